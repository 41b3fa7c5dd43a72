/* Hits that pass on at once through what lies or falls together, of the step contacts. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "runs.h"
#include "wild.h"

/* A ball of a thousand times the mass falls on one that lies on the ground: between the two that one would be hit without end. It is let go after a few hits, which
 * give the heavy one no more than its restitution would. */
static void what_is_squeezed_is_let_go(void **unused)
{
	enum { STEPS = 6 };
	(void)unused;
	for (int light = 1; light <= 3; light++) { /* one upon the other */
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting("contacts", 5.0f, 40.0f);
			carom_body_def bodies[4];
			for (int k = 0; k <= light; k++)
				bodies[k] = scenery_circle(0.0f, 0.5f + 1.0005f * (float)k, 0.0f, 0.0f, 0.5f);
			bodies[light].position.y += 0.05f;
			bodies[light].velocity.y = -2.0f;
			bodies[light].density = 1000.0f;
			carom_world *world = runs_world(&def, device, bodies, (size_t)light + 1);
			if (!world)
				continue;
			float fastest = 0.0f;
			uint64_t hits = 0;
			for (int step = 0; step < STEPS; step++) {
				hits += runs_step(world, 1).hits;
				fastest = fmaxf(fastest, runs_state(world, (uint32_t)light).velocity.y);
			}
			if (device == scenery_devices)
				print_message("%d between: %llu hits, up at %.3g m/s\n", light, (unsigned long long)hits, (double)fastest);
			assert_true(hits < 600 * (uint64_t)light);
			assert_true(fastest < 0.3f * 2.3f);
			runs_near(runs_measure(world).max_penetration, 0.0, 1e-5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Bodies that fall in a heap: every hit is a push, with no more friction than its law allows; no step adds energy, and nothing sinks in. The hits are the same everywhere. */
static void shocks_push_and_rub(void **unused)
{
	enum { SIDE = 6, COUNT = SIDE * SIDE };
	static const float coefficients[] = {0.0f, 0.5f};
	(void)unused;
	for (int i = 0; i < 4; i++) {
		const float friction = coefficients[i % 2];
		carom_hit *expected = NULL;
		size_t expected_count = 0, ruled = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting("contacts", 3.6f, 40.0f);
			carom_body_def bodies[COUNT];
			scenery_random random = {(uint64_t)i + 7};
			size_t count;
			def.friction = friction;
			def.keep_hits = true;
			for (int k = 0; k < COUNT; k++) {
				bodies[k] = scenery_circle(1.15f * ((float)(k % SIDE) - 2.5f), 0.6f + 1.2f * (float)(k / SIDE), 0.0f, -3.0f, 0.5f); /* NOLINT: rows */
				if (i < 2) {
					bodies[k].shape = CAROM_REGULAR;
					bodies[k].sides = 4;
					bodies[k].angle = scenery_uniform(&random, 0.0f, 1.5f);
				}
			}
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			const carom_report report = runs_advance(world, 0.6);
			const carom_measure after = runs_measure(world);
			carom_hit *hits = runs_hits(world, &count);
			assert_int_equal(count, report.hits);
			for (size_t k = 0; k < count; k++) {
				const carom_hit *hit = &hits[k];
				const float push = hit->impulse.x * hit->normal.x + hit->impulse.y * hit->normal.y;
				const float rub = hit->impulse.y * hit->normal.x - hit->impulse.x * hit->normal.y;
				assert_true(push > 0.0f);
				assert_true(fabsf(rub) <= friction * push * 1.0001f + 1e-6f * push);
				ruled += hit->is_ruled;
			}
			assert_true(after.kinetic_energy + after.potential_energy < before.kinetic_energy + before.potential_energy);
			runs_near(after.max_penetration, 0.0, 1e-5);
			if (!expected) {
				print_message("%zu hits, %zu by rules\n", count, ruled);
				assert_true(ruled > count / 4);
			}
			runs_same_hits(&expected, &expected_count, hits, count);
			carom_world_destroy(world);
		}
		free(expected);
	}
}

/* Squares fall upon each other at odd angles, and touch several at corners: shocks get to bodies by several ways, and to pairs of which one alone has points for them. */
static void shocks_in_a_heap_are_the_same_everywhere(void **unused)
{
	enum { SIDE = 7, SQUARES = SIDE * SIDE };
	(void)unused;
	for (uint64_t seed = 26; seed <= 29; seed++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const carom_world_def def = runs_resting("contacts", 0.55f * SIDE, 1.2f * SIDE);
			const carom_body_def square = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.707f, 0.707f);
			scenery_random random = {seed};
			carom_body_def bodies[SQUARES];
			for (int k = 0; k < SQUARES; k++) {
				bodies[k] = square;
				bodies[k].position = (carom_vec2){1.05f * (float)(k % SIDE - SIDE / 2), 0.6f + 1.05f * (float)(k / SIDE)};
				bodies[k].angle = scenery_uniform(&random, -3.0f, 3.0f);
				bodies[k].velocity = (carom_vec2){scenery_uniform(&random, -1.0f, 1.0f), scenery_uniform(&random, -1.0f, 1.0f)};
			}
			carom_world *world = runs_world(&def, device, bodies, SQUARES);
			if (!world)
				continue;
			runs_step(world, runs_affordable(150));
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Motors and forces press light bodies between heavy ones, some of which are kinematic, and are steered. A crowd parted with what such a press makes of a speed in a step, and the next step had to hold that back with
 * more: the last of these worlds came to 10^9 J, the second to 10^7. In the third two shocks begin anew, for friction gained by them. */
static void a_crowd_gets_no_energy_from_what_holds_it_back(void **unused)
{
	static const uint64_t seeds[] = {4, 10, 22, 26, 67};
	static wild_world wild;
	(void)unused;
	for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
		const uint32_t often = 40 + (uint32_t)seeds[i] % 20, steps = (uint32_t)runs_affordable(400);
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_error error;
			wild_make(seeds[i], &wild);
			scenery_check(carom_pipeline_set(&wild.def.pipeline, "step", "contacts", &error), &error);
			wild.def.gravity.y = -10.0f;
			wild.def.restitution = 0.25f * (float)(seeds[i] % 3);
			wild.def.friction = 0.5f;
			carom_world *world = wild_create(&wild, device);
			double most = 0.0;
			if (!world)
				continue;
			for (uint32_t step = 0; step < steps; step++) {
				if (step % often == often - 1)
					wild_change(world, step / often, wild.def.time_step);
				runs_step(world, 1);
				most = fmax(most, runs_measure(world).kinetic_energy);
			}
			if (device == scenery_devices)
				print_message("world %d: %.3g J at most\n", (int)seeds[i], most);
			assert_true(most < 3e4);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_squeezed_is_let_go), cmocka_unit_test(shocks_push_and_rub),
		cmocka_unit_test(shocks_in_a_heap_are_the_same_everywhere), cmocka_unit_test(a_crowd_gets_no_energy_from_what_holds_it_back)};
	return cmocka_run_group_tests_name("shocks", tests, NULL, NULL);
}
