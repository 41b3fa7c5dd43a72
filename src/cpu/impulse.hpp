/* What the alternatives of the slot impulse share: CONTRACT.md, "impulse". [2.3] */
#ifndef CAROM_CPU_IMPULSE_HPP
#define CAROM_CPU_IMPULSE_HPP

#include "cpu/room.hpp"

namespace carom::cpu {

/* How two bodies slide along each other, where they rub: seen from the reference, whose parts are 0 where it is a wall. */
template <typename T> struct Slide {
	T friction = 0;
	Vec<T> v{0, 0}; /* of the incident body's centre */
	T ref_spin = 0, inc_spin = 0;
	T ref_rim = 0, inc_rim = 0; /* radii of circles */
};

/* A contact with what resists at it. */
template <typename T> struct Collision {
	Contact<T> contact;
	Threshold<T> threshold;
	T restitution;
	T ref_mass, inc_mass, ref_inertia, inc_inertia; /* inverse; a wall's are 0 */
	T micro = 0;                                    /* the least speed at which a push lets the points part */
	bool event = false;                             /* of the step events: it adds no energy */
	bool lossy = false;                             /* by its restitution or friction */
	bool slow = false;                              /* slower than what a push makes in a step, and lossy */
	bool ruled = false;                             /* answered otherwise than by its restitution */
	Slide<T> slide{};
	Vec<T> centre{0, 0}; /* of the incident body */

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

template <typename T> T rim_of(const Body<T> &body)
{
	return body.is_circle() ? body.radius : T(0);
}

template <typename T> Slide<T> wall_slide(const Body<T> &body, T friction, T t)
{
	return {friction, body.velocity_at(t), 0, body.angular_velocity_at(t), 0, rim_of(body)};
}

/* By the pose of A and B, of which `from_b` says whether B is the reference. */
template <typename T> Slide<T> pair_slide(const Body<T> &a, const Body<T> &b, const Pose<T> &pose, bool from_b, T friction)
{
	if (from_b)
		return {friction, -pose.v, pose.wb, pose.wa, rim_of(b), rim_of(a)};
	return {friction, pose.v, pose.wa, pose.wb, rim_of(a), rim_of(b)};
}

template <typename T> Collision<T> wall_collision(const Shapes<T> &shapes, const Rubs<T> &rubs, const FirstHit<T> &hit)
{
	const HeldConvex<T> body = shapes.convex(hit.row);
	const Wall<T> wall = room_wall(shapes, hit.wall());
	const T restitution = larger(shapes.restitution(hit.row), shapes.rule(RULES_RESTITUTION)), slop = wall_slop(body);
	Collision<T> collision{wall_contact(body, wall, hit.time, slop), {wall_gap(body, wall, hit.time), slop, wall_stillness(body)}, restitution, 0,
		body.inverse_mass, 0, body.inverse_inertia};
	collision.slide = wall_slide<T>(body, rubs.at_wall(hit.row), hit.time);
	collision.centre = body.place_at(hit.time);
	return collision;
}

template <typename T> Collision<T> pair_collision(const Shapes<T> &shapes, const Rubs<T> &rubs, const FirstHit<T> &hit)
{
	const HeldConvex<T> a = shapes.convex(hit.row), b = shapes.convex(hit.column);
	const Pose<T> at_hit = pose(a, b, hit.time);
	const T slop = pair_slop(a, b);
	const Axis<T> axis = hit_axis(a, b, at_hit, slop, pair_stillness(a, b), T(0));
	const Body<T> &ref = axis.from_b ? b : a, &inc = axis.from_b ? a : b;
	Collision<T> collision{contact_at(a, b, at_hit, axis, slop), {axis.gap, slop, pair_stillness(a, b)},
		larger(shapes.restitution(hit.row), shapes.restitution(hit.column)), ref.inverse_mass, inc.inverse_mass, ref.inverse_inertia,
		inc.inverse_inertia};
	collision.slide = pair_slide<T>(a, b, at_hit, axis.from_b, rubs.between(hit.row, hit.column));
	collision.centre = inc.place_at(hit.time);
	return collision;
}

/* Of the impulses about a body's centre; what is not there adds a 0 without a sign. */
template <typename T> T torque(const Contact<T> &contact, const Vec<T> levers[2], const Impulses<T> &j)
{
	T first = cross(levers[0], contact.n) * j.at[0];
	return first + (contact.count > 1 ? cross(levers[1], contact.n) * j.at[1] : T(0));
}

/* What a hit does to the incident body, and the torque on the reference, which gets the opposite push. */
template <typename T> struct Blow {
	T x, y, on_inc, on_ref;
};

/* Where the impulses at the points come to, so that friction acts there. */
template <typename T> Vec<T> middle(const Contact<T> &contact, const Vec<T> levers[2], T part)
{
	return contact.count > 1 ? Vec<T>(levers[0] + part * (levers[1] - levers[0])) : levers[0];
}

/* From the incident body's centre to there; the rim of a circle. */
template <typename T> Vec<T> inc_lever(const Collision<T> &collision, T part)
{
	const Contact<T> &c = collision.contact;
	const T rim = collision.slide.inc_rim;
	return rim > 0 ? Vec<T>(-(rim * c.n)) : middle(c, c.inc, part);
}

/* Against the sliding that the impulses along the normal leave: all of it, or as much as friction can. */
template <typename T> void rub(const Collision<T> &collision, const Impulses<T> &j, Blow<T> &blow)
{
	const Contact<T> &c = collision.contact;
	const Slide<T> &slide = collision.slide;
	const T sum = j.at[0] + j.at[1], part = j.at[1] / sum, most = slide.friction * sum;
	const Vec<T> along(-c.n.y(), c.n.x());
	const Vec<T> ref = slide.ref_rim > 0 ? Vec<T>(slide.ref_rim * c.n) : middle(c, c.ref, part);
	const Vec<T> inc = inc_lever(collision, part);
	const T ref_spin = slide.ref_spin + collision.ref_inertia * blow.on_ref, inc_spin = slide.inc_spin + collision.inc_inertia * blow.on_inc;
	const T slip = (inner(along, slide.v) + ref_spin * cross(along, ref)) - inc_spin * cross(along, inc);
	const T ref_arm = cross(ref, along), inc_arm = cross(inc, along);
	const T gives = ((collision.ref_mass + collision.inc_mass) + collision.ref_inertia * (ref_arm * ref_arm))
		+ collision.inc_inertia * (inc_arm * inc_arm);
	const T force = larger(smaller(-slip / gives, most), -most);
	blow.x += force * along.x();
	blow.y += force * along.y();
	blow.on_inc += force * inc_arm;
	blow.on_ref -= force * ref_arm;
}

template <typename T> Blow<T> blow_of(const Collision<T> &collision, const Impulses<T> &j)
{
	const Contact<T> &c = collision.contact;
	const T sum = j.at[0] + j.at[1];
	Blow<T> blow{sum * c.n.x(), sum * c.n.y(), torque(c, c.inc, j), -torque(c, c.ref, j)};
	if (collision.slide.friction > 0 && sum > 0)
		rub(collision, j, blow);
	return blow;
}

/* Where a hit is, and its normal towards A. */
template <typename T> struct Where {
	Vec<T> point{0, 0}, normal{0, 0};
};

template <typename T> Where<T> where(const Collision<T> &collision, const Impulses<T> &j)
{
	const T sum = j.at[0] + j.at[1], part = sum > 0 ? j.at[1] / sum : T(0);
	const Vec<T> &n = collision.contact.n;
	return {collision.centre + inc_lever(collision, part), collision.contact.from_b ? n : Vec<T>(-n)};
}

template <typename T> void put_impulse(const Texels<T> &impulse, const Collision<T> &collision, const Impulses<T> &j, T length)
{
	const Blow<T> blow = blow_of(collision, j);
	const T push_x = blow.x / length, push_y = blow.y / length, on_inc = blow.on_inc / length, on_ref = blow.on_ref / length;
	if (collision.contact.from_b)
		impulse.set(IMPULSE_PUSH, 0, push_x, push_y, on_inc, on_ref);
	else
		impulse.set(IMPULSE_PUSH, 0, -push_x, -push_y, on_ref, on_inc);
	const Where<T> at = where(collision, j);
	impulse.set(IMPULSE_WHERE, 0, at.point.x(), at.point.y(), at.normal.x(), at.normal.y());
}

/* Runs the slot: `resolve(collision)` gives the impulses at the points. */
template <typename T, typename Resolve> void find_impulse(const Job<T> &job, Resolve resolve)
{
	const Texels<T> impulse = job.texels(STATE_COUNT + 3);
	const FirstHit<T> hit(job.texels(STATE_COUNT + 1));
	if (!hit.in_step() || !hit.done) {
		impulse.set(IMPULSE_PUSH, 0, 0, 0, 0, 0);
		impulse.set(IMPULSE_WHERE, 0, 0, 0, 0, 0);
		return;
	}
	const Shapes<T> shapes(job, hit.length);
	const Rubs<T> rubs(shapes.uniforms, job.texels(STATE_COUNT + 2));
	Collision<T> collision = hit.at_wall() ? wall_collision(shapes, rubs, hit) : pair_collision(shapes, rubs, hit);
	put_impulse(impulse, collision, resolve(collision), hit.length);
	if (hit.at_wall())
		impulse.fact(IMPULSE_PUSH, IMPULSE_TORQUE_B) = 0;
}

}

#endif
