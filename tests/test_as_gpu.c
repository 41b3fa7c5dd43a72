/* What GPUs are given, on an OpenCL device that plays one: teams that run clusters, neighbours one by one, and shapes sorted by groups have the bits of the
 * CPU fallback, in all sizes of worlds.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "concave.h"
#include "pictures.h"
#include "runs.h"

enum { CONCAVE = SCENERY_POLYGONS + 1 /* more shapes: most are not convex */ };

static carom_world *crowded(const scenery_device *device, const char *step, int shapes, size_t count)
{
	static carom_body_def bodies[700];
	scenery_random random = {11};
	const float side = 0.55f * sqrtf((float)count) + 1.0f;
	carom_world_def def = runs_room(side, side);
	carom_error error;
	scenery_check(carom_pipeline_set(&def.pipeline, "step", step, &error), &error);
	def.gravity.y = -RUNS_GRAVITY;
	def.restitution = 0.6f;
	def.friction = 0.2f;
	if (shapes == CONCAVE)
		concave_bodies(&random, count, 1.05f, 6.0f, bodies);
	else
		scenery_bodies(&random, (scenery_shapes)shapes, count, 1.05f, 6.0f, bodies);
	return runs_world(&def, device, bodies, count);
}

static void worlds_have_the_same_bits(void **unused)
{
	(void)unused;
	static const size_t counts[] = {3, 60, 700};
	static const char *const steps[] = {"events", "contacts"};
	for (size_t c = 0; c < 3; c++)
		for (int k = 0; k < 2; k++)
			for (int shapes = SCENERY_MIXED; shapes <= CONCAVE; shapes++) {
				uint64_t first = 0;
				SCENERY_EACH_DEVICE(device) {
					carom_world *world = crowded(device, steps[k], shapes, counts[c]);
					if (!world)
						continue;
					const carom_report report = runs_step(world, counts[c] > 100 ? runs_affordable(20) : runs_affordable(100));
					runs_enough(report.hits > counts[c]);
					runs_same_hash(&first, runs_hash(world), device);
					carom_world_destroy(world);
				}
			}
}

/* In blocks of rows and columns of tiles, few and many of them, and one tile with most of the shapes. */
static void pictures_have_the_same_bits(void **unused)
{
	(void)unused;
	static const uint32_t sizes[][2] = {{1, 1}, {300, 200}, {1500, 1100}};
	for (size_t k = 0; k < 3; k++) {
		picture first = {0};
		carom_render_def def = sized(sizes[k][0], sizes[k][1]);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = crowded(device, "events", SCENERY_MIXED, 700);
			if (!world)
				continue;
			picture now = picture_of(world, def);
			if (device == scenery_devices) {
				first = now;
			} else {
				assert_memory_equal(first.pixels, now.pixels, 4 * (size_t)def.width * def.height);
				free(now.pixels);
			}
			carom_world_destroy(world);
		}
		free(first.pixels);
	}
}

int main(void)
{
	setenv("CAROM_AS_GPU", "1", 1);
	const struct CMUnitTest tests[] = {cmocka_unit_test(worlds_have_the_same_bits), cmocka_unit_test(pictures_have_the_same_bits)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
