/* SPDX-License-Identifier: MIT */
#include "runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

carom_world_def runs_def(void)
{
	carom_world_def def = carom_default_world_def();
	carom_error error;
	scenery_check(carom_pipeline_set(&def.pipeline, "step", "events", &error), &error);
	return def;
}

carom_world_def runs_room(float half_width, float half_height)
{
	carom_world_def def = runs_def();
	def.has_room = true;
	def.room_min = (carom_vec2){-half_width, -half_height};
	def.room_max = (carom_vec2){half_width, half_height};
	return def;
}

carom_world_def runs_resting(const char *step, float half_width, float height)
{
	carom_world_def def = runs_room(half_width, 1.0f);
	carom_error error;
	scenery_check(carom_pipeline_set(&def.pipeline, "step", step, &error), &error);
	def.gravity.y = -RUNS_GRAVITY;
	def.restitution = 0.3f;
	def.room_min.y = 0.0f;
	def.room_max.y = height;
	return def;
}

carom_world *runs_world(const carom_world_def *def, const scenery_device *device, const carom_body_def *bodies, size_t count)
{
	carom_world *world = scenery_world(def, device);
	carom_error error;
	if (world && count > 0)
		scenery_check(carom_world_add(world, bodies, count, NULL, &error), &error);
	return world;
}

carom_scene *runs_read(const char *path)
{
	carom_scene *scene;
	carom_error error;
	scenery_check(carom_scene_read(path, &scene, &error), &error);
	return scene;
}

carom_world *runs_scene(carom_scene *scene, const scenery_device *device)
{
	carom_world *world = runs_world(&scene->world, device, scene->bodies, scene->body_count);
	carom_error error;
	if (world && strcmp(carom_pipeline_get(&scene->world.pipeline, "step"), "contacts") == 0)
		scenery_check(carom_world_set_joints(world, scene->joint_count, scene->joints, &error), &error);
	carom_scene_destroy(scene);
	return world;
}

carom_world *runs_crowd(const scenery_device *device, const char *step, bool filtered)
{
	carom_world_def def = runs_room(45.0f, 15.0f);
	carom_body_def bodies[RUNS_CROWD];
	scenery_random random = {77};
	scenery_bodies(&random, SCENERY_MIXED, RUNS_CROWD, 1.3f, 5.0f, bodies);
	scenery_drive(&random, RUNS_CROWD, 2.0f, bodies);
	for (int i = 0; i < RUNS_CROWD; i++) {
		bodies[i].position.x -= 20.0f;
		if (filtered && i % 2)
			scenery_filter(&random, &bodies[i]);
	}
	def.gravity = (carom_vec2){0.0f, -9.81f};
	def.restitution = 0.5f;
	def.friction = 0.3f;
	def.profile = true;
	def.pipeline.step = step;
	return runs_world(&def, device, bodies, RUNS_CROWD);
}

queue *runs_queue(const carom_world_def *def, const carom_body_def *bodies, size_t count)
{
	carom_world_def numbers = *def;
	numbers.pipeline.step = NULL; /* it is only asked for its bodies */
	carom_world *world = runs_world(&numbers, &scenery_devices[0], bodies, count);
	queue *q = queue_of(world);
	carom_world_destroy(world);
	return q;
}

void runs_load_anew(carom_world *world)
{
	const carom_world_def *def = carom_world_get_def(world);
	const float x = def->has_room ? 0.5f * (def->room_min.x + def->room_max.x) : 0.0f;
	const float y = def->has_room ? 0.5f * (def->room_min.y + def->room_max.y) : 0.0f;
	const carom_body_def one = scenery_circle(x, y, 0.0f, 0.0f, 0.5f);
	const size_t many = carom_world_body_count(world) / 4 + 1; /* with few it would go on */
	uint32_t *indices = malloc(many * sizeof *indices), first;
	carom_body_def *bodies = malloc(many * sizeof *bodies);
	carom_error error;
	assert_true(indices && bodies);
	for (size_t i = 0; i < many; i++)
		bodies[i] = one;
	scenery_check(carom_world_add(world, bodies, many, &first, &error), &error);
	for (uint32_t i = 0; i < many; i++)
		indices[i] = first + i;
	scenery_check(carom_world_remove(world, indices, many, &error), &error);
	free(bodies);
	free(indices);
}

carom_report runs_step(carom_world *world, uint64_t steps)
{
	carom_report report;
	carom_error error;
	scenery_check(carom_world_step(world, steps, &report, &error), &error);
	return report;
}

carom_report runs_advance(carom_world *world, double seconds)
{
	carom_report report;
	carom_error error;
	scenery_check(carom_world_advance(world, seconds, &report, &error), &error);
	return report;
}

carom_body_state runs_state(carom_world *world, uint32_t index)
{
	carom_body_state state;
	carom_error error;
	scenery_check(carom_world_get_states(world, index, 1, &state, &error), &error);
	return state;
}

carom_snapshot *runs_snapshot(carom_world *world)
{
	carom_snapshot *snapshot = NULL;
	carom_error error = {0};
	scenery_check(carom_snapshot_create(world, &snapshot, &error), &error);
	return snapshot;
}

carom_measure runs_measure(carom_world *world)
{
	carom_measure measure;
	carom_error error;
	scenery_check(carom_world_measure(world, &measure, &error), &error);
	return measure;
}

double runs_energy(carom_world *world)
{
	const carom_measure measure = runs_measure(world);
	return measure.kinetic_energy + measure.potential_energy;
}

uint64_t runs_hash(carom_world *world)
{
	uint64_t hash;
	carom_error error;
	scenery_check(carom_world_hash(world, &hash, &error), &error);
	return hash;
}

void runs_same_hits(carom_hit **first, size_t *first_count, carom_hit *hits, size_t count)
{
	if (!*first) {
		*first = hits;
		*first_count = count;
		return;
	}
	assert_int_equal(count, *first_count);
	for (size_t k = 0; k < count; k++)
		assert_true(hits[k].time == (*first)[k].time && runs_same_hit(&hits[k], &(*first)[k]));
	free(hits);
}

uint64_t runs_hash_after(carom_world *world, uint64_t steps, uint64_t calls)
{
	for (uint64_t i = 0; i < calls; i++)
		runs_step(world, steps / calls);
	const uint64_t hash = runs_hash(world);
	carom_world_destroy(world);
	return hash;
}

carom_hit *runs_hits(carom_world *world, size_t *count)
{
	carom_error error;
	*count = carom_world_hit_count(world);
	carom_hit *hits = calloc(*count + 1, sizeof *hits);
	assert_non_null(hits);
	scenery_check(carom_world_get_hits(world, 0, *count, hits, &error), &error);
	return hits;
}

bool runs_same_hit(const carom_hit *a, const carom_hit *b)
{
	return a->body == b->body && a->other == b->other && memcmp(&a->point, &b->point, sizeof a->point) == 0
		&& memcmp(&a->normal, &b->normal, sizeof a->normal) == 0 && memcmp(&a->impulse, &b->impulse, sizeof a->impulse) == 0
		&& a->is_ruled == b->is_ruled;
}

void runs_near(double found, double expected, double tolerance)
{
	if (!(fabs(found - expected) <= tolerance))
		fail_msg("found %.9g, expected %.9g within %.2g", found, expected, tolerance);
}

void runs_same_hash(uint64_t *first, uint64_t hash, const scenery_device *device)
{
	if (*first && hash != *first)
		fail_msg("%s%s: %016llx, before it was %016llx", device->name, device->storage == CAROM_STORAGE_IMAGE ? " images" : "",
			(unsigned long long)hash, (unsigned long long)*first);
	*first = hash;
}

uint64_t runs_affordable(uint64_t steps)
{
	const char *build = getenv("CAROM_BUILD");
	return build && strstr(build, "sanitize") ? (steps + 9) / 10 : steps;
}

void runs_enough(bool enough)
{
	assert_true(enough || runs_affordable(10) < 10);
}

double runs_seconds(void)
{
	struct timespec now;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
