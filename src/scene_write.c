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
};

static void put_number(FILE *stream, float number)
{
	char text[SCENE_NUMBER_SIZE];
	size_t length = scene_format_number(number, text);
	fwrite(text, 1, length, stream);
}

static void put_pair(FILE *stream, carom_vec2 pair)
{
	putc('[', stream);
	put_number(stream, pair.x);
	fputs(", ", stream);
	put_number(stream, pair.y);
	putc(']', stream);
}

/* The bytes of the UTF-8 character at `text`, 0 if there is none. */
static size_t character_length(const unsigned char *text)
{
	static const unsigned long smallest[] = {0, 0, 0x80, 0x800, 0x10000}; /* less is overlong */
	size_t length = *text < 0x80 ? 1 : *text >= 0xF0 ? 4 : *text >= 0xE0 ? 3 : 2;
	if (length == 1)
		return 1;
	if (*text < 0xC0)
		return 0; /* the middle of a character */
	unsigned long code = *text & (0x7Fu >> length);
	for (size_t k = 1; k < length; k++) {
		if ((text[k] & 0xC0) != 0x80)
			return 0;
		code = code << 6 | (text[k] & 0x3Fu);
	}
	bool surrogate = code >= 0xD800 && code <= 0xDFFF;
	return code >= smallest[length] && code <= 0x10FFFF && !surrogate && *text < 0xF8 ? length : 0;
}

/* A name may hold anything; what is no UTF-8 becomes the replacement character, so that the file can be read. */
static void put_string(FILE *stream, const char *string)
{
	const unsigned char *at = (const unsigned char *)string;
	putc('"', stream);
	while (*at) {
		size_t length = character_length(at);
		if (length == 0) {
			fputs("\xEF\xBF\xBD", stream);
			at++;
			continue;
		}
		if (*at < 0x20) {
			fprintf(stream, "\\u%04x", (unsigned)*at);
		} else {
			if (*at == '"' || *at == '\\')
				putc('\\', stream);
			fwrite(at, 1, length, stream);
		}
		at += length;
	}
	putc('"', stream);
}

static bool same_pair(carom_vec2 a, carom_vec2 b)
{
	return memcmp(&a, &b, sizeof a) == 0; /* bits: -0 is written */
}

static bool same_number(float a, float b)
{
	return memcmp(&a, &b, sizeof a) == 0;
}

static void put_number_key(FILE *stream, const char *key, float number, float default_number)
{
	if (same_number(number, default_number))
		return;
	fprintf(stream, ", \"%s\": ", key);
	put_number(stream, number);
}

static void put_pair_key(FILE *stream, const char *key, carom_vec2 pair, carom_vec2 default_pair)
{
	if (same_pair(pair, default_pair))
		return;
	fprintf(stream, ", \"%s\": ", key);
	put_pair(stream, pair);
}

static void put_shape(FILE *stream, const carom_body_info *info)
{
	if (info->shape == CAROM_POLYGON) {
		fputs("{\"polygon\": {\"vertices\": [", stream);
		for (uint32_t k = 0; k < info->vertex_count; k++) {
			if (k > 0)
				fputs(", ", stream);
			put_pair(stream, info->vertices[k]);
		}
		fputs("]}", stream);
	} else {
		if (info->shape == CAROM_CIRCLE) {
			fputs("{\"circle\": {\"radius\": ", stream);
		} else {
			fprintf(stream, "{\"regular\": {\"sides\": %u, \"radius\": ", (unsigned)info->vertex_count);
		}
		put_number(stream, info->radius);
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
		put_pair(stream, normal);
		put_pair_key(stream, "friction", friction, none);
		putc('}', stream);
	}
	if (count > 0)
		putc(']', stream);
}

static void put_bits_key(FILE *stream, const char *key, uint32_t bits, uint32_t default_bits)
{
	if (bits != default_bits)
		fprintf(stream, ", \"%s\": %lu", key, (unsigned long)bits);
}

static void put_body(const struct writer *writer, const carom_body_info *info, const carom_body_state *state, const carom_contact *contacts,
	size_t contact_count)
{
	FILE *stream = writer->stream;
	const carom_body_def *defaults = &writer->body_defaults;
	put_shape(stream, info);
	fputs(", \"position\": ", stream);
	put_pair(stream, state->position);
	put_pair_key(stream, "velocity", state->velocity, defaults->velocity);
	put_number_key(stream, "angle", state->angle, defaults->angle);
	put_number_key(stream, "angular_velocity", state->angular_velocity, defaults->angular_velocity);
	if (info->density > 0) {
		put_number_key(stream, "density", info->density, defaults->density);
	} else if (isfinite(info->mass)) {
		put_number_key(stream, "mass", info->mass, defaults->mass);
	}
	put_number_key(stream, "restitution", info->restitution, writer->world->restitution);
	put_number_key(stream, "friction", info->friction, writer->world->friction);
	put_number_key(stream, "rolling_friction", info->rolling_friction, writer->world->rolling_friction);
	put_number_key(stream, "linear_damping", info->linear_damping, writer->world->linear_damping);
	put_number_key(stream, "angular_damping", info->angular_damping, writer->world->angular_damping);
	put_pair_key(stream, "force", info->force, defaults->force);
	put_number_key(stream, "torque", info->torque, defaults->torque);
	if (info->is_static)
		fputs(", \"static\": true", stream);
	if (info->is_kinematic)
		fputs(", \"kinematic\": true", stream);
	put_bits_key(stream, "categories", info->categories, defaults->categories);
	put_bits_key(stream, "mask", info->mask, defaults->mask);
	if (info->color != CAROM_COLOR_AUTO)
		fprintf(stream, ", \"color\": \"#%06x\"", (unsigned)(info->color & 0xFFFFFF));
	if (info->name) {
		fputs(", \"name\": ", stream);
		put_string(stream, info->name);
	}
	put_contacts(stream, contacts, contact_count);
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
		put_string(writer->stream, slots[k].alternative);
	}
	if (!same_number(world->epsilon, defaults->epsilon)) {
		put_separator(writer->stream, &begun, "epsilon");
		put_number(writer->stream, world->epsilon);
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
	put_number(stream, number);
}

static void put_world(const struct writer *writer, const carom_camera *camera)
{
	FILE *stream = writer->stream;
	const carom_world_def *world = writer->world;
	fputs("{\n  \"format\": \"carom-scene/1\",\n  \"time_step\": ", stream);
	put_number(stream, world->time_step);
	fputs(",\n  \"gravity\": ", stream);
	put_pair(stream, world->gravity);
	fputs(",\n  \"restitution\": ", stream);
	put_number(stream, world->restitution);
	put_if_any(stream, "friction", world->friction);
	put_if_any(stream, "rolling_friction", world->rolling_friction);
	put_if_any(stream, "linear_damping", world->linear_damping);
	put_if_any(stream, "angular_damping", world->angular_damping);
	if (world->has_room) {
		fputs(",\n  \"room\": { \"min\": ", stream);
		put_pair(stream, world->room_min);
		fputs(", \"max\": ", stream);
		put_pair(stream, world->room_max);
		fputs(" }", stream);
	}
	put_pipeline(writer);
	if (camera) {
		fputs(",\n  \"camera\": { \"center\": ", stream);
		put_pair(stream, camera->center);
		fputs(", \"height\": ", stream);
		put_number(stream, camera->height);
		fputs(" }", stream);
	}
}

static carom_status put_bodies(const struct writer *writer, carom_world *world, const carom_contact *contacts, size_t contact_count,
	carom_error *error)
{
	const size_t count = carom_world_body_count(world);
	carom_body_state states[STATES_AT_ONCE];
	carom_status status = CAROM_OK;
	fputs(",\n  \"bodies\": [", writer->stream);
	for (size_t k = 0, first = 0, end = 0; k < count; k++, first = end) {
		size_t left = count - k;
		carom_body_info info;
		if (k % STATES_AT_ONCE == 0)
			status = carom_world_get_states(world, (uint32_t)k, left < STATES_AT_ONCE ? left : STATES_AT_ONCE, states, error);
		if (status == CAROM_OK)
			status = carom_world_get_body(world, (uint32_t)k, &info, error);
		if (status != CAROM_OK)
			return status;
		while (end < contact_count && contacts[end].body == k)
			end++;
		fputs(k > 0 ? ",\n    " : "\n    ", writer->stream);
		put_body(writer, &info, &states[k % STATES_AT_ONCE], contacts + first, end - first);
	}
	fputs("\n  ]\n}\n", writer->stream);
	return CAROM_OK;
}

/* *contacts is to be freed. */
static carom_status get_contacts(carom_world *world, carom_contact **contacts, size_t *count, carom_error *error)
{
	carom_status status = carom_world_contact_count(world, count, error);
	if (status != CAROM_OK)
		return status;
	*contacts = malloc((*count + 1) * sizeof **contacts);
	if (!*contacts)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for %zu contacts", *count);
	return carom_world_get_contacts(world, 0, *count, *contacts, error);
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
	const struct writer writer = {stream, carom_world_get_def(world), &defaults, carom_default_body_def()};
	carom_contact *contacts = NULL;
	size_t contact_count = 0;
	put_world(&writer, camera);
	carom_status status = get_contacts(world, &contacts, &contact_count, error);
	if (status == CAROM_OK)
		status = put_bodies(&writer, world, contacts, contact_count, error);
	free(contacts);
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
