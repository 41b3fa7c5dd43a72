/* What a scene file may hold, beside the bodies.
 * SPDX-License-Identifier: MIT */
#include "follow.h"
#include "scene_json.h"

#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <limits.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define MOST_BYTES INT_MAX /* lines and columns are ints; the largest worlds take less */
#define FORMAT "carom-scene/1"

static const struct scene_range time_step = {FLT_MIN, FLT_MAX, false, "a number from 1.17549435e-38 to 3.4e38"};
static const struct scene_range epsilon = {0x1p-22, 0.5, false, "a number from 2.4e-7 (2^-22) to 0.5"};
static const struct scene_range iterations = {0, UINT32_MAX, false, "a whole number from 1 to 4294967295, or 0 for all in one pass"};

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
static carom_status read_head_bodies(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	if (!scene_is_array(value))
		return scene_fail_value(reader, place, value, "an array of bodies");
	return scene_read_array(reader, place, value, target, 0, scene_read_body, range);
}

static carom_status read_room(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"min", scene_read_pair, NULL, offsetof(carom_world_def, room_min), &scene_any, true},
		{"max", scene_read_pair, NULL, offsetof(carom_world_def, room_max), &scene_any, true},
		SCENE_LAST_FIELD,
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
		{"epsilon", scene_read_number, NULL, offsetof(carom_world_def, epsilon), &epsilon, false},
		{"iterations", scene_read_whole, NULL, offsetof(carom_world_def, iterations), &iterations, false},
		{"*", read_slot, NULL, 0, NULL, false},
		SCENE_LAST_FIELD,
	};
	(void)range;
	return scene_read_object(reader, place, value, target, fields);
}

static carom_status read_camera(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	static const struct scene_field fields[] = {
		{"center", scene_read_pair, NULL, offsetof(carom_scene, camera.center), &scene_any, true},
		{"height", scene_read_number, NULL, offsetof(carom_scene, camera.height), &scene_positive, true},
		SCENE_LAST_FIELD,
	};
	carom_scene *scene = target;
	(void)range;
	scene->has_camera = true;
	return scene_read_object(reader, place, value, target, fields);
}

static const struct scene_field scene_fields[] = {
	{"format", read_format, NULL, 0, NULL, true},
	{"time_step", scene_read_number, NULL, offsetof(carom_scene, world.time_step), &time_step, false},
	{"gravity", scene_read_pair, NULL, offsetof(carom_scene, world.gravity), &scene_any, false},
	{"restitution", scene_read_number, NULL, offsetof(carom_scene, world.restitution), &scene_part, false},
	{"friction", scene_read_number, NULL, offsetof(carom_scene, world.friction), &scene_friction, false},
	{"rolling_friction", scene_read_number, NULL, offsetof(carom_scene, world.rolling_friction), &scene_friction, false},
	{"linear_damping", scene_read_number, NULL, offsetof(carom_scene, world.linear_damping), &scene_damping, false},
	{"angular_damping", scene_read_number, NULL, offsetof(carom_scene, world.angular_damping), &scene_damping, false},
	{"room", read_room, NULL, offsetof(carom_scene, world), NULL, false},
	{"pipeline", read_pipeline, NULL, offsetof(carom_scene, world), NULL, false},
	{"camera", read_camera, NULL, 0, NULL, false},
	{"bodies", read_head_bodies, NULL, 0, NULL, true},
	SCENE_LAST_FIELD,
};

static carom_status read_scene(struct scene_reader *reader)
{
	json_t *head = NULL;
	carom_status status = scene_parse_head(reader, &head);
	if (status == CAROM_OK)
		status = scene_read_object(reader, NULL, head, reader->scene, scene_fields);
	scene_json_destroy(head);
	if (status == CAROM_OK)
		return scene_read_bodies(reader);
	/* A bracket that a body lacks shows behind the bodies; reading them tells where it is. */
	if (reader->broken_behind)
		scene_read_bodies(reader);
	return status;
}

/* ---- Texts and files ---- */

carom_status carom_scene_parse(const char *text, size_t length, const char *name, carom_scene **scene, carom_error *error)
{
	static const char byte_order_mark[] = "\xEF\xBB\xBF";
	carom_status status;
	GIVEN(scene, error);
	if (length > 0)
		GIVEN(text, error);
	else
		text = "";
	if (length > MOST_BYTES)
		return carom_fail(error, CAROM_INVALID_SCENE, "%s: found more than 2 GiB of text; allowed: up to %d bytes", name ? name : "scene",
			MOST_BYTES);
	struct scene_reader reader = {.name = name ? name : "scene", .text = text, .end = text + length, .error = error};
	if (length >= 3 && memcmp(text, byte_order_mark, 3) == 0)
		reader.text += 3;
	reader.scene = scene_create(reader.name);
	if (!reader.scene)
		return scene_fail_memory(&reader);
	const locale_t plain = newlocale(LC_NUMERIC_MASK, "C",
		(locale_t)0); /* jansson takes the point from the thread's locale, and gives up where that has several bytes */
	if (!plain) {
		carom_scene_destroy(reader.scene);
		return scene_fail_memory(&reader);
	}
	if (!scene_find_bodies(reader.text, reader.end, &reader.bodies, &reader.bodies_end))
		reader.bodies = reader.bodies_end = reader.end;
	const locale_t before = uselocale(plain);
	status = read_scene(&reader);
	uselocale(before);
	freelocale(plain);
	if (status == CAROM_OK) {
		*scene = reader.scene;
	} else {
		carom_scene_destroy(reader.scene);
	}
	return status;
}

/* All there is to read, as far as it can be a scene: the size of a pipe isn't known beforehand, and a device may have no end. */
static bool read_all(FILE *file, char **text, size_t *length)
{
	for (size_t capacity = 1 << 16, begun = 0; begun <= MOST_BYTES; begun = *length, capacity *= 2) {
		char *grown = realloc(*text, capacity);
		if (!grown)
			return false;
		*text = grown;
		*length += fread(*text + begun, 1, capacity - begun, file);
		if (*length < capacity)
			return !ferror(file);
		if (memchr(*text + begun, '\0', *length - begun))
			return true; /* which no JSON has */
	}
	return true;
}

static FILE *open_scene(const char *path)
{
	carom_target target = {.descriptor = -1};
	if (!carom_follow(path, &target) || target.descriptor < 0)
		return fopen(path, "rb");
	const int descriptor = carom_duplicate(target.descriptor, O_WRONLY);
	FILE *file = descriptor >= 0 ? fdopen(descriptor, "rb") : NULL;
	if (descriptor >= 0 && !file)
		close(descriptor);
	return file;
}

carom_status carom_scene_read(const char *path, carom_scene **scene, carom_error *error)
{
	carom_status status;
	char *text = NULL;
	char reason[128];
	size_t length = 0;
	FILE *file;
	GIVEN(path, error);
	GIVEN(scene, error);
	errno = 0;
	file = open_scene(path);
	if (file && read_all(file, &text, &length)) {
		status = carom_scene_parse(text, length, path, scene, error);
	} else if (errno == ENOMEM) {
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "%s: there is not enough memory to read it", path);
	} else {
		status = carom_fail(error, CAROM_IO, "%s: can't be read: %s; give the path of a scene file", path,
			carom_errno_text(errno, reason, sizeof reason));
	}
	free(text);
	if (file)
		fclose(file);
	return status;
}
