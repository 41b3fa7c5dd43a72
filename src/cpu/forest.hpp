/* Sets that grow while others look: a parent for each member, a root its own. */
#ifndef CAROM_CPU_FOREST_HPP
#define CAROM_CPU_FOREST_HPP

#include <algorithm>
#include <cstdint>

namespace carom::cpu {

struct Forest {
	int32_t *parents;

	int32_t root_of(int32_t s) const
	{
		for (int32_t parent; (parent = __atomic_load_n(&parents[s], __ATOMIC_ACQUIRE)) != s;)
			s = parent;
		return s;
	}

	/* Of sets that don't grow meanwhile: the root is the member's parent from then on. */
	int32_t flat_root_of(int32_t s) const
	{
		const int32_t root = root_of(s);
		if (root != __atomic_load_n(&parents[s], __ATOMIC_RELAXED))
			__atomic_store_n(&parents[s], root, __ATOMIC_RELEASE);
		return root;
	}

	void unite(int32_t a, int32_t b) const
	{
		while ((a = root_of(a)) != (b = root_of(b))) {
			int32_t child = std::max(a, b);
			const int32_t hook = child;
			if (__atomic_compare_exchange_n(&parents[hook], &child, std::min(a, b), false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
				return;
		}
	}
};

}

#endif
