/* A polygon's corners and its hull, and the pieces that it is cut into: they are cut, and then grow over their cuts. */
#include <string.h>

#include "pieces_rings.h"

static uint32_t keep_corners(const point *outline, uint32_t count, carom_vec2 *corners)
{
	point before = outline[count - 1];
	uint32_t kept = 0;
	for (uint32_t i = 0; i < count; i++) {
		if (is_straight(before, outline[i], outline[(i + 1) % count]))
			continue;
		before = outline[i];
		corners[kept++] = rounded_point(before);
	}
	return kept;
}

uint32_t carom_corners_find(const carom_vec2 *outline, uint32_t count, carom_vec2 *corners)
{
	point exact[CAROM_MAX_VERTICES] = {{0.0, 0.0}};
	for (uint32_t i = 0; i < count; i++)
		exact[i] = exact_point(outline[i]);
	return keep_corners(exact, count, corners);
}

/* The convex hull, from the vertex that is the farthest to the left on, by Andrew's monotone chain. */
static uint32_t find_hull(const point *outline, uint32_t count, carom_vec2 *hull)
{
	point sorted[CAROM_MAX_VERTICES], chain[2 * CAROM_MAX_VERTICES] = {{0.0, 0.0}};
	uint32_t kept = 0;
	for (uint32_t i = 0; i < count; i++) {
		uint32_t k = i;
		for (; k > 0 && (outline[i].x < sorted[k - 1].x || (outline[i].x == sorted[k - 1].x && outline[i].y < sorted[k - 1].y)); k--)
			sorted[k] = sorted[k - 1];
		sorted[k] = outline[i];
	}
	for (uint32_t half = 0; half < 2; half++) {
		const uint32_t first = kept;
		for (uint32_t i = 0; i < count; i++) {
			const point p = sorted[half ? count - 1 - i : i];
			while (kept >= first + 2 && !(turn_at(chain[kept - 2], chain[kept - 1], p) > 0.0))
				kept--;
			chain[kept++] = p;
		}
		kept--; /* the other half begins there */
	}
	return keep_corners(chain, kept, hull);
}

static void take(const cutting *all, carom_pieces *pieces)
{
	bool is_done[CAROM_MOST_PIECE_VERTICES] = {false};
	carom_vec2 *to = pieces->vertices;
	pieces->count = 0;
	for (uint32_t first = 0; first < all->side_count; first++) {
		uint32_t k = first;
		if (all->is_gone[first] || is_done[first])
			continue;
		pieces->sizes[pieces->count] = 0;
		do {
			if (!is_straight(at(all, before(all, k)), at(all, k), at(all, after(all, k)))) {
				*to++ = rounded_point(at(all, k));
				pieces->sizes[pieces->count]++;
			}
			is_done[k] = true;
			k = after(all, k);
		} while (k != first);
		pieces->count++;
	}
}

void carom_pieces_make(const carom_vec2 *outline, uint32_t count, carom_pieces *pieces)
{
	point corners[CAROM_MAX_VERTICES];
	cutting all = {.outline = corners, .count = count, .side_count = count};
	for (uint32_t i = 0; i < count; i++) {
		corners[i] = exact_point(outline[i]);
		all.sides[i] = (side){.from = corners[i], .next = (i + 1) % count};
	}
	memset(pieces, 0, sizeof *pieces);
	pieces->hull_count = find_hull(corners, count, pieces->hull);
	carom_rings_cut(&all);
	carom_rings_grow(&all);
	take(&all, pieces);
}
