/* The step events at its limits: speed, size, number, and hits that come one upon the other. On every device. */
#include <math.h>
#include <stdlib.h>

#include "forecast.h"
#include "layout.h"
#include "runs.h"
#include "world.h"

static carom_body_def fixed(carom_body_def def)
{
	def.is_static = true;
	return def;
}

static carom_body_def weighing(carom_body_def def, float mass)
{
	def.mass = mass;
	return def;
}

/* Nothing is deeper in anything than the slop, within which CONTRACT lets bodies touch: it is told by coordinates and radii of at most `size`. */
static void nothing_overlaps(carom_world *world, double size)
{
	runs_near(runs_measure(world).max_penetration, 0.0, size * (double)SLOP);
}

/* ---- Speed */

/* 1,000 m/s against a wall of 1 mm, and against another body coming at it. */
static void fast_bodies_hit(void **unused)
{
	(void)unused;
	const carom_world_def def = runs_def();
	const carom_body_def bodies[6] = {scenery_circle(-3.0f, 0.0f, 1000.0f, 0.0f, 0.05f), fixed(scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.001f, 2.0f)),
		scenery_circle(-3.0f, 5.0f, 1000.0f, 0.0f, 0.05f), scenery_circle(3.0f, 5.0f, -1000.0f, 0.0f, 0.05f),
		scenery_box(-3.0f, 9.0f, 1000.0f, 0.0f, 0.1f, 0.1f), scenery_box(3.0f, 9.0f, -1000.0f, 0.0f, 0.1f, 0.1f)};
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, 6);
		if (!world)
			continue;
		assert_int_equal(runs_step(world, 1).hits, 3);
		for (uint32_t i = 0; i < 6; i++)
			runs_near((double)runs_state(world, i).velocity.x, -(double)bodies[i].velocity.x, 2e-2);
		runs_near((double)runs_state(world, 0).position.x, -(1000.0 / 60.0 - 2.0 * (3.0 - 0.0505)) - 3.0 + 0.0, 1e-2);
		carom_world_destroy(world);
	}
}

/* A ball of a long row comes at 35,000 m/s, and the others rest: in one step each gets farther than it was looked for, one after the other. */
static void a_blow_goes_through_a_row(void **unused)
{
	enum { COUNT = 1000 };
	static carom_body_def bodies[COUNT];
	const float speed = 35000.0f;
	const carom_world_def def = runs_def();
	uint64_t first = 0;
	(void)unused;
	for (int i = 0; i < COUNT; i++) /* the fast one is the second in the list: not among those from which it is estimated how fast they are */
		bodies[i ^ 1] = scenery_circle(0.5f * (float)i, 0.0f, i ? 0.0f : speed, 0.0f, 0.1f);
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		assert_int_equal(runs_step(world, 1).hits, COUNT - 1);
		for (uint32_t i = 0; i < COUNT; i++)
			runs_near((double)runs_state(world, i).velocity.x, i == COUNT - 2 ? (double)speed : 0.0, 1e-3);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A ball at 100 m/s among 6,400 that rest and are a ten-thousandth of its mass: those it hits are twice as fast, and hit others. */
static void a_shot_scatters_many(void **unused)
{
	enum { SIDE = 80, COUNT = SIDE * SIDE + 1 };
	static carom_body_def bodies[COUNT];
	const carom_world_def def = runs_room(25.0f, 25.0f);
	uint64_t first = 0;
	(void)unused;
	bodies[0] = weighing(scenery_circle(-16.5f, 0.0f, 100.0f, 0.0f, 1.0f), 10.0f);
	for (int i = 1; i < COUNT; i++) {
		const int column = (i - 1) % SIDE, row = (i - 1) / SIDE;
		bodies[i] = weighing(scenery_circle(-15.0f + 0.3f * (float)column, 0.3f * (float)(row - SIDE / 2), 0.0f, 0.0f, 0.1f), 0.001f);
	}
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		const carom_measure before = runs_measure(world);
		assert_true(runs_step(world, 3).hits > 500);
		runs_near(runs_measure(world).kinetic_energy, before.kinetic_energy, 1e-5 * before.kinetic_energy);
		runs_near(runs_measure(world).momentum_x, before.momentum_x, 1e-5 * before.momentum_x);
		nothing_overlaps(world, 40.0);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Many times in one step between two walls of 1 mm: 0.95 m to the first, then 1.9 m each. A disc, and for a shorter time a box:
 * what rounding turns it by, every hit multiplies. */
static void fast_body_between_walls(void **unused)
{
	(void)unused;
	static const struct {
		float seconds;
		uint64_t hits;
	} cases[] = {{0.25f, 132}, {0.0045f, 2}}; /* (250 - 0.95) / 1.9 = 131.08, (4.5 - 0.95) / 1.9 = 1.87 */
	for (int shape = 0; shape < 2; shape++) {
		carom_world_def def = runs_def();
		const carom_body_def body = shape ? scenery_box(0.0f, 0.0f, 1000.0f, 0.0f, 0.1f, 0.1f) : scenery_circle(0.0f, 0.0f, 1000.0f, 0.0f, 0.05f);
		const carom_body_def bodies[3] = {
			body, fixed(scenery_box(1.0005f, 0.0f, 0.0f, 0.0f, 0.001f, 2.0f)), fixed(scenery_box(-1.0005f, 0.0f, 0.0f, 0.0f, 0.001f, 2.0f))};
		const double way = 1000.0 * (double)cases[shape].seconds - 0.95 - 1.9 * (double)(cases[shape].hits - 1);
		def.time_step = cases[shape].seconds;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, 3);
			if (!world)
				continue;
			assert_int_equal(runs_step(world, 1).hits, cases[shape].hits);
			runs_near((double)runs_state(world, 0).velocity.x, 1000.0, 1e-1);
			runs_near((double)runs_state(world, 0).position.x, -0.95 + way, 2.0 * (double)cases[shape].hits * 2.1 * (double)SLOP);
			carom_world_destroy(world);
		}
	}
}

/* Rods that fall on walls as thin as they are, and on a room's. One end bounces, and the other comes down while that one still touches: in less than a millionth of a
 * step, in which it would be on the far side. */
static void fast_rods_do_not_pass(void **unused)
{
	enum { RODS = 48 };
	static const struct {
		float thickness, speed, seconds, height;
	} cases[] = {{1e-4f, 1e3f, 1.0f, 0.3f}, {1e-5f, 2e3f, 1.0f / 60.0f, 0.0033f}, {1e-3f, 1e4f, 1.0f, 1.0f}};
	scenery_random random = {12};
	(void)unused;
	for (int i = 0; i < RODS; i++) {
		const float thickness = cases[i % 3].thickness, speed = cases[i % 3].speed, seconds = cases[i % 3].seconds, height = cases[i % 3].height;
		carom_body_def bodies[2] = {
			scenery_box(0.0f, height + thickness, 0.0f, -speed, 1.0f, thickness), fixed(scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 4.0f, thickness))};
		carom_world_def def = runs_def();
		uint64_t first = 0;
		def.has_room = i % 2; /* instead of the wall */
		def.room_min = (carom_vec2){-4.0f, 0.5f * thickness};
		def.room_max = (carom_vec2){4.0f, 2e5f};
		bodies[0].angle = scenery_uniform(&random, -1.8f, 1.8f) * height / speed;
		def.time_step = seconds;
		def.pipeline.step = i < RODS / 2 ? "events" : "first_impact";
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, i % 2 ? 1 : 2);
			if (!world)
				continue;
			for (int step = 0; step < (i < RODS / 2 ? 1 : 6); step++) {
				runs_step(world, 1);
				nothing_overlaps(world, 4.0);
			}
			assert_true(runs_state(world, 0).position.y > height);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Bars that turn more than once in a step, each within reach of others: as the queue has it. */
static void spinning_bars(void **unused)
{
	(void)unused;
	enum { COUNT = 9 };
	carom_world_def def = runs_room(2.0f, 2.0f);
	carom_body_def bodies[COUNT];
	scenery_random random = {11};
	uint64_t hits = 0, sure = 0;
	for (int i = 0; i < COUNT; i++) {
		const float x = 1.2f * (float)(i % 3 - 1), y = 1.2f * (float)(i / 3 - 1), speed = 20.0f;
		static carom_vec2 corners[4] = {{-0.5f, -0.005f}, {0.5f, -0.005f}, {0.5f, 0.005f}, {-0.5f, 0.005f}};
		const float vy = scenery_uniform(&random, -speed, speed), vx = scenery_uniform(&random, -speed, speed);
		bodies[i] = scenery_box(x, y, vx, vy, 1.0f, 1.0f);
		bodies[i].vertices = corners;
		bodies[i].angle = scenery_uniform(&random, -3.0f, 3.0f);
		bodies[i].is_static = i == 4;
		bodies[i].velocity = i == 4 ? (carom_vec2){0.0f, 0.0f} : bodies[i].velocity;
		bodies[i].angular_velocity = i == 4 ? 0.0f : scenery_uniform(&random, -600.0f, 600.0f);
	}
	def.time_step = 0.004f;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		forecast f = forecast_of(runs_queue(&def, bodies, COUNT));
		for (uint64_t i = 0; i < runs_affordable(50); i++) {
			forecast_follow(&f, world);
			forecast_step(&f, (double)def.time_step);
			const carom_report report = runs_step(world, 1);
			hits += report.hits;
			sure += f.sure;
			forecast_check(&f, world, "spinning bars");
			assert_true(!f.sure || report.hits == f.middle->hit_count);
		}
		nothing_overlaps(world, 4.0);
		forecast_destroy(&f);
		carom_world_destroy(world);
	}
	print_message("%llu hits, %llu steps foretold\n", (unsigned long long)hits, (unsigned long long)sure);
	runs_enough(hits >= 50 && sure >= 50);
}

/* ---- Number of hits */

/* Galperin's billiard: with masses 1 : 100^n as many hits as pi has in so many digits, all in one step and then in many. */
static void galperin_counts_pi(void **unused)
{
	(void)unused;
	static const struct {
		float mass;
		uint64_t hits;
	} cases[] = {{1.0f, 3}, {100.0f, 31}, {10000.0f, 314}};
	for (size_t i = 0; i < 6; i++) {
		carom_world_def def = runs_def();
		const carom_body_def bodies[3] = {fixed(scenery_box(-1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 2.0f)),
			weighing(scenery_circle(0.5f, 0.0f, 0.0f, 0.0f, 0.1f), 1.0f), weighing(scenery_circle(1.5f, 0.0f, -4.0f, 0.0f, 0.2f), cases[i % 3].mass)};
		def.time_step = i < 3 ? 4.0f : 0.03f;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, 3);
			if (!world)
				continue;
			const double energy = runs_measure(world).kinetic_energy;
			assert_int_equal(runs_advance(world, 4.0).hits, cases[i % 3].hits);
			runs_near(runs_measure(world).kinetic_energy / energy, 1.0, 3e-5);
			nothing_overlaps(world, 30.0);
			carom_world_destroy(world);
		}
	}
}

/* Newton's cradle: what goes in comes out at the other end, comes back from a wall, and goes out where it came from. Balls touch, within a slop. */
static void cradle(uint32_t count, bool has_wall, float gap, const scenery_device *device)
{
	carom_world_def def = runs_def();
	carom_body_def bodies[51];
	for (uint32_t i = 0; i < count; i++)
		bodies[i] = scenery_circle(i == 0 ? -2.0f : (float)i * (1.0f + gap), 0.0f, i == 0 ? 1.0f : 0.0f, 0.0f, 0.5f);
	bodies[count] = fixed(scenery_box((float)count * (1.0f + gap) + 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f));
	def.time_step = 8.0f;
	carom_world *world = runs_world(&def, device, bodies, count + has_wall);
	if (!world)
		return;
	const uint64_t wave = count - 1, hits = runs_step(world, 1).hits;
	if (hits != (has_wall ? 2 * wave + 1 : wave))
		fail_msg("%u balls with gaps of %g: %llu hits", count, (double)gap, (unsigned long long)hits);
	for (uint32_t i = 0; i < count; i++)
		runs_near((double)runs_state(world, i).velocity.x, has_wall && i == 0 ? -1.0 : !has_wall && i == count - 1 ? 1.0 : 0.0, 1e-5);
	carom_world_destroy(world);
}

static void newtons_cradle(void **unused)
{
	(void)unused;
	static const float gaps[] = {0.0f, 2e-7f, -2e-7f, 1e-4f};
	SCENERY_EACH_DEVICE(device) {
		for (int i = 0; i < 4; i++) {
			for (int has_wall = 0; has_wall < 2; has_wall++) {
				cradle(5, has_wall, gaps[i], device);
				cradle(50, has_wall, gaps[i], device);
			}
		}
	}
}

/* ---- Size and place */

static double seconds_of(const carom_world_def *def, const scenery_device *device, const carom_body_def *bodies, size_t count)
{
	carom_world *world = runs_world(def, device, bodies, count);
	const double begun = runs_seconds();
	runs_step(world, runs_affordable(120));
	const double seconds = runs_seconds() - begun;
	carom_world_destroy(world);
	return seconds;
}

/* A disc a thousand times larger than those about it, and large static bodies: for that the small ones neither become neighbours of all others
 * nor take much longer than alone. */
static void sizes_from_one_to_a_thousand(void **unused)
{
	(void)unused;
	enum { SMALL = 3000, COUNT = SMALL + 4 };
	carom_world_def def = runs_room(30.0f, 30.0f);
	static carom_body_def bodies[COUNT];
	scenery_random random = {3};
	uint64_t first = 0;
	for (int i = 0; i < SMALL; i++) {
		const float angle = 6.2831853f * (float)i / SMALL, far = scenery_uniform(&random, 10.1f, 13.0f), speed = 1.0f;
		bodies[i] = scenery_circle(far * cosf(angle), far * sinf(angle), scenery_uniform(&random, -speed, speed),
			scenery_uniform(&random, -speed, speed), 0.01f);
	}
	bodies[SMALL] = scenery_circle(0.0f, 0.0f, 2.0f, 1.0f, 10.0f);
	bodies[SMALL + 1] = fixed(scenery_circle(0.0f, -29.0f, 0.0f, 0.0f, 15.0f));
	bodies[SMALL + 2] = fixed(scenery_box(20.0f, 0.0f, 0.0f, 0.0f, 10.0f, 60.0f));
	bodies[SMALL + 3] = fixed(scenery_box(-20.0f, 0.0f, 0.0f, 0.0f, 10.0f, 0.01f));
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		const double energy = runs_measure(world).kinetic_energy, begun = runs_seconds();
		const carom_report report = runs_step(world, runs_affordable(120));
		const double seconds = runs_seconds() - begun, alone = seconds_of(&def, device, bodies, SMALL);
		print_message("%llu hits in %.4f s, %.4f s without what is large; %u neighbours\n", (unsigned long long)report.hits, seconds, alone,
			world->events.room);
		runs_enough(report.hits > 500);
		assert_true(report.held == 0 && world->events.room < 128 * COUNT);
		assert_true(seconds < 50.0 * alone || seconds < 0.025 * RUNS_SECONDS_MOST); /* so short a time is the machine's to say */
		runs_near(runs_measure(world).kinetic_energy / energy, 1.0, 1e-4);
		nothing_overlaps(world, 29.0 + 45.0); /* the box is 30.4 m about its centre */
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Bodies that part for good, a million metres away. */
static void bodies_fly_apart(void **unused)
{
	(void)unused;
	enum { COUNT = 64 };
	carom_world_def def = runs_def();
	carom_body_def bodies[COUNT];
	scenery_random random = {5};
	uint64_t first = 0;
	def.time_step = 0.25f;
	scenery_bodies(&random, SCENERY_MIXED, COUNT, 1.2f, 3.0f, bodies);
	for (int i = 0; i < COUNT; i++) {
		bodies[i].is_static = false;
		bodies[i].velocity.x += 100.0f * bodies[i].position.x;
		bodies[i].velocity.y += 100.0f * bodies[i].position.y;
	}
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		double far = 0.0;
		runs_advance(world, 1.0);
		const carom_body_state before = runs_state(world, 0);
		for (int i = 0; i < 20; i++)
			runs_advance(world, 100.0 + (double)i);
		const carom_body_state after = runs_state(world, 0);
		for (uint32_t i = 0; i < COUNT; i++)
			far = fmax(far, hypot((double)runs_state(world, i).position.x, (double)runs_state(world, i).position.y));
		assert_true(far > 1e6);
		runs_near((double)after.velocity.x, (double)before.velocity.x, 0.0);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* All in the same place at the start: whatever comes of it, it comes soon, and to an end. */
static void bodies_on_top_of_one_another(void **unused)
{
	(void)unused;
	enum { COUNT = 12 };
	for (int kind = 0; kind < 4; kind++) {
		carom_world_def def = runs_room(5.0f, 5.0f);
		carom_body_def bodies[COUNT];
		uint64_t first = 0;
		def.restitution = kind % 2 ? 0.5f : 1.0f;
		def.gravity.y = kind < 2 ? 0.0f : -10.0f;
		for (int i = 0; i < COUNT; i++) {
			bodies[i] = i % 2 ? scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f) : scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f);
			bodies[i].velocity.x = i % 3 == 0 ? 1.0f : i % 3 == 1 ? -1.0f : 0.0f;
			bodies[i].is_static = i == COUNT - 1 && kind == 3;
			bodies[i].velocity.x = bodies[i].is_static ? 0.0f : bodies[i].velocity.x;
		}
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			const double begun = runs_seconds();
			runs_step(world, runs_affordable(30));
			assert_true(runs_seconds() - begun < RUNS_SECONDS_MOST);
			for (uint32_t i = 0; i < COUNT; i++)
				assert_true(fabsf(runs_state(world, i).position.x) <= 5.0f && fabsf(runs_state(world, i).position.y) <= 5.0f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(fast_bodies_hit), cmocka_unit_test(a_blow_goes_through_a_row),
		cmocka_unit_test(a_shot_scatters_many), cmocka_unit_test(fast_body_between_walls), cmocka_unit_test(fast_rods_do_not_pass),
		cmocka_unit_test(spinning_bars), cmocka_unit_test(galperin_counts_pi), cmocka_unit_test(newtons_cradle),
		cmocka_unit_test(sizes_from_one_to_a_thousand), cmocka_unit_test(bodies_fly_apart), cmocka_unit_test(bodies_on_top_of_one_another)};
	return cmocka_run_group_tests_name("events_limits", tests, NULL, NULL);
}
