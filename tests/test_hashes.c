/* The same bits everywhere: each scene of scenes/ after some steps has the hash that is written here, on every device, for
 * every number of threads, in one run or in several. A hash that changes means that trajectories changed: say so in the
 * CHANGELOG, and find out why before a number here is touched. */
#include <stdio.h>

#include "scenery.h"

#define STEPS 1000

static const struct {
	const char *scene;
	uint64_t hash;
} golden[] = {
	{"scenes/billiard_break.json", 0x67a2d3b09229d3f4},
	{"scenes/circles_1024.json", 0xb407392652c0fb4a},
	{"scenes/circles_256.json", 0x8ef7c68f081e9804},
	{"scenes/mixed.json", 0xabc67be1b5beed04},
	{"scenes/newtons_cradle.json", 0xc7f0be3c1a579185},
	{"scenes/thin_wall.json", 0xc9f2ff84907e5b29},
	{"scenes/triangles_1024.json", 0x66c29846c62647ee},
	{"scenes/triangles_256.json", 0x45105d59c465c072},
};

static carom_world *world_of(const char *path, const scenery_device *device, uint32_t threads)
{
	carom_scene *scene = NULL;
	carom_world *world;
	carom_error error = {0};
	scenery_check(carom_scene_read(path, &scene, &error), &error);
	scene->world.threads = threads;
	world = scenery_world(&scene->world, device);
	if (world)
		scenery_check(carom_world_add(world, scene->bodies, scene->body_count, NULL, &error), &error);
	carom_scene_destroy(scene);
	return world;
}

static uint64_t hash_after(carom_world *world, uint64_t steps, int calls)
{
	uint64_t hash = 0;
	carom_error error;
	for (int i = 0; i < calls; i++)
		scenery_check(carom_world_step(world, steps / (uint64_t)calls, NULL, &error), &error);
	scenery_check(carom_world_hash(world, &hash, &error), &error);
	carom_world_destroy(world);
	return hash;
}

static void every_scene_has_its_hash(void **unused)
{
	(void)unused;
	for (size_t i = 0; i < sizeof golden / sizeof *golden; i++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = world_of(golden[i].scene, device, 0);
			uint64_t hash;
			if (!world)
				continue;
			hash = hash_after(world, STEPS, 1);
			if (hash != golden[i].hash)
				fail_msg("%s on %s: %016llx, expected %016llx", golden[i].scene, device->name, (unsigned long long)hash,
					(unsigned long long)golden[i].hash);
		}
	}
}

static void threads_and_calls_change_no_bit(void **unused)
{
	(void)unused;
	const size_t last = sizeof golden / sizeof *golden - 1;
	for (uint32_t threads = 1; threads <= 3; threads++)
		assert_true(hash_after(world_of(golden[last].scene, &scenery_devices[0], threads), STEPS, threads == 3 ? 10 : 1) == golden[last].hash);
}

/* The way to a time in one call, in many, and with a wait for each step. */
static void advancing_in_pieces_changes_no_bit(void **unused)
{
	(void)unused;
	uint64_t hashes[2];
	SCENERY_EACH_DEVICE(device) {
		for (int pieces = 0; pieces < 2; pieces++) {
			carom_world *world = world_of("scenes/mixed.json", device, 0);
			carom_report report = {.steps = 1};
			carom_error error;
			if (!world)
				return;
			while (report.steps > 0)
				scenery_check(carom_world_advance_to(world, 0.777, pieces ? 7 : UINT64_MAX, &report, &error), &error);
			hashes[pieces] = hash_after(world, 0, 1);
		}
		assert_true(hashes[0] == hashes[1]);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_scene_has_its_hash),
		cmocka_unit_test(threads_and_calls_change_no_bit),
		cmocka_unit_test(advancing_in_pieces_changes_no_bit),
	};
	return cmocka_run_group_tests_name("hashes", tests, NULL, NULL);
}
