#include "cpu/reach.hpp"

namespace carom::cpu {

/* Whether a body might get out of its box in the next step. */
template <typename T> static bool may_leave(const Slot<T> &slot, const Box<T> &box, T step, T common)
{
	const T x = slot.place[LINEAR_X], y = slot.place[LINEAR_Y];
	const T speed = std::sqrt(slot.place[LINEAR_VX] * slot.place[LINEAR_VX] + slot.place[LINEAR_VY] * slot.place[LINEAR_VY])
		+ (std::abs(slot.push[PUSH_X]) + std::abs(slot.push[PUSH_Y])) * step;
	const T way = std::max(speed_margin * speed * step, common) + slot.radius();
	return (x - way < box.min_x) | (y - way < box.min_y) | (x + way > box.max_x) | (y + way > box.max_y);
}

/* It gets another reach, and new neighbours before the next step. Few do: apart, it is not in the way of the others. */
template <typename T> [[gnu::noinline]] static void move_reach(const Job<T> &job, int32_t s)
{
	const Slot<T> *slots = reinterpret_cast<const Slot<T> *>(job.records(2));
	Box<T> *boxes = reinterpret_cast<Box<T> *>(job.records(3));
	Wake *wakes = reinterpret_cast<Wake *>(job.list(10));
	int32_t *status = job.list(4), *movers = job.list(11);
	const int32_t k = fetch_add(&status[STATUS_MOVERS], 1);
	if (k >= job.domain[2]) {
		__atomic_store_n(&status[STATUS_STALE], 1, __ATOMIC_RELAXED);
		return;
	}
	movers[k] = s;
	boxes[s] = reach_about(slots[s], T(0), ReachRules<T>{T(as_float(status[STATUS_WINDOW])), T(as_float(status[STATUS_PACE]))});
	wakes[s].changed = wakes[s].next = status[STATUS_AGE];
}

template <typename T> static void drift(const Job<T> &job)
{
	const Texels<T> uniforms = job.texels(0);
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	const Box<T> *boxes = reinterpret_cast<const Box<T> *>(job.records(3));
	int32_t *status = job.list(4), *owners = job.list(7), *parents = job.list(8);
	Span *spans = reinterpret_cast<Span *>(job.list(9));
	Wake *wakes = reinterpret_cast<Wake *>(job.list(10));
	Member *members = reinterpret_cast<Member *>(job.list(5));
	const Work<T> *work = reinterpret_cast<const Work<T> *>(job.records(6));
	const bool commits = status[STATUS_COMMIT] != 0;
	const T length = job.texels(1).fact(CLOCK_STEP, STEP_LENGTH), step = uniforms.fact(UNIFORMS_WORLD, WORLD_TIME_STEP);
	const T common = drift_part * T(as_float(status[STATUS_PACE])) * (step / T(as_float(status[STATUS_WINDOW])));
	if (!commits && !status[STATUS_LEFT])
		return;
	const Mover<T> mover{length};
	job.pool.run(job.domain[0], 1024, [=, &job](int32_t begin, int32_t end) {
		for (int32_t s = begin; s < end; s++) {
			const int32_t id = owners[s];
			Slot<T> &slot = slots[s];
			if (commits && !slot.is_static()) {
				Trajectory<T> way = id >= 0 ? work[id].trajectory(slot) : Trajectory<T>(slot);
				mover.move(slot, way, T(1));
				for (int32_t k = 0; k < 4; k++) /* one by one, as they were computed: to copy them at once would wait for all */
					slot.place[k] = way.place[k];
				slot.turn[TURN_ANGLE] = way.angle;
				slot.turn[TURN_VELOCITY] = way.velocity;
				if (may_leave(slot, boxes[s], step, common))
					move_reach(job, s);
			}
			if (id >= 0) {
				/* one that no event changed has not looked how it goes on */
				(members[id].events > 0 ? wakes[s].changed : wakes[s].next) = status[STATUS_AGE];
				members[id].reset();
				owners[s] = -1;
				parents[s] = s;
				spans[s].found = FOUND_NONE;
			}
		}
	});
}

extern const Stage forward_drift;
const Stage forward_drift{"forward", "drift", {{STAGE_DRIFT, drift<float>, drift<double>}}, nullptr, nullptr};

}
