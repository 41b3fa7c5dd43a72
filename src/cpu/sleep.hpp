/* Islands that sleep, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_SLEEP_HPP
#define CAROM_CPU_SLEEP_HPP

#include "cpu/clusters.hpp"

#include <algorithm>

namespace carom::cpu {

/* In Touching, how many points; a list; what layout.h says of each island, at its root, and of sleep; where the points are, and how many are of joints, and of these firm, and of rows; how far forces turn the body. */
struct Touching {
	int32_t count, slot, wanted, restless, asleep, footing, first, room, made, carrier, joined, firm, rows;
	float turns;
};

static_assert(sizeof(Touching) == TOUCHING_WIDTH * sizeof(int32_t), "touching");

/* Of a slot, before the step. */
template <typename T> struct Kept {
	T push[4], velocities[4], place[4];

	void keep(const Slot<T> &slot)
	{
		std::copy_n(slot.push, PUSH_BODY, push);
		velocities[0] = slot.place[LINEAR_VX], velocities[1] = slot.place[LINEAR_VY], velocities[2] = slot.turn[TURN_VELOCITY];
		place[0] = slot.place[LINEAR_X], place[1] = slot.place[LINEAR_Y], place[2] = slot.turn[TURN_ANGLE];
	}

	/* Was it at rest on a ground of that velocity? */
	bool is_at_rest(const Vec<T> &ground) const { return velocities[0] == ground.x() && velocities[1] == ground.y() && velocities[2] == 0; }

	/* It was at rest, and still is. */
	bool stays(const Slot<T> &slot) const
	{
		return is_at_rest({0, 0}) && slot.place[LINEAR_VX] == 0 && slot.place[LINEAR_VY] == 0 && slot.turn[TURN_VELOCITY] == 0
			&& place[0] == slot.place[LINEAR_X] && place[1] == slot.place[LINEAR_Y] && place[2] == slot.turn[TURN_ANGLE];
	}

	/* But for which body it is, which others look at meanwhile. */
	void restore(Slot<T> &slot, bool with_velocities) const
	{
		std::copy_n(push, PUSH_BODY, slot.push);
		if (with_velocities)
			slot.place[LINEAR_VX] = velocities[0], slot.place[LINEAR_VY] = velocities[1], slot.turn[TURN_VELOCITY] = velocities[2];
	}
};

/* Who sleeps, and how that ends. */
template <typename T> struct Sleepers {
	Touching *touching;
	Kept<T> *kept;
	int32_t *islands; /* the root of each slot's */
	int32_t *status;

	bool sleeps(int32_t s) const { return touching[s].asleep != 0; }

	/* The body with the push that it has awake; `room` holds one that sleeps. */
	const Slot<T> &awake(const Slot<T> &slot, int32_t s, Slot<T> &room) const
	{
		if (!sleeps(s))
			return slot;
		room = slot;
		kept[s].restore(room, false);
		return room;
	}

	/* Its island is to wake; or, of one that is awake, is not to fall asleep. */
	void disturb(int32_t s) const { __atomic_store_n(&touching[islands[s]].restless, 1, __ATOMIC_RELAXED); }

	bool is_disturbed(int32_t s) const { return __atomic_load_n(&touching[islands[s]].restless, __ATOMIC_RELAXED) != 0; }

	void wake(Slot<T> &slot, int32_t s) const
	{
		kept[s].restore(slot, false);
		rouse(s);
	}

	/* Its push is going to be another one. */
	void rouse(int32_t s) const
	{
		touching[s].asleep = 0;
		fetch_add(&status[STATUS_SLEEPERS], -1);
	}

	void fall_asleep(Slot<T> &slot, int32_t s) const
	{
		slot.push[PUSH_X] = slot.push[PUSH_Y] = slot.push[PUSH_TORQUE] = 0;
		touching[s].asleep = 1;
		fetch_add(&status[STATUS_SLEEPERS], 1);
	}
};

}

#endif
