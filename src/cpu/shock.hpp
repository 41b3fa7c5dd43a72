/* A hit that passes on at once to all that the bodies press on: CONTRACT.md, "The step contacts", Shocks. */
#ifndef CAROM_CPU_SHOCK_HPP
#define CAROM_CPU_SHOCK_HPP

#include "cpu/membership.hpp"
#include "cpu/push.hpp"
#include "cpu/resting.hpp"

#include <limits>

namespace carom::cpu {

/* One after the other, of one cluster. Points are kept here, side by side: Shocks is for kernels. */
template <typename T> class Shock
{
public:
	Shock(const Clusters<T> &all, const Rubs<T> &friction, Work<T> *work_of)
		: clusters(all), members(all.members), work(work_of), finder(all, friction), nearness{all.weight(), std::numeric_limits<T>::infinity()}
	{
	}

	/* From those two, of which the second may be none, -1, at time u. `own` are the cluster's members, and `join(slot)` is the number of one that
	 * becomes one; false if it can't. Who was moved to that time has to look again. */
	template <typename Join> bool spread(int32_t first, int32_t second, T u, const Membership<T> &own, const Join &join)
	{
		time = u;
		for (int32_t id : {first, second})
			if (id >= 0)
				open(id, own);
		bool done = pass_on(T(SHOCK_FARTHER), own, join);
		if (done && gains()) {
			begin_anew();
			done = pass_on(T(1), own, join);
		}
		for (int32_t k = 0; k < count; k++)
			put_back(parties[k]);
		return done;
	}

	/* Calls `visit(number)` for all that it moved to that time. */
	template <typename Visit> void each(const Visit &visit) const
	{
		for (int32_t k = 0; k < count; k++)
			visit(parties[k].id);
	}

	/* Calls `visit(number, partner, the impulse on the body, where, the normal towards it)` for each of its hits. */
	template <typename Visit> void each_hit(const Visit &visit) const
	{
		for (int32_t k = 0; k < count; k++) {
			const Point *p = points + parties[k].first, *const last = p + parties[k].points;
			while (p < last) {
				const Point &first = *p++;
				const bool has_second = p < last && p->partner.code == first.partner.code && p->n == first.n;
				const Point &second = has_second ? *p++ : first;
				const T total = has_second ? first.impulse + second.impulse : first.impulse, rub = has_second ? first.rub + second.rub : first.rub;
				if (!(total > 0))
					continue;
				const T part = has_second ? second.impulse / total : T(0);
				const T arm = first.arm + part * (second.arm - first.arm), grip_arm = first.grip_arm + part * (second.grip_arm - first.grip_arm);
				const int32_t id = parties[k].id;
				const Vec<T> n = first.n, at(work[id].place[LINEAR_X], work[id].place[LINEAR_Y]);
				visit(id, first.partner, Vec<T>(total * n + rub * first.along()), Vec<T>(at + (grip_arm * n - arm * first.along())), n);
			}
		}
	}

	/* What it looks at beside a body's way. */
	T margin(int32_t id) const { return nearness.force(nearness.weight, clusters.slots[clusters.active[id]].radius()); }

private:
	/* Whom the shock has got to. */
	struct Party : Pushed<T> {
		int32_t id, first, points, changed; /* where its points begin, and how many there are; which of all changes was the last of its velocity */
		bool is_held;
		Pushed<T> before; /* as it became one */

		void give(T *place, T &turning) const { place[LINEAR_VX] = this->vx, place[LINEAR_VY] = this->vy, turning = this->w; }
	};

	/* Where a party may be pushed. */
	struct Point : PushPoint<T> {
		Partner partner;
		int32_t other;   /* the partner as a party, or: */
		int32_t settled; /* which of all changes was the last before it was looked at */
	};

	/* A partner that is no party: it never is, or not yet. */
	static constexpr int32_t fixed = -1, closed = -2;

	/* Has neither of its parties another velocity since then? */
	bool is_settled(const Party &party, const Point &p) const
	{
		return p.settled >= party.changed && (p.other < 0 || p.settled >= parties[p.other].changed);
	}

	/* In sweeps over all points, until they do no more; false if the cluster has to be given up. */
	template <typename Join> bool pass_on(T farther, const Membership<T> &own, const Join &join)
	{
		bool more = true;
		for (int32_t sweep = 0; sweep < SHOCK_SWEEPS && more; sweep++) {
			more = false;
			for (int32_t k = 0; k < count; k++) {
				for (Point *p = begin(parties[k]); p < end(parties[k]); p++) {
					if (is_settled(parties[k], *p))
						continue;
					p->settled = changes;
					const T rate = p->parting(parties[k], partner_of(*p));
					if (!(rate < 0) && !(p->other != closed && p->impulse > 0))
						continue;
					if (p->other == closed && count < SHOCK_PARTIES) {
						const int32_t id = join(p->partner.slot());
						if (id < 0)
							return false;
						open(id, own);
					}
					more |= p->other != closed && push(parties[k], *p, rate, farther);
				}
			}
		}
		return true;
	}

	/* Have all more energy than before by more than it takes to part, and than partners that move as they like gave? What rubs may, if sweeps go farther. */
	bool gains()
	{
		T gained = 0, given = 0, had = 0;
		for (int32_t k = 0; k < count; k++) {
			const T was = parties[k].before.energy();
			gained += parties[k].energy() - was;
			had += was;
			for (const Point *p = begin(parties[k]); p < end(parties[k]); p++) {
				given += p->impulse * p->part;
				if (p->other == fixed)
					given += p->impulse * p->coming + p->rub * p->slipping;
			}
		}
		return gained > 2 * given + T(SHOCK_GAIN) * had;
	}

	/* All move as before it. */
	void begin_anew()
	{
		changes++;
		for (int32_t k = 0; k < count; k++) {
			static_cast<Pushed<T> &>(parties[k]) = parties[k].before;
			parties[k].changed = changes;
			for (Point *p = begin(parties[k]); p < end(parties[k]); p++)
				p->impulse = p->rub = 0;
		}
	}

	Pushed<T> *partner_of(const Point &p) { return p.other >= 0 ? &parties[p.other] : nullptr; }

	/* Which party the member with a number is, else -1; `id` may be none, -1. */
	int32_t party_of(int32_t id) const { return id >= 0 && members[id].seen < 0 ? -1 - members[id].seen : -1; }

	Point *begin(const Party &party) { return points + party.first; }
	Point *end(const Party &party) { return begin(party) + party.points; }

	/* Has a party, if it is one, points with slot s? Then these are with party k. */
	bool meets(int32_t party, int32_t s, int32_t k)
	{
		bool any = false;
		if (party < 0)
			return false;
		for (Point *p = begin(parties[party]); p < end(parties[party]); p++)
			if (p->partner.code == s)
				p->other = k, any = true;
		return any;
	}

	/* Moves a body to the time, and finds where it may be pushed, or push. */
	void open(int32_t id, const Membership<T> &own)
	{
		const int32_t s = clusters.active[id], k = count++;
		const Slot<T> &slot = clusters.slots[s];
		Trajectory<T> way = work[id].trajectory(slot);
		clusters.move(slot, way, time);
		work[id].keep(way);
		const Pushed<T> now(slot, way);
		parties[k] = {now, id, taken, 0, ++changes, way.held > 0, now};
		const auto partys = [&](int32_t other) { return party_of(own.own_number(other)); };
		const auto way_of = [&](int32_t other) {
			Trajectory<T> other_way = own.way_seen(other);
			clusters.move(clusters.slots[other], other_way, time);
			if (const int32_t party = partys(other); party >= 0 && !parties[party].is_held) /* which has been pushed since */
				parties[party].give(other_way.place, other_way.velocity);
			return other_way;
		};
		const auto is_known = [&](int32_t other) { return meets(partys(other), s, k); };
		finder.each(s, way, nearness, way_of, is_known, [&](const Resting<T> &rest) {
			const bool moves = rest.partner.moves();
			const int32_t party = moves ? partys(rest.partner.slot()) : -1;
			const int32_t partner = party >= 0 ? party : moves && clusters.slots[rest.partner.slot()].is_dynamic() ? closed : fixed;
			const T part = ((T(SHOCK_PARTING) * rest.force) * (1 - time)) / clusters.length;
			const Trajectory<T> other_way = moves ? way_of(rest.partner.slot()) : way;
			for (int32_t i = 0; i < rest.points && parties[k].points < SHOCK_POINTS; i++) {
				const auto &at = rest.at[i];
				Point &p = points[taken++];
				parties[k].points++;
				p = {{rest.n, at.arm, at.other_arm, at.slip.arm, at.slip.other_arm, rest.friction, part, 0, 0, 0, 0}, rest.partner, partner, 0};
				if (moves)
					p.coming = speed_on(other_way, p.n, p.other_arm), p.slipping = speed_on(other_way, p.along(), p.other_grip_arm);
			}
		});
		members[id].seen = -1 - k;
	}

	/* Lets the point part, or pull less; false if that is too little to count. */
	bool push(Party &party, Point &p, T rate, T farther)
	{
		if (!p.push(party, partner_of(p), rate, farther, T(SHOCK_WITHIN) * p.part, false))
			return false;
		party.changed = ++changes;
		if (p.other >= 0)
			parties[p.other].changed = changes;
		return true;
	}

	void put_back(const Party &party) const
	{
		if (!party.is_held)
			party.give(work[party.id].place, work[party.id].velocity);
	}

	const Clusters<T> &clusters;
	Member *const members;
	Work<T> *const work;
	RestFinder<T> finder;
	const Nearness<T> nearness;
	int32_t count = 0, taken = 0, changes = 0;
	T time = 0;
	Party parties[SHOCK_PARTIES];
	Point points[SHOCK_PARTIES * SHOCK_POINTS]; /* those of one party follow each other */
};

}

#endif
