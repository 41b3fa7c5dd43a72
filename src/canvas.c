/* The rendering phase [3], from the textures of the state to a picture on the host: for each layer the vertices are placed
 * and shapes made of them; then the shapes are sorted by tiles of pixels, and the pixels drawn. */
#include "canvas.h"

#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "world.h"

/* Pixels: the sides of what is drawn at once. A whole number of tiles, and images as large are to be had everywhere. */
#define BLOCK 4096

/* Of all layers: their indices are floats. There are fewer vertices and shapes. */
#define MOST_EDGES (1ul << 24)

/* ---- Shapes */

/* Places the layer's vertices and makes its shapes, behind those that there are. */
static carom_status draw_layer(carom_world *world, const carom_picture *picture, const carom_layer *layer, uint32_t *shapes, uint32_t *edges,
	carom_error *error)
{
	const carom_canvas *canvas = &world->canvas;
	const int32_t marks = (int32_t)layer->mark_count, items = marks + (int32_t)canvas->body_count;
	TRY(carom_canvas_send_view(world, picture, layer, *shapes, *edges, error));
	TRY(carom_canvas_send_marks(world, layer, error));
	if (canvas->vertices)
		TRY(carom_run(world, STAGE_VERTICES, (int32_t)canvas->vertices, 1, 0, 0, error));
	if (items)
		TRY(carom_run(world, STAGE_SHAPES, items, 1, marks, 0, error));
	*shapes += layer->mark_count + canvas->shapes;
	*edges += LINE_EDGES * layer->mark_count + canvas->edges;
	return CAROM_OK;
}

static carom_status draw_layers(carom_world *world, const carom_picture *picture, uint32_t *shapes, carom_error *error)
{
	uint64_t most_shapes = 0, most_edges = 0;
	uint32_t edges = 0;
	*shapes = 0;
	for (size_t i = 0; i < picture->layer_count; i++) {
		most_shapes += picture->layers[i].mark_count + world->canvas.shapes;
		most_edges += LINE_EDGES * picture->layers[i].mark_count + world->canvas.edges;
	}
	if (most_edges > MOST_EDGES)
		return carom_fail(error, CAROM_LIMIT, "a picture of %zu bodies has %llu edges%s: there can be %lu at most", world->body_count,
			(unsigned long long)most_edges, picture->layer_count > 1 ? ", with its inset" : "", MOST_EDGES);
	TRY(carom_canvas_hold(world, ROLE_SHAPES, SHAPES_WIDTH * most_shapes, error));
	TRY(carom_canvas_hold(world, ROLE_EDGES, most_edges, error));
	for (size_t i = 0; i < picture->layer_count; i++)
		TRY(draw_layer(world, picture, &picture->layers[i], shapes, &edges, error));
	return CAROM_OK;
}

/* ---- Pixels */

static carom_status hold_picture(carom_world *world, uint32_t width, uint32_t height, carom_error *error)
{
	static const float zero[4] = {0};
	carom_canvas *canvas = &world->canvas;
	if (canvas->width == width && canvas->height == height)
		return CAROM_OK;
	carom_textures_drop(world, ROLE_PICTURE);
	canvas->width = canvas->height = 0;
	TRY(carom_textures_create(world, ROLE_PICTURE, false, width, height, zero, error));
	canvas->width = width;
	canvas->height = height;
	return CAROM_OK;
}

/* Sorts the shapes by tiles and draws the pixels of a block. */
static carom_status draw_block(carom_world *world, uint32_t shapes, int32_t columns, int32_t rows, carom_error *error)
{
	const uint32_t *room = world->canvas.room;
	const int32_t chunks = carom_parts_of(shapes, BIN_CHUNK), row_room = (int32_t)room[ROLE_ROW_LIST], tile_room = (int32_t)room[ROLE_TILE_LIST];
	if (chunks)
		TRY(carom_run(world, STAGE_BIN_COUNT, chunks, 1, (int32_t)shapes, 0, error));
	TRY(carom_run(world, STAGE_BIN_SUM, rows, 1, chunks, 0, error));
	if (chunks)
		TRY(carom_run(world, STAGE_BIN_ROWS, chunks, 1, (int32_t)shapes, row_room, error));
	TRY(carom_run(world, STAGE_BIN_TILES, rows, 1, row_room, tile_room, error));
	return carom_run(world, STAGE_PIXELS, columns * (PIXEL_TILE / 2), rows, tile_room, 0, error);
}

/* Makes the lists longer if they were too short: `again` tells. */
static carom_status check_lists(carom_world *world, int32_t rows, bool *again, carom_error *error)
{
	const uint32_t row_room = world->canvas.room[ROLE_ROW_LIST], tile_room = world->canvas.room[ROLE_TILE_LIST];
	const uint32_t room = world->canvas.room[ROLE_BIN_TOTALS];
	uint64_t in_rows = 0, in_tiles = 0;
	uint32_t *totals = calloc(room, sizeof *totals);
	carom_status status;
	if (!totals)
		return carom_canvas_no_memory(world, error);
	status = world->device->kind->download(world->device, world->textures[ROLE_BIN_TOTALS].front, carom_row_count(2 * (uint32_t)rows), totals, error);
	for (int32_t r = 0; r < rows; r++) {
		in_rows += totals[2 * r];
		in_tiles += totals[2 * r + 1];
	}
	free(totals);
	*again = in_rows > row_room || in_tiles > tile_room;
	if (!status)
		status = carom_canvas_hold(world, ROLE_ROW_LIST, in_rows, error);
	return status ? status : carom_canvas_hold(world, ROLE_TILE_LIST, in_tiles, error);
}

/* Draws a block into a picture of its size; again where a list was too short, for nothing is left out. */
static carom_status draw_pixels(carom_world *world, carom_pixels block, uint32_t ground, uint32_t shapes, uint8_t *pixels, carom_error *error)
{
	const uint32_t width = (uint32_t)(block.x1 - block.x0), height = (uint32_t)(block.y1 - block.y0);
	const int32_t columns = carom_parts_of(width, PIXEL_TILE), rows = carom_parts_of(height, PIXEL_TILE);
	const uint64_t counts = (uint64_t)carom_parts_of(shapes, BIN_CHUNK) * (uint64_t)rows;
	bool again = true;
	TRY(hold_picture(world, width, height, error));
	TRY(carom_canvas_hold(world, ROLE_BIN_COUNTS, 2 * counts, error));
	TRY(carom_canvas_hold(world, ROLE_BIN_OFFSETS, counts, error));
	TRY(carom_canvas_hold(world, ROLE_BIN_TOTALS, 2 * (uint64_t)rows, error));
	TRY(carom_canvas_hold(world, ROLE_TILE_ENDS, (uint64_t)(columns + 1) * (uint64_t)rows, error));
	TRY(carom_canvas_hold(world, ROLE_ROW_LIST, 2 * (uint64_t)shapes, error));
	TRY(carom_canvas_hold(world, ROLE_TILE_LIST, 3 * (uint64_t)shapes + (uint64_t)columns * (uint64_t)rows, error));
	TRY(carom_canvas_send_frame(world, block, ground, error));
	while (again) {
		TRY(draw_block(world, shapes, columns, rows, error));
		TRY(world->device->kind->download(world->device, world->textures[ROLE_PICTURE].front, height, pixels, error));
		TRY(check_lists(world, rows, &again, error));
	}
	return CAROM_OK;
}

/* A block that is not as wide as the picture goes through memory of its own. */
static carom_status draw_part(carom_world *world, const carom_picture *picture, carom_pixels block, uint32_t shapes, uint8_t *pixels,
	carom_error *error)
{
	const size_t pitch = 4 * (size_t)picture->width, row = 4 * (size_t)(block.x1 - block.x0), rows = (size_t)(block.y1 - block.y0);
	uint8_t *to = pixels + (size_t)block.y0 * pitch + 4 * (size_t)block.x0, *part;
	carom_status status;
	if (row == pitch)
		return draw_pixels(world, block, picture->ground, shapes, to, error);
	part = malloc(row * rows);
	if (!part)
		return carom_canvas_no_memory(world, error);
	status = draw_pixels(world, block, picture->ground, shapes, part, error);
	for (size_t y = 0; !status && y < rows; y++)
		memcpy(to + y * pitch, part + y * row, row);
	free(part);
	return status;
}

carom_status carom_canvas_draw(carom_world *world, const carom_picture *picture, uint8_t *pixels, carom_error *error)
{
	const int32_t width = (int32_t)picture->width, height = (int32_t)picture->height;
	uint32_t shapes = 0;
	TRY(carom_textures_hold(world, error));
	TRY(carom_canvas_send_bodies(world, error));
	TRY(carom_canvas_send_transforms(world, error));
	TRY(draw_layers(world, picture, &shapes, error));
	for (int32_t y = 0; y < height; y += BLOCK) {
		for (int32_t x = 0; x < width; x += BLOCK) {
			const carom_pixels block = {x, y, x + BLOCK < width ? x + BLOCK : width, y + BLOCK < height ? y + BLOCK : height};
			TRY(draw_part(world, picture, block, shapes, pixels, error));
		}
	}
	return CAROM_OK;
}
