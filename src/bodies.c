/* From a body's definition to what the simulation needs: checks, mass and moment of inertia. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "polygon.h"
#include "status.h"
#include "world.h"

carom_body_def carom_default_body_def(void)
{
	carom_body_def def = {.shape = CAROM_CIRCLE,
		.density = 1.0f,
		.restitution = NAN,
		.friction = NAN,
		.rolling_friction = NAN,
		.linear_damping = NAN,
		.angular_damping = NAN,
		.categories = CAROM_CATEGORIES,
		.mask = CAROM_MASK,
		.color = CAROM_COLOR_AUTO};
	return def;
}

carom_body *carom_world_bodies(const carom_world *world)
{
	return world->bodies.items;
}

static carom_status fail(carom_error *error, size_t index, const char *field, const char *found)
{
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "bodies[%zu].%s: %s", index, field, found);
}

static carom_status fail_number(carom_error *error, size_t index, const char *field, double found, const char *allowed)
{
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "bodies[%zu].%s: found %g, must be %s", index, field, found, allowed);
}

static carom_status check_numbers(const carom_body_def *def, size_t index, carom_error *error)
{
	if (!carom_is_finite(def->position))
		return fail(error, index, "position", "must be two finite numbers (m)");
	if (!carom_is_finite(def->velocity))
		return fail(error, index, "velocity", "must be two finite numbers (m/s)");
	if (!carom_is_finite(def->force))
		return fail(error, index, "force", "must be two finite numbers (N)");
	if (!isfinite(def->angle))
		return fail(error, index, "angle", "must be a finite number (rad)");
	if (!isfinite(def->angular_velocity))
		return fail(error, index, "angular_velocity", "must be a finite number (rad/s)");
	if (!isfinite(def->torque))
		return fail(error, index, "torque", "must be a finite number (N m)");
	if (!isnan(def->restitution) && !(def->restitution >= 0.0f && def->restitution <= 1.0f))
		return fail_number(error, index, "restitution", (double)def->restitution, "from 0 to 1");
	if (!isnan(def->friction) && !carom_is_friction(def->friction))
		return fail_number(error, index, "friction", (double)def->friction, "from 0 to 1000");
	if (!isnan(def->rolling_friction) && !carom_is_friction(def->rolling_friction))
		return fail_number(error, index, "rolling_friction", (double)def->rolling_friction, "from 0 to 1000");
	if (!isnan(def->linear_damping) && !carom_is_damping(def->linear_damping))
		return fail_number(error, index, "linear_damping", (double)def->linear_damping, "finite and at least 0 (1/s)");
	if (!isnan(def->angular_damping) && !carom_is_damping(def->angular_damping))
		return fail_number(error, index, "angular_damping", (double)def->angular_damping, "finite and at least 0 (1/s)");
	if (!(def->mass >= 0.0f) || !isfinite(def->mass))
		return fail_number(error, index, "mass", (double)def->mass, "above 0 (kg), or 0 for the density's");
	if (def->mass == 0.0f && (!(def->density > 0.0f) || !isfinite(def->density)))
		return fail_number(error, index, "density", (double)def->density, "above 0 (kg/m^2)");
	if (def->color != CAROM_COLOR_AUTO && def->color > 0xFFFFFFu)
		return fail(error, index, "color", "must be 0xRRGGBB or CAROM_COLOR_AUTO");
	if (def->is_static && (def->velocity.x != 0.0f || def->velocity.y != 0.0f || def->angular_velocity != 0.0f))
		return fail(error, index, "velocity", "a static body does not move: leave out its velocities, or `static`");
	if (def->is_static && def->is_kinematic)
		return fail(error, index, "is_kinematic", "a static body does not move, and a kinematic one does: leave out one of the two");
	if ((def->is_static || def->is_kinematic) && (def->force.x != 0.0f || def->force.y != 0.0f || def->torque != 0.0f))
		return fail(error, index, "force",
			def->is_static ? "a static body feels no force: leave out force and torque, or `static`"
						   : "a kinematic body feels no force: leave out force and torque, or `kinematic`");
	return CAROM_OK;
}

static carom_status check_shape(const carom_body_def *def, size_t index, carom_error *error)
{
	uint32_t count = def->shape == CAROM_REGULAR ? def->sides : def->vertex_count;
	if ((def->shape == CAROM_CIRCLE || def->shape == CAROM_REGULAR) && (!(def->radius > 0.0f) || !isfinite(def->radius)))
		return fail_number(error, index, "radius", (double)def->radius, "above 0 (m)");
	if (def->shape == CAROM_CIRCLE)
		return CAROM_OK;
	if (def->shape != CAROM_POLYGON && def->shape != CAROM_REGULAR)
		return fail(error, index, "shape", "is none of CAROM_CIRCLE, CAROM_POLYGON, CAROM_REGULAR");
	if (count < CAROM_MIN_VERTICES || count > CAROM_MAX_VERTICES)
		return fail_number(error, index, def->shape == CAROM_REGULAR ? "sides" : "vertices", count, "3 to 64 of them");
	if (def->shape == CAROM_POLYGON && !def->vertices)
		return fail(error, index, "vertices", "are missing");
	for (uint32_t i = 0; def->shape == CAROM_POLYGON && i < count; i++)
		if (!carom_is_finite(def->vertices[i]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "bodies[%zu].vertices[%u]: must be two finite numbers (m)", index, (unsigned)i);
	return CAROM_OK;
}

static void set_mass(const carom_body_def *def, carom_body *body, double area, double second)
{
	double mass = def->mass > 0.0f ? (double)def->mass : (double)def->density * area;
	body->density = def->mass > 0.0f ? 0.0f : def->density;
	body->mass = carom_is_dynamic(body) ? (float)mass : INFINITY;
	body->inertia = carom_is_dynamic(body) ? (float)(mass * second / area) : INFINITY;
}

static carom_status make_circle(const carom_body_def *def, carom_body *body)
{
	double r = (double)def->radius, area = 3.14159265358979323846 * r * r;
	body->radius = body->bound = def->radius;
	body->vertex_count = body->hull_count = 1;
	body->is_convex = true;
	set_mass(def, body, area, 0.5 * area * r * r);
	return CAROM_OK;
}

static carom_status make_polygon(const carom_body_def *def, size_t index, carom_body *body, carom_vec2 *vertices, carom_error *error)
{
	carom_polygon polygon;
	TRY(carom_polygon_make(def, index, &polygon, error));
	memcpy(vertices, polygon.vertices, polygon.count * sizeof *vertices);
	body->radius = def->shape == CAROM_REGULAR ? def->radius : 0.0f;
	body->bound = nextafterf((float)polygon.bound, INFINITY);
	body->vertex_count = (uint8_t)polygon.count;
	body->is_convex = polygon.is_convex;
	body->recentred_by = polygon.recentred_by;
	set_mass(def, body, polygon.area, polygon.second);
	return CAROM_OK;
}

/* Kernels divide by masses and square lengths, and some devices take floats below FLT_MIN for 0. */
static bool is_computable(const carom_body *body)
{
	const float numbers[2] = {body->mass, body->inertia};
	for (int i = 0; i < 2 && carom_is_dynamic(body); i++)
		if (!(numbers[i] >= FLT_MIN && numbers[i] <= 1.0f / FLT_MIN))
			return false;
	return body->bound >= 1e-12f && body->bound <= 1e12f;
}

/* A body's number, or where it has none the world's. */
static float own_or(float own, float worlds)
{
	return isnan(own) ? worlds : own;
}

carom_status carom_body_make(const carom_body_def *def, const carom_world_def *world, size_t index, carom_body *body, carom_vec2 *vertices,
	carom_error *error)
{
	carom_status status = check_numbers(def, index, error);
	if (!status)
		status = check_shape(def, index, error);
	if (status)
		return status;
	memset(body, 0, sizeof *body);
	body->shape = (uint8_t)def->shape;
	body->restitution = own_or(def->restitution, world->restitution);
	body->friction = own_or(def->friction, world->friction);
	body->rolling_friction = own_or(def->rolling_friction, world->rolling_friction);
	body->linear_damping = own_or(def->linear_damping, world->linear_damping);
	body->angular_damping = own_or(def->angular_damping, world->angular_damping);
	body->force = def->force;
	body->torque = def->torque;
	body->color = def->color;
	body->categories = def->categories;
	body->mask = def->mask;
	body->is_static = def->is_static;
	body->is_kinematic = def->is_kinematic;
	status = def->shape == CAROM_CIRCLE ? make_circle(def, body) : make_polygon(def, index, body, vertices, error);
	if (!status && !is_computable(body))
		status = fail(error, index, "mass",
			"the mass or moment of inertia is no float to compute with: the body is too small, too large, too light or too heavy");
	return status;
}
