/* carom_snapshot: any rays, boxes and points among any bodies.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "count.h"
#include "solids.h"

static carom_world *world_of(const carom_body_def *bodies, size_t count)
{
	const carom_world_def def = carom_default_world_def();
	return runs_world(&def, &scenery_devices[0], bodies, count);
}

enum { BODIES = SOLIDS_COUNT, RAYS = 1000, BOXES = 1000, POINTS = 20000 };

static void rays_meet_what_is_nearest(void **unused)
{
	static solid solids[BODIES];
	int sure = 0, met = 0, thick = 0;
	(void)unused;
	for (uint64_t seed = 1; seed <= 2; seed++) {
		scenery_random random = {seed};
		carom_world *world = solids_wild(&random, solids);
		carom_snapshot *snapshot = runs_snapshot(world);
		for (int i = 0; i < RAYS; i++) {
			carom_ray ray = {solids_somewhere(&random), solids_somewhere(&random), 0};
			int32_t nearest;
			carom_ray_hit hit;
			if (i % 3 == 1)
				ray.to.x = ray.from.x;
			if (i % 3 == 2)
				ray.to = (carom_vec2){ray.from.x + scenery_uniform(&random, -2, 2), ray.from.y + scenery_uniform(&random, -2, 2)};
			if (i % 2)
				ray.radius = powf(10.0f, scenery_uniform(&random, -3, 0.5f));
			const solid disc = {.x = (double)ray.from.x, .y = (double)ray.from.y, .radius = (double)ray.radius};
			const double first = solids_first(solids, SOLIDS_COUNT, solids_meeting, &disc, (double)ray.to.x - disc.x, (double)ray.to.y - disc.y,
				&nearest);
			if (first < 0)
				continue;
			assert_int_equal(carom_snapshot_cast_rays(snapshot, 1, &ray, &hit, NULL), CAROM_OK);
			if (hit.other != nearest || (nearest >= 0 && !(fabs(hit.part - first) < 1e-6)))
				fail_msg("seed %llu, ray %d: %d at %.12g instead of %d at %.12g", (unsigned long long)seed, i, hit.other, hit.part, nearest, first);
			sure++;
			if (nearest < 0)
				continue;
			met++;
			thick += ray.radius > 0;
			/* the point is on the body, and the normal leads away from it */
			assert_true(fabs(solids_distance(&solids[nearest], (double)hit.point.x, (double)hit.point.y)) < 1e-5);
			assert_true(fabs(hypot((double)hit.normal.x, (double)hit.normal.y) - 1) < 1e-6);
			const double away = solids_distance(&solids[nearest], (double)hit.point.x + 0.001 * (double)hit.normal.x,
				(double)hit.point.y + 0.001 * (double)hit.normal.y);
			assert_true(fabs(away - 0.001) < 1e-5);
		}
		carom_snapshot_destroy(snapshot);
		carom_world_destroy(world);
	}
	print_message("%d of %d rays are sure, %d of these meet something, %d of these are discs\n", sure, 2 * RAYS, met, thick);
	assert_true(sure > 2 * RAYS * 9 / 10 && met > 2 * RAYS / 3 && thick > RAYS / 3);
}

/* The least distance of a body from a box: along a line it falls and then rises, and what is least on lines does so, too. */
static double distance_of_box(const solid *s, carom_vec2 min, carom_vec2 max)
{
	double low = (double)min.y, high = (double)max.y, least = HUGE_VAL;
	for (int k = 0; k < 50; k++) {
		const double ys[2] = {low + (high - low) / 3, high - (high - low) / 3};
		double found[2];
		for (int i = 0; i < 2; i++) {
			double left = (double)min.x, right = (double)max.x;
			for (int n = 0; n < 50; n++) {
				const double a = left + (right - left) / 3, b = right - (right - left) / 3;
				if (solids_distance(s, a, ys[i]) < solids_distance(s, b, ys[i]))
					right = b;
				else
					left = a;
			}
			found[i] = solids_distance(s, left, ys[i]);
			least = fmin(least, found[i]);
		}
		if (found[0] < found[1])
			high = ys[1];
		else
			low = ys[0];
	}
	return least;
}

static void boxes_hold_what_reaches_into_them(void **unused)
{
	static solid solids[BODIES];
	scenery_random random = {3};
	carom_world *world = solids_wild(&random, solids);
	carom_snapshot *snapshot = runs_snapshot(world);
	size_t all = 0;
	(void)unused;
	for (int i = 0; i < BOXES; i++) {
		const carom_vec2 min = solids_somewhere(&random);
		const float size = i % 4 == 0 ? 0.0f : i % 4 == 1 ? 10.0f : 1.0f;
		const carom_vec2 max = {min.x + scenery_uniform(&random, 0, size), min.y + scenery_uniform(&random, 0, size)};
		uint32_t found[BODIES];
		size_t count, next = 0;
		carom_error error;
		scenery_check(carom_snapshot_find(snapshot, min, max, found, COUNT(found), &count, &error), &error);
		for (uint32_t k = 0; k < BODIES; k++) {
			const bool is_found = next < count && found[next] == k;
			const double far = hypot(fmax(fmax((double)min.x - solids[k].x, solids[k].x - (double)max.x), 0),
				fmax(fmax((double)min.y - solids[k].y, solids[k].y - (double)max.y), 0));
			const double least = far > solids[k].radius + SOLIDS_SURE ? far : distance_of_box(&solids[k], min, max);
			next += is_found;
			if (fabs(least) > SOLIDS_SURE && is_found != (least < 0))
				fail_msg("box %d, body %u: %s, but its distance is %g", i, k, is_found ? "found" : "not found", least);
		}
		assert_int_equal(next, count);
		all += count;
	}
	print_message("%zu bodies in %d boxes\n", all, BOXES);
	assert_true(all > BOXES / 2);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

/* Far outside of all, too, and with a limit. */
static void the_nearest_is_found(void **unused)
{
	static solid solids[BODIES];
	scenery_random random = {6};
	carom_world *world = solids_wild(&random, solids);
	carom_snapshot *snapshot = runs_snapshot(world);
	int inside = 0, none = 0;
	(void)unused;
	for (int i = 0; i < POINTS; i++) {
		const float scale = i % 5 == 4 ? 1000.0f : 1.0f, within = i % 3 == 2 ? scenery_uniform(&random, 0, 2) : INFINITY;
		const carom_vec2 place = solids_somewhere(&random), point = {scale * place.x, scale * place.y};
		double least = HUGE_VAL, of_body;
		carom_nearest found;
		carom_error error;
		scenery_check(carom_snapshot_find_nearest(snapshot, 1, &point, within, &found, &error), &error);
		for (uint32_t k = 0; k < BODIES; k++)
			least = fmin(least, fmax(solids_distance(&solids[k], (double)point.x, (double)point.y), 0));
		if (fabs(least - (double)within) < SOLIDS_SURE)
			continue;
		if (least > (double)within) {
			assert_true(found.body == CAROM_NOTHING && found.distance == (double)within && found.point.x == point.x && found.normal.x == 0.0f);
			none++;
			continue;
		}
		assert_true(found.body >= 0 && found.body < BODIES);
		of_body = solids_distance(&solids[found.body], (double)point.x, (double)point.y);
		assert_true(fabs(fmax(of_body, 0) - least) < SOLIDS_SURE && fabs(found.distance - least) < SOLIDS_SURE);
		for (int32_t k = 0; k < found.body && found.distance == 0; k++)
			assert_true(solids_distance(&solids[k], (double)point.x, (double)point.y) > -SOLIDS_SURE);
		/* the point is on the body, and the normal leads from it to where it was asked */
		if (of_body < SOLIDS_SURE) {
			inside++;
			assert_true(found.point.x == point.x && found.point.y == point.y && found.distance < SOLIDS_SURE);
			continue;
		}
		assert_true(fabs(solids_distance(&solids[found.body], (double)found.point.x, (double)found.point.y)) < 1e-5);
		assert_true(fabs(hypot((double)found.normal.x, (double)found.normal.y) - 1) < 1e-6);
		const double far = 1e-5 + 1e-6 * found.distance;
		assert_true(fabs((double)found.point.x + found.distance * (double)found.normal.x - (double)point.x) < far);
		assert_true(fabs((double)found.point.y + found.distance * (double)found.normal.y - (double)point.y) < far);
	}
	print_message("%d of %d points are in bodies, %d far from all\n", inside, POINTS, none);
	assert_true(inside > POINTS / 10 && none > POINTS / 20);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

/* Discs of one size, which fill the cells in which they are looked for. */
static void points_lie_in_the_discs_about_them(void **unused)
{
	enum { SIDE = 12 };
	carom_body_def bodies[SIDE * SIDE];
	scenery_random random = {4};
	carom_world *world;
	carom_snapshot *snapshot;
	(void)unused;
	for (int k = 0; k < SIDE * SIDE; k++)
		bodies[k] = scenery_circle((float)(k % SIDE) + scenery_uniform(&random, 0, 0.5f), (float)(k / SIDE) + scenery_uniform(&random, 0, 0.5f), 0, 0,
			0.5f);
	world = world_of(bodies, SIDE * SIDE);
	snapshot = runs_snapshot(world);
	for (int i = 0; i < POINTS; i++) {
		const carom_vec2 point = {scenery_uniform(&random, -1, SIDE + 1), scenery_uniform(&random, -1, SIDE + 1)};
		uint32_t found[8];
		size_t count = 0, wanted = 0;
		assert_int_equal(carom_snapshot_find(snapshot, point, point, found, COUNT(found), &count, NULL), CAROM_OK);
		for (uint32_t k = 0; k < SIDE * SIDE; k++) {
			const double far = hypot((double)(point.x - bodies[k].position.x), (double)(point.y - bodies[k].position.y));
			const bool is_found = wanted < count && found[wanted] == k;
			if (fabs(far - 0.5) > 1e-6)
				assert_true(is_found == (far < 0.5));
			wanted += is_found;
		}
		assert_int_equal(wanted, count);
	}
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(rays_meet_what_is_nearest), cmocka_unit_test(boxes_hold_what_reaches_into_them),
		cmocka_unit_test(the_nearest_is_found), cmocka_unit_test(points_lie_in_the_discs_about_them)};
	return cmocka_run_group_tests_name("snapshot_random", tests, NULL, NULL);
}
