/* Bodies that come and go while a world goes on, each call of which fails in turn.
 * SPDX-License-Identifier: MIT */
#include "count.h"
#include "runs.h"
#include "walk.h"

enum { BODIES = 24 };

static carom_world *crowd(const scenery_device *device)
{
	carom_world_def def = runs_room(5.0f, 5.0f);
	carom_body_def bodies[BODIES];
	scenery_random random = {5};
	def.time_step = 0.0625f;
	def.friction = 0.5f;
	def.threads = 1; /* or the order of the calls were another each time */
	scenery_bodies(&random, SCENERY_MIXED, BODIES, 1.25f, 6.0f, bodies);
	carom_world *world = runs_world(&def, device, bodies, BODIES);
	if (world)
		runs_step(world, 2);
	return world;
}

typedef carom_status change(carom_world *world, carom_error *error);

static carom_status take_away(carom_world *world, carom_error *error)
{
	const uint32_t gone[] = {9, 4};
	return carom_world_remove(world, gone, COUNT(gone), error);
}

/* With a name and vertices that no other has. */
static carom_status add(carom_world *world, carom_error *error)
{
	const carom_vec2 own[] = {{0.2f, 0.0f}, {0.0f, 0.3f}, {-0.2f, 0.1f}};
	carom_body_def defs[] = {scenery_circle(4.5f, 4.5f, -3.0f, -5.0f, 0.2f), scenery_circle(-4.5f, 4.5f, 2.0f, 1.0f, 0.2f)};
	defs[1].shape = CAROM_POLYGON;
	defs[1].vertices = own;
	defs[1].vertex_count = COUNT(own);
	defs[1].name = "the last";
	return carom_world_add(world, defs, COUNT(defs), NULL, error);
}

static carom_status step(carom_world *world, carom_error *error)
{
	return carom_world_step(world, 1, NULL, error);
}

/* What fails has changed nothing, and works when it is tried again. */
bool walk_roster(const scenery_device *device, faults_kind kind, walk_judge *judge)
{
	static change *const changes[] = {take_away, add, step, take_away, step};
	const char *failed = "";
	uint64_t n, first = 0;
	for (n = 1; failed; n++) {
		carom_world *world = crowd(device);
		if (!world)
			return false;
		faults_arm(kind, n, walk_code(n));
		failed = NULL;
		for (size_t i = 0; i < COUNT(changes); i++) {
			const size_t count = carom_world_body_count(world);
			const double time = carom_world_time(world);
			carom_error error;
			const carom_status status = changes[i](world, &error);
			if (!status)
				continue;
			assert_null(failed); /* it fails once */
			failed = faults_disarm();
			judge(failed, status, &error);
			assert_int_equal(carom_world_body_count(world), count);
			if (carom_world_time(world) == time) /* else the step is done */
				scenery_check(changes[i](world, &error), &error);
		}
		if (!failed)
			failed = faults_disarm(); /* what can be done without */
		assert_int_equal(carom_world_body_count(world), BODIES - 2);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
	print_message("%s, bodies come and go: %llu calls\n", device->name, (unsigned long long)n - 1);
	return true;
}
