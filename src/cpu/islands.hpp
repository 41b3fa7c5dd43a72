/* Islands: dynamic bodies that touch each other, or are joined, directly or by others: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_ISLANDS_HPP
#define CAROM_CPU_ISLANDS_HPP

#include "cpu/rests.hpp"

#include <algorithm>

namespace carom::cpu {

/* A body and those that it touches are of one island; what is not dynamic carries it. */
template <typename T> void unite(const Rests<T> &rests, int32_t s)
{
	int32_t carrier = -1;
	const auto visit = [&](Partner partner, int32_t point) {
		if (point == 0 && partner.slot() > s && rests.slots[partner.slot()].is_dynamic()) /* of two bodies one says so */
			rests.islands.unite(s, partner.slot());
		if (!partner.moves())
			carrier = CARRIER_STATIC;
		else if (!rests.slots[partner.slot()].is_dynamic())
			carrier = std::max(carrier, rests.slots[partner.slot()].body());
	};
	rests.each_joined(s, [&](const Points<T> &, int32_t, Partner partner, int32_t) { visit(partner, 0); });
	rests.each_point(s, [&](const Points<T> &, const Grips<T> &, int32_t, Partner partner, int32_t point) { visit(partner, point); });
	rests.touching[s].carrier = carrier;
}

/* The root of a slot's island, which is its parent from then on; of what carries slots it has the largest index. What a root itself is
 * carried by stays where others may be putting theirs. */
template <typename T> int32_t settled_root(const Rests<T> &rests, int32_t s)
{
	const int32_t root = rests.islands.flat_root_of(s);
	if (root == s)
		return s;
	const int32_t carrier = rests.touching[s].carrier;
	int32_t *const to = &rests.touching[root].carrier;
	for (int32_t now = __atomic_load_n(to, __ATOMIC_RELAXED); now < carrier;)
		__atomic_compare_exchange_n(to, &now, carrier, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
	return root;
}

}

#endif
