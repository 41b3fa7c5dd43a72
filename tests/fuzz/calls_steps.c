/* Calls that let time pass, and what may have happened then.
 * SPDX-License-Identifier: MIT */
#include "calls.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 2, HITS_A_STEP = 16 };

/* Each hit rounds velocities to floats, a few units in the last place of the fastest. */
#define GAIN_A_HIT 1e-6
#define GAIN 1e-5
/* Contacts are found to about a millionth of the coordinates' size. */
#define OUTSIDE 1e-4f
#define OVERLAP 1e-4

/* ---- What has to hold */

static carom_measure measured(calls *c)
{
	carom_measure measure = {0};
	FUZZ_EXPECT(carom_world_measure(*c->slot, &measure, NULL) == CAROM_OK);
	return measure;
}

/* Does nothing push, no body that moves whatever it meets either, and is no impulse the paper's, which may give more than there was? */
static bool keeps_energy(calls *c)
{
	const carom_world_def *def = carom_world_get_def(*c->slot);
	carom_body_info info;
	for (uint32_t k = 0; k < carom_world_body_count(*c->slot); k++) {
		FUZZ_EXPECT(carom_world_get_body(*c->slot, k, &info, NULL) == CAROM_OK);
		if (info.is_kinematic || info.force.x != 0 || info.force.y != 0 || info.torque != 0)
			return false;
	}
	return c->bytes.tame && def->gravity.x == 0 && def->gravity.y == 0 && strcmp(carom_pipeline_get(&def->pipeline, "impulse"), "accumulate") != 0;
}

/* [2.1] as it is in the paper. */
static bool misses_hits(calls *c)
{
	return strcmp(carom_pipeline_get(&carom_world_get_def(*c->slot)->pipeline, "toi"), "bisection") == 0;
}

static bool is_inside(const carom_world_def *def, carom_vec2 p)
{
	return p.x >= def->room_min.x - OUTSIDE && p.x <= def->room_max.x + OUTSIDE && p.y >= def->room_min.y - OUTSIDE
		&& p.y <= def->room_max.y + OUTSIDE;
}

/* Where a body began in a wall, it may turn in it, and no wall stops a kinematic one. */
static void judge_states(calls *c, bool began_apart)
{
	const carom_world_def *def = carom_world_get_def(*c->slot);
	const size_t count = carom_world_body_count(*c->slot);
	carom_body_state states[MOST_BODIES];
	carom_body_info info;
	FUZZ_EXPECT(carom_world_get_states(*c->slot, 0, count, states, NULL) == CAROM_OK);
	for (size_t k = 0; k < count; k++) {
		const carom_body_state *s = &states[k];
		FUZZ_EXPECT(carom_world_get_body(*c->slot, (uint32_t)k, &info, NULL) == CAROM_OK);
		FUZZ_EXPECT(isfinite(s->position.x) && isfinite(s->position.y) && isfinite(s->velocity.x) && isfinite(s->velocity.y));
		FUZZ_EXPECT(isfinite(s->angular_velocity) && fabsf(s->angle) < 3.15f);
		FUZZ_EXPECT(!c->bytes.tame || !began_apart || !def->has_room || info.is_kinematic || is_inside(def, s->position));
	}
}

/* As many as the report has, one after the other, or none, in a world of a scene. */
static void judge_hits(calls *c, double begun, const carom_report *report)
{
	const int32_t bodies = (int32_t)carom_world_body_count(*c->slot);
	const size_t count = carom_world_hit_count(*c->slot);
	carom_hit hit;
	double before = begun;
	FUZZ_EXPECT(count == (carom_world_get_def(*c->slot)->keep_hits ? report->hits : 0));
	FUZZ_EXPECT(carom_world_get_hits(*c->slot, count, 1, &hit, NULL) == CAROM_INVALID_ARGUMENT);
	for (size_t k = 0; k < count; k++, before = hit.time) {
		FUZZ_EXPECT(carom_world_get_hits(*c->slot, k, 1, &hit, NULL) == CAROM_OK);
		FUZZ_EXPECT((int32_t)hit.body < bodies && hit.other < (int32_t)hit.body && hit.other >= CAROM_WALL_TOP);
		FUZZ_EXPECT(hit.time >= before - 1e-9 * before && hit.time <= (begun + report->advanced) * (1 + 1e-9));
		FUZZ_EXPECT(fabsf(hypotf(hit.normal.x, hit.normal.y) - 1) < 1e-5f);
		FUZZ_EXPECT(isfinite(hit.point.x) && isfinite(hit.point.y) && isfinite(hit.impulse.x) && isfinite(hit.impulse.y));
		calls_note(c, &hit.time, sizeof hit.time);
		calls_note(c, &hit.point, sizeof hit.point);
		calls_note(c, &hit.impulse, sizeof hit.impulse);
	}
}

/* ---- Time passes */

typedef struct passing {
	carom_measure before;
	bool keeps_energy;
	double time;
	carom_report report;
	carom_error error;
} passing;

static passing begin(calls *c)
{
	const carom_report blank = {77, 77, 77, 77, 77};
	return (passing){measured(c), keeps_energy(c), carom_world_time(*c->slot), blank, fuzz_blank()};
}

static void spend(calls *c, uint64_t work)
{
	c->work = work < c->work ? c->work - work : 0;
}

/* On failure, too, the report tells what was done, and the state is a good one. */
static void end(calls *c, const passing *p, carom_status status)
{
	const carom_report *report = &p->report;
	const bool fine = calls_judge(c, status, &p->error);
	FUZZ_EXPECT_SAID(fine || status == CAROM_STALLED || (status == CAROM_LIMIT && !c->bytes.tame), p->error.text);
	FUZZ_EXPECT(report->steps <= MOST_STEPS + 1 && report->advanced >= 0);
	FUZZ_EXPECT(fabs(carom_world_time(*c->slot) - p->time - report->advanced) <= 1e-9 * (p->time + report->advanced));
	spend(c, report->steps + report->hits / HITS_A_STEP);
	calls_note(c, report, sizeof *report);
	calls_look(c);
	judge_hits(c, p->time, report);
	judge_states(c, p->before.max_penetration == 0);
	const carom_measure after = measured(c);
	const double gain = p->before.kinetic_energy * (GAIN + GAIN_A_HIT * (double)report->hits);
	FUZZ_EXPECT(!c->bytes.tame || p->before.max_penetration > 0 || misses_hits(c) || after.max_penetration <= OVERLAP);
	FUZZ_EXPECT(!p->keeps_energy || after.kinetic_energy <= p->before.kinetic_energy + gain + 1e-12);
}

static uint64_t some_steps(calls *c)
{
	const uint64_t steps = 1 + bytes_below(&c->bytes, MOST_STEPS);
	return steps < c->work ? steps : c->work;
}

static bool go_on(void *context, const carom_report *so_far)
{
	carom_report *last = context;
	FUZZ_EXPECT(so_far->steps >= last->steps && so_far->hits >= last->hits && so_far->advanced >= last->advanced);
	*last = *so_far;
	return true;
}

void calls_step(calls *c)
{
	passing p = begin(c);
	carom_report last = {0};
	const uint64_t steps = carom_world_body_count(*c->slot) > 0 ? some_steps(c) : UINT64_MAX;
	carom_world_set_progress(*c->slot, go_on, &last);
	const carom_status status = carom_world_step(*c->slot, steps, &p.report, &p.error);
	carom_world_set_progress(*c->slot, NULL, NULL);
	FUZZ_EXPECT(status != CAROM_OK || p.report.steps == (steps < UINT64_MAX ? steps : 0));
	end(c, &p, status);
}

/* How many steps of first_impact a time takes is not known beforehand. */
void calls_advance(calls *c)
{
	const carom_world_def *def = carom_world_get_def(*c->slot);
	const bool bounded = strcmp(carom_pipeline_get(&def->pipeline, "step"), "events") == 0;
	double seconds = (double)def->time_step * (double)some_steps(c) * 0.9;
	passing p = begin(c);
	if (!c->bytes.tame && bytes_chance(&c->bytes, 4))
		seconds = bytes_wild_double(&c->bytes);
	const bool wrong = !(seconds >= 0 && seconds < 0x1p100);
	if (wrong) {
		const snapshot before = calls_look(c);
		FUZZ_EXPECT(!calls_judge(c, carom_world_advance(*c->slot, seconds, &p.report, &p.error), &p.error)
			&& p.error.status == CAROM_INVALID_ARGUMENT);
		calls_same(c, before);
	} else if (bounded && seconds <= (double)def->time_step * MOST_STEPS && c->work > MOST_STEPS) {
		end(c, &p, carom_world_advance(*c->slot, seconds, &p.report, &p.error));
	}
}

void calls_advance_to(calls *c)
{
	passing p = begin(c);
	double time = p.time + (double)carom_world_get_def(*c->slot)->time_step * (double)bytes_between(&c->bytes, -0.1f, MOST_STEPS);
	if (!c->bytes.tame && bytes_chance(&c->bytes, 4))
		time = bytes_wild_double(&c->bytes);
	const uint64_t steps = some_steps(c);
	const snapshot before = calls_look(c);
	const carom_status status = carom_world_advance_to(*c->slot, time, steps, &p.report, &p.error);
	if (status == CAROM_INVALID_ARGUMENT) {
		FUZZ_EXPECT(!(time >= p.time && time < 0x1p100) && !calls_judge(c, status, &p.error));
		calls_same(c, before);
		return;
	}
	end(c, &p, status);
}

static bool stop(void *context, const carom_report *so_far)
{
	(void)so_far;
	++*(int *)context;
	return false;
}

/* However many steps are asked for, it ends where the caller says. How many were done by then, the clock on the wall decides. */
void calls_break_off(calls *c)
{
	int asked = 0;
	carom_error error = fuzz_blank();
	if (carom_world_body_count(*c->slot) == 0 || c->work < MOST_STEPS)
		return;
	spend(c, MOST_STEPS);
	carom_world_set_progress(*c->slot, stop, &asked);
	const carom_status status = carom_world_step(*c->slot, UINT64_MAX, NULL, &error);
	FUZZ_EXPECT(fuzz_judge(status, &error) ? asked == 1 : status == CAROM_STALLED || status == CAROM_LIMIT);
	judge_states(c, false);
	carom_world_destroy(*c->slot);
	*c->slot = NULL;
}
