/* How far bodies get: CONTRACT.md, "events". */
#ifndef CAROM_CPU_WAYS_HPP
#define CAROM_CPU_WAYS_HPP

#include "cpu/clusters.hpp"

#include <algorithm>

namespace carom::cpu {

/* Those of bodies in a step, which are to stay in their reach. */
template <typename T> class Ways
{
public:
	Ways(const Clusters<T> &all, const T *reach, int32_t *needs) : clusters(all), boxes(reinterpret_cast<const Box<T> *>(reach)), need(needs) {}

	/* Where a body's middle gets by that time of the step, and what it looks at beside that. If it leaves its reach by then the step begins again, but goes on as long as it tells
	 * what others need, too. */
	Box<T> until(T time, int32_t s, const Trajectory<T> &way, T margin = 0) const
	{
		const Slot<T> &slot = clusters.slots[s];
		const Body<T> body = clusters.body(slot, way);
		const Box<T> now = part(body, time - way.time, margin), &most = boxes[s];
		if (now.min_x - body.radius >= most.min_x && now.min_y - body.radius >= most.min_y && now.max_x + body.radius <= most.max_x
			&& now.max_y + body.radius <= most.max_y)
			return now;
		need[s] = as_bits(static_cast<float>(part(body, 1 - way.time, margin).half(slot.place)));
		__atomic_store_n(&clusters.status[STATUS_LEFT], 1, __ATOMIC_RELAXED);
		return now;
	}

	[[gnu::always_inline]] void fetch(int32_t s) const { __builtin_prefetch(&boxes[s]); }

private:
	/* In such a part of the step. */
	static Box<T> part(const Body<T> &body, T rest, T margin)
	{
		const T size = std::abs(body.x.x()) + std::abs(body.x.y()) + body.radius;
		const T pad = T(0.125) * rest * rest * (std::abs(body.a.x()) + std::abs(body.a.y())) + size * T(4 * SLOP) + margin;
		const Vec<T> end = body.place_at(rest);
		return {std::min(body.x.x(), end.x()) - pad, std::min(body.x.y(), end.y()) - pad, std::max(body.x.x(), end.x()) + pad,
			std::max(body.x.y(), end.y()) + pad};
	}

	const Clusters<T> &clusters;
	const Box<T> *const boxes;
	int32_t *const need;
};

}

#endif
