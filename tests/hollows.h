/* Polygons that are not convex, and questions about any that are answered by their sides alone, in double precision: which side of them a point is on is told by how many a line
 * from there crosses.
 * SPDX-License-Identifier: MIT */
#ifndef HOLLOWS_H
#define HOLLOWS_H

#include "solids.h"

typedef enum hollow_kind { HOLLOW_STAR, HOLLOW_COMB, HOLLOW_SPIRAL, HOLLOW_KINDS } hollow_kind;

/* A random one, counter-clockwise, of about that radius, anywhere about the origin; some have vertices in the middle of their sides, which rounding moves a little. How many vertices it has. */
uint32_t hollows_make(scenery_random *random, hollow_kind kind, float radius, carom_vec2 vertices[CAROM_MAX_VERTICES]);

/* Corners where it turns to the right. */
uint32_t hollows_reflex(const carom_vec2 *vertices, uint32_t count);

/* A polygon as it was given, at the origin. */
solid hollows_solid(const carom_vec2 *vertices, uint32_t count);

/* From a point, negative inside. */
double hollows_distance(const solid *s, double x, double y);
/* From another; below 0 where they overlap, and by how much if one is a circle whose centre is outside. */
double hollows_gap(const solid *a, const solid *b);

/* Which part of its way, (along_x, along_y), one has gone when it meets what stands: 2 for never, or where it begins in it; -1 where that is not sure. */
double hollows_meeting(const solid *stands, const solid *moves, double along_x, double along_y);

/* So many bodies on the CPU fallback, without a room, all over each other: most of them are not convex. */
enum { HOLLOWS_COUNT = 60 };
carom_world *hollows_wild(scenery_random *random, solid solids[HOLLOWS_COUNT]);
/* One of them. */
carom_body_def hollows_body(scenery_random *random, carom_vec2 vertices[CAROM_MAX_VERTICES]);

#endif
