/* Joints that slide along a line, of the step contacts. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "joined.h"

static carom_joint slider(uint32_t body, int32_t other, float axis)
{
	carom_joint joint = joined_pin(body, other, 0.0f, 0.0f);
	joint.kind = CAROM_SLIDER;
	joint.axis = axis;
	return joint;
}

/* How far the body's anchor is to the left of the joint's line, m. */
static double off_line(carom_world *world)
{
	const carom_joint joint = joined_get(world, 0);
	const double turned = joint.other == CAROM_GROUND ? 0.0 : (double)runs_state(world, (uint32_t)joint.other).angle,
				 along = turned + (double)joint.axis;
	double x, y, ox, oy;
	joined_place(world, (int32_t)joint.body, joint.anchor, &x, &y);
	joined_place(world, joint.other, joint.other_anchor, &ox, &oy);
	return (y - oy) * cos(along) - (x - ox) * sin(along);
}

/* Down a line in the world it falls as down a slope without friction, g t^2 sin(a) / 2 far, and turns on as it did, or not where it is fixed. */
static void it_slides_down_a_line(void **unused)
{
	(void)unused;
	for (int fixed = 0; fixed < 2; fixed++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = joined_free(RUNS_GRAVITY);
			carom_body_def body = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f);
			carom_joint joint = slider(0, CAROM_GROUND, -0.5f);
			body.angular_velocity = fixed ? 0.0f : 1.0f;
			joint.anchor = (carom_vec2){0.0f, fixed ? 0.3f : 0.0f};
			joint.has_stops = fixed;
			carom_world *world = runs_world(&def, device, &body, 1);
			if (!world)
				continue;
			joined_set(world, 1, &joint);
			runs_step(world, 60);
			const carom_body_state state = runs_state(world, 0);
			const double way = 0.5 * (double)RUNS_GRAVITY * sin(0.5);
			runs_near((double)state.position.x, way * cos(0.5), 1e-4);
			runs_near((double)state.position.y, -way * sin(0.5), 1e-4);
			runs_near((double)state.angle, fixed ? 0.0 : 1.0, 1e-4);
			runs_near(off_line(world), 0.0, 1e-6);
			runs_near((double)joined_get(world, 0).force[0], (double)RUNS_GRAVITY * (double)joined_info(world, 0).mass * cos(0.5), 1e-2);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A line that turns with a body of its own, on which another slides outwards and turns: nothing outside acts on the two. */
static void a_line_turns_with_its_body(void **unused)
{
	(void)unused;
	for (int fixed = 0; fixed < 2; fixed++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = joined_free(0.0f);
			carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f), scenery_circle(1.0f, 0.0f, 0.5f, 1.0f, 0.2f)};
			carom_joint joint = slider(1, 0, 0.0f);
			joint.anchor = (carom_vec2){-0.8f, 0.05f};
			joint.other_anchor = (carom_vec2){0.2f, 0.05f};
			joint.has_stops = fixed;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			joined_set(world, 1, &joint);
			runs_step(world, 1);
			const carom_measure before = runs_measure(world);
			for (int second = 0; second < 5; second++) {
				runs_step(world, 60);
				const carom_measure after = runs_measure(world);
				runs_near(after.kinetic_energy, before.kinetic_energy, 1e-5 * before.kinetic_energy);
				runs_near(after.momentum_x, before.momentum_x, 1e-6);
				runs_near(after.momentum_y, before.momentum_y, 1e-6);
				runs_near(after.angular_momentum, before.angular_momentum, 1e-5);
				runs_near(off_line(world), 0.0, 2e-6);
			}
			if (fixed)
				runs_near((double)runs_state(world, 1).angle, (double)runs_state(world, 0).angle, 1e-5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A wheel on a line of its car, held by a spring, with a motor: the car sinks as far as the springs say, and drives. */
static void a_wheel_hangs_on_a_spring(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 200.0f, 10.0f);
		const carom_body_def bodies[3] = {scenery_box(0.0f, 0.9f, 0.0f, 0.0f, 2.0f, 0.4f), scenery_circle(-0.8f, 0.3f, 0.0f, 0.0f, 0.3f),
			scenery_circle(0.8f, 0.3f, 0.0f, 0.0f, 0.3f)};
		carom_joint joints[4];
		def.friction = 0.9f;
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		for (uint32_t k = 0; k < 2; k++) {
			joints[2 * k] = slider(k + 1, 0, 1.57079633f);
			joints[2 * k].motor_torque = 0.5f;
			joints[2 * k + 1] = slider(k + 1, 0, 0.0f);
			joints[2 * k + 1].kind = CAROM_SPRING;
			joints[2 * k + 1].other_anchor = (carom_vec2){k ? 0.8f : -0.8f, 0.2f};
			joints[2 * k + 1].stiffness = 60.0f;
			joints[2 * k + 1].damping = 5.0f;
		}
		joined_set(world, 4, joints);
		runs_step(world, 300);
		const double sunk = (double)RUNS_GRAVITY * (double)joined_info(world, 0).mass / 2.0 / 60.0;
		runs_near((double)runs_state(world, 0).position.y, 0.9 - sunk, 2e-3);
		runs_near(off_line(world), 0.0, 1e-5);
		carom_error error;
		for (size_t k = 0; k < 2; k++)
			scenery_check(carom_world_set_motor(world, 2 * k, -10.0f, 1.0f, &error), &error);
		runs_step(world, 240);
		runs_near((double)runs_state(world, 0).velocity.x, 3.0, 0.05);
		runs_near(off_line(world), 0.0, 1e-4);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(it_slides_down_a_line),
		cmocka_unit_test(a_line_turns_with_its_body),
		cmocka_unit_test(a_wheel_hangs_on_a_spring),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
