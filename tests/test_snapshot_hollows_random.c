/* carom_snapshot and carom_measure, of any polygons that are not convex: asked about, and asking.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "count.h"
#include "hollows.h"

enum { ASKED = 600, PAIRS = 1500 };

/* The point is on both, and along the normal one leaves the other: less than that where a corner points inwards. */
static void check_touch(const solid *stands, const solid *there, const carom_ray_hit *hit, int number)
{
	const double x = (double)hit->point.x, y = (double)hit->point.y, nx = (double)hit->normal.x, ny = (double)hit->normal.y;
	const solid away = solids_moved(there, 1e-4 * nx, 1e-4 * ny);
	const double of_stands = hollows_distance(stands, x, y), of_moves = hollows_distance(there, x, y), gap = hollows_gap(stands, &away);
	if (!(fabs(of_stands) < 1e-5) || !(fabs(of_moves) < 1e-5) || !(fabs(hypot(nx, ny) - 1) < 1e-6) || !(gap > 0))
		fail_msg("%d: the point is %g and %g from the bodies, which along the normal are %g apart", number, of_stands, of_moves, gap);
}

/* Is it that of a side on which the point is? */
static bool is_normal(const solid *s, const carom_ray_hit *hit)
{
	for (uint32_t k = 0; k < s->count; k++) {
		const double *a = s->corners[k], *b = s->corners[(k + 1) % s->count], length = hypot(b[0] - a[0], b[1] - a[1]);
		const double nx = (b[1] - a[1]) / length, ny = (a[0] - b[0]) / length;
		if (hypot(nx - (double)hit->normal.x, ny - (double)hit->normal.y) < 1e-6
			&& fabs(nx * ((double)hit->point.x - a[0]) + ny * ((double)hit->point.y - a[1])) < 1e-5)
			return true;
	}
	return s->count == 0;
}

static void rays_meet_what_is_nearest(void **unused)
{
	static solid stand[HOLLOWS_COUNT];
	scenery_random random = {1};
	carom_world *world = hollows_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	int sure = 0, met = 0;
	(void)unused;
	for (int i = 0; i < ASKED; i++) {
		const float half = i % 3 ? 15.0f : 3.0f;
		const carom_vec2 from = {scenery_uniform(&random, -15, 15), scenery_uniform(&random, -15, 15)};
		const carom_ray ray = {from, {from.x + scenery_uniform(&random, -half, half), from.y + scenery_uniform(&random, -half, half)},
			i % 2 ? powf(10.0f, scenery_uniform(&random, -3, 0)) : 0};
		const solid disc = {.x = (double)from.x, .y = (double)from.y, .radius = (double)ray.radius};
		const double x = (double)ray.to.x - disc.x, y = (double)ray.to.y - disc.y;
		int32_t nearest;
		carom_ray_hit hit;
		const double first = solids_first(stand, HOLLOWS_COUNT, hollows_meeting, &disc, x, y, &nearest);
		assert_int_equal(carom_snapshot_cast_rays(snapshot, 1, &ray, &hit, NULL), CAROM_OK);
		if (first < 0)
			continue;
		sure++;
		if (hit.other != nearest || (nearest >= 0 && !(fabs(hit.part - first) < 1e-6)))
			fail_msg("ray %d: %d at %.12g instead of %d at %.12g", i, hit.other, hit.part, nearest, first);
		if (nearest < 0)
			continue;
		met++;
		const solid there = solids_moved(&disc, hit.part * x, hit.part * y);
		check_touch(&stand[nearest], &there, &hit, i);
		assert_true(i % 2 || is_normal(&stand[nearest], &hit));
	}
	print_message("%d of %d rays are sure, %d of these meet something\n", sure, ASKED, met);
	assert_true(sure > ASKED * 8 / 10 && met > ASKED / 3);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

/* Those of a world of their own, where the tests see how they are placed. */
static solid solid_of(const carom_body_def *body)
{
	const carom_world_def def = carom_default_world_def();
	carom_world *world = runs_world(&def, &scenery_devices[0], body, 1);
	const solid s = solids_of(world, 0);
	carom_world_destroy(world);
	return s;
}

static void bodies_meet_what_is_nearest(void **unused)
{
	static solid stand[HOLLOWS_COUNT];
	scenery_random random = {2};
	carom_world *world = hollows_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	int sure = 0, met = 0;
	(void)unused;
	for (int i = 0; i < ASKED; i++) {
		carom_vec2 vertices[CAROM_MAX_VERTICES];
		carom_body_def body = hollows_body(&random, vertices);
		if (i % 2)
			body.position.x += body.position.x > 0 ? 10 : -10; /* where it mostly touches nothing */
		const carom_vec2 to = {scenery_uniform(&random, -15, 15), scenery_uniform(&random, -15, 15)};
		const solid moves = solid_of(&body);
		const double x = (double)to.x - moves.x, y = (double)to.y - moves.y;
		int32_t nearest;
		carom_ray_hit hit;
		carom_error error;
		const double first = solids_first(stand, HOLLOWS_COUNT, hollows_meeting, &moves, x, y, &nearest);
		scenery_check(carom_snapshot_cast_bodies(snapshot, 1, &body, &to, &hit, &error), &error);
		if (first < 0)
			continue;
		sure++;
		if (hit.other != nearest || (nearest >= 0 && !(fabs(hit.part - first) < 1e-6)))
			fail_msg("body %d: %d at %.12g instead of %d at %.12g", i, hit.other, hit.part, nearest, first);
		if (nearest < 0)
			continue;
		met++;
		const solid there = solids_moved(&moves, hit.part * x, hit.part * y);
		check_touch(&stand[nearest], &there, &hit, i);
	}
	print_message("%d of %d bodies are sure, %d of these meet something\n", sure, ASKED, met);
	assert_true(sure > ASKED * 8 / 10 && met > ASKED / 3);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void check_found(const uint32_t *found, size_t count, const solid stand[HOLLOWS_COUNT], const solid *asks, int number)
{
	size_t next = 0;
	for (uint32_t k = 0; k < HOLLOWS_COUNT; k++) {
		const bool is_found = next < count && found[next] == k;
		const double gap = hollows_gap(&stand[k], asks);
		next += is_found;
		if (fabs(gap) > SOLIDS_SURE && is_found != (gap < 0))
			fail_msg("%d, body %u: %s, but the gap is %g", number, k, is_found ? "found" : "not found", gap);
	}
	assert_int_equal(next, count);
}

static void what_is_touched_is_found(void **unused)
{
	static solid stand[HOLLOWS_COUNT];
	scenery_random random = {3};
	carom_world *world = hollows_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	size_t all = 0;
	(void)unused;
	for (int i = 0; i < ASKED; i++) {
		carom_vec2 vertices[CAROM_MAX_VERTICES];
		const carom_body_def body = hollows_body(&random, vertices);
		const solid asks = solid_of(&body);
		uint32_t found[HOLLOWS_COUNT];
		size_t count;
		carom_error error;
		scenery_check(carom_snapshot_find_touching(snapshot, &body, found, COUNT(found), &count, &error), &error);
		check_found(found, count, stand, &asks, i);
		all += count;
	}
	print_message("%zu bodies are touched by %d\n", all, ASKED);
	assert_true(all > ASKED / 2);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void boxes_hold_what_reaches_into_them(void **unused)
{
	static solid stand[HOLLOWS_COUNT];
	scenery_random random = {4};
	carom_world *world = hollows_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	size_t all = 0;
	(void)unused;
	for (int i = 0; i < ASKED; i++) {
		const float size = i % 3 ? scenery_uniform(&random, 0.001f, 2) : 0;
		const carom_vec2 min = {scenery_uniform(&random, -13, 13), scenery_uniform(&random, -13, 13)};
		const carom_vec2 max = {min.x + scenery_uniform(&random, 0.5f * size, size), min.y + scenery_uniform(&random, 0.5f * size, size)};
		const double left = (double)min.x, low = (double)min.y, right = (double)max.x, high = (double)max.y;
		const solid box = {.count = 4, .corners = {{left, low}, {right, low}, {right, high}, {left, high}}};
		const solid point = {.x = left, .y = low};
		uint32_t found[HOLLOWS_COUNT];
		size_t count;
		assert_int_equal(carom_snapshot_find(snapshot, min, max, found, COUNT(found), &count, NULL), CAROM_OK);
		check_found(found, count, stand, size > 0 ? &box : &point, i);
		all += count;
	}
	print_message("%zu bodies in %d boxes\n", all, ASKED);
	assert_true(all > ASKED / 4);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void the_nearest_is_found(void **unused)
{
	static solid stand[HOLLOWS_COUNT];
	scenery_random random = {5};
	carom_world *world = hollows_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	int inside = 0;
	(void)unused;
	for (int i = 0; i < 10 * ASKED; i++) {
		const carom_vec2 point = {scenery_uniform(&random, -16, 16), scenery_uniform(&random, -16, 16)};
		const double x = (double)point.x, y = (double)point.y;
		double least = HUGE_VAL;
		carom_nearest found;
		assert_int_equal(carom_snapshot_find_nearest(snapshot, 1, &point, INFINITY, &found, NULL), CAROM_OK);
		for (uint32_t k = 0; k < HOLLOWS_COUNT; k++)
			least = fmin(least, fmax(hollows_distance(&stand[k], x, y), 0));
		if (!(fabs(found.distance - least) < SOLIDS_SURE) || !(fabs(fmax(hollows_distance(&stand[found.body], x, y), 0) - least) < SOLIDS_SURE))
			fail_msg("point %d: %d at %g, instead of %g", i, found.body, found.distance, least);
		inside += least == 0;
		if (least < SOLIDS_SURE)
			continue;
		assert_true(fabs(hollows_distance(&stand[found.body], (double)found.point.x, (double)found.point.y)) < 1e-5);
		assert_true(fabs((double)found.point.x + least * (double)found.normal.x - x) < 1e-5);
		assert_true(fabs((double)found.point.y + least * (double)found.normal.y - y) < 1e-5);
	}
	print_message("%d of %d points are in bodies\n", inside, 10 * ASKED);
	assert_true(inside > ASKED);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

/* There is an overlap where there is one; of a disc whose centre is outside it is known, and no two are deeper in each other than they are broad. */
static void what_overlaps_is_measured(void **unused)
{
	scenery_random random = {6};
	int overlapping = 0;
	(void)unused;
	for (int i = 0; i < PAIRS; i++) {
		carom_vec2 vertices[2][CAROM_MAX_VERTICES];
		const carom_world_def def = carom_default_world_def();
		carom_body_def bodies[] = {hollows_body(&random, vertices[0]), hollows_body(&random, vertices[1])};
		for (int k = 0; k < 2; k++) {
			bodies[k].position = (carom_vec2){0.2f * bodies[k].position.x, 0.2f * bodies[k].position.y};
			bodies[k].is_static = false;
		}
		carom_world *world = runs_world(&def, &scenery_devices[0], bodies, 2);
		const solid a = solids_of(world, 0), b = solids_of(world, 1);
		const double gap = hollows_gap(&a, &b), depth = runs_measure(world).max_penetration;
		const bool is_known = (a.count == 0 && gap > -a.radius) || (b.count == 0 && gap > -b.radius);
		carom_world_destroy(world);
		if (fabs(gap) < SOLIDS_SURE && gap >= 0)
			continue;
		overlapping += gap < 0;
		if ((gap < 0) != (depth > 0) || !(depth < a.radius + b.radius) || (is_known && gap < 0 && !(fabs(depth + gap) < SOLIDS_SURE)))
			fail_msg("pair %d: overlap %g, gap %g", i, depth, gap);
	}
	print_message("%d of %d overlap\n", overlapping, PAIRS);
	assert_true(overlapping > PAIRS / 4 && overlapping < PAIRS * 3 / 4);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(rays_meet_what_is_nearest), cmocka_unit_test(bodies_meet_what_is_nearest),
		cmocka_unit_test(what_is_touched_is_found), cmocka_unit_test(boxes_hold_what_reaches_into_them), cmocka_unit_test(the_nearest_is_found),
		cmocka_unit_test(what_overlaps_is_measured)};
	return cmocka_run_group_tests_name("snapshot_hollows_random", tests, NULL, NULL);
}
