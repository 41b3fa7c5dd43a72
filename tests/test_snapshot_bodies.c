/* carom_snapshot: what bodies meet that move straight ahead, and what they touch.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <string.h>

#include "count.h"
#include "solids.h"

static carom_ray_hit cast(const carom_snapshot *snapshot, const carom_body_def *body, carom_vec2 to)
{
	carom_ray_hit hit;
	carom_error error;
	scenery_check(carom_snapshot_cast_bodies(snapshot, 1, body, &to, &hit, &error), &error);
	return hit;
}

/* ---- Known answers: a disc, a box of 2 x 2, and one that stands on its corner, in a room of 20 x 10 */

static carom_snapshot *known(void)
{
	carom_body_def bodies[] = {scenery_circle(0, 0, 0, 0, 1), scenery_box(4, 0, 0, 0, 2, 2), scenery_box(-4, 0, 0, 0, 2, 2)};
	carom_world_def def = carom_default_world_def();
	def.has_room = true;
	def.room_min = (carom_vec2){-10.0f, -5.0f};
	def.room_max = (carom_vec2){10.0f, 5.0f};
	bodies[2].angle = 0.78539816f;
	bodies[2].categories = 4;
	bodies[2].mask = 6;
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, COUNT(bodies));
	carom_snapshot *snapshot = runs_snapshot(world);
	carom_world_destroy(world);
	return snapshot;
}

static carom_body_def box_at(float x, float y, float angle, uint32_t categories)
{
	static const carom_vec2 corners[] = {{-0.5f, -0.25f}, {0.5f, -0.25f}, {0.5f, 0.25f}, {-0.5f, 0.25f}};
	carom_body_def box = carom_default_body_def();
	box.shape = CAROM_POLYGON;
	box.vertices = corners;
	box.vertex_count = COUNT(corners);
	box.position = (carom_vec2){x, y};
	box.angle = angle;
	box.categories = categories;
	return box;
}

static void bodies_meet_what_is_known(void **unused)
{
	const float quarter = 1.57079633f, eighth = 0.78539816f, half = 0.70710678f, aside = 0.96824584f;
	const struct {
		carom_body_def body;
		carom_vec2 to;
		carom_ray_hit wanted;
	} cases[] = {
		/* flush on the box, on its side, and half beside it; on the disc, and past it */
		{box_at(4, 4, 0, 1), {4, 0}, {1, 2.75 / 4, {4, 1}, {0, 1}}},
		{box_at(4.75f, 4, quarter, 1), {4.75f, 0}, {1, 2.5 / 4, {4.75f, 1}, {0, 1}}},
		{box_at(5.25f, 4, 0, 1), {5.25f, 0}, {1, 2.75 / 4, {4.875f, 1}, {0, 1}}},
		{box_at(0, -4, 0, 1), {0, 0}, {0, 2.75 / 4, {0, -1}, {0, -1}}},
		{box_at(1.6f, -1.1f, 0, 1), {1.6f, 0.9f}, {CAROM_NOTHING, 1, {1.6f, 0.9f}, {0, 0}}},
		/* the box on its corner is met by what is of a category that it hits: by a face, and flush */
		{box_at(-4, 4, 0, 1), {-4, -4}, {CAROM_NOTHING, 1, {-4, -4}, {0, 0}}},
		{box_at(-4, 4, 0, 2), {-4, 0}, {2, (3.75 - sqrt(2)) / 4, {-4, 2 * half}, {0, 1}}},
		{box_at(-2, 2, eighth, 2), {-4, 0}, {2, (2 * sqrt(2) - 1.5) / (2 * sqrt(2)), {half - 4, half}, {half, half}}},
		/* walls, by a face; there is none as far as it goes */
		{box_at(8, 3, quarter, 1), {11, 3}, {CAROM_WALL_RIGHT, 1.75 / 3, {10, 3}, {-1, 0}}},
		{box_at(8, 3, 0, 1), {8, 4.7f}, {CAROM_NOTHING, 1, {8, 4.7f}, {0, 0}}},
		/* out of the box, with a corner to the disc; what it touches, and no way at all */
		{box_at(4, 0.5f, 0, 1), {0, 0.5f}, {0, (3.5 - 0.96824583655) / 4, {aside, 0.25f}, {aside, 0.25f}}},
		{box_at(4, 1.25f, 0, 1), {4, -4}, {CAROM_NOTHING, 1, {4, -4}, {0, 0}}},
		{box_at(2, 2, 0, 1), {2, 2}, {CAROM_NOTHING, 1, {2, 2}, {0, 0}}},
	};
	carom_snapshot *snapshot = known();
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		const carom_ray_hit hit = cast(snapshot, &cases[i].body, cases[i].to), wanted = cases[i].wanted;
		const double aside_by = hypot((double)(hit.point.x - wanted.point.x), (double)(hit.point.y - wanted.point.y));
		const double turned_by = hypot((double)(hit.normal.x - wanted.normal.x), (double)(hit.normal.y - wanted.normal.y));
		if (hit.other != wanted.other || !(fabs(hit.part - wanted.part) < 1e-6) || !(aside_by < 1e-6) || !(turned_by < 1e-6))
			fail_msg("%zu: %d at %.9g, (%g, %g), normal (%g, %g)", i, hit.other, hit.part, (double)hit.point.x, (double)hit.point.y,
				(double)hit.normal.x, (double)hit.normal.y);
	}
	carom_snapshot_destroy(snapshot);
}

static void bodies_touch_what_is_known(void **unused)
{
	const struct {
		carom_body_def body;
		size_t count;
		uint32_t indices[3];
	} cases[] = {
		{box_at(4, 0, 0, 1), 1, {1}},     /* inside */
		{box_at(4, 1.25f, 0, 1), 1, {1}}, /* just touches */
		{box_at(4, 1.26f, 0, 1), 0, {0}},
		{box_at(-4, 0, 0, 1), 0, {0}}, /* passes through it */
		{box_at(-4, 0, 0, 2), 1, {2}},
		{scenery_circle(0, 0, 0, 0, 3), 2, {0, 1}},
		{scenery_circle(0, 5, 0, 0, 3.99f), 0, {0}},
	};
	carom_snapshot *snapshot = known();
	uint32_t found[3];
	size_t count;
	carom_error error;
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		scenery_check(carom_snapshot_find_touching(snapshot, &cases[i].body, found, COUNT(found), &count, &error), &error);
		if (count != cases[i].count || memcmp(found, cases[i].indices, count * sizeof *found) != 0)
			fail_msg("%zu: %zu are touched", i, count);
	}
	scenery_check(carom_snapshot_find_touching(snapshot, &cases[5].body, NULL, 0, &count, &error), &error);
	assert_int_equal(count, 2);
	carom_snapshot_destroy(snapshot);
}

static void what_is_wrong_is_named(void **unused)
{
	carom_body_def bodies[] = {scenery_circle(0, 3, 0, 0, 1), scenery_circle(0, 3, 0, 0, 1)};
	carom_vec2 to[] = {{0, 0}, {0, INFINITY}};
	carom_ray_hit hits[2] = {{.other = 7}, {.other = 7}};
	carom_snapshot *snapshot = known();
	carom_error error;
	size_t count = 7;
	(void)unused;
	assert_int_equal(carom_snapshot_cast_bodies(snapshot, 2, bodies, to, hits, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "to[1]: found (0, inf); allowed: finite numbers");
	to[1].y = 0;
	bodies[1].radius = -1;
	assert_int_equal(carom_snapshot_cast_bodies(snapshot, 2, bodies, to, hits, &error), CAROM_INVALID_ARGUMENT);
	assert_non_null(strstr(error.text, "bodies[1].radius: found -1"));
	assert_true(hits[0].other == 7 && hits[1].other == 7);
	assert_int_equal(carom_snapshot_find_touching(snapshot, &bodies[1], NULL, 0, &count, &error), CAROM_INVALID_ARGUMENT);
	assert_non_null(strstr(error.text, "bodies[0].radius: found -1"));
	assert_int_equal(count, 7);
	assert_int_equal(carom_snapshot_cast_bodies(snapshot, 0, NULL, NULL, NULL, NULL), CAROM_OK);
	carom_snapshot_destroy(snapshot);
}

/* ---- Any bodies among any bodies */

enum { CASTS = 250 };

/* Of many sizes, somewhere, each with a way; and as the tests see them. */
static void any_bodies(scenery_random *random, carom_body_def *bodies, carom_vec2 *to, solid *solids)
{
	static carom_vec2 flat[CASTS][4];
	const carom_world_def def = carom_default_world_def();
	scenery_bodies(random, SCENERY_MIXED, CASTS, 1.4f, 0.0f, bodies);
	for (int k = 0; k < CASTS; k++) {
		const float size = powf(10.0f, scenery_uniform(random, -2, 0.5f));
		bodies[k].position = solids_somewhere(random);
		bodies[k].angle = scenery_uniform(random, -3, 3);
		bodies[k].radius = size;
		if (bodies[k].shape == CAROM_POLYGON) {
			const float height = 0.5f * size * scenery_uniform(random, 0.05f, 1), width = 0.5f * size;
			memcpy(flat[k], (carom_vec2[]){{-width, -height}, {width, -height}, {width, height}, {-width, height}}, sizeof flat[k]);
			bodies[k].vertices = flat[k];
			bodies[k].vertex_count = 4;
		}
		to[k] = k % 3 ? solids_somewhere(random) : (carom_vec2){bodies[k].position.x + scenery_uniform(random, -2, 2), bodies[k].position.y};
	}
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, CASTS);
	for (uint32_t k = 0; k < CASTS; k++)
		solids[k] = solids_of(world, k);
	carom_world_destroy(world);
}

static void bodies_meet_what_is_nearest(void **unused)
{
	static solid stand[SOLIDS_COUNT], move[CASTS];
	static carom_body_def bodies[CASTS];
	carom_vec2 to[CASTS];
	carom_ray_hit hits[CASTS];
	int sure = 0, met = 0, polygons = 0;
	(void)unused;
	for (uint64_t seed = 1; seed <= 2; seed++) {
		scenery_random random = {seed};
		carom_world *world = solids_wild(&random, stand);
		carom_snapshot *snapshot = runs_snapshot(world);
		carom_error error;
		any_bodies(&random, bodies, to, move);
		scenery_check(carom_snapshot_cast_bodies(snapshot, CASTS, bodies, to, hits, &error), &error);
		for (int i = 0; i < CASTS; i++) {
			const double x = (double)to[i].x - move[i].x, y = (double)to[i].y - move[i].y;
			int32_t nearest;
			const double first = solids_first(stand, SOLIDS_COUNT, solids_meeting, &move[i], x, y, &nearest);
			if (first < 0)
				continue;
			sure++;
			if (hits[i].other != nearest || (nearest >= 0 && !(fabs(hits[i].part - first) < 1e-6)))
				fail_msg("seed %llu, body %d: %d at %.12g instead of %d at %.12g", (unsigned long long)seed, i, hits[i].other, hits[i].part, nearest,
					first);
			if (nearest < 0)
				continue;
			met++;
			polygons += move[i].count > 0 && stand[nearest].count > 0;
			/* the point is on both, and along the normal one leaves the other */
			const solid there = solids_moved(&move[i], hits[i].part * x, hits[i].part * y);
			const carom_vec2 at = hits[i].point, n = hits[i].normal;
			assert_true(fabs(solids_distance(&stand[nearest], (double)at.x, (double)at.y)) < 1e-5);
			assert_true(fabs(solids_distance(&there, (double)at.x, (double)at.y)) < 1e-5);
			const solid away = solids_moved(&there, 0.001 * (double)n.x, 0.001 * (double)n.y);
			assert_true(fabs(solids_gap(&stand[nearest], &away) - 0.001) < 1e-5);
		}
		carom_snapshot_destroy(snapshot);
		carom_world_destroy(world);
	}
	print_message("%d of %d bodies are sure, %d of these meet something, %d of these are polygons that meet one\n", sure, 2 * CASTS, met, polygons);
	assert_true(sure > 2 * CASTS * 9 / 10 && met > CASTS && polygons > CASTS / 4);
}

/* A disc that is cast is the ray of its radius, to the bit. */
static void discs_are_rays(void **unused)
{
	static solid stand[SOLIDS_COUNT];
	scenery_random random = {5};
	carom_world *world = solids_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	int met = 0;
	(void)unused;
	for (int i = 0; i < CASTS; i++) {
		const carom_vec2 from = solids_somewhere(&random), to = solids_somewhere(&random);
		const carom_body_def disc = scenery_circle(from.x, from.y, 0, 0, powf(10.0f, scenery_uniform(&random, -3, 0.5f)));
		const carom_ray ray = {from, to, disc.radius};
		carom_ray_hit of_ray, of_disc = cast(snapshot, &disc, to);
		assert_int_equal(carom_snapshot_cast_rays(snapshot, 1, &ray, &of_ray, NULL), CAROM_OK);
		assert_true(of_ray.other == of_disc.other && of_ray.part == of_disc.part);
		assert_memory_equal(&of_ray.point, &of_disc.point, sizeof of_ray.point);
		assert_memory_equal(&of_ray.normal, &of_disc.normal, sizeof of_ray.normal);
		met += of_ray.other >= 0;
	}
	assert_true(met > CASTS / 2);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

static void what_is_touched_is_found(void **unused)
{
	static solid stand[SOLIDS_COUNT], ask[CASTS];
	static carom_body_def bodies[CASTS];
	carom_vec2 to[CASTS];
	scenery_random random = {8};
	carom_world *world = solids_wild(&random, stand);
	carom_snapshot *snapshot = runs_snapshot(world);
	size_t all = 0;
	(void)unused;
	any_bodies(&random, bodies, to, ask);
	for (int i = 0; i < CASTS; i++) {
		uint32_t found[SOLIDS_COUNT];
		size_t count, next = 0;
		carom_error error;
		scenery_check(carom_snapshot_find_touching(snapshot, &bodies[i], found, COUNT(found), &count, &error), &error);
		for (uint32_t k = 0; k < SOLIDS_COUNT; k++) {
			const bool is_found = next < count && found[next] == k;
			const double gap = solids_gap(&stand[k], &ask[i]);
			next += is_found;
			if (fabs(gap) > SOLIDS_SURE && is_found != (gap < 0))
				fail_msg("body %d of %d: %s, but the gap is %g", (int)k, i, is_found ? "found" : "not found", gap);
		}
		assert_int_equal(next, count);
		all += count;
	}
	print_message("%zu bodies are touched by %d\n", all, CASTS);
	assert_true(all > CASTS / 2);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(bodies_meet_what_is_known), cmocka_unit_test(bodies_touch_what_is_known),
		cmocka_unit_test(what_is_wrong_is_named), cmocka_unit_test(bodies_meet_what_is_nearest), cmocka_unit_test(discs_are_rays),
		cmocka_unit_test(what_is_touched_is_found)};
	return cmocka_run_group_tests_name("snapshot_bodies", tests, NULL, NULL);
}
