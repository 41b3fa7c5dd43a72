#include "cpu/toi.hpp"

namespace carom::cpu {

/* Is a vertex of B inside A? The pose is A's. */
template <typename T> static bool reaches_into(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, InsideTest<T> inside)
{
	for (int32_t k = 0; k < b.count; k++) {
		if (inside(a, pose.to_a(b.vertex(k))))
			return true;
	}
	return false;
}

template <typename T> static bool overlap_at(const Pair<T> &pair, T t)
{
	const Convex<T> &a = pair.a, &b = pair.b;
	Pose<T> at_t = pose(a, b, t);
	if (pair.are_circles())
		return norm(at_t.d) < a.radius + b.radius;
	if (a.is_circle() || b.is_circle())
		return best_axis(a, b, at_t).gap < 0;
	return reaches_into(a, b, at_t, pair.inside) || reaches_into(b, a, at_t.swapped(), pair.inside);
}

template <typename T> static bool hits_at(const Pair<T> &pair, T t)
{
	Pose<T> at_t = pose(pair.a, pair.b, t);
	return pair.is_hit(at_t, best_axis(pair.a, pair.b, at_t));
}

/* Halves the interval, at most `iterations` times [2.1]. */
template <typename T> static HitTime<T> bisect(const Pair<T> &pair, T min, T max, const SearchRules<T> &rules)
{
	const T epsilon = rules.epsilon, iterations = rules.iterations;
	for (T i = 0; max - min > epsilon && i < iterations; i++) {
		T middle = T(0.5) * (max + min);
		(overlap_at(pair, middle) ? max : min) = middle;
	}
	if (max - min > epsilon)
		return {min, max, 0, min};
	return hits_at(pair, min) ? HitTime<T>{min, max, 1, min} : no_hit<T>();
}

/* A pair that parts is no hit, or time would stop at it. */
template <typename T> static HitTime<T> find(const Pair<T> &pair, const SearchRules<T> &rules)
{
	if (overlap_at(pair, T(0)))
		return hits_at(pair, T(0)) ? hit_at(T(0)) : no_hit<T>();
	return overlap_at(pair, T(1)) ? bisect(pair, T(0), T(1), rules) : no_hit<T>();
}

template <typename T> static HitTime<T> time(const Pair<T> &pair, const SearchRules<T> &rules)
{
	return find(pair, rules);
}

template <typename T> static SearchRules<T> rules_of(const Job<T> &job)
{
	const Shapes<T> shapes = shapes_before(job);
	return {shapes.rule(RULES_EPSILON), shapes.rule(RULES_ITERATIONS)};
}

/* The paper's Bisection1 [2.1]. */
template <typename T> static void first(const Job<T> &job)
{
	const SearchRules<T> rules = rules_of(job);
	find_hits(job, [&](const Pair<T> &pair) { return find(pair, rules); });
}

/* The paper's Bisection2: goes on with the intervals that are too long yet [2.1]. */
template <typename T> static void next(const Job<T> &job)
{
	const Shapes<T> shapes = shapes_before(job);
	const SearchRules<T> rules = rules_of(job);
	const Texels<T> front = job.texels(TOI_COUNT);
	search_tiles(job, TOI_COUNT + 1, [&](int32_t row, int32_t column, bool) {
		const HitTime<T> hit{front.at(column, row, HITTIMES_MIN), front.at(column, row, HITTIMES_MAX), front.at(column, row, HITTIMES_DONE),
			front.at(column, row, HITTIMES_HIT)};
		if (hit.done != 0)
			return hit;
		const HeldConvex<T> a = shapes.convex(row), b = shapes.convex(column);
		return bisect(Pair<T>(a, b, job.inside), hit.min, hit.max, rules);
	});
}

extern const Stage toi_bisection;
const Stage toi_bisection{"toi", "bisection", {{STAGE_TOI_FIRST, first<float>, first<double>}, {STAGE_TOI_NEXT, next<float>, next<double>}}, nullptr,
	nullptr, nullptr, nullptr, {time<float>}, {time<double>}};

}
