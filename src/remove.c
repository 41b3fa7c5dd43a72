/* Bodies that go: the others are numbered anew. */
#include <stdlib.h>
#include <string.h>

#include "status.h"
#include "step/events.h"
#include "world.h"

#define GONE UINT32_MAX
#define MUCH_WASTE 65536 /* bytes: then it is worth to load the device anew, if it is half of all */

static size_t name_size(const carom_world *world, const carom_body *body)
{
	return body->name ? strlen((const char *)world->names.items + body->name - 1) + 1 : 0;
}

/* The new index of each body, or GONE. */
static carom_status number_anew(const carom_world *world, const uint32_t *indices, size_t count, uint32_t *numbers, carom_error *error)
{
	uint32_t next = 0;
	memset(numbers, 0, world->body_count * sizeof *numbers);
	for (size_t k = 0; k < count; k++) {
		if (indices[k] >= world->body_count)
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "indices[%zu]: found %u, the world has %zu bodies", k, indices[k], world->body_count);
		if (numbers[indices[k]] == GONE)
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "indices[%zu]: body %u is there twice", k, indices[k]);
		numbers[indices[k]] = GONE;
	}
	for (size_t i = 0; i < world->body_count; i++)
		numbers[i] = numbers[i] == GONE ? GONE : next++;
	return CAROM_OK;
}

/* ---- The others ---- */

/* They move up, in place, and so do their states, where the host has them. */
static void close_ranks(carom_world *world, const uint32_t *numbers)
{
	carom_body *bodies = carom_world_bodies(world);
	float *linear = world->linear.items, *rotational = world->rotational.items;
	const bool has_states = world->newest & PLACE_HOST;
	for (size_t i = 0; i < world->body_count; i++) {
		const size_t to = numbers[i];
		if (to == i)
			continue;
		if (numbers[i] == GONE) {
			world->circle_count -= bodies[i].vertex_count == 1;
			world->waste += name_size(world, &bodies[i]) + carom_outline_size(&bodies[i]) * sizeof(carom_vec2);
			continue;
		}
		bodies[to] = bodies[i];
		if (has_states) {
			memcpy(linear + 4 * to, linear + 4 * i, 4 * sizeof *linear);
			memcpy(rotational + 4 * to, rotational + 4 * i, 4 * sizeof *rotational);
		}
	}
}

static void close_contacts(carom_world *world, const uint32_t *numbers)
{
	carom_contact *contacts = world->contacts.items;
	const size_t count = world->contacts.used / sizeof *contacts;
	size_t left = 0;
	for (size_t k = 0; k < count; k++) {
		carom_contact contact = contacts[k];
		if (numbers[contact.body] == GONE || (contact.other >= 0 && numbers[contact.other] == GONE))
			continue;
		contact.body = numbers[contact.body];
		contact.other = contact.other < 0 ? contact.other : (int32_t)numbers[contact.other];
		contacts[left++] = contact;
	}
	world->contacts.used = left * sizeof *contacts;
	world->contacts_sent = false;
}

static void let_go(carom_world *world, const uint32_t *numbers, size_t count)
{
	close_ranks(world, numbers);
	close_contacts(world, numbers);
	carom_joints_close(world, numbers, GONE);
	world->body_count -= count;
	world->bodies.used = world->body_count * sizeof(carom_body);
	world->linear.used = world->rotational.used = world->body_count * 4 * sizeof(float);
	world->hits.used = 0; /* which were of other indices */
	world->canvas.body_count = SIZE_MAX;
}

/* ---- What the others do not need ---- */

/* Keeps a polygon's vertices. `moved`: of each texel of Vertices from which on an outline has been kept, where to, or GONE: what shared them goes on to. */
static bool keep_outline(carom_world *to, const carom_world *from, carom_body body, uint32_t *moved)
{
	uint32_t *first = &moved[body.vertex_first / 2];
	if (*first == GONE && !carom_outlines_add(to, &body, (const carom_vec2 *)from->vertices.items + body.vertex_first))
		return false;
	if (*first == GONE)
		*first = body.vertex_first;
	return true;
}

static bool keep_name(carom_world *to, const carom_world *from, const carom_body *body)
{
	const size_t size = name_size(from, body);
	char *copy = carom_array_grow(&to->names, size);
	if (size > 0 && copy)
		memcpy(copy, (const char *)from->names.items + body->name - 1, size);
	return size == 0 || copy;
}

static void swap_arrays(carom_array *a, carom_array *b)
{
	const carom_array kept = *a;
	*a = *b;
	*b = kept;
}

/* The bodies are to be found there, where they were kept in order. */
static void take_kept(carom_world *world, carom_world *kept, const uint32_t *moved)
{
	size_t name = 1;
	for (size_t i = 0; i < world->body_count; i++) {
		carom_body *body = &carom_world_bodies(world)[i];
		const size_t size = name_size(world, body);
		body->vertex_first = body->vertex_count == 1 ? 0 : moved[body->vertex_first / 2];
		body->name = size ? (uint32_t)name : 0;
		name += size;
	}
	swap_arrays(&world->vertices, &kept->vertices);
	swap_arrays(&world->names, &kept->names);
	memcpy(world->notes, kept->notes, sizeof world->notes);
	world->waste = 0;
}

/* Vertices and names of bodies that are gone, of a world that is loaded anew. Where there is no memory they stay. */
static void drop_waste(carom_world *world)
{
	carom_world *kept = calloc(1, sizeof *kept); /* of which there are no more than vertices and names */
	const size_t outlines = carom_polygon_texels(world) + 1;
	uint32_t *moved = malloc(outlines * sizeof *moved);
	bool fits = kept && moved;
	if (moved)
		memset(moved, 0xFF, outlines * sizeof *moved);
	for (size_t i = 0; fits && i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		fits = (body->vertex_count == 1 || keep_outline(kept, world, *body, moved)) && keep_name(kept, world, body);
	}
	if (fits)
		take_kept(world, kept, moved);
	free(moved);
	if (kept) {
		free(kept->vertices.items);
		free(kept->names.items);
		free(kept);
	}
}

/* ---- The device ---- */

/* Will there be bodies left with all that some have? */
static bool traits_stay(const carom_world *world, const uint32_t *numbers)
{
	unsigned traits = 0;
	for (size_t i = 0; i < world->body_count && traits != world->traits; i++)
		traits |= numbers[i] != GONE ? carom_traits_of(&carom_world_bodies(world)[i]) : 0;
	return traits == world->traits;
}

static size_t circles_left(const carom_world *world, const uint32_t *indices, size_t count)
{
	size_t left = world->circle_count;
	for (size_t k = 0; k < count; k++)
		left -= carom_world_bodies(world)[indices[k]].vertex_count == 1;
	return left;
}

/* Does the device go on without them? */
static bool may_leave(const carom_world *world, const uint32_t *indices, const uint32_t *numbers, size_t count)
{
	const bool is_wasteful = world->waste > MUCH_WASTE && world->waste > (world->vertices.used + world->names.used) / 2;
	return carom_goes_on(world) && !is_wasteful && traits_stay(world, numbers) && carom_are_few(count, world->body_count)
		&& count <= (size_t)carom_events_movers(world) && carom_textures_fit(world, world->body_count - count, circles_left(world, indices, count));
}

static carom_status leave(carom_world *world, const uint32_t *numbers, size_t count, carom_error *error)
{
	uint32_t *sorted = malloc(count * sizeof *sorted), k = 0;
	if (!sorted)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to remove %zu bodies", count);
	for (uint32_t i = 0; i < world->body_count; i++)
		if (numbers[i] == GONE)
			sorted[k++] = i;
	carom_status status = carom_changes_send(world, error); /* which go by the old numbers */
	if (!status)
		status = carom_contacts_fetch(world, error);
	if (!status)
		status = carom_removed_send(world, sorted, k, error);
	free(sorted);
	if (status)
		return status;
	let_go(world, numbers, count);
	carom_roster_changed(world, world->body_count);
	return CAROM_OK;
}

static carom_status leave_anew(carom_world *world, const uint32_t *numbers, size_t count, carom_error *error)
{
	TRY(carom_textures_fetch(world, error));
	TRY(carom_changes_send(world, error));
	TRY(carom_contacts_fetch(world, error));
	let_go(world, numbers, count);
	drop_waste(world);
	carom_look_for_traits(world, 0);
	world->newest = PLACE_HOST;
	carom_load_anew(world);
	return CAROM_OK;
}

carom_status carom_world_remove(carom_world *world, const uint32_t *indices, size_t count, carom_error *error)
{
	uint32_t *numbers;
	carom_status status;
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	if (count == 0)
		return CAROM_OK;
	GIVEN(indices, error);
	numbers = malloc((world->body_count + 1) * sizeof *numbers);
	if (!numbers)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to remove %zu bodies", count);
	status = number_anew(world, indices, count, numbers, error);
	if (!status)
		status = may_leave(world, indices, numbers, count) ? leave(world, numbers, count, error) : leave_anew(world, numbers, count, error);
	free(numbers);
	return status;
}
