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

#define WHO_ORDER 3 /* which the device leaves to the host: among hits of equal times */

static int compare_numbers(float a, float b)
{
	return a < b ? -1 : a > b;
}

static int compare(const void *left, const void *right)
{
	const kept_hit *a = left, *b = right;
	const int step = compare_numbers(a->when[WHEN_STEP], b->when[WHEN_STEP]), time = compare_numbers(a->who[WHO_TIME], b->who[WHO_TIME]),
			  order = compare_numbers(a->who[WHO_ORDER], b->who[WHO_ORDER]), row = compare_numbers(a->who[WHO_ROW], b->who[WHO_ROW]);
	return step ? step : time ? time : order ? order : row ? row : compare_numbers(a->who[WHO_COLUMN], b->who[WHO_COLUMN]);
}

static bool is_at_once(const kept_hit *a, const kept_hit *b)
{
	return a->when[WHEN_STEP] == b->when[WHEN_STEP] && a->who[WHO_TIME] == b->who[WHO_TIME];
}

/* What the hits do to a body comes one after the other; NULL for what they do not change. */
static float *order_of(const carom_world *world, float *orders, float party)
{
	return party >= 0.0f && carom_is_dynamic(&carom_world_bodies(world)[(int32_t)party]) ? &orders[(int32_t)party] : NULL;
}

/* Hits at the same time, in the order in which the device answered those of each body: what leads to another gets a lower number, and what has
 * nothing to do with another is in the order of the bodies. `orders` has a 0 for each body, and again in the end. */
static void order_hits(const carom_world *world, kept_hit *hits, size_t count, float *orders)
{
	for (size_t k = 0; k < count; k++) {
		float *row = order_of(world, orders, hits[k].who[WHO_ROW]), *column = order_of(world, orders, hits[k].who[WHO_COLUMN]);
		const float order = row && column ? (*row > *column ? *row : *column) : row ? *row : column ? *column : 0.0f;
		hits[k].who[WHO_ORDER] = order;
		if (row)
			*row = order + 1.0f;
		if (column)
			*column = order + 1.0f;
	}
	for (size_t k = 0; k < count; k++) {
		float *row = order_of(world, orders, hits[k].who[WHO_ROW]), *column = order_of(world, orders, hits[k].who[WHO_COLUMN]);
		if (row)
			*row = 0.0f;
		if (column)
			*column = 0.0f;
	}
	qsort(hits, count, sizeof *hits, compare);
}

/* By their times; of equal ones each after those that led to it. False if there is no memory. */
static bool sort(const carom_world *world, kept_hit *hits, size_t count)
{
	float *orders = calloc(world->body_count, sizeof *orders);
	if (!orders)
		return false;
	for (size_t k = 0; k < count; k++)
		hits[k].who[WHO_ORDER] = (float)k; /* as they were answered */
	qsort(hits, count, sizeof *hits, compare);
	for (size_t first = 0, end; first < count; first = end) {
		for (end = first + 1; end < count && is_at_once(&hits[first], &hits[end]); end++)
			;
		if (end - first > 1)
			order_hits(world, hits + first, end - first, orders);
	}
	free(orders);
	return true;
}

carom_status carom_hits_add(carom_world *world, const carom_hit *hit, carom_error *error)
{
	carom_hit *added = carom_array_grow(&world->hits, sizeof *added);
	if (!added)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for more than %zu hits; shorter calls have less", carom_world_hit_count(world));
	*added = *hit;
	return CAROM_OK;
}

static carom_status add(carom_world *world, const kept_hit *kept, carom_error *error)
{
	const carom_hit hit = {
		.time = world->begun + ((double)kept->when[WHEN_ELAPSED] + (double)kept->when[WHEN_ELAPSED_LOW])
			- (1.0 - (double)kept->who[WHO_TIME]) * (double)kept->when[WHEN_LENGTH],
		.body = (uint32_t)kept->who[WHO_ROW],
		.other = (int32_t)kept->who[WHO_COLUMN],
		.point = {kept->where[WHERE_X], kept->where[WHERE_Y]},
		.normal = {kept->where[WHERE_NORMAL_X], kept->where[WHERE_NORMAL_Y]},
		.impulse = {kept->what[WHAT_IMPULSE_X], kept->what[WHAT_IMPULSE_Y]},
		.is_ruled = kept->what[WHAT_RULED] > 0.0f,
	};
	return carom_hits_add(world, &hit, error);
}

/* Leaves those that came to pass. */
static size_t drop_others(kept_hit *hits, size_t count)
{
	size_t left = 0;
	for (size_t k = 0; k < count; k++)
		if (hits[k].when[WHEN_STEP] > 0.0f)
			hits[left++] = hits[k];
	return left;
}

carom_status carom_hits_take(carom_world *world, uint32_t first, uint32_t end, carom_error *error)
{
	const uint32_t rows = carom_row_count(HITS_WIDTH * end), width = carom_row_width(HITS_WIDTH * world->events.hit_room);
	kept_hit *kept;
	carom_status status;
	if (first >= end)
		return CAROM_OK;
	kept = malloc((size_t)rows * (width / HITS_WIDTH) * sizeof *kept);
	if (!kept)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to read %u hits", end - first);
	status = world->device->kind->download(world->device, world->textures[ROLE_HITS].front, rows, kept, error);
	if (!status) {
		const size_t count = drop_others(kept + first, end - first);
		if (!sort(world, kept + first, count))
			status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to sort %zu hits", count);
		for (size_t k = first; !status && k < first + count; k++)
			status = add(world, &kept[k], error);
	}
	free(kept);
	return status;
}

size_t carom_world_hit_count(const carom_world *world)
{
	return world ? world->hits.used / sizeof(carom_hit) : 0;
}

carom_status carom_world_get_hits(const carom_world *world, size_t first, size_t count, carom_hit *hits, carom_error *error)
{
	GIVEN(world, error);
	if (count > 0)
		GIVEN(hits, error);
	TRY(carom_check_span("hits", first, count, world->def.keep_hits ? "the last call had" : "without `keep_hits` in its def the world has",
		carom_world_hit_count(world), error));
	if (count > 0)
		memcpy(hits, (const carom_hit *)world->hits.items + first, count * sizeof *hits);
	return CAROM_OK;
}
