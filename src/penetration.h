/* How deep bodies overlap, for carom_world_measure.
 *
 * The overlap is looked for in grids, one for each size of bodies (a factor of two), whose cells are as large as the
 * bodies in them: a body meets those of its own grid and of the coarser ones, so that neither one huge body nor a wide
 * range of sizes makes the search quadratic.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PENETRATION_H
#define CAROM_PENETRATION_H

#include "carom.h"

/* A vertex in world coordinates and the edge from it to the next: outward normal, and the normal's dot with the vertex. */
typedef struct carom_corner {
	double x, y, normal_x, normal_y, at;
} carom_corner;

typedef struct carom_placed {
	double x, y, radius;               /* of the circle that encloses the body */
	double min_x, min_y, max_x, max_y; /* its box */
	const carom_corner *corners;       /* NULL for a circle */
	uint32_t corner_count, level;
	bool is_static;
} carom_placed;

/* Places a body of `body->vertex_count` vertices. Returns how many of `corners`, which `at` keeps, it took. */
uint32_t carom_place_body(carom_placed *at, const carom_body_info *body, const carom_body_state *state, carom_corner *corners);

/* The deepest overlap of two bodies that are not both static, or of a body that is not static and a wall of the room; 0 if
 * nothing overlaps. Sets the bodies' levels. */
carom_status carom_deepest_penetration(carom_placed *bodies, size_t count, const carom_world_def *def, double *deepest, carom_error *error);

#endif
