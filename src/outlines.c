/* The vertices of polygons. Equal polygons share them: that is less memory, and near at hand when bodies meet. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "world.h"

static size_t used_vertices(const carom_world *world)
{
	return world->vertices.used / sizeof(carom_vec2);
}

static uint32_t even(uint32_t count)
{
	return count + count % 2;
}

bool carom_outlines_have_room(const carom_world *world, uint32_t count)
{
	return used_vertices(world) + even(count) <= CAROM_MOST_VERTICES;
}

/* Where one of the latest polygons with these vertices would be noted: FNV-1a. */
static carom_note *note_of(carom_world *world, const carom_vec2 *vertices, uint32_t count)
{
	const unsigned char *bytes = (const unsigned char *)vertices;
	uint32_t hash = 2166136261u;
	for (size_t i = 0; i < count * sizeof *vertices; i++)
		hash = (hash ^ bytes[i]) * 16777619u;
	return &world->notes[(hash ^ hash >> 16) % CAROM_NOTES];
}

bool carom_outlines_add(carom_world *world, carom_body *body, const carom_vec2 *vertices)
{
	carom_note *note = note_of(world, vertices, body->vertex_count);
	const size_t size = body->vertex_count * sizeof *vertices;
	carom_vec2 *corner = world->vertices.items;
	body->vertex_first = note->first;
	if (note->count == body->vertex_count && !memcmp(corner + note->first, vertices, size))
		return true;
	body->vertex_first = (uint32_t)used_vertices(world);
	corner = carom_array_grow(&world->vertices, even(body->vertex_count) * sizeof *corner);
	if (!corner)
		return false;
	corner[even(body->vertex_count) - 1] = (carom_vec2){0.0f, 0.0f};
	memcpy(corner, vertices, size);
	*note = (carom_note){body->vertex_first, body->vertex_count};
	return true;
}

/* From a vertex, its record: the normal as the kernels of the other step find it. */
static void fill_corner(float *corner, carom_vec2 from, carom_vec2 to)
{
	const float x = to.x - from.x, y = to.y - from.y, size = sqrtf(x * x + y * y);
	corner[OUTLINE_X] = from.x;
	corner[OUTLINE_Y] = from.y;
	corner[OUTLINE_NORMAL_X] = y / size;
	corner[OUTLINE_NORMAL_Y] = -x / size;
}

carom_status carom_outlines_send(carom_world *world, carom_error *error)
{
	const carom_vec2 *vertices = world->vertices.items;
	uint32_t items = 2 * world->polygon_capacity;
	float(*corners)[4];
	carom_status status;
	if (!items)
		return CAROM_OK;
	corners = calloc(items, sizeof *corners);
	if (!corners)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to upload the outlines of %zu bodies", world->body_count);
	for (size_t i = 0; i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		const carom_vec2 *own = vertices + body->vertex_first;
		const float *first = corners[body->vertex_first];
		if (body->vertex_count == 1 || first[OUTLINE_NORMAL_X] != 0.0f || first[OUTLINE_NORMAL_Y] != 0.0f)
			continue; /* a circle, or one that shares what has been filled in */
		for (uint32_t k = 0; k < body->vertex_count; k++)
			fill_corner(corners[body->vertex_first + k], own[k], own[(k + 1) % body->vertex_count]);
	}
	world->events.outlines = world->vertices.used;
	status = world->device->kind->upload(world->device, world->textures[ROLE_OUTLINES].front, carom_row_count(items), corners, error);
	free(corners);
	return status;
}
