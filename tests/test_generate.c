/* carom generate: what it promises of its scenes.
 * SPDX-License-Identifier: MIT */
#include "command.h"

#include <math.h>

static carom_scene *generate(const char *options)
{
	char line[256], path[128];
	carom_scene *scene = NULL;
	carom_error error = {0};
	snprintf(line, sizeof line, "$C generate %s --out $D/scene.json", options);
	check(line, 0, NULL);
	snprintf(path, sizeof path, "%s/scene.json", call.folder);
	if (carom_scene_read(path, &scene, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return scene;
}

static void the_same_call_gives_the_same_bytes(void **state)
{
	(void)state;
	check("$C generate --shape mixed --count 500 >$D/a && $C generate --shape mixed --count 500 --seed 1 >$D/b && cmp $D/a $D/b", 0, NULL);
	check("$C generate --shape mixed --count 500 --seed 2 >$D/b; ! cmp -s $D/a $D/b", 0, NULL);
}

/* On whatever machine: the scenes of the repository were made by these calls. */
static void every_machine_gives_the_same_bytes(void **state)
{
	(void)state;
	check("$C generate --shape triangle --count 256 | cmp - scenes/triangles_256.json", 0, NULL);
	check("$C generate --shape triangle --count 1024 | cmp - scenes/triangles_1024.json", 0, NULL);
	check("$C generate --shape circle --count 256 | cmp - scenes/circles_256.json", 0, NULL);
	check("$C generate --shape circle --count 1024 | cmp - scenes/circles_1024.json", 0, NULL);
}

static double radius_of(const carom_body_def *body)
{
	double radius = (double)body->radius;
	for (uint32_t k = 0; body->shape == CAROM_POLYGON && k < body->vertex_count; k++)
		radius = fmax(radius, hypot((double)body->vertices[k].x, (double)body->vertices[k].y));
	return radius;
}

/* The circles around the bodies keep apart, from the walls too. */
static void check_apart(const carom_scene *scene)
{
	for (size_t k = 0; k < scene->body_count; k++) {
		const carom_body_def *a = &scene->bodies[k];
		double reach = fmax(fabs((double)a->position.x), fabs((double)a->position.y)) + radius_of(a);
		if (reach >= (double)scene->world.room_max.x)
			fail_msg("body %zu touches a wall", k);
		for (size_t i = 0; i < k; i++) {
			const carom_body_def *b = &scene->bodies[i];
			double dx = (double)a->position.x - (double)b->position.x, dy = (double)a->position.y - (double)b->position.y;
			if (sqrt(dx * dx + dy * dy) <= radius_of(a) + radius_of(b))
				fail_msg("bodies %zu and %zu touch", i, k);
		}
	}
}

/* At a density of 1, mass is area. */
static void check_fill(carom_scene *scene, double fill)
{
	carom_world *world = NULL;
	carom_error error = {0};
	double mass = 0, side = 2 * (double)scene->world.room_max.x;
	scene->world.device = "cpu";
	if (carom_scene_create_world(scene, &world, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	for (uint32_t k = 0; k < scene->body_count; k++) {
		carom_body_info info;
		assert_int_equal(carom_world_get_body(world, k, &info, NULL), CAROM_OK);
		mass += (double)info.mass;
	}
	carom_world_destroy(world);
	if (fabs(mass / (side * side) - fill) > 1e-5 * fill)
		fail_msg("a fill of %g instead of %g", mass / (side * side), fill);
}

static void nothing_touches_at_any_fill(void **state)
{
	(void)state;
	static const struct {
		const char *options;
		size_t count;
		double fill;
	} cases[] = {
		{"--shape circle --count 1", 1, 0.25},
		{"--shape circle --count 1 --fill 0.7", 1, 0.7},
		{"--shape circle --count 2 --fill 0.4", 2, 0.4},
		{"--shape square --count 3", 3, 0.25},
		{"--shape circle --count 7 --fill 1e-6", 7, 1e-6},
		{"--shape circle --count 1000", 1000, 0.25},
		{"--shape circle --count 1000 --fill 0.5 --radius 1e-3", 1000, 0.5},
		{"--shape circle --count 1000 --fill 0.8", 1000, 0.8},
		{"--shape triangle --count 1000", 1000, 0.25},
		{"--shape triangle --count 1000 --fill 0.34 --radius 300", 1000, 0.34},
		{"--shape square --count 1000 --fill 0.5", 1000, 0.5},
		{"--shape regular:64 --count 999 --fill 0.6", 999, 0.6},
		{"--shape star:5 --count 300", 300, 0.25},
		{"--shape star:32 --count 200 --fill 0.3 --radius 7", 200, 0.3},
		{"--shape mixed --count 1001 --fill 0.4", 1001, 0.4},
	};
	for (size_t k = 0; k < COUNT(cases); k++) {
		carom_scene *scene = generate(cases[k].options);
		assert_int_equal(scene->body_count, cases[k].count);
		check_apart(scene);
		check_fill(scene, cases[k].fill);
		carom_scene_destroy(scene);
	}
}

/* Mean and spread of a component are those of a uniform one, and circles don't turn. */
static void speeds_are_uniform(void **state)
{
	(void)state;
	carom_scene *scene = generate("--shape triangle --count 10000 --speed 3");
	double sum = 0, squares = 0, largest = 0, turning = 0;
	for (size_t k = 0; k < scene->body_count; k++) {
		double v = (double)scene->bodies[k].velocity.x, w = (double)scene->bodies[k].angular_velocity;
		sum += v;
		squares += v * v;
		largest = fmax(largest, fabs(v));
		turning = fmax(turning, fabs(w));
		assert_true(fabs((double)scene->bodies[k].angle) <= 3.1415927);
	}
	assert_true(fabs(sum / 10000) < 0.1 && fabs(squares / 10000 - 3) < 0.15);
	assert_true(largest <= 3 && largest > 2.99 && turning <= 3 && turning > 2.99);
	carom_scene_destroy(scene);
	scene = generate("--shape circle --count 10 --speed 0");
	for (size_t k = 0; k < scene->body_count; k++)
		assert_true(scene->bodies[k].angular_velocity == 0 && scene->bodies[k].velocity.x == 0 && !signbit(scene->bodies[k].velocity.x));
	carom_scene_destroy(scene);
}

/* Bodies that follow each other in the file are as far apart as any two: half a side (0.52 of it in the mean). */
static void neighbours_in_the_file_are_none_in_the_room(void **state)
{
	(void)state;
	carom_scene *scene = generate("--shape circle --count 4000");
	double sum = 0;
	for (size_t k = 1; k < scene->body_count; k++) {
		carom_vec2 a = scene->bodies[k - 1].position, b = scene->bodies[k].position;
		sum += sqrt(pow((double)a.x - (double)b.x, 2) + pow((double)a.y - (double)b.y, 2));
	}
	double mean = sum / (double)(scene->body_count - 1) / (2 * (double)scene->world.room_max.x);
	if (fabs(mean - 0.52) > 0.03)
		fail_msg("%g of a side apart", mean);
	carom_scene_destroy(scene);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_call_gives_the_same_bytes), cmocka_unit_test(every_machine_gives_the_same_bytes),
		cmocka_unit_test(nothing_touches_at_any_fill), cmocka_unit_test(speeds_are_uniform),
		cmocka_unit_test(neighbours_in_the_file_are_none_in_the_room)};
	return cmocka_run_group_tests_name("generate", tests, make_folder, remove_folder);
}
