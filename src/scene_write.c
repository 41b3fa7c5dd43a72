/* A world's present state as a scene file: one body a line, in their order, what has its default left out.
 * SPDX-License-Identifier: MIT */
#include "scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STATES_AT_ONCE 1024

struct writer {
	FILE *stream;
	const carom_world_def *world, *world_defaults;
	carom_body_def body_defaults;
	carom_contact *contacts; /* in the order of their bodies, */
	carom_joint *joints;     /* and these, too */
	size_t contact_count, joint_count;
};

static void put_shape(FILE *stream, const carom_body_info *info)
{
	if (info->shape == CAROM_POLYGON) {
		fputs("{\"polygon\": {\"vertices\": [", stream);
		for (uint32_t k = 0; k < info->vertex_count; k++) {
			if (k > 0)
				fputs(", ", stream);
			scene_put_pair(stream, info->vertices[k]);
		}
		fputs("]}", stream);
	} else {
		if (info->shape == CAROM_CIRCLE) {
			fputs("{\"circle\": {\"radius\": ", stream);
		} else {
			fprintf(stream, "{\"regular\": {\"sides\": %u, \"radius\": ", (unsigned)info->vertex_count);
		}
		scene_put_number(stream, info->radius);
		putc('}', stream);
	}
}

static void put_contacts(FILE *stream, const carom_contact *contacts, size_t count)
{
	static const carom_vec2 none = {0, 0};
	for (size_t k = 0; k < count; k++) {
		const carom_contact *contact = &contacts[k];
		const carom_vec2 normal = {contact->normal[0], contact->normal[1]}, friction = {contact->friction[0], contact->friction[1]};
		fputs(k > 0 ? ", {" : ", \"contacts\": [{", stream);
		if (contact->other < 0)
			fprintf(stream, "\"wall\": \"%s\", \"normal\": ", scene_walls[-1 - contact->other]);
		else
			fprintf(stream, "\"body\": %d, \"normal\": ", (int)contact->other);
		scene_put_pair(stream, normal);
		scene_put_pair_key(stream, "friction", friction, none);
		if (contact->part > 0)
			fprintf(stream, ", \"part\": %u", (unsigned)contact->part);
		putc('}', stream);
	}
	if (count > 0)
		putc(']', stream);
}

static void put_joints(FILE *stream, const carom_joint *joints, size_t count)
{
	static const carom_vec2 none = {0, 0};
	for (size_t k = 0; k < count; k++) {
		const carom_joint *joint = &joints[k];
		fprintf(stream, "%s\"kind\": \"%s\"", k > 0 ? ", {" : ", \"joints\": [{", scene_joint_kinds[joint->kind]);
		if (joint->other != CAROM_GROUND)
			fprintf(stream, ", \"body\": %d", (int)joint->other);
		scene_put_pair_key(stream, "anchor", joint->anchor, none);
		fputs(", \"other_anchor\": ", stream);
		scene_put_pair(stream, joint->other_anchor);
		scene_put_number_key(stream, "length", joint->length, joint->kind == CAROM_REVOLUTE || joint->kind == CAROM_SLIDER ? 0 : NAN);
		scene_put_number_key(stream, "axis", joint->axis, 0);
		scene_put_number_key(stream, "stiffness", joint->stiffness, 0);
		scene_put_number_key(stream, "damping", joint->damping, 0);
		scene_put_number_key(stream, "motor_speed", joint->motor_speed, 0);
		scene_put_number_key(stream, "motor_torque", joint->motor_torque, 0);
		scene_put_number_key(stream, "lower_angle", joint->lower_angle, joint->has_stops ? NAN : 0);
		scene_put_number_key(stream, "upper_angle", joint->upper_angle, joint->has_stops ? NAN : 0);
		if (joint->collides)
			fputs(", \"collides\": true", stream);
		scene_put_pair_key(stream, "force", (carom_vec2){joint->force[0], joint->force[1]}, none);
		scene_put_pair_key(stream, "torque", (carom_vec2){joint->torque[0], joint->torque[1]}, none);
		putc('}', stream);
	}
	if (count > 0)
		putc(']', stream);
}

/* What a body is in, from `first` on, before `end`. */
struct own {
	size_t first_contact, end_contact, first_joint, end_joint;
};

static void put_body(const struct writer *writer, const carom_body_info *info, const carom_body_state *state, const struct own *own)
{
	FILE *stream = writer->stream;
	const carom_body_def *defaults = &writer->body_defaults;
	put_shape(stream, info);
	fputs(", \"position\": ", stream);
	scene_put_pair(stream, state->position);
	scene_put_pair_key(stream, "velocity", state->velocity, defaults->velocity);
	scene_put_number_key(stream, "angle", state->angle, defaults->angle);
	scene_put_number_key(stream, "angular_velocity", state->angular_velocity, defaults->angular_velocity);
	if (info->density > 0) {
		scene_put_number_key(stream, "density", info->density, defaults->density);
	} else if (isfinite(info->mass)) {
		scene_put_number_key(stream, "mass", info->mass, defaults->mass);
	}
	scene_put_number_key(stream, "restitution", info->restitution, writer->world->restitution);
	scene_put_number_key(stream, "friction", info->friction, writer->world->friction);
	scene_put_number_key(stream, "rolling_friction", info->rolling_friction, writer->world->rolling_friction);
	scene_put_number_key(stream, "linear_damping", info->linear_damping, writer->world->linear_damping);
	scene_put_number_key(stream, "angular_damping", info->angular_damping, writer->world->angular_damping);
	scene_put_pair_key(stream, "force", info->force, defaults->force);
	scene_put_number_key(stream, "torque", info->torque, defaults->torque);
	if (info->is_static)
		fputs(", \"static\": true", stream);
	if (info->is_kinematic)
		fputs(", \"kinematic\": true", stream);
	scene_put_bits_key(stream, "categories", info->categories, defaults->categories);
	scene_put_bits_key(stream, "mask", info->mask, defaults->mask);
	if (info->color != CAROM_COLOR_AUTO)
		fprintf(stream, ", \"color\": \"#%06x\"", (unsigned)(info->color & 0xFFFFFF));
	if (info->name) {
		fputs(", \"name\": ", stream);
		scene_put_string(stream, info->name);
	}
	put_contacts(stream, writer->contacts + own->first_contact, own->end_contact - own->first_contact);
	put_joints(stream, writer->joints + own->first_joint, own->end_joint - own->first_joint);
	putc('}', stream);
}

static void put_separator(FILE *stream, bool *begun, const char *key)
{
	fprintf(stream, "%s\"%s\": ", *begun ? ", " : ",\n  \"pipeline\": { ", key);
	*begun = true;
}

/* Only what was chosen: the defaults may become better ones. */
static void put_pipeline(const struct writer *writer)
{
	const carom_world_def *world = writer->world, *defaults = writer->world_defaults;
	const carom_pipeline *pipeline = &world->pipeline;
	const struct {
		const char *slot, *alternative;
	} slots[] = {
		{"step", pipeline->step},
		{"aabb", pipeline->aabb},
		{"overlap", pipeline->overlap},
		{"inside", pipeline->inside},
		{"toi", pipeline->toi},
		{"walls", pipeline->walls},
		{"reduce", pipeline->reduce},
		{"impulse", pipeline->impulse},
		{"transforms", pipeline->transforms},
		{"vertices", pipeline->vertices},
	};
	bool begun = false;
	for (size_t k = 0; k < sizeof slots / sizeof *slots; k++) {
		if (!slots[k].alternative)
			continue;
		put_separator(writer->stream, &begun, slots[k].slot);
		scene_put_string(writer->stream, slots[k].alternative);
	}
	if (!scene_same_number(world->epsilon, defaults->epsilon)) {
		put_separator(writer->stream, &begun, "epsilon");
		scene_put_number(writer->stream, world->epsilon);
	}
	if (world->iterations != defaults->iterations) {
		put_separator(writer->stream, &begun, "iterations");
		fprintf(writer->stream, "%u", (unsigned)world->iterations);
	}
	if (begun)
		fputs(" }", writer->stream);
}

/* A number of the scene, where it is not 0. */
static void put_if_any(FILE *stream, const char *key, float number)
{
	if (number == 0.0f)
		return;
	fprintf(stream, ",\n  \"%s\": ", key);
	scene_put_number(stream, number);
}

static void put_world(const struct writer *writer, const carom_camera *camera)
{
	FILE *stream = writer->stream;
	const carom_world_def *world = writer->world;
	fputs("{\n  \"format\": \"carom-scene/1\",\n  \"time_step\": ", stream);
	scene_put_number(stream, world->time_step);
	fputs(",\n  \"gravity\": ", stream);
	scene_put_pair(stream, world->gravity);
	fputs(",\n  \"restitution\": ", stream);
	scene_put_number(stream, world->restitution);
	put_if_any(stream, "friction", world->friction);
	put_if_any(stream, "rolling_friction", world->rolling_friction);
	put_if_any(stream, "linear_damping", world->linear_damping);
	put_if_any(stream, "angular_damping", world->angular_damping);
	if (world->has_room) {
		fputs(",\n  \"room\": { \"min\": ", stream);
		scene_put_pair(stream, world->room_min);
		fputs(", \"max\": ", stream);
		scene_put_pair(stream, world->room_max);
		fputs(" }", stream);
	}
	put_pipeline(writer);
	if (camera) {
		fputs(",\n  \"camera\": { \"center\": ", stream);
		scene_put_pair(stream, camera->center);
		fputs(", \"height\": ", stream);
		scene_put_number(stream, camera->height);
		fputs(" }", stream);
	}
}

static carom_status put_bodies(const struct writer *writer, carom_world *world, carom_error *error)
{
	const size_t count = carom_world_body_count(world);
	carom_body_state states[STATES_AT_ONCE];
	carom_status status = CAROM_OK;
	fputs(",\n  \"bodies\": [", writer->stream);
	struct own own = {0};
	for (size_t k = 0; k < count; k++) {
		size_t left = count - k;
		carom_body_info info;
		if (k % STATES_AT_ONCE == 0)
			status = carom_world_get_states(world, (uint32_t)k, left < STATES_AT_ONCE ? left : STATES_AT_ONCE, states, error);
		if (status == CAROM_OK)
			status = carom_world_get_body(world, (uint32_t)k, &info, error);
		if (status != CAROM_OK)
			return status;
		own.first_contact = own.end_contact;
		while (own.end_contact < writer->contact_count && writer->contacts[own.end_contact].body == k)
			own.end_contact++;
		own.first_joint = own.end_joint;
		while (own.end_joint < writer->joint_count && writer->joints[own.end_joint].body == k)
			own.end_joint++;
		fputs(k > 0 ? ",\n    " : "\n    ", writer->stream);
		put_body(writer, &info, &states[k % STATES_AT_ONCE], &own);
	}
	fputs("\n  ]\n}\n", writer->stream);
	return CAROM_OK;
}

/* Both arrays are to be freed. */
static carom_status get_contacts(carom_world *world, struct writer *writer, carom_error *error)
{
	carom_status status = carom_world_contact_count(world, &writer->contact_count, error);
	if (status != CAROM_OK)
		return status;
	writer->joint_count = carom_world_joint_count(world);
	writer->contacts = calloc(writer->contact_count + 1, sizeof *writer->contacts);
	writer->joints = calloc(writer->joint_count + 1, sizeof *writer->joints);
	if (!writer->contacts || !writer->joints)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for %zu contacts and %zu joints", writer->contact_count, writer->joint_count);
	status = carom_world_get_joints(world, 0, writer->joint_count, writer->joints, error);
	return status == CAROM_OK ? carom_world_get_contacts(world, 0, writer->contact_count, writer->contacts, error) : status;
}

/* What is refused when it is read is not written. */
static carom_status check_camera(const carom_camera *camera, carom_error *error)
{
	const float x = camera->center.x, y = camera->center.y, height = camera->height;
	if (isfinite(x) && isfinite(y) && isfinite(height) && height > 0)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "camera: found center (%g, %g) and height %g; allowed: finite numbers, the height above 0",
		(double)x, (double)y, (double)height);
}

static carom_status put_scene(carom_world *world, const carom_camera *camera, FILE *stream, carom_error *error)
{
	const carom_world_def defaults = carom_default_world_def();
	struct writer writer = {
		.stream = stream, .world = carom_world_get_def(world), .world_defaults = &defaults, .body_defaults = carom_default_body_def()};
	put_world(&writer, camera);
	carom_status status = get_contacts(world, &writer, error);
	if (status == CAROM_OK)
		status = put_bodies(&writer, world, error);
	free(writer.contacts);
	free(writer.joints);
	return status;
}

carom_status carom_world_write_scene(carom_world *world, const carom_camera *camera, const char *path, carom_error *error)
{
	carom_file *file = NULL;
	FILE *stream = NULL;
	GIVEN(world, error);
	GIVEN(path, error);
	carom_status status = camera ? check_camera(camera, error) : CAROM_OK;
	if (status == CAROM_OK)
		status = carom_file_create(path, &file, &stream, error);
	if (status != CAROM_OK)
		return status;
	status = put_scene(world, camera, stream, error);
	if (status == CAROM_OK)
		return carom_file_commit(file, error);
	carom_file_destroy(file);
	return status;
}

carom_status carom_scene_text_create(carom_world *world, const carom_camera *camera, char **text, size_t *length, carom_error *error)
{
	char *written = NULL;
	size_t size = 0;
	GIVEN(world, error);
	GIVEN(text, error);
	if (camera)
		TRY(check_camera(camera, error));
	FILE *stream = open_memstream(&written, &size);
	carom_status status = stream ? put_scene(world, camera, stream, error) : CAROM_OK;
	bool is_whole = stream && !ferror(stream); /* fclose may not say so again */
	is_whole = (!stream || fclose(stream) == 0) && is_whole;
	if (status == CAROM_OK && !is_whole)
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to write a scene of %zu bodies", carom_world_body_count(world));
	if (status != CAROM_OK) {
		free(written);
		return status;
	}
	*text = written;
	if (length)
		*length = size;
	return CAROM_OK;
}

void carom_scene_text_destroy(char *text)
{
	free(text);
}
