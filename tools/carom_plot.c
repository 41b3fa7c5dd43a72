/* Charts drawn with cairo. Carom's own rasteriser draws bodies; lines, dashes and text are outside what it exists for, and the
 * library stays without them: of all that is built, only the command is linked with cairo.
 * SPDX-License-Identifier: MIT */
#include "carom_plot_panel.h"
#include "carom_tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MARGIN 24.0
#define PANEL_WIDTH 420.0
#define PANEL_HEIGHT 300.0
#define LONE_WIDTH 800.0 /* of a chart with one panel */
#define LONE_HEIGHT 440.0
#define LINE 22.0 /* of the legend */
#define LEVELS 9  /* of each of red, green and blue */

/* ---- The legend ---- */

enum key { KEY_OURS, KEY_REFERENCE, KEY_COLOR };

/* Draws the entry (or, without `drawn`, only takes its place) and moves on to the next, on a new line where it has no room. */
static void flow_key(const struct canvas *canvas, struct box *at, enum key key, const char *text, int color, bool drawn)
{
	const double sample = key == KEY_COLOR ? 23 : 37, width = sample + width_of(canvas->cairo, text) + 22;
	if (at->x > MARGIN && at->x + width > MARGIN + at->width) {
		at->x = MARGIN;
		at->y += LINE;
	}
	if (drawn) {
		if (color < 0) {
			set_gray(canvas->cairo, 0.4);
		} else {
			set_color(canvas->cairo, color);
		}
		if (key == KEY_COLOR) {
			draw_swatch(canvas->cairo, at->x, at->y);
		} else {
			draw_sample(canvas->cairo, at->x, at->y, key == KEY_REFERENCE);
		}
		set_gray(canvas->cairo, 0.15);
		put_within(canvas->cairo, text, at->x + sample, at->y + 4, width);
	}
	at->x += width;
}

static bool is_new(const struct plot_figure *figure, size_t panel, size_t index)
{
	const char *label = figure->panels[panel].series[index].label;
	for (size_t i = 0; i <= panel; i++) {
		for (size_t k = 0; k < (i < panel ? figure->panels[i].series_count : index); k++) {
			const struct plot_series *series = &figure->panels[i].series[k];
			if (!series->reference && series->label && strcmp(series->label, label) == 0)
				return false;
		}
	}
	return true;
}

/* Whether the first colour stands for something, or only for Carom. */
static bool first_is_named(const struct plot_figure *figure)
{
	for (size_t i = 0; i < figure->panel_count; i++) {
		for (size_t k = 0; k < figure->panels[i].series_count; k++) {
			if (figure->panels[i].series[k].label && figure->panels[i].series[k].color == 0)
				return true;
		}
	}
	return false;
}

/* First what dashes mean, then the colours; answers the legend's height. */
static double draw_legend(const struct canvas *canvas, double top, double width, bool drawn)
{
	const struct plot_figure *figure = canvas->figure;
	const int color = first_is_named(figure) ? -1 : 0;
	struct box at = {MARGIN, top + LINE / 2, width, 0};
	set_font(canvas->cairo, 12, false);
	flow_key(canvas, &at, KEY_OURS, figure->ours, color, drawn);
	flow_key(canvas, &at, KEY_REFERENCE, figure->reference, color, drawn);
	for (size_t i = 0; i < figure->panel_count; i++) {
		for (size_t k = 0; k < figure->panels[i].series_count; k++) {
			const struct plot_series *series = &figure->panels[i].series[k];
			if (!series->reference && series->label && is_new(figure, i, k))
				flow_key(canvas, &at, KEY_COLOR, series->label, series->color, drawn);
		}
	}
	return at.y + LINE / 2 - top;
}

/* ---- The figure ---- */

static void widen(struct range *range, double value)
{
	range->low = value < range->low ? value : range->low;
	range->high = value > range->high ? value : range->high;
}

/* The next of ..., 1, 2, 5, 10, ... that is not above (or not below) the value. */
static double round_to_step(double value, bool up)
{
	static const double steps[] = {1, 2, 5, 10};
	const double decade = pow(10, floor(log10(value)));
	size_t k = up ? 0 : 3;
	while (up && k < 3 && steps[k] * decade < value * 0.999)
		k++;
	while (!up && k > 0 && steps[k] * decade > value * 1.001)
		k--;
	return steps[k] * decade;
}

static void widen_by(const struct plot_panel *panel, struct range *x, struct range *y)
{
	for (size_t k = 0; k < panel->series_count; k++) {
		for (size_t p = 0; p < panel->series[k].point_count; p++) {
			const struct plot_point *point = &panel->series[k].points[p];
			widen(x, point->x);
			widen(y, point->least);
			widen(y, point->most);
		}
	}
}

/* Of all panels, so that they can be compared; a little room on both sides of the least and the most bodies. */
static void find_ranges(struct canvas *canvas)
{
	canvas->x = canvas->y = (struct range){INFINITY, 0};
	for (size_t k = 0; k < canvas->figure->panel_count; k++)
		widen_by(&canvas->figure->panels[k], &canvas->x, &canvas->y);
	if (!(canvas->y.low > 0 && canvas->y.high > 0))
		canvas->x = canvas->y = (struct range){1, 10};
	canvas->x = (struct range){canvas->x.low / 1.2, canvas->x.high * 1.2};
	canvas->y = (struct range){round_to_step(canvas->y.low, false), round_to_step(canvas->y.high * 1.001, true)};
}

/* Everything, on a canvas of that width; answers the height it takes. Without `drawn` nothing is drawn. */
static double draw_figure(const struct canvas *canvas, double width, bool drawn)
{
	const struct plot_figure *figure = canvas->figure;
	bool lone = figure->panel_count <= 1;
	size_t across = lone ? 1 : figure->panel_count <= 4 ? 2 : 3, down = (figure->panel_count + across - 1) / across;
	const double panel_width = (width - 2 * MARGIN) / (double)across, panel_height = lone ? LONE_HEIGHT : PANEL_HEIGHT;
	double top = MARGIN + 50;
	top += draw_legend(canvas, top, width - 2 * MARGIN, drawn) + 6;
	for (size_t k = 0; drawn && k < figure->panel_count; k++)
		draw_panel(canvas,
			(struct box){MARGIN - 6 + panel_width * (double)(k % across), top + panel_height * (double)(k / across), panel_width, panel_height},
			&figure->panels[k], k % across == 0, k + across >= figure->panel_count);
	double bottom = top + panel_height * (double)down + 18;
	if (drawn) {
		set_font(canvas->cairo, 18, true);
		set_gray(canvas->cairo, 0.1);
		put_within(canvas->cairo, figure->title, MARGIN, MARGIN + 14, width - 2 * MARGIN);
		set_font(canvas->cairo, 11.5, false);
		set_gray(canvas->cairo, 0.35);
		put_within(canvas->cairo, figure->subtitle, MARGIN, MARGIN + 36, width - 2 * MARGIN);
		put_within(canvas->cairo, figure->footnote, MARGIN, bottom, width - 2 * MARGIN);
	}
	return bottom + MARGIN - 8;
}

/* ---- The file ---- */

static carom_status no_memory(carom_error *error)
{
	return out_of_memory(error, "there is not enough memory for a chart");
}

/* To one of LEVELS: smooth edges need no more, and so few colours make a small file. */
static uint8_t rounded(uint8_t value)
{
	return (uint8_t)((value * (LEVELS - 1) + 127) / 255 * 255 / (LEVELS - 1));
}

/* Cairo's pixels are 0xXXRRGGBB in the machine's byte order. */
static carom_status write_surface(cairo_surface_t *surface, const char *path, carom_error *error)
{
	const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
	const unsigned char *rows = cairo_image_surface_get_data(surface);
	const int stride = cairo_image_surface_get_stride(surface);
	uint8_t *pixels = malloc((size_t)width * (size_t)height * 4);
	if (!pixels)
		return no_memory(error);
	for (int y = 0; y < height; y++) {
		for (int x = 0; x < width; x++) {
			uint8_t *to = pixels + ((size_t)y * (size_t)width + (size_t)x) * 4;
			uint32_t pixel;
			memcpy(&pixel, rows + (ptrdiff_t)y * stride + 4 * x, sizeof pixel);
			for (int channel = 0; channel < 3; channel++)
				to[channel] = rounded((uint8_t)(pixel >> (16 - 8 * channel)));
			to[3] = 255;
		}
	}
	carom_status status = carom_png_write(path, pixels, (uint32_t)width, (uint32_t)height, error);
	free(pixels);
	return status;
}

/* A white canvas of that height; its surface is the cairo's target. */
static cairo_t *create_cairo(double width, double height)
{
	cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(width * SCALE), (int)ceil(height * SCALE));
	cairo_t *cairo = cairo_create(surface);
	cairo_surface_destroy(surface);
	cairo_scale(cairo, SCALE, SCALE);
	set_gray(cairo, 1);
	cairo_paint(cairo);
	return cairo;
}

static int compare_points(const void *a, const void *b)
{
	const struct plot_point *p = a, *q = b;
	return (p->x > q->x) - (p->x < q->x);
}

/* They come in the order in which somebody asked for them. */
static void sort_points(struct plot_figure *figure)
{
	for (size_t i = 0; i < figure->panel_count; i++) {
		for (size_t k = 0; k < figure->panels[i].series_count; k++) {
			struct plot_series *series = &figure->panels[i].series[k];
			qsort(series->points, series->point_count, sizeof *series->points, compare_points);
		}
	}
}

carom_status plot_write(struct plot_figure *figure, const char *path, carom_error *error)
{
	struct canvas canvas = {.figure = figure};
	const double width = 2 * MARGIN + (figure->panel_count <= 1 ? LONE_WIDTH : PANEL_WIDTH * (figure->panel_count <= 4 ? 2 : 3));
	sort_points(figure);
	find_ranges(&canvas);
	canvas.cairo = create_cairo(1, 1);
	double height = draw_figure(&canvas, width, false);
	cairo_destroy(canvas.cairo);
	canvas.cairo = create_cairo(width, height);
	draw_figure(&canvas, width, true);
	cairo_surface_t *surface = cairo_get_target(canvas.cairo);
	cairo_surface_flush(surface);
	carom_status status = cairo_status(canvas.cairo) == CAIRO_STATUS_SUCCESS ? write_surface(surface, path, error) : no_memory(error);
	cairo_destroy(canvas.cairo);
	return status;
}

carom_status plot_check(const char *path, carom_error *error)
{
	return try_path(path, error);
}
