/* What an event does to its parties: CONTRACT.md, "The step events", Answer. */
#ifndef CAROM_CPU_IMPACT_HPP
#define CAROM_CPU_IMPACT_HPP

#include "cpu/rules.hpp"

namespace carom::cpu {

/* What the row body gets; the column body gets the impulse's opposite. */
template <typename T> struct Impact {
	T x, y, row_torque, column_torque, total;
	bool lossy, slow, ruled;
	Where<T> at;
};

template <typename T> class Impacts
{
public:
	Impacts(const Bodies<T> &all, const Rubs<T> &friction) : bodies(all), rubs(friction), slots(all.slots) {}

	/* Of a body and wall k. */
	Impact<T> at_wall(int32_t s, const Trajectory<T> &way, int32_t k, const Past<T> &past) const
	{
		Convex<T> body;
		bodies.fill(body, slots[s], way);
		const Wall<T> wall = bodies.wall(k);
		const T slop = wall_slop(body), stillness = wall_stillness(body);
		Collision<T> collision{wall_contact(body, wall, T(0), slop), {wall_gap(body, wall, T(0)), slop, stillness, found_loose}, 1, 0,
			body.inverse_mass, 0, body.inverse_inertia};
		collision.slide = wall_slide<T>(body, rubs.at_wall(slots[s].body()), T(0));
		set_event_rules(collision, larger(slots[s].turn[TURN_RESTITUTION], bodies.rule(RULES_RESTITUTION)), inner(wall.n, body.a), norm(body.a),
			bodies.weight(), stillness, past);
		collision.centre = body.x;
		return impact(collision);
	}

	Impact<T> of_pair(int32_t row, const Trajectory<T> &row_way, int32_t column, const Trajectory<T> &column_way, const Past<T> &past) const
	{
		Convex<T> a, b;
		bodies.fill(a, slots[row], row_way);
		bodies.fill(b, slots[column], column_way);
		const Pose<T> at = pose(a, b, T(0));
		const T slop = pair_slop(a, b), stillness = pair_stillness(a, b);
		const Touch<T> touch = have_pieces(a, b) ? answer_of_pieces(a, b, at, slop, stillness, found_loose) : answer_of(a, b, at, slop, stillness);
		const bool from_b = touch.contact.from_b;
		const Body<T> &ref = from_b ? b : a, &inc = from_b ? a : b;
		Collision<T> collision{touch.contact, {touch.gap, slop, stillness, found_loose}, 1, ref.inverse_mass, inc.inverse_mass, ref.inverse_inertia,
			inc.inverse_inertia};
		const Vec<T> between = inc.a - ref.a;
		collision.slide = pair_slide<T>(a, b, at, from_b, rubs.between(slots[row].body(), slots[column].body()));
		set_event_rules(collision, larger(slots[row].turn[TURN_RESTITUTION], slots[column].turn[TURN_RESTITUTION]),
			inner(collision.contact.n, between), larger(norm(a.a), norm(b.a)), bodies.weight(), stillness, past);
		collision.centre = inc.x;
		return impact(collision);
	}

private:
	static constexpr T found_loose = T(0.5);

	static Touch<T> answer_of(const Convex<T> &a, const Convex<T> &b, const Pose<T> &at, T slop, T stillness)
	{
		const Axis<T> axis = hit_axis(a, b, at, slop, stillness, found_loose);
		return {contact_at(a, b, at, axis, slop), axis};
	}

	Impact<T> impact(const Collision<T> &collision) const
	{
		const Contact<T> &c = collision.contact;
		const Impulses<T> j = bodies.functions.impulses(collision);
		const Blow<T> blow = blow_of(collision, j);
		const T total = j.at[0] + j.at[1], length = bodies.length, x = blow.x / length, y = blow.y / length;
		const T on_inc = blow.on_inc / length, on_ref = blow.on_ref / length;
		const Where<T> at = where(collision, j);
		if (c.from_b)
			return {x, y, on_inc, on_ref, total, collision.lossy, collision.slow, collision.ruled, at};
		return {-x, -y, on_ref, on_inc, total, collision.lossy, collision.slow, collision.ruled, at};
	}

	const Bodies<T> &bodies;
	const Rubs<T> &rubs;
	const Slot<T> *const slots;
};

}

#endif
