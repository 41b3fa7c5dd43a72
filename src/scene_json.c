/* jansson is included here and nowhere else.
 * SPDX-License-Identifier: MIT */
#include "scene_json.h"

#include <float.h>
#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Integers are read as reals: one kind of number, -0 keeps its sign, and 1 followed by twenty zeros is a number too. */
#define FLAGS (JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL)

/* What lies below rounds to a float: FLT_MAX with nine digits is already above FLT_MAX. */
#define MAX_ROUNDED 0x1.ffffffp127

const struct scene_range scene_any = {-FLT_MAX, FLT_MAX, false, "a number within +-3.4e38"};
const struct scene_range scene_positive = {0, FLT_MAX, true, "a number above 0, at most 3.4e38"};
const struct scene_range scene_part = {0, 1, false, "a number from 0 to 1"};
const struct scene_range scene_friction = {0, (double)CAROM_MAX_FRICTION, false, "a number from 0 to 1000"};
const struct scene_range scene_damping = {0, FLT_MAX, false, "a number from 0 to 3.4e38"};
const struct scene_range scene_bits = {0, UINT32_MAX, false, "a whole number from 0 to 4294967295, a bit for each category"};

/* ---- Errors ---- */

static size_t put_place(char *text, size_t size, const struct scene_place *place)
{
	if (!place)
		return 0;
	size_t length = put_place(text, size, place->outer);
	if (length >= size)
		return size;
	int more = place->key ? snprintf(text + length, size - length, "%s%.80s", length ? "." : "", place->key)
						  : snprintf(text + length, size - length, "[%zu]", place->index);
	return length + (size_t)more;
}

static void set_position(carom_error *error, const char *text, const char *at)
{
	error->line = 1;
	error->column = 0;
	for (; text < at; text++) {
		if (*text == '\n') {
			error->line++;
			error->column = 0;
		} else if (((unsigned char)*text & 0xC0) != 0x80) { /* a UTF-8 character counts once */
			error->column++;
		}
	}
}

/* One line, whatever the file holds. */
static carom_status finish(const struct scene_reader *reader, const carom_error *at)
{
	if (!reader->error)
		return CAROM_INVALID_SCENE;
	reader->error->line = at->line;
	reader->error->column = at->column;
	for (char *text = reader->error->text; *text; text++) {
		if ((unsigned char)*text < 0x20 || *text == 0x7f)
			*text = '?';
	}
	return CAROM_INVALID_SCENE;
}

carom_status scene_fail(const struct scene_reader *reader, const struct scene_place *place, const char *format, ...)
{
	char where[256] = "", what[640], line[24] = "";
	carom_error at = {.line = 0};
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(what, sizeof what, format, arguments);
	va_end(arguments);
	put_place(where, sizeof where, place);
	if (reader->body) {
		set_position(&at, reader->text, reader->body + 1);
		snprintf(line, sizeof line, ":%d", at.line);
	}
	carom_fail(reader->error, CAROM_INVALID_SCENE, "%s%s: %s%s%s", reader->name, line, where, *where ? ": " : "", what);
	return finish(reader, &at);
}

carom_status scene_fail_memory(const struct scene_reader *reader)
{
	return carom_fail(reader->error, CAROM_OUT_OF_MEMORY, "%s: there is not enough memory to read it", reader->name);
}

/* Where memory ends jansson's parser says nothing, or, of a string, that none is there: nothing else that is wrong ends with a quotation mark. */
static bool is_memory(const struct scene_reader *reader, const char *at, const json_error_t *found)
{
	const bool misses_string = strncmp(found->text, "invalid token", 13) == 0 || strncmp(found->text, "string or '}' expected", 22) == 0;
	return json_error_code(found) == json_error_out_of_memory || !*found->text || (misses_string && at > reader->text && at[-1] == '"');
}

/* What jansson found wrong; `at` is behind it. */
static carom_status fail_syntax(const struct scene_reader *reader, const char *at, const json_error_t *found)
{
	static const char too_much[] = "end of file expected"; /* jansson's words, where it was given an element alone */
	carom_error position;
	const char *text = found->text, *instead = "";
	if (is_memory(reader, at, found))
		return scene_fail_memory(reader);
	if (reader->body && strncmp(text, too_much, sizeof too_much - 1) == 0) {
		instead = "',' or ']' expected";
		text += sizeof too_much - 1;
	}
	set_position(&position, reader->text, at);
	carom_fail(reader->error, CAROM_INVALID_SCENE, "%s:%d:%d: not valid JSON: %s%s", reader->name, position.line, position.column, instead, text);
	return finish(reader, &position);
}

/* At most 40 bytes of a string, not cut within a character. */
static int shown_length(const char *string)
{
	int length = (int)strnlen(string, 40);
	while (length > 0 && ((unsigned char)string[length] & 0xC0) == 0x80)
		length--;
	return length;
}

static const char *describe(const json_t *value, char *text, size_t size)
{
	const char *string = json_string_value(value);
	switch (json_typeof(value)) {
	case JSON_OBJECT: return "an object";
	case JSON_ARRAY: snprintf(text, size, "an array of %zu", json_array_size(value)); break;
	case JSON_STRING: snprintf(text, size, "\"%.*s%s\"", shown_length(string), string, strlen(string) > 40 ? "..." : ""); break;
	case JSON_INTEGER:
	case JSON_REAL: snprintf(text, size, "%.9g", json_number_value(value)); break;
	case JSON_TRUE: return "true";
	case JSON_FALSE: return "false";
	case JSON_NULL: return "null";
	}
	return text;
}

carom_status scene_fail_value(const struct scene_reader *reader, const struct scene_place *place, const json_t *value, const char *allowed)
{
	char found[64];
	return scene_fail(reader, place, "found %s; allowed: %s", describe(value, found, sizeof found), allowed);
}

static carom_status fail_key(const struct scene_reader *reader, const struct scene_place *place, const struct scene_field *fields)
{
	char known[320] = "";
	size_t length = 0;
	for (; fields->key && length < sizeof known; fields++) {
		length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", length ? ", " : "", fields->key);
	}
	return scene_fail(reader, place, "unknown key; allowed: %s", known);
}

/* ---- Values ---- */

bool scene_fit_number(double number, const struct scene_range *range, float *rounded)
{
	double near = fabs(number) < MAX_ROUNDED ? (double)(float)number : number;
	if (!(near >= range->min) || !(near <= range->max) || (range->above_min && near == range->min))
		return false;
	*rounded = (float)near;
	return true;
}

bool scene_fit_whole(double number, const struct scene_range *range, uint32_t *whole)
{
	if (!(number >= range->min) || !(number <= range->max) || floor(number) < number)
		return false;
	*whole = (uint32_t)number;
	return true;
}

bool scene_fit_color(const char *text, uint32_t *color)
{
	static const char digits[] = "0123456789abcdefABCDEF";
	size_t length = strlen(text);
	if ((length != 4 && length != 7) || *text != '#' || strspn(text + 1, digits) != length - 1)
		return false;
	*color = (uint32_t)strtoul(text + 1, NULL, 16);
	if (length == 4)
		*color = ((*color & 0xF00) << 8 | (*color & 0xF0) << 4 | (*color & 0xF)) * 0x11;
	return true;
}

const char *scene_missing_key(const struct scene_field *fields, unsigned seen)
{
	for (unsigned row = 0; fields[row].key; row++) {
		if (fields[row].required && !(seen >> row & 1))
			return fields[row].key;
	}
	return NULL;
}

carom_status scene_read_number(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	if (json_is_number(value) && scene_fit_number(json_number_value(value), range, target))
		return CAROM_OK;
	return scene_fail_value(reader, place, value, range->text);
}

carom_status scene_read_whole(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	if (json_is_number(value) && scene_fit_whole(json_number_value(value), range, target))
		return CAROM_OK;
	return scene_fail_value(reader, place, value, range->text);
}

carom_status scene_read_pair(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	float pair[2];
	if (json_array_size(value) != 2)
		return scene_fail_value(reader, place, value, "an array of 2 numbers, [x, y]");
	carom_status status = scene_read_array(reader, place, value, pair, sizeof *pair, scene_read_number, range);
	if (status == CAROM_OK)
		*(carom_vec2 *)target = (carom_vec2){pair[0], pair[1]};
	return status;
}

carom_status scene_read_flag(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	(void)range;
	if (!json_is_boolean(value))
		return scene_fail_value(reader, place, value, "true or false");
	*(bool *)target = json_is_true(value);
	return CAROM_OK;
}

carom_status scene_read_string(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	(void)range;
	if (!json_is_string(value))
		return scene_fail_value(reader, place, value, "a string");
	size_t size = json_string_length(value) + 1;
	char *copy = scene_allocate(reader->scene, size);
	if (!copy)
		return scene_fail_memory(reader);
	memcpy(copy, json_string_value(value), size);
	*(const char **)target = copy;
	return CAROM_OK;
}

carom_status scene_read_color(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	(void)range;
	if (json_is_string(value) && scene_fit_color(json_string_value(value), target))
		return CAROM_OK;
	return scene_fail_value(reader, place, value, "a colour, \"#rgb\" or \"#rrggbb\"");
}

static const struct scene_field *find_field(const struct scene_field *fields, const char *key)
{
	while (fields->key && strcmp(fields->key, "*") != 0 && strcmp(fields->key, key) != 0)
		fields++;
	return fields;
}

carom_status scene_read_object(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_field *fields)
{
	const char *key;
	json_t *item;
	unsigned seen = 0;
	if (!json_is_object(value))
		return scene_fail_value(reader, place, value, "an object");
	json_object_foreach((json_t *)(uintptr_t)value, key, item)
	{ /* wants no const, but changes nothing */
		struct scene_place inner = {place, key, 0};
		const struct scene_field *field = find_field(fields, key);
		if (!field->key)
			return fail_key(reader, &inner, fields);
		carom_status status = field->read(reader, &inner, item, (char *)target + field->offset, field->range);
		if (status != CAROM_OK)
			return status;
		seen |= 1u << (field - fields);
	}
	const char *missing = scene_missing_key(fields, seen);
	return missing ? scene_fail(reader, place, "\"%s\" is missing", missing) : CAROM_OK;
}

carom_status scene_read_array(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target, size_t stride,
	scene_read_function *read, const struct scene_range *range)
{
	carom_status status = CAROM_OK;
	for (size_t k = 0; status == CAROM_OK && k < json_array_size(value); k++) {
		struct scene_place element = {place, NULL, k};
		status = read(reader, &element, json_array_get(value, k), (char *)target + k * stride, range);
	}
	return status;
}

size_t scene_array_size(const json_t *value)
{
	return json_array_size(value);
}

bool scene_is_array(const json_t *value)
{
	return json_is_array(value);
}

/* ---- Text ---- */

struct feed {
	const char *at;
	const struct scene_reader *reader;
};

/* Hands jansson the text up to the bodies, then the text behind them. */
static size_t feed_head(void *buffer, size_t size, void *data)
{
	struct feed *feed = data;
	const struct scene_reader *reader = feed->reader;
	if (feed->at == reader->bodies)
		feed->at = reader->bodies_end;
	size_t left = (size_t)((feed->at < reader->bodies ? reader->bodies : reader->end) - feed->at);
	if (size > left)
		size = left;
	memcpy(buffer, feed->at, size);
	feed->at += size;
	return size;
}

carom_status scene_parse_head(struct scene_reader *reader, json_t **head)
{
	struct feed feed = {reader->text, reader};
	json_error_t found = {.text = "found a NUL byte"}; /* jansson would take it for the end of the file */
	const char *nul = memchr(reader->text, '\0', (size_t)(reader->end - reader->text));
	if (nul)
		return fail_syntax(reader, nul + 1, &found);
	*head = json_load_callback(feed_head, &feed, FLAGS, &found);
	if (*head)
		return CAROM_OK;
	const char *at = reader->text + (found.position > 0 ? found.position : 0);
	reader->broken_behind = at >= reader->bodies;
	if (reader->broken_behind)
		at += reader->bodies_end - reader->bodies;
	return fail_syntax(reader, at, &found);
}

carom_status scene_parse_element(struct scene_reader *reader, const char *begin, const char *end, json_t **element)
{
	json_error_t found = {.text = "a body expected"};
	*element = NULL;
	if (begin == end)
		return fail_syntax(reader, begin, &found);
	*element = json_loadb(begin, (size_t)(end - begin), FLAGS | JSON_DECODE_ANY, &found);
	return *element ? CAROM_OK : fail_syntax(reader, begin + found.position, &found);
}

void scene_json_destroy(json_t *value)
{
	json_decref(value);
}
