/* Polygons with vertices within their sides, or nearly: what hits them knows nothing of these. By every step, on every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "runs.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

enum { FLOOR, BALL, OTHER_BALL, BOX, ROCK, BODIES };

/* All falls onto a floor, or a body that turns, whose sides have vertices in between, or not. */
static void fill_bodies(bool straight, carom_body_def bodies[BODIES])
{
	static const carom_vec2 plain[] = {{-2, -0.5f}, {2, -0.5f}, {2, 0.5f}, {-2, 0.5f}},
							dotted[] = {{-2, -0.5f}, {-1, -0.5f}, {1, -0.5f}, {2, -0.5f}, {2, 0}, {2, 0.5f}, {0.5f, 0.5f}, {0, 0.5f}, {-0.5f, 0.5f},
								{-2, 0.5f}, {-2, 0}};
	static const carom_vec2 rock[] = {{-0.25f, -0.25f}, {0.25f, -0.25f}, {0.25f, 0.25f}, {-0.25f, 0.25f}},
							dotted_rock[] = {
								{-0.25f, -0.25f}, {0, -0.25f}, {0.25f, -0.25f}, {0.25f, 0}, {0.25f, 0.25f}, {0, 0.25f}, {-0.25f, 0.25f}, {-0.25f, 0}};
	bodies[FLOOR] = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f);
	bodies[FLOOR].vertices = straight ? plain : dotted;
	bodies[FLOOR].vertex_count = straight ? COUNT(plain) : COUNT(dotted);
	bodies[FLOOR].is_static = true;
	bodies[BALL] = scenery_circle(-1.25f, 1.2f, 0.0f, 0.0f, 0.2f);
	bodies[OTHER_BALL] = scenery_circle(0.03125f, 2.0f, 0.0f, 0.0f, 0.125f);
	bodies[BOX] = scenery_box(0.25f, 0.8f, 0.0f, 0.0f, 0.5f, 0.25f);
	bodies[ROCK] = scenery_box(1.25f, 1.5f, 0.125f, 0.0f, 0.5f, 0.5f);
	bodies[ROCK].vertices = straight ? rock : dotted_rock;
	bodies[ROCK].vertex_count = straight ? COUNT(rock) : COUNT(dotted_rock);
	bodies[ROCK].mass = 0.25f;
	bodies[ROCK].angular_velocity = 1.0f;
}

static void vertices_within_sides_change_no_bit(void **unused)
{
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	(void)unused;
	for (size_t i = 0; i < COUNT(steps); i++) {
		carom_world_def def = runs_def();
		uint64_t first = 0;
		def.pipeline.step = steps[i];
		def.gravity.y = -10.0f;
		def.restitution = i < 2 ? 0.5f : 1.0f; /* the step first_impact has no rest */
		def.friction = 0.25f;
		for (int straight = 0; straight < 2; straight++) {
			carom_body_def bodies[BODIES];
			fill_bodies(straight, bodies);
			SCENERY_EACH_DEVICE(device) {
				carom_world *world = runs_world(&def, device, bodies, BODIES);
				if (!world)
					continue;
				carom_body_info info;
				scenery_check(carom_world_get_body(world, ROCK, &info, NULL), NULL);
				assert_int_equal(info.vertex_count, bodies[ROCK].vertex_count); /* it is as it was given */
				runs_advance(world, 1.25);
				runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

/* A ball comes back from a roof that is hardly one as from a floor, however near to the ridge it falls: its sides lean by `slope`. */
static void a_flat_roof_throws_nothing_aside(void **unused)
{
	static const float heights[] = {0.0f, 5e-7f, 1e-6f, 3e-6f, 1e-5f, 1e-4f, 1e-3f}, places[] = {1e-4f, 3e-3f, 0.02f, 0.1f, 0.4f};
	(void)unused;
	for (size_t i = 0; i < COUNT(heights); i++) {
		const carom_vec2 roof[] = {{-2.0f, -0.5f}, {2.0f, -0.5f}, {2.0f, 0.5f}, {0.0f, 0.5f + heights[i]}, {-2.0f, 0.5f}};
		carom_body_def bodies[2 * COUNT(places) + 1];
		carom_world_def def = runs_def();
		const double slope = (double)heights[i] / 2.0;
		uint64_t first = 0;
		def.gravity.y = -10.0f;
		bodies[0] = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f);
		bodies[0].vertices = roof;
		bodies[0].vertex_count = COUNT(roof);
		bodies[0].is_static = true;
		for (size_t k = 0; k < 2 * COUNT(places); k++) {
			bodies[k + 1] = scenery_circle(k % 2 ? places[k / 2] : -places[k / 2], 1.5f, 0.0f, 0.0f, 0.25f);
			bodies[k + 1].mask = 2; /* they are not there for each other */
		}
		bodies[0].categories = 2;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, COUNT(bodies));
			if (!world)
				continue;
			runs_advance(world, 0.5); /* they fall for 0.39 s */
			for (uint32_t k = 1; k < COUNT(bodies); k++) {
				const carom_body_state state = runs_state(world, k);
				assert_true(state.velocity.y > 2.0f);
				assert_true(fabs((double)state.velocity.x) < 3.9 * (2.0 * slope + 2e-6)); /* as fast as it fell, by twice the slope */
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(vertices_within_sides_change_no_bit), cmocka_unit_test(a_flat_roof_throws_nothing_aside)};
	return cmocka_run_group_tests_name("straight", tests, NULL, NULL);
}
