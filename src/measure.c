/* What is measured of a state, in double precision: sums over the bodies, and the deepest overlap.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "penetration.h"
#include "status.h"

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

static carom_status add_bodies(carom_world *world, carom_measure *sum, carom_error *error)
{
	const carom_vec2 gravity = carom_world_get_def(world)->gravity;
	const size_t count = carom_world_body_count(world);
	carom_status status = CAROM_OK;
	for (uint32_t k = 0; k < count && status == CAROM_OK; k++) {
		carom_body_info body;
		carom_body_state state;
		status = carom_world_get_body(world, k, &body, error);
		if (status == CAROM_OK)
			status = carom_world_get_states(world, k, 1, &state, error);
		if (status == CAROM_OK && isfinite(body.mass))
			add_body(sum, &body, &state, gravity);
	}
	return status;
}

carom_status carom_world_measure(carom_world *world, carom_measure *measure, carom_error *error)
{
	GIVEN(world, error);
	GIVEN(measure, error);
	carom_measure sum = {0};
	carom_crowd crowd;
	carom_status status = carom_crowd_make(world, CAROM_MASK, "measure", &crowd, error);
	if (status == CAROM_OK)
		status = add_bodies(world, &sum, error);
	if (status == CAROM_OK) {
		sum.max_penetration = carom_deepest_penetration(&crowd, world);
		*measure = sum;
	}
	carom_crowd_free(&crowd);
	return status;
}
