/* Bodies in their places, and the grids in which they are looked for.
 * SPDX-License-Identifier: MIT */
#include "crowd.h"
#include "angle.h"
#include "status.h"
#include "world.h"

#include <math.h>
#include <stdlib.h>

#define CELLS_PER_BODY 2 /* no more cells than that: bodies may be far apart */

/* ---- Bodies in their places ----------------------------------------------------------------------------------- */

/* Where a body is, and how it is turned. */
typedef struct frame {
	double x, y, sine, cosine;
} frame;

static frame frame_of(const carom_body_state *state)
{
	frame f = {(double)state->position.x, (double)state->position.y, 0, 1};
	carom_sincos((double)state->angle, &f.sine, &f.cosine);
	return f;
}

static void place_box(carom_placed *at)
{
	const carom_corner *corners = at->corners;
	at->min_x = at->max_x = corners[0].x, at->min_y = at->max_y = corners[0].y;
	for (uint32_t k = 1; k < at->corner_count; k++) {
		at->min_x = carom_least(at->min_x, corners[k].x), at->min_y = carom_least(at->min_y, corners[k].y);
		at->max_x = carom_most(at->max_x, corners[k].x), at->max_y = carom_most(at->max_y, corners[k].y);
	}
}

static void place_corners(carom_placed *at, const frame *f, const carom_vec2 *vertices, uint32_t count, carom_parts *parts)
{
	carom_corner *corners = parts->corners;
	for (uint32_t k = 0; k < count; k++) {
		double x = (double)vertices[k].x, y = (double)vertices[k].y;
		corners[k].x = f->x + (f->cosine * x - f->sine * y);
		corners[k].y = f->y + (f->sine * x + f->cosine * y);
	}
	for (uint32_t k = 0; k < count; k++) {
		const carom_corner *next = &corners[k + 1 < count ? k + 1 : 0];
		double along_x = next->x - corners[k].x, along_y = next->y - corners[k].y;
		double length = sqrt(along_x * along_x + along_y * along_y);
		corners[k].normal_x = length > 0 ? along_y / length : 0;
		corners[k].normal_y = length > 0 ? -along_x / length : 0;
		/* An edge that was lost in rounding has no side: everything is behind it. */
		corners[k].at = length > 0 ? corners[k].normal_x * corners[k].x + corners[k].normal_y * corners[k].y : HUGE_VAL;
	}
	at->corners = corners;
	at->corner_count = (uint8_t)count;
	parts->corners += count;
	place_box(at);
}

static void place_pieces(carom_placed *at, const frame *f, const carom_pieces *pieces, carom_parts *parts)
{
	const carom_vec2 *vertices = pieces->vertices;
	carom_placed *to = parts->pieces;
	for (uint32_t k = 0; k < pieces->count; vertices += pieces->sizes[k++]) {
		to[k] = (carom_placed){0};
		place_corners(&to[k], f, vertices, pieces->sizes[k], parts);
	}
	at->pieces = to;
	at->piece_count = (uint8_t)pieces->count;
	parts->pieces += pieces->count;
}

void carom_place_body(carom_placed *at, const carom_body_info *body, const carom_pieces *pieces, const carom_body_state *state, carom_parts *parts)
{
	*at = (carom_placed){.x = (double)state->position.x, .y = (double)state->position.y, .radius = (double)body->radius};
	at->categories = body->categories;
	at->mask = body->mask;
	at->is_dynamic = isfinite(body->mass);
	at->min_x = at->x - at->radius, at->min_y = at->y - at->radius, at->max_x = at->x + at->radius, at->max_y = at->y + at->radius;
	if (!body->vertices)
		return;
	const frame f = frame_of(state);
	place_corners(at, &f, body->vertices, body->vertex_count, parts);
	if (pieces)
		place_pieces(at, &f, pieces, parts);
}

/* ---- Grids ---------------------------------------------------------------------------------------------------- */

static uint32_t level_of(double radius, double largest)
{
	int exponent;
	frexp(largest / radius, &exponent);
	return exponent <= 1 ? 0 : exponent >= CAROM_GRIDS ? CAROM_GRIDS - 1 : (uint32_t)exponent - 1;
}

static bool is_somewhere(const carom_placed *body, uint32_t mask)
{
	return (mask == CAROM_MASK || body->categories & mask) && body->radius > 0 && isfinite(body->min_x) && isfinite(body->min_y)
		&& isfinite(body->max_x) && isfinite(body->max_y);
}

/* Gives each body its level, and each grid its members in the order of their indices. */
static void sort_by_level(carom_crowd *c, uint32_t mask)
{
	double largest = 0;
	for (size_t k = 0; k < c->count; k++)
		largest = carom_most(c->bodies[k].radius, largest);
	for (size_t k = 0; k < c->count; k++) {
		carom_placed *body = &c->bodies[k];
		body->level = (uint8_t)(is_somewhere(body, mask) ? level_of(body->radius, largest) : CAROM_GRIDS);
		if (body->level < CAROM_GRIDS)
			c->grids[body->level].count++;
	}
	uint32_t *members = c->members;
	for (carom_grid *g = c->grids; g < c->grids + CAROM_GRIDS; g++) {
		g->members = members;
		members += g->count;
		g->count = 0;
	}
	for (size_t k = 0; k < c->count; k++) {
		carom_grid *g = c->bodies[k].level < CAROM_GRIDS ? &c->grids[c->bodies[k].level] : NULL;
		if (g)
			g->members[g->count++] = (uint32_t)k;
	}
}

uint32_t carom_grid_cell(const carom_grid *grid, double at, double origin, uint32_t cells)
{
	const double index = (at - origin) / grid->cell;
	return !(index > 0) ? 0 : index < cells ? (uint32_t)index : cells - 1;
}

uint32_t carom_grid_column(const carom_grid *grid, double x)
{
	return carom_grid_cell(grid, x, grid->x, grid->columns);
}

uint32_t carom_grid_row(const carom_grid *grid, double y)
{
	return carom_grid_cell(grid, y, grid->y, grid->rows);
}

/* Chooses the cells so that they cover the members' centres, each as broad as the largest member or more. */
static void size_grid(carom_grid *g, const carom_placed *bodies)
{
	double right = -HUGE_VAL, top = -HUGE_VAL, radius = 0;
	g->x = g->y = HUGE_VAL;
	for (uint32_t k = 0; k < g->count; k++) {
		const carom_placed *body = &bodies[g->members[k]];
		g->x = carom_least(body->x, g->x), g->y = carom_least(body->y, g->y);
		right = carom_most(body->x, right), top = carom_most(body->y, top);
		radius = carom_most(body->radius, radius);
	}
	g->radius = radius * CAROM_GRID_ROUNDING;
	g->cell = 2 * g->radius;
	while (((right - g->x) / g->cell + 1) * ((top - g->y) / g->cell + 1) > (double)CELLS_PER_BODY * g->count)
		g->cell *= 2;
	g->columns = (uint32_t)((right - g->x) / g->cell) + 1;
	g->rows = (uint32_t)((top - g->y) / g->cell) + 1;
}

/* Sorts the members by cell: a counting sort, stable, that uses `cells` and `sorted` of g->count each as scratch. */
static void fill_grid(carom_grid *g, const carom_placed *bodies, uint32_t *cells, uint32_t *sorted)
{
	uint32_t count = g->columns * g->rows;
	for (uint32_t k = 0; k <= count; k++)
		g->starts[k] = 0;
	for (uint32_t k = 0; k < g->count; k++) {
		const carom_placed *body = &bodies[g->members[k]];
		cells[k] = carom_grid_row(g, body->y) * g->columns + carom_grid_column(g, body->x);
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

static void build_grids(carom_crowd *c, uint32_t mask, uint32_t *scratch)
{
	uint32_t *starts = c->starts;
	sort_by_level(c, mask);
	for (carom_grid *g = c->grids; g < c->grids + CAROM_GRIDS; g++) {
		if (g->count == 0)
			continue;
		size_grid(g, c->bodies);
		g->starts = starts;
		starts += g->columns * g->rows + 1;
		fill_grid(g, c->bodies, scratch, scratch + c->count);
	}
}

/* ---- All of it ------------------------------------------------------------------------------------------------ */

static bool make_parts(const carom_world *world, carom_parts *parts)
{
	const carom_body *bodies = carom_world_bodies(world);
	size_t corners = 0, pieces = 0;
	for (size_t k = 0; k < world->body_count; k++) {
		corners += (uint32_t)bodies[k].vertex_count + bodies[k].piece_vertices;
		pieces += bodies[k].piece_count;
	}
	parts->corners = calloc(corners + 1, sizeof *parts->corners);
	parts->pieces = calloc(pieces + 1, sizeof *parts->pieces);
	return parts->corners && parts->pieces;
}

static carom_status place_all(carom_world *world, carom_crowd *c, carom_body_state *states, carom_error *error)
{
	carom_parts parts = c->parts;
	TRY(carom_world_get_states(world, 0, c->count, states, error));
	for (uint32_t k = 0; k < c->count; k++) {
		const carom_body *body = &carom_world_bodies(world)[k];
		carom_body_info info;
		carom_pieces pieces;
		TRY(carom_world_get_body(world, k, &info, error));
		if (!body->is_convex)
			carom_outline_pieces(world, body, &pieces);
		carom_place_body(&c->bodies[k], &info, body->is_convex ? NULL : &pieces, &states[k], &parts);
	}
	return CAROM_OK;
}

carom_status carom_crowd_make(carom_world *world, uint32_t mask, const char *why, carom_crowd *crowd, carom_error *error)
{
	*crowd = (carom_crowd){.count = carom_world_body_count(world)};
	const size_t count = crowd->count;
	carom_status status;
	if (count == 0)
		return CAROM_OK;
	carom_body_state *states = malloc(count * sizeof *states);
	uint32_t *scratch = malloc(2 * count * sizeof *scratch);
	crowd->bodies = calloc(count, sizeof *crowd->bodies);
	crowd->members = malloc(count * sizeof *crowd->members);
	crowd->starts = malloc((CELLS_PER_BODY * count + CAROM_GRIDS) * sizeof *crowd->starts);
	if (make_parts(world, &crowd->parts) && states && scratch && crowd->bodies && crowd->members && crowd->starts)
		status = place_all(world, crowd, states, error);
	else
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to %s %zu bodies", why, count);
	if (status == CAROM_OK)
		build_grids(crowd, mask, scratch);
	free(states);
	free(scratch);
	return status;
}

void carom_crowd_free(carom_crowd *crowd)
{
	free(crowd->bodies);
	free(crowd->parts.corners);
	free(crowd->parts.pieces);
	free(crowd->members);
	free(crowd->starts);
	*crowd = (carom_crowd){0};
}
