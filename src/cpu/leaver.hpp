/* Bodies that go while the lists last. */
#ifndef CAROM_CPU_LEAVER_HPP
#define CAROM_CPU_LEAVER_HPP

#include "cpu/reach.hpp"

#include <algorithm>

namespace carom::cpu {

/* The slots stay without gaps: the last one's body goes where another one was. Of both slots nothing is left in the lists. */
template <typename T> class Leaver
{
public:
	explicit Leaver(const Job<T> &job)
		: slots(reinterpret_cast<Slot<T> *>(job.records(1))), places(job.list(2)), boxes(reinterpret_cast<Box<T> *>(job.records(3))),
		  status(job.list(4)), movers(slots, job.records(3), job.list(4), job.list(5), job.list(6), job.domain[3]),
		  spans(reinterpret_cast<Span *>(job.list(7))), neighbours(job.list(8)), extra(job.list(9))
	{
	}

	void leave(int32_t s, int32_t last) const
	{
		slots[s] = slots[last];
		places[slots[s].body()] = s;
		if (status[STATUS_STALE])
			return;
		part(s);
		part(last);
		boxes[last] = Box<T>::nowhere();
		movers.rename(last, s);
		if (s != last)
			movers.move(s);
	}

private:
	/* All that have the slot in their lists are in its own. */
	void part(int32_t s) const
	{
		Span &span = spans[s];
		for (; span.end > span.start; span.end--)
			forget(neighbours[span.end - 1], s);
		span.half = span.end;
		for (; extra[s] >= 0; extra[s] = extra[extra[s] + NODE_LINK])
			forget(extra[extra[s] + NODE_SLOT], s);
	}

	void forget(int32_t s, int32_t gone) const
	{
		Span &span = spans[s];
		int32_t *const first = neighbours + span.start, *const middle = neighbours + span.half, *const end = neighbours + span.end;
		int32_t *const ahead = std::remove(first, middle, gone), *const behind = std::remove(middle, end, gone);
		span.half = static_cast<int32_t>(ahead - neighbours);
		span.end = static_cast<int32_t>(std::copy(middle, behind, ahead) - neighbours);
		for (int32_t *link = &extra[s]; *link >= 0;) {
			int32_t *const node = extra + *link;
			if (node[NODE_SLOT] == gone)
				*link = node[NODE_LINK];
			else
				link = &node[NODE_LINK];
		}
	}

	Slot<T> *const slots;
	int32_t *const places;
	Box<T> *const boxes;
	const int32_t *const status;
	const MoverList<T> movers;
	Span *const spans;
	int32_t *const neighbours, *const extra;
};

}

#endif
