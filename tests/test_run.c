/* Runs: the same twice, stopped and resumed, with any number of threads, several at once; and how much memory.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "runs.h"
#include "world.h"

/* The hash after so many steps of a crowd of its own; 0 where there is no such device. */
static uint64_t run_crowd(const scenery_device *device, uint64_t seed, uint32_t threads, uint64_t steps)
{
	carom_world *world = scenery_crowd(device, seed, threads);
	uint64_t hash = 0;
	if (world) {
		assert_int_equal(runs_step(world, steps).steps, steps);
		hash = runs_hash(world);
	}
	carom_world_destroy(world);
	return hash;
}

/* ---- The same bits */

static void the_same_run_twice(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const uint64_t hash = run_crowd(device, 5, 0, 500);
		assert_true(hash == run_crowd(device, 5, 0, 500));
		assert_true(!hash || hash != run_crowd(device, 5, 0, 501));
		assert_true(!hash || hash != run_crowd(device, 6, 0, 500));
	}
}

static void any_number_of_threads(void **unused)
{
	(void)unused;
	static const uint32_t threads[] = {2, 3, 7, 256};
	const uint64_t hash = run_crowd(&scenery_devices[0], 5, 1, 300);
	for (size_t i = 0; i < sizeof threads / sizeof *threads; i++)
		assert_true(run_crowd(&scenery_devices[0], 5, threads[i], 300) == hash);
}

/* A thousand steps are five hundred, and five hundred of another world that goes on from there. */
static void stopped_and_resumed(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *first = scenery_crowd(device, 8, 0), *second = scenery_crowd(device, 8, 0);
		carom_body_state states[SCENERY_CROWD];
		carom_error error;
		if (!first)
			continue;
		const uint64_t hits = runs_step(first, 500).hits;
		scenery_check(carom_world_get_states(first, 0, SCENERY_CROWD, states, &error), &error);
		scenery_check(carom_world_set_states(second, 0, SCENERY_CROWD, states, &error), &error);
		assert_true(runs_hash(first) == runs_hash(second));
		assert_true(hits > 100 && runs_step(second, 500).hits == runs_step(first, 500).hits);
		assert_true(runs_hash(first) == runs_hash(second));
		assert_true(runs_hash(first) == run_crowd(device, 8, 0, 1000));
		carom_world_destroy(first);
		carom_world_destroy(second);
	}
}

static void images_and_buffers(void **unused)
{
	(void)unused;
	uint64_t hashes[3] = {0};
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = scenery_crowd(device, 9, 0);
		carom_device_info info;
		carom_error error;
		if (!world)
			continue;
		scenery_check(carom_world_get_device(world, &info, &error), &error);
		assert_true(info.is_opencl == !strcmp(device->name, "opencl"));
		assert_true(info.uses_images == (device->storage == CAROM_STORAGE_IMAGE));
		runs_step(world, 700);
		hashes[device - scenery_devices] = runs_hash(world);
		carom_world_destroy(world);
	}
	assert_true(!hashes[1] || hashes[1] == hashes[0]);
	assert_true(!hashes[2] || hashes[2] == hashes[0]);
}

typedef struct errand {
	const scenery_device *device;
	uint64_t seed, hash;
} errand;

static void *run_errand(void *context)
{
	errand *e = context;
	e->hash = run_crowd(e->device, e->seed, 2, 300);
	return NULL;
}

static void worlds_in_four_threads(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		pthread_t threads[4];
		errand errands[4];
		for (size_t i = 0; i < 4; i++) {
			errands[i] = (errand){device, 20 + i, 0};
			assert_int_equal(pthread_create(&threads[i], NULL, run_errand, &errands[i]), 0);
		}
		for (size_t i = 0; i < 4; i++)
			assert_int_equal(pthread_join(threads[i], NULL), 0);
		for (size_t i = 0; i < 4; i++)
			assert_true(errands[i].hash == run_crowd(device, errands[i].seed, 0, 300));
	}
}

/* A run that fails tells what was done before, and where it stood still. */
static void a_stall_tells_what_was_done(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = scenery_first_impact();
		const carom_body_def ball = scenery_circle(0.0f, 1.0f, 0.0f, 0.0f, 0.5f);
		carom_report report = {0};
		carom_body_state state;
		carom_error error;
		def.gravity = (carom_vec2){0.0f, -10.0f};
		def.restitution = 0.25f;
		def.has_room = true;
		def.room_min = (carom_vec2){-2.0f, 0.0f};
		def.room_max = (carom_vec2){2.0f, 4.0f};
		carom_world *world = scenery_world(&def, device);
		if (!world)
			continue;
		scenery_check(carom_world_add(world, &ball, 1, NULL, &error), &error);
		assert_int_equal(carom_world_step(world, 100000, &report, &error), CAROM_STALLED);
		assert_true(report.hits > 0 && report.steps >= report.hits && report.steps < 100000);
		assert_true(report.advanced > 0.3 && report.advanced < 3.0 && carom_world_time(world) == report.advanced);
		scenery_check(carom_world_get_states(world, 0, 1, &state, &error), &error);
		assert_true(fabsf(state.position.y - 0.5f) < 1e-3f);
		carom_world_destroy(world);
	}
}

/* What is refused has done nothing, and says so; no time before the world's is a target. */
static void what_is_refused_did_nothing(void **unused)
{
	(void)unused;
	const carom_world_def def = carom_default_world_def();
	const carom_body_def ball = scenery_circle(0.0f, 0.0f, 1.0f, 0.0f, 0.5f);
	carom_world *world = scenery_world(&def, scenery_devices);
	carom_report report = {9, 9, 9, 9, 9.0};
	carom_error error;
	scenery_check(carom_world_add(world, &ball, 1, NULL, &error), &error);
	assert_int_equal(carom_world_advance(world, -1.0, &report, &error), CAROM_INVALID_ARGUMENT);
	assert_true(report.steps == 0 && report.hits == 0 && report.ruled == 0 && report.held == 0 && report.advanced == 0.0);
	for (int i = 0; i < 2; i++) {
		report.steps = 9;
		assert_int_equal(carom_world_advance_to(world, -1.0, 7, &report, &error), CAROM_INVALID_ARGUMENT);
		assert_true(report.steps == 0 && carom_world_time(world) == 0.0);
		scenery_check(carom_world_step(world, 0, NULL, &error), &error);
	}
	carom_world_destroy(world);
}

/* An advance arrives, exactly, and no step is a sliver, though the time step is a float. */
static void an_advance_arrives(void **unused)
{
	static const struct {
		const char *step;
		float time_step;
		uint64_t steps; /* in a tenth of a second */
	} cases[] = {{"events", 1.0f / 60.0f, 6}, {"contacts", 0.01f, 10}, {"first_impact", 0.001f, 100}, {"events", 0.03f, 4}, {"events", 0.25f, 1}};
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
			carom_world_def def = carom_default_world_def();
			const carom_body_def ball = scenery_circle(0.0f, 0.0f, 1.0f, 0.0f, 0.5f);
			carom_report report;
			carom_error error;
			def.pipeline.step = cases[i].step;
			def.time_step = cases[i].time_step;
			carom_world *world = scenery_world(&def, device);
			if (!world)
				continue;
			scenery_check(carom_world_add(world, &ball, 1, NULL, &error), &error);
			for (int k = 1; k <= 32; k++) {
				scenery_check(carom_world_advance_to(world, 0.1 * k, UINT64_MAX, &report, &error), &error);
				assert_int_equal(report.steps, cases[i].steps);
				assert_true(fabs(report.advanced - 0.1) < 1e-8 && carom_world_time(world) == 0.1 * k);
			}
			carom_world_destroy(world);
		}
	}
}

/* ---- Memory */

static uint64_t taken;
static carom_status (*real_create)(carom_device *, const char *, carom_texel_format, uint32_t, uint32_t, const float *, carom_texture **,
	carom_error *);

static carom_status counting_create(carom_device *device, const char *name, carom_texel_format format, uint32_t width, uint32_t height,
	const float fill[4], carom_texture **texture, carom_error *error)
{
	taken += (uint64_t)width * height * (format == TEXELS_FLOAT || format == TEXELS_RECORD ? 16 : 4);
	return real_create(device, name, format, width, height, fill, texture, error);
}

/* What the textures of `count` bodies take, by watching the device make them. */
static uint64_t memory_taken(const carom_world_def *def, size_t count)
{
	carom_world *world = scenery_world(def, &scenery_devices[0]);
	carom_device_class counting = *world->device->kind;
	carom_error error;
	real_create = counting.create;
	counting.create = counting_create;
	taken = 0;
	for (size_t i = 0; i < count; i++) { /* each has vertices of its own */
		const carom_body_def body = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f + (float)i);
		scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
	}
	world->device->kind = &counting;
	scenery_check(carom_textures_update(world, &error), &error);
	carom_world_destroy(world);
	return taken;
}

static carom_status failing_create(carom_device *device, const char *name, carom_texel_format format, uint32_t width, uint32_t height,
	const float fill[4], carom_texture **texture, carom_error *error)
{
	(void)device, (void)name, (void)format, (void)width, (void)height, (void)fill, (void)texture, (void)error;
	return CAROM_OUT_OF_MEMORY;
}

/* A list of neighbours that can't grow is an error; the state is that of before, and with more memory the run goes on. */
static void a_list_that_cannot_grow_loses_nothing(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = scenery_crowd(device, 3, 0), *other = scenery_crowd(device, 3, 0);
		if (!world)
			continue;
		const carom_device_class *kind = world->device->kind;
		carom_device_class failing = *kind;
		carom_error error;
		failing.create = failing_create;
		scenery_check(carom_textures_update(world, &error), &error);
		const uint64_t before = runs_hash(world);
		world->events.room = 1;
		world->device->kind = &failing;
		assert_int_equal(carom_world_step(world, 5, NULL, &error), CAROM_OUT_OF_MEMORY);
		assert_true(runs_hash(world) == before);
		assert_int_equal(carom_world_step(world, 5, NULL, &error), CAROM_OUT_OF_MEMORY);
		assert_true(runs_hash(world) == before);
		world->device->kind = kind;
		runs_step(world, 5);
		runs_step(other, 5);
		assert_true(runs_hash(world) == runs_hash(other));
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

static void memory_is_known_beforehand(void **unused)
{
	(void)unused;
	static const size_t counts[] = {1, 8, 9, 100, 1000};
	static const char *const reductions[] = {"classic", "four_six", "tiled"};
	for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
		for (size_t k = 0; k < 6; k++) {
			carom_world_def def = scenery_first_impact();
			def.pipeline.reduce = reductions[k / 2];
			def.pipeline.toi = k % 2 ? "bisection" : "separating";
			def.iterations = 3;
			const uint64_t said = carom_world_memory(&def, counts[i], 4 * counts[i]), is = memory_taken(&def, counts[i]);
			if (!((double)said > 0.95 * (double)is && (double)said < 1.25 * (double)is))
				fail_msg("%zu bodies, %s: said to take %llu bytes, take %llu", counts[i], reductions[k / 2], (unsigned long long)said,
					(unsigned long long)is);
		}
	}
	for (size_t i = 0; i < 2 * sizeof counts / sizeof *counts; i++) {
		const size_t count = counts[i / 2];
		carom_world_def def = carom_default_world_def();
		def.keep_hits = i % 2;
		uint64_t said = carom_world_memory(&def, count, 4 * count), is = memory_taken(&def, count);
		if (!((double)said > 0.95 * (double)is && (double)said < 1.25 * (double)is))
			fail_msg("%zu bodies, events: said to take %llu bytes, take %llu", count, (unsigned long long)said, (unsigned long long)is);
		def.pipeline.step = "contacts";
		def.friction = 0.5f;
		said = carom_world_memory(&def, count, 4 * count);
		is = memory_taken(&def, count);
		def.friction = 0.0f; /* what bodies have of their own isn't known */
		if (!((double)said > 0.95 * (double)is && (double)said < 1.25 * (double)is && carom_world_memory(&def, count, 4 * count) == said))
			fail_msg("%zu bodies, contacts: said to take %llu bytes, take %llu", count, (unsigned long long)said, (unsigned long long)is);
	}
	carom_world_def unknown = carom_default_world_def();
	unknown.pipeline.toi = "guess";
	assert_true(carom_world_memory(&unknown, 10, 40) == 0);
	carom_world_def endless = scenery_first_impact();
	endless.pipeline.toi = "bisection";
	endless.iterations = 1;
	endless.epsilon = -1.0f;
	assert_true(carom_world_memory(&endless, 10, 40) == 0);
	const carom_world_def def = carom_default_world_def();
	assert_true(carom_world_memory(&def, 1 << 20, 3 << 20) < (uint64_t)1 << 30); /* a KiB each for a million triangles */
	assert_true(carom_world_memory(&def, 4194304, 64 * 4194304) > 0);
	assert_true(carom_world_memory(&def, 1, 7 * CAROM_MAX_VERTICES) > 0 && carom_world_memory(&def, 1, 7 * CAROM_MAX_VERTICES + 1) == 0);
	assert_true(carom_world_memory(&def, 4194305, 4194305) == 0);
	assert_true(carom_world_memory(&def, SIZE_MAX, SIZE_MAX) == 0);
	assert_true(carom_world_memory(&def, 1, SIZE_MAX) == 0);
}

static double seconds(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static long most_memory(void)
{
	struct rusage usage;
	getrusage(RUSAGE_SELF, &usage);
	return usage.ru_maxrss / 1024; /* MiB on Linux */
}

/* Said at once, with the texture's name and without filling the memory; and the bodies are still there. */
static void assert_too_many(carom_world *world, const carom_body_def *bodies, size_t count)
{
	const double start = seconds();
	const long before = most_memory();
	char square[64];
	carom_report report = {9, 9, 9, 9, 9.0};
	carom_body_state state;
	carom_error error = {0};
	scenery_check(carom_world_add(world, bodies, count, NULL, &error), &error);
	snprintf(square, sizeof square, "HitTimes, of %zu x %zu texels", count, count);
	for (int i = 0; i < 2; i++) {
		assert_int_equal(carom_world_step(world, 1, &report, &error), CAROM_LIMIT);
		assert_int_equal(error.status, CAROM_LIMIT);
		if (!strstr(error.text, square) || !strstr(error.text, "first_impact") || !strstr(error.text, world->device->info.name))
			fail_msg("%s", error.text);
		assert_int_equal(report.steps, 0);
	}
	scenery_check(carom_world_get_states(world, 65535, 1, &state, &error), &error);
	assert_true(state.position.x == 255.0f && state.position.y == 255.0f);
	assert_true(seconds() - start < 5.0);
	assert_true(most_memory() - before < 256);
}

static void too_many_bodies(void **unused)
{
	(void)unused;
	const size_t most = 1u << 18;
	carom_body_def *bodies = calloc(most, sizeof *bodies);
	assert_non_null(bodies);
	for (size_t i = 0; i < most; i++)
		bodies[i] = scenery_circle((float)(i % 256), (float)(i / 256), 0.0f, 0.0f, 0.25f);
	for (size_t i = 0; i < scenery_device_count + 1; i++) { /* the last is a CPU with boundless memory */
		const scenery_device *device = &scenery_devices[i % scenery_device_count];
		carom_world_def def = scenery_first_impact();
		carom_world *world = scenery_world(&def, device);
		if (!world)
			continue;
		if (i == scenery_device_count)
			world->device->info.memory = world->device->info.max_allocation = (uint64_t)1 << 50;
		/* an OpenCL device that holds 64 GiB in one buffer gets bodies for 1 TiB */
		const bool is_huge = device->storage == CAROM_STORAGE_BUFFER && world->device->info.max_allocation >> 36;
		assert_too_many(world, bodies, is_huge ? most : 65536);
		carom_world_destroy(world);
	}
	free(bodies);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_run_twice), cmocka_unit_test(any_number_of_threads),
		cmocka_unit_test(stopped_and_resumed), cmocka_unit_test(images_and_buffers), cmocka_unit_test(worlds_in_four_threads),
		cmocka_unit_test(a_stall_tells_what_was_done), cmocka_unit_test(what_is_refused_did_nothing), cmocka_unit_test(an_advance_arrives),
		cmocka_unit_test(memory_is_known_beforehand), cmocka_unit_test(a_list_that_cannot_grow_loses_nothing), cmocka_unit_test(too_many_bodies)};
	return cmocka_run_group_tests_name("run", tests, NULL, NULL);
}
