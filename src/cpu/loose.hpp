/* By how much rates change forces, and what an iteration comes to at points of joints that are not firm, or that give way of themselves: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_LOOSE_HPP
#define CAROM_CPU_LOOSE_HPP

#include "cpu/joint.hpp"
#include "cpu/rests.hpp"

namespace carom::cpu {

/* How much a force at a point parts it. */
template <typename T> T gives(const Rests<T> &rests, int32_t s, T arm)
{
	return rests.inverse_mass(s) + rests.inverse_inertia(s) * (arm * arm);
}

/* A bound of how much a force at a point parts it, with all others that there are. */
template <typename T> T gives_with_all(const Rests<T> &rests, int32_t s, Partner partner, T share, T other_share, T arm, T other_arm)
{
	const T own = share * gives(rests, s, arm);
	return partner.moves() ? own + other_share * gives(rests, partner.slot(), other_arm) : own;
}

/* By how much rates change forces; 0 where there is no point. */
template <typename T> void set_steps(const Rests<T> &rests, Points<T> &points, Grips<T> &grips, int32_t s, T share, const Lanes<T> &others)
{
	for (int32_t i = 0; i < lane_count; i++) {
		const Partner partner(points.partner[i]);
		if (partner.is_none())
			continue;
		points.step[i] = 1 / (gives_with_all(rests, s, partner, share, others[i], points.arm[i], points.other_arm[i]) + points.give[i]);
		if (rests.rubs)
			grips.step[i] = 1 / gives_with_all(rests, s, partner, share, others[i], grips.arm[i], grips.other_arm[i]);
	}
}

/* What an iteration comes to at the points of a body's joints that are not firm: some in a row, and then those that hold aside. */
template <typename T> class Loose
{
public:
	Loose(const Rests<T> &all, const Joints<T> &joints, int32_t own, bool has_any)
		: rests(all), rows(JointRows<T>::others(joints, all.slots[own].body(), has_any && all.touching[own].rows > all.touching[own].firm)),
		  bounded(all.touching[own].rows - all.touching[own].firm), aside(all.touching[own].joined - all.touching[own].rows)
	{
	}

	/* Of four points, from that one on. */
	[[gnu::noinline]] void iterate(const Points<T> &points, int32_t i, const Lanes<T> &rates, Lanes<T> &force, Lanes<T> &wanted)
	{
		for (; i < lane_count && bounded > 0; i++, bounded--, rows.next()) {
			const ForceBounds<T> bounds(rows.joint(), rows.part(), points.arm[i], points.least[i], rests.length, rests.impulses);
			answer(points, i, rates, bounds.low, bounds.high, force, wanted);
		}
		for (; i < lane_count && aside > 0; i++, aside--)
			answer(points, i, rates, -infinite<T>, infinite<T>, force, wanted);
	}

private:
	static void answer(const Points<T> &points, int32_t i, const Lanes<T> &rates, T low, T high, Lanes<T> &force, Lanes<T> &wanted)
	{
		const T rate = rates[i] + points.give[i] * points.start[i], pushed = points.start[i] - rate * points.step[i];
		force[i] = smaller(larger(low, pushed), high);
		wanted[i] = pushed > high ? rate : force[i] > low ? std::abs(rate) : -rate;
	}

	const Rests<T> &rests;
	JointRows<T> rows;
	int32_t bounded, aside;
};

}

#endif
