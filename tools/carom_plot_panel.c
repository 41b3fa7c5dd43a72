/* A panel of a chart: its axes, and the lines in it.
 * SPDX-License-Identifier: MIT */
#include "carom_plot_panel.h"

#include <math.h>
#include <string.h>

/* Round about a panel's plot. */
#define LEFT 62.0
#define BOTTOM 44.0
#define TOP 30.0
#define RIGHT 14.0
#define LABEL_GAP 8.0 /* between two labels */
#define BAR_GAP 4.0   /* between the bars of two series */
#define THIN (1 / SCALE)
#define TWO_PI 6.28318530717958647692

/* Told apart with any colour vision (Okabe and Ito), yellow left out: it is too light on white. */
static const double palette[][3] = {
	{0.00, 0.45, 0.70}, /* blue */
	{0.84, 0.37, 0.00}, /* vermilion */
	{0.00, 0.62, 0.45}, /* green */
	{0.80, 0.47, 0.65}, /* purple */
	{0.34, 0.71, 0.91}, /* sky */
	{0.90, 0.62, 0.00}, /* orange */
};

#define COLORS (sizeof palette / sizeof *palette)

/* ---- Text and colours ---- */

void set_gray(cairo_t *cairo, double gray)
{
	cairo_set_source_rgb(cairo, gray, gray, gray);
}

void set_color(cairo_t *cairo, int color)
{
	const double *c = palette[(size_t)color % COLORS];
	if (color == PLOT_GRAY) {
		set_gray(cairo, 0.4);
		return;
	}
	cairo_set_source_rgb(cairo, c[0], c[1], c[2]);
}

void set_font(cairo_t *cairo, double size, bool bold)
{
	cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
	cairo_set_font_size(cairo, size);
}

double width_of(cairo_t *cairo, const char *text)
{
	cairo_text_extents_t extents;
	cairo_text_extents(cairo, text, &extents);
	return extents.x_advance;
}

/* `align` 0: x is the left end, 0.5: the middle, 1: the right end. */
static void put_text(cairo_t *cairo, const char *text, double x, double y, double align)
{
	cairo_move_to(cairo, x - align * width_of(cairo, text), y);
	cairo_show_text(cairo, text);
}

void put_within(cairo_t *cairo, const char *text, double x, double y, double width)
{
	char part[512];
	size_t length = strlen(text);
	if (length < sizeof part && width_of(cairo, text) <= width) {
		put_text(cairo, text, x, y, 0);
		return;
	}
	length = length < sizeof part - 4 ? length : sizeof part - 4;
	do {
		snprintf(part, sizeof part, "%.*s...", (int)length, text);
	} while (width_of(cairo, part) > width && --length > 0);
	put_text(cairo, part, x, y, 0);
}

/* "0.001", "1", "1,000", "1,000,000" */
static void format_number(double number, char *text, size_t size)
{
	char digits[32];
	snprintf(digits, sizeof digits, number < 1000 ? "%g" : "%.0f", number);
	size_t used = 0, length = strlen(digits);
	for (size_t k = 0; k < length && used + 2 < size; k++) {
		if (number >= 1000 && k > 0 && (length - k) % 3 == 0)
			text[used++] = ',';
		text[used++] = digits[k];
	}
	text[used] = '\0';
}

/* ---- Axes ---- */

static double place(struct range range, double value, double from, double to)
{
	return from + (to - from) * (log(value) - log(range.low)) / (log(range.high) - log(range.low));
}

static double place_x(const struct canvas *canvas, struct box plot, double x)
{
	return place(canvas->x, x, plot.x, plot.x + plot.width);
}

static double place_y(const struct canvas *canvas, struct box plot, double y)
{
	return place(canvas->y, y, plot.y + plot.height, plot.y);
}

static void put_line(cairo_t *cairo, double x0, double y0, double x1, double y1)
{
	cairo_move_to(cairo, x0, y0);
	cairo_line_to(cairo, x1, y1);
	cairo_stroke(cairo);
}

/* Where a line of that width begins and ends at a pixel's edge: else some were paler than others. */
static double sharp(double at, double width)
{
	return floor(at * SCALE) / SCALE + width / 2;
}

/* A line at each digit of each decade; the ones are labelled, and where decades are few the twos and fives. */
static bool is_labelled(const struct canvas *canvas, int digit)
{
	return digit == 1 || ((digit == 2 || digit == 5) && canvas->y.high / canvas->y.low < 1000);
}

static void draw_y_line(const struct canvas *canvas, struct box plot, double value, int digit)
{
	cairo_t *cairo = canvas->cairo;
	char text[32];
	const double y = place_y(canvas, plot, value), width = digit == 1 ? 1 : THIN, at = sharp(y, width);
	set_gray(cairo, digit == 1 ? 0.80 : 0.93);
	cairo_set_line_width(cairo, width);
	put_line(cairo, plot.x, at, plot.x + plot.width, at);
	if (is_labelled(canvas, digit)) {
		format_number(value, text, sizeof text);
		set_gray(cairo, 0.25);
		put_text(cairo, text, plot.x - 7, y + 4, 1);
	}
}

static void draw_y_axis(const struct canvas *canvas, struct box plot)
{
	set_font(canvas->cairo, 11, false);
	for (double decade = pow(10, floor(log10(canvas->y.low) + 1e-9)); decade < canvas->y.high * 1.001; decade *= 10) {
		for (int digit = 1; digit < 10; digit++) {
			if (digit * decade > canvas->y.low * 0.999 && digit * decade < canvas->y.high * 1.001)
				draw_y_line(canvas, plot, digit * decade, digit);
		}
	}
}

/* The first that is no reference: the others have the same numbers of bodies, or fewer. NULL for none. */
static const struct plot_series *find_ticks(const struct plot_panel *panel)
{
	for (size_t k = 0; k < panel->series_count; k++) {
		if (!panel->series[k].reference && panel->series[k].point_count)
			return &panel->series[k];
	}
	return NULL;
}

/* Whether each `stride`-th label keeps clear of the next. */
static bool labels_fit(const struct canvas *canvas, struct box plot, const struct plot_series *ticks, size_t stride)
{
	double end = -HUGE_VAL;
	for (size_t k = 0; k < ticks->point_count; k += stride) {
		char text[32];
		format_number(ticks->points[k].x, text, sizeof text);
		double x = place_x(canvas, plot, ticks->points[k].x), half = width_of(canvas->cairo, text) / 2;
		if (x - half < end + LABEL_GAP)
			return false;
		end = x + half;
	}
	return true;
}

/* A line at each number of bodies that was measured; where there are many, some are labelled. */
static void draw_x_axis(const struct canvas *canvas, struct box plot, const struct plot_panel *panel)
{
	cairo_t *cairo = canvas->cairo;
	const struct plot_series *ticks = find_ticks(panel);
	size_t stride = 1;
	char text[32];
	set_font(cairo, 11, false);
	while (ticks && stride < ticks->point_count && !labels_fit(canvas, plot, ticks, stride))
		stride++;
	for (size_t k = 0; ticks && k < ticks->point_count; k++) {
		const double x = place_x(canvas, plot, ticks->points[k].x), at = sharp(x, THIN);
		set_gray(cairo, 0.93);
		cairo_set_line_width(cairo, THIN);
		put_line(cairo, at, plot.y, at, plot.y + plot.height);
		format_number(ticks->points[k].x, text, sizeof text);
		set_gray(cairo, 0.25);
		if (k % stride == 0)
			put_text(cairo, text, x, plot.y + plot.height + 16, 0.5);
	}
}

/* The units, where the panel is at the edge of the figure. */
static void draw_labels(const struct canvas *canvas, struct box plot, bool left, bool bottom)
{
	cairo_t *cairo = canvas->cairo;
	set_font(cairo, 11.5, false);
	set_gray(cairo, 0.25);
	if (bottom)
		put_text(cairo, canvas->figure->x_label, plot.x + plot.width / 2, plot.y + plot.height + 34, 0.5);
	if (!left)
		return;
	cairo_save(cairo);
	cairo_translate(cairo, plot.x - LEFT + 14, plot.y + plot.height / 2);
	cairo_rotate(cairo, -TWO_PI / 4);
	put_text(cairo, canvas->figure->y_label, 0, 0, 0.5);
	cairo_restore(cairo);
}

/* ---- Series ---- */

static void set_dash(cairo_t *cairo, bool dashed)
{
	static const double dashes[] = {5, 4};
	cairo_set_dash(cairo, dashes, dashed ? 2 : 0, 0);
	cairo_set_line_width(cairo, dashed ? 1.4 : 2);
}

static void draw_marker(cairo_t *cairo, double x, double y, bool hollow)
{
	cairo_set_dash(cairo, NULL, 0, 0);
	cairo_set_line_width(cairo, 1.4);
	cairo_arc(cairo, x, y, hollow ? 3.2 : 3.6, 0, TWO_PI);
	if (hollow) {
		cairo_save(cairo);
		set_gray(cairo, 1);
		cairo_fill_preserve(cairo);
		cairo_restore(cairo);
	} else {
		cairo_fill_preserve(cairo);
	}
	cairo_stroke(cairo);
}

void draw_sample(cairo_t *cairo, double x, double y, bool reference)
{
	set_dash(cairo, reference);
	put_line(cairo, x, y, x + 30, y);
	draw_marker(cairo, x + 15, y, reference);
}

void draw_swatch(cairo_t *cairo, double x, double y)
{
	cairo_rectangle(cairo, x, y - 5, 16, 10);
	cairo_fill(cairo);
}

static void draw_bar(cairo_t *cairo, double x, double low, double high)
{
	cairo_set_dash(cairo, NULL, 0, 0);
	cairo_set_line_width(cairo, 1.2);
	put_line(cairo, x, low, x, high);
	put_line(cairo, x - 4, low, x + 4, low);
	put_line(cairo, x - 4, high, x + 4, high);
}

/* `aside`: to the right of where it belongs. */
static void draw_series(const struct canvas *canvas, struct box plot, const struct plot_series *series, double aside)
{
	cairo_t *cairo = canvas->cairo;
	set_color(cairo, series->color);
	set_dash(cairo, series->reference);
	for (size_t k = 0; k < series->point_count; k++)
		cairo_line_to(cairo, aside + place_x(canvas, plot, series->points[k].x), place_y(canvas, plot, series->points[k].y));
	cairo_stroke(cairo);
	for (size_t k = 0; k < series->point_count; k++) {
		const struct plot_point *point = &series->points[k];
		double x = aside + place_x(canvas, plot, point->x);
		if (point->least < point->most)
			draw_bar(cairo, x, place_y(canvas, plot, point->least), place_y(canvas, plot, point->most));
		set_color(cairo, series->color);
		draw_marker(cairo, x, place_y(canvas, plot, point->y), series->reference);
		set_color(cairo, series->color);
	}
}

/* References below; the others a little beside each other, since their bars may overlap. */
static void draw_all(const struct canvas *canvas, struct box plot, const struct plot_panel *panel)
{
	double aside = BAR_GAP / 2;
	for (size_t k = 0; k < panel->series_count; k++) {
		if (panel->series[k].reference) {
			draw_series(canvas, plot, &panel->series[k], 0);
		} else {
			aside -= BAR_GAP / 2;
		}
	}
	for (size_t k = 0; k < panel->series_count; k++) {
		if (!panel->series[k].reference) {
			draw_series(canvas, plot, &panel->series[k], aside);
			aside += BAR_GAP;
		}
	}
}

void draw_panel(const struct canvas *canvas, struct box box, const struct plot_panel *panel, bool left, bool bottom)
{
	cairo_t *cairo = canvas->cairo;
	const struct box plot = {box.x + LEFT, box.y + TOP, box.width - LEFT - RIGHT, box.height - TOP - BOTTOM};
	set_font(cairo, 13, true);
	set_gray(cairo, 0.1);
	put_within(cairo, panel->title, plot.x, box.y + 19, plot.width + RIGHT);
	draw_y_axis(canvas, plot);
	draw_x_axis(canvas, plot, panel);
	draw_labels(canvas, plot, left, bottom);
	set_gray(cairo, 0.45);
	cairo_set_line_width(cairo, 1);
	cairo_rectangle(cairo, plot.x, plot.y, plot.width, plot.height);
	cairo_stroke(cairo);
	draw_all(canvas, plot, panel);
}
