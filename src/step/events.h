/* What the step contacts, which is events with a stage more, has of it. */
#ifndef CAROM_STEP_EVENTS_H
#define CAROM_STEP_EVENTS_H

#include "step/step.h"
#include "world.h"

carom_status carom_events_prepare(carom_world *world, carom_error *error);
carom_status carom_events_begin(carom_world *world, carom_error *error);
carom_status carom_events_finish(carom_world *world, carom_error *error);
carom_status carom_events_unload(carom_world *world, carom_error *error);
carom_status carom_events_take_hits(carom_world *world, carom_error *error);
uint64_t carom_events_memory(const carom_pipeline *pipeline, const carom_world_def *def, size_t body_count, size_t vertex_count);

/* The next step begins with new lists of neighbours. */
void carom_events_drop_lists(carom_world *world);
/* A step's two halves: makes new lists of neighbours where it is time, and answers the hits. */
bool carom_events_lists_are_due(const carom_world *world);
carom_status carom_events_find_neighbours(carom_world *world, carom_error *error);
carom_status carom_events_resolve(carom_world *world, carom_error *error);
/* New neighbours of bodies that may leave the boxes that lists were made for, as resolving begins with. */
carom_status carom_events_mend(carom_world *world, carom_error *error);

#define EVENTS_ROUNDS 2 /* handed over a step, at least */

/* After a batch, from its status: how the next is driven; and where no step is under way, how many slices its steps have. */
carom_status carom_events_adapt(carom_world *world, const int32_t *status, carom_error *error);
void carom_events_adapt_slices(carom_events *events, int32_t *status);

/* A texture of so many ints or records, folded into rows. */
carom_status carom_events_create_list(carom_world *world, carom_role role, bool pair, uint64_t items, carom_error *error);
int32_t carom_events_share(const carom_world *world);  /* work-items that share what is active */
uint64_t carom_events_numbers(uint64_t capacity);      /* of members: a cluster may lose one to another, so there are some more than bodies */
int32_t carom_events_movers(const carom_world *world); /* room in Movers */
uint32_t carom_events_enough(int32_t wanted);          /* room for so many items that were wanted, and some more */

#endif
