/* Crowds in which most bodies are not convex: at high speed nothing gets into anything, and energy and momentum stay; and the bits are the same on every device, with any number of
 * threads, when a run stops and goes on, and whatever is added, removed and steered meanwhile.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "concave.h"
#include "runs.h"
#include "wild.h"

enum { COUNT = 60 };

/* ---- What is kept */

static void nobody_leaves(carom_world *world, float half)
{
	for (uint32_t i = 0; i < COUNT; i++) {
		const carom_body_state state = runs_state(world, i);
		assert_true(fabsf(state.position.x) < half && fabsf(state.position.y) < half);
	}
}

/* At up to 100 m/s: many times their size in a step. */
static void wild_gas_keeps_its_energy(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_room(5.2f, 5.2f);
		carom_body_def bodies[COUNT];
		scenery_random random = {71};
		uint64_t hits = 0;
		concave_bodies(&random, COUNT, 1.2f, 100.0f, bodies);
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		const double energy = runs_measure(world).kinetic_energy;
		for (uint64_t i = 0; i < runs_affordable(100); i++) {
			hits += runs_step(world, 1).hits;
			if (i % 8 == 0 || device == scenery_devices)
				assert_true(concave_overlap(world, 3e-5) <= 3e-5);
		}
		nobody_leaves(world, 5.2f);
		print_message("%llu hits, energy %.3g\n", (unsigned long long)hits, runs_measure(world).kinetic_energy / energy - 1.0);
		runs_enough(hits > 3000);
		runs_near(runs_measure(world).kinetic_energy / energy, 1.0, 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Towards each other, without walls and what is static. */
static void what_flies_together_keeps_its_momentum(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = runs_def();
		carom_body_def bodies[COUNT];
		scenery_random random = {72};
		uint64_t hits = 0;
		concave_bodies(&random, COUNT, 1.2f, 10.0f, bodies);
		for (int i = 0; i < COUNT; i++) {
			bodies[i].is_static = false;
			bodies[i].velocity.x -= 10.0f * bodies[i].position.x;
			bodies[i].velocity.y -= 10.0f * bodies[i].position.y;
		}
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		const carom_measure begun = runs_measure(world);
		const double size = sqrt(begun.kinetic_energy * COUNT); /* kg m/s, about */
		for (uint64_t i = 0; i < runs_affordable(60); i++) {
			hits += runs_step(world, 1).hits;
			assert_true(concave_overlap(world, 3e-5) <= 3e-5);
		}
		const carom_measure ended = runs_measure(world);
		print_message("%llu hits, energy %.3g, momentum %.3g %.3g\n", (unsigned long long)hits, ended.kinetic_energy / begun.kinetic_energy - 1.0,
			(ended.momentum_x - begun.momentum_x) / size, (ended.momentum_y - begun.momentum_y) / size);
		runs_enough(hits > 200);
		runs_near(ended.kinetic_energy / begun.kinetic_energy, 1.0, 1e-5);
		runs_near(ended.momentum_x / size, begun.momentum_x / size, 1e-5);
		runs_near(ended.momentum_y / size, begun.momentum_y / size, 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- Bits */

/* They fall, rub, and are driven. */
static carom_world *crowd(const scenery_device *device, const char *step, uint32_t threads)
{
	carom_world_def def = runs_room(5.2f, 5.2f);
	carom_body_def bodies[COUNT];
	scenery_random random = {73};
	concave_bodies(&random, COUNT, 1.2f, 6.0f, bodies);
	scenery_drive(&random, COUNT, 2.0f, bodies);
	def.gravity.y = -RUNS_GRAVITY;
	def.restitution = 0.4f;
	def.friction = 0.3f;
	def.threads = threads;
	def.pipeline.step = step;
	return runs_world(&def, device, bodies, COUNT);
}

/* One made from what the world is now, which ends. */
static carom_world *resumed(carom_world *world, const scenery_device *device)
{
	carom_scene *scene;
	carom_world *twin;
	carom_error error;
	char *text;
	size_t length;
	scenery_check(carom_scene_text_create(world, NULL, &text, &length, &error), &error);
	scenery_check(carom_scene_parse(text, length, NULL, &scene, &error), &error);
	carom_scene_text_destroy(text);
	carom_world_destroy(world);
	scene->world.device = device->name;
	scene->world.storage = device->storage;
	scenery_check(carom_scene_create_world(scene, &twin, &error), &error);
	carom_scene_destroy(scene);
	return twin;
}

static void all_ways_give_the_same_bits(void **unused)
{
	static const char *const steps[] = {"events", "contacts"};
	(void)unused;
	for (int s = 0; s < 2; s++) {
		const uint64_t half = runs_affordable(30);
		uint64_t first = 0;
		for (uint32_t threads = 1; threads <= 3; threads++)
			runs_same_hash(&first, runs_hash_after(crowd(&scenery_devices[0], steps[s], threads), 2 * half, threads), &scenery_devices[0]);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = crowd(device, steps[s], 0);
			if (!world)
				continue;
			runs_same_hash(&first, runs_hash_after(world, 2 * half, 1), device);
			world = crowd(device, steps[s], 0);
			runs_step(world, half);
			runs_same_hash(&first, runs_hash_after(resumed(world, device), half, 1), device);
		}
	}
}

/* Bodies are steered, go and come, and are joined; and some are moved elsewhere, and turned. */
static uint64_t changed(carom_world *world, bool anew)
{
	for (uint32_t i = 0; i < runs_affordable(36); i++) {
		wild_change(world, i, 1.0f / 60.0f);
		if (i % 9 == 4) {
			const uint32_t index = 13 * i % COUNT;
			carom_body_state state = runs_state(world, index);
			carom_error error;
			state.angle += 1.5f;
			state.position.x *= 0.5f;
			scenery_check(carom_world_set_states(world, index, 1, &state, &error), &error);
		}
		if (anew)
			runs_load_anew(world);
		runs_step(world, 1);
	}
	return runs_hash_after(world, 1, 1);
}

static void changes_give_the_same_bits(void **unused)
{
	static const char *const steps[] = {"events", "contacts"};
	(void)unused;
	for (int s = 0; s < 2; s++) {
		uint64_t first = 0;
		runs_same_hash(&first, changed(crowd(&scenery_devices[0], steps[s], 2), true), &scenery_devices[0]);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = crowd(device, steps[s], 3);
			if (world)
				runs_same_hash(&first, changed(world, false), device);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(wild_gas_keeps_its_energy), cmocka_unit_test(what_flies_together_keeps_its_momentum),
		cmocka_unit_test(all_ways_give_the_same_bits), cmocka_unit_test(changes_give_the_same_bits)};
	return cmocka_run_group_tests_name("concave_bits", tests, NULL, NULL);
}
