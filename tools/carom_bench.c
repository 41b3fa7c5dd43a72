/* carom bench: the paper's tables, measured here, and Carom beside other engines.
 * SPDX-License-Identifier: MIT */
#include "carom_bench.h"
#include "carom_plot.h"

#include <stdlib.h>
#include <string.h>

/* What `carom bench` takes by name; `all` those of the paper in this order. */
static const struct {
	const char *name;
	const struct bench_table *table; /* of the paper; NULL for the others, which have these */
	carom_status (*check)(const struct bench_options *options, carom_error *error);
	carom_status (*run)(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error);
} tables[] = {
	{"table1", &bench_table1, NULL, NULL},
	{"table2", &bench_table2, NULL, NULL},
	{"table3", &bench_table3, NULL, NULL},
	{"table4", &bench_table4, NULL, NULL},
	{"table5", &bench_table5, NULL, NULL},
	{"scale", NULL, bench_scale_check, bench_scale},
	{"tunnel", NULL, bench_tunnel_check, bench_tunnel},
	{"heap", NULL, bench_heap_check, bench_heap},
	{"rays", NULL, bench_rays_check, bench_rays},
};

#define TABLE_COUNT (sizeof tables / sizeof *tables)

#define PAPER_SECONDS 0.5 /* of a run, where --seconds is not given */
#define LEAST_BODIES 8    /* of fewer, not all numbers can be placed in their room */
#define MOST_BODIES 1048576

/* ---- Options ---- */

static carom_status read_runs(const char *text, void *target, carom_error *error)
{
	uint64_t runs = 0;
	if (read_count(text, &runs, error) != CAROM_OK || runs < 1 || runs > MAX_RUNS)
		return wrong(error, "found \"%s\"; allowed: a whole number from 1 to %d", text, MAX_RUNS);
	*(uint64_t *)target = runs;
	return CAROM_OK;
}

static carom_status read_sizes(const char *text, void *target, carom_error *error)
{
	struct bench_options *options = target;
	const char *at = text;
	options->size_count = 0;
	for (;;) {
		char *end = NULL;
		unsigned long size = *at >= '0' && *at <= '9' ? strtoul(at, &end, 10) : 0;
		if (size < LEAST_BODIES || size > MOST_BODIES || (*end && *end != ',') || options->size_count == MAX_SIZES)
			return wrong(error, "found \"%s\"; allowed: at most %d numbers of bodies, %d to %d each, like 256,512", text, MAX_SIZES, LEAST_BODIES,
				MOST_BODIES);
		options->sizes[options->size_count++] = (uint32_t)size;
		if (!*end)
			return CAROM_OK;
		at = end + 1;
	}
}

static const struct option options_table[] = {
	{"csv", "FILE.csv", read_path, offsetof(struct bench_options, csv), "write a table with a row a measurement, of all tables"},
	{"plot", "FILE.png", read_path, offsetof(struct bench_options, plot), "draw a chart; `all` draws one a table: FILE-table1.png and so on"},
	{"runs", "N", read_runs, offsetof(struct bench_options, runs), "runs of each figure, 1 to 99; their median is shown; default 5"},
	{"seconds", "S", read_positive, offsetof(struct bench_options, seconds),
		"about how long a run may last: where 1,000 repetitions take longer, 10 to 500 are measured and scaled, of scale 1 to "
		"500; "
		"default 0.5, for scale 0.2"},
	{"sizes", "N,N,..", read_sizes, 0,
		"numbers of bodies, 8 to 1048576; default those of the paper's table: 256 to 2048, for table2 to 4096; for scale 256 to "
		"1048576, for heap 100 and 400, for rays 1024, 16384 and 131072"},
	{NULL, NULL, NULL, 0, NULL},
};

/* ---- Files ---- */

/* Where the chart of the table goes; false if that is too long a name. */
static bool chart_path(const struct bench_options *options, const char *table, bool all, char *path, size_t size)
{
	const char *plot = options->plot, *dot = strrchr(plot, '.'), *slash = strrchr(plot, '/');
	size_t stem = dot && dot != plot && (!slash || dot > slash + 1) ? (size_t)(dot - plot) : strlen(plot);
	int length = all ? snprintf(path, size, "%.*s-%s%s", (int)stem, plot, table, plot + stem) : snprintf(path, size, "%s", plot);
	return length >= 0 && (size_t)length < size;
}

/* ---- Tables ---- */

static carom_status run_paper_table(const struct bench_table *table, const struct bench_options *options, FILE *csv, const char *plot,
	carom_error *error)
{
	struct bench_options own = *options;
	struct bench_result *result = calloc(1, sizeof *result);
	if (!result)
		return out_of_memory(error, "there is not enough memory for the figures");
	own.seconds = own.seconds > 0 ? own.seconds : PAPER_SECONDS;
	carom_status status = bench_measure(table, &own, result, error);
	if (status == CAROM_OK) {
		bench_print(result);
		fflush(stdout);
		if (csv)
			bench_write_csv(csv, result);
		status = plot ? bench_draw(result, plot, error) : CAROM_OK;
	}
	free(result);
	return status;
}

static carom_status check_table(size_t index, const struct bench_options *options, carom_error *error)
{
	carom_error found;
	const struct bench_table *table = tables[index].table;
	carom_status status = table ? bench_check(table, options, &found) : tables[index].check(options, &found);
	if (status != CAROM_OK)
		wrong(error, "%s can't be measured: %.900s", tables[index].name, found.text);
	return status;
}

static carom_status run_table(size_t index, const struct bench_options *options, bool all, FILE *csv, carom_error *error)
{
	char path[4096];
	const char *plot = options->plot ? path : NULL;
	if (plot && !chart_path(options, tables[index].name, all, path, sizeof path))
		return wrong(error, "--plot: the name is too long");
	if (!tables[index].table)
		return tables[index].run(options, csv, plot, error);
	return run_paper_table(tables[index].table, options, csv, plot, error);
}

/* `all` leaves out what this build of the library can't do. */
static carom_status run_tables(const struct bench_options *options, const char *name, FILE *csv, carom_error *error)
{
	bool all = strcmp(name, "all") == 0, printed = false;
	carom_status status = CAROM_OK;
	for (size_t k = 0; status == CAROM_OK && k < TABLE_COUNT; k++) {
		if (all ? !tables[k].table : strcmp(name, tables[k].name) != 0)
			continue;
		status = check_table(k, options, error);
		if (status == CAROM_UNKNOWN_NAME && all) {
			say(&options->common, "%s", error->text);
			status = CAROM_OK;
			continue;
		}
		if (status == CAROM_OK && printed)
			printf("\n\n");
		if (status == CAROM_OK)
			status = run_table(k, options, all, csv, error);
		printed = true;
	}
	return status;
}

static carom_status check_name(const char *name, carom_error *error)
{
	char known[256] = "";
	for (size_t k = 0; k < TABLE_COUNT; k++) {
		if (strcmp(name, tables[k].name) == 0)
			return CAROM_OK;
		size_t used = strlen(known);
		snprintf(known + used, sizeof known - used, "%s, ", tables[k].name);
	}
	return strcmp(name, "all") == 0 ? CAROM_OK : wrong(error, "%.80s: no such table; allowed: %sall", name, known);
}

/* Whether no chart would replace the CSV file. */
static carom_status check_paths(const struct bench_options *options, const char *name, carom_error *error)
{
	char path[4096];
	const bool all = strcmp(name, "all") == 0;
	for (size_t k = 0; options->csv && options->plot && k < TABLE_COUNT; k++) {
		if ((all || strcmp(name, tables[k].name) == 0) && chart_path(options, tables[k].name, all, path, sizeof path)
			&& are_one_file(options->csv, path))
			return wrong(error, "%s: --csv and --plot write there; give each a name of its own", options->csv);
	}
	return CAROM_OK;
}

/* The CSV file, and whether charts can be written, is looked at before minutes are spent. */
static carom_status run_bench(const struct bench_options *options, const char *name, carom_error *error)
{
	carom_file *file = NULL;
	FILE *csv = NULL;
	carom_status status = check_name(name, error);
	if (status == CAROM_OK)
		status = check_paths(options, name, error);
	if (status == CAROM_OK && options->plot)
		status = plot_check(options->plot, error);
	if (status == CAROM_OK && options->csv)
		status = carom_file_create(options->csv, &file, &csv, error);
	if (csv)
		bench_write_csv_header(csv);
	if (status == CAROM_OK)
		status = run_tables(options, name, csv, error);
	if (status == CAROM_OK && file) {
		status = carom_file_commit(file, error);
	} else {
		carom_file_destroy(file);
	}
	return status;
}

/* Where nobody says which device, it is OpenCL's, as in the paper, if there is one that works: the fallback is measured beside it. */
static const char *default_device(void)
{
	const char *chosen = getenv("CAROM_DEVICE");
	carom_device_info *devices = NULL;
	size_t count = 0;
	bool found = false;
	if ((chosen && *chosen) || carom_device_list_create(&devices, &count, NULL) != CAROM_OK)
		return NULL;
	for (size_t k = 0; k < count; k++)
		found = found || (devices[k].is_opencl && devices[k].works);
	carom_device_list_destroy(devices);
	return found ? "opencl" : NULL;
}

static int bench_main(int argc, char **argv)
{
	struct bench_options options = {.runs = 5};
	carom_error error;
	int code = parse_options(&bench_command, argc, argv, &options.common);
	if (code >= 0)
		return code;
	if (!options.common.device)
		options.common.device = default_device();
	catch_interruptions();
	if (run_bench(&options, options.common.argument_count ? options.common.arguments[0] : "all", &error) != CAROM_OK)
		return interrupted_code(report(&error));
	return finish_output();
}

const struct command bench_command = {
	.name = "bench",
	.arguments = "[table1 | table2 | table3 | table4 | table5 | scale | tunnel | heap | rays | all]",
	.least_arguments = 0,
	.most_arguments = 1,
	.summary = "Measures the tables of the paper here, its figures beside, and body-steps a second beside other engines",
	.details = "\n  table1  the bisection kernels, with the loop inside and outside\n"
			   "  table2  the minimum of all hit times, by each alternative of reduce\n"
			   "  table3  the six combinations of the rendering phase\n"
			   "  table4  whole steps of circles and triangles, on OpenCL and on the CPU fallback, drawn and not drawn\n"
			   "  table5  each kernel of a step\n"
			   "  all     all of these, the default: four to six minutes on two cores\n"
			   "  scale   not the paper's, and not part of all: body-steps a second over the number of bodies, by the step\n"
			   "          events, on OpenCL and on the CPU fallback, and how long a picture of them takes; beside, on the same\n"
			   "          bodies, Box2D and Chipmunk, where this build has them; what each keeps of the energy, and how\n"
			   "          deep bodies overlap: some minutes\n"
			   "  tunnel  likewise: how many fast circles pass a wall 1 mm thick, or one another head-on, by the same engines, at\n"
			   "          1 to 1,000 m/s; it has no chart, and --runs, --seconds and --sizes change nothing in it\n"
			   "  heap    likewise: how long a step of circles and squares (without friction and with) takes that fall into a room\n"
			   "          and then lie there, by the steps contacts and events and by the same engines; no chart, and\n"
			   "          --seconds changes nothing in it: some ten minutes\n"
			   "  rays    likewise: how long it takes to find what a ray meets first among circles and triangles, by carom_snapshot\n"
			   "          and by the same engines; no chart, and --seconds changes nothing in it\n\n"
			   "Figures are seconds for 1,000 repetitions, as in the paper: the median of the runs, the least and the\n"
			   "most; the paper's figure; the ratio, above 1 where Carom is faster. The bodies are those of\n"
			   "`carom generate --count N`, at its default fill, speed, radius and seed. Each run goes through the same\n"
			   "states, alternatives take turns, and everything is warmed up before. The device is --device or CAROM_DEVICE,\n"
			   "else one of OpenCL, where there is one; table4 measures the CPU fallback beside it. --set fills the\n"
			   "slots that the table does not vary; the others are the defaults. The paper's tables are of the step\n"
			   "first_impact; in scale, --set step=NAME measures that step.\n"
			   "An interruption ends it after the figure at hand; then no file is written.\n",
	.options = options_table,
	.makes_worlds = true,
	.main = bench_main,
};
