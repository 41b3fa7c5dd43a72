/* A hit that passes on at once to all that the bodies press on: CONTRACT.md, "The step contacts", Shocks. */
#ifndef CAROM_CPU_SHOCK_HPP
#define CAROM_CPU_SHOCK_HPP

#include "cpu/resting.hpp"

#include <algorithm>
#include <limits>

namespace carom::cpu {

/* Where a party may be pushed: a record of Shocks. The impulses are on the party. */
template <typename T> struct ShockPoint {
	T normal_x, normal_y, arm, other_arm;
	T grip_arm, other_grip_arm, friction, part;
	T partner, number, impulse, rub; /* impulse: how fast the partner comes along the normal, while it could be a party, but is none */

	Vec<T> normal() const { return {normal_x, normal_y}; }
	Vec<T> along() const { return {-normal_y, normal_x}; }
	Partner whom() const { return Partner(partner); }
};

static_assert(sizeof(ShockPoint<float>) == SHOCK_WIDTH * 4 * sizeof(float), "records");

/* One after the other, of one cluster. */
template <typename T> class Shock
{
public:
	Shock(const Clusters<T> &all, const Rubs<T> &friction, Work<T> *work_of, T *points_of)
		: clusters(all), work(work_of), points(reinterpret_cast<ShockPoint<T> *>(points_of)),
		  finder(all, friction), nearness{all.weight(), std::numeric_limits<T>::infinity()}
	{
	}

	/* From those two, of which the second may be none, -1, at time u. `own(slot)` is the number of a body of the cluster, else -1, `join(slot)` of one that
	 * becomes one; false if it can't. */
	template <typename Own, typename Join> bool spread(int32_t first, int32_t second, T u, const Own &own, const Join &join)
	{
		count = 0;
		time = u;
		for (int32_t id : {first, second})
			if (id >= 0)
				open(id, own);
		for (int32_t sweep = 0; sweep < SHOCK_SWEEPS; sweep++) {
			bool more = false;
			for (int32_t k = 0; k < count; k++) {
				for (ShockPoint<T> *p = points_of(parties[k]), *end = p + SHOCK_POINTS; p < end && !p->whom().is_none(); p++) {
					const T rate = rate_of(parties[k], *p);
					if (!(rate < 0) && !(is_open(*p) && p->impulse > 0))
						continue;
					if (!is_open(*p) && count < SHOCK_PARTIES) {
						const int32_t id = join(p->whom().slot());
						if (id < 0)
							return false;
						open(id, own);
					}
					more |= is_open(*p) && push(parties[k], *p, rate);
				}
			}
			if (!more)
				break;
		}
		return true;
	}

	/* Calls `visit(number)` for all that it moved to that time. */
	template <typename Visit> void each(const Visit &visit) const
	{
		for (int32_t k = 0; k < count; k++)
			visit(parties[k]);
	}

	/* Calls `visit(number, partner, the impulse on the body, where, the normal towards it)` for each of its hits. */
	template <typename Visit> void each_hit(const Visit &visit) const
	{
		for (int32_t k = 0; k < count; k++) {
			const ShockPoint<T> *p = points_of(parties[k]), *const end = p + SHOCK_POINTS;
			while (p < end && !p->whom().is_none()) {
				const ShockPoint<T> &first = *p++;
				const bool has_second = p < end && p->partner == first.partner;
				const ShockPoint<T> &second = has_second ? *p++ : first;
				const T total = has_second ? first.impulse + second.impulse : first.impulse, rub = has_second ? first.rub + second.rub : first.rub;
				if (!is_open(first) || !(total > 0))
					continue;
				const T part = has_second ? second.impulse / total : T(0);
				const T arm = first.arm + part * (second.arm - first.arm), grip_arm = first.grip_arm + part * (second.grip_arm - first.grip_arm);
				const Vec<T> n = first.normal(), at(work[parties[k]].place[LINEAR_X], work[parties[k]].place[LINEAR_Y]);
				visit(parties[k], first.whom(), Vec<T>(total * n + rub * first.along()), Vec<T>(at + (grip_arm * n - arm * first.along())), n);
			}
		}
	}

	/* What it looks at beside a body's way. */
	T margin(int32_t id) const { return nearness.force(nearness.weight, slot_of(id).radius()); }

private:
	struct Give {
		T mass, inertia; /* inverse */

		T at(T arm) const { return mass + inertia * (arm * arm); }
	};

	const Slot<T> &slot_of(int32_t id) const { return clusters.slots[clusters.active[id]]; }
	ShockPoint<T> *points_of(int32_t id) const { return points + SHOCK_POINTS * id; }
	bool is_party(int32_t id) const { return id >= 0 && std::find(parties, parties + count, id) < parties + count; }

	Give give_of(int32_t id) const
	{
		if (id < 0 || work[id].held > 0)
			return {0, 0};
		return {slot_of(id).mass[MASS_INVERSE], slot_of(id).mass[MASS_INVERSE_INERTIA]};
	}

	/* Of a way, along n; what is held stands. */
	template <typename Way> static T speed(const Way &way, const Vec<T> &n, T arm)
	{
		if (way.held > 0)
			return 0;
		return inner(n, Vec<T>(way.place[LINEAR_VX], way.place[LINEAR_VY])) + way.velocity * arm;
	}

	/* Could the partner become a party? */
	bool can_join(Partner partner) const { return partner.moves() && clusters.slots[partner.slot()].is_dynamic(); }
	bool is_open(const ShockPoint<T> &p) const { return p.number >= 0 || !can_join(p.whom()); }

	/* How fast the partner of an open point comes along n: a party, a kinematic body, or what does not move. */
	T partners_speed(const ShockPoint<T> &p, const Vec<T> &n, T arm) const
	{
		if (p.number >= 0)
			return speed(work[static_cast<int32_t>(p.number)], n, arm);
		return p.whom().moves() ? speed(Trajectory<T>(clusters.slots[p.whom().slot()]), n, arm) : T(0);
	}

	T rate_of(int32_t id, const ShockPoint<T> &p) const
	{
		return speed(work[id], p.normal(), p.arm) - (is_open(p) ? partners_speed(p, p.normal(), p.other_arm) : p.impulse);
	}

	/* Moves a body to the time, and finds where it may be pushed, or push. */
	template <typename Own> void open(int32_t id, const Own &own)
	{
		const int32_t s = clusters.active[id];
		Trajectory<T> way = work[id].trajectory(clusters.slots[s]);
		clusters.move(clusters.slots[s], way, time);
		work[id].keep(way);
		ShockPoint<T> *p = points_of(id), *const end = p + SHOCK_POINTS;
		const auto way_of = [&](int32_t other) {
			const int32_t other_id = own(other);
			Trajectory<T> other_way = other_id >= 0 ? work[other_id].trajectory(clusters.slots[other]) : Trajectory<T>(clusters.slots[other]);
			clusters.move(clusters.slots[other], other_way, time);
			return other_way;
		};
		finder.each(s, way, nearness, way_of, [&](const Resting<T> &rest) {
			const bool joins = can_join(rest.partner);
			if (joins && is_party(own(rest.partner.slot())))
				return; /* which has the points */
			for (int32_t k = 0; k < rest.points && p < end; k++, p++) {
				const auto &at = rest.at[k];
				*p = {rest.n.x(), rest.n.y(), at.arm, at.other_arm, at.slip.arm, at.slip.other_arm, rest.friction,
					((T(SHOCK_PARTING) * rest.force) * (1 - time)) / clusters.length, static_cast<T>(rest.partner.code), -1, 0, 0};
				if (joins)
					p->impulse = speed(way_of(rest.partner.slot()), rest.n, at.other_arm);
			}
		});
		if (p < end)
			p->partner = PARTNER_NONE;
		for (int32_t k = 0; k < count; k++)
			for (ShockPoint<T> *q = points_of(parties[k]), *last = q + SHOCK_POINTS; q < last && !q->whom().is_none(); q++)
				if (q->partner == static_cast<T>(s))
					q->number = static_cast<T>(id), q->impulse = 0;
		parties[count++] = id;
	}

	void turn(int32_t id, const Give &give, const Vec<T> &impulse, T torque)
	{
		work[id].place[LINEAR_VX] += give.mass * impulse.x();
		work[id].place[LINEAR_VY] += give.mass * impulse.y();
		work[id].velocity += give.inertia * torque;
	}

	/* Lets the point part, or pull less; false if that is too little to count. */
	bool push(int32_t id, ShockPoint<T> &p, T rate)
	{
		const int32_t other = static_cast<int32_t>(p.number);
		const Give give = give_of(id), other_give = give_of(other);
		const T gives = give.at(p.arm) + other_give.at(p.other_arm);
		if (!(gives > 0))
			return false;
		const T impulse = larger(p.impulse + (p.part - rate) / gives, T(0)), more = impulse - p.impulse;
		if (std::abs(more) * gives < T(SHOCK_WITHIN) * p.part)
			return false;
		p.impulse = impulse;
		act(id, give, other, other_give, more * p.normal(), more * p.arm, more * p.other_arm);
		if (!(p.friction > 0))
			return true;
		const T grip_gives = give.at(p.grip_arm) + other_give.at(p.other_grip_arm);
		const T slip = speed(work[id], p.along(), p.grip_arm) - partners_speed(p, p.along(), p.other_grip_arm);
		const T most = p.friction * impulse, rub = larger(smaller(p.rub - slip / grip_gives, most), -most), change = rub - p.rub;
		p.rub = rub;
		act(id, give, other, other_give, change * p.along(), change * p.grip_arm, change * p.other_grip_arm);
		return true;
	}

	void act(int32_t id, const Give &give, int32_t other, const Give &other_give, const Vec<T> &impulse, T torque, T other_torque)
	{
		turn(id, give, impulse, torque);
		if (other >= 0)
			turn(other, other_give, -impulse, -other_torque);
	}

	const Clusters<T> &clusters;
	Work<T> *const work;
	ShockPoint<T> *const points;
	RestFinder<T> finder;
	const Nearness<T> nearness;
	int32_t parties[SHOCK_PARTIES];
	int32_t count = 0;
	T time = 0;
};

}

#endif
