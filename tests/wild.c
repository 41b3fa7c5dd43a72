/* SPDX-License-Identifier: MIT */
#include "wild.h"

#include <math.h>
#include <string.h>

#include "runs.h"

uint32_t wild_below(scenery_random *random, uint32_t end)
{
	return (uint32_t)scenery_uniform(random, 0.0f, (float)end);
}

bool wild_one_in(scenery_random *random, uint32_t many)
{
	return wild_below(random, many) == 0;
}

static carom_body_def wild_body(scenery_random *random, uint32_t shapes, float speed)
{
	const float small = wild_one_in(random, 6) ? 0.02f : 0.6f, radius = 0.5f * scenery_uniform(random, small, 1.0f);
	const float vy = scenery_uniform(random, -speed, speed), vx = scenery_uniform(random, -speed, speed);
	carom_body_def body = scenery_circle(0.0f, 0.0f, vx, vy, radius);
	if (shapes == 1 || (shapes == 2 && wild_one_in(random, 2))) {
		body.shape = CAROM_REGULAR;
		body.sides = 3 + wild_below(random, 5);
		body.angle = scenery_uniform(random, -3.0f, 3.0f);
		body.angular_velocity = scenery_uniform(random, -5.0f, 5.0f);
	}
	if (wild_one_in(random, 12))
		body.is_static = true;
	if (wild_one_in(random, 8))
		body.mass = scenery_uniform(random, 0.01f, 100.0f);
	if (wild_one_in(random, 15) && !body.is_static)
		body.force = (carom_vec2){scenery_uniform(random, -3.0f, 3.0f), scenery_uniform(random, -3.0f, 3.0f)};
	if (wild_one_in(random, 8) && !body.is_static && body.shape == CAROM_REGULAR)
		body.torque = scenery_uniform(random, -1.0f, 1.0f);
	if (body.is_static) {
		body.velocity = (carom_vec2){0.0f, 0.0f};
		body.angular_velocity = 0.0f;
	}
	return body;
}

/* Bodies on a square lattice, of one of so many sizes. */
static void make(scenery_random *random, uint32_t sizes, wild_world *world)
{
	static const float restitutions[] = {0.0f, 0.0f, 0.3f, 0.9f, 1.0f, 1.0f}, frictions[] = {0.0f, 0.0f, 0.0f, 0.2f, 0.7f, 1000.0f};
	carom_world_def *def = &world->def;
	*def = runs_def();
	const uint32_t shapes = wild_below(random, 3), side = 2 + wild_below(random, sizes);
	const float pitch = scenery_uniform(random, 1.02f, 2.0f), half = 0.5f * (float)side * pitch + 0.6f;
	const float middle = wild_one_in(random, 3) ? scenery_uniform(random, -200.0f, 200.0f) : 0.0f;
	const float speed = wild_one_in(random, 12) ? 300.0f : scenery_uniform(random, 0.0f, 10.0f);
	scenery_random rubbing = {random->state ^ 1}; /* of its own: the bodies of a seed are kept */
	def->restitution = restitutions[wild_below(random, 6)];
	def->friction = frictions[wild_below(&rubbing, 6)];
	def->rolling_friction = wild_one_in(&rubbing, 3) ? 0.125f : 0.0f;
	def->linear_damping = wild_one_in(&rubbing, 6) ? scenery_uniform(&rubbing, 0.0f, 4.0f) : 0.0f;
	def->angular_damping = def->linear_damping;
	def->gravity.y = wild_one_in(random, 2) ? -scenery_uniform(random, 0.0f, 20.0f) : 0.0f;
	def->has_room = true;
	def->room_min = (carom_vec2){middle - half, -half};
	def->room_max = (carom_vec2){middle + half, half};
	world->count = side * side;
	world->joint_count = 0;
	for (uint32_t i = 0; i < world->count; i++) {
		carom_body_def *body = &world->bodies[i];
		*body = wild_body(random, shapes, speed);
		body->position.x = middle + ((float)(i % side) - 0.5f * (float)(side - 1)) * pitch;
		body->position.y = ((float)(i / side) - 0.5f * (float)(side - 1)) * pitch;
	}
}

void wild_make(uint64_t seed, wild_world *world)
{
	scenery_random random = {seed};
	make(&random, 7, world);
}

/* Corners on an ellipse, in order: convex, with edges of all lengths. */
static void make_outline(scenery_random *random, carom_vec2 *corners)
{
	const float flat = scenery_uniform(random, 0.1f, 1.0f), turn = 6.2831853f / (float)WILD_CORNERS;
	for (uint32_t i = 0; i < WILD_CORNERS; i++) {
		const float angle = ((float)i + scenery_uniform(random, 0.0f, 0.95f)) * turn;
		corners[i] = (carom_vec2){0.45f * cosf(angle), 0.45f * flat * sinf(angle)};
	}
}

/* Corners at growing angles, now far from the middle, now near it: not convex, but simple. */
static void make_hollow(scenery_random *random, carom_vec2 *corners)
{
	const float deep = scenery_uniform(random, 0.15f, 0.8f), turn = 6.2831853f / (float)WILD_CORNERS;
	for (uint32_t i = 0; i < WILD_CORNERS; i++) {
		const float angle = ((float)i + scenery_uniform(random, 0.0f, 0.6f)) * turn, far = i % 2 ? 0.45f * deep : 0.45f;
		const float x = far * cosf(angle), y = far * sinf(angle);
		corners[i] = (carom_vec2){x, y};
	}
}

/* Half of the polygons of one world in three, by numbers of their own: the bodies of a seed are kept. */
static void make_hollows(uint64_t seed, wild_world *world)
{
	scenery_random random = {seed ^ 3};
	if (!wild_one_in(&random, 3))
		return;
	for (uint32_t i = 0; i < WILD_HOLLOWS; i++)
		make_hollow(&random, world->hollows[i]);
	for (uint32_t i = 0; i < world->count; i++) {
		carom_body_def *body = &world->bodies[i];
		if (body->shape == CAROM_CIRCLE || body->sides > 8 || wild_one_in(&random, 2))
			continue;
		body->shape = CAROM_POLYGON;
		body->vertices = world->hollows[wild_below(&random, WILD_HOLLOWS)];
		body->vertex_count = WILD_CORNERS;
	}
}

/* Below the others, in a room that grows for it or in none. */
static void add_large(scenery_random *random, wild_world *world)
{
	carom_body_def large = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, scenery_uniform(random, 2.0f, 20.0f));
	large.position.x = 0.5f * (world->def.room_min.x + world->def.room_max.x);
	large.is_static = wild_one_in(random, 2);
	if (wild_one_in(random, 2)) {
		large.shape = CAROM_REGULAR;
		large.sides = 3 + wild_below(random, 60);
	}
	if (!large.is_static)
		large.velocity = (carom_vec2){scenery_uniform(random, -20.0f, 20.0f), scenery_uniform(random, -20.0f, 20.0f)};
	if (wild_one_in(random, 2)) {
		world->def.has_room = false;
		large.position.y = world->def.room_min.y - large.radius - 1.0f;
	} else {
		world->def.room_min.y -= 3.0f * large.radius;
		world->def.room_min.x -= large.radius;
		world->def.room_max.x += large.radius;
		large.position.y = world->def.room_min.y + 1.5f * large.radius;
	}
	world->bodies[world->count++] = large;
}

/* All rest but one, which is heavy, and hits many of them in a step: each then is twice as fast. */
static void make_shot(scenery_random *random, wild_world *world)
{
	for (uint32_t i = 0; i < world->count; i++) {
		world->bodies[i].velocity = (carom_vec2){0.0f, 0.0f};
		world->bodies[i].angular_velocity = 0.0f;
	}
	carom_body_def *shot = &world->bodies[wild_below(random, world->count)];
	shot->is_static = shot->is_kinematic = false;
	shot->mass = 1000.0f;
	const float speed = 1.5f / world->def.time_step;
	shot->velocity = (carom_vec2){scenery_uniform(random, -speed, speed), scenery_uniform(random, -speed, speed)};
}

/* Rows that exactly fill the room, on each other or with air between them: nothing can move aside. With restitution 1 that would take minutes. */
static void make_tight(scenery_random *random, wild_world *world)
{
	static const carom_vec2 square[4] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
	const uint32_t side = 2 + wild_below(random, 5);
	const float half = 0.5f * (float)side, pitch = wild_one_in(random, 2) ? 1.0f : 1.25f;
	const bool are_squares = wild_one_in(random, 2);
	carom_world_def *def = &world->def;
	def->has_room = true;
	def->room_min = (carom_vec2){-half, 0.0f};
	def->room_max = (carom_vec2){half, 4.0f * half};
	def->gravity = (carom_vec2){0.0f, -10.0f};
	def->restitution = fminf(def->restitution, 0.9f);
	world->count = side * side;
	for (uint32_t i = 0; i < world->count; i++) {
		carom_body_def *body = &world->bodies[i];
		*body = scenery_circle((float)(i % side) + 0.5f - half, 0.5f + (float)(i / side) * pitch, 0.0f, 0.0f, 0.5f);
		if (!are_squares)
			continue;
		body->shape = CAROM_POLYGON;
		body->vertices = square;
		body->vertex_count = 4;
	}
}

void wild_make_wider(uint64_t seed, wild_world *world)
{
	static const char *const tois[] = {"circle_quadratic", "separating"}, *const impulses[] = {"pair_exact", "accumulate"};
	static const float steps[] = {0.005f, 1.0f / 60.0f, 1.0f / 60.0f, 0.1f};
	scenery_random random = {seed};
	carom_error error;
	make(&random, wild_one_in(&random, 6) ? WILD_SIDE - 1 : 7, world);
	world->def.time_step = steps[wild_below(&random, 4)];
	scenery_check(carom_pipeline_set(&world->def.pipeline, "toi", tois[wild_below(&random, 2)], &error), &error);
	scenery_check(carom_pipeline_set(&world->def.pipeline, "impulse", impulses[wild_below(&random, 4) / 3], &error), &error);
	for (uint32_t i = 0; i < WILD_OUTLINES; i++)
		make_outline(&random, world->outlines[i]);
	const bool irregular = wild_one_in(&random, 2);
	for (uint32_t i = 0; i < world->count; i++) {
		carom_body_def *body = &world->bodies[i];
		if (!irregular || body->shape == CAROM_CIRCLE || wild_one_in(&random, 2))
			continue;
		body->shape = CAROM_POLYGON;
		body->vertices = world->outlines[wild_below(&random, WILD_OUTLINES)];
		body->vertex_count = WILD_CORNERS;
	}
	make_hollows(seed, world);
	scenery_random driving = {seed ^ 1}; /* of its own: the bodies of a seed are kept */
	if (wild_one_in(&driving, 3))
		scenery_drive(&driving, world->count, 5.0f, world->bodies);
	if (wild_one_in(&random, 6))
		world->def.has_room = false;
	if (wild_one_in(&random, 3))
		add_large(&random, world);
	if (wild_one_in(&random, 2))
		scenery_check(carom_pipeline_set(&world->def.pipeline, "step", "contacts", &error), &error);
	if (wild_one_in(&random, 12))
		make_shot(&random, world);
	if (wild_one_in(&random, 12))
		make_tight(&random, world);
	scenery_random filtering = {seed ^ 2};
	const bool filtered = wild_one_in(&filtering, 4);
	for (uint32_t i = 0; i < world->count && filtered; i++)
		scenery_filter(&filtering, &world->bodies[i]);
	wild_join(seed, world);
}

/* Tiny static bodies in a row below all others, where few get. */
void wild_add_watchers(wild_world *world)
{
	const carom_vec2 low = world->def.room_min, high = world->def.room_max;
	for (uint32_t i = 0; i < WILD_WATCHERS; i++) {
		carom_body_def *watcher = &world->bodies[world->count++];
		*watcher = scenery_circle(low.x + (high.x - low.x) * ((float)i + 0.5f) / (float)WILD_WATCHERS, low.y + 0.004f, 0.0f, 0.0f, 0.002f);
		watcher->is_static = true;
	}
}

/* A body gets another velocity, if it may have one. */
static void steer(carom_world *world, uint32_t index)
{
	carom_body_state state = runs_state(world, index);
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	if (info.is_static)
		return;
	state.velocity = (carom_vec2){1.0f - state.velocity.y, state.velocity.x};
	scenery_check(carom_world_set_states(world, index, 1, &state, &error), &error);
	if (!info.is_kinematic)
		scenery_check(carom_world_set_force(world, index, (carom_vec2){3.0f * info.mass, info.mass}, 0.0f, &error), &error);
}

/* A body goes, and one like it comes in its place, as the last one. */
static void replace(carom_world *world, uint32_t index)
{
	const carom_body_state state = runs_state(world, index);
	carom_body_def def = carom_default_body_def();
	carom_vec2 vertices[CAROM_MAX_VERTICES];
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	if (info.vertices)
		memcpy(vertices, info.vertices, info.vertex_count * sizeof *vertices);
	def.shape = info.vertices ? CAROM_POLYGON : CAROM_CIRCLE;
	def.radius = info.radius;
	def.vertices = vertices;
	def.vertex_count = info.vertex_count;
	def.position = state.position;
	def.angle = state.angle;
	def.velocity = state.velocity;
	def.angular_velocity = state.angular_velocity;
	def.is_static = info.is_static;
	def.is_kinematic = info.is_kinematic;
	def.mass = info.is_static || info.is_kinematic ? 0.0f : info.mass;
	def.restitution = info.restitution;
	def.friction = info.friction;
	def.rolling_friction = info.rolling_friction;
	def.linear_damping = info.linear_damping;
	def.angular_damping = info.angular_damping;
	def.force = info.force;
	def.torque = info.torque;
	def.categories = info.categories;
	def.mask = info.mask;
	scenery_check(carom_world_remove(world, &index, 1, &error), &error);
	scenery_check(carom_world_add(world, &def, 1, NULL, &error), &error);
}

/* One joint more, as the two are; or all of them go. */
static void join(carom_world *world, uint32_t step, uint32_t count)
{
	static carom_joint joints[WILD_JOINTS];
	carom_error error;
	size_t has = carom_world_joint_count(world);
	if (strcmp(carom_pipeline_get(&carom_world_get_def(world)->pipeline, "step"), "contacts") != 0 || count < 2)
		return;
	scenery_check(carom_world_get_joints(world, 0, has, joints, &error), &error);
	has = step % 49 == 45 || has == WILD_JOINTS ? 0 : has;
	joints[has] = carom_default_joint();
	joints[has].kind = (carom_joint_kind)(step % 5);
	joints[has].body = 5 * step % count;
	joints[has].other = step % 11 == 4 ? CAROM_GROUND : (int32_t)((5 * step + 1) % count);
	joints[has].collides = step % 3 == 0;
	if (joints[has].kind != CAROM_REVOLUTE && step % 11 == 4)
		joints[has].other_anchor = (carom_vec2){0.0f, 0.0f};
	if (joints[has].kind == CAROM_SPRING) {
		joints[has].stiffness = step % 9 ? 20.0f : 1e5f;
		joints[has].damping = (float)(step % 5);
	}
	if (joints[has].kind == CAROM_SLIDER)
		joints[has].axis = (float)(step % 6) - 2.0f;
	if (joints[has].kind == CAROM_REVOLUTE || joints[has].kind == CAROM_SLIDER) {
		joints[has].motor_speed = 2.0f - (float)(step % 5);
		joints[has].motor_torque = step % 3 ? 2.0f : 0.0f;
		joints[has].has_stops = step % 7 < 4;
		joints[has].lower_angle = -(float)(step % 3);
		joints[has].upper_angle = (float)(step % 5);
	}
	if (carom_world_set_joints(world, has + 1, joints, &error)) /* neither moves, or they are at one place */
		assert_int_equal(error.status, CAROM_INVALID_ARGUMENT);
}

/* Of one that has a motor, or gets one, the speed. */
static void drive(carom_world *world, uint32_t step)
{
	const size_t has = carom_world_joint_count(world);
	carom_error error;
	if (has > 0 && carom_world_set_motor(world, step % has, (float)(step % 9) - 4.0f, step % 6 ? 3.0f : 0.0f, &error))
		assert_int_equal(error.status, CAROM_INVALID_ARGUMENT); /* it is no pin */
}

void wild_change(carom_world *world, uint32_t step, float time_step)
{
	static const float lengths[] = {1.1f, 0.6f, 1.6f, 1.0f};
	const uint32_t count = (uint32_t)carom_world_body_count(world);
	carom_error error;
	if (step % 3 == 0)
		steer(world, 7 * step % count);
	if (step % 4 == 1)
		replace(world, 11 * step % count);
	if (step % 12 == 9)
		scenery_check(carom_world_set_gravity(world, (carom_vec2){(float)(step % 5) - 2.0f, -1.0f}, &error), &error);
	if (step % 8 == 5)
		scenery_check(carom_world_set_time_step(world, lengths[step / 8 % 4] * time_step, &error), &error);
	if (step % 7 == 3)
		join(world, step, count);
	if (step % 5 == 2)
		drive(world, step);
	if (step % 10 == 7)
		scenery_check(carom_world_set_filter(world, 5 * step % count, 1 + step % 20 / 10, CAROM_MASK - step % 30 / 10, &error), &error);
}
