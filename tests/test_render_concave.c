/* Pictures of polygons that are not convex, against their outlines.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "layout.h"
#include "rendering.h"

#include "silhouettes.h"

#define GROUND 0xFCFCFAu
#define FILL 0x3399CCu
#define SCALE 40 /* pixels a metre */

/* ---- Pixels are inside or outside */

/* A body's outline in a picture, in pixels from its middle, y up. */
typedef struct outline {
	uint32_t count;
	double x[CAROM_MAX_VERTICES], y[CAROM_MAX_VERTICES];
} outline;

static outline outline_of(carom_world *world)
{
	carom_body_info info;
	carom_body_state at;
	carom_error error;
	outline found = {0};
	scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
	scenery_check(carom_world_get_states(world, 0, 1, &at, &error), &error);
	const double c = cos((double)at.angle), s = sin((double)at.angle);
	for (found.count = 0; found.count < info.vertex_count; found.count++) {
		const double x = (double)info.vertices[found.count].x, y = (double)info.vertices[found.count].y;
		found.x[found.count] = SCALE * ((double)at.position.x + c * x - s * y);
		found.y[found.count] = SCALE * ((double)at.position.y + s * x + c * y);
	}
	return found;
}

/* From the nearest side. */
static double distance_from(const outline *of, double x, double y)
{
	double least = HUGE_VAL;
	for (uint32_t k = 0; k < of->count; k++) {
		const uint32_t next = (k + 1) % of->count;
		const double side_x = of->x[next] - of->x[k], side_y = of->y[next] - of->y[k];
		const double part = ((x - of->x[k]) * side_x + (y - of->y[k]) * side_y) / (side_x * side_x + side_y * side_y);
		const double near = fmax(0, fmin(1, part));
		least = fmin(least, hypot(x - of->x[k] - near * side_x, y - of->y[k] - near * side_y));
	}
	return least;
}

/* Even-odd. */
static bool is_inside(const outline *of, double x, double y)
{
	bool inside = false;
	for (uint32_t k = 0; k < of->count; k++) {
		const uint32_t next = (k + 1) % of->count;
		if ((of->y[k] > y) != (of->y[next] > y) && x < of->x[k] + (of->x[next] - of->x[k]) * (y - of->y[k]) / (of->y[next] - of->y[k]))
			inside = !inside;
	}
	return inside;
}

/* Pixels that are on the wrong side of the outline, or deep inside but not of the body's colour: farther than a pixel from it there is no doubt, and nothing of it to be seen
 * farther than its breadth. */
static uint32_t wrong_pixels(picture p, const outline *of)
{
	uint32_t wrong = 0;
	for (uint32_t k = 0; k < p.width * p.height; k++) {
		const double x = k % p.width + 0.5 - p.width / 2.0, y = p.height / 2.0 - k / p.width - 0.5, distance = distance_from(of, x, y);
		const uint32_t color = color_at(p, k % p.width, k / p.width);
		if (distance > 1)
			wrong += is_inside(of, x, y) ? color == GROUND || (distance > 2 && color != FILL) : color != GROUND;
	}
	return wrong;
}

static picture picture_at(carom_world *world)
{
	carom_render_def def = sized(140, 120);
	def.has_camera = true;
	def.camera.height = 120.0f / SCALE;
	return picture_of(world, def);
}

static void pixels_are_inside_or_outside(void **state)
{
	(void)state;
	for (uint32_t shape = 0; shape < SILHOUETTES; shape++) {
		for (int turn = 0; turn < 4; turn++) {
			carom_vec2 v[CAROM_MAX_VERTICES];
			carom_body_def body = silhouette_body(shape, v, 0.013f * (float)turn, -0.1f * (float)turn, 0.77f * (float)turn);
			body.color = FILL;
			carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1);
			const outline of = outline_of(world);
			picture p = picture_at(world);
			if (wrong_pixels(p, &of) > 0)
				fail_msg("shape %u, turned %d times, has %u wrong pixels", shape, turn, wrong_pixels(p, &of));
			free(p.pixels);
			carom_world_destroy(world);
		}
	}
}

/* The comparison must be able to say no: a U that is filled. */
static void a_filled_one_is_found(void **state)
{
	(void)state;
	static const carom_vec2 box[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
	carom_vec2 v[CAROM_MAX_VERTICES];
	carom_body_def bodies[2] = {silhouette_body(1, v, 0, 0, 0), carom_default_body_def()};
	carom_world *world = world_on("cpu", carom_default_world_def(), bodies, 1);
	const outline of = outline_of(world);
	carom_world_destroy(world);
	bodies[1].shape = CAROM_POLYGON;
	bodies[1].vertices = box;
	bodies[1].vertex_count = 4;
	bodies[1].position.y = (float)(of.y[0] / SCALE) + 1;
	bodies[1].color = FILL;
	world = world_on("cpu", carom_default_world_def(), &bodies[1], 1);
	picture p = picture_at(world);
	assert_in_range(wrong_pixels(p, &of), 38 * 58, 40 * 60); /* what lies between its arms */
	free(p.pixels);
	carom_world_destroy(world);
}

/* An L so large that the sides of its inner corner, which is here, end far off: they lie on borders of pixels. */
static void a_huge_one_has_sharp_sides(void **state)
{
	(void)state;
	enum { FAR = 786432, CENTER = FAR / 6 };
	static const carom_vec2 l[6] = {{-FAR, -FAR}, {FAR, -FAR}, {FAR, 0}, {0, 0}, {0, FAR}, {-FAR, FAR}};
	carom_body_def body = carom_default_body_def();
	body.shape = CAROM_POLYGON;
	body.vertices = l;
	body.vertex_count = 6;
	body.position = (carom_vec2){-CENTER, -CENTER};
	carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1);
	picture p = picture_of(world, ten_a_metre(60, 40));
	for (uint32_t k = 0; k < 60 * 40; k++)
		if ((color_at(p, k % 60, k / 60) != GROUND) != (k % 60 < 30 || k / 60 >= 20))
			fail_msg("pixel (%u, %u) is %06x", k % 60, k / 60, color_at(p, k % 60, k / 60));
	free(p.pixels);
	carom_world_destroy(world);
}

/* Thin ones, and such as are far smaller than a pixel, do not fall between the centres of pixels. */
static void tiny_ones_show_wherever_they_are(void **state)
{
	(void)state;
	static const carom_vec2 angle[6] = {{0, 0}, {0.6f, 0}, {0.6f, 0.002f}, {0.002f, 0.002f}, {0.002f, 0.6f}, {0, 0.6f}};
	carom_vec2 small[6];
	for (int k = 0; k < 6; k++)
		small[k] = (carom_vec2){0.001f * angle[k].x, 0.001f * angle[k].y};
	for (int k = 0; k < 242; k++) {
		carom_body_def body = carom_default_body_def();
		body.shape = CAROM_POLYGON;
		body.vertices = k % 2 ? angle : small;
		body.vertex_count = 6;
		carom_world *world = world_on("cpu", carom_default_world_def(), &body, 1);
		carom_render_def render = ten_a_metre(24, 24);
		render.camera.center = (carom_vec2){0.01f * (float)(k / 2 % 11), 0.01f * (float)(k / 22)};
		picture p = picture_of(world, render);
		int most = 0;
		for (uint32_t i = 0; i < 24 * 24; i++)
			most = abs((int)(GROUND >> 16) - p.pixels[4 * i]) > most ? abs((int)(GROUND >> 16) - p.pixels[4 * i]) : most;
		if (most < 5)
			fail_msg("at place %d: a contrast of %d levels", k, most);
		free(p.pixels);
		carom_world_destroy(world);
	}
}

/* ---- The same bytes */

static void add_all(carom_world *world, uint32_t count)
{
	carom_error error;
	scenery_check(silhouette_add(world, count, 1.9f, &error), &error);
}

/* A picture with an inset, and one of what is near, where sides begin and end outside. */
static void pictures_of(carom_world *world, picture made[2])
{
	carom_render_def near = sized(203, 150);
	near.has_camera = true;
	near.camera = (carom_camera){{0.3f, 0.2f}, 0.8f};
	made[0] = picture_of(world, with_inset(203, 150));
	made[1] = picture_of(world, near);
}

static void devices_and_combinations_give_one_picture(void **state)
{
	(void)state;
	static const char *const transforms[2] = {"index", "to_cpu"};
	picture first[2] = {{0}}, found[2] = {{0}};
	SCENERY_EACH_DEVICE(device) {
		for (int k = 0; k < 6; k++) {
			carom_world_def def = room(options[k / 2], transforms[k % 2]);
			carom_world *world = scenery_world(&def, device);
			if (!world)
				break;
			add_all(world, 10);
			fill(world);
			add_all(world, 15);
			pictures_of(world, first[0].pixels ? found : first);
			carom_world_destroy(world);
			for (int i = 0; i < 2 && (k || device != scenery_devices); i++) {
				assert_memory_equal(found[i].pixels, first[i].pixels, bytes_of(first[i]));
				free(found[i].pixels);
			}
		}
	}
	free(first[0].pixels);
	free(first[1].pixels);
}

static int restore(void **state)
{
	(void)state;
	unsetenv("CAROM_MAX_ALLOCATION");
	return 0;
}

/* With little room. */
static void passes_give_one_picture(void **state)
{
	(void)state;
	picture first[2] = {{0}}, found[2] = {{0}};
	SCENERY_EACH_DEVICE(device) {
		for (int limited = 0; limited < 2; limited++) {
			carom_world_def def = room(NULL, NULL);
			setenv("CAROM_MAX_ALLOCATION", limited ? "40000" : "1000000000", 1);
			carom_world *world = scenery_world(&def, device);
			if (!world)
				break;
			add_all(world, 90);
			pictures_of(world, first[0].pixels ? found : first);
			assert_int_equal(world->canvas.room[ROLE_LIGHT] > TILE, limited);
			carom_world_destroy(world);
			for (int i = 0; i < 2 && (limited || device != scenery_devices); i++) {
				assert_memory_equal(found[i].pixels, first[i].pixels, bytes_of(first[i]));
				free(found[i].pixels);
			}
		}
	}
	free(first[0].pixels);
	free(first[1].pixels);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(pixels_are_inside_or_outside), cmocka_unit_test(a_filled_one_is_found),
		cmocka_unit_test(a_huge_one_has_sharp_sides), cmocka_unit_test(tiny_ones_show_wherever_they_are),
		cmocka_unit_test(devices_and_combinations_give_one_picture), cmocka_unit_test_teardown(passes_give_one_picture, restore)};
	return cmocka_run_group_tests_name("render_concave", tests, NULL, NULL);
}
