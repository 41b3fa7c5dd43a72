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

/* A vertex of the polygon as Geometry counts: from the hull on, which lies behind it where it is another one. */
static float ordinal_of(const carom_body *body, uint32_t vertex)
{
	return (float)vertex - (float)(carom_outline_hull(body) - body->vertex_first);
}

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
	texel[STREAM_Y] = by_body ? ordinal_of(body, ordinal) : by_texel ? (float)ordinal : local.y;
	texel[STREAM_BODY] = (float)index;
}

static void fill_draw(const carom_body *body, uint32_t index, const carom_canvas *next, float *texels)
{
	float *parts = texels + 4 * DRAW_PARTS, *ink = texels + 4 * DRAW_INK;
	uint32_t fill = body->color;
	if (fill == CAROM_COLOR_AUTO)
		fill = body->is_static ? CAROM_COLOR_STATIC : carom_palette_color(index);
	parts[PARTS_VERTEX] = (float)next->vertices;
	parts[PARTS_COUNT] = body->is_convex ? (float)body->vertex_count : -(float)body->vertex_count;
	parts[PARTS_EDGE] = (float)next->edges;
	parts[PARTS_SHAPE] = (float)next->shapes;
	ink[INK_FILL] = (float)fill;
	ink[INK_OUTLINE] = (float)carom_darker_color(fill);
}

/* In Edges, but for those of radius lines. */
static uint32_t sides_of(const carom_body *body)
{
	return body->is_convex ? body->vertex_count - 1u : SIDE_WIDTH * (uint32_t)body->vertex_count;
}

static uint32_t edges_of(const carom_canvas *canvas, const carom_body *body)
{
	return sides_of(body) + (body->vertex_count == 1 && canvas->has_lines ? LINE_REST : 0);
}

static uint32_t shapes_of(const carom_canvas *canvas, const carom_body *body)
{
	return body->vertex_count == 1 && canvas->has_lines ? 2 : 1;
}

static void count_bodies(carom_world *world)
{
	carom_canvas *canvas = &world->canvas;
	canvas->body_count = world->body_count;
	canvas->all_vertices = canvas->all_sides = canvas->all_circles = canvas->end = 0;
	canvas->largest_circle = 0;
	for (size_t i = 0; i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		const bool is_circle = body->vertex_count == 1;
		canvas->all_vertices += body->vertex_count;
		canvas->all_sides += sides_of(body);
		canvas->all_circles += is_circle;
		canvas->largest_circle = is_circle && body->radius > canvas->largest_circle ? body->radius : canvas->largest_circle;
	}
}

void carom_canvas_count(carom_world *world, const carom_picture *picture)
{
	carom_canvas *canvas = &world->canvas;
	double scale = 0;
	bool has_lines;
	if (canvas->body_count != world->body_count)
		count_bodies(world);
	for (size_t i = 0; i < picture->layer_count; i++)
		scale = picture->layers[i].scale > scale ? picture->layers[i].scale : scale;
	has_lines = (double)canvas->largest_circle * scale > 0.99 * (double)SHOW_ANGLE; /* the device rounds */
	if (has_lines != canvas->has_lines)
		canvas->end = 0;
	canvas->has_lines = has_lines;
}

/* Fills in what there is room for, from `next->first` on in the order of drawing: static bodies first, what moves lies over them. */
static void fill_bodies(const carom_world *world, uint64_t most, carom_canvas *next, float *stream, float *draws)
{
	const uint64_t count = world->body_count;
	uint32_t circle = 0;
	for (next->end = 0; next->end < 2 * count; next->end++) {
		const uint32_t i = (uint32_t)(next->end < count ? next->end : next->end - count);
		const carom_body *body = &carom_world_bodies(world)[i];
		circle = i ? circle : carom_polygon_texels(world);
		const uint32_t texel = body->vertex_count == 1 ? circle++ : body->vertex_first / 2;
		if (next->end < next->first || body->is_static != (next->end < count))
			continue;
		if (next->edges + edges_of(next, body) > most || SHAPES_WIDTH * (next->shapes + shapes_of(next, body)) > most)
			break;
		fill_draw(body, i, next, draws + 4 * DRAWS_WIDTH * (size_t)next->bodies++);
		for (uint32_t k = 0; k < body->vertex_count; k++)
			fill_stream(world, i, texel, k, stream + 4 * (size_t)next->vertices++);
		next->edges += edges_of(next, body);
		next->shapes += shapes_of(next, body);
	}
}

static uint64_t lesser(uint64_t a, uint64_t b)
{
	return a < b ? a : b;
}

carom_status carom_canvas_send_bodies(carom_world *world, uint64_t first, uint64_t most, carom_error *error)
{
	carom_canvas next = world->canvas;
	float *stream, *draws;
	carom_status status;
	if (next.end > 0 && next.first == first)
		return CAROM_OK;
	world->canvas.end = 0; /* until all is sent */
	TRY(carom_canvas_hold(world, ROLE_STREAM, lesser(next.all_vertices, most), error));
	TRY(carom_canvas_hold(world, ROLE_PLACED, lesser(next.all_vertices, most), error));
	TRY(carom_canvas_hold(world, ROLE_DRAWS, lesser(DRAWS_WIDTH * world->body_count, most), error));
	next = world->canvas;
	next.first = first;
	next.bodies = next.vertices = next.edges = next.shapes = 0;
	stream = texels_for(world, ROLE_STREAM);
	draws = texels_for(world, ROLE_DRAWS);
	if (stream && draws) {
		fill_bodies(world, most, &next, stream, draws);
		status = upload(world, ROLE_STREAM, next.vertices, stream, error);
	} else {
		status = carom_canvas_no_memory(world, error);
	}
	if (!status)
		status = upload(world, ROLE_DRAWS, DRAWS_WIDTH * next.bodies, draws, error);
	if (!status)
		world->canvas = next;
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
	world->newest &= ~(unsigned)PLACE_HOST;
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
	first[FIRST_LINES] = world->canvas.has_lines ? 1 : 0;
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

carom_status carom_canvas_send_frame(carom_world *world, carom_pixels block, uint32_t ground, uint32_t pass, carom_error *error)
{
	float texels[4 * TILE] = {0}, *tiles = texels + 4 * FRAME_TILES;
	fill_box(block, texels + 4 * FRAME_BOX);
	tiles[TILES_COLUMNS] = (float)carom_parts_of((uint32_t)(block.x1 - block.x0), world->device->kind->tile_width);
	tiles[TILES_ROWS] = (float)carom_parts_of((uint32_t)(block.y1 - block.y0), world->device->kind->tile_height);
	tiles[TILES_GROUND] = (float)ground;
	tiles[TILES_PASS] = (float)pass;
	TRY(carom_canvas_hold(world, ROLE_FRAME, FRAME_WIDTH, error));
	return upload(world, ROLE_FRAME, FRAME_WIDTH, texels, error);
}
