#include "world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"

#define MAX_BODIES (1u << 22)               /* body indices and counts are exact as floats, and to spare */
#define MOST_KEPT (7u * CAROM_MAX_VERTICES) /* vertices of a polygon that is not convex, with those of its hull and its pieces */

void *carom_array_grow(carom_array *array, size_t size)
{
	if (size == 0)
		return array->items;
	if (array->used + size > array->room) {
		size_t room = array->room ? array->room : 4096;
		void *items;
		while (room < array->used + size)
			room *= 2;
		items = realloc(array->items, room);
		if (!items)
			return NULL;
		array->items = items;
		array->room = room;
	}
	array->used += size;
	return (char *)array->items + array->used - size;
}

int carom_compare_indices(const void *left, const void *right)
{
	const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
	return a < b ? -1 : a > b;
}

static const carom_step *step_named(const char *name)
{
	for (size_t i = 0; i < carom_step_count; i++)
		if (!strcmp(carom_steps[i]->name, name))
			return carom_steps[i];
	return NULL;
}

/* The names given may be gone tomorrow; those of the pipeline as resolved stay. */
static void keep_names(carom_pipeline *given, const carom_pipeline *resolved)
{
	const char **names = (const char **)(void *)given, *const *known = (const char *const *)(const void *)resolved;
	for (size_t i = 0; i < sizeof *given / sizeof *names; i++)
		names[i] = names[i] ? known[i] : NULL;
}

carom_status carom_world_create(const carom_world_def *def, carom_world **world, carom_error *error)
{
	GIVEN(def, error);
	GIVEN(world, error);
	TRY(carom_check_world_def(def, error));
	carom_device_def device_def = {.name = def->device, .storage = def->storage, .threads = def->threads, .profile = def->profile};
	TRY(carom_pipeline_resolve(&def->pipeline, &device_def.pipeline, error));
	carom_world *w = calloc(1, sizeof *w);
	if (!w)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for a world");
	w->def = *def;
	w->pipeline = device_def.pipeline;
	keep_names(&w->def.pipeline, &w->pipeline);
	w->step = step_named(w->pipeline.step);
	w->contacts_current = true;
	w->newest = PLACE_HOST;
	w->target = NAN;
	w->batch = 1;
	if (def->device) {
		snprintf(w->device_name, sizeof w->device_name, "%s", def->device);
		w->def.device = w->device_name;
	}
	const carom_status status = carom_device_open(&device_def, &w->device, error);
	if (status) {
		carom_world_destroy(w);
		return status;
	}
	*world = w;
	return CAROM_OK;
}

void carom_world_destroy(carom_world *world)
{
	if (!world)
		return;
	if (world->device)
		carom_textures_destroy(world);
	carom_device_close(world->device);
	free(world->bodies.items);
	free(world->vertices.items);
	free(world->names.items);
	free(world->linear.items);
	free(world->rotational.items);
	free(world->contacts.items);
	free(world->joints.items);
	free(world->driven.items);
	free(world->apart.items);
	free(world->changes.items);
	free(world->hits.items);
	free(world);
}

/* Into [-pi, pi]; what the kernels' rounding left a little outside stays, or a state that is read and set would change. */
float carom_wrapped(float angle)
{
	return fabsf(angle) <= ANGLE_MOST ? angle : (float)remainder((double)angle, 6.28318530717958647692);
}

static bool append_state(carom_world *world, const carom_body_def *def, const carom_body *body)
{
	float *linear = carom_array_grow(&world->linear, 4 * sizeof *linear), *rotational = carom_array_grow(&world->rotational, 4 * sizeof *rotational);
	if (!linear || !rotational)
		return false;
	linear[LINEAR_X] = def->position.x;
	linear[LINEAR_Y] = def->position.y;
	linear[LINEAR_VX] = def->velocity.x;
	linear[LINEAR_VY] = def->velocity.y;
	rotational[ROTATIONAL_ANGLE] = carom_wrapped(def->angle);
	rotational[ROTATIONAL_VELOCITY] = def->angular_velocity;
	rotational[ROTATIONAL_RADIUS] = body->bound;
	rotational[3] = 0.0f;
	return true;
}

static bool append_body(carom_world *world, const carom_body_def *def, carom_body *body, const carom_vec2 *vertices)
{
	size_t name_size = def->name ? strlen(def->name) + 1 : 0;
	carom_body *slot = carom_array_grow(&world->bodies, sizeof *slot);
	char *name = carom_array_grow(&world->names, name_size);
	if (!slot || (name_size && !name) || !append_state(world, def, body))
		return false;
	if (body->vertex_count > 1 && !carom_outlines_add(world, body, vertices))
		return false;
	if (name_size) {
		memcpy(name, def->name, name_size);
		body->name = (uint32_t)(world->names.used - name_size + 1);
	}
	*slot = *body;
	world->body_count++;
	world->circle_count += body->vertex_count == 1;
	return true;
}

static carom_status add_one(carom_world *world, const carom_body_def *def, size_t index, carom_error *error)
{
	carom_vec2 vertices[CAROM_MAX_VERTICES];
	carom_body body;
	carom_status status = carom_body_make(def, &world->def, index, &body, vertices, error);
	if (status)
		return status;
	if (!body.is_convex && world->step == &carom_step_first_impact)
		return carom_fail(error, CAROM_INVALID_ARGUMENT,
			"bodies[%zu].vertices: the polygon is not convex, and the step %s takes convex ones alone; take the step events or contacts", index,
			world->step->name);
	if (!def->is_kinematic && carom_outside_room(&world->def, def->position, def->velocity))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "bodies[%zu].position: (%g, %g) is outside the room", index, (double)def->position.x,
			(double)def->position.y);
	if (body.vertex_count > 1 && !carom_outlines_have_room(world, &body))
		return carom_fail(error, CAROM_LIMIT, "bodies[%zu]: a world holds at most %u vertices of polygons", index, CAROM_MOST_VERTICES);
	if (def->name && strlen(def->name) >= UINT32_MAX - world->names.used)
		return carom_fail(error, CAROM_LIMIT, "bodies[%zu].name: a world holds names of at most 4 GiB", index);
	if (!append_body(world, def, &body, vertices))
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for body %zu", index);
	return CAROM_OK;
}

unsigned carom_traits_of(const carom_body *body)
{
	const bool rubs = body->friction > 0.0f || body->rolling_friction > 0.0f, damps = body->linear_damping > 0.0f || body->angular_damping > 0.0f;
	return (rubs ? TRAIT_RUBS : 0u) | (damps ? TRAIT_DAMPS : 0u);
}

/* What those from that index on have. */
static unsigned traits_from(const carom_world *world, size_t first)
{
	const carom_body *bodies = carom_world_bodies(world);
	unsigned traits = 0;
	for (size_t i = first; i < world->body_count; i++)
		traits |= carom_traits_of(&bodies[i]);
	return traits;
}

void carom_look_for_traits(carom_world *world, size_t first)
{
	const unsigned before = world->traits;
	world->traits = (first > 0 ? before : 0) | traits_from(world, first);
	world->prepared = world->prepared && world->traits == before;
}

/* How much there was of what grows with each body. */
typedef struct ends {
	size_t bodies, vertices, names, linear, rotational, body_count, circle_count;
} ends;

static ends ends_of(const carom_world *world)
{
	return (ends){world->bodies.used, world->vertices.used, world->names.used, world->linear.used, world->rotational.used, world->body_count,
		world->circle_count};
}

static void go_back_to(carom_world *world, const ends *before)
{
	world->bodies.used = before->bodies;
	world->vertices.used = before->vertices;
	memset(world->notes, 0, sizeof world->notes);
	world->names.used = before->names;
	world->linear.used = before->linear;
	world->rotational.used = before->rotational;
	world->body_count = before->body_count;
	world->circle_count = before->circle_count;
}

/* Do the device's textures, as they are, take the bodies from that index on? */
static bool may_join(const carom_world *world, size_t first)
{
	return world->body_count > first && carom_goes_on(world) && !(traits_from(world, first) & ~world->traits)
		&& carom_are_few(world->body_count - world->events.known, first) && carom_textures_fit(world, world->body_count, world->circle_count);
}

/* The host has all of the state, and the device is loaded with it and with those that have come. */
static carom_status begin_anew(carom_world *world, const ends *before, carom_error *error)
{
	const ends after = ends_of(world);
	world->body_count = before->body_count; /* of which the device knows */
	carom_status status = carom_textures_fetch(world, error);
	if (!status)
		status = carom_contacts_fetch(world, error);
	world->body_count = after.body_count;
	if (status)
		return status;
	carom_look_for_traits(world, before->body_count);
	world->newest = PLACE_HOST;
	world->contacts_sent = false; /* where others were before, the device still has their contacts */
	carom_load_anew(world);
	return CAROM_OK;
}

carom_status carom_world_add(carom_world *world, const carom_body_def *defs, size_t count, uint32_t *first, carom_error *error)
{
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	const ends before = ends_of(world);
	if (count > MAX_BODIES - before.body_count)
		return carom_fail(error, CAROM_LIMIT, "a world holds at most %u bodies", MAX_BODIES);
	if (count > 0)
		GIVEN(defs, error);
	carom_status status = CAROM_OK;
	for (size_t i = 0; !status && i < count; i++)
		status = add_one(world, &defs[i], i, error);
	if (!status && may_join(world, before.body_count))
		carom_roster_changed(world, before.body_count);
	else if (!status && count > 0)
		status = begin_anew(world, &before, error);
	if (status)
		go_back_to(world, &before);
	else if (first)
		*first = (uint32_t)before.body_count;
	return status;
}

size_t carom_world_body_count(const carom_world *world)
{
	return world ? world->body_count : 0;
}

const carom_world_def *carom_world_get_def(const carom_world *world)
{
	return world ? &world->def : NULL;
}

double carom_world_time(const carom_world *world)
{
	return world ? world->time : 0.0;
}

carom_status carom_world_get_device(const carom_world *world, carom_device_info *info, carom_error *error)
{
	GIVEN(world, error);
	GIVEN(info, error);
	*info = world->device->info;
	info->uses_images = world->device->storage == CAROM_STORAGE_IMAGE;
	return CAROM_OK;
}

void carom_world_set_progress(carom_world *world, carom_progress progress, void *context)
{
	if (!world)
		return;
	world->progress = progress;
	world->progress_context = context;
}

bool carom_world_profile(carom_world *world, size_t index, carom_kernel_time *time)
{
	if (!world || !time || !world->def.profile || index >= STAGE_COUNT)
		return false;
	world->device->kind->profile(world->device);
	*time = world->device->times[index];
	time->kernel = carom_stages[index].kernel;
	return true;
}

carom_status carom_check_span(const char *things, size_t first, size_t count, const char *there_are, size_t known, carom_error *error)
{
	if (first <= known && count <= known - first)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "%s %zu to %zu: %s %zu", things, first, count > SIZE_MAX - first ? SIZE_MAX : first + count,
		there_are, known);
}

carom_status carom_check_bodies(const carom_world *world, uint32_t first, size_t count, carom_error *error)
{
	return carom_check_span("bodies", first, count, "the world has", world->body_count, error);
}

carom_status carom_world_get_body(const carom_world *world, uint32_t index, carom_body_info *info, carom_error *error)
{
	const carom_body *body;
	GIVEN(world, error);
	GIVEN(info, error);
	TRY(carom_check_bodies(world, index, 1, error));
	body = &carom_world_bodies(world)[index];
	*info = (carom_body_info){
		.shape = body->shape,
		.radius = body->shape == CAROM_POLYGON ? body->bound : body->radius,
		.vertex_count = body->vertex_count,
		.vertices = body->vertex_count > 1 ? (const carom_vec2 *)world->vertices.items + body->vertex_first : NULL,
		.mass = body->mass,
		.inertia = body->inertia,
		.density = body->density,
		.restitution = body->restitution,
		.friction = body->friction,
		.rolling_friction = body->rolling_friction,
		.linear_damping = body->linear_damping,
		.angular_damping = body->angular_damping,
		.force = body->force,
		.torque = body->torque,
		.is_static = body->is_static,
		.is_kinematic = body->is_kinematic,
		.categories = body->categories,
		.mask = body->mask,
		.recentred_by = body->recentred_by,
		.color = body->color,
		.name = body->name ? (const char *)world->names.items + body->name - 1 : NULL,
	};
	return CAROM_OK;
}

uint64_t carom_world_memory(const carom_world_def *def, size_t body_count, size_t vertex_count)
{
	carom_pipeline pipeline;
	const carom_step *step;
	if (!def || body_count > MAX_BODIES || vertex_count > MOST_KEPT * body_count)
		return 0;
	if (carom_check_world_def(def, NULL) || carom_pipeline_resolve(&def->pipeline, &pipeline, NULL))
		return 0;
	step = step_named(pipeline.step);
	return carom_textures_memory(body_count, vertex_count, step->pairs) + step->memory(&pipeline, def, body_count, vertex_count);
}

static uint64_t hash_float(uint64_t hash, float x)
{
	uint32_t bits;
	memcpy(&bits, &x, sizeof bits);
	for (int i = 0; i < 4; i++)
		hash = (hash ^ ((bits >> 8 * i) & 0xFF)) * 1099511628211u;
	return hash;
}

carom_status carom_world_hash(carom_world *world, uint64_t *hash, carom_error *error)
{
	uint64_t h = 14695981039346656037u;
	GIVEN(world, error);
	GIVEN(hash, error);
	TRY(carom_textures_fetch(world, error));
	for (size_t i = 0; i < world->body_count; i++) {
		const float *l = (const float *)world->linear.items + 4 * i, *r = (const float *)world->rotational.items + 4 * i;
		for (int k = 0; k < 4; k++)
			h = hash_float(h, l[k]);
		h = hash_float(hash_float(h, r[ROTATIONAL_ANGLE]), r[ROTATIONAL_VELOCITY]);
	}
	*hash = h;
	return CAROM_OK;
}
