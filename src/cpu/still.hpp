/* What lies still, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_STILL_HPP
#define CAROM_CPU_STILL_HPP

#include "cpu/rests.hpp"

namespace carom::cpu {

/* Is what does not give way at rest on the ground? */
template <typename T> bool is_still(const Rests<T> &rests, Partner partner, const Vec<T> &ground)
{
	if (!partner.moves())
		return ground.isZero(0);
	const Slot<T> &slot = rests.slots[partner.slot()];
	return slot.place[LINEAR_VX] == ground.x() && slot.place[LINEAR_VY] == ground.y() && slot.turn[TURN_VELOCITY] == 0;
}

/* How far a body may get in a step that is nearly still: what its forces are found within. 0: it never is, for one point holds nothing, or what it touches does not rub, or neither
 * gives way nor is at rest. */
template <typename T> T nearly_still(const Rests<T> &rests, int32_t s, const Vec<T> &ground)
{
	T least = infinite<T>;
	int32_t count = 0;
	if (!rests.rubs)
		return 0;
	rests.each_point(s, [&](const Points<T> &points, const Grips<T> &grips, int32_t i, Partner partner, int32_t) {
		const bool holds = grips.friction[i] > 0 && (rests.gives_way(partner) || is_still(rests, partner, ground));
		least = holds ? smaller(least, points.tolerance[i]) : T(0);
		count++;
	});
	return count > 1 ? least : T(0);
}

/* The most that a motion, or a push, moves any part of a body along an axis. */
template <typename T> T largest(const Slot<T> &slot, T x, T y, T turning)
{
	return larger(largest(Vec<T>(x, y)), slot.radius() * std::abs(turning));
}

/* Seen from the ground. */
template <typename T> T speed(const Slot<T> &slot, const Vec<T> &ground)
{
	return largest(slot, slot.place[LINEAR_VX] - ground.x(), slot.place[LINEAR_VY] - ground.y(), slot.turn[TURN_VELOCITY]);
}

template <typename T> void set_still(Slot<T> &slot, const Vec<T> &ground)
{
	slot.place[LINEAR_VX] = ground.x(), slot.place[LINEAR_VY] = ground.y(), slot.turn[TURN_VELOCITY] = 0;
}

/* Is nothing left of a body's push? */
template <typename T> bool is_unpushed(const Slot<T> &slot)
{
	return slot.push[PUSH_X] == 0 && slot.push[PUSH_Y] == 0 && slot.push[PUSH_TORQUE] == 0;
}

template <typename T> T pushed_by(const Slot<T> &slot)
{
	return largest(slot, slot.push[PUSH_X], slot.push[PUSH_Y], slot.push[PUSH_TORQUE]);
}

/* Is that far in a step too little to move a body that is at rest? */
template <typename T> bool is_slight(const Rests<T> &rests, int32_t s, const Vec<T> &ground, T way)
{
	return way < T(STILL_PUSH) * nearly_still(rests, s, ground);
}

/* Does it touch anything that was at rest as the step began? */
template <typename T> bool leans_on_rest(const Rests<T> &rests, int32_t s, const Vec<T> &ground, const Kept<T> *kept)
{
	bool leans = false;
	rests.each_point(s,
		[&](const Points<T> &, const Grips<T> &, int32_t, Partner partner, int32_t) { leans = leans || was_still(kept, partner, ground); });
	return leans;
}

/* What its island is on, of a slot whose forces are found: noted at the root, and whether it slides at the slot. */
template <typename T> void find_footing(const Rests<T> &rests, int32_t s, const Vec<T> &ground)
{
	int32_t own = 0, all = 0;
	if (!rests.rubs)
		return;
	rests.each_point(s, [&](const Points<T> &points, const Grips<T> &grips, int32_t i, Partner partner, int32_t) {
		if (!(points.force[i] > 0))
			return;
		const bool slides = !(std::abs(grips.force[i]) < grips.bound[i]);
		if (slides)
			own = FOOTING_SLIDES;
		if (!rests.gives_way(partner))
			all |= slides || !is_still(rests, partner, ground) ? FOOTING_LOOSE : FOOTING_FIRM;
	});
	__atomic_fetch_or(&rests.touching[s].footing, own, __ATOMIC_RELAXED);
	__atomic_fetch_or(&rests.touching[rests.islands.parents[s]].footing, all, __ATOMIC_RELAXED);
}

/* Does nothing slide at a slot, and does its island stand on something? */
template <typename T> bool stands_firm(const Rests<T> &rests, int32_t s)
{
	const int32_t all = rests.touching[rests.islands.parents[s]].footing;
	return !(rests.touching[s].footing & FOOTING_SLIDES) && (all & FOOTING_FIRM) && !(all & FOOTING_LOOSE);
}

/* After a step that took so long a body comes to rest that hardly moves and gets no faster; one that stands firm is slowed. */
template <typename T> void settle(const Rests<T> &rests, Slot<T> &slot, int32_t s, const Vec<T> &ground, const Kept<T> *kept, T length)
{
	if (rests.touching[s].count == 0)
		return;
	for (T *velocity : {&slot.place[LINEAR_VX], &slot.place[LINEAR_VY], &slot.turn[TURN_VELOCITY]})
		if (std::abs(*velocity) < T(STILL_LEAST))
			*velocity = 0;
	const T *const before = kept[s].velocities;
	const T within = nearly_still(rests, s, ground), now = speed(slot, ground) * length;
	const T was = largest(slot, before[0] - ground.x(), before[1] - ground.y(), before[2]) * length;
	if (!(now < was + T(STILL_PUSH) * within))
		return;
	if (now < T(STILL_SPEED) * within && leans_on_rest(rests, s, ground, kept)) {
		set_still(slot, ground);
	} else if (now < T(STILL_SLOW) * within && stands_firm(rests, s)) {
		slot.place[LINEAR_VX] -= T(STILL_BRAKE) * (slot.place[LINEAR_VX] - ground.x());
		slot.place[LINEAR_VY] -= T(STILL_BRAKE) * (slot.place[LINEAR_VY] - ground.y());
		slot.turn[TURN_VELOCITY] -= T(STILL_BRAKE) * slot.turn[TURN_VELOCITY];
	}
}

}

#endif
