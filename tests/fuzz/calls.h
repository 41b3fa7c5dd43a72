/* Calls of the library, made up from bytes, each judged by what the header promises.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_CALLS_H
#define CAROM_TESTS_CALLS_H

#include "bytes.h"
#include "fuzz.h"

enum { MOST_WORLDS = 3, MOST_BODIES = 12, MOST_CONTACTS = 127 };

typedef struct calls {
	bytes bytes;
	uint32_t threads; /* of every world */
	uint64_t work;    /* that may still be done: a step, or some hits */
	uint64_t trace;   /* a hash of all that the calls gave */
	carom_world *worlds[MOST_WORLDS];
	carom_world **slot; /* the world of this call, one of those above; *slot may be NULL */
} calls;

/* The next call that the bytes say. */
void calls_make(calls *c);

/* Into the trace. */
void calls_note(calls *c, const void *data, size_t size);
/* fuzz_judge, and into the trace. */
bool calls_judge(calls *c, carom_status status, const carom_error *error);

/* What a call may do to the state of a world. */
typedef struct snapshot {
	size_t count;
	double time;
	uint64_t hash;
} snapshot;
snapshot calls_look(calls *c);
/* A failure changed nothing. */
void calls_same(calls *c, snapshot before);
/* An index of a body that may be one too many, or far too many. */
uint32_t calls_index(calls *c);

/* calls_joints.c: those that join bodies, and drive motors */
void calls_join(calls *c);
/* calls_steps.c: those that let time pass */
void calls_step(calls *c);
void calls_advance(calls *c);
void calls_advance_to(calls *c);
void calls_break_off(calls *c);
/* calls_outputs.c: those that write and draw */
void calls_render(calls *c);
void calls_png(calls *c);
void calls_scene(calls *c);
void calls_parse(calls *c);
void calls_file(calls *c);

#endif
