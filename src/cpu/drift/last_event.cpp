#include "cpu/hits.hpp"

namespace carom::cpu {

/* Bodies that move on, four side by side as if none of them had been hit; of those that were one by one counts. */
template <typename T> class Drift
{
public:
	explicit Drift(const Job<T> &job)
		: slots(reinterpret_cast<Slot<T> *>(job.records(2))), status(job.list(4)), members(reinterpret_cast<Member *>(job.list(5))),
		  work(reinterpret_cast<const Work<T> *>(job.records(6))), owners(job.list(7)), parents(job.list(8)),
		  spans(reinterpret_cast<Span *>(job.list(9))), wakes(reinterpret_cast<Wake *>(job.list(10))), clock(job.texels(1)),
		  hits(job.records(12), status), mover(job.texels(1).fact(CLOCK_STEP, STEP_LENGTH)), friction(job.texels(13)),
		  damps(job.texels(0).fact(UNIFORMS_RUBS, RUBS_DAMPS) > 0),
		  keeper(slots, job.records(3), status, job.list(10), job.list(11), job.domain[2], job.texels(0))
	{
	}

	void run(int32_t begin, int32_t end, bool commits) const
	{
		int32_t s = begin;
		for (; commits && s + lane_count <= end; s += lane_count)
			move_four(s);
		for (; s < end; s++) {
			if (owners[s] >= 0)
				finish(s, commits);
			else if (commits)
				move(s, Trajectory<T>(slots[s]));
		}
	}

private:
	void move(int32_t s, Trajectory<T> way) const
	{
		Slot<T> &slot = slots[s];
		if (slot.is_static())
			return;
		mover.move(slot, way, T(1));
		if (damps) {
			for (int32_t component : {LINEAR_VX, LINEAR_VY})
				way.place[component] = damped(way.place[component], slot, FRICTION_LINEAR_DAMPING);
			way.velocity = damped(way.velocity, slot, FRICTION_ANGULAR_DAMPING);
		}
		for (int32_t k = 0; k < 4; k++) /* one by one, as they were written: a copy of all would wait until they lie in the cache */
			slot.place[k] = way.place[k];
		slot.turn[TURN_ANGLE] = way.angle;
		slot.turn[TURN_VELOCITY] = way.velocity;
		keeper.keep(s);
	}

	/* Of a body that has a number. */
	void finish(int32_t s, bool commits) const
	{
		const int32_t id = owners[s];
		if (commits) {
			move(s, work[id].trajectory(slots[s]));
			hits.confirm(members[id], clock);
		}
		if (members[id].events > 0)
			wakes[s].changed = CHANGED_IN(status[STATUS_AGE]);
		else /* it has not looked how it goes on */
			wakes[s].next = status[STATUS_AGE];
		members[id].reset();
		owners[s] = -1;
		parents[s] = s;
		spans[s].found = FOUND_NONE;
	}

	/* As `move` from the step's beginning. */
	[[gnu::always_inline]] void move_four(int32_t s) const
	{
		Slot<T> *const four = slots + s;
		Lanes<T> place[lane_count], turn[lane_count], push[lane_count];
		for (int32_t i = 0; i < lane_count; i++) {
			std::memcpy(&place[i], four[i].place, sizeof place[i]);
			std::memcpy(&turn[i], four[i].turn, sizeof turn[i]);
			std::memcpy(&push[i], four[i].push, sizeof push[i]);
		}
		transpose<T>(place), transpose<T>(turn), transpose<T>(push);
		const T length = mover.length, part = 1 / length, half = T(0.5);
		const Lanes<T> ax = (push[PUSH_X] * length) * length, ay = (push[PUSH_Y] * length) * length, b = (push[PUSH_TORQUE] * length) * length;
		Lanes<T> angle = turn[TURN_ANGLE] + (turn[TURN_VELOCITY] * length + half * b);
		wrap<T>(angle);
		const Lanes<T> inverse{four[0].mass[MASS_INVERSE], four[1].mass[MASS_INVERSE], four[2].mass[MASS_INVERSE], four[3].mass[MASS_INVERSE]};
		const auto moves = (inverse > 0) | (place[LINEAR_VX] != 0) | (place[LINEAR_VY] != 0) | (turn[TURN_VELOCITY] != 0);
		const auto becomes = [&moves](Lanes<T> &component, const Lanes<T> &next) { component = moves ? next : component; };
		becomes(place[LINEAR_X], place[LINEAR_X] + (place[LINEAR_VX] * length + half * ax));
		becomes(place[LINEAR_Y], place[LINEAR_Y] + (place[LINEAR_VY] * length + half * ay));
		becomes(place[LINEAR_VX], place[LINEAR_VX] + part * ax);
		becomes(place[LINEAR_VY], place[LINEAR_VY] + part * ay);
		becomes(turn[TURN_ANGLE], angle);
		becomes(turn[TURN_VELOCITY], turn[TURN_VELOCITY] + part * b);
		if (damps)
			damp(four, place, turn);
		decltype(inverse > 0) leave;
		keeper.may_leave(s, place, push, turn[TURN_RADIUS], leave);
		transpose<T>(place), transpose<T>(turn);
		for (int32_t i = 0; i < lane_count; i++) {
			std::memcpy(four[i].place, &place[i], sizeof place[i]);
			std::memcpy(four[i].turn, &turn[i], sizeof turn[i]);
		}
		for (int32_t i = 0; i < lane_count; i++) {
			if (owners[s + i] >= 0)
				finish(s + i, true);
			else if (moves[i] & leave[i])
				keeper.move(s + i);
		}
	}

	/* A velocity of a body as the step ends; what hardly moves stops, before its numbers are too small for some devices. */
	T damped(T velocity, const Slot<T> &slot, int32_t which) const
	{
		const T damping = friction.of(slot.body(), which), slower = velocity / (1 + damping * mover.length);
		return damping > 0 && std::abs(slower) < T(STILL_LEAST) ? T(0) : slower;
	}

	/* Four bodies, that have the components of their velocities side by side. */
	void damp(const Slot<T> *four, Lanes<T> *place, Lanes<T> *turn) const
	{
		for (int32_t i = 0; i < lane_count; i++) {
			for (int32_t component : {LINEAR_VX, LINEAR_VY})
				place[component][i] = damped(place[component][i], four[i], FRICTION_LINEAR_DAMPING);
			turn[TURN_VELOCITY][i] = damped(turn[TURN_VELOCITY][i], four[i], FRICTION_ANGULAR_DAMPING);
		}
	}

	Slot<T> *const slots;
	int32_t *const status;
	Member *const members;
	const Work<T> *const work;
	int32_t *const owners, *const parents;
	Span *const spans;
	Wake *const wakes;
	const Texels<T> clock;
	const Hits<T> hits;
	const Mover<T> mover;
	const Texels<T> friction;
	const bool damps;
	const ReachKeeper<T> keeper;
};

template <typename T> static void drift(const Job<T> &job)
{
	int32_t *status = job.list(4);
	const bool commits = status[STATUS_COMMIT] != 0;
	if (!commits && !status[STATUS_LEFT])
		return;
	const Drift<T> bodies(job);
	job.pool.run(job.domain[0], 1024, [&](int32_t begin, int32_t end) { bodies.run(begin, end, commits); });
	if (commits)
		status[STATUS_PASS] = 0;
}

extern const Stage drift_last_event;
const Stage drift_last_event{"drift", "last_event", {{STAGE_DRIFT, drift<float>, drift<double>}}, nullptr, nullptr};

}
