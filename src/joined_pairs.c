/* Pairs of bodies that joints keep from hitting each other: sorted, each once, as a part of Filters. */
#include <stdlib.h>

#include "layout.h"
#include "world.h"

static uint64_t pair_of(uint64_t a, uint64_t b)
{
	return a < b ? a << 32 | b : b << 32 | a;
}

static uint32_t body_of(uint64_t pair, int side)
{
	return (uint32_t)(pair >> 32 * side);
}

static int32_t *except_of(int32_t *filters, uint64_t pair, int side)
{
	return &filters[FILTER(body_of(pair, side), FILTER_EXCEPT)];
}

static int compare_pairs(const void *left, const void *right)
{
	const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
	return a < b ? -1 : a > b;
}

size_t carom_apart_count(const carom_world *world)
{
	return world->apart.used / sizeof(uint64_t);
}

bool carom_apart_find(carom_array *apart, const carom_joint *joints, size_t count)
{
	size_t left = 0;
	apart->used = 0;
	for (size_t k = 0; k < count; k++) {
		if (joints[k].collides || joints[k].other == CAROM_GROUND)
			continue;
		uint64_t *pair = carom_array_grow(apart, sizeof *pair);
		if (!pair)
			return false;
		*pair = pair_of(joints[k].body, (uint64_t)joints[k].other);
	}
	uint64_t *pairs = apart->items;
	const size_t all = apart->used / sizeof *pairs;
	if (!pairs)
		return true;
	if (all > 1)
		qsort(pairs, all, sizeof *pairs, compare_pairs);
	for (size_t k = 0; k < all; k++)
		if (k == 0 || pairs[k] != pairs[k - 1])
			pairs[left++] = pairs[k];
	apart->used = left * sizeof *pairs;
	return true;
}

bool carom_joints_part(const carom_world *world, size_t a, size_t b)
{
	const uint64_t pair = pair_of(a, b);
	return carom_apart_count(world) > 0 && bsearch(&pair, world->apart.items, carom_apart_count(world), sizeof pair, compare_pairs);
}

/* Of each body those that it never meets, behind FILTERS_FIRST and the bodies; from the end of each one's on, so that FILTER_EXCEPT is where they begin when all are there. */
void carom_apart_fill(const carom_world *world, int32_t *filters)
{
	const uint64_t *pairs = world->apart.items;
	const size_t count = carom_apart_count(world);
	int32_t end = (int32_t)FILTER(world->capacity, 0);
	if (count == 0)
		return;
	for (size_t k = 0; k < count; k++)
		for (int side = 0; side < 2; side++)
			++*except_of(filters, pairs[k], side);
	for (size_t body = 0; body < world->body_count; body++) {
		int32_t *except = &filters[FILTER(body, FILTER_EXCEPT)];
		if (*except == 0)
			continue;
		*except = end += *except;
		filters[end++] = -1;
	}
	for (size_t k = 0; k < count; k++)
		for (int side = 0; side < 2; side++)
			filters[--*except_of(filters, pairs[k], side)] = (int32_t)body_of(pairs[k], 1 - side);
}
