/* When, where and how fast two bodies touch, or a body and a wall of the room: in double precision, and by other means than the library's.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_TOUCH_H
#define CAROM_TESTS_TOUCH_H

#include "exact.h"

/* Seen from the reference body to the incident one. */
typedef struct touch {
	double normal[2];
	int count;              /* of points: 2 where a face lies on a face */
	double reference[2][2]; /* of each point: from the reference body's centre, */
	double incident[2][2];  /* and from the incident one's */
	double rate[2];         /* m a step, below 0: they approach */
	bool swapped;           /* the second body is the reference */
} touch;

/* Walls as the library counts them: x = min, y = min, x = max, y = max. */
typedef struct touch_room {
	bool is_there;
	double min[2], max[2];
	double restitution;
} touch_room;

/* To what it is at t. */
void touch_move(exact_body *k, double t);

/* How the bodies touch as they are now; if they don't, how they would. */
touch touch_pair(const exact_body *a, const exact_body *b);
touch touch_wall(const exact_body *k, const touch_room *room, int wall);

/* The slowest approach that counts as one: CONTRACT's stillness, a rule and no rounding. */
double touch_stillness(const exact_body *a, const exact_body *b);

/* When they first touch and approach, from now to `end`; infinite if they don't. What is nearer than `skin`, a part of CONTRACT's
 * slop, touches, but for two circles in straight lines and a circle and a wall. */
double touch_pair_time(const exact_body *a, const exact_body *b, double skin, double end);
double touch_wall_time(const exact_body *k, const touch_room *room, int wall, double skin, double end);

#endif
