/* Damping: how velocities get less from step to step, by the steps events and contacts. On every device. (That hits are where they ought to be is in test_events.c.)
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <string.h>

#include "runs.h"

static const char *const steps[] = {"events", "contacts"};

/* After n steps of h the velocity is that of the start / (1 + d h)^n, and the way the sum; what is kinematic goes on; a body's own damping counts before the world's. */
static void velocities_get_less(void **unused)
{
	enum { COUNT = 6, STEPS = 90 };
	(void)unused;
	for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			static const double linear[COUNT] = {1.0, 3.0, 0.0, 1.0, 1.0, 0.0}, angular[COUNT] = {0.5, 0.5, 2.0, 0.5, 0.5, 0.0};
			carom_world_def def = runs_def();
			carom_body_def bodies[COUNT];
			def.pipeline.step = steps[k];
			def.linear_damping = 1.0f;
			def.angular_damping = 0.5f;
			for (int i = 0; i < COUNT; i++) {
				bodies[i] = scenery_box(0.0f, 3.0f * (float)i, 4.0f, 0.25f, 1.0f, 1.0f);
				bodies[i].angular_velocity = 2.0f;
			}
			bodies[1].linear_damping = 3.0f;
			bodies[2].linear_damping = 0.0f;
			bodies[2].angular_damping = 2.0f;
			bodies[5].is_kinematic = true;
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			runs_step(world, STEPS);
			for (int i = 0; i < COUNT; i++) {
				const carom_body_state after = runs_state(world, (uint32_t)i);
				const double h = 1.0 / 60.0, by = 1.0 + linear[i] * h, turning = 1.0 + angular[i] * h;
				const double way = linear[i] > 0.0 ? 4.0 * h * (1.0 - pow(by, -STEPS)) / (1.0 - 1.0 / by) : 4.0 * h * STEPS;
				runs_near((double)after.velocity.x, 4.0 * pow(by, -STEPS), 1e-5);
				runs_near((double)after.velocity.y, 0.25 * pow(by, -STEPS), 1e-6);
				runs_near((double)after.angular_velocity, 2.0 * pow(turning, -STEPS), 1e-5);
				runs_near((double)after.position.x, way, 1e-4);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* In a step that is cut short it is as much as that takes. */
static void short_steps_damp_less(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		carom_body_def ball = scenery_circle(0.0f, 0.0f, 4.0f, 0.0f, 0.5f);
		ball.linear_damping = 6.0f;
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		runs_advance(world, 0.005);
		runs_near((double)runs_state(world, 0).velocity.x, 4.0 / 1.03, 1e-6);
		carom_world_destroy(world);
	}
}

/* What falls gets as fast as damping lets it: then a step adds what it takes. */
static void what_falls_gets_no_faster(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		carom_body_def ball = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
		def.gravity.y = -10.0f;
		ball.linear_damping = 2.0f;
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		runs_step(world, 900);
		runs_near((double)runs_state(world, 0).velocity.y, -5.0, 1e-4);
		carom_world_destroy(world);
	}
}

/* It ends with 0, not with numbers that some devices don't have. */
static void it_ends_with_nothing(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		carom_body_def ball = scenery_circle(0.0f, 0.0f, 4.0f, -1.0f, 0.5f);
		ball.angular_velocity = 3.0f;
		ball.linear_damping = ball.angular_damping = 60.0f; /* a half a step */
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		runs_step(world, 50);
		assert_true(runs_state(world, 0).velocity.x > 0.0f);
		runs_step(world, 14);
		const carom_body_state after = runs_state(world, 0);
		assert_true(after.velocity.x == 0.0f && after.velocity.y == 0.0f && after.angular_velocity == 0.0f);
		carom_world_destroy(world);
	}
}

enum { CROWD = 120 };

/* Pairs of which one follows the other as fast, and would never reach it, but that one gets slower: nobody may look ahead as if velocities stayed. The same bits as where all is loaded
 * anew before each step. */
static void no_hit_is_missed(void **unused)
{
	enum { PAIRS = 24 };
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		carom_body_def bodies[2 * PAIRS];
		uint64_t hits = 0;
		for (int i = 0; i < PAIRS; i++) {
			bodies[2 * i] = scenery_circle(0.0f, 2.0f * (float)i, 2.0f, 0.0f, 0.5f);
			bodies[2 * i + 1] = scenery_circle(1.005f + 0.01f * (float)i, 2.0f * (float)i, 2.0f, 0.0f, 0.5f);
			bodies[2 * i + 1].linear_damping = 15.0f;
		}
		carom_world *world = runs_world(&def, device, bodies, 2 * PAIRS), *other = runs_world(&def, device, bodies, 2 * PAIRS);
		if (!world)
			continue;
		for (int i = 0; i < 24; i++) {
			hits += runs_step(world, 1).hits;
			runs_load_anew(other);
			runs_step(other, 1);
			assert_true(runs_hash(world) == runs_hash(other));
		}
		assert_true(hits >= PAIRS);
		assert_true(runs_measure(world).max_penetration < 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* One that is damped comes into a world where nobody is, and leaves it: as in worlds that are made so. */
static void it_comes_and_goes(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		scenery_random random = {6};
		carom_world_def def = runs_room(12.0f, 12.0f);
		carom_body_def bodies[CROWD];
		carom_error error;
		scenery_bodies(&random, SCENERY_CIRCLES, CROWD, 2.0f, 10.0f, bodies);
		bodies[CROWD - 1].linear_damping = 4.0f;
		bodies[CROWD - 1].is_static = false;
		carom_world *world = runs_world(&def, device, bodies, CROWD - 1), *other;
		if (!world)
			continue;
		runs_step(world, 20);
		scenery_check(carom_world_add(world, &bodies[CROWD - 1], 1, NULL, &error), &error);
		for (int turn = 0; turn < 2; turn++) {
			const uint32_t last = CROWD - 1, count = turn ? CROWD - 1 : CROWD;
			carom_body_state states[CROWD], others[CROWD];
			other = runs_world(&def, device, bodies, count);
			scenery_check(carom_world_get_states(world, 0, count, states, &error), &error);
			scenery_check(carom_world_set_states(other, 0, count, states, &error), &error);
			runs_step(world, 20);
			runs_step(other, 20);
			scenery_check(carom_world_get_states(world, 0, count, states, &error), &error);
			scenery_check(carom_world_get_states(other, 0, count, others, &error), &error);
			assert_memory_equal(states, others, count * sizeof *states);
			carom_world_destroy(other);
			if (turn == 0)
				scenery_check(carom_world_remove(world, &last, 1, &error), &error);
		}
		carom_world_destroy(world);
	}
}

static void wrong_numbers_are_refused(void **unused)
{
	static const float wrong[] = {-0.5f, INFINITY};
	(void)unused;
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		carom_world_def def = runs_def();
		carom_body_def ball = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
		carom_world *world = runs_world(&def, &scenery_devices[0], NULL, 0);
		carom_error error;
		ball.linear_damping = wrong[i];
		assert_int_equal(carom_world_add(world, &ball, 1, NULL, &error), CAROM_INVALID_ARGUMENT);
		assert_non_null(strstr(error.text, "bodies[0].linear_damping: found "));
		ball.linear_damping = 0.0f;
		ball.angular_damping = wrong[i];
		assert_int_equal(carom_world_add(world, &ball, 1, NULL, &error), CAROM_INVALID_ARGUMENT);
		assert_non_null(strstr(error.text, "bodies[0].angular_damping: found "));
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(velocities_get_less),
		cmocka_unit_test(short_steps_damp_less),
		cmocka_unit_test(what_falls_gets_no_faster),
		cmocka_unit_test(it_ends_with_nothing),
		cmocka_unit_test(no_hit_is_missed),
		cmocka_unit_test(it_comes_and_goes),
		cmocka_unit_test(wrong_numbers_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
