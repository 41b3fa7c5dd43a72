/* The step contacts: what rests lies still, what moves moves as gravity says, and all else is events. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "layout.h"
#include "runs.h"
#include "wild.h"

#define SETTLED 240 /* steps after which a small heap lies */

/* How near bodies of a radius about 0.5 m come that rest on each other, some metres from the origin. */
#define NEAR ((double)CUSHION * (double)SLOP * 12.0)

static carom_body_def body_at(uint32_t sides, float x, float y)
{
	carom_body_def body = scenery_circle(x, y, 0.0f, 0.0f, 0.5f);
	if (sides) {
		body.shape = CAROM_REGULAR;
		body.sides = sides;
	}
	return body;
}

/* Bodies fall into a box. The hits of a second, once they lie. */
static uint64_t hits_of_heap(const char *step, uint32_t sides, const scenery_device *device, uint64_t *hash, carom_measure *measure)
{
	enum { SIDE = 6, COUNT = SIDE * SIDE };
	const carom_world_def def = runs_resting(step, 4.0f, 20.0f);
	carom_body_def bodies[COUNT];
	scenery_random random = {3};
	for (int i = 0; i < COUNT; i++) {
		bodies[i] = body_at(sides, 1.2f * ((float)(i % SIDE) - 2.5f) + scenery_uniform(&random, -0.05f, 0.05f), 0.7f + 1.2f * (float)(i / SIDE));
		bodies[i].angle = sides ? scenery_uniform(&random, 0.0f, 3.0f) : 0.0f;
	}
	carom_world *world = runs_world(&def, device, bodies, COUNT);
	if (!world)
		return 0;
	runs_step(world, runs_affordable(SETTLED));
	const carom_report report = runs_step(world, runs_affordable(60));
	*measure = runs_measure(world);
	*hash = runs_hash(world);
	carom_world_destroy(world);
	assert_true(report.held == 0);
	return report.hits;
}

static void heaps_lie_still(void **unused)
{
	static const uint32_t sides[] = {0, 3, 4, 6};
	(void)unused;
	for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
		carom_measure measure;
		uint64_t hash, first = 0;
		const uint64_t before = hits_of_heap("events", sides[i], &scenery_devices[0], &hash, &measure);
		SCENERY_EACH_DEVICE(device) {
			hash = 0;
			const uint64_t hits = hits_of_heap("contacts", sides[i], device, &hash, &measure);
			if (!hash)
				continue;
			runs_same_hash(&first, hash, device);
			if (device == scenery_devices)
				print_message("%u sides: %llu hits in a second, %llu by events, %.3g J, %.2g m deep\n", sides[i], (unsigned long long)hits,
					(unsigned long long)before, measure.kinetic_energy, measure.max_penetration);
			runs_enough(hits < before / 5);
			runs_near(measure.max_penetration, 0.0, 40.0 * (double)SLOP);
		}
	}
}

/* Bodies upon each other are borne all the way down, and no more is hit. */
static void column(uint32_t sides, uint32_t count, const scenery_device *device, uint64_t *first)
{
	enum { MOST = 12 };
	const carom_world_def def = runs_resting("contacts", 2.0f, 16.0f);
	const float pitch = sides ? sqrtf(0.5f) : 1.0f;
	carom_body_def bodies[MOST];
	for (uint32_t i = 0; i < count; i++) {
		bodies[i] = body_at(sides, 0.0f, (0.5f + (float)i) * pitch + 0.001f * (float)(i + 1));
		bodies[i].angle = sides ? 0.78539816f : 0.0f;
	}
	carom_world *world = runs_world(&def, device, bodies, count);
	if (!world)
		return;
	runs_step(world, runs_affordable(SETTLED));
	runs_enough(runs_step(world, runs_affordable(SETTLED)).hits == 0);
	for (uint32_t i = 0; i < count; i++) {
		const carom_body_state state = runs_state(world, i);
		const double rests = (0.5 + (double)i) * (double)pitch;
		runs_enough((double)state.position.y > rests - NEAR && (double)state.position.y < rests + NEAR * (double)(i + 1));
		runs_enough(hypot((double)state.velocity.x, (double)state.velocity.y) < 1e-3);
	}
	runs_same_hash(first, runs_hash(world), device);
	carom_world_destroy(world);
}

static void columns_stand_without_a_hit(void **unused)
{
	uint64_t balls = 0, boxes = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		column(0, 10, device, &balls);
		column(4, 10, device, &boxes);
	}
}

/* In a step a millimetre is thrice its size: what is that far is not near. A bead bounces, and a column stands. */
static void what_is_small_has_to_be_nearer(void **unused)
{
	enum { HIGH = 8 };
	const carom_world_def def = runs_resting("contacts", 0.1f, 0.1f);
	const float size = 0.001f;
	carom_body_def bead = scenery_circle(-0.05f, 4.0f * size, 0.0f, 0.0f, 0.5f * size), bodies[HIGH + 1];
	uint64_t first = 0;
	(void)unused;
	bead.restitution = 0.8f;
	for (int i = 0; i < HIGH; i++)
		bodies[i] = scenery_box(0.0f, (0.5f + 1.01f * (float)i) * size, 0.0f, 0.0f, size, size);
	bodies[HIGH] = bead;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, HIGH + 1);
		if (!world)
			continue;
		/* falls 3.5 mm in sqrt(7e-4) s, and has (1/30 - that) s to rise at 0.8 sqrt(0.07) m/s */
		const double rises = 2.0 / 60.0 - sqrt(7e-4), speed = 0.8 * sqrt(0.07);
		runs_step(world, 2);
		runs_near((double)runs_state(world, HIGH).position.y, 0.0005 + speed * rises - 5.0 * rises * rises, 1e-6);
		runs_step(world, runs_affordable(SETTLED));
		runs_enough(runs_step(world, runs_affordable(SETTLED)).hits == 0);
		for (int i = 0; i < HIGH; i++)
			runs_near((double)runs_state(world, (uint32_t)i).position.y, (0.5 + (double)i) * (double)size, 0.02 * (double)size);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Without friction what is on a slope slides down with g sin(slope), ball or box, borne by forces along the normal alone. */
static void slopes_only_turn_gravity(void **unused)
{
	const double slope = 0.5, seconds = 0.5;
	(void)unused;
	for (uint32_t sides = 0; sides <= 4; sides += 4) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting("contacts", 20.0f, 40.0f);
			const double high = (sides ? sqrt(0.125) : 0.5) + 0.5 + 1e-5;
			carom_body_def bodies[2] = {
				scenery_box(0.0f, 20.0f, 0.0f, 0.0f, 30.0f, 1.0f), body_at(sides, (float)(-sin(slope) * high), (float)(20.0 + cos(slope) * high))};
			bodies[0].is_static = true;
			bodies[0].angle = (float)slope;
			bodies[1].angle = sides ? (float)slope + 0.78539816f : 0.0f;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			runs_advance(world, seconds);
			const carom_body_state state = runs_state(world, 1);
			const double expected = -(double)RUNS_GRAVITY * sin(slope) * seconds;
			runs_near((double)state.velocity.x * cos(slope) + (double)state.velocity.y * sin(slope), expected, 1e-3 * fabs(expected));
			runs_near((double)state.velocity.y * cos(slope) - (double)state.velocity.x * sin(slope), 0.0, 0.01);
			runs_near((double)state.angular_velocity, 0.0, 0.01);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A force on one of two bodies moves both alike, and no more is hit. */
static void a_push_is_handed_on(void **unused)
{
	enum { COUNT = 2 };
	(void)unused;
	for (uint32_t sides = 0; sides <= 4; sides += 4) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting("contacts", 10.0f, 20.0f);
			const float pitch = sides ? sqrtf(0.5f) : 1.0f;
			carom_body_def bodies[COUNT];
			double mass = 0.0;
			def.gravity.y = 0.0f;
			for (int i = 0; i < COUNT; i++) {
				bodies[i] = body_at(sides, -8.0f + (pitch + 1e-4f) * (float)i, 10.0f);
				bodies[i].angle = sides ? 0.78539816f : 0.0f;
				bodies[i].mass = (float)(1 + i % 2);
				mass += 1 + i % 2;
			}
			bodies[0].force.x = 6.0f;
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			runs_step(world, runs_affordable(60));
			runs_enough(runs_step(world, runs_affordable(30)).hits == 0);
			const double expected = 6.0 / mass * carom_world_time(world);
			for (uint32_t i = 0; i < COUNT; i++)
				runs_near((double)runs_state(world, i).velocity.x, expected, 1e-3);
			runs_near(runs_measure(world).momentum_x, mass * expected, 1e-5 * mass * expected);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What pushes one of two bodies lets the other get where it was not looked for: among more others than lists take while they last. */
static void a_push_is_handed_on_beside_many(void **unused)
{
	enum { COLUMNS = 30, ROWS = 30, COUNT = 2 + COLUMNS * ROWS };
	static carom_body_def bodies[COUNT];
	const double force = 720.0; /* 0.1 m in a step */
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 10.0f, 20.0f);
		def.gravity.y = 0.0f;
		for (int i = 0; i < COUNT; i++) {
			const int k = i - 2;
			bodies[i] = scenery_circle(2.0f + 0.15f * (float)(k % COLUMNS), 10.0f + 0.15f * (float)(k / COLUMNS - ROWS / 2), 0.0f, 0.0f, 0.05f);
		}
		for (int i = 0; i < 2; i++) {
			bodies[i].position = (carom_vec2){0.10001f * (float)i, 10.0f};
			bodies[i].mass = 1.0f;
		}
		bodies[0].force.x = (float)force;
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		assert_true(runs_step(world, 4).hits == 0);
		for (uint32_t i = 0; i < 2; i++)
			runs_near((double)runs_state(world, i).velocity.x, 0.5 * force * carom_world_time(world), 1e-3);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* What comes fast bounces, as it does by events. */
static void what_falls_bounces(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 5.0f, 10.0f);
		const carom_body_def ball = body_at(0, 0.0f, 1.5f);
		def.restitution = 0.5f;
		carom_world *world = runs_world(&def, device, &ball, 1);
		if (!world)
			continue;
		runs_advance(world, sqrt(2.0 / (double)RUNS_GRAVITY) * 1.5); /* down, and half as long up */
		runs_near((double)runs_state(world, 0).position.y, 0.75, 0.002);
		carom_world_destroy(world);
	}
}

/* Whether it hits the floor, is stopped before or is borne: nothing leaves faster than it came. */
static void what_comes_slowly_leaves_no_faster(void **unused)
{
	enum { STEPS = 20, GAPS = 5, COUNT = 9 * GAPS };
	(void)unused;
	for (uint32_t sides = 0; sides <= 4; sides += 4) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			static const float gaps[GAPS] = {0.0f, 0.0002f, 0.001f, 0.0025f, 0.004f};
			carom_world_def def = runs_resting("contacts", 2.0f * (float)COUNT, 16.0f);
			carom_body_def bodies[COUNT];
			const double push = (double)RUNS_GRAVITY * (double)def.time_step * (double)def.time_step, lifted = 0.5 * push; /* to where it rests */
			def.restitution = 0.9f;
			for (int i = 0; i < COUNT; i++) {
				const float floor = sides ? sqrtf(0.125f) : 0.5f;
				bodies[i] = body_at(sides, 2.0f * (float)(i - COUNT / 2), floor + gaps[i % GAPS]);
				bodies[i].angle = sides ? 0.785398163f : 0.0f;
				bodies[i].restitution = 0.9f;
				bodies[i].velocity.y = -0.1f * (float)(i / GAPS + 1);
			}
			carom_world *world = runs_world(&def, device, bodies, COUNT);
			if (!world)
				continue;
			for (int step = 0; step < STEPS; step++) {
				runs_step(world, 1);
				for (uint32_t i = 0; i < COUNT; i++) {
					const carom_body_state state = runs_state(world, i);
					const double speed = (double)state.velocity.y, begun = (double)bodies[i].velocity.y;
					const double energy = 0.5 * speed * speed + (double)RUNS_GRAVITY * (double)(state.position.y - bodies[i].position.y);
					assert_true(energy <= 0.5 * begun * begun + (double)RUNS_GRAVITY * lifted);
				}
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* With restitution 1 nothing rests, and without a push nothing does: not a bit is another. */
static void without_rest_it_is_events(void **unused)
{
	(void)unused;
	for (int pushed = 0; pushed < 2; pushed++) {
		uint64_t hashes[2];
		for (int contacts = 0; contacts < 2; contacts++) {
			carom_world_def def = runs_resting(contacts ? "contacts" : "events", 10.0f, 20.0f);
			carom_body_def bodies[49];
			scenery_random random = {5};
			scenery_bodies(&random, SCENERY_MIXED, 49, 1.4f, 4.0f, bodies);
			for (int i = 0; i < 49; i++)
				bodies[i].position.y += 10.0f;
			def.restitution = pushed ? 1.0f : 0.5f;
			def.gravity.y = pushed ? -RUNS_GRAVITY : 0.0f;
			for (int i = 0; i < 49 && !pushed; i++) {
				bodies[i].force = (carom_vec2){0.0f, 0.0f};
				bodies[i].restitution = 0.5f;
			}
			hashes[contacts] = runs_hash_after(runs_world(&def, &scenery_devices[0], bodies, 49), 100, 1);
		}
		assert_true(hashes[0] == hashes[1]);
	}
}

/* On a plate lie many balls, without friction: neither it nor they hit anything once they lie. */
static void many_on_one_are_borne(void **unused)
{
	enum { BALLS = 16 };
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const carom_world_def def = runs_resting("contacts", 12.0f, 8.0f);
		carom_body_def bodies[BALLS + 1];
		bodies[0] = scenery_box(0.0f, 0.3f, 0.0f, 0.0f, 20.0f, 0.5f);
		for (int i = 0; i < BALLS; i++)
			bodies[i + 1] = body_at(0, 1.1f * ((float)i - 0.5f * (float)(BALLS - 1)), 1.1f);
		carom_world *world = runs_world(&def, device, bodies, BALLS + 1);
		if (!world)
			continue;
		assert_true(runs_step(world, runs_affordable(SETTLED)).held == 0);
		runs_enough(runs_step(world, 30).hits == 0);
		runs_enough(fabs((double)runs_state(world, 0).position.y - 0.25) < 0.001);
		for (uint32_t i = 1; i <= BALLS; i++)
			runs_enough(fabs((double)runs_state(world, i).position.y - 1.0) < 0.002);
		runs_near(runs_measure(world).max_penetration, 0.0, 40.0 * (double)SLOP);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Made-up worlds that lose energy and that nothing but gravity pushes: whatever is borne, squeezed or thrown, nothing gains any. */
static void forces_add_no_energy(void **unused)
{
	static wild_world wild;
	uint64_t hits = 0;
	double most = 0.0;
	(void)unused;
	for (uint64_t seed = 1; seed <= 30; seed++) {
		carom_error error;
		wild_make_wider(seed, &wild);
		if (!(wild.def.restitution < 1.0f) || !(wild.def.gravity.y < 0.0f))
			continue;
		scenery_check(carom_pipeline_set(&wild.def.pipeline, "step", "contacts", &error), &error);
		for (uint32_t i = 0; i < wild.count; i++) {
			wild.bodies[i].force = (carom_vec2){0.0f, 0.0f};
			wild.bodies[i].torque = 0.0f;
			wild.bodies[i].mask = CAROM_MASK; /* so that more is hit */
			wild.bodies[i].categories = CAROM_CATEGORIES;
		}
		carom_world *world = runs_world(&wild.def, &scenery_devices[0], wild.bodies, wild.count);
		const carom_measure before = runs_measure(world);
		for (int part = 0; part < 5 && before.kinetic_energy > 0.0; part++) { /* what rests from the beginning is in test_tight */
			hits += runs_step(world, runs_affordable(20)).hits;
			const carom_measure after = runs_measure(world);
			const double gained = (after.kinetic_energy - before.kinetic_energy) + (after.potential_energy - before.potential_energy);
			most = fmax(most, gained / (before.kinetic_energy + 1e-3));
		}
		carom_world_destroy(world);
	}
	print_message("%llu hits, at most %.2g of the kinetic energy gained\n", (unsigned long long)hits, most);
	runs_enough(hits > 10000);
	assert_true(most < 1e-4);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(heaps_lie_still), cmocka_unit_test(columns_stand_without_a_hit),
		cmocka_unit_test(what_is_small_has_to_be_nearer), cmocka_unit_test(slopes_only_turn_gravity), cmocka_unit_test(a_push_is_handed_on),
		cmocka_unit_test(a_push_is_handed_on_beside_many), cmocka_unit_test(what_falls_bounces), cmocka_unit_test(what_comes_slowly_leaves_no_faster),
		cmocka_unit_test(without_rest_it_is_events), cmocka_unit_test(many_on_one_are_borne), cmocka_unit_test(forces_add_no_energy)};
	return cmocka_run_group_tests_name("contacts", tests, NULL, NULL);
}
