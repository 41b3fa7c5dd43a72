/* What is beyond a stop, or a rope's length, is brought there, and stays: it keeps none of the speed that this takes. But what was at its bound before keeps all of its own.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "runs.h"

static carom_world_def no_gravity(void)
{
	carom_world_def def = runs_def();
	def.pipeline.step = "contacts";
	def.gravity = (carom_vec2){0.0f, 0.0f};
	return def;
}

static void join(carom_world *world, const carom_joint *joint)
{
	carom_error error;
	scenery_check(carom_world_set_joints(world, 1, joint, &error), &error);
}

static carom_joint rope(int32_t other, float length)
{
	carom_joint joint = carom_default_joint();
	joint.kind = CAROM_ROPE;
	joint.body = 0;
	joint.other = other;
	joint.other_anchor = (carom_vec2){0.0f, 0.0f};
	joint.length = length;
	return joint;
}

/* An arm on a pin, with stops that it is outside of: it comes to the nearer one, and is still there a second later, nearly at rest. */
static void check_stop(float lower, float upper, float expected)
{
	carom_body_def arm = scenery_box(0.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f);
	carom_joint pin = carom_default_joint();
	uint64_t expected_hash = 0;
	pin.anchor = (carom_vec2){-0.5f, 0.0f};
	pin.has_stops = true;
	pin.lower_angle = lower;
	pin.upper_angle = upper;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = no_gravity();
		carom_world *world = runs_world(&def, device, &arm, 1);
		if (!world)
			continue;
		join(world, &pin);
		for (int i = 0; i < 4; i++) {
			runs_step(world, 15);
			const carom_body_state state = runs_state(world, 0);
			runs_near(state.angle, expected, i ? 1e-4 : 0.02);
			if (i)
				runs_near(state.angular_velocity, 0.0, 1e-3);
		}
		runs_same_hash(&expected_hash, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

static void arms_stay_at_stops(void **unused)
{
	(void)unused;
	check_stop(0.5f, 1.5f, 0.5f);
	check_stop(-2.0f, -0.75f, -0.75f);
	check_stop(0.004f, 1.0f, 0.004f); /* so near that a single step brings it there */
	check_stop(-1.0f, -0.004f, -0.004f);
}

/* Two discs that are a metre apart, on a shorter rope: they come as near as it is long, and stay apart. */
static void check_drawn(float length)
{
	const carom_body_def discs[] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.1f), scenery_circle(1.0f, 0.0f, 0.0f, 0.0f, 0.2f)};
	uint64_t expected_hash = 0;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = no_gravity();
		const carom_joint joint = rope(1, length);
		carom_world *world = runs_world(&def, device, discs, 2);
		if (!world)
			continue;
		join(world, &joint);
		for (int i = 0; i < 4; i++) {
			runs_step(world, 15);
			const carom_body_state one = runs_state(world, 0), other = runs_state(world, 1);
			runs_near(other.position.x - one.position.x, length, i ? 1e-4 : 0.02);
			if (i)
				runs_near(other.velocity.x - one.velocity.x, 0.0, 1e-4);
		}
		runs_same_hash(&expected_hash, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

static void what_a_rope_draws_in_stays(void **unused)
{
	(void)unused;
	check_drawn(0.999f);
	check_drawn(0.9f);
	check_drawn(0.4f);
}

/* A ball that hangs on a rope is thrown up at 2 m/s: the rope bore it, and takes nothing of that. */
static void what_hangs_can_be_thrown(void **unused)
{
	(void)unused;
	const carom_body_def ball = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.1f);
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = no_gravity();
		carom_joint joint = rope(CAROM_GROUND, 1.0f);
		carom_error error;
		def.gravity.y = -RUNS_GRAVITY;
		joint.other_anchor = (carom_vec2){0.0f, 1.0f};
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		join(world, &joint);
		runs_step(world, 30);
		carom_body_state state = runs_state(world, 0);
		runs_near(state.position.y, 0.0, 1e-4);
		state.velocity.y = 2.0f;
		scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
		runs_step(world, 12); /* 0.2 s: to the top */
		state = runs_state(world, 0);
		runs_near(state.position.y, 0.2, 1e-3);
		runs_near(state.velocity.y, 0.0, 1e-2);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(arms_stay_at_stops), cmocka_unit_test(what_a_rope_draws_in_stays), cmocka_unit_test(what_hangs_can_be_thrown)};
	return cmocka_run_group_tests_name("brought", tests, NULL, NULL);
}
