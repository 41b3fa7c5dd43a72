/* The deepest overlap, looked for in grids: a body meets those of its own grid and of the coarser ones.
 * SPDX-License-Identifier: MIT */
#include "penetration.h"
#include "crossing.h"
#include "world.h"

#include <math.h>

/* ---- How deep two bodies overlap -------------------------------------------------------------------------------
 * Each function gives the separation, negative where they overlap: the distance by which the nearest face, or corner,
 * tells them apart. They stop where it is `enough` or more: such a pair is of no interest. */

static double separation_of_circles(const carom_placed *a, const carom_placed *b)
{
	double x = b->x - a->x, y = b->y - a->y;
	return sqrt(x * x + y * y) - a->radius - b->radius;
}

/* The distance from a point to the edge from `from` to `to`. */
static double distance_to_edge(double x, double y, const carom_corner *from, const carom_corner *to)
{
	double along_x = to->x - from->x, along_y = to->y - from->y, square = along_x * along_x + along_y * along_y;
	double part = square > 0 ? ((x - from->x) * along_x + (y - from->y) * along_y) / square : 0;
	part = carom_least(carom_most(part, 0), 1);
	double away_x = x - from->x - part * along_x, away_y = y - from->y - part * along_y;
	return sqrt(away_x * away_x + away_y * away_y);
}

/* The distance from a circle's centre to the nearest side of a polygon that does not hold it. */
static double distance_to_polygon(const carom_placed *polygon, const carom_placed *circle)
{
	double nearest = HUGE_VAL;
	for (uint32_t k = 0; k < polygon->corner_count; k++) {
		const carom_corner *to = &polygon->corners[k + 1 < polygon->corner_count ? k + 1 : 0];
		nearest = carom_least(nearest, distance_to_edge(circle->x, circle->y, &polygon->corners[k], to));
	}
	return nearest;
}

static double separation_from_circle(const carom_placed *polygon, const carom_placed *circle, double enough)
{
	double face = -HUGE_VAL;
	for (uint32_t k = 0; k < polygon->corner_count && face - circle->radius < enough; k++) {
		const carom_corner *edge = &polygon->corners[k];
		face = carom_most(face, edge->normal_x * circle->x + edge->normal_y * circle->y - edge->at);
	}
	if (face <= 0 || face - circle->radius >= enough)
		return face - circle->radius;
	return distance_to_polygon(polygon, circle) - circle->radius;
}

/* The separation by the faces of `a` alone. */
static double separation_by_faces(const carom_placed *a, const carom_placed *b, double enough)
{
	double separation = -HUGE_VAL;
	for (uint32_t k = 0; k < a->corner_count && separation < enough; k++) {
		const carom_corner *face = &a->corners[k];
		double nearest = HUGE_VAL;
		for (uint32_t i = 0; i < b->corner_count; i++) {
			double distance = face->normal_x * b->corners[i].x + face->normal_y * b->corners[i].y - face->at;
			nearest = distance < nearest ? distance : nearest;
		}
		separation = nearest > separation ? nearest : separation;
	}
	return separation;
}

static double separation_of_convex(const carom_placed *a, const carom_placed *b, double enough)
{
	if (!a->corners && !b->corners)
		return separation_of_circles(a, b);
	if (!b->corners)
		return separation_from_circle(a, b, enough);
	if (!a->corners)
		return separation_from_circle(b, a, enough);
	double by_faces = separation_by_faces(a, b, enough);
	return by_faces < enough ? carom_most(by_faces, separation_by_faces(b, a, enough)) : by_faces;
}

/* How far one of two boxes must move along x or y to leave the other: the bodies in them need no more. */
static double overlap_of_boxes(const carom_placed *a, const carom_placed *b)
{
	double x = carom_least(a->max_x - b->min_x, b->max_x - a->min_x);
	double y = carom_least(a->max_y - b->min_y, b->max_y - a->min_y);
	return carom_least(x, y);
}

/* Of polygons that are not convex: the pieces that are the deepest in each other count. What lies between two pieces, by rounding, is seen by the sides. */

static double separation_of_pieces_from_circle(const carom_placed *polygon, const carom_placed *circle)
{
	double least = -circle->radius;
	if (!carom_holds(polygon, circle->x, circle->y))
		return distance_to_polygon(polygon, circle) - circle->radius;
	for (uint32_t k = 0; k < polygon->piece_count; k++)
		least = carom_least(separation_from_circle(&polygon->pieces[k], circle, least), least);
	return least;
}

/* From one that is convex. */
static double separation_of_pieces(const carom_placed *a, const carom_placed *b, double enough)
{
	double least = enough;
	for (uint32_t k = 0; k < a->piece_count; k++)
		if (-overlap_of_boxes(&a->pieces[k], b) < least)
			least = carom_least(separation_of_convex(&a->pieces[k], b, least), least);
	return least;
}

static double separation_of_polygons(const carom_placed *a, const carom_placed *b, double enough)
{
	double least = enough;
	if (!a->pieces)
		return separation_of_polygons(b, a, enough);
	if (!b->pieces)
		least = separation_of_pieces(a, b, enough);
	for (uint32_t k = 0; b->pieces && k < b->piece_count; k++)
		if (-overlap_of_boxes(a, &b->pieces[k]) < least)
			least = separation_of_pieces(a, &b->pieces[k], least);
	return least > 0 && (carom_holds(a, b->corners->x, b->corners->y) || carom_holds(b, a->corners->x, a->corners->y)) ? 0 : least;
}

double carom_separation(const carom_placed *a, const carom_placed *b, double enough)
{
	if (!a->pieces && !b->pieces)
		return separation_of_convex(a, b, enough);
	if (!a->corners)
		return separation_of_pieces_from_circle(b, a);
	if (!b->corners)
		return separation_of_pieces_from_circle(a, b);
	return separation_of_polygons(a, b, enough);
}

/* Of a crowd, so far. */
typedef struct deepest {
	const carom_placed *bodies;
	const carom_world *world;
	double depth;
} deepest;

static void deepen_by_pair(deepest *all, const carom_placed *a, const carom_placed *b)
{
	if (overlap_of_boxes(a, b) <= all->depth || !(a->is_dynamic || b->is_dynamic) || !carom_meet(a, b))
		return;
	double depth = -carom_separation(a, b, -all->depth);
	if (depth > all->depth && !carom_joints_part(all->world, (size_t)(a - all->bodies), (size_t)(b - all->bodies)))
		all->depth = depth;
}

static void deepen_by_walls(deepest *all, const carom_placed *body, const carom_world_def *def)
{
	if (!body->is_dynamic)
		return;
	double x = carom_most((double)def->room_min.x - body->min_x, body->max_x - (double)def->room_max.x);
	double y = carom_most((double)def->room_min.y - body->min_y, body->max_y - (double)def->room_max.y);
	all->depth = carom_most(carom_most(x, y), all->depth);
}

/* ---- All pairs that are near ------------------------------------------------------------------------- */

/* The pairs of `body` with members of a grid, from the one in place `first` on. */
static void deepen_by_grid(deepest *all, const carom_placed *body, const carom_grid *g, uint32_t first)
{
	double reach = body->radius * CAROM_GRID_ROUNDING + g->radius;
	uint32_t left = carom_grid_column(g, body->x - reach), right = carom_grid_column(g, body->x + reach);
	uint32_t low = carom_grid_row(g, body->y - reach), high = carom_grid_row(g, body->y + reach);
	for (uint32_t row = low; row <= high; row++) {
		const uint32_t *starts = g->starts + (size_t)row * g->columns;
		uint32_t k = starts[left] > first ? starts[left] : first;
		for (; k < starts[right + 1]; k++)
			deepen_by_pair(all, body, &all->bodies[g->members[k]]);
	}
}

double carom_deepest_penetration(const carom_crowd *c, const carom_world *world)
{
	const carom_world_def *def = carom_world_get_def(world);
	deepest all = {c->bodies, world, 0};
	for (const carom_grid *g = c->grids; g < c->grids + CAROM_GRIDS; g++) {
		for (uint32_t k = 0; k < g->count; k++) {
			const carom_placed *body = &c->bodies[g->members[k]];
			if (def->has_room)
				deepen_by_walls(&all, body, def);
			deepen_by_grid(&all, body, g, k + 1);
			for (const carom_grid *coarser = c->grids; coarser < g; coarser++) {
				if (coarser->count > 0)
					deepen_by_grid(&all, body, coarser, 0);
			}
		}
	}
	return all.depth;
}
