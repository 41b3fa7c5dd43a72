/* Where a straight way crosses the sides of a polygon, which need not be convex.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_CROSSING_H
#define CAROM_CROSSING_H

#include "crowd.h"

typedef struct carom_crossing {
	double part;       /* above 0: of the way, where it first gets through a side from without; HUGE_VAL for nowhere */
	uint32_t side;     /* which one */
	bool is_in, is_on; /* it begins in the polygon, on it: next to a side rounding decides */
} carom_crossing;

/* Of the way from (x, y) along a vector, and on and on. */
carom_crossing carom_cross(const carom_placed *polygon, double x, double y, double along_x, double along_y);
/* Is a point in the polygon, or on it? */
bool carom_holds(const carom_placed *polygon, double x, double y);

#endif
