/* A room of all shapes, some static so that the order of drawing is not the world's, for the tests of rendering.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_RENDERING_H
#define CAROM_TESTS_RENDERING_H

#include "pictures.h"
#include "scenery.h"
#include "world.h"

static const char *const options[3] = {"option1", "option2", "option3"};

static inline void fill(carom_world *world)
{
	carom_body_def bodies[32];
	carom_error error;
	scenery_check(carom_world_add(world, bodies, mixed_bodies(bodies), NULL, &error), &error);
}

static inline carom_world_def room(const char *option, const char *transform)
{
	carom_world_def def = in_room(8, 5.5f);
	def.gravity = (carom_vec2){0.5f, -3};
	def.pipeline.vertices = option;
	def.pipeline.transforms = transform;
	return def;
}

static inline carom_render_def with_inset(uint32_t width, uint32_t height)
{
	carom_render_def def = sized(width, height);
	def.has_inset = true;
	def.inset = (carom_inset){{-5, -4}, {3, 2}};
	return def;
}

#endif
