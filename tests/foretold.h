/* Worlds that run the step events, held against the serial queue on every device: as many hits in each step, and everybody where the queue has them.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_FORETOLD_H
#define CAROM_TESTS_FORETOLD_H

#include "scenery.h"

/* A world to be; what is printed calls it by its name. */
typedef struct foretold_scene {
	const char *name;
	const carom_world_def *def;
	const carom_body_def *bodies;
	size_t count;
	bool counts; /* hits, too: but how many are those of bodies that don't bounce, and stay in touch, rounding decides */
} foretold_scene;

/* From one start, until chaos has made the forecast worthless, or for so many steps. Gives how many hits were foretold on the device where it was fewest. */
uint64_t foretold_run(const foretold_scene *s, uint64_t steps);
/* Each step by itself, from where the library is: so thousands of hits can be foretold. All devices are where the first one is. Gives the hits likewise. */
uint64_t foretold_follow(const foretold_scene *s, uint64_t steps);

#endif
