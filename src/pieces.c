/* A polygon is cut into triangles, ear by ear; triangles that are convex together become one; and then pieces grow over their cuts, as far as they stay convex and
 * within the polygon. */
#include "pieces.h"

#include <math.h>
#include <string.h>

#include "point.h"

#define NONE UINT32_MAX

/* A side of a piece, from its beginning to that of the next one. */
typedef struct side {
	point from;
	uint32_t next;
	bool is_cut;   /* it is none of the polygon's, but */
	uint32_t twin; /* one way of a cut whose other way this side is */
} side;

/* Pieces are rings of sides. */
typedef struct cutting {
	const point *outline;
	uint32_t count; /* of the outline's vertices */
	side sides[CAROM_MOST_PIECE_VERTICES];
	uint32_t side_count;
	bool is_gone[CAROM_MOST_PIECE_VERTICES]; /* sides of no piece any more */
} cutting;

static point at(const cutting *all, uint32_t k)
{
	return all->sides[k].from;
}

static uint32_t after(const cutting *all, uint32_t k)
{
	return all->sides[k].next;
}

static uint32_t before(const cutting *all, uint32_t k)
{
	uint32_t at_side = k;
	while (after(all, at_side) != k)
		at_side = after(all, at_side);
	return at_side;
}

static bool is_same(point a, point b)
{
	return a.x == b.x && a.y == b.y;
}

/* Above 0 where it turns to the left at b. */
static double turn_at(point a, point b, point c)
{
	return cross(minus(b, a), minus(c, b));
}

#define STRAIGHT 1e-6 /* the sine of a turn that rounding makes */

/* Is b a vertex within a side? */
static bool is_straight(point a, point b, point c)
{
	const point to_b = minus(b, a), to_c = minus(c, b);
	return !(turn_at(a, b, c) > STRAIGHT * sqrt(dot(to_b, to_b) * dot(to_c, to_c)));
}

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

static double length_of(const cutting *all, uint32_t k)
{
	const point way = minus(at(all, after(all, k)), at(all, k));
	return dot(way, way);
}

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
	return stays == than_stays ? length_of(all, cut) > length_of(all, than) : than_stays;
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

/* ---- Growing ---------------------------------------------------------------------------------------------------- */

/* The first `part` of a ray from `corner` along `way` at which side a-b is met by it. */
static double part_at_side(point corner, point way, point a, point b)
{
	const point along_side = minus(b, a), from = minus(a, corner);
	const double both = cross(way, along_side), part = cross(from, along_side) / both, where = cross(from, way) / both;
	return both != 0.0 && part > 0.0 && where >= 0.0 && where <= 1.0 ? part : HUGE_VAL;
}

#define ON_CUT 1e-9 /* what rounding makes of a part of 0 */

/* The part at which the triangle of the ray's beginning, its end and `far` gets to a point: 0 of one that is on the cut. */
static double part_at_point(point corner, point way, point far, point p)
{
	const point cut = minus(corner, far), seen = minus(p, far);
	const double both = cross(cut, way), share = cross(seen, way) / both, part = cross(cut, seen) / cross(seen, way);
	return both != 0.0 && share > 0.0 && share <= 1.0 && part > -ON_CUT ? fmax(part, 0.0) : HUGE_VAL;
}

/* Does a side of the polygon that begins in the corner and goes to p lie between the ray and the cut to `far`? */
static bool is_between(point corner, point way, point far, point p)
{
	const point cut = minus(far, corner), to_p = minus(p, corner);
	const double sense = cross(way, cut) > 0.0 ? 1.0 : -1.0;
	return sense * cross(way, to_p) >= 0.0 && sense * cross(to_p, cut) > 0.0;
}

/* A piece's side ends in `corner` with `way`, and a cut leads from there to `far`, behind which the piece goes on to `next`: where the corner may go along the way, so that the piece stays convex and in
 * the polygon. Half as far as it can: the new cut touches nothing. */
static point grown(const cutting *all, point corner, point way, point far, point next)
{
	const point beyond = minus(next, far), cut = minus(far, corner);
	const double sense = cross(way, cut) > 0.0 ? 1.0 : -1.0, turn = sense * cross(cut, beyond), nearer = sense * cross(way, beyond);
	double most = nearer > 0.0 ? fmax(turn, 0.0) / nearer : HUGE_VAL; /* there may be no turn at all */
	if (cross(way, cut) == 0.0)
		return corner;
	for (uint32_t i = 0; i < all->count; i++) {
		const point a = all->outline[i], b = all->outline[(i + 1) % all->count];
		const bool begins = is_same(a, corner), ends = is_same(b, corner);
		if ((begins && is_between(corner, way, far, b)) || (ends && is_between(corner, way, far, a)))
			return corner;
		if (!begins && !ends)
			most = fmin(most, part_at_side(corner, way, a, b));
		if (!begins && !is_same(a, far))
			most = fmin(most, part_at_point(corner, way, far, a));
	}
	return isfinite(most) ? along(corner, 0.5 * most, way) : corner;
}

/* A cut is moved outwards, at both ends, where the polygon's side beside it goes on inside of the polygon. */
static void grow(cutting *all, uint32_t cut)
{
	const uint32_t end = after(all, cut), back = before(all, cut), ahead = after(all, end);
	if (!all->sides[back].is_cut)
		all->sides[cut].from = grown(all, at(all, cut), minus(at(all, cut), at(all, back)), at(all, end), at(all, ahead));
	if (!all->sides[end].is_cut)
		all->sides[end].from = grown(all, at(all, end), minus(at(all, end), at(all, ahead)), at(all, cut), at(all, back));
}

/* Is a point in the piece with that side, or nearly? */
static bool holds(const cutting *all, uint32_t ring, point p)
{
	uint32_t k = ring;
	bool is_in = true;
	do {
		is_in = is_in && turn_at(at(all, k), at(all, after(all, k)), p) >= -ON_CUT * length_of(all, k);
		k = after(all, k);
	} while (k != ring);
	return is_in;
}

static point unit(point p)
{
	return along((point){0.0, 0.0}, 1.0 / sqrt(dot(p, p)), p);
}

/* The part of a way from a corner to a line. */
static double part_to_line(point corner, point way, point a, point b)
{
	const double part = cross(minus(b, a), minus(a, corner)) / cross(minus(b, a), way);
	return part > 0.0 ? part : HUGE_VAL;
}

/* A piece that ends between two cuts in a corner that points inwards is drawn back from there, where those on both sides of it have grown over the cuts: else what touches these there
 * would touch that piece too. */
static void draw_back(cutting *all, uint32_t k)
{
	const uint32_t back = before(all, k), first = all->sides[back].twin, second = all->sides[k].twin;
	if (!all->sides[k].is_cut || !all->sides[back].is_cut || all->sides[before(all, first)].is_cut || all->sides[after(all, second)].is_cut)
		return;
	const point q = at(all, k), from = at(all, back), to = at(all, after(all, k)), ahead = at(all, first), behind = at(all, after(all, second));
	if (is_same(q, ahead) || is_same(q, behind))
		return;
	const point low = cross(minus(to, q), minus(ahead, q)) > 0.0 ? ahead : to, high = cross(minus(behind, q), minus(from, q)) > 0.0 ? behind : from;
	const point a = unit(minus(low, q)), b = unit(minus(high, q)), way = {a.x + b.x, a.y + b.y};
	double most = part_to_line(q, way, from, to);
	most = fmin(most, fmin(part_to_line(q, way, ahead, at(all, after(all, first))), part_to_line(q, way, behind, at(all, second))));
	const point drawn = along(q, 0.5 * most, way);
	if (isfinite(most) && holds(all, first, drawn) && holds(all, first, from) && holds(all, second, drawn) && holds(all, second, to))
		all->sides[k].from = drawn;
}

/* ---- All of it -------------------------------------------------------------------------------------------------- */

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
		all.sides[i] = (side){corners[i], (i + 1) % count, false, NONE};
	}
	memset(pieces, 0, sizeof *pieces);
	pieces->hull_count = find_hull(corners, count, pieces->hull);
	cut_into_triangles(&all, 0);
	join_pieces(&all);
	for (uint32_t k = 0; k < all.side_count; k++)
		if (!all.is_gone[k] && all.sides[k].is_cut)
			grow(&all, k);
	for (uint32_t k = 0; k < all.side_count; k++)
		if (!all.is_gone[k])
			draw_back(&all, k);
	take(&all, pieces);
}
