/* A hit that joints pass on at once: CONTRACT.md, "The step contacts", Tugs. */
#ifndef CAROM_CPU_TUG_HPP
#define CAROM_CPU_TUG_HPP

#include "cpu/membership.hpp"
#include "cpu/push.hpp"
#include "cpu/resting.hpp"

#include <algorithm>

namespace carom::cpu {

/* What a hit did, seen from the first of its two. */
template <typename T> struct Struck {
	Vec<T> point, n; /* n: towards the first, */
	Vec<T> impulse;  /* and what it got */
	T friction;
};

/* The points of joints, as they are in this step; touching one int alone by the step events. */
template <typename T> struct JointPoints {
	const Touching *touching;
	const Points<T> *points;
};

/* One after the other, of one cluster. */
template <typename T> class Tug
{
public:
	Tug(const Clusters<T> &all, Work<T> *work_of, const JointPoints<T> &joints)
		: clusters(all), work(work_of), touching(joints.touching), lanes(joints.points), whole(all.whole()), share(part_of_whole(all.length, whole))
	{
	}

	/* From those two, of which the second may be none, -1, that were hit at time u, and were on such ways before; `partner` is the slot of what hit the first, or a wall. `own` are the
	 * cluster's members, and `join(slot)` is the number of one that becomes one; false if it can't. */
	template <typename Join>
	bool spread(int32_t one, int32_t other, int32_t partner, const Struck<T> &struck, const Trajectory<T> &one_before,
		const Trajectory<T> &other_before, T u, const Membership<T> &own, const Join &join)
	{
		time = u;
		first_slot = clusters.active[one], second_slot = partner;
		before[0] = &one_before, before[1] = &other_before;
		open(one, 1, own, join);
		if (other >= 0 && !is_lost)
			open(other, 0, own, join);
		if (is_lost)
			return false;
		strike(struck, partner, own);
		pass_on(own, join);
		if (!is_lost && gain() > T(TUG_GAIN) * (contact.impulse * changed)) {
			begin_anew();
			pass_on(own, join);
		}
		if (is_lost)
			return false;
		if ((goes_on || !is_driven()) && energy_gained() > T(TUG_GAIN) * (contact.impulse * changed))
			begin_anew(); /* and so it stays: the hit acts on the two alone */
		for (int32_t k = 0; k < count; k++)
			if (!parties[k].is_held) {
				Work<T> &to = work[parties[k].id];
				to.place[LINEAR_VX] = parties[k].vx, to.place[LINEAR_VY] = parties[k].vy, to.velocity = parties[k].w;
			}
		return true;
	}

	/* Calls `visit(number)` for all that it moved to that time. */
	template <typename Visit> void each(const Visit &visit) const
	{
		for (int32_t k = 0; k < count; k++)
			visit(parties[k].id);
	}

	/* What the first got in all by the hit. */
	Vec<T> impulse() const { return Vec<T>(contact.impulse * contact.n + contact.rub * contact.along()); }

private:
	/* In sweeps over all points, until they do no more, or the cluster is lost. */
	template <typename Join> void pass_on(const Membership<T> &own, const Join &join)
	{
		goes_on = true;
		for (int32_t sweep = 0; sweep < TUG_SWEEPS && goes_on; sweep++) {
			goes_on = false;
			for (int32_t k = 0; k < count; k++)
				for (int32_t point = 0; point < parties[k].points; point++) {
					Point &p = points[parties[k].first + point];
					if (p.other == closed && !reach(p, parties[k], own, join))
						continue;
					if (is_lost)
						return;
					goes_on |= push(parties[k], p, p.other, true);
				}
			goes_on |= push(parties[0], contact, contact.other, false); /* in the end the two part, whatever joints wanted */
		}
	}

	struct Party : Pushed<T> {
		int32_t id, first, points; /* of those of joints */
		bool is_held;
		Pushed<T> before; /* as it became one */
	};

	/* A point of a joint, or where the two hit each other. */
	struct Point : PushPoint<T> {
		int32_t slot, other; /* the partner, -1 for none that moves; and as a party, or: */
	};

	static constexpr int32_t fixed = -1, closed = -2;

	/* How the body in a slot moves at that time: as it was before it was hit, or is now. */
	Trajectory<T> way_of(int32_t s, const Membership<T> &own, bool was) const
	{
		if (was && s == first_slot)
			return *before[0];
		if (was && s == second_slot)
			return *before[1];
		Trajectory<T> way = own.way_seen(s);
		clusters.move(clusters.slots[s], way, time);
		return way;
	}

	/* The partner of a point, which is none yet, becomes a party if the hit would move it; false if not, or where there are too many. */
	template <typename Join> bool reach(Point &p, const Party &party, const Membership<T> &own, const Join &join)
	{
		const int32_t id = own.own_number(p.slot); /* a member of the cluster since the party with the point is open */
		int32_t k = party_of(id);
		if (k < 0) {
			if (!(std::abs(p.part - p.parting(party, nullptr)) >= least) || count == SHOCK_PARTIES)
				return false;
			k = count;
			open(id, 0, own, join);
		}
		p.other = k; /* also where that one has no room for this point */
		return true;
	}

	int32_t party_of(int32_t id) const
	{
		for (int32_t k = 0; k < count; k++)
			if (parties[k].id == id)
				return k;
		return fixed;
	}

	/* Moves a body to the time, and looks what it is joined with; so many of its points are others. Who is joined with it becomes a member, for how that moves counts, however far it is. */
	template <typename Join> void open(int32_t id, int32_t others, const Membership<T> &own, const Join &join)
	{
		const int32_t s = clusters.active[id], k = count;
		const Slot<T> &slot = clusters.slots[s];
		Trajectory<T> way = work[id].trajectory(slot);
		clusters.move(slot, way, time);
		work[id].keep(way);
		const Pushed<T> now(slot, way);
		parties[k] = {now, id, taken, 0, way.held > 0, now};
		count++;
		for (int32_t lane = 0; lane < touching[s].firm && parties[k].points < SHOCK_POINTS - others; lane++) {
			const Points<T> &four = lanes[touching[s].first + lane / lane_count];
			const int32_t i = lane % lane_count;
			const Partner partner(four.partner[i]);
			const bool moves = partner.moves();
			const int32_t party = moves && own.own_number(partner.slot()) >= 0 ? party_of(own.own_number(partner.slot())) : fixed;
			if (party >= 0 && meets(parties[party], s, k))
				continue;
			is_lost = party < 0 && moves && clusters.slots[partner.slot()].is_dynamic() && join(partner.slot()) < 0;
			if (is_lost)
				return;
			Point &p = points[taken++];
			parties[k].points++;
			p = {{Vec<T>(four.normal_x[i], four.normal_y[i]), four.arm[i], four.other_arm[i], 0, 0, 0, 0, 0, 0, 0, 0}, moves ? partner.slot() : -1,
				party >= 0                                                 ? party
					: moves && clusters.slots[partner.slot()].is_dynamic() ? closed
																		   : fixed};
			p.part = speed_on(way_of(s, own, true), p.n, p.arm);
			if (moves) {
				p.part -= speed_on(way_of(partner.slot(), own, true), p.n, p.other_arm);
				p.coming = speed_on(way_of(partner.slot(), own, false), p.n, p.other_arm);
			}
			if (is_loose(p, slot, four.least[i])) {
				taken--, parties[k].points--;
				continue;
			}
			if (stops)
				p.part = 0;
		}
	}

	/* Does it hold nothing, since in the step it brings its anchors so far, or since by now they part so much faster, or slower, than its force would have it? In m a whole step. */
	bool is_loose(const Point &p, const Slot<T> &slot, T least_way) const
	{
		const T radii = slot.radius() + (p.slot >= 0 ? clusters.slots[p.slot].radius() : T(0));
		const T other = p.slot >= 0 ? speed_on(Trajectory<T>(clusters.slots[p.slot]), p.n, p.other_arm) : T(0);
		const T begun = (speed_on(Trajectory<T>(slot), p.n, p.arm) - other) * whole, more = -least_way - begun;
		const T way = share * begun + (T(0.5) * (share * share)) * more, now = p.part * whole;
		return larger(std::abs(way), std::abs(now - (begun + (time * share) * more))) > T(TUG_LOOSE) * radii;
	}

	/* Has a party points of joints with slot s? Then these are with party k. */
	bool meets(const Party &party, int32_t s, int32_t k)
	{
		bool any = false;
		for (Point *p = points + party.first; p < points + party.first + party.points; p++)
			if (p->slot == s)
				p->other = k, any = true;
		return any;
	}

	/* Where the two hit each other. */
	void strike(const Struck<T> &struck, int32_t partner, const Membership<T> &own)
	{
		const Work<T> &one = work[parties[0].id];
		const Vec<T> n = struck.n, lever = struck.point - Vec<T>(one.place[LINEAR_X], one.place[LINEAR_Y]);
		contact = {
			{n, cross(lever, n), 0, 0, 0, struck.friction, 0, 0, 0, inner(struck.impulse, n), 0}, partner >= 0 ? partner : -1, count > 1 ? 1 : fixed};
		const Vec<T> way = contact.along();
		contact.grip_arm = cross(lever, way), contact.rub = inner(struck.impulse, way);
		if (partner >= 0) {
			const Trajectory<T> other = way_of(partner, own, false);
			const Vec<T> other_lever = struck.point - Vec<T>(other.place[LINEAR_X], other.place[LINEAR_Y]);
			contact.other_arm = cross(other_lever, n), contact.other_grip_arm = cross(other_lever, way);
			contact.coming = speed_on(other, n, contact.other_arm), contact.slipping = speed_on(other, way, contact.other_grip_arm);
		}
		first_impulse = contact.impulse, first_rub = contact.rub;
		contact.part = contact.parting(parties[0], party(contact.other));
		changed = contact.impulse * contact.gives(parties[0], party(contact.other), contact.arm, contact.other_arm);
		least = T(TUG_WITHIN) * changed;
	}

	/* What joints gave: their anchors have speeds against each other where they are being brought to where they belong. */
	T gain() const
	{
		T all = 0;
		for (int32_t k = 0; k < count; k++)
			for (int32_t point = 0; point < parties[k].points; point++)
				all += points[parties[k].first + point].impulse * points[parties[k].first + point].part;
		return all;
	}

	bool is_driven(const Point &p) const { return p.slot >= 0 && clusters.slots[p.slot].is_kinematic(); }

	/* Does something kinematic give and take energy as it likes? */
	bool is_driven() const
	{
		return std::any_of(points, points + taken, [&](const Point &p) { return is_driven(p); }) || is_driven(contact);
	}

	/* Twice the energy that all have more than before the hit: sweeps that come to no end may give some. */
	T energy_gained() const
	{
		T all = 0;
		for (int32_t k = 0; k < count; k++) {
			const int32_t s = clusters.active[parties[k].id];
			const Trajectory<T> *way = s == first_slot ? before[0] : s == second_slot ? before[1] : nullptr;
			all += parties[k].energy() - (way ? Pushed<T>(clusters.slots[s], *way) : parties[k].before).energy();
		}
		return all;
	}

	/* All move as before it, and the hit is what it was; joints are to have no speeds, and so give nothing. */
	void begin_anew()
	{
		stops = true;
		for (int32_t k = 0; k < count; k++) {
			static_cast<Pushed<T> &>(parties[k]) = parties[k].before;
			for (int32_t point = 0; point < parties[k].points; point++)
				points[parties[k].first + point].part = points[parties[k].first + point].impulse = 0;
		}
		contact.impulse = first_impulse, contact.rub = first_rub;
	}

	Pushed<T> *party(int32_t k) { return k >= 0 ? &parties[k] : nullptr; }

	bool push(Party &body, Point &p, int32_t other, bool pulls)
	{
		return p.push(body, party(other), p.parting(body, party(other)), pulls ? T(TUG_FARTHER) : T(1), least, pulls);
	}

	const Clusters<T> &clusters;
	Work<T> *const work;
	const Touching *const touching;
	const Points<T> *const lanes;
	const T whole, share; /* s: a whole step; and how much of that this one is */
	int32_t count = 0, taken = 0, first_slot = -1, second_slot = -1;
	const Trajectory<T> *before[2] = {nullptr, nullptr};
	T time = 0, changed = 0, least = 0, /* how much the hit changed a rate, and what of that is too little */
		first_impulse = 0, first_rub = 0;
	bool stops = false;   /* joints are to have no speeds, instead of those that they had */
	bool goes_on = false; /* sweeps have come to no end */
	bool is_lost = false; /* the cluster has to be given up */
	Point contact{};
	Party parties[SHOCK_PARTIES];
	Point points[SHOCK_PARTIES * SHOCK_POINTS]; /* those of one party follow each other */
};

}

#endif
