/* Charts as PNG files: lines over a logarithmic number of bodies, in panels that share their axes.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PLOT_H
#define CAROM_PLOT_H

#include "carom.h"

#define PLOT_POINTS 16
#define PLOT_SERIES 24
#define PLOT_PANELS 9
#define PLOT_GRAY (-1)

struct plot_point {
	double x, y;        /* above 0 */
	double least, most; /* the ends of the bar; equal to y for none */
};

struct plot_series {
	const char *label; /* in the legend, once however many series have it; NULL for none */
	int color;         /* from 0, of a palette, or PLOT_GRAY */
	bool reference;    /* dashed, with hollow markers: figures that others are compared with */
	size_t point_count;
	struct plot_point points[PLOT_POINTS];
};

struct plot_panel {
	const char *title;
	size_t series_count;
	struct plot_series series[PLOT_SERIES];
};

struct plot_figure {
	const char *title, *subtitle, *footnote; /* a line each */
	const char *x_label, *y_label;
	const char *ours, *reference; /* what solid and dashed lines are, for the legend */
	size_t panel_count;
	struct plot_panel panels[PLOT_PANELS];
};

/* Whether a chart can be written to that path. */
carom_status plot_check(const char *path, carom_error *error);
/* Whole or not at all. Brings the points of each series into the order of x. */
carom_status plot_write(struct plot_figure *figure, const char *path, carom_error *error);

#endif
