/* SPDX-License-Identifier: MIT */
#include "wild.h"

#include <math.h>
#include <string.h>

#include "runs.h"

static bool is_dynamic(const wild_world *world, uint32_t body)
{
	return !world->bodies[body].is_static && !world->bodies[body].is_kinematic;
}

/* A pin's or slider's: often none, or two that are the same. */
static void make_drive(scenery_random *random, carom_joint *joint)
{
	if (wild_one_in(random, 4)) {
		joint->motor_speed = scenery_uniform(random, -5.0f, 5.0f);
		joint->motor_torque = wild_one_in(random, 6) ? 1e4f : scenery_uniform(random, 0.0f, 3.0f);
	}
	if (wild_one_in(random, 3)) {
		joint->has_stops = true;
		joint->lower_angle = scenery_uniform(random, -2.0f, 0.5f);
		joint->upper_angle = wild_one_in(random, 3) ? joint->lower_angle : joint->lower_angle + scenery_uniform(random, 0.0f, 3.0f);
	}
}

static void make_kind(scenery_random *random, uint32_t kinds, carom_joint *joint)
{
	static const float stiffnesses[] = {1.0f, 50.0f, 1e3f, 1e6f};
	joint->kind = (carom_joint_kind)(kinds < 5 ? kinds : wild_below(random, 5));
	if (joint->kind == CAROM_SPRING) {
		joint->stiffness = stiffnesses[wild_below(random, 4)];
		joint->damping = wild_one_in(random, 2) ? scenery_uniform(random, 0.0f, 5.0f) : 0.0f;
	} else if (joint->kind == CAROM_SLIDER) {
		joint->axis = scenery_uniform(random, -3.0f, 3.0f);
	}
	if (joint->kind == CAROM_REVOLUTE || joint->kind == CAROM_SLIDER)
		make_drive(random, joint);
}

/* A place in the world as the body has it. */
static carom_vec2 anchor_at(const carom_body_def *body, float x, float y)
{
	const float dx = x - body->position.x, dy = y - body->position.y, c = cosf(body->angle), s = sinf(body->angle);
	return (carom_vec2){c * dx + s * dy, c * dy - s * dx};
}

/* Of two bodies, or a body and the ground, if that can be; somewhere between them, or by their middles. */
static void add(scenery_random *random, uint32_t kinds, uint32_t body, int32_t other, wild_world *world)
{
	carom_joint *joint = &world->joints[world->joint_count];
	const carom_body_def *one = &world->bodies[body];
	const carom_vec2 to = other == CAROM_GROUND ? (carom_vec2){one->position.x + 0.5f, one->position.y + 0.75f} : world->bodies[other].position;
	const float part = wild_one_in(random, 3) ? scenery_uniform(random, 0.0f, 1.0f) : 0.5f;
	if (!is_dynamic(world, body) && (other == CAROM_GROUND || !is_dynamic(world, (uint32_t)other)))
		return;
	world->joint_count++;
	*joint = carom_default_joint();
	joint->body = body;
	joint->other = other;
	joint->collides = wild_one_in(random, 3);
	make_kind(random, kinds, joint);
	if (joint->kind == CAROM_REVOLUTE || joint->kind == CAROM_SLIDER) {
		joint->anchor = anchor_at(one, one->position.x + part * (to.x - one->position.x), one->position.y + part * (to.y - one->position.y));
		return;
	}
	joint->other_anchor = other == CAROM_GROUND ? to : (carom_vec2){0.0f, 0.0f};
	if (joint->kind == CAROM_ROPE)
		joint->length = scenery_uniform(random, 0.9f, 1.5f) * hypotf(to.x - one->position.x, to.y - one->position.y);
}

void wild_join(uint64_t seed, wild_world *world)
{
	scenery_random random = {seed ^ 4}; /* of its own: the bodies of a seed are kept */
	const char *step = carom_pipeline_get(&world->def.pipeline, "step");
	if (!wild_one_in(&random, 3) || !step || strcmp(step, "contacts") != 0)
		return;
	const uint32_t rare = 1 + wild_below(&random, 8), kinds = wild_below(&random, 10), side = (uint32_t)sqrtf((float)world->count);
	for (uint32_t row = 0; row < side; row++) {
		for (uint32_t column = 0; column < side; column++) {
			const uint32_t i = row * side + column;
			if (column + 1 < side && wild_one_in(&random, rare))
				add(&random, kinds, i, (int32_t)(i + 1), world);
			if (row + 1 < side && wild_one_in(&random, rare))
				add(&random, kinds, i + side, (int32_t)i, world);
			if (wild_one_in(&random, 16))
				add(&random, kinds, i, CAROM_GROUND, world);
		}
	}
}

carom_world *wild_create(const wild_world *world, const scenery_device *device)
{
	carom_world *made = runs_world(&world->def, device, world->bodies, world->count);
	carom_error error;
	if (made && world->joint_count > 0)
		scenery_check(carom_world_set_joints(made, world->joint_count, world->joints, &error), &error);
	return made;
}
