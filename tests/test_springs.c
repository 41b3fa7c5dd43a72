/* Joints that are springs and ropes, of the step contacts. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "joined.h"

#define STEP (1.0 / 60.0)

/* From (0, 0) to the middle of body 0. */
static carom_joint line_of(carom_joint_kind kind, float length)
{
	carom_joint joint = joined_rod(0, CAROM_GROUND, 0.0f, 0.0f);
	joint.kind = kind;
	joint.length = length;
	return joint;
}

static double energy_with(carom_world *world, const carom_joint *spring)
{
	const carom_measure measure = runs_measure(world);
	const carom_body_state state = runs_state(world, 0);
	const double stretched = hypot((double)state.position.x, (double)state.position.y) - (double)spring->length;
	return measure.kinetic_energy + measure.potential_energy + 0.5 * (double)spring->stiffness * stretched * stretched;
}

/* ---- Springs */

/* A step is the rule of the mean: each turns the phase by 2 atan(w h / 2), exactly, and takes no energy. */
static void a_spring_swings(void **unused)
{
	static const float rates[] = {2.0f, 10.0f, 60.0f};
	(void)unused;
	for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = joined_free(0.0f);
			carom_body_def ball = scenery_circle(1.5f, 0.0f, 0.0f, 0.0f, 0.2f);
			carom_joint spring = line_of(CAROM_SPRING, 1.0f);
			ball.mass = 2.0f;
			spring.stiffness = 2.0f * rates[i] * rates[i];
			carom_world *world = runs_world(&def, device, &ball, 1);
			if (!world)
				continue;
			joined_set(world, 1, &spring);
			const double begin = energy_with(world, &spring), turns = 2.0 * atan(0.5 * (double)rates[i] * STEP);
			for (int k = 1; k <= 10; k++) {
				runs_step(world, 60);
				runs_near((double)runs_state(world, 0).position.x, 1.0 + 0.5 * cos(60.0 * k * turns), 2e-4 * k);
				runs_near(energy_with(world, &spring), begin, 1e-4 * begin);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* It turns, and gets longer and shorter. */
static void a_spring_pendulum_keeps_its_energy(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(RUNS_GRAVITY);
		const carom_body_def ball = scenery_circle(1.0f, 0.0f, 0.0f, 0.0f, 0.2f);
		carom_joint spring = line_of(CAROM_SPRING, 1.0f);
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		const double range = (double)RUNS_GRAVITY * (double)joined_info(world, 0).mass;
		spring.stiffness = 40.0f;
		joined_set(world, 1, &spring);
		double longest = 0.0;
		const double begin = energy_with(world, &spring);
		for (int k = 1; k <= 120; k++) {
			runs_step(world, 10);
			longest = fmax(longest, hypot((double)runs_state(world, 0).position.x, (double)runs_state(world, 0).position.y));
			runs_near(energy_with(world, &spring), begin, 1e-3 * range);
		}
		assert_true(longest > 1.05);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

static void a_damper_damps(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(0.0f);
		carom_body_def ball = scenery_circle(1.5f, 0.0f, 0.0f, 0.0f, 0.2f);
		carom_joint spring = line_of(CAROM_SPRING, 1.0f);
		ball.mass = 1.0f;
		spring.stiffness = 100.0f;
		spring.damping = 4.0f;
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		joined_set(world, 1, &spring);
		for (int k = 1; k <= 5; k++) {
			const double t = 0.2 * k, rate = sqrt(96.0);
			runs_step(world, 12);
			runs_near((double)runs_state(world, 0).position.x, 1.0 + 0.5 * exp(-2.0 * t) * (cos(rate * t) + 2.0 / rate * sin(rate * t)), 3e-3);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Of a spring that would swing thirty times in a step nobody sees the swings: it is as long as it is at rest, soon, and never flies apart. */
static void a_spring_too_stiff_for_the_step_comes_to_rest(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(0.0f);
		const carom_body_def bodies[2] = {scenery_circle(1.5f, 0.0f, 0.0f, 0.0f, 0.2f), scenery_circle(0.0f, 0.0f, 1.0f, 2.0f, 0.2f)};
		carom_joint spring = line_of(CAROM_SPRING, 1.0f);
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		spring.other = 1;
		spring.stiffness = (float)(pow(30.0 * 2.0 * 3.14159265 / STEP, 2.0) * (double)joined_info(world, 0).mass / 2.0);
		joined_set(world, 1, &spring);
		const carom_measure before = runs_measure(world);
		for (int k = 0; k < 120; k++) {
			runs_step(world, 1);
			const carom_body_state a = runs_state(world, 0), b = runs_state(world, 1);
			runs_near(hypot((double)(a.position.x - b.position.x), (double)(a.position.y - b.position.y)), 1.0, k < 30 ? 0.51 : 2e-3);
		}
		const carom_measure after = runs_measure(world);
		runs_near(after.momentum_x, before.momentum_x, 1e-5);
		runs_near(after.momentum_y, before.momentum_y, 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Frames that fall between steps cut these short, by much or little: joints act in what there is of each, and take no energy. */
static void short_steps_take_no_energy(void **unused)
{
	static const double frames[] = {0.04, 0.013};
	(void)unused;
	for (int kind = 0; kind < 3; kind++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
				carom_world_def def = joined_free(RUNS_GRAVITY);
				const carom_body_def body = kind == CAROM_REVOLUTE ? scenery_box(0.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f)
																   : scenery_circle(1.0f, 0.0f, 0.0f, 0.0f, 0.2f);
				carom_joint joint = kind == CAROM_REVOLUTE ? joined_pin(0, CAROM_GROUND, -0.5f, 0.0f)
														   : line_of(kind == 1 ? CAROM_DISTANCE : CAROM_SPRING, 1.0f);
				joint.stiffness = kind == 2 ? 40.0f : 0.0f;
				carom_world *world = runs_world(&def, device, &body, 1);
				if (!world)
					break;
				joined_set(world, 1, &joint);
				const double range = (double)RUNS_GRAVITY * (double)joined_info(world, 0).mass, begin = kind == 2 ? energy_with(world, &joint) : 0.0;
				for (int frame = 0; (double)frame * frames[i] < 4.0; frame++) {
					const carom_measure now = runs_measure(world);
					runs_near(kind == 2 ? energy_with(world, &joint) : now.kinetic_energy + now.potential_energy, begin, 1e-3 * range);
					runs_advance(world, frames[i]);
				}
				assert_true(kind == 2 || joined_slack(world) < 1e-5);
				if (i == 0)
					runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

/* ---- Ropes */

/* A ball falls as if there was no rope until that is tight; then it swings, no farther than the rope is long, and keeps its energy. */
static void a_rope_gets_tight_and_swings(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(RUNS_GRAVITY);
		const carom_body_def bodies[2] = {scenery_circle(0.6f, 0.0f, 0.0f, 0.0f, 0.1f), scenery_circle(3.6f, 0.0f, 0.0f, 0.0f, 0.1f)};
		const carom_joint rope = line_of(CAROM_ROPE, 1.0f);
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		joined_set(world, 1, &rope);
		runs_step(world, 18);
		assert_true(runs_state(world, 0).position.y == runs_state(world, 1).position.y && joined_get(world, 0).force[0] == 0.0f);
		runs_step(world, 12);
		assert_true(joined_get(world, 0).force[0] < 0.0f);
		carom_error error;
		const uint32_t other = 1;
		scenery_check(carom_world_remove(world, &other, 1, &error), &error);
		const carom_measure before = runs_measure(world);
		const double range = (double)RUNS_GRAVITY * (double)joined_info(world, 0).mass;
		for (int k = 0; k < 600; k++) {
			const carom_body_state state = runs_state(world, 0);
			const carom_measure now = runs_measure(world);
			assert_true(hypot((double)state.position.x, (double)state.position.y) < 1.0 + 1e-5);
			runs_near(now.kinetic_energy + now.potential_energy, before.kinetic_energy + before.potential_energy, 2e-3 * range);
			runs_step(world, 1);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_spring_swings),
		cmocka_unit_test(a_spring_pendulum_keeps_its_energy),
		cmocka_unit_test(a_damper_damps),
		cmocka_unit_test(a_spring_too_stiff_for_the_step_comes_to_rest),
		cmocka_unit_test(short_steps_take_no_energy),
		cmocka_unit_test(a_rope_gets_tight_and_swings),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
