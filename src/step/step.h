/* A step: a whole simulation loop over the slots. What changes the data between slots is a new step, in a file of its own. */
#ifndef CAROM_STEP_H
#define CAROM_STEP_H

#include "carom.h"

struct carom_world;

typedef struct carom_step {
	const char *name;
	/* Creates what the step needs besides the textures of the state; CAROM_LIMIT says which texture is too large. */
	carom_status (*prepare)(struct carom_world *world, carom_error *error);
	/* Hands one step to the device, from the world's front textures to its back textures, and swaps them. Never waits. */
	carom_status (*run)(struct carom_world *world, carom_error *error);
	/* Bytes of what prepare creates. */
	uint64_t (*memory)(const carom_pipeline *pipeline, const carom_world_def *def, size_t body_count);
} carom_step;

extern const carom_step carom_step_first_impact;

extern const carom_step *const carom_steps[];
extern const size_t carom_step_count;

#endif
