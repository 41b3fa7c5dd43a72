/* What joints hold, as points of Contacts that pull as well as push: CONTRACT.md, "contacts", Joints. */
#ifndef CAROM_CPU_JOINTS_HPP
#define CAROM_CPU_JOINTS_HPP

#include "cpu/keep.hpp"

namespace carom::cpu {

/* The records of a joint. */
template <typename T> struct Joint {
	T parties[4], anchors[2][2], forces[4];

	bool is_pin() const { return parties[JOINT_LENGTH] < 0; }
	int32_t points() const { return is_pin() ? 2 : 1; }
};

static_assert(sizeof(Joint<float>) == JOINT_WIDTH * 4 * sizeof(float), "joints");

/* One of the two bodies, as it gets from where it is to the end of a way, or a place in the world. */
template <typename T> struct Held {
	Vec<T> x = {0, 0}, way = {0, 0}, lever = {0, 0}, last_lever = {0, 0};
	T turned = 0, radius = 0, inverse_mass = 0, inverse_inertia = 0;

	/* A place in the world. */
	explicit Held(const T *anchor) : x(anchor[0], anchor[1]) {}
	/* What stays where it is. */
	Held(const Slot<T> &slot, const T *anchor)
		: x(slot.place[LINEAR_X], slot.place[LINEAR_Y]), lever(turn(rotation_of(slot.turn[TURN_ANGLE]), Vec<T>(anchor[0], anchor[1]))),
		  last_lever(lever), radius(slot.radius()), inverse_mass(slot.mass[MASS_INVERSE]), inverse_inertia(slot.mass[MASS_INVERSE_INERTIA])
	{
	}
	/* What moves so far, and turns. */
	Held(const Slot<T> &slot, const T *anchor, const Vec<T> &moved, T by) : Held(slot, anchor)
	{
		way = moved, turned = smaller(larger(by, -T(JOINT_TURN)), T(JOINT_TURN));
		last_lever = turn(rotation_of(slot.turn[TURN_ANGLE] + turned), Vec<T>(anchor[0], anchor[1]));
	}

	/* So that it times the angle is what the anchor gets along n; or where the way ends. */
	T arm(const Vec<T> &n, bool at_end) const
	{
		return at_end ? cross(last_lever, n) : cross(Vec<T>(T(0.5) * (lever + last_lever)), n) * (1 + (turned * turned) * T(1.0f / 12));
	}

	/* How much a force at the anchor turns the body. */
	T gives() const { return largest(lever) * inverse_inertia; }
};

/* How a joint's one or two points hold one of its bodies, seen from the other: along which ways, so that forces along them do no work, and how far the anchors are to get along them. */
template <typename T> struct Hold {
	Vec<T> n[2];
	T target[2] = {0, 0};

	Hold(const Joint<T> &joint, bool is_other, const Held<T> &own, const Held<T> &other, bool at_end)
	{
		const Vec<T> first = (own.x - other.x) + (own.lever - other.lever);
		const Vec<T> gone = (own.way - other.way) + ((own.last_lever - own.lever) - (other.last_lever - other.lever));
		const T sign = is_other ? T(-1) : T(1);
		if (joint.is_pin()) {
			n[0] = Vec<T>(sign, 0), n[1] = Vec<T>(0, sign);
			target[0] = -inner(n[0], first), target[1] = -inner(n[1], first);
			return;
		}
		const Vec<T> twice = at_end ? Vec<T>(first + gone) : Vec<T>(first + (first + gone));
		const T length = joint.parties[JOINT_LENGTH], distance = norm(first), size = norm(twice);
		n[0] = size > 0 ? Vec<T>(twice.x() / size, twice.y() / size) : Vec<T>(sign, 0);
		n[1] = Vec<T>(0, 0);
		target[0] = at_end ? length - distance : (length - distance) * ((length + distance) / larger(size, length));
	}
};

/* Of all bodies. */
template <typename T> class Joints
{
public:
	Joints(T *records, const int32_t *joined) : joints(reinterpret_cast<Joint<T> *>(records)), list(joined) {}

	bool has_any() const { return list[JOINED_COUNT] > 0; }

	/* Calls `visit(joint, is it the joint's other body)` for each of a body's, in order. */
	template <typename Visit> void each(int32_t body, const Visit &visit) const
	{
		if (!has_any())
			return;
		for (int32_t side = list[JOINED_FIRST + body]; side >= 0; side = list[JOINED_NEXT(list[JOINED_BODIES], side)])
			visit(joints[side / 2], side % 2 == 1);
	}

	/* The body at the other end, -1 for none. */
	static int32_t partner_of(const Joint<T> &joint, bool is_other)
	{
		return static_cast<int32_t>(joint.parties[is_other ? JOINT_BODY : JOINT_OTHER]);
	}

private:
	Joint<T> *const joints;
	const int32_t *const list;
};

/* Of a dynamic body, or a kinematic one, which has no points; those with which it is joined wake, if it is awake. How many points there are. */
template <typename T>
int32_t count_joined(const Joints<T> &joints, const Slot<T> *slots, const int32_t *places, const Sleepers<T> &sleepers, int32_t s)
{
	int32_t points = 0;
	if (slots[s].is_static())
		return 0;
	joints.each(slots[s].body(), [&](const Joint<T> &joint, bool is_other) {
		const int32_t partner = Joints<T>::partner_of(joint, is_other);
		points += joint.points();
		if (partner >= 0 && !sleepers.sleeps(s) && sleepers.sleeps(places[partner]))
			sleepers.disturb(places[partner]);
	});
	return slots[s].is_dynamic() ? points : 0;
}

/* How a joint holds the body in slot s as the step begins. */
template <typename T> struct HeldNow {
	Held<T> own, other;
	Hold<T> hold;
	Partner partner;

	HeldNow(const Joint<T> &joint, bool is_other, const Slot<T> *slots, const int32_t *places, int32_t s)
		: own(slots[s], joint.anchors[is_other]), other(other_of(joint, is_other, slots, places)), hold(joint, is_other, own, other, false)
	{
		const int32_t body = Joints<T>::partner_of(joint, is_other);
		if (body < 0)
			partner = Partner::that_stays(-1);
		else
			partner = slots[places[body]].is_static() ? Partner::that_stays(body) : Partner(places[body]);
	}

private:
	static Held<T> other_of(const Joint<T> &joint, bool is_other, const Slot<T> *slots, const int32_t *places)
	{
		const int32_t body = Joints<T>::partner_of(joint, is_other);
		const T *anchor = joint.anchors[!is_other];
		return body < 0 ? Held<T>(anchor) : Held<T>(slots[places[body]], anchor);
	}
};

/* Writes the points, which come first of a body's. */
template <typename T>
void write_joined(const Joints<T> &joints, const Slot<T> *slots, const int32_t *places, int32_t s, Points<T> *to, Grips<T> *grips)
{
	int32_t written = 0;
	joints.each(slots[s].body(), [&](const Joint<T> &joint, bool is_other) {
		const HeldNow<T> now(joint, is_other, slots, places, s);
		const Held<T> &own = now.own, &other = now.other;
		const T size = (larger(largest(own.x), largest(other.x)) + (own.radius + other.radius)) + (largest(own.lever) + largest(other.lever));
		for (int32_t k = 0; k < joint.points(); k++, written++) {
			Points<T> &points = to[written / lane_count];
			const int32_t i = written % lane_count;
			points.drop(i);
			points.partner[i] = static_cast<T>(now.partner.code);
			points.normal_x[i] = now.hold.n[k].x(), points.normal_y[i] = now.hold.n[k].y();
			points.arm[i] = cross(own.lever, now.hold.n[k]), points.other_arm[i] = cross(other.lever, now.hold.n[k]);
			points.tolerance[i] = T(JOINT_PART) * (size * T(SLOP));
			if (grips)
				grips[written / lane_count].drop(i);
		}
	});
}

/* Forces begin with the last ones. */
template <typename T> void warm_joined(const Rests<T> &rests, const Joints<T> &joints, int32_t s)
{
	int32_t point = 0;
	joints.each(rests.slots[s].body(), [&](const Joint<T> &joint, bool) {
		for (int32_t k = 0; k < joint.points() && point < rests.touching[s].joined; k++, point++) {
			Points<T> &points = rests.points[rests.touching[s].first + point / lane_count];
			const int32_t i = point % lane_count;
			points.force[i] = points.start[i] = begun(rests, rests.slots[s], Partner(points.partner[i]), joint.forces[k], rests.length);
		}
	});
}

/* Is it looked, after so many iterations, where all would get? */
inline bool is_aimed(int32_t done)
{
	return done >= 0 && done < 31 && (JOINT_AIMED >> done & 1) != 0;
}

/* What forces are to do, once it is known where all would get with those that they begin with: by the end of the step each anchor is where it belongs. */
template <typename T> [[gnu::noinline]] void aim_joined(const Rests<T> &rests, const Joints<T> &joints, const Lanes<T> *loads, int32_t s, int32_t now)
{
	int32_t point = 0;
	joints.each(rests.slots[s].body(), [&](const Joint<T> &joint, bool is_other) {
		const int32_t first = rests.touching[s].first, other_body = Joints<T>::partner_of(joint, is_other);
		const auto four = [&](int32_t k) -> Points<T> & { return rests.points[first + (point + k) / lane_count]; };
		const Partner partner(four(0).partner[point % lane_count]);
		const T *anchor = joint.anchors[!is_other];
		const auto held = [&](int32_t slot_index, const T *at, bool by_velocity) {
			const Slot<T> &slot = rests.slots[slot_index];
			const Lanes<T> &load = loads[LOADS_OF(slot_index) + now];
			const auto way = [&](T velocity, T with_forces) {
				return by_velocity ? velocity * rests.length : T(0.5) * (velocity * rests.length + with_forces);
			};
			return Held<T>(slot, at, {way(slot.place[LINEAR_VX], load[0]), way(slot.place[LINEAR_VY], load[1])},
				way(slot.turn[TURN_VELOCITY], load[2]));
		};
		const auto held_other = [&](bool by_velocity) {
			return other_body < 0 ? Held<T>(anchor)
				: partner.moves() ? held(partner.slot(), anchor, by_velocity)
								  : Held<T>(rests.slots[rests.places[other_body]], anchor);
		};
		Held<T> own = held(s, joint.anchors[is_other], false), other = held_other(false);
		T force = 0;
		for (int32_t k = 0; k < joint.points(); k++)
			force += std::abs(four(k).force[(point + k) % lane_count]);
		T gives = own.gives() + other.gives();
		if (!joint.is_pin())
			gives += (own.inverse_mass + other.inverse_mass) / joint.parties[JOINT_LENGTH];
		Hold<T> hold(joint, is_other, own, other, false);
		const T far = T(JOINT_FAR) * (own.radius + other.radius);
		const bool is_stiff = force * gives > T(JOINT_STIFF) || std::abs(hold.target[0]) > far || std::abs(hold.target[1]) > far;
		if (is_stiff) {
			own = held(s, joint.anchors[is_other], true), other = held_other(true);
			hold = Hold<T>(joint, is_other, own, other, true);
		}
		const T most = T(JOINT_MOST) * (own.radius + other.radius);
		for (int32_t k = 0; k < joint.points(); k++, point++) {
			Points<T> &points = four(0);
			const int32_t i = point % lane_count;
			const Vec<T> &n = hold.n[k];
			const auto along = [&](int32_t slot_index, T arm) {
				if (slot_index < 0)
					return T(0);
				const Slot<T> &slot = rests.slots[slot_index];
				return (n.x() * (slot.place[LINEAR_VX] * rests.length) + n.y() * (slot.place[LINEAR_VY] * rests.length))
					+ arm * (slot.turn[TURN_VELOCITY] * rests.length);
			};
			const T target = larger(smaller(hold.target[k], most), -most);
			points.normal_x[i] = n.x(), points.normal_y[i] = n.y();
			points.arm[i] = own.arm(n, is_stiff), points.other_arm[i] = other.arm(n, is_stiff);
			points.least[i] = is_stiff ? -(T(EASE) * target) : (along(s, points.arm[i]) - along(partner.slot(), points.other_arm[i])) - 2 * target;
		}
	});
}

/* Keeps the forces for the next step, each at one of its two bodies. True if this one began with the same. */
template <typename T> bool keep_joined(const Rests<T> &rests, const Joints<T> &joints, const Kept<T> *kept, int32_t s, const Vec<T> &ground, T length)
{
	const bool bears = rests.touching[rests.islands.parents[s]].wanted == rests.status[STATUS_FIRST] && kept[s].is_at_rest(ground);
	int32_t point = 0;
	bool are_same = true;
	if (rests.touching[s].joined == 0)
		return true;
	joints.each(rests.slots[s].body(), [&](Joint<T> &joint, bool is_other) {
		for (int32_t k = 0; k < joint.points(); k++, point++) {
			const Points<T> &points = rests.points[rests.touching[s].first + point / lane_count];
			const int32_t i = point % lane_count;
			const Partner partner(points.partner[i]);
			if ((is_other && rests.gives_way(partner)) || (bears && was_still(kept, partner, ground)))
				continue;
			const T force = (points.force[i] / length) / length;
			are_same = are_same && force == joint.forces[k];
			joint.forces[k] = force;
		}
	});
	return are_same;
}

}

#endif
