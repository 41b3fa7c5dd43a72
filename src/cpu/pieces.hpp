/* Polygons that are not convex meet by their pieces: CONTRACT.md, "Polygons that are not convex". */
#ifndef CAROM_CPU_PIECES_HPP
#define CAROM_CPU_PIECES_HPP

#include "cpu/toi.hpp"

#include <vector>

namespace carom::cpu {

/* Of two bodies, has one at least pieces? */
template <typename T> bool have_pieces(const Body<T> &a, const Body<T> &b)
{
	return (a.pieces | b.pieces) != 0;
}

/* A convex part of a body, and a circle that holds it; of what is convex the whole. */
template <typename T> struct Piece {
	const Corner<T> *corners;
	int32_t count;
	Vec<T> middle;
	T radius;

	/* As a body. */
	Convex<T> of(const Convex<T> &whole) const
	{
		Convex<T> convex = whole;
		convex.corners = corners, convex.count = count, convex.pieces = 0;
		return convex;
	}
};

/* Calls `visit(piece)` for each of a body. */
template <typename T, typename Visit> void each_piece(const Convex<T> &body, const Visit &visit)
{
	if (body.pieces == 0)
		return visit(Piece<T>{body.corners, body.count, {0, 0}, body.radius});
	const Corner<T> *const table = body.corners + (body.count + body.count % 2), *corners = table + body.pieces;
	for (int32_t k = 0; k < body.pieces; k++) {
		const T *const record = reinterpret_cast<const T *>(table + k);
		const Piece<T> piece{corners, static_cast<int32_t>(record[PIECE_COUNT]), {record[PIECE_X], record[PIECE_Y]}, record[PIECE_RADIUS]};
		visit(piece);
		corners += piece.count;
	}
}

/* The pairs of pieces of two bodies. */
template <typename T> class PiecePairs
{
public:
	PiecePairs(const Convex<T> &row, const Convex<T> &column)
		: a(row), b(column), x(column.x - row.x), v(column.v - row.v), ra(rotation_of(row.angle_at(0))), rb(rotation_of(column.angle_at(0))),
		  pushed(T(0.5) * span(column.a - row.a)), spin_a(std::abs(row.w) + T(0.5) * std::abs(row.b)),
		  spin_b(std::abs(column.w) + T(0.5) * std::abs(column.b))
	{
	}

	/* Calls `visit(piece of A, piece of B)`, in order, for each two that may get so near before `until`. */
	template <typename Visit> void each(T until, T reach, const Visit &visit) const
	{
		const Vec<T> way = until * v;
		each_piece(a, [&](const Piece<T> &own) {
			const Vec<T> from = turn(ra, own.middle);
			const T aside = pushed + spin_a * norm(own.middle);
			each_piece(b, [&](const Piece<T> &other) {
				const T near = (own.radius + other.radius) + ((aside + spin_b * norm(other.middle)) * until + reach);
				if (!passes(x + (turn(rb, other.middle) - from), way, near))
					visit(own.of(a), other.of(b));
			});
		});
	}

private:
	/* Does what goes straight on keep that distance? */
	static bool passes(const Vec<T> &d, const Vec<T> &way, T distance)
	{
		const T approach = inner(d, way), square = inner(way, way);
		if (approach >= 0)
			return norm(d) > distance;
		if (-approach >= square)
			return norm(Vec<T>(d + way)) > distance;
		return std::abs(cross(d, way)) > distance * std::sqrt(square);
	}

	const Convex<T> &a, &b;
	const Vec<T> x, v, ra, rb;
	const T pushed, spin_a, spin_b; /* lengths in a step */
};

/* The first hit of two pieces, as `find(pair, rules)` has that of two convex bodies. */
template <typename T, typename Find>
[[gnu::noinline]] HitTime<T> first_hit_of_pieces(const Pair<T> &pair, const Find &find, const SearchRules<T> &rules)
{
	HitTime<T> first = no_hit<T>();
	T until = pair.until;
	PiecePairs<T>(pair.a, pair.b).each(T(1), T(APART_SLOPS) * pair.slop, [&](const Convex<T> &a, const Convex<T> &b) {
		const HitTime<T> found = find(Pair<T>(a, b, pair.inside, until), rules);
		if (found.hit < first.hit)
			first = found, until = smaller(until, found.hit);
	});
	return first;
}

/* A contact, and the gap of the axis that it is along, and of each point. */
template <typename T> struct Touch {
	Contact<T> contact;
	T gap, gaps[2];

	Touch() = default;
	Touch(const Contact<T> &at, const Axis<T> &axis) : contact(at), gap(axis.gap)
	{
		for (int i = 0; i < at.count; i++)
			gaps[i] = at.count > 1 ? inner(at.n, at.ref[i]) - axis.offset : axis.gap;
	}

	/* From the other body as the reference. */
	void swap()
	{
		contact.from_b = !contact.from_b;
		contact.n = -contact.n;
		for (int i = 0; i < contact.count; i++)
			std::swap(contact.ref[i], contact.inc[i]);
	}

	/* Takes on the points of another one that lie farther out; false, and nothing is done, where that is along another way. The pose is A's. */
	bool merge(Touch other, const Pose<T> &pose_of_a, T slop)
	{
		if (other.contact.from_b != contact.from_b)
			other.swap();
		if (!(inner(other.contact.n, contact.n) > T(PIECES_ALIKE)))
			return false;
		const Pose<T> pose = contact.from_b ? pose_of_a.swapped() : pose_of_a;
		for (int i = 0; i < other.contact.count; i++)
			widen(other.contact.ref[i], other.contact.inc[i], other.gaps[i], pose, (T(CORNER_NEAR) * T(CORNER_DEEP)) * slop);
		return true;
	}

private:
	void widen(const Vec<T> &ref, const Vec<T> &inc, T point_gap, const Pose<T> &pose, T near)
	{
		const Vec<T> along(-contact.n.y(), contact.n.x());
		const int last = contact.count - 1;
		const T at = inner(along, ref);
		if (at < inner(along, contact.ref[0]) - near) {
			if (last == 0)
				put(1, contact.ref[0], contact.inc[0], gaps[0], contact.rate[0]);
			put(0, ref, inc, point_gap, rate_at<T>(contact.n, pose, ref, inc));
		} else if (at > inner(along, contact.ref[last]) + near) {
			put(1, ref, inc, point_gap, rate_at<T>(contact.n, pose, ref, inc));
		} else {
			return;
		}
		contact.count = 2;
	}

	void put(int i, const Vec<T> &ref, const Vec<T> &inc, T point_gap, T rate)
	{
		contact.ref[i] = ref, contact.inc[i] = inc, contact.rate[i] = rate;
		gaps[i] = point_gap;
	}
};

/* How a hit of two convex pieces would be answered. */
template <typename T> struct Answer : Touch<T> {
	enum { apart, touching, hit } state;

	Answer(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, T slop, T stillness, T loose)
		: Answer(a, b, pose, hit_axis(a, b, pose, slop, stillness, loose), slop, stillness, loose)
	{
	}

	/* Is the hit of two bodies rather this one of their pieces: what touches and is hit, what touches at least, and the fastest, or the nearest? */
	bool is_before(const Answer &other) const
	{
		if (state != other.state)
			return state > other.state;
		return state == apart ? this->gap < other.gap : this->contact.slowest() < other.contact.slowest();
	}

private:
	Answer(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, const Axis<T> &axis, T slop, T stillness, T loose)
		: Touch<T>(contact_at(a, b, pose, axis, slop), axis), state(apart)
	{
		if (axis.gap <= T(PIECES_TOUCH) * slop)
			state = this->contact.is_below(Threshold<T>(axis.gap, slop, stillness, loose).rate) ? hit : touching;
	}
};

/* How one of two bodies is, of which one has pieces: at all points that are along the way. */
template <typename T>
[[gnu::noinline]] Touch<T> answer_of_pieces(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, T slop, T stillness, T loose)
{
	static thread_local std::vector<Answer<T>> all;
	all.clear();
	for (const T reach : {T(APART_SLOPS) * slop, infinite<T>}) /* what bisection found may not be so near yet */
		if (all.empty())
			PiecePairs<T>(a, b).each(T(0), reach,
				[&](const Convex<T> &own, const Convex<T> &other) { all.emplace_back(own, other, pose, slop, stillness, loose); });
	const Answer<T> *first = all.data();
	for (const Answer<T> &answer : all)
		if (answer.is_before(*first))
			first = &answer;
	Touch<T> merged = *first;
	for (const Answer<T> &answer : all)
		if (answer.state != Answer<T>::apart && !a.is_circle() && !b.is_circle())
			merged.merge(answer, pose, slop);
	return merged;
}

/* What forces may act at. */
template <typename T> struct Touches {
	Touch<T> of[PAIR_RESTS];
	int32_t count = 0;

	/* Of two convex bodies that are no farther from each other than `force`. */
	static bool find(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, T force, T slop, Touch<T> &touch)
	{
		const Axis<T> best = best_axis(a, b, pose);
		if (best.gap > force || best.gap < -(T(SUNK_MOST) * slop))
			return false;
		const Contact<T> at_best = contact_at(a, b, pose, best, force - best.gap);
		const Axis<T> axis = corner_way(a, b, pose, best, at_best, slop);
		touch = {axis.is_same(best) ? at_best : contact_at(a, b, pose, axis, force - axis.gap), axis};
		return true;
	}

	/* Of what has pieces: along each way one. */
	[[gnu::noinline]] void find_of_pieces(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, T force, T slop)
	{
		PiecePairs<T>(a, b).each(T(0), force, [&](const Convex<T> &own, const Convex<T> &other) {
			Touch<T> touch;
			if (find(own, other, pose, force, slop, touch))
				add(touch, a.is_circle() || b.is_circle(), pose, slop);
		});
	}

private:
	void add(const Touch<T> &touch, bool is_round, const Pose<T> &pose, T slop)
	{
		for (int32_t k = 0; k < count; k++)
			if (is_round ? replace(of[k], touch) : of[k].merge(touch, pose, slop))
				return;
		if (count < PAIR_RESTS)
			of[count++] = touch;
	}

	/* A circle has one point along a way: where it is nearest. */
	static bool replace(Touch<T> &nearest, const Touch<T> &touch)
	{
		if (!(inner(touch.contact.n, nearest.contact.n) > T(PIECES_ALIKE)))
			return false;
		if (touch.gap < nearest.gap)
			nearest = touch;
		return true;
	}
};

}

#endif
