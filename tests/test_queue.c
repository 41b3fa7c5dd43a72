/* The queue that judges the step events is judged itself, by what is known without a computer. */
#include <math.h>

#include "queue.h"

static carom_world_def open_space(void)
{
	carom_world_def def = carom_default_world_def();
	def.time_step = 1.0f;
	return def;
}

static queue *queue_from(const carom_world_def *def, const carom_body_def *bodies, size_t count)
{
	carom_world *world = scenery_world(def, &scenery_devices[0]);
	carom_error error;
	scenery_check(carom_world_add(world, bodies, count, NULL, &error), &error);
	queue *q = queue_of(world);
	carom_world_destroy(world);
	return q;
}

static void assert_near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.12g, expected %.12g within %.2g", found, expected, tolerance);
}

/* Galperin's billiard: with masses 1 : 100^n there are as many hits as pi has in so many digits. */
static void galperin_counts_pi(void **unused)
{
	(void)unused;
	static const struct {
		float mass;
		size_t hits;
	} cases[] = {{1.0f, 3}, {100.0f, 31}, {10000.0f, 314}};
	for (size_t i = 0; i < 3; i++) {
		carom_world_def def = open_space();
		carom_body_def bodies[3] = {scenery_box(-1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 2.0f), scenery_circle(0.5f, 0.0f, 0.0f, 0.0f, 0.1f),
			scenery_circle(1.5f, 0.0f, -4.0f, 0.0f, 0.2f)};
		bodies[0].is_static = true;
		bodies[1].mass = 1.0f;
		bodies[2].mass = cases[i].mass;
		queue *q = queue_from(&def, bodies, 3);
		const double energy = queue_kinetic_energy(q);
		queue_step(q, 4.0, 1000);
		assert_int_equal(q->hit_count, cases[i].hits);
		assert_near(queue_kinetic_energy(q) / energy, 1.0, 1e-11);
		queue_destroy(q);
	}
}

static void two_bodies(void **unused)
{
	(void)unused;
	const carom_world_def def = open_space();
	carom_body_def circles[2] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.25f), scenery_circle(2.0f, 0.3f, -2.0f, 0.0f, 0.25f)};
	carom_body_def boxes[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.5f, 2.0f), scenery_circle(-2.0f, 0.6f, 4.0f, 0.0f, 0.1f)};
	const double M = 3.0, m = 0.5, v = 4.0, b = (double)0.6f, I = M * (0.25 + 4.0) / 12.0, j = 2.0 * v / (1.0 / m + 1.0 / M + b * b / I);
	boxes[0].mass = 3.0f;
	boxes[1].mass = 0.5f;
	queue *q = queue_from(&def, circles, 2);
	queue_step(q, 1.0, 10);
	assert_int_equal(q->hit_count, 1);
	assert_near(q->hits[0].time, 0.8, 1e-7);
	assert_near(q->bodies[0].at.vx, -2.0 * 0.8 * 0.8, 1e-6);
	assert_near(q->bodies[0].at.vy, -2.0 * 0.8 * 0.6, 1e-6);
	queue_destroy(q);
	q = queue_from(&def, boxes, 2);
	queue_step(q, 0.5, 10);
	assert_int_equal(q->hit_count, 1);
	assert_near(q->hits[0].time, 2.0 * (2.0 - 0.25 - (double)0.1f) / 4.0, 1e-9);
	assert_near(q->bodies[0].at.vx, j / M, 1e-6);
	assert_near(q->bodies[0].at.w, -j * b / I, 1e-6);
	assert_near(q->bodies[1].at.vx, v - j / m, 1e-6);
	queue_destroy(q);
}

/* Both corners of a box that falls flat are hit at once. */
static void box_falls_flat(void **unused)
{
	(void)unused;
	for (int onto_wall = 0; onto_wall < 2; onto_wall++) {
		carom_world_def def = open_space();
		carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, -2.0f, 1.0f, 1.0f), scenery_box(0.0f, -2.0f, 0.0f, 0.0f, 6.0f, 1.0f)};
		bodies[1].is_static = true;
		def.restitution = 0.5f;
		def.has_room = onto_wall;
		def.room_min = (carom_vec2){-5.0f, -1.5f};
		def.room_max = (carom_vec2){5.0f, 5.0f};
		queue *q = queue_from(&def, bodies, onto_wall ? 1 : 2);
		queue_step(q, 0.75, 10);
		assert_int_equal(q->hit_count, 1);
		assert_near(q->hits[0].time * 0.75, 0.5, 1e-9);
		assert_near(q->bodies[0].at.vy, 1.0, 1e-9);
		assert_near(q->bodies[0].at.w, 0.0, 1e-9);
		queue_destroy(q);
	}
}

/* A ball's bounces shorten by the restitution, down to the small ones that it keeps for good. */
static void ball_comes_to_rest(void **unused)
{
	(void)unused;
	carom_world_def def = open_space();
	const carom_body_def ball = scenery_circle(0.0f, 1.75f, 0.0f, 0.0f, 0.5f);
	const double fall = sqrt(2.0 * 1.25 / 10.0);
	def.gravity = (carom_vec2){0.0f, -10.0f};
	def.restitution = 0.5f;
	def.has_room = true;
	def.room_min = (carom_vec2){-2.0f, 0.0f};
	def.room_max = (carom_vec2){2.0f, 4.0f};
	queue *q = queue_from(&def, &ball, 1);
	queue_step(q, 1.6, 100);
	assert_near(q->hits[0].time * 1.6, fall, 1e-9);
	for (int i = 1; i < 3; i++)
		assert_near((q->hits[i].time - q->hits[i - 1].time) * 1.6, fall * pow(0.5, i - 1), 1e-9);
	for (int step = 0; step < 100; step++) {
		queue_step(q, 1.0 / 60.0, 40); /* 1/32 of what gravity makes of its speed brings it down again after 1/16 of a step */
		assert_int_equal(q->held, 0);
	}
	assert_true(q->hit_count >= 15);
	assert_near(q->bodies[0].at.y, 0.5, 1e-5);
	queue_destroy(q);
}

/* Random crowds keep their energy, and without a room their momentum; nobody ends inside another. */
static void crowds_keep_energy(void **unused)
{
	(void)unused;
	enum { COUNT = 36 };
	for (int shapes = SCENERY_MIXED; shapes <= SCENERY_POLYGONS; shapes++) {
		carom_body_def bodies[COUNT];
		carom_world_def def = open_space();
		scenery_random random = {5};
		scenery_bodies(&random, (scenery_shapes)shapes, COUNT, 1.2f, 2.0f, bodies);
		for (int i = 0; i < COUNT; i++) {
			bodies[i].is_static = false;
			bodies[i].velocity.x -= 0.5f * bodies[i].position.x;
			bodies[i].velocity.y -= 0.5f * bodies[i].position.y;
		}
		queue *q = queue_from(&def, bodies, COUNT);
		const double energy = queue_kinetic_energy(q), x = queue_momentum(q, 0), y = queue_momentum(q, 1);
		size_t hits = 0;
		for (int step = 0; step < 40; step++) {
			queue_step(q, 0.05, 10000);
			hits += q->hit_count;
			for (int i = 0; i < COUNT; i++) {
				for (int k = 0; k < i; k++)
					assert_true(exact_distance(&q->bodies[i].at, &q->bodies[k].at, 0.0) > -1e-6 * 2.0);
			}
		}
		print_message("%zu hits, energy %.3g\n", hits, queue_kinetic_energy(q) / energy - 1.0);
		assert_true(hits > 60);
		assert_near(queue_kinetic_energy(q) / energy, 1.0, 1e-11);
		assert_near(queue_momentum(q, 0), x, 1e-11);
		assert_near(queue_momentum(q, 1), y, 1e-11);
		queue_destroy(q);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(galperin_counts_pi), cmocka_unit_test(two_bodies), cmocka_unit_test(box_falls_flat),
		cmocka_unit_test(ball_comes_to_rest), cmocka_unit_test(crowds_keep_energy)};
	return cmocka_run_group_tests_name("queue", tests, NULL, NULL);
}
