/* Worlds and their pictures, for the tests of carom_world_render.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_PICTURES_H
#define CAROM_TESTS_PICTURES_H

#include "carom.h"
#include "count.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct picture {
	uint32_t width, height;
	uint8_t *pixels;
} picture;

/* NULL if there is no such device. */
static inline carom_world *world_on(const char *device, carom_world_def def, const carom_body_def *bodies, size_t count)
{
	carom_world *world = NULL;
	carom_error error = {0};
	def.device = device;
	carom_status status = carom_world_create(&def, &world, &error);
	if (status == CAROM_UNKNOWN_NAME && strcmp(device, "cpu") != 0)
		return NULL;
	if (status != CAROM_OK || carom_world_add(world, bodies, count, NULL, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return world;
}

static inline picture picture_of(carom_world *world, carom_render_def def)
{
	picture made = {def.width, def.height, malloc((size_t)def.width * def.height * 4)};
	carom_error error = {0};
	assert_non_null(made.pixels);
	if (carom_world_render(world, &def, made.pixels, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return made;
}

static inline size_t bytes_of(picture p)
{
	return (size_t)p.width * p.height * 4;
}

static inline uint32_t color_at(picture p, uint32_t x, uint32_t y)
{
	const uint8_t *pixel = p.pixels + ((size_t)y * p.width + x) * 4;
	return (uint32_t)pixel[0] << 16 | (uint32_t)pixel[1] << 8 | pixel[2];
}

static inline carom_render_def sized(uint32_t width, uint32_t height)
{
	carom_render_def def = carom_default_render_def();
	def.width = width;
	def.height = height;
	return def;
}

/* A picture of 10 pixels a metre with the origin at its centre. */
static inline carom_render_def ten_a_metre(uint32_t width, uint32_t height)
{
	carom_render_def def = sized(width, height);
	def.has_camera = true;
	def.camera.height = (float)height / 10;
	return def;
}

static inline carom_body_def regular(uint32_t sides, float radius, float x, float y, float angle)
{
	carom_body_def def = carom_default_body_def();
	def.shape = sides ? CAROM_REGULAR : CAROM_CIRCLE;
	def.sides = sides;
	def.radius = radius;
	def.position = (carom_vec2){x, y};
	def.angle = angle;
	return def;
}

static inline carom_world_def in_room(float half_width, float half_height)
{
	carom_world_def def = carom_default_world_def();
	def.has_room = true;
	def.room_min = (carom_vec2){-half_width, -half_height};
	def.room_max = (carom_vec2){half_width, half_height};
	return def;
}

/* Circles, regular polygons and static bodies for a room of 16 x 11 m. Returns how many: at most 32. */
static inline size_t mixed_bodies(carom_body_def *bodies)
{
	static const carom_vec2 beam[4] = {{0, 0}, {6, 0}, {6, 0.6f}, {0, 0.6f}};
	size_t count = 0;
	for (uint32_t k = 0; k < 21; k++) {
		float x = -6.6f + 2.2f * (float)(k % 7), y = 4.0f - 1.9f * (float)(k / 7);
		bodies[count++] = regular(k % 7 == 0 ? 0 : k % 7 + 2, 0.3f + 0.04f * (float)(k % 5) + 0.1f * (float)(k / 7), x, y, 0.3f * (float)k);
	}
	bodies[count] = carom_default_body_def();
	bodies[count].shape = CAROM_POLYGON;
	bodies[count].vertices = beam;
	bodies[count].vertex_count = 4;
	bodies[count].position = (carom_vec2){-3.5f, -3};
	bodies[count].angle = 0.25f;
	bodies[count++].is_static = true;
	bodies[count] = regular(0, 1.4f, 4, -3.2f, 0);
	bodies[count++].is_static = true;
	bodies[count] = regular(0, 0.7f, 0.8f, -3.6f, 2);
	bodies[count++].color = 0xF2F2F2;
	bodies[count] = regular(6, 0.5f, 6.9f, -4, 2);
	bodies[count++].color = 0x202020;
	return count;
}

#endif
