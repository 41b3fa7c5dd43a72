/* What joints hold, as points of Contacts that pull as well as push: CONTRACT.md, "contacts", Joints. */
#ifndef CAROM_CPU_JOINTS_HPP
#define CAROM_CPU_JOINTS_HPP

#include "cpu/joint.hpp"

#include <optional>

namespace carom::cpu {

/* How many points a body's joints have. */
struct JoinedCount {
	int32_t all = 0, firm = 0; /* firm: the first ones, which push and pull as is needed */
};

/* Of a dynamic body, or a kinematic one, which has no points; those with which it is joined wake, if it is awake. */
template <typename T>
JoinedCount count_joined(const Joints<T> &joints, const Slot<T> *slots, const int32_t *places, const Sleepers<T> &sleepers, int32_t s)
{
	JoinedCount count;
	if (slots[s].is_static())
		return count;
	for (JointRows<T> rows(joints, slots[s].body()); rows.has(); rows.next()) {
		count.all++;
		count.firm += rows.is_firm();
		if (const int32_t partner = rows.partner(); partner >= 0 && !sleepers.sleeps(s) && sleepers.sleeps(places[partner]))
			sleepers.disturb(places[partner]);
	}
	return slots[s].is_dynamic() ? count : JoinedCount{};
}

/* How a joint holds the body in slot s as the step begins. */
template <typename T> struct HeldNow {
	Held<T> own, other;
	Hold<T> hold;
	Partner partner;

	HeldNow() = default;
	HeldNow(const JointRows<T> &rows, const Slot<T> *slots, const int32_t *places, int32_t s)
		: own(slots[s], rows.joint().anchors[rows.is_other()]), other(other_of(rows, slots, places)),
		  hold(rows.joint(), rows.is_other(), own, other, true)
	{
		const int32_t body = rows.partner();
		if (body < 0)
			partner = Partner::that_stays(-1);
		else
			partner = slots[places[body]].is_static() ? Partner::that_stays(body) : Partner(places[body]);
	}

	static Held<T> other_of(const JointRows<T> &rows, const Slot<T> *slots, const int32_t *places)
	{
		const int32_t body = rows.partner();
		const T *anchor = rows.joint().anchors[!rows.is_other()];
		return body < 0 ? Held<T>(anchor) : Held<T>(slots[places[body]], anchor);
	}
};

/* Writes the points, which come first of a body's. Impulses let what is still apart get as far as its bound in the step, and no farther. */
template <typename T>
void write_joined(const Joints<T> &joints, const Slot<T> *slots, const int32_t *places, T part_of_step, int32_t s, Points<T> *to, Grips<T> *grips)
{
	int32_t written = 0;
	HeldNow<T> now;
	for (JointRows<T> rows(joints, slots[s].body()); rows.has(); rows.next(), written++) {
		if (rows.begins())
			now = HeldNow<T>(rows, slots, places, s);
		const Held<T> &own = now.own, &other = now.other;
		const Part part = rows.part();
		const Vec<T> n = now.hold.way(part);
		const T size = (larger(largest(own.x), largest(other.x)) + (own.radius + other.radius)) + (largest(own.lever) + largest(other.lever));
		Points<T> &points = to[written / lane_count];
		const int32_t i = written % lane_count;
		points.drop(i);
		points.partner[i] = static_cast<T>(now.partner.code);
		points.normal_x[i] = n.x(), points.normal_y[i] = n.y();
		points.arm[i] = now.hold.arm_of(part, own, true, true);
		points.other_arm[i] = now.hold.arm_of(part, other, false, true);
		points.least[i] = is_one_sided(part) ? larger(-now.hold.aim(part, rows.joint()), T(0)) / part_of_step : T(0);
		points.tolerance[i] = T(JOINT_PART) * (size * T(SLOP));
		if (grips)
			grips[written / lane_count].drop(i);
	}
}

/* What a joint keeps of a force at one of its points, whose arm that is; or, by what was kept, of the other bound of two, `beside`. */
template <typename T> T kept_of(Part part, T now, T arm, T beside)
{
	const T force = std::abs(now) < T(JOINT_LEAST) ? T(0) : now;
	switch (part) {
	case Part::rope: return 0 - force;
	case Part::motor:
	case Part::lower:
	case Part::fixed: return force * std::abs(arm);
	case Part::upper: return force > 0 ? 0 - force * std::abs(arm) : beside;
	default: return force;
	}
}

/* And what it then begins with. */
template <typename T> T begun_with(Part part, T kept, T arm)
{
	const T force = is_angular(part) ? (std::abs(arm) > 0 ? kept / std::abs(arm) : T(0)) : kept;
	return is_one_sided(part) ? larger(part == Part::lower ? force : 0 - force, T(0)) : force;
}

/* Where it is kept. */
template <typename T> T &kept_at(Joint<T> &joint, Part part)
{
	return joint.forces[part == Part::motor ? JOINT_TORQUE : is_angular(part) ? JOINT_STOP : JOINT_FORCE + (part == Part::pin_y)];
}

/* Forces begin with the last ones, but where these have led astray: what iterations can't find would add up from step to step. What they pull at the body's levers holds its angle, like a
 * spring; where that is too fast for the step they turn the body less, as if they knew how far it will have turned. */
template <typename T> void warm_joined(const Rests<T> &rests, const Joints<T> &joints, int32_t s)
{
	int32_t point = 0;
	bool is_astray = false;
	Vec<T> lever(0, 0);
	T holds = 0;
	for (JointRows<T> rows(joints, rests.slots[s].body()); rows.has() && point < rests.touching[s].joined; rows.next(), point++) {
		Points<T> &points = rests.points[rests.touching[s].first + point / lane_count];
		const int32_t i = point % lane_count;
		if (rows.begins()) {
			const HeldNow<T> now(rows, rests.slots, rests.places, s);
			is_astray = now.hold.astray(rows.joint()) > T(JOINT_ASTRAY) * points.tolerance[i];
			lever = now.own.lever;
		}
		const T kept = begun_with(rows.part(), kept_at(rows.joint(), rows.part()), points.arm[i]);
		const T last = begun(rests, rests.slots[s], Partner(points.partner[i]), kept, rests.length);
		points.force[i] = points.start[i] = is_astray ? T(0) : last;
		if (!is_angular(rows.part()))
			holds += last * inner(Vec<T>(points.normal_x[i], points.normal_y[i]), lever);
	}
	holds *= rests.slots[s].mass[MASS_INVERSE_INERTIA];
	rests.touching[s].turns = holds > T(JOINT_STIFF) ? static_cast<float>(1 / (1 + T(0.5) * holds)) : 1.0f;
}

/* Is it looked, after so many iterations, where all would get? */
inline bool is_aimed(int32_t done)
{
	return done >= 0 && done < 31 && (JOINT_AIMED >> done & 1) != 0;
}

/* A joint of the body in a slot, once it is known where all would get with the forces that there are. */
template <typename T> class Aim
{
public:
	Aim(const Rests<T> &all, const JointRows<T> &joints, const Lanes<T> *now, int32_t slot, Partner other_slot)
		: rests(&all), rows(&joints), loads(now), s(slot), partner(other_slot), own(own_at(false)), other(other_at(false)),
		  held(joints.joint(), joints.is_other(), own, other, false)
	{
	}

	/* Whether the step is too long, by what the forces at its point, of a pin at both, add up to. */
	void choose(T forces)
	{
		const Joint<T> &joint = rows->joint();
		const T far = T(JOINT_FAR) * (own.radius + other.radius);
		T gives = own.gives() + other.gives();
		if (!joint.turns())
			gives += (own.inverse_mass + other.inverse_mass) / joint.parties[JOINT_LENGTH];
		if (joint.is(JOINT_SLIDER))
			gives += largest(held.slid) * (rows->is_other() ? own : other).inverse_inertia;
		const T least = joint.is(JOINT_ROPE) ? -held.target[0] : std::abs(held.target[0]);
		is_stiff = joint.is(JOINT_SPRING) ? joint.answer(rests->length, rests->part).at_end
										  : forces * gives > T(JOINT_STIFF) || least > far || std::abs(held.target[1]) > far;
		if (!is_stiff)
			return;
		own = own_at(true), other = other_at(true);
		held = Hold<T>(joint, rows->is_other(), own, other, true);
	}

	void write(Points<T> &points, int32_t i) const
	{
		const Part part = rows->part();
		const Vec<T> n = held.way(part);
		points.normal_x[i] = n.x(), points.normal_y[i] = n.y();
		points.arm[i] = held.arm_of(part, own, true, is_stiff);
		points.other_arm[i] = held.arm_of(part, other, false, is_stiff);
		const T parts = along(n, s, points.arm[i]) - along(n, partner.slot(), points.other_arm[i]);
		if (part == Part::spring)
			points.least[i] = spring(n, parts);
		else if (part == Part::motor)
			points.least[i] = at_last((rows->joint().drive[DRIVE_SPEED] * rests->length) * held.arm, parts);
		else
			points.least[i] = least(part, parts);
	}

private:
	Held<T> own_at(bool by_velocity) const { return at(s, rows->joint().anchors[rows->is_other()], by_velocity); }

	Held<T> other_at(bool by_velocity) const
	{
		return partner.moves() ? at(partner.slot(), rows->joint().anchors[!rows->is_other()], by_velocity)
							   : HeldNow<T>::other_of(*rows, rests->slots, rests->places);
	}

	Held<T> at(int32_t slot_index, const T *anchor, bool by_velocity) const
	{
		const Slot<T> &slot = rests->slots[slot_index];
		const Lanes<T> &load = loads[LOADS_OF(slot_index)];
		const T k = rests->part, before = by_velocity ? k : k * (1 - T(0.5) * k), after = by_velocity ? T(0) : T(0.5) * (k * k);
		const auto way = [&](T velocity, T with_forces) { return (velocity * rests->length) * before + with_forces * after; };
		return Held<T>(slot, anchor, {way(slot.place[LINEAR_VX], load[0]), way(slot.place[LINEAR_VY], load[1])},
			way(slot.turn[TURN_VELOCITY], load[2]));
	}

	/* How far a body gets along n, as it moves now. */
	T along(const Vec<T> &n, int32_t slot_index, T arm) const
	{
		if (slot_index < 0)
			return 0;
		const Slot<T> &slot = rests->slots[slot_index];
		return (n.x() * (slot.place[LINEAR_VX] * rests->length) + n.y() * (slot.place[LINEAR_VY] * rests->length))
			+ arm * (slot.turn[TURN_VELOCITY] * rests->length);
	}

	/* So that they have that rate, as a way of a whole step, when the step ends. */
	T at_last(T rate, T parts) const { return -((rate - (1 - rests->part) * parts) / rests->part); }

	/* By the end of the step each anchor, or angle, is where it belongs; of a short step as much nearer as it is of a whole one. */
	T least(Part part, T parts) const
	{
		const T most = T(JOINT_MOST) * (own.radius + other.radius), far = T(JOINT_FAR) * (own.radius + other.radius), k = rests->part;
		const T aim = held.aim(part, rows->joint()), up = smaller(aim, most), target = is_one_sided(part) ? up : larger(up, -most);
		const bool eases = is_angular(part) ? (is_one_sided(part) ? aim : std::abs(aim)) > far : is_stiff;
		const T way = is_one_sided(part) && target < 0 ? target : k * target;
		return eases ? at_last(T(EASE) * target, parts) : (2 / k - 1) * parts - (2 / (k * k)) * way;
	}

	/* What a spring pulls with where all get as they would now, but for what it gives way by then: that comes with its force. */
	T spring(const Vec<T> &n, T parts) const
	{
		const Springing<T> answer = rows->joint().answer(rests->length, rests->part);
		const T rest = rows->joint().parties[JOINT_LENGTH], k = rests->part;
		if (is_stiff) {
			const T pull = answer.stiffness * ((held.last_distance - k * parts) - rest);
			return (pull + (answer.stiffness * k + answer.damping) * ((1 - k) * parts)) / answer.per_way;
		}
		const T way = inner(n, held.gone), mean = T(0.5) * (held.distance + held.last_distance) - rest;
		const T pull = answer.stiffness * (held.straight * mean - T(0.5) * way)
			+ (answer.damping / k) * (held.straight * (held.last_distance - held.distance) - way);
		return (2 / k - 1) * parts + pull / answer.per_way;
	}

	const Rests<T> *rests;
	const JointRows<T> *rows;
	const Lanes<T> *loads; /* of the iteration's parity */
	int32_t s;
	Partner partner;
	Held<T> own, other;
	Hold<T> held;
	bool is_stiff = false;
};

/* What forces are to do, once it is known where all would get with those that they begin with. */
template <typename T>
[[gnu::noinline, gnu::flatten]] void aim_joined(const Rests<T> &rests, const Joints<T> &joints, const Lanes<T> *loads, int32_t s, int32_t now)
{
	int32_t point = 0;
	std::optional<Aim<T>> aim;
	for (JointRows<T> rows(joints, rests.slots[s].body()); rows.has(); rows.next(), point++) {
		const auto four = [&](int32_t k) -> Points<T> & { return rests.points[rests.touching[s].first + (point + k) / lane_count]; };
		const auto force = [&](int32_t k) { return std::abs(four(k).force[(point + k) % lane_count]); };
		const int32_t i = point % lane_count;
		if (rows.begins()) {
			aim.emplace(rests, rows, loads + now, s, Partner(four(0).partner[i]));
			if (rows.is_firm() || !is_angular(rows.part()))
				aim->choose(rows.part() == Part::pin_x ? force(0) + force(1) : force(0));
		}
		aim->write(four(0), i);
	}
}

/* Keeps the forces for the next step, each at one of its two bodies. True if this one began with the same. */
template <typename T> bool keep_joined(const Rests<T> &rests, const Joints<T> &joints, const Kept<T> *kept, int32_t s, const Vec<T> &ground, T length)
{
	const bool bears = rests.touching[rests.islands.parents[s]].wanted == rests.status[STATUS_FIRST] && kept[s].is_at_rest(ground);
	int32_t point = 0;
	T beside = 0; /* of the row before */
	bool are_same = true;
	if (rests.touching[s].joined == 0)
		return true;
	for (JointRows<T> rows(joints, rests.slots[s].body()); rows.has(); rows.next(), point++) {
		const Points<T> &points = rests.points[rests.touching[s].first + point / lane_count];
		const int32_t i = point % lane_count;
		const Partner partner(points.partner[i]);
		if ((rows.is_other() && rests.gives_way(partner)) || (bears && was_still(kept, partner, ground)))
			continue;
		const T now = kept_of(rows.part(), (points.force[i] / length) / length, points.arm[i], beside);
		beside = now;
		if (rows.part() == Part::lower)
			continue; /* it is kept with the upper one */
		T &at = kept_at(rows.joint(), rows.part());
		are_same = are_same && now == at;
		at = now;
	}
	return are_same;
}

}

#endif
