/* SPDX-License-Identifier: MIT */
#include "solids.h"

#include <math.h>
#include <string.h>

solid solids_of(carom_world *world, uint32_t index)
{
	carom_body_info info;
	carom_body_state state;
	carom_error error;
	solid s = {0};
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	scenery_check(carom_world_get_states(world, index, 1, &state, &error), &error);
	s.x = (double)state.position.x, s.y = (double)state.position.y, s.radius = (double)info.radius, s.count = info.vertices ? info.vertex_count : 0;
	for (uint32_t k = 0; k < s.count; k++) {
		const double x = (double)info.vertices[k].x, y = (double)info.vertices[k].y, c = cos((double)state.angle), n = sin((double)state.angle);
		s.corners[k][0] = s.x + c * x - n * y;
		s.corners[k][1] = s.y + n * x + c * y;
	}
	return s;
}

double solids_distance(const solid *s, double x, double y)
{
	double nearest = HUGE_VAL;
	bool inside = true;
	if (s->count == 0)
		return hypot(x - s->x, y - s->y) - s->radius;
	for (uint32_t k = 0; k < s->count; k++) {
		const double *a = s->corners[k], *b = s->corners[(k + 1) % s->count], ex = b[0] - a[0], ey = b[1] - a[1];
		const double part = fmin(fmax(((x - a[0]) * ex + (y - a[1]) * ey) / (ex * ex + ey * ey), 0), 1);
		nearest = fmin(nearest, hypot(x - a[0] - part * ex, y - a[1] - part * ey));
		inside = inside && ex * (y - a[1]) - ey * (x - a[0]) > 0;
	}
	return inside ? -nearest : nearest;
}

/* How far it is in front of the best of the other's faces. */
static double beyond_faces(const solid *faces, const solid *s)
{
	double best = -HUGE_VAL;
	for (uint32_t k = 0; k < faces->count; k++) {
		const double *a = faces->corners[k], *b = faces->corners[(k + 1) % faces->count], ex = b[0] - a[0], ey = b[1] - a[1];
		double nearest = HUGE_VAL;
		for (uint32_t i = 0; i < s->count; i++)
			nearest = fmin(nearest, (ey * (s->corners[i][0] - a[0]) - ex * (s->corners[i][1] - a[1])) / hypot(ex, ey));
		best = fmax(best, nearest);
	}
	return best;
}

static double from_corners(const solid *s, const solid *corners, solids_measure *distance)
{
	double nearest = HUGE_VAL;
	for (uint32_t i = 0; i < corners->count; i++)
		nearest = fmin(nearest, distance(s, corners->corners[i][0], corners->corners[i][1]));
	return nearest;
}

double solids_nearest(const solid *a, const solid *b, solids_measure *distance)
{
	if (b->count == 0)
		return distance(a, b->x, b->y) - b->radius;
	if (a->count == 0)
		return distance(b, a->x, a->y) - a->radius;
	return fmin(from_corners(a, b, distance), from_corners(b, a, distance));
}

double solids_gap(const solid *a, const solid *b)
{
	const double beyond = a->count > 0 && b->count > 0 ? fmax(beyond_faces(a, b), beyond_faces(b, a)) : 0;
	return beyond < 0 ? beyond : solids_nearest(a, b, solids_distance);
}

solid solids_moved(const solid *s, double x, double y)
{
	solid to = *s;
	to.x += x;
	to.y += y;
	for (uint32_t k = 0; k < to.count; k++) {
		to.corners[k][0] += x;
		to.corners[k][1] += y;
	}
	return to;
}

static double gap_at(const solid *stands, const solid *moves, double x, double y)
{
	const solid there = solids_moved(moves, x, y);
	return solids_gap(stands, &there);
}

/* Are the circles around them never near? */
static bool passes(const solid *stands, const solid *moves, double along_x, double along_y)
{
	const double x = stands->x - moves->x, y = stands->y - moves->y, square = along_x * along_x + along_y * along_y;
	const double part = square > 0 ? fmin(fmax((x * along_x + y * along_y) / square, 0), 1) : 0;
	return hypot(x - part * along_x, y - part * along_y) > stands->radius + moves->radius + 0.01;
}

double solids_meeting(const solid *stands, const solid *moves, double along_x, double along_y)
{
	double low = 0, high = 1, before = 0;
	if (passes(stands, moves, along_x, along_y))
		return 2;
	const double start = gap_at(stands, moves, 0, 0);
	if (fabs(start) < SOLIDS_SURE)
		return -1;
	if (start < 0)
		return 2;
	while (high - low > 1e-13) { /* the least gap is in between */
		const double a = low + (high - low) / 3, b = high - (high - low) / 3;
		if (gap_at(stands, moves, a * along_x, a * along_y) < gap_at(stands, moves, b * along_x, b * along_y))
			high = b;
		else
			low = a;
	}
	const double least = gap_at(stands, moves, low * along_x, low * along_y);
	if (fabs(least) < SOLIDS_SURE)
		return -1;
	if (least > 0)
		return 2;
	while (low - before > 1e-15) {
		const double middle = 0.5 * (before + low);
		if (gap_at(stands, moves, middle * along_x, middle * along_y) > 0)
			before = middle;
		else
			low = middle;
	}
	return low;
}

carom_world *solids_wild(scenery_random *random, solid solids[SOLIDS_COUNT])
{
	const carom_world_def def = carom_default_world_def();
	carom_body_def bodies[SOLIDS_COUNT];
	scenery_bodies(random, SCENERY_MIXED, SOLIDS_COUNT, 1.4f, 0.0f, bodies);
	for (int k = 0; k < SOLIDS_COUNT; k++) {
		const float size = k < 3 ? 6.0f : powf(10.0f, k % 2 ? scenery_uniform(random, -2.2f, 0.3f) : scenery_uniform(random, -0.5f, -0.3f));
		const float half = k % 2 ? 20.0f : 4.0f;
		bodies[k].position = (carom_vec2){scenery_uniform(random, -half, half), scenery_uniform(random, -half, half)};
		bodies[k].angle = scenery_uniform(random, -3, 3);
		if (bodies[k].shape == CAROM_POLYGON) {
			bodies[k] = scenery_box(bodies[k].position.x, bodies[k].position.y, 0, 0, size, size * scenery_uniform(random, 0.05f, 1));
			bodies[k].angle = scenery_uniform(random, -3, 3);
		} else {
			bodies[k].radius = size;
		}
	}
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, SOLIDS_COUNT);
	for (uint32_t k = 0; k < SOLIDS_COUNT; k++)
		solids[k] = solids_of(world, k);
	return world;
}

carom_vec2 solids_somewhere(scenery_random *random)
{
	const float half = scenery_uniform(random, 0, 1) < 0.5f ? 24.0f : 5.0f;
	return (carom_vec2){scenery_uniform(random, -half, half), scenery_uniform(random, -half, half)};
}

double solids_first(const solid *stand, int32_t count, solids_way *meeting, const solid *moves, double along_x, double along_y, int32_t *other)
{
	double first = 2, next = 2;
	*other = CAROM_NOTHING;
	for (int32_t k = 0; k < count; k++) {
		const double part = meeting(&stand[k], moves, along_x, along_y);
		if (part < 0)
			return -1;
		if (part < first)
			next = first, first = part, *other = k;
		else
			next = fmin(next, part);
	}
	return first <= 1 && next - first < 1e-6 ? -1 : first;
}
