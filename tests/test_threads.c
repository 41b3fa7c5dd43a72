/* 27 worlds in four threads, each with threads of its own: what they compute is what each computes alone. Under the thread sanitizer
 * this is also where races show (`make check-threads`).
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "joined.h"

enum { WORLDS = 27, THREADS = 4, STEPS = 3, WIDTH = 64, HEIGHT = 48 };

/* What comes of a world; `error` tells where nothing did. */
typedef struct outcome {
	uint64_t state, picture;
	carom_error error;
} outcome;

static const scenery_device *device_of(int index)
{
	return &scenery_devices[(size_t)index % scenery_device_count];
}

static const char *const steps[] = {"events", "first_impact", "contacts"};

static const char *step_of(int index)
{
	return steps[(size_t)index / scenery_device_count % (sizeof steps / sizeof *steps)];
}

/* Enough for every stage of the CPU device to share its work among threads: they take up to 4,096 bodies at once, of contacts 64 that touch. */
static size_t bodies_of(int index)
{
	const bool shared = strcmp(device_of(index)->name, "cpu") == 0;
	return !shared ? 30 : strcmp(step_of(index), "events") == 0 ? 6000 : 600;
}

static size_t row_of(const carom_world_def *def)
{
	return (size_t)(def->room_max.x - def->room_min.x) - 1;
}

/* Rows of circles that lie on each other, and rub. */
static void build_wall(carom_body_def *bodies, size_t count, carom_world_def *def)
{
	const size_t row = row_of(def);
	def->gravity.y = -10.0f;
	def->restitution = 0.5f;
	def->friction = 0.5f;
	for (size_t i = 0; i < count; i++)
		bodies[i] = scenery_circle(def->room_min.x + 0.6f + (float)(i % row) * 1.0001f, def->room_min.y + 0.5f + (float)(i / row) * 1.0001f, 0.0f,
			0.0f, 0.5f);
}

/* Every other one of the wall's circles is held by a rod to the next, and every sixteenth pinned to one of the row above. */
static carom_status join_wall(carom_world *world, size_t count, size_t row, carom_error *error)
{
	carom_joint *joints = malloc(count * sizeof *joints);
	size_t joined = 0;
	for (size_t i = 0; i + row < count; i++) {
		const bool is_pin = i % 16 == 1;
		if (!is_pin && (i % 2 != 0 || (i + 1) % row == 0))
			continue;
		joints[joined++] = is_pin ? joined_pin((uint32_t)i, (int32_t)(i + row), 0.0f, 0.0f) : joined_rod((uint32_t)i, (int32_t)(i + 1), 0.0f, 0.0f);
	}
	const carom_status status = carom_world_set_joints(world, joined, joints, error);
	free(joints);
	return status;
}

/* Everything of a world's life. No assertions: those are of the main thread. */
static carom_status live(int index, outcome *out)
{
	const size_t count = bodies_of(index);
	const float half = 0.7f * sqrtf((float)count) + 2.0f;
	carom_world_def def = runs_room(half, half);
	carom_body_def *bodies = malloc(count * sizeof *bodies);
	carom_render_def render = carom_default_render_def();
	carom_measure measure;
	carom_world *world = NULL;
	uint8_t pixels[4 * WIDTH * HEIGHT] = {0};
	scenery_random random = {(uint64_t)index};
	def.device = device_of(index)->name;
	def.storage = device_of(index)->storage;
	def.pipeline.step = step_of(index);
	def.threads = 3;
	render.width = WIDTH;
	render.height = HEIGHT;
	const bool touches = strcmp(step_of(index), "contacts") == 0;
	if (touches)
		build_wall(bodies, count, &def);
	else
		scenery_bodies(&random, SCENERY_MIXED, count, 1.4f, 5.0f, bodies);
	carom_status status = carom_world_create(&def, &world, &out->error);
	if (!status)
		status = carom_world_add(world, bodies, count, NULL, &out->error);
	if (!status && touches)
		status = join_wall(world, count, row_of(&def), &out->error);
	if (!status)
		status = carom_world_step(world, STEPS, NULL, &out->error);
	if (!status)
		status = carom_world_measure(world, &measure, &out->error);
	if (!status)
		status = carom_world_hash(world, &out->state, &out->error);
	if (!status)
		status = carom_world_render(world, &render, pixels, &out->error);
	out->picture = scenery_hash(pixels, sizeof pixels);
	carom_world_destroy(world);
	free(bodies);
	return status;
}

typedef struct worker {
	int first;
	bool with_opencl;
	outcome *outcomes;
	carom_status statuses[WORLDS];
} worker;

static void *work(void *argument)
{
	worker *w = argument;
	for (int i = w->first; i < WORLDS; i += THREADS)
		if (w->with_opencl || strcmp(device_of(i)->name, "cpu") == 0)
			w->statuses[i] = live(i, &w->outcomes[i]);
	return NULL;
}

static bool has_opencl(void)
{
	const carom_world_def def = carom_default_world_def();
	carom_world *world = scenery_world(&def, &scenery_devices[1]);
	carom_world_destroy(world);
	return world != NULL;
}

static void worlds_are_independent(void **unused)
{
	(void)unused;
	static outcome together[WORLDS], alone[WORLDS];
	static worker workers[THREADS];
	pthread_t threads[THREADS];
	const bool with_opencl = has_opencl();
	for (int i = 0; i < THREADS; i++) {
		workers[i] = (worker){.first = i, .with_opencl = with_opencl, .outcomes = together};
		assert_int_equal(pthread_create(&threads[i], NULL, work, &workers[i]), 0);
	}
	for (int i = 0; i < THREADS; i++)
		assert_int_equal(pthread_join(threads[i], NULL), 0);
	for (int i = 0; i < WORLDS; i++) {
		scenery_check(workers[i % THREADS].statuses[i], &together[i].error);
		if (!with_opencl && strcmp(device_of(i)->name, "cpu") != 0)
			continue;
		scenery_check(live(i, &alone[i]), &alone[i].error);
		assert_true(together[i].state == alone[i].state && together[i].picture == alone[i].picture);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(worlds_are_independent)};
	return cmocka_run_group_tests_name("threads", tests, NULL, NULL);
}
