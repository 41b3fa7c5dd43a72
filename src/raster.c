/* Shapes made ready for pixels, and their pixels.
 * SPDX-License-Identifier: MIT */
#include "raster.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#define PI 3.141592653589793
#define LEAST_OPACITY 0.15 /* of a dot far smaller than a pixel: it still shows on the ground */
#define LINE_OPACITY 0.75  /* at least, of a line however thin: of a body of five pixels or more */
#define FARTHEST 1000000   /* pixels: beyond any picture, and far from an int's end */
#define LANES 8            /* pixels at a time: a fixed count lets the compiler use SIMD */

static double least(double a, double b)
{
	return a < b ? a : b;
}

static double most(double a, double b)
{
	return a > b ? a : b;
}

/* NaN becomes `low`. */
static double clamp(double value, double low, double high)
{
	return least(most(value, low), high);
}

static int32_t whole(double position)
{
	return (int32_t)clamp(position, -FARTHEST, FARTHEST);
}

int32_t carom_nearest_pixel(double position)
{
	return whole(floor(position + 0.5));
}

carom_pixels carom_pixels_clip(carom_pixels box, carom_pixels clip)
{
	if (box.x0 < clip.x0)
		box.x0 = clip.x0;
	if (box.y0 < clip.y0)
		box.y0 = clip.y0;
	if (box.x1 > clip.x1)
		box.x1 = clip.x1;
	if (box.y1 > clip.y1)
		box.y1 = clip.y1;
	return box;
}

/* `array` with room for `needed` elements, moved if need be; NULL, and nothing changed, without the memory. */
static void *with_room(void *array, size_t *room, size_t needed, size_t size)
{
	size_t wanted = *room * 2 > needed ? *room * 2 : needed + 256;
	if (array && needed <= *room)
		return array;
	void *grown = wanted <= SIZE_MAX / size ? realloc(array, wanted * size) : NULL;
	if (grown)
		*room = wanted;
	return grown;
}

static bool make_room(carom_draw_list *list, uint32_t edge_count)
{
	carom_draw_shape *shapes = with_room(list->shapes, &list->shape_room, list->shape_count + 1, sizeof *shapes);
	if (shapes)
		list->shapes = shapes;
	carom_draw_edge *edges = with_room(list->edges, &list->edge_room, list->edge_count + edge_count, sizeof *edges);
	if (edges)
		list->edges = edges;
	list->out_of_memory = !shapes || !edges;
	return !list->out_of_memory;
}

/* NULL if the shape touches no pixel or there is no memory for it. */
static carom_draw_shape *add_shape(carom_draw_list *list, carom_pixels touched, uint32_t edge_count)
{
	if (touched.x0 >= touched.x1 || touched.y0 >= touched.y1 || list->out_of_memory || !make_room(list, edge_count))
		return NULL;
	carom_draw_shape *shape = &list->shapes[list->shape_count++];
	*shape = (carom_draw_shape){.touched = touched, .first_edge = list->edge_count, .opacity = 1};
	return shape;
}

static void add_edge(carom_draw_list *list, carom_draw_shape *shape, double slope_x, double slope_y, double at, double bend)
{
	carom_draw_edge *edge = &list->edges[list->edge_count++];
	edge->slope_x = (float)clamp(slope_x, -FLT_MAX, FLT_MAX);
	edge->slope_y = (float)clamp(slope_y, -FLT_MAX, FLT_MAX);
	edge->at = (float)clamp(at, -FLT_MAX, FLT_MAX);
	edge->bend = (float)clamp(bend, 0, FLT_MAX);
	shape->edge_count++;
}

/* A shape's mean breadth tells what of it can be seen. What is thinner than a pixel is drawn a pixel wide and paler
 * instead, so that it can't fall between the centres of pixels. */
static double growth(double breadth)
{
	return clamp((1 - breadth) / 2, 0, 0.5);
}

static void paint_shape(carom_draw_shape *shape, const carom_paint *paint, double breadth, double length)
{
	double least_opacity = clamp(LEAST_OPACITY * length, LEAST_OPACITY, LINE_OPACITY);
	bool is_line = breadth < 1 && least_opacity >= LINE_OPACITY;
	shape->fill = is_line ? paint->outline : paint->fill; /* two outlines and nothing between them */
	shape->outline = paint->outline;
	shape->width = (float)clamp(breadth / 8, 0, paint->width);
	shape->opacity = (float)(clamp(paint->opacity, 0, 1) * clamp(breadth, least_opacity, 1));
}

/* The pixels whose centres may be within half a pixel of what lies between two corners. */
static carom_pixels pixels_between(carom_point low, carom_point high, double margin, carom_pixels clip)
{
	carom_pixels box = {
		whole(floor(low.x - margin)), whole(floor(low.y - margin)), whole(ceil(high.x + margin)), whole(ceil(high.y + margin))};
	return carom_pixels_clip(box, clip);
}

void carom_draw_box(carom_draw_list *list, carom_pixels clip, carom_pixels box, uint32_t color)
{
	carom_draw_shape *shape = add_shape(list, carom_pixels_clip(box, clip), 0);
	if (shape)
		shape->fill = shape->outline = color;
}

void carom_draw_frame(carom_draw_list *list, carom_pixels clip, carom_pixels box, int32_t breadth, uint32_t color)
{
	carom_pixels out = {box.x0 - breadth, box.y0 - breadth, box.x1 + breadth, box.y1 + breadth};
	carom_draw_box(list, clip, (carom_pixels){out.x0, out.y0, out.x1, box.y0}, color);
	carom_draw_box(list, clip, (carom_pixels){out.x0, box.y1, out.x1, out.y1}, color);
	carom_draw_box(list, clip, (carom_pixels){out.x0, box.y0, box.x0, box.y1}, color);
	carom_draw_box(list, clip, (carom_pixels){box.x1, box.y0, out.x1, box.y1}, color);
}

void carom_draw_disc(carom_draw_list *list, carom_pixels clip, carom_point center, double radius, const carom_paint *paint)
{
	double breadth = PI * radius * radius / most(2 * radius, 1);
	double r = radius + growth(breadth);
	carom_pixels touched = pixels_between(center, center, r, clip);
	carom_draw_shape *shape = add_shape(list, touched, 1);
	if (!shape)
		return;
	paint_shape(shape, paint, breadth, 2 * radius);
	double x = touched.x0 + 0.5 - center.x, y = touched.y0 + 0.5 - center.y;
	add_edge(list, shape, x / r, y / r, (x * x + y * y - r * r) / (2 * r), 1 / (2 * r));
}

static void bounds_of(const carom_point *points, uint32_t count, carom_point *low, carom_point *high)
{
	*low = *high = points[0];
	for (uint32_t k = 1; k < count; k++) {
		low->x = least(low->x, points[k].x), low->y = least(low->y, points[k].y);
		high->x = most(high->x, points[k].x), high->y = most(high->y, points[k].y);
	}
}

static double area_of(const carom_point *points, uint32_t count)
{
	double twice_area = 0;
	for (uint32_t k = 2; k < count; k++) {
		carom_point a = {points[k - 1].x - points[0].x, points[k - 1].y - points[0].y};
		carom_point b = {points[k].x - points[0].x, points[k].y - points[0].y};
		twice_area += a.y * b.x - a.x * b.y;
	}
	return twice_area / 2;
}

/* The half plane of a polygon's side, `out` pixels farther out. A side that was lost in rounding has none. */
static void add_side(carom_draw_list *list, carom_draw_shape *shape, carom_point a, carom_point b, double out)
{
	double along_x = b.x - a.x, along_y = b.y - a.y, length = sqrt(along_x * along_x + along_y * along_y);
	if (!(length > 0))
		return;
	double slope_x = -along_y / length, slope_y = along_x / length;
	double at = slope_x * (shape->touched.x0 + 0.5 - a.x) + slope_y * (shape->touched.y0 + 0.5 - a.y);
	add_edge(list, shape, slope_x, slope_y, at - out, 0);
}

void carom_draw_polygon(
	carom_draw_list *list, carom_pixels clip, const carom_point *points, uint32_t count, const carom_paint *paint)
{
	carom_point low, high;
	bounds_of(points, count, &low, &high);
	double width = high.x - low.x, height = high.y - low.y, length = sqrt(width * width + height * height);
	double breadth = area_of(points, count) / most(length, 1), out = growth(breadth);
	carom_pixels touched = pixels_between(low, high, out, clip);
	carom_draw_shape *shape = add_shape(list, touched, count);
	if (!shape)
		return;
	paint_shape(shape, paint, breadth, length);
	for (uint32_t k = 0; k < count; k++)
		add_side(list, shape, points[k], points[k + 1 < count ? k + 1 : 0], out);
}

void carom_draw_line(
	carom_draw_list *list, carom_pixels clip, carom_point a, carom_point b, double breadth, uint32_t color, double opacity)
{
	double along_x = b.x - a.x, along_y = b.y - a.y, length = sqrt(along_x * along_x + along_y * along_y);
	if (!(length > 0))
		return;
	double x = along_y / length * breadth / 2, y = -along_x / length * breadth / 2;
	carom_point corners[4] = {{a.x - x, a.y - y}, {b.x - x, b.y - y}, {b.x + x, b.y + y}, {a.x + x, a.y + y}};
	carom_draw_polygon(list, clip, corners, 4, &(carom_paint){color, color, 0, opacity});
}

void carom_draw_list_free(carom_draw_list *list)
{
	free(list->shapes);
	free(list->edges);
	*list = (carom_draw_list){0};
}

/* ---- From shapes to pixels ------------------------------------------------------------------------------------ */

/* The signed distance from the shape to LANES pixels of a row, x and y counted from its first pixel. */
static void measure_distances(const carom_draw_edge *edges, uint32_t count, float x, float y, float distances[LANES])
{
	for (int i = 0; i < LANES; i++)
		distances[i] = -FLT_MAX;
	for (const carom_draw_edge *edge = edges; edge < edges + count; edge++) {
		float slope = edge->slope_x, bend = edge->bend, at = edge->at + (edge->slope_y + bend * y) * y;
		for (int i = 0; i < LANES; i++) {
			float across = x + (float)i;
			float distance = at + (slope + bend * across) * across;
			if (bend > 0) {
				float square = 1 + 4 * bend * distance;
				distance = 2 * distance / (1 + sqrtf(square > 0 ? square : 0));
			}
			distances[i] = distance > distances[i] ? distance : distances[i];
		}
	}
}

static float share(float value)
{
	value = value > 0 ? value : 0;
	return value < 1 ? value : 1;
}

/* A shape's paint with its colours squared: light adds up nearly as the squares of sRGB values do, so an edge that is
 * blended in squares is as bright as it should be, for the price of a root. */
typedef struct ink {
	float fill[3], outline[3];
	float width, opacity;
	uint8_t bytes[3];
} ink;

static ink mix_ink(const carom_draw_shape *shape)
{
	ink made = {.width = shape->width, .opacity = shape->opacity};
	for (int c = 0; c < 3; c++) {
		int shift = 16 - 8 * c;
		float fill = (float)(shape->fill >> shift & 255), outline = (float)(shape->outline >> shift & 255);
		made.fill[c] = fill * fill;
		made.outline[c] = outline * outline;
		made.bytes[c] = (uint8_t)(shape->fill >> shift & 255);
	}
	return made;
}

static void blend(const ink *with, float distance, uint8_t *pixel)
{
	float cover = share(0.5f - distance), inner = share(0.5f - distance - with->width);
	if (inner >= 1 && with->opacity >= 1) {
		for (int c = 0; c < 3; c++)
			pixel[c] = with->bytes[c];
	} else if (cover > 0) {
		for (int c = 0; c < 3; c++) {
			float light = with->outline[c] * (cover - inner) + with->fill[c] * inner;
			float ground = (float)pixel[c] * (float)pixel[c];
			pixel[c] = (uint8_t)(sqrtf(ground + with->opacity * (light - cover * ground)) + 0.5f);
		}
	}
}

static void draw_shape(const carom_draw_shape *shape, const carom_draw_edge *edges, uint8_t *pixels, uint32_t width)
{
	ink with = mix_ink(shape);
	float distances[LANES];
	carom_pixels box = shape->touched;
	for (int32_t y = box.y0; y < box.y1; y++) {
		uint8_t *row = pixels + (size_t)y * width * 4;
		for (int32_t x = box.x0; x < box.x1; x += LANES) {
			int32_t end = x + LANES < box.x1 ? x + LANES : box.x1;
			measure_distances(edges, shape->edge_count, (float)(x - box.x0), (float)(y - box.y0), distances);
			for (int32_t i = x; i < end; i++)
				blend(&with, distances[i - x], row + (size_t)i * 4);
		}
	}
}

void carom_raster(const carom_draw_list *list, uint8_t *pixels, uint32_t width)
{
	for (size_t k = 0; k < list->shape_count; k++)
		draw_shape(&list->shapes[k], list->edges + list->shapes[k].first_edge, pixels, width);
}
