/* The deepest overlap, looked for in grids.
 * SPDX-License-Identifier: MIT */
#include "penetration.h"
#include "angle.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>

#define LEVELS 24         /* sizes told apart; the smallest bodies, from 2^-23 of the largest on, share one grid */
#define CELLS_PER_BODY 2  /* no more cells than that: bodies may be far apart */
#define ROUNDING 1.000001 /* radii are floats, and may be a little smaller than what they enclose */

/* The bodies of one size by cell: those of cell k are members[starts[k]] to members[starts[k + 1] - 1]. */
typedef struct grid {
	double x, y, cell, radius; /* the first cell's corner, a cell's side, the largest body's radius */
	uint32_t columns, rows, count;
	uint32_t *members, *starts;
} grid;

typedef struct crowd {
	carom_placed *bodies;
	size_t count;
	grid grids[LEVELS];                 /* from the largest bodies to the smallest */
	uint32_t *members, *cells, *starts; /* memory of the grids; `cells` is scratch */
} crowd;

/* libm's fmin and fmax are calls; where `a` is NaN these give `b`. */
static double least(double a, double b)
{
	return a < b ? a : b;
}

static double most(double a, double b)
{
	return a > b ? a : b;
}

/* ---- Bodies in their places ----------------------------------------------------------------------------------- */

static void place_corners(carom_placed *at, const carom_body_info *body, const carom_body_state *state, carom_corner *corners)
{
	double sine, cosine;
	carom_sincos((double)state->angle, &sine, &cosine);
	for (uint32_t k = 0; k < body->vertex_count; k++) {
		double x = (double)body->vertices[k].x, y = (double)body->vertices[k].y;
		corners[k].x = at->x + (cosine * x - sine * y);
		corners[k].y = at->y + (sine * x + cosine * y);
	}
	for (uint32_t k = 0; k < body->vertex_count; k++) {
		const carom_corner *next = &corners[k + 1 < body->vertex_count ? k + 1 : 0];
		double along_x = next->x - corners[k].x, along_y = next->y - corners[k].y;
		double length = sqrt(along_x * along_x + along_y * along_y);
		corners[k].normal_x = length > 0 ? along_y / length : 0;
		corners[k].normal_y = length > 0 ? -along_x / length : 0;
		/* An edge that was lost in rounding has no side: everything is behind it. */
		corners[k].at = length > 0 ? corners[k].normal_x * corners[k].x + corners[k].normal_y * corners[k].y : HUGE_VAL;
	}
	at->corners = corners;
	at->corner_count = body->vertex_count;
}

static void place_box(carom_placed *at)
{
	const carom_corner *corners = at->corners;
	if (!corners) {
		at->min_x = at->x - at->radius, at->min_y = at->y - at->radius, at->max_x = at->x + at->radius, at->max_y = at->y + at->radius;
		return;
	}
	at->min_x = at->max_x = corners[0].x, at->min_y = at->max_y = corners[0].y;
	for (uint32_t k = 1; k < at->corner_count; k++) {
		at->min_x = least(at->min_x, corners[k].x), at->min_y = least(at->min_y, corners[k].y);
		at->max_x = most(at->max_x, corners[k].x), at->max_y = most(at->max_y, corners[k].y);
	}
}

uint32_t carom_place_body(carom_placed *at, const carom_body_info *body, const carom_body_state *state, carom_corner *corners)
{
	*at = (carom_placed){.x = (double)state->position.x, .y = (double)state->position.y, .radius = (double)body->radius};
	at->is_static = body->is_static;
	if (body->vertices)
		place_corners(at, body, state, corners);
	place_box(at);
	return at->corner_count;
}

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
	part = least(most(part, 0), 1);
	double away_x = x - from->x - part * along_x, away_y = y - from->y - part * along_y;
	return sqrt(away_x * away_x + away_y * away_y);
}

static double separation_from_circle(const carom_placed *polygon, const carom_placed *circle, double enough)
{
	double face = -HUGE_VAL, nearest = HUGE_VAL;
	uint32_t count = polygon->corner_count;
	for (uint32_t k = 0; k < count && face - circle->radius < enough; k++) {
		const carom_corner *edge = &polygon->corners[k];
		face = most(face, edge->normal_x * circle->x + edge->normal_y * circle->y - edge->at);
	}
	if (face <= 0 || face - circle->radius >= enough)
		return face - circle->radius;
	for (uint32_t k = 0; k < count; k++) {
		const carom_corner *to = &polygon->corners[k + 1 < count ? k + 1 : 0];
		nearest = least(nearest, distance_to_edge(circle->x, circle->y, &polygon->corners[k], to));
	}
	return nearest - circle->radius;
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

static double separation(const carom_placed *a, const carom_placed *b, double enough)
{
	if (!a->corners && !b->corners)
		return separation_of_circles(a, b);
	if (!b->corners)
		return separation_from_circle(a, b, enough);
	if (!a->corners)
		return separation_from_circle(b, a, enough);
	double by_faces = separation_by_faces(a, b, enough);
	return by_faces < enough ? most(by_faces, separation_by_faces(b, a, enough)) : by_faces;
}

/* How far one of two boxes must move along x or y to leave the other: the bodies in them need no more. */
static double overlap_of_boxes(const carom_placed *a, const carom_placed *b)
{
	double x = least(a->max_x - b->min_x, b->max_x - a->min_x);
	double y = least(a->max_y - b->min_y, b->max_y - a->min_y);
	return least(x, y);
}

static void deepen_by_pair(double *deepest, const carom_placed *a, const carom_placed *b)
{
	if (overlap_of_boxes(a, b) <= *deepest || (a->is_static && b->is_static))
		return;
	double depth = -separation(a, b, -*deepest);
	if (depth > *deepest)
		*deepest = depth;
}

static void deepen_by_walls(double *deepest, const carom_placed *body, const carom_world_def *def)
{
	if (body->is_static)
		return;
	double x = most((double)def->room_min.x - body->min_x, body->max_x - (double)def->room_max.x);
	double y = most((double)def->room_min.y - body->min_y, body->max_y - (double)def->room_max.y);
	*deepest = most(most(x, y), *deepest);
}

/* ---- Grids ---------------------------------------------------------------------------------------------------- */

static uint32_t level_of(double radius, double largest)
{
	int exponent;
	frexp(largest / radius, &exponent);
	return exponent <= 1 ? 0 : exponent >= LEVELS ? LEVELS - 1 : (uint32_t)exponent - 1;
}

static bool is_somewhere(const carom_placed *body)
{
	return body->radius > 0 && isfinite(body->min_x) && isfinite(body->min_y) && isfinite(body->max_x) && isfinite(body->max_y);
}

/* Gives each body its level, and each grid its members in the order of their indices. */
static void sort_by_level(crowd *c)
{
	double largest = 0;
	for (size_t k = 0; k < c->count; k++)
		largest = most(c->bodies[k].radius, largest);
	for (size_t k = 0; k < c->count; k++) {
		carom_placed *body = &c->bodies[k];
		body->level = is_somewhere(body) ? level_of(body->radius, largest) : LEVELS;
		if (body->level < LEVELS)
			c->grids[body->level].count++;
	}
	uint32_t *members = c->members;
	for (grid *g = c->grids; g < c->grids + LEVELS; g++) {
		g->members = members;
		members += g->count;
		g->count = 0;
	}
	for (size_t k = 0; k < c->count; k++) {
		grid *g = c->bodies[k].level < LEVELS ? &c->grids[c->bodies[k].level] : NULL;
		if (g)
			g->members[g->count++] = (uint32_t)k;
	}
}

static uint32_t cell_of(double position, double origin, double cell, uint32_t cells)
{
	double index = (position - origin) / cell;
	return !(index > 0) ? 0 : index < cells ? (uint32_t)index : cells - 1;
}

/* Chooses the cells so that they cover the members' centres, each as broad as the largest member or more. */
static void size_grid(grid *g, const carom_placed *bodies)
{
	double right = -HUGE_VAL, top = -HUGE_VAL, radius = 0;
	g->x = g->y = HUGE_VAL;
	for (uint32_t k = 0; k < g->count; k++) {
		const carom_placed *body = &bodies[g->members[k]];
		g->x = least(body->x, g->x), g->y = least(body->y, g->y);
		right = most(body->x, right), top = most(body->y, top);
		radius = most(body->radius, radius);
	}
	g->radius = radius * ROUNDING;
	g->cell = 2 * g->radius;
	while (((right - g->x) / g->cell + 1) * ((top - g->y) / g->cell + 1) > (double)CELLS_PER_BODY * g->count)
		g->cell *= 2;
	g->columns = (uint32_t)((right - g->x) / g->cell) + 1;
	g->rows = (uint32_t)((top - g->y) / g->cell) + 1;
}

/* Sorts the members by cell: a counting sort, stable, that uses `cells` and `sorted` of g->count each as scratch. */
static void fill_grid(grid *g, const carom_placed *bodies, uint32_t *cells, uint32_t *sorted)
{
	uint32_t count = g->columns * g->rows;
	for (uint32_t k = 0; k <= count; k++)
		g->starts[k] = 0;
	for (uint32_t k = 0; k < g->count; k++) {
		const carom_placed *body = &bodies[g->members[k]];
		cells[k] = cell_of(body->y, g->y, g->cell, g->rows) * g->columns + cell_of(body->x, g->x, g->cell, g->columns);
		g->starts[cells[k] + 1]++;
	}
	for (uint32_t k = 0; k < count; k++)
		g->starts[k + 1] += g->starts[k];
	for (uint32_t k = 0; k < g->count; k++)
		sorted[g->starts[cells[k]]++] = g->members[k];
	for (uint32_t k = 0; k < g->count; k++)
		g->members[k] = sorted[k];
	for (uint32_t k = count; k > 0; k--)
		g->starts[k] = g->starts[k - 1];
	g->starts[0] = 0;
}

static void build_grids(crowd *c)
{
	uint32_t *starts = c->starts;
	sort_by_level(c);
	for (grid *g = c->grids; g < c->grids + LEVELS; g++) {
		if (g->count == 0)
			continue;
		size_grid(g, c->bodies);
		g->starts = starts;
		starts += g->columns * g->rows + 1;
		fill_grid(g, c->bodies, c->cells, c->cells + c->count);
	}
}

/* The pairs of `body` with members of a grid, from the one in place `first` on. */
static void deepen_by_grid(double *deepest, const carom_placed *bodies, const carom_placed *body, const grid *g, uint32_t first)
{
	double reach = body->radius * ROUNDING + g->radius;
	uint32_t left = cell_of(body->x - reach, g->x, g->cell, g->columns), right = cell_of(body->x + reach, g->x, g->cell, g->columns);
	uint32_t low = cell_of(body->y - reach, g->y, g->cell, g->rows), high = cell_of(body->y + reach, g->y, g->cell, g->rows);
	for (uint32_t row = low; row <= high; row++) {
		const uint32_t *starts = g->starts + (size_t)row * g->columns;
		uint32_t k = starts[left] > first ? starts[left] : first;
		for (; k < starts[right + 1]; k++)
			deepen_by_pair(deepest, body, &bodies[g->members[k]]);
	}
}

static double search(const crowd *c, const carom_world_def *def)
{
	double deepest = 0;
	for (const grid *g = c->grids; g < c->grids + LEVELS; g++) {
		for (uint32_t k = 0; k < g->count; k++) {
			const carom_placed *body = &c->bodies[g->members[k]];
			if (def->has_room)
				deepen_by_walls(&deepest, body, def);
			deepen_by_grid(&deepest, c->bodies, body, g, k + 1);
			for (const grid *coarser = c->grids; coarser < g; coarser++) {
				if (coarser->count > 0)
					deepen_by_grid(&deepest, c->bodies, body, coarser, 0);
			}
		}
	}
	return deepest;
}

carom_status carom_deepest_penetration(carom_placed *bodies, size_t count, const carom_world_def *def, double *deepest, carom_error *error)
{
	crowd c = {.bodies = bodies, .count = count};
	carom_status status = CAROM_OK;
	c.members = malloc(count * sizeof *c.members + 1);
	c.cells = malloc(2 * count * sizeof *c.cells + 1);
	c.starts = malloc((CELLS_PER_BODY * count + LEVELS) * sizeof *c.starts);
	if (c.members && c.cells && c.starts) {
		build_grids(&c);
		*deepest = search(&c, def);
	} else {
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to measure the overlaps of %zu bodies", count);
	}
	free(c.members);
	free(c.cells);
	free(c.starts);
	return status;
}
