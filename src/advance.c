/* Steps in batches: the host hands a batch to the device and reads the clock after it, not after each step. */
#include <math.h>

#include "layout.h"
#include "status.h"
#include "world.h"

#define BATCH 64                /* steps handed over without waiting */
#define FOR_EVER 1.2676506e30   /* s: 2^100, more than any number of steps takes */

typedef float clock_texels[4 * CLOCK_WIDTH];

static float *texel(float *clock, int which)
{
	return clock + 4 * which;
}

/* A duration as the clock holds it: the sum of two floats. */
static carom_status start_clock(carom_world *world, double seconds, carom_error *error)
{
	clock_texels clock = {0};
	texel(clock, CLOCK_HIT)[HIT_TIME] = NO_HIT;
	texel(clock, CLOCK_STEP)[STEP_STALLED] = world->stalled;
	texel(clock, CLOCK_TIME)[TIME_REMAINING] = (float)seconds;
	texel(clock, CLOCK_TIME)[TIME_REMAINING_LOW] = (float)(seconds - (double)(float)seconds);
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
		"simulated time stands still at %.9g s: %.0f hits in a row took no time, the last of %s with %s; bodies that come to rest on each other, with "
		"restitution below 1 or squeezed together, hit without end, and the step %s resolves each of these hits",
		world->time, (double)texel(clock, CLOCK_STEP)[STEP_STALLED], a, b, world->step->name);
}

/* What the clock says now, added to the report. */
static carom_status read_clock(carom_world *world, float *clock, double start, carom_report *report, carom_error *error)
{
	carom_status status = world->device->kind->download(world->device, world->textures[ROLE_CLOCK].front, 1, clock, error);
	if (status)
		return status;
	report->steps = (uint64_t)texel(clock, CLOCK_COUNTS)[COUNTS_STEPS];
	report->hits = (uint64_t)texel(clock, CLOCK_COUNTS)[COUNTS_HITS];
	report->advanced = (double)texel(clock, CLOCK_TIME)[TIME_ELAPSED] + (double)texel(clock, CLOCK_TIME)[TIME_ELAPSED_LOW];
	world->time = start + report->advanced;
	world->stalled = texel(clock, CLOCK_STEP)[STEP_STALLED];
	return texel(clock, CLOCK_STEP)[STEP_ENDED] > 0.0f ? stalled(world, clock, error) : CAROM_OK;
}

static carom_status run_batch(carom_world *world, uint64_t steps, carom_error *error)
{
	carom_status status = CAROM_OK;
	world->host_current = false;
	for (uint64_t i = 0; !status && i < steps; i++)
		status = world->step->run(world, error);
	return status ? status : world->device->kind->flush(world->device, error);
}

/* A guess, from how it went so far, of how many steps the rest will take: those after the end are idle, but not free. */
static uint64_t batch_size(const carom_world *world, double rest, uint64_t steps_left, const carom_report *report)
{
	double step = report->steps && report->advanced > 0.0 ? report->advanced / (double)report->steps : (double)world->def.time_step;
	double wanted = ceil(rest / step);
	uint64_t size = wanted < BATCH ? (uint64_t)wanted : BATCH;
	if (size < 1)
		size = 1;
	return size < steps_left ? size : steps_left;
}

/* The clock counts in floats, so a leg is short enough for whole numbers to stay exact. */
static carom_status run_leg(carom_world *world, double seconds, uint64_t steps, carom_report *report, bool *go_on, carom_error *error)
{
	clock_texels clock;
	double start = world->time;
	carom_report done = {0, 0, 0.0}, sum = *report;
	carom_status status = start_clock(world, seconds, error);
	while (!status && *go_on && done.steps < steps && done.advanced < seconds) {
		uint64_t before = done.steps;
		status = run_batch(world, batch_size(world, seconds - done.advanced, steps - done.steps, &done), error);
		if (!status)
			status = read_clock(world, clock, start, &done, error);
		report->steps = sum.steps + done.steps;
		report->hits = sum.hits + done.hits;
		report->advanced = sum.advanced + done.advanced;
		if (!status && done.steps == before)
			break; /* what was left of the time rounds to nothing */
		if (!status && world->progress)
			*go_on = world->progress(world->progress_context, report);
	}
	return status;
}

static carom_status run_all(carom_world *world, double seconds, uint64_t steps, carom_report *report, carom_error *error)
{
	const uint64_t leg = 1u << 22;
	carom_report done = {0, 0, 0.0};
	bool go_on = true;
	carom_status status = CAROM_OK;
	if (world->body_count > 0 && steps > 0 && seconds > 0.0)
		status = carom_textures_update(world, error);
	while (!status && go_on && world->body_count > 0 && done.steps < steps && done.advanced < seconds) {
		uint64_t before = done.steps;
		status = run_leg(world, seconds - done.advanced, steps - done.steps < leg ? steps - done.steps : leg, &done, &go_on, error);
		if (done.steps == before)
			break;
	}
	if (report)
		*report = done;
	return status;
}

carom_status carom_world_step(carom_world *world, uint64_t steps, carom_report *report, carom_error *error)
{
	return run_all(world, FOR_EVER, steps, report, error);
}

carom_status carom_world_advance(carom_world *world, double seconds, carom_report *report, carom_error *error)
{
	if (!(seconds >= 0.0 && seconds < FOR_EVER))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "seconds: found %g, must be a finite number from 0 on", seconds);
	return run_all(world, seconds, UINT64_MAX, report, error);
}
