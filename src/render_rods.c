/* The rods, ropes and springs of a picture: lines below the bodies, cut where their view ends.
 * SPDX-License-Identifier: MIT */
#include "anchor.h"
#include "canvas.h"
#include "palette.h"
#include "status.h"
#include "world.h"

#include <math.h>
#include <stdlib.h>

#define ROD_LINES 2.5 /* how broad a rod is, in thin lines */

/* Cuts the part of a line off that is on the far side of `edge` along one axis. */
static bool cut(double *from, double *to, double *from_across, double *to_across, double edge, bool below)
{
	const bool from_out = below ? *from < edge : *from > edge, to_out = below ? *to < edge : *to > edge;
	if (from_out && to_out)
		return false;
	const double across = from_out || to_out ? *from_across + (*to_across - *from_across) * ((edge - *from) / (*to - *from)) : 0;
	if (from_out)
		*from = edge, *from_across = across;
	if (to_out)
		*to = edge, *to_across = across;
	return true;
}

/* What of a rod is to be seen in the layer, whose marks nothing else clips. */
static void draw_rod(carom_layer *layer, const carom_joint *joint, const carom_body_state *states)
{
	double x0, y0, x1, y1;
	carom_anchor_place(&states[joint->body], joint->anchor, &x0, &y0);
	carom_anchor_place(joint->other == CAROM_GROUND ? NULL : &states[joint->other], joint->other_anchor, &x1, &y1);
	if (!isfinite(x0 + y0 + x1 + y1))
		return;
	const double breadth = ROD_LINES * layer->line;
	carom_mark rod = {(x0 - layer->left) * layer->scale, (layer->top - y0) * layer->scale, (x1 - layer->left) * layer->scale,
		(layer->top - y1) * layer->scale, breadth, CAROM_COLOR_FRAME};
	const carom_pixels *clip = &layer->clip;
	if (cut(&rod.x0, &rod.x1, &rod.y0, &rod.y1, clip->x0 + breadth / 2, true)
		&& cut(&rod.x0, &rod.x1, &rod.y0, &rod.y1, clip->x1 - breadth / 2, false)
		&& cut(&rod.y0, &rod.y1, &rod.x0, &rod.x1, clip->y0 + breadth / 2, true)
		&& cut(&rod.y0, &rod.y1, &rod.x0, &rod.x1, clip->y1 - breadth / 2, false))
		layer->rods[layer->rod_count++] = rod;
}

carom_status carom_rods_draw(carom_world *world, size_t layer_count, carom_layer *layers, carom_error *error)
{
	const size_t count = carom_world_joint_count(world), bodies = carom_world_body_count(world);
	if (count == 0)
		return CAROM_OK;
	carom_joint *joints = malloc(count * sizeof *joints);
	carom_body_state *states = malloc(bodies * sizeof *states);
	carom_status status = CAROM_OK;
	for (size_t i = 0; i < layer_count; i++)
		layers[i].rods = malloc(count * sizeof *layers[i].rods);
	if (!joints || !states || !layers[0].rods || !layers[layer_count - 1].rods)
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to draw %zu joints", count);
	if (status == CAROM_OK)
		status = carom_world_get_joints(world, 0, count, joints, error);
	if (status == CAROM_OK)
		status = carom_world_get_states(world, 0, bodies, states, error);
	for (size_t i = 0; status == CAROM_OK && i < layer_count; i++)
		for (size_t k = 0; k < count; k++)
			if (!carom_joint_turns(&joints[k]))
				draw_rod(&layers[i], &joints[k], states);
	free(joints);
	free(states);
	return status;
}
