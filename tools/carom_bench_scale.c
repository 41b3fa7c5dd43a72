/* carom bench scale: body-steps a second over the number of bodies, Carom's and other engines'.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <stdlib.h>

const struct scale_engine scale_engines[SCALE_ENGINES] = {
	{"Carom, CPU fallback", NULL, PLACE_CPU, 0},
	{"Carom, OpenCL", NULL, PLACE_OPENCL, 1},
	{"Box2D", &peer_box2d, PLACE_CHOSEN, 2},
	{"Chipmunk", &peer_chipmunk, PLACE_CHOSEN, 3},
};

const struct scale_shape scale_shapes[SCALE_SHAPES] = {{"circles", "circle", 0}, {"triangles", "triangle", 3}};

struct bench_spread scale_spread(const struct scale_result *result, const struct scale_cell *cell)
{
	if (cell->steps == 0)
		return (struct bench_spread){0, 0, 0};
	return bench_spread(cell->seconds, result->runs, 1 / (double)cell->steps);
}

double scale_rate(const struct scale_result *result, const struct scale_row *row, size_t engine)
{
	double seconds = scale_spread(result, &row->cells[engine]).median;
	return seconds > 0 ? 1e-6 * row->bodies / seconds : 0;
}

carom_status bench_scale_check(const struct bench_options *options, carom_error *error)
{
	carom_world_def def;
	return scale_world_def(options, PLACE_CHOSEN, &def, error);
}

carom_status bench_scale(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error)
{
	struct bench_options own = *options;
	struct scale_result *result = calloc(1, sizeof *result);
	if (!result)
		return out_of_memory(error, "there is not enough memory for the figures");
	own.seconds = own.seconds > 0 ? own.seconds : SCALE_SECONDS;
	carom_status status = scale_measure(&own, result, error);
	if (status == CAROM_OK) {
		scale_print(result);
		fflush(stdout);
		if (csv)
			scale_write_csv(csv, result);
		if (plot)
			status = scale_draw(result, plot, error);
	}
	free(result);
	return status;
}
