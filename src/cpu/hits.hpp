/* Hits that are kept: CONTRACT.md, "The step events", Kept. */
#ifndef CAROM_CPU_HITS_HPP
#define CAROM_CPU_HITS_HPP

#include "cpu/reach.hpp"

namespace carom::cpu {

/* The records of a hit, as they lie in memory. */
template <typename T> struct KeptHit {
	T time, row, column, unused;
	T x, y, normal_x, normal_y;
	T impulse_x, impulse_y, ruled, link;
	T elapsed, elapsed_low, length, step;
};

static_assert(sizeof(KeptHit<float>) == HITS_WIDTH * 4 * sizeof(float)
		&& offsetof(KeptHit<float>, link) == (4 * HITS_WHAT + WHAT_LINK) * sizeof(float),
	"hits");

template <typename T> class Hits
{
public:
	Hits(T *records, int32_t *counts) : hits(reinterpret_cast<KeptHit<T> *>(records)), status(counts) {}

	bool are_kept() const { return status[STATUS_KEPT_ROOM] > 0; }

	/* As one of the member's. Where there is no room the step begins again, but goes on as long as it tells how much is needed. */
	void keep(Member &member, KeptHit<T> hit) const
	{
		const int32_t k = fetch_add(&status[STATUS_KEPT], 1);
		if (k >= status[STATUS_KEPT_ROOM]) {
			__atomic_store_n(&status[STATUS_LEFT], 1, __ATOMIC_RELAXED);
			return;
		}
		hit.link = static_cast<T>(member.kept);
		hit.step = 0;
		hits[k] = hit;
		member.kept = k;
	}

	/* The member's last hit had another impulse. */
	void amend(const Member &member, const Vec<T> &impulse) const
	{
		if (are_kept() && member.kept >= 0)
			hits[member.kept].impulse_x = impulse.x(), hits[member.kept].impulse_y = impulse.y();
	}

	/* The member's hits came to pass, in the step that the clock has counted last. */
	void confirm(const Member &member, const Texels<T> &clock) const
	{
		for (int32_t k = member.kept; k >= 0; k = static_cast<int32_t>(hits[k].link)) {
			hits[k].elapsed = clock.fact(CLOCK_TIME, TIME_ELAPSED);
			hits[k].elapsed_low = clock.fact(CLOCK_TIME, TIME_ELAPSED_LOW);
			hits[k].length = clock.fact(CLOCK_STEP, STEP_LENGTH);
			hits[k].step = clock.fact(CLOCK_COUNTS, COUNTS_STEPS);
		}
	}

private:
	KeptHit<T> *const hits;
	int32_t *const status;
};

}

#endif
