/* carom_world_render against golden pictures, on every device there is.
 * CAROM_UPDATE_GOLDEN=1 writes the golden pictures anew: look at them before they are committed.
 * SPDX-License-Identifier: MIT */
#include "pictures.h"

#include <png.h>

#define TOLERANCE 2 /* levels: vertices of regular polygons may differ in the last bit where they are made */

static const char *const devices[] = {"cpu", "opencl"};

static picture read_png(const char *path)
{
	png_image image = {.version = PNG_IMAGE_VERSION};
	if (!png_image_begin_read_from_file(&image, path))
		fail_msg("%s: %s", path, image.message);
	image.format = PNG_FORMAT_RGBA;
	picture read = {image.width, image.height, malloc(PNG_IMAGE_SIZE(image))};
	assert_non_null(read.pixels);
	if (!png_image_finish_read(&image, NULL, read.pixels, 0, NULL))
		fail_msg("%s: %s", path, image.message);
	return read;
}

static void compare(const char *name, picture found, picture golden)
{
	int worst = 0;
	assert_true(found.width == golden.width && found.height == golden.height);
	for (size_t k = 0; k < bytes_of(found); k++) {
		int difference = abs(found.pixels[k] - golden.pixels[k]);
		worst = difference > worst ? difference : worst;
	}
	if (worst > TOLERANCE) {
		char path[200];
		snprintf(path, sizeof path, "build/%s.found.png", name);
		carom_png_write(path, found.pixels, found.width, found.height, NULL);
		fail_msg("%s differs by %d levels from its golden picture: see %s", name, worst, path);
	}
}

static void check_golden(const char *name, picture found)
{
	char path[200];
	snprintf(path, sizeof path, "tests/golden/%s.png", name);
	if (getenv("CAROM_UPDATE_GOLDEN")) {
		assert_int_equal(carom_png_write(path, found.pixels, found.width, found.height, NULL), CAROM_OK);
		return;
	}
	picture golden = read_png(path);
	compare(name, found, golden);
	free(golden.pixels);
}

/* The picture is the golden one, and the same on all devices, bit by bit. */
static void check(const char *name, carom_world_def def, const carom_body_def *bodies, size_t count, carom_render_def render)
{
	picture first = {0};
	for (size_t k = 0; k < COUNT(devices); k++) {
		carom_world *world = world_on(devices[k], def, bodies, count);
		if (!world) {
			print_message("SKIPPED %s on %s: there is no such device\n", name, devices[k]);
			continue;
		}
		picture found = picture_of(world, render);
		carom_world_destroy(world);
		if (!first.pixels) {
			first = found;
			continue;
		}
		assert_memory_equal(found.pixels, first.pixels, bytes_of(first));
		free(found.pixels);
	}
	check_golden(name, first);
	free(first.pixels);
}

static void mixed_shapes_in_a_room(void **state)
{
	(void)state;
	carom_body_def bodies[32];
	check("mixed", in_room(8, 5.5f), bodies, mixed_bodies(bodies), sized(320, 240));
}

static void a_camera_of_its_own(void **state)
{
	(void)state;
	carom_body_def bodies[32];
	carom_render_def render = sized(320, 180);
	render.has_camera = true;
	render.camera = (carom_camera){{3, -2}, 6};
	check("camera", in_room(8, 5.5f), bodies, mixed_bodies(bodies), render);
}

static void no_room(void **state)
{
	(void)state;
	carom_body_def bodies[32];
	check("no_room", carom_default_world_def(), bodies, mixed_bodies(bodies), sized(240, 240));
}

static void an_inset(void **state)
{
	(void)state;
	carom_body_def bodies[256];
	carom_render_def render = sized(320, 240);
	for (uint32_t k = 0; k < COUNT(bodies); k++)
		bodies[k] = regular(k % 3 ? 3 : 0, 0.5f, -9.5f + 1.26f * (float)(k % 16), -9.5f + 1.26f * (float)(k / 16), 0.7f * (float)k);
	render.has_inset = true;
	render.inset = (carom_inset){{-8, -7}, {5, 4}};
	check("inset", in_room(10.5f, 10.5f), bodies, COUNT(bodies), render);
}

static void bodies_smaller_than_a_pixel(void **state)
{
	(void)state;
	carom_body_def bodies[400];
	for (uint32_t k = 0; k < COUNT(bodies); k++)
		bodies[k] = regular(k % 4 ? 2 + k % 4 : 0, 0.05f * (float)(1 + k / 20), 3.1f * (float)(k % 20), 3.1f * (float)(k / 20), (float)k);
	check("tiny", carom_default_world_def(), bodies, COUNT(bodies), sized(80, 80));
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(mixed_shapes_in_a_room), cmocka_unit_test(a_camera_of_its_own), cmocka_unit_test(no_room),
		cmocka_unit_test(an_inset), cmocka_unit_test(bodies_smaller_than_a_pixel)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
