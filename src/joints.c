/* What holds bodies together: the host's list of joints, and its way to the device (Joints and Joined in kernels/CONTRACT.md) and back. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "anchor.h"
#include "layout.h"
#include "status.h"
#include "step/events.h"

#define MOST_JOINTS (1u << 24)

size_t carom_joint_count(const carom_world *world)
{
	return world->joints.used / sizeof(carom_joint);
}

/* ---- The device's copy ---- */

static carom_status no_memory(size_t count, carom_error *error)
{
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to move %zu joints", count);
}

static float kind_of(carom_joint_kind kind)
{
	switch (kind) {
	case CAROM_REVOLUTE: return JOINT_PIN;
	case CAROM_DISTANCE: return JOINT_ROD;
	case CAROM_ROPE: return JOINT_ROPE;
	case CAROM_SLIDER: return JOINT_SLIDER;
	default: return JOINT_SPRING;
	}
}

/* How much a force at an anchor moves it, at most. */
static double gives_at(const carom_world *world, int32_t body, carom_vec2 anchor)
{
	if (body == CAROM_GROUND)
		return 0;
	const carom_body *own = &carom_world_bodies(world)[body];
	const double x = (double)anchor.x, y = (double)anchor.y;
	return 1 / (double)own->mass + (x * x + y * y) / (double)own->inertia;
}

static void fill_drive(const carom_world *world, const carom_joint *joint, float *drive)
{
	const double lower = (double)joint->lower_angle, upper = (double)joint->upper_angle;
	if (joint->kind != CAROM_REVOLUTE && joint->kind != CAROM_SLIDER) {
		drive[SPRING_STIFFNESS] = joint->stiffness;
		drive[SPRING_DAMPING] = joint->damping;
		drive[DRIVE_GIVES] = (float)(gives_at(world, (int32_t)joint->body, joint->anchor) + gives_at(world, joint->other, joint->other_anchor));
		return;
	}
	drive[DRIVE_SPEED] = joint->motor_speed;
	drive[DRIVE_TORQUE] = joint->motor_torque;
	drive[DRIVE_MIDDLE] = joint->has_stops ? (float)(0.5 * (lower + upper)) : 0.0f;
	drive[DRIVE_HALF] = joint->has_stops ? (float)(0.5 * (upper - lower)) : -1.0f;
}

static void fill_records(const carom_world *world, float *records)
{
	const carom_joint *joints = world->joints.items;
	for (size_t k = 0; k < carom_joint_count(world); k++, records += 4 * JOINT_WIDTH) {
		float *parties = records + 4 * JOINT_PARTIES, *anchors = records + 4 * JOINT_ANCHORS;
		parties[JOINT_BODY] = (float)joints[k].body;
		parties[JOINT_OTHER] = (float)joints[k].other;
		parties[JOINT_LENGTH] = joints[k].kind == CAROM_SLIDER ? joints[k].axis : joints[k].length;
		parties[JOINT_KIND] = kind_of(joints[k].kind);
		memcpy(anchors, &joints[k].anchor, sizeof joints[k].anchor);
		memcpy(anchors + 2, &joints[k].other_anchor, sizeof joints[k].other_anchor);
		memcpy(records + 4 * JOINT_FORCES + JOINT_FORCE, joints[k].force, sizeof joints[k].force);
		memcpy(records + 4 * JOINT_FORCES + JOINT_TORQUE, joints[k].torque, sizeof joints[k].torque);
		fill_drive(world, &joints[k], records + 4 * JOINT_DRIVE);
	}
}

/* From the last joint on, so that a body's are in order. */
static void fill_joined(const carom_world *world, int32_t *list)
{
	const carom_joint *joints = world->joints.items;
	const uint32_t bodies = world->capacity;
	list[JOINED_COUNT] = (int32_t)carom_joint_count(world);
	list[JOINED_BODIES] = (int32_t)bodies;
	if (carom_joint_count(world) == 0)
		return;
	memset(list + JOINED_FIRST, 0xFF, (size_t)bodies * sizeof *list);
	for (size_t k = carom_joint_count(world); k-- > 0;)
		for (int side = 0; side < 2; side++) {
			const int32_t body = side ? joints[k].other : (int32_t)joints[k].body;
			if (body == CAROM_GROUND)
				continue;
			int32_t *first = &list[JOINED_FIRST + body];
			list[JOINED_NEXT(bodies, 2 * k + (size_t)side)] = *first;
			*first = (int32_t)(2 * k) + side;
		}
}

/* Items of the two lists: one record at least, and the head. */
static uint32_t record_count(const carom_world *world)
{
	return carom_joint_count(world) > 0 ? JOINT_WIDTH * (uint32_t)carom_joint_count(world) : 1;
}

static uint32_t joined_count(const carom_world *world)
{
	const size_t count = carom_joint_count(world);
	return count > 0 ? (uint32_t)JOINED_NEXT(world->capacity, 2 * count) : JOINED_FIRST;
}

/* Room for so many items of a size, in whole rows; to be given to free. */
static void *rows_create(uint32_t items, size_t size)
{
	return calloc((size_t)carom_row_count(items) * carom_row_width(items), size);
}

static carom_status make_room(carom_world *world, carom_error *error)
{
	const uint32_t room = (uint32_t)carom_joint_count(world) + 1; /* 0: not made yet */
	if (world->events.joint_room == room)
		return CAROM_OK;
	world->events.joint_room = 0;
	TRY(carom_events_create_list(world, ROLE_JOINTS, false, record_count(world), error));
	TRY(carom_events_create_list(world, ROLE_JOINED, false, joined_count(world), error));
	world->events.joint_room = room;
	return CAROM_OK;
}

carom_status carom_joints_send(carom_world *world, carom_error *error)
{
	const carom_device_class *kind = world->device->kind;
	const uint32_t records = record_count(world), joined = joined_count(world);
	TRY(make_room(world, error));
	float *texels = rows_create(records, 4 * sizeof *texels);
	int32_t *list = rows_create(joined, sizeof *list);
	carom_status status = CAROM_OK;
	if (texels && list) {
		fill_records(world, texels);
		fill_joined(world, list);
		status = kind->upload(world->device, world->textures[ROLE_JOINTS].front, carom_row_count(records), texels, error);
		if (!status)
			status = kind->upload(world->device, world->textures[ROLE_JOINED].front, carom_row_count(joined), list, error);
	} else {
		status = no_memory(carom_joint_count(world), error);
	}
	free(texels);
	free(list);
	world->driven.used = 0;
	return status;
}

/* Each once, for the device changes them side by side. How many there are. */
static uint32_t sort_driven(uint32_t *driven, size_t count)
{
	uint32_t left = 0;
	qsort(driven, count, sizeof *driven, carom_compare_indices);
	for (size_t k = 0; k < count; k++)
		if (left == 0 || driven[k] != driven[left - 1])
			driven[left++] = driven[k];
	return left;
}

carom_status carom_joints_drive(carom_world *world, carom_error *error)
{
	uint32_t *driven = world->driven.items;
	const carom_joint *joints = world->joints.items;
	float *texels;
	if (world->driven.used == 0)
		return CAROM_OK;
	const uint32_t count = sort_driven(driven, world->driven.used / sizeof *driven);
	TRY(carom_records_create(world, count, &texels, error));
	for (uint32_t k = 0; k < count; k++) {
		texels[4 * k + DRIVEN_JOINT] = (float)driven[k];
		texels[4 * k + DRIVEN_SPEED] = joints[driven[k]].motor_speed;
		texels[4 * k + DRIVEN_TORQUE] = joints[driven[k]].motor_torque;
	}
	TRY(carom_records_send(world, count, texels, error));
	TRY(carom_run(world, STAGE_DRIVE, (int32_t)count, 1, 0, 0, error));
	world->driven.used = 0;
	return CAROM_OK;
}

carom_status carom_joints_fetch(carom_world *world, carom_error *error)
{
	carom_joint *joints = world->joints.items;
	const size_t count = carom_joint_count(world);
	if (count == 0 || world->events.joint_room != count + 1)
		return CAROM_OK;
	const uint32_t records = record_count(world);
	float *texels = rows_create(records, 4 * sizeof *texels);
	if (!texels)
		return no_memory(count, error);
	const carom_status status = world->device->kind->download(world->device, world->textures[ROLE_JOINTS].front, carom_row_count(records), texels,
		error);
	for (size_t k = 0; !status && k < count; k++) {
		const float *forces = texels + 4 * (JOINT_WIDTH * k + JOINT_FORCES);
		memcpy(joints[k].force, forces + JOINT_FORCE, sizeof joints[k].force);
		memcpy(joints[k].torque, forces + JOINT_TORQUE, sizeof joints[k].torque);
	}
	free(texels);
	return status;
}

void carom_joints_close(carom_world *world, const uint32_t *numbers, uint32_t gone)
{
	carom_joint *joints = world->joints.items;
	size_t left = 0;
	for (size_t k = 0; k < carom_joint_count(world); k++) {
		carom_joint joint = joints[k];
		if (numbers[joint.body] == gone || (joint.other != CAROM_GROUND && numbers[joint.other] == gone))
			continue;
		joint.body = numbers[joint.body];
		joint.other = joint.other == CAROM_GROUND ? CAROM_GROUND : (int32_t)numbers[joint.other];
		joints[left++] = joint;
	}
	world->joints.used = left * sizeof *joints;
	carom_apart_find(&world->apart, joints, left);
}

/* ---- The interface ---- */

carom_joint carom_default_joint(void)
{
	return (carom_joint){.other = CAROM_GROUND, .other_anchor = {NAN, NAN}, .length = NAN};
}

size_t carom_world_joint_count(const carom_world *world)
{
	return world ? carom_joint_count(world) : 0;
}

carom_status carom_world_get_joints(carom_world *world, size_t first, size_t count, carom_joint *joints, carom_error *error)
{
	GIVEN(world, error);
	if (count > 0)
		GIVEN(joints, error);
	TRY(carom_contacts_fetch(world, error)); /* with which the forces come */
	TRY(carom_check_span("joints", first, count, "the world has", carom_joint_count(world), error));
	if (count > 0)
		memcpy(joints, (const carom_joint *)world->joints.items + first, count * sizeof *joints);
	return CAROM_OK;
}

/* The state of a body; of the world, NULL. */
static carom_status state_of(carom_world *world, int32_t body, carom_body_state *room, const carom_body_state **state, carom_error *error)
{
	*state = body == CAROM_GROUND ? NULL : room;
	return body == CAROM_GROUND ? CAROM_OK : carom_world_get_states(world, (uint32_t)body, 1, room, error);
}

/* What was not said is as it is now. */
static carom_status complete(carom_world *world, carom_joint *joint, carom_error *error)
{
	carom_body_state rooms[2];
	const carom_body_state *own, *other;
	double x, y, other_x, other_y, s = 0, c = 1;
	TRY(state_of(world, (int32_t)joint->body, &rooms[0], &own, error));
	TRY(state_of(world, joint->other, &rooms[1], &other, error));
	carom_anchor_place(own, joint->anchor, &x, &y);
	if (isnan(joint->other_anchor.x) && isnan(joint->other_anchor.y)) {
		if (other)
			carom_sincos((double)other->angle, &s, &c);
		const double dx = x - (other ? (double)other->position.x : 0), dy = y - (other ? (double)other->position.y : 0);
		joint->other_anchor = (carom_vec2){(float)(c * dx + s * dy), (float)(c * dy - s * dx)};
	}
	if (!joint->has_stops)
		joint->lower_angle = joint->upper_angle = 0.0f;
	if (carom_joint_turns(joint)) {
		joint->length = 0.0f;
		joint->force[1] = joint->kind == CAROM_SLIDER ? 0.0f : joint->force[1];
		return CAROM_OK;
	}
	carom_anchor_place(other, joint->other_anchor, &other_x, &other_y);
	joint->length = isnan(joint->length) ? (float)sqrt((x - other_x) * (x - other_x) + (y - other_y) * (y - other_y)) : joint->length;
	joint->force[1] = joint->kind == CAROM_ROPE ? joint->force[1] : 0.0f;
	joint->torque[0] = joint->torque[1] = 0.0f;
	return CAROM_OK;
}

static carom_status check_all(carom_world *world, size_t count, carom_joint *joints, carom_error *error)
{
	if (world->step != &carom_step_contacts)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints: the step %s holds none; take the step contacts", world->step->name);
	for (size_t k = 0; k < count; k++) {
		TRY(carom_joint_check_parties(world, k, &joints[k], error));
		TRY(complete(world, &joints[k], error));
		TRY(carom_joint_check_numbers(world, k, &joints[k], error));
	}
	return CAROM_OK;
}

/* In the order of their bodies, of one body as they are: so they are written, and read again. */
static carom_status sort(const carom_world *world, const carom_joint *joints, size_t count, carom_joint *sorted, carom_error *error)
{
	size_t *ends = calloc(world->body_count + 1, sizeof *ends); /* of the joints of each body, so far */
	if (!ends)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for %zu joints", count);
	for (size_t k = 0; k < count; k++)
		ends[joints[k].body + 1]++;
	for (size_t body = 1; body < world->body_count; body++)
		ends[body] += ends[body - 1];
	for (size_t k = 0; k < count; k++)
		sorted[ends[joints[k].body]++] = joints[k];
	free(ends);
	return CAROM_OK;
}

/* Bodies hit each other that did not, or do not that did. */
static bool are_others(const carom_array *a, const carom_array *b)
{
	return a->used != b->used || (a->used > 0 && memcmp(a->items, b->items, a->used) != 0);
}

/* All of them as they are kept, and the pairs that they keep from hitting each other. */
static carom_status take(carom_world *world, size_t count, const carom_joint *joints, carom_array *sorted, carom_array *apart, carom_error *error)
{
	if (count == 0)
		return CAROM_OK;
	if (count > MOST_JOINTS)
		return carom_fail(error, CAROM_LIMIT, "a world holds at most %u joints", MOST_JOINTS);
	carom_joint *copy = malloc(count * sizeof *copy), *to = carom_array_grow(sorted, count * sizeof *to);
	carom_status status = CAROM_OUT_OF_MEMORY;
	if (copy && to) {
		memcpy(copy, joints, count * sizeof *copy);
		status = check_all(world, count, copy, error);
		if (!status)
			status = sort(world, copy, count, to, error);
		if (!status && !carom_apart_find(apart, to, count))
			status = CAROM_OUT_OF_MEMORY;
	}
	free(copy);
	return status == CAROM_OUT_OF_MEMORY ? carom_fail(error, status, "no memory for %zu joints", count) : status;
}

carom_status carom_world_set_joints(carom_world *world, size_t count, const carom_joint *joints, carom_error *error)
{
	carom_array sorted = {0}, apart = {0};
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	if (count > 0)
		GIVEN(joints, error);
	TRY(carom_contacts_fetch(world, error)); /* which are sent again with the joints */
	const carom_status status = take(world, count, joints, &sorted, &apart, error);
	if (status) {
		free(sorted.items);
		free(apart.items);
		return status;
	}
	if (are_others(&apart, &world->apart))
		carom_tell_later(world, UNSENT_FILTERS);
	free(world->joints.items);
	free(world->apart.items);
	world->joints = sorted;
	world->apart = apart;
	world->contacts_sent = false;
	return CAROM_OK;
}

carom_status carom_world_set_motor(carom_world *world, size_t index, float speed, float torque, carom_error *error)
{
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	TRY(carom_check_span("joints", index, 1, "the world has", carom_joint_count(world), error));
	carom_joint *joint = (carom_joint *)world->joints.items + index, changed = *joint;
	const size_t used = world->driven.used;
	changed.motor_speed = speed;
	changed.motor_torque = torque;
	TRY(carom_joint_check_numbers(world, index, &changed, error));
	if (world->contacts_sent) {
		uint32_t *driven = used < carom_joint_count(world) * sizeof *driven ? carom_array_grow(&world->driven, sizeof *driven) : NULL;
		if (driven) {
			*driven = (uint32_t)index;
		} else { /* as if all were set */
			TRY(carom_contacts_fetch(world, error));
			world->contacts_sent = false;
		}
	}
	*joint = changed;
	return CAROM_OK;
}
