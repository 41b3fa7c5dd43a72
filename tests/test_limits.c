/* Devices that have less than this one: each limit that Carom needs is asked for first, and where it is too low there is another way, or an error
 * that says so and leaves the state as it was.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "pictures.h"
#include "runs.h"
#include "world.h"

static int restore(void **unused)
{
	(void)unused;
	unsetenv("CAROM_MAX_IMAGE_SIZE");
	unsetenv("CAROM_MAX_ALLOCATION");
	return 0;
}

static void assert_names(const carom_error *error, const char *text)
{
	if (!strstr(error->text, text))
		fail_msg("'%s' does not say '%s'", error->text, text);
}

static carom_device_info device_of(const carom_world *world)
{
	carom_device_info info;
	carom_error error;
	scenery_check(carom_world_get_device(world, &info, &error), &error);
	return info;
}

static void limits_are_whole_numbers(void **unused)
{
	(void)unused;
	static const char *const wrong[] = {"0", "-1", " 5", "1e6", "64 MiB", "99999999999999999999"};
	carom_device_info *devices = NULL;
	size_t count = 0;
	carom_error error;
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		setenv("CAROM_MAX_ALLOCATION", wrong[i], 1);
		assert_int_equal(carom_device_list_create(&devices, &count, &error), CAROM_INVALID_ARGUMENT);
		assert_names(&error, "CAROM_MAX_ALLOCATION: found '");
		assert_names(&error, wrong[i]);
	}
	assert_null(devices);
}

/* A scene that is right is not blamed for the environment, a folder without kernels is not passed over. */
static void the_environment_is_blamed(void **unused)
{
	(void)unused;
	static const struct {
		const char *variable, *text, *said;
	} wrong[] = {
		{"CAROM_MAX_ALLOCATION", "abc", "CAROM_MAX_ALLOCATION: found 'abc'"},
		{"CAROM_KERNEL_DIR", "nowhere", "CAROM_KERNEL_DIR: found 'nowhere', which has none of the kernels, as aabb/loose.cl is one"},
		{"CAROM_KERNEL_DIR", "scenes", "CAROM_KERNEL_DIR: found 'scenes', which has none of the kernels"},
	};
	carom_scene *scene = NULL;
	carom_world *world = NULL;
	carom_error error;
	scenery_check(carom_scene_read("scenes/mixed.json", &scene, &error), &error);
	scene->world.device = "cpu";
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		setenv(wrong[i].variable, wrong[i].text, 1);
		assert_int_equal(carom_scene_create_world(scene, &world, &error), CAROM_INVALID_ARGUMENT);
		assert_ptr_equal(strstr(error.text, wrong[i].said), error.text);
		unsetenv(wrong[i].variable);
	}
	setenv("CAROM_KERNEL_DIR", "", 1);
	scenery_check(carom_scene_create_world(scene, &world, &error), &error);
	unsetenv("CAROM_KERNEL_DIR");
	carom_world_destroy(world);
	carom_scene_destroy(scene);
}

static void limits_only_get_lower(void **unused)
{
	(void)unused;
	carom_device_info *devices[2];
	size_t count[2];
	carom_error error;
	for (int i = 0; i < 2; i++) {
		scenery_check(carom_device_list_create(&devices[i], &count[i], &error), &error);
		setenv("CAROM_MAX_ALLOCATION", "18446744073709551615", 1);
		setenv("CAROM_MAX_IMAGE_SIZE", "5000", 1);
	}
	assert_int_equal(count[0], count[1]);
	for (size_t i = 0; i < count[0]; i++) {
		assert_true(devices[1][i].max_allocation == devices[0][i].max_allocation);
		assert_true(devices[1][i].max_image_size <= 5000 || !devices[1][i].is_opencl);
		assert_true(devices[0][i].max_image_size >= devices[1][i].max_image_size);
	}
	carom_device_list_destroy(devices[0]);
	carom_device_list_destroy(devices[1]);
}

/* A row of bodies is 4,096 texels: where images have not even that, buffers hold it. */
static void small_images_make_way_for_buffers(void **unused)
{
	(void)unused;
	const scenery_device automatic = {"opencl", CAROM_STORAGE_AUTO}, image = {"opencl", CAROM_STORAGE_IMAGE};
	const carom_body_def body = scenery_circle(0.0f, 0.0f, 1.0f, 0.0f, 0.5f);
	carom_world_def def = scenery_first_impact();
	carom_world *world = runs_world(&def, &automatic, &body, 1);
	carom_error error;
	if (!world)
		return;
	assert_true(device_of(world).uses_images == device_of(world).has_images);
	carom_world_destroy(world);
	setenv("CAROM_MAX_IMAGE_SIZE", "4095", 1);
	world = runs_world(&def, &automatic, &body, 1);
	assert_false(device_of(world).uses_images);
	runs_step(world, 1);
	carom_world_destroy(world);
	def.device = image.name;
	def.storage = image.storage;
	assert_int_equal(carom_world_create(&def, &world, &error), CAROM_DEVICE);
	assert_names(&error, "use buffer storage");
}

/* More bodies than an image has texels a side: first_impact can't hold its pairs, events does not need them. */
static void sides_are_limited(void **unused)
{
	(void)unused;
	enum { COUNT = 4097 };
	static carom_body_def bodies[COUNT];
	for (int i = 0; i < COUNT; i++)
		bodies[i] = scenery_circle((float)(i % 64), (float)(i / 64), 0.5f, 0.0f, 0.3f);
	setenv("CAROM_MAX_IMAGE_SIZE", "4096", 1);
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = scenery_first_impact(), events = runs_def();
		carom_world *world;
		carom_error error;
		if (device->storage != CAROM_STORAGE_IMAGE || !(world = runs_world(&def, device, bodies, COUNT)))
			continue;
		assert_int_equal(carom_world_step(world, 1, NULL, &error), CAROM_LIMIT);
		assert_names(&error, "at most 4096 bodies");
		assert_true(runs_state(world, 1).position.x == 1.0f);
		carom_world_destroy(world);
		world = runs_world(&events, device, bodies, COUNT);
		runs_step(world, 1);
		carom_world_destroy(world);
	}
}

/* A picture is drawn in blocks: it may be wider than an image, and is the same. */
static void pictures_are_drawn_in_blocks(void **unused)
{
	(void)unused;
	enum { WIDTH = 5000, HEIGHT = 8, SIZE = 4 * WIDTH * HEIGHT };
	static uint8_t pixels[2][SIZE];
	const carom_body_def body = scenery_circle(0.0f, 0.0f, 1.0f, 0.0f, 0.5f);
	const carom_world_def def = runs_def();
	const carom_render_def render = sized(WIDTH, HEIGHT);
	SCENERY_EACH_DEVICE(device) {
		for (int limited = 0; limited < 2; limited++) {
			carom_world *world = runs_world(&def, device, &body, 1);
			carom_error error;
			if (!world)
				break;
			scenery_check(carom_world_render(world, &render, pixels[limited], &error), &error);
			carom_world_destroy(world);
			setenv("CAROM_MAX_IMAGE_SIZE", "4096", 1);
		}
		assert_memory_equal(pixels[0], pixels[1], SIZE);
		assert_true(pixels[0][0] == 0xFF || pixels[0][3] == 0xFF);
		restore(NULL);
	}
}

static carom_world *pile(const scenery_device *device)
{
	enum { COUNT = 400 };
	carom_body_def bodies[COUNT];
	carom_world_def def = in_room(8, 5.5f);
	carom_world *world = scenery_world(&def, device);
	carom_error error;
	for (uint32_t k = 0; k < COUNT; k++) {
		bodies[k] = regular(k % 3 ? 3 + k % 62 : 0, 0.8f, 0.035f * (float)k - 7, 4.5f - 0.7f * (float)(k % 13), 0.1f * (float)k);
		bodies[k].is_static = k % 5 == 0;
	}
	if (world)
		scenery_check(carom_world_add(world, bodies, COUNT, NULL, &error), &error);
	return world;
}

/* More bodies, one over the other, than there is room for at once: they are drawn in passes, and the picture is the same. */
static void pictures_are_drawn_in_passes(void **unused)
{
	(void)unused;
	static const char *const limits[] = {"40000", "65536", "262144"};
	carom_render_def def = sized(203, 150);
	def.has_inset = true;
	def.inset = (carom_inset){{-5, -4}, {3, 2}};
	carom_world *world = pile(&scenery_devices[0]);
	const picture expected = picture_of(world, def);
	assert_int_equal(world->canvas.room[ROLE_LIGHT], TILE);
	carom_world_destroy(world);
	SCENERY_EACH_DEVICE(device) {
		for (size_t i = 0; i < COUNT(limits); i++) {
			setenv("CAROM_MAX_ALLOCATION", limits[i], 1);
			world = pile(device);
			if (!world)
				break;
			const picture found = picture_of(world, def), again = picture_of(world, def);
			assert_true(world->canvas.room[ROLE_LIGHT] > 1);
			assert_memory_equal(found.pixels, expected.pixels, bytes_of(expected));
			assert_memory_equal(again.pixels, expected.pixels, bytes_of(expected));
			free(found.pixels);
			free(again.pixels);
			carom_world_destroy(world);
		}
		restore(NULL);
	}
	free(expected.pixels);
}

/* From room for next to nothing to room for all: the run ends as it does without a limit, or says what it lacks and keeps the state. */
static void allocations_are_limited(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *whole = scenery_crowd(device, 5, 0);
		int refused = 0, done = 0;
		if (!whole)
			continue;
		const uint64_t before = runs_hash(whole);
		runs_step(whole, 20);
		for (uint64_t most = 64; most <= 1 << 20; most *= 4) {
			char text[32];
			carom_error error;
			snprintf(text, sizeof text, "%llu", (unsigned long long)most);
			setenv("CAROM_MAX_ALLOCATION", text, 1);
			carom_world *world = scenery_crowd(device, 5, 0);
			carom_status status = carom_world_step(world, 20, NULL, &error);
			if (status) {
				assert_int_equal(status, CAROM_LIMIT);
				assert_names(&error, text);
			}
			assert_true(runs_hash(world) == (status ? before : runs_hash(whole)));
			refused += status != CAROM_OK;
			done += status == CAROM_OK;
			carom_world_destroy(world);
		}
		assert_true(refused > 0 && done > 0);
		restore(NULL);
		carom_world_destroy(whole);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test_teardown(limits_are_whole_numbers, restore), cmocka_unit_test(the_environment_is_blamed),
		cmocka_unit_test_teardown(limits_only_get_lower, restore), cmocka_unit_test_teardown(small_images_make_way_for_buffers, restore),
		cmocka_unit_test_teardown(sides_are_limited, restore), cmocka_unit_test_teardown(pictures_are_drawn_in_blocks, restore),
		cmocka_unit_test_teardown(pictures_are_drawn_in_passes, restore), cmocka_unit_test_teardown(allocations_are_limited, restore)};
	return cmocka_run_group_tests_name("limits", tests, NULL, NULL);
}
