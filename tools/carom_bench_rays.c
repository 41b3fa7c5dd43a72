/* carom bench rays: how long it takes to find what a ray meets first, in Carom and in other engines.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RAYS 10000 /* in a run */
#define LENGTHS 2
#define ENGINES 3
#define TURN 2.399963 /* rad from one ray to the next: that of the golden section goes round without a pattern */

static const float lengths[LENGTHS] = {5, 100}; /* m; the first meets something mostly, the second nearly always */

static const struct scale_engine engines[ENGINES] = {
	{"Carom", NULL, PLACE_CPU, 0}, {"Box2D", &peer_box2d, PLACE_CHOSEN, 0}, {"Chipmunk", &peer_chipmunk, PLACE_CHOSEN, 0}};

static const uint32_t default_sizes[] = {1024, 16384, 131072};

struct rays_cell {
	size_t runs;
	double seconds[MAX_RUNS]; /* of all the rays */
	uint32_t met, other;      /* rays that meet a body, and those that meet another than Carom says, or none */
};

struct rays_result {
	size_t size_count;
	uint32_t sizes[MAX_SIZES];
	carom_device_info device;
	double snapshot[SCALE_SHAPES][MAX_SIZES][MAX_RUNS]; /* s, to make one */
	struct rays_cell cells[SCALE_SHAPES][MAX_SIZES][LENGTHS][ENGINES];
};

/* What is measured of one set of bodies. */
struct rays_run {
	struct scale_start start;
	carom_snapshot *snapshot;
	void *peers[ENGINES]; /* NULL for Carom, and for what is not in this build */
	carom_ray rays[RAYS];
	carom_ray_hit met[RAYS];
	int32_t found[RAYS]; /* a body, or below 0 */
};

/* ---- Measuring ---- */

/* From places in the room where no body is: of what a ray begins in engines say different things. */
static carom_status place_rays(struct rays_run *run, float length, carom_error *error)
{
	const struct peer_scene *scene = &run->start.scene;
	const float width = scene->room_max.x - scene->room_min.x, height = scene->room_max.y - scene->room_min.y;
	double at = 0;
	for (size_t k = 0; k < RAYS;) {
		const double angle = TURN * (at += 1);
		const carom_vec2 from = {
			scene->room_min.x + width * (float)fmod(0.7548776662 * at, 1), scene->room_min.y + height * (float)fmod(0.5698402910 * at, 1)};
		size_t bodies = 0;
		const carom_status status = carom_snapshot_find(run->snapshot, from, from, NULL, 0, &bodies, error);
		if (status != CAROM_OK)
			return status;
		if (bodies == 0)
			run->rays[k++] = (carom_ray){from, {from.x + length * (float)cos(angle), from.y + length * (float)sin(angle)}, 0};
	}
	return CAROM_OK;
}

static carom_status cast(struct rays_run *run, size_t engine, carom_error *error)
{
	if (!engines[engine].peer)
		return carom_snapshot_cast_rays(run->snapshot, RAYS, run->rays, run->met, error);
	for (size_t k = 0; k < RAYS; k++)
		run->found[k] = engines[engine].peer->cast(run->peers[engine], run->rays[k].from, run->rays[k].to);
	return CAROM_OK;
}

static carom_status measure_engine(struct rays_run *run, size_t engine, struct rays_cell *cell, carom_error *error)
{
	const double begun = wall_seconds();
	const carom_status status = cast(run, engine, error);
	cell->seconds[cell->runs] = wall_seconds() - begun;
	if (status != CAROM_OK)
		return status;
	cell->runs++;
	cell->met = cell->other = 0;
	for (size_t k = 0; k < RAYS; k++) {
		const int32_t ours = run->met[k].other, found = engines[engine].peer ? run->found[k] : ours;
		cell->met += found >= 0;
		cell->other += found != ours && (found >= 0 || ours >= 0);
	}
	return fail_interrupted(error);
}

/* Engines take turns; that of the first run is to warm up. */
static carom_status measure_lengths(struct rays_result *result, size_t shape, size_t size, uint64_t runs, struct rays_run *run, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (size_t length = 0; status == CAROM_OK && length < LENGTHS; length++) {
		struct rays_cell *cells = result->cells[shape][size][length];
		status = place_rays(run, lengths[length], error);
		for (uint64_t k = 0; k <= runs; k++) {
			for (size_t engine = 0; status == CAROM_OK && engine < ENGINES; engine++) {
				if (k == 1)
					cells[engine].runs = 0;
				if (!engines[engine].peer || run->peers[engine])
					status = measure_engine(run, engine, &cells[engine], error);
			}
		}
	}
	return status;
}

static carom_status measure_snapshots(struct rays_run *run, uint64_t runs, double *seconds, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (uint64_t k = 0; status == CAROM_OK && k <= runs; k++) {
		carom_snapshot_destroy(run->snapshot);
		run->snapshot = NULL;
		const double begun = wall_seconds();
		status = carom_snapshot_create(run->start.world, &run->snapshot, error);
		if (k > 0)
			seconds[k - 1] = wall_seconds() - begun;
	}
	return status;
}

static carom_status measure_bodies(struct rays_result *result, size_t shape, size_t size, const struct bench_options *options, carom_error *error)
{
	struct rays_run *run = calloc(1, sizeof *run);
	if (!run)
		return out_of_memory(error, "there is not enough memory for the rays");
	carom_status status = scale_start_create(&scale_shapes[shape], result->sizes[size], options, 0, 0, &run->start, error);
	if (status == CAROM_OK)
		status = carom_world_get_device(run->start.world, &result->device, error);
	if (status == CAROM_OK)
		status = measure_snapshots(run, options->runs, result->snapshot[shape][size], error);
	for (size_t k = 0; status == CAROM_OK && k < ENGINES; k++)
		run->peers[k] = engines[k].peer && engines[k].peer->create ? engines[k].peer->create(&run->start.scene) : NULL;
	if (status == CAROM_OK)
		status = measure_lengths(result, shape, size, options->runs, run, error);
	for (size_t k = 0; k < ENGINES; k++) {
		if (run->peers[k])
			engines[k].peer->destroy(run->peers[k]);
	}
	carom_snapshot_destroy(run->snapshot);
	scale_start_destroy(&run->start);
	free(run);
	return status;
}

/* ---- Text ---- */

static void print_engine(const struct rays_cell cells[LENGTHS][ENGINES], size_t engine)
{
	printf("  %-10s", engines[engine].label);
	for (size_t length = 0; length < LENGTHS; length++) {
		const struct rays_cell *cell = &cells[length][engine];
		const struct bench_spread spread = bench_spread(cell->seconds, cell->runs, 1e6 / RAYS);
		char texts[3][32], all[80];
		snprintf(all, sizeof all, "%s (%s - %s)", bench_format(spread.median, texts[0], sizeof texts[0]),
			bench_format(spread.least, texts[1], sizeof texts[1]), bench_format(spread.most, texts[2], sizeof texts[2]));
		printf("  %-26s %6u %6u", all, (unsigned)cell->met, (unsigned)cell->other);
	}
	putchar('\n');
}

static void print(const struct rays_result *result, uint64_t runs)
{
	printf("rays: microseconds to find what a ray meets first, on one core\n");
	bench_print_device("Carom on", &result->device);
	scale_print_peers();
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		for (size_t size = 0; size < result->size_count; size++) {
			char text[32];
			const struct bench_spread snapshot = bench_spread(result->snapshot[shape][size], runs, 1e3);
			printf("\n%u %s; Carom's snapshot of them takes %s ms\n            ", (unsigned)result->sizes[size], scale_shapes[shape].title,
				bench_format(snapshot.median, text, sizeof text));
			for (size_t length = 0; length < LENGTHS; length++)
				printf("  %3.0f m: us (least - most)      met  other", (double)lengths[length]);
			putchar('\n');
			for (size_t engine = 0; engine < ENGINES; engine++) {
				if (result->cells[shape][size][0][engine].runs)
					print_engine(result->cells[shape][size], engine);
			}
		}
	}
	printf("\nThe bodies of `carom bench scale` at the start, %d rays from where no body is; medians of %u runs.\n"
		   "met: rays that meet a body; other: those that meet another one than Carom says, or none.\n",
		RAYS, (unsigned)runs);
}

/* ---- CSV ---- */

static void write_cell(FILE *stream, const struct rays_result *result, size_t shape, size_t size, size_t length, size_t engine)
{
	const struct rays_cell *cell = &result->cells[shape][size][length][engine];
	const struct peer *peer = engines[engine].peer;
	for (size_t run = 0; run < cell->runs; run++) {
		fprintf(stream, "%s,rays,\"%s, %g m\",", carom_version(), scale_shapes[shape].title, (double)lengths[length]);
		scale_put_engine(stream, &engines[engine], &result->device, result->sizes[size], scale_shapes[shape].name, peer ? peer->settings : "");
		fprintf(stream, "%zu,%d,0,%.9g,%.9g,,,,,,,,%u\n", run + 1, RAYS, cell->seconds[run], REPETITIONS * cell->seconds[run] / RAYS,
			(unsigned)cell->met);
	}
}

static void write_csv(FILE *stream, const struct rays_result *result)
{
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		for (size_t size = 0; size < result->size_count; size++) {
			for (size_t k = 0; k < LENGTHS * ENGINES; k++)
				write_cell(stream, result, shape, size, k / ENGINES, k % ENGINES);
		}
	}
}

/* ---- The call ---- */

carom_status bench_rays_check(const struct bench_options *options, carom_error *error)
{
	return options->plot ? wrong(error, "--plot: it has no chart") : CAROM_OK;
}

carom_status bench_rays(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error)
{
	struct rays_result *result = calloc(1, sizeof *result);
	(void)plot;
	if (!result)
		return out_of_memory(error, "there is not enough memory for the figures");
	result->size_count = bench_choose_sizes(options, default_sizes, sizeof default_sizes / sizeof *default_sizes, result->sizes);
	carom_status status = CAROM_OK;
	for (size_t k = 0; status == CAROM_OK && k < SCALE_SHAPES * result->size_count; k++)
		status = measure_bodies(result, k / result->size_count, k % result->size_count, options, error);
	if (status == CAROM_OK) {
		print(result, options->runs);
		fflush(stdout);
		if (csv)
			write_csv(csv, result);
	}
	free(result);
	return status;
}
