/* What the files of `carom run` share.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_RUN_H
#define CAROM_RUN_H

#include "carom_tool.h"

struct run_options {
	struct common_options common;
	uint64_t steps;                                         /* NO_STEPS if not given */
	double time;                                            /* s; below 0 if not given */
	const char *out, *png, *stats, *hits, *states, *frames; /* paths; NULL if not asked for */
	double fps;                                             /* 0 if not given */
	bool hash;
	uint32_t size[2]; /* pixels; 0 if not given */
	bool has_inset;
	carom_inset inset;
};

#define NO_STEPS UINT64_MAX

/* The bar on a terminal. */
struct progress {
	bool shown; /* stderr is a terminal, and nobody said --quiet */
	bool drawn;
	double begun, last; /* wall_seconds */
};

struct run {
	const struct run_options *options;
	bool has_camera; /* of the scene */
	carom_camera camera;
	carom_world *world;
	carom_render_def render;
	struct film *film;                  /* NULL if no frames are asked for */
	struct states *states;              /* NULL if no states are asked for */
	uint8_t *pixels;                    /* NULL if no picture of the end is asked for */
	carom_file *stats_file, *hits_file; /* NULL if no such table is asked for */
	FILE *stats, *hits;
	uint64_t frames_done; /* drawn, or their states taken, and when the simulation has ended, written */
	carom_report total;
	bool interrupted;
	double seconds; /* of wall time spent in steps and what belongs to them */
	struct progress progress;
};

/* ---- carom_simulate.c */

/* All the steps that were asked for, with their frames and rows. On failure or interruption `run` tells how far it came. */
carom_status simulate(struct run *run, carom_error *error);

/* ---- carom_output.c */

/* Memory for a picture, to be given to free. */
carom_status allocate_pixels(const carom_render_def *render, uint8_t **pixels, carom_error *error);
/* Fails where an output could not be written in the end, before hours are spent on it, and opens the tables. */
carom_status prepare_outputs(struct run *run, carom_error *error);
/* The camera of a film, which the world decides where the scene does not. Says so where the enlarged part is not in the picture. */
carom_status prepare_camera(struct run *run, carom_error *error);
/* Simulated seconds at which the next frame is due; infinite if neither frames nor states are asked for. */
double next_frame(const struct run *run);
carom_status write_frame(struct run *run, carom_error *error);
/* A row for the step just done. */
carom_status write_row(struct run *run, const carom_report *step, carom_error *error);
/* A row for each hit of the last call. */
carom_status write_hits(struct run *run, carom_error *error);
/* The last state, the picture, the tables. Tries each even if one fails; the exit code. */
int write_outputs(struct run *run);
void destroy_outputs(struct run *run);

/* ---- carom_film.c */

/* `folder` and `render` stay the caller's. */
carom_status film_create(const char *folder, const carom_render_def *render, struct film **film, carom_error *error);
/* Where a frame goes. */
carom_status film_path(const struct film *film, uint64_t number, char *path, size_t size, carom_error *error);
/* Draws the next frame, which is then written while the caller goes on; fails as the first one did that could not be written. */
carom_status film_add(struct film *film, carom_world *world, carom_error *error);
/* Waits until all are written; *length: so many are, from the first on. Fails as film_add. */
carom_status film_finish(struct film *film, uint64_t *length, carom_error *error);
void film_destroy(struct film *film);

/* ---- carom_states.c */

/* A name that ends in .npy is an array, any other one a table. */
carom_status states_create(const char *path, struct states **states, carom_error *error);
/* Where all are now; after CAROM_IO, of what can't be written, it is only to be destroyed. */
carom_status states_add(struct states *states, carom_world *world, carom_error *error);
/* Releases it, also on failure; then what was there before stays. */
carom_status states_commit(struct states *states, carom_error *error);
void states_destroy(struct states *states);

/* ---- carom_progress.c */

void begin_progress(struct progress *progress, bool quiet);
/* Draws the bar if it is time to. `done` is the part done, 0..1. */
void show_progress(struct progress *progress, double done, uint64_t steps, double simulated);
void end_progress(struct progress *progress);

#endif
