/* The forces between bodies that rest on each other: a projected gradient, accelerated as Nesterov did. */
#include "cpu/resting.hpp"

namespace carom::cpu {

constexpr int32_t chunk = 64; /* slots */

/* x, y, torque of an acceleration, in a step that is 1 long. */
template <typename T> struct Load {
	T x, y, torque, points;

	T along(const Vec<T> &n, T arm) const { return (n.x() * x + n.y() * y) + arm * torque; }
	void add(T force, const Vec<T> &n, T arm, const Slot<T> &slot)
	{
		x += (slot.mass[MASS_INVERSE] * force) * n.x();
		y += (slot.mass[MASS_INVERSE] * force) * n.y();
		torque += (slot.mass[MASS_INVERSE_INERTIA] * force) * arm;
	}
};

/* Of a slot, before the step. */
template <typename T> struct Kept {
	T push[4], velocities[4];

	void keep(const Slot<T> &slot)
	{
		std::copy_n(slot.push, 4, push);
		velocities[0] = slot.place[LINEAR_VX], velocities[1] = slot.place[LINEAR_VY], velocities[2] = slot.turn[TURN_VELOCITY];
	}

	void restore(Slot<T> &slot, bool with_velocities) const
	{
		std::copy_n(push, 4, slot.push);
		if (with_velocities)
			slot.place[LINEAR_VX] = velocities[0], slot.place[LINEAR_VY] = velocities[1], slot.turn[TURN_VELOCITY] = velocities[2];
	}
};

/* What the stages begin with: Uniforms, the clock, the slots, Status, Contacts, Touching. */
template <typename T> struct Rests {
	const Slot<T> *slots;
	int32_t *status;
	Resting<T> *contacts;
	const Touching *touching;
	T length;

	explicit Rests(const Job<T> &job)
		: slots(reinterpret_cast<const Slot<T> *>(job.records(2))), status(job.list(3)), contacts(reinterpret_cast<Resting<T> *>(job.records(4))),
		  touching(reinterpret_cast<const Touching *>(job.list(5))), length(step_length(job.texels(1), job.texels(0)))
	{
	}

	bool moves(int32_t other) const { return other >= 0 && !slots[other].is_static(); }

	/* Calls `visit(contact)` for all the contacts of a slot, in order. */
	template <typename Visit> void each(int32_t s, const Visit &visit) const
	{
		for (Resting<T> *rest = contacts + CONTACTS_MOST * s, *end = rest + touching[s].count; rest != end; rest++)
			visit(*rest);
	}

	/* What acts on a body besides. */
	Load<T> push(int32_t s) const
	{
		if (status[STATUS_PASS] == PASS_IMPULSES)
			return {};
		const T *p = slots[s].push;
		return {(p[PUSH_X] * length) * length, (p[PUSH_Y] * length) * length, (p[PUSH_TORQUE] * length) * length, 0};
	}
};

template <typename T> static void begin(const Job<T> &job)
{
	int32_t *status = job.list(2);
	const int32_t first = job.domain[2], last = job.domain[3];
	const bool waits = iterations_are_wanted(status);
	if (!(step_length(job.texels(1), job.texels(0)) > 0) || !lists_are_good(status) || status[STATUS_UNDER_WAY])
		return;
	if (!waits && status[STATUS_PASS] == PASS_FORCES)
		return; /* the forces are found: with iterations that were handed over for the impulses */
	status[STATUS_HANDED] = last;
	if (waits)
		return;
	status[STATUS_FIRST] = status[STATUS_WANTED] = first;
	if (status[STATUS_PASS]++ == 0)
		status[STATUS_TOUCHING] = status[STATUS_BORNE] = 0;
}

template <typename T> static void find(const Job<T> &job)
{
	const Clusters<T> clusters(job, 14);
	Resting<T> *contacts = reinterpret_cast<Resting<T> *>(job.records(12));
	Touching *touching = reinterpret_cast<Touching *>(job.list(13));
	Kept<T> *kept = reinterpret_cast<Kept<T> *>(job.records(16));
	int32_t *status = clusters.status;
	if (status[STATUS_FIRST] != job.domain[2])
		return;
	const bool first = status[STATUS_PASS] == PASS_IMPULSES;
	job.pool.run(job.domain[0], 256, [&](int32_t from, int32_t to) {
		RestFinder<T> finder(clusters);
		for (int32_t s = from; s < to; s++) {
			const bool listed = !first && touching[s].count > 0;
			if (first)
				kept[s].keep(clusters.slots[s]);
			touching[s].count = finder.find(s, contacts + CONTACTS_MOST * s);
			if (touching[s].count > 0 && !listed)
				touching[fetch_add(&status[STATUS_TOUCHING], 1)].slot = s;
		}
	});
}

/* Contacts of which one body has too many are none. */
template <typename T> static void join(const Job<T> &job)
{
	const Rests<T> rests(job);
	Load<T> *loads = reinterpret_cast<Load<T> *>(job.records(6));
	const int32_t first = job.domain[2];
	if (rests.status[STATUS_FIRST] != first)
		return;
	job.pool.run(rests.status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		for (int32_t k = from; k < to; k++) {
			const int32_t s = rests.touching[k].slot;
			Load<T> load = rests.push(s);
			rests.each(s, [&](Resting<T> &rest) {
				if (rests.moves(rest.other()) && rests.touching[rest.other()].count < 0)
					rest.points = 0;
				load.points += rest.points;
			});
			loads[LOADS_WIDTH * s + (first & 1)] = load;
		}
	});
}

/* One iteration of one body. True if another is wanted. */
template <typename T> static bool iterate_one(const Rests<T> &rests, Load<T> *loads, int32_t s, int32_t number)
{
	const int32_t now = number & 1, done = number - rests.status[STATUS_FIRST];
	const T beta = static_cast<T>(done) / static_cast<T>(done + 3);
	const Slot<T> &slot = rests.slots[s];
	const Load<T> load = loads[LOADS_WIDTH * s + now];
	Load<T> next = rests.push(s);
	bool wanted = false;
	next.points = load.points;
	rests.each(s, [&](Resting<T> &rest) {
		const bool moves = rests.moves(rest.other());
		const Vec<T> n = rest.n();
		for (int32_t i = 0; i < rest.count(); i++) {
			auto &point = rest.at[i];
			T along = load.along(n, point.arm),
			  gives = load.points * (slot.mass[MASS_INVERSE] + slot.mass[MASS_INVERSE_INERTIA] * (point.arm * point.arm));
			if (moves) {
				const Slot<T> &other = rests.slots[rest.other()];
				const Load<T> &other_load = loads[LOADS_WIDTH * rest.other() + now];
				along -= other_load.along(n, point.other_arm);
				gives += other_load.points * (other.mass[MASS_INVERSE] + other.mass[MASS_INVERSE_INERTIA] * (point.other_arm * point.other_arm));
			}
			const T rate = point.rate + along, force = larger(rest.start[i] - rate / gives, T(0));
			wanted |= (force > 0 ? std::abs(rate) : -rate) > rest.tolerance;
			rest.start[i] = force + beta * (force - point.force);
			point.force = force;
			next.add(rest.start[i], n, point.arm, slot);
		}
	});
	loads[LOADS_WIDTH * s + 1 - now] = next;
	return wanted;
}

template <typename T> static void iterate(const Job<T> &job)
{
	const Rests<T> rests(job);
	Load<T> *loads = reinterpret_cast<Load<T> *>(job.records(6));
	const int32_t number = job.domain[2];
	if (rests.status[STATUS_WANTED] != number)
		return;
	job.pool.run(rests.status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		bool wanted = false;
		for (int32_t k = from; k < to; k++)
			wanted |= iterate_one(rests, loads, rests.touching[k].slot, number);
		if (wanted && number - rests.status[STATUS_FIRST] + 1 < CONTACT_ITERATIONS)
			__atomic_store_n(&rests.status[STATUS_WANTED], number + 1, __ATOMIC_RELAXED);
	});
}

template <typename T> static void apply(const Job<T> &job)
{
	const Rests<T> rests(job);
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	int32_t *need = job.list(9);
	if (rests.status[STATUS_HANDED] != job.domain[3] || iterations_are_wanted(rests.status))
		return;
	rests.status[STATUS_BORNE] = 1;
	const ReachKeeper<T> keeper(slots, job.records(6), rests.status, job.list(7), job.list(8), job.domain[2], job.texels(0));
	const bool impulses = rests.status[STATUS_PASS] == PASS_IMPULSES;
	job.pool.run(rests.status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		for (int32_t k = from; k < to; k++) {
			const int32_t s = rests.touching[k].slot;
			Load<T> sum{};
			rests.each(s, [&](const Resting<T> &rest) {
				for (int32_t i = 0; i < rest.count(); i++)
					sum.add(rest.at[i].force, rest.n(), rest.at[i].arm, slots[s]);
			});
			const T x = sum.x / rests.length, y = sum.y / rests.length, torque = sum.torque / rests.length;
			if (impulses) {
				slots[s].place[LINEAR_VX] += x;
				slots[s].place[LINEAR_VY] += y;
				slots[s].turn[TURN_VELOCITY] += torque;
			} else {
				slots[s].push[PUSH_X] += x / rests.length;
				slots[s].push[PUSH_Y] += y / rests.length;
				slots[s].push[PUSH_TORQUE] += torque / rests.length;
			}
			if (keeper.pushed(s)) /* lists that are made anew for this step, without the forces, have to be long enough */
				need[s] = as_bits(static_cast<float>(keeper.way_of(slots[s])));
		}
	});
}

/* After a step the pushes are as they were; before one that begins again the velocities, too. */
template <typename T> static void release(const Job<T> &job)
{
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(1));
	int32_t *status = job.list(2);
	const Touching *touching = reinterpret_cast<const Touching *>(job.list(3));
	const Kept<T> *kept = reinterpret_cast<const Kept<T> *>(job.records(4));
	const bool again = job.domain[3];
	if (!status[STATUS_BORNE] || (status[STATUS_PASS] > 0) != again)
		return;
	const ReachKeeper<T> keeper(slots, job.records(5), status, job.list(6), job.list(7), job.domain[2], job.texels(0));
	job.pool.run(status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		for (int32_t k = from; k < to; k++) {
			const int32_t s = touching[k].slot;
			kept[s].restore(slots[s], again);
			keeper.pushed(s);
		}
	});
}

extern const Stage contacts_nesterov;
const Stage contacts_nesterov{"contacts", "nesterov",
	{{STAGE_CONTACTS_BEGIN, begin<float>, begin<double>}, {STAGE_CONTACTS_FIND, find<float>, find<double>},
		{STAGE_CONTACTS_JOIN, join<float>, join<double>}, {STAGE_CONTACTS_ITERATE, iterate<float>, iterate<double>},
		{STAGE_CONTACTS_APPLY, apply<float>, apply<double>}, {STAGE_CONTACTS_RELEASE, release<float>, release<double>}},
	nullptr, nullptr};

}
