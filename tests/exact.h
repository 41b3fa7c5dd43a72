/* The first contact of two bodies in a step, by brute force and in double precision: what the toi slot is judged by.
 * Nothing here is shared with the library but the bodies' numbers.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_EXACT_H
#define CAROM_TESTS_EXACT_H

#include "carom.h"

/* A body in a step that is 1 long: velocities in metres and radians a step, accelerations a step a step. */
typedef struct exact_body {
	uint32_t count;                        /* corners; 1 for a circle */
	double corners[CAROM_MAX_VERTICES][2]; /* about the centre of mass; a circle's is (0, 0) */
	double normals[CAROM_MAX_VERTICES][2]; /* outward, of the faces from each corner to the next */
	bool is_concave;                       /* a polygon that is not convex: its distances are those of outlines (outline.h) */
	double radius;                         /* of a circle, 0 for a polygon */
	double bound;                          /* of the circle about the centre of mass that holds the body */
	double x, y, vx, vy, ax, ay, angle, w, b;
} exact_body;

/* The body of a world, as a step of the world's time_step will move it. */
exact_body exact_of(carom_world *world, uint32_t index);

/* How far apart they are at t; below 0 where they overlap: minus the depth, by the face that separates best. */
double exact_distance(const exact_body *a, const exact_body *b, double t);

/* No point of one moves faster against a point of the other, in metres a step. */
double exact_fastest(const exact_body *a, const exact_body *b);

/* How near a corner of the one is to a corner of the other at t; infinite where one is a circle. */
double exact_corners(const exact_body *a, const exact_body *b, double t);

typedef struct exact_contact {
	double least; /* the least distance seen; where it is below `band`, the least there is within a quarter of `band` */
	double near;  /* time at which they first are within `band`; infinite if they never are, like the next ones */
	double time;  /* at which they first touch */
	double speed; /* m a step, at which they approach then */
	double deep;  /* time at which they first overlap by `band` */
} exact_contact;

/* From the start to `end`, or until they overlap by more than `band`. The samples lie so close that between two of them the
 * distance can't get from above `band` to below it. */
exact_contact exact_search(const exact_body *a, const exact_body *b, double band, double end);

#endif
