/* What is called in the middle of a step: how often it is changes no bit, it may end the call, and it may look, not touch.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <string.h>

#include "runs.h"

static uint64_t run_crowd(const scenery_device *device, uint64_t seed, uint64_t steps)
{
	carom_world *world = scenery_crowd(device, seed, 0);
	const uint64_t hash = world && runs_step(world, steps).steps == steps ? runs_hash(world) : 0;
	carom_world_destroy(world);
	return hash;
}

/* Counts its calls, and says stop when so many steps or seconds are done. */
typedef struct watch {
	uint64_t stop_at, calls;
	double stop_after;
	carom_report last;
} watch;

static bool look(void *context, const carom_report *so_far)
{
	watch *w = context;
	assert_true(so_far->steps > w->last.steps && so_far->hits >= w->last.hits && so_far->advanced >= w->last.advanced);
	w->calls++;
	w->last = *so_far;
	return so_far->steps < w->stop_at && so_far->advanced < w->stop_after;
}

/* Called or not, and cut short or not: the same steps give the same bits. */
static void steps_cut_short(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const uint64_t whole = run_crowd(device, 12, 600);
		watch all = {.stop_at = UINT64_MAX, .stop_after = INFINITY}, some = {.stop_at = 200, .stop_after = INFINITY};
		carom_world *world = scenery_crowd(device, 12, 0), *cut = scenery_crowd(device, 12, 0);
		if (!world)
			continue;
		carom_world_set_progress(world, look, &all);
		assert_int_equal(runs_step(world, 600).steps, 600);
		assert_true(all.calls >= 2 && all.last.steps == 600 && runs_hash(world) == whole);
		carom_world_set_progress(cut, look, &some);
		const carom_report report = runs_step(cut, 600);
		assert_true(report.steps >= 200 && report.steps < 600 && report.steps == some.last.steps && report.hits == some.last.hits);
		assert_true(carom_world_time(cut) == report.advanced);
		carom_world_set_progress(cut, NULL, NULL);
		assert_int_equal(runs_step(cut, 600 - report.steps).steps, 600 - report.steps);
		assert_true(runs_hash(cut) == whole);
		carom_world_destroy(world);
		carom_world_destroy(cut);
	}
}

static void an_advance_cut_short(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		watch some = {.stop_at = UINT64_MAX, .stop_after = 0.5};
		carom_world *world = scenery_crowd(device, 13, 0);
		carom_report report, rest;
		carom_error error;
		if (!world)
			continue;
		carom_world_set_progress(world, look, &some);
		scenery_check(carom_world_advance(world, 4.0, &report, &error), &error);
		assert_true(report.advanced >= 0.5 && report.advanced < 4.0 && report.advanced == some.last.advanced);
		assert_true(carom_world_time(world) == report.advanced);
		carom_world_set_progress(world, NULL, NULL);
		scenery_check(carom_world_advance(world, 4.0 - report.advanced, &rest, &error), &error);
		assert_true(fabs(carom_world_time(world) - 4.0) < 1e-9 && fabs(report.advanced + rest.advanced - 4.0) < 1e-9);
		carom_world_destroy(world);
	}
}

/* ---- The world in its own callback */

static void assert_busy(carom_status status, const carom_error *error)
{
	assert_int_equal(status, CAROM_INVALID_ARGUMENT);
	assert_string_equal(error->text, "world: found in the middle of a step; its progress callback may read it, not change it");
}

static bool change(void *context, const carom_report *so_far)
{
	carom_world *world = context;
	const carom_body_def body = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.1f);
	carom_body_state state;
	carom_error error;
	(void)so_far;
	scenery_check(carom_world_get_states(world, 0, 1, &state, &error), &error);
	assert_busy(carom_world_step(world, 1, NULL, &error), &error);
	assert_busy(carom_world_advance(world, 1.0, NULL, &error), &error);
	assert_busy(carom_world_advance_to(world, 1e3, 1, NULL, &error), &error);
	assert_busy(carom_world_add(world, &body, 1, NULL, &error), &error);
	assert_busy(carom_world_set_states(world, 0, 1, &state, &error), &error);
	assert_busy(carom_world_set_force(world, 0, state.velocity, 0.0f, &error), &error);
	assert_busy(carom_world_set_contacts(world, 0, NULL, &error), &error);
	assert_busy(carom_world_set_joints(world, 0, NULL, &error), &error);
	return true;
}

static bool look_around(void *context, const carom_report *so_far)
{
	carom_world *world = context;
	carom_render_def def = carom_default_render_def();
	uint8_t pixels[16 * 9 * 4];
	carom_measure measure;
	carom_error error;
	size_t contacts;
	(void)so_far;
	def.width = 16;
	def.height = 9;
	runs_hash(world);
	scenery_check(carom_world_measure(world, &measure, &error), &error);
	scenery_check(carom_world_contact_count(world, &contacts, &error), &error);
	scenery_check(carom_world_render(world, &def, pixels, &error), &error);
	return true;
}

static void a_callback_may_look_not_touch(void **unused)
{
	static const carom_progress callbacks[] = {change, look_around};
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const uint64_t whole = run_crowd(device, 14, 600);
		for (size_t i = 0; i < sizeof callbacks / sizeof *callbacks; i++) {
			carom_world *world = scenery_crowd(device, 14, 0);
			if (!world)
				continue;
			carom_world_set_progress(world, callbacks[i], world);
			assert_int_equal(runs_step(world, 600).steps, 600);
			assert_true(runs_hash(world) == whole);
			carom_world_destroy(world);
		}
	}
}

static carom_world *pyramid(const scenery_device *device)
{
	carom_scene *scene = NULL;
	carom_error error;
	scenery_check(carom_scene_read("scenes/pyramid.json", &scene, &error), &error);
	carom_world *world = runs_world(&scene->world, device, scene->bodies, scene->body_count);
	carom_scene_destroy(scene);
	return world;
}

/* Forces are found in iterations, for which a batch may have no room: then it ends within a step. */
static void forces_under_way_may_be_looked_at(void **unused)
{
	uint64_t whole = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = pyramid(device), *watched = pyramid(device);
		if (!world)
			continue;
		runs_same_hash(&whole, runs_hash_after(world, 60, 1), device);
		carom_world_set_progress(watched, look_around, watched);
		runs_same_hash(&whole, runs_hash_after(watched, 60, 1), device);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(steps_cut_short), cmocka_unit_test(an_advance_cut_short),
		cmocka_unit_test(a_callback_may_look_not_touch), cmocka_unit_test(forces_under_way_may_be_looked_at)};
	return cmocka_run_group_tests_name("progress", tests, NULL, NULL);
}
