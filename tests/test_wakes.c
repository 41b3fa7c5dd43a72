/* A look that is good for some steps is not good for what changes in between. On every device.
 * SPDX-License-Identifier: MIT */
#include "runs.h"

static carom_vec2 turned(carom_vec2 v, int quarters)
{
	return quarters == 0 ? v : turned((carom_vec2){-v.y, v.x}, quarters - 1);
}

static carom_body_def ball(float x, float y, float vx, float vy, int quarters)
{
	const carom_vec2 at = turned((carom_vec2){x, y}, quarters), v = turned((carom_vec2){vx, vy}, quarters);
	return scenery_circle(at.x, at.y, v.x, v.y, 0.5f);
}

enum { SPECTATORS = 40 }; /* so many that those in hits are few: then a look is good for several steps */

/* A ball falls on the ground so slowly that it is stopped there without a hit, in the third step. In the second another, which falls behind it just as fast, has
 * been hit from the side; when that looked, the two were never to meet. Whichever of the two lies first in memory, which follows from their places. */
static void what_is_stopped_is_looked_at(void **unused)
{
	(void)unused;
	for (int quarters = 0; quarters < 4; quarters++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_room(3.0f, 3.0f);
			carom_body_def bodies[3 + SPECTATORS] = {ball(0.0f, -2.494662f, 0.0f, 0.036667f, quarters),
				ball(0.0f, -1.490662f, 0.0f, 0.036667f, quarters), ball(-1.017167f, -1.490662f, 1.0f, 0.036667f, quarters)};
			for (int i = 0; i < SPECTATORS; i++) {
				bodies[3 + i] = scenery_circle(0.1f * (float)(i % 8) - 0.35f, 0.1f * (float)(i / 8), 0.0f, 0.0f, 0.01f);
				bodies[3 + i].is_static = true;
			}
			def.gravity = turned((carom_vec2){0.0f, -RUNS_GRAVITY}, quarters);
			def.restitution = 0.3f;
			def.pipeline.step = "contacts";
			carom_world *world = runs_world(&def, device, bodies, 3 + SPECTATORS);
			if (!world)
				continue;
			uint64_t hits = 0;
			for (int step = 0; step < 8; step++) {
				hits += runs_step(world, 1).hits;
				assert_true(step < 2 ? hits == (uint64_t)step : hits > 1);
				assert_true(runs_measure(world).max_penetration < 1e-6);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

enum { STEPS = 120 };

/* Slow polygons, most of which turn, with forces and torques, among driven ones: few hit in a step, so what is near is proved to stay apart for some steps. A world whose
 * bodies are loaded anew looks at all in each. */
static void near_polygons_are_looked_at_in_time(void **unused)
{
	(void)unused;
	for (uint64_t seed = 0; seed < 3; seed++) {
		enum { COUNT = 150 };
		scenery_random random = {seed};
		carom_body_def bodies[COUNT];
		carom_world_def def = runs_room(8.0f, 8.0f);
		uint64_t first = 0;
		scenery_bodies(&random, SCENERY_POLYGONS, COUNT, 1.1f, 0.5f, bodies);
		scenery_drive(&random, COUNT, 0.5f, bodies);
		for (int i = 0; i < COUNT; i++) {
			if (bodies[i].is_static || bodies[i].is_kinematic)
				continue;
			bodies[i].angular_velocity = scenery_uniform(&random, -2.0f, 2.0f);
			bodies[i].force.x = scenery_uniform(&random, -0.1f, 0.1f);
			bodies[i].torque = scenery_uniform(&random, -0.05f, 0.05f);
		}
		SCENERY_EACH_DEVICE(device) {
			for (int anew = 0; anew < 2; anew++) {
				carom_world *world = runs_world(&def, device, bodies, COUNT);
				uint64_t hits = 0;
				if (!world)
					continue;
				for (int step = 0; step < STEPS; step++) {
					if (anew)
						runs_load_anew(world);
					hits += runs_step(world, 1).hits;
				}
				assert_true(hits > STEPS / 2 && runs_measure(world).max_penetration < 1e-5);
				runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_stopped_is_looked_at), cmocka_unit_test(near_polygons_are_looked_at_in_time)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
