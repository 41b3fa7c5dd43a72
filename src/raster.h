/* The draw list: what a picture is made of, in pixels, and how that becomes a picture.
 *
 * A picture is a list of convex shapes, drawn one over the other. A shape is the pixels it may touch and the edges that
 * bound it; both are clipped and measured from the shape's first pixel when it is added, so that floats are exact enough
 * for any shape, and what is left for a pixel is the same few operations everywhere: the distance to each edge, their
 * maximum, and a blend. All of it is + - * / sqrt and comparisons: a picture has the same bits on every host.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_RASTER_H
#define CAROM_RASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* In pixels from the picture's upper left corner, y down; the first pixel's centre is (0.5, 0.5). */
typedef struct carom_point {
	double x, y;
} carom_point;

/* The pixels x0 <= x < x1, y0 <= y < y1. */
typedef struct carom_pixels {
	int32_t x0, y0, x1, y1;
} carom_pixels;

typedef struct carom_paint {
	uint32_t fill, outline; /* 0xRRGGBB */
	double width;           /* pixels, of the outline, inside the shape; 0 for none */
	double opacity;         /* 0..1 */
} carom_paint;

/* A half plane, or with `bend` > 0 a disc of radius 1 / (2 bend): inside is where
 * s(x, y) = at + x slope_x + y slope_y + (x^2 + y^2) bend is negative, with x and y from the centre of the shape's first pixel.
 * The distance is s for a half plane, 2 s / (1 + sqrt(1 + 4 bend s)) for a disc. */
typedef struct carom_draw_edge {
	float slope_x, slope_y, at, bend;
} carom_draw_edge;

typedef struct carom_draw_shape {
	carom_pixels touched;
	uint32_t edge_count; /* 0: all the pixels it touches */
	size_t first_edge;
	uint32_t fill, outline;
	float width, opacity;
} carom_draw_shape;

/* Starts as all zero and ends with carom_draw_list_free. */
typedef struct carom_draw_list {
	carom_draw_shape *shapes;
	carom_draw_edge *edges;
	size_t shape_count, shape_room, edge_count, edge_room;
	bool out_of_memory; /* set by the first shape that could not be added */
} carom_draw_list;

/* A fill of whole pixels. */
void carom_draw_box(carom_draw_list *list, carom_pixels clip, carom_pixels box, uint32_t color);
/* Four bands of whole pixels around `box`. */
void carom_draw_frame(carom_draw_list *list, carom_pixels clip, carom_pixels box, int32_t breadth, uint32_t color);
/* Discs and polygons of under a pixel still show, as pale as they are small. */
void carom_draw_disc(carom_draw_list *list, carom_pixels clip, carom_point center, double radius, const carom_paint *paint);
/* `points` counter-clockwise as seen: clockwise in x and y. */
void carom_draw_polygon(
	carom_draw_list *list, carom_pixels clip, const carom_point *points, uint32_t count, const carom_paint *paint);
/* From `a` to `b`, with square ends. */
void carom_draw_line(
	carom_draw_list *list, carom_pixels clip, carom_point a, carom_point b, double breadth, uint32_t color, double opacity);
void carom_draw_list_free(carom_draw_list *list);

carom_pixels carom_pixels_clip(carom_pixels box, carom_pixels clip);
/* The nearest pixel border; any value, not only those of an int. */
int32_t carom_nearest_pixel(double position);

/* Draws the list over RGBA pixels that are there already, opaque, `width` a row. */
void carom_raster(const carom_draw_list *list, uint8_t *pixels, uint32_t width);

#endif
