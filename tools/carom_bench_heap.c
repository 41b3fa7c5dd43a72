/* carom bench heap: what a step costs where bodies fall upon each other and lie there, in Carom and in other engines.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define FALLING 180 /* steps until they lie, most of them */
#define LYING 120   /* steps after these */
#define RESTITUTION 0.3f
#define GRAVITY 9.81f /* m/s^2 */
#define FILL 0.35
#define SPEED 1.0 /* m/s */
#define SHAPES 3
#define ENGINES 5

static const struct {
	struct scale_engine engine;
	const char *step; /* of Carom */
} engines[ENGINES] = {
	{{"Carom, CPU fallback, contacts", NULL, PLACE_CPU, 0}, "step=contacts"},
	{{"Carom, OpenCL, contacts", NULL, PLACE_OPENCL, 0}, "step=contacts"},
	{{"Carom, CPU fallback, events", NULL, PLACE_CPU, 0}, "step=events"},
	{{"Box2D", &peer_box2d, PLACE_CHOSEN, 0}, NULL},
	{{"Chipmunk", &peer_chipmunk, PLACE_CHOSEN, 0}, NULL},
};

static const struct {
	struct scale_shape shape;
	float friction;
} shapes[SHAPES] = {{{"circles", "circle", 0}, 0}, {{"squares", "square", 4}, 0}, {{"squares, friction 0.5", "square", 4}, 0.5f}};

static const uint32_t default_sizes[] = {100, 400};

/* What was measured of an engine and its heaps, one a run. */
struct heap_cell {
	size_t runs;
	double falling[MAX_RUNS], lying[MAX_RUNS]; /* s, of all these steps */
	uint64_t hits[MAX_RUNS];                   /* of Carom, in those lying */
	double energy[MAX_RUNS];                   /* J, in the end */
	double overlap;                            /* m, the deepest that was seen of those lying */
};

struct heap_result {
	size_t size_count;
	uint32_t sizes[MAX_SIZES];
	carom_device_info devices[ENGINES]; /* of Carom's */
	char settings[ENGINES][SCALE_SETTINGS];
	struct heap_cell cells[SHAPES][MAX_SIZES][ENGINES];
};

/* ---- Measuring ---- */

/* With the step that the engine is measured with. */
static struct bench_options options_of(const struct bench_options *options, size_t engine)
{
	struct bench_options own = *options;
	if (engines[engine].step)
		own.common.sets[own.common.set_count++] = engines[engine].step;
	return own;
}

static carom_status start_create(size_t shape, uint32_t bodies, uint64_t seed, const struct bench_options *options, struct scale_start *start,
	carom_error *error)
{
	const struct placement_def placement = {
		.sides = shapes[shape].shape.sides, .count = bodies, .fill = FILL, .speed = SPEED, .radius = 0.5, .seed = seed};
	carom_status status = scale_start_place(start, &placement, error);
	if (status != CAROM_OK)
		return status;
	start->scene.gravity = (carom_vec2){0, -GRAVITY};
	start->scene.restitution = RESTITUTION;
	start->scene.friction = shapes[shape].friction;
	return scale_start_fill(start, options, error);
}

static carom_status timed_steps(struct scale_runner *runner, uint64_t steps, double *seconds, carom_error *error)
{
	const double begun = wall_seconds();
	carom_status status = scale_runner_step(runner, steps, error);
	*seconds += wall_seconds() - begun;
	return status == CAROM_OK ? fail_interrupted(error) : status;
}

static carom_status run(struct scale_runner *runner, const struct peer_scene *scene, carom_world *judge, carom_body_state *states,
	struct heap_cell *cell, carom_error *error)
{
	const size_t index = cell->runs;
	carom_status status = CAROM_OK;
	for (int k = 0; status == CAROM_OK && k < FALLING; k += SCALE_KEPT_EVERY)
		status = timed_steps(runner, SCALE_KEPT_EVERY, &cell->falling[index], error);
	const uint64_t before = runner->hits;
	for (int k = 0; status == CAROM_OK && k < LYING; k += SCALE_KEPT_EVERY) {
		status = timed_steps(runner, SCALE_KEPT_EVERY, &cell->lying[index], error);
		if (status == CAROM_OK)
			status = scale_look(runner, scene, judge, states, &cell->overlap, &cell->energy[index], error);
	}
	cell->hits[index] = runner->hits - before;
	cell->runs += status == CAROM_OK;
	return status;
}

static carom_status measure_engine(struct heap_result *result, size_t engine, const struct scale_start *start, const struct bench_options *options,
	carom_world *judge, carom_body_state *states, struct heap_cell *cell, carom_error *error)
{
	const struct bench_options own = options_of(options, engine);
	struct scale_runner runner;
	if (engines[engine].engine.peer && !engines[engine].engine.peer->create)
		return CAROM_OK;
	carom_status status = scale_runner_create(&engines[engine].engine, start, &own, &runner, error);
	if (status != CAROM_OK)
		return status;
	if (scale_runner_describe(&runner, &result->devices[engine], result->settings[engine]))
		status = run(&runner, &start->scene, judge, states, cell, error);
	scale_runner_destroy(&runner);
	return status;
}

/* All engines take turns at the same bodies. */
static carom_status measure_heap(struct heap_result *result, size_t shape, size_t size, uint64_t seed, const struct bench_options *options,
	carom_error *error)
{
	const uint32_t bodies = result->sizes[size];
	struct scale_start start;
	carom_world *judge = NULL;
	carom_body_state *states = malloc(bodies * sizeof *states);
	carom_status status = start_create(shape, bodies, seed, options, &start, error);
	if (status == CAROM_OK && !states)
		status = out_of_memory(error, "there is not enough memory to measure");
	if (status == CAROM_OK)
		status = scale_judge_create(&start, &judge, error);
	for (size_t k = 0; status == CAROM_OK && k < ENGINES; k++)
		status = measure_engine(result, k, &start, options, judge, states, &result->cells[shape][size][k], error);
	carom_world_destroy(judge);
	scale_start_destroy(&start);
	free(states);
	return status;
}

static carom_status measure(const struct bench_options *options, struct heap_result *result, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (size_t shape = 0; shape < SHAPES; shape++) {
		for (size_t size = 0; size < result->size_count; size++) {
			for (uint64_t k = 1; status == CAROM_OK && k <= options->runs; k++)
				status = measure_heap(result, shape, size, k, options, error);
		}
	}
	return status;
}

/* ---- Text ---- */

static double mean_hits(const struct heap_cell *cell)
{
	double sum = 0;
	for (size_t k = 0; k < cell->runs; k++)
		sum += (double)cell->hits[k];
	return sum / (LYING * (double)cell->runs);
}

static void print_cell(const struct heap_cell *cell, size_t engine)
{
	const struct bench_spread falling = bench_spread(cell->falling, cell->runs, 1), lying = bench_spread(cell->lying, cell->runs, 1e3 / LYING);
	char texts[3][32], spread[80], hits[32] = "";
	if (!engines[engine].engine.peer)
		bench_format(mean_hits(cell), hits, sizeof hits);
	snprintf(spread, sizeof spread, "%s - %s", bench_format(lying.least, texts[0], sizeof texts[0]),
		bench_format(lying.most, texts[1], sizeof texts[1]));
	printf("  %-30s %10s", engines[engine].engine.label, bench_format(falling.median, texts[0], sizeof texts[0]));
	printf(" %10s  %-17s %11s %10.2g m %10.2g J\n", bench_format(lying.median, texts[2], sizeof texts[2]), spread, hits, cell->overlap,
		bench_spread(cell->energy, cell->runs, 1).median);
}

static void print(const struct heap_result *result, uint64_t runs)
{
	printf("heap: steps of 1/60 s by the wall clock\n");
	bench_print_device("CPU fallback", &result->devices[0]);
	if (result->devices[1].is_opencl)
		bench_print_device("device", &result->devices[1]);
	scale_print_peers();
	for (size_t shape = 0; shape < SHAPES; shape++) {
		for (size_t size = 0; size < result->size_count; size++) {
			printf("\n%u %-28s  falling, s  ms a step  least - most      hits a step      overlap       energy\n", (unsigned)result->sizes[size],
				shapes[shape].shape.title);
			for (size_t k = 0; k < ENGINES; k++) {
				if (result->cells[shape][size][k].runs)
					print_cell(&result->cells[shape][size][k], k);
			}
		}
	}
	printf("\nBodies of radius 0.5 m (squares: of the circle around), those of `carom generate --fill %g --speed %g --seed K` for K from 1\n"
		   "to %u, fall in their room with %g m/s^2, restitution %g. Where bodies lie is chaotic: each run is another heap.\n"
		   "falling: the first %d steps, together; the median of the runs.\n"
		   "ms a step: of the %d steps after these; the median of the runs, the least and the most. hits: the mean of these steps.\n"
		   "overlap: the deepest of all runs, looked for every %d of these steps, also with walls; energy: kinetic, in the end, the\n"
		   "median. Carom takes all cores, the others one. None lets bodies sleep. Of two restitutions Chipmunk takes the product.\n",
		FILL, SPEED, (unsigned)runs, (double)GRAVITY, (double)RESTITUTION, FALLING, LYING, SCALE_KEPT_EVERY);
}

/* ---- CSV ---- */

static void write_cell(FILE *stream, const struct heap_result *result, size_t shape, size_t size, size_t engine)
{
	const struct heap_cell *cell = &result->cells[shape][size][engine];
	for (size_t run = 0; run < cell->runs; run++) {
		for (int lies = 0; lies < 2; lies++) {
			const double seconds = lies ? cell->lying[run] : cell->falling[run];
			fprintf(stream, "%s,heap,\"%s, %s\",", carom_version(), shapes[shape].shape.title, lies ? "lying" : "falling");
			scale_put_engine(stream, &engines[engine].engine, &result->devices[engine], result->sizes[size], shapes[shape].shape.name,
				result->settings[engine]);
			fprintf(stream, "%zu,%d,0,%.9g,%.9g,,,", run + 1, lies ? LYING : FALLING, seconds, REPETITIONS * seconds / (lies ? LYING : FALLING));
			if (lies)
				fprintf(stream, "%.9g", cell->overlap);
			fputs(",,,,,", stream);
			if (lies && !engines[engine].engine.peer)
				fprintf(stream, "%" PRIu64, cell->hits[run]);
			putc('\n', stream);
		}
	}
}

static void write_csv(FILE *stream, const struct heap_result *result)
{
	for (size_t shape = 0; shape < SHAPES; shape++) {
		for (size_t size = 0; size < result->size_count; size++) {
			for (size_t k = 0; k < ENGINES; k++)
				write_cell(stream, result, shape, size, k);
		}
	}
}

/* ---- The call ---- */

carom_status bench_heap_check(const struct bench_options *options, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (size_t k = 0; k < options->common.set_count; k++) {
		if (!strncmp(options->common.sets[k], "step=", 5))
			return wrong(error, "--set: found %.80s; it measures contacts and events", options->common.sets[k]);
	}
	if (options->common.set_count == MAX_SETS)
		return wrong(error, "--set: more than %d together with those of the table", MAX_SETS);
	for (size_t k = 0; status == CAROM_OK && k < ENGINES; k++) {
		const struct bench_options own = options_of(options, k);
		carom_world_def def;
		status = scale_world_def(&own, PLACE_CHOSEN, &def, error);
	}
	return status == CAROM_OK && options->plot ? wrong(error, "--plot: it has no chart") : status;
}

carom_status bench_heap(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error)
{
	struct heap_result *result = calloc(1, sizeof *result);
	(void)plot;
	if (!result)
		return out_of_memory(error, "there is not enough memory for the figures");
	result->size_count = bench_choose_sizes(options, default_sizes, sizeof default_sizes / sizeof *default_sizes, result->sizes);
	carom_status status = measure(options, result, error);
	if (status == CAROM_OK) {
		print(result, options->runs);
		fflush(stdout);
		if (csv)
			write_csv(csv, result);
	}
	free(result);
	return status;
}
