/* A polygon that is being cut: its pieces are rings of sides. */
#ifndef CAROM_PIECES_RINGS_H
#define CAROM_PIECES_RINGS_H

#include <math.h>

#include "pieces.h"
#include "point.h"

/* A side of a piece, from its beginning to that of the next one. */
typedef struct side {
	point from;
	uint32_t next;
	bool is_cut;   /* it is none of the polygon's, but */
	uint32_t twin; /* one way of a cut whose other way this side is */
} side;

typedef struct cutting {
	const point *outline;
	uint32_t count; /* of the outline's vertices */
	side sides[CAROM_MOST_PIECE_VERTICES];
	uint32_t side_count;
	bool is_gone[CAROM_MOST_PIECE_VERTICES]; /* sides of no piece any more */
} cutting;

static inline point at(const cutting *all, uint32_t k)
{
	return all->sides[k].from;
}

static inline uint32_t after(const cutting *all, uint32_t k)
{
	return all->sides[k].next;
}

static inline uint32_t before(const cutting *all, uint32_t k)
{
	uint32_t at_side = k;
	while (after(all, at_side) != k)
		at_side = after(all, at_side);
	return at_side;
}

/* Of a side's length. */
static inline double square_of(const cutting *all, uint32_t k)
{
	const point way = minus(at(all, after(all, k)), at(all, k));
	return dot(way, way);
}

static inline bool is_same(point a, point b)
{
	return a.x == b.x && a.y == b.y;
}

/* Above 0 where it turns to the left at b. */
static inline double turn_at(point a, point b, point c)
{
	return cross(minus(b, a), minus(c, b));
}

#define STRAIGHT 1e-6 /* the sine of a turn that rounding makes */

/* Is b a vertex within a side? */
static inline bool is_straight(point a, point b, point c)
{
	const point to_b = minus(b, a), to_c = minus(c, b);
	return !(turn_at(a, b, c) > STRAIGHT * sqrt(dot(to_b, to_b) * dot(to_c, to_c)));
}

/* From the polygon alone, as one ring, to convex pieces. */
void carom_rings_cut(cutting *all);
/* They grow over their cuts, as far as they stay convex and within the polygon. */
void carom_rings_grow(cutting *all);

#endif
