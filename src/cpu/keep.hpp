/* What forces leave to the next step, and what that begins with: CONTRACT.md, "contacts", Begin. */
#ifndef CAROM_CPU_KEEP_HPP
#define CAROM_CPU_KEEP_HPP

#include "cpu/rests.hpp"

namespace carom::cpu {

/* A force in a step's units; 0 if it is too large for either body to begin with. */
template <typename T> T begun(const Rests<T> &rests, const Slot<T> &slot, Partner partner, T force, T length)
{
	const T own = slot.mass[MASS_INVERSE], start = (force * length) * length;
	const T inverse_mass = partner.moves() ? larger(own, rests.slots[partner.slot()].mass[MASS_INVERSE]) : own;
	return std::abs(start) * inverse_mass <= T(WARM_MOST) ? start : T(0);
}

/* Once impulses have stopped what comes together forces let it come nearer by less, and begin with those of the last steps. */
template <typename T> void warm_up(const Rests<T> &rests, const Warm<T> &warm, int32_t s)
{
	const Slot<T> &slot = rests.slots[s];
	WarmForces<T> last;
	int32_t k = 0;
	rests.each_point(s, [&](Points<T> &points, Grips<T> &grips, int32_t i, Partner partner, int32_t point) {
		if (point == 0)
			last = warm.of(slot.body(), partner.key(rests.slots), k);
		const T friction = rests.rubs ? grips.friction[i] : T(0), part = friction > 0 ? T(1) : T(WARM_PART);
		points.least[i] = T(EASE) * points.least[i] - T(0.5f / CONTACT_PART) * points.tolerance[i];
		points.force[i] = points.start[i] = part * begun(rests, slot, partner, last.normal[point], rests.length);
		if (rests.rubs) {
			grips.bound[i] = friction * points.force[i];
			grips.force[i] = grips.start[i] = part * begun(rests, slot, partner, last.friction[point], rests.length);
		}
	});
}

/* In the place of a slot's forces what the next step begins with, in N: their means, where such began this one. True if that
 * is what began it. */
template <typename T> bool find_means(const Rests<T> &rests, const Kept<T> *kept, int32_t s, const Vec<T> &ground, T length, const Warm<T> &warm)
{
	const Slot<T> &slot = rests.slots[s];
	const bool bears = rests.touching[rests.islands.parents[s]].wanted == rests.status[STATUS_FIRST]; /* what the second pass began with */
	WarmForces<T> last;
	int32_t k = 0;
	bool are_same = true;
	rests.each_point(s, [&](Points<T> &points, Grips<T> &grips, int32_t i, Partner partner, int32_t point) {
		if (point == 0)
			last = warm.of(slot.body(), partner.key(rests.slots), k);
		const bool lasts = begun(rests, slot, partner, last.normal[point], length) > 0;
		const bool rub = rests.rubs && grips.friction[i] > 0;
		const bool stays = bears && rub && kept[s].is_at_rest(ground) && was_still(kept, partner, ground);
		const T follow = stays ? T(0) : rub ? T(GRIP_WARM_FOLLOW) : T(WARM_FOLLOW);
		const auto mean = [&](T force, T before) {
			const T now = (force / length) / length;
			return lasts ? before + follow * (now - before) : now;
		};
		points.force[i] = mean(points.force[i], last.normal[point]);
		if (rests.rubs)
			grips.force[i] = mean(grips.force[i], last.friction[point]);
		are_same = are_same && points.force[i] == last.normal[point] && (!rests.rubs || grips.force[i] == last.friction[point]);
	});
	return are_same;
}

/* Keeps the forces on a slot for the next step. True if this one began with the same. */
template <typename T> bool keep_forces(const Rests<T> &rests, const Kept<T> *kept, int32_t s, const Vec<T> &ground, T length, const Warm<T> &warm)
{
	const int32_t body = rests.slots[s].body();
	int32_t count = 0;
	const bool are_same = find_means(rests, kept, s, ground, length, warm);
	rests.each_point(s, [&](const Points<T> &points, const Grips<T> &grips, int32_t i, Partner partner, int32_t point) {
		if (point == 0)
			warm.begin(body, count++, partner.key(rests.slots));
		warm.keep(body, count - 1, point, points.force[i], rests.rubs ? grips.force[i] : T(0));
	});
	warm.keep_count(body, count);
	return are_same;
}

}

#endif
