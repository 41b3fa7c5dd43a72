/* How a device computes: each number is made visible by a body's motion. In a step of 1 s a body of mass m, pushed by 1 N, gets the speed 1 / m.
 * SPDX-License-Identifier: MIT */
#include "carom_check.h"

#include <math.h>
#include <string.h>

enum { ROWS = 16, COUNT = ROWS * ROWS, PAIRS = COUNT, BODIES = COUNT + 2 * PAIRS };

static const float gravity = -9.8125f, apart = 100.0f, tiny = 1e-40f;

/* Numbers in [0, 1) with all their bits, the same everywhere. */
static float next_number(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (float)(*state >> 8) / 16777216.0f;
}

static carom_body_def circle_at(int place, float x, float radius)
{
	carom_body_def body = carom_default_body_def();
	body.shape = CAROM_CIRCLE;
	body.radius = radius;
	body.position = (carom_vec2){apart * (float)(place % ROWS) + x, apart * (float)(place / ROWS)};
	return body;
}

/* COUNT bodies alone, then pairs of which one flies at the other. The first body alone is hardly moved at all. */
static void make_bodies(carom_body_def *bodies)
{
	uint32_t state = 1;
	for (int i = 0; i < COUNT; i++) {
		bodies[i] = circle_at(i, 0, 0.5f);
		bodies[i].mass = 1 + next_number(&state);
		bodies[i].force = (carom_vec2){1, 1 + next_number(&state)};
	}
	bodies[0].force.x = 0;
	bodies[0].velocity.x = tiny;
	for (int i = 0; i < PAIRS; i++) {
		carom_body_def *pair = &bodies[COUNT + 2 * i];
		pair[0] = circle_at(COUNT + i, 0, 0.5f + next_number(&state));
		pair[1] = circle_at(COUNT + i, 5, 0.5f + next_number(&state));
		pair[1].position.y += 0.5f * next_number(&state);
		pair[1].velocity = (carom_vec2){-6 - next_number(&state), next_number(&state) - 0.5f};
	}
}

static carom_status states_after(const carom_world_def *def, const carom_body_def *bodies, carom_body_state *states, carom_error *error)
{
	carom_world *world = NULL;
	carom_status status = carom_world_create(def, &world, error);
	if (!status)
		status = carom_world_add(world, bodies, BODIES, NULL, error);
	if (!status)
		status = carom_world_step(world, 1, NULL, error);
	if (!status)
		status = carom_world_get_states(world, 0, BODIES, states, error);
	carom_world_destroy(world);
	return status;
}

static void judge_alone(const carom_body_def *body, const carom_body_state *state, struct numbers_found *found)
{
	const float inverse = 1.0f / body->mass, push = body->force.y * inverse, twice = gravity + push, once = fmaf(body->force.y, inverse, gravity);
	found->count++;
	found->quotients += state->velocity.x == body->velocity.x + body->force.x * inverse;
	found->contracted += state->velocity.y == once && once != twice;
}

carom_status find_numbers(const carom_world_def *def, struct numbers_found *found, carom_error *error)
{
	static carom_body_def bodies[BODIES];
	static carom_body_state states[2][BODIES];
	carom_world_def numbers = *def;
	carom_status status;
	numbers.time_step = 1;
	numbers.gravity.y = gravity;
	make_bodies(bodies);
	status = states_after(&numbers, bodies, states[0], error);
	numbers.device = "cpu";
	if (!status)
		status = states_after(&numbers, bodies, states[1], error);
	if (status)
		return status;
	memset(found, 0, sizeof *found);
	for (int i = 1; i < COUNT; i++)
		judge_alone(&bodies[i], &states[0][i], found);
	found->denormals = states[0][0].velocity.x == tiny && states[0][0].position.x == tiny;
	for (int i = COUNT; i < BODIES; i += 2) {
		found->hits++;
		found->roots += !memcmp(&states[0][i], &states[1][i], 2 * sizeof states[0][i]);
	}
	return CAROM_OK;
}
