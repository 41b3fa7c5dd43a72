/* Keeping hits: the same on every device, however a run is cut; none is lost; and when there are any.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "runs.h"

enum { MOST_BODIES = 120 };

/* ---- The same bits */

/* Those of so many calls, one after the other. */
static carom_hit *collect(carom_world *world, uint64_t steps, uint64_t calls, size_t *count)
{
	carom_hit *all = NULL;
	*count = 0;
	for (uint64_t i = 0; i < calls; i++) {
		size_t more;
		runs_step(world, steps / calls);
		carom_hit *hits = runs_hits(world, &more);
		carom_hit *grown = realloc(all, (*count + more + 1) * sizeof *all);
		assert_non_null(grown);
		all = grown;
		memcpy(all + *count, hits, more * sizeof *all);
		*count += more;
		free(hits);
	}
	carom_world_destroy(world);
	return all;
}

static void devices_calls_and_threads_change_none(void **unused)
{
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	(void)unused;
	for (size_t s = 0; s < sizeof steps / sizeof *steps; s++) {
		carom_body_def bodies[MOST_BODIES];
		carom_world_def def = runs_resting(steps[s], 6.0f, 20.0f);
		scenery_random random = {11};
		carom_hit *first = NULL;
		size_t first_count = 0;
		scenery_bodies(&random, SCENERY_MIXED, MOST_BODIES, 1.05f, 3.0f, bodies);
		for (int i = 0; i < MOST_BODIES; i++)
			bodies[i].position.y += 8.0f;
		def.keep_hits = true;
		if (s == 2)
			def.restitution = 1.0f, def.gravity.y = 0.0f;
		SCENERY_EACH_DEVICE(device) {
			for (uint64_t cut = 1; cut <= 4; cut *= 2) {
				size_t count;
				def.threads = (uint32_t)cut;
				carom_world *world = runs_world(&def, device, bodies, MOST_BODIES);
				if (!world)
					break;
				carom_hit *hits = collect(world, 4 * runs_affordable(10), cut, &count);
				assert_true(!first || count == first_count);
				for (size_t k = 0; first && k < count; k++) {
					assert_true(runs_same_hit(&hits[k], &first[k]));
					runs_near(hits[k].time, first[k].time, 1e-12);
				}
				free(first);
				first = hits;
				first_count = count;
			}
		}
		print_message("%s: %zu hits\n", steps[s], first_count);
		runs_enough(first_count > 30);
		free(first);
	}
}

/* ---- None is lost */

/* A light ball between a wall and a heavy one is hit as often as pi has it: by the thousands in a step, of many such. */
static void many_in_one_step(void **unused)
{
	enum { BILLIARDS = 8, HITS = 3141 };
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_body_def bodies[3 * BILLIARDS];
		carom_world_def def = runs_def();
		carom_error error;
		carom_hit hit;
		for (int i = 0; i < BILLIARDS; i++) {
			carom_body_def *three = bodies + 3 * i;
			const float y = 3.0f * (float)i;
			three[0] = scenery_box(-1.0f, y, 0.0f, 0.0f, 1.0f, 2.0f);
			three[1] = scenery_circle(0.5f, y, 0.0f, 0.0f, 0.1f);
			three[2] = scenery_circle(1.5f, y, -4.0f, 0.0f, 0.2f);
			three[0].is_static = true;
			three[1].mass = 1.0f;
			three[2].mass = 1e6f;
		}
		def.time_step = 4.0f;
		def.keep_hits = true;
		carom_world *world = runs_world(&def, device, bodies, 3 * BILLIARDS);
		if (!world)
			continue;
		const carom_report report = runs_step(world, 1);
		assert_int_equal(carom_world_hit_count(world), report.hits);
		assert_int_equal(report.hits, BILLIARDS * HITS);
		scenery_check(carom_world_get_hits(world, report.hits - 1, 1, &hit, &error), &error);
		carom_world_destroy(world);
	}
}

/* Also of steps that take more rounds than are handed over at once, and of those that begin again: a heap's first seconds have both. */
static void none_of_a_heap_is_lost(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		uint64_t all = 0;
		carom_scene *scene = runs_read("scenes/heap.json");
		scene->world.keep_hits = true;
		carom_world *world = runs_scene(scene, device);
		if (!world)
			continue;
		for (uint64_t i = 0; i < runs_affordable(100); i++) {
			const carom_report report = runs_step(world, 1);
			assert_int_equal(carom_world_hit_count(world), report.hits);
			all += report.hits;
		}
		runs_enough(all > 4096);
		carom_world_destroy(world);
	}
}

/* ---- When there are any */

static bool count_them(void *context, const carom_report *so_far)
{
	carom_world *world = context;
	assert_int_equal(carom_world_hit_count(world), so_far->hits);
	return so_far->steps < 64;
}

static void last_call_has_them(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const carom_body_def ball = scenery_circle(0.0f, 0.0f, 7.0f, 5.0f, 0.5f);
		carom_world_def def = runs_room(3.0f, 2.0f);
		carom_error error;
		carom_hit hit;
		def.keep_hits = true;
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		assert_int_equal(carom_world_hit_count(world), 0);
		runs_step(world, 120);
		assert_true(carom_world_hit_count(world) > 5);
		runs_step(world, 0);
		assert_int_equal(carom_world_hit_count(world), 0);
		assert_int_equal(carom_world_get_hits(world, 0, 0, NULL, &error), CAROM_OK);
		carom_world_set_progress(world, count_them, world);
		const carom_report report = runs_advance(world, 10.0);
		assert_int_equal(carom_world_hit_count(world), report.hits);
		assert_int_equal(carom_world_get_hits(world, report.hits, 1, &hit, &error), CAROM_INVALID_ARGUMENT);
		assert_non_null(strstr(error.text, "the last call had"));
		assert_int_equal(carom_world_get_hits(world, 1, SIZE_MAX, &hit, &error), CAROM_INVALID_ARGUMENT);
		assert_int_equal(carom_world_get_hits(world, 0, 1, NULL, &error), CAROM_INVALID_ARGUMENT);
		carom_world_destroy(world);
		def.keep_hits = false;
		world = runs_world(&def, device, &ball, 1);
		assert_true(runs_step(world, 120).hits > 5);
		assert_int_equal(carom_world_hit_count(world), 0);
		assert_int_equal(carom_world_get_hits(world, 0, 1, &hit, &error), CAROM_INVALID_ARGUMENT);
		assert_non_null(strstr(error.text, "keep_hits"));
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(devices_calls_and_threads_change_none), cmocka_unit_test(many_in_one_step),
		cmocka_unit_test(none_of_a_heap_is_lost), cmocka_unit_test(last_call_has_them)};
	return cmocka_run_group_tests_name("hits_kept", tests, NULL, NULL);
}
