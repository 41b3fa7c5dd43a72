/* New neighbours while the lists last. */
#ifndef CAROM_CPU_MENDER_HPP
#define CAROM_CPU_MENDER_HPP

#include "cpu/reach.hpp"

#include <algorithm>

namespace carom::cpu {

/* The neighbours of bodies that have got another reach. Those are not in the cells where they would be looked for, so the search is also among them. */
template <typename T> class Mender
{
public:
	explicit Mender(const Job<T> &job)
		: slots(reinterpret_cast<const Slot<T> *>(job.records(0))), filters(job.list(1)), boxes(reinterpret_cast<const Box<T> *>(job.records(2))),
		  status(job.list(3)), cells{job.list(4), {as_float(status[STATUS_CELL]), job.domain[2], job.domain[3]}},
		  spans(reinterpret_cast<const Span *>(job.list(5))), neighbours(job.list(6)), movers(job.list(7)), extra(job.list(8)),
		  wakes(reinterpret_cast<Wake *>(job.list(9)))
	{
	}

	void mend(int32_t s) const
	{
		const Box<T> box = boxes[s];
		for (int32_t level = 0; status[STATUS_LEVELS] >> level; level++) {
			if (status[STATUS_LEVELS] & (1 << level))
				cells.each(box, level, [&](int32_t first, int32_t end) {
					for (int32_t other = first; other < end; other++)
						meet(s, box, other);
				});
		}
		for (int32_t k = 0; k < status[STATUS_MOVERS]; k++)
			meet(s, box, movers[k]);
	}

private:
	void meet(int32_t s, const Box<T> &box, int32_t other) const
	{
		if (!box.touches(boxes[other]) || other == s || !slots[s].meets(slots[other], filters) || knows(s, other))
			return;
		add(s, other);
		add(other, s);
		/* Where both were changed in the last step, the pair may be for the other to look at. */
		__atomic_store_n(&wakes[other].next, status[STATUS_AGE], __ATOMIC_RELAXED);
	}

	bool knows(int32_t s, int32_t other) const
	{
		if (std::find(neighbours + spans[s].start, neighbours + spans[s].end, other) != neighbours + spans[s].end)
			return true;
		for (int32_t k = __atomic_load_n(&extra[s], __ATOMIC_ACQUIRE); k >= 0; k = extra[k + NODE_LINK])
			if (extra[k + NODE_SLOT] == other)
				return true;
		return false;
	}

	/* Where there is no room the lists are made anew. */
	void add(int32_t s, int32_t other) const
	{
		if (__atomic_load_n(&status[STATUS_STALE], __ATOMIC_RELAXED))
			return;
		const int32_t node = fetch_add(&status[STATUS_EXTRA], NODE_WIDTH);
		if (node + NODE_WIDTH > status[STATUS_EXTRA_ROOM]) {
			__atomic_store_n(&status[STATUS_STALE], 1, __ATOMIC_RELAXED);
			return;
		}
		extra[node + NODE_SLOT] = other;
		extra[node + NODE_LINK] = __atomic_load_n(&extra[s], __ATOMIC_RELAXED);
		while (!__atomic_compare_exchange_n(&extra[s], &extra[node + NODE_LINK], node, true, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED)) {
		}
	}

	const Slot<T> *const slots;
	const Filters filters;
	const Box<T> *const boxes;
	int32_t *const status;
	const CellList<T> cells;
	const Span *const spans;
	const int32_t *const neighbours, *const movers;
	int32_t *const extra;
	Wake *const wakes;
};

}

#endif
