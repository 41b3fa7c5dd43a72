/* The hits of a call, where the world's def has them kept: from the device, in their order, for carom_world_get_hits. */
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "world.h"

/* The records of a hit. */
typedef struct kept_hit {
	float who[4], where[4], what[4], when[4];
} kept_hit;

_Static_assert(sizeof(kept_hit) == HITS_WIDTH * 4 * sizeof(float), "the device has them so");

static int compare_numbers(float a, float b)
{
	return a < b ? -1 : a > b;
}

/* By their times; of equal ones what leads to another is before it. */
static int compare(const void *left, const void *right)
{
	const kept_hit *a = left, *b = right;
	const int step = compare_numbers(a->when[WHEN_STEP], b->when[WHEN_STEP]), time = compare_numbers(a->who[WHO_TIME], b->who[WHO_TIME]),
			  order = compare_numbers(a->who[WHO_ORDER], b->who[WHO_ORDER]), row = compare_numbers(a->who[WHO_ROW], b->who[WHO_ROW]);
	return step ? step : time ? time : order ? order : row ? row : compare_numbers(a->who[WHO_COLUMN], b->who[WHO_COLUMN]);
}

carom_hit *carom_hits_add(carom_world *world, carom_error *error)
{
	carom_hit *hit = carom_array_grow(&world->hits, sizeof *hit);
	if (!hit)
		carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for more than %zu hits; shorter calls have less", carom_world_hit_count(world));
	return hit;
}

static carom_status add(carom_world *world, const kept_hit *kept, carom_error *error)
{
	carom_hit *hit = carom_hits_add(world, error);
	if (!hit)
		return CAROM_OUT_OF_MEMORY;
	*hit = (carom_hit){
		.time = world->begun + ((double)kept->when[WHEN_ELAPSED] + (double)kept->when[WHEN_ELAPSED_LOW])
			- (1.0 - (double)kept->who[WHO_TIME]) * (double)kept->when[WHEN_LENGTH],
		.body = (uint32_t)kept->who[WHO_ROW],
		.other = (int32_t)kept->who[WHO_COLUMN],
		.point = {kept->where[WHERE_X], kept->where[WHERE_Y]},
		.normal = {kept->where[WHERE_NORMAL_X], kept->where[WHERE_NORMAL_Y]},
		.impulse = {kept->what[WHAT_IMPULSE_X], kept->what[WHAT_IMPULSE_Y]},
		.is_ruled = kept->what[WHAT_RULED] > 0.0f,
	};
	return CAROM_OK;
}

carom_status carom_hits_take(carom_world *world, uint32_t first, uint32_t end, carom_error *error)
{
	const uint32_t rows = carom_row_count(HITS_WIDTH * end), width = carom_row_width(HITS_WIDTH * world->events.hit_room);
	kept_hit *kept;
	carom_status status;
	if (first >= end)
		return CAROM_OK;
	kept = malloc((size_t)rows * width * 4 * sizeof(float));
	if (!kept)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to read %u hits", end - first);
	status = world->device->kind->download(world->device, world->textures[ROLE_HITS].front, rows, kept, error);
	if (!status)
		qsort(kept + first, end - first, sizeof *kept, compare);
	for (uint32_t k = first; !status && k < end; k++)
		if (kept[k].when[WHEN_STEP] > 0.0f)
			status = add(world, &kept[k], error);
	free(kept);
	return status;
}

size_t carom_world_hit_count(const carom_world *world)
{
	return world ? world->hits.used / sizeof(carom_hit) : 0;
}

carom_status carom_world_get_hits(const carom_world *world, size_t first, size_t count, carom_hit *hits, carom_error *error)
{
	const size_t known = carom_world_hit_count(world);
	GIVEN(world, error);
	if (count > 0)
		GIVEN(hits, error);
	if (first > known || count > known - first)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "hits %zu to %zu: the last call had %zu%s", first,
			count > SIZE_MAX - first ? SIZE_MAX : first + count, known,
			world->def.keep_hits ? "" : " that were kept, for the world was made without `keep_hits`");
	if (count > 0)
		memcpy(hits, (const carom_hit *)world->hits.items + first, count * sizeof *hits);
	return CAROM_OK;
}
