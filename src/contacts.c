/* What pushes at contacts, as a part of the state: the host's list of it, and its way to the device (Warm in kernels/CONTRACT.md) and back. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "step/events.h"

_Static_assert(CAROM_MAX_PARTS == PAIR_RESTS, "of two bodies the device keeps as many contacts as the interface tells of");

static bool is_dynamic(const carom_world *world, int32_t body)
{
	return body >= 0 && carom_is_dynamic(&carom_world_bodies(world)[body]);
}

static size_t contact_count(const carom_world *world)
{
	return world->contacts.used / sizeof(carom_contact);
}

/* By the bodies, walls first, and the parts. */
static int compare(const void *left, const void *right)
{
	const carom_contact *a = left, *b = right;
	if (a->body != b->body)
		return a->body < b->body ? -1 : 1;
	if (a->other != b->other)
		return a->other < b->other ? -1 : 1;
	return a->part < b->part ? -1 : a->part > b->part;
}

/* ---- The device's copy ---- */

/* Records of Warm, and WarmSpans, in whole rows. */
typedef struct warm {
	float *records;
	int32_t *spans;
	uint32_t width;           /* records a contact */
	uint32_t rows, span_rows; /* of those that are moved */
} warm;

static void warm_destroy(warm *w)
{
	free(w->records);
	free(w->spans);
}

static carom_status no_memory(const carom_world *world, carom_error *error)
{
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to move the contacts of %zu bodies", world->body_count);
}

static carom_status warm_create(const carom_world *world, warm *w, carom_error *error)
{
	const uint32_t spans = WARM_SPAN_WIDTH * (world->capacity + 1);
	*w = (warm){.width = WARM_WIDTH(world->traits & TRAIT_RUBS), .span_rows = carom_row_count(spans)};
	w->spans = calloc((size_t)w->span_rows * carom_row_width(spans), sizeof *w->spans);
	return w->spans ? CAROM_OK : no_memory(world, error);
}

/* Of the first so many contacts that there is room for. */
static carom_status warm_create_records(const carom_world *world, warm *w, uint32_t contacts, carom_error *error)
{
	const uint32_t row = carom_row_width(w->width * world->events.warm_room);
	w->rows = (w->width * contacts + row - 1) / row;
	w->records = calloc((size_t)w->rows * row + 1, 4 * sizeof *w->records);
	return w->records ? CAROM_OK : no_memory(world, error);
}

static int32_t *span_of(const warm *w, uint32_t body)
{
	return w->spans + WARM_SPAN_WIDTH * ((size_t)body + 1);
}

/* Contact k of a body: its record, and where bodies rub another one behind that. */
static float *warm_at(const warm *w, uint32_t body, int32_t k)
{
	return w->records + 4 * (size_t)w->width * (size_t)(span_of(w, body)[WARM_SPAN_START] + k);
}

static void put_side(const carom_world *world, warm *w, uint32_t body, int32_t other, const carom_contact *contact)
{
	float *record;
	if (!is_dynamic(world, (int32_t)body))
		return;
	record = warm_at(w, body, span_of(w, body)[WARM_SPAN_COUNT]++);
	record[WARM_PARTNER] = (float)other;
	memcpy(record + WARM_FORCES, contact->normal, sizeof contact->normal);
	if (world->traits & TRAIT_RUBS)
		memcpy(record + 4 + WARM_FRICTION, contact->friction, sizeof contact->friction);
}

/* Gives each body room for its contacts, and half as many more. */
static uint64_t give_room(const carom_world *world, warm *w)
{
	const carom_contact *contacts = world->contacts.items;
	uint64_t taken = 0;
	for (size_t i = 0; i < contact_count(world); i++)
		for (int side = 0; side < 2; side++) {
			const int32_t body = side ? contacts[i].other : (int32_t)contacts[i].body;
			if (is_dynamic(world, body))
				span_of(w, (uint32_t)body)[WARM_SPAN_ROOM]++;
		}
	for (uint32_t body = 0; body < world->body_count; body++) {
		int32_t *span = span_of(w, body);
		span[WARM_SPAN_START] = (int32_t)taken;
		span[WARM_SPAN_ROOM] += span[WARM_SPAN_ROOM] / 2;
		taken += (uint64_t)span[WARM_SPAN_ROOM];
	}
	return taken;
}

static carom_status make_room(carom_world *world, uint64_t contacts, carom_error *error)
{
	if (contacts > INT32_MAX / 2)
		return carom_fail(error, CAROM_LIMIT, "the %zu bodies have %llu contacts: more than any device holds", world->body_count,
			(unsigned long long)contacts);
	world->events.warm_room = carom_events_enough((int32_t)contacts);
	return carom_events_create_list(world, ROLE_WARM, false, WARM_WIDTH(world->traits & TRAIT_RUBS) * (uint64_t)world->events.warm_room, error);
}

static carom_status send(carom_world *world, warm *w, carom_error *error)
{
	const carom_contact *contacts = world->contacts.items;
	const size_t count = contact_count(world);
	const carom_device_class *kind = world->device->kind;
	const uint64_t taken = give_room(world, w);
	if (taken > world->events.warm_room)
		TRY(make_room(world, taken, error));
	TRY(warm_create_records(world, w, (uint32_t)taken, error));
	for (size_t i = 0; i < count; i++)
		put_side(world, w, contacts[i].body, contacts[i].other, &contacts[i]);
	for (size_t i = 0; i < count; i++)
		if (contacts[i].other >= 0)
			put_side(world, w, (uint32_t)contacts[i].other, (int32_t)contacts[i].body, &contacts[i]);
	w->spans[WARM_TAKEN] = (int32_t)taken;
	w->spans[WARM_ROOM] = (int32_t)world->events.warm_room;
	if (w->rows > 0)
		TRY(kind->upload(world->device, world->textures[ROLE_WARM].front, w->rows, w->records, error));
	return kind->upload(world->device, world->textures[ROLE_WARM_SPANS].front, w->span_rows, w->spans, error);
}

carom_status carom_contacts_send(carom_world *world, carom_error *error)
{
	warm w;
	carom_status status;
	if (world->contacts_sent)
		return CAROM_OK;
	status = warm_create(world, &w, error);
	if (!status)
		status = send(world, &w, error);
	warm_destroy(&w);
	if (!status)
		status = carom_joints_send(world, error);
	world->contacts_sent = !status;
	return status;
}

/* Two bodies that move both have the contact: the one of the larger index tells of it. Of the same two they are in order. */
static bool take_body(carom_world *world, const warm *w, uint32_t body)
{
	int32_t before = INT32_MIN;
	uint32_t part = 0;
	for (int32_t k = 0; k < span_of(w, body)[WARM_SPAN_COUNT]; k++) {
		const float *record = warm_at(w, body, k);
		const int32_t other = (int32_t)record[WARM_PARTNER];
		carom_contact *contact;
		part = other == before ? part + 1 : 0;
		before = other;
		if (other > (int32_t)body && is_dynamic(world, other))
			continue;
		contact = carom_array_grow(&world->contacts, sizeof *contact);
		if (!contact)
			return false;
		*contact = other < (int32_t)body ? (carom_contact){.body = body, .other = other}
										 : (carom_contact){.body = (uint32_t)other, .other = (int32_t)body};
		contact->part = part;
		memcpy(contact->normal, record + WARM_FORCES, sizeof contact->normal);
		if (world->traits & TRAIT_RUBS)
			memcpy(contact->friction, record + 4 + WARM_FRICTION, sizeof contact->friction);
	}
	return true;
}

static carom_status take(carom_world *world, warm *w, carom_error *error)
{
	const carom_device_class *kind = world->device->kind;
	int32_t taken;
	TRY(kind->download(world->device, world->textures[ROLE_WARM_SPANS].front, w->span_rows, w->spans, error));
	taken = w->spans[WARM_TAKEN] < w->spans[WARM_ROOM] ? w->spans[WARM_TAKEN] : w->spans[WARM_ROOM];
	TRY(warm_create_records(world, w, (uint32_t)taken, error));
	if (w->rows > 0)
		TRY(kind->download(world->device, world->textures[ROLE_WARM].front, w->rows, w->records, error));
	for (uint32_t body = 0; body < world->body_count; body++)
		if (!take_body(world, w, body))
			return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the contacts of %zu bodies", world->body_count);
	return CAROM_OK;
}

static carom_status download(carom_world *world, carom_error *error)
{
	warm w;
	carom_status status = warm_create(world, &w, error);
	if (!status)
		status = take(world, &w, error);
	warm_destroy(&w);
	return status;
}

carom_status carom_contacts_fetch(carom_world *world, carom_error *error)
{
	carom_status status = CAROM_OK;
	if (world->contacts_current)
		return CAROM_OK;
	world->contacts.used = 0;
	if (world->step == &carom_step_contacts)
		status = download(world, error);
	if (!status)
		status = carom_joints_fetch(world, error);
	if (status)
		return status;
	if (contact_count(world) > 1)
		qsort(world->contacts.items, contact_count(world), sizeof(carom_contact), compare);
	world->contacts_current = true;
	return CAROM_OK;
}

carom_status carom_contacts_grow(carom_world *world, carom_error *error)
{
	int32_t wanted = 0;
	warm w;
	carom_status status = warm_create(world, &w, error);
	if (!status)
		status = world->device->kind->download(world->device, world->textures[ROLE_WARM_SPANS].front, 1, w.spans, error); /* what is for all */
	if (!status)
		wanted = w.spans[WARM_TAKEN];
	warm_destroy(&w);
	if (status || (uint32_t)wanted <= world->events.warm_room)
		return status;
	TRY(carom_contacts_fetch(world, error)); /* what it has is a part of the state */
	world->contacts_sent = false;
	return make_room(world, (uint64_t)wanted, error);
}

/* ---- The interface ---- */

carom_status carom_world_contact_count(carom_world *world, size_t *count, carom_error *error)
{
	GIVEN(world, error);
	GIVEN(count, error);
	TRY(carom_contacts_fetch(world, error));
	*count = contact_count(world);
	return CAROM_OK;
}

carom_status carom_world_get_contacts(carom_world *world, size_t first, size_t count, carom_contact *contacts, carom_error *error)
{
	GIVEN(world, error);
	if (count > 0)
		GIVEN(contacts, error);
	TRY(carom_contacts_fetch(world, error));
	TRY(carom_check_span("contacts", first, count, "the world has", contact_count(world), error));
	if (count > 0)
		memcpy(contacts, (const carom_contact *)world->contacts.items + first, count * sizeof *contacts);
	return CAROM_OK;
}

static carom_status check_parties(const carom_world *world, size_t k, const carom_contact *contact, carom_error *error)
{
	if (contact->body >= world->body_count)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].body: found %u, the world has %zu bodies", k, contact->body,
			world->body_count);
	if (contact->other < CAROM_WALL_TOP || contact->other >= (int32_t)contact->body)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].other: found %d, must be the index of a body before body %u, or of a wall", k,
			(int)contact->other, contact->body);
	if (contact->other < 0 && !world->def.has_room)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].other: found a wall, but there is no room", k);
	if (!is_dynamic(world, (int32_t)contact->body) && !is_dynamic(world, contact->other))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu]: one of the two must be dynamic, and body %u is %s", k, contact->body,
			carom_world_bodies(world)[contact->body].is_static ? "static" : "kinematic");
	return CAROM_OK;
}

static carom_status check_contact(const carom_world *world, size_t k, const carom_contact *contact, carom_error *error)
{
	TRY(check_parties(world, k, contact, error));
	if (contact->part >= (contact->other < 0 ? 1 : CAROM_MAX_PARTS))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].part: found %u, must be %s", k, contact->part,
			contact->other < 0 ? "0 with a wall" : "from 0 to 3");
	for (int point = 0; point < 2; point++) {
		if (!(contact->normal[point] >= 0.0f) || !isfinite(contact->normal[point]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].normal: found %g, must be finite and at least 0 (N)", k,
				(double)contact->normal[point]);
		if (!isfinite(contact->friction[point]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].friction: must be two finite numbers (N)", k);
	}
	return CAROM_OK;
}

/* Of contacts in order: each part of a pair once. */
static carom_status check_together(size_t count, const carom_contact *contacts, carom_error *error)
{
	for (size_t k = 1; k < count; k++)
		if (compare(&contacts[k - 1], &contacts[k]) == 0)
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts: body %u has more than one with %s %d", contacts[k].body,
				contacts[k].other < 0 ? "wall" : "body", (int)contacts[k].other);
	return CAROM_OK;
}

carom_status carom_world_set_contacts(carom_world *world, size_t count, const carom_contact *contacts, carom_error *error)
{
	carom_array sorted = {0};
	carom_status status = CAROM_OK;
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	if (count > 0)
		GIVEN(contacts, error);
	for (size_t k = 0; k < count; k++)
		TRY(check_contact(world, k, &contacts[k], error));
	if (count > 0) {
		if (!carom_array_grow(&sorted, count * sizeof *contacts)) {
			status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for %zu contacts", count);
		} else {
			memcpy(sorted.items, contacts, count * sizeof *contacts);
			qsort(sorted.items, count, sizeof *contacts, compare);
			status = check_together(count, sorted.items, error);
		}
	}
	if (status) {
		free(sorted.items);
		return status;
	}
	free(world->contacts.items);
	world->contacts = sorted;
	world->contacts_current = true;
	world->contacts_sent = false;
	return CAROM_OK;
}
