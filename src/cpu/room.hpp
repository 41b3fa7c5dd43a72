/* The room's walls, and a body's contact with one: CONTRACT.md, "walls". */
#ifndef CAROM_CPU_ROOM_HPP
#define CAROM_CPU_ROOM_HPP

#include "cpu/contact.hpp"

namespace carom::cpu {

constexpr int32_t wall_count = 4;

/* A half-plane: n . x >= offset is in the room. */
template <typename T> struct Wall {
	Vec<T> n;
	T offset;

	T height(const Vec<T> &x) const { return inner(n, x) - offset; }
};

/* `state` is what knows the room: a State, or another. */
template <typename T, template <typename> class Rules> Wall<T> room_wall(const Rules<T> &state, int32_t wall)
{
	switch (wall) {
	case 0: return {{1, 0}, state.room(ROOM_MIN_X)};
	case 1: return {{0, 1}, state.room(ROOM_MIN_Y)};
	case 2: return {{-1, 0}, -state.room(ROOM_MAX_X)};
	default: return {{0, -1}, -state.room(ROOM_MAX_Y)};
	}
}

template <typename T> T wall_slop(const Body<T> &body)
{
	return (largest(body.x) + body.radius) * SLOP;
}

template <typename T> T wall_stillness(const Body<T> &body)
{
	return ((span(body.v) + span(body.a)) + (std::abs(body.w) + std::abs(body.b)) * body.radius) * APPROACH + STILL;
}

template <typename T> T wall_gap(const Convex<T> &convex, const Wall<T> &wall, T t)
{
	return wall.height(convex.place_at(t)) + lowest<T>(convex, turn_back(rotation_of(convex.angle_at(t)), wall.n)).height;
}

/* Adds the ends of what of a polygon touches. */
template <typename T> void add_wall_points(Contact<T> &contact, const Convex<T> &convex, const Wall<T> &wall, T t, T slop)
{
	const Vec<T> rotation = rotation_of(convex.angle_at(t)), m = turn_back(rotation, wall.n);
	const T limit = lowest(convex, m).height + slop;
	int32_t first = 0, last = 0;
	T least = infinite<T>, most = -infinite<T>;
	for (int32_t k = 0; k < convex.count; k++) {
		Vec<T> vertex = convex.vertex(k);
		if (!(inner(m, vertex) <= limit))
			continue;
		T along = cross(m, vertex);
		if (along < least)
			least = along, first = k;
		if (along > most)
			most = along, last = k;
	}
	const T rate = inner(wall.n, convex.velocity_at(t)), w = convex.angular_velocity_at(t);
	auto add = [&](int32_t k) {
		Vec<T> inc = turn(rotation, convex.vertex(k));
		contact.add(Vec<T>(0, 0), inc, rate - w * cross(wall.n, inc));
	};
	add(first);
	if (least != most)
		add(last);
}

/* The wall is the reference and stands where the body's centre is: its levers are 0. */
template <typename T> Contact<T> wall_contact(const Convex<T> &convex, const Wall<T> &wall, T t, T slop)
{
	Contact<T> contact{};
	contact.from_b = true;
	contact.n = wall.n;
	if (convex.is_circle())
		contact.add(Vec<T>(0, 0), Vec<T>(0, 0), inner(wall.n, convex.velocity_at(t)));
	else
		add_wall_points(contact, convex, wall, t, slop);
	return contact;
}

}

#endif
