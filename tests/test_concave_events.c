/* Crowds in which most bodies are not convex, by the step events, against the serial queue, which knows outlines, but no pieces: as many hits in each step, and
 * everybody where the queue has them.
 * SPDX-License-Identifier: MIT */
#include "concave.h"
#include "foretold.h"
#include "hollows.h"
#include "runs.h"

enum { MOST_BODIES = 40 };

typedef struct scene {
	const char *name;
	size_t count;
	float pitch, speed;
	bool has_room, mixed_restitution;
	float gravity, restitution, friction, time_step;
	float driven; /* m/s, rad/s: up to which most of what else is static is kinematic; 0: none */
	bool level;   /* none is turned at first, so that sides meet sides */
} scene;

static const scene scenes[] = {
	{"16 outlines", 16, 1.15f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.05f, 0.0f, false},
	{"40 outlines", 40, 1.1f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, 0.0f, false},
	{"outlines without a room", 30, 1.1f, 2.0f, false, false, 0.0f, 0.9f, 0.0f, 0.02f, 0.0f, false},
	{"outlines that fall", 30, 1.15f, 3.0f, true, true, -10.0f, 0.5f, 0.0f, 1.0f / 60.0f, 0.0f, false},
	{"outlines that rub", 36, 1.1f, 3.0f, true, false, 0.0f, 1.0f, 0.5f, 0.02f, 0.0f, false},
	{"outlines that fall and rub, driven", 40, 1.15f, 4.0f, true, true, -3.0f, 0.9f, 0.7f, 1.0f / 60.0f, 4.0f, false},
	{"long steps of outlines", 25, 1.2f, 4.0f, true, false, -1.0f, 1.0f, 0.0f, 0.1f, 0.0f, false},
	{"level outlines", 36, 1.05f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, 0.0f, true},
	{"level outlines that fall and rub", 25, 1.05f, 3.0f, true, true, -3.0f, 0.5f, 0.4f, 0.02f, 0.0f, true},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static carom_world_def make(const scene *s, uint64_t seed, carom_body_def *bodies)
{
	const float half = 0.5f * s->pitch * (float)(s->count > 36 ? 7 : s->count > 25 ? 6 : s->count > 16 ? 5 : 4) + 0.6f;
	carom_world_def def = s->has_room ? runs_room(half, half) : runs_def();
	scenery_random random = {seed};
	concave_bodies(&random, s->count, s->pitch, s->speed, bodies);
	if (s->driven > 0.0f)
		scenery_drive(&random, s->count, s->driven, bodies);
	for (size_t i = 0; i < s->count; i++) {
		if (s->level)
			bodies[i].angle = bodies[i].angular_velocity = 0.0f;
		if (s->mixed_restitution)
			bodies[i].restitution = scenery_uniform(&random, 0.5f, 1.0f);
		if (s->friction > 0.0f)
			bodies[i].friction = scenery_uniform(&random, 0.0f, 2.0f * s->friction);
		if (!s->has_room) { /* towards the middle, or they would fly apart */
			bodies[i].is_static = false;
			bodies[i].velocity.x -= bodies[i].position.x;
			bodies[i].velocity.y -= bodies[i].position.y;
		}
	}
	def.gravity.y = s->gravity;
	def.restitution = s->restitution;
	def.friction = s->friction;
	def.time_step = s->time_step;
	return def;
}

static void runs_as_foretold(void **unused)
{
	(void)unused;
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, (uint64_t)(s - scenes) + 21, bodies);
		const foretold_scene foretold = {s->name, &def, bodies, s->count, true};
		runs_enough(foretold_run(&foretold, runs_affordable(100)) > 15);
	}
}

static void each_step_is_as_foretold(void **unused)
{
	(void)unused;
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, (uint64_t)(s - scenes) + 100, bodies);
		const foretold_scene foretold = {s->name, &def, bodies, s->count, true};
		runs_enough(foretold_follow(&foretold, runs_affordable(s->gravity < -5.0f ? 20 : 60)) > 20);
	}
}

/* Stars, combs and spirals with up to 64 corners, which nobody has drawn. */
static void random_outlines_are_as_foretold(void **unused)
{
	static carom_vec2 vertices[MOST_BODIES][CAROM_MAX_VERTICES];
	static const int which[] = {1, 2};
	(void)unused;
	for (size_t k = 0; k < sizeof which / sizeof *which; k++) {
		const scene *s = &scenes[which[k]];
		carom_body_def bodies[MOST_BODIES];
		scenery_random random = {k + 5};
		const carom_world_def def = make(s, k + 200, bodies);
		for (size_t i = 0; i < s->count; i++) {
			if (bodies[i].shape != CAROM_POLYGON)
				continue;
			bodies[i].vertex_count = hollows_make(&random, (hollow_kind)(i % HOLLOW_KINDS), 0.45f, vertices[i]);
			bodies[i].vertices = vertices[i];
		}
		const foretold_scene foretold = {s->name, &def, bodies, s->count, true};
		runs_enough(foretold_follow(&foretold, runs_affordable(30)) > 20);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(runs_as_foretold), cmocka_unit_test(each_step_is_as_foretold), cmocka_unit_test(random_outlines_are_as_foretold)};
	return cmocka_run_group_tests_name("concave_events", tests, NULL, NULL);
}
