/* Timing engines over sizes. All begin from the same bodies, which have met a few times; each then runs on by itself. They take
 * turns, so that none always meets the machine in the same mood.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <string.h>
#include <unistd.h>

#define START_SECONDS 10.0 /* the steps before all may take */
#define WARM_BATCHES 2     /* the steps before, of each engine, last as long as that */
#define LEAST_WARM 2
#define LEAST_STEPS 10                 /* of Carom in a batch: every few steps it makes its lists of neighbours anew */
#define UNTIMED 2                      /* steps after another engine had the caches; where batches are long it makes no difference */
#define COPY_BYTES ((size_t)256 << 20) /* more than caches hold */

/* ---- Progress ---- */

static void show(const struct bench_options *options, const char *shape, uint32_t bodies, const char *what)
{
	if (!options->common.quiet && isatty(STDERR_FILENO)) {
		fprintf(stderr, "\rscale, %s: %u bodies, %s\033[K", shape, (unsigned)bodies, what);
		fflush(stderr);
	}
}

static void clear_line(const struct bench_options *options)
{
	if (!options->common.quiet && isatty(STDERR_FILENO))
		fprintf(stderr, "\r\033[K");
}

/* ---- A cell ---- */

/* Seconds a step takes once caches are full and trees are grown: at most SCALE_WARM steps, and about `least` seconds. */
static carom_status warm_up(struct scale_runner *runner, double least, double *seconds, carom_error *error)
{
	uint64_t done = LEAST_WARM; /* kernels may be compiled in these */
	carom_status status = scale_runner_step(runner, done, error);
	const double begun = wall_seconds();
	for (uint64_t steps = 1; status == CAROM_OK && done < SCALE_WARM && wall_seconds() - begun < least; steps *= 2) {
		double from = wall_seconds();
		steps = steps < SCALE_WARM - done ? steps : SCALE_WARM - done;
		status = scale_runner_step(runner, steps, error);
		*seconds = (wall_seconds() - from) / (double)steps;
		done += steps;
	}
	return status;
}

/* A round number, for what takes so many seconds a step. */
static uint64_t choose_steps(const struct scale_runner *runner, double seconds, const struct bench_options *options)
{
	static const uint64_t rounds[] = {1000, 500, 200, 100, 50, 20, 10, 5, 2};
	double wanted = options->seconds / seconds;
	if (runner->world && seconds < SCALE_SLOW && wanted < LEAST_STEPS)
		wanted = LEAST_STEPS;
	for (size_t k = 0; k < sizeof rounds / sizeof *rounds; k++) {
		if ((double)rounds[k] <= wanted)
			return rounds[k];
	}
	return 1;
}

const char *scale_absence(const struct scale_result *result, size_t engine)
{
	const struct scale_engine *this = &scale_engines[engine];
	if (this->peer && !this->peer->create)
		return this->peer->settings;
	return this->place == PLACE_OPENCL && !result->device.is_opencl ? "the device chosen is none of OpenCL's" : NULL;
}

/* Notes why the engine is left out of the row, if it is. */
static bool left_out(const struct scale_result *result, const struct scale_row *rows, size_t row, size_t engine, char *why, size_t size)
{
	const char *absence = scale_absence(result, engine);
	if (absence)
		snprintf(why, size, "%s", absence);
	for (size_t k = 0; !absence && k < row; k++) {
		double seconds = scale_spread(result, &rows[k].cells[engine]).median;
		if (rows[k].bodies < rows[row].bodies && seconds > SCALE_SLOW) {
			snprintf(why, size, "with %u a step took %.1f s", (unsigned)rows[k].bodies, seconds);
			return true;
		}
	}
	return absence != NULL;
}

/* What does not fit is no error: the others are still measured. */
static carom_status forgive(carom_status status, const carom_error *error, char *why, size_t size)
{
	if (status != CAROM_LIMIT && status != CAROM_OUT_OF_MEMORY)
		return status;
	snprintf(why, size, "%.*s", (int)size - 1, error->text);
	return CAROM_OK;
}

static carom_status prepare(struct scale_result *result, size_t shape, size_t row, size_t engine, const struct scale_start *start,
	const struct bench_options *options, struct scale_runner *runner, carom_error *error)
{
	struct scale_cell *cell = &result->rows[shape][row].cells[engine];
	double seconds = 0;
	if (left_out(result, result->rows[shape], row, engine, cell->why, sizeof cell->why))
		return CAROM_OK;
	show(options, scale_shapes[shape].title, result->rows[shape][row].bodies, scale_engines[engine].label);
	carom_status status = scale_runner_create(&scale_engines[engine], start, options, runner, error);
	if (status == CAROM_OK)
		status = warm_up(runner, WARM_BATCHES * options->seconds, &seconds, error);
	if (status == CAROM_OK)
		status = scale_runner_draw(runner, error);
	if (status == CAROM_OK) {
		cell->steps = choose_steps(runner, seconds, options);
		return CAROM_OK;
	}
	scale_runner_destroy(runner);
	return forgive(status, error, cell->why, sizeof cell->why);
}

/* Of what a step has moved, as in a film; like the first steps, the first picture after another engine had the caches is not timed. */
static carom_status measure_picture(struct scale_runner *runner, double *seconds, carom_error *error)
{
	carom_status status = scale_runner_draw(runner, error);
	if (status == CAROM_OK)
		status = scale_runner_step(runner, 1, error);
	const double begun = wall_seconds();
	if (status == CAROM_OK)
		status = scale_runner_draw(runner, error);
	*seconds = wall_seconds() - begun;
	return status;
}

static carom_status measure_batch(struct scale_runner *runner, struct scale_cell *cell, size_t run, carom_error *error)
{
	carom_status status = cell->steps > 5 * UNTIMED ? scale_runner_step(runner, UNTIMED, error) : CAROM_OK;
	double begun = wall_seconds();
	if (status == CAROM_OK)
		status = scale_runner_step(runner, cell->steps, error);
	cell->seconds[run] = wall_seconds() - begun;
	return status == CAROM_OK && runner->world ? measure_picture(runner, &cell->picture[run], error) : status;
}

/* ---- A row ---- */

static carom_status measure_engines(struct scale_result *result, size_t shape, size_t row, const struct scale_start *start,
	const struct bench_options *options, carom_error *error)
{
	struct scale_runner runners[SCALE_ENGINES] = {{0}};
	struct scale_row *cells = &result->rows[shape][row];
	carom_status status = CAROM_OK;
	for (size_t k = 0; status == CAROM_OK && k < SCALE_ENGINES; k++)
		status = prepare(result, shape, row, k, start, options, &runners[k], error);
	for (size_t run = 0; run < result->runs; run++) {
		for (size_t k = 0; status == CAROM_OK && k < SCALE_ENGINES; k++) {
			size_t engine = (k + run) % SCALE_ENGINES;
			if (!cells->cells[engine].steps)
				continue;
			show(options, scale_shapes[shape].title, cells->bodies, scale_engines[engine].label);
			status = measure_batch(&runners[engine], &cells->cells[engine], run, error);
			if (status == CAROM_OK)
				status = fail_interrupted(error);
		}
	}
	for (size_t k = 0; k < SCALE_ENGINES; k++)
		scale_runner_destroy(&runners[k]);
	return status;
}

static carom_status measure_row(struct scale_result *result, size_t shape, size_t row, const struct bench_options *options, carom_error *error)
{
	struct scale_row *this = &result->rows[shape][row];
	struct scale_start start;
	show(options, scale_shapes[shape].title, this->bodies, "100 steps to begin from");
	carom_status status = scale_start_create(&scale_shapes[shape], this->bodies, options, SCALE_WARM, START_SECONDS, &start, error);
	if (status != CAROM_OK) { /* nobody has bodies then */
		for (size_t k = 1; k < SCALE_ENGINES; k++)
			snprintf(this->cells[k].why, sizeof this->cells[k].why, "the bodies could not be made");
		return forgive(status, error, this->cells[0].why, sizeof this->cells[0].why);
	}
	this->warm = start.steps;
	status = measure_engines(result, shape, row, &start, options, error);
	scale_start_destroy(&start);
	return status;
}

/* ---- All ---- */

static carom_status describe(struct scale_result *result, size_t engine, const struct bench_options *options, carom_error *error)
{
	carom_device_info *info = scale_engines[engine].place == PLACE_CPU ? &result->fallback : &result->device;
	carom_world_def def;
	carom_world *world = NULL;
	carom_status status = scale_world_def(options, scale_engines[engine].place, &def, error);
	if (status == CAROM_OK)
		status = carom_world_create(&def, &world, error);
	if (status == CAROM_OK)
		status = carom_world_get_device(world, info, error);
	if (status == CAROM_OK) {
		bench_describe_pipeline(world, result->settings[engine], sizeof result->settings[engine]);
		snprintf(result->step, sizeof result->step, "%s", carom_pipeline_get(&carom_world_get_def(world)->pipeline, "step"));
	}
	carom_world_destroy(world);
	return status;
}

static carom_status describe_all(struct scale_result *result, const struct bench_options *options, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (size_t k = 0; status == CAROM_OK && k < SCALE_ENGINES; k++) {
		if (scale_engines[k].peer) {
			snprintf(result->settings[k], sizeof result->settings[k], "%s", scale_engines[k].peer->settings);
		} else {
			status = describe(result, k, options, error);
		}
	}
	return status;
}

/* The largest that is not above SCALE_KEPT. */
static uint32_t choose_kept(const struct scale_result *result)
{
	uint32_t kept = 0;
	for (size_t k = 0; k < result->row_count; k++) {
		uint32_t bodies = result->rows[0][k].bodies;
		kept = bodies <= SCALE_KEPT && bodies > kept ? bodies : kept;
	}
	return kept ? kept : SCALE_KEPT;
}

static void choose_sizes(struct scale_result *result, const struct bench_options *options)
{
	const uint32_t least = 8, most = 20;
	result->runs = (size_t)options->runs;
	result->row_count = options->size_count ? options->size_count : most - least + 1;
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		for (size_t k = 0; k < result->row_count; k++)
			result->rows[shape][k].bodies = options->size_count ? options->sizes[k] : 1u << (least + k);
	}
	result->kept_bodies = choose_kept(result);
}

carom_status scale_measure(const struct bench_options *options, struct scale_result *result, carom_error *error)
{
	choose_sizes(result, options);
	carom_status status = describe_all(result, options, error);
	if (status == CAROM_OK)
		scale_measure_copy(result, COPY_BYTES, result->fallback.compute_units);
	for (size_t shape = 0; status == CAROM_OK && shape < SCALE_SHAPES; shape++) {
		for (size_t k = 0; status == CAROM_OK && k < result->row_count; k++)
			status = measure_row(result, shape, k, options, error);
		show(options, scale_shapes[shape].title, result->kept_bodies, "what is kept");
		if (status == CAROM_OK)
			status = scale_measure_kept(result, shape, options, error);
	}
	if (status == CAROM_OK)
		scale_measure_copy(result, COPY_BYTES, result->fallback.compute_units);
	clear_line(options);
	return status;
}
