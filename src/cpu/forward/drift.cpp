#include "cpu/reach.hpp"

namespace carom::cpu {

template <typename T> static void drift(const Job<T> &job)
{
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	int32_t *status = job.list(4), *owners = job.list(7), *parents = job.list(8);
	Span *spans = reinterpret_cast<Span *>(job.list(9));
	Wake *wakes = reinterpret_cast<Wake *>(job.list(10));
	Member *members = reinterpret_cast<Member *>(job.list(5));
	const Work<T> *work = reinterpret_cast<const Work<T> *>(job.records(6));
	const bool commits = status[STATUS_COMMIT] != 0;
	const T length = job.texels(1).fact(CLOCK_STEP, STEP_LENGTH);
	const ReachKeeper<T> keeper(slots, job.records(3), status, job.list(10), job.list(11), job.domain[2], job.texels(0));
	if (!commits && !status[STATUS_LEFT])
		return;
	const Mover<T> mover{length};
	job.pool.run(job.domain[0], 1024, [=](int32_t begin, int32_t end) {
		for (int32_t s = begin; s < end; s++) {
			const int32_t id = owners[s];
			Slot<T> &slot = slots[s];
			if (commits && !slot.is_static()) {
				Trajectory<T> way = id >= 0 ? work[id].trajectory(slot) : Trajectory<T>(slot);
				mover.move(slot, way, T(1));
				std::memcpy(slot.place, way.place, sizeof way.place);
				slot.turn[TURN_ANGLE] = way.angle;
				slot.turn[TURN_VELOCITY] = way.velocity;
				keeper.keep(s);
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
	if (commits)
		status[STATUS_PASS] = 0;
}

extern const Stage forward_drift;
const Stage forward_drift{"forward", "drift", {{STAGE_DRIFT, drift<float>, drift<double>}}, nullptr, nullptr};

}
