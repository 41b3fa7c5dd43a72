/* Polygons that are not convex, by the step contacts: what stands on legs, hangs in hooks or lies in notches comes to rest, and what bears it is known by hand. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "concave.h"
#include "layout.h"
#include "runs.h"

/* How near bodies of some metres come that rest on each other. */
#define NEAR ((double)CUSHION * (double)SLOP * 12.0)

enum { SETTLES = 240, LIES = 60 };

static carom_body_def fixed(carom_body_def def)
{
	def.is_static = true;
	return def;
}

static carom_world_def resting_def(float friction)
{
	carom_world_def def = runs_resting("contacts", 6.0f, 12.0f);
	def.friction = friction;
	def.restitution = 0.0f;
	return def;
}

/* What `other` bears of `body`: the forces at the first and the last of all points, and their sum. */
typedef struct bearing {
	double left, right, sum;
	size_t contacts;
} bearing;

static bearing bearing_of(carom_world *world, uint32_t body, int32_t other)
{
	bearing b = {0};
	size_t count;
	carom_error error;
	scenery_check(carom_world_contact_count(world, &count, &error), &error);
	carom_contact *all = calloc(count + 1, sizeof *all);
	assert_non_null(all);
	scenery_check(carom_world_get_contacts(world, 0, count, all, &error), &error);
	for (size_t k = 0; k < count; k++) {
		if (all[k].body != body || all[k].other != other)
			continue;
		if (b.contacts++ == 0)
			b.left = (double)all[k].normal[0];
		b.right = (double)all[k].normal[1];
		b.sum += (double)all[k].normal[0] + (double)all[k].normal[1];
	}
	free(all);
	return b;
}

static double weight_of(carom_world *world, uint32_t body)
{
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, body, &info, &error), &error);
	return (double)info.mass * (double)RUNS_GRAVITY;
}

/* Until all lies; then nothing changes any more, to the bit. */
static void lies_still(carom_world *world, const scenery_device *device, uint64_t *first)
{
	runs_step(world, runs_affordable(SETTLES));
	const uint64_t before = runs_hash(world);
	const carom_report report = runs_step(world, runs_affordable(LIES));
	runs_enough(report.hits == 0);
	runs_enough(runs_hash(world) == before);
	runs_same_hash(first, before, device);
	assert_true(concave_overlap(world, 1e-4) <= 1e-4);
}

/* ---- On two legs */

static const carom_vec2 table[8] = {{-2, 3.5f}, {-2, 0.5f}, {-1.5f, 0.5f}, {-1.5f, 3}, {1.5f, 3}, {1.5f, 0.5f}, {2, 0.5f}, {2, 3.5f}};

/* Upon the floor, or a static box: each leg bears half of the weight, and of what stands in the middle; and more of what stands aside. */
static void table_stands(const scenery_device *device, bool on_floor, double aside, uint64_t *first)
{
	const carom_world_def def = resting_def(0.5f);
	carom_body_def bodies[3] = {
		fixed(scenery_box(0.0f, 0.25f, 0.0f, 0.0f, 8.0f, 0.5f)), concave_outline(table, 8), scenery_box((float)aside, 4.1f, 0.0f, 0.0f, 1.0f, 1.0f)};
	if (on_floor)
		bodies[0].position.y = 10.0f, bodies[1].position.y -= 0.45f, bodies[2].position.y -= 0.45f;
	carom_world *world = runs_world(&def, device, bodies, 3);
	if (!world)
		return;
	lies_still(world, device, first);
	const bearing of_table = bearing_of(world, 1, on_floor ? CAROM_WALL_BOTTOM : 0), of_box = bearing_of(world, 2, 1);
	const double table_weight = weight_of(world, 1), box_weight = weight_of(world, 2);
	runs_enough(of_table.contacts == 1 && of_box.contacts == 1);
	if (runs_affordable(10) == 10) {
		runs_near(of_box.sum / box_weight, 1.0, 1e-2);
		runs_near(of_table.sum / (table_weight + box_weight), 1.0, 2e-2);
		runs_near(of_table.right / of_table.sum, 0.5 + 0.25 * aside * box_weight / (table_weight + box_weight), 1e-2);
	}
	runs_near((double)runs_state(world, 1).angle, 0.0, 1e-4);
	carom_world_destroy(world);
}

static void tables_stand_on_two_legs(void **unused)
{
	(void)unused;
	for (int on_floor = 0; on_floor < 2; on_floor++) {
		for (int aside = 0; aside < 2; aside++) {
			uint64_t first = 0;
			SCENERY_EACH_DEVICE(device)
				table_stands(device, on_floor, aside ? 1.0 : 0.0, &first);
		}
	}
}

/* ---- Arches, hooks, bolts */

/* Astride a beam: it hangs by the middle of its ceiling, or stands there, and its legs reach down on both sides of it. */
static void arch_hangs_on_a_beam(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = resting_def(0.5f);
		carom_body_def bodies[3] = {
			fixed(scenery_box(0.0f, 2.75f, 0.0f, 0.0f, 1.0f, 0.5f)), concave_outline(table, 8), scenery_circle(0.0f, 4.05f, 0.0f, 0.0f, 0.5f)};
		bodies[1].position.y += 0.01f;
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		lies_still(world, device, &first);
		const double load = weight_of(world, 1) + weight_of(world, 2);
		const bearing b = bearing_of(world, 1, 0);
		if (runs_affordable(10) == 10) {
			runs_near(b.sum / load, 1.0, 1e-2);
			runs_near(b.left / b.sum, 0.5, 1e-2);
			runs_near(bearing_of(world, 2, 1).sum / weight_of(world, 2), 1.0, 1e-2);
		}
		carom_world_destroy(world);
	}
}

/* Walls 0.5 thick, and a mouth below, 0.6 wide. */
static const carom_vec2 cave[12] = {
	{2, 4}, {2, 8}, {-2, 8}, {-2, 4}, {-0.3f, 4}, {-0.3f, 4.5f}, {-1.5f, 4.5f}, {-1.5f, 7.5f}, {1.5f, 7.5f}, {1.5f, 4.5f}, {0.3f, 4.5f}, {0.3f, 4}};
static const carom_vec2 bolt[8] = {{-1, 5}, {-0.25f, 5}, {-0.25f, 2}, {0.25f, 2}, {0.25f, 5}, {1, 5}, {1, 5.5f}, {-1, 5.5f}};

/* A T hangs by its head in a slot, each side of which bears half of it, and of what draws at it. */
static void bolt_hangs_in_a_slot(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = resting_def(0.3f);
		carom_body_def bodies[2] = {fixed(concave_outline(cave, 12)), concave_outline(bolt, 8)};
		bodies[1].position.y -= 0.49f;
		bodies[1].force.y = -30.0f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		lies_still(world, device, &first);
		const bearing b = bearing_of(world, 1, 0);
		runs_near((double)runs_state(world, 1).position.y, (double)bodies[1].position.y - 0.01, NEAR);
		if (runs_affordable(10) == 10) {
			runs_near(b.sum / (weight_of(world, 1) + 30.0), 1.0, 1e-2);
			runs_near(b.left / b.sum, 0.5, 1e-2);
		}
		carom_world_destroy(world);
	}
}

/* Two hooks, one in the other: what is drawn down by its own weight and more stays where it is. */
static void hook_hangs_in_a_hook(void **unused)
{
	static const carom_vec2 upper[8] = {{-0.25f, 8}, {-0.25f, 4}, {1.25f, 4}, {1.25f, 5}, {0.75f, 5}, {0.75f, 4.5f}, {0.25f, 4.5f}, {0.25f, 8}};
	static const carom_vec2 lower[8] = {{1.7f, 1}, {1.7f, 5.5f}, {0.4f, 5.5f}, {0.4f, 4.6f}, {0.7f, 4.6f}, {0.7f, 5.1f}, {1.3f, 5.1f}, {1.3f, 1}};
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = resting_def(0.6f);
		carom_body_def bodies[2] = {fixed(concave_outline(upper, 8)), concave_outline(lower, 8)};
		bodies[1].force.y = -10.0f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		for (uint64_t i = 0; i < runs_affordable(600); i++) {
			runs_step(world, 1);
			assert_true(runs_state(world, 1).position.y > 2.0f);
			assert_true(concave_overlap(world, 1e-4) <= 1e-4);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- In a notch */

static const carom_vec2 notched[5] = {{-3, 0.5f}, {3, 0.5f}, {3, 4}, {0, 1}, {-3, 4}};

/* A box on a corner, in a notch that it fits in: without friction each side bears it by its normal. Turned, the notch bears it by one side and holds it by the other. */
static void box_lies_in_a_notch(void **unused)
{
	(void)unused;
	for (int rubs = 0; rubs < 2; rubs++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const carom_world_def def = resting_def(rubs ? 0.5f : 0.0f);
			carom_body_def bodies[2] = {fixed(concave_outline(notched, 5)), scenery_box(0.0f, 1.0f + sqrtf(0.5f) + 0.02f, 0.0f, 0.0f, 1.0f, 1.0f)};
			bodies[1].angle = 0.78539816f;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			if (rubs) {
				lies_still(world, device, &first);
			} else {
				runs_step(world, runs_affordable(SETTLES));
				runs_same_hash(&first, runs_hash(world), device);
			}
			const bearing b = bearing_of(world, 1, 0);
			runs_near((double)runs_state(world, 1).position.y, 1.0 + sqrt(0.5), 2.0 * NEAR);
			runs_enough(b.contacts == 2);
			if (!rubs && runs_affordable(10) == 10)
				runs_near(b.sum / weight_of(world, 1), sqrt(2.0), 1e-2);
			carom_world_destroy(world);
		}
	}
}

/* Of all kinds, on each other: the heap comes to rest, and nothing is in anything. */
static void heap_lies(void **unused)
{
	enum { COUNT = 24 };
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 2.2f, 12.0f);
		carom_body_def bodies[COUNT];
		def.friction = 0.4f;
		for (int i = 0; i < COUNT; i++) {
			bodies[i] = concave_body((concave_kind)(i % CONCAVE_KINDS), i % CONCAVE_SIZES);
			bodies[i].position = (carom_vec2){1.05f * (float)(i % 4) - 1.6f, 0.6f + 1.05f * (float)(i / 4)};
			bodies[i].angle = (float)i;
		}
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		runs_step(world, runs_affordable(600));
		const carom_report report = runs_step(world, runs_affordable(60));
		const double energy = runs_measure(world).kinetic_energy, deep = concave_overlap(world, 1e-4);
		print_message("%llu hits in a second, %.3g J, %.2g m deep\n", (unsigned long long)report.hits, energy, deep);
		runs_enough(energy < 1e-3);
		assert_true(deep <= 1e-4);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(tables_stand_on_two_legs), cmocka_unit_test(arch_hangs_on_a_beam),
		cmocka_unit_test(bolt_hangs_in_a_slot), cmocka_unit_test(hook_hangs_in_a_hook), cmocka_unit_test(box_lies_in_a_notch),
		cmocka_unit_test(heap_lies)};
	return cmocka_run_group_tests_name("concave_rest", tests, NULL, NULL);
}
