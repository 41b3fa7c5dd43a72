/* Bodies that go: the others are numbered anew, and the device is loaded anew. */
#include <stdlib.h>
#include <string.h>

#include "status.h"
#include "world.h"

#define GONE UINT32_MAX

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

/* Keeps its vertices. `moved`: of each texel of Vertices from which on an outline has been kept, where to, or GONE: what shared them goes on to. */
static bool keep_outline(carom_world *to, const carom_world *from, carom_body *body, uint32_t *moved)
{
	uint32_t *first = &moved[body->vertex_first / 2];
	if (*first == GONE && !carom_outlines_add(to, body, (const carom_vec2 *)from->vertices.items + body->vertex_first))
		return false;
	if (*first == GONE)
		*first = body->vertex_first;
	body->vertex_first = *first;
	return true;
}

/* A body that stays, with its outline and its name, in a new world's arrays. False if there is no memory. */
static bool keep_body(carom_world *to, const carom_world *from, size_t index, uint32_t *moved)
{
	carom_body body = carom_world_bodies(from)[index];
	const char *name = body.name ? (const char *)from->names.items + body.name - 1 : NULL;
	carom_body *kept = carom_array_grow(&to->bodies, sizeof *kept);
	if (!kept || (body.vertex_count > 1 && !keep_outline(to, from, &body, moved)))
		return false;
	if (name) {
		const size_t size = strlen(name) + 1;
		char *copy = carom_array_grow(&to->names, size);
		if (!copy)
			return false;
		memcpy(copy, name, size);
		body.name = to->names.used - size + 1;
	}
	*kept = body;
	return true;
}

/* The others' states move up, in place. */
static void close_ranks(carom_world *world, const uint32_t *numbers)
{
	float *linear = world->linear.items, *rotational = world->rotational.items;
	carom_contact *contacts = world->contacts.items;
	const size_t count = world->contacts.used / sizeof *contacts;
	size_t left = 0;
	for (size_t i = 0; i < world->body_count; i++) {
		if (numbers[i] == GONE)
			continue;
		memmove(linear + 4 * (size_t)numbers[i], linear + 4 * i, 4 * sizeof *linear);
		memmove(rotational + 4 * (size_t)numbers[i], rotational + 4 * i, 4 * sizeof *rotational);
	}
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

static void swap_arrays(carom_array *a, carom_array *b)
{
	const carom_array kept = *a;
	*a = *b;
	*b = kept;
}

static carom_status remove_bodies(carom_world *world, const uint32_t *numbers, size_t count, carom_error *error)
{
	carom_world *kept = calloc(1, sizeof *kept); /* of which there is no more than what the host knows of bodies */
	const size_t outlines = carom_polygon_texels(world) + 1;
	uint32_t *moved = malloc(outlines * sizeof *moved);
	bool fits = kept && moved;
	if (moved)
		memset(moved, 0xFF, outlines * sizeof *moved);
	for (size_t i = 0; fits && i < world->body_count; i++)
		fits = numbers[i] == GONE || keep_body(kept, world, i, moved);
	free(moved);
	if (fits) {
		close_ranks(world, numbers);
		swap_arrays(&world->bodies, &kept->bodies);
		swap_arrays(&world->vertices, &kept->vertices);
		swap_arrays(&world->names, &kept->names);
		memcpy(world->notes, kept->notes, sizeof world->notes);
		world->body_count -= count;
		world->linear.used = world->rotational.used = world->body_count * 4 * sizeof(float);
	}
	if (kept) {
		free(kept->bodies.items);
		free(kept->vertices.items);
		free(kept->names.items);
		free(kept);
	}
	return fits ? CAROM_OK : carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to remove %zu bodies", count);
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
	TRY(carom_textures_fetch(world, error));
	TRY(carom_changes_send(world, error)); /* which go by the old numbers */
	TRY(carom_contacts_fetch(world, error));
	numbers = malloc((world->body_count + 1) * sizeof *numbers);
	if (!numbers)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to remove %zu bodies", count);
	status = number_anew(world, indices, count, numbers, error);
	if (!status)
		status = remove_bodies(world, numbers, count, error);
	free(numbers);
	if (status)
		return status;
	carom_look_for_friction(world, 0);
	world->hits.used = 0; /* which were of other indices */
	world->canvas.body_count = SIZE_MAX;
	world->bodies_current = false;
	world->newest = PLACE_HOST;
	return CAROM_OK;
}
