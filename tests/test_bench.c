/* carom bench: that it measures what it says, and what it writes. The figures themselves are the machine's.
 * SPDX-License-Identifier: MIT */
#include "command.h"

#include <math.h>
#include <png.h>

#define FIELDS 19
#define FAST "--runs 2 --seconds 0.0001 --quiet"

enum field {
	VERSION,
	TABLE,
	PART,
	DEVICE,
	STORAGE,
	BODIES,
	SHAPE,
	ALTERNATIVE,
	PIPELINE,
	ITERATIONS,
	RUN,
	REPETITIONS,
	LAUNCHES,
	SECONDS,
	PER_1000,
	PAPER,
	DRIFT,
	OVERLAP,
	COPY_RATE
};

/* ---- CSV ---- */

static char text[1 << 20];

struct csv {
	size_t rows;
	char *at[512][FIELDS];
};

static struct csv csv;

/* Cuts the field at `at` off, quotes removed; answers what follows its comma or newline. */
static char *cut_field(char *at, char **field, char *end)
{
	char *to = at;
	bool quoted = *at == '"';
	*field = at;
	at += quoted;
	while (*at && (quoted || (*at != ',' && *at != '\n'))) {
		if (quoted && *at == '"' && *++at != '"')
			break;
		*to++ = *at++;
	}
	*end = *at;
	if (*at != ',' && *at != '\n')
		fail_msg("a field that does not end: %.40s", *field);
	*to = '\0';
	return at + 1;
}

static void read_csv(const char *name)
{
	char path[128], end = 0;
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	text[fread(text, 1, sizeof text - 1, file)] = '\0';
	fclose(file);
	csv.rows = 0;
	for (char *at = text; *at; csv.rows++) {
		assert_true(csv.rows < COUNT(csv.at));
		for (size_t k = 0; k < FIELDS; k++) {
			at = cut_field(at, &csv.at[csv.rows][k], &end);
			assert_true(end == (k + 1 < FIELDS ? ',' : '\n'));
		}
	}
}

static double number(size_t row, enum field field)
{
	char *end = NULL;
	double value = strtod(csv.at[row][field], &end);
	if (!*csv.at[row][field] || *end || !(value >= 0))
		fail_msg("row %zu, field %d: \"%s\" is no figure", row, (int)field, csv.at[row][field]);
	return value;
}

static void check_row(size_t row, double bodies)
{
	assert_true(number(row, BODIES) == bodies && number(row, SECONDS) > 0 && number(row, REPETITIONS) >= 10);
	assert_true(number(row, RUN) == (double)(1 + (row - 1) % 2));
	assert_true(fabs(number(row, PER_1000) * number(row, REPETITIONS) / (1000 * number(row, SECONDS)) - 1) < 1e-6);
	assert_true(*csv.at[row][DEVICE] && strstr(csv.at[row][PIPELINE], "step=first_impact aabb=tight overlap=all_pairs"));
	assert_true(strcmp(csv.at[row][SHAPE], "circle") == 0 || strcmp(csv.at[row][SHAPE], "triangle") == 0);
}

/* How many rows have that in the field. */
static size_t count(enum field field, const char *value)
{
	size_t found = 0;
	for (size_t row = 1; row < csv.rows; row++)
		found += strcmp(csv.at[row][field], value) == 0;
	return found;
}

/* ---- Charts ---- */

static void check_chart(const char *name)
{
	char path[128];
	png_image image = {.version = PNG_IMAGE_VERSION};
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	if (!png_image_begin_read_from_file(&image, path))
		fail_msg("%s: %s", name, image.message);
	image.format = PNG_FORMAT_GRAY;
	uint8_t *pixels = malloc(PNG_IMAGE_SIZE(image));
	assert_non_null(pixels);
	assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
	assert_true(image.width >= 800 && image.height >= 400);
	double sum = 0, squares = 0, all = (double)image.width * image.height;
	for (size_t k = 0; k < PNG_IMAGE_SIZE(image); k++) {
		sum += pixels[k];
		squares += (double)pixels[k] * pixels[k];
	}
	double mean = sum / all, variance = squares / all - mean * mean;
	if (mean < 200 || variance < 20)
		fail_msg("%s: a mean of %g and a variance of %g", name, mean, variance);
	free(pixels);
}

/* A build with CAIRO=no says so at once. */
static bool has_charts(void)
{
	if (shell("$C bench table1 --sizes 12 --plot $D/none.png --device cpu --runs 1 --seconds 0.0001 --quiet") == 0)
		return true;
	if (!strstr(call.err, "built without cairo"))
		fail_msg("%s", call.err);
	if (getenv("CAROM_NO_SKIP"))
		fail_msg("%s", call.err);
	print_message("SKIPPED charts: %s", call.err);
	return false;
}

/* ---- Tests ---- */

static void all_tables_are_measured(void **state)
{
	(void)state;
	static const struct {
		const char *table, *title;
		size_t figures;
	} tables[] = {
		{"table1", "Table 1: ", 2}, {"table2", "Table 2: ", 4}, {"table3", "Table 3: ", 12}, {"table4", "Table 4: ", 8}, {"table5", "Table 5: ", 10}};
	char line[256], name[32];
	bool charts = has_charts();
	snprintf(line, sizeof line, "$C bench all --device cpu --sizes 12 " FAST " --csv $D/t.csv %s", charts ? "--plot $D/p.q.png" : "");
	check(line, 0, NULL);
	assert_string_equal(call.err, "");
	read_csv("t.csv");
	assert_int_equal(count(VERSION, carom_version()), csv.rows - 1);
	assert_int_equal(count(TABLE, "scale"), 0);
	for (size_t row = 1; row < csv.rows; row++)
		check_row(row, 12);
	for (size_t k = 0; k < COUNT(tables); k++) {
		assert_non_null(strstr(call.out, tables[k].title));
		assert_int_equal(count(TABLE, tables[k].table), 2 * tables[k].figures);
		snprintf(name, sizeof name, "p.q-%s.png", tables[k].table);
		if (charts)
			check_chart(name);
	}
	assert_int_equal(count(STORAGE, "memory"), csv.rows - 1);
	assert_non_null(strstr(call.out, "What is named OpenCL was left out"));
}

static void opencl_has_its_columns(void **state)
{
	(void)state;
	if (!has_opencl())
		return;
	check("$C bench table4 --device opencl --storage buffer --sizes 12 " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 1 + 2 * 16);
	assert_int_equal(count(STORAGE, "buffer"), 2 * 8);
	assert_int_equal(count(STORAGE, "memory"), 2 * 8);
	assert_int_equal(count(ALTERNATIVE, "OpenCL-bisection"), 2 * 4);
	assert_non_null(strstr(call.out, "textures in buffers"));
	check("$C bench table5 --device opencl --sizes 12 " FAST, 0, "");
	assert_non_null(strstr(call.out, "OpenCL's, by profiling events"));
}

/* ---- scale ---- */

/* The engines beside Carom that are in this build: what it says of those that are not. */
static size_t count_peers(void)
{
	static const char *const names[] = {"Box2D", "Chipmunk"};
	char line[64];
	size_t found = 0;
	for (size_t k = 0; k < COUNT(names); k++) {
		snprintf(line, sizeof line, "\n%s: not in this build", names[k]);
		bool is_there = !strstr(call.out, line);
		snprintf(line, sizeof line, "\n%s ", names[k]);
		assert_true(is_there == (strstr(call.out, line) != NULL));
		assert_true(is_there == (count(ALTERNATIVE, names[k]) > 0));
		found += is_there;
	}
	return found;
}

/* 12 bodies are the most that were measured, so it is told of them what is kept. */
static void check_kept(size_t row)
{
	char *end = NULL;
	bool ours = strncmp(csv.at[row][ALTERNATIVE], "Carom", 5) == 0;
	double drift = strtod(csv.at[row][DRIFT], &end);
	assert_true(end != csv.at[row][DRIFT] && !*end && number(row, BODIES) == 12 && number(row, REPETITIONS) == 1000);
	assert_true(ours ? fabs(drift) < 1e-4 && number(row, OVERLAP) < 1e-4 : drift > -1 && number(row, OVERLAP) < 1);
	assert_true(number(row, RUN) == 1 && number(row, SECONDS) > 0);
}

static void check_scale_row(size_t row, const char *step)
{
	char setting[64];
	bool ours = strncmp(csv.at[row][ALTERNATIVE], "Carom", 5) == 0;
	snprintf(setting, sizeof setting, "step=%s ", step);
	assert_true(ours == (strncmp(csv.at[row][PIPELINE], setting, strlen(setting)) == 0));
	assert_true(*csv.at[row][DEVICE] && *csv.at[row][PIPELINE] && !*csv.at[row][PAPER]);
	assert_true(strcmp(csv.at[row][SHAPE], "circle") == 0 || strcmp(csv.at[row][SHAPE], "triangle") == 0);
	assert_true(number(row, COPY_RATE) > 1e6 && number(row, LAUNCHES) == 0);
	assert_true(fabs(number(row, PER_1000) * number(row, REPETITIONS) / (1000 * number(row, SECONDS)) - 1) < 1e-6);
	if (strstr(csv.at[row][PART], ", kept")) {
		check_kept(row);
		return;
	}
	assert_true(number(row, BODIES) == 8 || number(row, BODIES) == 12);
	assert_true(number(row, SECONDS) > 0 && number(row, REPETITIONS) >= 1 && number(row, RUN) >= 1 && number(row, RUN) <= 2);
	assert_true(!*csv.at[row][DRIFT] && !*csv.at[row][OVERLAP]);
}

/* Two shapes, two sizes, two runs, and a row of what is kept. */
static void check_scale(const char *options, const char *step, size_t devices)
{
	char line[256];
	snprintf(line, sizeof line, "$C bench scale --sizes 8,12 " FAST " --csv $D/t.csv %s", options);
	check(line, 0, NULL);
	assert_string_equal(call.err, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 1 + 2 * (devices + count_peers()) * (2 * 2 + 1));
	assert_int_equal(count(TABLE, "scale"), csv.rows - 1);
	assert_int_equal(count(VERSION, carom_version()), csv.rows - 1);
	for (size_t row = 1; row < csv.rows; row++)
		check_scale_row(row, step);
	assert_int_equal(count(ALTERNATIVE, "Carom, CPU fallback"), 2 * 5);
	assert_int_equal(count(ALTERNATIVE, "Carom, OpenCL"), (devices - 1) * 2 * 5);
	assert_non_null(strstr(call.out, "kept in 1000 steps of 12 bodies"));
}

/* Whether every device has the step that is measured by itself. */
static bool has_events(void)
{
	if (shell("$C run scenes/thin_wall.json --steps 1 --set step=events --device cpu") == 0)
		return true;
	print_message("SKIPPED step=events: %s", call.err);
	return false;
}

static void scale_is_measured(void **state)
{
	(void)state;
	check_scale("--device cpu --set step=first_impact", "first_impact", 1);
	assert_non_null(strstr(call.out, "can't be compared"));
	if (has_opencl()) {
		check_scale("--device opencl --storage buffer --set step=first_impact", "first_impact", 2);
		assert_int_equal(count(STORAGE, "buffer"), 2 * 5);
	}
	if (!has_events())
		return;
	check_scale("--device cpu", "events", 1);
	assert_null(strstr(call.out, "can't be compared"));
}

static void scale_has_a_chart(void **state)
{
	(void)state;
	if (!has_charts())
		return;
	check("$C bench scale --device cpu --sizes 8,12,20 --set step=first_impact " FAST " --plot $D/scale.png", 0, "");
	check_chart("scale.png");
}

/* What does not fit is left out, and that is said. */
static void scale_goes_on_without_what_does_not_fit(void **state)
{
	(void)state;
	check("$C bench scale --device cpu --sizes 12,1048576 --set step=first_impact " FAST " --csv $D/t.csv", 0, "");
	assert_non_null(strstr(call.out, " 1048576  Carom, CPU fallback           -  left out: "));
	read_csv("t.csv");
	assert_int_equal(count(BODIES, "1048576"), 0);
	assert_true(count(BODIES, "12") > 0);
}

/* The figure of that alternative in run 1; NULL for none. */
static const char *paper_of(const char *bodies, const char *alternative)
{
	for (size_t row = 1; row < csv.rows; row++) {
		if (strcmp(csv.at[row][BODIES], bodies) == 0 && strcmp(csv.at[row][ALTERNATIVE], alternative) == 0)
			return csv.at[row][PAPER];
	}
	return NULL;
}

static void the_papers_figures_stand_beside_its_sizes(void **state)
{
	(void)state;
	check("$C bench table2 --device cpu --sizes 100,256,512 " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 1 + 2 * 3 * 4);
	assert_string_equal(paper_of("256", "classic"), "1.422");
	assert_string_equal(paper_of("512", "four_six"), "1.438");
	assert_string_equal(paper_of("512", "tiled"), "");
	assert_string_equal(paper_of("100", "six"), "");
	assert_non_null(strstr(call.out, "1.42"));
	assert_non_null(strstr(call.out, "10, scaled"));
}

static void launches_and_settings_are_told(void **state)
{
	(void)state;
	check("$C bench table1 --device cpu --sizes 20 --set inside=orourke " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 5);
	for (size_t row = 1; row < csv.rows; row++) {
		bool outside = strcmp(csv.at[row][ALTERNATIVE], "outside") == 0;
		assert_non_null(strstr(csv.at[row][PIPELINE], " inside=orourke toi=bisection "));
		assert_true(number(row, ITERATIONS) == (outside ? 1 : 0));
		assert_true(number(row, LAUNCHES) == number(row, REPETITIONS) * (outside ? 18 : 1));
	}
}

static void wrong_calls_exit_with_2(void **state)
{
	(void)state;
	static const struct {
		const char *line, *said;
	} calls[] = {
		{"$C bench table6", "table6: no such table; allowed: table1, table2, table3, table4, table5, scale, all"},
		{"$C bench table1 table2", "one argument too many"},
		{"$C bench table1 --runs 0", "--runs: found \"0\"; allowed: a whole number from 1 to 99"},
		{"$C bench table1 --runs 100", "allowed: a whole number from 1 to 99"},
		{"$C bench table1 --seconds 0", "--seconds: found \"0\"; allowed: a number above 0"},
		{"$C bench table1 --sizes 7", "--sizes: found \"7\"; allowed: at most 16 numbers of bodies, 8 to 1048576"},
		{"$C bench table1 --sizes 8,", "--sizes: found \"8,\""},
		{"$C bench table1 --sizes 8,,9", "--sizes: found \"8,,9\""},
		{"$C bench table1 --sizes 1048577", "--sizes: found \"1048577\""},
		{"$C bench table1 --sizes 9,9,9,9,9,9,9,9,9,9,9,9,9,9,9,9,9", "at most 16 numbers"},
		{"$C bench table1 --sizes 12 --device nowhere", "nowhere"},
		{"$C bench scale --sizes 12 --device nowhere", "nowhere"},
		{"$C bench scale --set step=guess", "--set: the slot 'step' has no alternative 'guess'"},
		{"$C bench scale --runs 0", "--runs: found \"0\""},
		{"$C bench table1 --set reduce=guess", "--set: the slot 'reduce' has no alternative 'guess'"},
	};
	for (size_t k = 0; k < COUNT(calls); k++)
		check(calls[k].line, 2, calls[k].said);
}

/* Before anything is measured. */
static void files_that_cannot_be_written_fail(void **state)
{
	(void)state;
	check("$C bench table4 --csv $D/nowhere/t.csv --device cpu", 1, "nowhere/t.csv");
	assert_string_equal(call.out, "");
	check("$C bench table1 --sizes 12 --csv $D/left.csv --device nowhere; test ! -e $D/left.csv", 0, NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(all_tables_are_measured), cmocka_unit_test(opencl_has_its_columns),
		cmocka_unit_test(scale_is_measured), cmocka_unit_test(scale_has_a_chart), cmocka_unit_test(scale_goes_on_without_what_does_not_fit),
		cmocka_unit_test(the_papers_figures_stand_beside_its_sizes), cmocka_unit_test(launches_and_settings_are_told),
		cmocka_unit_test(wrong_calls_exit_with_2), cmocka_unit_test(files_that_cannot_be_written_fail)};
	return cmocka_run_group_tests_name("bench", tests, make_folder, remove_folder);
}
