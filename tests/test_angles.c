/* A state's angle is in [-pi, pi], however far a body turned.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "runs.h"

static carom_body_state state_of(carom_world *world)
{
	carom_body_state state;
	carom_error error;
	scenery_check(carom_world_get_states(world, 0, 1, &state, &error), &error);
	return state;
}

static carom_world *world_of(const carom_world_def *def, const carom_body_def *body, const scenery_device *device)
{
	carom_world *world = scenery_world(def, device);
	carom_error error;
	if (world)
		scenery_check(carom_world_add(world, body, 1, NULL, &error), &error);
	return world;
}

/* A body turned to where the wrapping rounds: the state that is read and set again goes on with the same bits. */
static void angles_near_pi_come_back(void **unused)
{
	(void)unused;
	carom_body_def body = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.5f);
	body.angle = nextafterf(3.14159265f, 0.0f);
	for (int i = 0; i < 8; i++, body.angle = nextafterf(body.angle, 9.0f)) {
		const carom_world_def def = carom_default_world_def();
		carom_world *world = world_of(&def, &body, &scenery_devices[0]);
		carom_error error;
		for (int k = 0; k < 3; k++) {
			runs_step(world, 1);
			const uint64_t hash = runs_hash(world);
			const carom_body_state state = state_of(world);
			scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
			assert_true(runs_hash(world) == hash);
		}
		carom_world_destroy(world);
	}
}

/* Even where a step turns a body so far that rounding loses its direction; with the same bits on each device. */
static void check_turns(const char *step, float speed)
{
	uint64_t expected = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = carom_default_world_def();
		carom_body_def body = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.5f);
		def.time_step = 1000;
		def.pipeline.step = step;
		body.angular_velocity = speed;
		carom_world *world = world_of(&def, &body, device);
		if (!world)
			continue;
		for (int k = 0; k < 3; k++) {
			runs_step(world, 1);
			const carom_body_state state = state_of(world);
			if (!(fabsf(state.angle) <= 3.1416f))
				fail_msg("%g rad/s by %s on %s: angle %.9g", (double)speed, step, device->name, (double)state.angle);
			assert_true(state.angular_velocity == speed);
		}
		expected = expected ? expected : runs_hash(world);
		assert_true(runs_hash(world) == expected);
		carom_world_destroy(world);
	}
}

static void angles_stay_within_half_a_turn(void **unused)
{
	(void)unused;
	for (float speed = 1.2345f; speed < 9e5f; speed *= 1.7f) {
		check_turns("events", speed);
		check_turns("contacts", -speed);
		check_turns("first_impact", speed);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(angles_near_pi_come_back), cmocka_unit_test(angles_stay_within_half_a_turn)};
	return cmocka_run_group_tests_name("angles", tests, NULL, NULL);
}
