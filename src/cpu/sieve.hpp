/* Which of a body's neighbours may touch it at all. Most are found to stay apart, so this is where a step's time goes: they
 * are tested several at a time, in loops that compilers make vectors of. */
#ifndef CAROM_CPU_SIEVE_HPP
#define CAROM_CPU_SIEVE_HPP

#include "cpu/slots.hpp"

#include <limits>

namespace carom::cpu {

template <typename T> class Sieve
{
public:
	explicit Sieve(const Disc<T> &of) : own(of) {}

	bool is_full() const { return count == room; }

	/* A body that goes on as the step began, or has been at a place at a time and is held from then on or not. */
	void add(int32_t k, const Slot<T> &slot, T length) { add(k, slot, slot.place, 0, length); }
	void add(int32_t k, const Slot<T> &slot, const Work<T> &at, T length) { add(k, slot, at.place, at.time, at.held > 0 ? 0 : length); }

	/* Calls `meet(k)` for those that do not stay apart, and forgets all. */
	template <typename Meet> void sift(const Meet &meet)
	{
		int32_t near[room + width], left = 0;
		fill_up();
		test();
		for (int32_t i = 0; i < count; i++) {
			near[left] = which[i];
			left += touching[i];
		}
		count = 0;
		for (int32_t i = 0; i < left; i++)
			meet(near[i]); /* NOLINT(clang-analyzer-core.CallAndMessage): the first `left` of them were written above */
	}

private:
	static constexpr int32_t room = 32, width = 4; /* vectors are whole, so that no part of a loop goes one by one */

	void add(int32_t k, const Slot<T> &slot, const T *place, T at, T moves)
	{
		which[count] = k;
		time[count] = at;
		x[count] = place[LINEAR_X];
		y[count] = place[LINEAR_Y];
		vx[count] = place[LINEAR_VX] * moves;
		vy[count] = place[LINEAR_VY] * moves;
		ax[count] = (slot.push[PUSH_X] * moves) * moves;
		ay[count] = (slot.push[PUSH_Y] * moves) * moves;
		radius[count++] = slot.radius();
	}

	void fill_up()
	{
		for (int32_t i = count; i % width != 0; i++)
			x[i] = y[i] = vx[i] = vy[i] = ax[i] = ay[i] = radius[i] = time[i] = 0;
	}

	/* As stay_apart. */
	void test()
	{
		const T around = 2 * (std::abs(own.x) + std::abs(own.y)), none = std::numeric_limits<T>::min();
		const int32_t end = (count + width - 1) / width * width;
		for (int32_t i = 0; i < end; i++) {
			const T start = time[i] > own.time ? time[i] : own.time, rest = 1 - start, t = start - time[i], after = start - own.time;
			const T own_x = own.x + after * (own.vx + T(0.5) * after * own.ax), own_y = own.y + after * (own.vy + T(0.5) * after * own.ay);
			const T dx = x[i] + t * (vx[i] + T(0.5) * t * ax[i]) - own_x, dy = y[i] + t * (vy[i] + T(0.5) * t * ay[i]) - own_y;
			const T ux = vx[i] + t * ax[i] - (own.vx + after * own.ax), uy = vy[i] + t * ay[i] - (own.vy + after * own.ay);
			const T reach = own.radius + radius[i];
			const T size = around + 2 * (std::abs(own_x - own.x) + std::abs(own_y - own.y)) + std::abs(dx) + std::abs(dy) + reach + std::abs(ux)
				+ std::abs(uy);
			const T most = reach + (std::abs(ax[i] - own.ax) + std::abs(ay[i] - own.ay)) + size * T(4 * SLOP);
			const T at = -(dx * ux + dy * uy) / (ux * ux + uy * uy + none), late = at > 0 ? at : 0, u = late < rest ? late : rest;
			const T px = dx + u * ux, py = dy + u * uy;
			touching[i] = px * px + py * py > most * most * T(1.00001) ? 0 : 1;
		}
	}

	const Disc<T> own;
	int32_t count = 0, which[room + width], touching[room + width];
	T x[room + width], y[room + width], vx[room + width], vy[room + width], ax[room + width], ay[room + width], radius[room + width],
		time[room + width];
};

}

#endif
