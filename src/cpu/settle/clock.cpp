#include "cpu/reach.hpp"

namespace carom::cpu {

/* The clock gets on, if the step is done. */
template <typename T> static void settle(const Job<T> &job)
{
	const Texels<T> uniforms = job.texels(0), clock = job.texels(1), now = job.texels(3);
	int32_t *status = job.list(2);
	const T length = step_length(clock, uniforms);
	const bool good = length > 0 && lists_are_good(status), left = good && status[STATUS_LEFT];
	const bool again = good && !left && (status[STATUS_ROUND] > job.domain[2] || !is_last_slice(status)), done = good && !left && !again;
	for (int32_t texel = 0; texel < CLOCK_WIDTH; texel++) {
		for (int32_t channel = 0; channel < 4; channel++)
			now.fact(texel, channel) = clock.fact(texel, channel);
	}
	now.set(CLOCK_STEP, 0, 0, 0, clock.fact(CLOCK_STEP, STEP_STALLED), clock.fact(CLOCK_STEP, STEP_ENDED));
	if (done) {
		auto add = [&](int32_t texel, int32_t high, int32_t low, T x) {
			const Sum<T> sum = add_exactly({clock.fact(texel, high), clock.fact(texel, low)}, x);
			now.fact(texel, high) = sum.high, now.fact(texel, low) = sum.low;
		};
		now.set(CLOCK_HIT, 0, NO_HIT, 0, 0, 1);
		now.set(CLOCK_STEP, 0, length, length, 0, 0);
		add_time(clock, now, length);
		add(CLOCK_COUNTS, COUNTS_HITS, COUNTS_HITS_LOW, static_cast<T>(status[STATUS_HITS]));
		add(CLOCK_RULED, RULED_HITS, RULED_HITS_LOW, static_cast<T>(status[STATUS_RULED]));
		now.fact(CLOCK_COUNTS, COUNTS_STEPS) += 1;
		now.fact(CLOCK_COUNTS, COUNTS_HELD) += static_cast<T>(status[STATUS_HELD]);
	}
	status[STATUS_COMMIT] = done;
	status[STATUS_UNDER_WAY] = again;
	status[STATUS_STEPS] += done;
	if (done) {
		/* Numbers given, by now, are of bodies in clusters. Where velocities change between steps no look ahead is right. */
		const bool damps = uniforms.fact(UNIFORMS_RUBS, RUBS_DAMPS) > 0;
		const bool busy = damps || status[STATUS_ACTIVE] > job.domain[3] / BUSY;
		status[STATUS_BUSTLE] = status[STATUS_HITS];
		status[STATUS_ANSWERED] += status[STATUS_HITS];
		status[STATUS_KEPT_BEFORE] = status[STATUS_KEPT];
		status[STATUS_AGE] = busy || status[STATUS_AHEAD] == 0 ? 0 : status[STATUS_AGE] + 1;
		status[STATUS_AHEAD] = busy ? 0 : HORIZON - 1;
	}
	status[STATUS_MENDED] = status[STATUS_MOVERS];
	status[STATUS_AGAIN] += again;
	status[STATUS_IDLE] += !good && length > 0;
	if (left)
		status[STATUS_STALE] = 1;
	if (done || left)
		status[STATUS_ACTIVE] = status[STATUS_FOUND] = status[STATUS_HITS] = status[STATUS_RULED] = status[STATUS_HELD] = 0;
}

extern const Stage settle_clock;
const Stage settle_clock{"settle", "clock", {{STAGE_SETTLE, settle<float>, settle<double>}}, nullptr, nullptr};

}
