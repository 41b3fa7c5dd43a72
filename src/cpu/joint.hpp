/* A joint, its points, and what it holds: CONTRACT.md, "contacts", Joints. */
#ifndef CAROM_CPU_JOINT_HPP
#define CAROM_CPU_JOINT_HPP

#include "cpu/keep.hpp"

namespace carom::cpu {

/* What a point of a joint is for. */
enum class Part { pin_x, pin_y, rod, rope, spring, line, motor, lower, upper, fixed };

/* Does it hold the bodies' angles, not their anchors? */
inline bool is_angular(Part part)
{
	return part >= Part::motor;
}

/* Does it push one way alone? */
inline bool is_one_sided(Part part)
{
	return part == Part::rope || part == Part::lower || part == Part::upper;
}

/* What a spring pulls with, kg: by how far its anchors are apart, and by their speed; and by what that, as a way of a whole step, comes to be. */
template <typename T> struct Springing {
	T stiffness, damping, per_way;
	bool at_end; /* the step is too long to swing in */
};

/* The records of a joint. */
template <typename T> struct Joint {
	T parties[4], anchors[2][2], forces[4], drive[4];

	bool is(int32_t kind) const { return parties[JOINT_KIND] == static_cast<T>(kind); }
	/* Do its bodies turn against each other about the anchor? */
	bool turns() const { return is(JOINT_PIN) || is(JOINT_SLIDER); }
	bool has_motor() const { return turns() && drive[DRIVE_TORQUE] > 0; }
	bool is_fixed() const { return turns() && drive[DRIVE_HALF] == 0; }
	bool has_stops() const { return turns() && drive[DRIVE_HALF] > 0; }

	/* How many push and pull as is needed: those are firm; or how many others there are. */
	int32_t points(bool firm) const
	{
		if (firm)
			return is(JOINT_PIN) ? 2 + is_fixed() : is(JOINT_SLIDER) ? 1 + is_fixed() : is(JOINT_ROD);
		return turns() ? has_motor() + 2 * has_stops() : !is(JOINT_ROD);
	}

	/* In such a part of a whole step of that length. */
	Springing<T> answer(T length, T k) const
	{
		const T most = SPRING_MOST, stiffness = smaller((drive[SPRING_STIFFNESS] * length) * length, most);
		const T damping = smaller(drive[SPRING_DAMPING] * length, most);
		const bool at_end = (T(0.5) * stiffness + damping) * drive[DRIVE_GIVES] > T(SPRING_STIFF);
		const T per_way = at_end ? k * (stiffness * k + damping) : T(0.5) * (k * k) * (T(0.5) * stiffness + damping / k);
		return {stiffness, damping, larger(per_way, T(SPRING_LEAST)), at_end};
	}

	/* How what has a length holds what it joins where that is across it, kg, by the tension that the last step ended with; 0 where a step of that length is not too long for it, and of others. */
	T aside(T length) const
	{
		const T tension = larger(-((forces[JOINT_FORCE] * length) * length), T(0)), rest = parties[JOINT_LENGTH];
		if (turns() || !(tension > 0))
			return 0;
		T holds = tension / rest;
		if (is(JOINT_SPRING)) {
			const Springing<T> spring = answer(length, 1);
			holds = spring.at_end ? (tension * spring.stiffness) / (rest * spring.stiffness + tension) : T(0);
		}
		return holds * drive[DRIVE_GIVES] > T(JOINT_STIFF) ? holds : T(0);
	}

	Part part(bool firm, int32_t k) const
	{
		if (firm)
			return is(JOINT_ROD)         ? Part::rod
				: k == is(JOINT_PIN) + 1 ? Part::fixed
				: is(JOINT_SLIDER)       ? Part::line
				: k == 0                 ? Part::pin_x
										 : Part::pin_y;
		if (!turns())
			return is(JOINT_ROPE) ? Part::rope : Part::spring;
		return has_motor() && k == 0 ? Part::motor : k == has_motor() ? Part::lower : Part::upper;
	}
};

static_assert(sizeof(Joint<float>) == JOINT_WIDTH * 4 * sizeof(float), "joints");

/* Of all bodies. */
template <typename T> class Joints
{
public:
	Joints(T *records, const int32_t *joined) : joints(reinterpret_cast<Joint<T> *>(records)), list(joined) {}

	bool has_any() const { return list[JOINED_COUNT] > 0; }
	/* A body's first joint, as a side (see Joined), -1 for none; and the same body's next one. */
	int32_t first_side(int32_t body) const { return has_any() ? list[JOINED_FIRST + body] : -1; }
	int32_t next_side(int32_t side) const { return list[JOINED_NEXT(list[JOINED_BODIES], side)]; }
	Joint<T> &of(int32_t side) const { return joints[side / 2]; }
	/* The body at the other end, -1 for none. */
	int32_t partner(int32_t side) const { return static_cast<int32_t>(of(side).parties[is_other(side) ? JOINT_BODY : JOINT_OTHER]); }
	/* Is it the joint's other body's? */
	static bool is_other(int32_t side) { return side % 2 == 1; }
	/* A body's anchor, in its own frame, or a place. */
	const T *anchor(int32_t side) const { return of(side).anchors[is_other(side)]; }
	const T *other_anchor(int32_t side) const { return of(side).anchors[!is_other(side)]; }

	/* Calls `visit(side)` for each of a body's joints that holds aside in a step of that length, in order. */
	template <typename Visit> void each_aside(int32_t body, T length, const Visit &visit) const
	{
		for (int32_t side = first_side(body); side >= 0; side = next_side(side))
			if (of(side).aside(length) > 0)
				visit(side);
	}

private:
	Joint<T> *const joints;
	const int32_t *const list;
};

/* Goes through the points of a body's joints: first those that are firm, of one joint after the other, and then the others. */
template <typename T> class JointRows
{
public:
	JointRows(const Joints<T> &all, int32_t body) : joints(all), first(all.first_side(body)), side(first) { settle(); }
	/* The others alone, of a body that has any. */
	static JointRows others(const Joints<T> &all, int32_t body, bool has_any) { return JointRows(all, has_any ? all.first_side(body) : -1, false); }

	bool has() const { return side >= 0; }
	void next()
	{
		k++;
		settle();
	}

	Joint<T> &joint() const { return joints.of(side); }
	bool is_firm() const { return firm; }
	/* Of the joint. */
	int32_t which_side() const { return side; }
	bool is_other() const { return Joints<T>::is_other(side); }
	int32_t partner() const { return joints.partner(side); }
	/* Is it the first of its joint's that are firm, or that are not? */
	bool begins() const { return k == 0; }
	Part part() const { return joint().part(firm, k); }

private:
	JointRows(const Joints<T> &all, int32_t from, bool begins_firm) : joints(all), first(from), side(from), firm(begins_firm) { settle(); }

	void settle()
	{
		while (side >= 0 && k == joint().points(firm)) {
			k = 0;
			side = joints.next_side(side);
			if (side < 0 && firm)
				firm = false, side = first;
		}
	}

	const Joints<T> &joints;
	const int32_t first;
	int32_t side, k = 0;
	bool firm = true;
};

/* One of the two bodies, as it gets from where it is to the end of a way, or a place in the world. */
template <typename T> struct Held {
	Vec<T> x = {0, 0}, way = {0, 0}, lever = {0, 0}, last_lever = {0, 0};
	T angle = 0, turned = 0, radius = 0, inverse_mass = 0, inverse_inertia = 0;

	Held() = default;
	/* A place in the world. */
	explicit Held(const T *anchor) : x(anchor[0], anchor[1]) {}
	/* What stays where it is. */
	Held(const Slot<T> &slot, const T *anchor)
		: x(slot.place[LINEAR_X], slot.place[LINEAR_Y]), lever(turn(rotation_of(slot.turn[TURN_ANGLE]), Vec<T>(anchor[0], anchor[1]))),
		  last_lever(lever), angle(slot.turn[TURN_ANGLE]), radius(slot.radius()), inverse_mass(slot.mass[MASS_INVERSE]),
		  inverse_inertia(slot.mass[MASS_INVERSE_INERTIA])
	{
	}
	/* The same where it was before; of the slot only what does not change counts. */
	Held(const Slot<T> &slot, const T *anchor, const Kept<T> &before)
		: x(before.place[0], before.place[1]), lever(turn(rotation_of(before.place[2]), Vec<T>(anchor[0], anchor[1]))), last_lever(lever),
		  angle(before.place[2]), inverse_mass(slot.mass[MASS_INVERSE]), inverse_inertia(slot.mass[MASS_INVERSE_INERTIA])
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

	/* m, the radius of gyration; 0 of what does not move, or turn. */
	T gyration() const { return inverse_inertia > 0 ? std::sqrt(inverse_mass / inverse_inertia) : T(0); }
};

/* How a joint holds one of its bodies, seen from the other: along which ways, so that forces along them do no work, and how far the anchors are to get along them. */
template <typename T> struct Hold {
	Vec<T> n[2] = {{0, 0}, {0, 0}}, gone = {0, 0}; /* gone: how far the anchors get, one seen from the other */
	T target[2] = {0, 0};
	/* Of what has a length: how far the anchors are, and come to be; and how much of that the way in the middle has. */
	T distance = 0, last_distance = 0, straight = 0;
	/* m, the arm of forces that turn; and rad, from the middle of the stops. */
	T arm = 0, turned = 0;
	T sign = 1;
	/* Of a slider, from the anchor on the line to the other one, as the way begins and ends; and how far the line turns. */
	Vec<T> slid = {0, 0}, last_slid = {0, 0};
	T line_turned = 0;
	bool owns_line = false, has_line = false;

	Hold() = default;
	Hold(const Joint<T> &joint, bool is_other, const Held<T> &own, const Held<T> &other, bool at_end)
		: gone((own.way - other.way) + ((own.last_lever - own.lever) - (other.last_lever - other.lever))), sign(is_other ? T(-1) : T(1))
	{
		const Vec<T> first = (own.x - other.x) + (own.lever - other.lever);
		if (joint.turns()) {
			if (joint.is(JOINT_PIN)) {
				n[0] = Vec<T>(sign, 0), n[1] = Vec<T>(0, sign);
				target[0] = -inner(n[0], first), target[1] = -inner(n[1], first);
			} else {
				slide(joint, is_other ? own : other, first, at_end);
			}
			if (!joint.is_fixed() && joint.points(false) == 0)
				return;
			arm = larger(own.gyration(), other.gyration());
			turned = wrapped((is_other ? other.angle - own.angle : own.angle - other.angle) - joint.drive[DRIVE_MIDDLE]);
			return;
		}
		const Vec<T> last = first + gone, twice = at_end ? last : Vec<T>(first + last);
		const T length = joint.parties[JOINT_LENGTH], size = norm(twice);
		distance = norm(first), last_distance = norm(last);
		n[0] = size > 0 ? Vec<T>(twice.x() / size, twice.y() / size) : Vec<T>(sign, 0);
		target[0] = at_end ? length - distance : (length - distance) * ((length + distance) / larger(size, length));
		straight = distance + last_distance > 0 ? size / (distance + last_distance) : T(1);
	}

	/* Of one of its points. */
	Vec<T> way(Part part) const
	{
		if (is_angular(part))
			return {0, 0};
		return part == Part::rope ? Vec<T>(-n[0]) : n[part == Part::pin_y];
	}

	/* Of a point, of one of the two. */
	T arm_of(Part part, const Held<T> &body, bool is_own, bool at_end) const
	{
		if (is_angular(part))
			return part == Part::upper ? -(sign * arm) : sign * arm;
		const Vec<T> along = way(part);
		const T own = body.arm(along, at_end);
		if (!has_line || is_own != owns_line)
			return own;
		return own
			+ (at_end ? cross(last_slid, along)
					  : cross(Vec<T>(T(0.5) * (slid + last_slid)), along) * (1 + (line_turned * line_turned) * T(1.0f / 12)));
	}

	/* A slider, whose line that body has. */
	void slide(const Joint<T> &joint, const Held<T> &owner, const Vec<T> &first, bool at_end)
	{
		const T axis = joint.parties[JOINT_LENGTH];
		const auto normal = [&](T angle) {
			const Vec<T> along = rotation_of(angle);
			return Vec<T>(sign * -along.y(), sign * along.x());
		};
		has_line = true, owns_line = sign < 0;
		slid = sign * first, last_slid = sign * (first + gone), line_turned = owner.turned;
		n[0] = normal((owner.angle + axis) + (at_end ? owner.turned : T(0.5) * owner.turned));
		target[0] = -inner(normal(owner.angle + axis), first);
	}

	/* How far the anchors are from where they belong, or an angle that is fixed; of a spring that is too stiff for a step of that length, from where the last force has them. */
	T astray(const Joint<T> &joint, T length) const
	{
		if (joint.is(JOINT_SPRING)) {
			const T stiffness = joint.drive[SPRING_STIFFNESS];
			return stiffness > 0 && joint.answer(length, 1).at_end ? std::abs(joint.forces[JOINT_FORCE] / stiffness - target[0]) : T(0);
		}
		const T anchors = larger(std::abs(target[0]), std::abs(target[1]));
		return joint.is_fixed() ? larger(anchors, std::abs(turned * arm)) : anchors;
	}

	/* How far the two are to get, at least where it pushes one way alone. */
	T aim(Part part, const Joint<T> &joint) const
	{
		const T half = joint.drive[DRIVE_HALF];
		switch (part) {
		case Part::rope: return -target[0];
		case Part::lower: return -((turned + half) * arm);
		case Part::upper: return -((half - turned) * arm);
		case Part::fixed: return -(turned * arm);
		default: return target[part == Part::pin_y];
		}
	}
};

/* Where a joint keeps the force of a point. */
inline int kept_at(Part part)
{
	return part == Part::motor ? JOINT_TORQUE : is_angular(part) ? JOINT_STOP : JOINT_FORCE + (part == Part::pin_y);
}

/* What a point begins with, by what was kept. */
template <typename T> T begun_with(Part part, T kept, T arm)
{
	const T force = is_angular(part) ? (std::abs(arm) > 0 ? kept / std::abs(arm) : T(0)) : kept;
	return is_one_sided(part) ? larger(part == Part::lower ? force : 0 - force, T(0)) : force;
}

/* What one that pushes one way has to take back. */
template <typename T> T taken_back(const Joint<T> &joint, Part part, T arm)
{
	return part == Part::rope ? larger(joint.forces[JOINT_BACK], T(0)) : begun_with(part, 0 - joint.forces[kept_at(part)], arm);
}

/* What the force at a point of a joint may be. */
template <typename T> struct ForceBounds {
	T low, high = infinite<T>;

	/* Of a point with that arm. Impulses at a bound that has been reached take back what its force made of a speed if it brought its bodies there in the last step, as is kept then: they stop there. */
	ForceBounds(const Joint<T> &joint, Part part, T arm, T free, T length, bool impulses) : low(is_one_sided(part) ? T(0) : -infinite<T>)
	{
		if (impulses && (part == Part::motor || part == Part::spring))
			low = high = 0;
		else if (impulses && is_one_sided(part) && !(free > 0))
			low = 0 - (taken_back(joint, part, arm) * length) * length;
		else if (part == Part::motor)
			high = ((joint.drive[DRIVE_TORQUE] * length) * length) / std::abs(arm), low = -high;
	}
};

}

#endif
