/* Where a joint's anchors are. */
#ifndef CAROM_ANCHOR_H
#define CAROM_ANCHOR_H

#include "angle.h"
#include "carom.h"

/* m; of a place in the world `body` is NULL. */
static inline void carom_anchor_place(const carom_body_state *body, carom_vec2 anchor, double *x, double *y)
{
	double sine = 0, cosine = 1;
	if (body)
		carom_sincos((double)body->angle, &sine, &cosine);
	*x = (body ? (double)body->position.x : 0) + (cosine * (double)anchor.x - sine * (double)anchor.y);
	*y = (body ? (double)body->position.y : 0) + (sine * (double)anchor.x + cosine * (double)anchor.y);
}

#endif
