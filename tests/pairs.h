/* Many pairs of bodies in one world, each looked at alone: body 2 k + 1 against body 2 k, whatever else is in their way.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_PAIRS_H
#define CAROM_TESTS_PAIRS_H

#include "exact.h"
#include "scenery.h"

enum { PAIRS_AT_ONCE = 128, PAIRS_BODIES = 2 * PAIRS_AT_ONCE };

/* What aabb, overlap and toi made of a pair. */
typedef struct pairs_hit {
	bool boxes_overlap;
	bool done;   /* else only a pause */
	double time; /* part of the step; above 1 for none */
} pairs_hit;

/* A world for pairs; NULL where there is no such device. */
carom_world *pairs_world(const char *toi, const scenery_device *device);
/* The same in double precision. */
carom_world *pairs_oracle(const char *toi);

/* Empties the world, puts `count` bodies into it and finds the pairs' hit times in the step that begins. */
void pairs_find(carom_world *world, bool is_oracle, const carom_body_def *bodies, size_t count, pairs_hit *hits);

/* Random pairs, their vertices too. */
typedef struct pairs_batch {
	carom_body_def bodies[PAIRS_BODIES];
	carom_vec2 vertices[PAIRS_BODIES][8];
} pairs_batch;

/* What two bodies mostly do in the step. */
typedef enum pairs_kind {
	PAIRS_TOUCHING, /* they touch; two of five only just or only just not */
	PAIRS_PASSING   /* polygons that pass each other, at any distance; one of five touches */
} pairs_kind;

/* Circles, triangles to octagons, irregular polygons and thin boxes, slow and fast, turning and not, some accelerated and
 * some against a static one. `world` is for measuring them. */
void pairs_random(scenery_random *random, pairs_kind kind, carom_world *world, pairs_batch *batch);

#endif
