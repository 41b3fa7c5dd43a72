/* The forces at contacts: what they are, that they are a part of the state, and which are refused. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runs.h"

#define MOST 64
#define STANDING 60 /* steps */

typedef struct contact_list {
	size_t count;
	carom_contact all[MOST];
} contact_list;

static contact_list contacts_of(carom_world *world)
{
	contact_list list = {.count = 0};
	carom_error error;
	scenery_check(carom_world_contact_count(world, &list.count, &error), &error);
	assert_true(list.count <= MOST);
	scenery_check(carom_world_get_contacts(world, 0, list.count, list.all, &error), &error);
	return list;
}

static void set_contacts(carom_world *world, const contact_list *list)
{
	carom_error error;
	scenery_check(carom_world_set_contacts(world, list->count, list->all, &error), &error);
}

static carom_body_def ball(float x, float y)
{
	carom_body_def body = scenery_circle(x, y, 0.0f, 0.0f, 0.5f);
	body.mass = 2.0f;
	return body;
}

static carom_body_def box(float x, float y)
{
	carom_body_def body = scenery_box(x, y, 0.0f, 0.0f, 1.0f, 1.0f);
	body.mass = 3.0f;
	return body;
}

/* ---- What they are */

static void is_contact(const carom_contact *contact, uint32_t body, int32_t other, double left, double right)
{
	assert_true(contact->body == body && contact->other == other);
	runs_near((double)contact->normal[0], left, 0.02 * left + 0.3);
	runs_near((double)contact->normal[1], right, right > 0 ? 0.02 * right + 0.3 : 0.0);
}

/* Two balls stand upon each other, two boxes on the ground and at a wall, and another box on a plate that does not move, where it leans to the right. */
static void forces_are_weights(void **unused)
{
	(void)unused;
	contact_list first = {.count = 0};
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 8.0f, 8.0f);
		carom_body_def bodies[] = {
			ball(0.0f, 0.501f), ball(0.0f, 1.502f), box(-5.0f, 0.501f), scenery_box(4.0f, 2.0f, 0.0f, 0.0f, 2.0f, 1.0f), box(4.75f, 3.001f)};
		bodies[3].is_static = true;
		carom_world *world = runs_world(&def, device, bodies, 5);
		if (!world)
			continue;
		runs_step(world, STANDING);
		const contact_list list = contacts_of(world);
		assert_int_equal(list.count, 4);
		is_contact(&list.all[0], 0, CAROM_WALL_BOTTOM, 40.0, 0.0);
		is_contact(&list.all[1], 1, 0, 20.0, 0.0);
		is_contact(&list.all[2], 2, CAROM_WALL_BOTTOM, 15.0, 15.0);
		is_contact(&list.all[3], 4, 3, 10.0, 20.0); /* 0.5 m of it is on the left, and 0.25 m on the right, of its centre */
		assert_true(!first.count || memcmp(&first, &list, sizeof first) == 0);
		first = list;
		carom_world_destroy(world);
	}
}

/* What gravity pulls to the right friction holds: to the left, as the ground sees it. */
static void friction_is_what_pulls(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 8.0f, 8.0f);
		def.gravity.x = 2.0f;
		def.friction = 0.5f;
		const carom_body_def body = box(0.0f, 0.501f);
		carom_world *world = runs_world(&def, device, &body, 1);
		if (!world)
			continue;
		runs_step(world, STANDING);
		const contact_list list = contacts_of(world);
		assert_int_equal(list.count, 1);
		is_contact(&list.all[0], 0, CAROM_WALL_BOTTOM, 12.0, 18.0); /* it leans by 3 kg x 2 m/s^2 at an arm of half a meter */
		runs_near((double)list.all[0].friction[0] + (double)list.all[0].friction[1], 6.0, 0.02);
		carom_world_destroy(world);
	}
}

/* ---- They are a part of the state */

static void build_pyramid(carom_body_def *bodies, uint32_t rows)
{
	for (uint32_t row = 0, i = 0; row < rows; row++)
		for (uint32_t k = 0; k < rows - row; k++)
			bodies[i++] = box(1.02f * ((float)k - 0.5f * (float)(rows - row - 1)), 0.501f + 1.001f * (float)row);
}

enum { ROWS = 5, PYRAMID = ROWS * (ROWS + 1) / 2 };

static carom_world *pyramid(const scenery_device *device, float friction)
{
	carom_world_def def = runs_resting("contacts", 12.0f, 12.0f);
	carom_body_def bodies[PYRAMID];
	def.friction = friction;
	build_pyramid(bodies, ROWS);
	return runs_world(&def, device, bodies, PYRAMID);
}

static void take_states(carom_world *to, carom_world *from)
{
	carom_body_state states[MOST];
	carom_error error;
	const size_t count = carom_world_body_count(from);
	scenery_check(carom_world_get_states(from, 0, count, states, &error), &error);
	scenery_check(carom_world_set_states(to, 0, count, states, &error), &error);
}

/* A world goes on from another one's states with the same bits if it has its contacts, too; without these it finds others. */
static void states_and_contacts_are_all(void **unused)
{
	(void)unused;
	for (int rubs = 0; rubs < 2; rubs++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const float friction = rubs ? 0.5f : 0.0f;
			carom_world *world = pyramid(device, friction), *next = pyramid(device, friction), *without = pyramid(device, friction);
			if (!world)
				continue;
			runs_step(world, STANDING / 2);
			const contact_list list = contacts_of(world);
			assert_true(list.count > PYRAMID);
			take_states(next, world);
			take_states(without, world);
			set_contacts(next, &list);
			assert_true(runs_hash(next) == runs_hash(without));
			const uint64_t hash = runs_hash_after(world, STANDING, 6);
			assert_true(runs_hash_after(next, STANDING, 1) == hash);
			assert_true(runs_hash_after(without, STANDING, 1) != hash);
			runs_same_hash(&first, hash, device);
		}
	}
}

/* More bodies, for which the device's textures are made anew, leave them as they are; so does one that is the first to rub. */
static void they_outlive_what_is_added(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = pyramid(device, 0.0f), *next = pyramid(device, 0.0f);
		carom_body_def more[2 * PYRAMID];
		carom_error error;
		if (!world)
			continue;
		for (int i = 0; i < 2 * PYRAMID; i++) {
			more[i] = ball(-11.0f + 0.7f * (float)i, 10.0f);
			more[i].is_static = true;
			more[i].mass = 0.0f;
		}
		more[0].friction = 0.5f;
		runs_step(world, STANDING / 2);
		const contact_list list = contacts_of(world);
		runs_step(world, 1); /* the device is ahead of what was read */
		const contact_list ahead = contacts_of(world);
		assert_memory_not_equal(&list, &ahead, sizeof list);
		scenery_check(carom_world_add(world, more, 2 * PYRAMID, NULL, &error), &error);
		const contact_list after = contacts_of(world);
		assert_memory_equal(&ahead, &after, sizeof after);
		scenery_check(carom_world_add(next, more, 2 * PYRAMID, NULL, &error), &error);
		take_states(next, world);
		set_contacts(next, &after);
		assert_true(runs_hash_after(world, STANDING, 1) == runs_hash_after(next, STANDING, 1));
	}
}

/* Steps that have no use for them forget them. */
static void other_steps_forget_them(void **unused)
{
	(void)unused;
	static const char *const steps[] = {"events", "first_impact"};
	SCENERY_EACH_DEVICE(device) {
		for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
			carom_world_def def = runs_resting(steps[i], 4.0f, 4.0f);
			const carom_body_def body = ball(0.0f, 2.0f);
			const contact_list list = {1, {{0, CAROM_WALL_BOTTOM, {20.0f, 0.0f}, {0.0f, 0.0f}, 0}}};
			carom_world *world = runs_world(&def, device, &body, 1);
			if (!world)
				continue;
			set_contacts(world, &list);
			assert_int_equal(contacts_of(world).count, 1);
			runs_step(world, 1);
			assert_int_equal(contacts_of(world).count, 0);
			carom_world_destroy(world);
		}
	}
}

/* What nobody can bear, or what does not touch, is let go of. */
static void wrong_forces_do_no_harm(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 4.0f, 4.0f);
		const carom_body_def bodies[] = {ball(0.0f, 0.501f), ball(2.0f, 0.501f)};
		const contact_list list = {4,
			{{1, 0, {3e38f, 1e30f}, {-3e38f, 0.0f}, 0}, {0, CAROM_WALL_BOTTOM, {3e38f, 3e38f}, {3e38f, -3e38f}, 0},
				{0, CAROM_WALL_TOP, {1e9f, 0.0f}, {1e9f, 0.0f}, 0}, {1, CAROM_WALL_BOTTOM, {1e4f, 0.0f}, {0.0f, 0.0f}, 0}}};
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_step(world, 1);
		set_contacts(world, &list);
		runs_step(world, 2 * STANDING);
		for (uint32_t i = 0; i < 2; i++) {
			runs_near((double)runs_state(world, i).position.y, 0.5, 1e-3);
			is_contact(&contacts_of(world).all[i], i, CAROM_WALL_BOTTOM, 20.0, 0.0);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- Which are refused */

static void refuse(carom_world *world, const contact_list *list, const char *said)
{
	carom_error error = {.status = CAROM_OK};
	const contact_list before = contacts_of(world);
	assert_int_equal(carom_world_set_contacts(world, list->count, list->all, &error), CAROM_INVALID_ARGUMENT);
	if (error.status != CAROM_INVALID_ARGUMENT || !strstr(error.text, said))
		fail_msg("expected \"%s\", found \"%s\"", said, error.text);
	const contact_list after = contacts_of(world);
	assert_memory_equal(&before, &after, sizeof after);
}

static void wrong_contacts_are_refused(void **unused)
{
	static const struct {
		contact_list list;
		const char *said;
	} wrong[] = {
		{{1, {{5, 0, {0}, {0}, 0}}}, "contacts[0].body: found 5, the world has 5 bodies"},
		{{2, {{1, 0, {0}, {0}, 0}, {0, 0, {0}, {0}, 0}}}, "contacts[1].other: found 0, must be the index of a body before body 0, or of a wall"},
		{{1, {{1, -5, {0}, {0}, 0}}}, "contacts[0].other: found -5"},
		{{1, {{1, 2, {0}, {0}, 0}}}, "contacts[0].other: found 2"},
		{{1, {{4, 3, {0}, {0}, 0}}}, "contacts[0]: one of the two must be dynamic, and body 4 is static"},
		{{1, {{4, -1, {0}, {0}, 0}}}, "contacts[0]: one of the two must be dynamic, and body 4 is static"},
		{{1, {{1, 0, {1.0f, -1.0f}, {0}, 0}}}, "contacts[0].normal: found -1, must be finite and at least 0 (N)"},
		{{1, {{1, 0, {NAN, 0}, {0}, 0}}}, "contacts[0].normal: found "},
		{{1, {{1, 0, {INFINITY, 0}, {0}, 0}}}, "contacts[0].normal: found inf"},
		{{1, {{1, 0, {0}, {0, NAN}, 0}}}, "contacts[0].friction: must be two finite numbers (N)"},
		{{3, {{1, 0, {0}, {0}, 0}, {2, 0, {0}, {0}, 0}, {1, 0, {1}, {0}, 0}}}, "contacts: body 1 has more than one with body 0"},
		{{2, {{1, -2, {0}, {0}, 0}, {1, -2, {1}, {0}, 0}}}, "contacts: body 1 has more than one with wall -2"},
		{{3, {{1, 0, {0}, {0}, 0}, {1, 0, {0}, {0}, 3}, {1, 0, {1}, {0}, 3}}}, "contacts: body 1 has more than one with body 0"},
		{{1, {{1, 0, {0}, {0}, 4}}}, "contacts[0].part: found 4, must be from 0 to 3"},
		{{1, {{1, -2, {0}, {0}, 1}}}, "contacts[0].part: found 1, must be 0 with a wall"},
	};
	(void)unused;
	carom_world_def def = runs_resting("contacts", 20.0f, 8.0f);
	carom_body_def bodies[] = {ball(0, 1), ball(2, 1), ball(4, 1), ball(6, 1), ball(8, 1)};
	bodies[3].is_static = bodies[4].is_static = true;
	bodies[3].mass = bodies[4].mass = 0.0f;
	carom_world *world = runs_world(&def, &scenery_devices[0], bodies, 5);
	const contact_list good = {2, {{3, 2, {1, 2}, {3, 4}, 0}, {1, 0, {5, 6}, {7, 8}, 0}}}, sorted = {2, {good.all[1], good.all[0]}};
	carom_contact one;
	carom_error error;
	set_contacts(world, &good);
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
		refuse(world, &wrong[i].list, wrong[i].said);
	const contact_list now = contacts_of(world);
	assert_memory_equal(&now, &sorted, sizeof now);
	assert_int_equal(carom_world_get_contacts(world, 1, 2, &one, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "contacts 1 to 3: the world has 2");

	carom_world_destroy(world);

	def.has_room = false;
	world = runs_world(&def, &scenery_devices[0], bodies, 5);
	refuse(world, &(contact_list){1, {{1, CAROM_WALL_LEFT, {0}, {0}, 0}}}, "contacts[0].other: found a wall, but there is no room");
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(forces_are_weights), cmocka_unit_test(friction_is_what_pulls),
		cmocka_unit_test(states_and_contacts_are_all), cmocka_unit_test(they_outlive_what_is_added), cmocka_unit_test(other_steps_forget_them),
		cmocka_unit_test(wrong_forces_do_no_harm), cmocka_unit_test(wrong_contacts_are_refused)};
	return cmocka_run_group_tests_name("warm", tests, NULL, NULL);
}
