/* Bodies with many contacts, by the step contacts: they are borne as all others are, however many there are. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "runs.h"

#define BOXES 24 /* on a plank, */
#define PLANK BOXES
#define POSTS 2
#define LEFT_POST (BOXES + 1)
#define STANDING 180 /* steps, after which all is at rest */

#define ROWS 8 /* of a wall of bricks, */
#define BRICKS 8
#define WALL (ROWS * BRICKS)

#define BALLS 150 /* in a bed, on which a large one falls */

/* scenery_box remembers few shapes at a time, for so many bodies at once. */
static carom_body_def box_at(const carom_body_def *like, float x, float y)
{
	carom_body_def body = *like;
	body.position = (carom_vec2){x, y};
	return body;
}

/* ---- A plank that bears boxes, and lies on two posts */

/* The plank is behind the boxes, and the posts behind it, so that it has contacts before and after its own index. */
static carom_world *plank(const scenery_device *device)
{
	carom_world_def def = runs_resting("contacts", 20.0f, 12.0f);
	carom_body_def bodies[BOXES + 1 + POSTS];
	carom_body_def box = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f), post = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 2.0f);
	box.mass = 2.0f;
	post.is_static = true;
	def.friction = 0.5f;
	for (int i = 0; i < BOXES; i++)
		bodies[i] = box_at(&box, 1.2f * ((float)i - 0.5f * (BOXES - 1)), 3.01f);
	bodies[PLANK] = scenery_box(0.0f, 2.255f, 0.0f, 0.0f, 1.2f * BOXES, 0.5f);
	bodies[PLANK].mass = 20.0f;
	for (int i = 0; i < POSTS; i++)
		bodies[LEFT_POST + i] = box_at(&post, i ? 14.0f : -14.0f, 1.0f);
	return runs_world(&def, device, bodies, BOXES + 1 + POSTS);
}

/* To be given to free. */
static carom_contact *contacts_of(carom_world *world, size_t *count)
{
	carom_contact *contacts;
	carom_error error;
	scenery_check(carom_world_contact_count(world, count, &error), &error);
	contacts = calloc(*count + 1, sizeof *contacts);
	assert_non_null(contacts);
	scenery_check(carom_world_get_contacts(world, 0, *count, contacts, &error), &error);
	return contacts;
}

static double weight_on(const carom_contact *contacts, size_t count, uint32_t body, int32_t other)
{
	for (size_t i = 0; i < count; i++)
		if (contacts[i].body == body && contacts[i].other == other)
			return (double)contacts[i].normal[0] + (double)contacts[i].normal[1];
	return 0.0;
}

static void a_plank_bears_many(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = plank(device);
		size_t count;
		if (!world)
			continue;
		runs_step(world, runs_affordable(STANDING));
		runs_same_hash(&first, runs_hash(world), device);
		runs_enough(runs_step(world, 60).hits == 0);
		for (uint32_t i = 0; i <= PLANK; i++) {
			const carom_body_state state = runs_state(world, i);
			runs_near((double)state.position.y, i == PLANK ? 2.25 : 3.0, 0.002);
			runs_enough(state.velocity.x == 0.0f && state.velocity.y == 0.0f && state.angular_velocity == 0.0f);
		}
		carom_contact *contacts = contacts_of(world, &count);
		assert_true(count >= BOXES + POSTS);
		for (uint32_t i = 0; i < BOXES; i++)
			runs_enough(fabs(weight_on(contacts, count, PLANK, (int32_t)i) - 2.0 * (double)RUNS_GRAVITY) < 1.0);
		for (uint32_t i = LEFT_POST; i < LEFT_POST + POSTS; i++)
			runs_enough(fabs(weight_on(contacts, count, i, PLANK) - (0.5 * (2.0 * BOXES + 20.0)) * (double)RUNS_GRAVITY) < 6.0);
		free(contacts);
		carom_world_destroy(world);
	}
}

/* A world with its states and its contacts goes on with the same bits. */
static void their_forces_are_a_part_of_the_state(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = plank(device), *other = plank(device);
		carom_body_state states[BOXES + 1 + POSTS];
		carom_error error;
		size_t count;
		if (!world)
			continue;
		runs_step(world, 20);
		carom_contact *contacts = contacts_of(world, &count);
		scenery_check(carom_world_get_states(world, 0, BOXES + 1 + POSTS, states, &error), &error);
		for (uint32_t i = 0; i < BOXES + 1 + POSTS; i++)
			scenery_check(carom_world_set_states(other, i, 1, &states[i], &error), &error);
		runs_step(world, 10);
		const uint64_t expected = runs_hash(world);
		scenery_check(carom_world_set_contacts(other, count, contacts, &error), &error);
		runs_step(other, 10);
		assert_true(runs_hash(other) == expected);
		free(contacts);
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* ---- Lists that grow */

/* Bricks, each on two others, have more points and contacts than there is room for at first, but not before the upper half comes down, when the lower one has forces. With one more
 * body there is twice as much room. */
static carom_world *wall(const scenery_device *device, bool roomy)
{
	carom_world_def def = runs_resting("contacts", 20.0f, 12.0f);
	carom_body_def bodies[WALL + 1];
	const carom_body_def brick = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.5f);
	def.friction = 0.6f;
	for (int row = 0; row < ROWS; row++)
		for (int i = 0; i < BRICKS; i++)
			bodies[row * BRICKS + i] = box_at(&brick, (row < ROWS / 2 ? 1.02f : 1.0001f) * ((float)i + (row % 2 ? 0.5f : 0.0f)),
				0.2501f + 0.5001f * (float)row + (row < ROWS / 2 ? 0.0f : 0.2f + 0.01f * (float)row));
	bodies[WALL] = box_at(&brick, -15.0f, 5.0f);
	bodies[WALL].is_static = true;
	return runs_world(&def, device, bodies, roomy ? WALL + 1 : WALL);
}

static void what_has_no_room_gets_more(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = wall(device, false), *roomy = wall(device, true);
		size_t count, other_count;
		if (!world)
			continue;
		for (int call = 0; call < 5; call++) {
			runs_step(world, 5);
			runs_step(roomy, 5);
			carom_contact *contacts = contacts_of(world, &count), *others = contacts_of(roomy, &other_count);
			assert_true(count == other_count && count > (call < 4 ? 1 : 2) * WALL);
			assert_memory_equal(contacts, others, count * sizeof *contacts);
			free(contacts);
			free(others);
			for (uint32_t i = 0; i < WALL; i++) {
				const carom_body_state state = runs_state(world, i), other = runs_state(roomy, i);
				assert_memory_equal(&state, &other, sizeof state);
			}
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
		carom_world_destroy(roomy);
	}
}

/* ---- What falls on many */

/* A large ball falls into a bed of small ones: shocks get to more of them than a body has points for, and it comes to lie on many. */
static void a_large_ball_falls_on_many(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 3.0f, 12.0f);
		carom_body_def bodies[BALLS + 1];
		for (int i = 0; i < BALLS; i++) {
			const int row = i / 27, column = i % 27;
			bodies[i] = scenery_circle(-2.85f + 0.216f * (float)column + (row % 2 ? 0.05f : 0.0f), 0.11f + 0.21f * (float)row, 0.0f, 0.0f, 0.1f);
			bodies[i].friction = 0.4f;
		}
		bodies[BALLS] = scenery_circle(0.3f, 4.0f, 0.0f, -6.0f, 1.8f);
		bodies[BALLS].density = 1.0f;
		bodies[BALLS].friction = 0.4f;
		carom_world *world = runs_world(&def, device, bodies, BALLS + 1);
		if (!world)
			continue;
		const double before = runs_measure(world).kinetic_energy + runs_measure(world).potential_energy;
		runs_step(world, runs_affordable(240));
		runs_same_hash(&first, runs_hash(world), device);
		const carom_measure now = runs_measure(world);
		assert_true(now.kinetic_energy + now.potential_energy < before);
		runs_near(now.max_penetration, 0.0, 40.0 * (double)SLOP);
		runs_enough(now.kinetic_energy < 0.01);
		runs_enough(runs_step(world, 30).hits < 300);
		size_t count, touched = 0;
		carom_contact *contacts = contacts_of(world, &count);
		for (size_t i = 0; i < count; i++)
			touched += contacts[i].body == BALLS;
		runs_enough(touched > 12);
		free(contacts);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_plank_bears_many), cmocka_unit_test(their_forces_are_a_part_of_the_state),
		cmocka_unit_test(what_has_no_room_gets_more), cmocka_unit_test(a_large_ball_falls_on_many)};
	return cmocka_run_group_tests_name("many", tests, NULL, NULL);
}
