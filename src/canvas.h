/* A picture of a world as its device draws it: layers, each a view of the bodies over its marks [3]. */
#ifndef CAROM_CANVAS_H
#define CAROM_CANVAS_H

#include "carom.h"
#include "stage.h"

/* The pixels x0 <= x < x1, y0 <= y < y1, from the picture's upper left corner, y down. */
typedef struct carom_pixels {
	int32_t x0, y0, x1, y1;
} carom_pixels;

/* A box of whole pixels, or a line with square ends. */
typedef struct carom_mark {
	double x0, y0, x1, y1;
	double breadth; /* pixels, of a line; 0 for a box */
	uint32_t color; /* 0xRRGGBB */
} carom_mark;

#define CAROM_MAX_MARKS 32

typedef struct carom_layer {
	double left, top;  /* m, of the point at the picture's upper left corner */
	double scale;      /* pixels a metre */
	double line;       /* pixels, the breadth of thin lines */
	carom_pixels clip; /* of the bodies */
	uint32_t mark_count;
	carom_mark marks[CAROM_MAX_MARKS]; /* below the bodies, in the order in which they are drawn */
	uint32_t rod_count;                /* any number, between those and the bodies */
	carom_mark *rods;
} carom_layer;

typedef struct carom_picture {
	uint32_t width, height, ground;
	size_t layer_count;
	const carom_layer *layers;
} carom_picture;

/* Draws the present state into height rows of width RGBA bytes. */
carom_status carom_canvas_draw(carom_world *world, const carom_picture *picture, uint8_t *pixels, carom_error *error);

/* render_rods.c: those of all layers; their memory is to be given to free, whether this succeeds or not. */
carom_status carom_rods_draw(carom_world *world, size_t layer_count, carom_layer *layers, carom_error *error);

/* canvas_send.c */
int32_t carom_parts_of(uint32_t whole, uint32_t part); /* how many there are, the last of which may be smaller */
carom_status carom_canvas_no_memory(const carom_world *world, carom_error *error);
/* Makes room for texels, or the ints of a list, folded into rows; what they held is lost where there was none. */
carom_status carom_canvas_hold(carom_world *world, carom_role role, uint64_t items, carom_error *error);
/* Counts what all bodies have, and finds whether any circle is large enough in the picture for its radius line. */
void carom_canvas_count(carom_world *world, const carom_picture *picture);
/* Stream and Draws: of the bodies from `first` on in the order of drawing those that have no more than `most` edges, or texels of shapes. */
carom_status carom_canvas_send_bodies(carom_world *world, uint64_t first, uint64_t most, carom_error *error);
/* What a picture needs: where bodies are if the pipeline has that sent, the views and their marks, the block to draw. */
carom_status carom_canvas_send_transforms(carom_world *world, carom_error *error);
carom_status carom_canvas_send_view(carom_world *world, const carom_picture *picture, const carom_layer *layer, uint32_t first_shape,
	uint32_t first_edge, carom_error *error);
carom_status carom_canvas_send_marks(carom_world *world, const carom_layer *layer, carom_error *error);
carom_status carom_canvas_send_frame(carom_world *world, carom_pixels block, uint32_t ground, uint32_t pass, carom_error *error);

#endif
