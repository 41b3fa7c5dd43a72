/* What tests of joints need.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_JOINED_H
#define CAROM_TESTS_JOINED_H

#include "runs.h"

/* Without a room, and without loss in hits, with gravity down. */
carom_world_def joined_free(float gravity);
/* A pin at (x, y) of the body, which is there now; and a rod from its middle to that of another, or to a place in the world. */
carom_joint joined_pin(uint32_t body, int32_t other, float x, float y);
carom_joint joined_rod(uint32_t body, int32_t other, float other_x, float other_y);
void joined_set(carom_world *world, size_t count, const carom_joint *joints);
carom_joint joined_get(carom_world *world, size_t k);
carom_body_info joined_info(carom_world *world, uint32_t body);
/* Where an anchor of a body, or of CAROM_GROUND, is, m. */
void joined_place(carom_world *world, int32_t body, carom_vec2 anchor, double *x, double *y);
/* How far the worst joint is from where it belongs, m. */
double joined_slack(carom_world *world);
/* Bars of 1 m from (0, 0) to the right, or balls on rods, that turn about it as one; NULL where there is no such device. */
enum { JOINED_LINKS = 10 };
carom_world *joined_chain(const scenery_device *device, bool of_rods, float gravity, float turning);

#endif
