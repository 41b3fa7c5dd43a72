/* The step events where hits would have no end: collapse, rest, what is squeezed. And crowds that must keep what they have. On every device. */
#include <math.h>

#include "layout.h"
#include "runs.h"
#include "wild.h"

#define GRAVITY 10.0

static carom_body_def fixed(carom_body_def def)
{
	def.is_static = true;
	return def;
}

static void nothing_overlaps(carom_world *world, double size)
{
	runs_near(runs_measure(world).max_penetration, 0.0, size * (double)SLOP);
}

/* Steps one by one: energy grows by no more than rounding, and by the speed that CONTRACT gives in a microcollision, MICRO of what
 * gravity makes in a step: half of it squared for each hit, of a body of `mass` at most. */
static carom_report run_down(carom_world *world, uint64_t steps, double mass)
{
	const double micro = (double)MICRO * GRAVITY * (double)carom_world_get_def(world)->time_step, begun = runs_seconds();
	carom_report sum = {0};
	double energy = runs_energy(world);
	const double scale = fabs(energy) + mass * GRAVITY;
	for (uint64_t i = 0; i < steps; i++) {
		const carom_report report = runs_step(world, 1);
		const double now = runs_energy(world), allowed = 0.5 * mass * micro * micro * (double)report.hits + 1e-5 * scale;
		if (!(now - energy <= allowed))
			fail_msg("step %llu: energy grew from %.9g to %.9g J, allowed are %.3g", (unsigned long long)i, energy, now, allowed);
		energy = now;
		sum.hits += report.hits;
		sum.ruled += report.ruled;
		sum.held += report.held;
	}
	assert_true(runs_seconds() - begun < RUNS_SECONDS_MOST);
	return sum;
}

/* ---- Rest */

/* A ball or a box on the floor of a room or on a static body, with restitution 0.5 and 0: it lies there in the end. */
static void bodies_come_to_rest(void **unused)
{
	(void)unused;
	for (int kind = 0; kind < 8; kind++) {
		carom_world_def def = kind & 1 ? runs_room(5.0f, 5.0f) : runs_def();
		const carom_body_def body = kind & 2 ? scenery_box(0.0f, -3.0f, 0.0f, 0.0f, 1.0f, 1.0f) : scenery_circle(0.0f, -3.0f, 0.0f, 0.0f, 0.5f);
		const carom_body_def bodies[2] = {body, fixed(scenery_box(0.0f, -5.5f, 0.0f, 0.0f, 8.0f, 1.0f))};
		def.gravity.y = -(float)GRAVITY;
		def.restitution = kind & 4 ? 0.0f : 0.5f;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, kind & 1 ? 1 : 2);
			if (!world)
				continue;
			const carom_report sum = run_down(world, 180, 1.0);
			const carom_body_state state = runs_state(world, 0);
			/* a bounce of a microcollision is v^2 / 2 g high, and a hit may be a slop early */
			const double micro = (double)MICRO * GRAVITY / 60.0, high = micro * micro / (2.0 * GRAVITY) + 12.0 * (double)SLOP;
			runs_near((double)state.position.y, -4.5 + 0.5 * high, 0.5 * high + 5.5 * (double)SLOP);
			runs_near((double)state.velocity.y, 0.0, 2.0 * micro);
			runs_near((double)state.angular_velocity, 0.0, 1e-2);
			assert_true(sum.hits > 1 && sum.ruled > 0 && sum.held == 0);
			nothing_overlaps(world, 12.0);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* With restitution 0 what falls on a ball that rests is not thrown back, though the ball has been in rapid hits before, and is in more now. */
static void what_falls_on_a_resting_ball_stays(void **unused)
{
	(void)unused;
	static const float masses[] = {1.0f, 10.0f, 100.0f};
	SCENERY_EACH_DEVICE(device) {
		for (size_t i = 0; i < sizeof masses / sizeof *masses; i++) {
			carom_world_def def = runs_room(5.0f, 5.0f);
			carom_body_def bodies[2] = {scenery_circle(0.0f, -4.4f, 0.0f, 0.0f, 0.5f), scenery_circle(0.0f, -2.4f, 0.0f, 0.0f, 0.5f)};
			def.gravity.y = -(float)GRAVITY;
			def.restitution = 0.0f;
			bodies[0].mass = 1.0f;
			bodies[1].mass = masses[i];
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				break;
			for (int k = 0; k < 60; k++) {
				runs_step(world, 1);
				assert_true(runs_state(world, 1).velocity.y < 0.05f);
			}
			runs_near((double)runs_state(world, 1).position.y, -3.5, 1e-3);
			nothing_overlaps(world, 5.0);
			carom_world_destroy(world);
		}
	}
}

/* 1e-5 m of room on either side: slow, as many hits as the way has; fast, too many: it is held, and stays between the two. */
static void squeezed_ball(void **unused)
{
	(void)unused;
	static const struct {
		float speed, restitution;
		bool is_held;
	} cases[] = {{1.0f, 1.0f, false}, {100.0f, 1.0f, true}, {100.0f, 0.5f, false}, {100.0f, 0.0f, false}};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		carom_world_def def = runs_def();
		const carom_body_def bodies[3] = {scenery_circle(0.0f, 0.0f, cases[i].speed, 0.0f, 0.5f),
			fixed(scenery_box(1.00001f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f)), fixed(scenery_box(-1.00001f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f))};
		def.restitution = cases[i].restitution;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, 3);
			if (!world)
				continue;
			const carom_report sum = run_down(world, 10, 1.0);
			print_message("speed %g, restitution %g: %llu hits, held %llu times\n", (double)cases[i].speed, (double)cases[i].restitution,
				(unsigned long long)sum.hits, (unsigned long long)sum.held);
			assert_true((sum.held > 0) == cases[i].is_held);
			assert_true(fabs((double)runs_state(world, 0).position.x) < 1e-5 + 3.0 * (double)SLOP);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A ball that is held falls no more, though the one that bounces on it does: that comes down on it once more in the same step, before it gets to the wall, and before
 * another hits the held one from below. */
static void what_is_held_does_not_fall(void **unused)
{
	(void)unused;
	enum { COUNT = 5 };
	for (int order = 0; order < 2; order++) {
		carom_world_def def = runs_room(0.65f, 5.0f);
		const carom_body_def balls[2] = {scenery_circle(0.0f, 1.02f, 0.5f, -1.0f, 0.5f), scenery_circle(0.0f, -2.0f, 0.0f, 4.68f, 0.5f)};
		const carom_body_def bodies[COUNT] = {balls[order], scenery_circle(0.0f, 0.0f, 100.0f, 0.0f, 0.5f), balls[1 - order],
			fixed(scenery_box(0.55001f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f)), fixed(scenery_box(-0.55001f, 0.0f, 0.0f, 0.0f, 0.1f, 1.0f))};
		def.gravity.y = -(float)GRAVITY;
		def.time_step = 0.35f;
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			assert_int_equal(runs_step(world, 1).held, 1);
			assert_true(runs_state(world, 2 * (uint32_t)order).position.y > runs_state(world, 1).position.y + 0.9f);
			assert_true(runs_state(world, 2 * (uint32_t)order).velocity.y > -0.5f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Fifty balls in a row are run into by a heavy one: inelastic collapse. Momentum stays, energy goes. */
static void row_collapses(void **unused)
{
	(void)unused;
	enum { COUNT = 50 };
	static const float restitutions[] = {0.0f, 0.2f, 0.5f, 0.9f};
	for (int i = 0; i < 4; i++) {
		carom_world_def def = runs_def();
		carom_body_def bodies[COUNT];
		uint64_t first = 0;
		for (int k = 0; k < COUNT; k++)
			bodies[k] = scenery_circle((float)k * 1.01f, 0.0f, k == 0 ? 5.0f : 0.0f, 0.0f, 0.5f);
		bodies[0].mass = 50.0f;
		def.restitution = restitutions[i];
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			const carom_report sum = run_down(world, runs_affordable(120), 50.0);
			print_message("restitution %g: %llu hits, held %llu times\n", (double)restitutions[i], (unsigned long long)sum.hits,
				(unsigned long long)sum.held);
			runs_near(runs_measure(world).momentum_x / before.momentum_x, 1.0, 1e-5);
			for (uint32_t k = 1; k < COUNT; k++)
				assert_true(runs_state(world, k).position.x > runs_state(world, k - 1).position.x + 0.99f);
			runs_near(runs_measure(world).max_penetration, 0.0, 70.0 * 2.0 * (double)SLOP);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What stays together after a hit moves alike. It does not hit any more, but each step rounds places by half a unit, often the same way again and again: without a rule
 * for what is sunk, squares are a centimetre deep in each other after two thousand steps. */
static void what_moves_alike_does_not_sink(void **unused)
{
	(void)unused;
	static const char *const steps[] = {"events", "first_impact"};
	for (int kind = 0; kind < 10; kind++) {
		const bool at_wall = kind >= 8;
		carom_world_def def = at_wall ? runs_room(45.0f, 45.0f) : runs_def();
		const float vy = kind & 4 ? 1.234f : 0.0f;
		const carom_body_def first = kind & 1 ? scenery_box(-40.0f, -20.0f, 3.3f, vy, 0.7f, 0.7f) : scenery_circle(-40.0f, -20.0f, 3.3f, vy, 0.5f);
		const carom_body_def second = kind & 2 ? scenery_box(-38.9f, -19.9f, 0.0f, vy, 0.7f, 0.7f) : scenery_circle(-38.9f, -19.9f, 0.0f, vy, 0.5f);
		carom_body_def bodies[2] = {first, second};
		def.restitution = 0.0f;
		if (at_wall) { /* each runs into it, and then along it */
			bodies[0].velocity = (carom_vec2){-7.7f, 1.1f};
			bodies[1].velocity = (carom_vec2){-7.7f, 2.2f};
		}
		bodies[0].mass = 5.0f;
		for (int i = 0; i < 2; i++) {
			uint64_t hash = 0;
			def.pipeline.step = steps[i];
			SCENERY_EACH_DEVICE(device) {
				carom_world *world = runs_world(&def, device, bodies, 2);
				uint64_t hits = 0;
				if (!world)
					continue;
				for (int k = 0; k < 10; k++) {
					hits += runs_step(world, runs_affordable(100)).hits;
					nothing_overlaps(world, 2.0 * 48.0);
				}
				runs_enough(hits > 0);
				runs_same_hash(&hash, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

/* Turning polygons with restitution 0 that stay together press on each other because they turn. They part as slowly as rounding can tell, come back at once, and so
 * on: four thousand times a step, were they not driven apart faster each time. */
static void what_turns_together_has_an_end(void **unused)
{
	(void)unused;
	static wild_world wild;
	uint64_t first = 0;
	wild_make_wider(6043, &wild);
	wild.def.friction = 0.0f;
	assert_true(wild.def.gravity.y == 0.0f && wild.def.restitution == 0.0f && !wild.def.has_room);
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&wild.def, device, wild.bodies, wild.count);
		if (!world)
			continue;
		const carom_report sum = runs_step(world, runs_affordable(60));
		assert_true(sum.hits < 15000 && sum.held == 0);
		nothing_overlaps(world, 50.0);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A column of balls or boxes stands on the floor. What is at the bottom bears all the others: without the rule for crowds a ball is in a thousand hits a step, and
 * with it in some hundred. The column hops: its top is less than a millimetre too high on average, and hardly ever more. */
static void column_stands(void **unused)
{
	(void)unused;
	enum { COUNT = 50 };
	for (int boxes = 0; boxes < 2; boxes++) {
		const uint32_t count = boxes ? COUNT / 5 : COUNT;
		carom_world_def def = runs_room(5.0f, 50.0f);
		carom_body_def bodies[COUNT];
		uint64_t first = 0;
		for (uint32_t k = 0; k < count; k++) {
			const float y = -49.5f + (float)k * 1.001f;
			bodies[k] = boxes ? scenery_box(0.0f, y, 0.0f, 0.0f, 1.0f, 1.0f) : scenery_circle(0.0f, y, 0.0f, 0.0f, 0.5f);
		}
		def.gravity.y = -(float)GRAVITY;
		def.restitution = 0.3f;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, count);
			if (!world)
				continue;
			double height = 0.0;
			runs_step(world, 20);
			for (int k = 0; k < 10; k++) {
				const carom_report report = runs_step(world, 2);
				assert_true(report.hits > 0 && report.hits < (uint64_t)2 * 150 * count && report.held == 0);
				const double top = (double)runs_state(world, count - 1).position.y;
				runs_near(top, -49.5 + (double)(count - 1), 2e-3);
				height += 0.1 * top;
				nothing_overlaps(world, 50.0);
			}
			runs_near(height, -49.5 + (double)(count - 1), 1e-3);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Three simulated seconds of bodies that fall onto one another: nobody leaves the room or sinks in, and they do come to rest. */
static void small_heap(void **unused)
{
	(void)unused;
	enum { COUNT = 30 };
	for (int shapes = SCENERY_MIXED; shapes <= SCENERY_POLYGONS; shapes++) {
		carom_world_def def = runs_room(3.0f, 4.0f);
		carom_body_def bodies[COUNT];
		scenery_random random = {21};
		uint64_t first = 0;
		scenery_bodies(&random, (scenery_shapes)shapes, COUNT, 0.9f, 1.0f, bodies);
		for (int i = 0; i < COUNT; i++) {
			bodies[i].is_static = false;
			bodies[i].radius *= 0.7f;
			bodies[i].density = 1.0f;
		}
		def.gravity.y = -(float)GRAVITY;
		def.restitution = 0.3f;
		SCENERY_EACH_DEVICE(device) {
			if (device->storage == CAROM_STORAGE_IMAGE || (device->storage == CAROM_STORAGE_BUFFER && shapes != SCENERY_MIXED))
				continue; /* it takes long, and other tests compare bits */
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			const double begun = runs_seconds();
			const carom_report sum = run_down(world, runs_affordable(180), 0.5);
			const carom_measure measure = runs_measure(world);
			print_message("heap: %llu hits, held %llu times, %.3g J left, %.3g m deep, %.2f s\n", (unsigned long long)sum.hits,
				(unsigned long long)sum.held, measure.kinetic_energy, measure.max_penetration, runs_seconds() - begun);
			assert_int_equal(sum.held, 0);
			nothing_overlaps(world, 5.0);
			runs_enough(measure.kinetic_energy < 0.5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What hardly moves any more, since friction took all but rounding of it: no impulse could be told from 0. */
static void what_hardly_moves_is_still(void **unused)
{
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	(void)unused;
	for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
		carom_world_def def = runs_def();
		carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 2.0f, 2.0f), scenery_box(0.3f, 2.0f, 1.8e-41f, -1.8e-41f, 2.0f, 2.0f)};
		uint64_t first = 0;
		bodies[0].is_static = true;
		bodies[1].angular_velocity = 4.7e-41f;
		def.restitution = def.friction = 0.5f;
		def.pipeline.step = steps[i];
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			const carom_report report = runs_step(world, 10);
			assert_true(report.steps == 10 && report.hits == 0 && report.held == 0);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(bodies_come_to_rest), cmocka_unit_test(what_falls_on_a_resting_ball_stays),
		cmocka_unit_test(squeezed_ball), cmocka_unit_test(what_is_held_does_not_fall), cmocka_unit_test(row_collapses),
		cmocka_unit_test(what_moves_alike_does_not_sink), cmocka_unit_test(what_turns_together_has_an_end), cmocka_unit_test(column_stands),
		cmocka_unit_test(small_heap), cmocka_unit_test(what_hardly_moves_is_still)};
	return cmocka_run_group_tests_name("events_rest", tests, NULL, NULL);
}
