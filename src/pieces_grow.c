/* Pieces of a polygon grow over their cuts: half as far as they stay convex and within the polygon. */
#include "pieces_rings.h"

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
		is_in = is_in && turn_at(at(all, k), at(all, after(all, k)), p) >= -ON_CUT * square_of(all, k);
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

void carom_rings_grow(cutting *all)
{
	for (uint32_t k = 0; k < all->side_count; k++)
		if (!all->is_gone[k] && all->sides[k].is_cut)
			grow(all, k);
	for (uint32_t k = 0; k < all->side_count; k++)
		if (!all->is_gone[k])
			draw_back(all, k);
}
