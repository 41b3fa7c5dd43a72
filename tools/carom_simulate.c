/* The steps of `carom run`.
 *
 * What is computed must not depend on how fast this machine is: the clock decides when the bar is drawn and how soon an
 * interruption is seen, nothing else. A step is cut short only where a frame or the end asks for it.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <math.h>

/* The library calls it now and then. */
static bool go_on(void *context, const carom_report *so_far)
{
	struct run *run = context;
	const struct run_options *options = run->options;
	uint64_t steps = run->total.steps + so_far->steps;
	double simulated = run->total.advanced + so_far->advanced;
	bool counted = options->steps != NO_STEPS;
	show_progress(&run->progress, counted ? (double)steps / (double)options->steps : simulated / options->time, steps, simulated);
	run->interrupted = is_interrupted();
	return !run->interrupted;
}

/* Adds what a call did, also where it failed in the middle. */
static carom_status account(struct run *run, const carom_report *done, carom_status status, carom_error *error)
{
	static const carom_report nothing = {0};
	run->total.steps += done->steps;
	run->total.hits += done->hits;
	run->total.ruled += done->ruled;
	run->total.held += done->held;
	run->total.advanced += done->advanced;
	go_on(run, &nothing);
	if (run->hits && done->steps > 0) { /* also of a call that failed in the end */
		const carom_status written = write_hits(run, status == CAROM_OK ? error : NULL);
		status = status == CAROM_OK ? written : status;
	}
	if (status == CAROM_OK && run->stats && done->steps > 0)
		status = write_row(run, done, error);
	return status;
}

static carom_status step(struct run *run, uint64_t steps, carom_error *error)
{
	carom_report done = {0};
	carom_status status = carom_world_step(run->world, steps, &done, error);
	return account(run, &done, status, error);
}

/* Steps that one call makes at most: a row of --stats needs each by itself, and the hits of a call are in memory until they are written. */
static uint64_t most_at_once(const struct run *run)
{
	return run->stats ? 1 : run->hits ? 256 : UINT64_MAX;
}

/* --time: ends at `until` exactly. */
static carom_status run_until(struct run *run, double until, carom_error *error)
{
	carom_status status = CAROM_OK;
	while (status == CAROM_OK && !run->interrupted && carom_world_time(run->world) < until) {
		carom_report done = {0};
		status = carom_world_advance_to(run->world, until, most_at_once(run), &done, error);
		status = account(run, &done, status, error);
		if (done.steps == 0) /* a world without bodies */
			break;
	}
	return status;
}

static carom_status run_time(struct run *run, double end, carom_error *error)
{
	carom_status status = CAROM_OK;
	while (status == CAROM_OK && !run->interrupted && next_frame(run) <= end) {
		status = run_until(run, next_frame(run), error);
		if (status == CAROM_OK && !run->interrupted)
			status = write_frame(run, error);
	}
	return status == CAROM_OK && !run->interrupted ? run_until(run, end, error) : status;
}

/* Time steps are floats, and many of them not quite what was meant. */
static bool is_reached(const struct run *run, double until)
{
	const double length = (double)carom_world_get_def(run->world)->time_step;
	return until - carom_world_time(run->world) <= fmin(length, until) * 1e-6;
}

/* Steps that surely end before `until`; 0 if the next one may not. */
static uint64_t whole_steps(const struct run *run, double until)
{
	double length = (double)carom_world_get_def(run->world)->time_step;
	double count = floor((until - carom_world_time(run->world)) / length);
	/* The last one is taken alone: whether it fits is then seen from the time itself, not from a quotient. */
	return count < 1 ? 0 : count < 3 ? 1 : count < 1e18 ? (uint64_t)count - 1 : NO_STEPS;
}

/* How many steps to take at once: up to the row or the frame that is next. */
static uint64_t steps_at_once(const struct run *run, uint64_t left)
{
	uint64_t most = most_at_once(run) < left ? most_at_once(run) : left;
	uint64_t before_frame = whole_steps(run, next_frame(run));
	if (before_frame < most)
		most = before_frame > 0 ? before_frame : 1;
	return most;
}

/* --steps: no step is cut short, so a frame shows the end of the step that its time falls into. */
static carom_status run_steps(struct run *run, uint64_t steps, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (;;) {
		uint64_t before = run->total.steps;
		while (status == CAROM_OK && is_reached(run, next_frame(run)))
			status = write_frame(run, error);
		if (status != CAROM_OK || run->interrupted || before >= steps)
			return status;
		status = step(run, steps_at_once(run, steps - before), error);
		if (run->total.steps == before) /* a world without bodies */
			return status;
	}
}

/* The frames that are drawn are written, however the simulation ended. */
static carom_status finish_frames(struct run *run, carom_status status, carom_error *error)
{
	carom_error of_film;
	if (!run->film)
		return status;
	carom_status finished = film_finish(run->film, &run->frames_done, &of_film);
	if (status != CAROM_OK || finished == CAROM_OK)
		return status;
	*error = of_film;
	return finished;
}

carom_status simulate(struct run *run, carom_error *error)
{
	double begun = wall_seconds();
	carom_status status;
	catch_interruptions();
	carom_world_set_progress(run->world, go_on, run);
	begin_progress(&run->progress, run->options->common.quiet);
	status = run->options->steps != NO_STEPS ? run_steps(run, run->options->steps, error) : run_time(run, run->options->time, error);
	status = finish_frames(run, status, error);
	end_progress(&run->progress);
	carom_world_set_progress(run->world, NULL, NULL);
	run->seconds = wall_seconds() - begun;
	return status;
}
