/* What the files of `carom bench scale` share: engines beside each other on the same bodies, over sizes. `carom bench tunnel` and `heap` run them, too.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_BENCH_SCALE_H
#define CAROM_BENCH_SCALE_H

#include "carom_bench.h"
#include "carom_peer.h"
#include "carom_placement.h"

#define SCALE_SECONDS 0.2 /* of a batch, where --seconds is not given */
#define SCALE_WARM 100    /* steps before anything is measured */
#define SCALE_SLOW 1.0    /* s: an engine whose step takes longer is left out of the larger sizes */
#define SCALE_KEPT 1024   /* bodies of which it is told what an engine keeps */
#define SCALE_KEPT_STEPS 1000
#define SCALE_KEPT_EVERY 10  /* steps between two looks at the overlap */
#define SCALE_FLOOR_BYTES 64 /* of a body and step: 32 of state read, 32 written */
#define SCALE_WIDTH 1920     /* pixels of a picture */
#define SCALE_HEIGHT 1080
#define SCALE_SHAPES 2
#define SCALE_ENGINES 4
#define SCALE_SETTINGS 512

struct scale_engine {
	const char *label;
	const struct peer *peer; /* NULL: Carom */
	enum bench_place place;  /* of Carom */
	int color;               /* in the chart */
};

struct scale_shape {
	const char *title; /* "circles" */
	const char *name;  /* "circle" */
	uint32_t sides;    /* 0 for circles */
};

extern const struct scale_engine scale_engines[SCALE_ENGINES];
extern const struct scale_shape scale_shapes[SCALE_SHAPES];

/* ---- What was measured */

struct scale_cell {
	uint64_t steps;           /* of a batch; 0: not measured */
	double seconds[MAX_RUNS]; /* of a batch */
	double picture[MAX_RUNS]; /* s: of one, behind each batch; 0 where nothing is drawn */
	char why[256];            /* it was not measured */
};

/* What an engine keeps of the physics. */
struct scale_kept {
	bool measured;
	double drift;   /* of the kinetic energy, as a part of it */
	double overlap; /* m, the deepest that was seen, of two bodies or of a body and a wall */
	double seconds; /* of all steps */
};

struct scale_row {
	uint32_t bodies;
	uint64_t warm; /* steps before */
	struct scale_cell cells[SCALE_ENGINES];
};

struct scale_result {
	size_t runs, row_count;
	carom_device_info device, fallback;
	char step[64];                                /* the alternative that Carom's step is */
	char settings[SCALE_ENGINES][SCALE_SETTINGS]; /* Carom's "slot=alternative" of all slots, or what the peer runs with */
	size_t copy_bytes;                            /* copied to measure the memory */
	unsigned copy_threads;
	double copy_rate; /* bytes/s, read and written together; 0: there was no memory for it */
	uint32_t kept_bodies;
	struct scale_kept kept[SCALE_SHAPES][SCALE_ENGINES];
	struct scale_row rows[SCALE_SHAPES][MAX_SIZES];
};

/* s a step */
struct bench_spread scale_spread(const struct scale_result *result, const struct scale_cell *cell);
/* Millions a second; 0 where nothing was measured. */
double scale_rate(const struct scale_result *result, const struct scale_row *row, size_t engine);

/* ---- carom_bench_scale_world.c */

/* Bodies as every engine gets them. */
struct scale_start {
	carom_world *world; /* on the CPU fallback; it owns what the scene points to of the bodies */
	carom_body_def *defs;
	carom_body_info *bodies;
	carom_body_state *states;
	struct peer_scene scene;
	uint64_t steps; /* done before */
};

/* `most_steps` are done on the CPU fallback, but no more once they have taken `seconds`. */
carom_status scale_start_create(const struct scale_shape *shape, uint32_t bodies, const struct bench_options *options, uint64_t most_steps,
	double seconds, struct scale_start *start, carom_error *error);
/* Sets its bodies, their count and their room; restitution 1, without gravity. What follows is scale_start_fill. */
carom_status scale_start_place(struct scale_start *start, const struct placement_def *placement, carom_error *error);
/* The same of bodies at hand: `defs`, which become the start's, and the scene's count, room, gravity and restitution are set, all else is zero. */
carom_status scale_start_fill(struct scale_start *start, const struct bench_options *options, carom_error *error);
void scale_start_destroy(struct scale_start *start);
/* Carom's world as the options say, but for its room, gravity and restitution. */
carom_status scale_world_def(const struct bench_options *options, enum bench_place place, carom_world_def *def, carom_error *error);

/* An engine with its bodies. */
struct scale_runner {
	const struct scale_engine *engine;
	carom_world *world; /* Carom's, or */
	void *peer;         /* the peer's; NULL both: there is none */
	uint8_t *pixels;    /* of the last picture; NULL before the first */
	uint64_t hits;      /* of Carom, so far */
};

carom_status scale_runner_create(const struct scale_engine *engine, const struct scale_start *start, const struct bench_options *options,
	struct scale_runner *runner, carom_error *error);
void scale_runner_destroy(struct scale_runner *runner);
carom_status scale_runner_step(struct scale_runner *runner, uint64_t steps, carom_error *error);
/* Draws its bodies; of a peer nothing. */
carom_status scale_runner_draw(struct scale_runner *runner, carom_error *error);
/* What it runs with, and on which device, if it is Carom; false if it was to be an OpenCL device, and is none. */
bool scale_runner_describe(const struct scale_runner *runner, carom_device_info *device, char settings[SCALE_SETTINGS]);
carom_status scale_runner_get_states(struct scale_runner *runner, size_t count, carom_body_state *states, carom_error *error);

/* ---- carom_bench_scale_kept.c */

/* The same bodies on the CPU fallback, without a room, to measure states by. */
carom_status scale_judge_create(const struct scale_start *start, carom_world **judge, carom_error *error);
/* Looks at the runner's bodies; answers their kinetic energy, J, and raises the deepest overlap to what is seen, also with walls. `states` has room
 * for all. */
carom_status scale_look(struct scale_runner *runner, const struct peer_scene *scene, carom_world *judge, carom_body_state *states, double *overlap,
	double *energy, carom_error *error);
carom_status scale_measure_kept(struct scale_result *result, size_t shape, const struct bench_options *options, carom_error *error);

/* ---- carom_bench_scale_copy.c */

/* Raises the result's copy_rate to what arrays of `bytes`, copied by `threads`, reach at best; notes how it was measured. */
void scale_measure_copy(struct scale_result *result, size_t bytes, unsigned threads);

/* ---- carom_bench_scale_measure.c */

/* Fills in *result, which is all zeros. */
carom_status scale_measure(const struct bench_options *options, struct scale_result *result, carom_error *error);
/* Why the engine can't run here at all; NULL if it can. */
const char *scale_absence(const struct scale_result *result, size_t engine);

/* ---- carom_bench_scale_print.c */

/* A line each: version and settings, or that it is not in this build. */
void scale_print_peers(void);
/* From the device on, up to the run's number. */
void scale_put_engine(FILE *stream, const struct scale_engine *engine, const carom_device_info *device, uint32_t bodies, const char *shape,
	const char *settings);
void scale_print(const struct scale_result *result);
void scale_write_csv(FILE *stream, const struct scale_result *result);
carom_status scale_draw(const struct scale_result *result, const char *path, carom_error *error);

#endif
