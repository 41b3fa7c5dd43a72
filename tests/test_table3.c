/* The six combinations of the paper's rendering phase [3, table 3] on every device: one picture, and as many texture
 * accesses as the table's last row says.
 * SPDX-License-Identifier: MIT */
#include "rendering.h"

static const char *const transforms[2] = {"index", "to_cpu"};

/* ---- The six combinations */

/* Before a step and after some, when the state is on the device alone. */
static void pictures_of(carom_world *world, picture made[2])
{
	carom_error error;
	made[0] = picture_of(world, with_inset(203, 150));
	scenery_check(carom_world_step(world, 20, NULL, &error), &error);
	made[1] = picture_of(world, with_inset(203, 150));
}

static void six_combinations_give_one_picture(void **state)
{
	(void)state;
	picture first[2] = {{0}}, found[2] = {{0}};
	SCENERY_EACH_DEVICE(device) {
		for (int k = 0; k < 6; k++) {
			carom_world_def def = room(options[k / 2], transforms[k % 2]);
			carom_world *world = scenery_world(&def, device);
			if (!world)
				break;
			fill(world);
			pictures_of(world, first[0].pixels ? found : first);
			carom_world_destroy(world);
			for (int i = 0; i < 2 && (k || device != scenery_devices); i++) {
				assert_memory_equal(found[i].pixels, first[i].pixels, bytes_of(first[i]));
				free(found[i].pixels);
			}
		}
	}
	assert_memory_not_equal(first[0].pixels, first[1].pixels, bytes_of(first[0]));
	free(first[0].pixels);
	free(first[1].pixels);
}

/* ---- Table 3's last row */

static carom_world *counting_world(const carom_world_def *def, const scenery_device *device)
{
	carom_world *world = scenery_world(def, device);
	carom_device_def counting = {.name = device->name, .storage = device->storage, .count_reads = true};
	carom_error error;
	if (!world)
		return NULL;
	counting.pipeline = world->pipeline;
	carom_device_close(world->device);
	world->device = NULL;
	scenery_check(carom_device_open(&counting, &world->device, &error), &error);
	return world;
}

static uint64_t accesses(carom_world *world, int32_t vertices)
{
	uint64_t before, count;
	carom_error error;
	scenery_check(world->device->kind->reads(world->device, &before, &error), &error);
	scenery_check(carom_run(world, STAGE_VERTICES, vertices, 1, 0, 0, &error), &error);
	scenery_check(world->device->kind->reads(world->device, &count, &error), &error);
	return count;
}

static void texture_accesses_are_those_of_table_3(void **state)
{
	(void)state;
	static const uint64_t expected[6] = {4, 2, 3, 1, 2, 0}; /* a vertex */
	SCENERY_EACH_DEVICE(device) {
		for (int k = 0; k < 6; k++) {
			carom_world_def def = room(options[k / 2], transforms[k % 2]);
			carom_world *world = counting_world(&def, device);
			if (!world)
				break;
			fill(world);
			free(picture_of(world, sized(64, 48)).pixels);
			assert_true(world->canvas.vertices > 80);
			assert_int_equal(accesses(world, (int32_t)world->canvas.vertices), expected[k] * world->canvas.vertices);
			carom_world_destroy(world);
		}
	}
}

/* 2t: to_cpu reads two textures back for each picture, index none. */
static void only_to_cpu_reads_the_state_back(void **state)
{
	(void)state;
	SCENERY_EACH_DEVICE(device) {
		for (int k = 0; k < 2; k++) {
			carom_world_def def = room("option3", transforms[k]);
			carom_world *world = scenery_world(&def, device);
			carom_error error;
			if (!world)
				continue;
			fill(world);
			scenery_check(carom_world_step(world, 3, NULL, &error), &error);
			assert_false(world->newest & PLACE_HOST);
			free(picture_of(world, sized(64, 48)).pixels);
			assert_int_equal(world->newest & PLACE_HOST, k == 1);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(six_combinations_give_one_picture), cmocka_unit_test(texture_accesses_are_those_of_table_3),
		cmocka_unit_test(only_to_cpu_reads_the_state_back)};
	return cmocka_run_group_tests_name("table3", tests, NULL, NULL);
}
