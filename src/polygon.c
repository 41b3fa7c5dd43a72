/* From a definition's polygon to the one that is kept: is it one, where is its centre of mass, and what are its moments? */
#include "polygon.h"

#include <math.h>

#include "point.h"
#include "status.h"

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

/* Every turn to the left, to rounding, and so convex, if it goes round once. `*turns`: how far they turn in all. */
static bool turns_left(const point *p, uint32_t n, double size, double *turns)
{
	bool left = true;
	*turns = 0.0;
	for (uint32_t i = 0; i < n; i++) {
		const point e = minus(p[(i + 1) % n], p[i]), f = minus(p[(i + 2) % n], p[(i + 1) % n]);
		left = left && !(cross(e, f) < -1e-7 * size * hypot(e.x, e.y));
		*turns += atan2(cross(e, f), dot(e, f));
	}
	return left;
}

static double distance_to_side(point p, point from, point to)
{
	const point side = minus(to, from);
	const double part = fmax(0.0, fmin(1.0, dot(minus(p, from), side) / dot(side, side)));
	const point away = minus(p, along(from, part, side));
	return hypot(away.x, away.y);
}

static bool sides_cross(point a, point b, point c, point d)
{
	const double of_c = cross(minus(b, a), minus(c, a)), of_d = cross(minus(b, a), minus(d, a));
	const double of_a = cross(minus(d, c), minus(a, c)), of_b = cross(minus(d, c), minus(b, c));
	return of_c * of_d < 0.0 && of_a * of_b < 0.0;
}

/* Do two sides that don't follow each other come nearer than that? */
static bool sides_meet(point a, point b, point c, point d, double near)
{
	return sides_cross(a, b, c, d) || distance_to_side(a, c, d) <= near || distance_to_side(b, c, d) <= near || distance_to_side(c, a, b) <= near
		|| distance_to_side(d, a, b) <= near;
}

/* Sides that follow each other lie on each other, or others meet. */
static bool meets_itself(const point *p, uint32_t n, double size)
{
	const double near = THINNEST * size;
	for (uint32_t i = 0; i < n; i++) {
		const point a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
		if (dot(minus(b, a), minus(c, b)) < 0.0 && (distance_to_side(a, b, c) <= near || distance_to_side(c, a, b) <= near))
			return true;
		for (uint32_t k = i + 2; k < n && (k + 1) % n != i; k++)
			if (sides_meet(a, b, p[k], p[(k + 1) % n], near))
				return true;
	}
	return false;
}

/* Counter-clockwise and simple: it goes round once, and meets itself nowhere. NULL, or what is wrong. */
static const char *flaw_of(const point *p, uint32_t n, double size, bool *is_convex)
{
	double turns;
	for (uint32_t i = 0; i < n; i++) {
		const point side = minus(p[(i + 1) % n], p[i]);
		if (hypot(side.x, side.y) <= THINNEST * size)
			return "has two vertices at the same place, or no farther apart than a millionth of its length";
	}
	*is_convex = turns_left(p, n, size, &turns);
	if (turns > 6.5 || (!*is_convex && meets_itself(p, n, size)))
		return "crosses or touches itself";
	return NULL;
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
static carom_status check(const point *p, uint32_t n, double area, size_t index, const char *once, bool *is_convex, carom_error *error)
{
	const double size = size_of(p, n);
	const char *flaw = flaw_of(p, n, size, is_convex);
	if (!flaw && !(area > THINNEST * size * size))
		flaw = "has no area, or at most a millionth of its length squared";
	if (!flaw)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT,
		"bodies[%zu].vertices: the polygon %s%s; it must have %d to %d vertices in order, and meet itself nowhere", index, flaw, once,
		CAROM_MIN_VERTICES, CAROM_MAX_VERTICES);
}

/* The polygon about its centre of mass, counter-clockwise; *centre is how far it was moved. */
static carom_status place(const carom_body_def *def, size_t index, point *p, uint32_t n, point *centre, carom_error *error)
{
	bool is_convex;
	double second, area = moments(p, n, centre, &second), size = size_of(p, n);
	if (area < 0.0)
		reverse(p, n);
	TRY(check(p, n, fabs(area), index, "", &is_convex, error));
	/* what rounding to floats left over when a centred polygon was written down is no offset: the more, the thinner it is */
	if (def->shape == CAROM_REGULAR || hypot(centre->x, centre->y) < (1e-6 + 2e-7 * size * size / fabs(area)) * size)
		*centre = (point){0.0, 0.0};
	for (uint32_t i = 0; i < n; i++)
		p[i] = minus(p[i], *centre);
	return CAROM_OK;
}

carom_status carom_polygon_make(const carom_body_def *def, size_t index, carom_polygon *polygon, carom_error *error)
{
	point p[CAROM_MAX_VERTICES] = {{0.0, 0.0}}, centre;
	const uint32_t n = def->shape == CAROM_REGULAR ? def->sides : def->vertex_count;
	for (uint32_t i = 0; def->shape == CAROM_POLYGON && i < n; i++)
		p[i] = exact_point(def->vertices[i]);
	if (def->shape == CAROM_REGULAR)
		regular_points(def, p);
	TRY(place(def, index, p, n, &centre, error));
	*polygon = (carom_polygon){.count = n, .recentred_by = rounded_point(centre)};
	for (uint32_t i = 0; i < n; i++) {
		polygon->vertices[i] = rounded_point(p[i]);
		p[i] = exact_point(polygon->vertices[i]);
		polygon->bound = fmax(polygon->bound, hypot(p[i].x, p[i].y));
	}
	polygon->area = moments(p, n, &centre, &polygon->second);
	return check(p, n, polygon->area, index, ", when its vertices are rounded to floats about its centre of mass", &polygon->is_convex, error);
}
