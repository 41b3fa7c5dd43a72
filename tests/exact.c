/* SPDX-License-Identifier: MIT */
#include "exact.h"

#include <math.h>

#include "outline.h"
#include "scenery.h"

typedef struct point {
	double x, y;
} point;

typedef struct placed {
	uint32_t count;
	point corners[CAROM_MAX_VERTICES], normals[CAROM_MAX_VERTICES]; /* of the faces from a corner to the next, outward */
} placed;

static placed place(const exact_body *k, double t)
{
	placed p;
	const double angle = k->angle + t * (k->w + 0.5 * t * k->b), c = cos(angle), s = sin(angle);
	const double x = k->x + t * (k->vx + 0.5 * t * k->ax), y = k->y + t * (k->vy + 0.5 * t * k->ay);
	p.count = k->count;
	for (uint32_t i = 0; i < k->count; i++) {
		const double *corner = k->corners[i], *normal = k->normals[i];
		p.corners[i] = (point){x + c * corner[0] - s * corner[1], y + s * corner[0] + c * corner[1]};
		p.normals[i] = (point){c * normal[0] - s * normal[1], s * normal[0] + c * normal[1]};
	}
	return p;
}

/* How far the face of p that separates best keeps q away; a circle, as its centre, has no face. */
static double best_face(const placed *p, const placed *q)
{
	double best = -INFINITY;
	for (uint32_t i = 0; p->count > 1 && i < p->count; i++) {
		const point from = p->corners[i], n = p->normals[i];
		double low = INFINITY;
		for (uint32_t k = 0; k < q->count; k++) {
			const double apart = n.x * (q->corners[k].x - from.x) + n.y * (q->corners[k].y - from.y);
			low = apart < low ? apart : low;
		}
		best = low > best ? low : best;
	}
	return best;
}

/* The square of the distance from a corner of q to an edge of p; a circle's centre is an edge without length. */
static double nearest_edge(const placed *p, const placed *q)
{
	double least = INFINITY;
	for (uint32_t i = 0; i < p->count; i++) {
		const point from = p->corners[i], to = p->corners[i + 1 < p->count ? i + 1 : 0], e = {to.x - from.x, to.y - from.y};
		const double square = e.x * e.x + e.y * e.y, inverse = square > 0.0 ? 1.0 / square : 0.0;
		for (uint32_t k = 0; k < q->count; k++) {
			const double x = q->corners[k].x - from.x, y = q->corners[k].y - from.y, along = (x * e.x + y * e.y) * inverse;
			const double part = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along, dx = x - part * e.x, dy = y - part * e.y;
			least = dx * dx + dy * dy < least ? dx * dx + dy * dy : least;
		}
	}
	return least;
}

static double distance_of_outlines(const exact_body *a, const exact_body *b, double t)
{
	exact_body moved[2] = {*a, *b};
	touch_move(&moved[0], t);
	touch_move(&moved[1], t);
	return outline_distance(&moved[0], &moved[1]);
}

double exact_distance(const exact_body *a, const exact_body *b, double t)
{
	if (a->is_concave || b->is_concave)
		return distance_of_outlines(a, b, t);
	const placed p = place(a, t), q = place(b, t);
	const double face = fmax(best_face(&p, &q), best_face(&q, &p));
	const bool apart = face > 0.0 || (a->count == 1 && b->count == 1);
	return (apart ? sqrt(fmin(nearest_edge(&p, &q), nearest_edge(&q, &p))) : face) - a->radius - b->radius;
}

double exact_corners(const exact_body *a, const exact_body *b, double t)
{
	const placed p = place(a, t), q = place(b, t);
	double least = INFINITY;
	for (uint32_t i = 0; p.count > 1 && q.count > 1 && i < p.count; i++)
		for (uint32_t k = 0; k < q.count; k++)
			least = fmin(least, hypot(q.corners[k].x - p.corners[i].x, q.corners[k].y - p.corners[i].y));
	return least;
}

double exact_fastest(const exact_body *a, const exact_body *b)
{
	const double speed = hypot(b->vx - a->vx, b->vy - a->vy) + hypot(b->ax - a->ax, b->ay - a->ay);
	return speed + (fabs(a->w) + fabs(a->b)) * a->bound + (fabs(b->w) + fabs(b->b)) * b->bound + 1e-12;
}

/* The distance of the circles about them where that is much, or else their own. */
static double at_least(const exact_body *a, const exact_body *b, double t)
{
	const double x = b->x - a->x + t * (b->vx - a->vx + 0.5 * t * (b->ax - a->ax));
	const double y = b->y - a->y + t * (b->vy - a->vy + 0.5 * t * (b->ay - a->ay));
	const double apart = hypot(x, y) - a->bound - b->bound;
	return apart > 0.05 * (a->bound + b->bound) ? apart : exact_distance(a, b, t);
}

static double bisect(const exact_body *a, const exact_body *b, double low, double high)
{
	while (high - low > 1e-12) {
		const double middle = 0.5 * (low + high);
		if (exact_distance(a, b, middle) > 0.0)
			low = middle;
		else
			high = middle;
	}
	return high;
}

exact_contact exact_search(const exact_body *a, const exact_body *b, double band, double end)
{
	const double fastest = exact_fastest(a, b);
	exact_contact found = {INFINITY, INFINITY, INFINITY, 0.0, INFINITY};
	double before = 0.0, t = 0.0;
	for (;;) {
		const double apart = at_least(a, b, t);
		found.least = fmin(found.least, apart);
		if (apart <= band)
			found.near = fmin(found.near, t);
		if (apart <= 0.0 && isinf(found.time)) {
			found.time = t > 0.0 ? bisect(a, b, before, t) : 0.0;
			found.speed = (exact_distance(a, b, found.time - 1e-7) - exact_distance(a, b, found.time + 1e-7)) / 2e-7;
		}
		if (apart <= -band) {
			found.deep = t;
			return found;
		}
		if (t >= end)
			return found;
		before = t;
		t = fmin(end, t + (apart > 2.0 * band ? apart - band : 0.5 * band) / fastest);
	}
}

static void set_corners(exact_body *k, const carom_vec2 *vertices)
{
	for (uint32_t i = 0; i < k->count; i++) {
		const carom_vec2 from = vertices[i], to = vertices[i + 1 < k->count ? i + 1 : 0];
		const double x = (double)to.x - (double)from.x, y = (double)to.y - (double)from.y, size = hypot(x, y);
		k->corners[i][0] = (double)from.x;
		k->corners[i][1] = (double)from.y;
		k->normals[i][0] = y / size;
		k->normals[i][1] = -x / size;
		k->bound = fmax(k->bound, hypot((double)from.x, (double)from.y));
	}
	for (uint32_t i = 0; i < k->count; i++) {
		const double *to = k->normals[i + 1 < k->count ? i + 1 : 0], turn = k->normals[i][0] * to[1] - k->normals[i][1] * to[0];
		k->is_concave = k->is_concave || turn < -1e-6;
	}
}

exact_body exact_of(carom_world *world, uint32_t index)
{
	const carom_world_def *def = carom_world_get_def(world);
	const double length = (double)def->time_step;
	carom_body_info info;
	carom_body_state s;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	scenery_check(carom_world_get_states(world, index, 1, &s, &error), &error);
	exact_body k = {.count = info.vertex_count,
		.radius = info.vertices ? 0.0 : (double)info.radius,
		.bound = (double)info.radius,
		.x = (double)s.position.x,
		.y = (double)s.position.y,
		.vx = (double)s.velocity.x * length,
		.vy = (double)s.velocity.y * length,
		.angle = (double)s.angle,
		.w = (double)s.angular_velocity * length};
	if (isfinite(info.mass)) {
		k.ax = ((double)def->gravity.x + (double)info.force.x / (double)info.mass) * length * length;
		k.ay = ((double)def->gravity.y + (double)info.force.y / (double)info.mass) * length * length;
		k.b = (double)info.torque / (double)info.inertia * length * length;
	}
	if (info.vertices)
		set_corners(&k, info.vertices);
	return k;
}
