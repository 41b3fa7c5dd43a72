/* What the reader of scenes is made of: the storage behind a carom_scene, and finding the bodies in a text.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_SCENE_H
#define CAROM_SCENE_H

#include "status.h"

/* What carom_scene.storage points to. */
struct scene_storage {
	char *name;                 /* of the file, for errors */
	struct scene_block *blocks; /* vertices and strings */
};

/* A scene of no bodies with the default world; NULL if there is no memory. */
carom_scene *scene_create(const char *name);
/* Memory for any type that lives as long as the scene; NULL if there is none. A million small pieces are cheap. */
void *scene_allocate(carom_scene *scene, size_t size);

/* Room for one more item of an array that is only grown by this, and had `count`; NULL if there is no memory. It may move. */
void *scene_grow(void *items, size_t count, size_t size);

/* What files call them: carom_wall, from -1 down. */
#define SCENE_WALLS 4
extern const char *const scene_walls[SCENE_WALLS];

/* Likewise of carom_joint_kind. */
#define SCENE_JOINT_KINDS 5
extern const char *const scene_joint_kinds[SCENE_JOINT_KINDS];

const char *scene_skip_space(const char *at, const char *end);
/* The text between the brackets of the top-level "bodies" array; false if there is no such array. */
bool scene_find_bodies(const char *text, const char *end, const char **bodies, const char **bodies_end);
/* The end of the array element that starts at `text`: the next comma of its level, or `end`. */
const char *scene_element_end(const char *text, const char *end);

/* Writes a finite number as printf's %.9g does, but -0 as -0.0 and always with a point; answers the length, no NUL follows. */
#define SCENE_NUMBER_SIZE 32
size_t scene_format_number(float number, char *text);
/* scene_put.c: as they stand in a file; those with a key put a comma before it, and nothing at all if it is the default, to the bit. */
bool scene_same_number(float a, float b);
void scene_put_number(FILE *stream, float number);
void scene_put_pair(FILE *stream, carom_vec2 pair);
/* What is no UTF-8 becomes the replacement character, so that the file can be read. */
void scene_put_string(FILE *stream, const char *string);
void scene_put_number_key(FILE *stream, const char *key, float number, float default_number);
void scene_put_pair_key(FILE *stream, const char *key, carom_vec2 pair, carom_vec2 default_pair);
void scene_put_bits_key(FILE *stream, const char *key, uint32_t bits, uint32_t default_bits);
/* The double nearest to the JSON number at `at`. Answers its end, or NULL where there is no number, or none that is quickly
 * read: strtod's work. */
const char *scene_scan_number(const char *at, const char *end, double *number);

#endif
