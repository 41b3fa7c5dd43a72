#include "cpu/search.hpp"

namespace carom::cpu {

/* Of two circles that fall alike the distance is quadratic in time [4.1]. */
template <typename T> static HitTime<T> quadratic(const Pair<T> &pair)
{
	Vec<T> d = pair.b.x - pair.a.x, v = pair.b.v - pair.a.v;
	T reach = pair.a.radius + pair.b.radius, distance = norm(d), approach = inner(d, v);
	T gap = (distance - reach) * (distance + reach);
	if (gap <= 0)
		return approach < Threshold<T>(distance - reach, pair.slop, pair.stillness).rate * distance ? hit_at(T(0)) : no_hit<T>();
	T x = cross(d, v), under = (reach * reach) * inner(v, v) - x * x;
	if (approach >= 0 || under <= 0 || std::sqrt(under) <= pair.stillness * reach)
		return no_hit<T>();
	T t = gap / (std::sqrt(under) - approach);
	return t <= 1 ? hit_at(t) : no_hit<T>();
}

template <typename T> static HitTime<T> find(const Pair<T> &pair)
{
	bool alike = pair.a.a.x() == pair.b.a.x() && pair.a.a.y() == pair.b.a.y();
	return pair.are_circles() && alike ? quadratic(pair) : separating_search(pair);
}

template <typename T> static void circle_quadratic(const Job<T> &job)
{
	find_hits(job, find<T>);
}

template <typename T> static HitTime<T> time(const Pair<T> &pair, const SearchRules<T> &)
{
	return find<T>(pair);
}

extern const Stage toi_circle_quadratic;
const Stage toi_circle_quadratic{"toi", "circle_quadratic", {{STAGE_TOI_FIRST, circle_quadratic<float>, circle_quadratic<double>}}, nullptr, nullptr,
	nullptr, nullptr, {time<float>}, {time<double>}};

}
