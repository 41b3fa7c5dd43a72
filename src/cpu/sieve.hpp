/* Which pairs of neighbours may touch at all. Most are found to stay apart, so this is where a step's time goes: they
 * are tested several at a time, in loops that compilers make vectors of. */
#ifndef CAROM_CPU_SIEVE_HPP
#define CAROM_CPU_SIEVE_HPP

#include "cpu/slots.hpp"

namespace carom::cpu {

template <typename T> class Sieve
{
public:
	/* Looks at the rest of the step and so many steps more. */
	explicit Sieve(T steps_ahead) : ahead(steps_ahead) {}

	bool is_full() const { return count == room; }

	[[gnu::always_inline]] void add(int32_t a, int32_t b, const Between<T> &between)
	{
		first[count] = a;
		second[count] = b;
		std::memcpy(way[count], between.way, sizeof between.way);
		std::memcpy(push[count], between.push, sizeof between.push);
		radii[count] = between.radii;
		size[count] = between.size;
		rest[count++] = between.rest;
	}

	/* Calls `meet(a, b, approach)` for those that do not stay apart, and forgets all. */
	template <typename Meet> void sift(const Meet &meet)
	{
		int32_t near[room], left = 0;
		for (int32_t i = count; i % width != 0; i++) {
			std::fill(way[i], way[i] + 4, T(0));
			std::fill(push[i], push[i] + 4, T(0));
			radii[i] = size[i] = rest[i] = 0;
		}
		for (int32_t i = 0; i < (count + width - 1) / width * width; i++)
			touching[i] = at(i).may_touch() ? 1 : 0;
		for (int32_t i = 0; i < count; i++) {
			near[left] = i;
			left += touching[i];
		}
		count = 0;
		for (int32_t i = 0; i < left; i++)
			/* NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): the first `left` of them were written above */
			meet(first[near[i]], second[near[i]], at(near[i]));
	}

private:
	[[gnu::always_inline]] Approach<T> at(int32_t i) const { return Approach<T>(way[i], push[i], radii[i], size[i], rest[i], ahead); }

	static constexpr int32_t room = 64, width = 4; /* vectors are whole, so that no part of a loop goes one by one */

	const T ahead;
	int32_t count = 0, first[room], second[room], touching[room];
	T way[room][4], push[room][4], radii[room], size[room], rest[room];
};

}

#endif
