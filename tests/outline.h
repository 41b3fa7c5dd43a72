/* Two bodies of which one at least is a polygon that is not convex, by their outlines: how far apart they are, and how they touch. In double precision, and without
 * the pieces that the library cuts such polygons into: what touches is a vertex of the one and a side of the other.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_OUTLINE_H
#define CAROM_TESTS_OUTLINE_H

#include "touch.h"

/* As they are now; below 0 where they overlap: minus how deep a vertex of the one, or the circle's centre, lies in the other, or how far sides that cross are from not doing so. */
double outline_distance(const exact_body *a, const exact_body *b);

/* Like touch_pair, but without the rates. Where they touch in several places it is along the normal of the one that approaches fastest: there are as
 * many points as lie along such a normal, but the two outermost ones are enough. What is nearer than the least gap and `slop` touches. */
touch outline_touch(const exact_body *a, const exact_body *b, double slop);

#endif
