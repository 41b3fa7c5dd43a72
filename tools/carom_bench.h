/* What the files of `carom bench` share. A table is data: what is run, and what is read off. To add one, add a file like
 * carom_bench_tables.c and name its table in carom_bench.c.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_BENCH_H
#define CAROM_BENCH_H

#include "carom_tool.h"

#define MAX_RUNS 99
#define MAX_SIZES 16
#define MAX_SUBJECTS 8
#define MAX_COLUMNS 12
#define MAX_PARTS 4
#define REPETITIONS 1000 /* what the paper's figures are for */
#define PAPER_LOG2 8     /* its tables begin with 2^8 bodies */
#define PAPER_SIZES 5

/* ---- A table */

enum bench_work {
	WORK_STEPS,       /* steps, handed over together */
	WORK_DRAWN_STEPS, /* a step and a picture in turn */
	WORK_PICTURES,    /* pictures of one state */
};

enum bench_place {
	PLACE_CHOSEN, /* the device that --device says */
	PLACE_OPENCL, /* the same, but left out where that is no OpenCL device */
	PLACE_CPU,    /* the CPU fallback */
};

/* A world, and what is done with it again and again. */
struct bench_subject {
	const char *label; /* for the line that shows how far the command is */
	uint32_t sides;    /* of the bodies; 0 for circles */
	enum bench_work work;
	enum bench_place place;
	uint32_t iterations; /* as in carom_world_def */
	const char *sets[2]; /* "slot=alternative", over those of --set */
	bool boxes;          /* their walls are static boxes, not a room's */
};

/* A figure read off a subject. */
struct bench_column {
	const char *label;
	size_t subject;
	const char *kernels[8]; /* the time of these; none: the wall clock */
	const double *paper;    /* s for 1,000, PAPER_SIZES of them from 2^PAPER_LOG2 bodies on, 0 for none; NULL for none at all */
	const char *panel;      /* of the chart; NULL for one that has the part's title */
	const char *legend;     /* in the chart; NULL for the label, "" for none */
	int color;              /* in the chart */
};

/* Subjects that are compared with each other: they take turns. */
struct bench_part {
	const char *title;
	const struct bench_subject *subjects;
	size_t subject_count;
	const struct bench_column *columns;
	size_t column_count;
};

struct bench_table {
	const char *name;     /* "table1" */
	const char *title;    /* says what is done 1,000 times */
	const char *chart;    /* the chart's title */
	const char *unit;     /* of the chart's axis: "seconds for 1,000 ..." */
	const char *notes;    /* what the reader must know, in lines */
	unsigned least, most; /* log2 of the numbers of bodies */
	const struct bench_part *parts;
	size_t part_count;
};

extern const struct bench_table bench_table1, bench_table2, bench_table3, bench_table4, bench_table5;

/* ---- The call */

struct bench_options {
	struct common_options common;
	const char *csv, *plot; /* NULL if not given */
	uint64_t runs;
	double seconds; /* a measurement should last, about; 0 for the table's own */
	uint32_t sizes[MAX_SIZES];
	size_t size_count; /* 0: the table's own */
};

/* ---- What was measured */

struct bench_cell {
	bool measured;
	double seconds[MAX_RUNS]; /* of `repetitions` */
	uint64_t launches;        /* of its kernels, in one run */
};

struct bench_row {
	uint32_t bodies;
	uint64_t repetitions;
	struct bench_cell cells[MAX_COLUMNS];
};

struct bench_result {
	const struct bench_table *table;
	size_t runs, row_count;
	carom_device_info device, fallback; /* the chosen device; the CPU fallback where a part needs it */
	struct bench_row rows[MAX_PARTS][MAX_SIZES];
	char pipelines[MAX_PARTS][MAX_SUBJECTS][512]; /* "slot=alternative" of all slots */
};

struct bench_spread {
	double median, least, most;
};

struct bench_summary {
	struct bench_spread spread; /* s for 1,000 */
	double paper;               /* s for 1,000; 0 for none */
};

struct bench_summary bench_summarize(const struct bench_result *result, const struct bench_row *row, const struct bench_column *column, size_t index);

/* ---- carom_bench_measure.c */

/* Whether the library has all the slots and alternatives that the table names; CAROM_UNKNOWN_NAME if not. Refuses another step than the
 * paper's. */
carom_status bench_check(const struct bench_table *table, const struct bench_options *options, carom_error *error);
/* Fills in *result, which is all zeros. */
carom_status bench_measure(const struct bench_table *table, const struct bench_options *options, struct bench_result *result, carom_error *error);

/* The numbers of bodies that the options name, else `count` standard ones, into `sizes`; answers how many there are. */
size_t bench_choose_sizes(const struct bench_options *options, const uint32_t *standard, size_t count, uint32_t sizes[MAX_SIZES]);
/* Of measurements, all multiplied by `scale`. */
struct bench_spread bench_spread(const double *seconds, size_t runs, double scale);
/* "slot=alternative" of all slots */
void bench_describe_pipeline(const carom_world *world, char *text, size_t size);

/* ---- carom_bench_world.c */

/* The states at the stops along 1,000 steps of the default pipeline. The first steps alone would not do: bodies that have not
 * met yet are cheaper to look at. */
struct bench_path {
	size_t stops;
	carom_body_state *states; /* of all bodies, stop after stop */
};

/* Made on the CPU fallback: the same states whatever is measured. */
carom_status bench_path_create(const struct bench_part *part, uint32_t bodies, struct bench_path *path, carom_error *error);
void bench_path_destroy(struct bench_path *path);

/* A world that is measured. */
struct bench_world {
	const struct bench_subject *subject;
	carom_world *world;
	uint8_t *pixels; /* NULL where nothing is drawn */
};

/* What the options and the subject say, but for the room; fails where the library lacks an alternative they name. */
carom_status bench_world_def(const struct bench_subject *subject, const struct bench_options *options, carom_world_def *def, carom_error *error);
carom_status bench_world_create(const struct bench_subject *subject, const struct bench_options *options, uint32_t bodies, bool profile,
	struct bench_world *world, carom_error *error);
void bench_world_destroy(struct bench_world *world);
carom_status bench_world_restore(struct bench_world *world, const struct bench_path *path, size_t stop, carom_error *error);
/* Does the subject's work that often. */
carom_status bench_world_work(struct bench_world *world, uint64_t times, carom_error *error);

/* ---- carom_bench_print.c */

void bench_print(const struct bench_result *result);
void bench_write_csv_header(FILE *stream);
void bench_write_csv(FILE *stream, const struct bench_result *result);
/* Three significant digits, without an exponent. */
const char *bench_format(double number, char *text, size_t size);
const char *bench_format_ratio(double ratio, char *text, size_t size);
/* A line: "WHAT: its name, compute units, storage" */
void bench_print_device(const char *what, const carom_device_info *device);
/* In quotes, with a comma behind. */
void bench_put_text(FILE *stream, const char *text);
/* "PLATFORM: NAME" */
void bench_put_device(FILE *stream, const carom_device_info *device);
/* "image", "buffer" or "memory" */
const char *bench_storage(const carom_device_info *device);

/* ---- carom_bench_chart.c */

carom_status bench_draw(const struct bench_result *result, const char *path, carom_error *error);
/* The devices, in a line. `fallback`: whether it was measured beside. */
void bench_describe_devices(const carom_device_info *device, const carom_device_info *fallback, char *text, size_t size);

/* ---- carom_bench_scale.c, _tunnel.c, _heap.c, _rays.c: no tables of the paper's */

/* Whether the library has the step that is measured; CAROM_UNKNOWN_NAME if not. */
carom_status bench_scale_check(const struct bench_options *options, carom_error *error);
/* Measures, prints, writes into `csv` and draws into `plot`, both of which may be NULL. */
carom_status bench_scale(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error);
/* The same; these have no chart. */
carom_status bench_tunnel_check(const struct bench_options *options, carom_error *error);
carom_status bench_tunnel(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error);
carom_status bench_heap_check(const struct bench_options *options, carom_error *error);
carom_status bench_heap(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error);
carom_status bench_rays_check(const struct bench_options *options, carom_error *error);
carom_status bench_rays(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error);

#endif
