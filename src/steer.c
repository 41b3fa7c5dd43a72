/* Bodies between two steps: their states are read and changed, and what pushes them. Where the step events has them in its slots, it tells of few alone,
 * and changes are noted, and handed over together (tell.c) before it goes on. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "step/events.h"

#define MOST_PICKS 4 /* calls that pick bodies after a batch: who asks more often asks for all, one after the other */

/* Room for so many changes more, which then do not fail. */
static carom_status reserve(carom_world *world, size_t count, carom_error *error)
{
	const size_t size = count * sizeof(carom_change);
	if (!carom_array_grow(&world->changes, size))
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to change %zu bodies", count);
	world->changes.used -= size;
	return CAROM_OK;
}

/* The body's change: the one it has already, or a new one. */
static carom_change *change_of(carom_world *world, uint32_t index)
{
	carom_body *body = &carom_world_bodies(world)[index];
	carom_change *changes = world->changes.items;
	if (!body->change) {
		changes[carom_change_count(world)] = (carom_change){.body = index};
		world->changes.used += sizeof *changes;
		body->change = (uint32_t)carom_change_count(world);
	}
	return &changes[body->change - 1];
}

static carom_body_state state_of(const float *linear, const float *rotational)
{
	return (carom_body_state){
		{linear[LINEAR_X], linear[LINEAR_Y]}, rotational[ROTATIONAL_ANGLE], {linear[LINEAR_VX], linear[LINEAR_VY]}, rotational[ROTATIONAL_VELOCITY]};
}

/* Of few bodies, from their slots alone. */
static carom_status pick(carom_world *world, uint32_t first, uint32_t count, carom_body_state *states, carom_error *error)
{
	const uint32_t records = CHANGES_WIDTH * count;
	float *texels;
	world->events.picks++;
	TRY(carom_changes_send(world, error));
	TRY(carom_records_create(world, records, &texels, error));
	carom_status status = carom_run(world, STAGE_PICK, (int32_t)count, 1, (int32_t)first, 0, error);
	if (!status)
		status = world->device->kind->download(world->device, world->textures[ROLE_CHANGES].front, carom_row_count(records), texels, error);
	for (uint32_t k = 0; !status && k < count; k++)
		states[k] = state_of(texels + 4 * (CHANGES_WIDTH * k + CHANGES_PLACE), texels + 4 * (CHANGES_WIDTH * k + CHANGES_TURN));
	free(texels);
	return status;
}

static bool are_picked(const carom_world *world, size_t count)
{
	return count > 0 && carom_are_few(count, world->body_count) && world->events.picks < MOST_PICKS && !(world->newest & PLACE_HOST)
		&& carom_goes_on(world);
}

carom_status carom_world_get_states(carom_world *world, uint32_t first, size_t count, carom_body_state *states, carom_error *error)
{
	GIVEN(world, error);
	if (count > 0)
		GIVEN(states, error);
	TRY(carom_check_bodies(world, first, count, error));
	if (are_picked(world, count))
		return pick(world, first, (uint32_t)count, states, error);
	TRY(carom_textures_fetch(world, error));
	for (size_t i = 0; i < count; i++)
		states[i] = state_of((const float *)world->linear.items + 4 * (first + i), (const float *)world->rotational.items + 4 * (first + i));
	return CAROM_OK;
}

static carom_status check_state(const carom_world *world, uint32_t index, const carom_body_state *s, carom_error *error)
{
	const carom_body *body = &carom_world_bodies(world)[index];
	if (!carom_is_finite(s->position) || !carom_is_finite(s->velocity) || !isfinite(s->angle) || !isfinite(s->angular_velocity))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "the state of body %u has a number that is not finite", index);
	if (!body->is_kinematic && carom_outside_room(&world->def, s->position, s->velocity))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "the position of body %u, (%g, %g), is outside the room", index, (double)s->position.x,
			(double)s->position.y);
	if (body->is_static && (s->velocity.x != 0.0f || s->velocity.y != 0.0f || s->angular_velocity != 0.0f))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "body %u is static and can't be given a velocity", index);
	return CAROM_OK;
}

/* A body that the slots do not know has its state where it is to be told from. */
static bool is_known(const carom_world *world, uint32_t index)
{
	return index < world->events.known;
}

static void set_state(carom_world *world, uint32_t index, const carom_body_state *s)
{
	const float linear[4] = {[LINEAR_X] = s->position.x, [LINEAR_Y] = s->position.y, [LINEAR_VX] = s->velocity.x, [LINEAR_VY] = s->velocity.y};
	const float rotational[4] = {[ROTATIONAL_ANGLE] = carom_wrapped(s->angle),
		[ROTATIONAL_VELOCITY] = s->angular_velocity,
		[ROTATIONAL_RADIUS] = carom_world_bodies(world)[index].bound};
	if (carom_goes_on(world) && is_known(world, index)) {
		carom_change *change = change_of(world, index);
		change->moves = true;
		memcpy(change->linear, linear, sizeof linear);
		memcpy(change->rotational, rotational, sizeof rotational);
	}
	if (world->newest & PLACE_HOST || !is_known(world, index)) {
		memcpy((float *)world->linear.items + 4 * (size_t)index, linear, sizeof linear);
		memcpy((float *)world->rotational.items + 4 * (size_t)index, rotational, sizeof rotational);
	}
}

/* Who sets many and has not read them goes back to where they were, far from where they are: then it costs less to load all than to look for what is around each. */
static bool is_set_anew(const carom_world *world, size_t count)
{
	return !(world->newest & PLACE_HOST) && !carom_are_few(count, world->body_count);
}

carom_status carom_world_set_states(carom_world *world, uint32_t first, size_t count, const carom_body_state *states, carom_error *error)
{
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	if (count > 0)
		GIVEN(states, error);
	TRY(carom_check_bodies(world, first, count, error));
	for (size_t i = 0; i < count; i++)
		TRY(check_state(world, first + (uint32_t)i, &states[i], error));
	if (count == 0)
		return CAROM_OK;
	TRY(reserve(world, count, error));
	if (!carom_goes_on(world) || is_set_anew(world, count)) {
		TRY(carom_textures_fetch(world, error));
		world->newest = PLACE_HOST;
	}
	for (size_t i = 0; i < count; i++)
		set_state(world, first + (uint32_t)i, &states[i]);
	return CAROM_OK;
}

carom_status carom_world_set_force(carom_world *world, uint32_t index, carom_vec2 force, float torque, carom_error *error)
{
	carom_body *body;
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	TRY(carom_check_bodies(world, index, 1, error));
	body = &carom_world_bodies(world)[index];
	if (!carom_is_finite(force) || !isfinite(torque))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "the force and torque on body %u must be finite (N, N m)", index);
	if (!carom_is_dynamic(body) && (force.x != 0.0f || force.y != 0.0f || torque != 0.0f))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "body %u is %s and feels no force", index, body->is_static ? "static" : "kinematic");
	if (carom_goes_on(world)) {
		TRY(reserve(world, 1, error));
		if (is_known(world, index))
			change_of(world, index);
	} else {
		carom_load_anew(world);
	}
	body->force = force;
	body->torque = torque;
	return CAROM_OK;
}

carom_status carom_world_set_filter(carom_world *world, uint32_t index, uint32_t categories, uint32_t mask, carom_error *error)
{
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	TRY(carom_check_bodies(world, index, 1, error));
	carom_body *body = &carom_world_bodies(world)[index];
	if (body->categories == categories && body->mask == mask)
		return CAROM_OK;
	body->categories = categories;
	body->mask = mask;
	carom_tell_later(world, UNSENT_FILTERS);
	return CAROM_OK;
}

/* What the def says from now on, if that is allowed. */
static carom_status change_def(carom_world *world, const carom_world_def *def, carom_error *error)
{
	TRY(carom_check_idle(world, error));
	TRY(carom_check_world_def(def, error));
	world->def = *def;
	return CAROM_OK;
}

carom_status carom_world_set_gravity(carom_world *world, carom_vec2 gravity, carom_error *error)
{
	GIVEN(world, error);
	carom_world_def def = world->def;
	def.gravity = gravity;
	TRY(change_def(world, &def, error));
	carom_tell_later(world, UNSENT_GRAVITY);
	return CAROM_OK;
}

carom_status carom_world_set_time_step(carom_world *world, float time_step, carom_error *error)
{
	GIVEN(world, error);
	carom_world_def def = world->def;
	def.time_step = time_step;
	TRY(change_def(world, &def, error));
	carom_tell_later(world, UNSENT_TIME_STEP);
	return CAROM_OK;
}
