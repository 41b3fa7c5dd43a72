/* A floor of boxes side by side, flush: what slides over it knows nothing of the seams. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "runs.h"

#define TILES 7 /* scenery_box knows eight boxes */

static void lay_floor(float width, carom_body_def *bodies)
{
	for (int i = 0; i < TILES; i++) {
		bodies[i] = scenery_box(((float)i - 1.5f) * width, -0.5f, 0.0f, 0.0f, width, 1.0f);
		bodies[i].is_static = true;
	}
}

static carom_body_def sliding(uint32_t sides, float speed)
{
	carom_body_def body = scenery_box(0.0f, 0.2001f, speed, 0.0f, 0.8f, 0.4f);
	if (sides) {
		body = scenery_circle(0.0f, 0.0f, speed, 0.0f, 0.4f);
		body.shape = CAROM_REGULAR;
		body.sides = sides;
		body.angle = 3.14159265f * (1.0f / (float)sides - 0.5f); /* on a side */
		body.position.y = 0.4f * cosf(3.14159265f / (float)sides) + 1e-4f;
	}
	return body;
}

/* Without friction it slides on, though hops and rounding leave its corners a little below the next box's top. */
static void what_slides_slides_on(void **unused)
{
	static const struct {
		const char *step;
		uint32_t sides;
		float speed, restitution; /* m/s */
	} cases[] = {{"events", 0, 1.0f, 0.9f}, {"events", 0, 20.0f, 0.5f}, {"events", 6, 5.0f, 0.0f}, {"events", 3, 3.0f, 0.5f},
		{"contacts", 0, 0.5f, 0.5f}, {"contacts", 6, 5.0f, 0.5f}, {"contacts", 3, 20.0f, 0.9f}};
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		for (float time_step = 1.0f / 60.0f; time_step > 0.5e-3f; time_step /= 16.0f) {
			carom_world_def def = runs_def();
			carom_body_def bodies[TILES + 1];
			uint64_t first = 0;
			def.pipeline.step = cases[i].step;
			def.gravity.y = -10.0f;
			def.restitution = cases[i].restitution;
			def.time_step = time_step;
			lay_floor(1.0f, bodies);
			bodies[TILES] = sliding(cases[i].sides, cases[i].speed);
			SCENERY_EACH_DEVICE(device) {
				carom_world *world = runs_world(&def, device, bodies, TILES + 1);
				if (!world)
					continue;
				const double seconds = fmin(4.2 / (double)cases[i].speed, 2.1);
				runs_advance(world, seconds);
				const carom_body_state state = runs_state(world, TILES);
				runs_near((double)state.velocity.x / (double)cases[i].speed, 1.0, 3e-3);
				runs_near((double)state.position.x, (double)cases[i].speed * seconds, 1e-2);
				runs_near((double)state.angle, (double)bodies[TILES].angle, 3e-3);
				runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

/* By a step, over tiles of half a metre: where the body is after so many seconds, and with how many hits at most. */
static void slides_to(carom_world_def def, const char *step, carom_body_def body, double seconds, double x, double off, uint64_t most_hits)
{
	carom_body_def bodies[TILES + 1];
	uint64_t first = 0;
	def.pipeline.step = step;
	lay_floor(0.5f, bodies);
	bodies[TILES] = body;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, TILES + 1);
		if (!world)
			continue;
		assert_true(runs_advance(world, seconds).hits <= most_hits);
		runs_near((double)runs_state(world, TILES).position.x, x, off);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* In touch from the beginning, and nothing presses: by first_impact, too. */
static void what_glides_glides_on(void **unused)
{
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	(void)unused;
	for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
		carom_body_def body = sliding(0, 2.0f);
		body.position.y = 0.2f;
		slides_to(runs_def(), steps[i], body, 1.5, 3.0, 1e-5, 0);
	}
}

/* With friction it stops where it would on one long box: after v^2 / (2 mu g). */
static void what_rubs_stops_where_it_ought_to(void **unused)
{
	carom_world_def def = runs_def();
	(void)unused;
	def.gravity.y = -10.0f;
	def.restitution = 0.5f;
	def.friction = 0.2f;
	slides_to(def, "events", sliding(0, 3.0f), 2.0, 2.25, 5e-3, UINT64_MAX);
	slides_to(def, "contacts", sliding(0, 3.0f), 2.0, 2.25, 5e-3, UINT64_MAX);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_slides_slides_on), cmocka_unit_test(what_glides_glides_on), cmocka_unit_test(what_rubs_stops_where_it_ought_to)};
	return cmocka_run_group_tests_name("seams", tests, NULL, NULL);
}
