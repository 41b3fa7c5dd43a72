/* Running a world: ranges, states, forces, growing, stopping and resuming, progress, memory and its limit, threads.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <string.h>

#include "layout.h"
#include "runs.h"
#include "world.h"

static void assert_fails(carom_status status, const carom_error *error, carom_status expected, const char *said)
{
	if (status != expected || error->status != expected || strncmp(error->text, said, strlen(said)) != 0)
		fail_msg("expected %s: \"%s ...\", got %s: \"%s\"", carom_status_name(expected), said, carom_status_name(status), error->text);
}

static void get_states(carom_world *world, size_t count, carom_body_state *states)
{
	carom_error error;
	scenery_check(carom_world_get_states(world, 0, count, states, &error), &error);
}

static void set_states(carom_world *world, size_t count, const carom_body_state *states)
{
	carom_error error;
	scenery_check(carom_world_set_states(world, 0, count, states, &error), &error);
}

/* ---- Ranges */

static void bodies_out_of_range(void **unused)
{
	(void)unused;
	carom_world *world = scenery_crowd(&scenery_devices[0], 1, 0);
	carom_body_state states[2] = {{{7.0f, 7.0f}, 7.0f, {7.0f, 7.0f}, 7.0f}}, untouched[2];
	carom_body_info info, same;
	carom_error error = {0};
	memcpy(untouched, states, sizeof states);
	memset(&info, 0x5A, sizeof info);
	same = info;
	assert_fails(carom_world_get_states(world, SCENERY_CROWD, 1, states, &error), &error, CAROM_INVALID_ARGUMENT,
		"bodies 40 to 41: the world has 40");
	assert_fails(carom_world_get_states(world, 39, 2, states, &error), &error, CAROM_INVALID_ARGUMENT, "bodies 39 to 41: ");
	assert_fails(carom_world_get_states(world, 1, SIZE_MAX, states, &error), &error, CAROM_INVALID_ARGUMENT, "bodies 1 to ");
	assert_fails(carom_world_set_states(world, 41, 0, states, &error), &error, CAROM_INVALID_ARGUMENT, "bodies 41 to 41: ");
	assert_fails(carom_world_get_body(world, SCENERY_CROWD, &info, &error), &error, CAROM_INVALID_ARGUMENT, "bodies 40 to 41: ");
	assert_fails(carom_world_get_body(world, UINT32_MAX, &info, &error), &error, CAROM_INVALID_ARGUMENT, "bodies 4294967295 to ");
	assert_fails(carom_world_set_force(world, SCENERY_CROWD, (carom_vec2){0, 0}, 0, &error), &error, CAROM_INVALID_ARGUMENT, "bodies 40 to 41: ");
	assert_memory_equal(states, untouched, sizeof states);
	assert_memory_equal(&info, &same, sizeof info);
	scenery_check(carom_world_get_states(world, SCENERY_CROWD, 0, NULL, &error), &error);
	scenery_check(carom_world_set_states(world, SCENERY_CROWD, 0, NULL, &error), &error);
	scenery_check(carom_world_add(world, NULL, 0, NULL, &error), &error);
	assert_int_equal(carom_world_body_count(world), SCENERY_CROWD);
	assert_fails(carom_world_add(world, NULL, (size_t)1 << 22, NULL, &error), &error, CAROM_LIMIT, "a world holds at most 4194304 bodies");
	carom_world_destroy(world);
}

/* Nothing is set if one of the states is wrong. */
static void assert_state_refused(carom_world *world, const carom_body_state *bad, const char *said)
{
	carom_body_state states[2];
	const uint64_t hash = runs_hash(world);
	carom_error error = {0};
	get_states(world, 1, states);
	states[0].position.x += 0.25f;
	states[1] = *bad;
	assert_fails(carom_world_set_states(world, 0, 2, states, &error), &error, CAROM_INVALID_ARGUMENT, said);
	assert_true(runs_hash(world) == hash);
}

static void states_out_of_range(void **unused)
{
	(void)unused;
	carom_world *world = scenery_crowd(&scenery_devices[0], 1, 0);
	const carom_body_state good = {{0.0f, 0.0f}, 0.0f, {0.0f, 0.0f}, 0.0f};
	for (size_t i = 0; i < sizeof good / sizeof(float); i++) {
		carom_body_state bad = good;
		((float *)(void *)&bad)[i] = i % 2 ? NAN : -INFINITY;
		assert_state_refused(world, &bad, "the state of body 1 has a number that is not finite");
	}
	carom_body_state outside = good;
	outside.position.y = 5.5f;
	assert_state_refused(world, &outside, "the position of body 1, (0, 5.5), is outside the room");
	carom_world_destroy(world);
}

/* What rounding leaves of a fast body's way may be outside, and then a run goes on from there. */
static void a_room_has_some_slack(void **unused)
{
	(void)unused;
	carom_world *world = scenery_crowd(&scenery_devices[0], 1, 0);
	carom_body_state state = {{0.0f, -5.009f}, 0.0f, {0.0f, 0.0f}, 0.0f};
	set_states(world, 1, &state);
	state.position.y = -5.02f;
	assert_state_refused(world, &state, "the position of body 1, (0, -5.02), is outside the room");
	state.velocity.x = -1e6f;
	set_states(world, 1, &state);
	carom_world_destroy(world);
}

/* However long a run is: where it would leave the floats it ends with the last good state, in whatever pieces it is done. */
static void a_run_ends_where_floats_do(void **unused)
{
	(void)unused;
	static const struct {
		float gravity;
		const char *said;
	} falls[] = {{-1e8f, "body 0: its place, or how far a step brings it, is too large"},
		{-1e10f, "body 0: its speed, or what a step of so much push adds to it, is"}};
	for (int i = 0; i < 2; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			for (uint64_t piece = 7; piece < 10000; piece *= 1000) {
				carom_world_def def = runs_def();
				const carom_body_def body = scenery_circle(1.0f, 0.0f, 0.0f, 0.0f, 0.5f);
				carom_error error = {0};
				carom_report report = {0};
				carom_status status = CAROM_OK;
				uint64_t steps = 0;
				def.gravity.y = falls[i].gravity;
				carom_world *world = runs_world(&def, device, &body, 1);
				if (!world)
					continue;
				for (; !status && steps < 7000; steps += report.steps)
					status = carom_world_step(world, piece, &report, &error);
				assert_int_equal(status, CAROM_LIMIT);
				assert_true(strstr(error.text, falls[i].said));
				assert_true(steps == (i == 0 ? 268 : 5) && runs_state(world, 0).position.y > -1e9f);
				runs_same_hash(&first, runs_hash(world), device);
				carom_world_destroy(world);
			}
		}
	}
}

static void static_bodies_keep_still(void **unused)
{
	(void)unused;
	carom_world_def def = carom_default_world_def();
	carom_body_def body = scenery_circle(1.0f, 2.0f, 0.0f, 0.0f, 0.5f);
	carom_body_state state = {{3.0f, 4.0f}, 1.0f, {0.0f, 0.0f}, 0.0f};
	carom_error error = {0};
	carom_world *world = scenery_world(&def, &scenery_devices[0]);
	body.is_static = true;
	scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
	set_states(world, 1, &state);
	state.velocity.x = 1.0f;
	assert_fails(carom_world_set_states(world, 0, 1, &state, &error), &error, CAROM_INVALID_ARGUMENT, "body 0 is static");
	state = (carom_body_state){{3.0f, 4.0f}, 1.0f, {0.0f, 0.0f}, 1.0f};
	assert_fails(carom_world_set_states(world, 0, 1, &state, &error), &error, CAROM_INVALID_ARGUMENT, "body 0 is static");
	assert_fails(carom_world_set_force(world, 0, (carom_vec2){1, 0}, 0, &error), &error, CAROM_INVALID_ARGUMENT, "body 0 is static");
	runs_step(world, 5);
	get_states(world, 1, &state);
	assert_true(state.position.x == 3.0f && state.position.y == 4.0f && state.angle == 1.0f);
	carom_world_destroy(world);
}

/* ---- States and forces */

/* What is set is read, with the same bits, before and after the device had it; an angle comes back in [-pi, pi]. */
static void states_come_back(void **unused)
{
	(void)unused;
	static const float numbers[] = {0.0f, -0.0f, 1e-40f, -3.25f, 1e30f, 3.1415925f, -3.1415927f, 3.1415927f};
	const size_t count = sizeof numbers / sizeof *numbers;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = carom_default_world_def();
		carom_world *world = scenery_world(&def, device);
		const carom_body_def body = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f);
		carom_error error;
		for (size_t i = 0; world && i < count; i++) {
			const float x = numbers[i], angle = fabsf(x) > 3.2f ? 1.0f : x;
			const carom_body_state set = {{x, -x}, angle, {x, 2.0f}, -x}, turned = {{x, -x}, 7.0f, {x, 2.0f}, -x};
			carom_body_state read[2];
			scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
			scenery_check(carom_world_set_states(world, (uint32_t)i, 1, &set, &error), &error);
			scenery_check(carom_textures_update(world, &error), &error);
			world->newest &= ~(unsigned)PLACE_HOST; /* as after a step */
			scenery_check(carom_world_get_states(world, (uint32_t)i, 1, read, &error), &error);
			assert_memory_equal(read, &set, sizeof set);
			scenery_check(carom_world_set_states(world, (uint32_t)i, 1, &turned, &error), &error);
			scenery_check(carom_world_get_states(world, (uint32_t)i, 1, read, &error), &error);
			assert_true(fabs((double)read->angle - (7.0 - 2.0 * 3.14159265358979)) < 1e-7);
		}
		carom_world_destroy(world);
	}
}

static void a_force_acts_from_now_on(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = carom_default_world_def();
		carom_body_def body = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f);
		carom_world *world = scenery_world(&def, device);
		carom_body_state state;
		carom_body_info info;
		carom_error error;
		if (!world)
			continue;
		body.mass = 2.0f;
		scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
		runs_step(world, 60);
		scenery_check(carom_world_set_force(world, 0, (carom_vec2){4.0f, -2.0f}, 0.5f, &error), &error);
		assert_fails(carom_world_set_force(world, 0, (carom_vec2){NAN, 0}, 0, &error), &error, CAROM_INVALID_ARGUMENT, "the force and torque");
		assert_fails(carom_world_set_force(world, 0, (carom_vec2){0, 0}, INFINITY, &error), &error, CAROM_INVALID_ARGUMENT, "the force");
		scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
		assert_true(info.force.x == 4.0f && info.force.y == -2.0f && info.torque == 0.5f);
		runs_step(world, 60);
		get_states(world, 1, &state);
		assert_true(fabsf(state.velocity.x - 2.0f) < 1e-5f && fabsf(state.velocity.y + 1.0f) < 1e-5f);
		assert_true(fabsf(state.angular_velocity - 0.5f) < 1e-5f && fabsf(state.position.x - 1.0f) < 1e-5f);
		carom_world_destroy(world);
	}
}

/* ---- Steps */

static void an_empty_world_steps(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = carom_default_world_def();
		carom_world *world = scenery_world(&def, device);
		carom_report report = {9, 9, 9, 9, 9.0};
		carom_error error;
		if (!world)
			continue;
		scenery_check(carom_world_step(world, 10, &report, &error), &error);
		assert_true(report.steps == 0 && report.hits == 0 && report.advanced == 0.0);
		report.steps = 9;
		scenery_check(carom_world_advance(world, 1.0, &report, &error), &error);
		assert_true(report.steps == 0 && report.advanced == 0.0 && carom_world_time(world) == 0.0);
		assert_true(runs_hash(world) == 14695981039346656037u); /* FNV-1a of nothing */
		carom_world_destroy(world);
	}
}

static void times_out_of_range(void **unused)
{
	(void)unused;
	static const double bad[] = {-1e-9, -INFINITY, INFINITY, NAN, 1e300};
	carom_world *world = scenery_crowd(&scenery_devices[0], 2, 0);
	const uint64_t hash = runs_hash(world);
	carom_report report = {9, 9, 9, 9, 9.0};
	carom_error error = {0};
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
		assert_fails(carom_world_advance(world, bad[i], &report, &error), &error, CAROM_INVALID_ARGUMENT, "seconds: found ");
	scenery_check(carom_world_advance(world, 0.0, &report, &error), &error);
	assert_true(report.steps == 0 && report.hits == 0 && report.advanced == 0.0 && runs_hash(world) == hash);
	report.steps = 9;
	scenery_check(carom_world_step(world, 0, &report, &error), &error);
	assert_true(report.steps == 0 && runs_hash(world) == hash && carom_world_time(world) == 0.0);
	scenery_check(carom_world_advance(world, 0.505, &report, &error), &error);
	assert_true(fabs(report.advanced - 0.505) < 1e-9 && fabs(carom_world_time(world) - 0.505) < 1e-9 && report.steps >= 31);
	carom_world_destroy(world);
}

/* Of less time than a float can divide by, as it is left where a float is not quite what was meant, too, nothing comes of it; and a step that
 * lasts no longer than that is one. */
static void the_shortest_times_pass(void **unused)
{
	(void)unused;
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	static const double times[] = {1e-320, 1e-40, 1e-38, 2e-38, 1e-37, 3e-36};
	const carom_body_def bodies[2] = {scenery_box(0.0f, 0.5f, 2.0f, -1.0f, 1.0f, 1.0f), scenery_circle(1.0f, 0.5f, -3.0f, 0.0f, 0.5f)};
	for (size_t i = 0; i < 3; i++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = runs_resting(steps[i], 5.0f, 5.0f);
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			for (size_t k = 0; k < sizeof times / sizeof *times; k++)
				runs_advance(world, times[k]);
			assert_true(isfinite(runs_measure(world).kinetic_energy) && carom_world_time(world) < 1e-35);
			runs_near((double)runs_state(world, 0).position.y, 0.5, 0.0);
			carom_world_destroy(world);
			def.time_step = LEAST_STEP;
			world = runs_world(&def, device, bodies, 2);
			assert_int_equal(runs_step(world, 5).steps, 5);
			assert_true(isfinite(runs_measure(world).kinetic_energy));
			runs_near((double)runs_state(world, 0).position.y, 0.5, 0.0);
			carom_world_destroy(world);
		}
	}
}

/* What of a body is beyond a wall at the start is not pushed back, but gets no farther; its centre must be inside. */
static void a_body_may_reach_through_a_wall(void **unused)
{
	(void)unused;
	const carom_world_def def = runs_room(5.0f, 5.0f);
	const carom_body_def bodies[3] = {scenery_circle(4.5f, -3.0f, 1.0f, 0.0f, 1.0f), scenery_circle(4.5f, 0.0f, 0.0f, 0.0f, 1.0f),
		scenery_box(4.5f, 3.0f, -1.0f, 0.0f, 2.0f, 2.0f)};
	const carom_body_def outside = scenery_circle(5.5f, 0.0f, -1.0f, 0.0f, 1.0f);
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = runs_world(&def, device, bodies, 3);
		carom_error error;
		if (!world)
			continue;
		assert_fails(carom_world_add(world, &outside, 1, NULL, &error), &error, CAROM_INVALID_ARGUMENT, "bodies[0].position: (5.5, 0) is outside");
		assert_int_equal(runs_step(world, 60).hits, 1);
		runs_near((double)runs_state(world, 0).position.x, 3.5, 1e-4);
		runs_near((double)runs_state(world, 1).position.x, 4.5, 0.0);
		runs_near((double)runs_state(world, 2).position.x, 3.5, 1e-4);
		carom_world_destroy(world);
	}
}

/* Bodies that come while others move change nothing of their state, also when the textures have to grow. */
static void growing_keeps_the_bits(void **unused)
{
	(void)unused;
	const carom_body_def more[30] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1e-3f)};
	SCENERY_EACH_DEVICE(device) {
		carom_world *grown = scenery_crowd(device, 3, 0), *made = scenery_crowd(device, 3, 0);
		carom_body_state before[SCENERY_CROWD], states[SCENERY_CROWD + 30];
		carom_body_def late[30];
		uint32_t first = 0;
		carom_error error;
		if (!grown)
			continue;
		for (int i = 0; i < 30; i++) {
			late[i] = more[0];
			late[i].position = (carom_vec2){-4.9f + 0.01f * (float)i, -4.9f};
		}
		runs_step(grown, 150);
		get_states(grown, SCENERY_CROWD, before);
		scenery_check(carom_world_add(grown, late, 30, &first, &error), &error);
		get_states(grown, SCENERY_CROWD + 30, states);
		assert_int_equal(first, SCENERY_CROWD);
		assert_memory_equal(states, before, sizeof before);
		scenery_check(carom_world_add(made, late, 30, NULL, &error), &error);
		set_states(made, SCENERY_CROWD + 30, states);
		assert_true(runs_step(grown, 100).hits == runs_step(made, 100).hits);
		assert_true(runs_hash(grown) == runs_hash(made));
		carom_world_destroy(grown);
		carom_world_destroy(made);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(bodies_out_of_range), cmocka_unit_test(states_out_of_range),
		cmocka_unit_test(a_room_has_some_slack), cmocka_unit_test(a_run_ends_where_floats_do), cmocka_unit_test(static_bodies_keep_still),
		cmocka_unit_test(states_come_back), cmocka_unit_test(a_force_acts_from_now_on), cmocka_unit_test(an_empty_world_steps),
		cmocka_unit_test(times_out_of_range), cmocka_unit_test(the_shortest_times_pass), cmocka_unit_test(a_body_may_reach_through_a_wall),
		cmocka_unit_test(growing_keeps_the_bits)};
	return cmocka_run_group_tests_name("world", tests, NULL, NULL);
}
