/* The steps of `carom run`, in chunks.
 *
 * The size of a chunk follows the clock, and what is computed must not: a step is cut short only where a frame or the end
 * asks for it, never at the end of a chunk.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <math.h>
#include <signal.h>
#include <string.h>

#define CHUNK_SECONDS 0.2
#define MAX_CHUNK 1000000u

/* Set by the handler, which can reach nothing but a global. */
static volatile sig_atomic_t interrupted;

static void on_signal(int number)
{
	(void)number;
	interrupted = 1;
}

/* The first signal ends the run after the chunk, the second the process. What the caller ignores stays ignored. */
static void catch_signal(int number)
{
	struct sigaction action, before;
	memset(&action, 0, sizeof action);
	action.sa_handler = on_signal;
	action.sa_flags = (int)SA_RESETHAND | SA_RESTART;
	if (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
		sigaction(number, &action, NULL);
}

static void adapt_chunk(struct run *run, uint64_t steps, double seconds)
{
	double wanted = seconds > 0 ? (double)steps * CHUNK_SECONDS / seconds : MAX_CHUNK;
	double grown = (double)run->chunk * 4; /* the first steps of a device are no measure */
	if (wanted > grown)
		wanted = grown;
	run->chunk = wanted < 1 ? 1 : wanted > MAX_CHUNK ? MAX_CHUNK : (uint64_t)wanted;
}

/* Adds what a call did, also where it failed in the middle. */
static carom_status account(struct run *run, const carom_report *done, double begun, carom_status status, carom_error *error)
{
	double seconds = wall_seconds() - begun;
	run->total.steps += done->steps;
	run->total.hits += done->hits;
	run->total.advanced += done->advanced;
	if (done->steps > 0)
		adapt_chunk(run, done->steps, seconds);
	if (run->stats && status == CAROM_OK)
		status = write_row(run, done, error);
	return status;
}

/* Whole steps that surely end before `until`; 0 if the next one has to be cut short. */
static uint64_t whole_steps(const struct run *run, double until)
{
	double step = (double)carom_world_get_def(run->world)->time_step;
	double count = floor((until - carom_world_time(run->world)) / step);
	/* The last one is run alone: whether it fits is then seen from the time itself, not from a quotient. */
	return count < 1 ? 0 : count > 2 ? (uint64_t)fmin(count - 1, MAX_CHUNK) : 1;
}

static uint64_t chunk_of(const struct run *run, uint64_t most)
{
	uint64_t chunk = run->stats ? 1 : run->chunk; /* a row for each step */
	return chunk < most ? chunk : most;
}

static carom_status do_steps(struct run *run, uint64_t steps, carom_error *error)
{
	carom_report done = {0};
	double begun = wall_seconds();
	carom_status status = carom_world_step(run->world, steps, &done, error);
	return account(run, &done, begun, status, error);
}

static carom_status do_rest(struct run *run, double seconds, carom_error *error)
{
	carom_report done = {0};
	double begun = wall_seconds();
	carom_status status = carom_world_advance(run->world, seconds, &done, error);
	return account(run, &done, begun, status, error);
}

/* So little is left only where the time step, a float, is not quite what was meant; a step for it would be waste. */
static bool is_reached(const struct run *run, double until)
{
	double step = (double)carom_world_get_def(run->world)->time_step;
	return until - carom_world_time(run->world) <= step * 1e-6;
}

static bool look_up(struct run *run, double done)
{
	show_progress(&run->progress, done, run->total.steps, run->total.advanced);
	run->interrupted = interrupted;
	return !interrupted;
}

/* --time: ends at `until` exactly. */
static carom_status run_until(struct run *run, double until, double end, carom_error *error)
{
	carom_status status = CAROM_OK;
	bool reached = is_reached(run, until);
	while (status == CAROM_OK && !reached && look_up(run, carom_world_time(run->world) / end)) {
		uint64_t steps = whole_steps(run, until);
		if (steps > 0) {
			status = do_steps(run, chunk_of(run, steps), error);
			reached = is_reached(run, until);
		} else {
			status = do_rest(run, until - carom_world_time(run->world), error);
			reached = true;
		}
	}
	return status;
}

static carom_status run_time(struct run *run, double end, carom_error *error)
{
	carom_status status = CAROM_OK;
	while (status == CAROM_OK && !run->interrupted && next_frame(run) <= end) {
		status = run_until(run, next_frame(run), end, error);
		if (status == CAROM_OK && !run->interrupted)
			status = write_frame(run, error);
	}
	return status == CAROM_OK && !run->interrupted ? run_until(run, end, end, error) : status;
}

/* --steps: no step is cut short, so a frame shows the end of the step that its time falls into. */
static carom_status run_steps(struct run *run, uint64_t steps, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (;;) {
		while (status == CAROM_OK && is_reached(run, next_frame(run)))
			status = write_frame(run, error);
		if (status != CAROM_OK || run->total.steps >= steps || !look_up(run, (double)run->total.steps / (double)steps))
			return status;
		uint64_t most = steps - run->total.steps, before_frame = MAX_CHUNK;
		if (run->options->frames)
			before_frame = whole_steps(run, next_frame(run));
		if (before_frame < most)
			most = before_frame > 0 ? before_frame : 1;
		status = do_steps(run, chunk_of(run, most), error);
	}
}

carom_status simulate(struct run *run, carom_error *error)
{
	double begun = wall_seconds();
	carom_status status;
	interrupted = 0;
	catch_signal(SIGINT);
	catch_signal(SIGTERM);
	run->chunk = 1;
	begin_progress(&run->progress, run->options->common.quiet);
	status =
		run->options->steps != NO_STEPS ? run_steps(run, run->options->steps, error) : run_time(run, run->options->time, error);
	end_progress(&run->progress);
	run->seconds = wall_seconds() - begun;
	return status;
}
