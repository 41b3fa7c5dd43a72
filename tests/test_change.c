/* What is changed of a world while it lives: it goes on as one does that was made so.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runs.h"

enum { COUNT = 60 };

static const char *const steps[] = {"events", "contacts", "first_impact"};
enum { STEPS = sizeof steps / sizeof *steps };

/* Of bodies that fall, and rub. */
static carom_world *world_of(const char *step, const scenery_device *device)
{
	carom_body_def bodies[COUNT];
	carom_world_def def = runs_resting(step, 5.0f, 12.0f);
	scenery_random random = {5};
	char name[32];
	carom_world *world = scenery_world(&def, device);
	if (!world)
		return NULL;
	scenery_bodies(&random, SCENERY_MIXED, COUNT, 1.1f, 2.0f, bodies);
	for (int i = 0; i < COUNT; i++) {
		carom_error error;
		bodies[i].position.y += 5.5f;
		bodies[i].friction = i % 5 == 0 ? 0.5f : 0.0f;
		snprintf(name, sizeof name, "body %d", i);
		bodies[i].name = i % 3 == 0 ? name : NULL;
		bodies[i].categories = i % 7 == 0 ? 4 : CAROM_CATEGORIES;
		bodies[i].mask = i % 8 == 0 ? 3 : CAROM_MASK;
		scenery_check(carom_world_add(world, &bodies[i], 1, NULL, &error), &error);
	}
	return world;
}

/* One made from what the world is now. */
static carom_world *twin_of(carom_world *world, const scenery_device *device)
{
	carom_scene *scene;
	carom_world *twin;
	carom_error error;
	char *text;
	size_t length;
	scenery_check(carom_scene_text_create(world, NULL, &text, &length, &error), &error);
	scenery_check(carom_scene_parse(text, length, NULL, &scene, &error), &error);
	carom_scene_text_destroy(text);
	scene->world.device = device->name;
	scene->world.storage = device->storage;
	scenery_check(carom_scene_create_world(scene, &twin, &error), &error);
	carom_scene_destroy(scene);
	return twin;
}

static void assert_same_picture(carom_world *a, carom_world *b)
{
	enum { WIDTH = 160, HEIGHT = 120 };
	static uint8_t first[4 * WIDTH * HEIGHT], second[4 * WIDTH * HEIGHT];
	carom_render_def def = carom_default_render_def();
	carom_error error;
	def.width = WIDTH;
	def.height = HEIGHT;
	scenery_check(carom_world_render(a, &def, first, &error), &error);
	scenery_check(carom_world_render(b, &def, second, &error), &error);
	assert_memory_equal(first, second, sizeof first);
}

/* They look alike, and go on with the same bits. */
static void assert_twins(carom_world *world, const scenery_device *device)
{
	carom_world *twin = twin_of(world, device);
	assert_int_equal(carom_world_body_count(twin), carom_world_body_count(world));
	assert_same_picture(world, twin);
	for (int i = 0; i < 2; i++) {
		const carom_report report = runs_step(world, 5), other = runs_step(twin, 5);
		assert_memory_equal(&report, &other, sizeof report);
		assert_int_equal(runs_hash(world), runs_hash(twin));
	}
	carom_world_destroy(twin);
}

/* ---- Bodies go */

static bool is_gone(uint32_t index)
{
	return index % 4 == 1 || index == 0 || index == COUNT - 1;
}

static void others_stay_as_they_are(carom_world *world)
{
	carom_body_info before[COUNT], after;
	carom_body_state states[COUNT], state;
	uint32_t gone[COUNT], next = 0;
	char names[COUNT][32] = {""};
	size_t count = 0;
	carom_error error;
	scenery_check(carom_world_get_states(world, 0, COUNT, states, &error), &error);
	for (uint32_t i = 0; i < COUNT; i++) {
		scenery_check(carom_world_get_body(world, i, &before[i], &error), &error);
		snprintf(names[i], sizeof names[i], "%s", before[i].name ? before[i].name : "");
		if (is_gone(COUNT - 1 - i))
			gone[count++] = COUNT - 1 - i; /* in any order */
	}
	scenery_check(carom_world_remove(world, gone, count, &error), &error);
	assert_int_equal(carom_world_body_count(world), COUNT - count);
	for (uint32_t i = 0; i < COUNT; i++) {
		if (is_gone(i))
			continue;
		scenery_check(carom_world_get_body(world, next, &after, &error), &error);
		state = runs_state(world, next++);
		assert_memory_equal(&state, &states[i], sizeof state);
		assert_true(after.mass == before[i].mass && after.inertia == before[i].inertia && after.friction == before[i].friction
			&& after.categories == before[i].categories && after.mask == before[i].mask && after.is_static == before[i].is_static
			&& after.is_kinematic == before[i].is_kinematic && after.vertex_count == before[i].vertex_count && after.shape == before[i].shape);
		assert_string_equal(after.name ? after.name : "", names[i]);
	}
}

static void the_others_go_on(void **unused)
{
	(void)unused;
	for (size_t s = 0; s < STEPS; s++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(steps[s], device);
			if (!world)
				continue;
			runs_step(world, runs_affordable(40));
			others_stay_as_they_are(world);
			assert_twins(world, device);
			carom_world_destroy(world);
		}
	}
}

/* Also where others take the places of those that went, as many as before, and where the friction goes with them, or comes back. */
static void others_come_and_go(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of("contacts", device);
		carom_error error;
		if (!world)
			continue;
		for (uint32_t round = 0; round < 4; round++) {
			carom_body_def fresh = scenery_circle(0.0f, 11.0f, 0.0f, 0.0f, 0.4f);
			uint32_t gone[COUNT];
			size_t count = 0;
			runs_step(world, 5);
			assert_twins(world, device);
			for (uint32_t i = 0; i < carom_world_body_count(world); i++) {
				carom_body_info info;
				scenery_check(carom_world_get_body(world, i, &info, &error), &error);
				if (round == 1 ? info.friction > 0.0f : i % 7 == round)
					gone[count++] = i;
			}
			scenery_check(carom_world_remove(world, gone, count, &error), &error);
			assert_twins(world, device);
			fresh.shape = round % 2 ? CAROM_CIRCLE : CAROM_REGULAR;
			fresh.sides = 3 + round;
			fresh.friction = round == 2 ? 0.7f : 0.0f;
			for (size_t k = 0; k < count && k < 8; k++) {
				fresh.position.x = -4.0f + (float)k;
				scenery_check(carom_world_add(world, &fresh, 1, NULL, &error), &error);
			}
			assert_twins(world, device);
		}
		const uint32_t first = 0;
		const carom_body_def box = scenery_box(0.0f, 10.0f, 0.0f, 0.0f, 3.0f, 0.7f);
		scenery_check(carom_world_remove(world, &first, 1, &error), &error);
		scenery_check(carom_world_add(world, &box, 1, NULL, &error), &error);
		assert_twins(world, device);
		carom_world_destroy(world);
	}
}

static void all_may_go(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of("events", device);
		uint32_t all[COUNT];
		carom_error error;
		const carom_body_def ball = scenery_circle(0.0f, 5.0f, 0.0f, 0.0f, 0.5f);
		if (!world)
			continue;
		runs_step(world, 3);
		for (uint32_t i = 0; i < COUNT; i++)
			all[i] = i;
		scenery_check(carom_world_remove(world, all, COUNT, &error), &error);
		assert_int_equal(carom_world_body_count(world), 0);
		assert_int_equal(runs_step(world, 3).steps, 0);
		scenery_check(carom_world_add(world, &ball, 1, NULL, &error), &error);
		assert_int_equal(runs_step(world, 3).steps, 3);
		assert_twins(world, device);
		carom_world_destroy(world);
	}
}

static bool try_to_change(void *context, const carom_report *so_far)
{
	carom_world *world = context;
	const uint32_t first = 0;
	carom_error error;
	(void)so_far;
	assert_int_equal(carom_world_remove(world, &first, 1, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_set_gravity(world, (carom_vec2){0.0f, 1.0f}, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_set_filter(world, 0, 1, 2, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_set_time_step(world, 0.1f, &error), CAROM_INVALID_ARGUMENT);
	assert_non_null(strstr(error.text, "middle of a step"));
	return true;
}

static void what_is_wrong_changes_nothing(void **unused)
{
	(void)unused;
	const uint32_t beyond[] = {3, COUNT}, twice[] = {3, 4, 3};
	carom_world *world = world_of("events", &scenery_devices[0]);
	carom_error error;
	if (!world)
		return;
	runs_step(world, 5);
	const uint64_t hash = runs_hash(world);
	assert_int_equal(carom_world_remove(world, beyond, 2, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "indices[1]: found 60, the world has 60 bodies");
	assert_int_equal(carom_world_remove(world, twice, 3, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "indices[2]: body 3 is there twice");
	assert_int_equal(carom_world_remove(world, NULL, 0, &error), CAROM_OK);
	assert_int_equal(carom_world_set_filter(world, COUNT, 1, 2, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "bodies 60 to 61: the world has 60");
	assert_int_equal(carom_world_set_gravity(world, (carom_vec2){0.0f, 1.0f / 0.0f}, &error), CAROM_INVALID_ARGUMENT);
	assert_non_null(strstr(error.text, "gravity: "));
	assert_int_equal(carom_world_set_time_step(world, 0.0f, &error), CAROM_INVALID_ARGUMENT);
	assert_non_null(strstr(error.text, "time_step: "));
	assert_int_equal(carom_world_body_count(world), COUNT);
	assert_int_equal(runs_hash(world), hash);
	assert_twins(world, &scenery_devices[0]);
	carom_world_set_progress(world, try_to_change, world);
	runs_step(world, 2);
	carom_world_destroy(world);
}

/* ---- Gravity, the time step and filters */

static void gravity_time_step_and_filters_change(void **unused)
{
	(void)unused;
	for (size_t s = 0; s < STEPS; s++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(steps[s], device);
			carom_error error;
			if (!world)
				continue;
			runs_step(world, runs_affordable(20));
			scenery_check(carom_world_set_gravity(world, (carom_vec2){3.0f, 4.0f}, &error), &error);
			assert_true(carom_world_get_def(world)->gravity.x == 3.0f);
			assert_twins(world, device);
			scenery_check(carom_world_set_time_step(world, 0.004f, &error), &error);
			assert_true(carom_world_get_def(world)->time_step == 0.004f);
			assert_twins(world, device);
			for (uint32_t i = 0; i < COUNT; i += 3)
				scenery_check(carom_world_set_filter(world, i, 1 + i % 2, CAROM_MASK - i % 4, &error), &error);
			assert_twins(world, device);
			carom_world_destroy(world);
		}
	}
}

static void a_thrown_ball_turns_back(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const carom_body_def ball = scenery_circle(0.0f, 0.0f, 1.0f, 2.0f, 0.5f);
		const carom_world_def def = runs_def();
		carom_world *world = runs_world(&def, device, &ball, 1);
		carom_error error;
		if (!world)
			continue;
		runs_advance(world, 1.0);
		scenery_check(carom_world_set_gravity(world, (carom_vec2){0.0f, -4.0f}, &error), &error);
		scenery_check(carom_world_set_time_step(world, 0.125f, &error), &error);
		assert_int_equal(runs_advance(world, 1.0).steps, 8);
		const carom_body_state state = runs_state(world, 0);
		runs_near((double)state.position.x, 2.0, 1e-5);
		runs_near((double)state.position.y, 2.0, 1e-5);
		runs_near((double)state.velocity.y, -2.0, 1e-5);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(the_others_go_on), cmocka_unit_test(others_come_and_go), cmocka_unit_test(all_may_go),
		cmocka_unit_test(what_is_wrong_changes_nothing), cmocka_unit_test(gravity_time_step_and_filters_change),
		cmocka_unit_test(a_thrown_ball_turns_back)};
	return cmocka_run_group_tests_name("change", tests, NULL, NULL);
}
