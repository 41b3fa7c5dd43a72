/* What is measured of a state, in double precision: sums over the bodies, and the deepest overlap.
 * SPDX-License-Identifier: MIT */
#include "penetration.h"
#include "status.h"

#include <stdlib.h>

typedef struct bodies {
	size_t count, corner_count;
	carom_body_state *states;
	carom_placed *placed;
	carom_corner *corners;
} bodies;

static void add_body(carom_measure *sum, const carom_body_info *body, const carom_body_state *state, carom_vec2 gravity)
{
	double m = (double)body->mass, inertia = (double)body->inertia, w = (double)state->angular_velocity;
	double x = (double)state->position.x, y = (double)state->position.y;
	double vx = (double)state->velocity.x, vy = (double)state->velocity.y;
	sum->kinetic_energy += (m * (vx * vx + vy * vy) + inertia * w * w) / 2;
	sum->potential_energy -= m * ((double)gravity.x * x + (double)gravity.y * y);
	sum->momentum_x += m * vx;
	sum->momentum_y += m * vy;
	sum->angular_momentum += m * (x * vy - y * vx) + inertia * w;
}

static carom_status count_bodies(const carom_world *world, bodies *b, carom_error *error)
{
	b->count = carom_world_body_count(world);
	for (uint32_t k = 0; k < b->count; k++) {
		carom_body_info body;
		carom_status status = carom_world_get_body(world, k, &body, error);
		if (status != CAROM_OK)
			return status;
		b->corner_count += body.vertex_count;
	}
	return CAROM_OK;
}

static carom_status allocate(bodies *b, carom_error *error)
{
	b->states = malloc(b->count * sizeof *b->states);
	b->placed = malloc(b->count * sizeof *b->placed);
	b->corners = malloc(b->corner_count * sizeof *b->corners);
	if (!b->states || !b->placed || !b->corners)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to measure %zu bodies", b->count);
	return CAROM_OK;
}

/* Reads the state, adds up the sums and puts every body in its place. */
static carom_status read_bodies(carom_world *world, bodies *b, carom_measure *sum, carom_error *error)
{
	carom_vec2 gravity = carom_world_get_def(world)->gravity;
	carom_corner *corners = b->corners;
	carom_status status = carom_world_get_states(world, 0, b->count, b->states, error);
	for (uint32_t k = 0; k < b->count && status == CAROM_OK; k++) {
		carom_body_info body;
		status = carom_world_get_body(world, k, &body, error);
		if (status != CAROM_OK)
			break;
		if (!body.is_static)
			add_body(sum, &body, &b->states[k], gravity);
		corners += carom_place_body(&b->placed[k], &body, &b->states[k], corners);
	}
	return status;
}

carom_status carom_world_measure(carom_world *world, carom_measure *measure, carom_error *error)
{
	GIVEN(world, error);
	GIVEN(measure, error);
	carom_measure sum = {0};
	bodies b = {0};
	carom_status status = count_bodies(world, &b, error);
	if (status != CAROM_OK || b.count == 0)
		goto done;
	status = allocate(&b, error);
	if (status == CAROM_OK)
		status = read_bodies(world, &b, &sum, error);
	if (status == CAROM_OK)
		status = carom_deepest_penetration(b.placed, b.count, carom_world_get_def(world), &sum.max_penetration, error);
done:
	if (status == CAROM_OK)
		*measure = sum;
	free(b.states);
	free(b.placed);
	free(b.corners);
	return status;
}
