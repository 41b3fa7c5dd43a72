/* What a scene file may hold.
 * SPDX-License-Identifier: MIT */
#include "scene_json.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FORMAT "carom-scene/1"
#define LAST_FIELD {NULL, NULL, 0, NULL, false}

static const struct scene_range any = {-FLT_MAX, FLT_MAX, false, "a number within +-3.4e38"};
static const struct scene_range positive = {0, FLT_MAX, true, "a number above 0, at most 3.4e38"};
static const struct scene_range part = {0, 1, false, "a number from 0 to 1"};
static const struct scene_range sides = {CAROM_MIN_VERTICES, CAROM_MAX_VERTICES, false, "a whole number from 3 to 64"};
static const struct scene_range epsilon = {0x1p-22, 0.5, false, "a number from 2.4e-7 (2^-22) to 0.5"};
static const struct scene_range iterations = {
	0, UINT32_MAX, false, "a whole number from 1 to 4294967295, or 0 for all in one pass"};

/* ---- Bodies ---- */

struct body {
	carom_body_def def;
	const char *shape;   /* its key, NULL until there is one */
	float density, mass; /* NaN until given */
};

static carom_status read_shape(struct scene_reader *reader, const struct scene_place *place, const json_t *value,
	struct body *body, carom_shape shape, const struct scene_field *fields)
{
	if (body->shape)
		return scene_fail(reader, place->outer, "found \"%s\" and \"%s\"; allowed: one shape", body->shape, place->key);
	body->shape = place->key;
	body->def.shape = shape;
	return scene_read_object(reader, place, value, body, fields);
}

static carom_status read_circle(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"radius", scene_read_number, offsetof(struct body, def.radius), &positive, true},
		LAST_FIELD,
	};
	(void)range;
	return read_shape(reader, place, value, target, CAROM_CIRCLE, fields);
}

static carom_status read_regular(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"sides", scene_read_whole, offsetof(struct body, def.sides), &sides, true},
		{"radius", scene_read_number, offsetof(struct body, def.radius), &positive, true},
		LAST_FIELD,
	};
	(void)range;
	return read_shape(reader, place, value, target, CAROM_REGULAR, fields);
}

static carom_status read_vertices(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	struct body *body = target;
	size_t count = scene_array_size(value);
	if (count < CAROM_MIN_VERTICES || count > CAROM_MAX_VERTICES) {
		return scene_fail_value(reader, place, value, "an array of 3 to 64 vertices, [[x, y], ...]");
	}
	carom_vec2 *vertices = scene_allocate(reader->scene, count * sizeof *vertices);
	if (!vertices)
		return scene_fail_memory(reader);
	body->def.vertices = vertices;
	body->def.vertex_count = (uint32_t)count;
	return scene_read_array(reader, place, value, vertices, sizeof *vertices, scene_read_pair, range);
}

static carom_status read_polygon(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"vertices", read_vertices, 0, &any, true},
		LAST_FIELD,
	};
	(void)range;
	return read_shape(reader, place, value, target, CAROM_POLYGON, fields);
}

static const struct scene_field body_fields[] = {
	{"circle", read_circle, 0, NULL, false},
	{"polygon", read_polygon, 0, NULL, false},
	{"regular", read_regular, 0, NULL, false},
	{"position", scene_read_pair, offsetof(struct body, def.position), &any, false},
	{"velocity", scene_read_pair, offsetof(struct body, def.velocity), &any, false},
	{"angle", scene_read_number, offsetof(struct body, def.angle), &any, false},
	{"angular_velocity", scene_read_number, offsetof(struct body, def.angular_velocity), &any, false},
	{"density", scene_read_number, offsetof(struct body, density), &positive, false},
	{"mass", scene_read_number, offsetof(struct body, mass), &positive, false},
	{"restitution", scene_read_number, offsetof(struct body, def.restitution), &part, false},
	{"force", scene_read_pair, offsetof(struct body, def.force), &any, false},
	{"torque", scene_read_number, offsetof(struct body, def.torque), &any, false},
	{"static", scene_read_flag, offsetof(struct body, def.is_static), NULL, false},
	{"color", scene_read_color, offsetof(struct body, def.color), NULL, false},
	{"name", scene_read_string, offsetof(struct body, def.name), NULL, false},
	LAST_FIELD,
};

static carom_status add_body(struct scene_reader *reader, const carom_body_def *def)
{
	carom_scene *scene = reader->scene;
	if (scene->body_count == reader->capacity) {
		size_t capacity = reader->capacity ? reader->capacity * 2 : 64;
		carom_body_def *bodies = realloc(scene->bodies, capacity * sizeof *bodies);
		if (!bodies)
			return scene_fail_memory(reader);
		scene->bodies = bodies;
		reader->capacity = capacity;
	}
	scene->bodies[scene->body_count++] = *def;
	return CAROM_OK;
}

static carom_status read_body(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	struct body body = {carom_default_body_def(), NULL, NAN, NAN};
	(void)target;
	(void)range;
	carom_status status = scene_read_object(reader, place, value, &body, body_fields);
	if (status != CAROM_OK)
		return status;
	if (!body.shape)
		return scene_fail(reader, place, "the shape is missing; allowed: circle, polygon, regular");
	if (!isnan(body.density) && !isnan(body.mass))
		return scene_fail(reader, place, "found \"density\" and \"mass\"; allowed: one of them");
	if (!isnan(body.density))
		body.def.density = body.density;
	if (!isnan(body.mass))
		body.def.mass = body.mass;
	return add_body(reader, &body.def);
}

/* One JSON tree a body, so that a million bodies need no more memory than one. */
static carom_status read_cut_bodies(struct scene_reader *reader)
{
	static const struct scene_place bodies = {NULL, "bodies", 0};
	const char *end = reader->bodies_end, *at = scene_skip_space(reader->bodies, end);
	carom_status status = CAROM_OK;
	if (at == end)
		return CAROM_OK;
	for (;;) {
		struct scene_place place = {&bodies, NULL, reader->scene->body_count};
		const char *element_end = scene_element_end(at, end);
		reader->body = at;
		json_t *value = NULL;
		status = scene_parse_element(reader, at, element_end, &value);
		if (status == CAROM_OK)
			status = read_body(reader, &place, value, NULL, NULL);
		scene_json_destroy(value);
		if (status != CAROM_OK || element_end == end)
			break;
		at = scene_skip_space(element_end + 1, end);
	}
	reader->body = NULL;
	return status;
}

/* ---- The world ---- */

static carom_status read_format(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	const char *format = NULL;
	(void)target;
	carom_status status = scene_read_string(reader, place, value, &format, range);
	if (status == CAROM_OK && strcmp(format, FORMAT) != 0)
		status = scene_fail_value(reader, place, value, "\"" FORMAT "\"");
	return status;
}

/* In the head the bodies are cut out, unless "bodies" is written with escapes, which the cut does not look for. */
static carom_status read_head_bodies(struct scene_reader *reader, const struct scene_place *place, const json_t *value,
	void *target, const struct scene_range *range)
{
	if (!scene_is_array(value))
		return scene_fail_value(reader, place, value, "an array of bodies");
	return scene_read_array(reader, place, value, target, 0, read_body, range);
}

static carom_status read_room(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"min", scene_read_pair, offsetof(carom_world_def, room_min), &any, true},
		{"max", scene_read_pair, offsetof(carom_world_def, room_max), &any, true},
		LAST_FIELD,
	};
	carom_world_def *world = target;
	(void)range;
	carom_status status = scene_read_object(reader, place, value, target, fields);
	if (status != CAROM_OK)
		return status;
	if (!(world->room_min.x < world->room_max.x) || !(world->room_min.y < world->room_max.y)) {
		return scene_fail(reader, place, "found min [%.9g, %.9g] and max [%.9g, %.9g]; allowed: min below max in x and in y",
			(double)world->room_min.x, (double)world->room_min.y, (double)world->room_max.x, (double)world->room_max.y);
	}
	world->has_room = true;
	return CAROM_OK;
}

static carom_status read_slot(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	carom_world_def *world = target;
	const char *alternative = "";
	carom_error found;
	carom_status status = scene_read_string(reader, place, value, &alternative, range);
	if (status != CAROM_OK)
		return status;
	if (carom_pipeline_set(&world->pipeline, place->key, alternative, &found) == CAROM_OK)
		return CAROM_OK;
	return scene_fail(reader, place, "%s", found.text);
}

static carom_status read_pipeline(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"epsilon", scene_read_number, offsetof(carom_world_def, epsilon), &epsilon, false},
		{"iterations", scene_read_whole, offsetof(carom_world_def, iterations), &iterations, false},
		{"*", read_slot, 0, NULL, false},
		LAST_FIELD,
	};
	(void)range;
	return scene_read_object(reader, place, value, target, fields);
}

static carom_status read_camera(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"center", scene_read_pair, offsetof(carom_scene, camera.center), &any, true},
		{"height", scene_read_number, offsetof(carom_scene, camera.height), &positive, true},
		LAST_FIELD,
	};
	carom_scene *scene = target;
	(void)range;
	scene->has_camera = true;
	return scene_read_object(reader, place, value, target, fields);
}

static const struct scene_field scene_fields[] = {
	{"format", read_format, 0, NULL, true},
	{"time_step", scene_read_number, offsetof(carom_scene, world.time_step), &positive, false},
	{"gravity", scene_read_pair, offsetof(carom_scene, world.gravity), &any, false},
	{"restitution", scene_read_number, offsetof(carom_scene, world.restitution), &part, false},
	{"room", read_room, offsetof(carom_scene, world), NULL, false},
	{"pipeline", read_pipeline, offsetof(carom_scene, world), NULL, false},
	{"camera", read_camera, 0, NULL, false},
	{"bodies", read_head_bodies, 0, NULL, true},
	LAST_FIELD,
};

static carom_status read_scene(struct scene_reader *reader)
{
	json_t *head = NULL;
	carom_status status = scene_parse_head(reader, &head);
	if (status == CAROM_OK)
		status = scene_read_object(reader, NULL, head, reader->scene, scene_fields);
	scene_json_destroy(head);
	if (status == CAROM_OK)
		return read_cut_bodies(reader);
	/* A bracket that a body lacks shows behind the bodies; reading them tells where it is. */
	if (reader->broken_behind)
		read_cut_bodies(reader);
	return status;
}

/* ---- Texts and files ---- */

carom_status carom_scene_parse(const char *text, size_t length, const char *name, carom_scene **scene, carom_error *error)
{
	static const char byte_order_mark[] = "\xEF\xBB\xBF";
	carom_status status;
	if (!text || !scene)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "carom_scene_parse: no text or no scene");
	struct scene_reader reader = {.name = name ? name : "scene", .text = text, .end = text + length, .error = error};
	if (length >= 3 && memcmp(text, byte_order_mark, 3) == 0)
		reader.text += 3;
	reader.scene = scene_create(reader.name);
	if (!reader.scene)
		return scene_fail_memory(&reader);
	if (!scene_find_bodies(reader.text, reader.end, &reader.bodies, &reader.bodies_end))
		reader.bodies = reader.bodies_end = reader.end;
	status = read_scene(&reader);
	if (status == CAROM_OK) {
		*scene = reader.scene;
	} else {
		carom_scene_destroy(reader.scene);
	}
	return status;
}

/* Everything there is to read: the size of a pipe isn't known beforehand. */
static bool read_all(FILE *file, char **text, size_t *length)
{
	size_t capacity = 0, size = 1 << 16;
	while (size <= SIZE_MAX / 2) {
		char *grown = realloc(*text, size);
		if (!grown)
			return false;
		*text = grown;
		capacity = size;
		*length += fread(*text + *length, 1, capacity - *length, file);
		if (*length < capacity)
			return !ferror(file);
		size *= 2;
	}
	return false;
}

carom_status carom_scene_read(const char *path, carom_scene **scene, carom_error *error)
{
	carom_status status;
	char *text = NULL;
	size_t length = 0;
	FILE *file;
	if (!path || !scene)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "carom_scene_read: no path or no scene");
	errno = 0;
	file = fopen(path, "rb");
	if (file && read_all(file, &text, &length)) {
		status = carom_scene_parse(text, length, path, scene, error);
	} else if (errno == ENOMEM) {
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "%s: there is not enough memory to read it", path);
	} else {
		status = carom_fail(error, CAROM_IO, "%s: can't be read: %s; give the path of a scene file", path, strerror(errno));
	}
	free(text);
	if (file)
		fclose(file);
	return status;
}
