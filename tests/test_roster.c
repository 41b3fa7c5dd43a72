/* Bodies that come and go while the others go on: few of them have nothing loaded anew, and the bits are those of a world that is loaded anew. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "count.h"
#include "runs.h"
#include "world.h"

enum { STEPS = 40, IDLE = 80 };

/* How often all bodies were loaded. */
static uint64_t loads(carom_world *world)
{
	carom_kernel_time time;
	for (size_t i = 0; carom_world_profile(world, i, &time); i++)
		if (strcmp(time.kernel, "slots_load") == 0)
			return time.launches;
	fail_msg("no kernel loads bodies");
	return 0;
}

static uint32_t add(carom_world *world, const carom_body_def *def)
{
	uint32_t index;
	carom_error error;
	scenery_check(carom_world_add(world, def, 1, &index, &error), &error);
	return index;
}

static void take_away(carom_world *world, const uint32_t *indices, size_t count)
{
	carom_error error;
	scenery_check(carom_world_remove(world, indices, count, &error), &error);
}

/* Filtered where the step is events. */
static carom_world *crowd(const scenery_device *device, const char *step)
{
	return runs_crowd(device, step, strcmp(step, "events") == 0);
}

/* On its own spot, where nothing else is, of those that have not been used: of any shape and any kind. */
static void come(carom_world *world, scenery_random *random, int spot)
{
	const carom_vec2 own[3] = {{0.5f, 0.0f}, {scenery_uniform(random, -0.4f, 0.4f), 0.4f}, {-0.5f, scenery_uniform(random, -0.3f, 0.3f)}};
	carom_body_def def = scenery_circle(16.0f + 1.2f * (float)(spot % 20), -12.0f + 1.2f * (float)(spot / 20), scenery_uniform(random, -20.0f, 20.0f),
		scenery_uniform(random, -20.0f, 20.0f), 0.45f);
	carom_body_state state = {.position = def.position, .velocity = {-def.velocity.x, 3.0f}, .angle = 1.0f};
	carom_error error;
	def.angular_velocity = scenery_uniform(random, -5.0f, 5.0f);
	def.shape = spot % 5 == 4 ? CAROM_POLYGON : spot % 2 ? CAROM_REGULAR : CAROM_CIRCLE;
	def.sides = 3 + (uint32_t)spot % 4;
	def.vertices = own;
	def.vertex_count = COUNT(own);
	if (spot % 3 == 0 && strcmp(carom_pipeline_get(&carom_world_get_def(world)->pipeline, "step"), "events") == 0)
		scenery_filter(random, &def);
	def.is_kinematic = spot % 11 == 3;
	if (spot % 11 == 5) {
		def.is_static = true;
		def.velocity = (carom_vec2){0.0f, 0.0f};
		def.angular_velocity = 0.0f;
	}
	const uint32_t index = add(world, &def);
	if (spot % 11 == 6) /* before the device knows of it */
		scenery_check(carom_world_set_states(world, index, 1, &state, &error), &error);
	if (spot % 11 == 8)
		scenery_check(carom_world_set_force(world, index, (carom_vec2){-20.0f, 30.0f}, 1.0f, &error), &error);
}

/* Some, in any order. */
static void go(carom_world *world, scenery_random *random, size_t count)
{
	uint32_t gone[8], k = 0;
	while (k < count) {
		bool is_new = true;
		gone[k] = (uint32_t)scenery_uniform(random, 0.0f, (float)carom_world_body_count(world));
		for (uint32_t i = 0; i < k; i++)
			is_new = is_new && gone[i] != gone[k];
		k += is_new;
	}
	take_away(world, gone, count);
}

/* One that stays is steered before others come or go. */
static void steer(carom_world *world, scenery_random *random)
{
	const uint32_t index = (uint32_t)scenery_uniform(random, 0.0f, (float)carom_world_body_count(world));
	carom_body_state state = runs_state(world, index);
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	if (info.is_static || info.is_kinematic)
		return;
	state.velocity.y = 12.0f;
	scenery_check(carom_world_set_states(world, index, 1, &state, &error), &error);
}

static void come_and_go(carom_world *world, scenery_random *random, int step, int *spot)
{
	static const size_t gone[] = {1, 0, 5, 2}, added[] = {3, 1, 0, 2, 1};
	carom_error error;
	steer(world, random);
	if (step % 3 == 0)
		go(world, random, gone[step % 4]);
	for (size_t k = 0; k < added[step % 5]; k++)
		come(world, random, (*spot)++);
	if (step % 3 != 0)
		go(world, random, gone[step % 4]);
	if (step % 13 == 7) /* by which each body's own force is looked for */
		scenery_check(carom_world_set_gravity(world, (carom_vec2){0.2f * (float)step, -9.0f}, &error), &error);
}

static void they_come_and_go_as_if_loaded_anew(void **unused)
{
	static const char *const steps[] = {"events", "contacts"};
	(void)unused;
	for (size_t i = 0; i < COUNT(steps); i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			for (int anew = 0; anew < 2; anew++) {
				carom_world *world = crowd(device, steps[i]);
				scenery_random random = {5};
				int spot = 0;
				for (int step = 0; world && step < STEPS; step++) {
					come_and_go(world, &random, step, &spot);
					if (anew)
						runs_load_anew(world);
					runs_step(world, 1 + (uint64_t)(step % 2));
				}
				if (!world)
					continue;
				assert_true(anew ? loads(world) >= STEPS : loads(world) <= 4); /* new outlines need more room now and then */
				runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

/* Discs that do nothing, far away. */
static void add_idle(carom_world *world)
{
	for (int k = 0; k < IDLE; k++) {
		const carom_body_def def = scenery_circle(60.0f + 2.0f * (float)k, 0.5f, 0.0f, 0.0f, 0.5f);
		add(world, &def);
	}
}

/* What lay on it falls, and what comes is hit where it is, though neither was looked for when lists were made. */
static void what_was_borne_falls_on_what_has_come(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 300.0f, 50.0f);
		const carom_body_def tower[] = {
			scenery_box(0.0f, 0.5f, 0, 0, 1.0f, 1.0f), scenery_box(0.0f, 1.5f, 0, 0, 1.0f, 1.0f), scenery_box(0.0f, 2.5f, 0, 0, 1.0f, 1.0f)};
		const carom_body_def flat = scenery_box(0.0f, 0.125f, 0, 0, 4.0f, 0.25f);
		const uint32_t lowest = 0;
		def.restitution = 0.0f;
		def.profile = true;
		carom_world *world = runs_world(&def, device, tower, COUNT(tower));
		if (!world)
			continue;
		add_idle(world);
		runs_step(world, runs_affordable(60));
		runs_near((double)runs_state(world, 2).position.y, 2.5, 1e-3);
		take_away(world, &lowest, 1);
		const uint32_t last = add(world, &flat);
		runs_step(world, 90);
		runs_near((double)runs_state(world, last).position.y, 0.125, 1e-3);
		runs_near((double)runs_state(world, 0).position.y, 0.75, 1e-3);
		runs_near((double)runs_state(world, 1).position.y, 1.75, 1e-3);
		assert_int_equal(loads(world), 1);
		carom_world_destroy(world);
	}
}

/* Boxes that rest on the ground: one of them goes, one comes in its place, and now and then one is moved there: what
 * rests on what is known in the next step, as in a world that is loaded anew. */
static void what_rests_is_known_at_once(void **unused)
{
	enum { BOXES = 48, ROUNDS = 12 };
	uint64_t first = 0;
	size_t counts[ROUNDS] = {0};
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (int anew = 0; anew < 2; anew++) {
			carom_world_def def = runs_resting("contacts", 100.0f, 50.0f);
			carom_body_def boxes[BOXES];
			for (int k = 0; k < BOXES; k++)
				boxes[k] = scenery_box(-70.0f + 3.0f * (float)k, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f);
			carom_world *world = runs_world(&def, device, boxes, BOXES);
			for (uint32_t round = 0; world && round < ROUNDS; round++) {
				const uint32_t gone = 7 * round % BOXES;
				carom_body_state moved = runs_state(world, gone);
				size_t count;
				carom_error error;
				runs_step(world, 3);
				take_away(world, &gone, 1);
				if (round % 3 == 2) {
					scenery_check(carom_world_set_states(world, 5, 1, &moved, &error), &error);
					moved.position.y = 1.5f;
				}
				carom_body_def def_of_new = scenery_box(moved.position.x, moved.position.y, 0.0f, 0.0f, 1.0f, 1.0f);
				add(world, &def_of_new);
				if (anew)
					runs_load_anew(world);
				runs_step(world, 1);
				scenery_check(carom_world_contact_count(world, &count, &error), &error);
				counts[round] = counts[round] ? counts[round] : count;
				assert_int_equal(count, counts[round]);
				assert_in_range(count, BOXES - ROUNDS, BOXES);
			}
			if (world)
				runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

enum { AROUND = 8, WAYS = 8 };
#define STEP (1.0f / 64)

/* Turned by so many eighths. */
static carom_body_def turned(int way, float x, float y, float vx, float vy)
{
	const float angle = 0.3f + 0.785398f * (float)way, c = cosf(angle), s = sinf(angle);
	return scenery_circle(c * x - s * y, s * x + c * y, c * vx - s * vy, s * vx + c * vy, 0.1f);
}

/* A small disc on its way up, one that leaves it to the side, and others before it, which come towards it and pass through it, or which cross its way after a
 * step, and are gone before it is there: it has no hit. Which of them is in the last slot depends on where they are, and it is another one on each way. */
static carom_world *way_up(const scenery_device *device, int way, bool cross)
{
	carom_world_def def = runs_def();
	carom_body_def bodies[AROUND];
	def.time_step = STEP;
	bodies[0] = turned(way, 0.4f, 0.0f, 0.2f / STEP, 0.0f);
	bodies[1] = turned(way, 0.0f, 0.0f, 0.0f, 0.2f / STEP);
	for (int k = 2; k < AROUND; k++) {
		bodies[k] = cross ? turned(way, -0.5f, 0.2f + 0.25f * (float)k, 0.5f / STEP, 0.0f)
						  : turned(way, 0.0f, 0.5f + 0.01f * (float)k, 0.0f, -0.2f / STEP);
		bodies[k].mask = cross ? CAROM_MASK : 0;
	}
	carom_world *world = runs_world(&def, device, bodies, AROUND);
	if (world)
		assert_int_equal(runs_step(world, 1).hits, 0);
	return world;
}

/* The one to the side is gone: the other one, as it looks at all around it, finds nothing on its way. */
static void expect_no_hit(carom_world *world)
{
	const carom_body_state state = runs_state(world, 0);
	carom_error error;
	scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
	assert_int_equal(runs_step(world, 5).hits, 0);
	carom_world_destroy(world);
}

/* Not where the last slot's body has a slot now, nor where it was itself, nor what has come into the last slot since. */
static void a_slot_means_nothing_to_who_knew_the_one_before(void **unused)
{
	const uint32_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (int way = 0; way < WAYS; way++) {
			carom_world *world = way_up(device, way, false);
			carom_body_def one_more = turned(way, 0.0f, 0.8f, 0.0f, 0.0f);
			if (!world)
				continue;
			take_away(world, &first, 1);
			expect_no_hit(world);
			world = way_up(device, way, true);
			take_away(world, &first, 1);
			expect_no_hit(world);
			world = way_up(device, way, true);
			take_away(world, &first, 1);
			one_more.mask = 0;
			assert_int_equal(add(world, &one_more), AROUND - 1);
			expect_no_hit(world);
		}
	}
}

/* The textures are made for a power of two bodies, and not anew each time that there is one more or one fewer. */
static void at_the_edge_of_what_there_is_room_for(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		def.profile = true;
		carom_world *world = runs_world(&def, device, NULL, 0);
		const carom_body_def def_of_all = scenery_circle(-3.0f, 0.0f, 1.0f, 0.0f, 0.5f);
		if (!world)
			continue;
		for (int k = 0; k < 64; k++) {
			carom_body_def one = def_of_all;
			one.position.y = 2.0f * (float)k;
			add(world, &one);
		}
		for (int k = 0; k < 20; k++) {
			carom_body_def one = def_of_all;
			one.position = (carom_vec2){3.0f, 2.0f * (float)(k / 2)};
			runs_step(world, 1);
			if (k % 2) {
				const uint32_t last = 64;
				take_away(world, &last, 1);
			} else {
				assert_int_equal(add(world, &one), 64);
			}
		}
		assert_int_equal(carom_world_body_count(world), 64);
		assert_true(loads(world) <= 2);
		carom_world_destroy(world);
	}
}

/* It is refused by the next step, which leaves all as it was, and goes on without it. */
static void one_that_is_too_fast(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = crowd(device, "events"), *other = crowd(device, "events");
		const carom_body_def fast = scenery_circle(30.0f, 0.0f, 2e9f, 0.0f, 0.5f);
		carom_error error;
		if (!world)
			continue;
		runs_step(world, 3);
		runs_step(other, 3);
		const uint32_t index = add(world, &fast);
		assert_int_equal(carom_world_step(world, 1, NULL, &error), CAROM_LIMIT);
		assert_non_null(strstr(error.text, "body 300: its speed"));
		take_away(world, &index, 1);
		assert_true(runs_hash(world) == runs_hash(other));
		runs_step(world, 3);
		runs_step(other, 3);
		assert_true(runs_hash(world) == runs_hash(other));
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* One comes, and the one before goes, again and again: each has its own name, and vertices where it is a polygon. Returns the most bytes that there were of these. */
static size_t most_kept(carom_shape shape)
{
	carom_world *world = crowd(&scenery_devices[0], "events");
	scenery_random random = {3};
	size_t most = 0;
	runs_step(world, 1);
	for (int k = 0; k < 3000; k++) {
		char name[128];
		const carom_vec2 corners[] = {{0.5f, 0.0f}, {0.0f, scenery_uniform(&random, 0.3f, 0.5f)}, {-0.5f, 0.0f}};
		carom_body_def def = scenery_circle(30.0f, 0.0f, 0.0f, 0.0f, 0.5f);
		carom_body_info info;
		carom_error error;
		snprintf(name, sizeof name, "one that comes, and goes when the next one has come, for there is no end of them: number %d", k);
		def.shape = shape;
		def.vertices = corners;
		def.vertex_count = COUNT(corners);
		def.name = name;
		const uint32_t index = add(world, &def), before = index - 1;
		if (k > 0)
			take_away(world, &before, 1);
		scenery_check(carom_world_get_body(world, k > 0 ? before : index, &info, &error), &error);
		assert_string_equal(info.name, name);
		assert_true(shape == CAROM_CIRCLE || (info.vertex_count == 3 && info.vertices[1].y - info.vertices[0].y > 0.29f));
		most = world->vertices.used + world->names.used > most ? world->vertices.used + world->names.used : most;
		if (k % 500 == 0)
			runs_step(world, 1);
	}
	carom_world_destroy(world);
	return most;
}

static void the_gone_are_forgotten(void **unused)
{
	(void)unused;
	assert_in_range(most_kept(CAROM_CIRCLE), 65536, 2 * 65536);
	assert_in_range(most_kept(CAROM_POLYGON), 1, 2 * 65536); /* before that there is no room for the vertices */
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(they_come_and_go_as_if_loaded_anew), cmocka_unit_test(what_was_borne_falls_on_what_has_come),
		cmocka_unit_test(what_rests_is_known_at_once), cmocka_unit_test(a_slot_means_nothing_to_who_knew_the_one_before),
		cmocka_unit_test(at_the_edge_of_what_there_is_room_for), cmocka_unit_test(one_that_is_too_fast), cmocka_unit_test(the_gone_are_forgotten)};
	return cmocka_run_group_tests_name("roster", tests, NULL, NULL);
}
