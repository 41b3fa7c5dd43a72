/* By how much rates change forces, and what an iteration comes to at points of joints that are not firm: CONTRACT.md, "contacts". */
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
		points.step[i] = 1 / gives_with_all(rests, s, partner, share, others[i], points.arm[i], points.other_arm[i]);
		if (rests.rubs)
			grips.step[i] = 1 / gives_with_all(rests, s, partner, share, others[i], grips.arm[i], grips.other_arm[i]);
	}
}

/* The same for the points of a body's joints that are not firm, with what they give way of themselves; and what an iteration comes to there: lanes of four points, from `first` on. */
template <typename T> class Loose
{
public:
	Loose(const Rests<T> &all, const Joints<T> &joints, int32_t own, int32_t points, bool has_new_steps)
		: rests(all), s(own), rows(JointRows<T>::others(joints, all.slots[own].body(), points > 0)), left(points), anew(has_new_steps)
	{
	}

	[[gnu::noinline]] void iterate(Points<T> &points, int32_t first, T share, const Lanes<T> &others, const Lanes<T> &rates, Lanes<T> &force,
		Lanes<T> &wanted)
	{
		for (int32_t i = first; i < lane_count && left > 0; i++, left--, rows.next()) {
			const ForceBounds<T> bounds(rows.joint(), rows.part(), points.arm[i], rests.length, rests.part, rests.impulses);
			if (anew)
				points.step[i] = 1
					/ (gives_with_all(rests, s, Partner(points.partner[i]), share, others[i], points.arm[i], points.other_arm[i]) + bounds.give);
			const T rate = rates[i] + bounds.give * points.start[i], pushed = points.start[i] - rate * points.step[i];
			force[i] = smaller(larger(bounds.low, pushed), bounds.high);
			wanted[i] = pushed > bounds.high ? rate : force[i] > bounds.low ? std::abs(rate) : -rate;
		}
	}

private:
	const Rests<T> &rests;
	const int32_t s;
	JointRows<T> rows;
	int32_t left;
	const bool anew;
};

}

#endif
