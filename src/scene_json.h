/* JSON values into C values, with errors that name the place. What jansson is needed for, and all of it.
 *
 * Each kind of object has a table of its keys; what a key may hold is the reader and the rule of its row.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_SCENE_JSON_H
#define CAROM_SCENE_JSON_H

#include "scene.h"

typedef struct json_t json_t;

struct scene_reader {
	const char *name; /* of the file */
	const char *text, *end;
	const char *bodies, *bodies_end; /* what is cut out of the text; both at its end if nothing is */
	const char *body;                /* where the body being read starts, NULL outside of the cut */
	bool broken_behind;              /* the text behind the cut is no JSON */
	carom_scene *scene;
	carom_error *error;
};

/* A JSON path, kept on the stack and written out only for an error. */
struct scene_place {
	const struct scene_place *outer; /* NULL for a key of the file's outermost object */
	const char *key;                 /* NULL for an array's element */
	size_t index;
};

struct scene_range {
	double min, max;
	bool above_min;   /* min itself is not allowed */
	const char *text; /* what is allowed, for the error */
};

/* Reads `value` into `target`, or fails and names `place`. */
typedef carom_status scene_read_function(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range);

/* Text that is read without a tree. */
struct scene_text {
	const char *at, *end;
	carom_scene *scene;
};

/* The same from the text itself, for what the library writes; false for all else, which is for a tree to read or to refuse.
 * What is accepted here is what a tree would give, to the bit. */
typedef bool scene_quick_function(struct scene_text *text, void *target, const struct scene_range *range);

/* A row of a table of keys; the last has no key. */
struct scene_field {
	const char *key; /* "*": every key that no row before has */
	scene_read_function *read;
	scene_quick_function *quick; /* NULL: always from a tree */
	size_t offset;               /* in what the object is read into */
	const struct scene_range *range;
	bool required;
};

#define SCENE_LAST_FIELD                 \
	{                                    \
		NULL, NULL, NULL, 0, NULL, false \
	}

extern const struct scene_range scene_any, scene_positive, scene_part, scene_friction, scene_damping, scene_bits;

scene_read_function scene_read_number; /* into a float */
scene_read_function scene_read_whole;  /* into a uint32_t */
scene_read_function scene_read_pair;   /* into a carom_vec2 */
scene_read_function scene_read_flag;   /* into a bool */
scene_read_function scene_read_string; /* into a const char *, owned by the scene */
scene_read_function scene_read_color;  /* into a uint32_t */

carom_status scene_read_object(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_field *fields);
/* Element k goes through `read` into `target` + k * stride. */
carom_status scene_read_array(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target, size_t stride,
	scene_read_function *read, const struct scene_range *range);

scene_quick_function scene_quick_number, scene_quick_whole, scene_quick_pair, scene_quick_flag, scene_quick_string, scene_quick_color;

/* One or more elements, each of which `one` reads. */
bool scene_quick_array(struct scene_text *text, bool (*one)(struct scene_text *text));
bool scene_quick_object(struct scene_text *text, void *target, const struct scene_field *fields);
/* The character after spaces, or nothing. */
bool scene_quick_take(struct scene_text *text, char character);

/* What both ways of reading check. */
bool scene_fit_number(double number, const struct scene_range *range, float *rounded);
bool scene_fit_whole(double number, const struct scene_range *range, uint32_t *whole);
bool scene_fit_color(const char *text, uint32_t *color);
/* The first required key whose bit, by row, is not set; NULL if none is missing. */
const char *scene_missing_key(const struct scene_field *fields, unsigned seen);

/* 0 for what is no array. */
size_t scene_array_size(const json_t *value);
bool scene_is_array(const json_t *value);

/* The text without the bodies; *head is released by scene_json_destroy. */
carom_status scene_parse_head(struct scene_reader *reader, json_t **head);
/* One element of the bodies. */
carom_status scene_parse_element(struct scene_reader *reader, const char *begin, const char *end, json_t **element);
void scene_json_destroy(json_t *value);

scene_read_function scene_read_body; /* adds it to the scene */
/* Those of a body that is the next to be added. */
scene_read_function scene_read_contacts, scene_read_joints;
scene_quick_function scene_quick_contacts, scene_quick_joints;
/* The bodies that were cut out of the text, one by one. */
carom_status scene_read_bodies(struct scene_reader *reader);

carom_status scene_fail(const struct scene_reader *reader, const struct scene_place *place, const char *format, ...) CAROM_PRINTF(3, 4);
carom_status scene_fail_value(const struct scene_reader *reader, const struct scene_place *place, const json_t *value, const char *allowed);
carom_status scene_fail_memory(const struct scene_reader *reader);

#endif
