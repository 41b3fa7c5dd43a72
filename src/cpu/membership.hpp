/* How bodies become members of a cluster that is run, and clusters one: CONTRACT.md, "events". */
#ifndef CAROM_CPU_MEMBERSHIP_HPP
#define CAROM_CPU_MEMBERSHIP_HPP

#include "cpu/clusters.hpp"

#include <algorithm>

namespace carom::cpu {

/* Of one cluster, by its leader's number. */
template <typename T> class Membership
{
public:
	Membership(const Clusters<T> &all, Work<T> *work_of, int32_t number, int32_t in_round)
		: clusters(all), slots(all.slots), members(all.members), work(work_of), leader(number), round(in_round),
		  head(__atomic_load_n(&all.members[number].head, __ATOMIC_ACQUIRE))
	{
	}

	/* Another cluster got into the way before this one was run. */
	bool is_none() const { return head < 0; }

	/* Calls `visit(number)` for each member. */
	template <typename Visit> void each(const Visit &visit) const
	{
		for (int32_t m = head; m >= 0; m = members[m].link)
			visit(m);
	}

	/* The number of a member's body, else -1. */
	int32_t own_number(int32_t s) const
	{
		const int32_t id = number_of(s);
		return id >= 0 && __atomic_load_n(&members[id].owner, __ATOMIC_RELAXED) == leader ? id : -1;
	}

	/* The index of a body's state in Work and Members, as far as this cluster knows of it: of its own members now, of all others as the slice began; -1: as the step began. */
	int32_t seen(int32_t s) const
	{
		const int32_t own = own_number(s);
		return own >= 0 ? own : clusters.saved_index(number_of(s));
	}

	/* The way of a body of which that is seen. */
	Trajectory<T> way_at(int32_t at, int32_t s) const { return at >= 0 ? work[at].trajectory(slots[s]) : Trajectory<T>(slots[s]); }

	Trajectory<T> way_seen(int32_t s) const { return way_at(seen(s), s); }

	/* The number of a body that `by` is to hit, claimed if it is nobody's, and then `added(number)` is called; -1 if it is another cluster's. */
	template <typename Added> int32_t join(int32_t s, int32_t by, const Added &added)
	{
		if (claim(s, head)) {
			const int32_t id = number_of(s);
			added(id);
			return id;
		}
		const int32_t id = number_of(s);
		if (id < 0) {
			__atomic_store_n(&clusters.status[STATUS_LEFT], 1, __ATOMIC_RELAXED); /* so many numbers were lost: the step begins again */
			return -1;
		}
		if (!meet(owner_of(id)))
			return id;
		members[leader].pile |= clusters.events_of(by) >= PILE_EVENTS;
		if (round - clusters.status[STATUS_BEGUN] >= SPREAD_ROUND)
			spread();
		return -1;
	}

	/* It lies in a pile. */
	void stays_together() const { members[leader].pile = 1; }

	/* If one of its members led one that is, so is this. */
	bool is_in_pile() const
	{
		int32_t m = head;
		while (m >= 0 && !members[m].pile)
			m = members[m].link;
		if (m >= 0)
			stays_together();
		return m >= 0;
	}

	/* Takes on what is near, as long as there are numbers enough for what is hit; false if other clusters have some of it, which are one with this in the next round. */
	bool take_near()
	{
		const int32_t numbers = clusters.status[STATUS_NUMBERS], most = numbers - std::min(numbers / 4, NUMBERS_SPARE / 2);
		bool alone = true;
		each_neighbour([&](int32_t m, int32_t other) {
			if (!is_near(slots[clusters.active[m]], slots[other]))
				return;
			if (number_of(other) >= 0 || __atomic_load_n(&clusters.status[STATUS_ACTIVE], __ATOMIC_RELAXED) < most)
				claim(other, m);
			alone &= !meet(owner_of(number_of(other)));
		});
		return alone;
	}

private:
	/* The number of whoever's body in a slot, -1 if it has none. */
	int32_t number_of(int32_t s) const { return __atomic_load_n(&clusters.owners[s], __ATOMIC_ACQUIRE); }

	/* Who leads the cluster that a number belongs to, -1 if it is nobody's. */
	int32_t owner_of(int32_t id) const { return id < 0 ? -1 : __atomic_load_n(&members[id].owner, __ATOMIC_ACQUIRE); }

	/* If that is another cluster, the two are one in the next round. */
	bool meet(int32_t owner) const
	{
		const bool meets = owner >= 0 && owner != leader;
		if (meets)
			clusters.conflict(leader, owner, round);
		return meets;
	}

	/* Calls `visit(member, slot)` for each neighbour of each member, and of those that `visit` adds. */
	template <typename Visit> void each_neighbour(const Visit &visit) const
	{
		each([&](int32_t m) {
			const int32_t s = clusters.active[m];
			clusters.each_neighbour(s, clusters.spans[s].end, [&](int32_t other, bool) { visit(m, other); });
		});
	}

	/* All the clusters around this one are one with it in the next round. */
	void spread() const
	{
		each_neighbour([this](int32_t, int32_t other) { meet(owner_of(number_of(other))); });
	}

	/* As the step begins. */
	static bool is_near(const Slot<T> &slot, const Slot<T> &other)
	{
		const T x = other.place[LINEAR_X] - slot.place[LINEAR_X], y = other.place[LINEAR_Y] - slot.place[LINEAR_Y];
		const T reach = (slot.radius() + other.radius()) + T(PILE_GAP) * smaller(slot.radius(), other.radius());
		return other.is_dynamic() && x * x + y * y < reach * reach;
	}

	/* A body that was nobody's comes behind a member in the list; false if it is somebody's, or there are no more numbers. */
	bool claim(int32_t s, int32_t before)
	{
		int32_t id = number_of(s);
		if (id < 0 ? !number(s, &id) : !take_over(id))
			return false;
		__atomic_store_n(&clusters.parents[s], clusters.active[leader], __ATOMIC_RELEASE);
		members[id].link = members[before].link;
		members[before].link = id;
		return true;
	}

	/* One that has no number gets one, and is the cluster's. */
	bool number(int32_t s, int32_t *number)
	{
		const int32_t id = *number = fetch_add(&clusters.status[STATUS_ACTIVE], 1);
		if (id >= clusters.status[STATUS_NUMBERS])
			return false;
		clusters.active[id] = s;
		begin_anew(members[id], work[id], slots[s]);
		members[id].owner = leader;
		if (clusters.take(s, id))
			return true;
		clusters.active[id] = -1;
		members[id].reset();
		return false;
	}

	/* One that has a number from a slice before, if it is nobody's in this one. */
	bool take_over(int32_t id)
	{
		int32_t nobody = -1;
		return owner_of(id) < 0 && __atomic_compare_exchange_n(&members[id].owner, &nobody, leader, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
	}

	const Clusters<T> &clusters;
	const Slot<T> *const slots;
	Member *const members;
	Work<T> *const work;
	const int32_t leader, round, head;
};

}

#endif
