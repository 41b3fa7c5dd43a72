/* Bodies that are not convex, as the host keeps them: masses and moments of inertia, outlines and pieces, coming and going.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "count.h"
#include "hollows.h"
#include "world.h"

static carom_body_def polygon(const carom_vec2 *vertices, uint32_t count)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_POLYGON;
	def.vertices = vertices;
	def.vertex_count = count;
	return def;
}

static carom_world *world_of(const carom_body_def *bodies, size_t count)
{
	const carom_world_def def = carom_default_world_def();
	return runs_world(&def, &scenery_devices[0], bodies, count);
}

static carom_body_info info_of(const carom_world *world, uint32_t index)
{
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	return info;
}

/* ---- Masses ---- */

static void check_mass(const carom_vec2 *vertices, uint32_t count, double x, double y, double area, double second)
{
	carom_body_def def = polygon(vertices, count);
	def.density = 2.0f;
	carom_world *world = world_of(&def, 1);
	const carom_body_info info = info_of(world, 0);
	runs_near((double)info.mass, 2 * area, 2e-6 * area);
	runs_near((double)info.inertia, 2 * second, 4e-6 * second);
	runs_near((double)info.recentred_by.x, x, 1e-6);
	runs_near((double)info.recentred_by.y, y, 1e-6);
	assert_int_equal(info.vertex_count, count);
	for (uint32_t k = 0; k < count; k++) {
		runs_near((double)info.vertices[k].x, (double)vertices[k].x - x, 1e-6);
		runs_near((double)info.vertices[k].y, (double)vertices[k].y - y, 1e-6);
	}
	carom_world_destroy(world);
}

/* A bar of 4 x 1 and one of 1 x 3, about the centre of mass of both, each by Steiner. */
static void an_l_is_two_bars(void **unused)
{
	static const carom_vec2 corners[] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
	const double x = (4 * 2.0 + 3 * 0.5) / 7, y = (4 * 0.5 + 3 * 2.5) / 7;
	const double lying = 4 * (16.0 + 1) / 12 + 4 * ((2 - x) * (2 - x) + (0.5 - y) * (0.5 - y));
	const double standing = 3 * (1.0 + 9) / 12 + 3 * ((0.5 - x) * (0.5 - x) + (2.5 - y) * (2.5 - y));
	(void)unused;
	check_mass(corners, COUNT(corners), x, y, 7, lying + standing);
}

/* So many of 32 parts of a ring, about the +x axis, each a triangle less a smaller one: a = 2 pi / 32, of one of radius r the area is r^2 sin(a) / 2, the second moment r^4 sin(a) (2 + cos(a)) / 12 about the
 * tip, and the centre of mass r cos(a / 2) 2 / 3 from it. */
static void a_c_is_a_part_of_a_ring(void **unused)
{
	enum { ALL = 32, PARTS = 28 };
	const double a = 2 * 3.14159265358979323846 / ALL, out = 2, in = 1.5, begin = -0.5 * PARTS * a;
	carom_vec2 corners[2 * (PARTS + 1)];
	(void)unused;
	for (int k = 0; k <= PARTS; k++) {
		corners[k] = (carom_vec2){(float)(out * cos(begin + k * a)), (float)(out * sin(begin + k * a))};
		corners[2 * PARTS + 1 - k] = (carom_vec2){(float)(in * cos(begin + k * a)), (float)(in * sin(begin + k * a))};
	}
	const double area = PARTS * (out * out - in * in) * sin(a) / 2, along = sin(0.5 * PARTS * a) / sin(0.5 * a); /* of so many unit vectors */
	const double x = along * (pow(out, 3) - pow(in, 3)) * sin(a) / 2 * cos(0.5 * a) * 2 / 3 / area;
	check_mass(corners, COUNT(corners), x, 0, area, PARTS * (pow(out, 4) - pow(in, 4)) * sin(a) * (2 + cos(a)) / 12 - area * x * x);
}

/* ---- What is kept ---- */

/* What a body's pieces are is told by its outline. */
static void check_kept(const carom_world *world, uint32_t index)
{
	const carom_body *body = &carom_world_bodies(world)[index];
	const carom_body_info info = info_of(world, index);
	carom_pieces kept, made;
	if (body->is_convex) {
		assert_int_equal(body->piece_count, 0);
		return;
	}
	carom_pieces_make(info.vertices, info.vertex_count, &made);
	carom_outline_pieces(world, body, &kept);
	assert_true(kept.count == made.count && kept.hull_count == made.hull_count);
	assert_memory_equal(kept.hull, made.hull, made.hull_count * sizeof *made.hull);
	assert_memory_equal(kept.sizes, made.sizes, made.count * sizeof *made.sizes);
	size_t vertices = 0;
	for (uint32_t k = 0; k < made.count; k++)
		vertices += made.sizes[k];
	assert_memory_equal(kept.vertices, made.vertices, vertices * sizeof *made.vertices);
	assert_int_equal(vertices, body->piece_vertices);
	assert_true(carom_outline_size(body) <= 7 * info.vertex_count + 1);
}

enum { BODIES = 200 };

/* Every other one is its predecessor's equal. */
static carom_world *world_of_pairs(void)
{
	static carom_vec2 vertices[BODIES][CAROM_MAX_VERTICES];
	carom_body_def bodies[BODIES];
	scenery_random random = {31};
	for (int k = 0; k < BODIES; k++) {
		const int of = k - k % 2;
		if (k == of)
			bodies[k] = hollows_body(&random, vertices[k]);
		else
			bodies[k] = bodies[of];
	}
	return world_of(bodies, BODIES);
}

static void equal_ones_share(void **unused)
{
	carom_world *world = world_of_pairs();
	size_t all = 0;
	(void)unused;
	for (uint32_t k = 0; k < BODIES; k++) {
		const carom_body *body = &carom_world_bodies(world)[k];
		check_kept(world, k);
		assert_true(k % 2 == 0 || body->vertex_first == body[-1].vertex_first);
		all += carom_outline_size(body);
	}
	assert_int_equal(world->vertices.used, all / 2 * sizeof(carom_vec2));
	carom_world_destroy(world);
}

/* In any order: what is left is as it was, and what nobody has any more takes no memory. */
static void the_others_stay(void **unused)
{
	carom_world *world = world_of_pairs(), *before = world_of_pairs();
	uint32_t was[BODIES];
	scenery_random random = {32};
	size_t left = BODIES;
	(void)unused;
	for (uint32_t k = 0; k < BODIES; k++)
		was[k] = k;
	while (left > 0) {
		const uint32_t gone = (uint32_t)scenery_uniform(&random, 0, (float)left - 0.01f);
		size_t used = 0;
		carom_error error;
		scenery_check(carom_world_remove(world, &gone, 1, &error), &error);
		memmove(&was[gone], &was[gone + 1], (--left - gone) * sizeof *was);
		for (uint32_t k = 0; k < left; k++) {
			const carom_body_info now = info_of(world, k), then = info_of(before, was[k]);
			check_kept(world, k);
			assert_true(now.vertex_count == then.vertex_count && now.mass == then.mass && now.inertia == then.inertia);
			if (now.vertices)
				assert_memory_equal(now.vertices, then.vertices, now.vertex_count * sizeof *now.vertices);
			if (k == 0 || was[k] % 2 == 0 || was[k - 1] != was[k] - 1)
				used += carom_outline_size(&carom_world_bodies(world)[k]);
		}
		assert_int_equal(world->vertices.used, used * sizeof(carom_vec2));
	}
	carom_world_destroy(world);
	carom_world_destroy(before);
}

/* Good ones before it in the same call are not kept, either. */
static void what_is_refused_leaves_nothing(void **unused)
{
	carom_vec2 vertices[2][CAROM_MAX_VERTICES];
	scenery_random random = {33};
	carom_error error = {0};
	(void)unused;
	carom_body_def bodies[3];
	for (int k = 0; k < 2; k++)
		bodies[k] = polygon(vertices[k], hollows_make(&random, HOLLOW_SPIRAL, 1.0f, vertices[k]));
	bodies[2] = scenery_circle(0, 0, 0, 0, -1);
	carom_world *world = world_of(bodies, 1);
	const size_t used = world->vertices.used;
	assert_int_equal(carom_world_add(world, bodies, 3, NULL, &error), CAROM_INVALID_ARGUMENT);
	assert_true(carom_world_body_count(world) == 1 && world->vertices.used == used);
	scenery_check(carom_world_add(world, bodies, 2, NULL, &error), &error);
	for (uint32_t k = 0; k < 3; k++)
		check_kept(world, k);
	carom_world_destroy(world);
}

/* Of a world that has nearly as many vertices as it may, without having them. */
static void so_many_have_room(void **unused)
{
	const carom_body most = {.vertex_count = CAROM_MAX_VERTICES}, convex = {.vertex_count = CAROM_MAX_VERTICES, .is_convex = true};
	const size_t taken = CAROM_MOST_VERTICES - 7 * CAROM_MAX_VERTICES;
	carom_world *world = calloc(1, sizeof *world);
	(void)unused;
	assert_non_null(world);
	world->vertices.used = taken * sizeof(carom_vec2);
	assert_true(carom_outlines_have_room(world, &most));
	world->vertices.used = (taken + 2) * sizeof(carom_vec2);
	assert_true(!carom_outlines_have_room(world, &most) && carom_outlines_have_room(world, &convex));
	free(world);
}

static void first_impact_takes_none(void **unused)
{
	static const carom_vec2 corners[] = {{0, 0}, {2, 0}, {0.5f, 0.5f}, {0, 2}};
	const carom_world_def def = scenery_first_impact();
	const carom_body_def bodies[] = {scenery_circle(0, 0, 0, 0, 1), polygon(corners, COUNT(corners))};
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, 1);
	carom_error error = {0};
	(void)unused;
	assert_int_equal(carom_world_add(world, bodies, 2, NULL, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text,
		"bodies[1].vertices: the polygon is not convex, and the step first_impact takes convex ones alone; take the step events or contacts");
	assert_int_equal(carom_world_body_count(world), 1);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(an_l_is_two_bars), cmocka_unit_test(a_c_is_a_part_of_a_ring),
		cmocka_unit_test(equal_ones_share), cmocka_unit_test(the_others_stay), cmocka_unit_test(what_is_refused_leaves_nothing),
		cmocka_unit_test(so_many_have_room), cmocka_unit_test(first_impact_takes_none)};
	return cmocka_run_group_tests_name("hollows", tests, NULL, NULL);
}
