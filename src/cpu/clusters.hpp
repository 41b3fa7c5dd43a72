/* The clusters of the step events: CONTRACT.md, "The step events". */
#ifndef CAROM_CPU_CLUSTERS_HPP
#define CAROM_CPU_CLUSTERS_HPP

#include "cpu/forest.hpp"
#include "cpu/reach.hpp"

namespace carom::cpu {

/* A body that no event has changed yet. */
template <typename T> void begin_anew(Member &member, Work<T> &work, const Slot<T> &slot)
{
	work.keep(Trajectory<T>(slot));
	work.next[NEXT_TIME] = NO_HIT;
	work.empty_box();
	member.events = member.begun = member.rapid = member.stuck = member.fast = member.hits = member.ruled = 0;
	member.kept = -1;
}

/* When a slice of a step ends. */
template <typename T> T slice_end(const int32_t *status, int32_t slice)
{
	return T(slice + 1) / T(status[STATUS_SLICES]);
}

/* What clusters did, and what of it was lost. */
struct Tally {
	int32_t hits, ruled, held, lost;

	Tally &operator+=(const Tally &other)
	{
		hits += other.hits, ruled += other.ruled, held += other.held, lost += other.lost;
		return *this;
	}

	void add_to(int32_t *status) const
	{
		const auto add = [](int32_t &sum, int32_t more) {
			if (more != 0)
				fetch_add(&sum, more);
		};
		add(status[STATUS_HITS], hits), add(status[STATUS_RULED], ruled), add(status[STATUS_HELD], held), add(status[STATUS_LOST], lost);
	}
};

/* What the threads that run clusters share. A number belongs to one cluster; only its thread changes what it numbers, but for what is
 * reached by the atomic functions here. */
template <typename T> class Clusters : public Bodies<T>
{
public:
	/* The kernel's textures: those of Bodies, then spans, neighbours, status, members, active, found, extra, wake; owners and parents last. */
	Clusters(const Job<T> &job, int owners_at) : Clusters(job, owners_at, step_length(job.texels(2), job.texels(1))) {}
	Clusters(const Job<T> &job, int owners_at, T step_length)
		: Bodies<T>(job, step_length), spans(reinterpret_cast<Span *>(job.list(4))), neighbours(job.list(5)), status(job.list(6)),
		  members(reinterpret_cast<Member *>(job.list(7))), active(job.list(8)), owners(job.list(owners_at)), parents(job.list(owners_at + 1)),
		  found(reinterpret_cast<FoundHit *>(job.list(9))), extra(job.list(10)), wakes(reinterpret_cast<Wake *>(job.list(11))),
		  ahead(this->length < this->time_step() ? T(0) : T(status[STATUS_AHEAD]))
	{
	}

	/* Calls `visit(other, whether it is for this slot to test the pair, where the other could as well)` for those in the slot's span, up to an end, and
	 * those that it got since. */
	template <typename Visit> void each_neighbour(int32_t s, int32_t end, const Visit &visit) const
	{
		for (int32_t k = spans[s].start; k < end; k++)
			visit(neighbours[k], k < spans[s].half);
		for (int32_t k = extra[s]; k >= 0; k = extra[k + NODE_LINK])
			visit(extra[k + NODE_SLOT], s < extra[k + NODE_SLOT]);
	}

	/* What is read of a slot that is looked at: where its neighbours are listed, then the list, then what is asked of the neighbours. In
	 * worlds that caches can't hold, a look takes as long as it waits for these. (Inline: GCC takes what does nothing but fetch for what does nothing.) */
	[[gnu::always_inline]] void fetch_span(int32_t s) const
	{
		__builtin_prefetch(&slots[s]);
		__builtin_prefetch(&spans[s]);
		__builtin_prefetch(&extra[s]);
	}

	[[gnu::always_inline]] void fetch_list(int32_t s) const
	{
		__builtin_prefetch(&neighbours[spans[s].start]);
		__builtin_prefetch(&neighbours[spans[s].end]);
	}

	[[gnu::always_inline]] void fetch_neighbours(int32_t s, int32_t end) const
	{
		for (int32_t k = spans[s].start; k < end; k++) {
			__builtin_prefetch(&slots[neighbours[k]]);
			__builtin_prefetch(&owners[neighbours[k]]);
			__builtin_prefetch(&wakes[neighbours[k]]);
		}
	}

	/* Where the neighbours end whom a slot looks at as a step begins: all, if it was changed, else those that do not look at it. */
	int32_t watched_end(int32_t s) const { return wakes[s].changed > 0 ? spans[s].end : spans[s].half; }

	/* The body is to be looked at again at that time, in steps from the beginning of this one; but not in this one. */
	void wake_at(int32_t s, T time) const { wakes[s].next = status[STATUS_AGE] + std::max(static_cast<int32_t>(time), 1); }

	/* Not later than that. */
	void wake_before(int32_t s, T time) const
	{
		const int32_t next = wakes[s].next;
		wake_at(s, time);
		wakes[s].next = std::min(wakes[s].next, next);
	}

	/* In the next step, whoever else says so, too. */
	void rouse(int32_t s) const { __atomic_store_n(&wakes[s].next, status[STATUS_AGE] + 1, __ATOMIC_RELAXED); }

	/* The end of the step's slice. */
	T until() const { return slice_end<T>(status, status[STATUS_SLICE]); }

	/* The index, in Work and Members, of a number's state as the slice began; -1 if it was given since. */
	int32_t saved_index(int32_t id) const { return id >= 0 && id < status[STATUS_SAVED] ? status[STATUS_NUMBERS] + id : -1; }

	/* A number's events in the slice. */
	int32_t events_of(int32_t id) const { return members[id].events - members[id].begun; }

	/* The number goes back to the state in which the slice began. */
	void go_back(int32_t id, Work<T> *work) const
	{
		const int32_t at = saved_index(id);
		if (at < 0)
			return begin_anew(members[id], work[id], slots[active[id]]);
		const Member &saved = members[at];
		Member &member = members[id];
		member.stuck = saved.stuck, member.events = saved.events, member.rapid = saved.rapid, member.seen = saved.seen, member.fast = saved.fast;
		member.kept = saved.kept, member.hits = member.ruled = 0;
		work[id] = work[at];
	}

	/* Is it held by an event of this slice? (One that was held before has no events, but may have hits.) */
	bool was_held(int32_t id, const Work<T> *work) const
	{
		const int32_t saved = saved_index(id);
		return events_of(id) > 0 && work[id].held > 0 && !(saved >= 0 && work[saved].held > 0);
	}

	bool ready() const { return this->length > 0 && lists_are_good(status); }

	int32_t root_of(int32_t s) const { return Forest{parents}.root_of(s); }
	void unite(int32_t a, int32_t b) const { Forest{parents}.unite(a, b); }

	bool take(int32_t s, int32_t id) const
	{
		int32_t nobody = -1;
		return __atomic_compare_exchange_n(&owners[s], &nobody, id, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
	}

	/* The two are one in the next round. */
	void conflict(int32_t a, int32_t b, int32_t round) const
	{
		unite(active[a], active[b]);
		for (int32_t leader : {a, b}) {
			__atomic_store_n(&members[leader].round, round + 1, __ATOMIC_RELAXED);
			__atomic_store_n(&members[leader].head, -1, __ATOMIC_RELAXED);
		}
		__atomic_store_n(&status[STATUS_ROUND], round + 1, __ATOMIC_RELAXED);
	}

	using Bodies<T>::slots;
	Span *const spans;
	const int32_t *const neighbours;
	int32_t *const status;
	Member *const members;
	int32_t *const active, *const owners, *const parents;
	FoundHit *const found;
	const int32_t *const extra;
	Wake *const wakes;
	const T ahead; /* steps after this one that a look is good for; a step that is cut short says nothing of longer ones */
};

}

#endif
