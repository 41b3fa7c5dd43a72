/* The queue of events of a cluster: CONTRACT.md, "The step events". */
#ifndef CAROM_CPU_QUEUE_HPP
#define CAROM_CPU_QUEUE_HPP

#include "cpu/clusters.hpp"
#include "cpu/heap.hpp"
#include "cpu/hits.hpp"
#include "cpu/impact.hpp"
#include "cpu/membership.hpp"
#include "cpu/shock.hpp"
#include "cpu/sieve.hpp"
#include "cpu/tug.hpp"
#include "cpu/ways.hpp"

namespace carom::cpu {

/* One cluster, by its leader's number. */
template <typename T> class Queue
{
public:
	Queue(const Clusters<T> &all, const Rubs<T> &friction, Work<T> *work_of, const Ways<T> &all_ways, const Hits<T> &kept, const JointPoints<T> &held,
		int32_t number, int32_t in_round, std::vector<int32_t> &room)
		: clusters(all), rubs(friction), impacts(all, friction), hits(kept), joints(held), slots(all.slots), members(all.members), work(work_of),
		  ways(all_ways), heap(all.members, work_of, room), membership(all, work_of, number, in_round), is_borne(all.status[STATUS_BORNE] > 0),
		  until(all.until())
	{
	}

	Tally run()
	{
		if (membership.is_none())
			return {};
		if (membership.is_in_pile() && !membership.take_near())
			return count();
		membership.each([this](int32_t m) {
			ways.fetch(clusters.active[m]); /* to be asked when it was hit */
			recall(m);
			heap.add(m);
		});
		while (answer_first()) {
		}
		return count();
	}

private:
	using Found = typename Bodies<T>::Found;

	/* Answers the first event; false when there is none left, or the cluster has to be given up. */
	bool answer_first()
	{
		const int32_t id = heap.first();
		const T *next = work[id].next;
		const int32_t other = static_cast<int32_t>(next[NEXT_PARTNER]);
		finished = !(next[NEXT_TIME] <= until);
		if (finished)
			return false;
		int32_t other_id = -1;
		if (other >= 0 && slots[other].is_dynamic()) {
			other_id = member(other, id);
			if (other_id < 0)
				return false;
			if (members[other_id].events != members[id].seen) {
				look_again(id); /* what it saw is over */
				return true;
			}
		}
		const T u = next[NEXT_TIME];
		Answered answered(work[id].trajectory(slots[clusters.active[id]]));
		const bool is_shock = answer(id, other_id, answered);
		if (is_shock)
			return pass_on(id, other_id, u);
		if (is_borne && answered.hit.total > 0 && (is_joined(id) || is_joined(other_id)))
			return tug(id, other_id, other, u, answered);
		if (other_id >= 0)
			members[other_id].seen = -1; /* it looks later */
		look_again(id);
		if (other_id >= 0)
			look_again(other_id);
		return true;
	}

	void look_again(int32_t id)
	{
		look(id);
		heap.update(id);
	}

	/* The number of a body that `by` is to hit, as a member, which it becomes if it is nobody's; -1 if it is another cluster's. */
	int32_t member(int32_t s, int32_t by)
	{
		return membership.join(s, by, [this](int32_t added) { heap.add(added); });
	}

	/* The member's first event, as the slice begins. */
	void recall(int32_t id)
	{
		if (clusters.saved_index(id) >= 0) {
			if (work[id].next[NEXT_TIME] == NEXT_UNKNOWN)
				look(id);
			return;
		}
		int32_t k = clusters.spans[clusters.active[id]].found;
		forget(id);
		for (; k >= 0; k = clusters.found[k].link) {
			const float time = as_float(clusters.found[k].time);
			offer(id, clusters.found[k].partner, {T(std::abs(time)), std::signbit(time)}, 0);
		}
		if (k == FOUND_NO_ROOM)
			look(id);
	}

	void forget(int32_t id)
	{
		work[id].next[NEXT_TIME] = NO_HIT;
		members[id].seen = 0;
	}

	/* Finds the member's first event. */
	void look(int32_t id)
	{
		const int32_t s = clusters.active[id];
		const Trajectory<T> way = work[id].trajectory(slots[s]);
		const Disc<T> disc = disc_of(s, work[id]);
		const bool is_clear = !(way.held > 0) && clusters.stays_inside(s, way, 1 + clusters.ahead);
		int32_t wall;
		forget(id);
		if (!is_clear) {
			const auto at_wall = clusters.wall_time(s, way, &wall);
			offer(id, -1 - wall, at_wall, 0);
		}
		clusters.wake_at(s, is_clear ? 1 + clusters.ahead : 1);
		Sieve<T> sieve(clusters.ahead);
		const auto meet = [&](int32_t, int32_t other, const Approach<T> &approach) { look_at(id, way, other, approach); };
		clusters.each_neighbour(s, clusters.spans[s].end, [&](int32_t other, bool) {
			if (const int32_t at = membership.seen(other); at >= 0)
				sieve.add(s, other, between(disc, disc_of(other, work[at]), clusters.ahead));
			else
				sieve.add(s, other, Between<T>(disc, Disc<T>(slots[other], clusters.length).later(disc.time), clusters.ahead));
			if (sieve.is_full())
				sieve.sift(meet);
		});
		sieve.sift(meet);
	}

	Disc<T> disc_of(int32_t s, const Work<T> &at) const { return Disc<T>(slots[s], at.place, at.time, at.held > 0, clusters.length); }

	/* The member's next event may be the one with this body. Of two that look again after one event the later one looks whether they hit: so one of both knows, and the other
	 * looks again when its own next event has come. In later steps the one that was changed last does, or the one for which the pair is, if that is changed in this step, too. */
	void look_at(int32_t id, const Trajectory<T> &way, int32_t other, const Approach<T> &approach)
	{
		const int32_t s = clusters.active[id], at = membership.seen(other), seen = at >= 0 ? members[at].events : 0;
		const Trajectory<T> other_way = membership.way_at(at, other);
		const Disc<T> other_disc(slots[other], other_way.place, other_way.time, other_way.held > 0, clusters.length);
		const Outlook<T> outlook(approach, slots[s], disc_of(s, work[id]), slots[other], other_disc);
		clusters.wake_before(s, outlook.earliest);
		const bool looks_later = at >= 0 && members[at].seen < 0;
		if (looks_later)
			return;
		if (seen > 0 && at < clusters.status[STATUS_NUMBERS]) /* a member */
			clusters.wake_before(other, outlook.earliest);
		const T first = work[id].next[NEXT_TIME];
		if (outlook.may_touch && !(outlook.earliest > first))
			offer(id, other, clusters.pair_time(s, way, other, other_way, smaller(first, T(1))), seen);
	}

	/* A hit with another slot, or with wall -1 - partner, which has had so many events. */
	void offer(int32_t id, int32_t partner, const Found &hit, int32_t seen)
	{
		const int32_t index = slots[clusters.active[id]].body(), other = partner < 0 ? partner : slots[partner].body();
		const T pause = hit.is_pause ? T(partner < 0 ? -0.5 : 0.5) : T(0);
		const T event[4] = {
			hit.time, static_cast<T>(std::max(index, other)), static_cast<T>(std::min(index, other)), static_cast<T>(partner) + pause};
		T *next = work[id].next;
		if (!(hit.time <= 1 && event_before(event, next)))
			return;
		std::copy(event, event + 4, next);
		members[id].seen = seen;
	}

	/* Is an event at time u a rapid one of the body? */
	bool is_rapid(int32_t id, const Trajectory<T> &way, T u) const
	{
		return id >= 0 && !(way.held > 0) && members[id].events > 0 && u - way.time < T(RAPID);
	}

	bool had_enough(int32_t id) const { return members[id].rapid >= RAPID_MOST; }

	/* What the parties of a hit were like, and what it was. */
	struct Answered {
		Trajectory<T> own, other;
		Impact<T> hit{};

		explicit Answered(const Trajectory<T> &way) : own(way), other(way) {}
	};

	/* Answers the member's event; true if it is a shock. */
	bool answer(int32_t id, int32_t other_id, Answered &answered)
	{
		const int32_t s = clusters.active[id], other = static_cast<int32_t>(work[id].next[NEXT_PARTNER]);
		const T u = work[id].next[NEXT_TIME];
		Trajectory<T> way = work[id].trajectory(slots[s]);
		const bool changes = !(way.held > 0), pause = work[id].next[NEXT_PARTNER] != static_cast<T>(other);
		const bool rapid = !pause && is_rapid(id, way, u);
		bool other_rapid = false;
		Past<T> past{rapid && had_enough(id), members[id].events, is_borne, false};
		past.shock = past.borne && clusters.weight() > 0;
		clusters.move(slots[s], way, u);
		Impact<T> &hit = answered.hit;
		answered.own = way;
		if (other < 0) {
			if (!pause)
				hit = impacts.at_wall(s, way, -1 - other, past);
		} else {
			Trajectory<T> other_way = membership.way_seen(other);
			const bool other_changes = other_id >= 0 && !(other_way.held > 0);
			other_rapid = !pause && is_rapid(other_id, other_way, u);
			past.rapid |= other_rapid && had_enough(other_id);
			past.events = other_id >= 0 ? std::max(past.events, members[other_id].events) : past.events;
			clusters.move(slots[other], other_way, u);
			answered.other = other_way;
			const bool is_row = slots[s].body() > slots[other].body();
			if (!pause)
				hit = is_row ? impacts.of_pair(s, way, other, other_way, past) : impacts.of_pair(other, other_way, s, way, past);
			if (other_changes)
				push(other, other_id, other_way, hit, !is_row, other_rapid, past.borne);
			if (changes)
				push(s, id, way, hit, is_row, rapid, past.borne);
		}
		if (other < 0 && changes)
			push(s, id, way, hit, true, rapid, past.borne);
		const T *next = work[id].next;
		if (hit.total > 0)
			count_hit(id, u, next[NEXT_ROW], next[NEXT_COLUMN], hit.at, {hit.x, hit.y}, hit.ruled);
		return past.rapid && past.shock && hit.lossy;
	}

	/* The number of a body that a shock gets to, as `member`: for it that is an event. */
	int32_t join_shock(int32_t s, int32_t by, T u)
	{
		const int32_t id = member(s, by);
		if (id >= 0) {
			const bool rapid = is_rapid(id, work[id].trajectory(slots[s]), u);
			members[id].rapid += rapid;
			members[id].stuck = rapid ? members[id].stuck + 1 : 0;
		}
		return id;
	}

	/* The hit of these two passes on to others at once; false if the cluster has to be given up. */
	bool pass_on(int32_t id, int32_t other_id, T u)
	{
		Shock<T> shock(clusters, rubs, work);
		const bool is_row = other_id < 0 || slots[clusters.active[id]].body() > slots[clusters.active[other_id]].body();
		const auto join = [&](int32_t s) { return join_shock(s, id, u); };
		if (!shock.spread(is_row ? id : other_id, is_row ? other_id : id, u, membership, join))
			return false;
		shock.each_hit([&](int32_t m, Partner partner, const Vec<T> &impulse, const Vec<T> &point, const Vec<T> &normal) {
			const int32_t index = slots[clusters.active[m]].body(), other = partner.key(slots);
			const T sign = index > other ? T(1) : T(-1);
			count_hit(m, u, static_cast<T>(std::max(index, other)), static_cast<T>(std::min(index, other)), {point, sign * normal}, sign * impulse,
				true);
		});
		shock.each([&](int32_t m) {
			const int32_t s = clusters.active[m];
			Trajectory<T> way = work[m].trajectory(slots[s]);
			members[m].events += 2; /* the way there, and what it got: who looks at it knows that it is not as it was */
			hold_at_last(members[m], STUCK_BORNE, Trajectory<T>(slots[s]), way);
			work[m].keep(way);
			widen(s, m, way, shock.margin(m));
		});
		shock.each([&](int32_t m) { look_again(m); });
		return true;
	}

	bool is_joined(int32_t id) const { return id >= 0 && joints.touching[clusters.active[id]].firm > 0; }

	/* What the hit of these two did passes on to what is joined with them; false if the cluster has to be given up. */
	bool tug(int32_t id, int32_t other_id, int32_t partner, T u, const Answered &answered)
	{
		const int32_t s = clusters.active[id], own = slots[s].body(), others = partner < 0 ? partner : slots[partner].body();
		const bool is_row = own > others, is_first = is_row || other_id < 0;
		const T sign = is_row == is_first ? T(1) : T(-1);
		const Impact<T> &hit = answered.hit;
		const Struck<T> struck{hit.at.point, Vec<T>(sign * hit.at.normal), Vec<T>(sign * hit.x, sign * hit.y),
			partner < 0 ? rubs.at_wall(own) : rubs.between(own, others)};
		const auto join = [&](int32_t slot) { return member(slot, id); };
		Tug<T> all(clusters, work, joints);
		const bool done = is_first ? all.spread(id, other_id, partner, struck, answered.own, answered.other, u, membership, join)
								   : all.spread(other_id, id, s, struck, answered.other, answered.own, u, membership, join);
		if (!done)
			return false;
		hits.amend(members[id], Vec<T>(sign * all.impulse()));
		all.each([&](int32_t m) {
			const int32_t slot = clusters.active[m];
			Trajectory<T> way = work[m].trajectory(slots[slot]);
			members[m].events += 2; /* as of a shock */
			hold_at_last(members[m], STUCK_BORNE, Trajectory<T>(slots[slot]), way);
			work[m].keep(way);
			widen(slot, m, way);
		});
		all.each([&](int32_t m) { look_again(m); });
		return true;
	}

	/* As one of the member's, of that time, row and column; the impulse is on the row body. */
	void count_hit(int32_t id, T u, T row, T column, const Where<T> &at, const Vec<T> &impulse, bool ruled)
	{
		members[id].hits++;
		members[id].ruled += ruled;
		if (hits.are_kept())
			hits.keep(members[id],
				{u, row, column, 0, at.point.x(), at.point.y(), at.normal.x(), at.normal.y(), impulse.x(), impulse.y(), T(ruled), 0, 0, 0, 0, 0});
	}

	void push(int32_t s, int32_t id, Trajectory<T> &way, const Impact<T> &hit, bool is_row, bool rapid, bool borne)
	{
		const T sign = is_row ? T(1) : T(-1);
		way.place[LINEAR_VX] += (sign * hit.x) * slots[s].mass[MASS_INVERSE];
		way.place[LINEAR_VY] += (sign * hit.y) * slots[s].mass[MASS_INVERSE];
		way.velocity += (is_row ? hit.row_torque : hit.column_torque) * slots[s].mass[MASS_INVERSE_INERTIA];
		Member &member = members[id];
		member.rapid += rapid;
		member.stuck = rapid && hit.slow ? member.stuck + 1 : 0;
		member.fast |= hit.total > 0 && !hit.slow;
		member.events++;
		hold_at_last(member, borne ? STUCK_BORNE : STUCK_MOST, Trajectory<T>(slots[s]), way);
		work[id].keep(way);
		widen(s, id, way);
	}

	/* Adds the way that is left of the slice to the box of all of it. */
	void widen(int32_t s, int32_t id, const Trajectory<T> &way, T margin = 0)
	{
		const Box<T> rest = ways.until(until, s, way, margin);
		T *box = work[id].box;
		box[0] = std::min(box[0], rest.min_x), box[1] = std::min(box[1], rest.min_y);
		box[2] = std::max(box[2], rest.max_x), box[3] = std::max(box[3], rest.max_y);
	}

	/* What a finished cluster did; of one that is given up all is lost. */
	Tally count()
	{
		Tally tally{};
		membership.each([&](int32_t m) {
			if (finished) {
				tally += {members[m].hits, members[m].ruled, clusters.was_held(m, work), 0};
				if (!is_last_slice(clusters.status) && clusters.events_of(m) >= PILE_EVENTS)
					membership.stays_together();
				return;
			}
			tally.lost += clusters.events_of(m);
			clusters.go_back(m, work);
		});
		return tally;
	}

	const Clusters<T> &clusters;
	const Rubs<T> &rubs;
	const Impacts<T> impacts;
	const Hits<T> &hits;
	const JointPoints<T> &joints;
	const Slot<T> *const slots;
	Member *const members;
	Work<T> *const work;
	const Ways<T> &ways;
	Heap<T> heap;
	Membership<T> membership;
	const bool is_borne; /* forces bear what rests: the step contacts */
	const T until;       /* the slice's end */
	bool finished = false;
};

}

#endif
