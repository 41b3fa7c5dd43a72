/* A table as a chart: a panel a part, our figures and the paper's over the number of bodies.
 * SPDX-License-Identifier: MIT */
#include "carom_bench.h"
#include "carom_plot.h"

#include <stdlib.h>
#include <string.h>

static struct plot_panel *find_panel(struct plot_figure *figure, const char *title)
{
	size_t k = 0;
	while (k < figure->panel_count && strcmp(figure->panels[k].title, title) != 0)
		k++;
	if (k == PLOT_PANELS)
		return NULL;
	if (k == figure->panel_count)
		figure->panels[figure->panel_count++].title = title;
	return &figure->panels[k];
}

static const char *legend_of(const struct bench_column *column)
{
	if (!column->legend)
		return column->label;
	return *column->legend ? column->legend : NULL;
}

static void add_point(struct plot_series *series, double x, double y, double least, double most)
{
	if (y > 0 && series->point_count < PLOT_POINTS)
		series->points[series->point_count++] = (struct plot_point){x, y, least, most};
}

/* Both lines of a column. */
static void add_column(struct plot_figure *figure, const struct bench_result *result, size_t part, size_t index)
{
	const struct bench_column *column = &result->table->parts[part].columns[index];
	struct plot_panel *panel = find_panel(figure, column->panel ? column->panel : result->table->parts[part].title);
	if (!panel || panel->series_count + 2 > PLOT_SERIES || !result->rows[part][0].cells[index].measured)
		return;
	struct plot_series *paper = &panel->series[panel->series_count++], *ours = &panel->series[panel->series_count++];
	*paper = (struct plot_series){.label = legend_of(column), .color = column->color, .reference = true};
	*ours = (struct plot_series){.label = legend_of(column), .color = column->color};
	for (size_t k = 0; k < result->row_count; k++) {
		const struct bench_row *row = &result->rows[part][k];
		struct bench_summary sum = bench_summarize(result, row, column, index);
		add_point(ours, row->bodies, sum.spread.median, sum.spread.least, sum.spread.most);
		add_point(paper, row->bodies, sum.paper, sum.paper, sum.paper);
	}
}

void bench_describe_devices(const carom_device_info *device, const carom_device_info *fallback, char *text, size_t size)
{
	const bool both = device->is_opencl && *fallback->name;
	const char *storage = device->uses_images ? ", images" : ", buffers";
	snprintf(text, size, "%s%s%s, %u %s%s%s%s", device->platform, *device->platform ? ": " : "", device->name, (unsigned)device->compute_units,
		device->is_opencl ? "compute units" : "cores", device->is_opencl ? storage : "", both ? "; " : "", both ? fallback->name : "");
}

carom_status bench_draw(const struct bench_result *result, const char *path, carom_error *error)
{
	char device[700], footnote[200];
	struct plot_figure *figure = calloc(1, sizeof *figure);
	if (!figure)
		return out_of_memory(error, "there is not enough memory for a chart");
	bench_describe_devices(&result->device, &result->fallback, device, sizeof device);
	snprintf(footnote, sizeof footnote,
		"Carom %s: median of %zu runs, bars from the least to the most. The paper: GeForce 7900 GS; "
		"CPU: Core 2 Duo, 1.86 GHz.",
		carom_version(), result->runs);
	figure->title = result->table->chart;
	figure->subtitle = device;
	figure->footnote = footnote;
	figure->x_label = "bodies";
	figure->y_label = result->table->unit;
	figure->ours = "Carom";
	figure->reference = "the paper";
	for (size_t part = 0; part < result->table->part_count; part++) {
		for (size_t k = 0; k < result->table->parts[part].column_count; k++)
			add_column(figure, result, part, k);
	}
	carom_status status = plot_write(figure, path, error);
	free(figure);
	return status;
}
