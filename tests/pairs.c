/* SPDX-License-Identifier: MIT */
#include "pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"
#include "layout.h"
#include "world.h"

/* ---- Their hit times */

carom_world *pairs_world(const char *toi, const scenery_device *device)
{
	carom_world_def def = scenery_first_impact();
	def.pipeline.toi = toi;
	return scenery_world(&def, device);
}

carom_world *pairs_oracle(const char *toi)
{
	carom_world_def def = scenery_first_impact();
	def.pipeline.toi = toi;
	return judge_oracle(&def);
}

static void transfer(carom_world *world, carom_texture *texture, uint32_t rows, void *texels, bool up)
{
	carom_error error;
	if (up)
		scenery_check(world->device->kind->upload(world->device, texture, rows, texels, &error), &error);
	else
		scenery_check(world->device->kind->download(world->device, texture, rows, texels, &error), &error);
}

static void fill(carom_world *world, const carom_body_def *bodies, size_t count)
{
	carom_error error;
	world->bodies.used = world->vertices.used = world->names.used = world->linear.used = world->rotational.used = 0;
	memset(world->notes, 0, sizeof world->notes);
	world->body_count = 0;
	scenery_check(carom_world_add(world, bodies, count, NULL, &error), &error);
	scenery_check(carom_textures_update(world, &error), &error);
}

/* Nothing overlapped before, and the step is a whole one. */
static void start(carom_world *world)
{
	const uint32_t n = world->capacity;
	float clock[4 * CLOCK_WIDTH] = {0};
	uint8_t *none = calloc(n, n);
	assert_non_null(none);
	clock[4 * CLOCK_TIME + TIME_REMAINING] = 1.0f;
	transfer(world, world->textures[ROLE_CLOCK].front, 1, clock, true);
	transfer(world, world->textures[ROLE_OVERLAP].front, n, none, true);
	transfer(world, world->textures[ROLE_OVERLAP].back, n, none, true);
	transfer(world, world->textures[ROLE_TILES].front, n / TILE, none, true);
	transfer(world, world->textures[ROLE_TILES].back, n / TILE, none, true);
	free(none);
}

/* Of what overlaps, leaves the pairs 2 k + 1 and 2 k: all in tiles on the diagonal. */
static void leave_pairs(carom_world *world, size_t count, pairs_hit *hits)
{
	const uint32_t n = world->capacity, tiles = n / TILE;
	uint8_t *overlap = calloc(n, n), *left = calloc(n, n), *now = calloc(tiles, tiles * 4);
	assert_true(overlap && left && now);
	transfer(world, world->textures[ROLE_OVERLAP].front, n, overlap, false);
	for (size_t k = 0; k < count / 2; k++) {
		const size_t pair = (2 * k + 1) * n + 2 * k, tile = 2 * k / TILE;
		hits[k].boxes_overlap = overlap[pair] != 0;
		left[pair] = overlap[pair];
		now[4 * (tile * tiles + tile)] |= overlap[pair] ? TILES_NOW : 0;
	}
	transfer(world, world->textures[ROLE_OVERLAP].front, n, left, true);
	transfer(world, world->textures[ROLE_TILES].front, tiles, now, true);
	free(overlap);
	free(left);
	free(now);
}

static void read_hits(carom_world *world, bool is_oracle, size_t count, pairs_hit *hits)
{
	const uint32_t n = world->capacity;
	void *texels = calloc((size_t)n * n, 4 * sizeof(double));
	assert_non_null(texels);
	transfer(world, world->textures[ROLE_HIT_TIMES].front, n, texels, false);
	for (size_t k = 0; k < count / 2; k++) {
		const size_t pair = 4 * ((2 * k + 1) * n + 2 * k), hit = pair + HITTIMES_HIT, done = pair + HITTIMES_DONE;
		const double time = is_oracle ? ((double *)texels)[hit] : (double)((float *)texels)[hit];
		hits[k].done = (is_oracle ? ((double *)texels)[done] : (double)((float *)texels)[done]) > 0.0;
		hits[k].time = hits[k].boxes_overlap ? time : (double)NO_HIT;
	}
	free(texels);
}

void pairs_find(carom_world *world, bool is_oracle, const carom_body_def *bodies, size_t count, pairs_hit *hits)
{
	const int32_t n = (int32_t)count, tiles = (n + TILE - 1) / TILE;
	carom_error error;
	fill(world, bodies, count);
	start(world);
	scenery_check(carom_run(world, STAGE_AABB, n, 1, 0, 0, &error), &error);
	scenery_check(carom_run(world, STAGE_OVERLAP, tiles, (tiles + OVERLAP_GROUP - 1) / OVERLAP_GROUP, n, 0, &error), &error);
	carom_swap(world, ROLE_OVERLAP);
	carom_swap(world, ROLE_TILES);
	world->textures[ROLE_OVERLAP_BEFORE].front = world->textures[ROLE_OVERLAP].back;
	leave_pairs(world, count, hits);
	scenery_check(carom_run(world, STAGE_TOI_FIRST, tiles, tiles, n, 0, &error), &error);
	carom_swap(world, ROLE_HIT_TIMES);
	read_hits(world, is_oracle, count, hits);
}

/* ---- Random pairs */

static double uniform(scenery_random *random, double low, double high)
{
	return (double)scenery_uniform(random, (float)low, (float)high);
}

/* Corners on an ellipse at growing angles, so that they are convex; every angle has a part of the turn for itself. */
static void irregular(scenery_random *random, carom_body_def *def, carom_vec2 *corners)
{
	const double size = uniform(random, 0.1, 1.0), flat = uniform(random, 0.2, 1.0);
	def->shape = CAROM_POLYGON;
	def->vertices = corners;
	def->vertex_count = (uint32_t)uniform(random, 3.0, 9.0);
	for (uint32_t i = 0; i < def->vertex_count; i++) {
		const double angle = 6.2831853 * ((double)i + uniform(random, 0.0, 0.8)) / (double)def->vertex_count;
		corners[i] = (carom_vec2){(float)(size * cos(angle)), (float)(size * flat * sin(angle))};
	}
}

static carom_body_def random_shape(scenery_random *random, carom_vec2 *corners)
{
	static const carom_vec2 thin[4] = {{-0.0005f, -0.5f}, {0.0005f, -0.5f}, {0.0005f, 0.5f}, {-0.0005f, 0.5f}};
	const double choice = uniform(random, 0.0, 1.0);
	carom_body_def def = carom_default_body_def();
	def.mass = 1.0f;
	def.radius = (float)uniform(random, 0.1, 1.0);
	if (choice < 0.25) {
		def.shape = CAROM_CIRCLE;
	} else if (choice < 0.55) {
		def.shape = CAROM_REGULAR;
		def.sides = (uint32_t)uniform(random, 3.0, 9.0);
	} else if (choice < 0.85) {
		irregular(random, &def, corners);
	} else {
		def.shape = CAROM_POLYGON;
		def.vertices = thin;
		def.vertex_count = 4;
	}
	return def;
}

/* In metres and radians in `length` seconds: up to 8 m and a whole turn, accelerations likewise. */
static void set_moving(scenery_random *random, carom_body_def *def, double length)
{
	const double speed = pow(10.0, uniform(random, -1.0, 0.9)) / length, way = uniform(random, -3.1415926, 3.1415926);
	const double choice = uniform(random, 0.0, 1.0), turns = choice < 0.4 ? 0.0 : choice < 0.8 ? 1.0 : 6.2831853;
	def->velocity = (carom_vec2){(float)(speed * cos(way)), (float)(speed * sin(way))};
	def->angular_velocity = (float)(uniform(random, -turns, turns) / length);
	if (uniform(random, 0.0, 1.0) < 0.3) {
		def->force.x = (float)(uniform(random, -2.0, 2.0) / (length * length));
		def->force.y = (float)(uniform(random, -2.0, 2.0) / (length * length));
		def->torque = (float)(uniform(random, -0.3, 0.3) / (length * length));
	}
}

static void make_pair(scenery_random *random, pairs_kind kind, carom_body_def *defs, carom_vec2 (*corners)[8], double length)
{
	const double far = uniform(random, 0.0, 1.0) < 0.8 ? 1.0 : 50.0;
	const double slower = kind == PAIRS_PASSING ? pow(10.0, uniform(random, 0.0, 2.5)) : 1.0;
	for (int i = 0; i < 2; i++) {
		do
			defs[i] = random_shape(random, corners[i]);
		while (kind == PAIRS_PASSING && defs[i].shape == CAROM_CIRCLE);
		defs[i].angle = (float)uniform(random, -3.1, 3.1);
		defs[i].is_static = i == 0 && uniform(random, 0.0, 1.0) < 0.2;
		if (!defs[i].is_static)
			set_moving(random, &defs[i], length * slower);
	}
	defs[0].position = (carom_vec2){(float)uniform(random, -far, far), (float)uniform(random, -far, far)};
}

/* Moves b so that at t it is at (x, y) from a's centre. */
static void put_at(const exact_body *a, exact_body *b, double t, double x, double y)
{
	b->x = a->x + t * (a->vx + 0.5 * t * a->ax) + x - t * (b->vx + 0.5 * t * b->ax);
	b->y = a->y + t * (a->vy + 0.5 * t * a->ay) + y - t * (b->vy + 0.5 * t * b->ay);
}

/* Puts b where it touches a at t, seen from a in the direction `way`. */
static void put_touching(const exact_body *a, exact_body *b, double t, double way)
{
	double low = 0.0, high = a->bound + b->bound;
	while (high - low > 1e-12) {
		const double middle = 0.5 * (low + high);
		put_at(a, b, t, middle * cos(way), middle * sin(way));
		if (exact_distance(a, b, t) > 0.0)
			high = middle;
		else
			low = middle;
	}
}

static double distance_moved(const exact_body *a, const exact_body *b, double t, double x, double y)
{
	exact_body moved = *b;
	moved.x += x;
	moved.y += y;
	return exact_distance(a, &moved, t);
}

/* They touch at t; now let them graze: turns b's velocity so that the distance does not change at t, and is `apart` then. */
static void let_graze(const exact_body *a, exact_body *b, double t, double apart)
{
	const double h = 1e-7, nx = (distance_moved(a, b, t, h, 0.0) - distance_moved(a, b, t, -h, 0.0)) / (2.0 * h);
	const double ny = (distance_moved(a, b, t, 0.0, h) - distance_moved(a, b, t, 0.0, -h)) / (2.0 * h);
	const double rate = (exact_distance(a, b, t + h) - exact_distance(a, b, t - h)) / (2.0 * h);
	b->vx -= rate * nx;
	b->vy -= rate * ny;
	b->x += (rate * t + apart) * nx;
	b->y += (rate * t + apart) * ny;
}

/* The second passes the first at any distance, from far less to more than its size, or would if it did not hit it a little. */
static void pass(scenery_random *random, const exact_body *a, exact_body *b, double t)
{
	const double apart = pow(10.0, uniform(random, -5.0, 0.0));
	let_graze(a, b, t, uniform(random, 0.0, 1.0) < 0.8 ? apart : -0.1 * apart);
}

/* Apart at the start, then touching, grazing or somewhere in the neighbourhood. */
static void aim(scenery_random *random, pairs_kind kind, const exact_body *a, exact_body *b)
{
	const exact_body wish = *b;
	do {
		const double t = uniform(random, 0.05, 1.0), way = uniform(random, -3.1415926, 3.1415926), choice = uniform(random, 0.0, 1.0);
		*b = wish;
		put_touching(a, b, t, way);
		if (kind == PAIRS_PASSING) {
			pass(random, a, b, t);
		} else if (choice < 0.4) {
			const double least = choice < 0.25 ? 1e-4 : 1e-5;
			let_graze(a, b, t, uniform(random, -least, least));
		} else if (choice < 0.5) {
			b->x += uniform(random, -0.5, 0.5);
			b->y += uniform(random, -0.5, 0.5);
		}
	} while (exact_distance(a, b, 0.0) < 1e-3);
}

void pairs_random(scenery_random *random, pairs_kind kind, carom_world *world, pairs_batch *batch)
{
	const double length = (double)carom_world_get_def(world)->time_step;
	for (size_t k = 0; k < PAIRS_BODIES; k += 2)
		make_pair(random, kind, batch->bodies + k, batch->vertices + k, length);
	fill(world, batch->bodies, PAIRS_BODIES);
	for (uint32_t k = 0; k < PAIRS_BODIES; k += 2) {
		const exact_body a = exact_of(world, k);
		exact_body b = exact_of(world, k + 1);
		aim(random, kind, &a, &b);
		batch->bodies[k + 1].position = (carom_vec2){(float)b.x, (float)b.y};
		batch->bodies[k + 1].velocity = (carom_vec2){(float)(b.vx / length), (float)(b.vy / length)};
	}
}
