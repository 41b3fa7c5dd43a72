/* carom_snapshot: what rays meet and what lies in boxes, where that is known; and what it is of.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "count.h"
#include "runs.h"

static carom_world *world_of(const carom_body_def *bodies, size_t count, bool has_room)
{
	carom_world_def def = carom_default_world_def();
	def.has_room = has_room;
	def.room_min = (carom_vec2){-10.0f, -5.0f};
	def.room_max = (carom_vec2){10.0f, 5.0f};
	return runs_world(&def, &scenery_devices[0], bodies, count);
}

static carom_ray_hit cast(const carom_snapshot *snapshot, carom_ray ray)
{
	carom_ray_hit hit;
	carom_error error;
	scenery_check(carom_snapshot_cast_rays(snapshot, 1, &ray, &hit, &error), &error);
	return hit;
}

/* ---- Known answers */

static void check_ray(const carom_snapshot *snapshot, carom_ray ray, carom_ray_hit wanted)
{
	const carom_ray_hit hit = cast(snapshot, ray);
	const double off = fmax(fmax(fabs(hit.part - wanted.part),
								fmax(fabs((double)(hit.point.x - wanted.point.x)), fabs((double)(hit.point.y - wanted.point.y)))),
		fmax(fabs((double)(hit.normal.x - wanted.normal.x)), fabs((double)(hit.normal.y - wanted.normal.y))));
	if (hit.other != wanted.other || !(off < 1e-6))
		fail_msg("(%g, %g) to (%g, %g), radius %g: %d at %.9g, (%g, %g), normal (%g, %g) instead of %d at %.9g, (%g, %g), normal (%g, %g)",
			(double)ray.from.x, (double)ray.from.y, (double)ray.to.x, (double)ray.to.y, (double)ray.radius, hit.other, hit.part, (double)hit.point.x,
			(double)hit.point.y, (double)hit.normal.x, (double)hit.normal.y, wanted.other, wanted.part, (double)wanted.point.x,
			(double)wanted.point.y, (double)wanted.normal.x, (double)wanted.normal.y);
}

static void rays_meet_what_is_known(void **unused)
{
	/* a disc, a box of 2 x 2, and one that stands on its corner */
	carom_body_def bodies[] = {scenery_circle(0, 0, 0, 0, 1), scenery_box(4, 0, 0, 0, 2, 2), scenery_box(-4, 0, 0, 0, 2, 2)};
	const float half = 0.70710678f, corner = 1.41421356f;
	(void)unused;
	bodies[2].angle = 0.78539816f;
	for (int has_room = 0; has_room < 2; has_room++) {
		carom_world *world = world_of(bodies, COUNT(bodies), has_room);
		carom_snapshot *snapshot = runs_snapshot(world);
		const carom_ray_hit wall = {CAROM_WALL_TOP, 0.5, {1, 5}, {0, -1}}, none = {CAROM_NOTHING, 1, {1, 8}, {0, 0}};
		carom_world_destroy(world); /* which it does not need any more */
		check_ray(snapshot, (carom_ray){{0, 4}, {0, -4}, 0}, (carom_ray_hit){0, 3.0 / 8, {0, 1}, {0, 1}});
		check_ray(snapshot, (carom_ray){{0, 4}, {0, -4}, 0.5f}, (carom_ray_hit){0, 2.5 / 8, {0, 1}, {0, 1}});
		/* what it begins in it does not meet: out of the disc to the box, and the disc that touches it */
		check_ray(snapshot, (carom_ray){{0.5f, 0.25f}, {4.5f, 0.25f}, 0}, (carom_ray_hit){1, 2.5 / 4, {3, 0.25f}, {-1, 0}});
		check_ray(snapshot, (carom_ray){{2, 0.25f}, {-0.5f, 0.25f}, 1},
			(carom_ray_hit){0, (2.0 - sqrt(4 - 0.0625)) / 2.5, {sqrtf(1 - 0.015625f), 0.125f}, {sqrtf(1 - 0.015625f), 0.125f}});
		check_ray(snapshot, (carom_ray){{2.5f, 3}, {2.5f, 4.5f}, 0.25f}, (carom_ray_hit){CAROM_NOTHING, 1, {2.5f, 4.5f}, {0, 0}});
		/* faces, corners, and discs that go round them */
		check_ray(snapshot, (carom_ray){{7, -0.5f}, {3, -0.5f}, 0}, (carom_ray_hit){1, 0.5, {5, -0.5f}, {1, 0}});
		check_ray(snapshot, (carom_ray){{7, -0.5f}, {3, -0.5f}, 0.5f}, (carom_ray_hit){1, 1.5 / 4, {5, -0.5f}, {1, 0}});
		check_ray(snapshot, (carom_ray){{7, 1 + half}, {3, 1 + half}, 1}, (carom_ray_hit){1, (2.0 - (double)half) / 4, {5, 1}, {half, half}});
		check_ray(snapshot, (carom_ray){{-4, 4}, {-4, 0}, 0.5f}, (carom_ray_hit){2, (4.0 - 0.5 - (double)corner) / 4, {-4, corner}, {0, 1}});
		check_ray(snapshot, (carom_ray){{-5, 3}, {-5, -3}, 0}, (carom_ray_hit){2, (4.0 - (double)corner) / 6, {-5, corner - 1}, {-half, half}});
		/* to the walls, and where there are none */
		check_ray(snapshot, (carom_ray){{1, 2}, {1, 8}, 0}, has_room ? wall : none);
		if (!has_room) {
			carom_snapshot_destroy(snapshot);
			continue;
		}
		check_ray(snapshot, (carom_ray){{1, -2}, {1, -6}, 1}, (carom_ray_hit){CAROM_WALL_BOTTOM, 0.5, {1, -5}, {0, 1}});
		check_ray(snapshot, (carom_ray){{-8, 1}, {-12, 2}, 0}, (carom_ray_hit){CAROM_WALL_LEFT, 0.5, {-10, 1.5f}, {1, 0}});
		check_ray(snapshot, (carom_ray){{8, 1}, {16, 1}, 0}, (carom_ray_hit){CAROM_WALL_RIGHT, 0.25, {10, 1}, {-1, 0}});
		carom_snapshot_destroy(snapshot);
	}
}

static void of_what_is_met_at_once_the_first_counts(void **unused)
{
	carom_body_def bodies[] = {scenery_box(9, 2, 0, 0, 2, 2), scenery_box(2, -1, 0, 0, 2, 2), scenery_box(2, 1, 0, 0, 2, 2)};
	carom_world *world = world_of(bodies, COUNT(bodies), true);
	carom_snapshot *snapshot = runs_snapshot(world);
	(void)unused;
	assert_int_equal(cast(snapshot, (carom_ray){{0, 0}, {4, 0}, 0.5f}).other, 1);
	assert_int_equal(cast(snapshot, (carom_ray){{0, 0}, {4, 0}, 0}).other, 1);
	assert_int_equal(cast(snapshot, (carom_ray){{6, 3.5f}, {10, 3.5f}, 0.5f}).other, 0); /* before the wall at 9.5 */
	assert_int_equal(cast(snapshot, (carom_ray){{0, 0}, {0, 0}, 0.5f}).other, CAROM_NOTHING);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void check_box(const carom_snapshot *snapshot, carom_vec2 min, carom_vec2 max, size_t wanted, const uint32_t *indices)
{
	uint32_t found[8] = {0};
	size_t count = 99;
	carom_error error;
	scenery_check(carom_snapshot_find(snapshot, min, max, found, COUNT(found), &count, &error), &error);
	assert_int_equal(count, wanted);
	for (size_t k = 0; k < wanted; k++)
		assert_int_equal(found[k], indices[k]);
}

static void boxes_hold_what_is_known(void **unused)
{
	carom_body_def bodies[] = {
		scenery_circle(0, 0, 0, 0, 1), scenery_box(4, 0, 0, 0, 2, 2), scenery_box(-4, 0, 0, 0, 2, 2), scenery_circle(0, 0, 0, 0, 0.001f)};
	carom_world *world;
	carom_snapshot *snapshot;
	uint32_t indices[4] = {77, 77, 77, 77};
	size_t count = 0;
	(void)unused;
	bodies[2].angle = 0.78539816f;
	world = world_of(bodies, COUNT(bodies), false);
	snapshot = runs_snapshot(world);
	check_box(snapshot, (carom_vec2){-9, -9}, (carom_vec2){9, 9}, 4, (uint32_t[]){0, 1, 2, 3});
	check_box(snapshot, (carom_vec2){0, 0}, (carom_vec2){0, 0}, 2, (uint32_t[]){0, 3});
	check_box(snapshot, (carom_vec2){1, 0}, (carom_vec2){1, 0}, 1, (uint32_t[]){0}); /* on its rim */
	check_box(snapshot, (carom_vec2){0.75f, 0.75f}, (carom_vec2){2, 2}, 0, NULL);    /* its box touches, it does not */
	check_box(snapshot, (carom_vec2){0.70f, 0.70f}, (carom_vec2){2, 2}, 1, (uint32_t[]){0});
	check_box(snapshot, (carom_vec2){3, 1}, (carom_vec2){3, 1}, 1, (uint32_t[]){1}); /* its corner */
	check_box(snapshot, (carom_vec2){3, 1.00001f}, (carom_vec2){3, 2}, 0, NULL);
	check_box(snapshot, (carom_vec2){-5, 0.5f}, (carom_vec2){-4.95f, 2}, 0, NULL); /* beside the face of one that stands on a corner */
	check_box(snapshot, (carom_vec2){-5, 0.5f}, (carom_vec2){-4.5f, 2}, 1, (uint32_t[]){2});
	check_box(snapshot, (carom_vec2){-4, -3}, (carom_vec2){4, 3}, 4, (uint32_t[]){0, 1, 2, 3});
	/* no more than there is room for */
	assert_int_equal(carom_snapshot_find(snapshot, (carom_vec2){-9, -9}, (carom_vec2){9, 9}, indices, 3, &count, NULL), CAROM_OK);
	assert_true(count == 4 && indices[0] < indices[1] && indices[1] < indices[2] && indices[2] < 4 && indices[3] == 77);
	assert_int_equal(carom_snapshot_find(snapshot, (carom_vec2){-9, -9}, (carom_vec2){9, 9}, NULL, 0, &count, NULL), CAROM_OK);
	assert_int_equal(count, 4);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void wrong_questions_are_refused(void **unused)
{
	carom_body_def body = scenery_circle(0, 0, 0, 0, 1);
	carom_world *world = world_of(&body, 1, false);
	carom_snapshot *snapshot = runs_snapshot(world);
	const carom_ray rays[] = {{{0, 0}, {1, 0}, 0}, {{0, NAN}, {1, 0}, 0}, {{0, 0}, {1, INFINITY}, 0}, {{0, 0}, {1, 0}, -1}};
	static const char *const texts[] = {"rays[0].from.y: found nan; allowed: a finite number", "rays[0].to.y: found inf; allowed: a finite number",
		"rays[0].radius: found -1; allowed: a finite number, 0 or more"};
	carom_ray_hit hits[2] = {{42, 0, {0, 0}, {0, 0}}, {42, 0, {0, 0}, {0, 0}}};
	carom_error error;
	size_t count = 42;
	uint32_t index;
	(void)unused;
	for (size_t k = 0; k < COUNT(texts); k++) {
		assert_int_equal(carom_snapshot_cast_rays(snapshot, 1, &rays[k + 1], hits, &error), CAROM_INVALID_ARGUMENT);
		assert_string_equal(error.text, texts[k]);
	}
	assert_int_equal(carom_snapshot_cast_rays(snapshot, 2, rays, hits, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "rays[1].from.y: found nan; allowed: a finite number");
	assert_true(hits[0].other == 42); /* all or none */
	assert_int_equal(carom_snapshot_cast_rays(snapshot, 0, NULL, NULL, &error), CAROM_OK);
	assert_int_equal(carom_snapshot_find(snapshot, (carom_vec2){1, 0}, (carom_vec2){0, 1}, &index, 1, &count, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "box: found (1, 0) to (0, 1); allowed: finite numbers, min no larger than max");
	assert_int_equal(carom_snapshot_find(snapshot, (carom_vec2){NAN, 0}, (carom_vec2){0, 1}, &index, 1, &count, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(count, 42);
	const carom_vec2 points[] = {{0, 0}, {0, -INFINITY}};
	carom_nearest nearest[2] = {{.body = 42}, {.body = 42}};
	assert_int_equal(carom_snapshot_find_nearest(snapshot, 2, points, 1, nearest, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "points[1]: found (0, -inf); allowed: finite numbers");
	assert_int_equal(carom_snapshot_find_nearest(snapshot, 1, points, NAN, nearest, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "within: found nan; allowed: a number, 0 or more");
	assert_int_equal(carom_snapshot_find_nearest(snapshot, 1, points, -1, nearest, &error), CAROM_INVALID_ARGUMENT);
	assert_true(nearest[0].body == 42);
	assert_int_equal(carom_snapshot_find_nearest(snapshot, 0, NULL, 1, NULL, &error), CAROM_OK);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

/* ---- Worlds that go on */

/* A fan of rays from the middle of a room, after some steps: the same bits on every device, and still the same when the world has gone on. */
static void a_snapshot_is_of_its_time_on_every_device(void **unused)
{
	enum { FAN = 64 };
	carom_ray rays[FAN];
	carom_ray_hit expected[FAN], hits[FAN];
	bool is_first = true;
	(void)unused;
	memset(expected, 0, sizeof expected);
	for (int k = 0; k < FAN; k++)
		rays[k] = (carom_ray){{0.1f, 0.2f}, {30.0f * cosf(0.1f * (float)k), 30.0f * sinf(0.1f * (float)k)}, k % 2 ? 0.05f : 0.0f};
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = scenery_crowd(device, 5, 0);
		carom_error error;
		if (!world)
			continue;
		scenery_check(carom_world_step(world, 20, NULL, &error), &error);
		carom_snapshot *snapshot = runs_snapshot(world);
		memset(hits, 0, sizeof hits);
		scenery_check(carom_snapshot_cast_rays(snapshot, FAN, rays, hits, &error), &error);
		for (int k = 0; k < FAN; k++) {
			assert_true(hits[k].other != CAROM_NOTHING); /* the walls, at the latest */
			if (is_first)
				expected[k] = hits[k];
			assert_true(hits[k].other == expected[k].other && hits[k].part == expected[k].part);
			assert_memory_equal(&hits[k].point, &expected[k].point, 2 * sizeof(carom_vec2));
		}
		is_first = false;
		scenery_check(carom_world_step(world, 20, NULL, &error), &error);
		carom_snapshot *later = runs_snapshot(world);
		carom_world_destroy(world);
		int other = 0;
		for (int k = 0; k < FAN; k++) {
			assert_true(cast(snapshot, rays[k]).part == expected[k].part);
			other += cast(later, rays[k]).part != expected[k].part;
		}
		assert_true(other > FAN / 4);
		carom_snapshot_destroy(snapshot);
		carom_snapshot_destroy(later);
	}
}

static void in_an_empty_world_there_is_nothing(void **unused)
{
	carom_world *world = world_of(NULL, 0, false);
	carom_snapshot *snapshot = runs_snapshot(world);
	(void)unused;
	assert_int_equal(cast(snapshot, (carom_ray){{0, 0}, {9, 9}, 1}).other, CAROM_NOTHING);
	check_box(snapshot, (carom_vec2){-9, -9}, (carom_vec2){9, 9}, 0, NULL);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(rays_meet_what_is_known), cmocka_unit_test(of_what_is_met_at_once_the_first_counts),
		cmocka_unit_test(boxes_hold_what_is_known), cmocka_unit_test(wrong_questions_are_refused),

		cmocka_unit_test(a_snapshot_is_of_its_time_on_every_device), cmocka_unit_test(in_an_empty_world_there_is_nothing)};
	return cmocka_run_group_tests_name("snapshot", tests, NULL, NULL);
}
