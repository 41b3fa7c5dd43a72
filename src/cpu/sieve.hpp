/* Which pairs of neighbours may touch at all. Most are found to stay apart, so this is where a step's time goes: they
 * are tested several at a time, in loops that compilers make vectors of. */
#ifndef CAROM_CPU_SIEVE_HPP
#define CAROM_CPU_SIEVE_HPP

#include "cpu/slots.hpp"

namespace carom::cpu {

template <typename T> class Sieve
{
public:
	bool is_full() const { return count == room; }

	[[gnu::always_inline]] void add(int32_t a, int32_t b, const Approach<T> &approach)
	{
		first[count] = a;
		second[count] = b;
		x[count] = approach.x;
		y[count] = approach.y;
		vx[count] = approach.vx;
		vy[count] = approach.vy;
		rest[count] = approach.rest;
		size[count] = approach.size;
		most[count++] = approach.most;
	}

	/* Calls `meet(a, b, approach)` for those that do not stay apart, and forgets all. */
	template <typename Meet> void sift(const Meet &meet)
	{
		int32_t near[room], left = 0;
		for (int32_t i = count; i % width != 0; i++)
			x[i] = y[i] = vx[i] = vy[i] = rest[i] = size[i] = most[i] = 0;
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
	[[gnu::always_inline]] Approach<T> at(int32_t i) const { return Approach<T>(x[i], y[i], vx[i], vy[i], rest[i], size[i], most[i]); }

	static constexpr int32_t room = 64, width = 4; /* vectors are whole, so that no part of a loop goes one by one */

	int32_t count = 0, first[room], second[room], touching[room];
	T x[room], y[room], vx[room], vy[room], rest[room], size[room], most[room];
};

}

#endif
