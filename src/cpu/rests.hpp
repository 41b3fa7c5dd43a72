/* What forces do to bodies that rest on each other, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_RESTS_HPP
#define CAROM_CPU_RESTS_HPP

#include "cpu/resting.hpp"

namespace carom::cpu {

/* What forces at points of a body add to the x, y and torque of its load, which has its share besides: a sum each of every fourth point, and then of those. */
template <typename T> struct Sums {
	const T inverse_mass, inverse_inertia;
	Lanes<T> x{}, y{}, torque{};

	/* Forces at four points, along a unit vector each. */
	void add(const Lanes<T> &forces, const Lanes<T> &along_x, const Lanes<T> &along_y, const Lanes<T> &arm)
	{
		const Lanes<T> straight = inverse_mass * forces, turning = inverse_inertia * forces;
		x += straight * along_x, y += straight * along_y, torque += turning * arm;
	}

	void add(const Points<T> &points, const Lanes<T> &forces) { add(forces, points.normal_x, points.normal_y, points.arm); }

	/* What friction does follows the force of its point. */
	void add(const Points<T> &points, const Grips<T> &grips, const Lanes<T> &forces) { add(forces, grips.x(points), grips.y(points), grips.arm); }

	void add_to(Lanes<T> &load) const
	{
		Lanes<T> of[lane_count] = {x, y, torque, Lanes<T>{}};
		transpose<T>(of);
		load += (of[0] + of[1]) + (of[2] + of[3]);
	}
};

/* Was a partner at rest on the ground as the step began? */
template <typename T> bool was_still(const Kept<T> *kept, Partner partner, const Vec<T> &ground)
{
	return partner.moves() ? kept[partner.slot()].is_at_rest(ground) : ground.isZero(0);
}

/* What the stages begin with: Uniforms, the clock, the slots, Status, Contacts, Touching, Grips, Islands. */
template <typename T> struct Rests {
	const Slot<T> *slots;
	int32_t *status;
	Points<T> *points;
	Touching *touching;
	Grips<T> *grips;
	Forest islands; /* dynamic bodies that touch each other, directly or by others */
	T length, part; /* of a whole step; and how much of that this one is, of joints */
	bool rubs;
	bool impulses;                   /* of the pass; read once, for in Status it lies beside what an iteration writes */
	const int32_t *places = nullptr; /* of stages that ask for the ground */

	explicit Rests(const Job<T> &job)
		: slots(reinterpret_cast<const Slot<T> *>(job.records(2))), status(job.list(3)), points(reinterpret_cast<Points<T> *>(job.records(4))),
		  touching(reinterpret_cast<Touching *>(job.list(5))), grips(reinterpret_cast<Grips<T> *>(job.records(6))), islands{job.list(7)},
		  length(whole_length(step_length(job.texels(1), job.texels(0)), job.texels(0))),
		  part(part_of_whole(step_length(job.texels(1), job.texels(0)), length)), rubs(job.texels(0).fact(UNIFORMS_RUBS, RUBS_ANY) > 0),
		  impulses(status[STATUS_PASS] == PASS_IMPULSES)
	{
	}

	/* Calls `visit(points, grips)` for all the points of a slot, in order; where nothing rubs there are no grips. */
	template <typename Visit> void each(int32_t s, const Visit &visit) const
	{
		int32_t four = touching[s].first;
		for (int32_t left = touching[s].count; left > 0; left -= lane_count, four++)
			visit(points[four], grips[rubs ? four : 0]);
	}

	/* Calls `visit(points, i, partner, which of all points it is)` for each that is of a joint. */
	template <typename Visit> void each_joined(int32_t s, const Visit &visit) const
	{
		for (int32_t k = 0; k < touching[s].joined; k++) {
			Points<T> &four = points[touching[s].first + k / lane_count];
			visit(four, k % lane_count, Partner(four.partner[k % lane_count]), k);
		}
	}

	/* Calls `visit(points, grips, i, partner, which of the contact's points it is)` for each point of contacts alone, but for those that are none. Two bodies may have contacts along several
	 * normals. */
	template <typename Visit> void each_point(int32_t s, const Visit &visit) const
	{
		Partner before;
		T x = 0, y = 0;
		int32_t point = 0, joined = touching[s].joined;
		each(s, [&](Points<T> &four, Grips<T> &rubbing) {
			for (int32_t i = 0; i < lane_count; i++) {
				const Partner partner(four.partner[i]);
				if (joined-- > 0 || partner.is_none())
					continue;
				point = partner.code == before.code && four.normal_x[i] == x && four.normal_y[i] == y ? point + 1 : 0;
				before = partner, x = four.normal_x[i], y = four.normal_y[i];
				visit(four, rubbing, i, partner, point);
			}
		});
	}

	/* How fast a slot's island is where it is at rest: as what carries it, if that is kinematic, and does not turn, and nothing static is touched. */
	Vec<T> ground_of(int32_t s) const
	{
		const int32_t carrier = touching[islands.parents[s]].carrier;
		if (carrier < 0 || carrier == CARRIER_STATIC)
			return {0, 0};
		const Slot<T> &slot = slots[places[carrier]];
		return slot.turn[TURN_VELOCITY] == 0 ? Vec<T>(slot.place[LINEAR_VX], slot.place[LINEAR_VY]) : Vec<T>(0, 0);
	}

	/* By how much forces move a body, and turn it. */
	T inverse_mass(int32_t s) const { return slots[s].mass[MASS_INVERSE]; }
	T inverse_inertia(int32_t s) const { return slots[s].mass[MASS_INVERSE_INERTIA] * static_cast<T>(touching[s].turns); }

	bool gives_way(Partner partner) const { return partner.moves() && slots[partner.slot()].is_dynamic(); }

	/* Adds what all forces on a slot come to. */
	void add_forces(int32_t s, Lanes<T> &load) const
	{
		Sums<T> sums{inverse_mass(s), inverse_inertia(s)};
		each(s, [&](const Points<T> &all, const Grips<T> &rubbing) {
			sums.add(all, all.force);
			if (rubs)
				sums.add(all, rubbing, rubbing.force);
		});
		sums.add_to(load);
	}

	/* How a body would move by itself. */
	void alone(int32_t s, T share, Lanes<T> &load) const
	{
		const Slot<T> &slot = slots[s];
		load = Lanes<T>{slot.place[LINEAR_VX], slot.place[LINEAR_VY], slot.turn[TURN_VELOCITY], 0} * length;
		if (!impulses)
			load += (Lanes<T>{slot.push[PUSH_X], slot.push[PUSH_Y], slot.push[PUSH_TORQUE], 0} * length) * length;
		load[LOAD_SHARE] = share;
	}
};

/* The lists of Loads, from slot 0 on. */
template <typename T> struct Loads {
	Lanes<T> *const now, *const next, *const alone;

	/* As the iteration with a number has them. */
	Loads(T *records, int32_t capacity, int32_t number)
		: now(list(records, capacity, number & 1)), next(list(records, capacity, 1 - (number & 1))), alone(list(records, capacity, LOADS_ALONE))
	{
	}

private:
	static Lanes<T> *list(T *records, int32_t capacity, int32_t which) { return reinterpret_cast<Lanes<T> *>(records) + LOADS_OF(capacity, which); }
};

}

#endif
