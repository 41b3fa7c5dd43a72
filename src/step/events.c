/* The step events: every hit of a time step at its exact time, in parallel, with work that grows as the number of bodies.
 *
 * Bodies live in slots, sorted by place, with lists of the neighbours that they could reach for a while; one that gets
 * farther gets new neighbours alone. A step looks at the pairs of these lists for hits, but not at those of which it is
 * known that they have none yet; bodies that hit form clusters, and each cluster is a queue of events that one
 * work-item, or a few lanes of a GPU, run to the end of the step. Clusters that get into each other's way are united and run again, in rounds;
 * where that would happen often a step has slices, between which clusters fall apart.
 * A step that can't be done as it was handed over (lists too old or too small, more rounds needed) changes nothing, and
 * those behind it in the batch go on with it: nobody waits. */
#include "step/events.h"

#include "layout.h"
#include "status.h"

#define FIRST_NEIGHBOURS 16   /* a slot; more are made when they are needed */
#define FIRST_HITS 4096       /* or one a body, if that is more; likewise */
#define MANY_HITS (1 << 20)   /* then there are more only where one step alone has more */
#define LAST_NUMBER (1 << 30) /* of a round, or of an iteration of the step contacts */
#define MOST_MOVERS 4096
#define MEND_SHARE 1024  /* slots for one group of those that look for new neighbours */
#define SHARE 16         /* slots for one work-item of those that share what is active, on a CPU, */
#define SHARE_GPU 4      /* and on a GPU, which has work-items in plenty */
#define GROUP_SHARE 8    /* slots for one group of those that run clusters, on a GPU, */
#define MOST_GROUPS 1024 /* and no more: about as many as run at once, so that the largest clusters of all begin first */
#define TEAM_LANES 8     /* of a group, look at one cluster's bodies, */
#define TEAM_LANES_OF_MANY 4
#define MANY (1 << 19) /* bodies: then there are clusters enough to keep all lanes busy */

/* Slots that may get another reach while the lists last. Each is looked for among them all, so there are not too many. */
static uint32_t movers_of(uint32_t capacity)
{
	return (capacity < 64 * MOST_MOVERS ? capacity / 64 : MOST_MOVERS) + 64;
}

/* Ints in Extra. */
static uint64_t extra_of(uint64_t capacity)
{
	return capacity + NODE_WIDTH * (capacity / 2 + 64);
}

int32_t carom_events_share(const carom_world *world)
{
	return (int32_t)world->body_count / (carom_is_gpu(world) ? SHARE_GPU : SHARE) + 64;
}

static carom_status resolve(carom_world *world, int32_t round, carom_error *error)
{
	const int32_t count = (int32_t)world->body_count, groups = count / GROUP_SHARE + 64;
	if (!carom_is_gpu(world))
		return carom_run(world, STAGE_RESOLVE, carom_events_share(world) / GROUP_MOST + 1, 1, round, 1, error);
	return carom_run(world, STAGE_RESOLVE, groups < MOST_GROUPS ? groups : MOST_GROUPS, 1, round, count < MANY ? TEAM_LANES : TEAM_LANES_OF_MANY,
		error);
}

int32_t carom_events_movers(const carom_world *world)
{
	return (int32_t)movers_of(world->capacity);
}

void carom_events_drop_lists(carom_world *world)
{
	world->events.since = UINT32_MAX / 2;
}

bool carom_events_lists_are_due(const carom_world *world)
{
	return world->events.since >= world->events.steps_a_list;
}

carom_status carom_events_find_neighbours(carom_world *world, carom_error *error)
{
	carom_events *events = &world->events;
	const int32_t count = (int32_t)world->body_count, columns = (int32_t)events->columns, rows = (int32_t)events->rows;
	const int32_t tenths = events->doublings > 0 ? 4 << events->doublings : 1; /* of a radius, that all are taken to get */
	TRY(carom_run(world, STAGE_PACE, 1, 1, count, tenths, error));
	TRY(carom_run(world, STAGE_REACH, count, 1, columns, rows, error));
	TRY(carom_run(world, STAGE_CELLS, 1, CELL_ROWS(rows), columns, rows, error));
	TRY(carom_run(world, STAGE_SORT, count, 1, 0, 0, error));
	carom_swap(world, ROLE_SLOTS);
	carom_swap(world, ROLE_NEED);
	TRY(carom_run(world, STAGE_NEAR, count, 1, columns, rows, error));
	TRY(carom_run(world, STAGE_GATHER, count, 1, 0, 0, error));
	events->since = 0;
	events->list_step = world->def.time_step;
	return CAROM_OK;
}

carom_status carom_events_mend(carom_world *world, carom_error *error)
{
	return carom_run(world, STAGE_MEND, (int32_t)world->body_count / MEND_SHARE + 4, 1, (int32_t)world->events.columns, (int32_t)world->events.rows,
		error);
}

/* Clusters that are in conflict after one round are done again in the next. */
static carom_status run_rounds(carom_world *world, int32_t count, carom_error *error)
{
	const int32_t share = carom_events_share(world);
	TRY(carom_run(world, STAGE_SEEK, world->events.looks_ahead ? (count + SEEK_EACH - 1) / SEEK_EACH : count, 1, world->events.round + 1, count,
		error));
	for (uint32_t i = 0; i < world->events.rounds; i++) {
		const int32_t round = ++world->events.round;
		if (world->events.slices > 1) {
			TRY(carom_run(world, STAGE_RELEASE, share, 1, round, 0, error));
			TRY(carom_run(world, STAGE_PAIR, share, 1, round, 0, error));
		}
		TRY(carom_run(world, STAGE_MUSTER, share, 1, round, 0, error));
		TRY(resolve(world, round, error));
		TRY(carom_run(world, STAGE_CHECK, share, 1, round, 0, error));
	}
	return CAROM_OK;
}

carom_status carom_events_resolve(carom_world *world, carom_error *error)
{
	const int32_t count = (int32_t)world->body_count;
	carom_status status;
	world->events.since++;
	TRY(carom_events_mend(world, error));
	TRY(run_rounds(world, count, error));
	TRY(carom_run(world, STAGE_SETTLE, 1, 1, world->events.round, count, error));
	carom_swap(world, ROLE_CLOCK);
	status = carom_run(world, STAGE_DRIFT, count, 1, carom_events_movers(world), 0, error);
	if (status)
		carom_swap(world, ROLE_CLOCK); /* back: the step is not done */
	return status;
}

static carom_status run(carom_world *world, carom_error *error)
{
	if (carom_events_lists_are_due(world))
		TRY(carom_events_find_neighbours(world, error));
	return carom_events_resolve(world, error);
}

uint64_t carom_events_numbers(uint64_t capacity)
{
	return capacity + (capacity < NUMBERS_SPARE ? capacity : NUMBERS_SPARE);
}

carom_status carom_events_create_list(carom_world *world, carom_role role, bool pair, uint64_t items, carom_error *error)
{
	static const float zero[4] = {0};
	carom_textures_drop(world, role);
	if (items > UINT32_MAX / 2)
		return carom_fail(error, CAROM_LIMIT, "the step events needs a list of %llu items: more than any device has", (unsigned long long)items);
	return carom_textures_create(world, role, pair, carom_row_width((uint32_t)items), carom_row_count((uint32_t)items), zero, error);
}

/* What is known of each number, so many times. */
static carom_status create_numbers(carom_world *world, uint64_t times, carom_error *error)
{
	const uint64_t numbers = times * carom_events_numbers(world->capacity);
	TRY(carom_events_create_list(world, ROLE_WORK, false, WORK_WIDTH * numbers, error));
	return carom_events_create_list(world, ROLE_MEMBERS, false, MEMBER_WIDTH * numbers, error);
}

static carom_status send_status(carom_world *world, const int32_t *status, carom_error *error)
{
	return world->device->kind->upload(world->device, world->textures[ROLE_STATUS].front, 1, status, error);
}

carom_status carom_events_unload(carom_world *world, carom_error *error)
{
	TRY(carom_run(world, STAGE_UNLOAD, (int32_t)world->body_count, 1, 0, 0, error));
	carom_swap(world, ROLE_LINEAR);
	carom_swap(world, ROLE_ROTATIONAL);
	world->newest |= PLACE_TEXTURES;
	return CAROM_OK;
}

/* The next batch loads the slots anew. */
static carom_status leave_slots(carom_world *world, carom_error *error)
{
	if (!(world->newest & PLACE_SLOTS))
		return CAROM_OK;
	TRY(world->step->unload(world, error));
	TRY(carom_textures_send(world, error));
	world->newest &= ~(unsigned)PLACE_SLOTS;
	return CAROM_OK;
}

/* Steps of several slices need room for the state in which one begins. */
static carom_status make_room_to_save(carom_world *world, carom_error *error)
{
	TRY(leave_slots(world, error));
	world->prepared = false;
	TRY(create_numbers(world, 2, error));
	world->prepared = world->events.saves = true;
	return CAROM_OK;
}

carom_status carom_events_begin(carom_world *world, carom_error *error)
{
	int32_t status[STATUS_WIDTH] = {[STATUS_STALE] = 1};
	if (world->events.round > LAST_NUMBER || world->events.iteration > LAST_NUMBER) /* numbers begin anew */
		TRY(leave_slots(world, error));
	if (world->events.slices > 1 && !world->events.saves)
		TRY(make_room_to_save(world, error));
	if (world->events.in_batch)
		carom_events_drop_lists(world);
	world->events.in_batch = true;
	if (world->newest & PLACE_SLOTS)
		return CAROM_OK;
	status[STATUS_ROOM] = (int32_t)world->events.room;
	status[STATUS_NODE_ROOM] = (int32_t)world->events.node_room;
	status[STATUS_EXTRA_ROOM] = (int32_t)extra_of(world->capacity);
	status[STATUS_CAPACITY] = (int32_t)world->capacity;
	status[STATUS_SLICES] = (int32_t)world->events.slices;
	status[STATUS_FOURS_ROOM] = (int32_t)world->events.fours_room;
	world->events.hits_taken = 0;
	status[STATUS_KEPT_ROOM] = (int32_t)world->events.hit_room;
	status[STATUS_NUMBERS] = status[STATUS_ACTIVE] = (int32_t)carom_events_numbers(world->capacity); /* all are to be reset */
	TRY(send_status(world, status, error));
	TRY(carom_outlines_send(world, error));
	TRY(carom_run(world, STAGE_LOAD, (int32_t)world->body_count, 1, 0, 0, error));
	carom_swap(world, ROLE_SLOTS);
	carom_swap(world, ROLE_NEED);
	world->newest |= PLACE_SLOTS;
	world->events.known = (uint32_t)world->body_count;
	carom_events_drop_lists(world);
	world->events.round = world->events.iteration = 0;
	return CAROM_OK;
}

uint32_t carom_events_enough(int32_t wanted)
{
	return (uint32_t)wanted + (uint32_t)wanted / 4;
}

/* Hits that had no room have it now that the others are taken, but for more in one step than that. */
static carom_status grow_hits(carom_world *world, int32_t *status, carom_error *error)
{
	carom_events *events = &world->events;
	if (status[STATUS_KEPT] <= status[STATUS_KEPT_ROOM] || (events->hit_room >= MANY_HITS && status[STATUS_STEPS] > 0))
		return CAROM_OK;
	if (events->hit_room >= HITS_MOST)
		return carom_fail(error, CAROM_LIMIT, "a step has more than %d hits, which are not kept all at once", HITS_MOST);
	events->hit_room = carom_events_enough(status[STATUS_KEPT]) < HITS_MOST / 2 ? 2 * carom_events_enough(status[STATUS_KEPT]) : HITS_MOST;
	TRY(carom_events_create_list(world, ROLE_HITS, false, HITS_WIDTH * (uint64_t)events->hit_room, error));
	status[STATUS_KEPT_ROOM] = (int32_t)events->hit_room;
	return CAROM_OK;
}

/* Lists that were too small grow; the work is done again. */
static carom_status grow(carom_world *world, int32_t *status, carom_error *error)
{
	carom_events *events = &world->events;
	world->prepared = false; /* if that fails, the next call begins with lists of the first size */
	if (status[STATUS_THRONGS] > THRONGS_MOST || status[STATUS_NODES] > NODES_MOST)
		return carom_fail(error, CAROM_LIMIT,
			"more than %d million pairs of the %zu bodies are so near that they might hit: too many lie in one place",
			THRONGS_MOST / 1000 * THRONG / 2000, world->body_count);
	if (status[STATUS_NEIGHBOURS] > status[STATUS_ROOM]) {
		events->room = carom_events_enough(status[STATUS_NEIGHBOURS]);
		TRY(carom_events_create_list(world, ROLE_NEIGHBOURS, false, events->room, error));
		status[STATUS_ROOM] = (int32_t)events->room;
	}
	if (status[STATUS_NODES] > status[STATUS_NODE_ROOM]) {
		events->node_room = carom_events_enough(status[STATUS_NODES]);
		TRY(carom_events_create_list(world, ROLE_NODES, false, NODE_WIDTH * (uint64_t)events->node_room, error));
		status[STATUS_NODE_ROOM] = (int32_t)events->node_room;
	}
	TRY(grow_hits(world, status, error));
	if (world->step->grow)
		TRY(world->step->grow(world, status, error));
	carom_events_drop_lists(world);
	world->prepared = true;
	return CAROM_OK;
}

carom_status carom_events_finish(carom_world *world, carom_error *error)
{
	int32_t status[STATUS_WIDTH];
	TRY(world->device->kind->download(world->device, world->textures[ROLE_STATUS].front, 1, status, error));
	if (status[STATUS_SMALL] || status[STATUS_KEPT] > status[STATUS_KEPT_ROOM])
		TRY(grow(world, status, error));
	else
		TRY(carom_events_adapt(world, status, error));
	if (status[STATUS_STALE])
		carom_events_drop_lists(world);
	world->events.in_batch = world->events.told = false;
	world->events.within = status[STATUS_PASS] > 0 || status[STATUS_UNDER_WAY];
	if (!world->events.within)
		carom_events_adapt_slices(&world->events, status);
	if (!status[STATUS_UNDER_WAY])
		status[STATUS_KEPT] = status[STATUS_KEPT_BEFORE] = (int32_t)(world->events.hits_taken = 0);
	status[STATUS_MOST] = status[STATUS_BUILDS] = status[STATUS_STEPS] = status[STATUS_IDLE] = status[STATUS_AGAIN] = status[STATUS_WAITS] = 0;
	return send_status(world, status, error);
}

carom_status carom_events_take_hits(carom_world *world, carom_error *error)
{
	int32_t status[STATUS_WIDTH];
	const uint32_t first = world->events.hits_taken;
	TRY(world->device->kind->download(world->device, world->textures[ROLE_STATUS].front, 1, status, error));
	world->events.hits_taken = (uint32_t)status[STATUS_KEPT_BEFORE];
	return carom_hits_take(world, first, world->events.hits_taken, error);
}

static uint64_t first_hits(const carom_world_def *def, uint64_t capacity)
{
	return !def->keep_hits ? 0 : capacity > FIRST_HITS ? capacity : FIRST_HITS;
}

/* Twice as many cells of the lowest level as bodies, in rows of a power of two. */
static void choose_cells(carom_events *events, uint32_t capacity)
{
	events->rows = events->columns = 16; /* more than a body looks at in a row */
	while (events->rows * events->columns < 2 * capacity) {
		if (events->columns <= events->rows)
			events->columns *= 2;
		else
			events->rows *= 2;
	}
}

/* Neighbours have the room that they begin with: what more they need depends on how crowded it is. */
uint64_t carom_events_memory(const carom_pipeline *pipeline, const carom_world_def *def, size_t body_count, size_t vertex_count)
{
	const uint64_t n = carom_capacity(body_count), records = 2 * SLOT_WIDTH + 1,
				   lists = 3 + 2 + WAKE_WIDTH + SPAN_WIDTH + FIRST_NEIGHBOURS + NODE_WIDTH / 2;
	carom_events cells = {0};
	(void)pipeline;
	const uint64_t corners = vertex_count > body_count ? 2 * (uint64_t)carom_capacity((vertex_count + body_count) / 2) : 1;
	choose_cells(&cells, (uint32_t)n);
	return 16 * (corners + HITS_WIDTH * first_hits(def, n)) + n * (16 * records + 4 * lists)
		+ carom_events_numbers(n) * (16 * WORK_WIDTH + 4 * (MEMBER_WIDTH + 1))
		+ 4 * (extra_of(n) + movers_of((uint32_t)n) + CELL_WIDTH * (uint64_t)cells.columns * CELL_ROWS(cells.rows) + STATUS_WIDTH);
}

carom_status carom_events_prepare(carom_world *world, carom_error *error)
{
	const uint64_t n = world->capacity;
	carom_events *events = &world->events;
	world->newest &= ~(unsigned)PLACE_SLOTS;
	*events = (carom_events){.room = FIRST_NEIGHBOURS * (uint32_t)n,
		.node_room = (uint32_t)n / 2 + 1,
		.hit_room = (uint32_t)first_hits(&world->def, n),
		.steps_a_list = 6,
		.rounds = EVENTS_ROUNDS,
		.slices = 1};
	choose_cells(events, world->capacity);
	TRY(carom_events_create_list(world, ROLE_OUTLINES, false, world->polygon_capacity ? 2 * (uint64_t)world->polygon_capacity : 1, error));
	TRY(carom_events_create_list(world, ROLE_SLOTS, true, SLOT_WIDTH * n, error));
	TRY(carom_events_create_list(world, ROLE_NEED, true, n, error));
	TRY(carom_events_create_list(world, ROLE_REACH, false, n, error));
	TRY(create_numbers(world, 1, error));
	TRY(carom_events_create_list(world, ROLE_PLACES, false, n, error));
	TRY(carom_events_create_list(world, ROLE_CHANGES, false, 1, error)); /* until there are some */
	TRY(carom_events_create_list(world, ROLE_OWNERS, false, n, error));
	TRY(carom_events_create_list(world, ROLE_PARENTS, false, n, error));
	TRY(carom_events_create_list(world, ROLE_ACTIVE, false, carom_events_numbers(n), error));
	TRY(carom_events_create_list(world, ROLE_SPANS, false, SPAN_WIDTH * n, error));
	TRY(carom_events_create_list(world, ROLE_NEIGHBOURS, false, events->room, error));
	TRY(carom_events_create_list(world, ROLE_NODES, false, NODE_WIDTH * (uint64_t)events->node_room, error));
	TRY(carom_events_create_list(world, ROLE_EXTRA, false, extra_of(n), error));
	TRY(carom_events_create_list(world, ROLE_MOVERS, false, movers_of(world->capacity), error));
	TRY(carom_events_create_list(world, ROLE_WAKE, false, WAKE_WIDTH * n, error));
	TRY(carom_events_create_list(world, ROLE_CELLS, false, CELL_WIDTH * (uint64_t)events->columns * CELL_ROWS(events->rows), error));
	TRY(carom_events_create_list(world, ROLE_HITS, false, events->hit_room ? HITS_WIDTH * (uint64_t)events->hit_room : 1, error));
	TRY(carom_events_create_list(world, ROLE_TOUCHING, false, 1, error)); /* those of contacts are in their place */
	TRY(carom_events_create_list(world, ROLE_CONTACTS, false, 1, error));
	TRY(carom_events_create_list(world, ROLE_SHOCKS, false, 1, error));
	return carom_events_create_list(world, ROLE_STATUS, false, STATUS_WIDTH, error);
}

const carom_step carom_step_events = {"events", false, carom_events_prepare, run, carom_events_begin, carom_events_finish, carom_events_unload,
	carom_events_take_hits, false, carom_events_memory, NULL, NULL};
