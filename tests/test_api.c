/* The public functions' errors and edges: statuses, definitions, names, devices, ranges of bodies, states and forces.
 * SPDX-License-Identifier: MIT */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "count.h"
#include "scenery.h"

/* `status` with an error that begins with `said`. */
static void assert_fails(carom_status status, const carom_error *error, carom_status expected, const char *said)
{
	if (status != expected || error->status != expected || strncmp(error->text, said, strlen(said)) != 0)
		fail_msg("expected %s: \"%s ...\", got %s: \"%s\"", carom_status_name(expected), said, carom_status_name(status), error->text);
}

/* ---- Statuses, versions */

static void statuses_have_names(void **unused)
{
	(void)unused;
#define CHECK_NAME(name, sentence)                                        \
	assert_string_equal(carom_status_name(CAROM_##name), "CAROM_" #name); \
	assert_string_equal(carom_status_text(CAROM_##name), sentence);
	CAROM_STATUS_LIST(CHECK_NAME)
#undef CHECK_NAME
	assert_string_equal(carom_status_name((carom_status)99), "CAROM_?");
	assert_string_equal(carom_status_name((carom_status)-1), "CAROM_?");
	assert_non_null(carom_status_text((carom_status)99));
}

static void version_is_the_headers(void **unused)
{
	(void)unused;
	char version[32];
	snprintf(version, sizeof version, "%d.%d.%d", CAROM_VERSION_MAJOR, CAROM_VERSION_MINOR, CAROM_VERSION_PATCH);
	assert_string_equal(carom_version(), version);
}

/* ---- The definition of a world */

static void assert_refused(const carom_world_def *def, carom_status expected, const char *said)
{
	carom_world *world = (carom_world *)&world;
	carom_error error = {0};
	assert_fails(carom_world_create(def, &world, &error), &error, expected, said);
	assert_ptr_equal(world, (carom_world *)&world);
}

#define REFUSE(said, field, value)                          \
	do {                                                    \
		carom_world_def bad = carom_default_world_def();    \
		bad.device = "cpu";                                 \
		bad.has_room = true;                                \
		bad.room_min = (carom_vec2){-1.0f, -2.0f};          \
		bad.room_max = (carom_vec2){1.0f, 2.0f};            \
		bad.field = (value);                                \
		assert_refused(&bad, CAROM_INVALID_ARGUMENT, said); \
	} while (0)

static void definitions_out_of_range(void **unused)
{
	(void)unused;
	static const float no_numbers[] = {NAN, INFINITY, -INFINITY};
	for (size_t i = 0; i < COUNT(no_numbers); i++) {
		REFUSE("time_step: found ", time_step, no_numbers[i]);
		REFUSE("gravity: must be two finite numbers", gravity.x, no_numbers[i]);
		REFUSE("gravity: must be two finite numbers", gravity.y, no_numbers[i]);
		REFUSE("restitution: found ", restitution, no_numbers[i]);
		REFUSE("friction: found ", friction, no_numbers[i]);
		REFUSE("rolling_friction: found ", rolling_friction, no_numbers[i]);
		REFUSE("linear_damping: found ", linear_damping, no_numbers[i]);
		REFUSE("angular_damping: found ", angular_damping, no_numbers[i]);
		REFUSE("epsilon: found ", epsilon, no_numbers[i]);
		REFUSE("room: min and max must be two finite numbers", room_min.x, no_numbers[i]);
		REFUSE("room: min and max must be two finite numbers", room_min.y, no_numbers[i]);
		REFUSE("room: min and max must be two finite numbers", room_max.x, no_numbers[i]);
		REFUSE("room: min and max must be two finite numbers", room_max.y, no_numbers[i]);
	}
	REFUSE("time_step: found 0, must be finite and at least 1.17549435e-38", time_step, 0.0f);
	REFUSE("time_step: found -0.5, must be finite and at least", time_step, -0.5f);
	REFUSE("time_step: found 1.17549421e-38, must be finite and at least", time_step, nextafterf(FLT_MIN, 0.0f));
	REFUSE("restitution: found -0.5, must be from 0 to 1", restitution, -0.5f);
	REFUSE("restitution: found 1.5, must be from 0 to 1", restitution, 1.5f);
	REFUSE("friction: found -0.5, must be from 0 to 1000", friction, -0.5f);
	REFUSE("friction: found 1001, must be from 0 to 1000", friction, 1001.0f);
	REFUSE("rolling_friction: found -0.5, must be from 0 to 1000", rolling_friction, -0.5f);
	REFUSE("linear_damping: found -0.5, must be finite and at least 0 (1/s)", linear_damping, -0.5f);
	REFUSE("angular_damping: found -0.5, must be finite and at least 0 (1/s)", angular_damping, -0.5f);
	REFUSE("epsilon: found 0, must be from 2^-22 to 0.5", epsilon, 0.0f);
	REFUSE("epsilon: found 1.19209e-07, must be from 2^-22 to 0.5", epsilon, FLT_EPSILON);
	REFUSE("epsilon: found 0.75, must be from 2^-22 to 0.5", epsilon, 0.75f);
	REFUSE("threads: found 257, must be from 1 to 256, or 0", threads, 257);
	REFUSE("room: min (1, -2) must be below max (1, 2)", room_min.x, 1.0f);
	REFUSE("room: min (-1, 2.5) must be below max (1, 2)", room_min.y, 2.5f);
}

static void definitions_in_range(void **unused)
{
	(void)unused;
	carom_world_def def = carom_default_world_def();
	char device[] = "cpu", aabb[] = "loose";
	carom_error error;
	def.device = device;
	def.pipeline.aabb = aabb;
	def.epsilon = 2.0f * FLT_EPSILON;
	def.restitution = 0.0f;
	def.room_min = (carom_vec2){NAN, 1.0f}; /* no room: not looked at */
	def.time_step = 0.25f;
	for (int i = 0; i < 2; i++) {
		carom_world *world = NULL;
		device[0] = 'c';
		aabb[0] = 'l';
		scenery_check(carom_world_create(&def, &world, &error), &error);
		device[0] = aabb[0] = 'x';
		assert_string_equal(carom_world_get_def(world)->device, "cpu");
		assert_string_equal(carom_world_get_def(world)->pipeline.aabb, "loose");
		assert_null(carom_world_get_def(world)->pipeline.toi);
		assert_true(carom_world_get_def(world)->time_step == 0.25f && carom_world_get_def(world)->epsilon == def.epsilon);
		assert_true(carom_world_time(world) == 0.0 && carom_world_body_count(world) == 0);
		carom_world_destroy(world);
		def.epsilon = 0.5f;
		def.restitution = 1.0f;
	}
}

/* More halvings in a pass than there can be are all in one pass. */
static void any_number_of_iterations(void **unused)
{
	(void)unused;
	static const uint32_t iterations[] = {0, 22, 64, 1u << 24, INT32_MAX, UINT32_MAX};
	const carom_body_def bodies[2] = {scenery_box(-1.5f, 0.0f, 2.0f, 0.1f, 1.0f, 1.0f), scenery_circle(1.0f, 0.1f, -1.0f, 0.0f, 0.5f)};
	uint64_t hashes[COUNT(iterations)];
	for (size_t i = 0; i < COUNT(iterations); i++) {
		carom_world_def def = scenery_first_impact();
		carom_world *world = NULL;
		carom_report report;
		carom_error error;
		def.device = "cpu";
		def.pipeline.toi = "bisection";
		def.time_step = 0.25f;
		def.iterations = iterations[i];
		scenery_check(carom_world_create(&def, &world, &error), &error);
		scenery_check(carom_world_add(world, bodies, 2, NULL, &error), &error);
		scenery_check(carom_world_step(world, 8, &report, &error), &error);
		scenery_check(carom_world_hash(world, &hashes[i], &error), &error);
		assert_true(report.hits > 0 && hashes[i] == hashes[0]);
		carom_world_destroy(world);
	}
}

/* What a step could not compute with is refused by it, and by nothing else; the state stays. */
static void assert_no_start(carom_world_def def, carom_body_def body, const char *said)
{
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	for (size_t i = 0; i < COUNT(steps); i++) {
		carom_world *world = NULL;
		carom_body_state state;
		carom_report report = {9, 9, 9, 9, 9.0};
		carom_error error = {0};
		def.device = "cpu";
		def.pipeline.step = steps[i];
		scenery_check(carom_world_create(&def, &world, &error), &error);
		scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
		assert_fails(carom_world_step(world, 1, &report, &error), &error, CAROM_LIMIT, said);
		assert_fails(carom_world_advance(world, 1.0, NULL, &error), &error, CAROM_LIMIT, said);
		scenery_check(carom_world_get_states(world, 0, 1, &state, &error), &error);
		assert_true(report.steps == 0 && carom_world_time(world) == 0 && state.position.x == body.position.x && state.velocity.y == body.velocity.y);
		state = (carom_body_state){.position = {1e9f, 0.0f}};
		if (!strcmp(said, "body 0: its place")) {
			scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
			scenery_check(carom_world_step(world, 1, NULL, &error), &error);
		}
		carom_world_destroy(world);
	}
}

static void steps_start_within_floats(void **unused)
{
	(void)unused;
	const carom_world_def def = carom_default_world_def();
	carom_world_def falling = def, slow = def, wide = def;
	const carom_body_def far = scenery_circle(1.0001e9f, 0.0f, 0.0f, 0.0f, 1.0f), fast = scenery_circle(0.0f, 0.0f, 0.0f, -FLT_MAX, 1.0f);
	carom_body_def here = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 1.0f), pushed = here, heavy = here, spinning = here;
	assert_no_start(def, far, "body 0: its place");
	assert_no_start(def, fast, "body 0: its speed");
	pushed.force.y = FLT_MAX;
	assert_no_start(def, pushed, "body 0: its speed");
	spinning.angular_velocity = 2e9f;
	assert_no_start(def, spinning, "body 0: its speed");
	falling.gravity.x = -1e11f;
	assert_no_start(falling, here, "body 0: its speed");
	slow.time_step = 1e30f;
	here.velocity.x = 1.0f;
	assert_no_start(slow, here, "body 0: its way in one step");
	wide.has_room = true;
	wide.room_min = (carom_vec2){-1e10f, -1.0f};
	wide.room_max = (carom_vec2){1.0f, 1.0f};
	assert_no_start(wide, here, "body 0: the room");
	heavy.mass = 1e36f;
	heavy.velocity.x = 10.0f;
	assert_no_start(def, heavy, "a body of 1e+36 kg");
	wide.room_min.x = -1.0f;
	wide.time_step = 1e5f;
	wide.gravity.y = -10.0f;
	here.velocity.x = 0.0f;
	assert_no_start(wide, here, "body 0: its way in one step");
	falling.gravity.x = 0.0f;
	falling.time_step = 1e6f;
	here.velocity.x = 2e3f;
	assert_no_start(falling, here, "body 0: its place, or how far a step brings it,");
}

/* What falls gets no farther than that, however often it is asked to. */
static void steps_end_within_floats(void **unused)
{
	static const char *const steps[] = {"events", "contacts", "first_impact"};
	(void)unused;
	for (size_t i = 0; i < COUNT(steps); i++) {
		carom_world_def def = carom_default_world_def();
		const carom_body_def body = scenery_circle(0.0f, 0.0f, 5e8f, 0.0f, 1.0f);
		carom_world *world = NULL;
		carom_body_state state;
		carom_error error = {0};
		def.device = "cpu";
		def.gravity.y = -1e6f;
		def.pipeline.step = steps[i];
		scenery_check(carom_world_create(&def, &world, &error), &error);
		scenery_check(carom_world_add(world, &body, 1, NULL, &error), &error);
		for (uint64_t k = 1; k <= 1000000; k *= 100) {
			const carom_status expected = k <= 100 ? CAROM_OK : CAROM_LIMIT;
			assert_int_equal(carom_world_step(world, k, NULL, &error), expected);
			scenery_check(carom_world_get_states(world, 0, 1, &state, &error), &error);
			assert_true(fabsf(state.position.x) <= 1e9f && fabsf(state.position.y) <= 1e9f);
		}
		carom_world_destroy(world);
	}
}

/* ---- Names */

static void unknown_names_list_the_known(void **unused)
{
	(void)unused;
	carom_pipeline pipeline = {0};
	carom_world_def def = carom_default_world_def();
	carom_error error = {0};
	assert_fails(carom_pipeline_set(&pipeline, "toy", "separating", &error), &error, CAROM_UNKNOWN_NAME, "there is no slot 'toy'");
	assert_non_null(strstr(error.text, "step, aabb, overlap, inside, toi, walls, reduce, impulse"));
	assert_fails(carom_pipeline_set(&pipeline, "forward", "collision", &error), &error, CAROM_UNKNOWN_NAME, "there is no slot 'forward'");
	assert_fails(carom_pipeline_set(&pipeline, "toi", "guess", &error), &error, CAROM_UNKNOWN_NAME, "the slot 'toi' has no alternative 'guess'");
	assert_non_null(strstr(error.text, "bisection, circle_quadratic, separating"));
	assert_null(pipeline.toi);
	assert_fails(carom_pipeline_set(&pipeline, "step", "", &error), &error, CAROM_UNKNOWN_NAME, "the slot 'step' has no alternative ''");
	assert_non_null(strstr(error.text, "first_impact"));
	assert_string_equal(carom_pipeline_get(&pipeline, "toi"), "circle_quadratic");
	assert_int_equal(carom_pipeline_set(&pipeline, "toi", "separating", NULL), CAROM_OK);
	assert_string_equal(carom_pipeline_get(&pipeline, "toi"), "separating");
	assert_null(carom_pipeline_get(&pipeline, "toy"));
	def.pipeline.reduce = "seven";
	assert_refused(&def, CAROM_UNKNOWN_NAME, "the slot 'reduce' has no alternative 'seven'; it has classic, four_six, six, tiled");
}

/* Every slot's alternatives, one of them the default; each may be chosen where there is a choice, and is then used. */
static void stages_are_listed(void **unused)
{
	(void)unused;
	carom_stage_info info;
	const carom_pipeline empty = {0};
	size_t count = 0, chosen = 0, defaults = 0;
	for (; carom_stage_list(count, &info); count++) {
		const char *standard = carom_pipeline_get(&empty, info.slot);
		carom_world_def def = carom_default_world_def();
		carom_world *world = NULL;
		carom_error error = {0};
		def.device = "cpu";
		defaults += info.is_default;
		assert_true(info.on_opencl && info.on_cpu);
		assert_true(!standard || info.is_default == !strcmp(standard, info.alternative));
		if (carom_pipeline_set(&def.pipeline, info.slot, info.alternative, &error)) {
			assert_fails(error.status, &error, CAROM_UNKNOWN_NAME, "there is no slot");
			continue;
		}
		chosen++;
		scenery_check(carom_world_create(&def, &world, &error), &error);
		assert_string_equal(carom_pipeline_get(&carom_world_get_def(world)->pipeline, info.slot), info.alternative);
		carom_world_destroy(world);
	}
	assert_true(chosen >= 17 && count > chosen && defaults >= 10 && defaults < count);
	assert_false(carom_stage_list(count + 1, &info));
	assert_false(carom_stage_list(SIZE_MAX, &info));
}

/* ---- Devices */

static void devices_are_listed(void **unused)
{
	(void)unused;
	carom_device_info *list = NULL;
	size_t count = 0, fallbacks = 0;
	carom_error error;
	scenery_check(carom_device_list_create(&list, &count, &error), &error);
	for (size_t i = 0; i < count; i++) {
		assert_true(list[i].is_default == (i == 0));
		assert_true(list[i].works == (list[i].reason[0] == 0));
		assert_true(list[i].compute_units > 0 && list[i].memory > 0 && list[i].max_allocation > 0);
		if (list[i].is_opencl)
			continue;
		fallbacks++;
		assert_true(list[i].works && list[i].exact && list[i].is_cpu);
	}
	assert_int_equal(fallbacks, 1);
	assert_true(list[0].works);
	carom_device_list_destroy(list);
}

/* The name of the device that `name` gets; the environment's where it is NULL. */
static bool opens_cpu(const char *name)
{
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	carom_device_info info;
	carom_error error;
	def.device = name;
	scenery_check(carom_world_create(&def, &world, &error), &error);
	scenery_check(carom_world_get_device(world, &info, &error), &error);
	carom_world_destroy(world);
	return !info.is_opencl;
}

/* Some runtimes call their device by its processor's name, as the CPU fallback does: the first one of the list counts. */
static void check_device_called(const carom_device_info *list, const char *name)
{
	size_t first = 0;
	while (!strstr(list[first].name, name) && !strstr(list[first].platform, name))
		first++;
	assert_true(opens_cpu(name) == !list[first].is_opencl);
}

static void devices_by_name(void **unused)
{
	(void)unused;
	carom_world_def def = carom_default_world_def();
	carom_device_info *list = NULL;
	size_t count = 0;
	scenery_check(carom_device_list_create(&list, &count, NULL), NULL);
	def.device = "abacus";
	assert_refused(&def, CAROM_UNKNOWN_NAME, "there is no device 'abacus'; use auto, cpu, opencl or part of one of these names: '");
	def.device = "";
	assert_refused(&def, CAROM_INVALID_ARGUMENT, "device: found \"\", must be auto, cpu, opencl or part of a name, or NULL");
	assert_true(opens_cpu("cpu") && opens_cpu("CPU") && opens_cpu("caRoM"));
	assert_true(opens_cpu("auto") == !list[0].is_opencl);
	for (size_t i = 0; i < count; i++) {
		if (!list[i].is_opencl || !list[i].works)
			continue;
		assert_false(opens_cpu("OpenCL"));
		check_device_called(list, list[i].platform);
		check_device_called(list, list[i].name);
	}
	setenv("CAROM_DEVICE", "cpu", 1);
	assert_true(opens_cpu(NULL));
	setenv("CAROM_DEVICE", "", 1);
	assert_true(opens_cpu(NULL) == opens_cpu("auto"));
	setenv("CAROM_DEVICE", "abacus", 1);
	assert_true(opens_cpu("cpu"));
	def.device = NULL;
	assert_refused(&def, CAROM_UNKNOWN_NAME, "CAROM_DEVICE: there is no device 'abacus'");
	unsetenv("CAROM_DEVICE");
	assert_true(opens_cpu(NULL) == opens_cpu("auto"));
	carom_device_list_destroy(list);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(statuses_have_names), cmocka_unit_test(version_is_the_headers),
		cmocka_unit_test(definitions_out_of_range), cmocka_unit_test(definitions_in_range), cmocka_unit_test(any_number_of_iterations),
		cmocka_unit_test(steps_start_within_floats), cmocka_unit_test(steps_end_within_floats), cmocka_unit_test(unknown_names_list_the_known),
		cmocka_unit_test(stages_are_listed), cmocka_unit_test(devices_are_listed), cmocka_unit_test(devices_by_name)};
	return cmocka_run_group_tests_name("api", tests, NULL, NULL);
}
