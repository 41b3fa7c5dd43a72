/* What was measured over sizes: as text, and as rows of the tables' CSV.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <inttypes.h>
#include <string.h>

/* ---- Text ---- */

void scale_print_peers(void)
{
	static const struct peer *const peers[] = {&peer_box2d, &peer_chipmunk};
	for (size_t k = 0; k < sizeof peers / sizeof *peers; k++)
		printf("%s%s%s: %s\n", peers[k]->name, peers[k]->version ? " " : "", peers[k]->version ? peers[k]->version() : "", peers[k]->settings);
}

static void print_head(const struct scale_result *result)
{
	printf("scale: steps of 1/60 s by the wall clock, step=%s\n", result->step);
	bench_print_device("device", &result->device);
	bench_print_device("CPU fallback", &result->fallback);
	scale_print_peers();
	if (result->copy_rate > 0) {
		char size[32];
		printf("memory: %.1f GB/s, the best of 10 copies of %s by %u thread%s, before and after, read and written bytes counted\n",
			1e-9 * result->copy_rate, format_bytes(result->copy_bytes, size, sizeof size), result->copy_threads,
			result->copy_threads == 1 ? "" : "s");
	}
}

/* The rate of the fastest peer; 0 for none. */
static double best_peer(const struct scale_result *result, const struct scale_row *row)
{
	double best = 0;
	for (size_t k = 0; k < SCALE_ENGINES; k++) {
		double rate = scale_engines[k].peer ? scale_rate(result, row, k) : 0;
		best = rate > best ? rate : best;
	}
	return best;
}

static void print_cell(const struct scale_result *result, const struct scale_row *row, size_t engine)
{
	char median[32], least[32], most[32], spread[72], speed[32], ratio[32] = "", share[32] = "", picture[32] = "";
	const struct scale_cell *cell = &row->cells[engine];
	const struct bench_spread seconds = scale_spread(result, cell);
	const double rate = scale_rate(result, row, engine), peer = best_peer(result, row);
	if (cell->steps == 0) {
		printf("%8u  %-20s%11s  left out: %s\n", (unsigned)row->bodies, scale_engines[engine].label, "-", cell->why);
		return;
	}
	snprintf(spread, sizeof spread, "%s - %s", bench_format(1e3 * seconds.least, least, sizeof least),
		bench_format(1e3 * seconds.most, most, sizeof most));
	if (!scale_engines[engine].peer && peer > 0)
		bench_format_ratio(rate / peer, ratio, sizeof ratio);
	if (result->copy_rate > 0)
		snprintf(share, sizeof share, "%.2g %%", 100 * 1e6 * rate * SCALE_FLOOR_BYTES / result->copy_rate);
	if (cell->picture[0] > 0)
		bench_format(1e3 * bench_spread(cell->picture, result->runs, 1).median, picture, sizeof picture);
	printf("%8u  %-20s%11s  %-20s%12s%14s%10s%14s  %zu x %" PRIu64 "\n", (unsigned)row->bodies, scale_engines[engine].label,
		bench_format(1e3 * seconds.median, median, sizeof median), spread, bench_format(rate, speed, sizeof speed), ratio, share, picture,
		result->runs, cell->steps);
}

static void print_shape(const struct scale_result *result, size_t shape)
{
	printf("\n%s\n%8s  %-20s%11s  %-20s%12s%14s%10s%14s  %s\n", scale_shapes[shape].title, "bodies", "", "ms a step", "least - most", "million/s",
		"to best peer", "of floor", "ms a picture", "steps");
	for (size_t i = 0; i < result->row_count; i++) {
		for (size_t k = 0; k < SCALE_ENGINES; k++) {
			if (!scale_absence(result, k))
				print_cell(result, &result->rows[shape][i], k);
		}
		if (i + 1 < result->row_count)
			putchar('\n');
	}
}

static void print_kept(const struct scale_result *result)
{
	printf("\nkept in %d steps of %u bodies\n%-12s%-20s%22s%16s\n", SCALE_KEPT_STEPS, (unsigned)result->kept_bodies, "", "", "kinetic energy, by",
		"worst overlap");
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		for (size_t k = 0; k < SCALE_ENGINES; k++) {
			const struct scale_kept *kept = &result->kept[shape][k];
			if (kept->measured)
				printf("%-12s%-20s%20.2g %%%14.2g m\n", scale_shapes[shape].title, scale_engines[k].label, 100 * kept->drift, kept->overlap);
		}
	}
}

static void print_warm(const struct scale_result *result)
{
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		for (size_t k = 0; k < result->row_count; k++) {
			const struct scale_row *row = &result->rows[shape][k];
			if (row->warm > 0 && row->warm < SCALE_WARM)
				printf("There were only %u steps before with %u %s.\n", (unsigned)row->warm, (unsigned)row->bodies, scale_shapes[shape].title);
		}
	}
}

static void print_reading(const struct scale_result *result)
{
	printf("\nThe bodies: radius 0.5 m (triangles: of the circle around), a quarter of a square room filled, each component of the\n"
		   "velocity uniform in [-5, 5] m/s, restitution 1, no friction, no gravity. All engines begin from the same bodies as\n"
		   "they are after %d steps of Carom; then each makes up to %d steps by itself that are not timed.\n",
		SCALE_WARM, SCALE_WARM);
	print_warm(result);
	printf("ms a step: the median of %zu batches, with the least and the most; steps: batches x steps of each.\n"
		   "million/s: body-steps a second, in millions: bodies x steps / seconds.\n"
		   "to best peer: Carom's body-steps a second / those of the faster of the others, above 1 where Carom is faster.\n"
		   "of floor: what a step takes at least, %d bytes a body at the memory's rate above, as a part of what it took. A GPU\n"
		   "with a memory of its own is not bound by that.\n"
		   "ms a picture: the median of as many, each drawn after a step, of %d x %d pixels, the bodies' states read and drawn,\n"
		   "but not written as PNG.\n"
		   "Carom takes all cores, the others one; they are the system's packages (Debian's Chipmunk has its assertions compiled\n"
		   "in). Where a step of one took more than %.0f s, it is left out of the larger sizes.\n"
		   "kept: the kinetic energy ought to stay and nothing to overlap; the overlap is looked for every %d steps, also with\n"
		   "walls. Both are measured by Carom, in double precision, from each engine's states.\n",
		result->runs, SCALE_FLOOR_BYTES, SCALE_WIDTH, SCALE_HEIGHT, SCALE_SLOW, SCALE_KEPT_EVERY);
	if (!strcmp(result->step, "first_impact"))
		printf("A step of %s may end before 1/60 s: its figures can't be compared with the others'.\n", result->step);
}

void scale_print(const struct scale_result *result)
{
	print_head(result);
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++)
		print_shape(result, shape);
	print_kept(result);
	print_reading(result);
}

/* ---- CSV ---- */

void scale_put_engine(FILE *stream, const struct scale_engine *engine, const carom_device_info *device, uint32_t bodies, const char *shape,
	const char *settings)
{
	const struct peer *peer = engine->peer;
	char name[64];
	if (peer) {
		snprintf(name, sizeof name, "%s %s", peer->name, peer->version());
		bench_put_text(stream, name);
	} else {
		bench_put_device(stream, device);
	}
	fprintf(stream, "%s,%u,%s,", peer ? "memory" : bench_storage(device), (unsigned)bodies, shape);
	bench_put_text(stream, engine->label);
	bench_put_text(stream, settings);
	fputs("0,", stream);
}

/* Up to the run's number; `what` is measured, if not steps. */
static void put_start(FILE *stream, const struct scale_result *result, size_t shape, const char *what, uint32_t bodies, size_t engine)
{
	const carom_device_info *device = scale_engines[engine].place == PLACE_CPU ? &result->fallback : &result->device;
	fprintf(stream, "%s,scale,\"%s%s\",", carom_version(), scale_shapes[shape].title, what);
	scale_put_engine(stream, &scale_engines[engine], device, bodies, scale_shapes[shape].name, result->settings[engine]);
}

static void write_cell(FILE *stream, const struct scale_result *result, size_t shape, const struct scale_row *row, size_t engine)
{
	const struct scale_cell *cell = &row->cells[engine];
	for (size_t run = 0; cell->steps && run < result->runs; run++) {
		put_start(stream, result, shape, "", row->bodies, engine);
		fprintf(stream, "%zu,%" PRIu64 ",0,%.9g,%.9g,,,,%.6g,,,,\n", run + 1, cell->steps, cell->seconds[run],
			REPETITIONS * cell->seconds[run] / (double)cell->steps, result->copy_rate);
	}
	for (size_t run = 0; cell->picture[0] > 0 && run < result->runs; run++) {
		put_start(stream, result, shape, ", a picture", row->bodies, engine);
		fprintf(stream, "%zu,1,0,%.9g,%.9g,,,,%.6g,,,,\n", run + 1, cell->picture[run], REPETITIONS * cell->picture[run], result->copy_rate);
	}
}

static void write_kept(FILE *stream, const struct scale_result *result, size_t shape, size_t engine)
{
	const struct scale_kept *kept = &result->kept[shape][engine];
	if (!kept->measured)
		return;
	put_start(stream, result, shape, ", kept", result->kept_bodies, engine);
	fprintf(stream, "1,%d,0,%.9g,%.9g,,%.9g,%.9g,%.6g,,,,\n", SCALE_KEPT_STEPS, kept->seconds, REPETITIONS * kept->seconds / SCALE_KEPT_STEPS,
		kept->drift, kept->overlap, result->copy_rate);
}

void scale_write_csv(FILE *stream, const struct scale_result *result)
{
	for (size_t shape = 0; shape < SCALE_SHAPES; shape++) {
		for (size_t i = 0; i < result->row_count; i++) {
			for (size_t k = 0; k < SCALE_ENGINES; k++)
				write_cell(stream, result, shape, &result->rows[shape][i], k);
		}
		for (size_t k = 0; k < SCALE_ENGINES; k++)
			write_kept(stream, result, shape, k);
	}
}
