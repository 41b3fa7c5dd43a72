/* Steps in batches: the host hands a batch to the device and reads the clock after it, not after each step. */
#include <math.h>
#include <time.h>

#include "layout.h"
#include "status.h"
#include "world.h"

#define MOST_BATCH 256        /* steps handed over without waiting */
#define MOST_LEG (1u << 22)   /* steps that the clock counts at once: its floats stay exact */
#define BATCH_SECONDS 0.1     /* and no more than about this long: a caller wants to hear of progress */
#define FOR_EVER 1.2676506e30 /* s: 2^100, more than any number of steps takes */

typedef float clock_texels[4 * CLOCK_WIDTH];

static float *texel(float *clock, int which)
{
	return clock + 4 * which;
}

/* Of what is kept as two floats. */
static double sum_at(float *clock, int which, int high, int low)
{
	return (double)texel(clock, which)[high] + (double)texel(clock, which)[low];
}

static carom_status start_clock(carom_world *world, carom_error *error)
{
	clock_texels clock = {0};
	texel(clock, CLOCK_HIT)[HIT_TIME] = NO_HIT;
	texel(clock, CLOCK_STEP)[STEP_STALLED] = world->stalled;
	texel(clock, CLOCK_TIME)[TIME_REMAINING] = world->remaining[0];
	texel(clock, CLOCK_TIME)[TIME_REMAINING_LOW] = world->remaining[1];
	return world->device->kind->upload(world->device, world->textures[ROLE_CLOCK].front, 1, clock, error);
}

static void describe_party(const carom_world *world, int index, char *text, size_t size)
{
	const carom_body *body = index >= 0 && (size_t)index < world->body_count ? &carom_world_bodies(world)[index] : NULL;
	if (!body)
		snprintf(text, size, "a wall");
	else if (body->name)
		snprintf(text, size, "body %d ('%.64s')", index, (const char *)world->names.items + body->name - 1);
	else
		snprintf(text, size, "body %d", index);
}

static carom_status stalled(const carom_world *world, float *clock, carom_error *error)
{
	char a[128], b[128];
	describe_party(world, (int)texel(clock, CLOCK_HIT)[HIT_ROW], a, sizeof a);
	describe_party(world, (int)texel(clock, CLOCK_HIT)[HIT_COLUMN], b, sizeof b);
	return carom_fail(error, CAROM_STALLED,
		"simulated time stands still at %.9g s: %.0f hits in a row took no time, the last of %s with %s; bodies that come to rest on each other, "
		"with restitution below 1 or squeezed together, hit without end, and the step %s resolves each of these hits",
		world->time, (double)texel(clock, CLOCK_STEP)[STEP_STALLED], a, b, world->step->name);
}

/* What the clock says now. */
static carom_status read_clock(carom_world *world, carom_report *report, carom_error *error)
{
	clock_texels clock;
	carom_status status = world->device->kind->download(world->device, world->textures[ROLE_CLOCK].front, 1, clock, error);
	if (status)
		return status;
	report->steps = (uint64_t)texel(clock, CLOCK_COUNTS)[COUNTS_STEPS];
	report->hits = (uint64_t)sum_at(clock, CLOCK_COUNTS, COUNTS_HITS, COUNTS_HITS_LOW);
	report->ruled = (uint64_t)sum_at(clock, CLOCK_RULED, RULED_HITS, RULED_HITS_LOW);
	report->held = (uint64_t)texel(clock, CLOCK_COUNTS)[COUNTS_HELD];
	report->advanced = sum_at(clock, CLOCK_TIME, TIME_ELAPSED, TIME_ELAPSED_LOW);
	world->time = world->begun + report->advanced;
	world->remaining[0] = texel(clock, CLOCK_TIME)[TIME_REMAINING];
	world->remaining[1] = texel(clock, CLOCK_TIME)[TIME_REMAINING_LOW];
	world->stalled = texel(clock, CLOCK_STEP)[STEP_STALLED];
	return texel(clock, CLOCK_STEP)[STEP_ENDED] > 0.0f ? stalled(world, clock, error) : CAROM_OK;
}

static carom_status run_batch(carom_world *world, uint64_t steps, carom_error *error)
{
	carom_status status = world->step->begin ? world->step->begin(world, error) : CAROM_OK;
	if (status)
		return status;
	world->newest = world->newest & PLACE_SLOTS ? PLACE_SLOTS : PLACE_TEXTURES;
	world->events.picks = 0;
	world->contacts_current = false; /* not before: what is not sent the host alone has */
	for (uint64_t i = 0; !status && i < steps; i++)
		status = world->step->run(world, error);
	if (!status)
		status = world->device->kind->flush(world->device, error);
	if (world->def.keep_hits) {
		const carom_status taken = world->step->take_hits(world, status ? NULL : error); /* where something failed, of what was done before */
		status = status ? status : taken;
	}
	return status || !world->step->finish ? status : world->step->finish(world, error);
}

/* Not many more steps than the time that remains takes, by a guess from how it went so far: those after the end are
 * idle, but not free. */
static uint64_t batch_size(const carom_world *world, uint64_t steps_left, const carom_report *report)
{
	double step = report->steps && report->advanced > 0.0 ? report->advanced / (double)report->steps : (double)world->def.time_step;
	double wanted = ceil((double)world->remaining[0] / step);
	uint64_t size = wanted < (double)world->batch ? (uint64_t)wanted : world->batch;
	if (world->def.keep_hits && world->step->keeps_last_hit)
		return 1;
	if (size < 1)
		size = 1;
	return size < steps_left ? size : steps_left;
}

static double seconds_now(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The wall clock decides how many steps a batch has, and nothing else. */
static void adapt_batch(carom_world *world, uint64_t steps, double seconds)
{
	if (seconds > BATCH_SECONDS && world->batch > 1)
		world->batch /= 2;
	else if (steps == world->batch && seconds < 0.25 * BATCH_SECONDS && world->batch < MOST_BATCH)
		world->batch *= 2;
}

static bool is_over(const carom_world *world)
{
	return !(world->remaining[0] >= LEAST_STEP);
}

/* Hands a batch over and counts what came of it: `done` is since the clock was started. What was done before something
 * failed is in the state, and so it counts, too; the step makes its own textures anew, for who knows what is in them. */
static carom_status count_batch(carom_world *world, uint64_t steps, carom_report *done, carom_error *error)
{
	carom_status status = run_batch(world, steps, error);
	if (!status)
		status = read_clock(world, done, error);
	if (status && status != CAROM_STALLED) {
		world->prepared = false;
		read_clock(world, done, NULL);
	}
	return status;
}

static carom_status run_leg(carom_world *world, uint64_t steps, carom_report *report, bool *go_on, carom_error *error)
{
	const carom_report sum = *report;
	carom_report done = {0};
	carom_status status = start_clock(world, error);
	world->begun = world->time;
	while (!status && *go_on && done.steps < steps && !is_over(world)) {
		const double begun = seconds_now();
		const uint64_t batch = batch_size(world, steps - done.steps, &done);
		status = count_batch(world, batch, &done, error);
		adapt_batch(world, batch, seconds_now() - begun);
		report->steps = sum.steps + done.steps;
		report->hits = sum.hits + done.hits;
		report->ruled = sum.ruled + done.ruled;
		report->held = sum.held + done.held;
		report->advanced = sum.advanced + done.advanced;
		if (!status && world->progress)
			*go_on = world->progress(world->progress_context, report);
	}
	return status;
}

/* What the device has made itself is good to go on from, for a while. */
static carom_status get_ready(carom_world *world, carom_error *error)
{
	const bool is_changed = !carom_bodies_are_known(world), is_good = !is_changed && carom_range_holds(world);
	carom_status status = is_good ? CAROM_OK : carom_textures_fetch(world, error);
	if (is_changed)
		world->stalled = 0; /* what stood still did so as it was before */
	if (!status && !is_good)
		status = carom_check_range(world, error);
	return status ? status : carom_textures_update(world, error);
}

/* Of so many that are left; one at least, for the next is good. */
static uint64_t leg_size(const carom_world *world, uint64_t steps_left)
{
	const double good = fmax(world->good_for / (double)world->def.time_step, 1.0);
	const uint64_t size = good < (double)MOST_LEG ? (uint64_t)good : MOST_LEG;
	return size < steps_left ? size : steps_left;
}

static carom_status run_all(carom_world *world, uint64_t steps, carom_report *report, carom_error *error)
{
	carom_report done = {0};
	const double begun = world->time;
	bool go_on = true;
	carom_status status = CAROM_OK;
	world->in_call = true;
	world->hits.used = 0;
	while (!status && go_on && world->body_count > 0 && done.steps < steps && !is_over(world)) {
		const double before = done.advanced;
		status = get_ready(world, error);
		if (!status)
			status = run_leg(world, leg_size(world, steps - done.steps), &done, &go_on, error);
		world->good_for -= done.advanced - before;
	}
	world->in_call = false;
	if (!status && is_over(world) && !isnan(world->target)) { /* but for what floats can't tell */
		world->time = world->target;
		done.advanced = world->time - begun;
	}
	if (report)
		*report = done;
	return status;
}

carom_status carom_check_idle(const carom_world *world, carom_error *error)
{
	if (!world->in_call)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "world: found in the middle of a step; its progress callback may read it, not change it");
}

/* Whatever fails before anything is done has done nothing. */
static void begin_report(carom_report *report)
{
	if (report)
		*report = (carom_report){0};
}

carom_status carom_world_step(carom_world *world, uint64_t steps, carom_report *report, carom_error *error)
{
	begin_report(report);
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	world->target = NAN;
	world->remaining[0] = (float)FOR_EVER;
	world->remaining[1] = 0.0f;
	return run_all(world, steps, report, error);
}

carom_status carom_world_advance_to(carom_world *world, double time, uint64_t most_steps, carom_report *report, carom_error *error)
{
	begin_report(report);
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	const double rest = time - world->time;
	if (!(time < FOR_EVER) || !(time == world->target || rest >= 0.0))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "time: found %g s, must be from the world's %g s to %g s", time, world->time, FOR_EVER);
	if (time != world->target) {
		world->target = time;
		world->remaining[0] = (float)rest;
		world->remaining[1] = (float)(rest - (double)(float)rest);
	}
	return run_all(world, most_steps, report, error);
}

carom_status carom_world_advance(carom_world *world, double seconds, carom_report *report, carom_error *error)
{
	begin_report(report);
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	if (!(seconds >= 0.0 && seconds < FOR_EVER))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "seconds: found %g, must be from 0 to %g", seconds, FOR_EVER);
	world->target = NAN;
	return carom_world_advance_to(world, world->time + seconds, UINT64_MAX, report, error);
}
