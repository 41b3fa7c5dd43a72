/* SPDX-License-Identifier: MIT */
#include "outline.h"

#include <math.h>

#include "layout.h"
#include "scenery.h"

#define DEEPEST 64.0 /* slops: so deep rounding may sink what touches */
#define MOST_SPOTS 256

/* Turned, about the centre of a. */
typedef struct placed {
	int count;
	double at[CAROM_MAX_VERTICES][2], normal[CAROM_MAX_VERTICES][2];
} placed;

static double inner(const double *a, const double *b)
{
	return a[0] * b[0] + a[1] * b[1];
}

static double cross(const double *a, const double *b)
{
	return a[0] * b[1] - a[1] * b[0];
}

static void minus(const double *a, const double *b, double *out)
{
	out[0] = a[0] - b[0];
	out[1] = a[1] - b[1];
}

static placed place(const exact_body *k, const exact_body *about)
{
	const double c = cos(k->angle), s = sin(k->angle), d[2] = {k->x - about->x, k->y - about->y};
	placed p = {.count = (int)k->count};
	for (int i = 0; i < p.count; i++) {
		p.at[i][0] = d[0] + c * k->corners[i][0] - s * k->corners[i][1];
		p.at[i][1] = d[1] + s * k->corners[i][0] + c * k->corners[i][1];
		p.normal[i][0] = c * k->normals[i][0] - s * k->normals[i][1];
		p.normal[i][1] = s * k->normals[i][0] + c * k->normals[i][1];
	}
	return p;
}

static const double *at(const placed *p, int i)
{
	return p->at[(i + p->count) % p->count];
}

/* ---- How far */

static double from_side(const placed *p, int i, const double *point)
{
	double side[2], away[2];
	minus(at(p, i + 1), at(p, i), side);
	minus(point, at(p, i), away);
	const double part = fmax(0.0, fmin(1.0, inner(side, away) / inner(side, side)));
	return hypot(away[0] - part * side[0], away[1] - part * side[1]);
}

static double from_outline(const placed *p, const double *point)
{
	double least = INFINITY;
	for (int i = 0; i < p->count; i++)
		least = fmin(least, from_side(p, i, point));
	return least;
}

/* Does a ray from the point cross the outline an odd number of times? */
static bool holds(const placed *p, const double *point)
{
	bool odd = false;
	for (int i = 0; i < p->count; i++) {
		const double *a = at(p, i), *b = at(p, i + 1);
		if ((a[1] > point[1]) != (b[1] > point[1]) && point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]))
			odd = !odd;
	}
	return odd;
}

/* How far the side from a to b, and that from c to d, would have to be moved not to cross; below 0 if they don't. */
static double crossing(const double *a, const double *b, const double *c, const double *d)
{
	double ab[2], cd[2], ac[2], ad[2], cb[2];
	minus(b, a, ab);
	minus(d, c, cd);
	minus(c, a, ac);
	minus(d, a, ad);
	minus(b, c, cb);
	const double of_c = cross(ab, ac), of_d = cross(ab, ad), of_a = -cross(cd, ac), of_b = cross(cd, cb);
	if (!(of_c * of_d < 0.0 && of_a * of_b < 0.0))
		return -1.0;
	return fmin(fmin(fabs(of_a), fabs(of_b)) / hypot(cd[0], cd[1]), fmin(fabs(of_c), fabs(of_d)) / hypot(ab[0], ab[1]));
}

/* Of q's vertices from p's sides, and how deep they are within p. */
static void look_at_vertices(const placed *p, const placed *q, double *least, double *deepest)
{
	for (int i = 0; i < q->count; i++) {
		const double apart = from_outline(p, q->at[i]);
		*least = fmin(*least, apart);
		if (holds(p, q->at[i]))
			*deepest = fmax(*deepest, apart);
	}
}

static void look_at_crossings(const placed *p, const placed *q, double *deepest)
{
	for (int i = 0; i < p->count; i++)
		for (int k = 0; k < q->count; k++)
			*deepest = fmax(*deepest, crossing(at(p, i), at(p, i + 1), at(q, k), at(q, k + 1)));
}

double outline_distance(const exact_body *a, const exact_body *b)
{
	const placed p = place(a, a), q = place(b, a);
	double least = INFINITY, deepest = -1.0;
	if (a->count > 1)
		look_at_vertices(&p, &q, &least, &deepest);
	if (b->count > 1)
		look_at_vertices(&q, &p, &least, &deepest);
	if (a->count > 1 && b->count > 1)
		look_at_crossings(&p, &q, &deepest);
	return (deepest < 0.0 ? least : -deepest) - a->radius - b->radius;
}

/* ---- How */

/* One point where they touch, seen from a to b. */
typedef struct spot {
	double normal[2], lever[2][2], rate;
	bool swapped; /* the side is b's */
} spot;

typedef struct spots {
	const exact_body *bodies[2];
	placed outlines[2];
	double gap, deep, slop; /* m: what is no farther, and no deeper, touches; and what rounding makes of a level side */
	int count;
	spot list[MOST_SPOTS];
} spots;

static void add_spot(spots *all, int sided, const double *normal, const double *point)
{
	const exact_body *a = all->bodies[0], *b = all->bodies[1];
	const double sign = sided ? -1.0 : 1.0, d[2] = {b->x - a->x, b->y - a->y}, v[2] = {b->vx - a->vx, b->vy - a->vy};
	spot s = {.swapped = sided != 0};
	for (int k = 0; k < 2; k++) {
		s.normal[k] = sign * normal[k];
		s.lever[0][k] = point[k];
		s.lever[1][k] = point[k] - d[k];
	}
	s.rate = inner(s.normal, v) + a->w * cross(s.normal, s.lever[0]) - b->w * cross(s.normal, s.lever[1]);
	if (all->count < MOST_SPOTS)
		all->list[all->count++] = s;
}

/* Is the vertex one that points outwards, with none of its two sides deeper along the normal than itself? */
static bool is_lowest(const placed *q, int k, const double *normal, double slop)
{
	double before[2], after[2];
	minus(at(q, k - 1), at(q, k), before);
	minus(at(q, k + 1), at(q, k), after);
	return cross(after, before) > 0.0 && inner(normal, before) >= -slop && inner(normal, after) >= -slop;
}

static void vertices_at_side(spots *all, int sided, int i)
{
	const placed *p = &all->outlines[sided], *q = &all->outlines[!sided];
	double side[2], above[2];
	minus(at(p, i + 1), at(p, i), side);
	const double length = hypot(side[0], side[1]);
	for (int k = 0; k < q->count; k++) {
		minus(at(q, k), at(p, i), above);
		const double gap = inner(p->normal[i], above), along = inner(side, above) / length;
		if (gap > all->gap || gap < -all->deep || along < -all->gap || along > length + all->gap)
			continue;
		if (is_lowest(q, k, p->normal[i], all->slop))
			add_spot(all, sided, p->normal[i], at(q, k));
	}
}

static void circle_at_side(spots *all, int sided, int i)
{
	const placed *p = &all->outlines[sided];
	const double *centre = all->outlines[!sided].at[0], radius = all->bodies[!sided]->radius;
	double side[2], away[2];
	minus(at(p, i + 1), at(p, i), side);
	minus(centre, at(p, i), away);
	const double along = inner(side, away), gap = inner(p->normal[i], away) - radius;
	if (along < 0.0 || along > inner(side, side) || gap > all->gap || gap < -all->deep)
		return;
	add_spot(all, sided, p->normal[i], (double[]){centre[0] - radius * p->normal[i][0], centre[1] - radius * p->normal[i][1]});
}

static void circle_at_vertex(spots *all, int sided, int i)
{
	const placed *p = &all->outlines[sided];
	const double *centre = all->outlines[!sided].at[0], radius = all->bodies[!sided]->radius;
	double before[2], after[2], away[2];
	minus(at(p, i - 1), at(p, i), before);
	minus(at(p, i + 1), at(p, i), after);
	minus(centre, at(p, i), away);
	const double size = hypot(away[0], away[1]), gap = size - radius;
	if (cross(after, before) <= 0.0 || inner(away, before) > 0.0 || inner(away, after) > 0.0 || gap > all->gap || gap < -all->deep)
		return;
	const double normal[2] = {away[0] / size, away[1] / size};
	add_spot(all, sided, normal, (double[]){centre[0] - radius * normal[0], centre[1] - radius * normal[1]});
}

static void find_spots(spots *all)
{
	for (int sided = 0; sided < 2; sided++) {
		const bool is_circle = all->bodies[!sided]->count == 1;
		for (int i = 0; all->bodies[sided]->count > 1 && i < all->outlines[sided].count; i++) {
			if (is_circle) {
				circle_at_side(all, sided, i);
				circle_at_vertex(all, sided, i);
			} else {
				vertices_at_side(all, sided, i);
			}
		}
	}
}

static void put_point(touch *t, const spot *s)
{
	for (int k = 0; k < 2; k++) {
		t->reference[t->count][k] = s->lever[t->swapped][k];
		t->incident[t->count][k] = s->lever[!t->swapped][k];
	}
	t->count++;
}

/* What is alike the chosen one acts with it: of circles it alone. */
static touch touch_of(const spots *all, const spot *chosen)
{
	touch t = {.swapped = chosen->swapped};
	const spot *ends[2] = {chosen, chosen};
	double low = 0.0, high = 0.0;
	for (int k = 0; k < 2; k++)
		t.normal[k] = t.swapped ? -chosen->normal[k] : chosen->normal[k];
	for (const spot *s = all->list; s < all->list + all->count; s++) {
		double from[2];
		minus(s->lever[0], chosen->lever[0], from);
		const double along = cross(chosen->normal, from);
		if (inner(s->normal, chosen->normal) <= (double)PIECES_ALIKE)
			continue;
		if (along < low)
			low = along, ends[0] = s;
		if (along > high)
			high = along, ends[1] = s;
	}
	put_point(&t, ends[0]);
	if (high - low > (double)(CORNER_NEAR * CORNER_DEEP) * all->slop && all->bodies[0]->count > 1 && all->bodies[1]->count > 1)
		put_point(&t, ends[1]);
	return t;
}

touch outline_touch(const exact_body *a, const exact_body *b, double slop)
{
	spots all = {.bodies = {a, b}, .outlines = {place(a, a), place(b, a)}, .deep = DEEPEST * slop, .slop = slop};
	all.gap = fmax(outline_distance(a, b), 0.0) + slop;
	find_spots(&all);
	for (; all.count == 0 && all.gap < 1e9; find_spots(&all)) /* vertex against vertex, or far apart */
		all.gap *= 2.0, all.deep *= 2.0;
	assert_true(all.count > 0);
	const spot *chosen = all.list;
	for (const spot *s = all.list; s < all.list + all.count; s++)
		if (s->rate < chosen->rate)
			chosen = s;
	return touch_of(&all, chosen);
}
