#include "cpu/body.hpp"

namespace carom::cpu {

template <typename T> struct First {
	T time, row, column, done;
};

template <typename T> static First<T> first_pair(const Texels<T> &reduced, int32_t count)
{
	if (count <= 1)
		return {NO_HIT, 0, 0, 1};
	return {reduced.fact(0, REDUCED_HIT), reduced.fact(0, REDUCED_ROW), reduced.fact(0, REDUCED_COLUMN), reduced.fact(0, REDUCED_DONE)};
}

template <typename T> static First<T> first_hit(const Job<T> &job, int32_t count, int32_t groups)
{
	const Texels<T> walls = job.texels(1);
	First<T> first = first_pair(job.texels(0), count);
	for (int32_t group = 0; group < groups; group++) {
		if (walls.of(group, WALLS_HIT) < first.time)
			first = {walls.of(group, WALLS_HIT), walls.of(group, WALLS_BODY), -1 - walls.of(group, WALLS_WALL), walls.of(group, WALLS_DONE)};
	}
	return first;
}

/* A step without a length: nothing happens, and time stands. Who was hit last stays, to be named when time has stalled. */
template <typename T> static void stand(const Texels<T> &clock, const Texels<T> &next)
{
	next.set(CLOCK_HIT, 0, NO_HIT, clock.fact(CLOCK_HIT, HIT_ROW), clock.fact(CLOCK_HIT, HIT_COLUMN), 1);
	for (int32_t channel = 0; channel < 4; channel++) {
		next.fact(CLOCK_STEP, channel) = clock.fact(CLOCK_STEP, channel);
		next.fact(CLOCK_TIME, channel) = clock.fact(CLOCK_TIME, channel);
		next.fact(CLOCK_COUNTS, channel) = clock.fact(CLOCK_COUNTS, channel);
		next.fact(CLOCK_RULED, channel) = clock.fact(CLOCK_RULED, channel);
	}
	next.fact(CLOCK_STEP, STEP_LENGTH) = 0;
	next.fact(CLOCK_STEP, STEP_ADVANCED) = 0;
}

/* Time gets on, and whether it got on enough is counted. */
template <typename T> static void get_on(const Texels<T> &clock, const Texels<T> &next, T length, T advanced, bool stalls, T limit)
{
	T stalled = stalls ? clock.fact(CLOCK_STEP, STEP_STALLED) + 1 : 0;
	next.fact(CLOCK_STEP, STEP_LENGTH) = length;
	next.fact(CLOCK_STEP, STEP_ADVANCED) = advanced;
	next.fact(CLOCK_STEP, STEP_STALLED) = stalled;
	next.fact(CLOCK_STEP, STEP_ENDED) = stalled > limit ? 1 : 0;
	add_time(clock, next, advanced);
}

/* The first hit of all, and the clock after the step [2.2]. */
template <typename T> static void earliest(const Job<T> &job)
{
	const Texels<T> uniforms = job.texels(2), clock = job.texels(3), next = job.texels(4);
	const int32_t count = job.domain[2], groups = job.domain[3];
	const T length = step_length(clock, uniforms);
	stand(clock, next);
	if (!(length > 0))
		return;
	First<T> hit = first_hit(job, count, groups);
	bool in_step = hit.time <= 1;
	T advanced = in_step ? hit.time * length : length;
	bool stalls = in_step && advanced < STALL_LENGTH * uniforms.fact(UNIFORMS_WORLD, WORLD_TIME_STEP);
	next.set(CLOCK_HIT, 0, hit.time, hit.row, hit.column, hit.done);
	get_on(clock, next, length, advanced, stalls, static_cast<T>(STALL_LIMIT + STALL_LIMIT_BODY * count));
	next.fact(CLOCK_COUNTS, COUNTS_STEPS) += 1;
	if (in_step && hit.done != 0)
		next.fact(CLOCK_COUNTS, COUNTS_HITS) += 1;
}

extern const Stage first_earliest;
const Stage first_earliest{"first", "earliest", {{STAGE_FIRST, earliest<float>, earliest<double>}}, nullptr, nullptr};

}
