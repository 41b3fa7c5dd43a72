/* Which pairs may hit each other: CONTRACT.md, "Bodies in step units". */
#ifndef CAROM_CPU_FILTERS_HPP
#define CAROM_CPU_FILTERS_HPP

#include <cstdint>

#include "layout.h"

namespace carom::cpu {

class Filters
{
public:
	explicit Filters(const int32_t *list) : any(list[FILTERS_ANY] != 0), numbers(list), of(reinterpret_cast<const Of *>(list + FILTERS_FIRST)) {}

	const bool any; /* else all meet all */

	/* Of two bodies. */
	bool let(int32_t a, int32_t b) const
	{
		return !any || ((of[a].categories & of[b].mask) != 0 && (of[b].categories & of[a].mask) != 0 && (of[a].except == 0 || !is_except(a, b)));
	}

private:
	/* Is the second one of those that the first never meets? */
	bool is_except(int32_t a, int32_t b) const
	{
		const int32_t *one = numbers + of[a].except;
		while (*one != b && *one >= 0)
			one++;
		return *one == b;
	}

	struct Of {
		uint32_t categories, mask;
		int32_t except;
	};
	const int32_t *const numbers;
	const Of *const of;
};

}

#endif
