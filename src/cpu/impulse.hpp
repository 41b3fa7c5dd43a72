/* What the alternatives of the slot impulse share: CONTRACT.md, "impulse". [2.3] */
#ifndef CAROM_CPU_IMPULSE_HPP
#define CAROM_CPU_IMPULSE_HPP

#include "cpu/room.hpp"

namespace carom::cpu {

/* A contact with what resists at it. */
template <typename T> struct Collision {
	Contact<T> contact;
	Threshold<T> threshold;
	T restitution;
	T ref_mass, inc_mass, ref_inertia, inc_inertia; /* inverse; a wall's are 0 */
	T micro = 0;                                    /* the least speed at which a push lets the points part */
	bool event = false;                             /* of the step events: it adds no energy */
	bool slow = false;                              /* slower than what a push makes in a step, and lossy */
	bool ruled = false;                             /* answered otherwise than by its restitution */

	/* How fast the points' parting at i grows by an impulse of 1 at k. */
	T coupling(int i, int k) const
	{
		const Contact<T> &c = contact;
		return ((ref_mass + inc_mass) + ref_inertia * (cross(c.ref[i], c.n) * cross(c.ref[k], c.n)))
			+ inc_inertia * (cross(c.inc[i], c.n) * cross(c.inc[k], c.n));
	}

	T gain(int i) const
	{
		const T rate = contact.rate[i], least = larger(micro, threshold.parting);
		return -rate < least ? least - rate : (-(1 + restitution)) * rate;
	}
	bool is_hit(int i) const { return i < contact.count && contact.rate[i] < threshold.rate; }
	T alone(int i) const { return gain(i) / coupling(i, i); }
};

/* The impulse at each of the two points, along the normal. */
template <typename T> struct Impulses {
	T at[2];
};

template <typename T> Collision<T> wall_collision(const Shapes<T> &shapes, const FirstHit<T> &hit)
{
	const HeldConvex<T> body = shapes.convex(hit.row);
	const Wall<T> wall = room_wall(shapes, hit.wall());
	const T restitution = larger(shapes.restitution(hit.row), shapes.rule(RULES_RESTITUTION)), slop = wall_slop(body);
	return {wall_contact(body, wall, hit.time, slop), {wall_gap(body, wall, hit.time), slop, wall_stillness(body)}, restitution, 0, body.inverse_mass,
		0, body.inverse_inertia};
}

template <typename T> Collision<T> pair_collision(const Shapes<T> &shapes, const FirstHit<T> &hit)
{
	const HeldConvex<T> a = shapes.convex(hit.row), b = shapes.convex(hit.column);
	const Pose<T> at_hit = pose(a, b, hit.time);
	const Axis<T> axis = best_axis(a, b, at_hit);
	const Body<T> &ref = axis.from_b ? b : a, &inc = axis.from_b ? a : b;
	const T slop = pair_slop(a, b);
	return {contact_at(a, b, at_hit, axis, slop), {axis.gap, slop, pair_stillness(a, b)},
		larger(shapes.restitution(hit.row), shapes.restitution(hit.column)), ref.inverse_mass, inc.inverse_mass, ref.inverse_inertia,
		inc.inverse_inertia};
}

/* Of the impulses about a body's centre; what is not there adds a 0 without a sign. */
template <typename T> T torque(const Contact<T> &contact, const Vec<T> levers[2], const Impulses<T> &j)
{
	T first = cross(levers[0], contact.n) * j.at[0];
	return first + (contact.count > 1 ? cross(levers[1], contact.n) * j.at[1] : T(0));
}

template <typename T> void put_impulse(const Texels<T> &impulse, const Collision<T> &collision, const Impulses<T> &j, T length)
{
	const Contact<T> &c = collision.contact;
	T sum = j.at[0] + j.at[1];
	T push_x = (sum * c.n.x()) / length, push_y = (sum * c.n.y()) / length;
	T on_inc = torque(c, c.inc, j) / length, on_ref = -torque(c, c.ref, j) / length;
	if (c.from_b)
		impulse.set(0, 0, push_x, push_y, on_inc, on_ref);
	else
		impulse.set(0, 0, -push_x, -push_y, on_ref, on_inc);
}

/* Runs the slot: `resolve(collision)` gives the impulses at the points. */
template <typename T, typename Resolve> void find_impulse(const Job<T> &job, Resolve resolve)
{
	const Texels<T> impulse = job.texels(STATE_COUNT + 2);
	const FirstHit<T> hit(job.texels(STATE_COUNT + 1));
	if (!hit.in_step() || !hit.done) {
		impulse.set(0, 0, 0, 0, 0, 0);
		return;
	}
	const Shapes<T> shapes(job, hit.length);
	Collision<T> collision = hit.at_wall() ? wall_collision(shapes, hit) : pair_collision(shapes, hit);
	put_impulse(impulse, collision, resolve(collision), hit.length);
	if (hit.at_wall())
		impulse.fact(0, IMPULSE_TORQUE_B) = 0;
}

}

#endif
