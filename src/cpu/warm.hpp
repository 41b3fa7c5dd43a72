/* The forces that the last steps ended with, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_WARM_HPP
#define CAROM_CPU_WARM_HPP

#include "layout.h"

#include <cstdint>

namespace carom::cpu {

/* Of a contact, in N. */
template <typename T> struct WarmForces {
	T normal[2] = {0, 0}, friction[2] = {0, 0};
};

/* Of all bodies, by index. */
template <typename T> class Warm
{
public:
	Warm(T *all_records, int32_t *all_counts, bool bodies_rub) : records(all_records), counts(all_counts), rubs(bodies_rub) {}

	void keep_count(int32_t body, int32_t count) const { counts[body] = count; }

	/* Of the contact with that partner; zeros if there was none. */
	WarmForces<T> of(int32_t body, int32_t partner) const
	{
		WarmForces<T> forces;
		for (int32_t k = 0; k < counts[body]; k++) {
			const T *record = at(body, k);
			if (static_cast<int32_t>(record[WARM_PARTNER]) != partner)
				continue;
			for (int32_t i = 0; i < 2; i++) {
				forces.normal[i] = record[WARM_FORCES + i];
				forces.friction[i] = rubs ? record[4 + WARM_FRICTION + i] : T(0);
			}
		}
		return forces;
	}

	/* Contact k, with that partner, of no forces yet. */
	void begin(int32_t body, int32_t k, int32_t partner) const
	{
		at(body, k)[WARM_PARTNER] = static_cast<T>(partner);
		for (int32_t point = 0; point < 2; point++)
			keep(body, k, point, 0, 0);
	}

	void keep(int32_t body, int32_t k, int32_t point, T normal, T friction) const
	{
		T *record = at(body, k);
		record[WARM_FORCES + point] = normal;
		if (rubs)
			record[4 + WARM_FRICTION + point] = friction;
	}

private:
	T *at(int32_t body, int32_t k) const
	{
		return records + (static_cast<size_t>(CONTACTS_MOST) * static_cast<size_t>(body) + static_cast<size_t>(k)) * (4 * WARM_WIDTH(rubs));
	}

	T *records;
	int32_t *counts;
	bool rubs;
};

}

#endif
