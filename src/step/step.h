/* A step: a whole simulation loop over the slots. What changes the data between slots is a new step, in a file of its own. */
#ifndef CAROM_STEP_H
#define CAROM_STEP_H

#include "carom.h"

struct carom_world;

typedef struct carom_step {
	const char *name;
	bool pairs; /* it writes Linear and Rotational while it reads them */
	/* Creates what the step needs besides the textures of the state; CAROM_LIMIT says which texture is too large. */
	carom_status (*prepare)(struct carom_world *world, carom_error *error);
	/* Hands one step to the device, from the world's front textures to its back textures, and swaps them. Never waits. */
	carom_status (*run)(struct carom_world *world, carom_error *error);
	/* The next three may be NULL. Before and after a batch of runs; the device may be at work while the first is called. */
	carom_status (*begin)(struct carom_world *world, carom_error *error);
	carom_status (*finish)(struct carom_world *world, carom_error *error);
	/* Brings the textures of the state up to date, of a step that keeps the state elsewhere (PLACE_SLOTS). */
	carom_status (*unload)(struct carom_world *world, carom_error *error);
	/* Where the world's def has hits kept: takes those of the runs since begin, before finish is called. */
	carom_status (*take_hits)(struct carom_world *world, carom_error *error);
	bool keeps_last_hit; /* and no other one: each run is a batch of its own then */
	/* Bytes of what prepare creates. */
	uint64_t (*memory)(const carom_pipeline *pipeline, const carom_world_def *def, size_t body_count, size_t vertex_count);
	/* May be NULL. By finish, of what `status` says is too small, and is the step's own. */
	carom_status (*grow)(struct carom_world *world, int32_t *status, carom_error *error);
	/* May be NULL. Where slots go on: so many of Changes are going to be changed; 0: what holds for all, or who there is. */
	carom_status (*wake)(struct carom_world *world, uint32_t changes, carom_error *error);
} carom_step;

extern const carom_step carom_step_first_impact, carom_step_events, carom_step_contacts;

extern const carom_step *const carom_steps[];
extern const size_t carom_step_count;

#endif
