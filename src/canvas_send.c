/* What the host sends to the device for pictures [3]: once for all what depends on the bodies alone, and for each picture
 * where it is seen from. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "layout.h"
#include "palette.h"
#include "status.h"
#include "world.h"

int32_t carom_parts_of(uint32_t whole, uint32_t part)
{
	return (int32_t)((whole + part - 1) / part);
}

/* Whole rows, and an eighth more than what is asked for at most: of a million bodies the shapes alone take 100 MiB. */
static uint32_t room_for(uint64_t items)
{
	const uint32_t capacity = carom_capacity((size_t)items), part = capacity / 16;
	return part < ROW_SIZE ? capacity : ((uint32_t)items + part - 1) / part * part;
}

carom_status carom_canvas_hold(carom_world *world, carom_role role, uint64_t items, carom_error *error)
{
	static const float zero[4] = {0};
	uint32_t room;
	if (items <= world->canvas.room[role] && world->canvas.room[role])
		return CAROM_OK;
	if (items > 1u << 30)
		return carom_fail(error, CAROM_LIMIT, "the picture needs a texture of %llu texels: draw a smaller one", (unsigned long long)items);
	room = room_for(items);
	carom_textures_drop(world, role);
	world->canvas.room[role] = 0;
	TRY(carom_textures_create(world, role, false, carom_row_width(room), carom_row_count(room), zero, error));
	world->canvas.room[role] = room;
	return CAROM_OK;
}

/* `texels` has room for whole rows. */
static carom_status upload(carom_world *world, carom_role role, uint32_t items, const float *texels, carom_error *error)
{
	return world->device->kind->upload(world->device, world->textures[role].front, carom_row_count(items), texels, error);
}

/* Zeros for whole rows of a role's texture; NULL without the memory. */
static float *texels_for(const carom_world *world, carom_role role)
{
	return calloc(world->canvas.room[role], 4 * sizeof(float));
}

carom_status carom_canvas_no_memory(const carom_world *world, carom_error *error)
{
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to draw %zu bodies", world->body_count);
}

/* ---- What is sent once: how vertices are to be found, and what is made of them [3] */

/* The vertex as the pipeline's option has it sent. */
static void fill_stream(const carom_world *world, uint32_t index, uint32_t first_texel, uint32_t ordinal, float *texel)
{
	const carom_body *body = &carom_world_bodies(world)[index];
	const carom_vec2 *vertices = world->vertices.items;
	const bool by_body = !strcmp(world->pipeline.vertices, "option1"), by_texel = !strcmp(world->pipeline.vertices, "option2");
	carom_vec2 local = {body->radius, 0};
	if (body->vertex_count > 1)
		local = vertices[body->vertex_first + ordinal];
	texel[STREAM_X] = by_body ? (float)index : by_texel ? (float)first_texel : local.x;
	texel[STREAM_Y] = by_body || by_texel ? (float)ordinal : local.y;
	texel[STREAM_BODY] = (float)index;
}

static void fill_draw(const carom_body *body, uint32_t index, const carom_canvas *next, float *texels)
{
	float *parts = texels + 4 * DRAW_PARTS, *ink = texels + 4 * DRAW_INK;
	uint32_t fill = body->color;
	if (fill == CAROM_COLOR_AUTO)
		fill = body->is_static ? CAROM_COLOR_STATIC : carom_palette_color(index);
	parts[PARTS_VERTEX] = (float)next->vertices;
	parts[PARTS_COUNT] = (float)body->vertex_count;
	parts[PARTS_EDGE] = (float)next->edges;
	parts[PARTS_SHAPE] = (float)next->shapes;
	ink[INK_FILL] = (float)fill;
	ink[INK_OUTLINE] = (float)carom_darker_color(fill);
}

/* Static bodies first: what moves lies over them. `next` counts what there is. */
static void fill_bodies(const carom_world *world, bool is_static, carom_canvas *next, size_t *drawn, float *stream, float *draws)
{
	uint32_t circle = carom_polygon_texels(world);
	for (uint32_t i = 0; i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		const uint32_t texel = body->vertex_count == 1 ? circle++ : body->vertex_first / 2;
		if (body->is_static == is_static) {
			fill_draw(body, i, next, draws + 4 * DRAWS_WIDTH * (*drawn)++);
			for (uint32_t k = 0; k < body->vertex_count; k++)
				fill_stream(world, i, texel, k, stream + 4 * (size_t)next->vertices++);
			next->edges += body->vertex_count == 1 ? 1 + LINE_EDGES : body->vertex_count;
			next->shapes += body->vertex_count == 1 ? 2 : 1;
		}
	}
}

carom_status carom_canvas_send_bodies(carom_world *world, carom_error *error)
{
	carom_canvas next = {.body_count = world->body_count};
	size_t vertices = 0, drawn = 0;
	float *stream = NULL, *draws = NULL;
	carom_status status;
	if (world->canvas.body_count == world->body_count && world->canvas.room[ROLE_DRAWS])
		return CAROM_OK;
	for (size_t i = 0; i < world->body_count; i++)
		vertices += carom_world_bodies(world)[i].vertex_count;
	TRY(carom_canvas_hold(world, ROLE_STREAM, vertices, error));
	TRY(carom_canvas_hold(world, ROLE_PLACED, vertices, error));
	TRY(carom_canvas_hold(world, ROLE_DRAWS, DRAWS_WIDTH * world->body_count, error));
	stream = texels_for(world, ROLE_STREAM);
	draws = texels_for(world, ROLE_DRAWS);
	if (stream && draws) {
		fill_bodies(world, true, &next, &drawn, stream, draws);
		fill_bodies(world, false, &next, &drawn, stream, draws);
		status = upload(world, ROLE_STREAM, (uint32_t)vertices, stream, error);
	} else {
		status = carom_canvas_no_memory(world, error);
	}
	if (!status)
		status = upload(world, ROLE_DRAWS, DRAWS_WIDTH * (uint32_t)drawn, draws, error);
	if (!status) {
		memcpy(next.room, world->canvas.room, sizeof next.room);
		next.width = world->canvas.width;
		next.height = world->canvas.height;
		world->canvas = next;
	}
	free(stream);
	free(draws);
	return status;
}

/* ---- What is sent for each picture */

/* toCPU [3]: the state is read back, whether or not the host had it already, and sent. */
carom_status carom_canvas_send_transforms(carom_world *world, carom_error *error)
{
	const uint32_t count = strcmp(world->pipeline.transforms, "to_cpu") ? 0 : (uint32_t)world->body_count;
	const float *linear, *rotational;
	float *texels;
	carom_status status;
	TRY(carom_canvas_hold(world, ROLE_TRANSFORMS, count, error)); /* kernels have it as an argument, read or not */
	if (!count)
		return CAROM_OK;
	world->host_current = false;
	TRY(carom_textures_fetch(world, error));
	texels = texels_for(world, ROLE_TRANSFORMS);
	if (!texels)
		return carom_canvas_no_memory(world, error);
	linear = world->linear.items;
	rotational = world->rotational.items;
	for (size_t i = 0; i < count; i++) {
		texels[4 * i + TRANSFORMS_X] = linear[4 * i + LINEAR_X];
		texels[4 * i + TRANSFORMS_Y] = linear[4 * i + LINEAR_Y];
		texels[4 * i + TRANSFORMS_ANGLE] = rotational[4 * i + ROTATIONAL_ANGLE];
	}
	status = upload(world, ROLE_TRANSFORMS, count, texels, error);
	free(texels);
	return status;
}

/* Nearest, and finite. */
static float single(double value)
{
	return (float)(value > (double)FLT_MAX ? (double)FLT_MAX : value < -(double)FLT_MAX ? -(double)FLT_MAX : value);
}

static void fill_box(carom_pixels box, float *texel)
{
	texel[BOX_X0] = (float)box.x0;
	texel[BOX_Y0] = (float)box.y0;
	texel[BOX_X1] = (float)box.x1;
	texel[BOX_Y1] = (float)box.y1;
}

carom_status carom_canvas_send_view(carom_world *world, const carom_picture *picture, const carom_layer *layer, uint32_t first_shape,
	uint32_t first_edge, carom_error *error)
{
	float texels[4 * TILE] = {0}, *origin = texels + 4 * VIEW_ORIGIN, *scale = texels + 4 * VIEW_SCALE, *first = texels + 4 * VIEW_FIRST;
	origin[ORIGIN_LEFT] = single(layer->left);
	origin[ORIGIN_LEFT_LOW] = single(layer->left - (double)origin[ORIGIN_LEFT]);
	origin[ORIGIN_TOP] = single(layer->top);
	origin[ORIGIN_TOP_LOW] = single(layer->top - (double)origin[ORIGIN_TOP]);
	scale[SCALE_PIXELS] = single(layer->scale);
	scale[SCALE_LINE] = single(layer->line);
	scale[SCALE_WIDTH] = (float)picture->width;
	scale[SCALE_HEIGHT] = (float)picture->height;
	fill_box(layer->clip, texels + 4 * VIEW_CLIP);
	first[FIRST_SHAPE] = (float)first_shape;
	first[FIRST_EDGE] = (float)first_edge;
	TRY(carom_canvas_hold(world, ROLE_VIEW, VIEW_WIDTH, error));
	return upload(world, ROLE_VIEW, VIEW_WIDTH, texels, error);
}

carom_status carom_canvas_send_marks(carom_world *world, const carom_layer *layer, carom_error *error)
{
	float texels[4 * MARKS_WIDTH * CAROM_MAX_MARKS] = {0};
	for (uint32_t i = 0; i < layer->mark_count; i++) {
		const carom_mark *mark = &layer->marks[i];
		float *place = texels + 4 * (MARKS_WIDTH * i + MARK_PLACE), *style = texels + 4 * (MARKS_WIDTH * i + MARK_STYLE);
		const double ends[4] = {mark->x0, mark->y0, mark->x1, mark->y1};
		for (int k = 0; k < 4; k++)
			place[k] = single(ends[k]);
		style[STYLE_COLOR] = (float)mark->color;
		style[STYLE_BREADTH] = single(mark->breadth);
	}
	TRY(carom_canvas_hold(world, ROLE_MARKS, MARKS_WIDTH * CAROM_MAX_MARKS, error));
	return upload(world, ROLE_MARKS, MARKS_WIDTH * CAROM_MAX_MARKS, texels, error);
}

carom_status carom_canvas_send_frame(carom_world *world, carom_pixels block, uint32_t ground, carom_error *error)
{
	float texels[4 * TILE] = {0}, *tiles = texels + 4 * FRAME_TILES;
	fill_box(block, texels + 4 * FRAME_BOX);
	tiles[TILES_COLUMNS] = (float)carom_parts_of((uint32_t)(block.x1 - block.x0), PIXEL_TILE);
	tiles[TILES_ROWS] = (float)carom_parts_of((uint32_t)(block.y1 - block.y0), PIXEL_TILE);
	tiles[TILES_GROUND] = (float)ground;
	TRY(carom_canvas_hold(world, ROLE_FRAME, FRAME_WIDTH, error));
	return upload(world, ROLE_FRAME, FRAME_WIDTH, texels, error);
}
