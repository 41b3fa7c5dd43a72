/* Other engines that `carom bench` measures beside Carom, in scale, tunnel, heap and rays. Each is known to one file, carom_peer_<name>.c or .cpp; where
 * its library is not installed, without_<name>.c stands for that file. Only the command is linked with them.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PEER_H
#define CAROM_PEER_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Circles and polygons in a room. */
struct peer_scene {
	size_t count;
	const carom_body_info *bodies;  /* `count` of them */
	const carom_body_state *states; /* as many */
	carom_vec2 room_min, room_max;  /* m */
	carom_vec2 gravity;             /* m/s^2 */
	float restitution, friction;    /* of the walls */
	float time_step;                /* s */
	bool bullets;                   /* where the engine can look for hits between moving bodies continuously, it does */
};

/* An engine. It runs on one core, as its package was compiled, with what it takes by itself unless `settings` says so. */
struct peer {
	const char *name;
	const char *settings;         /* a line; where the engine is not in this build, how to get it */
	const char *(*version)(void); /* NULL: the engine is not in this build, nor are the functions below */
	/* A world of the same bodies: masses, inertias, states and restitution are theirs, a pair has the mean of
	 * its frictions that Carom takes, none ever sleeps, the walls
	 * are static boxes. NULL: there is no memory. */
	void *(*create)(const struct peer_scene *scene);
	void (*step)(void *world);
	/* Of all bodies, in the order of the scene; angles may be of any size. */
	void (*get_states)(const void *world, carom_body_state *states);
	/* The body that a ray meets first; below 0 for a wall, and for nothing. */
	int32_t (*cast)(const void *world, carom_vec2 from, carom_vec2 to);
	void (*destroy)(void *world); /* may be NULL */
};

extern const struct peer peer_box2d, peer_chipmunk;

#define PEER_WALL 50.0f /* m, thickness: twice what any body gets on in a step, or it would be pushed out on the far side */

#ifdef __cplusplus
}
#endif

#endif
