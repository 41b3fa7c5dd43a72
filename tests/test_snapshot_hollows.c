/* carom_snapshot and carom_measure, of polygons that are not convex: known answers.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <string.h>

#include "count.h"
#include "hollows.h"

#define HALF_TURN 3.14159265f

/* ---- A U, 4 m wide and 3 m high, with a notch of 2 m x 2 m */

#define U_LOW 1.25f /* of its centre of mass, above its foot */
static const carom_vec2 u_corners[] = {
	{-2, -U_LOW}, {2, -U_LOW}, {2, 3 - U_LOW}, {1, 3 - U_LOW}, {1, 1 - U_LOW}, {-1, 1 - U_LOW}, {-1, 3 - U_LOW}, {-2, 3 - U_LOW}};

/* With its foot there. */
static carom_body_def u_at(float x, float y, float angle)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_POLYGON;
	def.vertices = u_corners;
	def.vertex_count = COUNT(u_corners);
	def.position = (carom_vec2){x - U_LOW * sinf(angle), y + U_LOW * cosf(angle)};
	def.angle = angle;
	return def;
}

static carom_world *world_of(const carom_body_def *bodies, size_t count)
{
	carom_world_def def = carom_default_world_def();
	def.has_room = true;
	def.room_min = (carom_vec2){-20, -10};
	def.room_max = (carom_vec2){20, 10};
	return runs_world(&def, &scenery_devices[0], bodies, count);
}

static carom_snapshot *snapshot_of(carom_body_def body)
{
	carom_world *world = world_of(&body, 1);
	carom_snapshot *snapshot = runs_snapshot(world);
	carom_world_destroy(world);
	return snapshot;
}

static void check_hit(size_t number, carom_ray_hit hit, carom_ray_hit wanted)
{
	const double aside_by = hypot((double)(hit.point.x - wanted.point.x), (double)(hit.point.y - wanted.point.y));
	const double turned_by = hypot((double)(hit.normal.x - wanted.normal.x), (double)(hit.normal.y - wanted.normal.y));
	if (hit.other != wanted.other || !(fabs(hit.part - wanted.part) < 1e-6) || !(aside_by < 2e-6) || !(turned_by < 1e-6))
		fail_msg("%zu: %d at %.9g, (%g, %g), normal (%g, %g)", number, hit.other, hit.part, (double)hit.point.x, (double)hit.point.y,
			(double)hit.normal.x, (double)hit.normal.y);
}

static void rays_meet_what_is_known(void **unused)
{
	const struct {
		carom_ray ray;
		carom_ray_hit wanted;
	} cases[] = {
		/* into the notch, across it from within, and out of it */
		{{{0, 8}, {0, -8}, 0}, {0, 7.0 / 16, {0, 1}, {0, 1}}},
		{{{0, 2}, {4, 2}, 0}, {0, 0.25, {1, 2}, {-1, 0}}},
		{{{0, 2}, {-4, 3}, 0}, {0, 0.25, {-1, 2.25f}, {1, 0}}},
		{{{0, 2}, {0, 9}, 0}, {CAROM_NOTHING, 1, {0, 9}, {0, 0}}},
		/* past one arm to the other; to an arm from outside, and to its end */
		{{{-3, 6}, {2, 1}, 0}, {0, 0.8, {1, 2}, {-1, 0}}},
		{{{-5, 2}, {5, 2}, 0}, {0, 0.3, {-2, 2}, {-1, 0}}},
		{{{1.5f, 8}, {1.5f, 2}, 0}, {0, 5.0 / 6, {1.5f, 3}, {0, 1}}},
		/* from within, through the notch to the other arm: it looks out; so it does where pieces overlap, and on sides */
		{{{-1.5f, 2}, {9, 2}, 0}, {CAROM_NOTHING, 1, {9, 2}, {0, 0}}},
		{{{-1.25f, 0.75f}, {1.5f, 2.5f}, 0}, {CAROM_NOTHING, 1, {1.5f, 2.5f}, {0, 0}}},
		{{{1, 2}, {-9, 2}, 0}, {CAROM_NOTHING, 1, {-9, 2}, {0, 0}}},
		{{{0, 1}, {5, 1}, 0}, {CAROM_NOTHING, 1, {5, 1}, {0, 0}}},
		/* along the ends of the arms, and along the foot: corners are met */
		{{{-5, 3}, {5, 3}, 0}, {0, 0.3, {-2, 3}, {-1, 0}}},
		{{{-5, 0}, {5, 0}, 0}, {0, 0.3, {-2, 0}, {-1, 0}}},
		/* aslant, and no way at all */
		{{{0, 2}, {-2, 1}, 0}, {0, 0.5, {-1, 1.5f}, {1, 0}}},
		{{{0, 2}, {0, 2}, 0}, {CAROM_NOTHING, 1, {0, 2}, {0, 0}}},
		/* discs: one that goes into the notch, one that is too broad, one in it, and one that touches an arm */
		{{{0, 8}, {0, -8}, 0.5f}, {0, 6.5 / 16, {0, 1}, {0, 1}}},
		{{{0.25f, 8}, {0.25f, -8}, 1.25f}, {0, 0.25, {1, 3}, {-0.6f, 0.8f}}},
		{{{0, 2}, {9, 2}, 0.5f}, {0, 0.5 / 9, {1, 2}, {-1, 0}}},
		{{{0.75f, 2}, {-9, 2}, 0.5f}, {CAROM_NOTHING, 1, {-9, 2}, {0, 0}}},
	};
	carom_snapshot *snapshot = snapshot_of(u_at(0, 0, 0));
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		carom_ray_hit hit;
		carom_error error;
		scenery_check(carom_snapshot_cast_rays(snapshot, 1, &cases[i].ray, &hit, &error), &error);
		check_hit(i, hit, cases[i].wanted);
	}
	carom_snapshot_destroy(snapshot);
}

static void bodies_meet_what_is_known(void **unused)
{
	const struct {
		carom_body_def stands, body;
		carom_vec2 by;
		carom_ray_hit wanted;
	} cases[] = {
		/* into the notch, flush; and on the ends of both arms, of which one counts */
		{u_at(0, 0, 0), scenery_box(0.25f, 8, 0, 0, 1, 1), {0, -16}, {0, 6.5 / 16, {0.25f, 1}, {0, 1}}},
		{u_at(0, 0, 0), scenery_box(0, 8, 0, 0, 3, 1), {0, -16}, {0, 4.5 / 16, {-1.25f, 3}, {0, 1}}},
		/* a U upside down, one of whose arms is in the notch: to the side; and up, out of it */
		{u_at(0, 0, 0), u_at(1.5f, 4.25f, HALF_TURN), {4, 0}, {0, 0.125, {1, 2.125f}, {-1, 0}}},
		{u_at(0, 0, 0), u_at(1.5f, 4.25f, HALF_TURN), {0, 4}, {CAROM_NOTHING, 1, {1.5f, 7}, {0, 0}}},
		/* and down: into the notch of a square without one it doesn't go */
		{scenery_box(0, 0, 0, 0, 2, 2), u_at(2, 6, HALF_TURN), {0, -4}, {0, 0.5, {0.5f, 1}, {0, 1}}},
		/* over a disc, which gets to the bottom of the notch; and a disc, likewise */
		{scenery_circle(0, 0, 0, 0, 0.25f), u_at(0, -6, 0), {0, 10}, {0, 0.475, {0, -0.25f}, {0, -1}}},
		{u_at(0, 0, 0), scenery_circle(0, 8, 0, 0, 0.5f), {0, -16}, {0, 6.5 / 16, {0, 1}, {0, 1}}},
		/* with both arms on the bottom of the room */
		{scenery_circle(9, 9, 0, 0, 0.25f), u_at(0, 0, HALF_TURN), {0, -8}, {CAROM_WALL_BOTTOM, 7.0 / 8, {-1.5f, -10}, {0, 1}}},
		/* it touches where it begins: the arms are not met, either */
		{u_at(0, 0, 0), scenery_box(0, 1.5f, 0, 0, 1, 1), {4, 0}, {CAROM_NOTHING, 1, {4, 1.5f}, {0, 0}}},
	};
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		const carom_vec2 from = cases[i].body.position, to = {from.x + cases[i].by.x, from.y + cases[i].by.y};
		carom_snapshot *snapshot = snapshot_of(cases[i].stands);
		carom_ray_hit hit, wanted = cases[i].wanted;
		carom_error error;
		scenery_check(carom_snapshot_cast_bodies(snapshot, 1, &cases[i].body, &to, &hit, &error), &error);
		if (wanted.other == CAROM_WALL_BOTTOM && hit.point.x > 0)
			wanted.point.x = -wanted.point.x; /* which of the arms is nearer is a matter of rounding */
		check_hit(i, hit, wanted);
		carom_snapshot_destroy(snapshot);
	}
}

static void what_is_touched_is_known(void **unused)
{
	const struct {
		carom_body_def body;
		size_t count;
	} cases[] = {
		/* in the notch, there and just not, and through both arms */
		{scenery_circle(0, 2.25f, 0, 0, 0.99f), 0},
		{scenery_circle(0, 2, 0, 0, 1), 1},
		{scenery_box(0, 1.5f, 0, 0, 1, 1), 1},
		{scenery_box(0, 1.51f, 0, 0, 1, 1), 0},
		{scenery_box(0, 2, 0, 0, 9, 0.5f), 1},
		/* in an arm, around all, and in one another's notches */
		{scenery_box(1.5f, 2, 0, 0, 0.1f, 0.1f), 1},
		{scenery_box(0, 1, 0, 0, 9, 9), 1},
		{u_at(1.5f, 4.25f, HALF_TURN), 0},
		{u_at(1.5f, 3.75f, HALF_TURN), 1},
		{u_at(0, -3.01f, 0), 0},
	};
	const struct {
		carom_vec2 point;
		size_t count;
	} points[] = {{{0, 2}, 0}, {{-1.5f, 2}, 1}, {{0, 1}, 1}, {{0, 0.5f}, 1}, {{1, 1}, 1}, {{-1, 3}, 1}, {{0, 3}, 0}, {{-1.25f, 0.75f}, 1}};
	carom_snapshot *snapshot = snapshot_of(u_at(0, 0, 0));
	carom_error error;
	size_t count;
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		scenery_check(carom_snapshot_find_touching(snapshot, &cases[i].body, NULL, 0, &count, &error), &error);
		if (count != cases[i].count)
			fail_msg("%zu: %zu are touched", i, count);
	}
	for (size_t i = 0; i < COUNT(points); i++) {
		scenery_check(carom_snapshot_find(snapshot, points[i].point, points[i].point, NULL, 0, &count, &error), &error);
		if (count != points[i].count)
			fail_msg("point %zu: in %zu", i, count);
	}
	carom_snapshot_destroy(snapshot);
}

static void what_is_near_is_known(void **unused)
{
	const struct {
		carom_vec2 point;
		carom_nearest wanted;
	} cases[] = {
		{{0.25f, 2.5f}, {0, 0.75, {1, 2.5f}, {-1, 0}}},
		{{0, 1.5f}, {0, 0.5, {0, 1}, {0, 1}}},
		{{0, 9}, {0, sqrt(37), {1, 3}, {-0.16439899f, 0.98639392f}}},
		{{-1.5f, 2}, {0, 0, {-1.5f, 2}, {0, 0}}},
		{{-1.25f, 0.75f}, {0, 0, {-1.25f, 0.75f}, {0, 0}}},
		{{1, 2}, {0, 0, {1, 2}, {0, 0}}},
	};
	carom_snapshot *snapshot = snapshot_of(u_at(0, 0, 0));
	carom_error error;
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		const carom_nearest wanted = cases[i].wanted;
		carom_nearest found;
		scenery_check(carom_snapshot_find_nearest(snapshot, 1, &cases[i].point, INFINITY, &found, &error), &error);
		const double aside_by = hypot(fabs((double)found.point.x) - fabs((double)wanted.point.x), (double)(found.point.y - wanted.point.y));
		const double turned_by = hypot(fabs((double)found.normal.x) - fabs((double)wanted.normal.x), (double)(found.normal.y - wanted.normal.y));
		if (found.body != 0 || !(fabs(found.distance - wanted.distance) < 1e-6) || !(aside_by < 1e-6) || !(turned_by < 1e-6))
			fail_msg("%zu: at %.9g, (%g, %g), normal (%g, %g)", i, found.distance, (double)found.point.x, (double)found.point.y,
				(double)found.normal.x, (double)found.normal.y);
	}
	carom_snapshot_destroy(snapshot);
}

static void overlaps_are_known(void **unused)
{
	const struct {
		const char *what;
		carom_body_def body;
		double overlap;
	} cases[] = {
		{"a disc in the notch", scenery_circle(0, 2.25f, 0, 0, 0.75f), 0},
		{"a disc on its bottom", scenery_circle(0, 1.4f, 0, 0, 0.5f), 0.1},
		{"a disc between the arms", scenery_circle(0, 2.2f, 0, 0, 1.1f), 0.1},
		{"a disc whose centre is in an arm", scenery_circle(1.25f, 2, 0, 0, 0.5f), 0.75},
		{"a disc on a corner", scenery_circle(0.4f, 3.8f, 0, 0, 1.1f), 0.1},
		{"a box on the bottom of the notch", scenery_box(0, 1.4f, 0, 0, 1, 1), 0.1},
		{"a box that just does not touch", scenery_box(0, 2, 0, 0, 1.98f, 1.98f), 0},
		{"a box across both arms", scenery_box(0, 3.9f, 0, 0, 9, 2), 0.1},
		{"a U in the notch", u_at(1.5f, 4.25f, HALF_TURN), 0},
		{"a U in the notch, and in an arm", u_at(2.1f, 4.25f, HALF_TURN), 0.1},
		{"a U in the notch, and in its bottom", u_at(1.5f, 3.9f, HALF_TURN), 0.1},
	};
	(void)unused;
	for (size_t i = 0; i < COUNT(cases); i++) {
		const carom_body_def bodies[] = {u_at(0, 0, 0), cases[i].body};
		for (int turned = 0; turned < 2; turned++) {
			const carom_body_def pair[] = {bodies[turned], bodies[1 - turned]};
			carom_world *world = world_of(pair, 2);
			const double found = runs_measure(world).max_penetration;
			if (!(fabs(found - cases[i].overlap) < 2e-6))
				fail_msg("%s: %.9g instead of %g", cases[i].what, found, cases[i].overlap);
			carom_world_destroy(world);
		}
	}
}

/* Its pieces overlap. */
static void one_alone_overlaps_nothing(void **unused)
{
	const carom_body_def u = u_at(0, 0, 0.3f);
	carom_world *world = world_of(&u, 1);
	(void)unused;
	assert_true(runs_measure(world).max_penetration == 0);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(rays_meet_what_is_known), cmocka_unit_test(bodies_meet_what_is_known),
		cmocka_unit_test(what_is_touched_is_known), cmocka_unit_test(what_is_near_is_known), cmocka_unit_test(overlaps_are_known),
		cmocka_unit_test(one_alone_overlaps_nothing)};
	return cmocka_run_group_tests_name("snapshot_hollows", tests, NULL, NULL);
}
