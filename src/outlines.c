/* The vertices of polygons, and of what they consist that are not convex. Equal polygons share them: that is less memory, and near at hand when bodies meet. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "pieces.h"
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

/* More than it has. */
static uint32_t most_vertices(const carom_body *body)
{
	return 2 * even(body->vertex_count) + (body->is_convex ? 0 : 5u * body->vertex_count);
}

bool carom_outlines_have_room(const carom_world *world, const carom_body *body)
{
	return used_vertices(world) + most_vertices(body) <= CAROM_MOST_VERTICES;
}

uint32_t carom_outline_hull(const carom_body *body)
{
	return body->vertex_first + (body->hull_count == body->vertex_count ? 0 : even(body->vertex_count));
}

/* Of each piece there is something to be told first. */
static uint32_t table_of(const carom_body *body)
{
	return carom_outline_hull(body) + even(body->hull_count);
}

/* Where the pieces' vertices are. */
static uint32_t pieces_of(const carom_body *body)
{
	return table_of(body) + body->piece_count;
}

uint32_t carom_outline_size(const carom_body *body)
{
	return body->vertex_count == 1 ? 0 : even(pieces_of(body) + body->piece_vertices - body->vertex_first);
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

/* Of the pieces how many vertices each has, and then these. */
static void put_pieces(const carom_pieces *pieces, uint32_t vertices, carom_vec2 *table)
{
	for (uint32_t k = 0; k < pieces->count; k++)
		table[k] = (carom_vec2){(float)pieces->sizes[k], 0.0f};
	memcpy(table + pieces->count, pieces->vertices, vertices * sizeof *table);
}

void carom_outline_pieces(const carom_world *world, const carom_body *body, carom_pieces *pieces)
{
	const carom_vec2 *vertices = world->vertices.items, *table = vertices + table_of(body);
	pieces->count = body->piece_count;
	pieces->hull_count = body->hull_count;
	memcpy(pieces->hull, vertices + carom_outline_hull(body), body->hull_count * sizeof *vertices);
	for (uint32_t k = 0; k < pieces->count; k++)
		pieces->sizes[k] = (uint8_t)table[k].x;
	memcpy(pieces->vertices, vertices + pieces_of(body), body->piece_vertices * sizeof *vertices);
}

static void make_pieces(const carom_body *body, const carom_vec2 *vertices, carom_pieces *pieces)
{
	if (!body->is_convex) {
		carom_pieces_make(vertices, body->vertex_count, pieces);
		return;
	}
	pieces->count = 0;
	pieces->hull_count = carom_corners_find(vertices, body->vertex_count, pieces->hull);
}

static bool add_anew(carom_world *world, carom_body *body, const carom_vec2 *vertices)
{
	carom_pieces pieces;
	make_pieces(body, vertices, &pieces);
	body->vertex_first = (uint32_t)used_vertices(world);
	body->piece_count = (uint8_t)pieces.count;
	body->hull_count = (uint8_t)pieces.hull_count;
	body->piece_vertices = 0;
	for (uint32_t k = 0; k < pieces.count; k++)
		body->piece_vertices = (uint16_t)(body->piece_vertices + pieces.sizes[k]);
	const uint32_t size = carom_outline_size(body);
	carom_vec2 *to = carom_array_grow(&world->vertices, size * sizeof *to);
	if (!to)
		return false;
	memset(to, 0, size * sizeof *to);
	memcpy(to + (carom_outline_hull(body) - body->vertex_first), pieces.hull, pieces.hull_count * sizeof *to);
	memcpy(to, vertices, body->vertex_count * sizeof *to);
	put_pieces(&pieces, body->piece_vertices, to + (table_of(body) - body->vertex_first));
	return true;
}

bool carom_outlines_add(carom_world *world, carom_body *body, const carom_vec2 *vertices)
{
	carom_note *note = note_of(world, vertices, body->vertex_count);
	const carom_vec2 *kept = world->vertices.items; /* NULL where there is none */
	if (note->count == body->vertex_count && !memcmp(kept + note->first, vertices, body->vertex_count * sizeof *vertices)) {
		body->vertex_first = note->first;
		body->piece_count = note->piece_count;
		body->hull_count = note->hull_count;
		body->piece_vertices = note->piece_vertices;
		return true;
	}
	if (!add_anew(world, body, vertices))
		return false;
	*note = (carom_note){body->vertex_first, body->piece_vertices, body->vertex_count, body->hull_count, body->piece_count};
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

static void fill_corners(float (*corners)[4], const carom_vec2 *vertices, uint32_t count)
{
	for (uint32_t k = 0; k < count; k++)
		fill_corner(corners[k], vertices[k], vertices[(k + 1) % count]);
}

/* What is told of a piece: the middle of its box, and how far it is from there, at most. */
static void fill_piece(float *piece, const carom_vec2 *vertices, uint32_t count)
{
	carom_vec2 low = vertices[0], high = vertices[0];
	double radius = 0;
	for (uint32_t k = 1; k < count; k++) {
		low = (carom_vec2){fminf(low.x, vertices[k].x), fminf(low.y, vertices[k].y)};
		high = (carom_vec2){fmaxf(high.x, vertices[k].x), fmaxf(high.y, vertices[k].y)};
	}
	piece[PIECE_COUNT] = (float)count;
	piece[PIECE_X] = 0.5f * (low.x + high.x);
	piece[PIECE_Y] = 0.5f * (low.y + high.y);
	for (uint32_t k = 0; k < count; k++)
		radius = fmax(radius, hypot((double)vertices[k].x - (double)piece[PIECE_X], (double)vertices[k].y - (double)piece[PIECE_Y]));
	piece[PIECE_RADIUS] = nextafterf((float)radius, INFINITY);
}

/* The hull, then the pieces' records, then the pieces. */
static void fill_outline(const carom_world *world, const carom_body *body, float (*corners)[4])
{
	const carom_vec2 *vertices = world->vertices.items;
	const uint32_t hull = carom_outline_hull(body), table = table_of(body);
	uint32_t first = pieces_of(body);
	fill_corners(corners + hull, vertices + hull, body->hull_count);
	for (uint32_t k = 0; k < body->piece_count; k++) {
		const uint32_t count = (uint32_t)vertices[table + k].x;
		fill_piece(corners[table + k], vertices + first, count);
		fill_corners(corners + first, vertices + first, count);
		first += count;
	}
}

carom_status carom_outlines_send(carom_world *world, carom_error *error)
{
	const uint32_t items = 2 * world->polygon_capacity;
	float(*corners)[4];
	carom_status status;
	if (!items)
		return CAROM_OK;
	corners = calloc(items, sizeof *corners);
	if (!corners)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to upload the outlines of %zu bodies", world->body_count);
	for (size_t i = 0; i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		const float *first = corners[carom_outline_hull(body)];
		if (body->vertex_count == 1 || first[OUTLINE_NORMAL_X] != 0.0f || first[OUTLINE_NORMAL_Y] != 0.0f)
			continue; /* a circle, or one that shares what has been filled in */
		fill_outline(world, body, corners);
	}
	world->events.outlines = world->vertices.used;
	status = world->device->kind->upload(world->device, world->textures[ROLE_OUTLINES].front, carom_row_count(items), corners, error);
	free(corners);
	return status;
}
