/* Bytes of an input as numbers, names and definitions: what a caller of the library may come up with.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_BYTES_H
#define CAROM_TESTS_BYTES_H

#include "carom.h"

typedef struct bytes {
	const uint8_t *at, *end; /* behind the end all are 0 */
	uint32_t placed;         /* bodies so far */
	bool tame;               /* all that is given is valid, and of a size that physics can be asked of */
} bytes;

uint8_t bytes_byte(bytes *b);
/* 0 to bound - 1, at most 255. */
uint32_t bytes_below(bytes *b, uint32_t bound);
/* One in `odds`, but not where the bytes have ended. */
bool bytes_chance(bytes *b, uint32_t odds);
/* In [low, high], in 256 steps. */
float bytes_between(bytes *b, float low, float high);
/* Anything: special values, any bits, plain numbers. */
float bytes_wild(bytes *b);
double bytes_wild_double(bytes *b);

/* A slot and an alternative, which may be known; or "". */
const char *bytes_slot(bytes *b);
const char *bytes_alternative(bytes *b);

carom_world_def bytes_world_def(bytes *b);
carom_body_state bytes_state(bytes *b, const carom_world_def *world);
carom_render_def bytes_render_def(bytes *b);

/* A body in that world; what its pointers point to lives as long as the room given. */
typedef struct bytes_body_room {
	carom_vec2 *vertices; /* from malloc, just as many as the body has */
	char name[16];
} bytes_body_room;
carom_body_def bytes_body_def(bytes *b, const carom_world_def *world, bytes_body_room *room);

#endif
