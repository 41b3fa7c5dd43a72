/* Worlds on one device share its context and the programs that are alike: those built once, released with the last that uses them, and no world is the worse for
 * another that fails.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "cl/functions.h"
#include "faults/faults.h"
#include "runs.h"

enum { WIDTH = 64, HEIGHT = 48 };

static const scenery_device *const device = &scenery_devices[2];

/* How many OpenCL objects there are that calls of this name, or of names that begin so, created. */
static size_t alive(const char *call)
{
	char kinds[16384], name[64];
	size_t count = 0;
	faults_alive(kinds, sizeof kinds);
	snprintf(name, sizeof name, " %s", call);
	for (const char *at = kinds; (at = strstr(at, name)); at++)
		count++;
	return count;
}

static void expect(size_t contexts, size_t programs)
{
	assert_int_equal(alive("clCreateContext"), contexts);
	assert_int_equal(alive("clCreateProgram"), programs);
}

static carom_status create(const char *step, carom_storage storage, carom_world **world, carom_error *error)
{
	carom_world_def def = runs_room(6.0f, 6.0f);
	carom_body_def bodies[SCENERY_CROWD];
	scenery_random random = {7};
	def.device = device->name;
	def.storage = storage;
	def.pipeline.step = step;
	scenery_bodies(&random, SCENERY_MIXED, SCENERY_CROWD, 1.4f, 5.0f, bodies);
	carom_status status = carom_world_create(&def, world, error);
	return status ? status : carom_world_add(*world, bodies, SCENERY_CROWD, NULL, error);
}

static carom_world *world_of(const char *step, carom_storage storage)
{
	carom_world *world = NULL;
	carom_error error;
	scenery_check(create(step, storage, &world, &error), &error);
	return world;
}

static carom_status draw(carom_world *world, carom_error *error)
{
	static uint8_t pixels[4 * WIDTH * HEIGHT];
	carom_render_def def = carom_default_render_def();
	def.width = WIDTH;
	def.height = HEIGHT;
	return carom_world_render(world, &def, pixels, error);
}

static void must_draw(carom_world *world)
{
	carom_error error;
	scenery_check(draw(world, &error), &error);
}

static uint64_t hash_after(carom_world *world, uint64_t steps)
{
	runs_step(world, steps);
	return runs_hash(world);
}

/* Of a world of events that shares with none, after so many steps. */
static uint64_t hash_alone(uint64_t steps)
{
	expect(0, 0);
	carom_world *world = world_of("events", CAROM_STORAGE_BUFFER);
	const uint64_t hash = hash_after(world, steps);
	carom_world_destroy(world);
	expect(0, 0);
	return hash;
}

static bool has_opencl(void)
{
	const carom_world_def def = carom_default_world_def();
	carom_world *world = scenery_world(&def, device);
	carom_world_destroy(world);
	scenery_forget_kernels();
	return world != NULL;
}

static void what_is_alike_is_shared(void **unused)
{
	(void)unused;
	if (!has_opencl())
		skip();
	const uint64_t expected = hash_alone(8);
	carom_world *first = world_of("events", CAROM_STORAGE_BUFFER);
	expect(1, 1);
	carom_world *second = world_of("events", CAROM_STORAGE_BUFFER);
	expect(1, 1);
	must_draw(second);
	expect(1, 2);
	must_draw(first);
	expect(1, 2);
	carom_world *other_step = world_of("contacts", CAROM_STORAGE_BUFFER);
	expect(1, 3);
	carom_world *with_images = world_of("events", CAROM_STORAGE_IMAGE);
	expect(1, 4);
	must_draw(with_images);
	expect(1, 5);
	runs_step(first, 4);
	assert_true(hash_after(second, 8) == expected && hash_after(first, 4) == expected);
	carom_world_destroy(first);
	expect(1, 5);
	assert_true(hash_after(with_images, 8) == expected);
	carom_world_destroy(with_images);
	expect(1, 3);
	must_draw(second);
	carom_world_destroy(second);
	expect(1, 1);
	runs_step(other_step, 1);
	carom_world_destroy(other_step);
	assert_int_equal(alive("cl"), 0);
}

/* For every call that could fail while another world is made, and draws. */
static void none_is_the_worse_for_another(void **unused)
{
	(void)unused;
	const char *failed = "";
	uint64_t n = 0;
	if (!has_opencl())
		skip();
	const uint64_t expected = hash_alone(9);
	carom_world *world = world_of("events", CAROM_STORAGE_BUFFER);
	must_draw(world);
	runs_step(world, 1);
	const size_t before = alive("cl");
	while (failed) {
		carom_world *other = NULL;
		carom_error error;
		faults_arm(FAULTS_OPENCL, ++n, CL_OUT_OF_HOST_MEMORY);
		if (!create("events", CAROM_STORAGE_BUFFER, &other, &error))
			(void)draw(other, &error);
		failed = faults_disarm();
		carom_world_destroy(other);
		assert_int_equal(alive("cl"), before);
	}
	assert_true(n > 100);
	assert_true(hash_after(world, 8) == expected);
	must_draw(world);
	carom_world_destroy(world);
	assert_int_equal(alive("cl"), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_alike_is_shared), cmocka_unit_test(none_is_the_worse_for_another)};
	return cmocka_run_group_tests_name("faults_shared", tests, NULL, NULL);
}
