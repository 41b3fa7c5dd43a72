/* What lies still, by the step contacts: bodies that rub come to rest, to the bit, and stay until something moves them; and what must move does. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "runs.h"

#define SIDE 6
#define PYRAMID (SIDE * (SIDE + 1) / 2)

static carom_body_def box_at(float x, float y)
{
	return scenery_box(x, y, 0.0f, 0.0f, 1.0f, 1.0f);
}

static carom_world_def ground(float friction)
{
	carom_world_def def = runs_resting("contacts", 200.0f, 100.0f);
	def.restitution = 0.0f;
	def.friction = friction;
	return def;
}

static bool is_at_rest(const carom_body_state *state)
{
	return state->velocity.x == 0.0f && state->velocity.y == 0.0f && state->angular_velocity == 0.0f;
}

static carom_world *pyramid(const scenery_device *device)
{
	carom_world_def def = ground(0.5f);
	carom_body_def boxes[PYRAMID];
	int k = 0;
	for (int row = 0; row < SIDE; row++)
		for (int column = 0; column < SIDE - row; column++)
			boxes[k++] = box_at(((float)column - 0.5f * (float)(SIDE - row - 1)) * 1.02f, 0.5005f + 1.0005f * (float)row);
	return runs_world(&def, device, boxes, PYRAMID);
}

/* A pyramid comes to rest, and then nothing changes, not in a bit; what hits it moves it again, and it comes to rest once more. */
static void a_pyramid_comes_to_rest(void **unused)
{
	uint64_t first = 0, later = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = pyramid(device);
		carom_body_state before[PYRAMID];
		carom_error error;
		if (!world)
			continue;
		runs_step(world, 240);
		for (uint32_t k = 0; k < PYRAMID; k++) {
			before[k] = runs_state(world, k);
			assert_true(is_at_rest(&before[k]));
		}
		runs_same_hash(&first, runs_hash(world), device);
		runs_step(world, 60);
		for (uint32_t k = 0; k < PYRAMID; k++) {
			const carom_body_state now = runs_state(world, k);
			assert_memory_equal(&now, &before[k], sizeof now);
		}
		before[PYRAMID - 1].velocity.x = 0.5f;
		scenery_check(carom_world_set_states(world, PYRAMID - 1, 1, &before[PYRAMID - 1], &error), &error);
		runs_step(world, 240);
		for (uint32_t k = 0; k < PYRAMID; k++) {
			const carom_body_state now = runs_state(world, k);
			assert_true(is_at_rest(&now));
			assert_true(k < PYRAMID - 1 || now.position.x > before[k].position.x + 0.01f);
		}
		runs_same_hash(&later, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Columns of boxes, quite upon each other and not, come to rest, each with its top where it was put. */
static void columns_come_to_rest(void **unused)
{
	enum { MOST = 10, COLUMNS = 6, COUNT = 45 };
	static const uint32_t heights[COLUMNS] = {3, 5, 8, 10, 10, 9};
	carom_body_def boxes[COUNT];
	uint32_t tops[COLUMNS], count = 0;
	uint64_t first = 0;
	(void)unused;
	for (uint32_t c = 0; c < COLUMNS; c++) {
		for (uint32_t k = 0; k < heights[c]; k++)
			boxes[count++] = box_at(4.0f * (float)c + (c % 2 ? 0.05f * (float)(k * 7 % 5) - 0.1f : 0.0f), 0.5005f + 1.0005f * (float)k);
		tops[c] = count - 1;
	}
	assert_int_equal(count, COUNT);
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = ground(0.5f);
		carom_world *world = runs_world(&def, device, boxes, COUNT);
		if (!world)
			continue;
		runs_step(world, 420);
		for (uint32_t k = 0; k < COUNT; k++) {
			const carom_body_state state = runs_state(world, k);
			assert_true(is_at_rest(&state));
		}
		/* steps that are cut short leave them as they are, to the bit */
		const uint64_t hash = runs_hash(world);
		for (int i = 0; i < 10; i++)
			runs_advance(world, 0.0171 + 0.0021 * (double)i);
		assert_true(runs_hash(world) == hash);
		for (uint32_t c = 0; c < COLUMNS; c++) {
			const carom_body_state state = runs_state(world, tops[c]);
			runs_near((double)state.position.x, (double)boxes[tops[c]].position.x, 0.02);
			runs_near((double)state.position.y, heights[c] - 0.5, 0.012);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* On ice what slides slowly, also two upon each other, is slowed by friction alone. */
static void what_slides_is_not_braked(void **unused)
{
	const double friction = 0.002, speed = 0.05, seconds = 1.0, g = (double)RUNS_GRAVITY;
	carom_body_def boxes[] = {box_at(0.0f, 0.5005f), box_at(4.0f, 0.5005f), box_at(4.0f, 1.501f)};
	uint64_t first = 0;
	(void)unused;
	for (int k = 0; k < 3; k++)
		boxes[k].velocity.x = (float)speed;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = ground((float)friction);
		carom_world *world = runs_world(&def, device, boxes, 3);
		if (!world)
			continue;
		runs_advance(world, seconds);
		for (uint32_t k = 0; k < 3; k++)
			runs_near((double)runs_state(world, k).velocity.x, speed - friction * g * seconds, 0.1 * friction * g * seconds);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* What friction holds by a hundredth lies still; what it fails to hold by a hundredth slides as Coulomb says, from rest on; a ball alone rolls away, however little the ground leans. */
static void what_is_not_held_starts(void **unused)
{
	const double friction = 0.5, g = (double)RUNS_GRAVITY, seconds = 5.0;
	static const double leans[] = {0.495, 0.505, 0.0001};
	(void)unused;
	for (int i = 0; i < 3; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = ground((float)friction);
			carom_body_def body = i < 2 ? box_at(0.0f, 0.5005f) : scenery_circle(0.0f, 0.5005f, 0.0f, 0.0f, 0.5f);
			carom_world *world = runs_world(&def, device, &body, 1);
			carom_error error;
			if (!world)
				continue;
			runs_step(world, 60);
			carom_body_state state = runs_state(world, 0);
			const double from = (double)state.position.x;
			assert_true(i == 2 || is_at_rest(&state));
			scenery_check(carom_world_set_gravity(world, (carom_vec2){(float)(leans[i] * g), (float)-g}, &error), &error);
			runs_advance(world, seconds);
			state = runs_state(world, 0);
			const double pull = i == 2 ? 2.0 / 3.0 * leans[i] : leans[i] - friction, way = (double)state.position.x - from;
			if (i == 0)
				assert_true(is_at_rest(&state) && fabs(way) < 1e-3);
			else
				runs_near(way, 0.5 * pull * g * seconds * seconds, 0.1 * pull * g * seconds * seconds);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Boxes upon each other on something kinematic ride with it, however slowly it goes, sideways and up. */
static void what_rides_goes_with_it(void **unused)
{
	const float speed = 0.001f;
	const double seconds = 10.0;
	(void)unused;
	for (int up = 0; up < 2; up++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			enum { COUNT = 4 };
			carom_world_def def = ground(0.5f);
			carom_body_def bodies[COUNT] = {scenery_box(0.0f, 2.0f, 0.0f, 0.0f, 10.0f, 1.0f)};
			carom_body_state before[COUNT];
			bodies[0].is_kinematic = true;
			bodies[0].velocity = (carom_vec2){up ? 0.0f : speed, up ? speed : 0.0f};
			for (int k = 1; k < COUNT; k++)
				bodies[k] = box_at(0.0f, 2.0005f + 1.0005f * (float)k);
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			runs_step(world, 120);
			for (uint32_t k = 0; k < COUNT; k++)
				before[k] = runs_state(world, k);
			runs_advance(world, seconds);
			for (uint32_t k = 0; k < COUNT; k++) {
				const carom_body_state now = runs_state(world, k);
				const double x = (double)(now.position.x - before[k].position.x), y = (double)(now.position.y - before[k].position.y);
				runs_near(up ? y : x, (double)speed * seconds, 5e-4);
				runs_near(up ? x : y, 0.0, 5e-4);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* ---- On what moves */

#define STORIES 5

/* A column on two kinematic boxes side by side, which meet at `seam`, and of which the second is so much faster than the first. */
static carom_world *column_on_lift(const scenery_device *device, float seam, carom_vec2 velocity, float faster)
{
	carom_world_def def = ground(0.5f);
	carom_body_def bodies[2 + STORIES];
	for (int k = 0; k < 2; k++) {
		bodies[k] = scenery_box(k ? seam + 2.0f : seam - 2.0f, 2.0f, velocity.x, velocity.y + (k ? faster : 0.0f), 4.0f, 1.0f);
		bodies[k].is_kinematic = true;
	}
	for (int k = 0; k < STORIES; k++) {
		bodies[2 + k] = box_at(0.02f * (float)(k % 2), 3.0005f + 1.0005f * (float)k);
		bodies[2 + k].velocity = velocity;
	}
	return runs_world(&def, device, bodies, 2 + STORIES);
}

static double farthest_from_lift(carom_world *world)
{
	const carom_vec2 lift = runs_state(world, 0).velocity;
	double most = 0.0;
	for (uint32_t k = 2; k < 2 + STORIES; k++) {
		const carom_body_state state = runs_state(world, k);
		most = fmax(most, fmax(fabs((double)state.velocity.x - (double)lift.x), fabs((double)state.velocity.y - (double)lift.y)));
		most = fmax(most, fabs((double)state.angular_velocity));
	}
	return most;
}

/* What stands on a lift goes with it, as still as on the ground but for what rounding makes, and comes to rest when it stops, or is carried on when that goes elsewhere. */
static void what_is_carried_is_still(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = column_on_lift(device, 0.0f, (carom_vec2){0.5f, 2.0f}, 0.0f);
		carom_body_state lift;
		carom_error error;
		if (!world)
			continue;
		runs_step(world, runs_affordable(180));
		runs_same_hash(&first, runs_hash(world), device);
		assert_true(runs_step(world, 30).hits == 0);
		runs_enough(farthest_from_lift(world) < 5e-3);
		for (uint32_t k = 0; k < 2; k++) {
			lift = runs_state(world, k);
			lift.velocity = (carom_vec2){0.0f, 0.0f};
			scenery_check(carom_world_set_states(world, k, 1, &lift, &error), &error);
		}
		runs_step(world, runs_affordable(240));
		runs_enough(farthest_from_lift(world) == 0.0);
		const uint64_t hash = runs_hash(world);
		runs_step(world, 10);
		runs_enough(runs_hash(world) == hash);
		carom_world_destroy(world);
	}
}

/* What one of the two lifts up while the other does not is not held. */
static void what_two_carry_apart_is_not_still(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = column_on_lift(device, 0.25f, (carom_vec2){0.0f, 0.0f}, 0.02f);
		if (!world)
			continue;
		runs_step(world, 60);
		assert_true(runs_state(world, 2).angle > 0.01f);
		carom_world_destroy(world);
	}
}

/* A ball alone rolls on, but not so slowly that devices differ in whether that is 0. */
static void what_is_hardly_a_number_is_none(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = ground(0.5f);
		carom_body_def balls[] = {scenery_circle(0.0f, 0.5f, 1e-25f, 0.0f, 0.5f), scenery_circle(3.0f, 0.5f, 1e-3f, 0.0f, 0.5f)};
		carom_world *world = runs_world(&def, device, balls, 2);
		if (!world)
			continue;
		runs_step(world, 10);
		assert_true(runs_state(world, 0).velocity.x == 0.0f && runs_state(world, 0).angular_velocity == 0.0f);
		assert_true(runs_state(world, 1).velocity.x > 5e-4f);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_hardly_a_number_is_none), cmocka_unit_test(a_pyramid_comes_to_rest),
		cmocka_unit_test(columns_come_to_rest), cmocka_unit_test(what_slides_is_not_braked), cmocka_unit_test(what_is_not_held_starts),
		cmocka_unit_test(what_rides_goes_with_it), cmocka_unit_test(what_is_carried_is_still), cmocka_unit_test(what_two_carry_apart_is_not_still)};
	return cmocka_run_group_tests_name("still", tests, NULL, NULL);
}
