/* Bodies that move as their velocities say, and push what lies in their way. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "runs.h"

static const char *const steps[] = {"first_impact", "events", "contacts"};
enum { STEPS = sizeof steps / sizeof *steps };

static carom_body_def paddle(float x, float y, float vx, float vy, float width, float height)
{
	carom_body_def def = scenery_box(x, y, vx, vy, width, height);
	def.is_kinematic = true;
	return def;
}

/* A ball at rest gets (1 + restitution) times the paddle's speed, at the exact time; the paddle goes on. */
static void a_paddle_hits_a_ball(void **unused)
{
	(void)unused;
	for (int i = 0; i < 2 * STEPS; i++) {
		const float restitution = i < STEPS ? 1.0f : 0.5f;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_def();
			const carom_body_def bodies[2] = {scenery_circle(0.0f, 0.25f, 0.0f, 0.0f, 0.5f), paddle(-3.0f, 0.0f, 1.5f, 0.0f, 0.2f, 4.0f)};
			size_t count;
			def.restitution = restitution;
			def.keep_hits = true;
			def.pipeline.step = steps[i % STEPS];
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			assert_int_equal(runs_advance(world, 3.0).hits, 1);
			carom_hit *hits = runs_hits(world, &count);
			assert_true(count == 1 && hits->body == 1 && hits->other == 0);
			runs_near(hits->time, 1.6, 1e-5);
			free(hits);
			const carom_body_state ball = runs_state(world, 0), driven = runs_state(world, 1);
			runs_near((double)ball.velocity.x, 1.5 * (1.0 + (double)restitution), 1e-6);
			runs_near((double)ball.position.x, 1.4 * 1.5 * (1.0 + (double)restitution), 1e-4);
			assert_true(driven.velocity.x == 1.5f && driven.velocity.y == 0.0f && driven.angular_velocity == 0.0f);
			runs_near((double)driven.position.x, 1.5, 1e-5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A rod that turns gives a ball (1 + restitution) times the speed of the point that hits it. */
static void a_rod_turns(void **unused)
{
	const double thick = 0.1, radius = 0.25, x = 1.5, y = 1.0, above = thick / 2 + radius, along = sqrt(x * x + y * y - above * above);
	const double time = (atan2(y, x) - atan2(above, along)) / 2.0;
	(void)unused;
	for (int i = 0; i < STEPS; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_def();
			carom_body_def bodies[2] = {
				paddle(0.0f, 0.0f, 0.0f, 0.0f, 5.0f, (float)thick), scenery_circle((float)x, (float)y, 0.0f, 0.0f, (float)radius)};
			def.restitution = 0.5f;
			bodies[0].angular_velocity = 2.0f;
			def.pipeline.step = steps[i];
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			assert_int_equal(runs_advance(world, 0.5).hits, 1);
			const carom_body_state ball = runs_state(world, 1);
			const double speed = 1.5 * 2.0 * along, angle = 2.0 * time + 1.5707963267948966; /* the way that the rod's face goes */
			runs_near((double)ball.velocity.x, speed * cos(angle), 2e-5);
			runs_near((double)ball.velocity.y, speed * sin(angle), 2e-5);
			runs_near((double)ball.position.x, x + (0.5 - time) * speed * cos(angle), 2e-5);
			runs_near((double)runs_state(world, 0).angle, 1.0, 1e-5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Between a wall and a piston that comes a ball gets faster by twice the piston's speed with each hit. */
static void a_piston_presses(void **unused)
{
	const double from = 4.0, speed = 0.5, end = 5.0, radius = 0.1;
	double x = 0.5, v = 2.0, time = 0.0; /* of the ball, from the wall */
	uint64_t expected = 0;
	(void)unused;
	for (;;) { /* to the piston, and to the wall */
		const double meet = v > 0.0 ? (from - speed * time - radius - x) / (v + speed) : (x - radius) / -v;
		if (time + meet > end) {
			x += v * (end - time);
			break;
		}
		time += meet;
		x += v * meet;
		v = v > 0.0 ? -v - 2.0 * speed : -v;
		expected++;
	}
	for (int i = 0; i < STEPS; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_room(2.0f, 2.0f);
			const carom_body_def bodies[2] = {
				scenery_circle(-1.5f, 0.0f, 2.0f, 0.0f, (float)radius), paddle(-2.0f + (float)from + 0.25f, 0.0f, -(float)speed, 0.0f, 0.5f, 3.0f)};
			def.pipeline.step = steps[i];
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			assert_int_equal(runs_advance(world, end).hits, expected);
			runs_near((double)runs_state(world, 0).velocity.x, v, 1e-5);
			runs_near((double)runs_state(world, 0).position.x, x - 2.0, 2e-4);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* By the step contacts what lies on a lift goes with it, without a hit once it slides no more. */
static void a_lift_carries(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 10.0f, 40.0f);
		const carom_body_def bodies[3] = {paddle(0.0f, 1.0f, 0.3f, 0.5f, 6.0f, 0.2f), scenery_box(-1.0f, 1.6001f, 0.0f, 0.5f, 1.0f, 1.0f),
			scenery_box(-1.0f, 2.6002f, 0.0f, 0.5f, 1.0f, 1.0f)};
		def.friction = 0.5f;
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		runs_advance(world, 1.0);
		assert_int_equal(runs_advance(world, 5.0).hits, 0);
		const carom_body_state lift = runs_state(world, 0);
		runs_near((double)lift.position.x, 1.8, 1e-4);
		runs_near((double)lift.position.y, 4.0, 1e-4);
		for (uint32_t k = 1; k <= 2; k++) {
			const carom_body_state box = runs_state(world, k);
			runs_near((double)(box.position.x - lift.position.x), -1.0 - 0.3 * 0.3 / (2.0 * 0.5 * (double)RUNS_GRAVITY), 2e-3); /* what it slides */
			runs_near((double)(box.position.y - lift.position.y), 0.6 + (double)(k - 1), 2e-3);
			runs_near((double)box.velocity.x, 0.3, 0.02);
			runs_near((double)box.velocity.y, 0.5, 0.02);
			runs_near((double)box.angle, 0.0, 1e-3);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A ball that is put on a belt slides until it rolls, with a third of the belt's speed. */
static void a_belt_rolls_a_ball(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 40.0f, 10.0f);
		const carom_body_def bodies[2] = {paddle(0.0f, 1.0f, 3.0f, 0.0f, 40.0f, 0.2f), scenery_circle(0.0f, 1.6f, 0.0f, 0.0f, 0.5f)};
		def.friction = 0.4f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_advance(world, 3.0);
		const carom_body_state ball = runs_state(world, 1);
		runs_near((double)ball.velocity.x, 1.0, 0.01);
		runs_near((double)ball.angular_velocity, 2.0 / 0.5, 0.04);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Nothing holds it: no static body, no other kinematic one, no wall. And where it is then it goes on from, when the state is written and read. */
static void nothing_holds_it(void **unused)
{
	(void)unused;
	for (int i = 0; i < STEPS; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_room(2.0f, 2.0f);
			carom_body_def bodies[3] = {paddle(0.0f, 0.0f, 3.0f, 0.0f, 0.5f, 0.5f), paddle(1.0f, 0.0f, -3.0f, 0.0f, 0.5f, 0.5f),
				scenery_box(0.5f, 0.0f, 0.0f, 0.0f, 0.5f, 2.0f)};
			char *text = NULL;
			size_t length = 0;
			carom_scene *scene = NULL;
			carom_error error;
			bodies[2].is_static = true;
			def.pipeline.step = steps[i];
			carom_world *world = runs_world(&def, device, bodies, 3);
			if (!world)
				continue;
			assert_int_equal(runs_advance(world, 2.0).hits, 0);
			runs_near((double)runs_state(world, 0).position.x, 6.0, 1e-4);
			runs_near((double)runs_state(world, 1).position.x, -5.0, 1e-4);
			assert_true(runs_measure(world).kinetic_energy == 0.0 && runs_measure(world).max_penetration == 0.0);
			scenery_check(carom_scene_text_create(world, NULL, &text, &length, &error), &error);
			scenery_check(carom_scene_parse(text, length, NULL, &scene, &error), &error);
			carom_scene_text_destroy(text);
			carom_world *again = runs_scene(scene, device);
			runs_same_hash(&first, runs_hash(world), device);
			assert_int_equal(runs_hash(again), runs_hash(world));
			runs_advance(world, 1.0);
			runs_advance(again, 1.0);
			assert_int_equal(runs_hash(again), runs_hash(world));
			carom_world_destroy(again);
			carom_world_destroy(world);
		}
	}
}

/* Its velocity is what it was given last: here it goes to and fro, and a box on it goes with it. */
static void it_can_be_steered(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 10.0f, 40.0f);
		const carom_body_def bodies[2] = {paddle(0.0f, 1.0f, 0.0f, 0.0f, 6.0f, 0.2f), scenery_box(0.0f, 1.6001f, 0.0f, 0.0f, 1.0f, 1.0f)};
		carom_error error;
		def.friction = 0.5f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		for (int step = 0; step < 120; step++) {
			carom_body_state state = runs_state(world, 0);
			state.velocity = (carom_vec2){
				0.5f * sinf((float)step * 0.05f), 0.5f * sinf((float)step * 0.1f)}; /* at most 1.5 and 3 m/s^2: it neither slides nor jumps */
			scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
			runs_step(world, 1);
			const carom_body_state box = runs_state(world, 1);
			runs_near((double)box.position.x, (double)runs_state(world, 0).position.x, 0.02);
			runs_near((double)box.position.y, (double)runs_state(world, 0).position.y + 0.6, 0.02);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* What has no room to go is passed through, after bounded work. */
static void what_is_squeezed_is_passed(void **unused)
{
	enum { PRESSED = 3, LASTS = 120, EVENTS_MOST = 4097 };
	(void)unused;
	for (int i = 0; i < 4; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting(steps[1 + i % 2], 4.0f, 4.0f);
			const carom_body_def bodies[PRESSED + 1] = {scenery_circle(0.0f, 0.5f, 0.0f, 0.0f, 0.5f), scenery_box(0.0f, 1.5f, 0.0f, 0.0f, 1.0f, 1.0f),
				scenery_circle(1.5f, 0.5f, 0.0f, 0.0f, 0.5f), paddle(0.0f, 3.5f, 0.0f, -2.0f, 8.0f, 1.0f)};
			def.friction = i < 2 ? 0.0f : 0.5f;
			carom_world *world = runs_world(&def, device, bodies, PRESSED + 1);
			if (!world)
				continue;
			const uint64_t hits = runs_step(world, LASTS).hits;
			if (device == scenery_devices)
				print_message("%s, friction %g: %llu hits\n", steps[1 + i % 2], (double)def.friction, (unsigned long long)hits);
			assert_true(hits <= (uint64_t)PRESSED * LASTS * EVENTS_MOST);
			for (uint32_t k = 0; k < PRESSED; k++) {
				const carom_body_state body = runs_state(world, k);
				assert_true(fabsf(body.position.x) < 4.0f && body.position.y > 0.0f && body.position.y < 4.0f);
			}
			runs_near((double)runs_state(world, PRESSED).position.y, -0.5, 1e-4);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Of crowds in which some are driven all devices have the same hits, field by field. */
static void crowds_have_one_outcome(void **unused)
{
	enum { COUNT = 49 };
	(void)unused;
	for (int i = 0; i < 6; i++) {
		carom_hit *expected = NULL;
		size_t expected_count = 0;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting(steps[i % STEPS], 5.0f, 12.0f);
			carom_body_def bodies[COUNT];
			scenery_random random = {(uint64_t)i + 1};
			size_t count;
			def.friction = i < STEPS ? 0.0f : 0.4f;
			def.keep_hits = true;
			scenery_bodies(&random, SCENERY_MIXED, COUNT, 1.2f, 3.0f, bodies);
			scenery_drive(&random, COUNT, 2.0f, bodies);
			for (int k = 0; k < COUNT; k++)
				bodies[k].position.y += 5.0f;
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			runs_step(world, runs_affordable(100));
			carom_hit *hits = runs_hits(world, &count);
			if (device == scenery_devices) {
				print_message("%s: %zu hits\n", steps[i % STEPS], count);
				runs_enough(count > 90);
			}
			runs_same_hits(&expected, &expected_count, hits, count);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
		free(expected);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_paddle_hits_a_ball), cmocka_unit_test(a_rod_turns), cmocka_unit_test(a_piston_presses),
		cmocka_unit_test(a_lift_carries), cmocka_unit_test(a_belt_rolls_a_ball), cmocka_unit_test(nothing_holds_it),
		cmocka_unit_test(it_can_be_steered), cmocka_unit_test(what_is_squeezed_is_passed), cmocka_unit_test(crowds_have_one_outcome)};
	return cmocka_run_group_tests_name("kinematic", tests, NULL, NULL);
}
