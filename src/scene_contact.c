/* What a scene file may hold of a body's contacts, read as bodies are.
 * SPDX-License-Identifier: MIT */
#include "scene_json.h"

#include <float.h>
#include <string.h>

static const struct scene_range no_less_than_0 = {0, FLT_MAX, false, "a number from 0 to 3.4e38"};
static const struct scene_range index_of_body = {0, UINT32_MAX, false, "the index of a body before this one"};

static const struct scene_range number_of_part = {0, CAROM_MAX_PARTS - 1, false, "a whole number from 0 to 3"};

#define WALLS "\"left\", \"bottom\", \"right\" or \"top\""

struct contact {
	carom_contact contact;
	uint32_t other;   /* UINT32_MAX until there is one */
	const char *wall; /* NULL: it is another body */
};

static bool fit_wall(const char *name, int32_t *other)
{
	for (int32_t k = 0; k < SCENE_WALLS; k++) {
		if (strcmp(name, scene_walls[k]) == 0) {
			*other = -1 - k;
			return true;
		}
	}
	return false;
}

static const struct scene_field fields[] = {
	{"body", scene_read_whole, scene_quick_whole, offsetof(struct contact, other), &index_of_body, false},
	{"wall", scene_read_string, scene_quick_string, offsetof(struct contact, wall), NULL, false},
	{"normal", scene_read_pair, scene_quick_pair, offsetof(struct contact, contact.normal), &no_less_than_0, true},
	{"friction", scene_read_pair, scene_quick_pair, offsetof(struct contact, contact.friction), &scene_any, false},
	{"part", scene_read_whole, scene_quick_whole, offsetof(struct contact, contact.part), &number_of_part, false},
	SCENE_LAST_FIELD,
};

static bool add(carom_scene *scene, struct contact *contact)
{
	contact->contact.body = (uint32_t)scene->body_count;
	if (!contact->wall)
		contact->contact.other = (int32_t)contact->other;
	carom_contact *contacts = scene_grow(scene->contacts, scene->contact_count, sizeof *contacts);
	if (!contacts)
		return false;
	scene->contacts = contacts;
	contacts[scene->contact_count++] = contact->contact;
	return true;
}

static carom_status read_one(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	struct contact contact = {.other = UINT32_MAX};
	(void)target;
	(void)range;
	carom_status status = scene_read_object(reader, place, value, &contact, fields);
	if (status != CAROM_OK)
		return status;
	if (!contact.wall == (contact.other == UINT32_MAX))
		return scene_fail(reader, place, "allowed: either \"body\" or \"wall\", whom it is with");
	if (contact.wall && !fit_wall(contact.wall, &contact.contact.other))
		return scene_fail(reader, &(struct scene_place){place, "wall", 0}, "found \"%.40s\"; allowed: " WALLS, contact.wall);
	if (!contact.wall && contact.other >= reader->scene->body_count)
		return scene_fail(reader, &(struct scene_place){place, "body", 0}, "found %u; allowed: %s", (unsigned)contact.other, index_of_body.text);
	return add(reader->scene, &contact) ? CAROM_OK : scene_fail_memory(reader);
}

static bool quick_one(struct scene_text *text)
{
	struct contact contact = {.other = UINT32_MAX};
	if (!scene_quick_object(text, &contact, fields) || !contact.wall == (contact.other == UINT32_MAX))
		return false;
	if (contact.wall ? !fit_wall(contact.wall, &contact.contact.other) : contact.other >= text->scene->body_count)
		return false;
	return add(text->scene, &contact);
}

carom_status scene_read_contacts(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	if (!scene_is_array(value))
		return scene_fail_value(reader, place, value, "an array of contacts");
	return scene_read_array(reader, place, value, target, 0, read_one, range);
}

bool scene_quick_contacts(struct scene_text *text, void *target, const struct scene_range *range)
{
	(void)target;
	(void)range;
	return scene_quick_array(text, quick_one);
}
