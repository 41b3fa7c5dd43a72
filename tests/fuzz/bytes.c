/* Bytes of an input as numbers, names and definitions. What is wild is what is tame with a few fields exchanged, so that
 * most of it gets past the first check.
 * SPDX-License-Identifier: MIT */
#include "bytes.h"
#include "count.h"

#include "fuzz.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* ---- Numbers */

uint8_t bytes_byte(bytes *b)
{
	return b->at < b->end ? *b->at++ : 0;
}

uint32_t bytes_below(bytes *b, uint32_t bound)
{
	return bytes_byte(b) % bound;
}

bool bytes_chance(bytes *b, uint32_t odds)
{
	return bytes_below(b, odds) == odds - 1;
}

float bytes_between(bytes *b, float low, float high)
{
	return low + (high - low) * ((float)bytes_byte(b) / 255.0f);
}

static uint32_t bits(bytes *b)
{
	uint32_t word = 0;
	for (int k = 0; k < 4; k++)
		word = word << 8 | bytes_byte(b);
	return word;
}

static carom_vec2 pair_between(bytes *b, float low, float high)
{
	carom_vec2 pair; /* no initialiser: its numbers come in no order */
	pair.x = bytes_between(b, low, high);
	pair.y = bytes_between(b, low, high);
	return pair;
}

float bytes_wild(bytes *b)
{
	static const float special[] = {0.0f, -0.0f, NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, FLT_MIN, FLT_TRUE_MIN, -FLT_TRUE_MIN, FLT_EPSILON,
		1e-30f, 1e-20f, 1e-12f, 1e-6f, 1e3f, 1e6f, -1e6f, 1e12f, -1e12f, 1e20f, -1e20f, 1e30f, -1e30f, 0.5f, 1.0f, -1.0f, 2.0f, 3.1415927f};
	const uint8_t kind = bytes_byte(b);
	float number;
	if (kind % 4 == 0)
		return bytes_between(b, -8.0f, 8.0f);
	if (kind % 4 == 1)
		return ldexpf((float)kind / 128.0f - 1.0f, (int)bytes_byte(b) - 128);
	if (kind % 4 == 2)
		return special[bytes_below(b, COUNT(special))];
	const uint32_t word = bits(b);
	memcpy(&number, &word, sizeof number);
	return number;
}

double bytes_wild_double(bytes *b)
{
	static const double special[] = {1e300, -1e300, 1e30, 1e-300, 0x1p100, 0x1p99, DBL_MAX, 4.9e-324, -1e-9};
	return bytes_chance(b, 4) ? special[bytes_below(b, COUNT(special))] : (double)bytes_wild(b);
}

/* Exchanges one float of a structure. */
static void exchange(bytes *b, void *structure, const size_t *offsets, size_t count)
{
	const float number = bytes_wild(b);
	memcpy((char *)structure + offsets[bytes_below(b, (uint32_t)count)], &number, sizeof number);
}

/* ---- Names */

static const char *const slots[] = {"step", "aabb", "overlap", "inside", "toi", "walls", "reduce", "impulse", "transforms", "vertices"};

const char *bytes_slot(bytes *b)
{
	static const char *const wrong[] = {
		"", "forward", "slots", "epsilon", "toi ", "a slot whose name is far too long to be kept in a message as it is"};
	return bytes_chance(b, 8) ? wrong[bytes_below(b, COUNT(wrong))] : slots[bytes_below(b, COUNT(slots))];
}

/* Of any slot, so mostly of another. */
const char *bytes_alternative(bytes *b)
{
	carom_stage_info info;
	if (bytes_chance(b, 8))
		return bytes_chance(b, 2) ? "" : "an alternative whose name is far too long to be kept in a message as it is";
	return carom_stage_list(bytes_byte(b), &info) ? info.alternative : "default";
}

/* A known alternative for one slot. */
static void choose(bytes *b, carom_pipeline *pipeline)
{
	const char *slot = slots[bytes_below(b, COUNT(slots))];
	uint32_t which = bytes_below(b, 4);
	carom_stage_info info;
	for (size_t k = 0; carom_stage_list(k, &info); k++) {
		if (strcmp(info.slot, slot) == 0 && which-- == 0)
			FUZZ_EXPECT(carom_pipeline_set(pipeline, slot, info.alternative, NULL) == CAROM_OK);
	}
}

/* ---- Worlds */

static void exchange_in_world(bytes *b, carom_world_def *def)
{
	static const size_t floats[] = {offsetof(carom_world_def, time_step), offsetof(carom_world_def, gravity.x), offsetof(carom_world_def, gravity.y),
		offsetof(carom_world_def, restitution), offsetof(carom_world_def, friction), offsetof(carom_world_def, rolling_friction),
		offsetof(carom_world_def, linear_damping), offsetof(carom_world_def, angular_damping), offsetof(carom_world_def, room_min.x),
		offsetof(carom_world_def, room_min.y), offsetof(carom_world_def, room_max.x), offsetof(carom_world_def, room_max.y),
		offsetof(carom_world_def, epsilon)};
	static const char *const devices[] = {"", "auto", "CPU", "abacus", "cpu and a name that is far too long to be kept in a message as it is"};
	const char **name = (const char **)(void *)&def->pipeline + bytes_below(b, sizeof def->pipeline / sizeof *name);
	switch (bytes_below(b, 8)) {
	case 0: def->iterations = bits(b); break;
	case 1: def->storage = (carom_storage)bytes_below(b, 8); break;
	case 2: def->device = devices[bytes_below(b, COUNT(devices))]; break;
	case 3: *name = bytes_alternative(b); break;
	default: exchange(b, def, floats, COUNT(floats)); break;
	}
}

carom_world_def bytes_world_def(bytes *b)
{
	carom_world_def def = carom_default_world_def();
	const uint8_t flags = bytes_byte(b);
	def.device = fuzz_device();
	def.time_step = bytes_between(b, 0.001f, 0.2f);
	def.has_room = flags & 1;
	def.room_min = pair_between(b, -8.0f, -0.1f);
	def.room_max = pair_between(b, 0.1f, 8.0f);
	if (flags & 2)
		def.gravity = pair_between(b, -10.0f, 10.0f);
	if (flags & 4)
		def.restitution = bytes_between(b, 0.0f, 1.0f);
	if (flags & 8)
		def.pipeline.step = "first_impact";
	if (flags & 16)
		def.epsilon = 1.0f / (float)(2u << bytes_below(b, 22));
	if (flags & 32)
		def.iterations = bytes_byte(b);
	def.profile = flags & 64;
	for (uint32_t k = flags & 128 ? bytes_below(b, 8) : 0; k > 0; k--)
		choose(b, &def.pipeline);
	for (uint32_t k = b->tame ? 0 : bytes_below(b, 4); k > 0; k--)
		exchange_in_world(b, &def);
	return def;
}

/* ---- Bodies */

/* Places mostly come from a lattice in the room: bodies that begin in each other take long, and little can be asked of them. */
#define CELLS 4

static carom_vec2 pitch_of(const carom_world_def *world)
{
	if (!world->has_room)
		return (carom_vec2){4.0f, 4.0f};
	return (carom_vec2){(world->room_max.x - world->room_min.x) / CELLS, (world->room_max.y - world->room_min.y) / CELLS};
}

static carom_vec2 place_in(bytes *b, const carom_world_def *world)
{
	const carom_vec2 pitch = pitch_of(world), least = world->has_room ? world->room_min : (carom_vec2){-2.0f * pitch.x, -2.0f * pitch.y};
	const uint32_t cell = b->placed++ * 5 % (CELLS * CELLS);
	const bool anywhere = bytes_chance(b, 16);
	carom_vec2 place = pair_between(b, anywhere ? 0.0f : 0.45f, anywhere ? (float)CELLS : 0.55f);
	if (!anywhere) {
		place.x += (float)(cell % CELLS);
		place.y += (float)(cell / CELLS);
	}
	return (carom_vec2){least.x + pitch.x * place.x, least.y + pitch.y * place.y};
}

/* Of the circle that a body fills of its cell. */
static float radius_in(bytes *b, const carom_world_def *world)
{
	const carom_vec2 pitch = pitch_of(world);
	const float most = bytes_chance(b, 16) ? 2.0f : 0.4f;
	return bytes_between(b, 0.02f, most) * (pitch.x < pitch.y ? pitch.x : pitch.y);
}

carom_body_state bytes_state(bytes *b, const carom_world_def *world)
{
	static const size_t floats[] = {offsetof(carom_body_state, position.x), offsetof(carom_body_state, position.y),
		offsetof(carom_body_state, velocity.x), offsetof(carom_body_state, velocity.y), offsetof(carom_body_state, angle),
		offsetof(carom_body_state, angular_velocity)};
	carom_body_state state = {.position = place_in(b, world)};
	state.angle = bytes_between(b, -4.0f, 4.0f);
	if (bytes_chance(b, 2)) {
		state.velocity = pair_between(b, -30.0f, 30.0f);
		state.angular_velocity = bytes_between(b, -30.0f, 30.0f);
	}
	if (!b->tame && bytes_chance(b, 4))
		exchange(b, &state, floats, COUNT(floats));
	return state;
}

/* Few mostly: a body of many takes much longer to look at. */
static uint32_t vertex_count(bytes *b)
{
	return CAROM_MIN_VERTICES + (bytes_chance(b, 16) ? bytes_below(b, CAROM_MAX_VERTICES - CAROM_MIN_VERTICES + 1) : bytes_below(b, 4));
}

/* On an ellipse about some place, either way round. */
static carom_vec2 *make_vertices(bytes *b, uint32_t count, float radius)
{
	const double width = (double)(radius * bytes_between(b, 0.05f, 1.0f)), height = (double)radius, turn = bytes_chance(b, 2) ? -2 * PI : 2 * PI;
	const carom_vec2 centre = pair_between(b, -2.0f, 2.0f);
	carom_vec2 *vertices = malloc(count * sizeof *vertices + 1);
	FUZZ_EXPECT(vertices);
	for (uint32_t k = 0; k < count; k++)
		vertices[k] = (carom_vec2){centre.x + (float)(width * cos(turn * k / count)), centre.y + (float)(height * sin(turn * k / count))};
	return vertices;
}

static void exchange_in_body(bytes *b, carom_body_def *def, carom_vec2 *vertices)
{
	static const size_t floats[] = {offsetof(carom_body_def, radius), offsetof(carom_body_def, position.x), offsetof(carom_body_def, position.y),
		offsetof(carom_body_def, velocity.x), offsetof(carom_body_def, velocity.y), offsetof(carom_body_def, angle),
		offsetof(carom_body_def, angular_velocity), offsetof(carom_body_def, density), offsetof(carom_body_def, mass),
		offsetof(carom_body_def, restitution), offsetof(carom_body_def, friction), offsetof(carom_body_def, rolling_friction),
		offsetof(carom_body_def, linear_damping), offsetof(carom_body_def, angular_damping), offsetof(carom_body_def, force.x),
		offsetof(carom_body_def, force.y), offsetof(carom_body_def, torque)};
	static const size_t coordinates[] = {offsetof(carom_vec2, x), offsetof(carom_vec2, y)};
	switch (bytes_below(b, 10)) {
	case 0: def->shape = (carom_shape)bytes_below(b, 5); break;
	case 1: def->sides = bits(b); break;
	case 2: def->color = bits(b); break;
	case 3: def->vertices = NULL; break;
	case 4:
		if (vertices && def->vertex_count > 0)
			exchange(b, &vertices[bytes_below(b, def->vertex_count)], coordinates, COUNT(coordinates));
		break;
	default: exchange(b, def, floats, COUNT(floats)); break;
	}
}

static void move_body(bytes *b, const carom_world_def *world, carom_body_def *def)
{
	const carom_body_state state = bytes_state(b, world);
	def->position = state.position;
	def->angle = state.angle;
	if (def->is_static && b->tame)
		return;
	def->velocity = state.velocity;
	def->angular_velocity = state.angular_velocity;
	if (bytes_chance(b, 8) && !(def->is_kinematic && b->tame)) {
		def->force = pair_between(b, -50.0f, 50.0f);
		def->torque = bytes_between(b, -20.0f, 20.0f);
	}
}

carom_body_def bytes_body_def(bytes *b, const carom_world_def *world, bytes_body_room *room)
{
	carom_body_def def = carom_default_body_def();
	const uint8_t flags = bytes_byte(b);
	*room = (bytes_body_room){NULL, ""};
	def.shape = (carom_shape)(flags % 3);
	def.radius = radius_in(b, world);
	def.sides = vertex_count(b);
	def.is_static = (flags >> 2 & 7) == 7;
	def.is_kinematic = (flags >> 2 & 7) == 6 || (def.is_static && !b->tame && bytes_chance(b, 8));
	if (def.shape == CAROM_POLYGON) {
		def.vertex_count = !b->tame && bytes_chance(b, 16) ? bytes_below(b, 70) : vertex_count(b);
		def.vertices = room->vertices = make_vertices(b, def.vertex_count, def.radius);
	}
	move_body(b, world, &def);
	if (flags & 32)
		def.density = bytes_between(b, 0.01f, 100.0f);
	if ((flags & 96) == 96)
		def.mass = bytes_between(b, 0.01f, 100.0f);
	if (flags & 128) {
		def.restitution = bytes_between(b, 0.0f, 1.0f);
		for (size_t k = 0; k + 1 < sizeof room->name && bytes_chance(b, 2); k++)
			room->name[k] = (char)bytes_byte(b);
		def.name = room->name;
	}
	if ((flags & 160) == 160)
		def.friction = bytes_between(b, 0.0f, 2.0f);
	if ((flags & 96) == 96)
		def.rolling_friction = bytes_between(b, 0.0f, 1.0f);
	if ((flags & 80) == 80)
		def.linear_damping = def.angular_damping = bytes_between(b, 0.0f, 4.0f);
	if ((flags & 192) == 192) {
		def.categories = 1u << (flags & 3);
		def.mask = ~(1u << (flags >> 2 & 3));
	}
	for (uint32_t k = b->tame ? 0 : bytes_below(b, 3); k > 0; k--)
		exchange_in_body(b, &def, room->vertices);
	return def;
}

/* ---- Pictures */

carom_render_def bytes_render_def(bytes *b)
{
	static const size_t floats[] = {offsetof(carom_render_def, camera.center.x), offsetof(carom_render_def, camera.center.y),
		offsetof(carom_render_def, camera.height), offsetof(carom_render_def, inset.min.x), offsetof(carom_render_def, inset.min.y),
		offsetof(carom_render_def, inset.size.x), offsetof(carom_render_def, inset.size.y)};
	carom_render_def def = carom_default_render_def();
	def.width = 1 + bytes_below(b, 64);
	def.height = 1 + bytes_below(b, 64);
	def.has_camera = bytes_chance(b, 2);
	def.camera.center = pair_between(b, -4.0f, 4.0f);
	def.camera.height = bytes_between(b, 0.01f, 20.0f);
	def.has_inset = bytes_chance(b, 2);
	def.inset.min = pair_between(b, -4.0f, 4.0f);
	def.inset.size = pair_between(b, 0.01f, 4.0f);
	for (uint32_t k = b->tame ? 0 : bytes_below(b, 3); k > 0; k--)
		exchange(b, &def, floats, COUNT(floats));
	return def;
}
