/* When what moves meets what stands: functions that give the part of the way give HUGE_VAL for never.
 * SPDX-License-Identifier: MIT */
#include "ray.h"
#include "crossing.h"
#include "penetration.h"

#include <float.h>
#include <math.h>

/* A circle about (x, y). */
static double part_to_circle(const carom_way *way, double x, double y, double radius)
{
	const double away_x = way->x - x, away_y = way->y - y, distance = sqrt(away_x * away_x + away_y * away_y);
	const double gap = (distance - radius) * (distance + radius), nearer = -(away_x * way->along_x + away_y * way->along_y);
	if (!(gap > 0) || !(nearer > 0))
		return HUGE_VAL;
	const double side = away_x * way->along_y - away_y * way->along_x;
	const double under = radius * radius * (way->along_x * way->along_x + way->along_y * way->along_y) - side * side;
	return under >= 0 ? gap / (sqrt(under) + nearer) : HUGE_VAL;
}

/* A line, from its free side. */
static double part_to_line(const carom_way *way, double normal_x, double normal_y, double offset)
{
	const double gap = normal_x * way->x + normal_y * way->y - offset, nearer = -(normal_x * way->along_x + normal_y * way->along_y);
	return gap > 0 && nearer > 0 ? gap / nearer : HUGE_VAL;
}

/* Keeps what is met sooner than what was. */
static void meet_circle(const carom_way *way, double x, double y, double radius, carom_meeting *meeting)
{
	const double part = part_to_circle(way, x, y, radius);
	if (!(part < meeting->part))
		return;
	const double from_x = way->x + part * way->along_x - x, from_y = way->y + part * way->along_y - y;
	const double length = sqrt(from_x * from_x + from_y * from_y);
	*meeting = (carom_meeting){part, from_x / length, from_y / length};
}

/* Lines along faces, each with a gap before what moves: it enters where it has passed all that it comes to from outside, if it has left none by then. */
typedef struct passage {
	carom_meeting in;
	double out;
} passage;

static void pass_line(passage *p, double gap, double nearer, double normal_x, double normal_y)
{
	if (nearer > 0 && gap / nearer > p->in.part)
		p->in = (carom_meeting){gap / nearer, normal_x, normal_y};
	else if (nearer < 0)
		p->out = carom_least(gap / nearer, p->out);
	else if (nearer == 0 && gap > 0)
		p->out = -HUGE_VAL;
}

static void keep_entry(const passage *p, carom_meeting *meeting)
{
	if (p->in.part > 0 && p->in.part <= p->out)
		*meeting = p->in;
}

static void enter_polygon(const carom_way *way, const carom_placed *polygon, carom_meeting *meeting)
{
	passage p = {{-HUGE_VAL, 0, 0}, HUGE_VAL};
	for (uint32_t k = 0; k < polygon->corner_count; k++) {
		const carom_corner *face = &polygon->corners[k];
		pass_line(&p, face->normal_x * way->x + face->normal_y * way->y - face->at, -(face->normal_x * way->along_x + face->normal_y * way->along_y),
			face->normal_x, face->normal_y);
	}
	keep_entry(&p, meeting);
}

/* Of one that is not convex a side itself is met. */
static void enter_outline(const carom_way *way, const carom_placed *polygon, carom_meeting *meeting)
{
	const carom_crossing at = carom_cross(polygon, way->x, way->y, way->along_x, way->along_y);
	if (!at.is_in && !at.is_on && at.part < meeting->part)
		*meeting = (carom_meeting){at.part, polygon->corners[at.side].normal_x, polygon->corners[at.side].normal_y};
}

/* How far it reaches along a direction. */
static double least_along(const carom_placed *polygon, double normal_x, double normal_y)
{
	double least = HUGE_VAL;
	for (uint32_t k = 0; k < polygon->corner_count; k++)
		least = carom_least(normal_x * polygon->corners[k].x + normal_y * polygon->corners[k].y, least);
	return least;
}

/* Of two polygons the lines along the faces of each, that one before the other's nearest corner. */
static void join_polygon(const carom_way *way, const carom_placed *polygon, carom_meeting *meeting)
{
	passage p = {{-HUGE_VAL, 0, 0}, HUGE_VAL};
	for (const carom_corner *face = polygon->corners; face < polygon->corners + polygon->corner_count; face++)
		pass_line(&p, least_along(way->body, face->normal_x, face->normal_y) - face->at,
			-(face->normal_x * way->along_x + face->normal_y * way->along_y), face->normal_x, face->normal_y);
	for (const carom_corner *face = way->body->corners; face < way->body->corners + way->body->corner_count; face++)
		pass_line(&p, least_along(polygon, face->normal_x, face->normal_y) - face->at, face->normal_x * way->along_x + face->normal_y * way->along_y,
			-face->normal_x, -face->normal_y);
	keep_entry(&p, meeting);
}

/* A corner, or where a side begins, of what moves and of what stands, where they meet. */
typedef struct touch {
	carom_meeting at;
	uint32_t own, met;
} touch;

/* Of two of which one at least is not convex: a corner of one meets a side of the other. */
static touch touch_of(const carom_way *way, const carom_placed *polygon)
{
	const carom_placed *own = way->body;
	touch first = {{HUGE_VAL, 0, 0}, 0, 0};
	for (uint32_t k = 0; k < own->corner_count; k++) {
		const carom_crossing at = carom_cross(polygon, own->corners[k].x, own->corners[k].y, way->along_x, way->along_y);
		const carom_corner *side = &polygon->corners[at.side];
		if (at.part < first.at.part)
			first = (touch){{at.part, side->normal_x, side->normal_y}, k, at.side};
	}
	for (uint32_t k = 0; k < polygon->corner_count; k++) {
		const carom_crossing at = carom_cross(own, polygon->corners[k].x, polygon->corners[k].y, -way->along_x, -way->along_y);
		const carom_corner *side = &own->corners[at.side];
		if (at.part < first.at.part)
			first = (touch){{at.part, -side->normal_x, -side->normal_y}, at.side, k};
	}
	return first;
}

static void join_outline(const carom_way *way, const carom_placed *polygon, carom_meeting *meeting)
{
	if (carom_separation(way->body, polygon, DBL_MIN) > 0)
		*meeting = touch_of(way, polygon).at;
}

/* A disc meets the polygon where its centre meets what is that far from it: faces moved outwards, and circles about the corners. */
static void touch_polygon(const carom_way *way, const carom_placed *polygon, carom_meeting *meeting)
{
	const carom_placed disc = {.x = way->x, .y = way->y, .radius = way->radius};
	if (carom_separation(polygon, &disc, DBL_MIN) <= 0)
		return;
	for (uint32_t k = 0; k < polygon->corner_count; k++) {
		const carom_corner *from = &polygon->corners[k], *to = &polygon->corners[k + 1 < polygon->corner_count ? k + 1 : 0];
		const double part = part_to_line(way, from->normal_x, from->normal_y, from->at + way->radius);
		const double x = way->x + part * way->along_x, y = way->y + part * way->along_y, edge_x = to->x - from->x, edge_y = to->y - from->y;
		if (part < meeting->part && (x - from->x) * edge_x + (y - from->y) * edge_y >= 0 && (x - to->x) * edge_x + (y - to->y) * edge_y <= 0)
			*meeting = (carom_meeting){part, from->normal_x, from->normal_y};
		meet_circle(way, from->x, from->y, way->radius, meeting);
	}
}

/* A polygon meets a circle when the circle, going the other way, meets the polygon. */
static void join_circle(const carom_way *way, const carom_placed *circle, carom_meeting *meeting)
{
	const carom_way back = {circle->x, circle->y, -way->along_x, -way->along_y, circle->radius, NULL};
	carom_meeting found = {HUGE_VAL, 0, 0};
	touch_polygon(&back, way->body, &found);
	*meeting = (carom_meeting){found.part, -found.normal_x, -found.normal_y};
}

static bool is_polygon(const carom_way *way)
{
	return way->body && way->body->corners;
}

/* Is the line of the way farther from the body than it reaches? */
static bool passes(const carom_way *way, const carom_placed *body)
{
	const double side = (body->x - way->x) * way->along_y - (body->y - way->y) * way->along_x,
				 reach = (body->radius + way->radius) * CAROM_GRID_ROUNDING;
	return side * side > reach * reach * (way->along_x * way->along_x + way->along_y * way->along_y);
}

bool carom_ray_meets_body(const carom_way *way, const carom_placed *body, carom_meeting *meeting)
{
	carom_meeting found = {HUGE_VAL, 0, 0};
	if (passes(way, body))
		return false;
	if (is_polygon(way))
		(!body->corners ? join_circle : way->body->pieces || body->pieces ? join_outline : join_polygon)(way, body, &found);
	else if (!body->corners)
		meet_circle(way, body->x, body->y, body->radius + way->radius, &found);
	else if (way->radius > 0)
		touch_polygon(way, body, &found);
	else
		(body->pieces ? enter_outline : enter_polygon)(way, body, &found);
	if (!(found.part <= 1))
		return false;
	*meeting = found;
	return true;
}

bool carom_ray_meets_wall(const carom_way *way, double normal_x, double normal_y, double offset, carom_meeting *meeting)
{
	const double reach = is_polygon(way) ? normal_x * way->x + normal_y * way->y - least_along(way->body, normal_x, normal_y) : way->radius;
	const double part = part_to_line(way, normal_x, normal_y, offset + reach);
	if (!(part <= 1))
		return false;
	*meeting = (carom_meeting){part, normal_x, normal_y};
	return true;
}

#define FLUSH 1e-6 /* of a polygon's radius: corners whose heights differ by no more are a face that lies flush */

/* What of a polygon touches along a direction: how high that is, and from where to where across it, to the left. */
typedef struct foot {
	double height, from, to;
} foot;

static uint32_t lowest_corner(const carom_placed *polygon, double normal_x, double normal_y)
{
	const double least = least_along(polygon, normal_x, normal_y);
	uint32_t k = 0;
	while (k + 1 < polygon->corner_count && normal_x * polygon->corners[k].x + normal_y * polygon->corners[k].y > least)
		k++;
	return k;
}

/* Makes it broader by a corner, if that lies flush with it. */
static bool widen(foot *f, const carom_placed *polygon, uint32_t k, double normal_x, double normal_y)
{
	const carom_corner *corner = &polygon->corners[k % polygon->corner_count];
	const double across = normal_x * corner->y - normal_y * corner->x;
	if (!(fabs(normal_x * corner->x + normal_y * corner->y - f->height) <= FLUSH * polygon->radius))
		return false;
	f->from = carom_least(across, f->from);
	f->to = carom_most(across, f->to);
	return true;
}

/* A corner, and those beside it, one after the other. */
static foot foot_of(const carom_placed *polygon, uint32_t k, double normal_x, double normal_y)
{
	const carom_corner *corner = &polygon->corners[k];
	const uint32_t count = polygon->corner_count;
	foot f = {normal_x * corner->x + normal_y * corner->y, HUGE_VAL, -HUGE_VAL};
	uint32_t ahead = 0, behind = 0;
	while (ahead < count && widen(&f, polygon, k + ahead, normal_x, normal_y))
		ahead++;
	while (behind < count && widen(&f, polygon, k + count - behind, normal_x, normal_y))
		behind++;
	return f;
}

/* What is met, seen from what moves; a wall is as broad as need be. */
static foot foot_of_other(const carom_placed *other, uint32_t k, double normal_x, double normal_y)
{
	if (!other)
		return (foot){0, -HUGE_VAL, HUGE_VAL};
	const foot f = foot_of(other, k, -normal_x, -normal_y);
	return (foot){f.height, -f.to, -f.from};
}

/* Where polygons touch. Of one that is convex it is what is lowest, and so of all that meet a wall. */
static touch where_polygons_touch(const carom_way *way, const carom_placed *other, const carom_meeting *meeting)
{
	if (other && (way->body->pieces || other->pieces))
		return touch_of(way, other);
	return (touch){*meeting, lowest_corner(way->body, meeting->normal_x, meeting->normal_y),
		other ? lowest_corner(other, -meeting->normal_x, -meeting->normal_y) : 0};
}

/* Of polygons that lie flush in the middle of what they share. */
void carom_ray_touches(const carom_way *way, const carom_placed *other, const carom_meeting *meeting, double *x, double *y)
{
	const double normal_x = meeting->normal_x, normal_y = meeting->normal_y;
	const double shift_x = meeting->part * way->along_x, shift_y = meeting->part * way->along_y;
	if (!is_polygon(way)) {
		*x = way->x + shift_x - way->radius * normal_x;
		*y = way->y + shift_y - way->radius * normal_y;
		return;
	}
	if (other && !other->corners) {
		*x = other->x + other->radius * normal_x;
		*y = other->y + other->radius * normal_y;
		return;
	}
	const touch where = where_polygons_touch(way, other, meeting);
	const foot own = foot_of(way->body, where.own, normal_x, normal_y), met = foot_of_other(other, where.met, normal_x, normal_y);
	const double height = own.height + normal_x * shift_x + normal_y * shift_y, aside = normal_x * shift_y - normal_y * shift_x;
	const double across = 0.5 * (carom_most(own.from + aside, met.from) + carom_least(own.to + aside, met.to));
	*x = height * normal_x - across * normal_y;
	*y = height * normal_y + across * normal_x;
}
