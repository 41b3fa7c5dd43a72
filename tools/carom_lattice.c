/* Points spread as evenly as a lattice can.
 * SPDX-License-Identifier: MIT */
#include "carom_placement.h"

#include <math.h>

struct lattice {
	uint32_t rows, columns;
	double shift;      /* of every other row, in columns */
	double across, up; /* m, from column to column and from row to row */
	double spacing;    /* m, between the closest two points */
};

static struct lattice make_lattice(uint32_t count, uint32_t rows, double shift, double side)
{
	struct lattice made = {.rows = rows, .columns = (count + rows - 1) / rows, .shift = rows > 1 ? shift : 0};
	double columns = (double)made.columns - 1 + made.shift;
	made.across = columns > 0 ? side / columns : 0;
	made.up = rows > 1 ? side / (rows - 1) : 0;
	double aside = made.shift * made.across;
	double in_row = made.columns > 1 ? made.across : INFINITY;
	double next_row = rows > 1 ? sqrt(aside * aside + made.up * made.up) : INFINITY;
	double row_after = rows > 2 ? 2 * made.up : INFINITY;
	made.spacing = in_row < next_row ? in_row : next_row;
	if (row_after < made.spacing)
		made.spacing = row_after;
	return made;
}

/* Square and triangular lattices of every number of rows that could be the best. */
static struct lattice find_lattice(uint32_t count, double side)
{
	uint32_t most = (uint32_t)(2 * sqrt(count)) + 2;
	struct lattice best = make_lattice(count, 1, 0, side);
	for (uint32_t rows = 2; rows <= most && rows <= count; rows++) {
		for (int shifted = 0; shifted < 2; shifted++) {
			struct lattice other = make_lattice(count, rows, shifted ? 0.5 : 0, side);
			if (other.spacing > best.spacing)
				best = other;
		}
	}
	return best;
}

static struct point lattice_point(const struct lattice *lattice, uint32_t row, uint32_t column, double half)
{
	struct point point = {0, 0};
	if (lattice->across > 0)
		point.x = (column + (row & 1 ? lattice->shift : 0)) * lattice->across - half;
	if (lattice->up > 0)
		point.y = row * lattice->up - half;
	return point;
}

/* A lattice seldom has just as many points: which stay empty is drawn by lot, each with the same chance. */
double lattice_fill(struct point *points, uint32_t count, double half, struct random *random)
{
	struct lattice lattice = find_lattice(count, 2 * half);
	uint32_t left = lattice.rows * lattice.columns, wanted = count;
	if (!points)
		return lattice.spacing;
	for (uint32_t row = 0; row < lattice.rows; row++) {
		for (uint32_t column = 0; column < lattice.columns; column++, left--) {
			if (random_below(random, left) >= wanted)
				continue;
			*points++ = lattice_point(&lattice, row, column, half);
			wanted--;
		}
	}
	return lattice.spacing;
}
