/* What judges polygons that are not convex is judged itself: given convex ones as outlines it says what it says of convex ones, by other means; and by what is known
 * without a computer. */
#include <math.h>
#include <string.h>

#include "concave.h"
#include "outline.h"
#include "queue.h"
#include "runs.h"

/* ---- Convex ones as outlines */

static exact_body body_in(scenery_random *random, carom_world *world, uint32_t index, double reach)
{
	exact_body k = exact_of(world, index);
	k.x = (double)scenery_uniform(random, -1.0f, 1.0f) * reach;
	k.y = (double)scenery_uniform(random, -1.0f, 1.0f) * reach;
	return k;
}

static exact_body as_outline(const exact_body *k)
{
	exact_body outline = *k;
	outline.is_concave = k->count > 1;
	return outline;
}

static void check_touch(const touch *found, const touch *expected)
{
	const double sign = found->swapped == expected->swapped ? 1.0 : -1.0;
	runs_near(sign * found->normal[0], expected->normal[0], 1e-9);
	runs_near(sign * found->normal[1], expected->normal[1], 1e-9);
	assert_int_equal(found->count, expected->count);
	for (int k = 0; k < 2 && found->count == 1; k++) {
		const double *lever = sign > 0.0 ? found->reference[0] : found->incident[0];
		runs_near(lever[k], expected->reference[0][k], 1e-6);
	}
	runs_near(found->rate[0], expected->rate[0], 1e-6);
}

/* Where a corner meets a corner rounding says along which side. */
static bool is_at_corners(const exact_body *a, const exact_body *b)
{
	return exact_corners(a, b, 0.0) < 1e-4;
}

/* Two bodies that fly by: are apart, touch when, and how? */
static void check_pair(exact_body *a, exact_body *b, size_t *touched)
{
	exact_body outlines[2] = {as_outline(a), as_outline(b)};
	const double apart = exact_distance(a, b, 0.0);
	if (apart > 0.0)
		runs_near(exact_distance(&outlines[0], &outlines[1], 0.0), apart, 1e-12);
	else
		assert_true(exact_distance(&outlines[0], &outlines[1], 0.0) <= 0.0);
	if (apart < 1e-3)
		return;
	const double expected = touch_pair_time(a, b, 0.5, 1.0), found = touch_pair_time(&outlines[0], &outlines[1], 0.5, 1.0);
	if (isinf(expected) && isinf(found))
		return;
	runs_near(found, expected, 1e-12);
	touch_move(a, expected);
	touch_move(b, expected);
	if (is_at_corners(a, b))
		return;
	touch_move(&outlines[0], expected);
	touch_move(&outlines[1], expected);
	const touch of_convex = touch_pair(a, b), of_outlines = touch_pair(&outlines[0], &outlines[1]);
	check_touch(&of_outlines, &of_convex);
	++*touched;
}

static void convex_outlines_are_convex_bodies(void **unused)
{
	(void)unused;
	enum { COUNT = 80 };
	carom_body_def bodies[COUNT];
	scenery_random random = {3};
	const carom_world_def def = runs_def();
	size_t touched = 0;
	scenery_bodies(&random, SCENERY_MIXED, COUNT, 1.4f, 40.0f, bodies);
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, COUNT);
	for (int i = 0; i < 12000; i++) {
		exact_body a = body_in(&random, world, (uint32_t)i % COUNT, 0.6), b = body_in(&random, world, (uint32_t)(7 * i + 1) % COUNT, 0.6);
		if (a.count > 1 || b.count > 1)
			check_pair(&a, &b, &touched);
	}
	print_message("%zu touched\n", touched);
	assert_true(touched > 1000);
	carom_world_destroy(world);
}

/* The same hits, from the same start, until chaos parts them. */
static void crowds_of_them_are_the_same(void **unused)
{
	(void)unused;
	enum { COUNT = 36 };
	carom_body_def bodies[COUNT];
	scenery_random random = {8};
	carom_world_def def = runs_room(4.4f, 4.4f);
	size_t hits = 0;
	def.friction = 0.3f;
	def.gravity.y = -2.0f;
	scenery_bodies(&random, SCENERY_MIXED, COUNT, 1.2f, 3.0f, bodies);
	queue *convex = runs_queue(&def, bodies, COUNT), *outlines = queue_copy(convex);
	for (int i = 0; i < COUNT; i++)
		outlines->bodies[i].at = as_outline(&convex->bodies[i].at);
	for (int step = 0; step < 20; step++) {
		queue_step(convex, 0.05, 10000);
		queue_step(outlines, 0.05, 10000);
		assert_int_equal(outlines->hit_count, convex->hit_count);
		for (size_t i = 0; i < convex->hit_count; i++)
			assert_true(outlines->hits[i].row == convex->hits[i].row && outlines->hits[i].column == convex->hits[i].column);
		hits += convex->hit_count;
	}
	for (int i = 0; i < COUNT; i++) {
		runs_near(outlines->bodies[i].at.x, convex->bodies[i].at.x, 1e-6);
		runs_near(outlines->bodies[i].at.vy, convex->bodies[i].at.vy, 1e-6);
	}
	print_message("%zu hits\n", hits);
	assert_true(hits > 60);
	queue_destroy(convex);
	queue_destroy(outlines);
}

/* ---- Notches */

static exact_body outline_of(const carom_vec2 *vertices, uint32_t count)
{
	const carom_body_def def = concave_outline(vertices, count);
	const carom_world_def numbers = runs_def();
	carom_world *world = runs_world(&numbers, &scenery_devices[0], &def, 1);
	exact_body k = exact_of(world, 0);
	carom_world_destroy(world);
	return k;
}

static const carom_vec2 notched[7] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0.5f}, {0, 0}, {-1, -0.5f}};

/* A box with a notch in its left side, from which nothing comes: the box itself. */
static void far_notch_changes_nothing(void **unused)
{
	(void)unused;
	const carom_vec2 box_at[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, ball_at[3] = {{3, -0.25f}, {3.5f, 0}, {3, 0.5f}};
	const exact_body dented = outline_of(notched, 7), box = outline_of(box_at, 4);
	for (int i = 0; i < 50; i++) {
		exact_body whole = box, hollow = dented, other = outline_of(ball_at, 3);
		other.count = i % 2 ? 3 : 1;
		other.radius = i % 2 ? 0.0 : 0.3;
		if (i % 2 == 0)
			other.corners[0][0] = other.corners[0][1] = 0.0;
		other.y = -1.2 + 0.05 * i;
		other.vx = -4.0;
		other.angle = other.w = 0.1 * i;
		const double expected = touch_pair_time(&other, &whole, 0.0, 1.0), found = touch_pair_time(&other, &hollow, 0.0, 1.0);
		runs_near(isinf(found) ? 2.0 : found, isinf(expected) ? 2.0 : expected, 1e-7);
	}
}

/* A ball and a wedge that fly into the notch come as deep as it lets them. */
static void notch_is_hollow(void **unused)
{
	(void)unused;
	const exact_body dented = outline_of(notched, 7);
	exact_body ball = {.count = 1, .radius = 0.1, .bound = 0.1, .x = -3.0, .vx = 4.0};
	const double deep = 0.1 / sin(atan2(0.5, 1.0)); /* between the sides, in front of their vertex at (0, 0) */
	runs_near(touch_pair_time(&ball, &dented, 0.0, 1.0), (3.0 - deep) / 4.0, 1e-7);
	ball.y = -0.3;
	runs_near(touch_pair_time(&ball, &dented, 0.0, 1.0), (3.0 - 0.6 - 0.1 / sin(atan2(0.5, 1.0))) / 4.0, 1e-7);
	const carom_vec2 wedge_at[3] = {{-4, -0.125f}, {-3, 0}, {-4, 0.125f}};
	exact_body wedge = outline_of(wedge_at, 3);
	wedge.vx = 4.0;
	runs_near(touch_pair_time(&wedge, &dented, 0.0, 1.0), 3.0 / 4.0, 1e-7);
	wedge.y += 0.25;
	runs_near(touch_pair_time(&wedge, &dented, 0.0, 1.0), 2.5 / 4.0, 1e-7);
	touch_move(&wedge, 2.5 / 4.0);
	const touch t = touch_pair(&wedge, &dented);
	runs_near((t.swapped ? 1.0 : -1.0) * t.normal[0], -1.0 / sqrt(5.0), 1e-7);
	runs_near((t.swapped ? 1.0 : -1.0) * t.normal[1], -2.0 / sqrt(5.0), 1e-7);
	assert_int_equal(t.count, 1);
}

static void overlaps_are_told(void **unused)
{
	(void)unused;
	const carom_vec2 rod_at[4] = {{-2, -0.125f}, {2, -0.125f}, {2, 0.125f}, {-2, 0.125f}};
	const exact_body rod = outline_of(rod_at, 4);
	exact_body cross[2] = {as_outline(&rod), as_outline(&rod)};
	cross[1].angle = 1.0; /* no vertex within the other */
	assert_true(exact_distance(&cross[0], &cross[1], 0.0) < -0.1);
	cross[1].angle = 0.0, cross[1].y = 0.25 - 1e-9;
	runs_near(exact_distance(&cross[0], &cross[1], 0.0), 0.0, 2e-9);
	cross[1].y = 0.25 + 1e-9;
	runs_near(exact_distance(&cross[0], &cross[1], 0.0), 1e-9, 1e-12);
}

/* ---- Crowds */

/* They keep their energy and momentum, and nobody ends inside another. */
static void crowds_keep_energy(void **unused)
{
	(void)unused;
	enum { COUNT = 36 };
	carom_body_def bodies[COUNT];
	const carom_world_def def = runs_def();
	scenery_random random = {5};
	size_t hits = 0;
	concave_bodies(&random, COUNT, 1.2f, 2.0f, bodies);
	for (int i = 0; i < COUNT; i++) {
		bodies[i].is_static = false;
		bodies[i].velocity.x -= 0.5f * bodies[i].position.x;
		bodies[i].velocity.y -= 0.5f * bodies[i].position.y;
	}
	queue *q = runs_queue(&def, bodies, COUNT);
	const double energy = queue_kinetic_energy(q), x = queue_momentum(q, 0), y = queue_momentum(q, 1);
	for (int step = 0; step < 40; step++) {
		queue_step(q, 0.05, 10000);
		hits += q->hit_count;
		for (int i = 0; i < COUNT; i++)
			for (int k = 0; k < i; k++)
				assert_true(exact_distance(&q->bodies[i].at, &q->bodies[k].at, 0.0) > -1e-6 * 2.0);
	}
	print_message("%zu hits, energy %.3g\n", hits, queue_kinetic_energy(q) / energy - 1.0);
	assert_true(hits > 60);
	runs_near(queue_kinetic_energy(q) / energy, 1.0, 1e-11);
	runs_near(queue_momentum(q, 0), x, 1e-11);
	runs_near(queue_momentum(q, 1), y, 1e-11);
	queue_destroy(q);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(convex_outlines_are_convex_bodies), cmocka_unit_test(crowds_of_them_are_the_same),
		cmocka_unit_test(far_notch_changes_nothing), cmocka_unit_test(notch_is_hollow), cmocka_unit_test(overlaps_are_told),
		cmocka_unit_test(crowds_keep_energy)};
	return cmocka_run_group_tests_name("outline", tests, NULL, NULL);
}
