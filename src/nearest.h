/* Which body is nearest to a point.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_NEAREST_H
#define CAROM_NEAREST_H

#include "crowd.h"

/* A body's point that is nearest, and the normal from there; of a body that the point is in this point, and no normal. */
typedef struct carom_closest {
	double distance, x, y, normal_x, normal_y;
	int32_t body; /* -1 for none */
} carom_closest;

/* Of bodies that are no farther than `within`; of equally near ones that with the lowest index. */
carom_closest carom_find_closest(const carom_crowd *crowd, double x, double y, double within);

#endif
