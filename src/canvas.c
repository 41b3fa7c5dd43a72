/* The rendering phase [3], from the textures of the state to a picture on the host: for each layer the vertices are placed
 * and shapes made of them; then the shapes are sorted by tiles of pixels, and the pixels drawn. */
#include "canvas.h"

#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "world.h"

/* Pixels: the sides of what is drawn at once, at most. A whole number of tiles, and images as large are to be had everywhere. */
#define BLOCK 4096

/* Of a pass: indices of its vertices, edges and texels of shapes are floats. */
#define MOST_TEXELS (1ull << 24)
/* What a pass takes: some 400,000 bodies without radius lines. More at once would take memory, and no less time. */
#define PASS_TEXELS (3ull << 19)
/* Room for all marks of a layer, and the smallest block. */
#define LEAST_TEXELS 512u
#define MARK_TEXELS (SHAPES_WIDTH * CAROM_MAX_MARKS)

/* What there are shapes of, but no pixels yet. More than there is room for are drawn in passes, each over those before. */
typedef struct carom_pass {
	uint64_t most; /* texels of a texture */
	uint32_t shapes, edges;
	bool is_first, is_last;
} carom_pass;

/* What a texture of the device can have: a power of two. */
static uint64_t most_texels(const carom_world *world)
{
	const carom_device_info *info = &world->device->info;
	const uint64_t most = info->max_allocation / sizeof(float[4]), in_image = (uint64_t)info->max_image_size * ROW_SIZE;
	uint64_t texels = MOST_TEXELS;
	while (texels > LEAST_TEXELS && (texels > most || (info->uses_images && texels > in_image)))
		texels /= 2;
	return texels;
}

/* ---- Shapes */

static bool has_room(uint64_t most, uint64_t shapes, uint64_t edges)
{
	return SHAPES_WIDTH * shapes <= most && edges <= most;
}

/* Room for the shapes of all layers, if one pass can draw them `at_once`, else for those of any pass. */
static carom_status hold_shapes(carom_world *world, const carom_picture *picture, uint64_t most, bool *at_once, carom_error *error)
{
	const carom_canvas *canvas = &world->canvas;
	const uint64_t lines = canvas->has_lines ? canvas->all_circles : 0;
	uint64_t shapes = 0, edges = 0;
	for (size_t i = 0; i < picture->layer_count; i++) {
		const uint64_t marks = (uint64_t)picture->layers[i].mark_count + picture->layers[i].rod_count;
		shapes += marks + canvas->body_count + lines;
		edges += LINE_REST * (marks + lines) + canvas->all_sides;
	}
	*at_once = has_room(most, shapes, edges);
	TRY(carom_canvas_hold(world, ROLE_BOXES, *at_once ? shapes : most / SHAPES_WIDTH, error));
	TRY(carom_canvas_hold(world, ROLE_SHAPES, *at_once ? SHAPES_WIDTH * shapes : most, error));
	return carom_canvas_hold(world, ROLE_EDGES, *at_once ? edges : most, error);
}

/* Places the vertices of what has been sent of a layer and makes its shapes, behind those that there are. */
static carom_status make_shapes(carom_world *world, const carom_picture *picture, const carom_layer *layer, uint32_t marks, carom_pass *pass,
	carom_error *error)
{
	const carom_canvas *canvas = &world->canvas;
	const int32_t items = (int32_t)(marks + canvas->bodies);
	TRY(carom_canvas_send_view(world, picture, layer, pass->shapes, pass->edges, error));
	TRY(carom_canvas_send_marks(world, layer, error));
	if (canvas->vertices)
		TRY(carom_run(world, STAGE_VERTICES, (int32_t)canvas->vertices, 1, 0, 0, error));
	if (items)
		TRY(carom_run(world, STAGE_SHAPES, items, 1, (int32_t)marks, 0, error));
	pass->shapes += marks + canvas->shapes;
	pass->edges += LINE_REST * marks + canvas->edges;
	return CAROM_OK;
}

/* ---- Pixels */

/* On a device that draws into the host's memory it is there, and until it is taken. */
static carom_status hold_picture(carom_world *world, uint32_t width, uint32_t height, uint8_t *pixels, carom_error *error)
{
	static const float zero[4] = {0};
	carom_canvas *canvas = &world->canvas;
	if (world->device->kind->wrap)
		return carom_textures_wrap(world, ROLE_PICTURE, width, height, pixels, error);
	if (canvas->width == width && canvas->height == height)
		return CAROM_OK;
	carom_textures_drop(world, ROLE_PICTURE);
	canvas->width = canvas->height = 0;
	TRY(carom_textures_create(world, ROLE_PICTURE, false, width, height, zero, error));
	canvas->width = width;
	canvas->height = height;
	return CAROM_OK;
}

static carom_status take_picture(carom_world *world, uint32_t height, uint8_t *pixels, carom_error *error)
{
	const carom_device_class *kind = world->device->kind;
	if (!kind->wrap)
		return kind->download(world->device, world->textures[ROLE_PICTURE].front, height, pixels, error);
	carom_textures_drop(world, ROLE_PICTURE);
	return CAROM_OK;
}

/* Sorts the shapes by tiles. */
static carom_status sort_shapes(carom_world *world, uint32_t shapes, int32_t rows, carom_error *error)
{
	const uint32_t *room = world->canvas.room;
	const int32_t chunks = carom_parts_of(shapes, BIN_CHUNK), row_room = (int32_t)(room[ROLE_ROW_LIST] / 2),
				  tile_room = (int32_t)room[ROLE_TILE_LIST];
	if (chunks)
		TRY(carom_run(world, STAGE_BIN_COUNT, chunks, 1, (int32_t)shapes, 0, error));
	TRY(carom_run(world, STAGE_BIN_SUM, rows, 1, chunks, 0, error));
	if (chunks)
		TRY(carom_run(world, STAGE_BIN_ROWS, chunks, 1, (int32_t)shapes, row_room, error));
	return carom_run(world, STAGE_BIN_TILES, rows, 1, row_room, tile_room, error);
}

/* Makes the lists longer if they were too short: `again` tells. */
static carom_status check_lists(carom_world *world, int32_t rows, bool *again, carom_error *error)
{
	const uint32_t row_room = world->canvas.room[ROLE_ROW_LIST] / 2, tile_room = world->canvas.room[ROLE_TILE_LIST];
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
		status = carom_canvas_hold(world, ROLE_ROW_LIST, 2 * in_rows, error);
	return status ? status : carom_canvas_hold(world, ROLE_TILE_LIST, in_tiles, error);
}

/* Draws the pass's shapes over what there is of a block; sorts them again where a list was too short, for nothing is left out. */
static carom_status draw_pass(carom_world *world, carom_pixels block, uint32_t ground, carom_pass *pass, carom_error *error)
{
	const int32_t columns = carom_parts_of((uint32_t)(block.x1 - block.x0), world->device->kind->tile_width);
	const int32_t rows = carom_parts_of((uint32_t)(block.y1 - block.y0), world->device->kind->tile_height);
	const uint64_t counts = (uint64_t)carom_parts_of(pass->shapes, BIN_CHUNK) * (uint64_t)rows;
	bool again = true;
	TRY(carom_canvas_hold(world, ROLE_BIN_COUNTS, 2 * counts, error));
	TRY(carom_canvas_hold(world, ROLE_BIN_OFFSETS, counts, error));
	TRY(carom_canvas_hold(world, ROLE_BIN_TOTALS, 2 * (uint64_t)rows, error));
	TRY(carom_canvas_hold(world, ROLE_TILE_ENDS, (uint64_t)(columns + 1) * (uint64_t)rows, error));
	TRY(carom_canvas_hold(world, ROLE_ROW_LIST, 4 * (uint64_t)pass->shapes, error));
	TRY(carom_canvas_hold(world, ROLE_TILE_LIST, 3 * (uint64_t)pass->shapes + (uint64_t)columns * (uint64_t)rows, error));
	TRY(carom_canvas_send_frame(world, block, ground, (pass->is_first ? 0u : PASS_OVER) | (pass->is_last ? 0u : PASS_UNDER), error));
	while (again) {
		TRY(sort_shapes(world, pass->shapes, rows, error));
		TRY(check_lists(world, rows, &again, error));
	}
	TRY(carom_run(world, STAGE_PIXELS, columns, rows, (int32_t)world->canvas.room[ROLE_TILE_LIST], 0, error));
	pass->is_first = false;
	pass->shapes = pass->edges = 0;
	return CAROM_OK;
}

/* Marks alone, before the bodies are sent. */
static carom_status draw_marks(carom_world *world, const carom_picture *picture, const carom_layer *layer, carom_pixels block, carom_pass *pass,
	carom_error *error)
{
	carom_canvas *canvas = &world->canvas;
	canvas->end = canvas->bodies = canvas->vertices = canvas->edges = canvas->shapes = 0;
	TRY(carom_canvas_hold(world, ROLE_PLACED, 1, error)); /* kernels have them as arguments, read or not */
	TRY(carom_canvas_hold(world, ROLE_DRAWS, 1, error));
	if (!has_room(pass->most, pass->shapes + layer->mark_count, pass->edges + LINE_REST * layer->mark_count))
		TRY(draw_pass(world, block, picture->ground, pass, error));
	return make_shapes(world, picture, layer, layer->mark_count, pass, error);
}

/* The layer's marks, and its rods, some at a time. */
static carom_status draw_rods(carom_world *world, const carom_picture *picture, const carom_layer *layer, carom_pixels block, carom_pass *pass,
	carom_error *error)
{
	carom_layer part = *layer;
	TRY(draw_marks(world, picture, &part, block, pass, error));
	for (uint32_t first = 0; first < layer->rod_count; first += part.mark_count) {
		const uint32_t left = layer->rod_count - first;
		part.mark_count = left < CAROM_MAX_MARKS ? left : CAROM_MAX_MARKS;
		memcpy(part.marks, layer->rods + first, part.mark_count * sizeof *part.marks);
		TRY(draw_marks(world, picture, &part, block, pass, error));
	}
	return CAROM_OK;
}

static carom_status draw_layer(carom_world *world, const carom_picture *picture, const carom_layer *layer, carom_pixels block, carom_pass *pass,
	carom_error *error)
{
	uint32_t marks = layer->rod_count > 0 ? 0 : layer->mark_count;
	uint64_t drawn = 0;
	if (layer->rod_count > 0)
		TRY(draw_rods(world, picture, layer, block, pass, error));
	do {
		TRY(carom_canvas_send_bodies(world, drawn, pass->most - MARK_TEXELS, error));
		if (!has_room(pass->most, pass->shapes + marks + world->canvas.shapes, pass->edges + LINE_REST * marks + world->canvas.edges))
			TRY(draw_pass(world, block, picture->ground, pass, error));
		TRY(make_shapes(world, picture, layer, marks, pass, error));
		drawn = world->canvas.end;
		marks = 0; /* those lie below all bodies */
	} while (drawn < 2 * (uint64_t)world->body_count);
	return CAROM_OK;
}

/* Draws a block into a picture of its size. */
static carom_status draw_block(carom_world *world, const carom_picture *picture, carom_pixels block, uint64_t most, uint8_t *pixels,
	carom_error *error)
{
	const uint32_t width = (uint32_t)(block.x1 - block.x0), height = (uint32_t)(block.y1 - block.y0);
	carom_pass pass = {.most = most, .is_first = true};
	TRY(hold_picture(world, width, height, pixels, error));
	for (size_t i = 0; i < picture->layer_count; i++)
		TRY(draw_layer(world, picture, &picture->layers[i], block, &pass, error));
	pass.is_last = true;
	TRY(draw_pass(world, block, picture->ground, &pass, error));
	return take_picture(world, height, pixels, error);
}

/* A block that is not as wide as the picture goes through memory of its own. */
static carom_status draw_part(carom_world *world, const carom_picture *picture, carom_pixels block, uint64_t most, uint8_t *pixels,
	carom_error *error)
{
	const size_t pitch = 4 * (size_t)picture->width, row = 4 * (size_t)(block.x1 - block.x0), rows = (size_t)(block.y1 - block.y0);
	uint8_t *to = pixels + (size_t)block.y0 * pitch + 4 * (size_t)block.x0, *part;
	carom_status status;
	if (row == pitch)
		return draw_block(world, picture, block, most, to, error);
	part = malloc(row * rows);
	if (!part)
		return carom_canvas_no_memory(world, error);
	status = draw_block(world, picture, block, most, part, error);
	for (size_t y = 0; !status && y < rows; y++)
		memcpy(to + y * pitch, part + y * row, row);
	free(part);
	return status;
}

static int32_t lesser(int32_t a, int32_t b)
{
	return a < b ? a : b;
}

carom_status carom_canvas_draw(carom_world *world, const carom_picture *picture, uint8_t *pixels, carom_error *error)
{
	const int32_t width = (int32_t)picture->width, height = (int32_t)picture->height;
	const uint64_t most = most_texels(world), of_pass = most < PASS_TEXELS ? most : PASS_TEXELS;
	int32_t side = BLOCK;
	bool at_once;
	TRY(carom_textures_hold(world, error));
	TRY(carom_canvas_send_transforms(world, error));
	carom_canvas_count(world, picture);
	TRY(hold_shapes(world, picture, of_pass, &at_once, error));
	while (!at_once && (uint64_t)side * (uint64_t)side > most)
		side /= 2;
	TRY(carom_canvas_hold(world, ROLE_LIGHT, at_once ? 1 : (uint64_t)lesser(side, width) * (uint64_t)lesser(side, height), error));
	for (int32_t y = 0; y < height; y += side) {
		for (int32_t x = 0; x < width; x += side) {
			const carom_pixels block = {x, y, lesser(x + side, width), lesser(y + side, height)};
			TRY(draw_part(world, picture, block, of_pass, pixels, error));
		}
	}
	return CAROM_OK;
}
