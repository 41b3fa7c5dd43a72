/* Bodies that are changed between two steps, while the others go on. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "count.h"
#include "runs.h"
#include "world.h"

enum { STEPS = 40, PAIRS = 32, IDLE = 1024 };

static void set_state(carom_world *world, uint32_t index, const carom_body_state *state)
{
	carom_error error;
	scenery_check(carom_world_set_states(world, index, 1, state, &error), &error);
}

static void set_force(carom_world *world, uint32_t index, float x, float y, float torque)
{
	carom_error error;
	scenery_check(carom_world_set_force(world, index, (carom_vec2){x, y}, torque, &error), &error);
}

static carom_body_info body_of(const carom_world *world, uint32_t index)
{
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	return info;
}

/* Another velocity, and of every third body another place: on its own spot, where nothing else is, of those that have not been used. */
static void steer_one(carom_world *world, scenery_random *random, int *spot)
{
	const uint32_t index = (uint32_t)scenery_uniform(random, 0.0f, (float)RUNS_CROWD);
	const carom_body_info info = body_of(world, index);
	carom_body_state state = runs_state(world, index);
	const float vx = scenery_uniform(random, -20.0f, 20.0f), vy = scenery_uniform(random, -20.0f, 20.0f), w = scenery_uniform(random, -9.0f, 9.0f);
	if (index % 3 == 0) {
		state.position = (carom_vec2){16.0f + 1.2f * (float)(*spot % 20), -12.0f + 1.2f * (float)(*spot / 20)};
		*spot += 1;
	}
	if (!info.is_static) {
		state.velocity = (carom_vec2){vx, vy};
		state.angular_velocity = w;
	}
	set_state(world, index, &state);
	if (!info.is_static && !info.is_kinematic)
		set_force(world, index, 3.0f * vy, -3.0f * vx, w);
}

/* All that can be are pushed; or all get another velocity, so that more go far than lists can keep up with. */
static void steer_all(carom_world *world, scenery_random *random, bool states)
{
	for (uint32_t i = 0; i < RUNS_CROWD; i++) {
		const carom_body_info info = body_of(world, i);
		const float x = scenery_uniform(random, -50.0f, 50.0f), y = scenery_uniform(random, -50.0f, 50.0f);
		if (info.is_static || info.is_kinematic)
			continue;
		if (states) {
			carom_body_state state = runs_state(world, i);
			state.velocity = (carom_vec2){x, y};
			set_state(world, i, &state);
		} else {
			set_force(world, i, x, y, 0.1f * x);
		}
	}
}

/* Gravity now and then; the time step, which gets shorter, and longer than lists were made for; and filters: bodies pass through others, or no longer. */
static void change_world(carom_world *world, scenery_random *random, int step)
{
	static const float lengths[] = {0.004f, 0.0045f, 0.01f, 0.001f, 0.05f, 0.0166f};
	carom_error error;
	if (step % 7 == 6)
		scenery_check(carom_world_set_gravity(world, (carom_vec2){0.5f * (float)step, -9.0f}, &error), &error);
	if (step % 5 > 2)
		scenery_check(carom_world_set_time_step(world, lengths[step / 5 % 6], &error), &error);
	if (step % 3 == 1) {
		const uint32_t body = (uint32_t)scenery_uniform(random, 0.0f, (float)RUNS_CROWD);
		const uint32_t categories = step % 2 ? 2 : CAROM_CATEGORIES, mask = step % 6 == 4 ? CAROM_MASK - 2 : CAROM_MASK;
		scenery_check(carom_world_set_filter(world, body, categories, mask, &error), &error);
	}
}

/* The bits of a world that is loaded anew before each step. */
static void it_is_as_loaded_anew(void **unused)
{
	static const char *const steps[] = {"events", "contacts"};
	(void)unused;
	for (size_t i = 0; i < 2; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			for (int anew = 0; anew < 2; anew++) {
				carom_world *world = runs_crowd(device, steps[i], false);
				scenery_random random = {5};
				int spot = 0;
				for (int step = 0; world && step < STEPS; step++) {
					const int steered = step % 4 == 3 ? 0 : 1 + step % 3 * 5;
					for (int k = 0; k < steered; k++)
						steer_one(world, &random, &spot);
					if (step % 10 == 5)
						steer_all(world, &random, step % 20 == 5);
					change_world(world, &random, step);
					if (anew)
						runs_load_anew(world);
					runs_step(world, 1 + (uint64_t)(step % 2));
				}
				if (world)
					runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

/* What is far away in short steps is met in a long one, by what moves by itself and by what is moved, on every way. */
static void a_longer_step_misses_nothing(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (int k = 0; k < 8; k++) {
			const float x = 4.0f * cosf(0.7f * (float)k), y = 4.0f * sinf(0.7f * (float)k), speed = k % 2 ? 2.5f : 6.0f;
			carom_world_def def = runs_def();
			carom_body_def bodies[] = {scenery_circle(x, y, -x * speed, -y * speed, 0.5f), scenery_circle(0, 0, 0, 0, 0.5f)};
			carom_error error;
			bodies[0].is_kinematic = k < 4;
			def.time_step = 0.001f;
			carom_world *world = runs_world(&def, device, bodies, COUNT(bodies));
			if (!world)
				continue;
			runs_step(world, 4);
			scenery_check(carom_world_set_time_step(world, 1.0f, &error), &error);
			assert_int_equal(runs_step(world, 1).hits, 1);
			/* twice as fast as what is moved, or as fast as what stops */
			const carom_body_state state = runs_state(world, 1);
			const double wanted = (k < 4 ? 8.0 : 4.0) * (double)speed;
			runs_near(hypot((double)state.velocity.x, (double)state.velocity.y), wanted, 1e-5 * wanted);
			carom_world_destroy(world);
		}
	}
}

/* Discs that glide towards others at rest, or will fall to static ones, and many more that keep the world calm: most are not looked at in each step. */
static carom_world *calm_world(const scenery_device *device, bool falls, double length)
{
	static carom_body_def bodies[2 * PAIRS + IDLE];
	carom_world_def def = runs_def();
	for (int k = 0; k < PAIRS; k++) {
		const double gap = (3.0 + 7.0 * (k + 0.5) / PAIRS) * length * (falls ? 0.5 : 1.0);
		bodies[2 * k] = scenery_circle(-1.0f - (float)gap, 2.0f * (float)(k - PAIRS / 2), falls ? 0.0f : 1.0f, 0.0f, 0.5f);
		bodies[2 * k + 1] = scenery_circle(0.0f, 2.0f * (float)(k - PAIRS / 2), 0.0f, 0.0f, 0.5f);
		bodies[2 * k + 1].is_static = falls;
	}
	for (int k = 0; k < IDLE; k++) {
		bodies[2 * PAIRS + k] = scenery_circle(50.0f + 2.0f * (float)(k % 32), 2.0f * (float)(k / 32), 0.0f, 0.0f, 0.5f);
		bodies[2 * PAIRS + k].is_static = falls && k % 2;
	}
	def.time_step = (float)length;
	return runs_world(&def, device, bodies, COUNT(bodies));
}

/* Until then it was known that nothing is hit for some steps. Steps that are longer by less than what has lists made anew, and gravity. */
static void looks_are_no_longer_good(void **unused)
{
	const double length = 1.0 / 64, longer = 1.1875 * length;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		for (int falls = 0; falls < 2; falls++) {
			carom_world *world = calm_world(device, falls, length);
			const double pull = 10.0, time = 8 * (falls ? length : longer);
			carom_error error;
			int hit = 0;
			if (!world)
				continue;
			runs_step(world, 2);
			if (falls)
				scenery_check(carom_world_set_gravity(world, (carom_vec2){(float)pull, 0.0f}, &error), &error);
			else
				scenery_check(carom_world_set_time_step(world, (float)longer, &error), &error);
			runs_step(world, 8);
			for (uint32_t k = 0; k < PAIRS; k++) {
				const carom_body_state glides = runs_state(world, 2 * k), stands = runs_state(world, 2 * k + 1);
				const double gap = (3.0 + 7.0 * (k + 0.5) / PAIRS) * length * (falls ? 0.5 : 1.0);
				const double until = falls ? sqrt(2.0 * gap / pull) : gap - 2.0 * length; /* it meets it */
				const bool meets = until < time;
				hit += meets;
				/* what falls is found to touch when it is nearer than CONTRACT's slop */
				runs_near((double)glides.velocity.x, falls ? pull * (meets ? time - 2.0 * until : time) : meets ? 0.0 : 1.0, falls ? 2e-3 : 1e-4);
				runs_near((double)stands.position.x, !falls && meets ? time - until : 0.0, 1e-5);
			}
			assert_true(hit > PAIRS / 2);
			carom_world_destroy(world);
		}
	}
}

static void let_pass(carom_world *world, uint32_t body, bool passes)
{
	carom_error error;
	scenery_check(carom_world_set_filter(world, body, passes ? 2 : CAROM_CATEGORIES, passes ? 2 : CAROM_MASK, &error), &error);
}

/* From one step to the next, what was to pass hits, and what was to hit passes. */
static void filters_hold_at_once(void **unused)
{
	const double length = 1.0 / 64;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = calm_world(device, false, length);
		if (!world)
			continue;
		for (uint32_t k = 0; k < PAIRS; k += 2)
			let_pass(world, 2 * k, true);
		runs_step(world, 2);
		for (uint32_t k = 0; k < PAIRS; k++)
			let_pass(world, 2 * k, k % 2);
		runs_step(world, 9);
		for (uint32_t k = 0; k < PAIRS; k++) {
			runs_near((double)runs_state(world, 2 * k).velocity.x, k % 2 ? 1.0 : 0.0, 1e-6);
			runs_near((double)runs_state(world, 2 * k + 1).velocity.x, k % 2 ? 0.0 : 1.0, 1e-6);
		}
		carom_world_destroy(world);
	}
}

/* What was still is put elsewhere, with a speed: at the exact time it hits what is near there, or as far away as several steps bring it. Again and again. */
static void what_slept_hits(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		carom_body_def bodies[2 + 60];
		for (int i = 0; i < 62; i++)
			bodies[i] = scenery_circle(3.0f * (float)(i % 8), 3.0f * (float)(i / 8), 0.0f, 0.0f, 0.5f);
		def.keep_hits = true;
		carom_world *world = runs_world(&def, device, bodies, 62);
		if (!world)
			continue;
		runs_step(world, 4);
		for (uint32_t row = 0; row < 7; row++) {
			const double gap = row % 2 ? 4.0 : 0.25;
			const carom_body_state state = {{22.0f + (float)gap, 3.0f * (float)row}, 0.0f, {-40.0f, 0.0f}, 0.0f};
			const double begun = carom_world_time(world);
			size_t count;
			set_state(world, 61, &state);
			runs_advance(world, 6.5 / 60.0);
			carom_hit *hits = runs_hits(world, &count), *own = hits;
			while (own < hits + count && own->body != 61)
				own++;
			assert_true(own < hits + count && own->other == (int32_t)(8 * row + 7));
			runs_near(own->time - begun, gap / 40.0, 1e-6);
			free(hits);
		}
		carom_world_destroy(world);
	}
}

/* A body that is pushed this way and that, by forces that each hold for one step. */
static void forces_hold_until_others_do(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_def();
		const carom_body_def bodies[2] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f), scenery_circle(9.0f, 0.0f, 0.0f, 0.0f, 0.5f)};
		double v = 0.0, x = 0.0, w = 0.0;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_step(world, 1);
		const carom_body_info info = body_of(world, 0);
		for (int step = 0; step < 60; step++) {
			const double push = 5.0 * sin(step), dt = (double)def.time_step;
			set_force(world, 0, (float)(push * (double)info.mass) + 1.0f, 0.0f, 1.0f); /* the last one counts */
			set_force(world, 0, (float)(push * (double)info.mass), 0.0f, (float)(push * (double)info.inertia));
			runs_step(world, 1);
			x += v * dt + 0.5 * push * dt * dt;
			v += push * dt;
			w += push * dt;
			const carom_body_state state = runs_state(world, 0);
			runs_near((double)state.position.x, x, 1e-6);
			runs_near((double)state.velocity.x, v, 1e-5);
			runs_near((double)state.angular_velocity, w, 1e-5);
		}
		assert_true(runs_state(world, 1).velocity.x == 0.0f);
		carom_world_destroy(world);
	}
}

/* What is set is read, before a step as after others were set; and what is refused has changed nothing. */
static void what_is_set_is_read(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_room(5.0f, 5.0f);
		const carom_body_def bodies[2] = {scenery_circle(-2.0f, 0.0f, 1.0f, 0.0f, 0.5f), scenery_circle(2.0f, 0.0f, 0.0f, 1.0f, 0.5f)};
		carom_error error;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_step(world, 3);
		const carom_body_state set = {{-1.0f, 2.0f}, 0.5f, {0.25f, -3.0f}, 7.0f}, other = runs_state(world, 1);
		const carom_body_state wrong[2] = {set, {{9.0f, 0.0f}, 0.0f, {0.0f, 0.0f}, 0.0f}}, fast = {{0.0f, 0.0f}, 0.0f, {2e9f, 0.0f}, 0.0f};
		for (int stepped = 0; stepped < 2; stepped++) {
			set_state(world, 0, &fast);
			set_state(world, 0, &set);
			assert_int_equal(carom_world_set_states(world, 0, 2, wrong, &error), CAROM_INVALID_ARGUMENT);
			assert_int_equal(carom_world_set_force(world, 0, (carom_vec2){INFINITY, 0.0f}, 0.0f, &error), CAROM_INVALID_ARGUMENT);
			carom_body_state found = runs_state(world, 0);
			assert_memory_equal(&found, &set, sizeof set);
			if (!stepped) {
				found = runs_state(world, 1);
				assert_memory_equal(&found, &other, sizeof other);
				runs_step(world, 1);
			}
		}
		/* too fast for floats: the step is refused, and can be taken once it is not any more */
		set_state(world, 1, &fast);
		assert_int_equal(carom_world_step(world, 1, NULL, &error), CAROM_LIMIT);
		assert_non_null(strstr(error.text, "body 1"));
		set_state(world, 1, &other);
		const double time = carom_world_time(world);
		runs_step(world, 1);
		assert_true(carom_world_time(world) > time);
		carom_world_destroy(world);
	}
}

/* A few are read from where they are; who reads one after the other gets all at once, not each by a way to the device. Both tell the same. */
static void who_reads_all_reads_them_once(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_crowd(device, "events", false);
		carom_body_state found[RUNS_CROWD], all[RUNS_CROWD];
		carom_error error;
		for (int round = 0; world && round < 2; round++) {
			runs_step(world, 2);
			for (uint32_t i = 0; i < RUNS_CROWD; i++) {
				found[i] = runs_state(world, i);
				assert_int_equal((world->newest & PLACE_HOST) != 0, i >= 4);
			}
			scenery_check(carom_world_get_states(world, 0, RUNS_CROWD, all, &error), &error);
			assert_memory_equal(found, all, sizeof all);
		}
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(it_is_as_loaded_anew), cmocka_unit_test(a_longer_step_misses_nothing),
		cmocka_unit_test(looks_are_no_longer_good), cmocka_unit_test(filters_hold_at_once), cmocka_unit_test(what_slept_hits),
		cmocka_unit_test(forces_hold_until_others_do), cmocka_unit_test(who_reads_all_reads_them_once), cmocka_unit_test(what_is_set_is_read)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
