/* What lies still, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_STILL_HPP
#define CAROM_CPU_STILL_HPP

#include "cpu/rests.hpp"

namespace carom::cpu {

/* How far a body may get in a step that is nearly still: what its forces are found within. 0: it never is, for one point holds nothing, or what it touches does not rub, or is
 * kinematic. */
template <typename T> T nearly_still(const Rests<T> &rests, int32_t s)
{
	T least = infinite<T>;
	int32_t count = 0;
	if (!rests.rubs)
		return 0;
	rests.each_point(s, [&](const Points<T> &points, const Grips<T> &grips, int32_t i, Partner partner, int32_t) {
		const bool is_kinematic = partner.moves() && !rests.slots[partner.slot()].is_dynamic();
		least = grips.friction[i] > 0 && !is_kinematic ? smaller(least, points.tolerance[i]) : T(0);
		count++;
	});
	return count > 1 ? least : T(0);
}

/* The most that a motion, or a push, moves any part of a body along an axis. */
template <typename T> T largest(const Slot<T> &slot, T x, T y, T turning)
{
	return larger(largest(Vec<T>(x, y)), slot.radius() * std::abs(turning));
}

template <typename T> T speed(const Slot<T> &slot)
{
	return largest(slot, slot.place[LINEAR_VX], slot.place[LINEAR_VY], slot.turn[TURN_VELOCITY]);
}

/* Is nothing left of a body's push? */
template <typename T> bool is_unpushed(const Slot<T> &slot)
{
	return slot.push[PUSH_X] == 0 && slot.push[PUSH_Y] == 0 && slot.push[PUSH_TORQUE] == 0;
}

template <typename T> void stop(Slot<T> &slot)
{
	slot.place[LINEAR_VX] = slot.place[LINEAR_VY] = slot.turn[TURN_VELOCITY] = 0;
}

/* Is a body at rest, and left there by its push? */
template <typename T> bool stays_still(const Rests<T> &rests, int32_t s)
{
	const Slot<T> &slot = rests.slots[s];
	const T push = largest(slot, slot.push[PUSH_X], slot.push[PUSH_Y], slot.push[PUSH_TORQUE]);
	return speed(slot) == 0 && (push * rests.length) * rests.length < T(STILL_PUSH) * nearly_still(rests, s);
}

/* Does it touch anything that was at rest as the step began? */
template <typename T> bool leans_on_rest(const Rests<T> &rests, int32_t s, const Kept<T> *kept)
{
	bool leans = false;
	rests.each_point(s, [&](const Points<T> &, const Grips<T> &, int32_t, Partner partner, int32_t) {
		leans = leans || !partner.moves() || kept[partner.slot()].is_at_rest();
	});
	return leans;
}

/* Does it, after a step that took so long, hardly move, and get no faster? */
template <typename T> bool comes_to_rest(const Rests<T> &rests, int32_t s, const Kept<T> *kept, T length)
{
	const Slot<T> &slot = rests.slots[s];
	const T *const before = kept[s].velocities;
	const T within = nearly_still(rests, s), now = speed(slot) * length, was = largest(slot, before[0], before[1], before[2]) * length;
	return now < T(STILL_SPEED) * within && now < was + T(STILL_PUSH) * within && leans_on_rest(rests, s, kept);
}

}

#endif
