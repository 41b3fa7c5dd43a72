/* Where a straight way crosses a polygon. On which side of the way a corner lies is found once for both sides of the polygon that meet there: nothing gets through between them.
 * SPDX-License-Identifier: MIT */
#include "crossing.h"

#include <math.h>

/* A corner as it is seen from where the way begins: how far to the left of the way, and how far along it, both times the way's length. */
typedef struct view {
	double left, ahead;
} view;

static view view_of(const carom_corner *corner, double x, double y, double along_x, double along_y)
{
	const double from_x = corner->x - x, from_y = corner->y - y;
	return (view){along_x * from_y - along_y * from_x, along_x * from_x + along_y * from_y};
}

/* A side that the way, going on and on, meets: how far along. */
static double ahead_at(view from, view to)
{
	return from.ahead + (to.ahead - from.ahead) * (from.left / (from.left - to.left));
}

/* Adds a side that it does not keep clear of. It goes in and out by turns, and from without where the side goes from its left to its right. */
static void add_side(carom_crossing *all, view from, view to, uint32_t side)
{
	if (from.left == to.left) { /* along the way, or no longer than rounding */
		all->is_on |= from.ahead * to.ahead <= 0;
		return;
	}
	const double ahead = ahead_at(from, to);
	all->is_on |= ahead == 0;
	all->is_in ^= (from.left > 0) != (to.left > 0) && ahead > 0;
	if (from.left > to.left && ahead > 0 && ahead < all->part) {
		all->part = ahead;
		all->side = side;
	}
}

carom_crossing carom_cross(const carom_placed *polygon, double x, double y, double along_x, double along_y)
{
	const uint32_t count = polygon->corner_count;
	carom_crossing all = {HUGE_VAL, 0, false, false};
	view from = view_of(&polygon->corners[count - 1], x, y, along_x, along_y);
	for (uint32_t k = 0; k < count; k++) {
		const view to = view_of(&polygon->corners[k], x, y, along_x, along_y);
		if (!((from.left > 0 && to.left > 0) || (from.left < 0 && to.left < 0)))
			add_side(&all, from, to, k > 0 ? k - 1 : count - 1);
		from = to;
	}
	all.part /= along_x * along_x + along_y * along_y;
	return all;
}

bool carom_holds(const carom_placed *polygon, double x, double y)
{
	const carom_crossing all = carom_cross(polygon, x, y, 1, 0);
	return all.is_in || all.is_on;
}
