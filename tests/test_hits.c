/* The hits that a world keeps: they explain all that the bodies did, and are those of the serial queue.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "forecast.h"
#include "runs.h"

enum { MOST_BODIES = 120 };

/* ---- Do they explain what the bodies did? */

/* A body on its way, in double. */
typedef struct party {
	double x, y, vx, vy, w, time;
	double inverse_mass, inverse_inertia;
} party;

static void follow(party *k, double time)
{
	k->x += k->vx * (time - k->time);
	k->y += k->vy * (time - k->time);
	k->time = time;
}

static party party_of(carom_world *world, uint32_t index)
{
	const carom_body_state state = runs_state(world, index);
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	return (party){(double)state.position.x, (double)state.position.y, (double)state.velocity.x, (double)state.velocity.y,
		(double)state.angular_velocity, carom_world_time(world), 1.0 / (double)info.mass, 1.0 / (double)info.inertia};
}

/* How fast it comes along the normal, at the point. */
static double speed_at(const party *k, const carom_hit *hit)
{
	const double x = (double)hit->point.x - k->x, y = (double)hit->point.y - k->y;
	return (k->vx - k->w * y) * (double)hit->normal.x + (k->vy + k->w * x) * (double)hit->normal.y;
}

static void push(party *k, const carom_hit *hit, double sign)
{
	const double x = (double)hit->point.x - k->x, y = (double)hit->point.y - k->y, jx = sign * (double)hit->impulse.x,
				 jy = sign * (double)hit->impulse.y;
	k->vx += jx * k->inverse_mass;
	k->vy += jy * k->inverse_mass;
	k->w += (x * jy - y * jx) * k->inverse_inertia;
}

/* Each hit in turn: its two come together before it, and it pushes them apart. */
static void explain(party *parties, const carom_hit *hits, size_t count)
{
	for (const carom_hit *hit = hits; hit < hits + count; hit++) {
		party wall = {0}, *body = &parties[hit->body], *other = hit->other < 0 ? &wall : &parties[hit->other];
		follow(body, hit->time);
		follow(other, hit->time);
		runs_near(hypot((double)hit->normal.x, (double)hit->normal.y), 1.0, 1e-6);
		assert_true((double)hit->impulse.x * (double)hit->normal.x + (double)hit->impulse.y * (double)hit->normal.y > 0.0);
		assert_true(speed_at(body, hit) - speed_at(other, hit) < 1e-4);
		push(body, hit, 1.0);
		push(other, hit, -1.0);
	}
}

static void all_that_happens_is_hits(const char *step, scenery_shapes shapes, float friction, const scenery_device *device, uint64_t steps)
{
	enum { COUNT = 60 };
	carom_body_def bodies[COUNT];
	party parties[COUNT];
	scenery_random random = {(uint64_t)shapes + 31};
	carom_world_def def = runs_room(5.5f, 5.5f);
	size_t count;
	scenery_bodies(&random, shapes, COUNT, 1.2f, 3.0f, bodies);
	def.pipeline.step = step;
	def.keep_hits = true;
	def.friction = friction;
	carom_world *world = runs_world(&def, device, bodies, COUNT);
	if (!world)
		return;
	runs_step(world, 2); /* the clock does not begin at 0 */
	for (uint32_t i = 0; i < COUNT; i++)
		parties[i] = party_of(world, i);
	const carom_report report = runs_step(world, steps);
	carom_hit *hits = runs_hits(world, &count);
	assert_int_equal(count, report.hits);
	runs_enough(count > 15);
	explain(parties, hits, count);
	for (uint32_t i = 0; i < COUNT; i++) {
		const carom_body_state state = runs_state(world, i);
		follow(&parties[i], carom_world_time(world));
		runs_near((double)state.position.x, parties[i].x, 5e-5);
		runs_near((double)state.position.y, parties[i].y, 5e-5);
		runs_near((double)state.velocity.x, parties[i].vx, 1e-4);
		runs_near((double)state.velocity.y, parties[i].vy, 1e-4);
		runs_near((double)state.angular_velocity, parties[i].w, 5e-4);
	}
	free(hits);
	carom_world_destroy(world);
}

static void hits_explain_all(void **unused)
{
	(void)unused;
	for (int shapes = SCENERY_MIXED; shapes <= SCENERY_POLYGONS; shapes++) {
		for (int rub = 0; rub < 2; rub++) {
			SCENERY_EACH_DEVICE(device) {
				all_that_happens_is_hits("events", (scenery_shapes)shapes, rub ? 0.4f : 0.0f, device, runs_affordable(20));
				all_that_happens_is_hits("first_impact", (scenery_shapes)shapes, rub ? 0.4f : 0.0f, device, runs_affordable(40));
			}
		}
	}
}

/* ---- Are they those of the queue? */

static bool has(int32_t body, int row, int column)
{
	return body == row || body == column;
}

/* With whom the body is hit, one after the other, and when. */
static void check_body(const queue *q, int32_t body, double begun, double length, const carom_hit *hits, size_t count)
{
	size_t k = 0;
	for (size_t i = 0; i < q->hit_count; i++) {
		const queue_hit *expected = &q->hits[i];
		if (!has(body, expected->row, expected->column))
			continue;
		while (k < count && !has(body, (int)hits[k].body, hits[k].other))
			k++;
		if (k == count || (int)hits[k].body != expected->row || hits[k].other != expected->column)
			fail_msg("body %d is hit by %d and %d, but that is not so", (int)body, expected->row, expected->column);
		runs_near((hits[k++].time - begun) / length, expected->time, 2e-4);
	}
	for (; k < count; k++)
		assert_false(has(body, (int)hits[k].body, hits[k].other));
}

static void follow_queue(scenery_shapes shapes, float friction, const scenery_device *device)
{
	carom_body_def bodies[MOST_BODIES];
	carom_world_def def = runs_room(7.2f, 7.2f);
	scenery_random random = {(uint64_t)shapes + 57};
	size_t checked = 0, count;
	scenery_bodies(&random, shapes, MOST_BODIES, 1.2f, 3.0f, bodies);
	def.time_step = 0.02f;
	def.friction = friction;
	def.keep_hits = true;
	carom_world *world = runs_world(&def, device, bodies, MOST_BODIES);
	if (!world)
		return;
	forecast f = forecast_of(runs_queue(&def, bodies, MOST_BODIES));
	for (uint64_t i = 0; i < runs_affordable(20); i++) {
		const double begun = carom_world_time(world);
		forecast_follow(&f, world);
		forecast_step(&f, (double)def.time_step);
		runs_step(world, 1);
		if (!f.sure)
			continue;
		carom_hit *hits = runs_hits(world, &count);
		for (int32_t body = 0; body < MOST_BODIES; body++)
			check_body(f.middle, body, begun, (double)def.time_step, hits, count);
		checked += count;
		free(hits);
	}
	print_message("%zu hits on %s\n", checked, device->name);
	runs_enough(checked > 30);
	forecast_destroy(&f);
	carom_world_destroy(world);
}

static void hits_are_the_queues(void **unused)
{
	(void)unused;
	for (int shapes = SCENERY_MIXED; shapes <= SCENERY_POLYGONS; shapes++) {
		SCENERY_EACH_DEVICE(device)
			follow_queue((scenery_shapes)shapes, shapes == SCENERY_MIXED ? 0.3f : 0.0f, device);
	}
}

/* What touches is hit in turn, though all at the same time. */
static void a_blow_goes_through_a_row(void **unused)
{
	enum { COUNT = 5 };
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_body_def bodies[COUNT];
		carom_world_def def = runs_def();
		size_t count;
		for (int i = 0; i < COUNT; i++) /* not in the order of their indices */
			bodies[(2 * i) % COUNT] = scenery_circle((float)i, 0.0f, 0.0f, 0.0f, 0.5f);
		bodies[0].position.x = -0.25f;
		bodies[0].velocity.x = 30.0f;
		def.keep_hits = true;
		carom_world *world = runs_world(&def, device, bodies, COUNT);
		if (!world)
			continue;
		runs_step(world, 1);
		carom_hit *hits = runs_hits(world, &count);
		int seen = 0;
		for (size_t k = 0; k < count; k++) {
			const int a = (2 * seen) % COUNT, b = (2 * seen + 2) % COUNT;
			if (fabsf(hits[k].impulse.x) < 1e-3f) /* what rounding has sunk is parted on the way */
				continue;
			assert_true(has(a, (int)hits[k].body, hits[k].other) && has(b, (int)hits[k].body, hits[k].other));
			runs_near(hits[k].time, 0.25 / 30.0, 1e-6);
			runs_near((double)hits[k].point.x, (double)seen + 0.5, 1e-5);
			runs_near((double)hits[k].normal.x, (int)hits[k].body == b ? 1.0 : -1.0, 1e-6);
			seen++;
		}
		assert_int_equal(seen, COUNT - 1);
		free(hits);
		carom_world_destroy(world);
	}
}

/* A body with a billion times the others' mass is a piston: nothing changes its velocity, and the work of its hits is what the gas gains. */
static void a_piston_does_work(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		size_t count;
		double work = 0.0;
		carom_scene *scene = runs_read("scenes/piston.json");
		scene->world.keep_hits = true;
		carom_world *world = runs_scene(scene, device);
		if (!world)
			continue;
		const double before = runs_measure(world).kinetic_energy;
		runs_advance(world, 12.0);
		carom_hit *hits = runs_hits(world, &count);
		for (size_t k = 0; k < count; k++)
			work += hits[k].other == 0 ? (double)hits[k].impulse.x * 0.5 /* m/s */ : 0.0;
		assert_true(runs_state(world, 0).velocity.x == 0.5f);
		assert_true(work > 50.0);
		runs_near((runs_measure(world).kinetic_energy - before) / work, 1.0, 1e-5);
		free(hits);
		carom_world_destroy(world);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(hits_explain_all), cmocka_unit_test(hits_are_the_queues),
		cmocka_unit_test(a_blow_goes_through_a_row), cmocka_unit_test(a_piston_does_work)};
	return cmocka_run_group_tests_name("hits", tests, NULL, NULL);
}
