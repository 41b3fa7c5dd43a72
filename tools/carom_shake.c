/* Moves points about until the lattice they came from is forgotten: the Monte Carlo moves of hard discs (Metropolis and
 * others, 1953), with a grid of cells to find neighbours.
 * SPDX-License-Identifier: MIT */
#include "carom_placement.h"

#include <math.h>
#include <stdlib.h>

#define SWEEPS 40 /* by then the pictures show no rows at fills that leave room to move */
#define NONE UINT32_MAX

struct cells {
	double half, scale; /* a coordinate becomes a cell by (x + half) * scale */
	uint32_t side;      /* cells each way */
	uint32_t *first;    /* of each cell, or NONE */
	uint32_t *next;     /* of each point, or NONE */
};

static uint32_t cell_coordinate(const struct cells *cells, double x)
{
	double cell = (x + cells->half) * cells->scale;
	uint32_t last = cells->side - 1;
	return cell >= last ? last : cell > 0 ? (uint32_t)cell : 0;
}

static uint32_t *cell_of(const struct cells *cells, struct point at)
{
	return &cells->first[(size_t)cell_coordinate(cells, at.y) * cells->side + cell_coordinate(cells, at.x)];
}

static void link_point(struct cells *cells, uint32_t index, uint32_t *cell)
{
	cells->next[index] = *cell;
	*cell = index;
}

static void unlink_point(struct cells *cells, uint32_t index, uint32_t *cell)
{
	while (*cell != index)
		cell = &cells->next[*cell];
	*cell = cells->next[index];
}

/* A cell is at least `distance` wide, so that who is near is in the cells around; and there are about as many as points. */
static bool make_cells(struct cells *cells, const struct point *points, uint32_t count, double half, double distance)
{
	double fit = floor(2 * half / distance), enough = ceil(sqrt(count));
	cells->half = half;
	cells->side = fit < 1 ? 1 : (uint32_t)(fit < enough ? fit : enough);
	cells->scale = half > 0 ? cells->side / (2 * half) : 0;
	size_t total = (size_t)cells->side * cells->side;
	cells->first = malloc(total * sizeof *cells->first);
	cells->next = malloc(count * sizeof *cells->next);
	if (!cells->first || !cells->next)
		return false;
	for (size_t k = 0; k < total; k++)
		cells->first[k] = NONE;
	for (uint32_t k = 0; k < count; k++)
		link_point(cells, k, cell_of(cells, points[k]));
	return true;
}

static bool is_free(const struct cells *cells, const struct point *points, uint32_t mover, struct point to, double distance)
{
	uint32_t x = cell_coordinate(cells, to.x), y = cell_coordinate(cells, to.y), last = cells->side - 1;
	for (uint32_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row <= last; row++) {
		for (uint32_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column <= last; column++) {
			uint32_t other = cells->first[(size_t)row * cells->side + column];
			for (; other != NONE; other = cells->next[other]) {
				double dx = points[other].x - to.x, dy = points[other].y - to.y;
				if (other != mover && dx * dx + dy * dy < distance * distance)
					return false;
			}
		}
	}
	return true;
}

static void move_point(struct cells *cells, struct point *points, uint32_t index, struct point to)
{
	uint32_t *from_cell = cell_of(cells, points[index]), *to_cell = cell_of(cells, to);
	points[index] = to;
	if (from_cell == to_cell)
		return;
	unlink_point(cells, index, from_cell);
	link_point(cells, index, to_cell);
}

bool shake(struct point *points, uint32_t count, double half, double distance, double reach, struct random *random)
{
	struct cells cells = {.first = NULL};
	bool made = make_cells(&cells, points, count, half, distance);
	for (uint32_t sweep = 0; made && sweep < SWEEPS; sweep++) {
		for (uint32_t k = 0; k < count; k++) {
			struct point to = points[k];
			to.x += reach * random_signed(random);
			to.y += reach * random_signed(random);
			bool inside = fabs(to.x) <= half && fabs(to.y) <= half;
			if (inside && is_free(&cells, points, k, to, distance))
				move_point(&cells, points, k, to);
		}
	}
	free(cells.first);
	free(cells.next);
	return made;
}
