/* Polygons, most of them not convex, for the tests of rendering.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_SILHOUETTES_H
#define CAROM_TESTS_SILHOUETTES_H

#include "carom.h"

#include <math.h>
#include <string.h>

enum { SILHOUETTES = 8 };

static inline carom_vec2 silhouette_polar(double radius, double angle)
{
	return (carom_vec2){(float)(radius * cos(angle)), (float)(radius * sin(angle))};
}

/* Points by turns so far out and so far in. */
static inline uint32_t silhouette_star(uint32_t points, double inner, carom_vec2 *v)
{
	for (uint32_t k = 0; k < 2 * points; k++)
		v[k] = silhouette_polar(k % 2 ? inner : 1.0, 3.14159265358979 * k / points);
	return 2 * points;
}

static inline uint32_t silhouette_gear(carom_vec2 *v)
{
	static const double part[4] = {0.0, 0.2, 0.5, 0.7}, radius[4] = {0.8, 1.0, 1.0, 0.8};
	for (uint32_t k = 0; k < 64; k++)
		v[k] = silhouette_polar(radius[k % 4], 6.28318530717958 * (k / 4 + part[k % 4]) / 16);
	return 64;
}

/* Teeth as broad as that, and a back. */
static inline uint32_t silhouette_comb(float tooth, carom_vec2 *v)
{
	uint32_t count = 0;
	v[count++] = (carom_vec2){0, 0};
	v[count++] = (carom_vec2){2, 0};
	for (int k = 15; k >= 0; k--) {
		const float left = (2 - tooth) * (float)k / 15;
		if (k < 15)
			v[count++] = (carom_vec2){left + tooth, 0.3f};
		v[count++] = (carom_vec2){left + tooth, 1.6f};
		v[count++] = (carom_vec2){left, 1.6f};
		if (k > 0)
			v[count++] = (carom_vec2){left, 0.3f};
	}
	return count;
}

static inline uint32_t silhouette_spiral(carom_vec2 *v)
{
	for (uint32_t k = 0; k < 32; k++) {
		const double angle = 0.5 * k, radius = 0.2 + 0.8 * k / 31;
		v[k] = silhouette_polar(radius, angle);
		v[63 - k] = silhouette_polar(radius - 0.1, angle);
	}
	return 64;
}

/* Of shape number k, some 2 m wide; `v` has room for CAROM_MAX_VERTICES. */
static inline uint32_t silhouette_vertices(uint32_t k, carom_vec2 *v)
{
	static const carom_vec2 flat[5] = {{-1, -1}, {0.3f, -1}, {1, -1}, {1, 1}, {-1, 1}}; /* convex, with a vertex within a side */
	static const carom_vec2 l[6] = {{0, 0}, {2, 0}, {2, 0.6f}, {0.6f, 0.6f}, {0.6f, 2}, {0, 2}};
	static const carom_vec2 u[8] = {{0, 0}, {2, 0}, {2, 2}, {1.5f, 2}, {1.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 2}, {0, 2}};
	switch (k) {
	case 0: return memcpy(v, l, sizeof l), 6;
	case 1: return memcpy(v, u, sizeof u), 8;
	case 2: return silhouette_star(5, 0.4, v);
	case 3: return silhouette_star(12, 0.55, v);
	case 4: return silhouette_gear(v);
	case 5: return silhouette_comb(0.06f, v);
	case 6: return memcpy(v, flat, sizeof flat), 5;
	default: return silhouette_spiral(v);
	}
}

static inline carom_body_def silhouette_body(uint32_t k, carom_vec2 *v, float x, float y, float angle)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_POLYGON;
	def.vertices = v;
	def.vertex_count = silhouette_vertices(k, v);
	def.position = (carom_vec2){x, y};
	def.angle = angle;
	return def;
}

/* So many on a grid about the origin, some static. */
static inline carom_status silhouette_add(carom_world *world, uint32_t count, float pitch, carom_error *error)
{
	for (uint32_t k = 0; k < count; k++) {
		carom_vec2 v[CAROM_MAX_VERTICES];
		carom_body_def def = silhouette_body(k % SILHOUETTES, v, pitch * ((float)(k % 5) - 2), pitch * ((float)(k / 5 % 3) - 1), 0.37f * (float)k);
		def.is_static = k % 4 == 3;
		const carom_status status = carom_world_add(world, &def, 1, NULL, error);
		if (status)
			return status;
	}
	return CAROM_OK;
}

#endif
