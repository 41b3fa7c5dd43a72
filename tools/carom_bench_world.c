/* Worlds to measure: bodies as `carom generate` places them, at a fill of 0.25, radius 0.5 m, speed up to 2 m/s.
 * SPDX-License-Identifier: MIT */
#include "carom_bench.h"
#include "carom_placement.h"

#include <stdlib.h>

#define WIDTH 640u
#define HEIGHT 480u
#define STOPS 10
#define BOXES 4

carom_status bench_world_def(const struct bench_subject *subject, const struct bench_options *options, carom_world_def *def, carom_error *error)
{
	struct common_options common = options->common;
	for (size_t k = 0; k < sizeof subject->sets / sizeof *subject->sets && subject->sets[k]; k++) {
		if (common.set_count == MAX_SETS)
			return wrong(error, "--set: more than %d together with those of the table", MAX_SETS);
		common.sets[common.set_count++] = subject->sets[k];
	}
	if (subject->place == PLACE_CPU)
		common.device = "cpu";
	*def = carom_default_world_def();
	def->pipeline.step = "first_impact"; /* the tables are the paper's */
	def->iterations = subject->iterations;
	return apply_options(&common, def, error);
}

/* The paper's walls of polygons [4.2]: static boxes, here around the room, as thick as a body is wide. */
static carom_status add_boxes(carom_world *world, float half, carom_error *error)
{
	const float far = half + 1;
	const carom_vec2 along[] = {{-far, -0.5f}, {far, -0.5f}, {far, 0.5f}, {-far, 0.5f}},
					 across[] = {{-0.5f, -far}, {0.5f, -far}, {0.5f, far}, {-0.5f, far}};
	carom_body_def boxes[BOXES];
	for (size_t k = 0; k < BOXES; k++) {
		const float side = (k & 1 ? 1 : -1) * (half + 0.5f);
		boxes[k] = carom_default_body_def();
		boxes[k].shape = CAROM_POLYGON;
		boxes[k].vertices = k < 2 ? along : across;
		boxes[k].vertex_count = 4;
		boxes[k].position = k < 2 ? (carom_vec2){0, side} : (carom_vec2){side, 0};
		boxes[k].is_static = true;
	}
	return carom_world_add(world, boxes, BOXES, NULL, error);
}

/* So many bodies between their walls, which are four of them if they are boxes. */
static carom_status create(const struct bench_subject *subject, uint32_t count, carom_world_def *def, carom_world **world, carom_error *error)
{
	const uint32_t moving = count - (subject->boxes ? BOXES : 0);
	const struct placement_def placement = {.sides = subject->sides, .count = moving, .fill = 0.25, .speed = 2, .radius = 0.5, .seed = 1};
	carom_body_def *bodies = NULL;
	float half;
	carom_status status = placement_create(&placement, &bodies, &half, error);
	if (status != CAROM_OK)
		return status;
	def->has_room = !subject->boxes;
	def->room_min = (carom_vec2){-half, -half};
	def->room_max = (carom_vec2){half, half};
	status = carom_world_create(def, world, error);
	if (status == CAROM_OK)
		status = carom_world_add(*world, bodies, moving, NULL, error);
	if (status == CAROM_OK && subject->boxes)
		status = add_boxes(*world, half, error);
	free(bodies);
	return status;
}

static carom_status no_memory(carom_error *error)
{
	return out_of_memory(error, "there is not enough memory to measure");
}

/* ---- Paths ---- */

static carom_status walk(carom_world *world, uint32_t bodies, struct bench_path *path, carom_error *error)
{
	carom_status status = carom_world_get_states(world, 0, bodies, path->states, error);
	for (size_t stop = 1; status == CAROM_OK && stop < path->stops; stop++) {
		status = carom_world_step(world, REPETITIONS / path->stops, NULL, error);
		if (status == CAROM_OK)
			status = carom_world_get_states(world, 0, bodies, path->states + stop * bodies, error);
	}
	return status;
}

carom_status bench_path_create(const struct bench_part *part, uint32_t bodies, struct bench_path *path, carom_error *error)
{
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	def.device = "cpu";
	def.pipeline.step = "first_impact";
	path->stops = part->subjects[0].work == WORK_PICTURES ? 1 : STOPS;
	path->states = malloc(path->stops * bodies * sizeof *path->states);
	carom_status status = path->states ? CAROM_OK : no_memory(error);
	if (status == CAROM_OK)
		status = create(&part->subjects[0], bodies, &def, &world, error);
	if (status == CAROM_OK)
		status = walk(world, bodies, path, error);
	carom_world_destroy(world);
	if (status != CAROM_OK)
		bench_path_destroy(path);
	return status;
}

void bench_path_destroy(struct bench_path *path)
{
	free(path->states);
	*path = (struct bench_path){0, NULL};
}

/* ---- Worlds ---- */

carom_status bench_world_create(const struct bench_subject *subject, const struct bench_options *options, uint32_t bodies, bool profile,
	struct bench_world *world, carom_error *error)
{
	carom_world_def def;
	*world = (struct bench_world){.subject = subject};
	carom_status status = bench_world_def(subject, options, &def, error);
	def.profile = profile;
	if (status == CAROM_OK)
		status = create(subject, bodies, &def, &world->world, error);
	if (status == CAROM_OK && subject->work != WORK_STEPS) {
		world->pixels = malloc((size_t)4 * WIDTH * HEIGHT);
		status = world->pixels ? CAROM_OK : no_memory(error);
	}
	if (status != CAROM_OK)
		bench_world_destroy(world);
	return status;
}

void bench_world_destroy(struct bench_world *world)
{
	carom_world_destroy(world->world);
	free(world->pixels);
	*world = (struct bench_world){0};
}

carom_status bench_world_restore(struct bench_world *world, const struct bench_path *path, size_t stop, carom_error *error)
{
	size_t bodies = carom_world_body_count(world->world);
	return carom_world_set_states(world->world, 0, bodies, path->states + stop * bodies, error);
}

static carom_status draw(struct bench_world *world, carom_error *error)
{
	carom_render_def def = carom_default_render_def();
	def.width = WIDTH;
	def.height = HEIGHT;
	return carom_world_render(world->world, &def, world->pixels, error);
}

carom_status bench_world_work(struct bench_world *world, uint64_t times, carom_error *error)
{
	carom_status status = CAROM_OK;
	if (world->subject->work == WORK_STEPS)
		return carom_world_step(world->world, times, NULL, error);
	for (uint64_t k = 0; status == CAROM_OK && k < times; k++) {
		if (world->subject->work == WORK_DRAWN_STEPS)
			status = carom_world_step(world->world, 1, NULL, error);
		if (status == CAROM_OK)
			status = draw(world, error);
	}
	return status;
}
