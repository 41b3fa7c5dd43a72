/* Crowds under the step events keep their energy and momentum and don't overlap; and worlds that are changed between calls. On every device. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "runs.h"
#include "world.h"

/* Bodies on a lattice, `pitch` from middle to middle. */
static void fill_at(scenery_random *random, scenery_shapes shapes, int side, float radius, float pitch, float speed, carom_body_def *bodies)
{
	for (int i = 0; i < side * side; i++) {
		const float vy = scenery_uniform(random, -speed, speed), vx = scenery_uniform(random, -speed, speed);
		const float middle = 0.5f * (float)(side - 1);
		carom_body_def def = scenery_circle(pitch * ((float)(i % side) - middle), pitch * ((float)(i / side) - middle), vx, vy, radius);
		if (shapes == SCENERY_POLYGONS || (shapes == SCENERY_MIXED && i % 2)) {
			def.shape = CAROM_REGULAR;
			def.sides = shapes == SCENERY_POLYGONS ? 3 : 3 + (uint32_t)(i / 2) % 4;
			def.angle = scenery_uniform(random, -3.0f, 3.0f);
			def.angular_velocity = scenery_uniform(random, -speed, speed);
		}
		bodies[i] = def;
	}
}

/* Nearly two fifths of the area are filled by discs, less by triangles, which could not be placed closer blindly. */
static void fill(scenery_random *random, scenery_shapes shapes, int side, float radius, float speed, carom_body_def *bodies)
{
	const float pitch = shapes == SCENERY_CIRCLES ? 2.8f * radius : 2.1f * radius; /* pi / 2.8^2 = 0.40, 1.3 / 2.1^2 = 0.29 */
	fill_at(random, shapes, side, radius, pitch, speed, bodies);
}

/* What 200 steps may cost, with a margin of three over what was seen: 1.6e-6 of the energy, 1.3e-8 of the momentum there is (the sum of all |m v|). */
#define ENERGY_KEPT 5e-6
#define MOMENTUM_KEPT 4e-8

static double impulse_of(carom_world *world)
{
	double sum = 0.0;
	for (uint32_t i = 0; i < carom_world_body_count(world); i++) {
		carom_body_info info;
		carom_error error;
		const carom_body_state s = runs_state(world, i);
		scenery_check(carom_world_get_body(world, i, &info, &error), &error);
		sum += (double)info.mass * hypot((double)s.velocity.x, (double)s.velocity.y);
	}
	return sum;
}

static void crowd(scenery_shapes shapes, bool has_room, const scenery_device *device, uint64_t *first)
{
	enum { SIDE = 16, COUNT = SIDE * SIDE };
	static carom_body_def bodies[COUNT];
	scenery_random random = {9};
	fill(&random, shapes, SIDE, 0.4f, 3.0f, bodies);
	const float half = 0.4f * (shapes == SCENERY_CIRCLES ? 1.4f : 1.05f) * (float)SIDE + 0.05f;
	const carom_world_def def = has_room ? runs_room(half, half) : runs_def();
	for (int i = 0; i < COUNT && !has_room; i++) { /* towards the middle, so that much is hit */
		bodies[i].velocity.x -= bodies[i].position.x;
		bodies[i].velocity.y -= bodies[i].position.y;
	}
	carom_world *world = runs_world(&def, device, bodies, COUNT);
	if (!world)
		return;
	const carom_measure before = runs_measure(world);
	const double impulse = impulse_of(world);
	const carom_report report = runs_step(world, runs_affordable(200));
	const carom_measure after = runs_measure(world);
	const double energy = after.kinetic_energy / before.kinetic_energy - 1.0;
	const double momentum = hypot(after.momentum_x - before.momentum_x, after.momentum_y - before.momentum_y) / impulse;
	print_message("%llu hits, energy %+.2g, momentum %.2g, %.2g m deep\n", (unsigned long long)report.hits, energy, has_room ? 0.0 : momentum,
		after.max_penetration);
	runs_enough(report.hits > 500);
	assert_true(report.held == 0);
	runs_near(energy, 0.0, ENERGY_KEPT);
	if (!has_room)
		runs_near(momentum, 0.0, MOMENTUM_KEPT);
	runs_near(after.max_penetration, 0.0, (has_room ? 11.0 : 40.0) * (double)SLOP); /* CONTRACT's slop: bodies that near touch */
	runs_same_hash(first, runs_hash(world), device);
	carom_world_destroy(world);
}

static void crowds_keep_energy_and_momentum(void **unused)
{
	(void)unused;
	for (int shapes = SCENERY_MIXED; shapes <= SCENERY_POLYGONS; shapes++) {
		for (int has_room = 0; has_room < 2; has_room++) {
			uint64_t first = 0;
			SCENERY_EACH_DEVICE(device)
				crowd((scenery_shapes)shapes, has_room, device, &first);
		}
	}
}

static void twenty_thousand_circles(void **unused)
{
	(void)unused;
	enum { SIDE = 142, COUNT = SIDE * SIDE };
	carom_body_def *bodies = calloc(COUNT, sizeof *bodies);
	const carom_world_def def = runs_room(100.0f, 100.0f);
	scenery_random random = {4};
	uint64_t first = 0, hits = 0;
	assert_non_null(bodies);
	fill(&random, SCENERY_CIRCLES, SIDE, 0.4f, 5.0f, bodies);
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		const double begun = runs_seconds();
		const carom_report report = runs_step(world, runs_affordable(20));
		print_message("%llu hits in %.2f s\n", (unsigned long long)report.hits, runs_seconds() - begun);
		runs_enough(report.hits > 5000);
		assert_true(hits == 0 || report.hits == hits);
		hits = report.hits;
		runs_near(runs_measure(world).max_penetration, 0.0, 101.0 * (double)SLOP);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
	free(bodies);
}

/* ---- Slices of a step */

/* Whatever falls, and lies in the end, in a room: the same hits, with their order and impulses, whether clusters fall apart within a step or not. */
static void slices_change_no_bit(void **unused)
{
	(void)unused;
	static const char *const steps[] = {"events", "contacts"};
	static const uint32_t slices[] = {1, 2, 5, SLICES_MOST};
	enum { SIDE = 12, COUNT = SIDE * SIDE };
	carom_body_def bodies[COUNT];
	scenery_random random = {6};
	fill_at(&random, SCENERY_MIXED, SIDE, 0.4f, 0.85f, 3.0f, bodies);
	for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
		carom_world_def def = runs_room(16.0f, 16.0f);
		uint64_t first = 0;
		carom_hit *hits = NULL;
		size_t hit_count = 0;
		def.gravity.y = -10.0f;
		def.restitution = 0.5f;
		def.keep_hits = true;
		assert_int_equal(carom_pipeline_set(&def.pipeline, "step", steps[i], NULL), CAROM_OK);
		SCENERY_EACH_DEVICE(device) {
			for (size_t k = 0; k < sizeof slices / sizeof *slices; k++) {
				carom_world *world = runs_world(&def, device, bodies, COUNT);
				if (!world)
					continue;
				runs_step(world, 1);
				world->events.slices = slices[k];
				size_t count;
				const carom_report report = runs_step(world, 20);
				carom_hit *now = runs_hits(world, &count);
				assert_true(world->events.saves || slices[k] == 1);
				assert_true(report.hits > 500 && report.hits == count);
				runs_same_hits(&hits, &hit_count, now, count);
				runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
		free(hits);
	}
}

/* A ball at rest is hit as the step begins, gets beyond its reach in a later slice, and there hits one of which it did not know; beside many that rest, so that reaches are short. */
static void what_leaves_its_reach_late_misses_nothing(void **unused)
{
	(void)unused;
	enum { SIDE = 10, COUNT = SIDE * SIDE + 3 };
	carom_body_def bodies[COUNT];
	scenery_random random = {8};
	carom_hit *hits = NULL;
	size_t hit_count = 0;
	carom_world_def def = runs_def();
	def.time_step = 0.1f;
	def.keep_hits = true;
	fill_at(&random, SCENERY_CIRCLES, SIDE, 0.5f, 3.0f, 0.01f, bodies);
	bodies[COUNT - 3] = scenery_circle(-11.5f, 40.0f, 100.0f, 0.0f, 0.5f);
	bodies[COUNT - 2] = scenery_circle(0.0f, 40.0f, 0.0f, 0.0f, 0.5f);
	bodies[COUNT - 1] = scenery_circle(7.0f, 40.0f, 0.0f, 0.0f, 0.5f);
	SCENERY_EACH_DEVICE(device) {
		for (uint32_t slices = 1; slices <= SLICES_MOST; slices *= 4) {
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			assert_int_equal(runs_step(world, 1).hits, 0);
			world->events.slices = slices;
			assert_int_equal(runs_step(world, 1).hits, 2);
			assert_true(world->events.saves || slices == 1);
			size_t count;
			carom_hit *now = runs_hits(world, &count);
			runs_same_hits(&hits, &hit_count, now, count);
			carom_world_destroy(world);
		}
	}
	free(hits);
}

/* Where most of a step's work would be lost it gets slices by itself, and none where it is not crowded. */
static void crowded_steps_get_slices(void **unused)
{
	(void)unused;
	enum { SIDE = 40, COUNT = SIDE * SIDE };
	static const float pitches[] = {0.82f, 2.0f}; /* 0.75 and 0.13 of the area */
	carom_body_def *bodies = calloc(COUNT, sizeof *bodies);
	assert_non_null(bodies);
	for (size_t i = 0; i < sizeof pitches / sizeof *pitches; i++) {
		const carom_world_def def = runs_room((float)SIDE * pitches[i] + 0.1f, (float)SIDE * pitches[i] + 0.1f);
		scenery_random random = {7};
		uint64_t first = 0;
		fill_at(&random, SCENERY_CIRCLES, SIDE, 0.4f, pitches[i], 5.0f, bodies);
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			const carom_report report = runs_step(world, 16);
			print_message("%llu hits, %u slices\n", (unsigned long long)report.hits, world->events.slices);
			assert_true(world->events.saves == (i == 0));
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
	free(bodies);
}

/* ---- Worlds that are changed */

static void little_or_nothing_in_a_room(void **unused)
{
	(void)unused;
	carom_world_def def = runs_room(1.0f, 1.0f);
	const carom_body_def ball = scenery_circle(0.0f, 0.0f, 1.0f, 0.0f, 0.5f), still = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
	carom_error error;
	def.time_step = 0.25f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, NULL, 0);
		if (!world)
			continue;
		assert_int_equal(runs_step(world, 100).steps, 0);
		scenery_check(carom_world_add(world, &ball, 1, NULL, &error), &error);
		assert_int_equal(runs_advance(world, 10.0).hits, 10); /* at 0.5 s, 1.5 s, ... */
		runs_near((double)runs_state(world, 0).position.x, 0.0, 1e-5);
		carom_world_destroy(world);
		world = runs_world(&def, device, &still, 1);
		assert_int_equal(runs_step(world, 100).hits, 0);
		carom_world_destroy(world);
	}
}

static void copy_body(carom_world *from, uint32_t index, carom_body_def *def)
{
	const carom_body_state s = runs_state(from, index);
	def->position = s.position;
	def->velocity = s.velocity;
	def->angle = s.angle;
	def->angular_velocity = s.angular_velocity;
}

/* States set and bodies added between calls give what a new world with these bodies gives: nothing of what was known before stays. */
static void changed_worlds_are_as_new_ones(void **unused)
{
	(void)unused;
	enum { COUNT = 100, MORE = 40 };
	carom_body_def bodies[COUNT + MORE];
	carom_world_def def = runs_room(8.0f, 8.0f);
	scenery_random random = {17};
	carom_error error;
	scenery_bodies(&random, SCENERY_MIXED, COUNT + MORE, 1.2f, 3.0f, bodies);
	def.gravity.y = -1.0f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		carom_body_def now[COUNT + MORE];
		runs_step(world, 20);
		for (uint32_t i = 0; i < COUNT + MORE; i++) {
			now[i] = bodies[i];
			now[i].position.x *= 0.97f; /* elsewhere: what is near whom has changed */
			if (i < COUNT) {
				const carom_body_state s = {now[i].position, now[i].angle, {-now[i].velocity.x, now[i].velocity.y}, now[i].angular_velocity};
				scenery_check(carom_world_set_states(world, i, 1, &s, &error), &error);
				copy_body(world, i, &now[i]);
			}
		}
		scenery_check(carom_world_add(world, now + COUNT, MORE, NULL, &error), &error);
		carom_world *fresh = runs_world(&def, device, now, COUNT + MORE);
		assert_int_equal(runs_step(world, 30).hits, runs_step(fresh, 30).hits);
		assert_true(runs_hash(world) == runs_hash(fresh));
		carom_world_destroy(fresh);
		carom_world_destroy(world);
	}
}

/* A rod that falls upright onto a wall: the two points of its end are so near each other that each alone counts the push twice. The paper's impulse sends it
 * back faster than it came; of events it adds nothing. */
static void accumulate_adds_no_energy_to_events(void **unused)
{
	(void)unused;
	const carom_body_def rod = scenery_box(0.0f, 0.0f, 0.0f, -2.0f, 0.2f, 1.0f);
	const double levers = 0.1 * 0.1 * 12.0 / (0.2 * 0.2 + 1.0), paper = 4.0 / (1.0 + levers) - 1.0; /* each point gives 2 / (1 + m b^2 / I) */
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_room(5.0f, 1.0f);
		def.pipeline.impulse = "accumulate";
		carom_world *world = runs_world(&def, device, &rod, 1);
		if (!world)
			continue;
		const double before = runs_measure(world).kinetic_energy;
		assert_int_equal(runs_step(world, 20).hits, 1);
		runs_near(runs_measure(world).kinetic_energy / before, 1.0, 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
		def.pipeline.step = "first_impact";
		world = runs_world(&def, device, &rod, 1);
		assert_int_equal(runs_step(world, 20).hits, 1);
		runs_near((double)runs_state(world, 0).velocity.y, 2.0 * paper, 1e-4);
		carom_world_destroy(world);
	}
}

/* Faces that meet in a short piece alone: both its ends push, and energy and momentum stay to rounding, however short it is. */
static void narrow_faces_keep_energy(void **unused)
{
	enum { COUNT = 12 };
	static const float widths[] = {0.2f, 0.05f, 0.01f, 0.005f, 0.001f, 0.0003f};
	static const char *const steps[] = {"events", "first_impact"};
	(void)unused;
	for (size_t i = 0; i < 2 * sizeof widths / sizeof *widths; i++) {
		const float width = widths[i / 2];
		carom_world_def def = runs_def();
		carom_body_def bodies[2 * COUNT];
		scenery_random random = {5};
		uint64_t first = 0;
		def.pipeline.step = steps[i % 2];
		for (int k = 0; k < COUNT; k++) { /* rods that stand on others, boxes that pass each other but for so much */
			const float x = 4.0f * (float)k - 24.0f, speed = scenery_uniform(&random, 1.0f, 3.0f);
			bodies[2 * k] = k % 2 ? scenery_box(x, 0.0f, 0.0f, speed, width, 1.0f) : scenery_box(x, 0.0f, 0.0f, speed, 1.0f, 1.0f);
			bodies[2 * k + 1] = k % 2 ? scenery_box(x, 1.2f, 0.0f, -1.0f, width, 1.0f) : scenery_box(x + 1.0f - width, 1.2f, 0.0f, -1.0f, 1.0f, 1.0f);
		}
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, 2 * COUNT);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			assert_int_equal(runs_advance(world, 0.25).hits, COUNT);
			const carom_measure after = runs_measure(world);
			runs_near(after.kinetic_energy / before.kinetic_energy, 1.0, 1e-6);
			runs_near(after.momentum_y, before.momentum_y, 1e-5);
			runs_near((double)runs_state(world, 2).angular_velocity, 0.0, 0.0);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* So many pairs that an int can't count their places in lists. */
static void a_throng_is_a_limit(void **unused)
{
	enum { COUNT = 36000 };
	static carom_body_def bodies[COUNT];
	const carom_world_def def = runs_def();
	(void)unused;
	for (int i = 0; i < COUNT; i++)
		bodies[i] = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.1f);
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		carom_error error;
		if (!world)
			continue;
		assert_int_equal(carom_world_step(world, 1, NULL, &error), CAROM_LIMIT);
		assert_non_null(strstr(error.text, "pairs of the 36000 bodies"));
		assert_true(runs_state(world, COUNT - 1).position.x == 0.0f);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(crowds_keep_energy_and_momentum), cmocka_unit_test(twenty_thousand_circles),
		cmocka_unit_test(little_or_nothing_in_a_room), cmocka_unit_test(changed_worlds_are_as_new_ones), cmocka_unit_test(slices_change_no_bit),
		cmocka_unit_test(what_leaves_its_reach_late_misses_nothing), cmocka_unit_test(crowded_steps_get_slices),
		cmocka_unit_test(accumulate_adds_no_energy_to_events), cmocka_unit_test(narrow_faces_keep_energy), cmocka_unit_test(a_throng_is_a_limit)};
	return cmocka_run_group_tests_name("events_crowds", tests, NULL, NULL);
}
