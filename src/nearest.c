/* Which body is nearest to a point: boxes about it grow until what lies outside of them is farther.
 * SPDX-License-Identifier: MIT */
#include "nearest.h"
#include "crossing.h"

#include <math.h>

static bool is_inside(const carom_placed *polygon, double x, double y)
{
	if (polygon->pieces)
		return carom_holds(polygon, x, y);
	for (uint32_t k = 0; k < polygon->corner_count; k++) {
		const carom_corner *face = &polygon->corners[k];
		if (face->normal_x * x + face->normal_y * y - face->at > 0)
			return false;
	}
	return true;
}

/* Of an edge: of the two ends, too. */
static void come_closer(double from_x, double from_y, double to_x, double to_y, double x, double y, double *least, carom_closest *found)
{
	const double edge_x = to_x - from_x, edge_y = to_y - from_y;
	const double along = ((x - from_x) * edge_x + (y - from_y) * edge_y) / (edge_x * edge_x + edge_y * edge_y);
	const double part = carom_least(carom_most(along, 0), 1), at_x = from_x + part * edge_x, at_y = from_y + part * edge_y;
	const double square = (x - at_x) * (x - at_x) + (y - at_y) * (y - at_y);
	if (!(square < *least))
		return;
	*least = square;
	found->x = at_x;
	found->y = at_y;
}

static carom_closest closest_of(const carom_placed *body, double x, double y)
{
	carom_closest found = {.x = x, .y = y};
	double least = HUGE_VAL;
	if (!body->corners) {
		const double away_x = x - body->x, away_y = y - body->y, far = sqrt(away_x * away_x + away_y * away_y);
		if (!(far > body->radius))
			return found;
		return (carom_closest){
			far - body->radius, body->x + body->radius * (away_x / far), body->y + body->radius * (away_y / far), away_x / far, away_y / far, 0};
	}
	if (is_inside(body, x, y))
		return found;
	for (uint32_t k = 0; k < body->corner_count; k++) {
		const carom_corner *from = &body->corners[k], *to = &body->corners[k + 1 < body->corner_count ? k + 1 : 0];
		come_closer(from->x, from->y, to->x, to->y, x, y, &least, &found);
	}
	found.distance = sqrt(least);
	if (found.distance > 0) {
		found.normal_x = (x - found.x) / found.distance;
		found.normal_y = (y - found.y) / found.distance;
	}
	return found;
}

static void look_at(const carom_crowd *crowd, int32_t body, double x, double y, carom_closest *best)
{
	const carom_placed *placed = &crowd->bodies[body];
	const double away_x = placed->x - x, away_y = placed->y - y, reach = best->distance + placed->radius * CAROM_GRID_ROUNDING;
	if (away_x * away_x + away_y * away_y > reach * reach * CAROM_GRID_ROUNDING)
		return;
	carom_closest found = closest_of(placed, x, y);
	found.body = body;
	if (found.distance < best->distance || (found.distance == best->distance && (best->body < 0 || body < best->body)))
		*best = found;
}

/* All in the cells of a box about the point. False if there are no other cells. */
static bool look_around(const carom_crowd *crowd, const carom_grid *g, double x, double y, double around, carom_closest *best)
{
	const uint32_t left = carom_grid_column(g, x - around), right = carom_grid_column(g, x + around);
	const uint32_t low = carom_grid_row(g, y - around), high = carom_grid_row(g, y + around);
	for (uint32_t row = low; row <= high; row++) {
		const uint32_t *starts = g->starts + (size_t)row * g->columns;
		for (uint32_t k = starts[left]; k < starts[right + 1]; k++)
			look_at(crowd, (int32_t)g->members[k], x, y, best);
	}
	return left > 0 || low > 0 || right + 1 < g->columns || high + 1 < g->rows;
}

carom_closest carom_find_closest(const carom_crowd *crowd, double x, double y, double within)
{
	carom_closest best = {.distance = within, .body = -1};
	for (const carom_grid *g = crowd->grids; g < crowd->grids + CAROM_GRIDS; g++) {
		double looked = 0.5 * g->cell;
		while (g->count > 0 && look_around(crowd, g, x, y, carom_least(looked, best.distance) + g->radius, &best) && looked < best.distance)
			looked *= 2;
	}
	return best;
}
