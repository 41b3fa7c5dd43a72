/* The bodies of `carom bench scale`, and the engines that are given them.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <stdlib.h>

#define CHUNK 10 /* steps between two looks at the clock */

static carom_status no_memory(const char *what, carom_error *error)
{
	return out_of_memory(error, "%s: there is not enough memory for so many bodies", what);
}

/* ---- Carom's worlds ---- */

carom_status scale_world_def(const struct bench_options *options, enum bench_place place, carom_world_def *def, carom_error *error)
{
	struct common_options common = options->common;
	if (place == PLACE_CPU)
		common.device = "cpu";
	*def = carom_default_world_def();
	carom_status found = carom_pipeline_set(&def->pipeline, "step", "events", error);
	carom_status status = apply_options(&common, def, error); /* --set step=... goes before the table's own */
	return status == CAROM_OK && !def->pipeline.step ? found : status;
}

static carom_status create_world(const struct scale_start *start, const struct bench_options *options, enum bench_place place, carom_world **world,
	carom_error *error)
{
	carom_world_def def;
	carom_status status = scale_world_def(options, place, &def, error);
	def.has_room = true;
	def.room_min = start->scene.room_min;
	def.room_max = start->scene.room_max;
	def.gravity = start->scene.gravity;
	def.restitution = start->scene.restitution;
	def.friction = start->scene.friction;
	if (status == CAROM_OK)
		status = carom_world_create(&def, world, error);
	if (status == CAROM_OK)
		status = carom_world_add(*world, start->defs, start->scene.count, NULL, error);
	return status;
}

/* ---- The start ---- */

carom_status scale_start_place(struct scale_start *start, const struct placement_def *placement, carom_error *error)
{
	float half;
	*start = (struct scale_start){0};
	carom_status status = placement_create(placement, &start->defs, &half, error);
	if (status != CAROM_OK)
		return status;
	start->scene.count = placement->count;
	start->scene.restitution = 1;
	start->scene.room_min = (carom_vec2){-half, -half};
	start->scene.room_max = (carom_vec2){half, half};
	return CAROM_OK;
}

static carom_status open_world(struct scale_start *start, const struct bench_options *options, carom_error *error)
{
	start->scene.time_step = carom_default_world_def().time_step;
	start->bodies = malloc(start->scene.count * sizeof *start->bodies);
	start->states = malloc(start->scene.count * sizeof *start->states);
	start->scene.bodies = start->bodies;
	start->scene.states = start->states;
	if (!start->bodies || !start->states)
		return no_memory("the scene", error);
	return create_world(start, options, PLACE_CPU, &start->world, error);
}

static carom_status walk(struct scale_start *start, uint64_t most_steps, double seconds, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (double begun = wall_seconds(); status == CAROM_OK && start->steps < most_steps && wall_seconds() - begun < seconds;) {
		uint64_t steps = most_steps - start->steps < CHUNK ? most_steps - start->steps : CHUNK;
		status = carom_world_step(start->world, steps, NULL, error);
		start->steps += steps;
	}
	return status;
}

/* Reads what the world has, if all went well. */
static carom_status finish(struct scale_start *start, carom_status status, carom_error *error)
{
	if (status == CAROM_OK)
		status = carom_world_get_states(start->world, 0, start->scene.count, start->states, error);
	for (uint32_t k = 0; status == CAROM_OK && k < start->scene.count; k++)
		status = carom_world_get_body(start->world, k, &start->bodies[k], error);
	if (status != CAROM_OK)
		scale_start_destroy(start);
	return status;
}

carom_status scale_start_create(const struct scale_shape *shape, uint32_t bodies, const struct bench_options *options, uint64_t most_steps,
	double seconds, struct scale_start *start, carom_error *error)
{
	const struct placement_def placement = {.sides = shape->sides, .count = bodies, .fill = 0.25, .speed = 5, .radius = 0.5, .seed = 1};
	carom_status status = scale_start_place(start, &placement, error);
	if (status == CAROM_OK)
		status = open_world(start, options, error);
	if (status == CAROM_OK)
		status = walk(start, most_steps, seconds, error);
	return finish(start, status, error);
}

carom_status scale_start_fill(struct scale_start *start, const struct bench_options *options, carom_error *error)
{
	return finish(start, open_world(start, options, error), error);
}

void scale_start_destroy(struct scale_start *start)
{
	carom_world_destroy(start->world);
	free(start->defs);
	free(start->bodies);
	free(start->states);
	*start = (struct scale_start){0};
}

/* ---- Runners ---- */

carom_status scale_runner_create(const struct scale_engine *engine, const struct scale_start *start, const struct bench_options *options,
	struct scale_runner *runner, carom_error *error)
{
	carom_status status;
	*runner = (struct scale_runner){.engine = engine};
	if (engine->peer) {
		runner->peer = engine->peer->create(&start->scene);
		return runner->peer ? CAROM_OK : no_memory(engine->label, error);
	}
	status = create_world(start, options, engine->place, &runner->world, error);
	if (status == CAROM_OK)
		status = carom_world_set_states(runner->world, 0, start->scene.count, start->states, error);
	if (status != CAROM_OK)
		scale_runner_destroy(runner);
	return status;
}

void scale_runner_destroy(struct scale_runner *runner)
{
	carom_world_destroy(runner->world);
	if (runner->peer)
		runner->engine->peer->destroy(runner->peer);
	free(runner->pixels);
	*runner = (struct scale_runner){0};
}

carom_status scale_runner_step(struct scale_runner *runner, uint64_t steps, carom_error *error)
{
	carom_report report = {0};
	if (runner->world) {
		carom_status status = carom_world_step(runner->world, steps, &report, error);
		runner->hits += report.hits;
		return status;
	}
	for (uint64_t k = 0; k < steps; k++)
		runner->engine->peer->step(runner->peer);
	return CAROM_OK;
}

carom_status scale_runner_draw(struct scale_runner *runner, carom_error *error)
{
	carom_render_def def = carom_default_render_def();
	if (!runner->world)
		return CAROM_OK;
	def.width = SCALE_WIDTH;
	def.height = SCALE_HEIGHT;
	if (!runner->pixels)
		runner->pixels = malloc((size_t)4 * SCALE_WIDTH * SCALE_HEIGHT);
	if (!runner->pixels)
		return no_memory("the picture", error);
	return carom_world_render(runner->world, &def, runner->pixels, error);
}

bool scale_runner_describe(const struct scale_runner *runner, carom_device_info *device, char settings[SCALE_SETTINGS])
{
	if (!runner->world) {
		snprintf(settings, SCALE_SETTINGS, "%s", runner->engine->peer->settings);
		return true;
	}
	if (carom_world_get_device(runner->world, device, NULL) != CAROM_OK)
		return false;
	bench_describe_pipeline(runner->world, settings, SCALE_SETTINGS);
	return runner->engine->place != PLACE_OPENCL || device->is_opencl;
}

carom_status scale_runner_get_states(struct scale_runner *runner, size_t count, carom_body_state *states, carom_error *error)
{
	if (runner->world)
		return carom_world_get_states(runner->world, 0, count, states, error);
	runner->engine->peer->get_states(runner->peer, states);
	return CAROM_OK;
}
