/* The textures that do not change while bodies do not [2]: what bodies are, and what is the same for all. */
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "step/events.h"
#include "world.h"

#define ENOUGH_ITERATIONS 64 /* halvings for any epsilon: they stop there */

static void fill_uniforms(const carom_world *world, void *data)
{
	const carom_world_def *def = &world->def;
	float *u = data, *room = u + 4 * UNIFORMS_ROOM, *rules = u + 4 * UNIFORMS_RULES, *rubs = u + 4 * UNIFORMS_RUBS;
	u[WORLD_COUNT] = (float)world->body_count;
	u[WORLD_TIME_STEP] = def->time_step;
	u[WORLD_GRAVITY_X] = def->gravity.x;
	u[WORLD_GRAVITY_Y] = def->gravity.y;
	room[ROOM_MIN_X] = def->room_min.x;
	room[ROOM_MIN_Y] = def->room_min.y;
	room[ROOM_MAX_X] = def->room_max.x;
	room[ROOM_MAX_Y] = def->room_max.y;
	rules[RULES_EPSILON] = def->epsilon;
	rules[RULES_ITERATIONS] = def->iterations && def->iterations < ENOUGH_ITERATIONS ? (float)def->iterations : (float)ENOUGH_ITERATIONS;
	rules[RULES_HAS_ROOM] = def->has_room ? 1.0f : 0.0f;
	rules[RULES_RESTITUTION] = def->restitution;
	rubs[RUBS_WALLS] = def->friction;
	rubs[RUBS_ANY] = world->traits & TRAIT_RUBS ? 1.0f : 0.0f;
	rubs[RUBS_ROLLING] = def->rolling_friction;
	rubs[RUBS_DAMPS] = world->traits & TRAIT_DAMPS ? 1.0f : 0.0f;
}

void carom_geometry_fill(const carom_body *body, float texel[4])
{
	texel[GEOMETRY_FIRST] = (float)(carom_outline_hull(body) / 2);
	texel[GEOMETRY_COUNT] = (float)(body->hull_count + PIECES * body->piece_count);
	texel[GEOMETRY_MASS] = body->mass;
	texel[GEOMETRY_INERTIA] = body->inertia;
}

static void fill_geometry(const carom_world *world, void *data)
{
	float *texels = data;
	uint32_t circle = carom_polygon_texels(world);
	for (size_t i = 0; i < world->body_count; i++, texels += 4) {
		const carom_body *body = &carom_world_bodies(world)[i];
		carom_geometry_fill(body, texels);
		if (body->vertex_count == 1)
			texels[GEOMETRY_FIRST] = (float)circle++;
	}
}

void carom_forces_fill(const carom_body *body, float texel[4])
{
	texel[FORCES_X] = body->force.x;
	texel[FORCES_Y] = body->force.y;
	texel[FORCES_TORQUE] = body->torque;
	texel[FORCES_RESTITUTION] = body->restitution;
}

static void fill_forces(const carom_world *world, void *data)
{
	float *texels = data;
	for (size_t i = 0; i < world->body_count; i++)
		carom_forces_fill(&carom_world_bodies(world)[i], texels + 4 * i);
}

static void fill_friction(const carom_world *world, void *data)
{
	float *texels = data;
	for (size_t i = 0; i < world->body_count && world->traits; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		texels[4 * i + FRICTION_SLIDING] = body->friction;
		texels[4 * i + FRICTION_ROLLING] = body->rolling_friction;
		texels[4 * i + FRICTION_LINEAR_DAMPING] = body->is_kinematic ? 0.0f : body->linear_damping;
		texels[4 * i + FRICTION_ANGULAR_DAMPING] = body->is_kinematic ? 0.0f : body->angular_damping;
	}
}

/* Is there a body that another one may pass through? False where all hit a category that each is of, and no joint keeps two from it. */
static bool is_filtered(const carom_world *world)
{
	const carom_body *bodies = carom_world_bodies(world);
	uint32_t hit_by_all = CAROM_MASK;
	if (carom_apart_count(world) > 0)
		return true;
	for (size_t i = 0; i < world->body_count; i++)
		hit_by_all &= bodies[i].mask;
	for (size_t i = 0; i < world->body_count; i++)
		if (!(bodies[i].categories & hit_by_all))
			return true;
	return false;
}

/* Those of polygons as the host has them; a circle's only vertex is (radius, 0). */
static void fill_vertices(const carom_world *world, void *data)
{
	float *texels = data;
	if (world->vertices.used)
		memcpy(texels, world->vertices.items, world->vertices.used);
	texels += 4 * (size_t)carom_polygon_texels(world);
	for (size_t i = 0; i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		if (body->vertex_count == 1) {
			texels[VERTICES_X0] = body->radius;
			texels += 4;
		}
	}
}

typedef void fill_texels(const carom_world *world, void *data);

/* Uploads `count` texels, or of a list ints, padded with zeros to whole rows. */
static carom_status send(carom_world *world, carom_role role, uint32_t count, fill_texels *fill, carom_error *error)
{
	void *texels = calloc(count, 4 * sizeof(float));
	if (!texels)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to upload %zu bodies", world->body_count);
	fill(world, texels);
	const carom_status status = world->device->kind->upload(world->device, world->textures[role].front, carom_row_count(count), texels, error);
	free(texels);
	return status;
}

carom_status carom_uniforms_send(carom_world *world, carom_error *error)
{
	return send(world, ROLE_UNIFORMS, UNIFORMS_WIDTH, fill_uniforms, error);
}

static void fill_filters(const carom_world *world, void *data)
{
	const carom_body *bodies = carom_world_bodies(world);
	uint32_t *list = data;
	list[FILTERS_ANY] = world->filter_room > FILTERS_FIRST;
	for (size_t i = 0; i < world->body_count && list[FILTERS_ANY]; i++) {
		list[FILTER(i, FILTER_CATEGORIES)] = bodies[i].categories;
		list[FILTER(i, FILTER_MASK)] = bodies[i].mask;
	}
	carom_apart_fill(world, data);
}

/* The head alone where no body may pass through another. */
carom_status carom_filters_send(carom_world *world, carom_error *error)
{
	const uint32_t room = is_filtered(world) ? (uint32_t)(FILTER(world->capacity, 0) + 4 * carom_apart_count(world)) : FILTERS_FIRST;
	if (room != world->filter_room) {
		world->filter_room = 0;
		TRY(carom_events_create_list(world, ROLE_FILTERS, false, room, error));
		world->filter_room = room;
	}
	return send(world, ROLE_FILTERS, room, fill_filters, error);
}

/* A texel alone where nothing brakes any body. */
carom_status carom_friction_send(carom_world *world, carom_error *error)
{
	static const float zero[4] = {0};
	const uint32_t room = world->traits ? world->capacity : 1;
	if (room != world->friction_room) {
		world->friction_room = 0;
		TRY(carom_textures_create(world, ROLE_FRICTION, false, carom_row_width(room), carom_row_count(room), zero, error));
		world->friction_room = room;
	}
	return send(world, ROLE_FRICTION, room, fill_friction, error);
}

/* One after the other, since of millions of bodies each takes much memory. */
carom_status carom_textures_send(carom_world *world, carom_error *error)
{
	if (world->bodies_current)
		return CAROM_OK;
	TRY(send(world, ROLE_GEOMETRY, world->capacity, fill_geometry, error));
	TRY(send(world, ROLE_FORCES, world->capacity, fill_forces, error));
	TRY(carom_friction_send(world, error));
	TRY(carom_filters_send(world, error));
	TRY(send(world, ROLE_VERTICES, world->vertex_capacity, fill_vertices, error));
	TRY(carom_uniforms_send(world, error));
	world->bodies_current = true;
	return CAROM_OK;
}
