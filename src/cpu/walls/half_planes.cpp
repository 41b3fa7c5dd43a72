#include "cpu/room.hpp"
#include "cpu/toi.hpp"

#include <algorithm>

namespace carom::cpu {

template <typename T> struct WallHit {
	T time, done;
};

/* A circle's height over the wall is quadratic in time. */
template <typename T> static WallHit<T> circle_hit(const Body<T> &body, const Wall<T> &wall, T slop, T stillness)
{
	const T rate = inner(wall.n, body.v), push = inner(wall.n, body.a), gap = wall.height(body.x) - body.radius;
	const Threshold<T> threshold(gap, slop, stillness);
	if (threshold.sunk && rate < threshold.rate)
		return {0, 1};
	T t = first_root(larger(gap, T(0)), rate, -push);
	if (t <= 1 && rate + t * push >= -stillness)
		t = push < 0 ? larger(t, (-stillness - rate) / push) : infinite<T>;
	return {t <= 1 ? t : T(NO_HIT), 1};
}

/* For how long after t no vertex surely reaches the wall. */
template <typename T> static T safe_time(const Convex<T> &convex, const Wall<T> &wall, const Vec<T> &m, T base, T t, T margin)
{
	T rate = inner(wall.n, convex.velocity_at(t)), w = convex.angular_velocity_at(t), rest = 1 - t;
	T spin = std::abs(w) + std::abs(convex.b) * rest;
	T bend = ((spin * spin) * convex.radius + larger(-inner(wall.n, convex.a), T(0))) + std::abs(convex.b) * convex.radius;
	T least = infinite<T>;
	for (int32_t k = 0; k < convex.count; k++) {
		Vec<T> vertex = convex.vertex(k);
		T gap = larger((base + inner(m, vertex)) - margin, T(0));
		least = smaller(least, first_root(gap, rate - w * cross(m, vertex), bend));
	}
	return least;
}

/* When the circle about a body reaches the wall. */
template <typename T> static T circle_reaches(const Body<T> &body, const Wall<T> &wall, T slop)
{
	const T way = (wall.height(body.x) - body.radius) - slop;
	return way > 0 ? first_root(way, inner(wall.n, body.v), -inner(wall.n, body.a)) : T(0);
}

/* As toi separating, with the wall for an axis. */
template <typename T> static WallHit<T> polygon_hit(const Convex<T> &convex, const Wall<T> &wall, T slop, T stillness)
{
	T t = circle_reaches(convex, wall, slop), creep = 0;
	for (int k = 0; k < SEARCH_LIMIT; k++) {
		if (!(t <= 1))
			return {NO_HIT, 1};
		Vec<T> m = turn_back(rotation_of(convex.angle_at(t)), wall.n);
		T base = wall.height(convex.place_at(t));
		const T gap = base + lowest(convex, m).height;
		const bool touching = gap <= slop;
		if (touching && wall_contact(convex, wall, t, slop).is_below(Threshold<T>(gap, slop, stillness).rate))
			return {t, 1};
		T safe = safe_time(convex, wall, m, base, t, (touching ? T(-MARGIN) : T(MARGIN)) * slop);
		if (touching)
			creep = creep_time(creep, slop, stillness);
		t = t + (touching ? larger(safe, creep) : safe);
	}
	return {smaller(t, T(1)), 0};
}

template <typename T> static WallHit<T> body_hit(const Convex<T> &convex, const Wall<T> &wall)
{
	const T slop = wall_slop(convex), stillness = wall_stillness(convex);
	return convex.is_circle() ? circle_hit(convex, wall, slop, stillness) : polygon_hit(convex, wall, slop, stillness);
}

template <typename T> static HitTime<T> time(const Convex<T> &convex, const Wall<T> &wall)
{
	const WallHit<T> hit = body_hit(convex, wall);
	return {hit.time, hit.time, hit.done, hit.time};
}

template <typename T> struct GroupHit {
	WallHit<T> hit{NO_HIT, 1};
	int32_t body = 0, wall = 0;
};

template <typename T> static void find_first(GroupHit<T> &first, const Shapes<T> &shapes, int32_t i)
{
	if (!shapes.is_dynamic(i))
		return;
	const HeldConvex<T> convex = shapes.convex(i);
	for (int32_t k = 0; k < wall_count; k++) {
		Wall<T> wall = room_wall(shapes, k);
		WallHit<T> hit = body_hit(convex, wall);
		if (hit.time < first.hit.time)
			first = {hit, i, k};
	}
}

template <typename T> static void half_planes(const Job<T> &job)
{
	const Shapes<T> shapes = shapes_before(job);
	const Texels<T> walls = job.texels(STATE_COUNT + 2);
	const bool has_room = shapes.rule(RULES_HAS_ROOM) != 0;
	const int32_t count = job.domain[2];
	job.pool.run(job.domain[0], 16, [&](int32_t begin, int32_t end) {
		for (int32_t group = begin; group < end; group++) {
			GroupHit<T> first;
			for (int32_t i = group * WALLS_GROUP; has_room && i < std::min((group + 1) * WALLS_GROUP, count); i++)
				find_first(first, shapes, i);
			walls.of(group, WALLS_HIT) = first.hit.time;
			walls.of(group, WALLS_BODY) = static_cast<T>(first.body);
			walls.of(group, WALLS_WALL) = static_cast<T>(first.wall);
			walls.of(group, WALLS_DONE) = first.hit.done;
		}
	});
}

extern const Stage walls_half_planes;
const Stage walls_half_planes{"walls", "half_planes", {{STAGE_WALLS, half_planes<float>, half_planes<double>}}, nullptr, nullptr, nullptr, nullptr,
	{nullptr, time<float>}, {nullptr, time<double>}};

}
