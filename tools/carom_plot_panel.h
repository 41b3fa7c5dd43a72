/* The parts of a chart: text, axes, lines. Only the files carom_plot*.c know cairo.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PLOT_PANEL_H
#define CAROM_PLOT_PANEL_H

#include "carom_plot.h"

#include <cairo.h>

#define SCALE 2.0 /* pixels a unit; all lengths are in units */

struct box {
	double x, y, width, height;
};

struct range {
	double low, high;
};

struct canvas {
	cairo_t *cairo;
	const struct plot_figure *figure;
	struct range x, y; /* of the data, the same in all panels */
};

void set_gray(cairo_t *cairo, double gray);
/* Of the palette, or PLOT_GRAY. */
void set_color(cairo_t *cairo, int color);
void set_font(cairo_t *cairo, double size, bool bold);
double width_of(cairo_t *cairo, const char *text);
/* As much as there is room for, with dots for the rest. */
void put_within(cairo_t *cairo, const char *text, double x, double y, double width);
/* A sample of a line, 30 wide. */
void draw_sample(cairo_t *cairo, double x, double y, bool reference);
/* A colour, 16 wide. */
void draw_swatch(cairo_t *cairo, double x, double y);
/* `left`, `bottom`: whether the axis there gets its unit. */
void draw_panel(const struct canvas *canvas, struct box box, const struct plot_panel *panel, bool left, bool bottom);

#endif
