/* What hits of a polygon are found by: its corners, and if it is not convex its hull, and convex pieces that together are the polygon. None of them has a vertex within a
 * side, for that would be taken for the side's end. */
#ifndef CAROM_PIECES_H
#define CAROM_PIECES_H

#include "carom.h"

#define CAROM_MOST_PIECES (CAROM_MAX_VERTICES - 2)
#define CAROM_MOST_PIECE_VERTICES (3 * CAROM_MOST_PIECES) /* of all pieces */

/* Where two pieces meet they mostly overlap, so that what touches the polygon in a corner that points inwards meets sides of the polygon there, and no cut. */
typedef struct carom_pieces {
	uint32_t hull_count, count;
	carom_vec2 hull[CAROM_MAX_VERTICES];
	uint8_t sizes[CAROM_MOST_PIECES];               /* vertices of each piece, */
	carom_vec2 vertices[CAROM_MOST_PIECE_VERTICES]; /* one after the other, counter-clockwise */
} carom_pieces;

/* The vertices of a convex polygon but for those within a side; how many there are. */
uint32_t carom_corners_find(const carom_vec2 *outline, uint32_t count, carom_vec2 *corners);
/* Of a simple polygon, counter-clockwise. */
void carom_pieces_make(const carom_vec2 *outline, uint32_t count, carom_pieces *pieces);

#endif
