/* Friction: textbook answers, what it must keep and what it must not add, and what stands because of it. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "layout.h"
#include "runs.h"

static const char *const steps[] = {"first_impact", "events", "contacts"};

/* The hash is 0 before the first device. Advances a world of `count` bodies for so many seconds, and gives their states. */
static bool run(const carom_world_def *def, const scenery_device *device, const carom_body_def *bodies, size_t count, double seconds,
	carom_body_state *states, uint64_t *first)
{
	carom_world *world = runs_world(def, device, bodies, count);
	if (!world)
		return false;
	runs_advance(world, seconds);
	for (uint32_t i = 0; i < count; i++)
		states[i] = runs_state(world, i);
	runs_same_hash(first, runs_hash(world), device);
	carom_world_destroy(world);
	return true;
}

static carom_body_def box_at(float x, float y, float angle)
{
	carom_body_def box = scenery_box(x, y, 0.0f, 0.0f, 1.0f, 1.0f);
	box.angle = angle;
	return box;
}

/* ---- One hit */

/* A ball that comes down on a wall with (vx, vy) and a spin: of its speed along the wall a hit takes at most friction (1 + e) |vy|, and where that is more
 * than it takes to roll, the ball rolls: then (v - w r) is 0 and v + w r / 2, its angular momentum about the point of contact, as before. */
static void a_ball_slides_or_rolls(void **unused)
{
	static const struct {
		float friction, spin;
	} cases[] = {{0.0f, 0.0f}, {0.1f, 0.0f}, {0.1f, 30.0f}, {0.1f, -30.0f}, {0.9f, 0.0f}, {0.9f, -5.0f}, {1000.0f, 20.0f}};
	const double vx = 3.0, vy = -4.0, radius = 0.5, restitution = 0.75;
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		for (size_t k = 0; k < 3; k++) {
			uint64_t first = 0;
			SCENERY_EACH_DEVICE(device) {
				carom_world_def def = runs_room(10.0f, 2.0f);
				carom_body_def ball = scenery_circle(-5.0f, 0.0f, (float)vx, (float)vy, (float)radius);
				carom_body_state after;
				def.pipeline.step = steps[k];
				def.restitution = (float)restitution;
				def.friction = cases[i].friction;
				ball.angular_velocity = cases[i].spin;
				ball.mass = 2.0f;
				if (!run(&def, device, &ball, 1, 0.5, &after, &first))
					continue;
				const double slip = vx + (double)cases[i].spin * radius, most = (double)cases[i].friction * (1.0 + restitution) * -vy;
				const double change = -copysign(fmin(fabs(slip) / 3.0, most), slip);
				runs_near((double)after.velocity.y, -restitution * vy, 1e-5);
				runs_near((double)after.velocity.x, vx + change, 1e-5);
				runs_near((double)after.angular_velocity, (double)cases[i].spin + 2.0 * change / radius, 1e-4);
			}
		}
	}
}

/* Two balls that graze each other turn like wheels of a gear: each takes as much spin as the other, and all spin and way together stay. */
static void balls_turn_each_other(void **unused)
{
	(void)unused;
	for (size_t k = 0; k < 3; k++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_def();
			carom_body_def balls[2] = {scenery_circle(-2.0f, 0.4f, 4.0f, 0.0f, 0.5f), scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f)};
			carom_body_state after[2];
			def.pipeline.step = steps[k];
			def.friction = 1.0f;
			for (int i = 0; i < 2; i++)
				balls[i].mass = 1.0f;
			if (!run(&def, device, balls, 2, 1.0, after, &first))
				continue;
			runs_near((double)after[0].angular_velocity, (double)after[1].angular_velocity, 1e-5);
			assert_true(fabsf(after[0].angular_velocity) > 0.5f);
			double momentum = 0.0, energy = 0.0;
			for (int i = 0; i < 2; i++) {
				const carom_body_state *s = &after[i];
				const double vx = (double)s->velocity.x, vy = (double)s->velocity.y, w = (double)s->angular_velocity;
				momentum += (double)s->position.x * vy - (double)s->position.y * vx + 0.125 * w;
				energy += 0.5 * (vx * vx + vy * vy + 0.125 * w * w);
			}
			runs_near(momentum, -0.4 * 4.0, 1e-5); /* of the first about the second's centre, before */
			runs_near((double)after[0].velocity.x + (double)after[1].velocity.x, 4.0, 1e-5);
			assert_true(energy < 7.9); /* of 8 J */
		}
	}
}

/* A pair takes the geometric mean of its two: with one that has none there is none, and not a bit is another. */
static void a_pair_takes_the_mean(void **unused)
{
	static const float frictions[][2] = {{0.2f, 0.8f}, {0.4f, 0.4f}, {0.0f, 0.8f}, {0.0f, 0.0f}};
	double spin[4] = {0};
	uint64_t hashes[4] = {0};
	(void)unused;
	for (size_t k = 0; k < 3; k++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = NULL;
			for (int i = 0; i < 4; i++) {
				carom_world_def def = runs_def();
				carom_body_def balls[2] = {scenery_circle(-2.0f, 0.3f, 4.0f, 0.0f, 0.5f), scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f)};
				def.pipeline.step = steps[k];
				def.friction = 0.9f; /* bodies have their own */
				for (int b = 0; b < 2; b++)
					balls[b].friction = frictions[i][b];
				world = runs_world(&def, device, balls, 2);
				if (!world)
					break;
				runs_advance(world, 1.0);
				spin[i] = (double)runs_state(world, 0).angular_velocity;
				hashes[i] = runs_hash(world);
				carom_world_destroy(world);
			}
			if (!world)
				continue;
			assert_true(spin[0] != 0.0);
			runs_near(spin[0], spin[1], 1e-6);
			assert_true(spin[2] == 0.0 && hashes[2] == hashes[3]);
		}
	}
}

/* ---- Crowds */

/* No hit adds energy, whatever its restitution and friction; and where no room is, none changes how much all move and turn. */
static void friction_adds_no_energy(void **unused)
{
	enum { COUNT = 64 };
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_body_def bodies[COUNT];
		carom_world_def def = runs_def();
		scenery_random random = {5};
		def.friction = 0.6f;
		scenery_bodies(&random, SCENERY_MIXED, COUNT, 1.2f, 1.0f, bodies);
		for (int i = 0; i < COUNT; i++) {
			bodies[i].is_static = false;
			bodies[i].velocity.x -= bodies[i].position.x;
			bodies[i].velocity.y -= bodies[i].position.y;
		}
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		const carom_measure begun = runs_measure(world);
		carom_measure last = begun;
		uint64_t hits = 0;
		for (uint64_t step = 0; step < runs_affordable(60); step++) {
			hits += runs_step(world, 1).hits;
			const carom_measure now = runs_measure(world);
			assert_true(now.kinetic_energy <= last.kinetic_energy + 1e-6 * begun.kinetic_energy);
			runs_near(now.momentum_x, begun.momentum_x, 1e-4);
			runs_near(now.momentum_y, begun.momentum_y, 1e-4);
			runs_near(now.angular_momentum, begun.angular_momentum, 1e-3);
			last = now;
		}
		runs_enough(hits > 200 && last.kinetic_energy < 0.9 * begun.kinetic_energy);
		carom_world_destroy(world);
	}
}

/* ---- What lies, slides and rolls */

/* A box that slides stops after v^2 / (2 friction g), a ball that slides rolls from v / (3 friction g) on, with two thirds of its speed. By hits, and by
 * forces. */
static void what_slides_stops_or_rolls(void **unused)
{
	const double v = 3.0, friction = 0.3, deceleration = friction * (double)RUNS_GRAVITY;
	(void)unused;
	for (size_t k = 1; k < 3; k++) {
		uint64_t box_hash = 0, ball_hash = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting(steps[k], 4.0f, 8.0f);
			carom_body_def box = box_at(-2.0f, 0.5f, 0.0f), ball = scenery_circle(-2.0f, 0.5f, (float)v, 0.0f, 0.5f);
			carom_body_state after;
			def.restitution = 0.0f;
			def.friction = (float)friction;
			box.velocity.x = (float)v;
			if (!run(&def, device, &box, 1, 2.0, &after, &box_hash))
				continue;
			runs_near((double)after.position.x, -2.0 + v * v / (2.0 * deceleration), 2e-3);
			runs_near((double)after.velocity.x, 0.0, 1e-4);
			runs_near((double)after.angle, 0.0, 1e-3);
			run(&def, device, &ball, 1, 1.0, &after, &ball_hash);
			runs_near((double)after.velocity.x, 2.0 / 3.0 * v, 2e-3);
			runs_near((double)after.angular_velocity * 0.5, -2.0 / 3.0 * v, 2e-3);
			const double until = v / (3.0 * deceleration), sliding = v * until - 0.5 * deceleration * until * until;
			runs_near((double)after.position.x, -2.0 + sliding + 2.0 / 3.0 * v * (1.0 - until), 3e-3);
		}
	}
}

/* On a slope of tan 0.4 a box with friction 0.5 stays where it is, and one with 0.25 slides with g (sin - 0.25 cos); a ball rolls with 2/3 g sin. */
static void slopes_hold_what_grips(void **unused)
{
	const double slope = atan(0.4), g = (double)RUNS_GRAVITY, high = 0.5 + 0.5 + 1e-4, seconds = 0.75;
	(void)unused;
	for (size_t k = 1; k < 3; k++) {
		for (int i = 0; i < 3; i++) {
			uint64_t first = 0;
			SCENERY_EACH_DEVICE(device) {
				carom_world_def def = runs_resting(steps[k], 20.0f, 40.0f);
				carom_body_def bodies[2] = {scenery_box(0.0f, 20.0f, 0.0f, 0.0f, 30.0f, 1.0f), box_at(0.0f, 0.0f, (float)slope)};
				carom_body_state after[2];
				def.restitution = 0.0f;
				def.friction = i == 1 ? 0.25f : 0.5f;
				if (i == 2)
					bodies[1] = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
				bodies[0].is_static = true;
				bodies[0].angle = (float)slope;
				bodies[1].position = (carom_vec2){(float)(-sin(slope) * high), (float)(20.0 + cos(slope) * high)};
				if (!run(&def, device, bodies, 2, seconds, after, &first))
					continue;
				const double along = (double)after[1].velocity.x * cos(slope) + (double)after[1].velocity.y * sin(slope);
				const double pull = i == 0 ? 0.0 : i == 1 ? sin(slope) - 0.25 * cos(slope) : 2.0 / 3.0 * sin(slope);
				runs_near(along, -pull * g * seconds, 0.015);
				if (i == 2)
					runs_near((double)after[1].angular_velocity * 0.5, -along, 0.02);
				if (i == 0) /* what falls on it by a tenth of a millimetre, and at first slides */
					runs_near(hypot((double)(after[1].position.x - bodies[1].position.x), (double)(after[1].position.y - bodies[1].position.y)), 0.0,
						4e-3);
			}
		}
	}
}

/* A pyramid of 28 boxes stands, though the ground is not level: without a hit, and hardly anything moves in seconds. Without friction it slides apart. */
static void pyramids_stand(void **unused)
{
	enum { SIDE = 7, COUNT = SIDE * (SIDE + 1) / 2 };
	static const float frictions[] = {0.5f, 1000.0f, 0.0f};
	(void)unused;
	for (int i = 0; i < 3; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting("contacts", (float)SIDE, 2.0f * SIDE);
			carom_body_def boxes[COUNT];
			int k = 0;
			def.restitution = 0.0f;
			def.gravity.x = 1.0f;
			def.friction = frictions[i];
			for (int row = 0; row < SIDE; row++)
				for (int column = 0; column < SIDE - row; column++)
					boxes[k++] = box_at(((float)column - 0.5f * (float)(SIDE - row - 1)) * 1.02f, 0.5005f + 1.0005f * (float)row, 0.0f);
			carom_world *world = runs_world(&def, device, boxes, COUNT);
			if (!world)
				continue;
			runs_step(world, runs_affordable(30)); /* they come to lie on each other */
			double farthest = 0.0;
			carom_body_state before[COUNT];
			for (uint32_t b = 0; b < COUNT; b++)
				before[b] = runs_state(world, b);
			const carom_report report = runs_step(world, runs_affordable(120));
			for (uint32_t b = 0; b < COUNT; b++) {
				const carom_body_state now = runs_state(world, b);
				farthest = fmax(farthest, hypot((double)(now.position.x - before[b].position.x), (double)(now.position.y - before[b].position.y)));
			}
			if (device == scenery_devices)
				print_message("friction %g: %llu hits in two seconds, %.2g m farthest\n", (double)frictions[i], (unsigned long long)report.hits,
					farthest);
			runs_enough(frictions[i] > 0.0f ? report.hits == 0 && farthest < 1e-3 : farthest > 0.5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Restitution 1 is no reason never to rest: friction takes the energy, and what lies still then is neither hit without end nor held where it is. */
static void what_rubs_rests_whatever_its_restitution(void **unused)
{
	enum { COUNT = 6 };
	(void)unused;
	for (int i = 1; i < 3; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting(steps[i], 5.0f, 8.0f);
			carom_body_def boxes[COUNT];
			def.restitution = 1.0f;
			def.friction = 0.5f;
			for (int k = 0; k < COUNT; k++) {
				boxes[k] = box_at((float)(2 * (k % 3) - 2), 1.0f + 1.5f * (float)(k / 3), 0.4f * (float)k);
				boxes[k].velocity.x = 1.5f - (float)k;
			}
			carom_world *world = runs_world(&def, device, boxes, COUNT);
			if (!world)
				continue;
			const carom_measure begun = runs_measure(world);
			const carom_report run = runs_step(world, runs_affordable(600));
			const carom_measure now = runs_measure(world);
			const carom_report last = runs_step(world, runs_affordable(60));
			if (device == scenery_devices)
				print_message("%s: %llu and %llu hits, at last %.2g J\n", steps[i], (unsigned long long)run.hits, (unsigned long long)last.hits,
					now.kinetic_energy);
			assert_true(run.held == 0 && last.held == 0 && last.hits < (uint64_t)60 * COUNT * 100);
			assert_true(now.max_penetration < 1e-4);
			runs_enough(now.kinetic_energy < 1e-3 * (begun.kinetic_energy + begun.potential_energy));
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A body with friction may come into a world of contacts that had none: it is held as if it had been there from the beginning. */
static void a_later_body_rubs(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 4.0f, 8.0f);
		carom_body_def smooth = box_at(-2.0f, 0.5f, 0.0f), rough = box_at(2.0f, 0.5f, 0.0f);
		carom_error error;
		def.restitution = 0.0f;
		def.friction = 1.0f;
		smooth.friction = 0.0f;
		rough.friction = 1.0f;
		smooth.velocity.x = rough.velocity.x = 0.5f;
		carom_world *world = runs_world(&def, device, &smooth, 1);
		if (!world)
			continue;
		runs_step(world, 10);
		scenery_check(carom_world_add(world, &rough, 1, NULL, &error), &error);
		runs_step(world, 30);
		runs_near((double)runs_state(world, 0).velocity.x, 0.5, 1e-5);
		runs_near((double)runs_state(world, 1).velocity.x, 0.0, 1e-4);
		runs_near((double)runs_state(world, 1).position.x, 2.0 + 0.0125, 2e-3);
		carom_world_destroy(world);
	}
}

/* Bodies that are refused leave nothing, not even the friction of those that were right. */
static void a_refused_body_rubs_nothing(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (int i = 0; i < 2; i++) {
			const carom_world_def def = runs_resting("contacts", 4.0f, 8.0f);
			carom_body_def bodies[] = {box_at(-2.0f, 0.5f, 0.0f), box_at(-2.0f, 1.7f, 0.0f), box_at(-2.0f, 2.9f, 0.0f)};
			carom_body_def refused[] = {box_at(2.0f, 0.5f, 0.0f), scenery_circle(0.0f, 5.0f, 0.0f, 0.0f, -1.0f)};
			carom_error error;
			carom_world *world = runs_world(&def, device, bodies, 3);
			if (!world)
				continue;
			runs_step(world, 60);
			refused[0].friction = 1.0f;
			if (i)
				assert_int_equal(carom_world_add(world, refused, 2, NULL, &error), CAROM_INVALID_ARGUMENT);
			runs_same_hash(&first, runs_hash_after(world, 10, 1), device);
		}
	}
}

/* Boxes that do not stand quite upon each other. */
static void a_tower_comes_to_rest(void **unused)
{
	enum { COUNT = 8 };
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 10.0f, 20.0f);
		carom_body_def boxes[COUNT];
		float left = INFINITY, right = -INFINITY;
		def.restitution = 0.2f;
		def.friction = 0.5f;
		for (int k = 0; k < COUNT; k++)
			boxes[k] = box_at(k % 2 ? 0.014f : -0.011f, 0.501f + 1.001f * (float)k, 0.0f);
		carom_world *world = runs_world(&def, device, boxes, COUNT);
		if (!world)
			continue;
		runs_step(world, 300);
		for (int step = 0; step < 60; step++) {
			runs_step(world, 1);
			const float x = runs_state(world, COUNT - 1).position.x;
			left = fminf(left, x);
			right = fmaxf(right, x);
		}
		print_message("%s: the top one goes %g mm to and fro\n", device->name, 1000.0 * (double)(right - left));
		assert_true(right == left && fabsf(right) < 0.03f);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_ball_slides_or_rolls), cmocka_unit_test(balls_turn_each_other),
		cmocka_unit_test(a_pair_takes_the_mean), cmocka_unit_test(friction_adds_no_energy), cmocka_unit_test(what_slides_stops_or_rolls),
		cmocka_unit_test(slopes_hold_what_grips), cmocka_unit_test(pyramids_stand), cmocka_unit_test(a_tower_comes_to_rest),
		cmocka_unit_test(what_rubs_rests_whatever_its_restitution), cmocka_unit_test(a_later_body_rubs),
		cmocka_unit_test(a_refused_body_rubs_nothing)};
	return cmocka_run_group_tests_name("friction", tests, NULL, NULL);
}
