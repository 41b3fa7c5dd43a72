/* What the device is told between two steps, where it goes on with its slots and its lists as they are: bodies that are changed, come or go, and what holds for
 * all of them. */
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "step/events.h"

#define FEW_PART 4        /* of all bodies */
#define FIRST_RECORDS 256 /* that Changes has room for */
#define LIST_STEPS 1.25f  /* of those that lists were made for, so long may a step be: what leaves its box then gets one for 1.5 of them */

bool carom_goes_on(const carom_world *world)
{
	return world->newest & PLACE_SLOTS && !world->events.within && world->prepared && world->slots_current;
}

void carom_tell_later(carom_world *world, carom_unsent what)
{
	if (carom_goes_on(world))
		world->unsent |= (unsigned)what;
	else
		carom_load_anew(world);
}

bool carom_are_few(size_t count, size_t of)
{
	return count <= of / FEW_PART;
}

static carom_status make_room(carom_world *world, uint32_t count, carom_error *error)
{
	uint32_t room = FIRST_RECORDS;
	if (count <= world->events.change_room)
		return CAROM_OK;
	while (room < count)
		room *= 2;
	world->events.change_room = 0;
	TRY(carom_events_create_list(world, ROLE_CHANGES, false, room, error));
	world->events.change_room = room;
	return CAROM_OK;
}

carom_status carom_records_create(carom_world *world, uint32_t count, float **records, carom_error *error)
{
	TRY(make_room(world, count, error));
	*records = calloc((size_t)carom_row_count(count) * carom_row_width(world->events.change_room), 4 * sizeof **records);
	return *records ? CAROM_OK : carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for %u records of bodies", count);
}

carom_status carom_records_send(carom_world *world, uint32_t count, float *records, carom_error *error)
{
	const carom_status status = world->device->kind->upload(world->device, world->textures[ROLE_CHANGES].front, carom_row_count(count), records,
		error);
	free(records);
	return status;
}

/* Of bodies that will be elsewhere. */
static carom_status send(carom_world *world, uint32_t count, float *records, carom_error *error)
{
	world->events.told = true;
	return carom_records_send(world, count, records, error);
}

/* ---- What holds for all ---- */

/* Is there one that is not filtered as the first of all bodies is? If all are, those that come pass through others only where some did before. */
static bool are_filtered(const carom_world *world, size_t first)
{
	const carom_body *bodies = carom_world_bodies(world);
	bool is_other = world->filter_room > FILTERS_FIRST;
	for (size_t i = first; i < world->body_count && !is_other; i++)
		is_other = bodies[i].categories != bodies->categories || bodies[i].mask != bodies->mask;
	return is_other;
}

void carom_roster_changed(carom_world *world, size_t first)
{
	if (world->traits || are_filtered(world, first))
		world->unsent |= UNSENT_INDICES;
	world->bodies_current = false;
	world->newest &= ~(unsigned)PLACE_TEXTURES;
}

/* Steps in which bodies sleep: so many of Changes are changed; 0: all are to wake. */
static carom_status wake(carom_world *world, uint32_t changes, carom_error *error)
{
	return world->step->wake ? world->step->wake(world, changes, error) : CAROM_OK;
}

static carom_status tell_indices(carom_world *world, carom_error *error)
{
	if (!(world->unsent & UNSENT_INDICES))
		return CAROM_OK;
	TRY(carom_friction_send(world, error));
	TRY(carom_filters_send(world, error));
	world->unsent &= ~(unsigned)UNSENT_INDICES;
	return CAROM_OK;
}

/* Lists are of those that may hit each other. */
static carom_status tell_filters(carom_world *world, carom_error *error)
{
	if (!(world->unsent & UNSENT_FILTERS))
		return CAROM_OK;
	TRY(wake(world, 0, error));
	TRY(carom_filters_send(world, error));
	carom_events_drop_lists(world);
	world->unsent &= ~(unsigned)UNSENT_FILTERS;
	return CAROM_OK;
}

/* Lists made for much shorter steps may not reach as far as a step. */
static carom_status tell_def(carom_world *world, carom_error *error)
{
	if (!(world->unsent & UNSENT_DEF))
		return CAROM_OK;
	TRY(wake(world, 0, error));
	if (world->def.time_step > LIST_STEPS * world->events.list_step)
		carom_events_drop_lists(world);
	TRY(world->bodies_current ? carom_uniforms_send(world, error)
							  : carom_textures_send(world, error)); /* what pushes each body is told by its index */
	TRY(carom_run(world, STAGE_PUSH, (int32_t)world->events.known, 1, carom_events_movers(world), 0, error));
	world->unsent &= ~(unsigned)UNSENT_DEF;
	return CAROM_OK;
}

/* ---- Bodies that are changed ---- */

static void fill_changes(const carom_world *world, float *texels)
{
	const carom_change *changes = world->changes.items;
	for (size_t k = 0; k < carom_change_count(world); k++, texels += 4 * CHANGES_WIDTH) {
		float *turn = texels + 4 * CHANGES_TURN;
		memcpy(texels + 4 * CHANGES_PLACE, changes[k].linear, sizeof changes[k].linear);
		turn[CHANGE_ANGLE] = changes[k].rotational[ROTATIONAL_ANGLE];
		turn[CHANGE_VELOCITY] = changes[k].rotational[ROTATIONAL_VELOCITY];
		turn[CHANGE_BODY] = (float)changes[k].body;
		turn[CHANGE_MOVES] = changes[k].moves ? 1.0f : 0.0f;
		carom_forces_fill(&carom_world_bodies(world)[changes[k].body], texels + 4 * CHANGES_FORCES);
	}
}

static carom_status tell_changes(carom_world *world, carom_error *error)
{
	const uint32_t count = (uint32_t)carom_change_count(world);
	float *texels;
	if (count == 0)
		return CAROM_OK;
	TRY(carom_records_create(world, CHANGES_WIDTH * count, &texels, error));
	fill_changes(world, texels);
	TRY(send(world, CHANGES_WIDTH * count, texels, error));
	TRY(wake(world, count, error));
	TRY(carom_run(world, STAGE_CHANGE, (int32_t)count, 1, carom_events_movers(world), 0, error));
	world->newest &= ~(unsigned)PLACE_TEXTURES;
	return CAROM_OK;
}

/* ---- Bodies that come ---- */

static void fill_added(const carom_world *world, uint32_t first, float *texels)
{
	for (size_t i = first; i < world->body_count; i++, texels += 4 * ADDED_WIDTH) {
		const carom_body *body = &carom_world_bodies(world)[i];
		memcpy(texels + 4 * ADDED_LINEAR, (const float *)world->linear.items + 4 * i, 4 * sizeof *texels);
		memcpy(texels + 4 * ADDED_ROTATIONAL, (const float *)world->rotational.items + 4 * i, 4 * sizeof *texels);
		carom_geometry_fill(body, texels + 4 * ADDED_GEOMETRY);
		carom_forces_fill(body, texels + 4 * ADDED_FORCES);
	}
}

/* Others may come to lie on it where it is. */
static bool has_immovable(const carom_world *world, uint32_t first)
{
	for (size_t i = first; i < world->body_count; i++)
		if (!carom_is_dynamic(&carom_world_bodies(world)[i]))
			return true;
	return false;
}

static carom_status tell_added(carom_world *world, carom_error *error)
{
	const uint32_t first = world->events.known, count = (uint32_t)world->body_count - first;
	float *texels;
	if (count == 0)
		return CAROM_OK;
	if (has_immovable(world, first))
		TRY(wake(world, 0, error));
	if (world->events.outlines < world->vertices.used)
		TRY(carom_outlines_send(world, error));
	TRY(carom_records_create(world, ADDED_WIDTH * count, &texels, error));
	fill_added(world, first, texels);
	TRY(send(world, ADDED_WIDTH * count, texels, error));
	TRY(carom_run(world, STAGE_ADD, (int32_t)count, 1, carom_events_movers(world), (int32_t)first, error));
	world->events.known += count;
	return CAROM_OK;
}

carom_status carom_changes_send(carom_world *world, carom_error *error)
{
	const carom_change *changes = world->changes.items;
	if (world->newest & PLACE_SLOTS) {
		TRY(tell_indices(world, error));
		TRY(tell_filters(world, error));
		TRY(tell_def(world, error));
		TRY(tell_changes(world, error));
		TRY(tell_added(world, error));
	} else if (carom_change_count(world) > 0 || world->unsent) { /* the host has all of it, and the device is to be loaded anew */
		carom_load_anew(world);
		world->unsent = 0;
	}
	for (size_t k = 0; k < carom_change_count(world); k++)
		carom_world_bodies(world)[changes[k].body].change = 0;
	world->changes.used = 0;
	return CAROM_OK;
}

/* ---- Bodies that go ---- */

carom_status carom_removed_send(carom_world *world, const uint32_t *indices, uint32_t count, carom_error *error)
{
	uint32_t slots = world->events.known;
	float *texels;
	TRY(wake(world, 0, error));
	TRY(carom_records_create(world, count, &texels, error));
	for (uint32_t k = 0; k < count; k++) {
		texels[4 * k + REMOVED_BODY] = (float)indices[k];
		texels[4 * k + REMOVED_LAST] = (float)--slots;
	}
	TRY(send(world, count, texels, error));
	TRY(carom_run(world, STAGE_REMOVE, 1, 1, (int32_t)count, carom_events_movers(world), error));
	world->events.known = slots;
	return CAROM_OK;
}
