/* Measuring: alternatives that are compared take turns, each run goes through the same states, and nothing is timed before
 * every kernel has been compiled and every page touched.
 * SPDX-License-Identifier: MIT */
#include "carom_bench.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define LEAST_REPETITIONS 10 /* two from every second stop */
#define FEW_REPETITIONS 50
#define UNTIMED 2
#define WARM_PART 0.1 /* of a run: long enough to tell how fast a subject is */

/* ---- Progress ---- */

/* `run` from 1; 0 while the subject is warmed up. */
static void show(const struct bench_options *options, const struct bench_result *result, const struct bench_part *part, uint32_t bodies, size_t run,
	const char *label)
{
	if (options->common.quiet || !isatty(STDERR_FILENO))
		return;
	fprintf(stderr, "\r%s, %s: %u bodies, ", result->table->name, part->title, (unsigned)bodies);
	if (run) {
		fprintf(stderr, "run %zu of %zu, ", run, result->runs);
	} else {
		fputs("warming up, ", stderr);
	}
	fprintf(stderr, "%s\033[K", label);
	fflush(stderr);
}

static void clear_line(const struct bench_options *options)
{
	if (!options->common.quiet && isatty(STDERR_FILENO))
		fprintf(stderr, "\r\033[K");
}

/* ---- A run ---- */

static bool is_of(const struct bench_column *column, const char *kernel)
{
	for (size_t k = 0; k < sizeof column->kernels / sizeof *column->kernels && column->kernels[k]; k++) {
		if (strcmp(column->kernels[k], kernel) == 0)
			return true;
	}
	return false;
}

/* What the column's kernels took so far. */
static carom_kernel_time sum_kernels(carom_world *world, const struct bench_column *column)
{
	carom_kernel_time sum = {NULL, 0, 0}, time;
	for (size_t k = 0; carom_world_profile(world, k, &time); k++) {
		if (is_of(column, time.kernel)) {
			sum.seconds += time.seconds;
			sum.launches += time.launches;
		}
	}
	return sum;
}

static carom_status measure_work(struct bench_world *world, const struct bench_part *part, struct bench_row *row, size_t run, uint64_t times,
	carom_error *error)
{
	carom_kernel_time before[MAX_COLUMNS];
	for (size_t k = 0; k < part->column_count; k++)
		before[k] = sum_kernels(world->world, &part->columns[k]);
	double begun = wall_seconds();
	carom_status status = bench_world_work(world, times, error);
	double wall = wall_seconds() - begun;
	for (size_t k = 0; status == CAROM_OK && k < part->column_count; k++) {
		const struct bench_column *column = &part->columns[k];
		if (&part->subjects[column->subject] != world->subject)
			continue;
		carom_kernel_time after = sum_kernels(world->world, column);
		row->cells[k].measured = true;
		row->cells[k].seconds[run] += *column->kernels ? after.seconds - before[k].seconds : wall;
		row->cells[k].launches += run == 0 ? after.launches - before[k].launches : 0;
	}
	return status;
}

/* As many repetitions from each stop, or where they are few from every second; the first there are not timed, since they
 * send the state and clear what the stop before has left. */
static carom_status measure_run(struct bench_world *world, const struct bench_part *part, const struct bench_path *path, struct bench_row *row,
	size_t run, carom_error *error)
{
	carom_status status = CAROM_OK;
	size_t stride = row->repetitions <= FEW_REPETITIONS && path->stops > 1 ? 2 : 1;
	uint64_t times = row->repetitions / (path->stops / stride);
	for (size_t stop = stride - 1; status == CAROM_OK && stop < path->stops; stop += stride) {
		status = bench_world_restore(world, path, stop, error);
		if (status == CAROM_OK)
			status = bench_world_work(world, UNTIMED, error);
		if (status == CAROM_OK)
			status = measure_work(world, part, row, run, times, error);
	}
	return status;
}

/* ---- A row ---- */

/* Seconds a repetition takes once all is warm, measured over `least` seconds at least. */
static carom_status warm_up(struct bench_world *world, const struct bench_path *path, double least, double *seconds, carom_error *error)
{
	carom_status status = bench_world_restore(world, path, path->stops - 1, error);
	if (status == CAROM_OK)
		status = bench_world_work(world, UNTIMED, error);
	for (uint64_t times = 1; status == CAROM_OK; times *= 4) {
		double begun = wall_seconds();
		status = bench_world_work(world, times, error);
		*seconds = (wall_seconds() - begun) / (double)times;
		if (*seconds * (double)times > least || times >= REPETITIONS)
			break;
	}
	return status;
}

/* A round number, so that it seldom differs from one call to the next. */
static uint64_t choose_repetitions(double wanted)
{
	static const uint64_t rounds[] = {1000, 500, 200, 100, 50, 20};
	for (size_t k = 0; k < sizeof rounds / sizeof *rounds; k++) {
		if ((double)rounds[k] <= wanted)
			return rounds[k];
	}
	return LEAST_REPETITIONS;
}

static bool is_profiled(const struct bench_part *part, size_t subject)
{
	for (size_t k = 0; k < part->column_count; k++) {
		if (part->columns[k].subject == subject && *part->columns[k].kernels)
			return true;
	}
	return false;
}

static bool left_out(const struct bench_result *result, const struct bench_subject *subject)
{
	return subject->place == PLACE_OPENCL && !result->device.is_opencl;
}

/* All worlds of a part, warm; where a subject is left out, none. */
static carom_status prepare(const struct bench_part *part, const struct bench_options *options, const struct bench_result *result,
	const struct bench_path *path, struct bench_row *row, struct bench_world *worlds, carom_error *error)
{
	carom_status status = CAROM_OK;
	double slowest = 0, seconds = 0;
	for (size_t k = 0; status == CAROM_OK && k < part->subject_count; k++) {
		const struct bench_subject *subject = &part->subjects[k];
		if (left_out(result, subject))
			continue;
		show(options, result, part, row->bodies, 0, subject->label);
		status = bench_world_create(subject, options, row->bodies, is_profiled(part, k), &worlds[k], error);
		if (status == CAROM_OK)
			status = warm_up(&worlds[k], path, WARM_PART * options->seconds, &seconds, error);
		slowest = seconds > slowest ? seconds : slowest;
	}
	row->repetitions = choose_repetitions(slowest > 0 ? options->seconds / slowest : REPETITIONS);
	return status;
}

static carom_status measure_row(const struct bench_part *part, const struct bench_options *options, const struct bench_result *result,
	const struct bench_path *path, struct bench_row *row, struct bench_world *worlds, carom_error *error)
{
	carom_status status = prepare(part, options, result, path, row, worlds, error);
	for (size_t run = 0; run < options->runs; run++) {
		for (size_t k = 0; status == CAROM_OK && k < part->subject_count; k++) {
			size_t subject = (k + run) % part->subject_count; /* so that none always follows the same */
			if (!worlds[subject].world)
				continue;
			show(options, result, part, row->bodies, run + 1, part->subjects[subject].label);
			status = measure_run(&worlds[subject], part, path, row, run, error);
			if (status == CAROM_OK)
				status = fail_interrupted(error);
		}
	}
	return status;
}

/* ---- A table ---- */

void bench_describe_pipeline(const carom_world *world, char *text, size_t size)
{
	const carom_pipeline *pipeline = &carom_world_get_def(world)->pipeline;
	const char *slot = "";
	carom_stage_info info;
	size_t used = 0;
	for (size_t k = 0; used < size && carom_stage_list(k, &info); k++) {
		const char *chosen = carom_pipeline_get(pipeline, info.slot);
		if (strcmp(slot, info.slot) != 0 && chosen)
			used += (size_t)snprintf(text + used, size - used, "%s%s=%s", used ? " " : "", info.slot, chosen);
		slot = info.slot;
	}
}

static carom_status measure_part(struct bench_result *result, size_t part, const struct bench_options *options, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (size_t k = 0; status == CAROM_OK && k < result->row_count; k++) {
		struct bench_world worlds[MAX_SUBJECTS] = {{0}};
		struct bench_row *row = &result->rows[part][k];
		struct bench_path path = {0, NULL};
		show(options, result, &result->table->parts[part], row->bodies, 0, "1,000 steps to begin from");
		status = bench_path_create(&result->table->parts[part], row->bodies, &path, error);
		if (status == CAROM_OK)
			status = measure_row(&result->table->parts[part], options, result, &path, row, worlds, error);
		for (size_t i = 0; i < MAX_SUBJECTS; i++) {
			if (worlds[i].world)
				bench_describe_pipeline(worlds[i].world, result->pipelines[part][i], sizeof result->pipelines[part][i]);
			bench_world_destroy(&worlds[i]);
		}
		bench_path_destroy(&path);
	}
	return status;
}

/* As the worlds of the table have it: its storage depends on what they run. */
static carom_status find_device(const struct bench_table *table, const struct bench_options *options, const char *name, carom_device_info *info,
	carom_error *error)
{
	struct bench_options own = *options;
	carom_world_def def;
	carom_world *world = NULL;
	own.common.device = name;
	carom_status status = bench_world_def(&table->parts[0].subjects[0], &own, &def, error);
	if (status == CAROM_OK)
		status = carom_world_create(&def, &world, error);
	if (status == CAROM_OK)
		status = carom_world_get_device(world, info, error);
	carom_world_destroy(world);
	return status;
}

static bool needs_fallback(const struct bench_table *table)
{
	for (size_t i = 0; i < table->part_count; i++) {
		for (size_t k = 0; k < table->parts[i].subject_count; k++) {
			if (table->parts[i].subjects[k].place == PLACE_CPU)
				return true;
		}
	}
	return false;
}

static void choose_sizes(struct bench_result *result, const struct bench_options *options)
{
	const struct bench_table *table = result->table;
	result->row_count = options->size_count ? options->size_count : table->most - table->least + 1;
	for (size_t part = 0; part < table->part_count; part++) {
		for (size_t k = 0; k < result->row_count; k++)
			result->rows[part][k].bodies = options->size_count ? options->sizes[k] : 1u << (table->least + k);
	}
}

carom_status bench_check(const struct bench_table *table, const struct bench_options *options, carom_error *error)
{
	carom_status status = CAROM_OK;
	carom_world_def def;
	for (size_t k = 0; k < options->common.set_count; k++) { /* whose kernels the tables are of */
		const char *set = options->common.sets[k];
		if (strncmp(set, "step=", 5) == 0 && strcmp(set, "step=first_impact") != 0)
			return wrong(error, "--set: found %.80s; allowed: step=first_impact", set);
	}
	for (size_t i = 0; status == CAROM_OK && i < table->part_count; i++) {
		for (size_t k = 0; status == CAROM_OK && k < table->parts[i].subject_count; k++)
			status = bench_world_def(&table->parts[i].subjects[k], options, &def, error);
	}
	return status;
}

carom_status bench_measure(const struct bench_table *table, const struct bench_options *options, struct bench_result *result, carom_error *error)
{
	result->table = table;
	result->runs = (size_t)options->runs;
	choose_sizes(result, options);
	carom_status status = find_device(table, options, options->common.device, &result->device, error);
	if (status == CAROM_OK && needs_fallback(table))
		status = find_device(table, options, "cpu", &result->fallback, error);
	for (size_t part = 0; status == CAROM_OK && part < table->part_count; part++)
		status = measure_part(result, part, options, error);
	clear_line(options);
	return status;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* The paper's figure for that many bodies, 0 for none. */
static double paper_of(const struct bench_column *column, uint32_t bodies)
{
	for (unsigned k = 0; column->paper && k < PAPER_SIZES; k++) {
		if (bodies == 1u << (PAPER_LOG2 + k))
			return column->paper[k];
	}
	return 0;
}

size_t bench_choose_sizes(const struct bench_options *options, const uint32_t *standard, size_t count, uint32_t sizes[MAX_SIZES])
{
	const size_t chosen = options->size_count ? options->size_count : count;
	memcpy(sizes, options->size_count ? options->sizes : standard, chosen * sizeof *sizes);
	return chosen;
}

struct bench_spread bench_spread(const double *seconds, size_t runs, double scale)
{
	double sorted[MAX_RUNS];
	memcpy(sorted, seconds, runs * sizeof *sorted);
	qsort(sorted, runs, sizeof *sorted, compare);
	return (struct bench_spread){
		.median = scale * (sorted[(runs - 1) / 2] + sorted[runs / 2]) / 2,
		.least = scale * sorted[0],
		.most = scale * sorted[runs - 1],
	};
}

struct bench_summary bench_summarize(const struct bench_result *result, const struct bench_row *row, const struct bench_column *column, size_t index)
{
	return (struct bench_summary){
		.spread = bench_spread(row->cells[index].seconds, result->runs, REPETITIONS / (double)row->repetitions),
		.paper = paper_of(column, row->bodies),
	};
}
