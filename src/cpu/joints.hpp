/* What joints hold, as points of Contacts that pull as well as push: CONTRACT.md, "contacts", Joints. */
#ifndef CAROM_CPU_JOINTS_HPP
#define CAROM_CPU_JOINTS_HPP

#include "cpu/joint.hpp"

#include <optional>

namespace carom::cpu {

/* Of a dynamic body, or a kinematic one, which has no points; those with which it is joined wake, if it is awake. */
template <typename T>
JoinedCount count_joined(const Joints<T> &joints, const Slot<T> *slots, const int32_t *places, const Sleepers<T> &sleepers, int32_t s, T length)
{
	JoinedCount count;
	if (slots[s].is_static())
		return count;
	for (JointRows<T> rows(joints, slots[s].body()); rows.has(); rows.next()) {
		count.rows++;
		count.firm += rows.is_firm();
		if (const int32_t partner = rows.partner(); partner >= 0 && !sleepers.sleeps(s) && sleepers.sleeps(places[partner]))
			sleepers.disturb(places[partner]);
	}
	count.all = count.rows;
	joints.each_aside(slots[s].body(), length, [&](int32_t) { count.all++; });
	return slots[s].is_dynamic() ? count : JoinedCount{};
}

/* How a joint holds the body in slot s as the step begins. */
template <typename T> struct HeldNow {
	Held<T> own, other;
	Hold<T> hold;
	Partner partner;

	HeldNow() = default;
	HeldNow(const Joints<T> &joints, int32_t side, const Slot<T> *slots, const int32_t *places, int32_t s)
		: own(slots[s], joints.anchor(side)), other(other_of(joints, side, slots, places)),
		  hold(joints.of(side), Joints<T>::is_other(side), own, other, true)
	{
		const int32_t body = joints.partner(side);
		if (body < 0)
			partner = Partner::that_stays(-1);
		else
			partner = slots[places[body]].is_static() ? Partner::that_stays(body) : Partner(places[body]);
	}

	static Held<T> other_of(const Joints<T> &joints, int32_t side, const Slot<T> *slots, const int32_t *places)
	{
		const int32_t body = joints.partner(side);
		return body < 0 ? Held<T>(joints.other_anchor(side)) : Held<T>(slots[places[body]], joints.other_anchor(side));
	}

	/* What forces at its points are found within. */
	T tolerance() const
	{
		const T size = (larger(largest(own.x), largest(other.x)) + (own.radius + other.radius)) + (largest(own.lever) + largest(other.lever));
		return T(JOINT_PART) * (size * T(SLOP));
	}
};

/* How far what pushes one way alone lets its bodies get before it acts; none of what has reached its bound, to what that is found within. */
template <typename T> T free_way(T way, T tolerance)
{
	return way > JOINT_REACHED * tolerance ? way : T(0);
}

/* Writes the points, which come first of a body's. Impulses let what is still apart get as far as its bound in the step, and no farther; what holds aside does nothing yet. */
template <typename T>
void write_joined(const Joints<T> &joints, const Slot<T> *slots, const int32_t *places, T length, T part_of_step, int32_t s, Points<T> *to,
	Grips<T> *grips)
{
	int32_t written = 0;
	HeldNow<T> now;
	T tolerance = 0;
	const auto write = [&](const Vec<T> &n, T arm, T other_arm, T least) {
		Points<T> &points = to[written / lane_count];
		const int32_t i = written % lane_count;
		points.drop(i);
		points.partner[i] = static_cast<T>(now.partner.code);
		points.normal_x[i] = n.x(), points.normal_y[i] = n.y();
		points.arm[i] = arm, points.other_arm[i] = other_arm;
		points.least[i] = least, points.tolerance[i] = tolerance;
		if (grips)
			grips[written / lane_count].drop(i);
		written++;
	};
	for (JointRows<T> rows(joints, slots[s].body()); rows.has(); rows.next()) {
		if (rows.begins()) {
			now = HeldNow<T>(joints, rows.which_side(), slots, places, s);
			tolerance = now.tolerance();
		}
		const Part part = rows.part();
		write(now.hold.way(part), now.hold.arm_of(part, now.own, true, true), now.hold.arm_of(part, now.other, false, true),
			is_one_sided(part) ? free_way(-now.hold.aim(part, rows.joint()), tolerance) / part_of_step : T(0));
	}
	joints.each_aside(slots[s].body(), length, [&](int32_t side) {
		now = HeldNow<T>(joints, side, slots, places, s);
		tolerance = now.tolerance();
		write({0, 0}, 0, 0, 0);
	});
}

/* What a joint keeps of a force at one of its points, whose arm that is; or, by what was kept, of the other bound of two, `beside`. `is_back`: of a stop, as what it has to take back. */
template <typename T> T kept_of(Part part, T now, T arm, T beside, bool is_back)
{
	const T size = std::abs(now) < T(JOINT_LEAST) ? T(0) : now, force = is_back ? 0 - size : size;
	switch (part) {
	case Part::rope: return 0 - size;
	case Part::motor:
	case Part::lower:
	case Part::fixed: return force * std::abs(arm);
	case Part::upper: return size > 0 ? 0 - force * std::abs(arm) : beside;
	default: return force;
	}
}

/* Calls `visit(rows, points, i, last)` for each point of a body's joints, `last` being the force that the step before left there. Returns how fast those hold its angle, by what they pull at
 * its levers, as a spring would. */
template <typename T, typename Visit> T visit_last(const Rests<T> &rests, const Joints<T> &joints, int32_t s, const Visit &visit)
{
	int32_t point = 0;
	Vec<T> lever(0, 0);
	T holds = 0;
	for (JointRows<T> rows(joints, rests.slots[s].body()); rows.has() && point < rests.touching[s].joined; rows.next(), point++) {
		Points<T> &points = rests.points[rests.touching[s].first + point / lane_count];
		const int32_t i = point % lane_count;
		if (rows.begins())
			lever = Held<T>(rests.slots[s], joints.anchor(rows.which_side())).lever;
		const bool is_free = points.least[i] > 0 && is_angular(rows.part()); /* a stop that is not reached: it is the other one's */
		const T kept = is_free ? T(0) : begun_with(rows.part(), rows.joint().forces[kept_at(rows.part())], points.arm[i]);
		const T last = begun(rests, rests.slots[s], Partner(points.partner[i]), kept, rests.length);
		visit(rows, points, i, last);
		if (!is_angular(rows.part()))
			holds += last * inner(Vec<T>(points.normal_x[i], points.normal_y[i]), lever);
	}
	return holds * rests.slots[s].mass[MASS_INVERSE_INERTIA];
}

/* Did impulses of the joints of a body's island come to no end, though none of them is tense? Then forces would not, either, and might give energy. */
template <typename T> bool is_tired(const Rests<T> &rests, int32_t s)
{
	return (rests.touching[rests.islands.parents[s]].footing & (FOOTING_TIRED | FOOTING_TENSE)) == FOOTING_TIRED;
}

/* After the last iteration of impulses that a body with joints can have: says that of its island, if it wants one more. */
template <typename T> void tire(const Rests<T> &rests, const Joints<T> &joints, int32_t s, bool wants)
{
	const Touching &own = rests.touching[s];
	int32_t rows = 0;
	const T holds = visit_last(rests, joints, s, [&rows](const JointRows<T> &, const Points<T> &, int32_t, T) { rows++; });
	const int32_t tense = holds > T(JOINT_STIFF) || own.joined > rows ? FOOTING_TENSE : 0;
	__atomic_fetch_or(&rests.touching[rests.islands.parents[s]].footing, (wants ? FOOTING_TIRED : 0) | tense, __ATOMIC_RELAXED);
}

/* Forces begin with the last ones, but where these have led astray, or the island is tired: what iterations can't find would add up from step to step. Where they hold the body's angle too
 * fast for the step they turn it less, as if they knew how far it will have turned. */
template <typename T> void warm_joined(const Rests<T> &rests, const Joints<T> &joints, int32_t s)
{
	const bool tired = is_tired(rests, s);
	bool is_astray = false;
	const T holds = visit_last(rests, joints, s, [&](const JointRows<T> &rows, Points<T> &points, int32_t i, T last) {
		if (rows.begins()) {
			const HeldNow<T> now(joints, rows.which_side(), rests.slots, rests.places, s);
			is_astray = now.hold.astray(rows.joint(), rests.length) > T(JOINT_ASTRAY) * points.tolerance[i];
		}
		points.force[i] = points.start[i] = tired || is_astray ? T(0) : last;
	});
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
	Aim(const Rests<T> &all, const Joints<T> &every_joint, int32_t slot_side, const Lanes<T> *now, int32_t slot, Partner other_slot, bool at_end)
		: rests(&all), joints(&every_joint), side(slot_side), loads(now), s(slot), partner(other_slot), own(own_at(at_end)), other(other_at(at_end)),
		  held(every_joint.of(slot_side), Joints<T>::is_other(slot_side), own, other, at_end), is_stiff(at_end), tired(is_tired(all, slot))
	{
	}

	/* Whether the step is too long, by what the forces at its point, of a pin at both, add up to, or the island is tired. */
	void choose(T forces)
	{
		const Joint<T> &joint = joints->of(side);
		const T far = T(JOINT_FAR) * (own.radius + other.radius);
		T gives = own.gives() + other.gives();
		if (!joint.turns())
			gives += (own.inverse_mass + other.inverse_mass) / joint.parties[JOINT_LENGTH];
		if (joint.is(JOINT_SLIDER))
			gives += largest(held.slid) * (Joints<T>::is_other(side) ? own : other).inverse_inertia;
		const T least = joint.is(JOINT_ROPE) ? -held.target[0] : std::abs(held.target[0]);
		is_stiff = joint.is(JOINT_SPRING)
			? joint.answer(rests->length, rests->part).at_end
			: (tired && !joint.is(JOINT_ROPE)) || forces * gives > T(JOINT_STIFF) || least > far || std::abs(held.target[1]) > far;
		if (is_stiff)
			*this = Aim(*rests, *joints, side, loads, s, partner, true);
	}

	void write(Part part, Points<T> &points, int32_t i) const
	{
		const Vec<T> n = held.way(part);
		turn_to(points, i, n, held.arm_of(part, own, true, is_stiff), held.arm_of(part, other, false, is_stiff));
		const T parts = parting(n, points.arm[i], points.other_arm[i]);
		if (part == Part::spring) {
			const Springing<T> answer = joints->of(side).answer(rests->length, rests->part);
			points.least[i] = spring(answer, n, parts);
			points.give[i] = 1 / answer.per_way;
		} else if (part == Part::motor)
			points.least[i] = at_last((joints->of(side).drive[DRIVE_SPEED] * rests->length) * held.arm, parts);
		else
			points.least[i] = least(part, parts);
	}

	/* Of what holds aside: it acts against what forces make of a way across it, for its tension turns with that. */
	void write_aside(Points<T> &points, int32_t i) const
	{
		const Vec<T> n(-held.n[0].y(), held.n[0].x());
		const T k = rests->part;
		turn_to(points, i, n, own.arm(n, true), other.arm(n, true));
		points.least[i] = -parting(n, points.arm[i], points.other_arm[i]);
		points.give[i] = 1 / larger(joints->of(side).aside(rests->length) * (T(0.5) * (k * k)), T(SPRING_LEAST));
	}

private:
	/* A point acts along n, with those arms. */
	static void turn_to(Points<T> &points, int32_t i, const Vec<T> &n, T arm, T other_arm)
	{
		points.normal_x[i] = n.x(), points.normal_y[i] = n.y();
		points.arm[i] = arm, points.other_arm[i] = other_arm;
	}

	/* How fast a point parts as all moves now. */
	T parting(const Vec<T> &n, T arm, T other_arm) const { return along(n, s, arm) - along(n, partner.slot(), other_arm); }

	Held<T> own_at(bool by_velocity) const { return at(s, joints->anchor(side), by_velocity); }

	Held<T> other_at(bool by_velocity) const
	{
		return partner.moves() ? at(partner.slot(), joints->other_anchor(side), by_velocity)
							   : HeldNow<T>::other_of(*joints, side, rests->slots, rests->places);
	}

	Held<T> at(int32_t slot_index, const T *anchor, bool by_velocity) const
	{
		const Slot<T> &slot = rests->slots[slot_index];
		const Lanes<T> &load = loads[slot_index];
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
		const T aim = held.aim(part, joints->of(side)), up = smaller(aim, most), target = is_one_sided(part) ? up : larger(up, -most);
		const bool eases = is_angular(part) ? (is_one_sided(part) ? aim > far : tired || std::abs(aim) > far) : is_stiff;
		const T way = is_one_sided(part) && target < 0 ? target : k * target;
		return eases ? at_last(T(EASE) * target, parts) : (2 / k - 1) * parts - (2 / (k * k)) * way;
	}

	/* What a spring pulls with where all get as they would now, but for what it gives way by then: that comes with its force. */
	T spring(const Springing<T> &answer, const Vec<T> &n, T parts) const
	{
		const T rest = joints->of(side).parties[JOINT_LENGTH], k = rests->part;
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
	const Joints<T> *joints;
	int32_t side;
	const Lanes<T> *loads; /* of the iteration's parity */
	int32_t s;
	Partner partner;
	Held<T> own, other;
	Hold<T> held;
	bool is_stiff, tired;
};

/* What forces are to do, once it is known where all would get with those that they begin with. */
template <typename T>
[[gnu::noinline, gnu::flatten]] void aim_joined(const Rests<T> &rests, const Joints<T> &joints, const Lanes<T> *loads, int32_t s)
{
	int32_t point = 0;
	std::optional<Aim<T>> aim;
	const auto four = [&](int32_t k) -> Points<T> & { return rests.points[rests.touching[s].first + (point + k) / lane_count]; };
	for (JointRows<T> rows(joints, rests.slots[s].body()); rows.has(); rows.next(), point++) {
		const auto force = [&](int32_t k) { return std::abs(four(k).force[(point + k) % lane_count]); };
		const int32_t i = point % lane_count;
		if (rows.begins()) {
			aim.emplace(rests, joints, rows.which_side(), loads, s, Partner(four(0).partner[i]), false);
			if (rows.is_firm() || !is_angular(rows.part()))
				aim->choose(rows.part() == Part::pin_x ? force(0) + force(1) : force(0));
		}
		aim->write(rows.part(), four(0), i);
	}
	if (rests.touching[s].joined == point)
		return;
	joints.each_aside(rests.slots[s].body(), rests.length, [&](int32_t side) {
		const int32_t i = point % lane_count;
		Aim<T>(rests, joints, side, loads, s, Partner(four(0).partner[i]), true).write_aside(four(0), i);
		point++;
	});
}

/* Were a joint's bodies beyond the bound of what pushes one way when the step began? */
template <typename T>
bool was_beyond(const Rests<T> &rests, const Joints<T> &joints, const Kept<T> *kept, int32_t side, Part part, int32_t s, T tolerance)
{
	const auto before = [&](int32_t slot, const T *anchor) {
		return rests.slots[slot].is_static() ? Held<T>(rests.slots[slot], anchor) : Held<T>(rests.slots[slot], anchor, kept[slot]);
	};
	const int32_t partner = joints.partner(side);
	const Held<T> own = before(s, joints.anchor(side));
	const Held<T> other = partner < 0 ? Held<T>(joints.other_anchor(side)) : before(rests.places[partner], joints.other_anchor(side));
	return Hold<T>(joints.of(side), Joints<T>::is_other(side), own, other, true).aim(part, joints.of(side)) > JOINT_REACHED * tolerance;
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
		const T force = (points.force[i] / length) / length, last = begun_with(rows.part(), rows.joint().forces[kept_at(rows.part())], points.arm[i]);
		const bool is_brought = is_one_sided(rows.part())
			&& (force > T(JOINT_BROUGHT) * last || (force > 0 && taken_back(rows.joint(), rows.part(), points.arm[i]) > 0))
			&& was_beyond(rests, joints, kept, rows.which_side(), rows.part(), s, points.tolerance[i]);
		const T now = kept_of(rows.part(), force, points.arm[i], beside, is_brought);
		beside = now;
		if (rows.part() == Part::lower)
			continue; /* it is kept with the upper one */
		T *const at = rows.joint().forces + kept_at(rows.part());
		are_same = are_same && now == *at;
		*at = now;
		if (rows.part() == Part::rope) {
			const T back = is_brought ? 0 - now : T(0);
			are_same = are_same && back == at[JOINT_BACK - JOINT_FORCE];
			at[JOINT_BACK - JOINT_FORCE] = back;
		}
	}
	return are_same;
}

}

#endif
