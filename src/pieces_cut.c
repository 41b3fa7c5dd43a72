/* A polygon is cut into triangles, ear by ear; triangles that are convex together become one. */
#include "pieces_rings.h"

#define NONE UINT32_MAX

/* ---- Triangles -------------------------------------------------------------------------------------------------- */

#define PASSING 1e-3 /* of a cut's length: how far from it other vertices are to be, for its line is a side of pieces */

/* The square of how long the cut would be, if the corner at the end of side k can be cut off so that no vertex is behind the cut, or nearer to it than `passing` of its length; else infinite. */
static double ear_cut(const cutting *all, uint32_t k, double passing)
{
	const uint32_t middle = after(all, k), end = after(all, middle);
	const point a = at(all, k), b = at(all, middle), c = at(all, end), cut = minus(c, a);
	if (!(turn_at(a, b, c) > 0.0))
		return HUGE_VAL;
	for (uint32_t other = after(all, end); other != k; other = after(all, other)) {
		const point p = at(all, other);
		if (turn_at(a, b, p) >= 0.0 && turn_at(b, c, p) >= 0.0 && turn_at(c, a, p) >= -passing * dot(cut, cut))
			return HUGE_VAL;
	}
	return dot(cut, cut);
}

static uint32_t add_side(cutting *all, side made)
{
	all->sides[all->side_count] = made;
	return all->side_count++;
}

/* The corner at the end of side k becomes a triangle of its own. */
static void cut_ear(cutting *all, uint32_t k)
{
	const uint32_t middle = after(all, k), end = after(all, middle);
	const uint32_t first = add_side(all, all->sides[k]), last = add_side(all, (side){at(all, end), first, true, k});
	if (all->sides[k].is_cut)
		all->sides[all->sides[k].twin].twin = first;
	all->sides[first].next = middle;
	all->sides[middle].next = last;
	all->sides[k] = (side){at(all, k), end, true, last};
}

/* Of corners that may be cut off the one with the shortest cut; NONE if none may be. */
static uint32_t best_ear(const cutting *all, uint32_t ring, uint32_t left, double passing)
{
	uint32_t best = NONE;
	double shortest = HUGE_VAL;
	for (uint32_t i = 0, k = ring; i < left; i++, k = after(all, k)) {
		const double cut = ear_cut(all, k, passing);
		if (cut < shortest)
			shortest = cut, best = k;
	}
	return best;
}

/* The corner that turns most to the left. */
static uint32_t sharpest_ear(const cutting *all, uint32_t ring, uint32_t left)
{
	uint32_t sharpest = ring;
	double most = -HUGE_VAL;
	for (uint32_t i = 0, k = ring; i < left; i++, k = after(all, k)) {
		const double turn = turn_at(at(all, k), at(all, after(all, k)), at(all, after(all, after(all, k))));
		if (turn > most)
			most = turn, sharpest = k;
	}
	return sharpest;
}

/* Where rounding lets no corner be cut off, it is the sharpest one. */
static void cut_into_triangles(cutting *all, uint32_t ring)
{
	for (uint32_t left = all->count; left > 3; left--) {
		const uint32_t clear = best_ear(all, ring, left, PASSING), ear = clear == NONE ? best_ear(all, ring, left, 0.0) : clear;
		ring = ear == NONE ? sharpest_ear(all, ring, left) : ear;
		cut_ear(all, ring);
	}
}

/* ---- Convex pieces ---------------------------------------------------------------------------------------------- */

#define CLEARLY 0.0625 /* the sine of a turn: where two cuts meet so straight, their piece is not to end in a corner that points inwards */

/* Where a cut begins, are the pieces on both sides of it convex together? */
static bool joins(const cutting *all, uint32_t cut)
{
	const uint32_t back = before(all, cut), ahead = after(all, all->sides[cut].twin);
	const point a = at(all, back), b = at(all, cut), c = at(all, after(all, ahead)), to_b = minus(b, a), to_c = minus(c, b);
	const double least = all->sides[back].is_cut && all->sides[ahead].is_cut ? CLEARLY * sqrt(dot(to_b, to_b) * dot(to_c, to_c)) : 0.0;
	return turn_at(a, b, c) >= least;
}

/* A cut that begins in a corner that points inwards: are the angles on both sides of it no more than half a turn, so that there it is all that is needed? */
static bool suffices(const cutting *all, uint32_t cut)
{
	const point from = at(all, cut), to = at(all, after(all, cut));
	uint32_t k = 0;
	while (!is_same(all->outline[k], from))
		k++;
	const point a = all->outline[(k + all->count - 1) % all->count], b = all->outline[(k + 1) % all->count];
	return turn_at(a, from, b) < 0.0 && turn_at(a, from, to) >= 0.0 && turn_at(to, from, b) >= 0.0;
}

/* Which of two cuts is rather to go: what suffices nowhere, or else the longer one. */
static bool goes_rather(const cutting *all, uint32_t cut, uint32_t than)
{
	const bool stays = suffices(all, cut) || suffices(all, all->sides[cut].twin);
	const bool than_stays = suffices(all, than) || suffices(all, all->sides[than].twin);
	return stays == than_stays ? square_of(all, cut) > square_of(all, than) : than_stays;
}

static void replace(cutting *all, uint32_t k, uint32_t by)
{
	all->sides[k].next = all->sides[by].next;
	all->sides[k].is_cut = all->sides[by].is_cut;
	all->sides[k].twin = all->sides[by].twin;
	if (all->sides[k].is_cut)
		all->sides[all->sides[k].twin].twin = k;
	all->is_gone[by] = true;
}

/* Cuts that are not needed. */
static void join_pieces(cutting *all)
{
	bool is_tried[CAROM_MOST_PIECE_VERTICES] = {false};
	for (;;) {
		uint32_t cut = NONE;
		for (uint32_t k = 0; k < all->side_count; k++)
			if (!all->is_gone[k] && all->sides[k].is_cut && !is_tried[k] && (cut == NONE || goes_rather(all, k, cut)))
				cut = k;
		if (cut == NONE)
			return;
		const uint32_t twin = all->sides[cut].twin;
		is_tried[cut] = is_tried[twin] = true;
		if (joins(all, cut) && joins(all, twin)) {
			const uint32_t after_cut = after(all, cut), after_twin = after(all, twin);
			replace(all, cut, after_twin);
			replace(all, twin, after_cut);
		}
	}
}

void carom_rings_cut(cutting *all)
{
	cut_into_triangles(all, 0);
	join_pieces(all);
}
