/* Many bodies in a square room, no two touching: what `carom generate` writes.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PLACEMENT_H
#define CAROM_PLACEMENT_H

#include "carom_tool.h"

#define MAX_PLACED 4194304u

struct placement_def {
	bool mixed;     /* circles and regular polygons of 3 to 6 sides in turn */
	uint32_t sides; /* of all bodies if not mixed; 0 for circles, and for stars of so many */
	uint32_t points;
	uint32_t count; /* 1..MAX_PLACED */
	double fill;    /* area of the bodies / area of the room, > 0 */
	double speed;   /* each velocity component is uniform in [-speed, speed] m/s, the angular velocity in rad/s */
	double radius;  /* m, of circles and of the circles around polygons */
	uint64_t seed;
};

/* The same bodies on every machine: made with + - * / and square roots alone. *bodies is an array of def->count, to be
 * freed, with what its pointers point to, in an order that has nothing to do with their places; the room reaches from -*half to *half, m, both ways.
 * CAROM_INVALID_ARGUMENT: so much can't be packed, or the room gets too large for floats. */
carom_status placement_create(const struct placement_def *def, carom_body_def **bodies, float *half, carom_error *error);

/* ---- The parts of it */

struct point {
	double x, y; /* m */
};

/* SplitMix64 (Steele, Lea, Flood 2014): small, and good enough to place bodies. */
struct random {
	uint64_t state;
};

static inline uint64_t random_bits(struct random *random)
{
	uint64_t bits = random->state += 0x9E3779B97F4A7C15u;
	bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9u;
	bits = (bits ^ bits >> 27) * 0x94D049BB133111EBu;
	return bits ^ bits >> 31;
}

/* Uniform in [-1, 1). */
static inline double random_signed(struct random *random)
{
	return (double)(random_bits(random) >> 11) * 0x1p-52 - 1;
}

/* Uniform in 0..bound - 1; the bias for a bound of 2^22 is 2^-10 of a part in a million. */
static inline uint32_t random_below(struct random *random, uint32_t bound)
{
	return (uint32_t)((random_bits(random) >> 32) * bound >> 32);
}

/* Puts `count` points on the lattice that keeps them farthest apart in [-half, half] x [-half, half], row by row, and answers
 * that distance (infinite for one point). `points` may be NULL. */
double lattice_fill(struct point *points, uint32_t count, double half, struct random *random);

/* Moves points at random by up to `reach` in each direction, none nearer to another than `distance` nor out of the square.
 * False if there is no memory. */
bool shake(struct point *points, uint32_t count, double half, double distance, double reach, struct random *random);

#endif
