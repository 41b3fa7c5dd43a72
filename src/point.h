/* Points and vectors of the plane, in double precision: polygons are looked at with these as bodies are made. */
#ifndef CAROM_POINT_H
#define CAROM_POINT_H

#include "carom.h"

typedef struct point {
	double x, y;
} point;

static inline double cross(point a, point b)
{
	return a.x * b.y - a.y * b.x;
}

static inline double dot(point a, point b)
{
	return a.x * b.x + a.y * b.y;
}

static inline point minus(point a, point b)
{
	return (point){a.x - b.x, a.y - b.y};
}

/* From `a` along `way`, so often. */
static inline point along(point a, double part, point way)
{
	return (point){a.x + part * way.x, a.y + part * way.y};
}

static inline point exact_point(carom_vec2 v)
{
	return (point){(double)v.x, (double)v.y};
}

static inline carom_vec2 rounded_point(point p)
{
	return (carom_vec2){(float)p.x, (float)p.y};
}

#endif
