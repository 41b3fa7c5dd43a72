/* When a disc, or a point, that moves meets what stands: each function gives the part of the way, HUGE_VAL for never.
 * SPDX-License-Identifier: MIT */
#include "ray.h"
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

/* A point enters a polygon where it has passed all of the faces that it comes to from outside, if it has left none by then. */
static void enter_polygon(const carom_way *way, const carom_placed *polygon, carom_meeting *meeting)
{
	carom_meeting in = {-HUGE_VAL, 0, 0};
	double out = HUGE_VAL;
	for (uint32_t k = 0; k < polygon->corner_count; k++) {
		const carom_corner *face = &polygon->corners[k];
		const double gap = face->normal_x * way->x + face->normal_y * way->y - face->at;
		const double nearer = -(face->normal_x * way->along_x + face->normal_y * way->along_y);
		if (nearer > 0 && gap / nearer > in.part)
			in = (carom_meeting){gap / nearer, face->normal_x, face->normal_y};
		else if (nearer < 0)
			out = carom_least(gap / nearer, out);
		else if (nearer == 0 && gap > 0)
			out = -HUGE_VAL;
	}
	if (in.part > 0 && in.part <= out)
		*meeting = in;
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
	if (!body->corners)
		meet_circle(way, body->x, body->y, body->radius + way->radius, &found);
	else if (way->radius > 0)
		touch_polygon(way, body, &found);
	else
		enter_polygon(way, body, &found);
	if (!(found.part <= 1))
		return false;
	*meeting = found;
	return true;
}

bool carom_ray_meets_wall(const carom_way *way, double normal_x, double normal_y, double offset, carom_meeting *meeting)
{
	const double part = part_to_line(way, normal_x, normal_y, offset + way->radius);
	if (!(part <= 1))
		return false;
	*meeting = (carom_meeting){part, normal_x, normal_y};
	return true;
}
