/* Joints that have motors and stops, of the step contacts. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "joined.h"

#define STEP (1.0 / 60.0)

/* A bar of 1 m from (0, 0) to the right, which turns about that end. */
static carom_body_def bar(void)
{
	return scenery_box(0.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f);
}

static carom_joint hinge(void)
{
	return joined_pin(0, CAROM_GROUND, -0.5f, 0.0f);
}

/* ---- Motors */

/* It turns two bodies against each other: by what it has, until they are as fast as it wants. */
static void a_motor_turns(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(0.0f);
		const carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 2.0f, 0.2f), scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.3f)};
		carom_joint motor = joined_pin(1, 0, 0.0f, 0.0f);
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		const double own = (double)joined_info(world, 1).inertia, other = (double)joined_info(world, 0).inertia, torque = 0.02;
		motor.motor_speed = 3.0f;
		motor.motor_torque = (float)torque;
		joined_set(world, 1, &motor);
		for (int k = 1; k <= 30; k++) {
			const double wanted = fmin(3.0, torque * (1.0 / own + 1.0 / other) * 10 * k * STEP);
			runs_step(world, 10);
			const double turning = (double)runs_state(world, 1).angular_velocity, against = (double)runs_state(world, 0).angular_velocity;
			runs_near(turning - against, wanted, 1e-4);
			runs_near(own * turning + other * against, 0.0, 1e-5);
			runs_near((double)joined_get(world, 0).torque[0], wanted < 3.0 ? torque : 0.0, wanted < 3.0 ? 1e-6 : torque);
		}
		runs_near((double)joined_get(world, 0).torque[0], 0.0, 1e-4);
		assert_true(joined_slack(world) < 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A motor that wants no speed is a brake: it bears a bar that hangs from it aside, with the weight's torque, or gives way with what it has. */
static void a_brake_holds_or_gives_way(void **unused)
{
	(void)unused;
	for (int holds = 0; holds < 2; holds++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = joined_free(RUNS_GRAVITY);
			const carom_body_def body = bar();
			carom_joint brake = hinge();
			carom_world *world = runs_world(&def, device, &body, 1);
			if (!world)
				continue;
			const carom_body_info info = joined_info(world, 0);
			const double weight = (double)RUNS_GRAVITY * (double)info.mass * 0.5;
			brake.motor_torque = (float)(weight * (holds ? 1.1 : 0.5));
			joined_set(world, 1, &brake);
			runs_step(world, holds ? 120 : 6);
			const double about_end = (double)info.inertia + (double)info.mass * 0.25, t = 6 * STEP;
			if (holds) {
				runs_near((double)runs_state(world, 0).angle, 0.0, 1e-4);
				runs_near((double)joined_get(world, 0).torque[0], weight, 1e-2 * weight);
			} else {
				runs_near((double)runs_state(world, 0).angle, -0.25 * weight / about_end * t * t, 1e-4);
				runs_near((double)joined_get(world, 0).torque[0], 0.5 * weight, 1e-6);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A body on two wheels with motors: it drives, the wheels roll, and it brakes. */
static void a_car_drives(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 200.0f, 10.0f);
		carom_body_def bodies[3] = {scenery_box(0.0f, 0.8f, 0.0f, 0.0f, 2.0f, 0.4f), scenery_circle(-0.8f, 0.35f, 0.0f, 0.0f, 0.3f),
			scenery_circle(0.8f, 0.35f, 0.0f, 0.0f, 0.3f)};
		carom_joint joints[2];
		def.friction = 0.9f;
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		for (uint32_t k = 0; k < 2; k++)
			joints[k] = joined_pin(k + 1, 0, 0.0f, 0.0f);
		for (int brakes = 0; brakes < 2; brakes++) {
			for (int k = 0; k < 2; k++) {
				joints[k].motor_speed = brakes ? 0.0f : -20.0f;
				joints[k].motor_torque = 1.0f;
			}
			joined_set(world, 2, joints);
			runs_step(world, 180);
			const carom_body_state body = runs_state(world, 0), wheel = runs_state(world, 2);
			runs_near((double)body.velocity.x, brakes ? 0.0 : 6.0, 0.02);
			runs_near((double)wheel.velocity.x, -0.3 * (double)wheel.angular_velocity, 0.02);
			runs_near((double)body.angle, 0.0, 0.02);
			assert_true(body.position.x > (brakes ? 10.0f : 5.0f));
			assert_true(joined_slack(world) < 1e-3);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Two boxes that are pinned to each other lie on the ground and sleep, until there is a motor. */
static void a_motor_wakes(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 20.0f, 10.0f);
		const carom_body_def bodies[2] = {scenery_box(0.0f, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f), scenery_box(1.2f, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f)};
		const carom_joint motor = joined_pin(1, 0, -0.6f, 0.0f);
		def.friction = 0.5f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		joined_set(world, 1, &motor);
		runs_step(world, 120);
		const uint64_t hash = runs_hash(world);
		runs_step(world, 60);
		assert_true(runs_hash(world) == hash);
		carom_error error;
		scenery_check(carom_world_set_motor(world, 0, 1.0f, 30.0f, &error), &error);
		runs_step(world, 30);
		runs_near((double)(runs_state(world, 1).angle - runs_state(world, 0).angle), 0.5, 0.05);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Who sets one motor gets the bits of one who sets all joints anew, whenever that is: while what it turns sleeps, between calls that read or change bodies, before the first step, and after bodies
 * have gone. */
static void a_motor_alone_is_as_all_joints(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		uint64_t hashes[2] = {0};
		for (int alone = 0; alone < 2; alone++) {
			carom_world_def def = runs_resting("contacts", 20.0f, 10.0f);
			carom_body_def bodies[7];
			carom_joint joints[3];
			carom_error error;
			for (int i = 0; i < 7; i++)
				bodies[i] = scenery_box(1.2f * (float)i - 4.0f, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f);
			for (uint32_t k = 0; k < 3; k++)
				joints[k] = joined_pin(2 * k + 1, (int32_t)(2 * k), -0.6f, 0.0f);
			def.friction = 0.5f;
			carom_world *world = runs_world(&def, device, bodies, 7);
			if (!world)
				break;
			joined_set(world, 3, joints);
			for (uint32_t turn = 0; turn < 12; turn++) {
				const size_t k = turn % carom_world_joint_count(world);
				const float speed = (float)(turn % 3) - 1.0f, torque = turn % 4 == 3 ? 0.0f : 40.0f;
				if (turn == 7) {
					const uint32_t gone = 2;
					scenery_check(carom_world_remove(world, &gone, 1, &error), &error);
				}
				if (alone) {
					scenery_check(carom_world_set_motor(world, k, 7.0f, 1.0f, &error), &error); /* who says it twice means the last */
					scenery_check(carom_world_set_motor(world, k, speed, torque, &error), &error);
					const carom_joint now = joined_get(world, k);
					assert_true(now.motor_speed == speed && now.motor_torque == torque);
				} else {
					const size_t has = carom_world_joint_count(world);
					scenery_check(carom_world_get_joints(world, 0, has, joints, &error), &error);
					joints[k].motor_speed = speed;
					joints[k].motor_torque = torque;
					joined_set(world, has, joints);
				}
				if (turn % 5 == 1)
					runs_load_anew(world);
				if (turn % 5 == 2)
					scenery_check(carom_world_set_force(world, 1, (carom_vec2){(float)turn, 0.0f}, 0.0f, &error), &error);
				runs_step(world, turn == 4 ? 120 : 7);
			}
			hashes[alone] = runs_hash(world);
			runs_same_hash(&first, hashes[alone], device);
			carom_world_destroy(world);
		}
		assert_true(hashes[0] == hashes[1]);
	}
}

/* ---- Stops */

/* A bar falls until it lies on the lower one, which bears it; and thrown up it gets to the upper one, and no farther. */
static void a_stop_bears(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(RUNS_GRAVITY);
		carom_body_def body = bar();
		carom_joint stops = hinge();
		body.angular_velocity = 5.0f;
		body.velocity.y = 2.5f;
		stops.has_stops = true;
		stops.lower_angle = -0.5f;
		stops.upper_angle = 0.25f;
		carom_world *world = runs_world(&def, device, &body, 1);
		if (!world)
			continue;
		joined_set(world, 1, &stops);
		float highest = 0.0f, lowest = 0.0f;
		for (int k = 0; k < 180; k++) {
			runs_step(world, 1);
			const carom_body_state state = runs_state(world, 0);
			highest = fmaxf(highest, state.angle);
			lowest = fminf(lowest, state.angle);
		}
		assert_true(highest < 0.25f + 1e-4f && highest > 0.25f - 5e-3f); /* in the step in which it gets there it falls, too */
		runs_near((double)lowest, -0.5, 1e-4);
		runs_near((double)runs_state(world, 0).angle, -0.5, 1e-4);
		const double weight = (double)RUNS_GRAVITY * (double)joined_info(world, 0).mass * 0.5 * cos(0.5);
		runs_near((double)joined_get(world, 0).torque[1], weight, 1e-2 * weight);
		assert_true(joined_slack(world) < 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Angles of which one lies beyond half a turn: a hand that turns stops there, also after having passed pi. */
static void a_stop_may_lie_beyond_half_a_turn(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(0.0f);
		const carom_body_def body = bar();
		carom_joint stops = hinge();
		stops.has_stops = true;
		stops.upper_angle = 4.5f;
		stops.lower_angle = -1.0f;
		stops.motor_speed = 2.0f;
		stops.motor_torque = 1.0f;
		carom_world *world = runs_world(&def, device, &body, 1);
		if (!world)
			continue;
		joined_set(world, 1, &stops);
		runs_step(world, 180);
		runs_near((double)runs_state(world, 0).angle, 4.5 - 2.0 * 3.14159265, 1e-4);
		runs_near((double)joined_get(world, 0).torque[0], 1.0, 1e-3);
		runs_near((double)joined_get(world, 0).torque[1], -1.0, 1e-2);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Five bars in a row that can't turn are one beam: it sticks out from the wall, and the first bears what statics say. */
static void what_does_not_turn_is_a_beam(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		enum { BARS = 5 };
		carom_world_def def = joined_free(RUNS_GRAVITY);
		carom_body_def bodies[BARS];
		carom_joint joints[BARS];
		for (int i = 0; i < BARS; i++) {
			bodies[i] = bar();
			bodies[i].position.x += (float)i;
			joints[i] = joined_pin((uint32_t)i, i - 1, -0.5f, 0.0f);
			joints[i].has_stops = true;
		}
		carom_world *world = runs_world(&def, device, bodies, BARS);
		if (!world)
			continue;
		joined_set(world, BARS, joints);
		runs_step(world, 240);
		const double weight = (double)RUNS_GRAVITY * BARS * (double)joined_info(world, 0).mass;
		runs_near((double)runs_state(world, BARS - 1).position.y, 0.0, 1e-3);
		runs_near((double)joined_get(world, 0).torque[1], weight * 0.5 * BARS, 0.03 * weight * BARS);
		runs_near((double)joined_get(world, 0).force[1], weight, 0.03 * weight);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A ball hits the end of a bar, or of one of two of half its length that are fixed to each other: it is the same hit. */
static void who_hits_a_part_hits_all(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_body_state balls[2];
		double turning[2];
		for (int parts = 1; parts <= 2; parts++) {
			carom_world_def def = joined_free(0.0f);
			carom_body_def bodies[3] = {scenery_circle(0.9f, 1.0f, 0.0f, -3.0f, 0.2f), scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 2.0f, 0.2f)};
			if (parts == 2) {
				bodies[1] = scenery_box(-0.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f);
				bodies[2] = scenery_box(0.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f);
			}
			carom_joint fixed = joined_pin(1, 2, 0.5f, 0.0f);
			fixed.has_stops = true;
			carom_world *world = runs_world(&def, device, bodies, (size_t)parts + 1);
			if (!world)
				break;
			if (parts == 2)
				joined_set(world, 1, &fixed);
			const carom_measure before = runs_measure(world);
			assert_int_equal(runs_advance(world, 0.5).hits, 1);
			const carom_measure after = runs_measure(world);
			runs_near(after.kinetic_energy, before.kinetic_energy, 1e-3 * before.kinetic_energy);
			runs_near(after.angular_momentum, before.angular_momentum, 1e-3);
			balls[parts - 1] = runs_state(world, 0);
			turning[parts - 1] = (double)runs_state(world, 1).angular_velocity;
			if (parts == 2) {
				runs_near((double)runs_state(world, 2).angular_velocity, turning[1], 1e-4);
				runs_near((double)balls[1].velocity.y, (double)balls[0].velocity.y, 1e-3);
				runs_near(turning[1], turning[0], 1e-3);
				runs_same_hash(&first, runs_hash(world), device);
			}
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_motor_turns),
		cmocka_unit_test(a_brake_holds_or_gives_way),
		cmocka_unit_test(a_car_drives),
		cmocka_unit_test(a_motor_wakes),
		cmocka_unit_test(a_motor_alone_is_as_all_joints),
		cmocka_unit_test(a_stop_bears),
		cmocka_unit_test(a_stop_may_lie_beyond_half_a_turn),
		cmocka_unit_test(what_does_not_turn_is_a_beam),
		cmocka_unit_test(who_hits_a_part_hits_all),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
