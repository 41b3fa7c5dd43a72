/* What pushes at contacts, as a part of the state: the host's list of it, and its way to the device (Warm in kernels/CONTRACT.md) and back. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "world.h"

_Static_assert(CAROM_MAX_CONTACTS == CONTACTS_MOST, "the header tells it");

static bool is_dynamic(const carom_world *world, int32_t body)
{
	return body >= 0 && carom_is_dynamic(&carom_world_bodies(world)[body]);
}

static size_t contact_count(const carom_world *world)
{
	return world->contacts.used / sizeof(carom_contact);
}

/* By the bodies, walls first. */
static int compare(const void *left, const void *right)
{
	const carom_contact *a = left, *b = right;
	if (a->body != b->body)
		return a->body < b->body ? -1 : 1;
	return a->other < b->other ? -1 : a->other > b->other;
}

/* ---- The device's copy ---- */

/* Records of Warm and ints of WarmCount, of all bodies, in whole rows. */
typedef struct warm {
	float *records;
	int32_t *counts;
	size_t width;  /* records a contact */
	uint32_t rows; /* of records */
	size_t count_rows;
} warm;

static carom_status warm_create(const carom_world *world, warm *w, carom_error *error)
{
	const uint32_t width = WARM_WIDTH(world->rubs), records = CONTACTS_MOST * width, n = (uint32_t)world->body_count;
	*w = (warm){.width = width, .rows = carom_row_count(records * n), .count_rows = carom_row_count(world->capacity)};
	w->records = calloc((size_t)w->rows * carom_row_width(records * world->capacity), 4 * sizeof *w->records);
	w->counts = calloc(w->count_rows * carom_row_width(world->capacity), sizeof *w->counts);
	if (w->records && w->counts)
		return CAROM_OK;
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to move the contacts of %zu bodies", world->body_count);
}

static void warm_destroy(warm *w)
{
	free(w->records);
	free(w->counts);
}

/* Contact k of a body: its record, and where bodies rub another one behind that. */
static float *warm_at(const warm *w, uint32_t body, int32_t k)
{
	return w->records + 4 * w->width * (CONTACTS_MOST * (size_t)body + (size_t)k);
}

static void put_side(const carom_world *world, warm *w, uint32_t body, int32_t other, const carom_contact *contact)
{
	float *record;
	if (!is_dynamic(world, (int32_t)body))
		return;
	record = warm_at(w, body, w->counts[body]++);
	record[WARM_PARTNER] = (float)other;
	memcpy(record + WARM_FORCES, contact->normal, sizeof contact->normal);
	if (world->rubs)
		memcpy(record + 4 + WARM_FRICTION, contact->friction, sizeof contact->friction);
}

carom_status carom_contacts_send(carom_world *world, carom_error *error)
{
	const carom_contact *contacts = world->contacts.items;
	const size_t count = contact_count(world);
	const carom_device_class *kind = world->device->kind;
	warm w;
	carom_status status;
	if (world->contacts_sent)
		return CAROM_OK;
	status = warm_create(world, &w, error);
	for (size_t i = 0; !status && i < count; i++)
		put_side(world, &w, contacts[i].body, contacts[i].other, &contacts[i]);
	for (size_t i = 0; !status && i < count; i++)
		if (contacts[i].other >= 0)
			put_side(world, &w, (uint32_t)contacts[i].other, (int32_t)contacts[i].body, &contacts[i]);
	if (!status && count > 0)
		status = kind->upload(world->device, world->textures[ROLE_WARM].front, w.rows, w.records, error);
	if (!status)
		status = kind->upload(world->device, world->textures[ROLE_WARM_COUNT].front, (uint32_t)w.count_rows, w.counts, error);
	warm_destroy(&w);
	world->contacts_sent = !status;
	return status;
}

/* Two bodies that move both have the contact: the one of the larger index tells of it. */
static bool take_body(carom_world *world, const warm *w, uint32_t body)
{
	for (int32_t k = 0; k < w->counts[body]; k++) {
		const float *record = warm_at(w, body, k);
		const int32_t other = (int32_t)record[WARM_PARTNER];
		carom_contact *contact;
		if (other > (int32_t)body && is_dynamic(world, other))
			continue;
		contact = carom_array_grow(&world->contacts, sizeof *contact);
		if (!contact)
			return false;
		*contact = other < (int32_t)body ? (carom_contact){.body = body, .other = other}
										 : (carom_contact){.body = (uint32_t)other, .other = (int32_t)body};
		memcpy(contact->normal, record + WARM_FORCES, sizeof contact->normal);
		if (world->rubs)
			memcpy(contact->friction, record + 4 + WARM_FRICTION, sizeof contact->friction);
	}
	return true;
}

static carom_status download(carom_world *world, carom_error *error)
{
	const carom_device_class *kind = world->device->kind;
	warm w;
	carom_status status = warm_create(world, &w, error);
	if (!status)
		status = kind->download(world->device, world->textures[ROLE_WARM].front, w.rows, w.records, error);
	if (!status)
		status = kind->download(world->device, world->textures[ROLE_WARM_COUNT].front, (uint32_t)w.count_rows, w.counts, error);
	for (uint32_t body = 0; !status && body < world->body_count; body++)
		if (!take_body(world, &w, body))
			status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the contacts of %zu bodies", world->body_count);
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
	if (status)
		return status;
	if (contact_count(world) > 1)
		qsort(world->contacts.items, contact_count(world), sizeof(carom_contact), compare);
	world->contacts_current = true;
	return CAROM_OK;
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
	for (int point = 0; point < 2; point++) {
		if (!(contact->normal[point] >= 0.0f) || !isfinite(contact->normal[point]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].normal: found %g, must be finite and at least 0 (N)", k,
				(double)contact->normal[point]);
		if (!isfinite(contact->friction[point]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts[%zu].friction: must be two finite numbers (N)", k);
	}
	return CAROM_OK;
}

/* Of contacts in order: each pair once, and no more than Warm holds. `counts` has a 0 for each body. */
static carom_status check_together(const carom_world *world, size_t count, const carom_contact *contacts, uint8_t *counts, carom_error *error)
{
	for (size_t k = 0; k < count; k++) {
		const int32_t parties[2] = {(int32_t)contacts[k].body, contacts[k].other};
		if (k > 0 && compare(&contacts[k - 1], &contacts[k]) == 0)
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts: body %u has more than one with %s %d", contacts[k].body,
				contacts[k].other < 0 ? "wall" : "body", (int)contacts[k].other);
		for (int i = 0; i < 2; i++)
			if (is_dynamic(world, parties[i]) && ++counts[parties[i]] > CONTACTS_MOST)
				return carom_fail(error, CAROM_INVALID_ARGUMENT, "contacts: body %d has more than %d", (int)parties[i], CONTACTS_MOST);
	}
	return CAROM_OK;
}

carom_status carom_world_set_contacts(carom_world *world, size_t count, const carom_contact *contacts, carom_error *error)
{
	carom_array sorted = {0};
	uint8_t *counts = NULL;
	carom_status status = CAROM_OK;
	GIVEN(world, error);
	TRY(carom_check_idle(world, error));
	if (count > 0)
		GIVEN(contacts, error);
	for (size_t k = 0; k < count; k++)
		TRY(check_contact(world, k, &contacts[k], error));
	if (count > 0) {
		counts = calloc(world->body_count, sizeof *counts);
		if (!counts || !carom_array_grow(&sorted, count * sizeof *contacts)) {
			status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for %zu contacts", count);
		} else {
			memcpy(sorted.items, contacts, count * sizeof *contacts);
			qsort(sorted.items, count, sizeof *contacts, compare);
			status = check_together(world, count, sorted.items, counts, error);
		}
	}
	free(counts);
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
