/* How the step events is driven follows from how it went: how many rounds and slices a step is handed over with, how many steps with one making of the lists, and how far
 * these reach. None of it changes a result. */
#include "step/events.h"

#include "layout.h"
#include "status.h"

#define MOST_ROUNDS 64
#define MOST_IDLE 256 /* batches that end no step: something is wrong */
#define PATIENCE 4    /* of them, with lists that were too short: from then on each making has the slowest bodies get twice as far */
#define MOST_DOUBLINGS 20
#define LOST_LEAST 256     /* events in a slice: for less another is not worth its kernels */
#define SLICES_SOME 4      /* as some are to one, SLICES_MOST are to some */
#define MANY_NEIGHBOURS 32 /* a slot: then that does not go on */
#define LEAST_ITERATIONS 8 /* handed over a pass */
#define LONG_LISTS 32      /* steps, for which most may be asleep: where they wake they need new ones */
#define LONGEST_LISTS 1024
#define GOOD_LISTS 4 /* made in a row that were good to the end: the next may be used a step longer */

/* Where each body that is hit gets farther than its list, and there is no end of it, all are to know more of the others. */
static void adapt_reach(carom_world *world, const int32_t *status)
{
	carom_events *events = &world->events;
	if (status[STATUS_STEPS] > 0) {
		if (events->doublings > 0)
			carom_events_drop_lists(world); /* those lists are too long for other steps */
		events->stale = events->doublings = 0;
	} else if (status[STATUS_STALE]) {
		const bool more = ++events->stale > PATIENCE && events->doublings < MOST_DOUBLINGS;
		events->doublings += more && (uint64_t)status[STATUS_NEIGHBOURS] < MANY_NEIGHBOURS * (uint64_t)world->body_count;
	}
}

/* There are more slices where more than half of all work was lost, fewer where less than a ninth; one, some or many, for with two clusters may still run into one another all over the
 * room, and what is between loses little. */
void carom_events_adapt_slices(carom_events *events, int32_t *status)
{
	const int64_t lost = status[STATUS_LOST], answered = 2 * (int64_t)status[STATUS_ANSWERED], worth = LOST_LEAST * (int64_t)status[STATUS_STEPS];
	if (8 * lost < answered && events->slices > 1)
		events->slices = events->slices > SLICES_SOME ? SLICES_SOME : 1;
	for (int64_t bound = answered; bound > 0 && lost > bound && lost > worth * events->slices && events->slices < SLICES_MOST; bound *= SLICES_SOME)
		events->slices *= SLICES_SOME;
	status[STATUS_LOST] = status[STATUS_ANSWERED] = 0;
	status[STATUS_SLICES] = events->saves ? (int32_t)events->slices : 1;
}

/* A step that waits for more begins again where lists are made for each: then there are to be enough at once, and not fewer soon. */
static void adapt_iterations(carom_events *events, const int32_t *status)
{
	const int32_t steps = status[STATUS_STEPS], waits = status[STATUS_WAITS];
	if (waits > steps)
		events->iterations = CONTACT_ITERATIONS;
	else if (waits > steps / 8 && events->iterations < CONTACT_ITERATIONS)
		events->iterations *= 2;
	else if (waits == 0 && 4 * (uint32_t)status[STATUS_MOST] <= events->iterations && events->iterations > LEAST_ITERATIONS
		&& events->steps_a_list > 1)
		events->iterations /= 2;
}

/* How many steps are handed over to one making of the lists, and with how many rounds, follows from how it went. */
carom_status carom_events_adapt(carom_world *world, const int32_t *status, carom_error *error)
{
	carom_events *events = &world->events;
	const int32_t steps = status[STATUS_STEPS], builds = status[STATUS_BUILDS];
	events->idle = steps > 0 ? 0 : events->idle + 1;
	events->looks_ahead = status[STATUS_AHEAD] > 0;
	adapt_reach(world, status);
	if (events->idle > MOST_IDLE)
		return carom_fail(error, CAROM_DEVICE, "'%s' ends no step of events any more", world->device->info.name);
	if (status[STATUS_AGAIN] > steps / 8 && events->rounds < MOST_ROUNDS)
		events->rounds++;
	else if (status[STATUS_AGAIN] == 0 && events->rounds > EVENTS_ROUNDS)
		events->rounds--;
	adapt_iterations(events, status);
	events->good += (uint32_t)builds;
	if (status[STATUS_IDLE] > 0) {
		/* being idle cost little, but the lists had died before their time */
		events->steps_a_list = events->steps_a_list > LONG_LISTS ? LONG_LISTS : events->steps_a_list - (events->steps_a_list > 1);
		events->good = 0;
	} else if (2 * (size_t)status[STATUS_SLEEPERS] > world->body_count && 8 * status[STATUS_MOVERS] < carom_events_movers(world)
		&& 2 * events->since >= events->steps_a_list && events->steps_a_list < LONGEST_LISTS) {
		events->steps_a_list *= 2; /* most sleep, and the others have hardly got any farther */
	} else if (events->good > GOOD_LISTS) {
		events->steps_a_list++;
		events->good = 0;
	}
	return CAROM_OK;
}
