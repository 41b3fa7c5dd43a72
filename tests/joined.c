/* SPDX-License-Identifier: MIT */
#include "joined.h"

#include <math.h>

/* Without a room, and without loss in hits. */
carom_world_def joined_free(float gravity)
{
	carom_world_def def = carom_default_world_def();
	def.pipeline.step = "contacts";
	def.gravity = (carom_vec2){0.0f, -gravity};
	return def;
}

carom_joint joined_pin(uint32_t body, int32_t other, float x, float y)
{
	carom_joint joint = carom_default_joint();
	joint.body = body;
	joint.other = other;
	joint.anchor = (carom_vec2){x, y};
	return joint;
}

carom_joint joined_rod(uint32_t body, int32_t other, float other_x, float other_y)
{
	carom_joint joint = joined_pin(body, other, 0.0f, 0.0f);
	joint.kind = CAROM_DISTANCE;
	joint.other_anchor = (carom_vec2){other_x, other_y};
	return joint;
}

void joined_set(carom_world *world, size_t count, const carom_joint *joints)
{
	carom_error error;
	scenery_check(carom_world_set_joints(world, count, joints, &error), &error);
}

carom_joint joined_get(carom_world *world, size_t k)
{
	carom_joint joint;
	carom_error error;
	scenery_check(carom_world_get_joints(world, k, 1, &joint, &error), &error);
	return joint;
}

carom_body_info joined_info(carom_world *world, uint32_t body)
{
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, body, &info, &error), &error);
	return info;
}

void joined_place(carom_world *world, int32_t body, carom_vec2 anchor, double *x, double *y)
{
	carom_body_state state = {.angle = 0.0f};
	if (body != CAROM_GROUND)
		state = runs_state(world, (uint32_t)body);
	const double c = cos((double)state.angle), s = sin((double)state.angle);
	*x = (double)state.position.x + c * (double)anchor.x - s * (double)anchor.y;
	*y = (double)state.position.y + s * (double)anchor.x + c * (double)anchor.y;
}

/* How far the worst joint is from where it belongs, m. */
double joined_slack(carom_world *world)
{
	double worst = 0.0;
	for (size_t k = 0; k < carom_world_joint_count(world); k++) {
		const carom_joint joint = joined_get(world, k);
		double x, y, other_x, other_y;
		joined_place(world, (int32_t)joint.body, joint.anchor, &x, &y);
		joined_place(world, joint.other, joint.other_anchor, &other_x, &other_y);
		worst = fmax(worst, fabs(hypot(x - other_x, y - other_y) - (double)joint.length));
	}
	return worst;
}

/* Bars of 1 m from (0, 0) to the right, or balls on rods, that turn about it as one. */
carom_world *joined_chain(const scenery_device *device, bool of_rods, float gravity, float turning)
{
	carom_world_def def = joined_free(gravity);
	carom_body_def bodies[JOINED_LINKS];
	carom_joint joints[JOINED_LINKS];
	for (int i = 0; i < JOINED_LINKS; i++) {
		const float x = of_rods ? (float)i + 1.0f : (float)i + 0.5f;
		bodies[i] = of_rods ? scenery_circle(x, 0.0f, 0.0f, turning * x, 0.2f) : scenery_box(x, 0.0f, 0.0f, turning * x, 1.0f, 0.2f);
		bodies[i].angular_velocity = turning;
		joints[i] = of_rods ? joined_rod((uint32_t)i, i - 1, 0.0f, 0.0f) : joined_pin((uint32_t)i, i - 1, -0.5f, 0.0f);
	}
	carom_world *world = runs_world(&def, device, bodies, JOINED_LINKS);
	if (world)
		joined_set(world, JOINED_LINKS, joints);
	return world;
}
