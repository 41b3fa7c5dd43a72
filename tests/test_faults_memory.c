/* Every allocation of a small run fails in turn: an error says so, nothing is lost, nothing leaks (which the sanitizers see).
 * SPDX-License-Identifier: MIT */
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "faults/walk.h"
#include "runs.h"

static int grown; /* lists that could not */
static int lost;  /* scenes that were read wrong */

/* Where its buffer for a token can't grow beyond 15 bytes jansson 2.14 loses one and says nothing: then the scene is another. */
static bool jansson_lost(const char *call, carom_status status)
{
	const bool is_lost = call && strncmp(call, "jansson", 7) == 0 && status == CAROM_INVALID_SCENE;
	lost += is_lost;
	return is_lost;
}

/* What can be done without, fewer threads say, is no failure. */
static void there_is_no_memory(const char *call, carom_status status, const carom_error *error)
{
	const bool is_told = status == CAROM_OUT_OF_MEMORY || jansson_lost(call, status);
	if (status && (!call || !is_told || error->status != status || !*error->text || strstr(error->text, "(null)")))
		fail_msg("%s failed: %s: %s", call ? call : "nothing", carom_status_name(status), error->text);
	grown += status && strstr(error->text, "Neighbours, ") && strstr(error->text, "can't be made");
}

static void worlds_that_open(void **unused)
{
	(void)unused;
	json_set_alloc_funcs(faults_malloc, free);
	SCENERY_EACH_DEVICE(device) {
		lost = 0;
		if (device->storage != CAROM_STORAGE_IMAGE) /* it is the same as with buffers */
			walk_opening(device, "events", FAULTS_MEMORY, there_is_no_memory);
		assert_true(lost <= 2); /* a long key and a name with escapes */
	}
	json_set_alloc_funcs(malloc, free);
}

static void worlds_that_run(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		walk_running(device, "events", FAULTS_MEMORY, there_is_no_memory);
		if (device->storage != CAROM_STORAGE_IMAGE)
			walk_running(device, "contacts", FAULTS_MEMORY, there_is_no_memory);
		walk_running(device, "first_impact", FAULTS_MEMORY, there_is_no_memory);
	}
}

static void bodies_are_steered(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device)
		walk_steering(device, FAULTS_MEMORY, there_is_no_memory);
}

static void bodies_come_and_go(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device)
		walk_roster(device, FAULTS_MEMORY, there_is_no_memory);
}

static void lists_that_grow(void **unused)
{
	(void)unused;
	grown = 0;
	SCENERY_EACH_DEVICE(device)
		walk_growing(device, FAULTS_MEMORY, there_is_no_memory);
	assert_true(grown > 0);
}

/* On the CPU device's own threads: a world of its own for each, since threads keep what they have. */
static void threads_that_run_out(void **unused)
{
	(void)unused;
	enum { BODIES = 400, STEPS = 2 };
	static carom_body_def bodies[BODIES];
	carom_world_def def = runs_room(20.0f, 20.0f);
	scenery_random random = {1};
	uint64_t hashes[STEPS + 1] = {0};
	const char *failed = "";
	int on_threads = 0;
	def.threads = 3;
	def.time_step = 0.0625f;
	scenery_bodies(&random, SCENERY_MIXED, BODIES, 1.4f, 6.0f, bodies);
	for (uint64_t n = 0; failed; n++) { /* the first is but looked at */
		carom_world *world = runs_world(&def, &scenery_devices[0], bodies, BODIES);
		carom_report report = {0};
		carom_error error;
		for (int i = 0; n == 0 && i <= STEPS; i++) {
			hashes[i] = runs_hash(world);
			runs_step(world, i < STEPS);
		}
		faults_arm(FAULTS_MEMORY, n, 0);
		const carom_status status = n ? carom_world_step(world, STEPS, &report, &error) : CAROM_OK;
		failed = n ? faults_disarm() : "";
		if (n && (status || failed)) {
			there_is_no_memory(failed, status, &error);
			on_threads += strstr(error.text, "the stage ") != NULL;
			assert_true(status && runs_hash(world) == hashes[report.steps]);
			runs_step(world, STEPS - report.steps);
		}
		assert_true(runs_hash(world) == hashes[STEPS]);
		carom_world_destroy(world);
	}
	assert_true(on_threads > 0);
}

/* To a world that has run. */
static void bodies_are_added_all_or_none(void **unused)
{
	(void)unused;
	enum { MORE = 200 };
	static carom_body_def bodies[MORE];
	const carom_body_def first = scenery_box(0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f);
	const char *failed = "";
	uint64_t n;
	for (int i = 0; i < MORE; i++) {
		bodies[i] = scenery_box((float)i, 9.0f, 0.0f, 0.0f, 1.0f, 1.0f);
		bodies[i].vertices = first.vertices;
		bodies[i].name = "a name that takes some bytes";
	}
	for (n = 1; failed; n++) {
		const carom_world_def def = runs_def();
		carom_world *world = runs_world(&def, &scenery_devices[0], &first, 1);
		uint32_t index = 7;
		carom_error error;
		runs_step(world, 2);
		const uint64_t hash = runs_hash(world);
		faults_arm(FAULTS_MEMORY, n, 0);
		const carom_status status = carom_world_add(world, bodies, MORE, &index, &error);
		failed = faults_disarm();
		if (failed) {
			there_is_no_memory(failed, status, &error);
			assert_true(status && index == 7 && carom_world_body_count(world) == 1 && runs_hash(world) == hash);
			scenery_check(carom_world_add(world, bodies, MORE, &index, &error), &error);
		}
		assert_true(index == 1 && carom_world_body_count(world) == 1 + MORE);
		runs_step(world, 1);
		carom_world_destroy(world);
	}
	assert_true(n > 4);
}

static carom_world *crowd_that_ran(bool keep_hits)
{
	carom_body_def bodies[SCENERY_CROWD];
	carom_world_def def = runs_room(5.0f, 5.0f);
	scenery_random random = {3};
	scenery_bodies(&random, SCENERY_MIXED, SCENERY_CROWD, 1.25f, 3.0f, bodies);
	scenery_filter(&random, &bodies[4]);
	def.threads = 1;
	def.keep_hits = keep_hits;
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, SCENERY_CROWD);
	runs_step(world, 2);
	return world;
}

/* Then it is written, too. */
static void bodies_are_removed_all_or_none(void **unused)
{
	(void)unused;
	const uint32_t gone[] = {7, 3, 12};
	const char *failed = "";
	uint64_t n, first = 0;
	for (n = 1; failed; n++) {
		carom_world *world = crowd_that_ran(false);
		carom_error error;
		char *text = NULL;
		const uint64_t hash = runs_hash(world);
		faults_arm(FAULTS_MEMORY, n, 0);
		carom_status status = carom_world_remove(world, gone, 3, &error);
		if (!status)
			status = carom_scene_text_create(world, NULL, &text, NULL, &error);
		failed = faults_disarm();
		if (failed) {
			there_is_no_memory(failed, status, &error);
			assert_true(status && !text);
			if (carom_world_body_count(world) == SCENERY_CROWD) {
				assert_true(runs_hash(world) == hash);
				scenery_check(carom_world_remove(world, gone, 3, &error), &error);
			}
		}
		carom_scene_text_destroy(text);
		assert_int_equal(carom_world_body_count(world), SCENERY_CROWD - 3);
		runs_step(world, 3);
		runs_same_hash(&first, runs_hash(world), &scenery_devices[0]);
		carom_world_destroy(world);
	}
	assert_true(n > 5);
}

/* A call that can't keep its hits tells how far it got, and the next one has its own. */
static void hits_are_kept_or_it_is_told(void **unused)
{
	(void)unused;
	enum { STEPS = 20 };
	const char *failed = "";
	uint64_t n, first = 0, told = 0;
	for (n = 1; failed; n++) {
		carom_world *world = crowd_that_ran(true);
		carom_report report = {0};
		carom_error error;
		faults_arm(FAULTS_MEMORY, n, 0);
		const carom_status status = carom_world_step(world, STEPS, &report, &error);
		failed = faults_disarm();
		if (failed && status) {
			there_is_no_memory(failed, status, &error);
			told += strstr(error.text, " hits") != NULL;
			report = runs_step(world, STEPS - report.steps);
		}
		assert_int_equal(carom_world_hit_count(world), report.hits);
		runs_same_hash(&first, runs_hash(world), &scenery_devices[0]);
		carom_world_destroy(world);
	}
	assert_true(told >= 3); /* to read, to sort, to keep them */
}

/* What is asked of a state where there is no memory for the answer leaves the world as it is. */
static void a_snapshot_is_made_or_not(void **unused)
{
	(void)unused;
	const char *failed = "";
	uint64_t n;
	carom_world *world = crowd_that_ran(false);
	const uint64_t hash = runs_hash(world);
	for (n = 1; failed; n++) {
		carom_snapshot *snapshot = NULL;
		carom_measure measure = {.max_penetration = 42};
		carom_error error;
		faults_arm(FAULTS_MEMORY, n, 0);
		carom_status status = carom_snapshot_create(world, &snapshot, &error);
		if (!status)
			status = carom_world_measure(world, &measure, &error);
		failed = faults_disarm();
		if (failed) {
			there_is_no_memory(failed, status, &error);
			assert_true(status && measure.max_penetration == 42);
		}
		carom_snapshot_destroy(snapshot);
		assert_true(runs_hash(world) == hash);
	}
	assert_true(n > 12);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(worlds_that_open), cmocka_unit_test(worlds_that_run), cmocka_unit_test(lists_that_grow),
		cmocka_unit_test(bodies_are_steered), cmocka_unit_test(bodies_come_and_go), cmocka_unit_test(threads_that_run_out),
		cmocka_unit_test(bodies_are_added_all_or_none), cmocka_unit_test(bodies_are_removed_all_or_none),
		cmocka_unit_test(hits_are_kept_or_it_is_told), cmocka_unit_test(a_snapshot_is_made_or_not)};
	return cmocka_run_group_tests_name("faults_memory", tests, walk_make_folder, walk_remove_folder);
}
