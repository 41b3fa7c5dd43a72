/* What a scene file may hold of a body.
 *
 * Bodies in the style of the library's own files are read straight from the text, eight times as fast; any other goes by
 * way of a JSON tree. Both take the same tables, and only the tree's way fails: it knows what to say.
 * SPDX-License-Identifier: MIT */
#include "scene_json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct scene_range sides = {CAROM_MIN_VERTICES, CAROM_MAX_VERTICES, false, "a whole number from 3 to 64"};

struct body {
	carom_body_def def;
	const char *shape;   /* its key, NULL until there is one */
	float density, mass; /* NaN until given */
};

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

static bool quick_vertices(struct scene_text *text, void *target, const struct scene_range *range)
{
	struct body *body = target;
	carom_vec2 read[CAROM_MAX_VERTICES], *vertices;
	uint32_t count = 0;
	if (!scene_quick_take(text, '['))
		return false;
	do {
		if (count == CAROM_MAX_VERTICES || !scene_quick_pair(text, &read[count++], range))
			return false;
	} while (scene_quick_take(text, ','));
	if (count < CAROM_MIN_VERTICES || !scene_quick_take(text, ']'))
		return false;
	vertices = scene_allocate(text->scene, count * sizeof *vertices);
	if (!vertices)
		return false;
	memcpy(vertices, read, count * sizeof *vertices);
	body->def.vertices = vertices;
	body->def.vertex_count = count;
	return true;
}

static const struct scene_field circle_fields[] = {
	{"radius", scene_read_number, scene_quick_number, offsetof(struct body, def.radius), &scene_positive, true},
	SCENE_LAST_FIELD,
};

static const struct scene_field regular_fields[] = {
	{"sides", scene_read_whole, scene_quick_whole, offsetof(struct body, def.sides), &sides, true},
	{"radius", scene_read_number, scene_quick_number, offsetof(struct body, def.radius), &scene_positive, true},
	SCENE_LAST_FIELD,
};

static const struct scene_field polygon_fields[] = {
	{"vertices", read_vertices, quick_vertices, 0, &scene_any, true},
	SCENE_LAST_FIELD,
};

static carom_status read_shape(struct scene_reader *reader, const struct scene_place *place, const json_t *value, struct body *body,
	carom_shape shape, const struct scene_field *fields)
{
	if (body->shape)
		return scene_fail(reader, place->outer, "found \"%s\" and \"%s\"; allowed: one shape", body->shape, place->key);
	body->shape = place->key;
	body->def.shape = shape;
	return scene_read_object(reader, place, value, body, fields);
}

static bool quick_shape(struct scene_text *text, struct body *body, carom_shape shape, const struct scene_field *fields)
{
	if (body->shape)
		return false;
	body->shape = "";
	body->def.shape = shape;
	return scene_quick_object(text, body, fields);
}

static carom_status read_circle(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	(void)range;
	return read_shape(reader, place, value, target, CAROM_CIRCLE, circle_fields);
}

static bool quick_circle(struct scene_text *text, void *target, const struct scene_range *range)
{
	(void)range;
	return quick_shape(text, target, CAROM_CIRCLE, circle_fields);
}

static carom_status read_polygon(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	(void)range;
	return read_shape(reader, place, value, target, CAROM_POLYGON, polygon_fields);
}

static bool quick_polygon(struct scene_text *text, void *target, const struct scene_range *range)
{
	(void)range;
	return quick_shape(text, target, CAROM_POLYGON, polygon_fields);
}

static carom_status read_regular(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	(void)range;
	return read_shape(reader, place, value, target, CAROM_REGULAR, regular_fields);
}

static bool quick_regular(struct scene_text *text, void *target, const struct scene_range *range)
{
	(void)range;
	return quick_shape(text, target, CAROM_REGULAR, regular_fields);
}

static const struct scene_field body_fields[] = {
	{"circle", read_circle, quick_circle, 0, NULL, false},
	{"polygon", read_polygon, quick_polygon, 0, NULL, false},
	{"regular", read_regular, quick_regular, 0, NULL, false},
	{"position", scene_read_pair, scene_quick_pair, offsetof(struct body, def.position), &scene_any, false},
	{"velocity", scene_read_pair, scene_quick_pair, offsetof(struct body, def.velocity), &scene_any, false},
	{"angle", scene_read_number, scene_quick_number, offsetof(struct body, def.angle), &scene_any, false},
	{"angular_velocity", scene_read_number, scene_quick_number, offsetof(struct body, def.angular_velocity), &scene_any, false},
	{"density", scene_read_number, scene_quick_number, offsetof(struct body, density), &scene_positive, false},
	{"mass", scene_read_number, scene_quick_number, offsetof(struct body, mass), &scene_positive, false},
	{"restitution", scene_read_number, scene_quick_number, offsetof(struct body, def.restitution), &scene_part, false},
	{"friction", scene_read_number, scene_quick_number, offsetof(struct body, def.friction), &scene_friction, false},
	{"rolling_friction", scene_read_number, scene_quick_number, offsetof(struct body, def.rolling_friction), &scene_friction, false},
	{"linear_damping", scene_read_number, scene_quick_number, offsetof(struct body, def.linear_damping), &scene_damping, false},
	{"angular_damping", scene_read_number, scene_quick_number, offsetof(struct body, def.angular_damping), &scene_damping, false},
	{"force", scene_read_pair, scene_quick_pair, offsetof(struct body, def.force), &scene_any, false},
	{"torque", scene_read_number, scene_quick_number, offsetof(struct body, def.torque), &scene_any, false},
	{"static", scene_read_flag, scene_quick_flag, offsetof(struct body, def.is_static), NULL, false},
	{"kinematic", scene_read_flag, scene_quick_flag, offsetof(struct body, def.is_kinematic), NULL, false},
	{"categories", scene_read_whole, scene_quick_whole, offsetof(struct body, def.categories), &scene_bits, false},
	{"mask", scene_read_whole, scene_quick_whole, offsetof(struct body, def.mask), &scene_bits, false},
	{"color", scene_read_color, scene_quick_color, offsetof(struct body, def.color), NULL, false},
	{"name", scene_read_string, scene_quick_string, offsetof(struct body, def.name), NULL, false},
	{"contacts", scene_read_contacts, scene_quick_contacts, 0, NULL, false},
	{"joints", scene_read_joints, scene_quick_joints, 0, NULL, false},
	SCENE_LAST_FIELD,
};

static carom_status add_body(struct scene_reader *reader, const carom_body_def *def)
{
	carom_scene *scene = reader->scene;
	carom_body_def *bodies = scene_grow(scene->bodies, scene->body_count, sizeof *bodies);
	if (!bodies)
		return scene_fail_memory(reader);
	scene->bodies = bodies;
	scene->bodies[scene->body_count++] = *def;
	return CAROM_OK;
}

static carom_status add_read(struct scene_reader *reader, struct body *body)
{
	if (!isnan(body->density))
		body->def.density = body->density;
	if (!isnan(body->mass))
		body->def.mass = body->mass;
	return add_body(reader, &body->def);
}

carom_status scene_read_body(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
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
	return add_read(reader, &body);
}

/* The body at `text->at`, which then is behind it: at the comma or at the end. */
static bool quick_body(struct scene_text *text, struct body *body)
{
	*body = (struct body){carom_default_body_def(), NULL, NAN, NAN};
	if (!scene_quick_object(text, body, body_fields) || !body->shape || (!isnan(body->density) && !isnan(body->mass)))
		return false;
	text->at = scene_skip_space(text->at, text->end);
	return text->at == text->end || *text->at == ',';
}

/* One JSON tree a body, so that a million bodies need no more memory than one. */
static carom_status read_by_tree(struct scene_reader *reader, struct scene_text *text)
{
	static const struct scene_place bodies = {NULL, "bodies", 0};
	const struct scene_place place = {&bodies, NULL, reader->scene->body_count};
	const char *begin = text->at;
	json_t *value = NULL;
	text->at = scene_element_end(begin, text->end);
	carom_status status = scene_parse_element(reader, begin, text->at, &value);
	if (status == CAROM_OK)
		status = scene_read_body(reader, &place, value, NULL, NULL);
	scene_json_destroy(value);
	return status;
}

carom_status scene_read_bodies(struct scene_reader *reader)
{
	struct scene_text text = {scene_skip_space(reader->bodies, reader->bodies_end), reader->bodies_end, reader->scene};
	bool more = text.at < text.end;
	carom_status status = CAROM_OK;
	while (status == CAROM_OK && more) {
		const size_t contacts = reader->scene->contact_count, joints = reader->scene->joint_count;
		struct body body;
		reader->body = text.at;
		if (quick_body(&text, &body)) {
			status = add_read(reader, &body);
		} else {
			text.at = reader->body;
			reader->scene->contact_count = contacts;
			reader->scene->joint_count = joints;
			status = read_by_tree(reader, &text);
		}
		more = text.at < text.end; /* else a comma, which asks for one more */
		if (more)
			text.at = scene_skip_space(text.at + 1, text.end);
	}
	reader->body = NULL;
	return status;
}
