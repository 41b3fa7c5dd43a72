/* Joints, of the step contacts: what they hold stays where it belongs, and they neither take nor give energy. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined.h"

static double force_of(carom_world *world, size_t k)
{
	const carom_joint joint = joined_get(world, k);
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
			carom_world_def def = joined_free(RUNS_GRAVITY);
			carom_body_def bob = is_pin ? scenery_box((float)(r * sin(a)), (float)(-r * cos(a)), 0.0f, 0.0f, 0.2f, 1.0f)
										: scenery_circle((float)(r * sin(a)), (float)(-r * cos(a)), 0.0f, 0.0f, 0.1f);
			const carom_joint joint = is_pin ? joined_pin(0, CAROM_GROUND, 0.0f, 0.5f) : joined_rod(0, CAROM_GROUND, 0.0f, 0.0f);
			bob.angle = is_pin ? (float)a : 0.0f;
			carom_world *world = runs_world(&def, device, &bob, 1);
			if (!world)
				continue;
			joined_set(world, 1, &joint);
			carom_body_info info;
			carom_error error;
			scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
			const double begin = runs_energy(world), mass = (double)info.mass, range = (double)RUNS_GRAVITY * mass * r * (1.0 - cos(a));
			for (int swing = 1; swing <= 10; swing++) {
				runs_advance(world, period);
				assert_true(joined_slack(world) < 3e-6);
				runs_near(runs_energy(world), begin, 1e-3 * range * swing);
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
		carom_world_def def = joined_free(RUNS_GRAVITY);
		carom_body_def bodies[3] = {scenery_circle(0.0f, -1.0f, 0.0f, 0.0f, 0.2f), scenery_box(0.0f, -2.0f, 0.0f, 0.0f, 0.2f, 1.0f),
			scenery_circle(3.0f, 0.0f, 0.0f, 0.0f, 0.2f)};
		const carom_joint joints[3] = {
			joined_rod(0, CAROM_GROUND, 0.0f, 0.0f), joined_pin(1, 0, 0.0f, 0.5f), joined_pin(2, CAROM_GROUND, 0.0f, 0.0f)};
		carom_joint after[3];
		carom_error error;
		for (int i = 0; i < 3; i++)
			bodies[i].mass = (float)(i + 1);
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		joined_set(world, 3, joints);
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

/* A chain that turns like a stick goes on so: with tensions of 28 and 40 N, and neither its energy nor its angular momentum changes by a thousandth in 10 s. */
static void a_chain_that_turns_goes_on(void **unused)
{
	(void)unused;
	for (int of_rods = 0; of_rods < 2; of_rods++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = joined_chain(device, of_rods, 0.0f, 2.0f);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			for (int k = 0; k < 10; k++) {
				runs_step(world, 60);
				const carom_measure after = runs_measure(world);
				assert_true(joined_slack(world) < 1e-5);
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
			carom_world *world = joined_chain(device, of_rods, RUNS_GRAVITY, 0.0f);
			if (!world)
				continue;
			const double begin = runs_energy(world);
			double most = 0.0;
			for (int k = 0; k < 100; k++) {
				runs_step(world, 6);
				most = fmax(most, runs_energy(world) - begin);
				assert_true(joined_slack(world) < 0.1);
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
		carom_world *world = joined_chain(device, false, 0.0f, 20.0f);
		if (!world)
			continue;
		double before = runs_measure(world).kinetic_energy;
		for (int k = 0; k < 20; k++) {
			runs_step(world, 15);
			const double after = runs_measure(world).kinetic_energy;
			assert_true(after < 1.01 * before);
			before = after;
		}
		assert_true(joined_slack(world) < 0.05);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- What is joined, and what it touches */

enum { PLANKS = 8 };

/* Planks of 1 m between two posts that are 7.6 m apart, and a box on them. */
static carom_world *bridge(const scenery_device *device, float damping)
{
	carom_world_def def = joined_free(RUNS_GRAVITY);
	carom_body_def bodies[PLANKS + 3];
	carom_joint joints[PLANKS + 1];
	const carom_body_def plank = scenery_box(0.0f, -0.1f, 0.0f, 0.0f, 1.0f, 0.1f), post = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.4f);
	def.restitution = 0.0f;
	def.friction = 0.5f;
	def.linear_damping = def.angular_damping = damping;
	for (int i = 0; i < PLANKS; i++) {
		bodies[i] = plank;
		bodies[i].position.x = 0.95f * ((float)i - 3.5f);
		joints[i] = joined_pin((uint32_t)i, i > 0 ? i - 1 : PLANKS, -0.5f, 0.0f);
		joints[i].other_anchor = i > 0 ? (carom_vec2){0.5f, 0.0f} : (carom_vec2){0.2f, 0.0f};
	}
	joints[PLANKS] = joined_pin(PLANKS - 1, PLANKS + 1, 0.5f, 0.0f);
	joints[PLANKS].other_anchor = (carom_vec2){-0.2f, 0.0f};
	for (int side = 0; side < 2; side++) {
		bodies[PLANKS + side] = post;
		bodies[PLANKS + side].position.x = side ? 4.0f : -4.0f;
		bodies[PLANKS + side].is_static = true;
	}
	bodies[PLANKS + 2] = scenery_box(0.3f, 0.6f, 0.0f, 0.0f, 0.8f, 0.8f);
	carom_world *world = runs_world(&def, device, bodies, PLANKS + 3);
	if (world)
		joined_set(world, PLANKS + 1, joints);
	return world;
}

/* Its ends bear what it and the box weigh together, and the box lies on it. */
static void a_bridge_bears(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = bridge(device, 2.0f);
		carom_joint ends[PLANKS + 1];
		carom_error error;
		if (!world)
			continue;
		runs_step(world, 600);
		scenery_check(carom_world_get_joints(world, 0, PLANKS + 1, ends, &error), &error);
		runs_near((double)ends[0].force[1] + (double)ends[PLANKS].force[1], (PLANKS * 0.1 + 0.64) * (double)RUNS_GRAVITY, 0.2);
		for (uint32_t i = 0; i < PLANKS + 3; i++) {
			const carom_body_state state = runs_state(world, i);
			assert_true(fabsf(state.velocity.x) < 0.01f && fabsf(state.velocity.y) < 0.01f);
		}
		assert_true(joined_slack(world) < 1e-4);
		const float height = runs_state(world, PLANKS + 2).position.y;
		assert_true(height < 0.2f && height > -1.5f);
		assert_true(runs_measure(world).max_penetration < 1e-3); /* joined planks overlap, and do not count */
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A bar that turns about a post in which it is goes on, unless the two collide; and once they are joined no more it flies away. */
static void the_joined_pass_each_other(void **unused)
{
	(void)unused;
	for (int collides = 0; collides < 2; collides++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = joined_free(0.0f);
			carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.3f, 0.3f), scenery_box(0.5f, 0.0f, 0.0f, 0.5f, 1.0f, 0.1f)};
			carom_joint joint = joined_pin(1, 0, -0.5f, 0.0f);
			bodies[0].is_static = true;
			bodies[1].angular_velocity = 1.0f;
			joint.collides = collides;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			joined_set(world, 1, &joint);
			const uint64_t hits = runs_step(world, 60).hits;
			assert_true((hits > 0) == collides);
			if (!collides)
				runs_near((double)runs_state(world, 1).angle, 1.0, 1e-3);
			joined_set(world, 0, NULL);
			assert_int_equal(carom_world_joint_count(world), 0);
			runs_step(world, 60);
			const carom_vec2 away = runs_state(world, 1).position;
			assert_true(collides || hypotf(away.x, away.y) > 0.6f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What is joined with a kinematic body goes where that takes it, and pulls along what is joined with it. */
static void the_kinematic_leads(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(0.0f);
		carom_body_def bodies[3] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.2f), scenery_circle(1.0f, 0.0f, 0.0f, 0.0f, 0.2f),
			scenery_box(2.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f)};
		carom_joint joints[2] = {joined_rod(1, 0, 0.0f, 0.0f), joined_pin(2, 1, -0.5f, 0.0f)};
		bodies[0].is_kinematic = true;
		bodies[0].velocity.x = -2.0f;
		def.linear_damping = def.angular_damping = 1.0f;
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		joints[1].other_anchor = (carom_vec2){1.0f, 0.0f};
		joined_set(world, 2, joints);
		runs_step(world, 120);
		runs_near((double)runs_state(world, 0).position.x, -4.0, 1e-4);
		runs_near((double)runs_state(world, 1).position.x, -3.0, 1e-4);
		runs_near((double)runs_state(world, 2).position.x, -1.5, 1e-4);
		assert_true(joined_slack(world) < 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

enum { MOST_IN_A_ROW = 40 };

/* A ball that hits a dumbbell along its rod hits both: of three equal masses one comes back with a third of its speed, as theory says, and no energy is lost; nor from the side, which sets it
 * spinning, nor by a chain, and of what a row of 40 gets hardly any. The hit that is kept has all of the impulse. */
static void a_hit_goes_through_a_rod(void **unused)
{
	static const struct {
		uint32_t count;
		float y;
		double lost; /* J, of 4.5 */
	} cases[] = {{2, 0.0f, 1e-3}, {2, 0.4f, 1e-3}, {5, 0.3f, 1e-3}, {MOST_IN_A_ROW, 0.0f, 3e-3}};
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const uint32_t n = cases[i].count;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = joined_free(0.0f);
			carom_body_def bodies[MOST_IN_A_ROW + 1];
			carom_joint joints[MOST_IN_A_ROW];
			def.keep_hits = true;
			for (uint32_t k = 0; k <= n; k++) {
				bodies[k] = k < n ? scenery_circle(1.5f * (float)k, 0.0f, 0.0f, 0.0f, 0.5f) : scenery_circle(-2.0f, cases[i].y, 3.0f, 0.0f, 0.5f);
				bodies[k].mass = 1.0f;
				if (k > 0 && k < n)
					joints[k] = joined_rod(k, (int32_t)k - 1, 0.0f, 0.0f);
			}
			carom_world *world = runs_world(&def, device, bodies, n + 1);
			if (!world)
				continue;
			joined_set(world, n - 1, joints + 1);
			const carom_measure before = runs_measure(world);
			assert_int_equal(runs_advance(world, 0.5).hits, 1);
			size_t count;
			carom_hit *hits = runs_hits(world, &count);
			const carom_measure after = runs_measure(world);
			const carom_body_state ball = runs_state(world, n);
			assert_int_equal(count, 1);
			runs_near((double)hits->impulse.x, (double)ball.velocity.x - 3.0, 1e-4);
			runs_near((double)hits->impulse.y, (double)ball.velocity.y, 1e-4);
			free(hits);
			runs_near(after.kinetic_energy, before.kinetic_energy, cases[i].lost);
			runs_near(after.momentum_x, before.momentum_x, 1e-5);
			runs_near(after.angular_momentum, before.angular_momentum, 1e-4);
			if (n == 2 && cases[i].y == 0.0f)
				runs_near((double)ball.velocity.x, -1.0, 1e-4);
			assert_true(joined_slack(world) < 1e-5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Two boxes on the ground with a rod between them come to rest and sleep; who pushes one wakes both, and so does who takes the rod away. */
static void what_is_joined_sleeps_together(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 20.0f, 10.0f);
		carom_body_def bodies[2] = {scenery_box(0.0f, 0.6f, 0.5f, 0.0f, 1.0f, 1.0f), scenery_box(3.0f, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f)};
		const carom_joint joint = joined_rod(1, 0, 0.0f, 0.0f);
		def.friction = 0.5f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		joined_set(world, 1, &joint);
		runs_step(world, 240);
		const uint64_t hash = runs_hash(world);
		runs_step(world, 60);
		assert_true(runs_hash(world) == hash);
		carom_body_state state = runs_state(world, 0);
		const float before = runs_state(world, 1).position.x;
		carom_error error;
		state.velocity.x = 3.0f;
		scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
		runs_step(world, 30);
		assert_true(runs_state(world, 1).position.x > before + 0.1f);
		assert_true(joined_slack(world) < 1e-4);
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
		cmocka_unit_test(a_bridge_bears),
		cmocka_unit_test(the_joined_pass_each_other),
		cmocka_unit_test(the_kinematic_leads),
		cmocka_unit_test(a_hit_goes_through_a_rod),
		cmocka_unit_test(what_is_joined_sleeps_together),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
