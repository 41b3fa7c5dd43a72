/* Bodies in a square room, no two touching, as full as asked for.
 * SPDX-License-Identifier: MIT */
#include "carom_placement.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define GAP 0.02 /* radii between the circles around two bodies at least: more than rounding to floats can close */
#define MIXED_KINDS 5

/* ---- The room ---- */

/* libm's sine may differ in the last bit from machine to machine. Taylor's series, for 0 <= x < 2.1. */
static double sine(double x)
{
	double term = x, sum = x;
	for (int k = 2; k < 30; k += 2) {
		term *= -x * x / (k * (k + 1.0));
		sum += term;
	}
	return sum;
}

/* Of a circle, or a regular polygon in a circle, of radius 1. */
static double unit_area(uint32_t sides)
{
	return sides == 0 ? PI : sides / 2.0 * sine(2 * PI / sides);
}

static uint32_t sides_of(const struct placement_def *def, uint32_t index)
{
	static const uint32_t kinds[MIXED_KINDS] = {0, 3, 4, 5, 6};
	return def->mixed ? kinds[index % MIXED_KINDS] : def->sides;
}

#define NOTCH 0.4 /* of a star's radius: how far the corners are from its middle that point inwards */

/* Of a star, or of what so many sides are, in a circle of radius 1. */
static double area_of(const struct placement_def *def, uint32_t sides)
{
	return def->points > 0 ? def->points * NOTCH * sine(PI / def->points) : unit_area(sides);
}

/* Each vertex is turned from the one before. */
static void fill_star(const struct placement_def *def, carom_vec2 *star)
{
	const double c = sine(PI / 2 - PI / def->points), s = sine(PI / def->points);
	struct point p = {def->radius, 0};
	for (uint32_t k = 0; k < 2 * def->points; k++) {
		const double part = k % 2 ? NOTCH : 1;
		star[k] = (carom_vec2){(float)(part * p.x), (float)(part * p.y)};
		p = (struct point){c * p.x - s * p.y, s * p.x + c * p.y};
	}
}

static double total_area(const struct placement_def *def)
{
	double area = 0;
	uint32_t kinds = def->mixed ? MIXED_KINDS : 1;
	for (uint32_t k = 0; k < kinds; k++)
		area += area_of(def, sides_of(def, k)) * (def->count / kinds + (k < def->count % kinds ? 1 : 0));
	return area * def->radius * def->radius;
}

/* Half a side, as the float that the scene will hold. */
static double half_of(const struct placement_def *def, double fill)
{
	double half = sqrt(total_area(def) / fill) / 2;
	return half < 1e38 ? (double)(float)half : INFINITY;
}

/* Half of the square that the centres keep to. */
static double inner_half(const struct placement_def *def, double fill)
{
	return half_of(def, fill) - def->radius * (1 + GAP / 2);
}

static bool fits(const struct placement_def *def, double fill)
{
	double inner = inner_half(def, fill);
	return inner >= 0 && lattice_fill(NULL, def->count, inner, NULL) > def->radius * (2 + GAP);
}

static carom_status fail_fill(const struct placement_def *def, carom_error *error)
{
	double low = 0, high = def->fill;
	for (int k = 0; k < 40; k++) {
		double middle = (low + high) / 2;
		*(fits(def, middle) ? &low : &high) = middle;
	}
	return wrong(error, "--fill: %u such bodies can't be packed to a fill of %g; allowed: up to %.3f", (unsigned)def->count, def->fill,
		floor(low * 1000) / 1000);
}

static carom_status check_def(const struct placement_def *def, carom_error *error)
{
	if (def->count < 1 || def->count > MAX_PLACED)
		return wrong(error, "--count: found %u; allowed: 1 to %u", (unsigned)def->count, MAX_PLACED);
	if (!(def->radius >= 1e-8) || !(def->radius <= 1e6))
		return wrong(error, "--radius: found %g; allowed: 1e-8 to 1e6 (m)", def->radius);
	if (!(def->speed >= 0) || !(def->speed <= 1e6))
		return wrong(error, "--speed: found %g; allowed: 0 to 1e6 (m/s)", def->speed);
	if (!fits(def, def->fill))
		return fail_fill(def, error);
	if (!(half_of(def, def->fill) * 0x1p-23 < def->radius * GAP / 8))
		return wrong(error, "--fill: %g makes a room so wide that floats in it can't tell touching bodies; take more", def->fill);
	return CAROM_OK;
}

/* ---- The bodies ---- */

static void shuffle(struct point *points, uint32_t count, struct random *random)
{
	for (uint32_t k = count - 1; k > 0; k--) {
		uint32_t other = random_below(random, k + 1);
		struct point held = points[k];
		points[k] = points[other];
		points[other] = held;
	}
}

/* Uniform in [-most, most); + 0 makes a plain zero of -0. */
static float uniform(struct random *random, double most)
{
	return (float)(most * random_signed(random) + 0.0);
}

static carom_body_def make_body(const struct placement_def *def, uint32_t index, struct point at, const carom_vec2 *star, struct random *random)
{
	carom_body_def body = carom_default_body_def();
	uint32_t sides = sides_of(def, index);
	body.shape = def->points > 0 ? CAROM_POLYGON : sides == 0 ? CAROM_CIRCLE : CAROM_REGULAR;
	body.sides = sides;
	body.vertices = star;
	body.vertex_count = 2 * def->points;
	body.radius = (float)def->radius;
	body.position = (carom_vec2){(float)at.x, (float)at.y};
	body.velocity.x = uniform(random, def->speed);
	body.velocity.y = uniform(random, def->speed);
	if (body.shape != CAROM_CIRCLE) {
		body.angle = uniform(random, PI);
		body.angular_velocity = uniform(random, def->speed);
	}
	return body;
}

carom_status placement_create(const struct placement_def *def, carom_body_def **bodies, float *half, carom_error *error)
{
	carom_status status = check_def(def, error);
	if (status != CAROM_OK)
		return status;
	struct random random = {def->seed};
	double inner = inner_half(def, def->fill), distance = def->radius * (2 + GAP);
	carom_body_def *made = malloc(def->count * sizeof *made + CAROM_MAX_VERTICES * sizeof(carom_vec2)); /* the star's vertices are behind them */
	struct point *points = malloc(def->count * sizeof *points);
	bool placed = made && points;
	if (placed) {
		double spacing = lattice_fill(points, def->count, inner, &random);
		double reach = def->count > 1 ? spacing - distance : inner;
		placed = shake(points, def->count, inner, distance, reach, &random);
	}
	if (placed) {
		carom_vec2 *star = (carom_vec2 *)(made + def->count);
		if (def->points > 0)
			fill_star(def, star);
		shuffle(points, def->count, &random);
		for (uint32_t k = 0; k < def->count; k++)
			made[k] = make_body(def, k, points[k], star, &random);
		*bodies = made;
		*half = (float)half_of(def, def->fill);
	} else {
		free(made);
		status = out_of_memory(error, "there is not enough memory for %u bodies", (unsigned)def->count);
	}
	free(points);
	return status;
}
