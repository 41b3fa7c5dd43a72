/* When a disc, a point or a polygon that moves straight ahead, without turning, meets a body that stands.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_RAY_H
#define CAROM_RAY_H

#include "crowd.h"

/* From (x, y) to (x + along_x, y + along_y). */
typedef struct carom_way {
	double x, y, along_x, along_y;
	double radius;            /* of the disc, or of the circle that encloses the body */
	const carom_placed *body; /* that moves, where the way begins; NULL for a disc, or a point, that meets all there is */
} carom_way;

/* The part of the way, and the normal from what is met to what moves. */
typedef struct carom_meeting {
	double part, normal_x, normal_y;
} carom_meeting;

/* False if they do not meet on the way, or touch as it begins. */
bool carom_ray_meets_body(const carom_way *way, const carom_placed *body, carom_meeting *meeting);
/* The same for a wall; the normal points to the side of it that is free, and offset is its dot with any point of the wall. */
bool carom_ray_meets_wall(const carom_way *way, double normal_x, double normal_y, double offset, carom_meeting *meeting);
/* Where they touch then; `other` is NULL for a wall. */
void carom_ray_touches(const carom_way *way, const carom_placed *other, const carom_meeting *meeting, double *x, double *y);

#endif
