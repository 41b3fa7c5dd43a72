/* Rendering on every device: each stage gives the bits of the float instance on the CPU and the values of the double one,
 * and lists that are too short, or pictures larger than what is drawn at once, lose nothing.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "judge.h"
#include "layout.h"
#include "rendering.h"

#include "silhouettes.h"

/* ---- Each stage against the CPU's two instances */

typedef struct trial {
	carom_world *reference, *oracle, *device;
	size_t compared, wrong_bits, wrong_values;
} trial;

/* The first `items` texels, or ints of a list, as they lie on the world's device; `size` bytes a number. */
static void *fetch(carom_world *world, carom_role role, uint32_t items, size_t size)
{
	void *data = calloc(world->canvas.room[role], 4 * size);
	carom_error error;
	assert_non_null(data);
	scenery_check(world->device->kind->download(world->device, world->textures[role].front, carom_row_count(items), data, &error), &error);
	return data;
}

static void compare_bits(trial *t, carom_role role, uint32_t items, size_t size)
{
	char *expected = fetch(t->reference, role, items, sizeof(float)), *found = fetch(t->device, role, items, sizeof(float));
	for (uint32_t i = 0; i < items; i++)
		t->wrong_bits += memcmp(expected + i * size, found + i * size, size) != 0;
	t->compared += items;
	free(expected);
	free(found);
}

/* Pixels, and what is derived from them, to a thousandth; colours and counts are whole numbers. */
static void compare_values(trial *t, carom_role role, uint32_t items)
{
	double *expected = fetch(t->oracle, role, items, sizeof(double));
	float *found = fetch(t->device, role, items, sizeof(float));
	for (size_t i = 0; i < 4 * (size_t)items; i++)
		t->wrong_values += fabs((double)found[i] - expected[i]) <= 1e-3 + 1e-6 * fabs(expected[i]) ? 0 : 1;
	free(expected);
	free(found);
}

/* The world's lists of what lies in which tile, against what its boxes say: rows of tiles, in each tile the shapes in order. */
static void check_lists(trial *t, carom_world *world, uint32_t shapes, uint32_t width, uint32_t height)
{
	const uint32_t wide = world->device->kind->tile_width, high = world->device->kind->tile_height;
	const uint32_t columns = (width + wide - 1) / wide, rows = (height + high - 1) / high;
	int32_t *ends = fetch(world, ROLE_TILE_ENDS, rows * (columns + 1), sizeof(float));
	const int32_t all = ends[rows * (columns + 1) - 1];
	int32_t *list = fetch(world, ROLE_TILE_LIST, (uint32_t)all, sizeof(float)), next = 0;
	int32_t *totals = fetch(world, ROLE_BIN_TOTALS, 2 * rows, sizeof(float));
	float *boxes = fetch(world, ROLE_BOXES, shapes, sizeof(float));
	for (uint32_t tile = 0; tile < columns * rows; tile++) {
		const float left = (float)(tile % columns * wide), top = (float)(tile / columns * high);
		t->wrong_bits += ends[tile + tile / columns] != next;
		for (uint32_t k = 0; k < shapes; k++) {
			const float *box = boxes + 4 * k;
			if (box[BOX_X0] < box[BOX_X1] && box[BOX_X0] < left + (float)wide && box[BOX_X1] > left && box[BOX_Y0] < top + (float)high
				&& box[BOX_Y1] > top) {
				t->wrong_bits += next >= all || list[next] != (int32_t)k;
				next++;
			}
		}
		t->wrong_bits += ends[tile + tile / columns + 1] != next;
	}
	for (uint32_t row = 0; row < rows; row++) {
		int32_t touching = 0;
		for (uint32_t k = 0; k < shapes; k++) {
			const float *box = boxes + 4 * k, top = (float)(row * high);
			touching += box[BOX_X0] < box[BOX_X1] && box[BOX_Y0] < top + (float)high && box[BOX_Y1] > top;
		}
		t->wrong_bits += totals[2 * row] != touching;
		t->wrong_bits += totals[2 * row + 1] != ends[(row + 1) * (columns + 1) - 1] - ends[row * (columns + 1)];
	}
	t->compared += (size_t)next + 2 * rows;
	free(totals);
	free(ends);
	free(list);
	free(boxes);
}

/* What the stages left behind after a picture of one layer with `marks` marks. */
static void compare_stages(trial *t, uint32_t marks, uint32_t width, uint32_t height)
{
	const carom_canvas *canvas = &t->reference->canvas;
	const uint32_t shapes = marks + canvas->shapes, edges = LINE_REST * marks + canvas->edges;
	compare_bits(t, ROLE_PLACED, canvas->vertices, 4 * sizeof(float));
	compare_bits(t, ROLE_BOXES, shapes, 4 * sizeof(float));
	compare_bits(t, ROLE_SHAPES, SHAPES_WIDTH * shapes, 4 * sizeof(float));
	compare_bits(t, ROLE_EDGES, edges, 4 * sizeof(float));
	check_lists(t, t->reference, shapes, width, height);
	check_lists(t, t->device, shapes, width, height);
	compare_values(t, ROLE_PLACED, canvas->vertices);
	compare_values(t, ROLE_EDGES, edges);
}

static void compare_pictures(trial *t, carom_render_def def)
{
	picture expected = picture_of(t->reference, def), oracle = picture_of(t->oracle, def), found = picture_of(t->device, def);
	for (size_t i = 0; i < bytes_of(found); i++) {
		t->wrong_bits += found.pixels[i] != expected.pixels[i];
		t->wrong_values += abs(found.pixels[i] - oracle.pixels[i]) > 1;
	}
	free(expected.pixels);
	free(oracle.pixels);
	free(found.pixels);
}

/* Polygons that are not convex lie over the rest. */
static void fill_all(carom_world *world)
{
	carom_error error;
	fill(world);
	scenery_check(silhouette_add(world, SILHOUETTES, 1.9f, &error), &error);
}

/* False where the device is not there. */
static bool try_device(const scenery_device *device, const char *option, trial *t)
{
	carom_world_def def = room(option, "index");
	carom_render_def render = sized(407, 301);
	render.has_camera = true;
	render.camera = (carom_camera){{-2, -1}, 9}; /* some bodies are cut, some not seen */
	picture first, again;
	memset(t, 0, sizeof *t);
	t->device = scenery_world(&def, device);
	if (!t->device)
		return false;
	t->reference = scenery_world(&def, &scenery_devices[0]);
	t->oracle = judge_oracle(&def);
	fill_all(t->reference);
	fill_all(t->oracle);
	fill_all(t->device);
	compare_pictures(t, with_inset(203, 150));
	first = picture_of(t->device, with_inset(203, 150));
	compare_pictures(t, render);
	compare_stages(t, 2, 407, 301); /* of the room this camera sees the left wall and the ground */
	assert_true(t->reference->canvas.has_lines);
	render.camera.height = 1000;
	compare_pictures(t, render);
	compare_stages(t, 5, 407, 301);
	assert_false(t->reference->canvas.has_lines); /* from so far no circle is large enough */
	again = picture_of(t->device, with_inset(203, 150));
	assert_memory_equal(first.pixels, again.pixels, bytes_of(first));
	free(first.pixels);
	free(again.pixels);
	carom_world_destroy(t->reference);
	carom_world_destroy(t->oracle);
	carom_world_destroy(t->device);
	return true;
}

static void every_stage_on_every_device(void **state)
{
	(void)state;
	SCENERY_EACH_DEVICE(device) {
		for (int k = 0; k < 3; k++) {
			trial t;
			if (!try_device(device, options[k], &t))
				continue;
			assert_true(t.compared > 1000);
			assert_int_equal(t.wrong_bits, 0);
			assert_int_equal(t.wrong_values, 0);
		}
	}
}

static void replace(char *text, size_t size, const char *good, const char *bad)
{
	char *place = strstr(text, good), rest[1 << 14];
	assert_non_null(place);
	snprintf(rest, sizeof rest, "%s", place + strlen(good));
	snprintf(place, size - (size_t)(place - text), "%s%s", bad, rest);
}

/* The comparison must be able to say no: in one kernel the line of sight is turned by a little. */
static void a_broken_kernel_is_found(void **state)
{
	(void)state;
	static char text[1 << 14];
	char folder[200], path[256];
	const char *build = getenv("CAROM_BUILD");
	FILE *file = fopen("kernels/vertices.h", "rb");
	trial t;
	assert_non_null(file);
	text[fread(text, 1, sizeof text - 64, file)] = 0;
	fclose(file);
	replace(text, sizeof text, "v.x * scale", "v.x * scale * 1.001f");
	snprintf(folder, sizeof folder, "%s/broken_rendering", build ? build : "build");
	mkdir(folder, 0777);
	snprintf(path, sizeof path, "%s/vertices.h", folder);
	file = fopen(path, "wb");
	assert_non_null(file);
	fputs(text, file);
	fclose(file);
	setenv("CAROM_KERNEL_DIR", folder, 1);
	bool ran = try_device(&scenery_devices[1], "option3", &t);
	unsetenv("CAROM_KERNEL_DIR");
	if (ran)
		assert_true(t.wrong_bits > 0 && t.wrong_values > 0);
}

/* ---- Nothing is lost */

/* Many large bodies, one over the other: a tile has more of them than there is room for at first. The last is on top. */
static void lists_grow(void **state)
{
	(void)state;
	enum { LAYERS = 700 };
	picture first = {0};
	SCENERY_EACH_DEVICE(device) {
		carom_body_def bodies[LAYERS];
		carom_world_def def = carom_default_world_def();
		carom_world *world = scenery_world(&def, device);
		carom_error error;
		if (!world)
			continue;
		for (uint32_t k = 0; k < LAYERS; k++) {
			bodies[k] = regular(4, 8, 0.02f * (float)k - 7.0f, 0, 0.01f * (float)k);
			bodies[k].color = 0x010101 * (k % 256);
		}
		scenery_check(carom_world_add(world, bodies, LAYERS, NULL, &error), &error);
		picture p = picture_of(world, ten_a_metre(320, 240)), again = picture_of(world, ten_a_metre(320, 240));
		const uint32_t wide = 160 / world->device->kind->tile_width, high = 160 / world->device->kind->tile_height; /* at least, of each */
		assert_true(world->canvas.room[ROLE_TILE_LIST] > wide * high * LAYERS);
		assert_int_equal(color_at(p, 180, 120), 0x010101 * ((LAYERS - 1) % 256));
		assert_memory_equal(p.pixels, again.pixels, bytes_of(p));
		free(again.pixels);
		if (first.pixels)
			assert_memory_equal(p.pixels, first.pixels, bytes_of(p));
		else
			first = p;
		if (first.pixels != p.pixels)
			free(p.pixels);
		carom_world_destroy(world);
	}
	free(first.pixels);
}

/* Wider and higher than what is drawn at once: a box, its sides on borders of pixels, lies over all four parts. */
static void large_pictures_are_drawn_in_parts(void **state)
{
	(void)state;
	static const carom_vec2 box[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = carom_default_world_def();
		carom_world *world = scenery_world(&def, device);
		carom_body_def body = carom_default_body_def();
		carom_error error;
		if (!world)
			continue;
		body.shape = CAROM_POLYGON;
		body.vertices = box;
		body.vertex_count = 4;
		body.position = (carom_vec2){200, -201.6f};
		scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
		picture p = picture_of(world, ten_a_metre(4200, 4160)); /* (0, 0) is at (2100, 2080) */
		for (uint32_t y = 0; y < p.height; y++) {
			for (uint32_t x = 0; x < p.width; x++) {
				bool inside = x >= 4090 && x < 4110 && y >= 4086 && y < 4106;
				if ((color_at(p, x, y) != 0xFCFCFAu) != inside)
					fail_msg("pixel (%u, %u) is %06x", x, y, color_at(p, x, y));
			}
		}
		assert_int_equal(color_at(p, 4095, 4095), color_at(p, 4096, 4096));
		free(p.pixels);
		carom_world_destroy(world);
	}
}

/* A world too large for first_impact, whose textures of pairs would not fit, can be looked at. */
static void a_picture_needs_no_textures_of_pairs(void **state)
{
	(void)state;
	carom_world_def def = scenery_first_impact();
	carom_world *world = scenery_world(&def, &scenery_devices[0]);
	carom_body_def *bodies = calloc(200000, sizeof *bodies);
	carom_error error;
	assert_non_null(bodies);
	for (uint32_t k = 0; k < 200000; k++)
		bodies[k] = regular(0, 0.4f, (float)(k % 500), (float)(k / 500), 0);
	scenery_check(carom_world_add(world, bodies, 200000, NULL, &error), &error);
	free(bodies);
	free(picture_of(world, sized(100, 80)).pixels);
	assert_false(world->prepared);
	assert_int_equal(carom_world_step(world, 1, NULL, &error), CAROM_LIMIT);
	free(picture_of(world, sized(100, 80)).pixels);
	carom_world_destroy(world);
}

static void a_world_that_is_not_drawn_pays_nothing(void **state)
{
	(void)state;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = room(NULL, NULL);
		carom_world *world = scenery_world(&def, device);
		carom_error error;
		if (!world)
			continue;
		fill(world);
		scenery_check(carom_world_step(world, 3, NULL, &error), &error);
		for (int role = ROLE_STREAM; role <= ROLE_PICTURE; role++)
			assert_null(world->textures[role].front);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(every_stage_on_every_device), cmocka_unit_test(a_broken_kernel_is_found),
		cmocka_unit_test(lists_grow), cmocka_unit_test(large_pictures_are_drawn_in_parts), cmocka_unit_test(a_picture_needs_no_textures_of_pairs),
		cmocka_unit_test(a_world_that_is_not_drawn_pays_nothing)};
	return cmocka_run_group_tests_name("rendering", tests, NULL, NULL);
}
