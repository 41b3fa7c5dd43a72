/* Polygons that are not convex, and what their tests ask of the worlds they are in.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_CONCAVE_H
#define CAROM_TESTS_CONCAVE_H

#include "scenery.h"

typedef enum concave_kind {
	CONCAVE_L,
	CONCAVE_U,
	CONCAVE_C,
	CONCAVE_CROSS,
	CONCAVE_STAR,
	CONCAVE_HOOK,
	CONCAVE_ARROW,
	CONCAVE_COMB,
	CONCAVE_KINDS
} concave_kind;

/* No vertex of it is farther from its centre of mass than 0.35 to 0.5 m, by `size`, which is one of so many. */
enum { CONCAVE_SIZES = 4 };
carom_body_def concave_body(concave_kind kind, int size);

/* Like scenery_bodies, but three of five are not convex. */
void concave_bodies(scenery_random *random, size_t count, float pitch, float speed, carom_body_def *defs);

/* The polygon that lies where its vertices are, counter-clockwise; they are not copied. */
carom_body_def concave_outline(const carom_vec2 *vertices, uint32_t count);

/* How deep any two of the bodies, of which one is dynamic, overlap, in m: 0 if none do. Which they are is told where it is more than `most`. */
double concave_overlap(carom_world *world, double most);

#endif
