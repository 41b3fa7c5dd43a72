/* carom_world_render against what must be true of any picture.
 * SPDX-License-Identifier: MIT */
#include "pictures.h"

#include <math.h>

#define GROUND 0xFCFCFAu

static void colors_are_those_of_the_bodies(void **state)
{
	(void)state;
	carom_body_def bodies[14];
	for (uint32_t k = 0; k < COUNT(bodies); k++)
		bodies[k] = regular(4, 0.8f, 2 * (float)k - 13, 0, 0);
	bodies[12].color = 0x123456;
	bodies[13].is_static = true;
	carom_world *world = world_on("cpu", carom_default_world_def(), bodies, COUNT(bodies));
	picture p = picture_of(world, ten_a_metre(280, 20));
	assert_int_equal(color_at(p, 10 + 20 * 12, 10), 0x123456);
	uint32_t grey = color_at(p, 10 + 20 * 13, 10);
	assert_true(abs((int)(grey >> 16) - (int)(grey & 255)) < 16);
	for (uint32_t k = 0; k < 12; k++) {
		assert_int_not_equal(color_at(p, 10 + 20 * k, 10), GROUND);
		for (uint32_t i = 0; i < k; i++)
			assert_int_not_equal(color_at(p, 10 + 20 * k, 10), color_at(p, 10 + 20 * i, 10));
	}
	for (size_t k = 3; k < bytes_of(p); k += 4)
		assert_int_equal(p.pixels[k], 255);
	free(p.pixels);
	carom_world_destroy(world);
}

/* The camera is where it says: edges that lie on pixel borders are sharp. */
static void places_are_exact(void **state)
{
	(void)state;
	static const carom_vec2 box[4] = {{-1, -0.5f}, {1, -0.5f}, {1, 0.5f}, {-1, 0.5f}};
	carom_body_def body = carom_default_body_def();
	body.shape = CAROM_POLYGON;
	body.vertices = box;
	body.vertex_count = 4;
	body.position = (carom_vec2){2, 1};
	carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1);
	picture p = picture_of(world, ten_a_metre(80, 40));
	for (uint32_t y = 0; y < p.height; y++) {
		for (uint32_t x = 0; x < p.width; x++) {
			bool inside = x >= 50 && x < 70 && y >= 5 && y < 15;
			if ((color_at(p, x, y) != GROUND) != inside)
				fail_msg("pixel (%u, %u) is %06x", x, y, color_at(p, x, y));
		}
	}
	free(p.pixels);
	carom_world_destroy(world);
}

static void a_circle_shows_its_angle(void **state)
{
	(void)state;
	carom_body_def body = regular(0, 1.5f, 0, 0, 3.14159265f / 2);
	carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1);
	picture p = picture_of(world, ten_a_metre(41, 41));
	assert_int_not_equal(color_at(p, 20, 12), color_at(p, 20, 28)); /* up is y */
	assert_int_equal(color_at(p, 12, 20), color_at(p, 28, 20));
	free(p.pixels);
	carom_world_destroy(world);
}

/* How far the picture is from one of nothing: the largest difference of a level. */
static int contrast(picture p)
{
	int most = 0;
	for (size_t k = 0; k < bytes_of(p); k++) {
		int difference = abs(p.pixels[k] - (k % 4 == 3 ? 255 : (int)(GROUND >> (16 - 8 * (k % 4)) & 255)));
		most = difference > most ? difference : most;
	}
	return most;
}

static void tiny_bodies_show_wherever_they_are(void **state)
{
	(void)state;
	static const carom_vec2 needle[3] = {{-0.6f, 0}, {0.6f, -0.002f}, {0.6f, 0.002f}};
	carom_body_def bodies[3] = {regular(0, 0.0005f, 0, 0, 0), regular(5, 0.001f, 0, 0, 0), carom_default_body_def()};
	bodies[2].shape = CAROM_POLYGON;
	bodies[2].vertices = needle;
	bodies[2].vertex_count = 3;
	for (size_t k = 0; k < COUNT(bodies); k++) {
		carom_world *world = world_on("cpu", carom_default_world_def(), &bodies[k], 1);
		carom_render_def render = ten_a_metre(24, 24);
		for (int place = 0; place < 121; place++) {
			render.camera.center = (carom_vec2){0.01f * (float)(place % 11), 0.01f * (float)(place / 11)};
			picture p = picture_of(world, render);
			if (contrast(p) < 5)
				fail_msg("body %zu at place %d has a contrast of %d levels", k, place, contrast(p));
			free(p.pixels);
		}
		carom_world_destroy(world);
	}
}

static void what_is_outside_is_not_drawn(void **state)
{
	(void)state;
	carom_body_def bodies[5] = {
		regular(3, 1, 7, 0, 0), regular(0, 1, 0, -6, 0), regular(0, 3, 1e6f, 0, 1), regular(4, 1, 0, 1e30f, 1), regular(9, 2, -1e9f, 1e9f, 2)};
	carom_world *world = world_on("cpu", carom_default_world_def(), bodies, COUNT(bodies));
	picture p = picture_of(world, ten_a_metre(100, 80));
	assert_int_equal(contrast(p), 0);
	free(p.pixels);
	carom_world_destroy(world);
}

/* A disc so large that its rim is straight here, and so far off that squares of pixels do not fit in a float. */
static void a_huge_body_has_a_sharp_rim(void **state)
{
	(void)state;
	carom_body_def body = regular(0, 1048576, 0, -1048576, 0);
	carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1);
	picture p = picture_of(world, ten_a_metre(200, 40));
	for (uint32_t x = 0; x < p.width; x++) {
		assert_int_equal(color_at(p, x, 19), GROUND);
		assert_int_not_equal(color_at(p, x, 20), GROUND);
	}
	free(p.pixels);
	carom_world_destroy(world);
}

static carom_camera fitted(carom_world *world, carom_render_def def)
{
	carom_camera camera = {{NAN, NAN}, NAN};
	carom_error error = {0};
	if (carom_world_fit_camera(world, &def, &camera, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return camera;
}

/* What is drawn without a camera is drawn with the one that is told. */
static void the_fitted_camera_is_the_pictures(void **state)
{
	(void)state;
	const carom_body_def body = regular(0, 2, 4, -1, 0);
	carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1), *room = world_on("cpu", in_room(4, 2), NULL, 0);
	carom_render_def def = sized(60, 30);
	carom_camera camera = fitted(world, def), of_room = fitted(room, def);
	assert_true(camera.center.x == 4 && camera.center.y == -1 && camera.height > 4 && camera.height < 4.5f);
	assert_true(of_room.center.x == 0 && of_room.center.y == 0 && of_room.height > 2 && of_room.height < 9);
	picture without = picture_of(world, def);
	def.has_camera = true;
	def.camera = camera;
	camera = fitted(world, def);
	assert_memory_equal(&camera, &def.camera, sizeof camera);
	picture with = picture_of(world, def);
	assert_memory_equal(with.pixels, without.pixels, bytes_of(with));
	def.camera.height = 0;
	assert_int_equal(carom_world_fit_camera(world, &def, &camera, NULL), CAROM_INVALID_ARGUMENT);
	free(with.pixels);
	free(without.pixels);
	carom_world_destroy(world);
	carom_world_destroy(room);
}

static void an_empty_world_is_a_ground(void **state)
{
	(void)state;
	carom_world *world = world_on("cpu", carom_default_world_def(), NULL, 0);
	picture p = picture_of(world, sized(30, 20));
	assert_int_equal(contrast(p), 0);
	free(p.pixels);
	carom_world_destroy(world);
	world = world_on("cpu", in_room(2, 1), NULL, 0);
	p = picture_of(world, sized(200, 200));
	assert_int_equal(color_at(p, 100, 100), GROUND);
	assert_int_not_equal(color_at(p, 100, 10), GROUND);
	free(p.pixels);
	carom_world_destroy(world);
}

/* The part that is highlighted lies in a blue body, so the enlargement is all blue, and nothing blue leaks out of it. */
static void an_inset_stays_in_its_frame(void **state)
{
	(void)state;
	carom_body_def body = regular(0, 2, -10, -6, 0);
	body.color = 0x0000FF;
	carom_world *world = world_on("cpu", in_room(16, 12), &body, 1);
	carom_render_def render = ten_a_metre(320, 240);
	picture plain = picture_of(world, render);
	render.has_inset = true;
	render.inset = (carom_inset){{-11, -6.8f}, {1, 0.5f}};
	picture p = picture_of(world, render);
	carom_world_destroy(world);
	for (uint32_t y = 0; y < 240; y++) {
		for (uint32_t x = 0; x < 320; x++) {
			/* 45 % of the width, of the same aspect, 6 pixels from the upper right corner */
			bool inside = x >= 320 - 6 - 144 && x < 320 - 6 && y >= 6 && y < 6 + 72;
			uint32_t color = color_at(p, x, y), before = color_at(plain, x, y);
			if (inside ? color != 0x0000FF : color >> 16 < 60 && before >> 16 >= 60)
				fail_msg("pixel (%u, %u) is %06x and was %06x", x, y, color, before);
		}
	}
	assert_int_equal(color_at(p, 169, 40), color_at(p, 240, 78)); /* the frame */
	free(plain.pixels);
	free(p.pixels);
}

static void any_size_will_do(void **state)
{
	(void)state;
	const uint32_t sizes[][2] = {{1, 1}, {1, 16384}, {16384, 1}, {2, 3}, {33, 7}};
	carom_body_def bodies[32];
	carom_world *world = world_on("cpu", in_room(8, 5.5f), bodies, mixed_bodies(bodies));
	for (size_t k = 0; k < COUNT(sizes); k++) {
		carom_render_def render = sized(sizes[k][0], sizes[k][1]);
		render.has_inset = true;
		render.inset = (carom_inset){{-1e30f, 1e30f}, {1e-30f, 1e30f}};
		free(picture_of(world, render).pixels);
		render.inset = (carom_inset){{-1, -1}, {1e30f, 1}};
		render.has_camera = true;
		render.camera = (carom_camera){{1e30f, -1e30f}, 1e-38f};
		free(picture_of(world, render).pixels);
	}
	carom_world_destroy(world);
}

/* ---- Arguments ------------------------------------------------------------------------------------------------ */

static void refused(carom_world *world, carom_render_def def, const char *text)
{
	uint8_t pixels[4] = {1, 2, 3, 4};
	carom_error error = {0};
	assert_int_equal(carom_world_render(world, &def, pixels, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(error.status, CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, text);
	assert_int_equal(carom_world_render(world, &def, pixels, NULL), CAROM_INVALID_ARGUMENT);
	assert_memory_equal(pixels, ((uint8_t[]){1, 2, 3, 4}), 4);
}

static void wrong_arguments_are_refused(void **state)
{
	(void)state;
	carom_world *world = world_on("cpu", carom_default_world_def(), NULL, 0);
	refused(world, sized(0, 10), "the picture is 0 x 10 pixels: both must be 1 to 16384");
	refused(world, sized(10, 16385), "the picture is 10 x 16385 pixels: both must be 1 to 16384");
	carom_render_def def = ten_a_metre(1, 1);
	def.camera = (carom_camera){{0, 0}, 0};
	refused(world, def, "camera.height is 0: it must be above 0 and finite");
	def.camera.height = NAN;
	refused(world, def, "camera.height is nan: it must be above 0 and finite");
	def.camera = (carom_camera){{1, INFINITY}, 1};
	refused(world, def, "camera.center is (1, inf): both must be finite");
	def = sized(1, 1);
	def.has_inset = true;
	refused(world, def, "inset.size is (0, 0): both must be above 0 and finite");
	def.inset = (carom_inset){{-INFINITY, 0}, {1, 1}};
	refused(world, def, "inset.min is (-inf, 0): both must be finite");
	refused(NULL, sized(1, 1), "world: found NULL, must be given");
	carom_world_destroy(world);
}

static void what_is_not_used_is_not_checked(void **state)
{
	(void)state;
	carom_world *world = world_on("cpu", carom_default_world_def(), NULL, 0);
	carom_render_def def = sized(4, 4);
	def.camera.height = NAN;
	def.inset.size.x = -1;
	free(picture_of(world, def).pixels);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(colors_are_those_of_the_bodies), cmocka_unit_test(places_are_exact),
		cmocka_unit_test(a_circle_shows_its_angle), cmocka_unit_test(tiny_bodies_show_wherever_they_are),
		cmocka_unit_test(what_is_outside_is_not_drawn), cmocka_unit_test(a_huge_body_has_a_sharp_rim),
		cmocka_unit_test(the_fitted_camera_is_the_pictures), cmocka_unit_test(an_empty_world_is_a_ground),
		cmocka_unit_test(an_inset_stays_in_its_frame), cmocka_unit_test(any_size_will_do), cmocka_unit_test(wrong_arguments_are_refused),
		cmocka_unit_test(what_is_not_used_is_not_checked)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
