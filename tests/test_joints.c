/* Joints, of the step contacts: what they hold stays where it belongs, and they neither take nor give energy. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runs.h"

/* Without a room, and without loss in hits. */
static carom_world_def free_space(float gravity)
{
	carom_world_def def = carom_default_world_def();
	def.pipeline.step = "contacts";
	def.gravity = (carom_vec2){0.0f, -gravity};
	return def;
}

static carom_joint pin(uint32_t body, int32_t other, float x, float y)
{
	carom_joint joint = carom_default_joint();
	joint.body = body;
	joint.other = other;
	joint.anchor = (carom_vec2){x, y};
	return joint;
}

static carom_joint rod(uint32_t body, int32_t other, float other_x, float other_y)
{
	carom_joint joint = pin(body, other, 0.0f, 0.0f);
	joint.kind = CAROM_DISTANCE;
	joint.other_anchor = (carom_vec2){other_x, other_y};
	return joint;
}

static void set(carom_world *world, size_t count, const carom_joint *joints)
{
	carom_error error;
	scenery_check(carom_world_set_joints(world, count, joints, &error), &error);
}

static void place(carom_world *world, int32_t body, carom_vec2 anchor, double *x, double *y)
{
	const carom_body_state state = body == CAROM_GROUND ? (carom_body_state){.angle = 0.0f} : runs_state(world, (uint32_t)body);
	const double c = cos((double)state.angle), s = sin((double)state.angle);
	*x = (double)state.position.x + c * (double)anchor.x - s * (double)anchor.y;
	*y = (double)state.position.y + s * (double)anchor.x + c * (double)anchor.y;
}

/* How far the worst joint is from where it belongs, m. */
static double slack(carom_world *world)
{
	double worst = 0.0;
	for (size_t k = 0; k < carom_world_joint_count(world); k++) {
		carom_joint joint;
		carom_error error;
		double x, y, other_x, other_y;
		scenery_check(carom_world_get_joints(world, k, 1, &joint, &error), &error);
		place(world, (int32_t)joint.body, joint.anchor, &x, &y);
		place(world, joint.other, joint.other_anchor, &other_x, &other_y);
		worst = fmax(worst, fabs(hypot(x - other_x, y - other_y) - (double)joint.length));
	}
	return worst;
}

static double energy(carom_world *world)
{
	const carom_measure measure = runs_measure(world);
	return measure.kinetic_energy + measure.potential_energy;
}

static double force_of(carom_world *world, size_t k)
{
	carom_joint joint;
	carom_error error;
	scenery_check(carom_world_get_joints(world, k, 1, &joint, &error), &error);
	return hypot((double)joint.force[0], (double)joint.force[1]);
}

/* ---- One pendulum */

/* Let go at an angle, it is back after a period, by a rod or by a pin, and swings as high as before. A rod of 1 m: 2 pi sqrt(1 / g) (1 + a^2 / 16 + 11 a^4 / 3072), and
 * with a mass that is not a point, by I / (m r) in place of 1 m. */
static void a_pendulum_keeps_its_period_and_its_height(void **unused)
{
	(void)unused;
	for (int is_pin = 0; is_pin < 2; is_pin++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const double a = 0.5, r = is_pin ? 0.5 : 1.0, length = is_pin ? (1.0 + 0.2 * 0.2) / 12.0 / r + r : r;
			const double period = 2.0 * 3.14159265358979 * sqrt(length / RUNS_GRAVITY) * (1.0 + a * a / 16.0 + 11.0 * pow(a, 4.0) / 3072.0);
			carom_world_def def = free_space(RUNS_GRAVITY);
			carom_body_def bob = is_pin ? scenery_box((float)(r * sin(a)), (float)(-r * cos(a)), 0.0f, 0.0f, 0.2f, 1.0f)
										: scenery_circle((float)(r * sin(a)), (float)(-r * cos(a)), 0.0f, 0.0f, 0.1f);
			const carom_joint joint = is_pin ? pin(0, CAROM_GROUND, 0.0f, 0.5f) : rod(0, CAROM_GROUND, 0.0f, 0.0f);
			bob.angle = is_pin ? (float)a : 0.0f;
			carom_world *world = runs_world(&def, device, &bob, 1);
			if (!world)
				continue;
			set(world, 1, &joint);
			carom_body_info info;
			carom_error error;
			scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
			const double begin = energy(world), mass = (double)info.mass, range = (double)RUNS_GRAVITY * mass * r * (1.0 - cos(a));
			for (int swing = 1; swing <= 10; swing++) {
				runs_advance(world, period);
				assert_true(slack(world) < 3e-6);
				runs_near(energy(world), begin, 1e-3 * range * swing);
			}
			runs_near((double)runs_state(world, 0).position.x, r * sin(a), 0.02 * r);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What hangs still has the weight on its joint, and stays there. */
static void what_hangs_weighs(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = free_space(RUNS_GRAVITY);
		carom_body_def bodies[3] = {scenery_circle(0.0f, -1.0f, 0.0f, 0.0f, 0.2f), scenery_box(0.0f, -2.0f, 0.0f, 0.0f, 0.2f, 1.0f),
			scenery_circle(3.0f, 0.0f, 0.0f, 0.0f, 0.2f)};
		const carom_joint joints[3] = {rod(0, CAROM_GROUND, 0.0f, 0.0f), pin(1, 0, 0.0f, 0.5f), pin(2, CAROM_GROUND, 0.0f, 0.0f)};
		carom_joint after[3];
		carom_error error;
		for (int i = 0; i < 3; i++)
			bodies[i].mass = (float)(i + 1);
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		set(world, 3, joints);
		runs_step(world, 120);
		for (uint32_t i = 0; i < 3; i++) {
			const carom_body_state state = runs_state(world, i);
			runs_near((double)state.position.x, (double)bodies[i].position.x, 1e-5);
			runs_near((double)state.position.y, (double)bodies[i].position.y, 1e-5);
		}
		scenery_check(carom_world_get_joints(world, 0, 3, after, &error), &error);
		runs_near((double)after[0].force[0], -3.0 * (double)RUNS_GRAVITY, 0.05);
		runs_near((double)after[1].force[1], 2.0 * (double)RUNS_GRAVITY, 0.05);
		runs_near((double)after[2].force[1], 3.0 * (double)RUNS_GRAVITY, 0.05);
		assert_true(after[0].force[1] == 0.0f && after[0].length == 1.0f && after[1].length == 0.0f);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- Chains */

enum { LINKS = 10 };

/* Bars of 1 m from (0, 0) to the right, or balls on rods, that turn about it as one. */
static carom_world *chain(const scenery_device *device, bool of_rods, float gravity, float turning)
{
	carom_world_def def = free_space(gravity);
	carom_body_def bodies[LINKS];
	carom_joint joints[LINKS];
	for (int i = 0; i < LINKS; i++) {
		const float x = of_rods ? (float)i + 1.0f : (float)i + 0.5f;
		bodies[i] = of_rods ? scenery_circle(x, 0.0f, 0.0f, turning * x, 0.2f) : scenery_box(x, 0.0f, 0.0f, turning * x, 1.0f, 0.2f);
		bodies[i].angular_velocity = turning;
		joints[i] = of_rods ? rod((uint32_t)i, i - 1, 0.0f, 0.0f) : pin((uint32_t)i, i - 1, -0.5f, 0.0f);
	}
	carom_world *world = runs_world(&def, device, bodies, LINKS);
	if (world)
		set(world, LINKS, joints);
	return world;
}

/* A chain that turns like a stick goes on so: with tensions of 28 and 40 N, and neither its energy nor its angular momentum changes by a thousandth in 10 s. */
static void a_chain_that_turns_goes_on(void **unused)
{
	(void)unused;
	for (int of_rods = 0; of_rods < 2; of_rods++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = chain(device, of_rods, 0.0f, 2.0f);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			for (int k = 0; k < 10; k++) {
				runs_step(world, 60);
				const carom_measure after = runs_measure(world);
				assert_true(slack(world) < 1e-5);
				runs_near(after.kinetic_energy, before.kinetic_energy, 1e-3 * before.kinetic_energy);
				runs_near(after.angular_momentum, before.angular_momentum, 1e-3 * before.angular_momentum);
			}
			assert_true(force_of(world, 0) > 25.0);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A chain that falls whips, faster than steps can follow; it holds together, and gets no energy from that. */
static void a_chain_that_falls_holds(void **unused)
{
	(void)unused;
	for (int of_rods = 0; of_rods < 2; of_rods++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = chain(device, of_rods, RUNS_GRAVITY, 0.0f);
			if (!world)
				continue;
			const double begin = energy(world);
			double most = 0.0;
			for (int k = 0; k < 100; k++) {
				runs_step(world, 6);
				most = fmax(most, energy(world) - begin);
				assert_true(slack(world) < 0.1);
			}
			assert_true(most < 0.2);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Far too fast for the time step: what it can't follow it slows, and nothing flies apart. */
static void what_is_too_fast_loses_energy(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = chain(device, false, 0.0f, 20.0f);
		if (!world)
			continue;
		double before = runs_measure(world).kinetic_energy;
		for (int k = 0; k < 20; k++) {
			runs_step(world, 15);
			const double after = runs_measure(world).kinetic_energy;
			assert_true(after < 1.01 * before);
			before = after;
		}
		assert_true(slack(world) < 0.05);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_pendulum_keeps_its_period_and_its_height),
		cmocka_unit_test(what_hangs_weighs),
		cmocka_unit_test(a_chain_that_turns_goes_on),
		cmocka_unit_test(a_chain_that_falls_holds),
		cmocka_unit_test(what_is_too_fast_loses_energy),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
