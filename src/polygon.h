/* From a definition's polygon to the one that is kept: checked, about its centre of mass, counter-clockwise, in floats. */
#ifndef CAROM_POLYGON_H
#define CAROM_POLYGON_H

#include "carom.h"

typedef struct carom_polygon {
	uint32_t count;
	carom_vec2 vertices[CAROM_MAX_VERTICES];
	bool is_convex;
	double area, second; /* m^2; m^4: the second moment about the centre of mass */
	double bound;        /* m: how far the farthest vertex is from there */
	carom_vec2 recentred_by;
} carom_polygon;

/* Of CAROM_POLYGON or CAROM_REGULAR, whose numbers are right; the error is about bodies[index]. */
carom_status carom_polygon_make(const carom_body_def *def, size_t index, carom_polygon *polygon, carom_error *error);

#endif
