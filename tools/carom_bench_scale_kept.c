/* What an engine keeps of the physics: the kinetic energy, and that nothing overlaps. All are measured by the same Carom world,
 * which is given their states; it has no room, since a peer's bodies may be out of theirs.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <math.h>
#include <stdlib.h>

/* How far the body reaches in the direction (x, y), from its centre. */
static double reach(const carom_body_info *body, const carom_body_state *state, double x, double y)
{
	if (body->shape == CAROM_CIRCLE)
		return (double)body->radius;
	const double c = cos((double)state->angle), s = sin((double)state->angle);
	double most = -HUGE_VAL;
	for (uint32_t k = 0; k < body->vertex_count; k++) {
		double vx = (double)body->vertices[k].x, vy = (double)body->vertices[k].y;
		double along = x * (c * vx - s * vy) + y * (s * vx + c * vy);
		most = along > most ? along : most; /* GCC 12 for ARM fails at fmax here */
	}
	return most;
}

/* The deepest that a body is in a wall; 0 for none. */
static double overlap_with_walls(const struct peer_scene *scene, const carom_body_state *states)
{
	double deepest = 0;
	for (size_t k = 0; k < scene->count; k++) {
		const carom_body_info *body = &scene->bodies[k];
		const double x = (double)states[k].position.x, y = (double)states[k].position.y;
		deepest = fmax(deepest, x + reach(body, &states[k], 1, 0) - (double)scene->room_max.x);
		deepest = fmax(deepest, y + reach(body, &states[k], 0, 1) - (double)scene->room_max.y);
		deepest = fmax(deepest, (double)scene->room_min.x - x + reach(body, &states[k], -1, 0));
		deepest = fmax(deepest, (double)scene->room_min.y - y + reach(body, &states[k], 0, -1));
	}
	return deepest;
}

carom_status scale_look(struct scale_runner *runner, const struct peer_scene *scene, carom_world *judge, carom_body_state *states, double *overlap,
	double *energy, carom_error *error)
{
	carom_measure measure = {0};
	carom_status status = scale_runner_get_states(runner, scene->count, states, error);
	if (status == CAROM_OK)
		status = carom_world_set_states(judge, 0, scene->count, states, error);
	if (status == CAROM_OK)
		status = carom_world_measure(judge, &measure, error);
	if (status != CAROM_OK)
		return status;
	*energy = measure.kinetic_energy;
	*overlap = fmax(*overlap, fmax(measure.max_penetration, overlap_with_walls(scene, states)));
	return CAROM_OK;
}

static carom_status run(struct scale_runner *runner, const struct peer_scene *scene, carom_world *judge, carom_body_state *states,
	struct scale_kept *kept, carom_error *error)
{
	double first = 0, energy = 0;
	carom_status status = scale_look(runner, scene, judge, states, &kept->overlap, &first, error);
	for (int k = 0; status == CAROM_OK && k < SCALE_KEPT_STEPS; k += SCALE_KEPT_EVERY) {
		double begun = wall_seconds();
		status = scale_runner_step(runner, SCALE_KEPT_EVERY, error);
		kept->seconds += wall_seconds() - begun;
		if (status == CAROM_OK)
			status = scale_look(runner, scene, judge, states, &kept->overlap, &energy, error);
	}
	kept->measured = status == CAROM_OK;
	kept->drift = energy / first - 1;
	return status;
}

carom_status scale_judge_create(const struct scale_start *start, carom_world **judge, carom_error *error)
{
	carom_world_def def = carom_default_world_def();
	def.device = "cpu";
	def.threads = 1;
	carom_status status = carom_world_create(&def, judge, error);
	return status == CAROM_OK ? carom_world_add(*judge, start->defs, start->scene.count, NULL, error) : status;
}

carom_status scale_measure_kept(struct scale_result *result, size_t shape, const struct bench_options *options, carom_error *error)
{
	carom_body_state *states = malloc(result->kept_bodies * sizeof *states);
	if (!states)
		return out_of_memory(error, "there is not enough memory to measure");
	struct scale_start start;
	carom_world *judge = NULL;
	carom_status status = scale_start_create(&scale_shapes[shape], result->kept_bodies, options, 0, 0, &start, error);
	if (status == CAROM_OK)
		status = scale_judge_create(&start, &judge, error);
	for (size_t k = 0; status == CAROM_OK && k < SCALE_ENGINES; k++) {
		struct scale_runner runner;
		if (scale_absence(result, k))
			continue;
		status = scale_runner_create(&scale_engines[k], &start, options, &runner, error);
		if (status == CAROM_OK)
			status = run(&runner, &start.scene, judge, states, &result->kept[shape][k], error);
		scale_runner_destroy(&runner);
	}
	carom_world_destroy(judge);
	scale_start_destroy(&start);
	free(states);
	return status;
}
