/* The same bits everywhere: each scene of scenes/ and some random worlds, after so many steps, have the hash that is written here, on every device, for
 * every number of threads, in one run or in several. A hash that changes means that trajectories changed: say so in the
 * CHANGELOG, and find out why before a number here is touched. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runs.h"

#define STEPS 1000
#ifdef __SANITIZE_ADDRESS__
#define PART 5 /* of the steps, for these take ten times as long: no hash is written here of so few, but all have the same */
#else
#define PART 1
#endif
#define RESTING_STEPS 200 /* of worlds in which a hundred bodies come to rest: the others take minutes, and are run if CAROM_LONG_TESTS is set */

static const struct {
	const char *scene;
	uint64_t hash,
		own; /* after STEPS of first_impact, 0 where that takes no such bodies, and of the scene's own step, which is events where it says nothing */
} golden[] = {
	{"scenes/billiard_break.json", 0x67a2d3b09229d3f4, 0xbe6530f293e25062},
	{"scenes/bridge.json", 0xde9bddfc3ed99fda, 0x754cd1a0c3a10eb1},
	{"scenes/car.json", 0xd1c8a94208bfd579, 0x4fb8d7c0403c1cb0},
	{"scenes/circles_1024.json", 0xb407392652c0fb4a, 0xaa3285fdc8f4d50f},
	{"scenes/circles_256.json", 0x8ef7c68f081e9804, 0xc5189580a0275343},
	{"scenes/heap.json", 0x515bfcb74767cfd7, 0xee3b6cc1e5acf396},
	{"scenes/letters.json", 0, 0xb1da15d9b1b41cdf},
	{"scenes/mixed.json", 0x62e06f0b87986c3c, 0x58b0504d2d2afd92},
	{"scenes/mixer.json", 0x9a455603469d877e, 0x5d480abb4c98dac6},
	{"scenes/newtons_cradle.json", 0xc7f0be3c1a579185, 0xf2d7510159883cca},
	{"scenes/pi.json", 0x9d624002521cac23, 0xd287219b381da045},
	{"scenes/piston.json", 0x2164404c393abf4d, 0x1a2d939507b78308},
	{"scenes/pyramid.json", 0x0633cf1a8e76570d, 0xe3f6c3aae127099e},
	{"scenes/sand.json", 0x72ee53ee9ba5fc06, 0x31dd5005a088fedb},
	{"scenes/sorter.json", 0x0a70d5e9a9d7a8c2, 0xba3826884b86444a},
	{"scenes/thin_wall.json", 0xf92a02eb0107cb9c, 0xe6d41d5bd0d9f749},
	{"scenes/towers.json", 0x06a65b03a828eaba, 0xbda3ad19ed9dabd8},
	{"scenes/triangles_1024.json", 0xcc55f47ec49c25b1, 0x8da8028aa248c377},
	{"scenes/triangles_256.json", 0xde49371816d9fa38, 0xc93506365757ceac},
};

/* 0: what the first one has. */
static uint64_t expected_at_first(uint64_t written)
{
	return PART == 1 ? written : 0;
}

static carom_world *world_of(const char *path, const char *step, const scenery_device *device, uint32_t threads)
{
	carom_scene *scene = runs_read(path);
	scene->world.threads = threads;
	if (step)
		scene->world.pipeline.step = step;
	return runs_scene(scene, device);
}

/* ---- Random worlds: seeds of scenery_bodies in a room with gravity, of all shapes, with static bodies, and lossy hits */

static const struct {
	uint64_t seed;
	scenery_shapes shapes;
	size_t count;
	float restitution, gravity, friction;
	uint64_t steps, hash[2], events[2]; /* after so many steps, and where those are fewer, after STEPS */
	uint64_t contacts;                  /* after RESTING_STEPS */
} random_worlds[] = {
	{1, SCENERY_MIXED, 49, 1.0f, 0.0f, 0.0f, STEPS, {0x06f6509e16156804}, {0xcde4342bddd0867e}, 0x5c3c0876116abdf6},
	{2, SCENERY_MIXED, 100, 0.75f, -9.81f, 0.0f, RESTING_STEPS, {0xe66d38cefc957cf6, 0x9494cb47c7d56f48}, {0x52c8f8546c926bd4, 0x9592a5489305c891},
		0x0b793730a50eb8e4},
	{3, SCENERY_POLYGONS, 64, 0.5f, -1.0f, 0.0f, RESTING_STEPS, {0x8a1cd3f3d3a0750a, 0x82a7e1836c0a4ac7}, {0xc7c995f7943af3f9, 0x502b206893c4c0d0},
		0x5899b9e1fe482899},
	{4, SCENERY_CIRCLES, 196, 0.875f, -3.0f, 0.0f, RESTING_STEPS, {0x2c0cb69fffe63f90, 0xb62125c1a5365cac}, {0x5222fe046872010e, 0x6131f8ab1255f382},
		0x073b3d85ed167c2b},
	{5, SCENERY_POLYGONS, 81, 1.0f, -2.0f, 0.0f, STEPS, {0x8097a8b0c8e24775}, {0x8278d1d170949ea3}, 0x1b51abc899bcbdcd},
	{6, SCENERY_CIRCLES, 100, 1.0f, -9.81f, 0.0f, STEPS, {0x77c43753b16437fd}, {0xba38d361258b61f1}, 0xb7b80328e6940db0},
	{7, SCENERY_MIXED, 16, 0.75f, -9.81f, 0.0f, STEPS, {0x108413312f5fd9af}, {0xeb6adb36e0341f92}, 0x31cee93e7bf981cf},
	{8, SCENERY_POLYGONS, 9, 0.5f, -1.0f, 0.0f, STEPS, {0x8cacd16454cb3966}, {0xaf0b2c37db51785e}, 0xce9c9c03752d4a49},
	{9, SCENERY_CIRCLES, 36, 0.875f, -3.0f, 0.0f, STEPS, {0x050b36b217d5ff67}, {0x88a992790e483f1c}, 0x2c1d02d5e04ef672},
	{10, SCENERY_MIXED, 49, 0.5f, -9.81f, 0.5f, RESTING_STEPS, {0x0c3ead4c230722ec, 0x32e4659c5f1d96f6}, {0x3ecec3b6eed95368, 0xa787a472e12ac5e2},
		0x471d6346d9066aed},
	{11, SCENERY_POLYGONS, 25, 0.75f, -3.0f, 1000.0f, RESTING_STEPS, {0x147144a217b6640e, 0xe663748c26ba84f5},
		{0x87e848d03f53f41b, 0x19586d9b29708f62}, 0xc6087b40493d15b6},
	{12, SCENERY_CIRCLES, 64, 1.0f, -2.0f, 0.25f, STEPS, {0xb0af4e0886036521}, {0xdb0ea15d092cc348}, 0x5c3a85cdc03447f6},
};

static carom_world *random_world(size_t i, const char *step, const scenery_device *device)
{
	enum { MOST = 196 };
	carom_body_def bodies[MOST];
	carom_world_def def = carom_default_world_def();
	scenery_random random = {random_worlds[i].seed};
	float half = 0.75f * sqrtf((float)random_worlds[i].count) + 1.0f;
	carom_world *world;
	carom_error error;
	def.pipeline.step = step;
	def.has_room = true;
	def.room_min = (carom_vec2){-half, -half};
	def.room_max = (carom_vec2){half, half};
	def.gravity = (carom_vec2){0.25f, random_worlds[i].gravity};
	def.restitution = random_worlds[i].restitution;
	def.friction = random_worlds[i].friction;
	scenery_bodies(&random, random_worlds[i].shapes, random_worlds[i].count, 1.4f, 4.0f, bodies);
	world = scenery_world(&def, device);
	if (world)
		scenery_check(carom_world_add(world, bodies, random_worlds[i].count, NULL, &error), &error);
	return world;
}

static void check_random(size_t i, const char *step, uint64_t steps, uint64_t written)
{
	uint64_t expected = expected_at_first(written);
	steps /= PART;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = random_world(i, step, device);
		uint64_t hash;
		if (!world)
			continue;
		hash = runs_hash_after(world, steps, 1);
		expected = expected ? expected : hash;
		if (hash != expected)
			fail_msg("seed %llu, %llu steps of %s on %s: %016llx, expected %016llx", (unsigned long long)random_worlds[i].seed,
				(unsigned long long)steps, step, device->name, (unsigned long long)hash, (unsigned long long)expected);
	}
}

static void random_worlds_have_their_hashes(void **unused)
{
	const char *all = getenv("CAROM_LONG_TESTS");
	(void)unused;
	for (size_t i = 0; i < sizeof random_worlds / sizeof *random_worlds; i++) {
		check_random(i, "first_impact", random_worlds[i].steps, random_worlds[i].hash[0]);
		check_random(i, "events", random_worlds[i].steps, random_worlds[i].events[0]);
		check_random(i, "contacts", RESTING_STEPS, random_worlds[i].contacts);
		if (random_worlds[i].steps < STEPS && all && *all) {
			check_random(i, "first_impact", STEPS, random_worlds[i].hash[1]);
			check_random(i, "events", STEPS, random_worlds[i].events[1]);
		}
	}
}

/* ---- Scenes */

static void check_hash(const char *scene, const char *step, uint64_t steps, uint64_t written)
{
	uint64_t expected = expected_at_first(written);
	steps /= PART;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = world_of(scene, step, device, 0);
		uint64_t hash;
		if (!world)
			continue;
		hash = runs_hash_after(world, steps, 1);
		expected = expected ? expected : hash;
		if (hash != expected)
			fail_msg("%s, step %s on %s: %016llx, expected %016llx", scene, step ? step : "of its own", device->name, (unsigned long long)hash,
				(unsigned long long)expected);
	}
}

static void every_scene_has_its_hash(void **unused)
{
	(void)unused;
	for (size_t i = 0; i < sizeof golden / sizeof *golden; i++)
		if (golden[i].hash)
			check_hash(golden[i].scene, "first_impact", STEPS, golden[i].hash);
}

static void every_scene_has_its_own_hash(void **unused)
{
	(void)unused;
	for (size_t i = 0; i < sizeof golden / sizeof *golden; i++)
		check_hash(golden[i].scene, NULL, STEPS, golden[i].own);
}

static void threads_and_calls_change_no_bit(void **unused)
{
	(void)unused;
	const size_t last = sizeof golden / sizeof *golden - 1;
	static const char *const steps[] = {"first_impact", "events"};
	const uint64_t written[] = {golden[last].hash, golden[last].own};
	for (size_t i = 0; i < 2; i++) {
		uint64_t expected = expected_at_first(written[i]);
		for (uint32_t threads = 1; threads <= 3; threads++) {
			const uint64_t calls = threads == 3 ? 10 : 1;
			const uint64_t hash = runs_hash_after(world_of(golden[last].scene, steps[i], &scenery_devices[0], threads), STEPS / PART, calls);
			expected = expected ? expected : hash;
			assert_true(hash == expected);
		}
	}
}

/* The way to a time in one call, in many, and with a wait for each step. */
static void advance_in_pieces(const char *step)
{
	uint64_t hashes[2];
	SCENERY_EACH_DEVICE(device) {
		for (int pieces = 0; pieces < 2; pieces++) {
			carom_world *world = world_of("scenes/mixed.json", step, device, 0);
			carom_report report = {.steps = 1};
			carom_error error;
			if (!world)
				return;
			while (report.steps > 0)
				scenery_check(carom_world_advance_to(world, 0.777, pieces ? 7 : UINT64_MAX, &report, &error), &error);
			hashes[pieces] = runs_hash_after(world, 0, 1);
		}
		assert_true(hashes[0] == hashes[1]);
	}
}

static void advancing_in_pieces_changes_no_bit(void **unused)
{
	(void)unused;
	advance_in_pieces("first_impact");
	advance_in_pieces("events");
	advance_in_pieces("contacts");
}

/* A world whose state was just set knows nothing of what steps learn for those after them: whom they need not look at, and who has other neighbours now. */
static void forget(carom_world *world)
{
	carom_body_state states[196];
	const size_t count = carom_world_body_count(world);
	carom_error error;
	scenery_check(carom_world_get_states(world, 0, count, states, &error), &error);
	scenery_check(carom_world_set_states(world, 0, count, states, &error), &error);
}

static void what_steps_learn_changes_no_bit(void **unused)
{
	enum { LEARNING_STEPS = 100 };
	static const char *const steps[] = {"events", "contacts"};
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (size_t i = 0; i < 2 * sizeof random_worlds / sizeof *random_worlds; i++) {
			carom_world *learning = random_world(i / 2, steps[i % 2], device), *forgetting = random_world(i / 2, steps[i % 2], device);
			carom_error error;
			if (!learning || !forgetting)
				return;
			for (int step = 0; step < LEARNING_STEPS; step++) {
				forget(forgetting);
				scenery_check(carom_world_step(forgetting, 1, NULL, &error), &error);
			}
			assert_true(runs_hash_after(learning, LEARNING_STEPS, 1) == runs_hash_after(forgetting, 0, 1));
		}
	}
}

/* How old the lists of neighbours are when bodies meet depends on how long the calls are, among others. In this world two bodies become neighbours that
 * were both changed in the step before. */
static void calls_of_any_length_change_no_bit(void **unused)
{
	enum { COUNT = 256, ALL = 840 / PART };
	static const uint64_t lengths[] = {1, 2, 3, 4, 6, 7, 8, ALL};
	carom_world_def def = carom_default_world_def();
	carom_body_def bodies[COUNT];
	scenery_random random = {18};
	uint64_t expected = 0;
	(void)unused;
	def.has_room = true;
	def.room_min = (carom_vec2){-15.0f, -15.0f};
	def.room_max = (carom_vec2){15.0f, 15.0f};
	scenery_bodies(&random, SCENERY_CIRCLES, COUNT, 1.8f, 3.0f, bodies);
	for (int i = 0; i < COUNT; i++) {
		bodies[i].is_static = false;
		bodies[i].radius = 0.5f;
		bodies[i].density = 1.0f;
		bodies[i].velocity.x = scenery_uniform(&random, -5.0f, 5.0f);
		bodies[i].velocity.y = scenery_uniform(&random, -5.0f, 5.0f);
	}
	SCENERY_EACH_DEVICE(device) {
		for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
			carom_world *world = scenery_world(&def, device);
			carom_error error;
			if (!world)
				break;
			scenery_check(carom_world_add(world, bodies, COUNT, NULL, &error), &error);
			const uint64_t hash = runs_hash_after(world, ALL, ALL / lengths[i]);
			expected = expected ? expected : hash;
			if (hash != expected)
				fail_msg("calls of %llu steps on %s: %016llx, expected %016llx", (unsigned long long)lengths[i], device->name,
					(unsigned long long)hash, (unsigned long long)expected);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(every_scene_has_its_hash), cmocka_unit_test(every_scene_has_its_own_hash),
		cmocka_unit_test(random_worlds_have_their_hashes), cmocka_unit_test(threads_and_calls_change_no_bit),
		cmocka_unit_test(advancing_in_pieces_changes_no_bit), cmocka_unit_test(what_steps_learn_changes_no_bit),
		cmocka_unit_test(calls_of_any_length_change_no_bit)};
	return cmocka_run_group_tests_name("hashes", tests, NULL, NULL);
}
