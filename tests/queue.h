/* A serial queue of events over plain numbers, in double precision: what the step events is judged by. It looks at every pair,
 * answers the first hit, and looks again. Nothing here is shared with the library but the bodies' numbers and the rules' constants.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_QUEUE_H
#define CAROM_TESTS_QUEUE_H

#include "scenery.h"
#include "touch.h"

enum { WALLS = 4 };

typedef struct queue_body {
	exact_body at;  /* between steps in m and s; in a step in parts of it, as it was at `time` */
	double push[3]; /* m/s^2, m/s^2, rad/s^2 */
	double inverse_mass, inverse_inertia, restitution, friction;
	double damping, angular_damping; /* 1/s */
	uint32_t categories, mask;
	double time;     /* part of the step */
	uint32_t events; /* of this step, */
	uint32_t rapid;  /* and of these, which came soon after the one before */
	uint32_t stuck;  /* of the last ones, rapid and slow */
	bool held;
} queue_body;

/* One hit: of two bodies, row > column, or of a body and wall -1 - column. */
typedef struct queue_hit {
	double time; /* part of the step */
	int row, column;
} queue_hit;

typedef struct queue {
	size_t count;
	queue_body *bodies;
	touch_room room;
	double friction;        /* of the walls */
	double gravity, weight; /* its size, and what that makes of a speed in the step */
	double *next;           /* the hit of row and column; a body's hits with walls come before, from column -4 on */
	queue_hit *hits;        /* of the last step */
	size_t hit_count, hit_room;
	size_t held;               /* bodies that were, in the last step */
	size_t ruled;              /* its hits that were answered otherwise than by their restitution */
	scenery_random *shaken_by; /* NULL: nobody; else each event shakes its bodies by `rounding` */
	double rounding;
	double skin; /* part of CONTRACT's slop: what is nearer touches; 0 unless it is changed */
} queue;

/* The world's bodies as they are now. */
queue *queue_of(carom_world *world);
queue *queue_copy(const queue *other);
void queue_destroy(queue *q);

/* Takes the places and velocities of the world's bodies again. */
void queue_follow(queue *q, carom_world *world);
/* Moves all by a random part, at most `relative`, of how large the numbers are: what rounding might do. */
void queue_shake(queue *q, scenery_random *random, double relative);
void queue_shake_body(exact_body *k, scenery_random *random, double relative);

/* A step of `length` s; fails the test if it has more than `most` events. */
void queue_step(queue *q, double length, size_t most);

double queue_kinetic_energy(const queue *q);
/* Along x, axis 0, or y, of bodies that are all dynamic. */
double queue_momentum(const queue *q, int axis);

#endif
