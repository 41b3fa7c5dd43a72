/* NULL for every pointer that the public functions take: what has to be given is refused by name, the rest may be left out.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "scenery.h"

static void null_is_released(void **unused)
{
	(void)unused;
	carom_world_destroy(NULL);
	carom_scene_destroy(NULL);
	carom_device_list_destroy(NULL);
	carom_file_destroy(NULL);
	carom_scene_text_destroy(NULL);
	carom_snapshot_destroy(NULL);
}

/* Every error may be NULL, and success leaves the error alone. */
static void errors_are_optional(void **unused)
{
	(void)unused;
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	carom_body_def body = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f);
	carom_error error, untouched;
	carom_device_info device;
	uint64_t hash;
	memset(&error, 0x5A, sizeof error);
	untouched = error;
	def.device = "cpu";
	assert_int_equal(carom_world_create(&def, &world, &error), CAROM_OK);
	assert_int_equal(carom_world_add(world, &body, 1, NULL, &error), CAROM_OK);
	assert_int_equal(carom_world_step(world, 1, NULL, &error), CAROM_OK);
	assert_int_equal(carom_world_advance(world, 0.01, NULL, &error), CAROM_OK);
	assert_int_equal(carom_world_hash(world, &hash, &error), CAROM_OK);
	assert_int_equal(carom_world_get_device(world, &device, &error), CAROM_OK);
	assert_memory_equal(&error, &untouched, sizeof error);
	assert_int_equal(carom_world_advance(world, -1.0, NULL, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_get_states(world, 0, 2, NULL, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_set_states(world, 0, 2, NULL, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_get_body(world, 1, NULL, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_set_force(world, 1, body.position, 0.0f, NULL), CAROM_INVALID_ARGUMENT);
	carom_world_destroy(world);
	world = NULL;
	def.device = "abacus";
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_UNKNOWN_NAME);
	def.time_step = 0.0f;
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_INVALID_ARGUMENT);
	assert_null(world);
}

/* The argument's name begins what is said. */
#define REFUSE(name, call)                                                   \
	do {                                                                     \
		carom_error error = {0};                                             \
		assert_int_equal(call, CAROM_INVALID_ARGUMENT);                      \
		assert_int_equal(error.status, CAROM_INVALID_ARGUMENT);              \
		assert_string_equal(error.text, name ": found NULL, must be given"); \
	} while (0)

static carom_world *world_of_one(void)
{
	const carom_body_def body = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f);
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	carom_error error;
	def.device = "cpu";
	def.profile = true;
	scenery_check(carom_world_create(&def, &world, &error), &error);
	scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
	return world;
}

static void what_has_to_be_given_of_worlds(void **unused)
{
	(void)unused;
	const carom_vec2 none = {0.0f, 0.0f};
	carom_world *world = world_of_one(), *other = NULL;
	carom_world_def def = carom_default_world_def();
	carom_body_def body = scenery_circle(3.0f, 0.0f, 0.0f, 0.0f, 1.0f);
	carom_body_info info;
	carom_body_state state;
	carom_contact contact;
	carom_joint joint;
	carom_hit hit;
	uint32_t index = 0;
	carom_device_info device;
	carom_measure measure;
	size_t count = 9;
	uint64_t hash;
	REFUSE("def", carom_world_create(NULL, &other, &error));
	REFUSE("world", carom_world_create(&def, NULL, &error));
	REFUSE("world", carom_world_add(NULL, &body, 1, NULL, &error));
	REFUSE("defs", carom_world_add(world, NULL, 1, NULL, &error));
	REFUSE("world", carom_world_get_body(NULL, 0, &info, &error));
	REFUSE("info", carom_world_get_body(world, 0, NULL, &error));
	REFUSE("world", carom_world_get_states(NULL, 0, 1, &state, &error));
	REFUSE("states", carom_world_get_states(world, 0, 1, NULL, &error));
	REFUSE("world", carom_world_set_states(NULL, 0, 1, &state, &error));
	REFUSE("states", carom_world_set_states(world, 0, 1, NULL, &error));
	REFUSE("world", carom_world_set_force(NULL, 0, none, 0.0f, &error));
	REFUSE("world", carom_world_set_filter(NULL, 0, 1, 1, &error));
	REFUSE("world", carom_world_set_gravity(NULL, none, &error));
	REFUSE("world", carom_world_set_time_step(NULL, 0.1f, &error));
	REFUSE("world", carom_world_remove(NULL, &index, 1, &error));
	REFUSE("indices", carom_world_remove(world, NULL, 1, &error));
	REFUSE("world", carom_world_contact_count(NULL, &count, &error));
	REFUSE("count", carom_world_contact_count(world, NULL, &error));
	REFUSE("world", carom_world_get_contacts(NULL, 0, 0, &contact, &error));
	REFUSE("contacts", carom_world_get_contacts(world, 0, 1, NULL, &error));
	REFUSE("world", carom_world_get_hits(NULL, 0, 0, &hit, &error));
	REFUSE("hits", carom_world_get_hits(world, 0, 1, NULL, &error));
	REFUSE("world", carom_world_set_contacts(NULL, 0, NULL, &error));
	REFUSE("contacts", carom_world_set_contacts(world, 1, NULL, &error));
	REFUSE("world", carom_world_get_joints(NULL, 0, 0, &joint, &error));
	REFUSE("joints", carom_world_get_joints(world, 0, 1, NULL, &error));
	REFUSE("world", carom_world_set_joints(NULL, 0, NULL, &error));
	REFUSE("joints", carom_world_set_joints(world, 1, NULL, &error));
	REFUSE("world", carom_world_step(NULL, 1, NULL, &error));
	REFUSE("world", carom_world_advance(NULL, 1.0, NULL, &error));
	REFUSE("world", carom_world_advance_to(NULL, 1.0, 1, NULL, &error));
	REFUSE("world", carom_world_get_device(NULL, &device, &error));
	REFUSE("info", carom_world_get_device(world, NULL, &error));
	REFUSE("world", carom_world_measure(NULL, &measure, &error));
	REFUSE("measure", carom_world_measure(world, NULL, &error));
	REFUSE("world", carom_world_hash(NULL, &hash, &error));
	REFUSE("hash", carom_world_hash(world, NULL, &error));
	assert_null(other);
	assert_int_equal(count, 9);
	assert_int_equal(carom_world_body_count(world), 1);
	carom_world_destroy(world);
}

static void what_has_to_be_given_of_a_snapshot(void **unused)
{
	(void)unused;
	carom_world *world = world_of_one();
	carom_snapshot *snapshot = NULL;
	const carom_ray ray = {{0, 0}, {1, 1}, 0};
	const carom_body_def body = carom_default_body_def();
	carom_ray_hit hit;
	const carom_vec2 point = {0, 0};
	carom_nearest nearest;
	uint32_t index;
	size_t count;
	REFUSE("world", carom_snapshot_create(NULL, &snapshot, &error));
	REFUSE("snapshot", carom_snapshot_create(world, NULL, &error));
	REFUSE("world", carom_snapshot_create_masked(NULL, 1, &snapshot, &error));
	REFUSE("snapshot", carom_snapshot_create_masked(world, 1, NULL, &error));
	scenery_check(carom_snapshot_create(world, &snapshot, NULL), NULL);
	REFUSE("snapshot", carom_snapshot_cast_rays(NULL, 1, &ray, &hit, &error));
	REFUSE("rays", carom_snapshot_cast_rays(snapshot, 1, NULL, &hit, &error));
	REFUSE("hits", carom_snapshot_cast_rays(snapshot, 1, &ray, NULL, &error));
	REFUSE("snapshot", carom_snapshot_cast_bodies(NULL, 1, &body, &point, &hit, &error));
	REFUSE("bodies", carom_snapshot_cast_bodies(snapshot, 1, NULL, &point, &hit, &error));
	REFUSE("to", carom_snapshot_cast_bodies(snapshot, 1, &body, NULL, &hit, &error));
	REFUSE("hits", carom_snapshot_cast_bodies(snapshot, 1, &body, &point, NULL, &error));
	REFUSE("snapshot", carom_snapshot_find_touching(NULL, &body, &index, 1, &count, &error));
	REFUSE("body", carom_snapshot_find_touching(snapshot, NULL, &index, 1, &count, &error));
	REFUSE("indices", carom_snapshot_find_touching(snapshot, &body, NULL, 1, &count, &error));
	REFUSE("count", carom_snapshot_find_touching(snapshot, &body, &index, 1, NULL, &error));
	REFUSE("snapshot", carom_snapshot_find_nearest(NULL, 1, &point, 1.0f, &nearest, &error));
	REFUSE("points", carom_snapshot_find_nearest(snapshot, 1, NULL, 1.0f, &nearest, &error));
	REFUSE("nearest", carom_snapshot_find_nearest(snapshot, 1, &point, 1.0f, NULL, &error));
	REFUSE("snapshot", carom_snapshot_find(NULL, point, point, &index, 1, &count, &error));
	REFUSE("indices", carom_snapshot_find(snapshot, point, point, NULL, 1, &count, &error));
	REFUSE("count", carom_snapshot_find(snapshot, point, point, &index, 1, NULL, &error));
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void what_has_to_be_given_of_the_rest(void **unused)
{
	(void)unused;
	static uint8_t pixels[4];
	const carom_render_def render = {.width = 1, .height = 1};
	carom_world *world = world_of_one();
	carom_pipeline pipeline = {0};
	carom_camera camera;
	carom_device_info *devices = NULL;
	carom_scene *scene = NULL;
	carom_file *file = NULL;
	FILE *stream = NULL;
	size_t count;
	char *text = NULL;
	REFUSE("pipeline", carom_pipeline_set(NULL, "toi", "separating", &error));
	REFUSE("slot", carom_pipeline_set(&pipeline, NULL, "separating", &error));
	REFUSE("alternative", carom_pipeline_set(&pipeline, "toi", NULL, &error));
	REFUSE("devices", carom_device_list_create(NULL, &count, &error));
	REFUSE("count", carom_device_list_create(&devices, NULL, &error));
	REFUSE("path", carom_scene_read(NULL, &scene, &error));
	REFUSE("scene", carom_scene_read("scenes/mixed.json", NULL, &error));
	REFUSE("text", carom_scene_parse(NULL, 2, "scene", &scene, &error));
	REFUSE("scene", carom_scene_parse("{}", 2, "scene", NULL, &error));
	REFUSE("scene", carom_scene_create_world(NULL, &world, &error));
	scenery_check(carom_scene_read("scenes/mixed.json", &scene, NULL), NULL);
	REFUSE("world", carom_scene_create_world(scene, NULL, &error));
	carom_scene_destroy(scene);
	REFUSE("world", carom_world_write_scene(NULL, NULL, "nowhere/scene.json", &error));
	REFUSE("path", carom_world_write_scene(world, NULL, NULL, &error));
	REFUSE("world", carom_scene_text_create(NULL, NULL, &text, NULL, &error));
	REFUSE("text", carom_scene_text_create(world, NULL, NULL, NULL, &error));
	REFUSE("world", carom_world_render(NULL, &render, pixels, &error));
	REFUSE("def", carom_world_render(world, NULL, pixels, &error));
	REFUSE("pixels", carom_world_render(world, &render, NULL, &error));
	REFUSE("world", carom_world_fit_camera(NULL, &render, &camera, &error));
	REFUSE("def", carom_world_fit_camera(world, NULL, &camera, &error));
	REFUSE("camera", carom_world_fit_camera(world, &render, NULL, &error));
	REFUSE("path", carom_png_write(NULL, pixels, 1, 1, &error));
	REFUSE("pixels", carom_png_write("nowhere/picture.png", NULL, 1, 1, &error));
	REFUSE("path", carom_file_create(NULL, &file, &stream, &error));
	REFUSE("file", carom_file_create("nowhere/file", NULL, &stream, &error));
	REFUSE("stream", carom_file_create("nowhere/file", &file, NULL, &error));
	REFUSE("file", carom_file_commit(NULL, &error));
	carom_world_destroy(world);
}

/* Arrays of no items, and what functions without a status do. */
static void what_need_not_be_given(void **unused)
{
	(void)unused;
	carom_world *world = world_of_one();
	const carom_pipeline pipeline = {0};
	carom_stage_info stage;
	carom_kernel_time time;
	assert_int_equal(carom_world_add(world, NULL, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_get_states(world, 1, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_set_states(world, 1, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_get_contacts(world, 0, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_get_hits(world, 0, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_remove(world, NULL, 0, NULL), CAROM_OK);
	assert_int_equal(carom_world_hit_count(NULL), 0);
	assert_int_equal(carom_world_set_contacts(world, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_get_joints(world, 0, 0, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_set_joints(world, 0, NULL, NULL), CAROM_OK);
	carom_world_set_progress(NULL, NULL, NULL);
	assert_int_equal(carom_world_body_count(NULL), 0);
	assert_true(carom_world_time(NULL) == 0.0);
	assert_null(carom_world_get_def(NULL));
	assert_int_equal(carom_world_memory(NULL, 1, 1), 0);
	assert_true(carom_world_profile(world, 0, &time));
	assert_false(carom_world_profile(world, 0, NULL));
	assert_false(carom_world_profile(NULL, 0, &time));
	assert_true(carom_stage_list(0, &stage));
	assert_false(carom_stage_list(0, NULL));
	assert_null(carom_pipeline_get(NULL, "toi"));
	assert_null(carom_pipeline_get(&pipeline, NULL));
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(null_is_released), cmocka_unit_test(errors_are_optional),
		cmocka_unit_test(what_has_to_be_given_of_worlds), cmocka_unit_test(what_has_to_be_given_of_a_snapshot),
		cmocka_unit_test(what_has_to_be_given_of_the_rest), cmocka_unit_test(what_need_not_be_given)};
	return cmocka_run_group_tests_name("null", tests, NULL, NULL);
}
