/* The slot reduce [2.2]: each alternative gives the least hit time and where it is, and reads as many texels as the paper says.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "count.h"
#include "layout.h"
#include "scenery.h"
#include "world.h"

static const char *const alternatives[] = {"classic", "six", "four_six", "tiled"};
static const size_t sizes[] = {2, 3, 8, 9, 64, 100, 257, 1000};

/* What was read in a pass to m x m from a live size of `from`. */
typedef struct pass {
	uint64_t m, from, reads;
} pass;

typedef struct run {
	float found[4]; /* as a texel of Reduced */
	size_t passes;
	pass pass[CAROM_MAX_LEVELS];
} run;

/* NULL where there is no such device. */
static carom_world *world_of(const char *alternative, const scenery_device *device, bool counting)
{
	carom_world_def def = scenery_first_impact();
	carom_device_def instrumented = {.name = device->name, .storage = device->storage, .count_reads = true};
	carom_world *world;
	carom_error error;
	def.pipeline.reduce = alternative;
	world = scenery_world(&def, device);
	if (world && counting) {
		instrumented.pipeline = world->pipeline;
		carom_device_close(world->device);
		world->device = NULL;
		scenery_check(carom_device_open(&instrumented, &world->device, &error), &error);
	}
	return world;
}

/* So many bodies in all, and the textures for them. */
static void grow(carom_world *world, size_t count)
{
	const carom_body_def body = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.25f);
	carom_error error;
	while (carom_world_body_count(world) < count)
		scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
	scenery_check(carom_textures_update(world, &error), &error);
}

/* ---- Hit times */

/* What they are like: with `ties` only eight different ones, of which many are the least; else all different. Of a pair,
 * `part` is how likely it has one. */
typedef struct kind {
	const char *name;
	bool ties;
	float part;
} kind;

static const kind kinds[] = {
	{"all different", false, 1.0f}, {"ties", true, 1.0f}, {"few ties", true, 0.05f}, {"few", false, 0.01f}, {"none", false, 0.0f}};

/* `beyond` is what the texels on the diagonal and above it hold. */
static void fill_hits(scenery_random *random, const kind *of, size_t count, size_t width, float beyond, float *hits)
{
	for (size_t row = 0; row < width; row++) {
		for (size_t column = 0; column < width; column++) {
			float *texel = hits + 4 * (row * width + column);
			const bool pair = column < row && row < count, hit = pair && scenery_uniform(random, 0.0f, 1.0f) < of->part;
			const float time = of->ties ? 0.125f * (float)(int)scenery_uniform(random, 0.0f, 8.0f) : scenery_uniform(random, 0.0f, 1.0f);
			texel[HITTIMES_MIN] = 0.0f;
			texel[HITTIMES_MAX] = 1.0f;
			texel[HITTIMES_HIT] = hit ? time : pair || row >= count ? NO_HIT : beyond;
			texel[HITTIMES_DONE] = hit && scenery_uniform(random, 0.0f, 1.0f) < 0.5f ? 0.0f : 1.0f;
		}
	}
}

/* The first in the order of time, row and column, among the pairs of some rows and columns. */
static void first_of(const float *hits, size_t width, const size_t rows[2], const size_t columns[2], float *first)
{
	const float none[4] = {[REDUCED_HIT] = NO_HIT, [REDUCED_DONE] = 1.0f};
	memcpy(first, none, sizeof none);
	for (size_t row = rows[0]; row < rows[1]; row++) {
		for (size_t column = columns[0]; column < columns[1] && column < row; column++) {
			const float *texel = hits + 4 * (row * width + column);
			if (texel[HITTIMES_HIT] >= first[REDUCED_HIT])
				continue;
			first[REDUCED_HIT] = texel[HITTIMES_HIT];
			first[REDUCED_ROW] = (float)row;
			first[REDUCED_COLUMN] = (float)column;
			first[REDUCED_DONE] = texel[HITTIMES_DONE];
		}
	}
}

/* As toi leaves them; what lies above the diagonal is the earliest of all, for nobody may look at it. */
static void fill_tiles(const float *hits, size_t count, size_t width, float *tiles)
{
	for (size_t row = 0; row < width / TILE; row++) {
		for (size_t column = 0; column < width / TILE; column++) {
			const size_t end = (row + 1) * TILE < count ? (row + 1) * TILE : count;
			const size_t rows[2] = {row * TILE, end}, columns[2] = {column * TILE, (column + 1) * TILE};
			float *texel = tiles + 4 * (row * (width / TILE) + column);
			first_of(hits, width, rows, columns, texel);
			if (column > row)
				texel[REDUCED_HIT] = -1.0f;
		}
	}
}

static void upload(carom_world *world, carom_role role, uint32_t rows, const float *texels)
{
	carom_error error;
	scenery_check(world->device->kind->upload(world->device, world->textures[role].front, rows, texels, &error), &error);
}

/* ---- Reducing */

static uint64_t reads_of(carom_world *world)
{
	uint64_t reads = UINT64_MAX;
	carom_error error;
	scenery_check(world->device->kind->reads(world->device, &reads, &error), &error);
	return reads;
}

static run reduce(carom_world *world, size_t count)
{
	carom_pair *reduced = &world->textures[ROLE_REDUCED];
	const bool tiled = world->device->kind->has(world->device, STAGE_REDUCE_TILES);
	int32_t size = tiled ? ((int32_t)count + TILE - 1) / TILE : (int32_t)count;
	carom_error error;
	run r = {.passes = 0};
	reduced->front = world->textures[tiled ? ROLE_TILE_HITS : ROLE_HIT_TIMES].front;
	for (; size > 1; r.passes++) {
		const int32_t m = tiled ? (size + TILE - 1) / TILE : (size + 1) / 2, pass_or_size = tiled ? size : (int32_t)r.passes;
		reduced->back = world->levels[r.passes];
		scenery_check(carom_run(world, tiled ? STAGE_REDUCE_TILES : STAGE_REDUCE, m, m, pass_or_size, 0, &error), &error);
		r.pass[r.passes] = (pass){(uint64_t)m, (uint64_t)size, reads_of(world)};
		reduced->front = reduced->back;
		size = m;
	}
	return r;
}

/* The last level's only texel that counts, the first. */
static void read_found(carom_world *world, size_t count, run *r)
{
	float *texels = calloc(carom_capacity(count), 4 * sizeof *texels);
	carom_error error;
	assert_non_null(texels);
	scenery_check(world->device->kind->download(world->device, world->textures[ROLE_REDUCED].front, 1, texels, &error), &error);
	memcpy(r->found, texels, sizeof r->found);
	free(texels);
}

static void judge(const run *r, const float *expected, const char *name)
{
	bool same = r->found[REDUCED_HIT] == expected[REDUCED_HIT];
	for (size_t i = 0; i < 4 && expected[REDUCED_HIT] <= 1.0f; i++)
		same = same && r->found[i] == expected[i];
	if (!same)
		fail_msg("%s: hit at %g, row %g, column %g, done %g, not %g, %g, %g, %g", name, (double)r->found[REDUCED_HIT], (double)r->found[REDUCED_ROW],
			(double)r->found[REDUCED_COLUMN], (double)r->found[REDUCED_DONE], (double)expected[REDUCED_HIT], (double)expected[REDUCED_ROW],
			(double)expected[REDUCED_COLUMN], (double)expected[REDUCED_DONE]);
}

/* Every kind of hit times, small ones several times. */
static void check_minima(carom_world *world, size_t count, bool whole_square)
{
	const size_t width = carom_capacity(count), all[2] = {0, count};
	float *hits = calloc(width * width, 4 * sizeof *hits), *tiles = calloc(width * width / (TILE * TILE), 4 * sizeof *tiles);
	scenery_random random = {count};
	assert_true(hits && tiles);
	for (size_t i = 0; i < COUNT(kinds) * (count > 100 ? 1 : 8); i++) {
		float expected[4];
		run r;
		fill_hits(&random, &kinds[i % COUNT(kinds)], count, width, whole_square ? NO_HIT : -1.0f, hits);
		fill_tiles(hits, count, width, tiles);
		first_of(hits, width, all, all, expected);
		upload(world, ROLE_HIT_TIMES, (uint32_t)width, hits);
		upload(world, ROLE_TILE_HITS, (uint32_t)width / TILE, tiles);
		r = reduce(world, count);
		read_found(world, count, &r);
		judge(&r, expected, kinds[i % COUNT(kinds)].name);
	}
	free(hits);
	free(tiles);
}

static void every_alternative_finds_the_first_hit(void **unused)
{
	(void)unused;
	for (size_t i = 0; i < COUNT(alternatives); i++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(alternatives[i], device, false);
			for (size_t k = 0; world && k < COUNT(sizes); k++) {
				grow(world, sizes[k]);
				check_minima(world, sizes[k], !strcmp(alternatives[i], "classic"));
				assert_true(reads_of(world) == 0); /* nothing is counted that need not be */
			}
			carom_world_destroy(world);
		}
	}
}

/* ---- Counting */

/* Texels read in a pass from `from` x `from` to m x m. The last pass of six and four_six takes the only pair that is left.
 * On the CPU these are what the fragments ask for: without counting it looks through whole rows first, and asks where there is a hit. */
static uint64_t paper_reads(const char *alternative, uint64_t m, uint64_t from)
{
	if (!strcmp(alternative, "classic"))
		return 4 * m * m;
	if (!strcmp(alternative, "tiled")) /* not the paper's: each texel once */
		return from * (from + 1) / 2;
	if (m == 1)
		return 1;
	return !strcmp(alternative, "six") ? 3 * (m * m - m) : 2 * (m * m - 1);
}

static uint64_t check_reads(carom_world *world, const char *alternative, size_t count)
{
	uint64_t all = 0;
	run r;
	reads_of(world);
	r = reduce(world, count);
	for (size_t i = 0; i < r.passes; i++) {
		const uint64_t expected = paper_reads(alternative, r.pass[i].m, r.pass[i].from);
		all += r.pass[i].reads;
		if (r.pass[i].reads != expected)
			fail_msg("%s of %zu bodies, pass to m = %llu: %llu texels read, not %llu", alternative, count, (unsigned long long)r.pass[i].m,
				(unsigned long long)r.pass[i].reads, (unsigned long long)expected);
	}
	return all;
}

static void reads_are_the_papers(void **unused)
{
	(void)unused;
	for (size_t i = 0; i < COUNT(alternatives); i++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(alternatives[i], device, true);
			uint64_t all = 0;
			for (size_t k = 0; world && k < COUNT(sizes); k++) {
				grow(world, sizes[k]);
				all = check_reads(world, alternatives[i], sizes[k]);
			}
			if (!world)
				continue;
			carom_world_destroy(world);
			print_message("%s on %s%s: %llu texels read for %zu bodies\n", alternatives[i], device->name,
				device->storage == CAROM_STORAGE_IMAGE ? " images" : "", (unsigned long long)all, sizes[COUNT(sizes) - 1]);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(every_alternative_finds_the_first_hit), cmocka_unit_test(reads_are_the_papers)};
	return cmocka_run_group_tests_name("reduce", tests, NULL, NULL);
}
