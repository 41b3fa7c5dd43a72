/* From a body's definition to what the simulation needs: checks, centre of mass, mass and moment of inertia. */
#include <float.h>
#include <math.h>
#include <string.h>

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

typedef struct point {
	double x, y;
} point;

static double cross(point a, point b)
{
	return a.x * b.y - a.y * b.x;
}

static point minus(point a, point b)
{
	return (point){a.x - b.x, a.y - b.y};
}

/* Area and centre of mass, and the second moment about the origin per unit of density, by the triangles to the origin. */
static double moments(const point *p, uint32_t n, point *centre, double *second)
{
	double area = 0.0;
	point c = {0.0, 0.0};
	*second = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		point a = p[i], b = p[(i + 1) % n];
		double twice = cross(a, b);
		area += 0.5 * twice;
		c.x += twice * (a.x + b.x) / 6.0;
		c.y += twice * (a.y + b.y) / 6.0;
		*second += twice * (a.x * a.x + a.x * b.x + b.x * b.x + a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
	}
	if (area != 0.0) {
		c.x /= area;
		c.y /= area;
	}
	*centre = c;
	return area;
}

static void reverse(point *p, uint32_t n)
{
	for (uint32_t i = 0; i < n / 2; i++) {
		point t = p[i];
		p[i] = p[n - 1 - i];
		p[n - 1 - i] = t;
	}
}

#define THINNEST 1e-6 /* of a polygon's length, which its sides must exceed, and its area divided by its length */

/* Convex, counter-clockwise and simple: every turn to the left, and once round in all. NULL, or what is wrong. */
static const char *convex_flaw(const point *p, uint32_t n, double size)
{
	double half_turns = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		point e = minus(p[(i + 1) % n], p[i]), f = minus(p[(i + 2) % n], p[(i + 1) % n]);
		double edge = hypot(e.x, e.y);
		if (edge <= THINNEST * size)
			return "has two vertices at the same place, or no farther apart than a millionth of its length";
		if (cross(e, f) < -1e-7 * size * edge)
			return "is not convex, or crosses itself";
		half_turns += atan2(cross(e, f), e.x * f.x + e.y * f.y);
	}
	return half_turns > 6.5 ? "crosses itself" : NULL;
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

/* Sine and cosine of a part of a quarter turn, -0.5..0.5, by their series: the same bits with every C library. */
static point quarter_turn(double part)
{
	double x = part * 1.57079632679489661923, s = x, c = 1.0, term = x; /* x^k / k! */
	for (int k = 2; k < 22; k++) {
		term *= x / k;
		if (k % 2)
			s += k % 4 == 3 ? -term : term;
		else
			c += k % 4 == 2 ? -term : term;
	}
	return (point){c, s};
}

static void regular_points(const carom_body_def *def, point *p)
{
	for (uint32_t i = 0; i < def->sides; i++) {
		uint32_t quarters = (8 * i + def->sides) / (2 * def->sides); /* the nearest whole number to 4 i / sides */
		point q = quarter_turn(((double)(4 * i) - (double)(quarters * def->sides)) / def->sides);
		const point turned[4] = {{q.x, q.y}, {-q.y, q.x}, {-q.x, -q.y}, {q.y, -q.x}};
		p[i] = (point){def->radius * turned[quarters % 4].x, def->radius * turned[quarters % 4].y};
	}
}

/* Its length, from the first vertex to the farthest. */
static double size_of(const point *p, uint32_t n)
{
	double size = 0.0;
	for (uint32_t i = 0; i < n; i++)
		size = fmax(size, hypot(p[i].x - p[0].x, p[i].y - p[0].y));
	return size;
}

/* `once` says of which polygon it is. */
static carom_status check_polygon(const point *p, uint32_t n, double area, size_t index, const char *once, carom_error *error)
{
	const double size = size_of(p, n);
	const char *flaw = convex_flaw(p, n, size);
	char found[256];
	if (!flaw && !(area > THINNEST * size * size))
		flaw = "has no area, or at most a millionth of its length squared";
	if (!flaw)
		return CAROM_OK;
	snprintf(found, sizeof found, "the polygon %s%s; it must be convex, with %d to %d vertices in order", flaw, once, CAROM_MIN_VERTICES,
		CAROM_MAX_VERTICES);
	return fail(error, index, "vertices", found);
}

/* The polygon about its centre of mass, counter-clockwise; *centre is how far it was moved. */
static carom_status place_polygon(const carom_body_def *def, size_t index, point *p, uint32_t n, point *centre, carom_error *error)
{
	double second, area = moments(p, n, centre, &second), size = size_of(p, n);
	if (area < 0.0)
		reverse(p, n);
	TRY(check_polygon(p, n, fabs(area), index, "", error));
	/* what rounding to floats left over when a centred polygon was written down is no offset: the more, the thinner it is */
	if (def->shape == CAROM_REGULAR || hypot(centre->x, centre->y) < (1e-6 + 2e-7 * size * size / fabs(area)) * size)
		*centre = (point){0.0, 0.0};
	for (uint32_t i = 0; i < n; i++)
		p[i] = minus(p[i], *centre);
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
	body->vertex_count = 1;
	set_mass(def, body, area, 0.5 * area * r * r);
	return CAROM_OK;
}

static carom_status make_polygon(const carom_body_def *def, size_t index, carom_body *body, carom_vec2 *vertices, carom_error *error)
{
	point p[CAROM_MAX_VERTICES] = {{0.0, 0.0}}, centre, rounded[CAROM_MAX_VERTICES];
	double second, area, bound = 0.0;
	uint32_t n = def->shape == CAROM_REGULAR ? def->sides : def->vertex_count;
	carom_status status;
	for (uint32_t i = 0; def->shape == CAROM_POLYGON && i < n; i++)
		p[i] = (point){def->vertices[i].x, def->vertices[i].y};
	if (def->shape == CAROM_REGULAR)
		regular_points(def, p);
	status = place_polygon(def, index, p, n, &centre, error);
	if (status)
		return status;
	for (uint32_t i = 0; i < n; i++) {
		vertices[i] = (carom_vec2){(float)p[i].x, (float)p[i].y};
		rounded[i] = (point){vertices[i].x, vertices[i].y};
		bound = fmax(bound, hypot(rounded[i].x, rounded[i].y));
	}
	area = moments(rounded, n, &p[0], &second);
	TRY(check_polygon(rounded, n, area, index, ", when its vertices are rounded to floats about its centre of mass", error));
	body->radius = def->shape == CAROM_REGULAR ? def->radius : 0.0f;
	body->bound = nextafterf((float)bound, INFINITY);
	body->vertex_count = (uint8_t)n;
	body->recentred_by = (carom_vec2){(float)centre.x, (float)centre.y};
	set_mass(def, body, area, second);
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
