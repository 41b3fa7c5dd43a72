/* Filters: bodies that pass through each other do so as if the other was not there, by every step, on every device. (Against the serial queue they are in
 * test_events.)
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runs.h"

static const char *const steps[] = {"first_impact", "events", "contacts"};
enum { STEPS = 3, MOST = 128 };

static carom_body_def of(carom_body_def def, uint32_t categories, uint32_t mask)
{
	def.mass = 1.0f;
	def.categories = categories;
	def.mask = mask;
	return def;
}

static carom_world *world_of(const char *step, const scenery_device *device, const carom_body_def *bodies, size_t count)
{
	carom_world_def def = runs_room(6, 6);
	def.pipeline.step = step;
	return runs_world(&def, device, bodies, count);
}

/* Pairs that come at each other, each in a lane of its own. */
static const struct {
	uint32_t categories[2], mask[2];
	bool meet;
} lanes[] = {
	{{1, 1}, {CAROM_MASK, CAROM_MASK}, true},
	{{1, 2}, {2, 1}, true},
	{{1, 2}, {CAROM_MASK, 2}, false}, /* the first would hit the second, but not the other way round */
	{{1, 2}, {1, CAROM_MASK}, false},
	{{6, 12}, {8, 2}, true},
	{{6, 12}, {8, 1}, false},
	{{1u << 31, 1u << 30}, {1u << 30, 1u << 31}, true},
	{{1u << 31, 1}, {1, 0x7FFFFFFF}, false},
	{{0, 1}, {CAROM_MASK, CAROM_MASK}, false}, /* of no category */
	{{1, 1}, {CAROM_MASK, 0}, false},
};
enum { LANES = sizeof lanes / sizeof *lanes };

static void check_lanes(const char *step, bool boxes, const scenery_device *device)
{
	carom_body_def bodies[2 * LANES];
	uint64_t hits = 0;
	for (size_t i = 0; i < LANES; i++) {
		const float y = 1.1f * (float)i - 5;
		bodies[2 * i] = of(scenery_circle(-2, y, 4, 0, 0.5f), lanes[i].categories[0], lanes[i].mask[0]);
		bodies[2 * i + 1] = of(scenery_circle(2, y, -4, 0, 0.5f), lanes[i].categories[1], lanes[i].mask[1]);
		if (boxes) {
			bodies[2 * i + 1].shape = CAROM_REGULAR;
			bodies[2 * i + 1].sides = 4;
		}
		hits += lanes[i].meet;
	}
	carom_world *world = world_of(step, device, bodies, 2 * LANES);
	if (!world)
		return;
	assert_int_equal(runs_advance(world, 0.8).hits, hits);
	for (uint32_t i = 0; i < LANES; i++) {
		runs_near((double)runs_state(world, 2 * i).position.x, lanes[i].meet ? -2.2 : 1.2, 1e-5);
		runs_near((double)runs_state(world, 2 * i + 1).position.x, lanes[i].meet ? 2.2 : -1.2, 1e-5);
	}
	carom_world_destroy(world);
}

static void each_must_hit_the_other(void **unused)
{
	(void)unused;
	for (int k = 0; k < 2 * STEPS; k++)
		SCENERY_EACH_DEVICE(device)
			check_lanes(steps[k / 2], k % 2, device);
}

/* Bodies of two kinds in one place. */
static void make_kinds(carom_body_def *first, carom_body_def *second, size_t count, uint64_t seed)
{
	scenery_random random = {seed};
	scenery_bodies(&random, SCENERY_MIXED, count, 1.2f, 4.0f, first);
	scenery_bodies(&random, SCENERY_MIXED, count, 1.2f, 4.0f, second);
	for (size_t i = 0; i < count; i++) {
		first[i] = of(first[i], 1, 1 | 4);
		second[i] = of(second[i], 2, 2);
	}
}

/* By events and, as long as little has been hit, by first_impact, whose steps end at every hit. */
static void a_crowd_does_not_feel_another(void **unused)
{
	enum { COUNT = MOST / 2 };
	(void)unused;
	for (int k = 0; k < 2; k++) {
		SCENERY_EACH_DEVICE(device) {
			carom_body_def all[MOST];
			make_kinds(all, all + COUNT, COUNT, 5);
			const double seconds = k ? (double)runs_affordable(100) / 60.0 : 0.15, exact = k ? 0.0 : 1e-5;
			carom_world *both = world_of(steps[k], device, all, MOST);
			if (!both)
				continue;
			uint64_t hits = runs_advance(both, seconds).hits;
			runs_enough(hits > (k ? 100 : 5));
			for (uint32_t kind = 0; kind < 2; kind++) {
				carom_world *alone = world_of(steps[k], device, all + kind * COUNT, COUNT);
				hits -= runs_advance(alone, seconds).hits;
				for (uint32_t i = 0; i < COUNT; i++) {
					const carom_body_state found = runs_state(both, kind * COUNT + i), expected = runs_state(alone, i);
					runs_near((double)found.position.x, (double)expected.position.x, exact);
					runs_near((double)found.position.y, (double)expected.position.y, exact);
					runs_near((double)found.angle, (double)expected.angle, 10 * exact);
				}
				carom_world_destroy(alone);
			}
			assert_int_equal(hits, 0);
			assert_true(runs_measure(both).max_penetration < 1e-4);
			carom_world_destroy(both);
		}
	}
}

/* Two piles in one place, each on a floor of its own, the second's below the first's: neither rests on what is not there for it. */
static void piles_stand_in_each_other(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 6, 12);
		def.friction = 0.5f;
		carom_body_def bodies[8];
		for (uint32_t kind = 0; kind < 2; kind++) {
			const uint32_t bit = 1u << (3 + kind);
			const float floor = kind ? 0.5f : 0.9f;
			carom_body_def *own = bodies + 4 * kind;
			own[0] = of(scenery_box(0, floor - 0.1f, 0, 0, 8, 0.2f), bit, bit);
			own[0].is_static = true;
			for (int k = 1; k < 4; k++)
				own[k] = of(scenery_box(0.1f * (float)kind, floor + (float)k - 0.5f, 0, 0, 1, 1), bit, bit);
		}
		carom_world *world = runs_world(&def, device, bodies, 8);
		if (!world)
			continue;
		runs_step(world, 120);
		for (uint32_t i = 0; i < 8; i++)
			runs_near((double)runs_state(world, i).position.y, (double)bodies[i].position.y, 0.01);
		assert_int_equal(runs_step(world, 1).hits, 0);
		assert_true(runs_measure(world).max_penetration < 1e-4);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- What changes */

static void set(carom_world *world, uint32_t index, uint32_t categories, uint32_t mask)
{
	carom_error error;
	carom_body_info info;
	scenery_check(carom_world_set_filter(world, index, categories, mask, &error), &error);
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	assert_true(info.categories == categories && info.mask == mask);
}

/* A ball that lies on a shelf falls through it, to the floor, from when the shelf is not for it; and once it is again, it stays below. */
static void a_filter_may_change(void **unused)
{
	(void)unused;
	for (int k = 0; k < 2; k++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const carom_world_def def = runs_resting(steps[1 + k], 6, 12);
			carom_body_def bodies[3] = {scenery_box(0, 4, 0, 0, 4, 0.5f), scenery_circle(-1, 4.75f, 0, 0, 0.5f), scenery_box(1, 4.75f, 0, 0, 1, 1)};
			bodies[0].is_static = true;
			carom_world *world = runs_world(&def, device, bodies, 3);
			if (!world)
				continue;
			runs_step(world, 30);
			runs_near((double)runs_state(world, 1).position.y, 4.75, 0.01);
			set(world, 1, 2, CAROM_MASK);
			runs_step(world, 1);
			runs_near((double)runs_state(world, 1).position.y, 4.75, 0.01); /* it is of another category, but the shelf still hits that */
			set(world, 0, 1, 1);
			runs_step(world, 120);
			runs_near((double)runs_state(world, 1).position.y, 0.5, 0.01);
			runs_near((double)runs_state(world, 2).position.y, 4.75, 0.01);
			set(world, 0, 1, CAROM_MASK);
			const carom_body_state up = {{-1, 2}, 0, {0, 12}, 0};
			carom_error error;
			scenery_check(carom_world_set_states(world, 1, 1, &up, &error), &error);
			runs_step(world, 60);
			assert_true(runs_state(world, 1).position.y < 3.5f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Filters go with their bodies, where indices become others, and where the textures become larger. */
static void filters_go_with_their_bodies(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		enum { COUNT = 20 };
		carom_body_def all[MOST];
		uint32_t odd[COUNT / 2];
		carom_error error;
		make_kinds(all, all + COUNT / 2, COUNT / 2, 6);
		for (uint32_t i = 0; i < COUNT / 2; i++)
			odd[i] = 2 * i + 1;
		carom_world *world = world_of("events", device, all, 4);
		if (!world)
			continue;
		runs_step(world, 1);
		scenery_check(carom_world_remove(world, (const uint32_t[4]){0, 1, 2, 3}, 4, &error), &error);
		scenery_check(carom_world_add(world, all, COUNT, NULL, &error), &error);
		scenery_check(carom_world_remove(world, odd, COUNT / 2, &error), &error);
		carom_body_def even[COUNT / 2];
		for (size_t i = 0; i < COUNT / 2; i++)
			even[i] = all[2 * i];
		carom_world *other = world_of("events", device, even, COUNT / 2);
		assert_true(runs_step(world, 100).hits == runs_step(other, 100).hits);
		assert_true(runs_hash(world) == runs_hash(other));
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* Of whatever categories bodies are, as long as all hit all. */
static void what_all_hit_changes_no_bit(void **unused)
{
	(void)unused;
	for (int k = 0; k < STEPS; k++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			for (int kind = 0; kind < 3; kind++) {
				carom_body_def bodies[MOST];
				scenery_random random = {9};
				scenery_bodies(&random, SCENERY_MIXED, 64, 1.2f, 4.0f, bodies);
				for (uint32_t i = 0; i < 64; i++) {
					const uint32_t two = 7u & ~(1u << i % 3); /* of three: any two bodies have one in common, but all together have none */
					const uint32_t categories[3] = {CAROM_CATEGORIES, 1u << i % 32 | 1u << (i + 1) % 32, two};
					bodies[i] = of(bodies[i], categories[kind], kind == 2 ? two : CAROM_MASK);
				}
				carom_world *world = world_of(steps[k], device, bodies, 64);
				if (world)
					runs_same_hash(&first, runs_hash_after(world, runs_affordable(60), 1), device);
			}
		}
	}
}

/* ---- Queries */

static void snapshots_may_leave_bodies_out(void **unused)
{
	(void)unused;
	const carom_body_def bodies[3] = {of(scenery_circle(-2, 0, 0, 0, 0.5f), 1, CAROM_MASK), of(scenery_box(0, 0, 0, 0, 1, 1), 2, 0),
		of(scenery_circle(3, 0, 0, 0, 0.5f), 0, CAROM_MASK)};
	static const struct {
		uint32_t mask, found;
		int32_t met, near;
	} cases[] = {{CAROM_MASK, 3, 0, 2}, {1, 1, 0, 0}, {2, 1, 1, 1}, {3, 2, 0, 1}, {4, 0, CAROM_WALL_RIGHT, CAROM_NOTHING},
		{0, 0, CAROM_WALL_RIGHT, CAROM_NOTHING}};
	carom_world *world = world_of("events", &scenery_devices[0], bodies, 3);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const carom_ray ray = {{-5, 0.25f}, {7, 0.25f}, 0};
		const carom_vec2 point = {4, 0};
		carom_snapshot *snapshot;
		carom_ray_hit hit;
		carom_nearest nearest;
		carom_error error;
		size_t found;
		scenery_check(carom_snapshot_create_masked(world, cases[i].mask, &snapshot, &error), &error);
		scenery_check(carom_snapshot_cast_rays(snapshot, 1, &ray, &hit, &error), &error);
		scenery_check(carom_snapshot_find(snapshot, (carom_vec2){-6, -6}, (carom_vec2){6, 6}, NULL, 0, &found, &error), &error);
		scenery_check(carom_snapshot_find_nearest(snapshot, 1, &point, INFINITY, &nearest, &error), &error);
		assert_int_equal(found, cases[i].found);
		assert_int_equal(hit.other, cases[i].met);
		assert_int_equal(nearest.body, cases[i].near);
		carom_snapshot_destroy(snapshot);
	}
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(each_must_hit_the_other), cmocka_unit_test(a_crowd_does_not_feel_another),
		cmocka_unit_test(piles_stand_in_each_other), cmocka_unit_test(a_filter_may_change), cmocka_unit_test(filters_go_with_their_bodies),
		cmocka_unit_test(what_all_hit_changes_no_bit), cmocka_unit_test(snapshots_may_leave_bodies_out)};
	return cmocka_run_group_tests_name("filters", tests, NULL, NULL);
}
