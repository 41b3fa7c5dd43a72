/* The members of a cluster by their next events: a large cluster has as many events as members, and asks for the first each time. */
#ifndef CAROM_CPU_HEAP_HPP
#define CAROM_CPU_HEAP_HPP

#include "cpu/slots.hpp"

#include <algorithm>
#include <vector>

namespace carom::cpu {

/* Is the event (time, row, column) before the other? */
template <typename T> bool event_before(const T *a, const T *b)
{
	return std::lexicographical_compare(a, a + 3, b, b + 3);
}

/* A binary heap of numbers, the one with the first event on top, that knows where each is. */
template <typename T> class Heap
{
public:
	/* The room is kept from cluster to cluster, and from step to step. */
	Heap(Member *all_members, const Work<T> *all_work, std::vector<int32_t> &room) : members(all_members), work(all_work), ids(room) { ids.clear(); }

	int32_t first() const { return ids[0]; }

	void add(int32_t id)
	{
		ids.push_back(id);
		put(ids.size() - 1, id);
		rise(ids.size() - 1);
	}

	/* The member's next event is another. */
	void update(int32_t id) { sink(rise(static_cast<size_t>(members[id].place))); }

private:
	bool is_before(int32_t a, int32_t b) const { return event_before(work[a].next, work[b].next); }

	void put(size_t place, int32_t id)
	{
		ids[place] = id;
		members[id].place = static_cast<int32_t>(place);
	}

	size_t rise(size_t place)
	{
		const int32_t id = ids[place];
		for (; place > 0 && is_before(id, ids[(place - 1) / 2]); place = (place - 1) / 2)
			put(place, ids[(place - 1) / 2]);
		put(place, id);
		return place;
	}

	void sink(size_t place)
	{
		const int32_t id = ids[place];
		for (size_t below; (below = 2 * place + 1) < ids.size(); place = below) {
			if (below + 1 < ids.size() && is_before(ids[below + 1], ids[below]))
				below++;
			if (!is_before(ids[below], id))
				break;
			put(place, ids[below]);
		}
		put(place, id);
	}

	Member *const members;
	const Work<T> *const work;
	std::vector<int32_t> &ids;
};

}

#endif
