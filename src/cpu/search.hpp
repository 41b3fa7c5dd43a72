/* The search of toi separating: conservative advancement. No time of the step is skipped at which the bodies could touch, so
 * nothing tunnels. CONTRACT.md, "toi". */
#ifndef CAROM_CPU_SEARCH_HPP
#define CAROM_CPU_SEARCH_HPP

#include "cpu/apart.hpp"

namespace carom::cpu {

/* When the centres come within reach of each other, without pushes. */
template <typename T> T centres_near(const Convex<T> &a, const Convex<T> &b, T reach)
{
	const Vec<T> d = b.x - a.x, v = b.v - a.v;
	const T way = norm(d) - reach;
	if (way <= 0)
		return 0;
	const T x = cross(d, v), approach = inner(d, v), under = (reach * reach) * inner(v, v) - x * x;
	return approach >= 0 || under < 0 ? infinite<T> : (way * (norm(d) + reach)) / (std::sqrt(under) - approach);
}

/* When the circles about the bodies touch, or a time before that. */
template <typename T> T circles_touch(const Convex<T> &a, const Convex<T> &b, T slop)
{
	const T push = norm(b.a - a.a), reach = (a.radius + b.radius) + slop;
	if (!(push > 0))
		return centres_near(a, b, reach);
	const T way = norm(b.x - a.x) - reach;
	return way <= 0 ? T(0) : way / (norm(b.v - a.v) + push);
}

/* Nearer to that, where pushes differ: before it no two bodies have a hit, and so none has a pause, for others take it that there is nothing. */
template <typename T> T circles_meet(const Convex<T> &a, const Convex<T> &b, T slop)
{
	return centres_near(a, b, ((a.radius + b.radius) + slop) + T(0.5) * norm(b.a - a.a));
}

/* How a body turns, as far as that matters to its distance from others: a circle's does not, and is taken to be as that of `other`. */
template <typename T> struct Turning {
	T w, b;

	Turning(const Body<T> &body, T spin, const Turning &other) : w(body.is_circle() ? other.w : spin), b(body.is_circle() ? other.b : body.b) {}
	Turning() : w(0), b(0) {}
};

/* How the incident body can move against the axis while the reference turns with it, for the rest of the step. */
template <typename T> struct Bounds {
	T base, rate, bend, turning_rate;
	Vec<T> m;
};

template <typename T> Bounds<T> bounds(const Convex<T> &reference, const Convex<T> &incident, const Pose<T> &pose, const Axis<T> &axis, T t)
{
	T rest = 1 - t, push = norm(incident.a - reference.a);
	T speed = norm(pose.v) + push * rest, reach = norm(pose.d) + speed * rest;
	const Turning<T> own(reference, pose.wa, Turning<T>()), other(incident, pose.wb, own);
	T twist = std::abs(own.b), relative_twist = std::abs(own.b - other.b);
	T spin = std::abs(own.w) + twist * rest, turning = std::abs(own.w - other.w) + relative_twist * rest;
	T bend = (((turning * turning) * incident.radius + (spin * spin) * reach) + (2 * spin) * speed)
		+ ((push + twist * reach) + relative_twist * incident.radius);
	Vec<T> n = turn(pose.ra, axis.n);
	T rate = inner(n, pose.v) + own.w * cross(n, pose.d);
	return {inner(n, pose.d) - axis.offset, rate, bend, own.w - other.w, turn_back(pose.relative, axis.n)};
}

/* For how long after t the axis surely goes on separating them. */
template <typename T> T safe_time(const Pair<T> &pair, const Pose<T> &pose_of_a, const Axis<T> &axis, T t, T margin)
{
	const Convex<T> &reference = axis.from_b ? pair.b : pair.a, &incident = axis.from_b ? pair.a : pair.b;
	const Bounds<T> to = bounds(reference, incident, axis.from_b ? pose_of_a.swapped() : pose_of_a, axis, t);
	if (incident.is_circle())
		return first_root(larger((to.base - incident.radius) - margin, T(0)), to.rate, to.bend);
	T least = infinite<T>;
	for (int32_t first = 0; first < incident.count; first += lane_count) {
		const FourCorners<T> c(incident, first);
		Lanes<T> gap = (to.base + (to.m.x() * c.x + to.m.y() * c.y)) - margin, roots;
		gap = gap < 0 ? Lanes<T>{} : gap;
		first_roots<T>(gap, to.rate + to.turning_rate * (to.m.x() * c.y - to.m.y() * c.x), to.bend, roots);
		for (int32_t i = 0; i < lane_count; i++)
			least = smaller(least, roots[i]);
	}
	return least;
}

template <typename T> HitTime<T> separating_search(const Pair<T> &pair)
{
	T t = circles_touch(pair.a, pair.b, pair.slop), creep = 0;
	if (t <= pair.until && polygons_stay_apart(pair.a, pair.b, t, pair.until, pair.slop))
		return no_hit<T>();
	for (int k = 0; k < 2 * SEARCH_LIMIT; k++) {
		if (k == SEARCH_LIMIT) {
			const T meet = circles_meet(pair.a, pair.b, pair.slop);
			if (!(smaller(t, T(1)) < meet))
				break;
			t = meet;
		}
		if (!(t <= pair.until))
			return no_hit<T>();
		Pose<T> pose_at_t = pose(pair.a, pair.b, t);
		Axis<T> axis = best_axis(pair.a, pair.b, pose_at_t);
		bool touching = axis.gap <= pair.slop;
		if (touching && pair.is_hit(pose_at_t, axis))
			return hit_at(t);
		T safe = safe_time(pair, pose_at_t, axis, t, (touching ? T(-MARGIN) : T(MARGIN)) * pair.slop);
		if (touching)
			creep = creep_time(creep, pair.slop, pair.stillness);
		t = t + (touching ? larger(safe, creep) : safe);
	}
	return pause_at(smaller(t, T(1)));
}

}

#endif
