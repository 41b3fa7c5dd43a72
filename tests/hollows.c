/* SPDX-License-Identifier: MIT */
#include "hollows.h"

#include <math.h>

#define PI 3.14159265358979323846

/* ---- Random ones ---- */

static carom_vec2 polar(double radius, double angle)
{
	return (carom_vec2){(float)(radius * cos(angle)), (float)(radius * sin(angle))};
}

static uint32_t make_star(scenery_random *random, float radius, carom_vec2 *vertices)
{
	const uint32_t count = (uint32_t)scenery_uniform(random, 4, CAROM_MAX_VERTICES + 0.99f);
	for (uint32_t k = 0; k < count; k++)
		vertices[k] = polar((double)(radius * scenery_uniform(random, 0.2f, 1)), 2 * PI * (k + (double)scenery_uniform(random, 0, 0.8f)) / count);
	return count;
}

/* Teeth of any lengths, which point down. */
static uint32_t make_comb(scenery_random *random, float radius, carom_vec2 *vertices)
{
	const uint32_t ends = 2 * (uint32_t)scenery_uniform(random, 2, CAROM_MAX_VERTICES / 2 - 0.01f) - 2;
	const float pitch = 1.6f * radius / (float)ends;
	for (uint32_t k = 0; k < ends; k++)
		vertices[k] = (carom_vec2){pitch * (float)k, radius * (k % 2 ? scenery_uniform(random, 0.3f, 0.8f) : scenery_uniform(random, -0.6f, 0.2f))};
	vertices[ends] = (carom_vec2){pitch * (float)ends, radius};
	vertices[ends + 1] = (carom_vec2){-pitch, radius};
	return ends + 2;
}

static uint32_t make_spiral(scenery_random *random, float radius, carom_vec2 *vertices)
{
	const uint32_t half = (uint32_t)scenery_uniform(random, 4, CAROM_MAX_VERTICES / 2 + 0.99f);
	const double turn = (double)scenery_uniform(random, 0.3f, 0.6f), grows = 0.045 * (double)radius,
				 thick = (double)scenery_uniform(random, 0.05f, 0.2f);
	for (uint32_t k = 0; k < half; k++) {
		const double angle = k * turn, out = 0.25 * (double)radius + grows * angle;
		vertices[k] = polar(out, angle);
		vertices[2 * half - 1 - k] = polar(out - thick * (double)radius, angle);
	}
	return 2 * half;
}

/* Behind each, but the last, one in the middle of its side. */
static uint32_t add_middles(carom_vec2 *vertices, uint32_t count)
{
	for (uint32_t k = count; k-- > 0;) {
		const carom_vec2 from = vertices[k], to = k + 1 < count ? vertices[2 * (k + 1)] : from;
		vertices[2 * k] = from;
		vertices[2 * k + 1] = (carom_vec2){0.5f * (from.x + to.x), 0.5f * (from.y + to.y)};
	}
	return 2 * count - 1;
}

uint32_t hollows_make(scenery_random *random, hollow_kind kind, float radius, carom_vec2 vertices[CAROM_MAX_VERTICES])
{
	static uint32_t (*const makers[HOLLOW_KINDS])(scenery_random *, float, carom_vec2 *) = {make_star, make_comb, make_spiral};
	const uint32_t count = makers[kind](random, radius, vertices);
	return 2 * count <= CAROM_MAX_VERTICES && scenery_uniform(random, 0, 1) < 0.5f ? add_middles(vertices, count) : count;
}

uint32_t hollows_reflex(const carom_vec2 *vertices, uint32_t count)
{
	uint32_t reflex = 0;
	for (uint32_t k = 0; k < count; k++) {
		const carom_vec2 a = vertices[k], b = vertices[(k + 1) % count], c = vertices[(k + 2) % count];
		const double e[2] = {(double)b.x - (double)a.x, (double)b.y - (double)a.y}, f[2] = {(double)c.x - (double)b.x, (double)c.y - (double)b.y};
		reflex += e[0] * f[1] - e[1] * f[0] < 0;
	}
	return reflex;
}

/* ---- Distances ---- */

solid hollows_solid(const carom_vec2 *vertices, uint32_t count)
{
	solid s = {.count = count};
	for (uint32_t k = 0; k < count; k++) {
		s.corners[k][0] = (double)vertices[k].x;
		s.corners[k][1] = (double)vertices[k].y;
		s.radius = fmax(s.radius, hypot(s.corners[k][0], s.corners[k][1]));
	}
	return s;
}

double hollows_distance(const solid *s, double x, double y)
{
	double nearest = HUGE_VAL;
	bool inside = false;
	if (s->count == 0)
		return hypot(x - s->x, y - s->y) - s->radius;
	for (uint32_t k = 0; k < s->count; k++) {
		const double *a = s->corners[k], *b = s->corners[(k + 1) % s->count], ex = b[0] - a[0], ey = b[1] - a[1];
		const double part = fmin(fmax(((x - a[0]) * ex + (y - a[1]) * ey) / (ex * ex + ey * ey), 0), 1);
		nearest = fmin(nearest, hypot(x - a[0] - part * ex, y - a[1] - part * ey));
		if ((a[1] > y) != (b[1] > y) && x < a[0] + ex * (y - a[1]) / ey)
			inside = !inside;
	}
	return inside ? -nearest : nearest;
}

static double side_of(const double *a, const double *b, const double *p)
{
	return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

static bool cross(const solid *a, const solid *b)
{
	for (uint32_t i = 0; i < a->count; i++)
		for (uint32_t k = 0; k < b->count; k++) {
			const double *p = a->corners[i], *q = a->corners[(i + 1) % a->count], *r = b->corners[k], *s = b->corners[(k + 1) % b->count];
			if ((side_of(p, q, r) > 0) != (side_of(p, q, s) > 0) && (side_of(r, s, p) > 0) != (side_of(r, s, q) > 0))
				return true;
		}
	return false;
}

double hollows_gap(const solid *a, const solid *b)
{
	const double nearest = solids_nearest(a, b, hollows_distance);
	return nearest > 0 && cross(a, b) ? -SOLIDS_SURE : nearest;
}

/* It can't get nearer than by the length of its way. */
double hollows_meeting(const solid *stands, const solid *moves, double along_x, double along_y)
{
	const double length = hypot(along_x, along_y);
	double part = 0;
	for (int k = 0; k < 200 && part <= 1; k++) {
		const solid there = solids_moved(moves, part * along_x, part * along_y);
		const double gap = hollows_gap(stands, &there);
		if (part == 0 && gap < SOLIDS_SURE)
			return gap > -SOLIDS_SURE ? -1 : 2;
		if (gap < 1e-10 * length)
			return part;
		part += gap / length;
	}
	return part > 1 ? 2 : -1;
}

/* ---- Worlds ---- */

carom_body_def hollows_body(scenery_random *random, carom_vec2 vertices[CAROM_MAX_VERTICES])
{
	const float size = scenery_uniform(random, 0.5f, 3);
	carom_body_def def = scenery_circle(scenery_uniform(random, -12, 12), scenery_uniform(random, -12, 12), 0, 0, 0.5f * size);
	const int kind = (int)scenery_uniform(random, 0, HOLLOW_KINDS + 1.99f);
	def.angle = scenery_uniform(random, -3, 3);
	def.is_static = scenery_uniform(random, 0, 1) < 0.2f;
	if (kind == HOLLOW_KINDS) {
		def.shape = CAROM_REGULAR;
		def.sides = 5;
	}
	if (kind < HOLLOW_KINDS) {
		def.shape = CAROM_POLYGON;
		def.vertices = vertices;
		def.vertex_count = hollows_make(random, (hollow_kind)kind, size, vertices);
	}
	return def;
}

carom_world *hollows_wild(scenery_random *random, solid solids[HOLLOWS_COUNT])
{
	static carom_vec2 vertices[HOLLOWS_COUNT][CAROM_MAX_VERTICES];
	const carom_world_def def = carom_default_world_def();
	carom_body_def bodies[HOLLOWS_COUNT];
	for (int k = 0; k < HOLLOWS_COUNT; k++)
		bodies[k] = hollows_body(random, vertices[k]);
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, HOLLOWS_COUNT);
	for (uint32_t k = 0; k < HOLLOWS_COUNT; k++)
		solids[k] = solids_of(world, k);
	return world;
}
