/* Rolling friction: what stops a ball that rolls, by the step contacts. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runs.h"

/* A plane that leans by that angle: the way of gravity is another one. */
static carom_world_def leaning(double angle, float rolling)
{
	carom_world_def def = runs_resting("contacts", 20.0f, 10.0f);
	def.gravity = (carom_vec2){RUNS_GRAVITY * (float)sin(angle), -RUNS_GRAVITY * (float)cos(angle)};
	def.friction = 0.5f;
	def.rolling_friction = rolling;
	return def;
}

static carom_body_def rolling_ball(float x, float y, float radius, float speed)
{
	carom_body_def ball = scenery_circle(x, y, speed, 0.0f, radius);
	ball.angular_velocity = -speed / radius;
	return ball;
}

/* A disc is slowed by 2/3 c g, so it gets as far as v^2 / (4/3 c g), and stays there: on a wall, on a box, whatever its size. */
static void a_ball_rolls_as_far_as_it_should(void **unused)
{
	static const struct {
		float radius, speed, rolling;
		bool on_box;
	} cases[] = {{0.5f, 1.0f, 0.05f, false}, {0.5f, 1.0f, 0.05f, true}, {0.1f, 2.0f, 0.1f, false}, {2.0f, 0.5f, 0.01f, false}};
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const float r = cases[i].radius;
			carom_world_def def = leaning(0.0, cases[i].rolling);
			carom_body_def bodies[2] = {
				rolling_ball(-3.0f, cases[i].on_box ? 1.0f + r : r, r, cases[i].speed), scenery_box(0.0f, 0.5f, 0.0f, 0.0f, 20.0f, 1.0f)};
			bodies[1].is_static = true;
			carom_world *world = runs_world(&def, device, bodies, cases[i].on_box ? 2 : 1);
			if (!world)
				continue;
			const double v = (double)cases[i].speed, slowed = (double)cases[i].rolling * RUNS_GRAVITY * 2.0 / 3.0;
			runs_advance(world, 0.5 * v / slowed);
			runs_near((double)runs_state(world, 0).velocity.x, 0.5 * v, 0.01 * v);
			runs_advance(world, 0.5 * v / slowed + 0.25);
			const carom_body_state after = runs_state(world, 0);
			runs_near((double)after.position.x, -3.0 + v * v / (2.0 * slowed), 0.01 * v * v / slowed);
			assert_true(after.velocity.x == 0.0f && after.velocity.y == 0.0f && after.angular_velocity == 0.0f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* On a plane that leans by less than the coefficient a ball stays where it is, to the bit; by more, it gets faster by 2/3 of what is left. */
static void a_ball_stays_where_it_is_not_too_steep(void **unused)
{
	static const double slopes[] = {0.04, 0.06, 0.1};
	const double rolling = 0.05, seconds = 2.0;
	(void)unused;
	for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const double angle = atan(slopes[i]), left = RUNS_GRAVITY * (sin(angle) - rolling * cos(angle)), a = left > 0.0 ? left * 2.0 / 3.0 : 0.0;
			carom_world_def def = leaning(angle, (float)rolling);
			carom_body_def ball = rolling_ball(-3.0f, 0.5f, 0.5f, 0.0f);
			carom_world *world = runs_world(&def, device, &ball, 1);
			if (!world)
				continue;
			runs_advance(world, seconds);
			const carom_body_state after = runs_state(world, 0);
			runs_near((double)after.position.x, -3.0 + 0.5 * a * seconds * seconds, 1e-3);
			runs_near((double)after.velocity.x, a * seconds, 2e-3);
			assert_true(left > 0.0 || after.velocity.x == 0.0f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Of two bodies the larger coefficient counts, and of two circles the smaller radius: on top of one that is fixed a ball stays, where it leans by less than their product. */
static void a_pair_takes_the_larger(void **unused)
{
	static const struct {
		float base, ball, slope; /* radii; how far it leans, as a part of the coefficient */
		float own, other;
		bool stays;
	} cases[] = {{2.0f, 0.5f, 0.8f, 0.1f, 0.0f, true}, {2.0f, 0.5f, 0.8f, 0.0f, 0.1f, true}, {2.0f, 0.5f, 1.2f, 0.1f, 0.1f, false},
		{0.25f, 0.5f, 0.4f, 0.1f, 0.0f, true}, {0.25f, 0.5f, 0.6f, 0.1f, 0.0f, false}, {2.0f, 0.5f, 0.1f, 0.0f, 0.0f, false}};
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const double angle = atan(0.1 * (double)cases[i].slope), far = (double)cases[i].base + (double)cases[i].ball;
			carom_world_def def = leaning(0.0, 0.0f);
			carom_body_def bodies[2] = {scenery_circle(0.0f, 5.0f, 0.0f, 0.0f, cases[i].base),
				scenery_circle((float)(far * sin(angle)), (float)(5.0 + far * cos(angle)), 0.0f, 0.0f, cases[i].ball)};
			bodies[0].is_static = true;
			bodies[0].rolling_friction = cases[i].other;
			bodies[1].rolling_friction = cases[i].own;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			runs_advance(world, 1.0);
			const carom_body_state after = runs_state(world, 1);
			if (cases[i].stays)
				assert_true(after.velocity.x == 0.0f && after.angular_velocity == 0.0f);
			else
				assert_true(after.velocity.x > 0.01f && after.angular_velocity < 0.0f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What stops one turns the other: a ball and the plank on which it rolls, on ground without friction, keep their momentum, and end at one speed. */
static void what_rolls_takes_along_what_it_is_on(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = leaning(0.0, 0.1f);
		carom_body_def bodies[2] = {scenery_box(0.0f, 0.25f, 0.0f, 0.0f, 6.0f, 0.5f), rolling_ball(-2.0f, 1.0f, 0.5f, 2.0f)};
		def.friction = 0.0f;
		bodies[0].friction = bodies[1].friction = 0.5f;
		bodies[0].mass = 3.0f;
		bodies[1].mass = 1.0f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_advance(world, 3.5);
		const carom_body_state plank = runs_state(world, 0), ball = runs_state(world, 1);
		runs_near(3.0 * (double)plank.velocity.x + (double)ball.velocity.x, 2.0, 1e-3);
		runs_near((double)ball.velocity.x, (double)plank.velocity.x, 1e-3);
		runs_near((double)ball.angular_velocity, 0.0, 1e-3);
		assert_true(ball.position.x - plank.position.x < 2.5f);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- Heaps */

enum { BALLS = 60, SIDES = 7 };

static void pour(scenery_random *random, carom_body_def *bodies)
{
	for (int i = 0; i < BALLS; i++)
		bodies[i] = scenery_circle(0.7f * (float)(i % 5 - 2) + scenery_uniform(random, -0.05f, 0.05f), 0.5f + 0.7f * (float)(i / 5), 0.0f, 0.0f,
			scenery_uniform(random, 0.15f, 0.3f));
}

/* Balls that are poured where no wall holds them all lie in the end, in a heap; without rolling friction some roll on. */
static void balls_that_are_poured_come_to_rest(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		scenery_random random = {7};
		carom_world_def def = leaning(0.0, 0.1f);
		carom_body_def bodies[BALLS];
		uint32_t moving = 0, high = 0;
		pour(&random, bodies);
		carom_world *world = runs_world(&def, device, bodies, BALLS);
		if (!world)
			continue;
		runs_step(world, 900);
		const uint64_t hash = runs_hash(world);
		for (uint32_t i = 0; i < BALLS; i++) {
			const carom_body_state state = runs_state(world, i);
			moving += state.velocity.x != 0.0f || state.velocity.y != 0.0f || state.angular_velocity != 0.0f;
			high += state.position.y > 0.6f;
		}
		assert_int_equal(moving, 0);
		assert_true(high > BALLS / 8);
		assert_true(runs_measure(world).max_penetration < 1e-4);
		runs_step(world, 60);
		assert_true(runs_hash(world) == hash);
		runs_same_hash(&first, hash, device);
		carom_world_destroy(world);
	}
}

/* The forces are a part of the state: who goes on with what was written goes on with the same bits. */
static void what_is_written_goes_on(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		scenery_random random = {9};
		carom_world_def def = leaning(0.02, 0.125f);
		carom_body_def bodies[BALLS];
		carom_error error;
		carom_scene *scene = NULL;
		char *text = NULL;
		size_t length = 0;
		pour(&random, bodies);
		bodies[3].rolling_friction = 0.25f;
		carom_world *world = runs_world(&def, device, bodies, BALLS), *other;
		if (!world)
			continue;
		runs_step(world, 150);
		scenery_check(carom_scene_text_create(world, NULL, &text, &length, &error), &error);
		assert_non_null(strstr(text, "\"rolling_friction\": 0.125,"));
		assert_non_null(strstr(text, "\"rolling_friction\": 0.25"));
		scenery_check(carom_scene_parse(text, length, NULL, &scene, &error), &error);
		carom_scene_text_destroy(text);
		assert_true(scene->contact_count > BALLS / 2);
		scene->world.device = device->name;
		scene->world.storage = device->storage;
		scenery_check(carom_scene_create_world(scene, &other, &error), &error);
		carom_scene_destroy(scene);
		carom_body_info info;
		scenery_check(carom_world_get_body(other, 3, &info, &error), &error);
		assert_true(info.rolling_friction == 0.25f);
		runs_step(world, 30);
		runs_step(other, 30);
		assert_true(runs_hash(world) == runs_hash(other));
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* Polygons press at corners, and have no rolling friction: not a bit is another. */
static void polygons_do_not_mind(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		uint64_t hashes[2] = {0};
		for (int k = 0; k < 2; k++) {
			carom_world_def def = leaning(0.05, k ? 0.5f : 0.0f);
			carom_body_def bodies[SIDES];
			for (int i = 0; i < SIDES; i++) {
				bodies[i] = scenery_circle((float)i - 3.0f, 0.6f, 0.5f, 0.0f, 0.5f);
				bodies[i].shape = CAROM_REGULAR;
				bodies[i].sides = (uint32_t)(3 + i);
			}
			carom_world *world = runs_world(&def, device, bodies, SIDES);
			if (world)
				hashes[k] = runs_hash_after(world, 90, 1);
		}
		assert_true(hashes[0] == hashes[1]);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_ball_rolls_as_far_as_it_should),
		cmocka_unit_test(a_ball_stays_where_it_is_not_too_steep),
		cmocka_unit_test(a_pair_takes_the_larger),
		cmocka_unit_test(what_rolls_takes_along_what_it_is_on),
		cmocka_unit_test(balls_that_are_poured_come_to_rest),
		cmocka_unit_test(what_is_written_goes_on),
		cmocka_unit_test(polygons_do_not_mind),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
