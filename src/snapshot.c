/* What is where in a world: rays, boxes and other bodies are asked of a copy of its bodies, which never changes.
 * SPDX-License-Identifier: MIT */
#include "nearest.h"
#include "penetration.h"
#include "ray.h"
#include "status.h"
#include "world.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

struct carom_snapshot {
	carom_crowd crowd;
	bool has_room;
	carom_vec2 room_min, room_max;
};

carom_status carom_snapshot_create(carom_world *world, carom_snapshot **snapshot, carom_error *error)
{
	return carom_snapshot_create_masked(world, CAROM_MASK, snapshot, error);
}

carom_status carom_snapshot_create_masked(carom_world *world, uint32_t mask, carom_snapshot **snapshot, carom_error *error)
{
	GIVEN(world, error);
	GIVEN(snapshot, error);
	const carom_world_def *def = carom_world_get_def(world);
	carom_snapshot *made = malloc(sizeof *made);
	if (!made)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for a snapshot");
	*made = (carom_snapshot){.has_room = def->has_room, .room_min = def->room_min, .room_max = def->room_max};
	const carom_status status = carom_crowd_make(world, mask, "keep", &made->crowd, error);
	if (status == CAROM_OK)
		*snapshot = made;
	else
		carom_snapshot_destroy(made);
	return status;
}

void carom_snapshot_destroy(carom_snapshot *snapshot)
{
	if (!snapshot)
		return;
	carom_crowd_free(&snapshot->crowd);
	free(snapshot);
}

/* A body that is asked for, and is not in it. */
typedef struct visitor {
	carom_placed at;
	carom_corner corners[CAROM_MAX_VERTICES + CAROM_MOST_PIECE_VERTICES];
	carom_placed pieces[CAROM_MOST_PIECES];
} visitor;

static carom_status place_visitor(const carom_body_def *def, size_t index, visitor *v, carom_error *error)
{
	const carom_world_def world = carom_default_world_def();
	const carom_body_state state = {.position = def->position, .angle = carom_wrapped(def->angle)};
	carom_vec2 vertices[CAROM_MAX_VERTICES];
	carom_parts parts = {v->corners, v->pieces};
	carom_pieces pieces;
	carom_body body;
	TRY(carom_body_make(def, &world, index, &body, vertices, error));
	if (!body.is_convex)
		carom_pieces_make(vertices, body.vertex_count, &pieces);
	const carom_body_info info = {.radius = body.bound,
		.vertex_count = body.vertex_count,
		.vertices = body.vertex_count > 1 ? vertices : NULL,
		.mass = body.mass,
		.categories = body.categories,
		.mask = body.mask};
	carom_place_body(&v->at, &info, body.is_convex ? NULL : &pieces, &state, &parts);
	return CAROM_OK;
}

/* ---- Rays ----------------------------------------------------------------------------------------------------- */

/* What was met first, so far. */
typedef struct first_meeting {
	carom_meeting at;
	int32_t other;
} first_meeting;

static void meet_walls(const carom_snapshot *snapshot, const carom_way *way, first_meeting *first)
{
	const struct {
		double normal_x, normal_y, offset;
		carom_wall wall;
	} walls[] = {{1, 0, (double)snapshot->room_min.x, CAROM_WALL_LEFT}, {0, 1, (double)snapshot->room_min.y, CAROM_WALL_BOTTOM},
		{-1, 0, -(double)snapshot->room_max.x, CAROM_WALL_RIGHT}, {0, -1, -(double)snapshot->room_max.y, CAROM_WALL_TOP}};
	for (size_t k = 0; snapshot->has_room && k < sizeof walls / sizeof *walls; k++) {
		carom_meeting meeting;
		if (carom_ray_meets_wall(way, walls[k].normal_x, walls[k].normal_y, walls[k].offset, &meeting) && meeting.part < first->at.part)
			*first = (first_meeting){meeting, walls[k].wall};
	}
}

/* Of what is met at once a body counts before a wall, and of bodies the one with the lowest index. */
static void meet_cell(const carom_crowd *crowd, const carom_grid *grid, uint32_t cell, const carom_way *way, first_meeting *first)
{
	for (uint32_t k = grid->starts[cell]; k < grid->starts[cell + 1]; k++) {
		const int32_t body = (int32_t)grid->members[k];
		carom_meeting meeting;
		if (way->body && !carom_meet(way->body, &crowd->bodies[body]))
			continue;
		if (!carom_ray_meets_body(way, &crowd->bodies[body], &meeting))
			continue;
		if (meeting.part < first->at.part || (meeting.part == first->at.part && (first->other < 0 || body < first->other)))
			*first = (first_meeting){meeting, body};
	}
}

/* Cells side by side across the way, and ahead along the axis that it follows most. */
typedef struct axes {
	double origin, across_origin;   /* of the grid's cells */
	uint32_t cells, across_cells;   /* how many there are */
	uint32_t stride, across_stride; /* from one to the next */
	double start, across_start;     /* of the way */
	double length, across_length;   /* of the way, with its sign */
} axes;

static axes axes_of(const carom_grid *g, const carom_way *way)
{
	if (fabs(way->along_x) >= fabs(way->along_y))
		return (axes){g->x, g->y, g->columns, g->rows, 1, g->columns, way->x, way->y, way->along_x, way->along_y};
	return (axes){g->y, g->x, g->rows, g->columns, g->columns, 1, way->y, way->x, way->along_y, way->along_x};
}

/* From the way's beginning to its end, or to where nothing can be met before what was. */
static void meet_grid(const carom_crowd *crowd, const carom_grid *g, const carom_way *way, first_meeting *first)
{
	const axes a = axes_of(g, way);
	const double reach = way->radius * CAROM_GRID_ROUNDING + g->radius;
	const bool is_forward = a.length >= 0;
	const double ahead = is_forward ? reach : -reach;
	const int64_t last = carom_grid_cell(g, a.start + a.length + ahead, a.origin, a.cells), step = is_forward ? 1 : -1;
	for (int64_t k = carom_grid_cell(g, a.start - ahead, a.origin, a.cells); is_forward ? k <= last : k >= last; k += step) {
		const double low = a.origin + (double)k * g->cell - reach, high = low + g->cell + 2 * reach;
		/* the part of the way on which it could meet a body of these cells */
		const double begin = a.length != 0 ? carom_most(((is_forward ? low : high) - a.start) / a.length, 0) : 0;
		const double end = a.length != 0 ? carom_least(((is_forward ? high : low) - a.start) / a.length, 1) : 1;
		if (begin > first->at.part)
			return;
		if (begin > end)
			continue;
		const double one = a.across_start + begin * a.across_length, other = a.across_start + end * a.across_length;
		const uint32_t left = carom_grid_cell(g, carom_least(one, other) - reach, a.across_origin, a.across_cells);
		const uint32_t right = carom_grid_cell(g, carom_most(one, other) + reach, a.across_origin, a.across_cells);
		for (uint32_t across = left; across <= right; across++)
			meet_cell(crowd, g, (uint32_t)k * a.stride + across * a.across_stride, way, first);
	}
}

static carom_ray_hit cast(const carom_snapshot *snapshot, const carom_way *way, carom_vec2 to)
{
	const carom_crowd *crowd = &snapshot->crowd;
	first_meeting first = {{HUGE_VAL, 0, 0}, CAROM_NOTHING};
	double x, y;
	meet_walls(snapshot, way, &first);
	for (const carom_grid *g = crowd->grids; g < crowd->grids + CAROM_GRIDS; g++) {
		if (g->count > 0)
			meet_grid(crowd, g, way, &first);
	}
	if (first.other == CAROM_NOTHING)
		return (carom_ray_hit){CAROM_NOTHING, 1, to, {0, 0}};
	carom_ray_touches(way, first.other >= 0 ? &crowd->bodies[first.other] : NULL, &first.at, &x, &y);
	const carom_vec2 normal = {(float)(first.at.normal_x + 0), (float)(first.at.normal_y + 0)}; /* without -0 */
	return (carom_ray_hit){first.other, first.at.part, {(float)(x + 0), (float)(y + 0)}, normal};
}

static carom_ray_hit cast_ray(const carom_snapshot *snapshot, const carom_ray *ray)
{
	const double x = (double)ray->from.x, y = (double)ray->from.y;
	const carom_way way = {x, y, (double)ray->to.x - x, (double)ray->to.y - y, (double)ray->radius, NULL};
	return cast(snapshot, &way, ray->to);
}

static carom_status check_ray(const carom_ray *ray, size_t k, carom_error *error)
{
	const struct {
		const char *name;
		float number;
	} numbers[] = {{"from.x", ray->from.x}, {"from.y", ray->from.y}, {"to.x", ray->to.x}, {"to.y", ray->to.y}};
	for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
		if (!isfinite(numbers[i].number))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "rays[%zu].%s: found %g; allowed: a finite number", k, numbers[i].name,
				(double)numbers[i].number);
	}
	if (!(ray->radius >= 0) || !isfinite(ray->radius))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "rays[%zu].radius: found %g; allowed: a finite number, 0 or more", k, (double)ray->radius);
	return CAROM_OK;
}

carom_status carom_snapshot_cast_rays(const carom_snapshot *snapshot, size_t count, const carom_ray *rays, carom_ray_hit *hits, carom_error *error)
{
	GIVEN(snapshot, error);
	if (count == 0)
		return CAROM_OK;
	GIVEN(rays, error);
	GIVEN(hits, error);
	for (size_t k = 0; k < count; k++)
		TRY(check_ray(&rays[k], k, error));
	for (size_t k = 0; k < count; k++)
		hits[k] = cast_ray(snapshot, &rays[k]);
	return CAROM_OK;
}

carom_status carom_snapshot_cast_bodies(const carom_snapshot *snapshot, size_t count, const carom_body_def *bodies, const carom_vec2 *to,
	carom_ray_hit *hits, carom_error *error)
{
	visitor v;
	GIVEN(snapshot, error);
	if (count == 0)
		return CAROM_OK;
	GIVEN(bodies, error);
	GIVEN(to, error);
	GIVEN(hits, error);
	for (size_t k = 0; k < count; k++) {
		TRY(place_visitor(&bodies[k], k, &v, error));
		if (!carom_is_finite(to[k]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "to[%zu]: found (%g, %g); allowed: finite numbers", k, (double)to[k].x, (double)to[k].y);
	}
	for (size_t k = 0; k < count; k++) {
		TRY(place_visitor(&bodies[k], k, &v, error));
		const carom_way way = {v.at.x, v.at.y, (double)to[k].x - v.at.x, (double)to[k].y - v.at.y, v.at.radius, &v.at};
		hits[k] = cast(snapshot, &way, to[k]);
	}
	return CAROM_OK;
}

/* ---- Boxes, and bodies ---------------------------------------------------------------------------------------- */

typedef struct finding {
	const carom_placed *what;
	bool by_filters; /* only those that it may hit */
	uint32_t *indices;
	size_t room, count;
} finding;

/* Bodies whose own boxes touch it may still be outside. */
static void find_in_cells(const carom_crowd *crowd, const carom_grid *g, uint32_t start, uint32_t end, finding *f)
{
	const carom_placed *what = f->what;
	for (uint32_t k = start; k < end; k++) {
		const carom_placed *body = &crowd->bodies[g->members[k]];
		if (body->min_x > what->max_x || body->max_x < what->min_x || body->min_y > what->max_y || body->max_y < what->min_y)
			continue;
		if ((f->by_filters && !carom_meet(what, body)) || carom_separation(what, body, DBL_MIN) > 0)
			continue;
		if (f->count < f->room)
			f->indices[f->count] = g->members[k];
		f->count++;
	}
}

static void find(const carom_crowd *crowd, finding *f, size_t *count)
{
	const carom_placed *what = f->what;
	for (const carom_grid *g = crowd->grids; g < crowd->grids + CAROM_GRIDS; g++) {
		if (g->count == 0)
			continue;
		const uint32_t first = carom_grid_column(g, what->min_x - g->radius), last = carom_grid_column(g, what->max_x + g->radius);
		const uint32_t high = carom_grid_row(g, what->max_y + g->radius);
		for (uint32_t row = carom_grid_row(g, what->min_y - g->radius); row <= high; row++)
			find_in_cells(crowd, g, g->starts[row * g->columns + first], g->starts[row * g->columns + last + 1], f);
	}
	if (f->count > 1 && f->room > 1)
		qsort(f->indices, f->count < f->room ? f->count : f->room, sizeof *f->indices, carom_compare_indices);
	*count = f->count;
}

carom_status carom_snapshot_find(const carom_snapshot *snapshot, carom_vec2 min, carom_vec2 max, uint32_t *indices, size_t room, size_t *count,
	carom_error *error)
{
	GIVEN(snapshot, error);
	GIVEN(count, error);
	if (room > 0)
		GIVEN(indices, error);
	if (!isfinite(min.x) || !isfinite(min.y) || !isfinite(max.x) || !isfinite(max.y) || min.x > max.x || min.y > max.y)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "box: found (%g, %g) to (%g, %g); allowed: finite numbers, min no larger than max",
			(double)min.x, (double)min.y, (double)max.x, (double)max.y);
	const double left = (double)min.x, bottom = (double)min.y, right = (double)max.x, top = (double)max.y;
	const carom_corner corners[] = {{left, bottom, 0, -1, -bottom}, {right, bottom, 1, 0, right}, {right, top, 0, 1, top}, {left, top, -1, 0, -left}};
	const carom_placed box = {.min_x = left, .min_y = bottom, .max_x = right, .max_y = top, .corners = corners, .corner_count = 4};
	finding f = {&box, false, indices, room, 0};
	find(&snapshot->crowd, &f, count);
	return CAROM_OK;
}

carom_status carom_snapshot_find_touching(const carom_snapshot *snapshot, const carom_body_def *body, uint32_t *indices, size_t room, size_t *count,
	carom_error *error)
{
	visitor v;
	GIVEN(snapshot, error);
	GIVEN(body, error);
	GIVEN(count, error);
	if (room > 0)
		GIVEN(indices, error);
	TRY(place_visitor(body, 0, &v, error));
	finding f = {&v.at, true, indices, room, 0};
	find(&snapshot->crowd, &f, count);
	return CAROM_OK;
}

/* ---- The nearest body ----------------------------------------------------------------------------------------- */

carom_status carom_snapshot_find_nearest(const carom_snapshot *snapshot, size_t count, const carom_vec2 *points, float within, carom_nearest *nearest,
	carom_error *error)
{
	GIVEN(snapshot, error);
	if (!(within >= 0))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "within: found %g; allowed: a number, 0 or more", (double)within);
	if (count == 0)
		return CAROM_OK;
	GIVEN(points, error);
	GIVEN(nearest, error);
	for (size_t k = 0; k < count; k++)
		if (!isfinite(points[k].x) || !isfinite(points[k].y))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "points[%zu]: found (%g, %g); allowed: finite numbers", k, (double)points[k].x,
				(double)points[k].y);
	for (size_t k = 0; k < count; k++) {
		const carom_closest found = carom_find_closest(&snapshot->crowd, (double)points[k].x, (double)points[k].y, (double)within);
		if (found.body < 0)
			nearest[k] = (carom_nearest){CAROM_NOTHING, (double)within, points[k], {0, 0}};
		else
			nearest[k] = (carom_nearest){
				found.body, found.distance, {(float)found.x, (float)found.y}, {(float)found.normal_x, (float)found.normal_y}};
	}
	return CAROM_OK;
}
