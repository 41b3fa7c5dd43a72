/* From a body's definition to the body: what is refused and how that is said, centres, masses and moments of inertia.
 * SPDX-License-Identifier: MIT */
#include <float.h>
#include <math.h>
#include <string.h>

#include "count.h"
#include "scenery.h"

static carom_world *new_world(void)
{
	carom_world_def def = carom_default_world_def();
	def.has_room = true;
	def.room_min = (carom_vec2){-100.0f, -100.0f};
	def.room_max = (carom_vec2){100.0f, 100.0f};
	return scenery_world(&def, &scenery_devices[0]);
}

/* As if nothing had been tried: the next body is the second, with its own state, vertices and name. */
static void assert_second(carom_world *world)
{
	static const carom_vec2 corners[3] = {{-1, -1}, {1, -1}, {0, 2}};
	carom_body_def def = scenery_circle(7.0f, 8.0f, 9.0f, 10.0f, 0.0f);
	carom_body_state state;
	carom_body_info info;
	carom_error error;
	uint32_t first = 0;
	def.shape = CAROM_POLYGON;
	def.vertices = corners;
	def.vertex_count = 3;
	def.angular_velocity = 11.0f;
	def.name = "second";
	scenery_check(carom_world_add(world, &def, 1, &first, &error), &error);
	assert_int_equal(first, 1);
	scenery_check(carom_world_get_states(world, 1, 1, &state, &error), &error);
	assert_true(state.position.x == 7.0f && state.position.y == 8.0f && state.velocity.y == 10.0f && state.angular_velocity == 11.0f);
	scenery_check(carom_world_get_body(world, 1, &info, &error), &error);
	assert_int_equal(info.vertex_count, 3);
	assert_memory_equal(info.vertices, corners, sizeof corners);
	assert_string_equal(info.name, "second");
}

/* Of good bodies before it and after it none is added, and the error names the field. */
static void assert_refused(carom_body_def bad, const char *said)
{
	carom_body_def defs[3] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f), bad, scenery_circle(3.0f, 0.0f, 0.0f, 0.0f, 1.0f)};
	carom_world *world = new_world();
	carom_error error = {0};
	uint32_t first = 77;
	defs[0].name = "first";
	scenery_check(carom_world_add(world, defs, 1, NULL, &error), &error);
	const carom_status status = carom_world_add(world, defs, 3, &first, &error);
	if (status != CAROM_INVALID_ARGUMENT || strncmp(error.text, said, strlen(said)) != 0)
		fail_msg("expected \"%s ...\", got %s: \"%s\"", said, carom_status_name(status), error.text);
	assert_int_equal(error.status, CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_world_body_count(world), 1);
	assert_int_equal(first, 77);
	assert_int_equal(carom_world_add(world, defs, 3, &first, NULL), CAROM_INVALID_ARGUMENT);
	assert_second(world);
	carom_world_destroy(world);
}

#define REFUSE(said, field, value)                                         \
	do {                                                                   \
		carom_body_def bad = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f); \
		bad.field = (value);                                               \
		assert_refused(bad, "bodies[1]." said);                            \
	} while (0)

static void numbers_out_of_range(void **unused)
{
	(void)unused;
	static const float no_numbers[] = {NAN, INFINITY, -INFINITY};
	for (size_t i = 0; i < COUNT(no_numbers); i++) {
		const float x = no_numbers[i];
		REFUSE("position: must be two finite numbers (m)", position.x, x);
		REFUSE("position: must be two finite numbers (m)", position.y, x);
		REFUSE("velocity: must be two finite numbers (m/s)", velocity.x, x);
		REFUSE("velocity: must be two finite numbers (m/s)", velocity.y, x);
		REFUSE("force: must be two finite numbers (N)", force.x, x);
		REFUSE("force: must be two finite numbers (N)", force.y, x);
		REFUSE("angle: must be a finite number (rad)", angle, x);
		REFUSE("angular_velocity: must be a finite number (rad/s)", angular_velocity, x);
		REFUSE("torque: must be a finite number (N m)", torque, x);
		REFUSE("radius: found ", radius, x);
		REFUSE("mass: found ", mass, x);
		REFUSE("density: found ", density, x);
	}
	REFUSE("radius: found 0, must be above 0 (m)", radius, 0.0f);
	REFUSE("radius: found -1, must be above 0 (m)", radius, -1.0f);
	REFUSE("mass: found -2, must be above 0 (kg)", mass, -2.0f);
	REFUSE("density: found 0, must be above 0 (kg/m^2)", density, 0.0f);
	REFUSE("density: found -1, must be above 0 (kg/m^2)", density, -1.0f);
	REFUSE("restitution: found -0.25, must be from 0 to 1", restitution, -0.25f);
	REFUSE("restitution: found 1.25, must be from 0 to 1", restitution, 1.25f);
	REFUSE("restitution: found inf, must be from 0 to 1", restitution, INFINITY);
	REFUSE("friction: found -0.25, must be from 0 to 1000", friction, -0.25f);
	REFUSE("friction: found 1000.5, must be from 0 to 1000", friction, 1000.5f);
	REFUSE("friction: found inf, must be from 0 to 1000", friction, INFINITY);
	REFUSE("rolling_friction: found 1000.5, must be from 0 to 1000", rolling_friction, 1000.5f);
	REFUSE("color: must be 0xRRGGBB or CAROM_COLOR_AUTO", color, 0x1000000u);
	REFUSE("position: (100.5, 0) is outside the room", position.x, 100.5f);
	REFUSE("position: (0, -101) is outside the room", position.y, -101.0f);
	REFUSE("shape: is none of", shape, (carom_shape)7);
}

static void what_nothing_pushes_takes_no_force(void **unused)
{
	(void)unused;
	for (int i = 0; i < 9; i++) {
		carom_body_def bad = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f);
		float *const numbers[] = {&bad.velocity.x, &bad.velocity.y, &bad.angular_velocity, &bad.force.x, &bad.force.y, &bad.torque};
		bad.is_static = i < 6;
		bad.is_kinematic = !bad.is_static;
		*numbers[i % 6 + (bad.is_static ? 0 : 3)] = 0.5f;
		assert_refused(bad,
			i < 3       ? "bodies[1].velocity: a static body does not move"
				: i < 6 ? "bodies[1].force: a static body feels no force"
						: "bodies[1].force: a kinematic body feels no force");
	}
}

/* Numbers that are floats but whose reciprocals are not, or only with fewer bits, which devices may take for 0. */
static void masses_have_reciprocals(void **unused)
{
	(void)unused;
	static const float radii[] = {1e-30f, 1e-10f, 1e10f, 1e30f};
	for (size_t i = 0; i < COUNT(radii); i++)
		assert_refused(scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, radii[i]), "bodies[1].mass: the mass or moment of inertia");
	for (size_t i = 0; i < COUNT(radii); i++) {
		carom_body_def fixed = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, i < 2 ? radii[i] * 1e-3f : radii[i] * 1e3f);
		fixed.is_static = true;
		assert_refused(fixed, "bodies[1].mass: the mass or moment of inertia");
	}
	REFUSE("mass: the mass or moment of inertia", mass, 1e-40f);
	REFUSE("mass: the mass or moment of inertia", mass, 3e38f);
}

static void shapes_out_of_range(void **unused)
{
	(void)unused;
	static carom_vec2 corners[65] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}};
	static const uint32_t counts[] = {0, 2, 65, UINT32_MAX};
	for (size_t i = 0; i < COUNT(counts); i++) {
		carom_body_def regular = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f), polygon = regular;
		regular.shape = CAROM_REGULAR;
		regular.sides = counts[i];
		polygon.shape = CAROM_POLYGON;
		polygon.vertices = corners;
		polygon.vertex_count = counts[i];
		assert_refused(regular, "bodies[1].sides: found ");
		assert_refused(polygon, "bodies[1].vertices: found ");
	}
	carom_body_def bad = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
	bad.shape = CAROM_REGULAR;
	bad.sides = 3;
	assert_refused(bad, "bodies[1].radius: found 0, must be above 0 (m)");
	bad.shape = CAROM_POLYGON;
	bad.vertex_count = 3;
	assert_refused(bad, "bodies[1].vertices: are missing");
	bad.vertices = corners;
	corners[2].y = NAN;
	assert_refused(bad, "bodies[1].vertices[2]: must be two finite numbers (m)");
}

/* ---- Polygons */

static carom_body_def polygon(const carom_vec2 *vertices, uint32_t count)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_POLYGON;
	def.vertices = vertices;
	def.vertex_count = count;
	return def;
}

static void polygons_that_are_none(void **unused)
{
	(void)unused;
	static const carom_vec2 touching[] = {{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}, bow_tie[] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
	static const carom_vec2 flat[] = {{0, 0}, {1, 0}, {2, 0}}, there_and_back[] = {{0, 0}, {2, 0}, {3, 0}, {1, 0}};
	static const carom_vec2 twice[] = {{0, 0}, {1, 0}, {1, 0}, {0, 1}}, ends_where_it_began[] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}};
	static const carom_vec2 spike[] = {{0, 0}, {1, 0}, {2, 0}, {1, 0}, {1, 1}, {0, 1}}, point[] = {{1, 1}, {1, 1}, {1, 1}};
	static const carom_vec2 double_round[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};
	carom_vec2 pentagram[5];
	for (int i = 0; i < 5; i++)
		pentagram[i] = (carom_vec2){(float)cos(i * 0.8 * 3.14159265), (float)sin(i * 0.8 * 3.14159265)};
	assert_refused(polygon(touching, 5), "bodies[1].vertices: the polygon crosses or touches itself; it must have 3 to 64 vertices in order");
	assert_refused(polygon(bow_tie, 4), "bodies[1].vertices: the polygon crosses or touches itself");
	assert_refused(polygon(pentagram, 5), "bodies[1].vertices: the polygon crosses or touches itself");
	assert_refused(polygon(double_round, 8), "bodies[1].vertices: the polygon crosses or touches itself");
	assert_refused(polygon(flat, 3), "bodies[1].vertices: the polygon has no area");
	assert_refused(polygon(there_and_back, 4), "bodies[1].vertices: the polygon ");
	assert_refused(polygon(twice, 4), "bodies[1].vertices: the polygon has two vertices at the same place");
	assert_refused(polygon(ends_where_it_began, 4), "bodies[1].vertices: the polygon has two vertices at the same place");
	assert_refused(polygon(point, 3), "bodies[1].vertices: the polygon has two vertices at the same place");
	assert_refused(polygon(spike, 6), "bodies[1].vertices: the polygon crosses or touches itself");
}

static carom_body_info info_of(carom_body_def def)
{
	static carom_vec2 vertices[CAROM_MAX_VERTICES]; /* the world does not outlive this call */
	carom_world *world = new_world();
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_add(world, &def, 1, NULL, &error), &error);
	scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
	if (info.vertices)
		info.vertices = memcpy(vertices, info.vertices, info.vertex_count * sizeof *vertices);
	carom_world_destroy(world);
	return info;
}

static void assert_near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.9g, expected %.9g within %.2g", found, expected, tolerance);
}

/* Twice the area, above 0 counter-clockwise. */
static double turn_of(const carom_body_info *info)
{
	double sum = 0.0;
	for (uint32_t i = 0; i < info->vertex_count; i++) {
		const carom_vec2 a = info->vertices[i], b = info->vertices[(i + 1) % info->vertex_count];
		sum += (double)a.x * (double)b.y - (double)a.y * (double)b.x;
	}
	return sum;
}

/* Either way round, with vertices in the middle of an edge too, the square is the same body. */
static void either_way_round(void **unused)
{
	(void)unused;
	static const carom_vec2 left[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, right[] = {{0, 0}, {0, 2}, {2, 2}, {2, 0}};
	static const carom_vec2 more[] = {{0, 0}, {0.5f, 0}, {1.5f, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
	const carom_body_def squares[] = {polygon(left, 4), polygon(right, 4), polygon(more, 8)};
	for (size_t i = 0; i < COUNT(squares); i++) {
		const carom_body_info info = info_of(squares[i]);
		assert_int_equal(info.vertex_count, squares[i].vertex_count);
		assert_near(turn_of(&info), 8.0, 1e-6);
		assert_near((double)info.mass, 4.0, 1e-6);
		assert_near((double)info.inertia, 4.0 * 8.0 / 12.0, 1e-6);
		assert_near((double)info.radius, sqrt(2.0), 1e-6);
		assert_near((double)info.recentred_by.x, 1.0, 0.0);
		assert_near((double)info.recentred_by.y, 1.0, 0.0);
	}
}

static void centre_of_mass_is_the_origin(void **unused)
{
	(void)unused;
	static const carom_vec2 triangle[] = {{10, 20}, {13, 20}, {10, 26}}, centred[] = {{-1, -2}, {2, -2}, {-1, 4}};
	carom_body_def def = polygon(triangle, 3);
	def.density = 2.0f;
	def.position = (carom_vec2){-3.0f, 4.0f};
	carom_body_info info = info_of(def);
	assert_near((double)info.recentred_by.x, 11.0, 1e-5);
	assert_near((double)info.recentred_by.y, 22.0, 1e-5);
	for (int i = 0; i < 3; i++) {
		assert_near((double)info.vertices[i].x, (double)centred[i].x, 1e-5);
		assert_near((double)info.vertices[i].y, (double)centred[i].y, 1e-5);
	}
	assert_near((double)info.mass, 2.0 * 9.0, 1e-4);
	assert_near((double)info.inertia, 18.0 * (9.0 + 36.0) / 18.0, 1e-3);
	info = info_of(polygon(centred, 3));
	assert_true(info.recentred_by.x == 0.0f && info.recentred_by.y == 0.0f);
	assert_memory_equal(info.vertices, centred, sizeof centred);
}

/* A polygon of k sides about a circle of radius r: area k r^2 sin(a) / 2, moment m r^2 (2 + cos(a)) / 6, a = 2 pi / k. */
static void regular_polygons(void **unused)
{
	(void)unused;
	for (uint32_t k = CAROM_MIN_VERTICES; k <= CAROM_MAX_VERTICES; k++) {
		const double a = 2.0 * 3.14159265358979 / k, r = 1.5, mass = 0.5 * k * r * r * sin(a) * 3.0;
		carom_body_def def = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.5f);
		def.shape = CAROM_REGULAR;
		def.sides = k;
		def.density = 3.0f;
		const carom_body_info info = info_of(def);
		assert_int_equal(info.shape, CAROM_REGULAR);
		assert_int_equal(info.vertex_count, k);
		assert_true(info.vertices[0].x == 1.5f && info.vertices[0].y == 0.0f && info.radius == 1.5f);
		assert_true(info.recentred_by.x == 0.0f && info.recentred_by.y == 0.0f);
		assert_near((double)info.mass, mass, 1e-6 * mass);
		assert_near((double)info.inertia, mass * r * r * (2.0 + cos(a)) / 6.0, 1e-6 * mass * r * r);
		for (uint32_t i = 0; i < k; i++) {
			assert_near((double)info.vertices[i].x, r * cos(a * i), 2e-7);
			assert_near((double)info.vertices[i].y, r * sin(a * i), 2e-7);
		}
	}
}

static void discs_and_given_masses(void **unused)
{
	(void)unused;
	carom_body_def def = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
	carom_body_info info = info_of(def);
	assert_near((double)info.mass, 0.7853981634, 1e-7);
	assert_near((double)info.inertia, 0.7853981634 * 0.125, 1e-8);
	assert_true(info.vertex_count == 1 && !info.vertices && info.density == 1.0f && info.radius == 0.5f);
	def.mass = 3.0f;
	info = info_of(def);
	assert_true(info.mass == 3.0f && info.density == 0.0f);
	assert_near((double)info.inertia, 0.375, 1e-7);
	def.is_static = true;
	info = info_of(def);
	assert_true(info.is_static && isinf(info.mass) && isinf(info.inertia));
}

static void the_rest_is_kept(void **unused)
{
	(void)unused;
	char name[] = "a name";
	carom_body_def def = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
	carom_world *world = new_world();
	carom_body_info info;
	carom_error error;
	def.name = name;
	def.color = 0x123456;
	def.restitution = 0.25f;
	def.force = (carom_vec2){1.0f, -2.0f};
	def.torque = 0.5f;
	scenery_check(carom_world_add(world, &def, 1, NULL, &error), &error);
	name[0] = 'A';
	def = carom_default_body_def();
	def.radius = 1.0f;
	scenery_check(carom_world_add(world, &def, 1, NULL, &error), &error);
	scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
	assert_string_equal(info.name, "a name");
	assert_true(info.color == 0x123456 && info.restitution == 0.25f && info.torque == 0.5f && !info.is_static);
	assert_true(info.force.x == 1.0f && info.force.y == -2.0f && info.shape == CAROM_CIRCLE);
	scenery_check(carom_world_get_body(world, 1, &info, &error), &error);
	assert_null(info.name);
	assert_true(info.color == CAROM_COLOR_AUTO && info.restitution == 1.0f); /* the world's */
	carom_world_destroy(world);
}

/* Of 600 polygons, more than are remembered, each has its own vertices, and an equal one those of one before or a copy. */
static void equal_polygons_share_vertices(void **unused)
{
	(void)unused;
	carom_world *world = new_world();
	carom_body_info info, twin;
	carom_error error;
	carom_body_def bad = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, -1.0f);
	for (uint32_t i = 0; i < 600; i++) {
		carom_body_def two[2] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f + (float)(i / 5)), bad};
		two[0].shape = CAROM_REGULAR;
		two[0].sides = 3 + i % 5;
		assert_int_equal(carom_world_add(world, two, 2, NULL, &error), CAROM_INVALID_ARGUMENT); /* and leaves nothing behind */
		scenery_check(carom_world_add(world, two, 1, NULL, &error), &error);
		scenery_check(carom_world_add(world, two, 1, NULL, &error), &error);
	}
	for (uint32_t i = 0; i < 600; i++) {
		scenery_check(carom_world_get_body(world, 2 * i, &info, &error), &error);
		scenery_check(carom_world_get_body(world, 2 * i + 1, &twin, &error), &error);
		assert_int_equal(info.vertex_count, 3 + i % 5);
		assert_true(info.vertices[0].x == 1.0f + (float)(i / 5) && info.vertices == twin.vertices);
	}
	carom_world_destroy(world);
}

/* What is given up with a call that failed is not shared by the next. */
static void outlines_given_up_are_not_shared(void **unused)
{
	(void)unused;
	carom_world_def def = carom_default_world_def();
	carom_body_def bodies[2] = {carom_default_body_def(), carom_default_body_def()};
	carom_body_info info;
	carom_world *world = NULL;
	def.device = "cpu";
	for (int i = 0; i < 2; i++) {
		bodies[i].shape = CAROM_REGULAR;
		bodies[i].sides = 5;
		bodies[i].radius = 1.0f + (float)i;
	}
	bodies[1].density = -1.0f;
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_OK);
	assert_int_equal(carom_world_add(world, bodies, 2, NULL, NULL), CAROM_INVALID_ARGUMENT);
	bodies[1].density = 1.0f;
	assert_int_equal(carom_world_add(world, &bodies[0], 1, NULL, NULL), CAROM_OK);
	assert_int_equal(carom_world_add(world, &bodies[1], 1, NULL, NULL), CAROM_OK);
	for (uint32_t i = 0; i < 2; i++) {
		assert_int_equal(carom_world_get_body(world, i, &info, NULL), CAROM_OK);
		assert_true(info.vertices[0].x == 1.0f + (float)i);
	}
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(outlines_given_up_are_not_shared), cmocka_unit_test(numbers_out_of_range),
		cmocka_unit_test(what_nothing_pushes_takes_no_force), cmocka_unit_test(masses_have_reciprocals), cmocka_unit_test(shapes_out_of_range),
		cmocka_unit_test(polygons_that_are_none), cmocka_unit_test(either_way_round), cmocka_unit_test(centre_of_mass_is_the_origin),
		cmocka_unit_test(regular_polygons), cmocka_unit_test(discs_and_given_masses), cmocka_unit_test(the_rest_is_kept),
		cmocka_unit_test(equal_polygons_share_vertices)};
	return cmocka_run_group_tests_name("bodies", tests, NULL, NULL);
}
