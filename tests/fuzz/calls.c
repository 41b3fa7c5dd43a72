/* Calls that make worlds, ask and change them.
 * SPDX-License-Identifier: MIT */
#include "calls.h"
#include "count.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Judging */

void calls_note(calls *c, const void *data, size_t size)
{
	const uint8_t *at = data;
	for (size_t k = 0; k < size; k++)
		c->trace = (c->trace ^ at[k]) * 1099511628211u;
}

bool calls_judge(calls *c, carom_status status, const carom_error *error)
{
	calls_note(c, &status, sizeof status);
	if (fuzz_judge(status, error))
		return true;
	calls_note(c, error->text, strlen(error->text));
	return false;
}

snapshot calls_look(calls *c)
{
	snapshot now = {.count = carom_world_body_count(*c->slot), .time = carom_world_time(*c->slot)};
	carom_error error = fuzz_blank();
	FUZZ_EXPECT(calls_judge(c, carom_world_hash(*c->slot, &now.hash, &error), &error));
	calls_note(c, &now, sizeof now);
	return now;
}

void calls_same(calls *c, snapshot before)
{
	const snapshot now = calls_look(c);
	FUZZ_EXPECT(now.count == before.count && now.time == before.time && now.hash == before.hash);
}

uint32_t calls_index(calls *c)
{
	const uint32_t index = bytes_below(&c->bytes, MOST_BODIES + 2);
	return bytes_chance(&c->bytes, 16) ? UINT32_MAX - index : index;
}

/* ---- Worlds */

static void create(calls *c)
{
	carom_world *world = (carom_world *)c;
	carom_world_def def = bytes_world_def(&c->bytes);
	carom_error error = fuzz_blank();
	def.threads = c->threads;
	def.keep_hits = true;
	if (!calls_judge(c, carom_world_create(&def, &world, &error), &error)) {
		FUZZ_EXPECT(world == (carom_world *)c && !c->bytes.tame);
		return;
	}
	carom_world_destroy(*c->slot);
	*c->slot = world;
	FUZZ_EXPECT(carom_world_body_count(world) == 0 && carom_world_time(world) == 0);
	FUZZ_EXPECT(carom_world_get_def(world)->time_step == def.time_step);
}

static void destroy(calls *c)
{
	carom_world_destroy(*c->slot);
	*c->slot = NULL;
}

static void add(calls *c)
{
	carom_body_def defs[4];
	bytes_body_room rooms[COUNT(defs)];
	carom_error error = fuzz_blank();
	const size_t count = 1 + bytes_below(&c->bytes, COUNT(defs));
	const snapshot before = calls_look(c);
	uint32_t first = 12345;
	if (before.count + count > MOST_BODIES)
		return;
	for (size_t k = 0; k < count; k++)
		defs[k] = bytes_body_def(&c->bytes, carom_world_get_def(*c->slot), &rooms[k]);
	if (calls_judge(c, carom_world_add(*c->slot, defs, count, &first, &error), &error)) {
		FUZZ_EXPECT(first == before.count && carom_world_body_count(*c->slot) == before.count + count);
	} else {
		FUZZ_EXPECT(first == 12345 && strncmp(error.text, "bodies[", 7) == 0);
		calls_same(c, before);
	}
	for (size_t k = 0; k < count; k++)
		free(rooms[k].vertices);
}

/* More than there can be, without an array of so many. */
static void add_too_many(calls *c)
{
	const carom_body_def def = carom_default_body_def();
	carom_error error = fuzz_blank();
	FUZZ_EXPECT(!calls_judge(c, carom_world_add(*c->slot, &def, bytes_chance(&c->bytes, 2) ? SIZE_MAX : 4194305, NULL, &error), &error));
	FUZZ_EXPECT(error.status == CAROM_LIMIT);
	carom_error untouched = fuzz_blank();
	FUZZ_EXPECT(calls_judge(c, carom_world_add(*c->slot, NULL, 0, NULL, &untouched), &untouched));
}

static void get_body(calls *c)
{
	carom_body_info info = {.radius = 12345};
	carom_error error = fuzz_blank();
	const uint32_t index = calls_index(c);
	if (!calls_judge(c, carom_world_get_body(*c->slot, index, &info, &error), &error)) {
		FUZZ_EXPECT(info.radius == 12345 && index >= carom_world_body_count(*c->slot));
		return;
	}
	FUZZ_EXPECT(info.mass > 0 && info.inertia > 0 && isinf(info.mass) == (info.is_static || info.is_kinematic)
		&& isinf(info.inertia) == isinf(info.mass));
	FUZZ_EXPECT(info.radius > 0 && info.restitution >= 0 && info.restitution <= 1 && info.friction >= 0 && info.friction <= CAROM_MAX_FRICTION);
	FUZZ_EXPECT((info.shape == CAROM_CIRCLE) == !info.vertices && info.vertex_count >= 1 && info.vertex_count <= CAROM_MAX_VERTICES);
	for (uint32_t k = 0; info.vertices && k < info.vertex_count; k++)
		FUZZ_EXPECT(isfinite(info.vertices[k].x) && isfinite(info.vertices[k].y));
	if (info.name)
		calls_note(c, info.name, strlen(info.name));
}

static void get_states(calls *c)
{
	carom_body_state states[MOST_BODIES + 1] = {{.angle = 12345}};
	carom_error error = fuzz_blank();
	const uint32_t first = calls_index(c);
	const size_t count = bytes_below(&c->bytes, MOST_BODIES + 2);
	if (calls_judge(c, carom_world_get_states(*c->slot, first, count, states, &error), &error)) {
		calls_note(c, states, count * sizeof *states);
		FUZZ_EXPECT(first + count <= carom_world_body_count(*c->slot));
	} else {
		FUZZ_EXPECT(states[0].angle == 12345);
	}
}

static void set_states(calls *c)
{
	carom_body_state states[4];
	carom_error error = fuzz_blank();
	const uint32_t first = calls_index(c);
	const size_t count = bytes_below(&c->bytes, COUNT(states) + 1);
	const snapshot before = calls_look(c);
	for (size_t k = 0; k < count; k++)
		states[k] = bytes_state(&c->bytes, carom_world_get_def(*c->slot));
	if (!calls_judge(c, carom_world_set_states(*c->slot, first, count, states, &error), &error))
		calls_same(c, before);
}

/* What is read can be set, and is then what is read. */
static void get_contacts(calls *c)
{
	carom_contact contacts[MOST_CONTACTS], again[MOST_CONTACTS];
	carom_error error = fuzz_blank();
	size_t count = 0;
	if (!calls_judge(c, carom_world_contact_count(*c->slot, &count, &error), &error) || count > MOST_CONTACTS)
		return;
	FUZZ_EXPECT(carom_world_get_contacts(*c->slot, 0, count + 1, contacts, NULL) == CAROM_INVALID_ARGUMENT);
	if (!calls_judge(c, carom_world_get_contacts(*c->slot, 0, count, contacts, &error), &error))
		return;
	calls_note(c, contacts, count * sizeof *contacts);
	FUZZ_EXPECT(carom_world_set_contacts(*c->slot, count, contacts, NULL) == CAROM_OK);
	FUZZ_EXPECT(carom_world_get_contacts(*c->slot, 0, count, again, NULL) == CAROM_OK);
	FUZZ_EXPECT(memcmp(contacts, again, count * sizeof *contacts) == 0);
}

static void set_contacts(calls *c)
{
	carom_contact contacts[3];
	carom_error error = fuzz_blank();
	const size_t count = bytes_below(&c->bytes, COUNT(contacts) + 1);
	const snapshot before = calls_look(c);
	size_t now = 0;
	for (size_t k = 0; k < count; k++) {
		contacts[k] = (carom_contact){.body = calls_index(c), .other = (int32_t)calls_index(c) - 4};
		for (int point = 0; point < 2; point++) {
			contacts[k].normal[point] = c->bytes.tame ? bytes_between(&c->bytes, 0, 50) : bytes_wild(&c->bytes);
			contacts[k].friction[point] = c->bytes.tame ? bytes_between(&c->bytes, -50, 50) : bytes_wild(&c->bytes);
		}
	}
	if (calls_judge(c, carom_world_set_contacts(*c->slot, count, contacts, &error), &error))
		FUZZ_EXPECT(carom_world_contact_count(*c->slot, &now, NULL) == CAROM_OK && now == count);
	calls_same(c, before);
}

static void set_force(calls *c)
{
	carom_error error = fuzz_blank();
	const uint32_t index = calls_index(c);
	const bool tame = c->bytes.tame;
	const carom_vec2 force = {tame ? bytes_between(&c->bytes, -50, 50) : bytes_wild(&c->bytes), 0};
	const snapshot before = calls_look(c);
	carom_body_info info;
	if (calls_judge(c, carom_world_set_force(*c->slot, index, force, force.x, &error), &error)) {
		FUZZ_EXPECT(carom_world_get_body(*c->slot, index, &info, NULL) == CAROM_OK);
		FUZZ_EXPECT(info.force.x == force.x && info.torque == force.x && isfinite(info.mass));
	}
	calls_same(c, before);
}

static void measure(calls *c)
{
	carom_measure measure = {.max_penetration = 12345};
	carom_error error = fuzz_blank();
	if (calls_judge(c, carom_world_measure(*c->slot, &measure, &error), &error)) {
		calls_note(c, &measure, sizeof measure);
		FUZZ_EXPECT(measure.kinetic_energy >= 0 && measure.max_penetration >= 0);
	}
	FUZZ_EXPECT(carom_world_measure(NULL, &measure, NULL) == CAROM_INVALID_ARGUMENT);
}

static void cast_body(calls *c, const carom_snapshot *made)
{
	bytes_body_room room;
	const carom_body_def body = bytes_body_def(&c->bytes, carom_world_get_def(*c->slot), &room);
	const carom_vec2 to = {bytes_wild(&c->bytes), bytes_wild(&c->bytes)};
	carom_ray_hit hit;
	carom_error error = fuzz_blank();
	size_t count = 0;
	if (calls_judge(c, carom_snapshot_cast_bodies(made, 1, &body, &to, &hit, &error), &error)) {
		FUZZ_EXPECT(hit.part > 0 && hit.part <= 1 && hit.other < (int64_t)carom_world_body_count(*c->slot));
		calls_note(c, &hit.part, sizeof hit.part);
	}
	error = fuzz_blank();
	calls_judge(c, carom_snapshot_find_touching(made, &body, NULL, 0, &count, &error), &error);
	FUZZ_EXPECT(count <= carom_world_body_count(*c->slot));
	free(room.vertices);
}

/* What a ray meets lies where it was met. */
static void ask_where(calls *c)
{
	const bool tame = c->bytes.tame;
	float numbers[5];
	carom_snapshot *made = NULL;
	carom_ray_hit hit;
	carom_error error = fuzz_blank();
	size_t count = 0;
	for (size_t k = 0; k < COUNT(numbers); k++)
		numbers[k] = tame ? bytes_between(&c->bytes, k < 4 ? -20 : 0, k < 4 ? 20 : 2) : bytes_wild(&c->bytes);
	const carom_ray ray = {{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, numbers[4]};
	if (!calls_judge(c, carom_snapshot_create(*c->slot, &made, &error), &error))
		return;
	error = fuzz_blank();
	calls_judge(c, carom_snapshot_find(made, ray.from, ray.to, NULL, 0, &count, &error), &error);
	FUZZ_EXPECT(count <= carom_world_body_count(*c->slot));
	error = fuzz_blank();
	if (calls_judge(c, carom_snapshot_cast_rays(made, 1, &ray, &hit, &error), &error)) {
		const float pad = 1e-3f;
		FUZZ_EXPECT(hit.part > 0 && hit.part <= 1 && hit.other < (int64_t)carom_world_body_count(*c->slot));
		calls_note(c, &hit.part, sizeof hit.part);
		if (tame && hit.other >= 0)
			FUZZ_EXPECT(!carom_snapshot_find(made, (carom_vec2){hit.point.x - pad, hit.point.y - pad},
							(carom_vec2){hit.point.x + pad, hit.point.y + pad}, NULL, 0, &count, NULL)
				&& count > 0);
	}
	cast_body(c, made);
	carom_snapshot_destroy(made);
}

/* ---- What needs no world */

static void set_pipeline(calls *c)
{
	carom_pipeline pipeline = {0};
	carom_error error = fuzz_blank();
	const char *slot = bytes_slot(&c->bytes), *alternative = bytes_alternative(&c->bytes);
	const char *before = carom_pipeline_get(&pipeline, slot);
	if (calls_judge(c, carom_pipeline_set(&pipeline, slot, alternative, &error), &error)) {
		FUZZ_EXPECT(before && strcmp(carom_pipeline_get(&pipeline, slot), alternative) == 0);
	} else {
		FUZZ_EXPECT(error.status == CAROM_UNKNOWN_NAME && carom_pipeline_get(&pipeline, slot) == before);
	}
}

static void list(calls *c)
{
	carom_device_info *devices = NULL, device;
	carom_stage_info stage;
	carom_kernel_time time;
	carom_error error = fuzz_blank();
	const size_t index = bytes_byte(&c->bytes);
	size_t count = 0;
	const bool is_stage = carom_stage_list(index, &stage), is_kernel = *c->slot && carom_world_profile(*c->slot, index, &time);
	calls_note(c, &is_stage, sizeof is_stage);
	calls_note(c, &is_kernel, sizeof is_kernel);
	FUZZ_EXPECT(!is_kernel || (time.kernel && time.seconds >= 0 && carom_world_get_def(*c->slot)->profile));
	FUZZ_EXPECT(calls_judge(c, carom_device_list_create(&devices, &count, &error), &error) && count > 0);
	carom_device_list_destroy(devices);
	if (*c->slot)
		FUZZ_EXPECT(calls_judge(c, carom_world_get_device(*c->slot, &device, &error), &error) && device.works);
}

static void ask(calls *c)
{
	const carom_world_def def = bytes_world_def(&c->bytes);
	const size_t bodies = bytes_byte(&c->bytes), vertices = bytes_byte(&c->bytes);
	const uint64_t memory = carom_world_memory(&def, bodies, vertices);
	const int number = (int)bytes_byte(&c->bytes) - 4;
	calls_note(c, &memory, sizeof memory);
	FUZZ_EXPECT(strncmp(carom_status_name((carom_status)number), "CAROM_", 6) == 0 && *carom_status_text((carom_status)number));
	FUZZ_EXPECT(*carom_version());
}

/* Any bodies, now and then one that is not there, or one twice. */
static void remove_some(calls *c)
{
	uint32_t indices[4];
	carom_error error = fuzz_blank();
	const size_t count = bytes_below(&c->bytes, COUNT(indices) + 1);
	const snapshot before = calls_look(c);
	for (size_t k = 0; k < count; k++)
		indices[k] = calls_index(c);
	if (!calls_judge(c, carom_world_remove(*c->slot, indices, count, &error), &error)) {
		FUZZ_EXPECT(strncmp(error.text, "indices[", 8) == 0);
		calls_same(c, before);
		return;
	}
	FUZZ_EXPECT(calls_look(c).count == before.count - count);
	FUZZ_EXPECT(count == 0 || carom_world_hit_count(*c->slot) == 0);
}

static void change(calls *c)
{
	const carom_world_def def = bytes_world_def(&c->bytes);
	carom_error error = fuzz_blank();
	if (calls_judge(c, carom_world_set_gravity(*c->slot, def.gravity, &error), &error))
		FUZZ_EXPECT(carom_world_get_def(*c->slot)->gravity.x == def.gravity.x);
	error = fuzz_blank();
	if (calls_judge(c, carom_world_set_time_step(*c->slot, def.time_step, &error), &error))
		FUZZ_EXPECT(carom_world_get_def(*c->slot)->time_step == def.time_step);
	error = fuzz_blank();
	carom_body_info info;
	const uint32_t index = calls_index(c), categories = bytes_byte(&c->bytes), mask = bytes_byte(&c->bytes);
	if (calls_judge(c, carom_world_set_filter(*c->slot, index, categories, mask, &error), &error))
		FUZZ_EXPECT(!carom_world_get_body(*c->slot, index, &info, NULL) && info.categories == categories && info.mask == mask);
}

/* ---- Which call */

typedef struct call {
	void (*make)(calls *c);
	bool needs_world;
} call;

static const call all[] = {{create, false}, {add, true}, {add, true}, {add, true}, {add, true}, {calls_step, true}, {calls_step, true},
	{calls_step, true}, {calls_advance, true}, {calls_advance_to, true}, {calls_break_off, true}, {get_body, true}, {get_states, true},
	{set_states, true}, {set_force, true}, {measure, true}, {calls_render, true}, {calls_scene, true}, {destroy, true}, {add_too_many, true},
	{calls_parse, false}, {calls_png, false}, {calls_file, false}, {set_pipeline, false}, {list, false}, {ask, false}, {set_contacts, true},
	{get_contacts, true}, {remove_some, true}, {change, true}, {ask_where, true}, {calls_join, true}};

void calls_make(calls *c)
{
	const uint8_t which = bytes_byte(&c->bytes);
	const call *next = &all[which / 4 % COUNT(all)];
	c->slot = &c->worlds[which % 4 < MOST_WORLDS ? which % 4 : 0];
	if (next->needs_world && !*c->slot)
		create(c);
	if (!next->needs_world || *c->slot)
		next->make(c);
}
