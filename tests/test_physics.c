/* What is known without a computer: hits with textbook answers, and what must be kept. On every device. */
#include <math.h>
#include <string.h>

#include "scenery.h"

static carom_world *world_of(const carom_world_def *def, const scenery_device *device, const carom_body_def *bodies, size_t count)
{
	carom_world *world = scenery_world(def, device);
	carom_error error;
	if (world)
		scenery_check(carom_world_add(world, bodies, count, NULL, &error), &error);
	return world;
}

static carom_report advance(carom_world *world, double seconds)
{
	carom_report report;
	carom_error error;
	scenery_check(carom_world_advance(world, seconds, &report, &error), &error);
	return report;
}

static carom_report step(carom_world *world, uint64_t steps)
{
	carom_report report;
	carom_error error;
	scenery_check(carom_world_step(world, steps, &report, &error), &error);
	return report;
}

static carom_body_state state_of(carom_world *world, uint32_t index)
{
	carom_body_state state;
	carom_error error;
	scenery_check(carom_world_get_states(world, index, 1, &state, &error), &error);
	return state;
}

static carom_measure measure_of(carom_world *world)
{
	carom_measure measure;
	carom_error error;
	scenery_check(carom_world_measure(world, &measure, &error), &error);
	return measure;
}

static void assert_near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.9g, expected %.9g within %.2g", found, expected, tolerance);
}

/* Equal circles head-on swap their velocities, at the time the quadratic says [4.1]. */
static void head_on_circles_swap(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	const carom_body_def bodies[2] = {scenery_circle(-1.0f, 0.0f, 3.0f, 0.0f, 0.25f), scenery_circle(1.0f, 0.0f, -1.0f, 0.0f, 0.25f)};
	def.time_step = 1.0f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, 2);
		if (!world)
			continue;
		carom_report report = step(world, 1);
		assert_int_equal(report.hits, 1);
		assert_near(report.advanced, 0.375, 1e-7); /* gap 1.5 m at 4 m/s */
		assert_near((double)state_of(world, 0).velocity.x, -1.0, 1e-6);
		assert_near((double)state_of(world, 1).velocity.x, 3.0, 1e-6);
		assert_near((double)state_of(world, 0).position.x, 0.125, 1e-6);
		carom_world_destroy(world);
	}
}

/* A glancing hit of circles: |d + t v| = r + r, solved by hand for d = (2, 0.3), v = (-2, 0), r = 0.25. */
static void circle_quadratic(void **unused)
{
	(void)unused;
	static const char *const ways[] = {"circle_quadratic", "separating", "bisection"};
	const carom_body_def bodies[2] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.25f), scenery_circle(2.0f, 0.3f, -2.0f, 0.0f, 0.25f)};
	const double time = (2.0 - 0.4) / 2.0; /* at that time d = (0.4, 0.3), of length 0.5 */
	for (size_t way = 0; way < 3; way++) {
		carom_world_def def = scenery_first_impact();
		def.time_step = 1.0f;
		def.pipeline.toi = ways[way];
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(&def, device, bodies, 2);
			if (!world)
				continue;
			carom_report report = step(world, 1);
			assert_int_equal(report.hits, 1);
			assert_near(report.advanced, time, way == 2 ? 8e-6 : 2e-6);
			/* the normal (0.8, 0.6) carries the whole normal velocity over */
			assert_near((double)state_of(world, 0).velocity.x, -2.0 * 0.8 * 0.8, 1e-4);
			assert_near((double)state_of(world, 0).velocity.y, -2.0 * 0.8 * 0.6, 1e-4);
			carom_world_destroy(world);
		}
	}
}

/* A small circle hits a box beside its centre: j = 2 v / (1/m + 1/M + b^2/I), spin j b / I. */
static void off_centre_hit_spins(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.5f, 2.0f), scenery_circle(-2.0f, 0.6f, 4.0f, 0.0f, 0.1f)};
	const double M = 3.0, m = 0.5, v = 4.0, b = 0.6, I = M * (0.25 + 4.0) / 12.0, j = 2.0 * v / (1.0 / m + 1.0 / M + b * b / I);
	bodies[0].mass = 3.0f;
	bodies[1].mass = 0.5f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, 2);
		if (!world)
			continue;
		assert_int_equal(advance(world, 0.45).hits, 1);
		assert_near((double)state_of(world, 0).velocity.x, j / M, 1e-5);
		assert_near((double)state_of(world, 0).angular_velocity, -j * b / I, 1e-5);
		assert_near((double)state_of(world, 1).velocity.x, v - j / m, 1e-5);
		assert_near((double)state_of(world, 1).angular_velocity, 0.0, 0.0);
		carom_world_destroy(world);
	}
}

static double flat_fall(const scenery_device *device, const char *impulse, float restitution, bool onto_wall)
{
	carom_world_def def = scenery_first_impact();
	carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, -2.0f, 1.0f, 1.0f), scenery_box(0.0f, -2.0f, 0.0f, 0.0f, 6.0f, 1.0f)};
	double speed = NAN;
	bodies[1].is_static = true;
	def.restitution = restitution;
	def.pipeline.impulse = impulse;
	def.has_room = onto_wall;
	def.room_min = (carom_vec2){-5.0f, -1.5f};
	def.room_max = (carom_vec2){5.0f, 5.0f};
	carom_world *world = world_of(&def, device, bodies, onto_wall ? 1 : 2);
	if (world) {
		assert_int_equal(advance(world, 0.75).hits, 1);
		assert_near((double)state_of(world, 0).angular_velocity, 0.0, 2e-4);
		speed = (double)state_of(world, 0).velocity.y;
	}
	carom_world_destroy(world);
	return speed;
}

/* The trap of the face contact: two vertices touch at once, and each given the whole impulse gives back the wrong speed. */
static void square_falls_flat(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (int wall = 0; wall < 2; wall++) {
			double full = flat_fall(device, "pair_exact", 1.0f, wall), half = flat_fall(device, "pair_exact", 0.5f, wall);
			double paper = flat_fall(device, "accumulate", 1.0f, wall);
			if (isnan(full))
				continue;
			assert_near(full, 2.0, 1e-5);
			assert_near(half, 1.0, 1e-5);
			assert_near(paper, 1.2, 1e-5); /* the paper's rule gives each contact 0.8 of the momentum: 0.6 of the speed comes back */
		}
	}
}

static void restitution_halves_speed(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	carom_body_def bodies[2] = {scenery_circle(0.0f, 0.0f, 2.0f, 0.0f, 0.25f), scenery_box(1.0f, 0.0f, 0.0f, 0.0f, 0.5f, 4.0f)};
	def.restitution = 0.5f;
	bodies[1].is_static = true;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, 2);
		if (!world)
			continue;
		assert_int_equal(advance(world, 0.5).hits, 1);
		assert_near((double)state_of(world, 0).velocity.x, -1.0, 1e-6);
		carom_world_destroy(world);
	}
}

/* A pair takes the larger restitution of its two. */
static void larger_restitution_counts(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	carom_body_def bodies[2] = {scenery_circle(-1.0f, 0.0f, 1.0f, 0.0f, 0.25f), scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.25f)};
	bodies[0].restitution = 0.0f;
	bodies[1].restitution = 0.5f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, 2);
		if (!world)
			continue;
		advance(world, 0.75);
		assert_near((double)(state_of(world, 1).velocity.x - state_of(world, 0).velocity.x), 0.5, 1e-6);
		carom_world_destroy(world);
	}
}

/* Under gravity a ball comes back to where it fell from, and with its speed: parabolas and hits are both exact. */
static void ball_bounces_to_its_height(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	const carom_body_def ball = scenery_circle(0.0f, 2.0f, 0.0f, 0.0f, 0.5f);
	def.gravity = (carom_vec2){0.0f, -10.0f};
	def.has_room = true;
	def.room_min = (carom_vec2){-2.0f, 0.0f};
	def.room_max = (carom_vec2){2.0f, 4.0f};
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, &ball, 1);
		if (!world)
			continue;
		assert_int_equal(advance(world, 2.0 * sqrt(2.0 * 1.5 / 10.0)).hits, 1);
		assert_near((double)state_of(world, 0).position.y, 2.0, 2e-5);
		assert_near((double)state_of(world, 0).velocity.y, 0.0, 2e-5);
		carom_world_destroy(world);
	}
}

/* A force and a torque, by the paper's Y(t) [1, figure 1]. */
static void force_and_torque(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	carom_body_def box = scenery_box(1.0f, 2.0f, 0.5f, 0.0f, 1.0f, 1.0f);
	box.mass = 2.0f;
	box.force = (carom_vec2){4.0f, -2.0f};
	box.torque = 0.5f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, &box, 1);
		if (!world)
			continue;
		advance(world, 1.5);
		assert_near((double)state_of(world, 0).position.x, 1.0 + 0.75 + 0.5 * 2.0 * 2.25, 2e-5);
		assert_near((double)state_of(world, 0).velocity.y, -1.5, 1e-5);
		assert_near((double)state_of(world, 0).angular_velocity, 0.5 / (2.0 / 6.0) * 1.5, 1e-5);
		assert_near((double)state_of(world, 0).angle, 0.5 * 1.5 * 2.25, 2e-5);
		assert_near(carom_world_time(world), 1.5, 1e-6);
		carom_world_destroy(world);
	}
}

/* A small body at 1,000 m/s, and two of them head-on: nothing passes through anything. */
static void nothing_tunnels(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	carom_body_def bodies[4] = {
		scenery_circle(-3.0f, 0.0f, 1000.0f, 0.0f, 0.05f),
		scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.001f, 2.0f),
		scenery_box(-3.0f, 5.0f, 1000.0f, 0.0f, 0.1f, 0.1f),
		scenery_box(3.0f, 5.02f, -1000.0f, 0.0f, 0.1f, 0.1f),
	};
	bodies[1].is_static = true;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, 4);
		if (!world)
			continue;
		assert_int_equal(advance(world, 1.0 / 60.0).hits, 2);
		assert_true(state_of(world, 0).position.x < -0.05f);
		assert_near((double)state_of(world, 0).velocity.x, -1000.0, 1e-2);
		assert_true(state_of(world, 2).position.x < state_of(world, 3).position.x);
		carom_world_destroy(world);
	}
}

/* Two triangles cross like a star, no vertex of one inside the other: separating sees the hit. */
static void crossing_without_vertex_inside(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 4.0f, 0.1f), scenery_box(0.0f, 0.6f, 0.0f, -30.0f, 0.1f, 1.0f)};
	def.pipeline.toi = "separating";
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, 2);
		if (!world)
			continue;
		carom_report report = step(world, 1);
		assert_int_equal(report.hits, 1);
		assert_near(report.advanced, 0.05 / 30.0, 1e-6);
		carom_world_destroy(world);
	}
}

/* The trap of the freeze: a pair that overlaps and parts is no hit, one that overlaps and approaches is hit at 0. */
static void overlapping_pairs(void **unused)
{
	(void)unused;
	static const char *const ways[] = {"circle_quadratic", "separating", "bisection"};
	for (size_t k = 0; k < 6; k++) {
		carom_world_def def = scenery_first_impact();
		bool boxes = k >= 3;
		float speed = 1.0f;
		def.pipeline.toi = ways[k % 3];
		SCENERY_EACH_DEVICE(device) {
			for (int parting = 0; parting < 2; parting++) {
				float v = parting ? -speed : speed;
				const carom_body_def circles[2] = {scenery_circle(0.0f, 0.0f, v, 0.0f, 0.5f), scenery_circle(0.9f, 0.1f, -v, 0.0f, 0.5f)};
				const carom_body_def squares[2] = {scenery_box(0.0f, 0.0f, v, 0.0f, 1.0f, 1.0f), scenery_box(0.9f, 0.1f, -v, 0.0f, 1.0f, 1.0f)};
				carom_world *world = world_of(&def, device, boxes ? squares : circles, 2);
				if (!world)
					continue;
				carom_report report = step(world, 1);
				assert_int_equal(report.hits, parting ? 0 : 1);
				assert_near(report.advanced, parting ? 1.0 / 60.0 : 0.0, 1e-8);
				assert_int_equal(step(world, 20).hits, 0);
				carom_world_destroy(world);
			}
		}
	}
}

/* Ten thousand hits: time gets on, energy and (without walls) momentum stay, nothing overlaps. */
static void many_hits_keep_energy(void **unused)
{
	(void)unused;
	enum { COUNT = 49 };
	carom_body_def bodies[COUNT];
	for (int shapes = SCENERY_MIXED; shapes <= SCENERY_POLYGONS; shapes++) {
		scenery_random random = {7};
		carom_world_def def = scenery_first_impact();
		def.has_room = true;
		def.room_min = (carom_vec2){-4.5f, -4.5f};
		def.room_max = (carom_vec2){4.5f, 4.5f};
		scenery_bodies(&random, (scenery_shapes)shapes, COUNT, 1.2f, 2.0f, bodies);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(&def, device, bodies, COUNT);
			if (!world)
				continue;
			double energy = measure_of(world).kinetic_energy;
			carom_report report = step(world, device->storage == CAROM_STORAGE_IMAGE ? 2000 : 10000);
			carom_measure measure = measure_of(world);
			assert_true(report.advanced > 1.0);
			assert_near(measure.kinetic_energy / energy, 1.0, 2e-5);
			assert_true(measure.max_penetration < 2e-5);
			carom_world_destroy(world);
		}
	}
}

static void momentum_stays(void **unused)
{
	(void)unused;
	enum { COUNT = 36 };
	carom_body_def bodies[COUNT];
	scenery_random random = {3};
	carom_world_def def = scenery_first_impact();
	scenery_bodies(&random, SCENERY_POLYGONS, COUNT, 1.1f, 1.0f, bodies);
	for (int i = 0; i < COUNT; i++) {
		bodies[i].is_static = false;
		bodies[i].velocity.x -= 0.3f * bodies[i].position.x; /* towards each other, so that much is hit */
		bodies[i].velocity.y -= 0.3f * bodies[i].position.y;
	}
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, bodies, COUNT);
		if (!world)
			continue;
		carom_measure before = measure_of(world), after;
		assert_true(advance(world, 5.0).hits > 30);
		after = measure_of(world);
		assert_near(after.momentum_x, before.momentum_x, 2e-5);
		assert_near(after.momentum_y, before.momentum_y, 2e-5);
		assert_near(after.angular_momentum, before.angular_momentum, 3e-4);
		assert_near(after.kinetic_energy / before.kinetic_energy, 1.0, 1e-5);
		carom_world_destroy(world);
	}
}

/* A ball that comes to rest hits for ever: that is said, and the state can still be read. */
static void rest_is_a_stall(void **unused)
{
	(void)unused;
	carom_world_def def = scenery_first_impact();
	const carom_body_def ball = scenery_circle(0.0f, 1.0f, 0.0f, 0.0f, 0.5f);
	def.gravity = (carom_vec2){0.0f, -10.0f};
	def.restitution = 0.5f;
	def.has_room = true;
	def.room_min = (carom_vec2){-2.0f, 0.0f};
	def.room_max = (carom_vec2){2.0f, 4.0f};
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(&def, device, &ball, 1);
		carom_error error;
		if (!world)
			continue;
		assert_int_equal(carom_world_advance(world, 10.0, NULL, &error), CAROM_STALLED);
		assert_non_null(strstr(error.text, "body 0 with a wall"));
		assert_near((double)state_of(world, 0).position.y, 0.5, 1e-4);
		const carom_body_state above = {.position = {0.0f, 3.0f}}; /* from there it goes on */
		scenery_check(carom_world_set_states(world, 0, 1, &above, &error), &error);
		scenery_check(carom_world_step(world, 3, NULL, &error), &error);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(head_on_circles_swap), cmocka_unit_test(circle_quadratic),
		cmocka_unit_test(off_centre_hit_spins), cmocka_unit_test(square_falls_flat), cmocka_unit_test(restitution_halves_speed),
		cmocka_unit_test(larger_restitution_counts), cmocka_unit_test(ball_bounces_to_its_height), cmocka_unit_test(force_and_torque),
		cmocka_unit_test(nothing_tunnels), cmocka_unit_test(crossing_without_vertex_inside), cmocka_unit_test(overlapping_pairs),
		cmocka_unit_test(many_hits_keep_energy), cmocka_unit_test(momentum_stays), cmocka_unit_test(rest_is_a_stall)};
	return cmocka_run_group_tests_name("physics", tests, NULL, NULL);
}
