/* SPDX-License-Identifier: MIT */
#include "touch.h"

#include <math.h>
#include <string.h>

#include "layout.h"
#include "outline.h"

typedef double corners[CAROM_MAX_VERTICES][2];

typedef struct face {
	int index, deepest; /* of the face, and of the other body's corner nearest to it */
	double apart;
} face;

static double inner(const double *a, const double *b)
{
	return a[0] * b[0] + a[1] * b[1];
}

static double cross(const double *a, const double *b)
{
	return a[0] * b[1] - a[1] * b[0];
}

void touch_move(exact_body *k, double t)
{
	k->x += t * (k->vx + 0.5 * t * k->ax);
	k->y += t * (k->vy + 0.5 * t * k->ay);
	k->angle += t * (k->w + 0.5 * t * k->b);
	k->vx += t * k->ax;
	k->vy += t * k->ay;
	k->w += t * k->b;
}

/* Of `which`, corners or normals: turned as the body is, but about its centre. */
static void turned(const exact_body *k, const double (*which)[2], corners out)
{
	const double c = cos(k->angle), s = sin(k->angle);
	for (uint32_t i = 0; i < k->count; i++) {
		out[i][0] = c * which[i][0] - s * which[i][1];
		out[i][1] = s * which[i][0] + c * which[i][1];
	}
}

/* ---- How */

static double rate_of(const exact_body *r, const exact_body *i, const touch *t, int point)
{
	const double *n = t->normal, v[2] = {i->vx - r->vx, i->vy - r->vy};
	return inner(n, v) + r->w * cross(n, t->reference[point]) - i->w * cross(n, t->incident[point]);
}

static double slop_of(const exact_body *a, const exact_body *b)
{
	return (fmax(fmax(fabs(a->x), fabs(a->y)), fmax(fabs(b->x), fabs(b->y))) + a->bound + b->bound) * (double)SLOP;
}

static touch touch_circles(const exact_body *a, const exact_body *b)
{
	const double d[2] = {b->x - a->x, b->y - a->y}, apart = hypot(d[0], d[1]);
	touch t = {.count = 1, .normal = {1.0, 0.0}};
	if (apart > 0.0)
		t.normal[0] = d[0] / apart, t.normal[1] = d[1] / apart;
	return t; /* levers along the normal turn nothing: they may as well be 0 */
}

static face best_face(const exact_body *a, const exact_body *b, const double *d, corners at, corners normal, corners other)
{
	face best = {0, 0, -INFINITY};
	for (int i = 0; i < (int)a->count; i++) {
		face f = {i, 0, INFINITY};
		for (int k = 0; k < (int)b->count; k++) {
			const double from[2] = {d[0] + other[k][0] - at[i][0], d[1] + other[k][1] - at[i][1]}, apart = inner(normal[i], from);
			if (apart < f.apart)
				f.apart = apart, f.deepest = k;
		}
		if (f.apart > best.apart)
			best = f;
	}
	return best;
}

/* Beyond the ends of all faces it is the corner nearest to a circle's centre that touches. */
static void turn_to_corner(touch *t, const exact_body *a, corners at, const double *centre)
{
	double least = INFINITY, normal[2] = {1.0, 0.0};
	for (uint32_t i = 0; i < a->count; i++) {
		const double *to = at[(i + 1) % a->count], edge[2] = {to[0] - at[i][0], to[1] - at[i][1]},
					 away[2] = {centre[0] - at[i][0], centre[1] - at[i][1]};
		const double along = inner(edge, away), size = hypot(away[0], away[1]);
		if (cross(away, edge) > 0.0 && along >= 0.0 && along <= inner(edge, edge))
			return;
		if (size < least)
			least = size, normal[0] = away[0] / size, normal[1] = away[1] / size;
	}
	memcpy(t->normal, normal, sizeof normal);
}

static touch touch_polygon_circle(const exact_body *a, const exact_body *b)
{
	const double d[2] = {b->x - a->x, b->y - a->y};
	corners at, normal, centre;
	touch t = {.count = 1};
	turned(a, a->corners, at);
	turned(a, a->normals, normal);
	turned(b, b->corners, centre);
	const face f = best_face(a, b, d, at, normal, centre);
	memcpy(t.normal, normal[f.index], sizeof t.normal);
	if (f.apart > 0.0)
		turn_to_corner(&t, a, at, d);
	for (int k = 0; k < 2; k++)
		t.reference[0][k] = d[k] - b->radius * t.normal[k];
	return t;
}

static void add_point(touch *t, const double *d, const double *point)
{
	for (int k = 0; k < 2; k++) {
		t->reference[t->count][k] = point[k];
		t->incident[t->count][k] = point[k] - d[k];
	}
	t->count++;
}

/* The incident edge, u to v, cut to what lies on the face `from` to `to`. False if nothing does. */
static bool clip(const double *from, const double *to, double *u, double *v)
{
	const double edge[2] = {to[0] - from[0], to[1] - from[1]}, square = inner(edge, edge);
	const double ufrom[2] = {u[0] - from[0], u[1] - from[1]}, vfrom[2] = {v[0] - from[0], v[1] - from[1]};
	const double low = inner(edge, ufrom) / square, high = inner(edge, vfrom) / square, whole[4] = {u[0], u[1], v[0], v[1]};
	const double first = fmin(fmax(low, 0.0), 1.0), last = fmin(fmax(high, 0.0), 1.0);
	for (int k = 0; k < 2 && fabs(high - low) > 0.0; k++) {
		u[k] = whole[k] + (whole[2 + k] - whole[k]) * (first - low) / (high - low);
		v[k] = whole[k] + (whole[2 + k] - whole[k]) * (last - low) / (high - low);
	}
	return fmax(low, high) >= 0.0 && fmin(low, high) <= 1.0;
}

/* Of the two edges at the deepest corner the one that is more level with the face. */
static int incident_edge(const exact_body *b, const face *f, corners other, const double *n)
{
	const int count = (int)b->count, before = (f->deepest + count - 1) % count, after = (f->deepest + 1) % count;
	const double *m = other[f->deepest], e1[2] = {m[0] - other[before][0], m[1] - other[before][1]};
	const double e2[2] = {other[after][0] - m[0], other[after][1] - m[1]};
	return fabs(inner(n, e2)) * hypot(e1[0], e1[1]) < fabs(inner(n, e1)) * hypot(e2[0], e2[1]) ? f->deepest : before;
}

static void add_points(touch *t, const exact_body *b, const face *f, const double *d, const double *from, const double *to, corners other,
	double slop)
{
	const int e = incident_edge(b, f, other, t->normal), next = (e + 1) % (int)b->count;
	double ends[2][2] = {{d[0] + other[e][0], d[1] + other[e][1]}, {d[0] + other[next][0], d[1] + other[next][1]}};
	if (clip(from, to, ends[0], ends[1])) {
		for (int k = 0; k < 2; k++) {
			const double above[2] = {ends[k][0] - from[0], ends[k][1] - from[1]};
			if (inner(t->normal, above) <= f->apart + slop)
				add_point(t, d, ends[k]);
		}
	}
	if (t->count == 0)
		add_point(t, d, (double[]){d[0] + other[f->deepest][0], d[1] + other[f->deepest][1]});
}

static touch touch_polygons(const exact_body *a, const exact_body *b)
{
	const double d[2] = {b->x - a->x, b->y - a->y}, back[2] = {-d[0], -d[1]}, slop = slop_of(a, b);
	corners at[2], normal[2];
	touch t = {0};
	turned(a, a->corners, at[0]);
	turned(a, a->normals, normal[0]);
	turned(b, b->corners, at[1]);
	turned(b, b->normals, normal[1]);
	const face fa = best_face(a, b, d, at[0], normal[0], at[1]), fb = best_face(b, a, back, at[1], normal[1], at[0]);
	t.swapped = fb.apart > fa.apart;
	const face *f = t.swapped ? &fb : &fa;
	const int next = (f->index + 1) % (int)(t.swapped ? b->count : a->count);
	memcpy(t.normal, normal[t.swapped][f->index], sizeof t.normal);
	add_points(&t, t.swapped ? a : b, f, t.swapped ? back : d, at[t.swapped][f->index], at[t.swapped][next], at[!t.swapped], slop);
	return t;
}

touch touch_pair(const exact_body *a, const exact_body *b)
{
	touch t;
	if (a->is_concave || b->is_concave) {
		t = outline_touch(a, b, slop_of(a, b));
	} else if (a->count > 1 && b->count > 1) {
		t = touch_polygons(a, b);
	} else if (a->count == 1 && b->count == 1) {
		t = touch_circles(a, b);
	} else {
		t = a->count > 1 ? touch_polygon_circle(a, b) : touch_polygon_circle(b, a);
		t.swapped = a->count == 1;
	}
	for (int k = 0; k < t.count; k++)
		t.rate[k] = rate_of(t.swapped ? b : a, t.swapped ? a : b, &t, k);
	return t;
}

/* ---- Walls */

static double wall_gap(const exact_body *k, const touch_room *room, int wall, double t)
{
	const double n = wall < 2 ? 1.0 : -1.0, offset = wall < 2 ? room->min[wall] : -room->max[wall - 2];
	exact_body moved = *k;
	corners at;
	double low = INFINITY;
	touch_move(&moved, t);
	turned(&moved, k->corners, at);
	for (uint32_t i = 0; i < k->count; i++)
		low = fmin(low, n * at[i][wall % 2]);
	return n * (wall % 2 ? moved.y : moved.x) + low - offset - k->radius;
}

static double wall_slop(const exact_body *k)
{
	return (fmax(fabs(k->x), fabs(k->y)) + k->bound) * (double)SLOP;
}

touch touch_wall(const exact_body *k, const touch_room *room, int wall)
{
	static const exact_body still;
	const double slop = wall_slop(k), gap = wall_gap(k, room, wall, 0.0);
	touch t = {.count = k->count == 1 ? 1 : 0};
	int ends[2] = {-1, -1};
	corners at;
	t.normal[wall % 2] = wall < 2 ? 1.0 : -1.0;
	turned(k, k->corners, at);
	for (int i = 0; i < (int)k->count && k->count > 1; i++) {
		const double offset = wall < 2 ? room->min[wall] : -room->max[wall - 2];
		if (inner(t.normal, at[i]) + t.normal[wall % 2] * (wall % 2 ? k->y : k->x) - offset > gap + slop)
			continue;
		ends[0] = ends[0] < 0 || cross(t.normal, at[i]) < cross(t.normal, at[ends[0]]) ? i : ends[0];
		ends[1] = ends[1] < 0 || cross(t.normal, at[i]) > cross(t.normal, at[ends[1]]) ? i : ends[1];
	}
	for (int e = 0; e < (ends[0] == ends[1] ? 1 : 2) && k->count > 1; e++)
		memcpy(t.incident[t.count++], at[ends[e]], sizeof at[0]);
	for (int e = 0; e < t.count; e++)
		t.rate[e] = rate_of(&still, k, &t, e);
	return t;
}

/* ---- When */

typedef struct search {
	const exact_body *a, *b;
	const touch_room *room; /* NULL: a and b; else a and the wall */
	int wall;
	double fastest, stillness;
	double slop, skin; /* m */
	double creep;      /* CONTRACT's, or CREEP_SHORT: so late is an approach seen that begins while they touch; they move by the slop or less */
} search;

double touch_stillness(const exact_body *a, const exact_body *b)
{
	static const exact_body wall;
	const exact_body *both[2] = {a, b ? b : &wall};
	double sum = 0.0;
	for (int i = 0; i < 2; i++) {
		const exact_body *k = both[i];
		sum += fabs(k->vx) + fabs(k->vy) + fabs(k->ax) + fabs(k->ay) + (fabs(k->w) + fabs(k->b)) * k->bound;
	}
	return sum * (double)APPROACH;
}

static search search_of(const exact_body *a, const exact_body *b, const touch_room *room, int wall, double skin)
{
	static const exact_body still = {.count = 1};
	search s = {a, b, room, wall, exact_fastest(a, b ? b : &still), touch_stillness(a, b), b ? slop_of(a, b) : wall_slop(a), 0.0, 0.0};
	s.skin = skin * s.slop;
	s.creep = fmin((double)CREEP_MOST, fmax(s.slop * (double)APPROACH / s.stillness, (double)CREEP_SHORT));
	return s;
}

static double gap_of(const search *s, double t)
{
	if (s->room)
		return wall_gap(s->a, s->room, s->wall, t) - s->skin;
	const double x = s->b->x - s->a->x + t * (s->b->vx - s->a->vx + 0.5 * t * (s->b->ax - s->a->ax));
	const double y = s->b->y - s->a->y + t * (s->b->vy - s->a->vy + 0.5 * t * (s->b->ay - s->a->ay));
	const double apart = hypot(x, y) - s->a->bound - s->b->bound;
	return (apart > 0.05 * (s->a->bound + s->b->bound) ? apart : exact_distance(s->a, s->b, t)) - s->skin;
}

static bool approach(const search *s, double at)
{
	exact_body a = *s->a, b = {0};
	touch t;
	touch_move(&a, at);
	if (s->room) {
		t = touch_wall(&a, s->room, s->wall);
	} else {
		b = *s->b;
		touch_move(&b, at);
		t = touch_pair(&a, &b);
	}
	const double stillness = touch_stillness(&a, s->room ? NULL : &b);
	return t.rate[0] < -stillness || (t.count > 1 && t.rate[1] < -stillness);
}

static double bisect(const search *s, double low, double high)
{
	while (high - low > 1e-15) {
		const double middle = 0.5 * (low + high);
		if (middle <= low || middle >= high)
			break;
		if (gap_of(s, middle) > 0.0)
			low = middle;
		else
			high = middle;
	}
	return high;
}

/* Nobody moves faster than `fastest`, so that no sample can be beyond a contact by more than a creep: what is grazed less deep than
 * the slop may be overlooked. */
static double walk(const search *s, double end)
{
	double before = 0.0, t = 0.0;
	bool apart = false;
	for (;;) {
		const double gap = gap_of(s, t);
		if (gap <= 0.0 && approach(s, t))
			return apart ? bisect(s, before, t) : t;
		if (t >= end)
			return INFINITY;
		apart = gap > 0.0;
		before = t;
		t = fmin(end, t + fmax(gap / s->fastest, gap > 0.25 * s->slop ? 0.0 : s->creep));
	}
}

/* In straight lines against each other: gap and speeds by the quadratic. */
static double circles_time(const search *s, double end)
{
	const double d[2] = {s->b->x - s->a->x, s->b->y - s->a->y}, v[2] = {s->b->vx - s->a->vx, s->b->vy - s->a->vy};
	const double reach = s->a->radius + s->b->radius, distance = hypot(d[0], d[1]), speed = inner(v, v), sum = inner(d, v);
	if (distance <= reach)
		return sum < -s->stillness * distance ? 0.0 : INFINITY;
	const double miss = cross(d, v), under = reach * reach * speed - miss * miss;
	if (sum >= 0.0 || under <= s->stillness * reach * s->stillness * reach)
		return INFINITY;
	const double t = (distance - reach) * (distance + reach) / (sqrt(under) - sum);
	return t <= end ? t : INFINITY;
}

double touch_pair_time(const exact_body *a, const exact_body *b, double skin, double end)
{
	const search s = search_of(a, b, NULL, 0, skin);
	const double apart = hypot(b->x - a->x, b->y - a->y) - a->bound - b->bound;
	if (apart > end * s.fastest + s.skin)
		return INFINITY;
	const bool straight = a->ax == b->ax && a->ay == b->ay;
	return straight && a->count == 1 && b->count == 1 ? circles_time(&s, end) : walk(&s, end);
}

/* gap + rate t + push t^2 / 2 comes to 0 from above. */
static double fall_time(double gap, double rate, double push)
{
	const double height = fmax(gap, 0.0), under = rate * rate - 2.0 * push * height;
	if (rate < 0.0)
		return under < 0.0 ? INFINITY : 2.0 * height / (sqrt(under) - rate);
	return push < 0.0 ? (rate + sqrt(under)) / -push : INFINITY;
}

double touch_wall_time(const exact_body *k, const touch_room *room, int wall, double skin, double end)
{
	const double n = wall < 2 ? 1.0 : -1.0, rate = n * (wall % 2 ? k->vy : k->vx), push = n * (wall % 2 ? k->ay : k->ax);
	const double centre = n * ((wall % 2 ? k->y : k->x) - (wall < 2 ? room->min[wall] : room->max[wall - 2]));
	const search s = search_of(k, NULL, room, wall, skin);
	if (centre - k->bound > s.fastest * end + s.skin)
		return INFINITY;
	if (k->count > 1)
		return walk(&s, end);
	double t = fall_time(centre - k->radius, rate, push);
	if (t <= end && rate + t * push >= -s.stillness)
		t = push < 0.0 ? fmax(t, (-s.stillness - rate) / push) : INFINITY;
	return t <= end ? t : INFINITY;
}
