/* carom bench tunnel: how many fast bodies pass a thin wall, or one another, in Carom and in other engines.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 60
#define THROWN 16
#define RADIUS 0.05f   /* m */
#define WALL 0.001f    /* m, thickness */
#define HALF_WIDTH 10  /* m, of the room */
#define HALF_HEIGHT 5  /* m */
#define MOST_BODIES 17 /* the wall is the last */
#define SPEEDS 6
#define ENGINES 5
#define BLOCKS 2

static const float speeds[SPEEDS] = {1, 10, 30, 100, 300, 1000};

static const struct {
	struct scale_engine engine;
	bool bullets;
} engines[ENGINES] = {
	{{"Carom, CPU fallback", NULL, PLACE_CPU, 0}, false},
	{{"Carom, OpenCL", NULL, PLACE_OPENCL, 0}, false},
	{{"Box2D", &peer_box2d, PLACE_CHOSEN, 0}, false},
	{{"Box2D, bullets", &peer_box2d, PLACE_CHOSEN, 0}, true},
	{{"Chipmunk", &peer_chipmunk, PLACE_CHOSEN, 0}, false},
};

struct tunnel_cell {
	bool measured;
	size_t passed;
	double drift; /* of the kinetic energy, as a part of it */
	double off;   /* m: the farthest that a body is from its exact place at the end */
	double seconds;
};

struct tunnel_result {
	carom_device_info devices[ENGINES]; /* of Carom's */
	char settings[ENGINES][SCALE_SETTINGS];
	struct tunnel_cell cells[BLOCKS][ENGINES][SPEEDS];
};

/* ---- The bodies ---- */

static carom_body_def circle_at(double x, double y, double speed, double angle)
{
	carom_body_def def = carom_default_body_def();
	def.radius = RADIUS;
	def.position = (carom_vec2){(float)x, (float)y};
	def.velocity = (carom_vec2){(float)(speed * cos(angle)), (float)(speed * sin(angle))};
	return def;
}

/* No two fly alike, so that steps end in different places beside the wall. */
static size_t place_at_wall(carom_body_def *defs, double speed)
{
	static const carom_vec2 corners[] = {{-WALL / 2, -HALF_HEIGHT}, {WALL / 2, -HALF_HEIGHT}, {WALL / 2, HALF_HEIGHT}, {-WALL / 2, HALF_HEIGHT}};
	for (int k = 0; k < THROWN; k++)
		defs[k] = circle_at(-0.3 - 0.0371 * k, 0.6 * k - 4.53, speed, 0.01 * (k * 5 % THROWN - 7));
	defs[THROWN] = carom_default_body_def();
	defs[THROWN].shape = CAROM_POLYGON;
	defs[THROWN].vertices = corners;
	defs[THROWN].vertex_count = 4;
	defs[THROWN].is_static = true;
	return THROWN + 1;
}

/* Each pair in a row of its own. */
static size_t place_pairs(carom_body_def *defs, double speed)
{
	for (int k = 0; k < THROWN; k += 2) {
		const double y = 0.6 * k - 4.2, x = 0.3 + 0.0173 * k;
		defs[k] = circle_at(-x, y, speed, 0);
		defs[k + 1] = circle_at(0.9 * x, y, speed, 0);
		defs[k + 1].velocity.x *= -1;
	}
	return THROWN;
}

/* ---- Who has passed ---- */

/* A number that is none has passed, too. */
static void look_at_wall(const carom_body_state *states, bool *passed)
{
	for (size_t k = 0; k < THROWN; k++) {
		const float x = states[k].position.x, y = states[k].position.y;
		passed[k] |= !(x > -HALF_WIDTH && x < 0 && y > -HALF_HEIGHT && y < HALF_HEIGHT);
	}
}

static void look_at_pairs(const carom_body_state *states, bool *passed)
{
	for (size_t k = 0; k < THROWN / 2; k++)
		passed[k] |= !(states[2 * k].position.x < states[2 * k + 1].position.x);
}

/* Where a point is that flew on from `from` between two walls. */
static double fold(double from, double way, double least, double most)
{
	const double width = most - least, at = fmod(from - least + way, 2 * width), ahead = at < 0 ? at + 2 * width : at;
	return least + (ahead <= width ? ahead : 2 * width - ahead);
}

/* Equal circles swap their velocities. So, with their diameter taken out of the line, they are points that fly through one another. */
static double off_the_pairs_places(const struct peer_scene *scene, const carom_body_state *states)
{
	const double time = STEPS * (double)scene->time_step, radius = (double)RADIUS;
	double most = 0;
	for (size_t k = 0; k < THROWN; k += 2) {
		double ends[2];
		for (size_t i = 0; i < 2; i++) {
			const carom_body_state *from = &scene->states[k + i];
			ends[i] = fold((double)from->position.x - 2 * radius * (double)i, (double)from->velocity.x * time, radius - HALF_WIDTH,
				HALF_WIDTH - 3 * radius);
		}
		most = fmax(most, fabs((double)states[k].position.x - fmin(ends[0], ends[1])));
		most = fmax(most, fabs((double)states[k + 1].position.x - fmax(ends[0], ends[1]) - 2 * radius));
	}
	return most;
}

static const struct {
	const char *name, *title;
	const char *what;                                    /* is counted */
	size_t (*place)(carom_body_def *defs, double speed); /* answers how many bodies there are */
	void (*look)(const carom_body_state *states, bool *passed);
	double (*off)(const struct peer_scene *scene, const carom_body_state *states); /* NULL where the exact places are not known */
} blocks[BLOCKS] = {
	{"wall", "thrown at a wall 1 mm thick", "passed, of 16", place_at_wall, look_at_wall, NULL},
	{"pairs", "pairs, each two head-on at that speed", "passed, of 8 pairs", place_pairs, look_at_pairs, off_the_pairs_places},
};

/* ---- Measuring ---- */

static carom_status start_create(size_t block, double speed, const struct bench_options *options, struct scale_start *start, carom_error *error)
{
	*start = (struct scale_start){.defs = malloc(MOST_BODIES * sizeof *start->defs)};
	if (!start->defs)
		return out_of_memory(error, "there is not enough memory for the bodies");
	start->scene.count = blocks[block].place(start->defs, speed);
	start->scene.restitution = 1;
	start->scene.room_min = (carom_vec2){-HALF_WIDTH, -HALF_HEIGHT};
	start->scene.room_max = (carom_vec2){HALF_WIDTH, HALF_HEIGHT};
	return scale_start_fill(start, options, error);
}

static double kinetic_energy(const struct peer_scene *scene, const carom_body_state *states)
{
	double sum = 0;
	for (size_t k = 0; k < scene->count; k++) {
		const double vx = (double)states[k].velocity.x, vy = (double)states[k].velocity.y, w = (double)states[k].angular_velocity;
		if (!scene->bodies[k].is_static)
			sum += 0.5 * ((double)scene->bodies[k].mass * (vx * vx + vy * vy) + (double)scene->bodies[k].inertia * w * w);
	}
	return sum;
}

static carom_status run(struct scale_runner *runner, const struct peer_scene *scene, size_t block, struct tunnel_cell *cell, carom_error *error)
{
	carom_body_state states[MOST_BODIES];
	bool passed[THROWN] = {false};
	carom_status status = CAROM_OK;
	for (int step = 0; status == CAROM_OK && step < STEPS; step++) {
		const double begun = wall_seconds();
		status = scale_runner_step(runner, 1, error);
		cell->seconds += wall_seconds() - begun;
		if (status == CAROM_OK)
			status = scale_runner_get_states(runner, scene->count, states, error);
		if (status == CAROM_OK)
			blocks[block].look(states, passed);
	}
	if (status != CAROM_OK)
		return status;
	cell->measured = true;
	cell->drift = kinetic_energy(scene, states) / kinetic_energy(scene, scene->states) - 1;
	cell->off = blocks[block].off ? blocks[block].off(scene, states) : 0;
	for (size_t k = 0; k < THROWN; k++)
		cell->passed += passed[k];
	return CAROM_OK;
}

static carom_status measure_cell(struct tunnel_result *result, size_t block, size_t engine, size_t speed, struct scale_start *start,
	const struct bench_options *options, carom_error *error)
{
	struct scale_runner runner;
	if (engines[engine].engine.peer && !engines[engine].engine.peer->create)
		return CAROM_OK;
	start->scene.bullets = engines[engine].bullets;
	carom_status status = scale_runner_create(&engines[engine].engine, start, options, &runner, error);
	if (status != CAROM_OK)
		return status;
	if (scale_runner_describe(&runner, &result->devices[engine], result->settings[engine]))
		status = run(&runner, &start->scene, block, &result->cells[block][engine][speed], error);
	scale_runner_destroy(&runner);
	return status == CAROM_OK ? fail_interrupted(error) : status;
}

static carom_status measure(const struct bench_options *options, struct tunnel_result *result, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (size_t block = 0; block < BLOCKS; block++) {
		for (size_t speed = 0; status == CAROM_OK && speed < SPEEDS; speed++) {
			struct scale_start start;
			status = start_create(block, (double)speeds[speed], options, &start, error);
			for (size_t engine = 0; status == CAROM_OK && engine < ENGINES; engine++)
				status = measure_cell(result, block, engine, speed, &start, options, error);
			scale_start_destroy(&start);
		}
	}
	return status;
}

/* ---- Text ---- */

static void print_head(const struct tunnel_result *result)
{
	printf("tunnel: circles of radius 0.05 m, %d steps of 1/60 s, step=events\n", STEPS);
	bench_print_device("CPU fallback", &result->devices[0]);
	if (result->devices[1].is_opencl)
		bench_print_device("device", &result->devices[1]);
	scale_print_peers();
}

enum figure { PASSED, ENERGY, OFF };

static void print_figure(const struct tunnel_cell *cell, enum figure figure)
{
	if (figure == PASSED) {
		printf("%12zu", cell->passed);
	} else if (figure == ENERGY) {
		printf("%+10.2g %%", 100 * cell->drift);
	} else {
		printf("%10.2g m", cell->off);
	}
}

static void print_figures(const struct tunnel_result *result, size_t block, enum figure figure)
{
	const char *const heads[] = {blocks[block].what, "kinetic energy, by", "off the exact place"};
	char text[32];
	printf("%-22s", heads[figure]);
	for (size_t k = 0; k < SPEEDS; k++) {
		snprintf(text, sizeof text, "%g m/s", (double)speeds[k]);
		printf("%12s", text);
	}
	putchar('\n');
	for (size_t engine = 0; engine < ENGINES; engine++) {
		const struct tunnel_cell *cells = result->cells[block][engine];
		if (!cells[0].measured)
			continue;
		printf("  %-20s", engines[engine].engine.label);
		for (size_t k = 0; k < SPEEDS; k++)
			print_figure(&cells[k], figure);
		putchar('\n');
	}
}

static void print(const struct tunnel_result *result)
{
	print_head(result);
	for (size_t block = 0; block < BLOCKS; block++) {
		printf("\n%s\n", blocks[block].title);
		print_figures(result, block, PASSED);
		print_figures(result, block, ENERGY);
		if (blocks[block].off)
			print_figures(result, block, OFF);
	}
	printf("\nThe room is %d x %d m, without gravity; restitution 1, no friction. The wall stands in its middle, from the floor to\n"
		   "the ceiling; the circles start on its left. A pair flies along a line of its own.\n"
		   "passed: those whose centre was beyond the wall, or out of the room, at the end of any step; pairs whose order along\n"
		   "their line has changed.\n"
		   "off: how far the worst of all is from where it ought to be at the end, which is known where all fly along lines.\n"
		   "bullets: with Box2D's continuous collision between moving bodies, which is off by itself; against static ones it is\n"
		   "on. Chipmunk has none. Box2D lets no body move more than 2 m in a step, and takes the rest of its speed.\n",
		2 * HALF_WIDTH, 2 * HALF_HEIGHT);
}

/* ---- CSV ---- */

static void write_cell(FILE *stream, const struct tunnel_result *result, size_t block, size_t engine, size_t speed)
{
	const struct tunnel_cell *cell = &result->cells[block][engine][speed];
	char off[32] = "";
	if (!cell->measured)
		return;
	if (blocks[block].off)
		snprintf(off, sizeof off, "%.9g", cell->off);
	fprintf(stream, "%s,tunnel,%s,", carom_version(), blocks[block].name);
	scale_put_engine(stream, &engines[engine].engine, &result->devices[engine], THROWN, "circle", result->settings[engine]);
	fprintf(stream, "1,%d,0,%.9g,%.9g,,%.9g,,,%g,%zu,%s,\n", STEPS, cell->seconds, REPETITIONS * cell->seconds / STEPS, cell->drift,
		(double)speeds[speed], cell->passed, off);
}

static void write_csv(FILE *stream, const struct tunnel_result *result)
{
	for (size_t block = 0; block < BLOCKS; block++) {
		for (size_t engine = 0; engine < ENGINES; engine++) {
			for (size_t speed = 0; speed < SPEEDS; speed++)
				write_cell(stream, result, block, engine, speed);
		}
	}
}

/* ---- The call ---- */

carom_status bench_tunnel_check(const struct bench_options *options, carom_error *error)
{
	carom_world_def def;
	carom_status status = scale_world_def(options, PLACE_CHOSEN, &def, error);
	if (status != CAROM_OK)
		return status;
	if (strcmp(carom_pipeline_get(&def.pipeline, "step"), "events") != 0)
		return wrong(error, "--set: found step=%s; allowed: step=events, whose steps all last 1/60 s", def.pipeline.step);
	return options->plot ? wrong(error, "--plot: it has no chart") : CAROM_OK;
}

carom_status bench_tunnel(const struct bench_options *options, FILE *csv, const char *plot, carom_error *error)
{
	struct tunnel_result *result = calloc(1, sizeof *result);
	(void)plot;
	if (!result)
		return out_of_memory(error, "there is not enough memory for the figures");
	carom_status status = measure(options, result, error);
	if (status == CAROM_OK) {
		print(result);
		fflush(stdout);
		if (csv)
			write_csv(csv, result);
	}
	free(result);
	return status;
}
