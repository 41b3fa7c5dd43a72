/* The bodies of a world in their places, in double precision, and the grids in which those near a place are found.
 *
 * There is a grid for each size of bodies (a factor of two), whose cells are as large as the bodies in them or larger: neither one huge body nor a wide
 * range of sizes makes a search look at all.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_CROWD_H
#define CAROM_CROWD_H

#include "carom.h"
#include "pieces.h"

#define CAROM_GRIDS 24               /* sizes told apart; the smallest bodies, from 2^-23 of the largest on, share one grid */
#define CAROM_GRID_ROUNDING 1.000001 /* radii are floats, and may be a little smaller than what they enclose */

/* A vertex in world coordinates and the edge from it to the next: outward normal, and the normal's dot with the vertex. */
typedef struct carom_corner {
	double x, y, normal_x, normal_y, at;
} carom_corner;

typedef struct carom_placed {
	double x, y, radius;               /* of the circle that encloses the body */
	double min_x, min_y, max_x, max_y; /* its box */
	const carom_corner *corners;       /* NULL for a circle */
	const struct carom_placed
		*pieces; /* of a polygon that is not convex: convex ones, of which corners and box alone are known, that together are it; else NULL */
	uint32_t categories, mask;
	uint8_t corner_count, piece_count;
	uint8_t level; /* its grid; CAROM_GRIDS: it is nowhere, for a number of it is not finite, or it is not asked for */
	bool is_dynamic;
} carom_placed;

/* Where corners and pieces go. */
typedef struct carom_parts {
	carom_corner *corners;
	carom_placed *pieces;
} carom_parts;

/* The bodies of one size by cell: those of cell k are members[starts[k]] to members[starts[k + 1] - 1]. */
typedef struct carom_grid {
	double x, y, cell, radius; /* the first cell's corner, a cell's side, the largest body's radius, rounded up */
	uint32_t columns, rows, count;
	uint32_t *members, *starts;
} carom_grid;

typedef struct carom_crowd {
	size_t count;
	carom_placed *bodies;
	carom_parts parts;             /* memory of the bodies' */
	carom_grid grids[CAROM_GRIDS]; /* from the largest bodies to the smallest */
	uint32_t *members, *starts;    /* memory of the grids */
} carom_crowd;

/* libm's fmin and fmax are calls; where `a` is NaN these give `b`. */
static inline double carom_least(double a, double b)
{
	return a < b ? a : b;
}

static inline double carom_most(double a, double b)
{
	return a > b ? a : b;
}

/* By their filters, may the two hit each other? */
static inline bool carom_meet(const carom_placed *a, const carom_placed *b)
{
	return (a->categories & b->mask) && (b->categories & a->mask);
}

/* Puts a body where its state says, in no grid; `pieces` are those of a polygon that is not convex, else NULL. What it takes of `parts`, which `at` keeps, is left out of them. */
void carom_place_body(carom_placed *at, const carom_body_info *body, const carom_pieces *pieces, const carom_body_state *state, carom_parts *parts);

/* Of the world as it is now, in grids those bodies that are of a category in `mask`, and all for CAROM_MASK; to be given to carom_crowd_free, whether this
 * succeeds or not. `why` is for the error: "measure". */
carom_status carom_crowd_make(carom_world *world, uint32_t mask, const char *why, carom_crowd *crowd, carom_error *error);
void carom_crowd_free(carom_crowd *crowd);

/* The cell of a coordinate among so many along one axis from `origin` on, the nearest one if it is outside: a column, or a row. */
uint32_t carom_grid_cell(const carom_grid *grid, double at, double origin, uint32_t cells);
uint32_t carom_grid_column(const carom_grid *grid, double x);
uint32_t carom_grid_row(const carom_grid *grid, double y);

#endif
