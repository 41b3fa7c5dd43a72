/* Bodies that exactly fill the room they lie or fall in: nothing can move aside, and hits of what is wedged have no end. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "layout.h"
#include "runs.h"

#define HEIGHT 40.0f

static const char *const steps[] = {"events", "contacts"};

static carom_body_def body_at(bool box, float x, float y)
{
	static const carom_vec2 corners[4] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
	carom_body_def def = scenery_circle(x, y, 0.0f, 0.0f, 0.5f);
	if (box) {
		def.shape = CAROM_POLYGON;
		def.vertices = corners;
		def.vertex_count = 4;
	}
	return def;
}

/* Rows of bodies of 1 m, each one shorter than that below, on which they fall: what falls between two drives them apart, and cannot. What is hit as often as that is
 * held, and only that: a step takes no more hits than these do. Nothing sinks in, and nobody is thrown up. */
static void wedges_have_an_end(void **unused)
{
	(void)unused;
	enum { WIDTH = 4, ROWS = 3, MOST = WIDTH * ROWS };
	static const struct {
		int rows;
		bool boxes;
	} cases[] = {{1, false}, {1, true}, {2, false}, {3, false}, {3, true}};
	for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
		const bool borne = i % 2;
		const carom_world_def def = runs_resting(steps[borne], 0.5f * (float)WIDTH, HEIGHT);
		carom_body_def bodies[MOST];
		uint32_t count = 0;
		uint64_t first = 0;
		for (int row = 0; row < cases[i / 2].rows; row++)
			for (int k = 0; k < WIDTH - row; k++)
				bodies[count++] = body_at(cases[i / 2].boxes, (float)k + 0.5f * (float)(1 + row - WIDTH), 0.5f + 1.2f * (float)row);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, count);
			if (!world)
				continue;
			const double begun = runs_seconds();
			const carom_report report = runs_step(world, runs_affordable(60));
			if (device == scenery_devices)
				print_message("%s: %u bodies in %d rows, %llu hits in %llu steps, held %llu times, %.3g J left, %.2f s\n", steps[borne], count,
					cases[i / 2].rows, (unsigned long long)report.hits, (unsigned long long)report.steps, (unsigned long long)report.held,
					runs_measure(world).kinetic_energy, runs_seconds() - begun);
			assert_true(report.hits <= report.steps * count * (borne ? 4 * STUCK_BORNE : STUCK_MOST)); /* a shock has some at once */
			assert_true(runs_seconds() - begun < RUNS_SECONDS_MOST);
			for (uint32_t k = 0; k < count; k++)
				assert_true(runs_state(world, k).position.y < bodies[k].position.y + 0.01f);
			runs_near(runs_measure(world).max_penetration, 0.0, 40.0 * (double)SLOP);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What is wedged is in hits again and again, between forces that can't part it: it may lose by that, but not get faster from step to step. With the longest steps, in which
 * forces make most of a speed. */
static void what_is_wedged_gains_no_energy(void **unused)
{
	(void)unused;
	enum { SIDE = 4, COUNT = SIDE * SIDE };
	for (int i = 0; i < 4; i++) {
		carom_world_def def = runs_resting(steps[i % 2], 0.5f * (float)SIDE, HEIGHT);
		carom_body_def bodies[COUNT];
		uint64_t first = 0;
		def.time_step = 0.1f;
		def.restitution = 0.9f;
		for (uint32_t k = 0; k < COUNT; k++)
			bodies[k] = body_at(i / 2, (float)(k % SIDE) + 0.5f * (float)(1 - SIDE), 0.5f + 1.25f * (float)(k / SIDE));
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			double most = -HUGE_VAL;
			for (uint64_t k = 0; k < runs_affordable(i % 2 ? 80 : 10); k++) {
				runs_step(world, 1);
				const carom_measure after = runs_measure(world);
				most = fmax(most, (after.kinetic_energy + after.potential_energy) - (before.kinetic_energy + before.potential_energy));
			}
			if (device == scenery_devices)
				print_message("%s, %s: %.3g J gained at most\n", steps[i % 2], i / 2 ? "boxes" : "balls", most);
			assert_true(most < 0.01);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* How long boxes take that fall in a pipe `gap` wider than they are, between the room's walls or static bodies. */
static double seconds_of_pipe(const char *step, bool walls, float gap, const scenery_device *device, uint64_t *hash)
{
	enum { COUNT = 10 };
	const carom_world_def def = runs_resting(step, walls ? 0.5f + gap : 2.0f, HEIGHT);
	carom_body_def bodies[COUNT + 2];
	for (int k = 0; k < COUNT; k++)
		bodies[k] = body_at(true, 0.0f, 0.75f + 1.5f * (float)k);
	for (int k = 0; k < 2; k++) {
		bodies[COUNT + k] = scenery_box(k ? 1.0f + gap : -1.0f - gap, 0.5f * HEIGHT, 0.0f, 0.0f, 1.0f, HEIGHT - 1.0f);
		bodies[COUNT + k].is_static = true;
	}
	carom_world *world = runs_world(&def, device, bodies, walls ? COUNT : COUNT + 2);
	if (!world)
		return 0.0;
	const double begun = runs_seconds();
	runs_step(world, runs_affordable(60));
	const double seconds = runs_seconds() - begun;
	*hash = runs_hash(world);
	runs_near(runs_measure(world).max_penetration, 0.0, 40.0 * (double)SLOP);
	for (uint32_t k = 0; k < COUNT; k++)
		runs_near((double)runs_state(world, k).position.x, 0.0, 1.1 * (double)gap + 40.0 * (double)SLOP);
	carom_world_destroy(world);
	return seconds;
}

/* What slides along two walls at once is at both all the way, and not looked at all the way. */
static void what_fills_a_pipe_falls(void **unused)
{
	(void)unused;
	for (int i = 0; i < 4; i++) {
		const bool walls = i % 2;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			uint64_t hash = 0;
			const double wide = seconds_of_pipe(steps[i / 2], walls, 0.1f, device, &hash),
						 tight = seconds_of_pipe(steps[i / 2], walls, 0.0f, device, &hash);
			if (!hash)
				continue;
			print_message("%s, %s: %.4f s, in a wide pipe %.4f s\n", steps[i / 2], walls ? "walls" : "static bodies", tight, wide);
			assert_true(tight < 20.0 * wide || tight < 0.025 * RUNS_SECONDS_MOST); /* so short a time is the machine's to say */
			runs_same_hash(&first, hash, device);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(wedges_have_an_end), cmocka_unit_test(what_is_wedged_gains_no_energy), cmocka_unit_test(what_fills_a_pipe_falls)};
	return cmocka_run_group_tests_name("tight", tests, NULL, NULL);
}
