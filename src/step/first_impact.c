/* The step first_impact [2]: the paper's loop. Every pair's hit time is found, the least of them ends the step, and that
 * hit is answered. */
#include <string.h>

#include "layout.h"
#include "status.h"
#include "step/step.h"
#include "world.h"

/* How many passes bisection takes when each halves an interval `iterations` times [2.1, table 1]. */
static int extra_passes(const carom_pipeline *pipeline, const carom_world_def *def)
{
	float width = 1.0f;
	uint32_t halvings = 0, a_pass = def->iterations;
	if (strcmp(pipeline->toi, "bisection") || a_pass == 0)
		return 0;
	for (; width > def->epsilon; width *= 0.5f)
		halvings++;
	return a_pass < halvings ? (int)((halvings + a_pass - 1) / a_pass - 1) : 0;
}

static int32_t tiles_of(int32_t count)
{
	return (count + TILE - 1) / TILE;
}

/* Collision detection [2.1]. */
static carom_status detect(carom_world *world, int32_t count, carom_error *error)
{
	const int32_t tiles = tiles_of(count), groups = (tiles + OVERLAP_GROUP - 1) / OVERLAP_GROUP;
	TRY(carom_run(world, STAGE_AABB, count, 1, 0, 0, error));
	TRY(carom_run(world, STAGE_OVERLAP, tiles, groups, count, 0, error));
	carom_swap(world, ROLE_OVERLAP);
	carom_swap(world, ROLE_TILES);
	world->textures[ROLE_OVERLAP_BEFORE].front = world->textures[ROLE_OVERLAP].back;
	TRY(carom_run(world, STAGE_TOI_FIRST, tiles, tiles, count, 0, error));
	carom_swap(world, ROLE_HIT_TIMES);
	for (int pass = extra_passes(&world->pipeline, &world->def); pass > 0; pass--) {
		TRY(carom_run(world, STAGE_TOI_NEXT, tiles, tiles, count, 0, error));
		carom_swap(world, ROLE_HIT_TIMES);
	}
	return CAROM_OK;
}

/* The least hit time of all pairs [2.2], by halving the texture (or by taking whole tiles) until one texel is left. */
static carom_status reduce(carom_world *world, int32_t count, carom_error *error)
{
	carom_pair *reduced = &world->textures[ROLE_REDUCED];
	const bool tiled = world->device->kind->has(world->device, STAGE_REDUCE_TILES);
	int32_t size = tiled ? tiles_of(count) : count;
	reduced->front = world->textures[tiled ? ROLE_TILE_HITS : ROLE_HIT_TIMES].front;
	for (int pass = 0; size > 1; pass++) {
		const int32_t half = (size + 1) / 2, m = tiled ? tiles_of(size) : half;
		reduced->back = world->levels[pass];
		TRY(carom_run(world, tiled ? STAGE_REDUCE_TILES : STAGE_REDUCE, m, m, tiled ? size : pass, 0, error));
		reduced->front = reduced->back;
		size = m;
	}
	return CAROM_OK;
}

/* Collision response [2.3]. */
static carom_status respond(carom_world *world, int32_t count, carom_error *error)
{
	TRY(carom_run(world, STAGE_IMPULSE, 1, 1, 0, 0, error));
	TRY(carom_run(world, STAGE_NO_COLLISION, count, 1, 0, 0, error));
	return carom_run(world, STAGE_COLLISION, count, 1, 0, 0, error);
}

/* One step. The device decides by its clock whether it ends in a collision: both forward kernels are run, and the one
 * whose turn it is not does nothing. So nobody waits. */
static carom_status run(carom_world *world, carom_error *error)
{
	const int32_t count = (int32_t)world->body_count, groups = world->def.has_room ? (count + WALLS_GROUP - 1) / WALLS_GROUP : 0;
	carom_status status;
	TRY(detect(world, count, error));
	TRY(reduce(world, count, error));
	if (groups)
		TRY(carom_run(world, STAGE_WALLS, groups, 1, count, 0, error));
	TRY(carom_run(world, STAGE_FIRST, 1, 1, count, groups, error));
	carom_swap(world, ROLE_CLOCK);
	status = respond(world, count, error);
	if (status) {
		carom_swap(world, ROLE_CLOCK); /* back: the step is not done */
		return status;
	}
	carom_swap(world, ROLE_LINEAR);
	carom_swap(world, ROLE_ROTATIONAL);
	return CAROM_OK;
}

/* The size of the first level of the reduction, and how much smaller each is than the one before. */
static uint32_t first_level(const carom_pipeline *pipeline, uint32_t capacity, uint32_t *ratio)
{
	const bool tiled = !strcmp(pipeline->reduce, "tiled");
	*ratio = tiled ? TILE : 2;
	return tiled ? (capacity + TILE * TILE - 1) / (TILE * TILE) : capacity / 2;
}

static uint32_t next_level(uint32_t size, uint32_t ratio)
{
	return size > 1 ? (size + ratio - 1) / ratio : 0;
}

static uint64_t levels_memory(const carom_pipeline *pipeline, uint64_t capacity)
{
	uint32_t ratio;
	uint64_t all = 0;
	for (uint32_t size = first_level(pipeline, (uint32_t)capacity, &ratio); size > 0; size = next_level(size, ratio))
		all += 16 * (uint64_t)size * size;
	return all;
}

static uint64_t memory(const carom_pipeline *pipeline, const carom_world_def *def, size_t body_count, size_t vertex_count)
{
	uint64_t n = carom_capacity(body_count), pairs = n * n;
	uint64_t hit_times = 16 * pairs * (extra_passes(pipeline, def) > 0 ? 2 : 1);
	(void)vertex_count;
	return hit_times + 2 * pairs + levels_memory(pipeline, n) + (16 + 8) * pairs / (TILE * TILE) + 16 * (n + n / WALLS_GROUP + 1);
}

/* Could this many bodies run on the device, by its limits of an image, of one texture, and in all? */
static bool fits(const carom_world *world, uint64_t capacity)
{
	const carom_device_info *info = &world->device->info;
	const bool has_sides = world->device->storage == CAROM_STORAGE_IMAGE || !info->is_opencl;
	return (!has_sides || capacity <= info->max_image_size) && 16 * capacity * capacity <= info->max_allocation
		&& memory(&world->pipeline, &world->def, capacity, 0) <= info->memory;
}

/* Asked for first, so that a scene too large fails at once and without filling the memory. */
static carom_status check_limits(const carom_world *world, carom_error *error)
{
	const uint64_t n = world->capacity;
	uint64_t most = n;
	if (fits(world, n))
		return CAROM_OK;
	while (most > TILE && !fits(world, most))
		most /= 2;
	return carom_fail(error, CAROM_LIMIT,
		"%zu bodies need an N x N texture, HitTimes, of %llu x %llu texels (%.3g GiB) in the step first_impact: '%s' "
		"%s can hold it for at most %llu bodies",
		world->body_count, (unsigned long long)n, (unsigned long long)n, 16.0 * (double)n * (double)n / (1024.0 * 1024.0 * 1024.0),
		world->device->info.name,
		world->device->storage == CAROM_STORAGE_IMAGE ? "with images"
			: world->device->info.is_opencl           ? "with buffers"
													  : "as it is",
		(unsigned long long)most);
}

static carom_status prepare(carom_world *world, carom_error *error)
{
	static const float zero[4] = {0}, none[4] = {0.0f, 1.0f, 1.0f, NO_HIT}, no_level[4] = {NO_HIT, 0.0f, 0.0f, 1.0f};
	const uint32_t n = world->capacity, groups = n / WALLS_GROUP ? n / WALLS_GROUP : 1;
	uint32_t ratio, size = first_level(&world->pipeline, n, &ratio);
	TRY(check_limits(world, error));
	TRY(carom_textures_create(world, ROLE_AABB, false, carom_row_width(n), carom_row_count(n), zero, error));
	TRY(carom_textures_create(world, ROLE_OVERLAP, true, n / OVERLAP_COLUMNS, n, zero, error));
	TRY(carom_textures_create(world, ROLE_HIT_TIMES, extra_passes(&world->pipeline, &world->def) > 0, n, n, none, error));
	TRY(carom_textures_create(world, ROLE_TILES, true, n / TILE, n / TILE, zero, error));
	TRY(carom_textures_create(world, ROLE_TILE_HITS, false, n / TILE, n / TILE, no_level, error));
	TRY(carom_textures_create(world, ROLE_WALLS, false, carom_row_width(groups), carom_row_count(groups), no_level, error));
	TRY(carom_textures_create(world, ROLE_IMPULSE, false, IMPULSE_WIDTH, 1, zero, error));
	for (int level = 0; size > 0; level++, size = next_level(size, ratio))
		TRY(carom_levels_create(world, level, size, no_level, error));
	return CAROM_OK;
}

/* That of the last run, if it ended in one: the clock and Impulse have it. */
static carom_status take_hits(carom_world *world, carom_error *error)
{
	const carom_device_class *kind = world->device->kind;
	float clock[4 * CLOCK_WIDTH], impulse[4 * IMPULSE_WIDTH];
	const float *hit = clock + 4 * CLOCK_HIT, *j = impulse + 4 * IMPULSE_PUSH, *where = impulse + 4 * IMPULSE_WHERE;
	TRY(kind->download(world->device, world->textures[ROLE_CLOCK].front, 1, clock, error));
	if (!(hit[HIT_TIME] <= 1.0f && hit[HIT_DONE] > 0.0f && clock[4 * CLOCK_STEP + STEP_LENGTH] > 0.0f))
		return CAROM_OK;
	TRY(kind->download(world->device, world->textures[ROLE_IMPULSE].front, 1, impulse, error));
	const carom_hit found = {
		.time = world->begun + ((double)clock[4 * CLOCK_TIME + TIME_ELAPSED] + (double)clock[4 * CLOCK_TIME + TIME_ELAPSED_LOW]),
		.body = (uint32_t)hit[HIT_ROW],
		.other = (int32_t)hit[HIT_COLUMN],
		.point = {where[WHERE_X], where[WHERE_Y]},
		.normal = {where[WHERE_NORMAL_X], where[WHERE_NORMAL_Y]},
		.impulse = {j[IMPULSE_X], j[IMPULSE_Y]},
	};
	return carom_hits_add(world, &found, error);
}

const carom_step carom_step_first_impact = {"first_impact", true, prepare, run, NULL, NULL, NULL, take_hits, true, memory, NULL, NULL};
