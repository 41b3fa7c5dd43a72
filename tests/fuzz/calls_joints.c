/* Calls that join bodies.
 * SPDX-License-Identifier: MIT */
#include "calls.h"

#include <string.h>

/* What such a joint has of its own; or anything. */
static void drive(calls *c, carom_joint *joint)
{
	const bool tame = c->bytes.tame, is_slider = joint->kind == CAROM_SLIDER, is_spring = joint->kind == CAROM_SPRING;
	if (is_spring || !tame) {
		joint->stiffness = tame ? bytes_between(&c->bytes, 1, 100) : bytes_wild(&c->bytes);
		joint->damping = tame ? bytes_between(&c->bytes, 0, 5) : bytes_wild(&c->bytes);
	}
	if (is_slider || !tame)
		joint->axis = tame ? bytes_between(&c->bytes, -5, 5) : bytes_wild(&c->bytes);
	if (is_slider || joint->kind == CAROM_REVOLUTE || !tame) {
		joint->motor_speed = tame ? bytes_between(&c->bytes, -5, 5) : bytes_wild(&c->bytes);
		joint->motor_torque = tame ? bytes_between(&c->bytes, 0, 5) : bytes_wild(&c->bytes);
		joint->has_stops = bytes_below(&c->bytes, 2) > 0;
		joint->lower_angle = tame ? bytes_between(&c->bytes, -2, 0) : bytes_wild(&c->bytes);
		joint->upper_angle = tame ? bytes_between(&c->bytes, 0, 2) : bytes_wild(&c->bytes);
	}
}

/* What is set can be read, and set again; else nothing is changed. */
static void set_joints(calls *c)
{
	enum { MOST = 3 };
	carom_joint joints[MOST], now[MOST], again[MOST];
	carom_error error = fuzz_blank();
	const size_t count = bytes_below(&c->bytes, MOST + 1), had = carom_world_joint_count(*c->slot);
	const snapshot before = calls_look(c);
	for (size_t k = 0; k < count; k++) {
		joints[k] = carom_default_joint();
		joints[k].kind = (carom_joint_kind)bytes_below(&c->bytes, c->bytes.tame ? 5 : 7);
		joints[k].body = calls_index(c);
		joints[k].other = (int32_t)calls_index(c) - 1;
		joints[k].collides = bytes_below(&c->bytes, 2) > 0;
		joints[k].anchor.x = c->bytes.tame ? bytes_between(&c->bytes, -2, 2) : bytes_wild(&c->bytes);
		if (bytes_below(&c->bytes, 2) > 0)
			joints[k].length = c->bytes.tame ? bytes_between(&c->bytes, 1, 3) : bytes_wild(&c->bytes);
		joints[k].force[0] = c->bytes.tame ? bytes_between(&c->bytes, -50, 50) : bytes_wild(&c->bytes);
		drive(c, &joints[k]);
	}
	if (!calls_judge(c, carom_world_set_joints(*c->slot, count, joints, &error), &error)) {
		FUZZ_EXPECT(carom_world_joint_count(*c->slot) == had);
		calls_same(c, before);
		return;
	}
	FUZZ_EXPECT(carom_world_joint_count(*c->slot) == count);
	FUZZ_EXPECT(carom_world_get_joints(*c->slot, 0, count, now, NULL) == CAROM_OK);
	FUZZ_EXPECT(carom_world_get_joints(*c->slot, 0, count + 1, again, NULL) == CAROM_INVALID_ARGUMENT);
	FUZZ_EXPECT(carom_world_set_joints(*c->slot, count, now, NULL) == CAROM_OK);
	FUZZ_EXPECT(carom_world_get_joints(*c->slot, 0, count, again, NULL) == CAROM_OK);
	FUZZ_EXPECT(count == 0 || memcmp(now, again, count * sizeof *now) == 0);
	calls_same(c, before);
}

/* A joint that is none, or no pin, has no motor. */
static void set_motor(calls *c)
{
	const bool tame = c->bytes.tame;
	const size_t joint = calls_index(c), has = carom_world_joint_count(*c->slot);
	const float speed = tame ? bytes_between(&c->bytes, -5, 5) : bytes_wild(&c->bytes);
	const float torque = tame ? bytes_between(&c->bytes, 0, 5) : bytes_wild(&c->bytes);
	const snapshot before = calls_look(c);
	carom_error error = fuzz_blank();
	carom_joint now;
	if (calls_judge(c, carom_world_set_motor(*c->slot, joint, speed, torque, &error), &error)) {
		FUZZ_EXPECT(joint < has && carom_world_get_joints(*c->slot, joint, 1, &now, NULL) == CAROM_OK);
		FUZZ_EXPECT(now.motor_speed == speed && now.motor_torque == torque && torque >= 0);
	}
	calls_same(c, before);
}

void calls_join(calls *c)
{
	if (bytes_chance(&c->bytes, 3))
		set_motor(c);
	else
		set_joints(c);
}
