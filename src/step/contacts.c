/* The step contacts: events, and forces between bodies that rest on each other, so that they need not hit each other without end.
 *
 * What bears what is found as a step begins: bodies that are nearer than what gravity and forces move them in a step, and do not come together much
 * faster than that. Those that would meet in the step are stopped at once: iterations find the impulses. Others then find the forces that let none of
 * them come too near by the end of the step; for as long they are a part of what pushes each body. All else is the step events', which answers whatever
 * they leave at its exact time: nothing passes through anything, and nothing is pushed apart. Iterations that one handing over has no room for go on in
 * the next. */
#include "layout.h"
#include "status.h"
#include "step/events.h"

#define FIRST_ITERATIONS 16 /* handed over a pass */
#define FIRST_FOURS 2       /* of points a body, and */
#define FIRST_WARM 6        /* contacts, of which the forces are kept; more are made when they are needed */

/* What it was, after a step, or before one that begins `again`. */
static carom_status release(carom_world *world, int32_t again, carom_error *error)
{
	return carom_run(world, STAGE_CONTACTS_RELEASE, carom_events_share(world), 1, carom_events_movers(world), again, error);
}

/* Of all slots, what SLEEP_... says. */
static carom_status sleep_of(carom_world *world, uint32_t count, int32_t what, carom_error *error)
{
	return carom_run(world, STAGE_SLEEP_BEGIN, (int32_t)count, 1, carom_events_movers(world), what, error);
}

/* Before the device is told of so many changes, who is to wake; 0: all, for what holds for all is another one. */
static carom_status wake(carom_world *world, uint32_t changes, carom_error *error)
{
	if (changes > 0)
		return carom_run(world, STAGE_SLEEP_END, (int32_t)changes, 1, 0, 0, error);
	return sleep_of(world, world->events.known, SLEEP_ENDS, error);
}

/* What bears what, and with which impulses or forces. */
static carom_status bear(carom_world *world, carom_error *error)
{
	const int32_t count = (int32_t)world->body_count, share = carom_events_share(world), first = world->events.iteration + 1;
	const int32_t last = world->events.iteration += (int32_t)world->events.iterations;
	TRY(carom_run(world, STAGE_CONTACTS_BEGIN, 1, 1, first, last, error));
	TRY(carom_run(world, STAGE_CONTACTS_FIND, count, 1, first, 0, error));
	TRY(carom_run(world, STAGE_CONTACTS_FIND, count, 1, first, 1, error));
	TRY(carom_run(world, STAGE_CONTACTS_JOIN, share, 1, first, 0, error));
	for (int32_t iteration = first; iteration <= last; iteration++)
		TRY(carom_run(world, STAGE_CONTACTS_ITERATE, share, 1, iteration, 0, error));
	return carom_run(world, STAGE_CONTACTS_APPLY, share, 1, carom_events_movers(world), last, error);
}

static carom_status run(carom_world *world, carom_error *error)
{
	if (carom_events_lists_are_due(world)) {
		TRY(release(world, 1, error)); /* the slots are sorted anew */
		TRY(wake(world, 0, error));
		TRY(carom_events_find_neighbours(world, error));
	}
	for (int pass = 0; pass < 2; pass++) /* impulses, forces */
		TRY(bear(world, error));
	TRY(carom_events_resolve(world, error));
	TRY(release(world, 0, error));
	return sleep_of(world, (uint32_t)world->body_count, SLEEP_BEGINS, error);
}

/* Of a step that is not done nothing is left: it begins again, with new lists, which forget how far it was. */
static carom_status unload(carom_world *world, carom_error *error)
{
	TRY(release(world, 1, error));
	if (world->events.within)
		carom_events_drop_lists(world);
	return carom_events_unload(world, error);
}

/* What bears a body where it has been put is looked for before it could hit that. */
static carom_status begin(carom_world *world, carom_error *error)
{
	if (!world->contacts_sent && world->newest & PLACE_SLOTS)
		TRY(wake(world, 0, error));
	TRY(carom_contacts_send(world, error));
	TRY(carom_events_begin(world, error));
	if (world->events.iteration == 0) /* they are loaded anew */
		TRY(sleep_of(world, world->capacity, SLEEP_FORGOTTEN, error));
	TRY(carom_joints_drive(world, error));
	return world->events.told ? carom_events_mend(world, error) : CAROM_OK;
}

/* What a list of so many items takes, in items: its last row is whole. */
static uint64_t folded(uint64_t items)
{
	return items > UINT32_MAX / 2 ? items : (uint64_t)carom_row_width((uint32_t)items) * carom_row_count((uint32_t)items);
}

/* Where some body has friction, too. */
static uint64_t memory(const carom_pipeline *pipeline, const carom_world_def *def, size_t body_count, size_t vertex_count)
{
	const uint64_t n = carom_capacity(body_count),
				   records = folded(FIRST_FOURS * FOUR_WIDTH * n) + folded(FIRST_FOURS * GRIP_WIDTH * n) + folded(LOADS_LISTS * (n + 1))
		+ folded(PUSHES_WIDTH * n) + folded(SHOCK_RECORDS * carom_events_numbers(n)) + folded(FIRST_WARM * n * WARM_WIDTH(true));
	return carom_events_memory(pipeline, def, body_count, vertex_count) + 16 * records
		+ 4 * (folded(TOUCHING_WIDTH * n) + folded(WARM_SPAN_WIDTH * (n + 1)) + folded(n));
}

static carom_status create_contacts(carom_world *world, carom_error *error)
{
	const uint64_t fours = world->events.fours_room;
	TRY(carom_events_create_list(world, ROLE_CONTACTS, false, FOUR_WIDTH * fours, error));
	return carom_events_create_list(world, ROLE_GRIPS, false, GRIP_WIDTH * (world->traits & TRAIT_RUBS ? fours : 1), error);
}

/* Points, and forces that are kept, for which there was no room. What Contacts has is found anew with new lists; what Warm has the host sends. */
static carom_status grow(carom_world *world, int32_t *status, carom_error *error)
{
	if (status[STATUS_FOURS] > status[STATUS_FOURS_ROOM]) {
		world->events.fours_room = carom_events_enough(status[STATUS_FOURS]);
		TRY(create_contacts(world, error));
		status[STATUS_FOURS_ROOM] = (int32_t)world->events.fours_room;
	}
	return carom_contacts_grow(world, error);
}

static carom_status prepare(carom_world *world, carom_error *error)
{
	const uint64_t n = world->capacity;
	TRY(carom_events_prepare(world, error));
	world->events.iterations = FIRST_ITERATIONS;
	world->contacts_sent = false;
	world->events.fours_room = FIRST_FOURS * world->capacity;
	world->events.warm_room = FIRST_WARM * world->capacity;
	TRY(create_contacts(world, error));
	TRY(carom_events_create_list(world, ROLE_TOUCHING, false, TOUCHING_WIDTH * n, error));
	TRY(carom_events_create_list(world, ROLE_ISLANDS, false, n, error));
	TRY(carom_events_create_list(world, ROLE_SHOCKS, false, SHOCK_RECORDS * carom_events_numbers(n), error));
	TRY(carom_events_create_list(world, ROLE_LOADS, false, LOADS_LISTS * (n + 1), error));
	TRY(carom_events_create_list(world, ROLE_PUSHES, false, PUSHES_WIDTH * n, error));
	TRY(carom_events_create_list(world, ROLE_WARM, false, WARM_WIDTH(world->traits & TRAIT_RUBS) * (uint64_t)world->events.warm_room, error));
	return carom_events_create_list(world, ROLE_WARM_SPANS, false, WARM_SPAN_WIDTH * (n + 1), error);
}

const carom_step carom_step_contacts = {
	"contacts", false, prepare, run, begin, carom_events_finish, unload, carom_events_take_hits, false, memory, grow, wake};
