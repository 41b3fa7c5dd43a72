#include "judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"

enum { COUNT = JUDGE_BODIES };

/* What one world's stages made: the live texels of a role. */
typedef struct texels {
	uint32_t width, rows;
	size_t used; /* numbers */
	void *data;
} texels;

carom_world_def judge_arena(const char *slot, const char *alternative)
{
	carom_world_def def = scenery_first_impact();
	carom_error error;
	def.gravity = (carom_vec2){0.3f, -1.0f};
	def.restitution = 0.8f;
	def.friction = 0.5f;
	def.has_room = true;
	def.room_min = (carom_vec2){-5.0f, -5.0f};
	def.room_max = (carom_vec2){5.0f, 5.0f};
	def.time_step = 0.05f;
	if (!strcmp(slot, "inside"))
		scenery_check(carom_pipeline_set(&def.pipeline, "toi", "bisection", &error), &error);
	if (strcmp(slot, "first") && strcmp(slot, "forward"))
		scenery_check(carom_pipeline_set(&def.pipeline, slot, alternative, &error), &error);
	if (!strcmp(alternative, "bisection"))
		def.iterations = 5;
	return def;
}

void judge_fill(carom_world *world, uint64_t seed)
{
	carom_body_def bodies[COUNT];
	scenery_random random = {seed}, filters = {seed + 1};
	carom_error error;
	scenery_bodies(&random, SCENERY_MIXED, COUNT, 0.9f, 4.0f, bodies); /* crowded: some overlap from the start */
	scenery_drive(&random, COUNT, 2.0f, bodies);
	for (int i = 0; i < COUNT; i++) {
		bodies[i].restitution = scenery_uniform(&random, 0.0f, 1.0f);
		bodies[i].friction = scenery_uniform(&random, 0.0f, 1.0f);
		if (i % 4 == 0)
			scenery_filter(&filters, &bodies[i]);
		if (!bodies[i].is_static && !bodies[i].is_kinematic) {
			bodies[i].force = (carom_vec2){scenery_uniform(&random, -1.0f, 1.0f), scenery_uniform(&random, -1.0f, 1.0f)};
			bodies[i].torque = scenery_uniform(&random, -0.3f, 0.3f);
		}
	}
	scenery_check(carom_world_add(world, bodies, COUNT, NULL, &error), &error);
	scenery_check(carom_textures_update(world, &error), &error);
}

carom_world *judge_oracle(const carom_world_def *def)
{
	carom_world *world = scenery_world(def, &scenery_devices[0]);
	carom_device_def device = {.pipeline = world->pipeline};
	carom_error error;
	carom_device_close(world->device);
	world->device = NULL;
	scenery_check(carom_cpu_open_double(&device, &world->device, &error), &error);
	return world;
}

static uint32_t level_size(uint32_t capacity, int level)
{
	uint32_t size = capacity / TILE;
	if (level >= 0)
		return capacity >> (level + 1);
	for (; level < 0; level++)
		size = (size + TILE - 1) / TILE;
	return size;
}

static texels extent(carom_role role, int level)
{
	texels t = {0, 1, 0, NULL};
	uint32_t capacity = carom_capacity(COUNT);
	switch (role) {
	case ROLE_OVERLAP: t.width = capacity / OVERLAP_COLUMNS, t.rows = COUNT; break;
	case ROLE_HIT_TIMES: t.width = capacity, t.rows = COUNT; break;
	case ROLE_TILES:
	case ROLE_TILE_HITS: t.width = t.rows = capacity / TILE; break;
	case ROLE_WALLS: t.width = capacity / WALLS_GROUP; break;
	case ROLE_CLOCK: t.width = CLOCK_WIDTH; break;
	case ROLE_IMPULSE: t.width = IMPULSE_WIDTH; break;
	case ROLE_REDUCED: t.width = t.rows = level_size(capacity, level); break;
	default: t.width = capacity; break;
	}
	t.used = (size_t)t.width * t.rows * 4;
	return t;
}

static texels fetch(carom_world *world, carom_role role, int level, size_t size, bool back)
{
	texels t = extent(role, level);
	carom_error error;
	carom_texture *texture = back ? world->textures[role].back : world->textures[role].front;
	t.data = calloc(t.used, size);
	assert_non_null(t.data);
	scenery_check(world->device->kind->download(world->device, texture, t.rows, t.data, &error), &error);
	return t;
}

static void compare_bits(judgement *b, carom_role role, const texels *expected, const texels *found, size_t size)
{
	for (size_t i = 0; i < expected->used; i += 4) {
		const char *e = (const char *)expected->data + i * size, *f = (const char *)found->data + i * size;
		if (!memcmp(e, f, 4 * size))
			continue;
		if (!b->wrong_bits++ && size == sizeof(float))
			print_message("texel %zu of role %d: %a %a %a %a, expected %a %a %a %a\n", i / 4, (int)role, (double)((const float *)(const void *)f)[0],
				(double)((const float *)(const void *)f)[1], (double)((const float *)(const void *)f)[2], (double)((const float *)(const void *)f)[3],
				(double)((const float *)(const void *)e)[0], (double)((const float *)(const void *)e)[1], (double)((const float *)(const void *)e)[2],
				(double)((const float *)(const void *)e)[3]);
	}
}

/* Is a number, given its role and channel, near the oracle's? Hit times may move where a hit is grazing. */
static double tolerance(carom_role role, size_t channel, double expected)
{
	switch (role) {
	case ROLE_HIT_TIMES:
	case ROLE_TILE_HITS:
	case ROLE_REDUCED:
	case ROLE_WALLS: return 2e-3;
	case ROLE_CLOCK: return 1e-5 + 1e-5 * fabs(expected);
	case ROLE_IMPULSE: return 1e-4 + 1e-3 * fabs(expected);
	default: return (channel < 2 ? 4e-6 : 1e-5) + 1e-5 * fabs(expected);
	}
}

static bool is_hit(carom_role role, const double *texel)
{
	return texel[role == ROLE_HIT_TIMES ? HITTIMES_HIT : WALLS_HIT] <= 1.0;
}

static void compare_values(judgement *b, carom_role role, const texels *oracle, const texels *found)
{
	const double *expected = oracle->data;
	const float *values = found->data;
	bool decides = role == ROLE_HIT_TIMES || role == ROLE_WALLS;
	for (size_t i = 0; i < oracle->used; i += 4) {
		double texel[4] = {(double)values[i], (double)values[i + 1], (double)values[i + 2], (double)values[i + 3]};
		bool disputed = decides && is_hit(role, texel) != is_hit(role, expected + i);
		b->decisions += decides && is_hit(role, expected + i);
		b->disputed += disputed;
		for (size_t k = 0; k < 4 && !disputed; k++)
			b->wrong_values += fabs(texel[k] - expected[i + k]) <= tolerance(role, k, expected[i + k]) ? 0 : 1;
	}
}

static void compare_bytes(judgement *b, const texels *oracle, const texels *found)
{
	const uint8_t *expected = oracle->data, *values = found->data;
	for (size_t i = 0; i < oracle->used; i++) {
		b->decisions += expected[i] != 0;
		b->disputed += expected[i] != values[i];
	}
}

/* Everyone goes on from the reference's output, so that each stage is judged alone. */
static void share(judgement *b, carom_role role, const texels *t)
{
	carom_world *const others[2] = {b->oracle, b->device};
	carom_error error;
	for (int i = 0; i < 2; i++)
		scenery_check(others[i]->device->kind->upload(others[i]->device, others[i]->textures[role].back, t->rows, t->data, &error), &error);
}

static void judge_output(judgement *b, carom_role role, int level)
{
	bool bytes = role == ROLE_OVERLAP || role == ROLE_TILES;
	size_t size = bytes ? 1 : sizeof(float);
	texels reference = fetch(b->reference, role, level, size, true), found = fetch(b->device, role, level, size, true);
	texels oracle = fetch(b->oracle, role, level, bytes ? 1 : sizeof(double), true);
	compare_bits(b, role, &reference, &found, size);
	if (bytes)
		compare_bytes(b, &oracle, &found);
	else
		compare_values(b, role, &oracle, &found);
	share(b, role, &reference);
	free(reference.data);
	free(found.data);
	free(oracle.data);
}

/* `level` of the reduction: from 0 where sizes are halved, from -1 down where tiles are taken. */
static void run_level(judgement *b, carom_stage stage, int32_t x, int32_t y, int32_t z, int32_t w, int level)
{
	const carom_stage_def *def = &carom_stages[stage];
	carom_world *const worlds[3] = {b->reference, b->oracle, b->device};
	carom_error error;
	for (int i = 0; i < 3; i++)
		scenery_check(carom_run(worlds[i], stage, x, y, z, w, &error), &error);
	for (int i = def->input_count; i < def->input_count + def->output_count; i++)
		judge_output(b, def->textures[i], level);
}

static void run_stage(judgement *b, carom_stage stage, int32_t x, int32_t y, int32_t z, int32_t w)
{
	run_level(b, stage, x, y, z, w, 0);
}

static void swap_all(judgement *b, carom_role role)
{
	carom_swap(b->reference, role);
	carom_swap(b->oracle, role);
	carom_swap(b->device, role);
}

static void run_reduction(judgement *b)
{
	carom_world *const worlds[3] = {b->reference, b->oracle, b->device};
	const bool tiled = b->device->device->kind->has(b->device->device, STAGE_REDUCE_TILES);
	int32_t size = tiled ? (COUNT + TILE - 1) / TILE : COUNT;
	for (int pass = 0; size > 1; pass++) {
		const int32_t live = size;
		size = tiled ? (size + TILE - 1) / TILE : (size + 1) / 2;
		for (int i = 0; i < 3; i++) {
			carom_pair *reduced = &worlds[i]->textures[ROLE_REDUCED];
			carom_texture *start = worlds[i]->textures[tiled ? ROLE_TILE_HITS : ROLE_HIT_TIMES].front;
			reduced->front = pass ? worlds[i]->levels[pass - 1] : start;
			reduced->back = worlds[i]->levels[pass];
		}
		if (tiled)
			run_level(b, STAGE_REDUCE_TILES, size, size, live, 0, -1 - pass);
		else
			run_level(b, STAGE_REDUCE, size, size, pass, 0, pass);
	}
	for (int i = 0; i < 3; i++)
		worlds[i]->textures[ROLE_REDUCED].front = worlds[i]->textures[ROLE_REDUCED].back;
}

static void start_clock(judgement *b)
{
	carom_world *const worlds[3] = {b->reference, b->oracle, b->device};
	float clock[4 * CLOCK_WIDTH] = {0};
	carom_error error;
	clock[4 * CLOCK_HIT + HIT_TIME] = NO_HIT;
	clock[4 * CLOCK_TIME + TIME_REMAINING] = 1.0f;
	for (int i = 0; i < 3; i++)
		scenery_check(worlds[i]->device->kind->upload(worlds[i]->device, worlds[i]->textures[ROLE_CLOCK].front, 1, clock, &error), &error);
}

/* The stages of one step in order, each judged. */
static void run_step(judgement *b)
{
	carom_world *const worlds[3] = {b->reference, b->oracle, b->device};
	const int32_t tiles = (COUNT + TILE - 1) / TILE, groups = (COUNT + WALLS_GROUP - 1) / WALLS_GROUP;
	start_clock(b);
	run_stage(b, STAGE_AABB, COUNT, 1, 0, 0);
	run_stage(b, STAGE_OVERLAP, tiles, (tiles + OVERLAP_GROUP - 1) / OVERLAP_GROUP, COUNT, 0);
	swap_all(b, ROLE_OVERLAP);
	swap_all(b, ROLE_TILES);
	for (int i = 0; i < 3; i++)
		worlds[i]->textures[ROLE_OVERLAP_BEFORE].front = worlds[i]->textures[ROLE_OVERLAP].back;
	run_stage(b, STAGE_TOI_FIRST, tiles, tiles, COUNT, 0);
	swap_all(b, ROLE_HIT_TIMES);
	for (int pass = 0; pass < 3 && b->reference->device->kind->has(b->reference->device, STAGE_TOI_NEXT); pass++) {
		run_stage(b, STAGE_TOI_NEXT, tiles, tiles, COUNT, 0);
		swap_all(b, ROLE_HIT_TIMES);
	}
	run_stage(b, STAGE_WALLS, groups, 1, COUNT, 0);
	run_reduction(b);
	run_stage(b, STAGE_FIRST, 1, 1, COUNT, groups);
	swap_all(b, ROLE_CLOCK);
	run_stage(b, STAGE_IMPULSE, 1, 1, 0, 0);
	run_stage(b, STAGE_NO_COLLISION, COUNT, 1, 0, 0);
	run_stage(b, STAGE_COLLISION, COUNT, 1, 0, 0);
	swap_all(b, ROLE_LINEAR);
	swap_all(b, ROLE_ROTATIONAL);
}

bool judge(const char *slot, const char *alternative, const scenery_device *device, uint64_t seed, judgement *b)
{
	carom_world_def def = judge_arena(slot, alternative);
	memset(b, 0, sizeof *b);
	b->device = scenery_world(&def, device);
	if (!b->device)
		return false;
	b->reference = scenery_world(&def, &scenery_devices[0]);
	b->oracle = judge_oracle(&def);
	judge_fill(b->reference, seed);
	judge_fill(b->oracle, seed);
	judge_fill(b->device, seed);
	for (int step = 0; step < 3; step++)
		run_step(b);
	carom_world_destroy(b->reference);
	carom_world_destroy(b->oracle);
	carom_world_destroy(b->device);
	return true;
}
