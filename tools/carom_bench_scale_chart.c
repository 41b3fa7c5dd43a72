/* Body-steps a second over the number of bodies, as a chart: a panel a shape, a curve an engine.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"
#include "carom_plot.h"

#include <stdlib.h>

/* Millions of body-steps a second that the memory allows. */
static double ceiling(const struct scale_result *result)
{
	return 1e-6 * result->copy_rate / SCALE_FLOOR_BYTES;
}

static void add_engine(struct plot_panel *panel, const struct scale_result *result, size_t shape, size_t engine)
{
	struct plot_series *series = &panel->series[panel->series_count];
	*series = (struct plot_series){.label = scale_engines[engine].label, .color = scale_engines[engine].color};
	for (size_t k = 0; k < result->row_count; k++) {
		const struct scale_row *row = &result->rows[shape][k];
		struct bench_spread seconds = scale_spread(result, &row->cells[engine]);
		double work = 1e-6 * row->bodies;
		if (seconds.least > 0)
			series->points[series->point_count++] = (struct plot_point){
				row->bodies, work / seconds.median, work / seconds.most, work / seconds.least};
	}
	panel->series_count += series->point_count > 0;
}

static void add_ceiling(struct plot_panel *panel, const struct scale_result *result)
{
	struct plot_series *series = &panel->series[panel->series_count++];
	*series = (struct plot_series){.color = PLOT_GRAY, .reference = true};
	for (size_t k = 0; k < result->row_count && ceiling(result) > 0; k++)
		series->points[series->point_count++] = (struct plot_point){result->rows[0][k].bodies, ceiling(result), ceiling(result), ceiling(result)};
}

carom_status scale_draw(const struct scale_result *result, const char *path, carom_error *error)
{
	char devices[700], footnote[200];
	struct plot_figure *figure = calloc(1, sizeof *figure);
	if (!figure)
		return out_of_memory(error, "there is not enough memory for a chart");
	bench_describe_devices(&result->device, &result->fallback, devices, sizeof devices);
	snprintf(footnote, sizeof footnote,
		"Carom %s, step %s, on all cores; others on one. 1/60 s a step, a quarter filled, up to 5 m/s, restitution 1. "
		"Medians of %zu, bars: all.",
		carom_version(), result->step, result->runs);
	figure->title = "Body-steps a second over the number of bodies";
	figure->subtitle = devices;
	figure->footnote = footnote;
	figure->x_label = "bodies";
	figure->y_label = "million body-steps a second";
	figure->ours = "measured";
	figure->reference = "64 bytes a body at the memory's rate";
	figure->panel_count = SCALE_SHAPES;
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		figure->panels[shape].title = scale_shapes[shape].title;
		for (size_t k = 0; k < SCALE_ENGINES; k++)
			add_engine(&figure->panels[shape], result, shape, k);
		add_ceiling(&figure->panels[shape], result);
	}
	carom_status status = plot_write(figure, path, error);
	free(figure);
	return status;
}
