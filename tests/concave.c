/* SPDX-License-Identifier: MIT */
#include "concave.h"

#include <math.h>
#include <stdlib.h>

#include "exact.h"
#include "runs.h"

enum { MOST = 16 };

typedef struct shape {
	uint32_t count;
	carom_vec2 at[MOST];
} shape;

static const shape shapes[CONCAVE_KINDS] = {
	[CONCAVE_L] = {6, {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}},
	[CONCAVE_U] = {8, {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},
	[CONCAVE_C] = {14,
		{{5, 2}, {3, 5}, {-1, 6}, {-5, 3}, {-5, -3}, {-1, -6}, {3, -5}, {5, -2}, {3, -1}, {1, -3}, {-2, -3}, {-3, 0}, {-1, 4}, {2, 3}}},
	[CONCAVE_CROSS] = {12, {{1, -1}, {3, -1}, {3, 1}, {1, 1}, {1, 3}, {-1, 3}, {-1, 1}, {-3, 1}, {-3, -1}, {-1, -1}, {-1, -3}, {1, -3}}},
	[CONCAVE_STAR] = {10,
		{{1, 0}, {0.32f, 0.24f}, {0.31f, 0.95f}, {-0.12f, 0.38f}, {-0.81f, 0.59f}, {-0.4f, 0}, {-0.81f, -0.59f}, {-0.12f, -0.38f}, {0.31f, -0.95f},
			{0.32f, -0.24f}}},
	[CONCAVE_HOOK] = {8, {{0, 0}, {4, 0}, {4, 6}, {3, 6}, {3, 1}, {1, 1}, {1, 2.5f}, {0, 3}}},
	[CONCAVE_ARROW] = {4, {{0, -1}, {3, 2}, {0, 0.5f}, {-2, 2}}},
	[CONCAVE_COMB] = {12, {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {1, 3}, {1, 4}, {4, 4}, {4, 5}, {0, 5}}},
};

static void centre_of(const carom_vec2 *at, uint32_t count, double *x, double *y)
{
	double area = 0.0;
	*x = *y = 0.0;
	for (uint32_t i = 0; i < count; i++) {
		const carom_vec2 a = at[i], b = at[(i + 1) % count];
		const double twice = (double)a.x * (double)b.y - (double)a.y * (double)b.x;
		area += twice;
		*x += twice * ((double)a.x + (double)b.x) / 3.0;
		*y += twice * ((double)a.y + (double)b.y) / 3.0;
	}
	*x /= area;
	*y /= area;
}

carom_body_def concave_outline(const carom_vec2 *vertices, uint32_t count)
{
	carom_body_def def = carom_default_body_def();
	double x, y;
	centre_of(vertices, count, &x, &y);
	def.shape = CAROM_POLYGON;
	def.vertices = vertices;
	def.vertex_count = count;
	def.position = (carom_vec2){(float)x, (float)y};
	return def;
}

static void scale(const shape *from, double radius, carom_vec2 *to)
{
	double x, y, bound = 0.0;
	centre_of(from->at, from->count, &x, &y);
	for (uint32_t i = 0; i < from->count; i++)
		bound = fmax(bound, hypot((double)from->at[i].x - x, (double)from->at[i].y - y));
	for (uint32_t i = 0; i < from->count; i++)
		to[i] = (carom_vec2){(float)(((double)from->at[i].x - x) * radius / bound), (float)(((double)from->at[i].y - y) * radius / bound)};
}

carom_body_def concave_body(concave_kind kind, int size)
{
	static carom_vec2 scaled[CONCAVE_KINDS][CONCAVE_SIZES][MOST];
	carom_vec2 *vertices = scaled[kind][size];
	carom_body_def def = carom_default_body_def();
	scale(&shapes[kind], 0.5 - 0.05 * size, vertices);
	def.shape = CAROM_POLYGON;
	def.vertices = vertices;
	def.vertex_count = shapes[kind].count;
	return def;
}

void concave_bodies(scenery_random *random, size_t count, float pitch, float speed, carom_body_def *defs)
{
	scenery_bodies(random, SCENERY_MIXED, count, pitch, speed, defs);
	for (size_t i = 0; i < count; i++) {
		if (scenery_uniform(random, 0.0f, 1.0f) < 0.4f)
			continue;
		const int kind = (int)scenery_uniform(random, 0.0f, (float)CONCAVE_KINDS), size = (int)scenery_uniform(random, 0.0f, (float)CONCAVE_SIZES);
		const carom_body_def shape_def = concave_body((concave_kind)kind, size);
		defs[i].shape = CAROM_POLYGON;
		defs[i].vertices = shape_def.vertices;
		defs[i].vertex_count = shape_def.vertex_count;
		defs[i].sides = 0;
	}
}

double concave_overlap(carom_world *world, double most)
{
	const uint32_t count = (uint32_t)carom_world_body_count(world);
	exact_body *bodies = calloc(count, sizeof *bodies);
	bool *is_dynamic = calloc(count, sizeof *is_dynamic);
	double deepest = 0.0;
	assert_true(bodies && is_dynamic);
	for (uint32_t i = 0; i < count; i++) {
		carom_body_info info;
		carom_error error;
		scenery_check(carom_world_get_body(world, i, &info, &error), &error);
		is_dynamic[i] = !info.is_static && !info.is_kinematic;
		bodies[i] = exact_of(world, i);
		for (uint32_t k = 0; k < i; k++) {
			const exact_body *a = &bodies[i], *b = &bodies[k];
			if ((!is_dynamic[i] && !is_dynamic[k]) || hypot(a->x - b->x, a->y - b->y) > a->bound + b->bound)
				continue;
			const double deep = -exact_distance(a, b, 0.0);
			if (deep > most)
				print_message("%u and %u overlap by %.3g m\n", (unsigned)i, (unsigned)k, deep);
			deepest = fmax(deepest, deep);
		}
	}
	free(bodies);
	free(is_dynamic);
	return deepest;
}
