/* Joints as a part of the state: written, read, removed with their bodies, and refused where something is wrong with them.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined.h"

enum { CROWD = 40 };

/* Bodies of all kinds in a room, each joined with one before it, or with the world. */
static carom_world *tangle(const scenery_device *device, uint64_t seed)
{
	carom_world_def def = runs_resting("contacts", 10.0f, 12.0f);
	carom_body_def bodies[CROWD];
	carom_joint joints[CROWD];
	scenery_random random = {seed};
	size_t count = 0;
	def.friction = 0.4f;
	scenery_bodies(&random, SCENERY_MIXED, CROWD, 1.4f, 2.0f, bodies);
	for (uint32_t i = 0; i < CROWD; i++) {
		bodies[i].position.y += 6.0f;
		const int32_t other = i % 7 == 0 ? CAROM_GROUND : (int32_t)(i - 1);
		if (bodies[i].is_static)
			continue;
		joints[count] = joined_pin(i, other, scenery_uniform(&random, -0.5f, 0.5f), 0.2f);
		if (i % 4 == 0) {
			joints[count].motor_speed = (float)(i % 3) - 1.0f;
			joints[count].motor_torque = 2.0f;
		}
		if (i % 6 < 3) {
			joints[count].has_stops = true;
			joints[count].lower_angle = -2.0f;
			joints[count].upper_angle = 1.5f;
		}
		if (i % 2) {
			joints[count].kind = i % 10 == 5 ? CAROM_ROPE : i % 10 == 9 ? CAROM_SPRING : CAROM_DISTANCE;
			joints[count].stiffness = i % 10 == 9 ? 50.0f : 0.0f;
			joints[count].damping = i % 10 == 9 ? 1.5f : 0.0f;
			joints[count].has_stops = false;
			joints[count].motor_torque = joints[count].motor_speed = 0.0f;
			joints[count].other_anchor = other == CAROM_GROUND ? (carom_vec2){0.0f, 11.0f} : (carom_vec2){0.1f, 0.0f};
		}
		if (i % 7 == 2 && joints[count].kind == CAROM_REVOLUTE) {
			joints[count].kind = CAROM_SLIDER;
			joints[count].axis = 0.75f;
		}
		joints[count].collides = i % 3 == 0;
		count++;
	}
	carom_world *world = runs_world(&def, device, bodies, CROWD);
	if (world)
		joined_set(world, count, joints);
	return world;
}

/* Who reads what was written goes on with the same bits: forces are a part of the state. */
static void what_is_written_goes_on(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = tangle(device, 3), *other;
		carom_scene *scene = NULL;
		carom_error error;
		char *text = NULL;
		size_t length = 0;
		if (!world)
			continue;
		runs_step(world, 40);
		scenery_check(carom_scene_text_create(world, NULL, &text, &length, &error), &error);
		assert_non_null(strstr(text, "{\"kind\": \"revolute\", "));
		assert_non_null(strstr(text, "\"collides\": true"));
		assert_non_null(strstr(text, "{\"kind\": \"rope\", "));
		assert_non_null(strstr(text, "\"stiffness\": 50, \"damping\": 1.5"));
		assert_non_null(strstr(text, "\"motor_torque\": 2"));
		assert_non_null(strstr(text, "{\"kind\": \"slider\", "));
		assert_non_null(strstr(text, "\"axis\": 0.75"));
		assert_non_null(strstr(text, "\"lower_angle\": -2, \"upper_angle\": 1.5"));
		scenery_check(carom_scene_parse(text, length, NULL, &scene, &error), &error);
		carom_scene_text_destroy(text);
		assert_int_equal(scene->joint_count, carom_world_joint_count(world));
		scene->world.device = device->name;
		scene->world.storage = device->storage;
		scenery_check(carom_scene_create_world(scene, &other, &error), &error);
		carom_scene_destroy(scene);
		runs_step(world, 30);
		runs_step(other, 30);
		assert_true(runs_hash(world) == runs_hash(other));
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* However many threads and calls, in images or buffers, the same bits. */
static void a_tangle_is_the_same_everywhere(void **unused)
{
	(void)unused;
	for (uint64_t seed = 1; seed <= 4; seed++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = tangle(device, seed);
			if (world)
				runs_same_hash(&first, runs_hash_after(world, 90, seed % 2 ? 1 : 9), device);
		}
	}
}

/* A body takes its joints with it; those of others stay, by their new indices, and the world goes on as one that is made so. */
static void who_goes_takes_its_joints(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		static const uint32_t gone[] = {4};
		carom_error error;
		carom_joint before[JOINED_LINKS], after[JOINED_LINKS];
		carom_world *world = joined_chain(device, false, RUNS_GRAVITY, 0.0f);
		if (!world)
			continue;
		runs_step(world, 20);
		scenery_check(carom_world_get_joints(world, 0, JOINED_LINKS, before, &error), &error);
		scenery_check(carom_world_remove(world, gone, 1, &error), &error);
		assert_int_equal(carom_world_joint_count(world), JOINED_LINKS - 2);
		scenery_check(carom_world_get_joints(world, 0, JOINED_LINKS - 2, after, &error), &error);
		assert_true(after[3].body == 3 && after[3].other == 2 && after[4].body == 5 && after[4].other == 4);
		assert_memory_equal(after[4].force, before[6].force, sizeof after[4].force);
		runs_step(world, 60);
		assert_true(joined_slack(world) < 1e-3);
		assert_true(runs_state(world, 8).position.y < -5.0f); /* what hung on it falls */
		const carom_body_def more = scenery_circle(20.0f, 0.0f, 0.0f, 0.0f, 0.5f);
		scenery_check(carom_world_add(world, &more, 1, NULL, &error), &error);
		runs_step(world, 10);
		assert_true(joined_slack(world) < 1e-3);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

enum { WIDTH = 160, HEIGHT = 120 };

static uint64_t drawn(carom_world *world, const carom_render_def *def)
{
	static uint8_t pixels[4 * WIDTH * HEIGHT];
	carom_error error;
	scenery_check(carom_world_render(world, def, pixels, &error), &error);
	return scenery_hash(pixels, sizeof pixels);
}

/* Rods are drawn below the bodies, more of them than are sent at once, and in the inset, too: pins are not. */
static void rods_are_drawn(void **unused)
{
	enum { RODS = 50 };
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(0.0f);
		carom_body_def bodies[RODS];
		carom_joint joints[RODS];
		carom_render_def picture = carom_default_render_def();
		picture.width = WIDTH;
		picture.height = HEIGHT;
		picture.has_inset = true;
		picture.inset = (carom_inset){{-1.0f, -1.0f}, {4.0f, 2.0f}};
		for (int i = 0; i < RODS; i++) {
			bodies[i] = scenery_circle((float)i, (float)(i * i % 7), 0.0f, 0.0f, 0.2f);
			joints[i] = joined_rod((uint32_t)i, i - 1, i > 0 ? 0.0f : -3.0f, 0.0f);
			joints[i].length = NAN;
		}
		carom_world *world = runs_world(&def, device, bodies, RODS);
		if (!world)
			continue;
		picture.has_camera = true;
		picture.camera = (carom_camera){{25.0f, 3.0f}, 30.0f};
		const uint64_t without = drawn(world, &picture);
		joined_set(world, RODS, joints);
		const uint64_t with = drawn(world, &picture);
		assert_true(with != without && with == drawn(world, &picture));
		for (int i = 0; i < RODS; i++)
			joints[i].kind = CAROM_REVOLUTE;
		joined_set(world, RODS, joints);
		assert_true(drawn(world, &picture) == without);
		runs_same_hash(&first, with, device);
		carom_world_destroy(world);
	}
}

/* What is wrong with a joint is said, and nothing is changed. */
static void wrong_joints_are_errors(void **unused)
{
	static const struct {
		const char *text;
		carom_joint joint;
	} cases[] = {
		{"joints[1].kind: found 7, must be one of carom_joint_kind", {.kind = (carom_joint_kind)7, .body = 1}},
		{"joints[1].body: found 3, the world has 3 bodies", {.body = 3}},
		{"joints[1].other: found 1, must be the index of another one of 3 bodies", {.body = 1, .other = 1}},
		{"joints[1].other: found -2, must be", {.body = 1, .other = -2}},
		{"joints[1].other: found 3, must be", {.body = 1, .other = 3}},
		{"joints[1]: one of the two must be dynamic, and body 2 is static", {.body = 2, .other = CAROM_GROUND}},
		{"joints[1].anchor: found (2e+09, 0)", {.body = 1, .other = 0, .anchor = {2e9f, 0.0f}}},
		{"joints[1].other_anchor: found (0, inf)", {.body = 1, .other = 0, .other_anchor = {0.0f, INFINITY}}},
		{"joints[1].length: found 0.001, must be a number from 0.01", {.kind = CAROM_DISTANCE, .body = 1, .length = 0.001f}},
		{"joints[1].length: found inf", {.kind = CAROM_DISTANCE, .body = 1, .length = INFINITY}},
		{"joints[1].length: found -1, must be a number from 0, to 1e9", {.kind = CAROM_SPRING, .body = 1, .length = -1.0f, .stiffness = 1.0f}},
		{"joints[1].stiffness: a spring must have that, or damping, above 0", {.kind = CAROM_SPRING, .body = 1, .length = 1.0f}},
		{"joints[1].stiffness: only a joint of kind CAROM_SPRING has it", {.kind = CAROM_ROPE, .body = 1, .length = 1.0f, .stiffness = 1.0f}},
		{"joints[1].damping: found -1, must be a number from 0 to 1e+12 (N s/m)",
			{.kind = CAROM_SPRING, .body = 1, .length = 1.0f, .damping = -1.0f}},
		{"joints[1].motor_speed: found nan, must be a number from -1e+09 to 1e+09 (rad/s)", {.body = 1, .motor_speed = NAN}},
		{"joints[1].motor_torque: found -2, must be", {.body = 1, .motor_torque = -2.0f}},
		{"joints[1].motor_torque: only a joint of kind CAROM_REVOLUTE or CAROM_SLIDER has it",
			{.kind = CAROM_DISTANCE, .body = 1, .length = 1.0f, .motor_torque = 2.0f}},
		{"joints[1].axis: only a joint of kind CAROM_SLIDER has it", {.body = 1, .axis = 1.0f}},
		{"joints[1].axis: found 7, must be a number from -6.28319 to 6.28319 (rad)", {.kind = CAROM_SLIDER, .body = 1, .axis = 7.0f}},
		{"joints[1].has_stops: only a joint of kind CAROM_REVOLUTE or CAROM_SLIDER has it",
			{.kind = CAROM_ROPE, .body = 1, .length = 1.0f, .has_stops = true}},
		{"joints[1].lower_angle: found nan, must be", {.body = 1, .has_stops = true, .lower_angle = NAN}},
		{"joints[1].upper_angle: found 7, must be a number from -6.28319 to 6.28319 (rad)", {.body = 1, .has_stops = true, .upper_angle = 7.0f}},
		{"joints[1].upper_angle: found 1, must be from lower_angle (2) on", {.body = 1, .has_stops = true, .lower_angle = 2.0f, .upper_angle = 1.0f}},
		{"joints[1].force: must be two finite numbers (N)", {.body = 1, .other = 0, .force = {0.0f, NAN}}},
		{"joints[1].torque: must be two finite numbers (N m)", {.body = 1, .other = 0, .torque = {INFINITY, 0.0f}}},
	};
	carom_body_def bodies[3] = {
		scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f), scenery_circle(2.0f, 0.0f, 0.0f, 0.0f, 0.5f), scenery_circle(4.0f, 0.0f, 0.0f, 0.0f, 0.5f)};
	carom_world_def def = joined_free(0.0f);
	carom_error error;
	(void)unused;
	bodies[2].is_static = true;
	carom_world *world = runs_world(&def, scenery_devices, bodies, 3);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const carom_joint joints[2] = {joined_rod(0, 1, 0.0f, 0.0f), cases[i].joint};
		assert_int_equal(carom_world_set_joints(world, 2, joints, &error), CAROM_INVALID_ARGUMENT);
		if (!strstr(error.text, cases[i].text))
			fail_msg("%zu: %s", i, error.text);
		assert_int_equal(carom_world_joint_count(world), 0);
	}
	const carom_joint rod = joined_rod(0, 1, 0.0f, 0.0f);
	joined_set(world, 1, &rod);
	assert_int_equal(carom_world_set_motor(world, 0, 1.0f, 1.0f, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "joints[0].motor_speed: only a joint of kind CAROM_REVOLUTE or CAROM_SLIDER has it");
	assert_int_equal(carom_world_set_motor(world, 1, 1.0f, 1.0f, &error), CAROM_INVALID_ARGUMENT);
	assert_non_null(strstr(error.text, "the world has 1"));
	carom_world_destroy(world);
	def.pipeline.step = "events";
	world = runs_world(&def, scenery_devices, bodies, 3);
	const carom_joint joint = joined_rod(0, 1, 0.0f, 0.0f);
	assert_int_equal(carom_world_set_joints(world, 1, &joint, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "joints: the step events holds none; take the step contacts");
	scenery_check(carom_world_set_joints(world, 0, NULL, &error), &error);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_is_written_goes_on),
		cmocka_unit_test(a_tangle_is_the_same_everywhere),
		cmocka_unit_test(who_goes_takes_its_joints),
		cmocka_unit_test(rods_are_drawn),
		cmocka_unit_test(wrong_joints_are_errors),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
