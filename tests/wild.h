/* Worlds that nobody would make: tiny bodies that torques spin up to millions of rad/s, others at hundreds of m/s, forces of their own.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_WILD_H
#define CAROM_TESTS_WILD_H

#include "scenery.h"

enum {
	WILD_SIDE = 24,
	WILD_MOST = WILD_SIDE * WILD_SIDE + 1,
	WILD_WATCHERS = 400,
	WILD_OUTLINES = 8,
	WILD_CORNERS = 9,
	WILD_HOLLOWS = 4,
	WILD_JOINTS = 3 * WILD_MOST
};

/* `bodies` point into `outlines`. */
typedef struct wild_world {
	carom_world_def def;
	uint32_t count;
	carom_body_def bodies[WILD_MOST + WILD_WATCHERS];
	carom_vec2 outlines[WILD_OUTLINES][WILD_CORNERS], hollows[WILD_HOLLOWS][WILD_CORNERS];
	size_t joint_count;
	carom_joint joints[WILD_JOINTS];
} wild_world;

/* From 0 up to below the end, each as likely; and true as often as once in so many times. */
uint32_t wild_below(scenery_random *random, uint32_t end);
bool wild_one_in(scenery_random *random, uint32_t many);

/* Up to 64 circles and regular polygons on a lattice in a room, which may be far from the origin. */
void wild_make(uint64_t seed, wild_world *world);
/* Of any size, by other rules, among them irregular polygons, also such as are not convex, and one large body, with walls or without, or one fast body among others that rest, or rows that exactly fill their room; and in
 * one of three with the step contacts joints of all kinds, few or a net of them. */
void wild_make_wider(uint64_t seed, wild_world *world);
/* Many that nothing happens to, so that those in hits are few: only then bodies do not look at each other in each step. */
void wild_add_watchers(wild_world *world);
/* NULL where there is no such device. */
carom_world *wild_create(const wild_world *world, const scenery_device *device);

/* Joints between neighbours of its lattice, and between some bodies and the ground; none, mostly. */
void wild_join(uint64_t seed, wild_world *world);

/* Before the step of that number bodies are steered, go and come, or what holds for all changes; `time_step` is the first one. */
void wild_change(carom_world *world, uint32_t step, float time_step);

#endif
