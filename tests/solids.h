/* Bodies of a world as the tests see them, by answers that know nothing of grids: how far one is from another, which along a straight way falls and then rises.
 * SPDX-License-Identifier: MIT */
#ifndef SOLIDS_H
#define SOLIDS_H

#include "runs.h"

#define SOLIDS_SURE 1e-7 /* m: closer to touching than that two ways of counting may differ */

/* A circle, or with corners a polygon, counter-clockwise. */
typedef struct solid {
	double x, y, radius;
	double corners[CAROM_MAX_VERTICES][2];
	uint32_t count;
} solid;

/* That of a world. */
solid solids_of(carom_world *world, uint32_t index);

/* The same elsewhere. */
solid solids_moved(const solid *s, double x, double y);

/* From a point; negative inside. */
typedef double solids_measure(const solid *s, double x, double y);
solids_measure solids_distance;
/* From another, likewise. */
double solids_gap(const solid *a, const solid *b);
/* The same by such a measure, which is asked of corners, of polygons that don't overlap. */
double solids_nearest(const solid *a, const solid *b, solids_measure *distance);

/* Which part of its way, (along_x, along_y), one has gone when it meets what stands: 2 for never, -1 where that is not sure. */
typedef double solids_way(const solid *stands, const solid *moves, double along_x, double along_y);
solids_way solids_meeting;

/* So many bodies on the CPU fallback, without a room: half of them of sizes from 1 to 1,000, all over each other, the others of about one size in the middle. */
enum { SOLIDS_COUNT = 150 };
carom_world *solids_wild(scenery_random *random, solid solids[SOLIDS_COUNT]);
/* A place among them, or near. */
carom_vec2 solids_somewhere(scenery_random *random);
/* What of so many that stand is met first, or CAROM_NOTHING, and when, likewise; it is not sure, either, where something else is met at about that time. */
double solids_first(const solid *stand, int32_t count, solids_way *meeting, const solid *moves, double along_x, double along_y, int32_t *other);

#endif
