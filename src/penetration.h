/* How deep bodies overlap.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PENETRATION_H
#define CAROM_PENETRATION_H

#include "crowd.h"

/* The separation of two bodies, negative where they overlap: the distance by which the nearest face, or corner, tells them apart; of polygons that are not convex, that of the two of their pieces that overlap the
 * most. It may be any number not below `enough` where it is that or more. */
double carom_separation(const carom_placed *a, const carom_placed *b, double enough);

/* The deepest overlap of two bodies that may hit each other, or of a body that is not static and a wall of the room; 0 if
 * nothing overlaps. The crowd is of that world. */
double carom_deepest_penetration(const carom_crowd *crowd, const carom_world *world);

#endif
