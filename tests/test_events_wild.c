/* Worlds that nobody would make: tiny bodies that torques spin up to millions of rad/s, others at hundreds of m/s, forces of their own. Whatever comes of them, it is
 * the same on every device, with any number of threads, and when a run stops and goes on. */
#include <stdlib.h>
#include <unistd.h>

#include "runs.h"

enum { MOST = 72 };

static uint32_t below(scenery_random *random, uint32_t end)
{
	return (uint32_t)scenery_uniform(random, 0.0f, (float)end);
}

static bool one_in(scenery_random *random, uint32_t many)
{
	return below(random, many) == 0;
}

static carom_body_def wild_body(scenery_random *random, uint32_t shapes, float speed)
{
	const float small = one_in(random, 6) ? 0.02f : 0.6f, radius = 0.5f * scenery_uniform(random, small, 1.0f);
	carom_body_def body = scenery_circle(0.0f, 0.0f, scenery_uniform(random, -speed, speed), scenery_uniform(random, -speed, speed), radius);
	if (shapes == 1 || (shapes == 2 && one_in(random, 2))) {
		body.shape = CAROM_REGULAR;
		body.sides = 3 + below(random, 5);
		body.angle = scenery_uniform(random, -3.0f, 3.0f);
		body.angular_velocity = scenery_uniform(random, -5.0f, 5.0f);
	}
	if (one_in(random, 12))
		body.is_static = true;
	if (one_in(random, 8))
		body.mass = scenery_uniform(random, 0.01f, 100.0f);
	if (one_in(random, 15) && !body.is_static)
		body.force = (carom_vec2){scenery_uniform(random, -3.0f, 3.0f), scenery_uniform(random, -3.0f, 3.0f)};
	if (one_in(random, 8) && !body.is_static && body.shape == CAROM_REGULAR)
		body.torque = scenery_uniform(random, -1.0f, 1.0f);
	if (body.is_static) {
		body.velocity = (carom_vec2){0.0f, 0.0f};
		body.angular_velocity = 0.0f;
	}
	return body;
}

/* On a lattice in a room, which may be far from the origin. */
static carom_world_def wild_world(uint64_t seed, carom_body_def *bodies, uint32_t *count)
{
	static const float restitutions[] = {0.0f, 0.0f, 0.3f, 0.9f, 1.0f, 1.0f};
	scenery_random random = {seed};
	carom_world_def def = runs_def();
	const uint32_t shapes = below(&random, 3), side = 2 + below(&random, 7);
	const float pitch = scenery_uniform(&random, 1.02f, 2.0f), half = 0.5f * (float)side * pitch + 0.6f;
	const float middle = one_in(&random, 3) ? scenery_uniform(&random, -200.0f, 200.0f) : 0.0f;
	const float speed = one_in(&random, 12) ? 300.0f : scenery_uniform(&random, 0.0f, 10.0f);
	def.restitution = restitutions[below(&random, 6)];
	def.gravity.y = one_in(&random, 2) ? -scenery_uniform(&random, 0.0f, 20.0f) : 0.0f;
	def.has_room = true;
	def.room_min = (carom_vec2){middle - half, -half};
	def.room_max = (carom_vec2){middle + half, half};
	*count = side * side;
	for (uint32_t i = 0; i < *count; i++) {
		bodies[i] = wild_body(&random, shapes, speed);
		bodies[i].position.x = middle + ((float)(i % side) - 0.5f * (float)(side - 1)) * pitch;
		bodies[i].position.y = ((float)(i / side) - 0.5f * (float)(side - 1)) * pitch;
	}
	return def;
}

/* Written to a scene half of the way, and read again. */
static uint64_t run_in_halves(carom_world *world, uint32_t steps)
{
	char path[] = "/tmp/carom-wild-XXXXXX";
	carom_error error;
	carom_scene *scene = NULL;
	const int file = mkstemp(path);
	assert_true(file >= 0 && close(file) == 0);
	runs_step(world, steps / 2);
	scenery_check(carom_world_write_scene(world, NULL, path, &error), &error);
	carom_world_destroy(world);
	scenery_check(carom_scene_read(path, &scene, &error), &error);
	assert_int_equal(unlink(path), 0);
	scene->world.device = "cpu";
	scenery_check(carom_scene_create_world(scene, &world, &error), &error);
	carom_scene_destroy(scene);
	return runs_hash_after(world, steps - steps / 2, 1);
}

/* In each of these worlds a pause was found or not, by chance, or a hit upon what was held not found. */
static void wild_worlds_have_one_hash(void **unused)
{
	(void)unused;
	static const uint64_t seeds[] = {42, 143, 494, 612, 812};
	const uint32_t steps = (uint32_t)runs_affordable(120);
	for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
		carom_body_def bodies[MOST];
		uint32_t count;
		uint64_t first = 0;
		carom_world_def def = wild_world(seeds[i], bodies, &count);
		print_message("seed %u: %u bodies\n", (unsigned)seeds[i], (unsigned)count);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, count);
			if (world)
				runs_same_hash(&first, runs_hash_after(world, steps, 1), device);
		}
		runs_same_hash(&first, run_in_halves(runs_world(&def, scenery_devices, bodies, count), steps), scenery_devices);
		for (def.threads = 1; def.threads <= 3; def.threads++)
			runs_same_hash(&first, runs_hash_after(runs_world(&def, scenery_devices, bodies, count), steps, steps), scenery_devices);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(wild_worlds_have_one_hash)};
	return cmocka_run_group_tests_name("events_wild", tests, NULL, NULL);
}
