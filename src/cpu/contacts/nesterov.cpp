/* The forces between bodies that rest on each other: a projected gradient, accelerated as Nesterov did. */
#include "cpu/fours.hpp"
#include "cpu/islands.hpp"
#include "cpu/joints.hpp"
#include "cpu/loose.hpp"
#include "cpu/response.hpp"
#include "cpu/still.hpp"

#include <algorithm>
#include <atomic>
#include <vector>

namespace carom::cpu {

constexpr int32_t chunk = 64;            /* slots */
constexpr int32_t iteration_chunk = 512; /* an iteration is short */

template <typename T> static void begin(const Job<T> &job)
{
	int32_t *status = job.list(2);
	if (status[STATUS_PASS] == 0)
		status[STATUS_TOUCHING] = status[STATUS_BORNE] = 0;
	const T length = whole_length(step_length(job.texels(1), job.texels(0)), job.texels(0));
	if (!(length > 0) || !lists_are_good(status) || status[STATUS_UNDER_WAY])
		return;
	const int32_t bits = as_bits(static_cast<float>(length));
	status[STATUS_ROUSED] = status[STATUS_PASS] == 0 && (status[STATUS_ROUSED] || bits != status[STATUS_SLEPT]);
	status[STATUS_SLEPT] = bits;
	status[STATUS_FIRST] = job.domain[2], status[STATUS_HANDED] = job.domain[3];
	status[STATUS_PASS]++;
}

/* The slots with contacts as they lie in space, so that most of a thread's neighbours are its own. */
static void sort_touching(Touching *touching, int32_t count)
{
	static thread_local std::vector<int32_t> all;
	all.clear();
	for (int32_t k = 0; k < count; k++)
		all.push_back(touching[k].slot);
	std::sort(all.begin(), all.end());
	for (int32_t k = 0; k < count; k++)
		touching[k].slot = all[static_cast<size_t>(k)];
}

/* First those that are awake; then those that they wake. */
template <typename T> static void find(const Job<T> &job)
{
	const T length = step_length(job.texels(2), job.texels(1)), whole = whole_length(length, job.texels(1)), part = part_of_whole(length, whole);
	const Clusters<T> clusters(job, 14, whole);
	Points<T> *points = reinterpret_cast<Points<T> *>(job.records(12));
	const Sleepers<T> sleepers{
		reinterpret_cast<Touching *>(job.list(13)), reinterpret_cast<Kept<T> *>(job.records(16)), job.list(20), clusters.status};
	const Rubs<T> rubs(job.texels(1), job.texels(17));
	Grips<T> *grips = reinterpret_cast<Grips<T> *>(job.records(18));
	const Warm<T> warm(nullptr, job.list(19), rubs.any);
	const int32_t *places = job.list(21);
	const Joints<T> joints(job.records(22), job.list(23));
	Touching *touching = sleepers.touching;
	int32_t *status = clusters.status;
	const bool is_second = job.domain[3];
	if (status[STATUS_FIRST] != job.domain[2] || status[STATUS_PASS] != PASS_IMPULSES)
		return;
	job.pool.run(job.domain[0], 256, [&](int32_t from, int32_t to) {
		static thread_local std::vector<RestingBody> bodies;
		RestFinder<T> finder(clusters, rubs);
		bodies.clear();
		for (int32_t s = from; s < to; s++) {
			if (sleepers.sleeps(s) != is_second || (is_second && !status[STATUS_ROUSED] && !sleepers.is_disturbed(s)))
				continue;
			if (!is_second)
				sleepers.kept[s].keep(clusters.slots[s]);
			sleepers.islands[s] = s;
			bodies.push_back(finder.find(s, sleepers));
			if (joints.has_any()) {
				bodies.back().joined = count_joined(joints, clusters.slots, places, sleepers, s, whole);
				bodies.back().points += bodies.back().joined.all;
			}
		}
		take_fours(bodies, touching, status);
		for (const RestingBody &body : bodies) {
			Touching &own = touching[body.s];
			own.turns = 1;
			if (own.joined > 0)
				write_joined(joints, clusters.slots, places, whole, part, body.s, points + own.first, rubs.any ? grips + own.first : nullptr);
			if (own.count > 0)
				finder.write(body, points + own.first, grips + (rubs.any ? own.first : 0));
			/* what rests on a kinematic body goes by that one's load */
			if (own.count > 0 || warm.has_any(clusters.slots[body.s].body()) || clusters.slots[body.s].is_kinematic())
				touching[fetch_add(&status[STATUS_TOUCHING], 1)].slot = body.s;
		}
	});
	if (is_second)
		sort_touching(touching, status[STATUS_TOUCHING]);
}

/* A bound of what all points do together, each as if it alone gave way by 1. */
template <typename T> [[gnu::noinline]] static T share_of(const Rests<T> &rests, int32_t s)
{
	const T straight = rests.inverse_mass(s), turning = rests.inverse_inertia(s), both = std::sqrt(straight) * std::sqrt(turning);
	Response<T> all;
	rests.each(s, [&](const Points<T> &points, const Grips<T> &grips) {
		const Responses<T> normal(straight, turning, both, points.normal_x, points.normal_y, points.arm);
		if (!rests.rubs) {
			for (int32_t i = 0; i < lane_count; i++)
				normal.add(i, all);
			return;
		}
		const Responses<T> along(straight, turning, both, grips.x(points), grips.y(points), grips.arm);
		for (int32_t i = 0; i < lane_count; i++) {
			normal.add(i, all);
			if (grips.friction[i] > 0)
				along.add(i, all);
		}
	});
	return all.bound();
}

template <typename T> static void join(const Job<T> &job)
{
	Rests<T> rests(job);
	rests.places = job.list(14);
	const Warm<T> warm(job.records(9), job.list(10), rests.rubs);
	const Joints<T> joints(job.records(12), job.list(13));
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	const Sleepers<T> sleepers{rests.touching, reinterpret_cast<Kept<T> *>(job.records(11)), rests.islands.parents, rests.status};
	const int32_t first = job.domain[2];
	if (rests.status[STATUS_FIRST] != first)
		return;
	const Loads<T> loads(job.records(8), rests.status[STATUS_CAPACITY], first);
	job.pool.run(rests.status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		for (int32_t k = from; k < to; k++) {
			const int32_t s = rests.touching[k].slot;
			rests.touching[s].wanted = first;
			if (rests.impulses) {
				if (sleepers.sleeps(s))
					sleepers.wake(slots[s], s);
				rests.touching[s].restless = rests.touching[s].footing = 0;
				take_warm(rests, warm, s);
				unite(rests, s);
			} else {
				warm_joined(rests, joints, s);
				warm_up(rests, warm, s);
			}
			rests.alone(s, share_of(rests, s), loads.alone[s]);
			loads.now[s] = loads.alone[s];
			if (!rests.impulses)
				rests.add_forces(s, loads.now[s]);
		}
	});
}

/* How fast points part, or slide, along a unit vector each. */
template <typename T>
[[gnu::always_inline]] static inline void find_rates(const Lanes<T> &x, const Lanes<T> &y, const Lanes<T> &arm, const Lanes<T> &other_arm,
	const Lanes<T> &load, const Lanes<T> (&others)[lane_count], Lanes<T> &rate)
{
	rate = ((x * load[0] + y * load[1]) + arm * load[2]) - ((x * others[0] + y * others[1]) + other_arm * others[2]);
}

/* What friction does in an iteration, once the points have new forces. Another iteration is wanted where something slides that could be held, or by a force that is not
 * yet what it may be. */
template <typename T, typename Wanted>
static void rub(const Points<T> &points, Grips<T> &grips, const Lanes<T> &load, const Lanes<T> (&others)[lane_count], T beta, int32_t done,
	Wanted &wanted)
{
	const Lanes<T> allowed = grips.friction * points.force,
				   most = done < GRIP_FOLLOW ? allowed : grips.bound + T(GRIP_BLEND) * (allowed - grips.bound);
	const Lanes<T> least = -most;
	Lanes<T> rate;
	find_rates<T>(grips.x(points), grips.y(points), grips.arm, grips.other_arm, load, others, rate);
	const Lanes<T> pushed = grips.start - rate * grips.step;
	const Lanes<T> below = most < pushed ? most : pushed, held = least > below ? least : below, size = magnitude(held);
	const Lanes<T> left = size < most ? rate : allowed - most;
	const Lanes<T> tolerance = (done == 0 ? T(GRIP_BEGUN) : static_cast<T>(1 << done / GRIP_PATIENCE)) * points.tolerance;
	wanted |= magnitude(left) > (size < most ? T(GRIP_CREEP) * tolerance : (T(GRIP_SLIDE) * tolerance) * grips.step);
	grips.bound = most;
	grips.start = held + beta * (held - grips.force);
	grips.force = held;
}

/* One iteration of one body, after so many; `anew`: with other steps than the one before. True if another is wanted. */
template <bool rubs, bool is_loose, typename T>
static bool iterate_one(const Rests<T> &rests, const Joints<T> &joints, const Loads<T> &loads, int32_t s, int32_t done, bool anew)
{
	const Lanes<T> load = loads.now[s], zero{};
	const T beta = static_cast<T>(done) / static_cast<T>(done + 2);
	const T closer = rests.impulses || done == 0 ? T(1) : T(CONTACT_CLOSER);
	Sums<T> next{rests.inverse_mass(s), rests.inverse_inertia(s)};
	int32_t firm = rests.touching[s].firm;
	Loose<T> loose(rests, joints, s, is_loose);
	decltype(load < zero) wanted{};
	rests.each(s, [&](Points<T> &points, Grips<T> &grips) {
		Lanes<T> others[lane_count];
		for (int32_t i = 0; i < lane_count; i++)
			others[i] = loads.now[Partner(points.partner[i]).slot()];
		transpose<T>(others);
		if (anew)
			set_steps(rests, points, grips, s, load[LOAD_SHARE], others[LOAD_SHARE]);
		Lanes<T> rate;
		find_rates<T>(points.normal_x, points.normal_y, points.arm, points.other_arm, load, others, rate);
		rate += points.least;
		Lanes<T> least{}; /* what is firm pulls, too */
		int32_t first = 0;
		for (; first < lane_count && firm > 0; first++, firm--)
			least[first] = -infinite<T>;
		const Lanes<T> pushed = points.start - rate * points.step;
		Lanes<T> force = least > pushed ? least : pushed, left = force > least ? magnitude(rate) : -rate;
		if constexpr (is_loose)
			loose.iterate(points, first, rate, force, left);
		wanted |= left > closer * points.tolerance;
		points.start = force + beta * (force - points.force);
		points.force = force;
		next.add(points, points.start);
		if constexpr (rubs) {
			rub(points, grips, load, others, smaller(beta, T(GRIP_MOMENTUM)), done, wanted);
			next.add(points, grips, grips.start);
		}
	});
	loads.next[s] = loads.alone[s];
	next.add_to(loads.next[s]);
	return wanted[0] | wanted[1] | wanted[2] | wanted[3];
}

/* One iteration of some of the bodies that touch, where their islands want it. */
template <bool rubs, typename T>
static bool iterate_some(const Rests<T> &rests, const Joints<T> &joints, const Loads<T> &loads, int32_t from, int32_t to, int32_t number)
{
	const int32_t done = number - rests.status[STATUS_FIRST];
	const bool aims = joints.has_any() && !rests.impulses, anew = done == 0 || (aims && is_aimed(done - 1));
	bool wanted = false;
	for (int32_t k = from; k < to; k++) {
		const int32_t s = rests.touching[k].slot;
		int32_t *const island_wants = &rests.touching[done == 0 ? settled_root(rests, s) : rests.islands.parents[s]].wanted;
		if (__atomic_load_n(island_wants, __ATOMIC_RELAXED) < number)
			continue;
		const bool is_joined = rests.touching[s].joined > 0;
		const int32_t most = !(rubs && rests.impulses) ? CONTACT_ITERATIONS : is_joined ? JOINT_IMPULSES : GRIP_IMPULSES;
		if (aims && is_aimed(done) && is_joined) {
			aim_joined(rests, joints, loads.now, s);
			loads.alone[s][LOAD_SHARE] = share_of(rests, s); /* with which the next one has its steps */
		}
		const bool is_loose = rests.touching[s].joined > rests.touching[s].firm;
		const bool wants = is_loose ? iterate_one<rubs, true>(rests, joints, loads, s, done, anew)
									: iterate_one<rubs, false>(rests, joints, loads, s, done, anew);
		if (rests.impulses && is_joined && done + 1 == most)
			tire(rests, joints, s, wants);
		if (!wants || done + 1 >= most)
			continue;
		wanted = true;
		if (__atomic_load_n(island_wants, __ATOMIC_RELAXED) == number) /* who stores takes the line from all others */
			__atomic_store_n(island_wants, number + 1, __ATOMIC_RELAXED);
	}
	return wanted;
}

#if defined(__x86_64__)
/* The same in fewer instructions, where the processor has them. */
template <bool rubs>
[[gnu::target("avx2"), gnu::flatten]] static bool iterate_some_avx2(const Rests<float> &rests, const Joints<float> &joints, const Loads<float> &loads,
	int32_t from, int32_t to, int32_t number)
{
	return iterate_some<rubs>(rests, joints, loads, from, to, number);
}

template <bool rubs> static auto best_iteration(float)
{
	return __builtin_cpu_supports("avx2") ? iterate_some_avx2<rubs> : iterate_some<rubs, float>;
}
#endif

template <bool rubs, typename T> static auto best_iteration(T)
{
	return iterate_some<rubs, T>;
}

/* The first iteration that is handed over, and all that are wanted after it: no step waits for more. */
template <typename T> static void iterate(const Job<T> &job)
{
	Rests<T> rests(job);
	rests.places = job.list(9);
	const Joints<T> joints(job.records(10), job.list(11));
	const auto some = rests.rubs ? best_iteration<true>(T()) : best_iteration<false>(T());
	int32_t number = job.domain[2];
	std::atomic<bool> wanted{rests.status[STATUS_FIRST] == number};
	for (; wanted; number++) {
		const Loads<T> loads(job.records(8), rests.status[STATUS_CAPACITY], number);
		wanted = false;
		job.pool.run(rests.status[STATUS_TOUCHING], iteration_chunk, [&](int32_t from, int32_t to) {
			if (some(rests, joints, loads, from, to, number))
				wanted = true;
		});
	}
}

/* Gives a dynamic body what forces on it come to. */
template <typename T> static void bear(const Rests<T> &rests, Slot<T> &slot, int32_t s)
{
	Lanes<T> sum{};
	rests.add_forces(s, sum);
	const Vec<T> ground = rests.ground_of(s);
	const bool is_at_rest = speed(slot, ground) == 0;
	const T x = sum[0] / rests.length, y = sum[1] / rests.length, torque = sum[2] / rests.length;
	if (rests.impulses) {
		slot.place[LINEAR_VX] += x;
		slot.place[LINEAR_VY] += y;
		slot.turn[TURN_VELOCITY] += torque;
		if (is_at_rest && is_slight(rests, s, ground, speed(slot, ground) * rests.length))
			set_still(slot, ground);
	} else {
		slot.push[PUSH_X] += x / rests.length;
		slot.push[PUSH_Y] += y / rests.length;
		slot.push[PUSH_TORQUE] += torque / rests.length;
		find_footing(rests, s, ground);
		if (is_at_rest && is_slight(rests, s, ground, pushed_by(slot) * rests.length * rests.length))
			slot.push[PUSH_X] = slot.push[PUSH_Y] = slot.push[PUSH_TORQUE] = 0;
	}
}

template <typename T> static void apply(const Job<T> &job)
{
	Rests<T> rests(job);
	rests.places = job.list(12);
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	int32_t *need = job.list(11);
	if (rests.status[STATUS_HANDED] != job.domain[3])
		return;
	rests.status[STATUS_BORNE] = 1;
	const ReachKeeper<T> keeper(slots, job.records(8), rests.status, job.list(9), job.list(10), job.domain[2], job.texels(0));
	job.pool.run(rests.status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		for (int32_t k = from; k < to; k++) {
			const int32_t s = rests.touching[k].slot;
			if (slots[s].is_dynamic()) /* what is kinematic is read meanwhile */
				bear(rests, slots[s], s);
			if (keeper.pushed(s)) /* lists that are made anew for this step, without the forces, have to be long enough */
				need[s] = as_bits(static_cast<float>(keeper.way_of(slots[s])));
		}
	});
}

/* After a step the pushes are as they were, and its forces are kept; before one that begins again the velocities, too, are as they were. */
template <typename T> static void release(const Job<T> &job)
{
	Rests<T> rests(job);
	rests.places = job.list(14);
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	Kept<T> *kept = reinterpret_cast<Kept<T> *>(job.records(8));
	const Sleepers<T> sleepers{rests.touching, kept, rests.islands.parents, rests.status};
	const Warm<T> warm(job.records(12), job.list(13), rests.rubs);
	const Joints<T> joints(job.records(15), job.list(16));
	const T length = whole_length(job.texels(1).fact(CLOCK_STEP, STEP_LENGTH), job.texels(0)); /* of the step that is done: the clock has gone on */
	const Wake *wakes = reinterpret_cast<const Wake *>(job.list(10));
	const bool again = job.domain[3];
	if (!rests.status[STATUS_BORNE] || (rests.status[STATUS_PASS] > 0) != again)
		return;
	const ReachKeeper<T> keeper(slots, job.records(9), rests.status, job.list(10), job.list(11), job.domain[2], job.texels(0));
	job.pool.run(rests.status[STATUS_TOUCHING], chunk, [&](int32_t from, int32_t to) {
		for (int32_t k = from; k < to; k++) {
			const int32_t s = rests.touching[k].slot;
			const bool is_borne = is_unpushed(slots[s]), has_event = wakes[s].changed == CHANGED_IN(rests.status[STATUS_AGE]);
			kept[s].restore(slots[s], again);
			if (!again) {
				const Vec<T> ground = rests.ground_of(s);
				settle(rests, slots[s], s, ground, kept, length);
				if (!keep_joined(rests, joints, kept, s, ground, length))
					sleepers.disturb(s);
				if (!keep_forces(rests, kept, s, ground, length, warm) || !is_borne || has_event || !kept[s].stays(slots[s]))
					sleepers.disturb(s);
			}
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
