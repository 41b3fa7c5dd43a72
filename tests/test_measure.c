/* carom_world_measure: sums against sums by hand, overlaps against known ones and against every pair.
 * SPDX-License-Identifier: MIT */
#include "carom.h"
#include "count.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define PI 3.14159265358979323846

static const carom_vec2 square[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

static carom_body_def circle_at(double x, double y, double radius)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_CIRCLE;
	def.radius = (float)radius;
	def.position = (carom_vec2){(float)x, (float)y};
	return def;
}

/* Two metres a side. */
static carom_body_def square_at(double x, double y, double angle)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_POLYGON;
	def.vertices = square;
	def.vertex_count = 4;
	def.position = (carom_vec2){(float)x, (float)y};
	def.angle = (float)angle;
	return def;
}

static carom_world *world_of(carom_world_def def, const carom_body_def *bodies, size_t count)
{
	carom_world *world = NULL;
	carom_error error = {0};
	def.device = "cpu";
	if (carom_world_create(&def, &world, &error) != CAROM_OK || carom_world_add(world, bodies, count, NULL, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return world;
}

static carom_measure measure_of(carom_world *world)
{
	carom_measure measure;
	carom_error error = {0};
	if (carom_world_measure(world, &measure, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return measure;
}

static void check_near(const char *what, double found, double wanted, double tolerance)
{
	if (!(fabs(found - wanted) <= tolerance))
		fail_msg("%s: %.12g instead of %.12g", what, found, wanted);
}

/* ---- Sums ----------------------------------------------------------------------------------------------------- */

static void sums_are_those_by_hand(void **state)
{
	(void)state;
	carom_world_def def = carom_default_world_def();
	carom_body_def bodies[3] = {circle_at(2, 3, 0.5), square_at(-4, 1, 0.5), square_at(20, 20, 0)};
	def.gravity = (carom_vec2){0.5f, -10};
	bodies[0].mass = 2, bodies[0].velocity = (carom_vec2){3, -1}, bodies[0].angular_velocity = 4;
	bodies[1].mass = 6, bodies[1].velocity = (carom_vec2){-1, 2}, bodies[1].angular_velocity = -0.5f;
	bodies[2].is_static = true;
	carom_world *world = world_of(def, bodies, COUNT(bodies));
	carom_measure found = measure_of(world);
	double disc = 2 * 0.5 * 0.5 / 2, block = 6 * (2.0 * 2 + 2 * 2) / 12; /* moments of inertia */
	check_near("kinetic energy", found.kinetic_energy, (2 * 10 + disc * 16 + 6 * 5 + block * 0.25) / 2, 1e-5);
	check_near("potential energy", found.potential_energy, -2 * (0.5 * 2 - 10 * 3) - 6 * (0.5 * -4 - 10 * 1), 1e-5);
	check_near("momentum x", found.momentum_x, 2 * 3 + 6 * -1, 1e-5);
	check_near("momentum y", found.momentum_y, 2 * -1 + 6 * 2, 1e-5);
	double angular = 2 * (2 * -1 - 3 * 3) + disc * 4 + 6 * (-4 * 2 - 1 * -1) + block * -0.5;
	check_near("angular momentum", found.angular_momentum, angular, 1e-5);
	check_near("overlap", found.max_penetration, 0, 0);
	carom_world_destroy(world);
}

static void an_empty_world_measures_nothing(void **state)
{
	(void)state;
	carom_world *world = world_of(carom_default_world_def(), NULL, 0);
	carom_measure found = measure_of(world);
	assert_true(found.kinetic_energy == 0 && found.potential_energy == 0 && found.momentum_x == 0 && found.momentum_y == 0);
	assert_true(found.angular_momentum == 0 && found.max_penetration == 0);
	carom_world_destroy(world);
}

static void null_is_an_error(void **state)
{
	(void)state;
	carom_measure measure = {.kinetic_energy = 42};
	carom_error error = {0};
	carom_world *world = world_of(carom_default_world_def(), NULL, 0);
	assert_int_equal(carom_world_measure(NULL, &measure, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "world: found NULL, must be given");
	assert_true(measure.kinetic_energy == 42);
	assert_int_equal(carom_world_measure(world, NULL, NULL), CAROM_INVALID_ARGUMENT);
	carom_world_destroy(world);
}

/* ---- Known overlaps ------------------------------------------------------------------------------------------- */

static void overlaps_of_pairs_are_known(void **state)
{
	(void)state;
	double diagonal = sqrt(2);
	struct {
		const char *what;
		carom_body_def a, b;
		double overlap;
	} cases[] = {
		{"circle and circle", circle_at(0, 0, 1), circle_at(0.84, 1.12, 0.5), 0.1},
		{"circles apart", circle_at(0, 0, 1), circle_at(1.2, 1.2, 0.5), 0},
		{"circle in circle", circle_at(0, 0, 1), circle_at(0.25, 0, 0.5), 1.25},
		{"face and circle", square_at(0, 0, 0), circle_at(1.4, 0.3, 0.5), 0.1},
		{"circle and turned face", circle_at(1.4 * sqrt(0.5), 1.4 * sqrt(0.5), 0.5), square_at(0, 0, PI / 4), 0.1},
		{"corner and circle", square_at(0, 0, 0), circle_at(1.3, -1.4, 0.6), 0.1},
		{"circle beside corner", square_at(0, 0, 0), circle_at(1.45, 1.45, 0.6), 0},
		{"centre of the circle inside", circle_at(-0.9, 0.2, 0.5), square_at(0, 0, 0), 0.6},
		{"face and face", square_at(0, 0, 0), square_at(0.7, -1.9, 0), 0.1},
		{"corner and face", square_at(0, 0, 0), square_at(0.5 + diagonal, 0.25, PI / 4), 0.5},
		{"face and corner", square_at(0.25, 0.5 + diagonal, PI / 4), square_at(0, 0, 0), 0.5},
		{"boxes alone overlap", square_at(0, 0, PI / 4), square_at(1.5, 1.5, PI / 4), 0},
		{"polygon in polygon", square_at(3, 3, 0), square_at(3, 3, 0), 2},
	};
	for (size_t k = 0; k < COUNT(cases); k++) {
		carom_body_def bodies[2] = {cases[k].a, cases[k].b};
		carom_world *world = world_of(carom_default_world_def(), bodies, 2);
		check_near(cases[k].what, measure_of(world).max_penetration, cases[k].overlap, 1e-6);
		carom_world_destroy(world);
	}
}

static void static_bodies_overlap_only_what_moves(void **state)
{
	(void)state;
	carom_body_def bodies[3] = {square_at(0, 0, 0), square_at(1, 0, 0), circle_at(-1.4, 0, 0.5)};
	bodies[0].is_static = bodies[1].is_static = true;
	carom_world *world = world_of(carom_default_world_def(), bodies, 3);
	check_near("static and circle", measure_of(world).max_penetration, 0.1, 1e-6);
	carom_world_destroy(world);
	world = world_of(carom_default_world_def(), bodies, 2);
	check_near("static and static", measure_of(world).max_penetration, 0, 0);
	carom_world_destroy(world);
}

static void walls_are_overlapped_too(void **state)
{
	(void)state;
	carom_world_def def = carom_default_world_def();
	carom_body_def bodies[2] = {circle_at(2, 0, 0.5), square_at(-2, 0, 0)};
	carom_body_state states[2];
	def.has_room = true;
	def.room_min = (carom_vec2){-5, -4}, def.room_max = (carom_vec2){5, 4};
	carom_world *world = world_of(def, bodies, 2);
	check_near("inside", measure_of(world).max_penetration, 0, 0);
	assert_int_equal(carom_world_get_states(world, 0, 2, states, NULL), CAROM_OK);
	states[0].position = (carom_vec2){2, -3.75f};
	assert_int_equal(carom_world_set_states(world, 0, 2, states, NULL), CAROM_OK);
	check_near("circle", measure_of(world).max_penetration, 0.25, 1e-6);
	states[1].position = (carom_vec2){-4, 0}, states[1].angle = (float)(PI / 4);
	assert_int_equal(carom_world_set_states(world, 0, 2, states, NULL), CAROM_OK);
	check_near("polygon", measure_of(world).max_penetration, sqrt(2) - 1, 1e-6);
	carom_world_destroy(world);
}

/* ---- Against every pair --------------------------------------------------------------------------------------- */

typedef struct outline {
	double x, y, radius;
	uint32_t count; /* 0 for a circle */
	double px[CAROM_MAX_VERTICES], py[CAROM_MAX_VERTICES];
	bool is_static;
} outline;

static outline outline_of(carom_world *world, uint32_t index)
{
	carom_body_info info;
	carom_body_state at;
	assert_int_equal(carom_world_get_body(world, index, &info, NULL), CAROM_OK);
	assert_int_equal(carom_world_get_states(world, index, 1, &at, NULL), CAROM_OK);
	outline o = {.x = at.position.x, .y = at.position.y, .radius = info.radius, .is_static = info.is_static};
	double c = cos((double)at.angle), s = sin((double)at.angle);
	o.count = info.vertices ? info.vertex_count : 0;
	for (uint32_t k = 0; k < o.count; k++) {
		o.px[k] = o.x + c * info.vertices[k].x - s * info.vertices[k].y;
		o.py[k] = o.y + s * info.vertices[k].x + c * info.vertices[k].y;
	}
	return o;
}

/* How far a and b overlap when both are projected on the normals of a's faces. */
static double overlap_on_normals(const outline *a, const outline *b)
{
	double least = HUGE_VAL;
	for (uint32_t k = 0; k < a->count; k++) {
		uint32_t next = (k + 1) % a->count;
		double ex = a->px[next] - a->px[k], ey = a->py[next] - a->py[k], length = hypot(ex, ey);
		double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
		const outline *both[2] = {a, b};
		for (int side = 0; side < 2; side++) {
			for (uint32_t i = 0; i < both[side]->count; i++) {
				double on = (both[side]->px[i] * ey - both[side]->py[i] * ex) / length;
				low[side] = fmin(low[side], on), high[side] = fmax(high[side], on);
			}
		}
		least = fmin(least, fmin(high[0] - low[1], high[1] - low[0]));
	}
	return least;
}

/* The distance of a point from a polygon's border, negative inside. */
static double distance_from_border(const outline *polygon, double x, double y)
{
	double nearest = HUGE_VAL;
	bool inside = true;
	for (uint32_t k = 0; k < polygon->count; k++) {
		uint32_t next = (k + 1) % polygon->count;
		double ex = polygon->px[next] - polygon->px[k], ey = polygon->py[next] - polygon->py[k];
		double dx = x - polygon->px[k], dy = y - polygon->py[k];
		double part = fmin(fmax((dx * ex + dy * ey) / (ex * ex + ey * ey), 0), 1);
		nearest = fmin(nearest, hypot(dx - part * ex, dy - part * ey));
		inside = inside && ex * dy - ey * dx >= 0;
	}
	return inside ? -nearest : nearest;
}

static double overlap_of(const outline *a, const outline *b)
{
	if (a->count == 0 && b->count == 0)
		return a->radius + b->radius - hypot(a->x - b->x, a->y - b->y);
	if (a->count == 0)
		return a->radius - distance_from_border(b, a->x, a->y);
	if (b->count == 0)
		return b->radius - distance_from_border(a, b->x, b->y);
	return fmin(overlap_on_normals(a, b), overlap_on_normals(b, a));
}

static double deepest_of_every_pair(carom_world *world)
{
	size_t count = carom_world_body_count(world);
	outline *outlines = malloc(count * sizeof *outlines);
	double deepest = 0;
	assert_non_null(outlines);
	for (uint32_t i = 0; i < count; i++) {
		outlines[i] = outline_of(world, i);
		for (uint32_t k = 0; k < i; k++) {
			if (!outlines[i].is_static || !outlines[k].is_static)
				deepest = fmax(deepest, overlap_of(&outlines[i], &outlines[k]));
		}
	}
	free(outlines);
	return deepest;
}

static double at_random(uint64_t *seed, double low, double high)
{
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return low + (high - low) * (double)(*seed >> 40) / 16777216;
}

/* Bodies anywhere in a square of `side`, their radii from 2^-octaves to 1. */
static void throw_bodies(uint64_t *seed, carom_body_def *bodies, size_t count, double side, double octaves)
{
	for (size_t k = 0; k < count; k++) {
		double radius = exp2(-at_random(seed, 0, octaves));
		bodies[k] = circle_at(at_random(seed, -side / 2, side / 2), at_random(seed, -side / 2, side / 2), radius);
		bodies[k].angle = (float)at_random(seed, -3, 3);
		bodies[k].is_static = at_random(seed, 0, 1) < 0.2;
		if (at_random(seed, 0, 1) < 0.6) {
			bodies[k].shape = CAROM_REGULAR;
			bodies[k].sides = 3 + (uint32_t)at_random(seed, 0, 5.99);
		}
	}
}

static void grids_miss_no_pair(void **state)
{
	(void)state;
	struct {
		size_t count;
		double side, octaves;
	} worlds[] = {{2, 2, 0}, {60, 60, 0}, {60, 30, 1}, {120, 60, 6}, {250, 500, 0.2}, {120, 3, 12}, {30, 1e5, 30}, {250, 40, 3}};
	carom_body_def bodies[250];
	uint64_t seed = 2026;
	for (int round = 0; round < 12; round++) {
		for (size_t k = 0; k < COUNT(worlds); k++) {
			throw_bodies(&seed, bodies, worlds[k].count, worlds[k].side, worlds[k].octaves);
			carom_world *world = world_of(carom_default_world_def(), bodies, worlds[k].count);
			check_near("deepest overlap", measure_of(world).max_penetration, deepest_of_every_pair(world), 1e-9);
			carom_world_destroy(world);
		}
	}
}

/* One overlap in a crowd of bodies that only just do not touch, for each of its places: no cell border hides it. */
static void one_overlap_is_found_wherever_it_is(void **state)
{
	(void)state;
	enum { SIDE = 6 };
	carom_body_def bodies[SIDE * SIDE];
	for (size_t moved = 0; moved < SIDE * SIDE - 1; moved++) {
		for (size_t k = 0; k < SIDE * SIDE; k++)
			bodies[k] = circle_at((double)(k % SIDE) * 1.01, (double)(k / SIDE) * 1.01, 0.5);
		bodies[moved].position.x += moved % SIDE < SIDE - 1 ? 0.02f : -0.02f;
		carom_world *world = world_of(carom_default_world_def(), bodies, COUNT(bodies));
		check_near("overlap", measure_of(world).max_penetration, 0.01, 1e-6);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(sums_are_those_by_hand), cmocka_unit_test(an_empty_world_measures_nothing),
		cmocka_unit_test(null_is_an_error), cmocka_unit_test(overlaps_of_pairs_are_known), cmocka_unit_test(static_bodies_overlap_only_what_moves),
		cmocka_unit_test(walls_are_overlapped_too), cmocka_unit_test(grids_miss_no_pair), cmocka_unit_test(one_overlap_is_found_wherever_it_is)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
