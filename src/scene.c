/* The storage of a scene, and the world made from it.
 * SPDX-License-Identifier: MIT */
#include "scene.h"

#include "definition.h"

#include <stdlib.h>
#include <string.h>

#define BLOCK_SIZE 65536u
#define ALIGNMENT 16u

struct scene_block {
	struct scene_block *next;
	size_t used, size;
	_Alignas(ALIGNMENT) unsigned char bytes[];
};

static struct scene_block *add_block(struct scene_storage *storage, size_t size)
{
	struct scene_block *block = malloc(sizeof *block + size);
	if (!block)
		return NULL;
	block->next = storage->blocks;
	block->used = 0;
	block->size = size;
	storage->blocks = block;
	return block;
}

void *scene_allocate(carom_scene *scene, size_t size)
{
	struct scene_storage *storage = scene->storage;
	struct scene_block *block = storage->blocks;
	size_t rounded = (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
	if (!block || block->size - block->used < rounded)
		block = add_block(storage, rounded > BLOCK_SIZE ? rounded : BLOCK_SIZE);
	if (!block)
		return NULL;
	block->used += rounded;
	return block->bytes + block->used - rounded;
}

/* Twice as much each time: how much there is follows from the count, and what is given back is not missed. */
void *scene_grow(void *items, size_t count, size_t size)
{
	const size_t first = 64;
	if (count > 0 && (count < first || (count & (count - 1)) != 0))
		return items;
	return realloc(items, (count ? 2 * count : first) * size);
}

const char *const scene_walls[SCENE_WALLS] = {"left", "bottom", "right", "top"};
const char *const scene_joint_kinds[SCENE_JOINT_KINDS] = {"revolute", "distance", "rope", "spring", "slider"};

carom_scene *scene_create(const char *name)
{
	struct scene_storage *storage = calloc(1, sizeof *storage);
	carom_scene *scene = calloc(1, sizeof *scene);
	if (storage)
		storage->name = strdup(name);
	if (!storage || !scene || !storage->name) {
		if (storage)
			free(storage->name);
		free(storage);
		free(scene);
		return NULL;
	}
	scene->storage = storage;
	scene->world = carom_default_world_def();
	return scene;
}

void carom_scene_destroy(carom_scene *scene)
{
	if (!scene)
		return;
	struct scene_storage *storage = scene->storage;
	while (storage->blocks) {
		struct scene_block *next = storage->blocks->next;
		free(storage->blocks);
		storage->blocks = next;
	}
	free(storage->name);
	free(storage);
	free(scene->bodies);
	free(scene->contacts);
	free(scene->joints);
	free(scene);
}

/* The file's key around a field of carom_body_def, so that the error's path is the one in the file. */
static const char *outer_key(const carom_scene *scene, unsigned long index, const char *field)
{
	static const char *const shapes[] = {"circle.", "polygon.", "regular."};
	bool of_shape = strncmp(field, "vertices", 8) == 0 || strncmp(field, "vertex_count", 12) == 0 || strncmp(field, "radius", 6) == 0
		|| strncmp(field, "sides", 5) == 0;
	if (!of_shape || index >= scene->body_count || (unsigned)scene->bodies[index].shape > CAROM_REGULAR)
		return "";
	return shapes[scene->bodies[index].shape];
}

/* A contact stands in the file with its first body. */
static carom_status blame_contact(const carom_scene *scene, unsigned long index, const char *text, carom_error *error)
{
	const struct scene_storage *storage = scene->storage;
	const uint32_t body = scene->contacts[index].body;
	unsigned long k = 0;
	while (k < index && scene->contacts[index - k - 1].body == body)
		k++;
	if (strncmp(text, ".other", 6) == 0)
		text += strlen(".other");
	return carom_fail(error, CAROM_INVALID_SCENE, "%s: bodies[%lu].contacts[%lu]%s", storage->name, (unsigned long)body, k, text);
}

/* So does a joint. */
static carom_status blame_joint(const carom_scene *scene, unsigned long index, const char *text, carom_error *error)
{
	static const char other[] = ".other:";
	const struct scene_storage *storage = scene->storage;
	const uint32_t body = scene->joints[index].body;
	const bool is_other = strncmp(text, other, strlen(other)) == 0;
	unsigned long k = 0;
	while (k < index && scene->joints[index - k - 1].body == body)
		k++;
	return carom_fail(error, CAROM_INVALID_SCENE, "%s: bodies[%lu].joints[%lu]%s%s", storage->name, (unsigned long)body, k, is_other ? ".body:" : "",
		is_other ? text + strlen(other) : text);
}

/* An argument that the library refused came from the file: says so, in the file's words. */
static carom_status blame_file(const carom_scene *scene, carom_error *error)
{
	const struct scene_storage *storage = scene->storage;
	char text[sizeof error->text];
	unsigned long index;
	int length = 0;
	if (!error)
		return CAROM_INVALID_SCENE;
	memcpy(text, error->text, sizeof text);
	if (sscanf(text, "contacts[%lu]%n", &index, &length) == 1 && length > 0 && index < scene->contact_count)
		return blame_contact(scene, index, text + length, error);
	if (sscanf(text, "joints[%lu]%n", &index, &length) == 1 && length > 0 && index < scene->joint_count)
		return blame_joint(scene, index, text + length, error);
	if (sscanf(text, "bodies[%lu].%n", &index, &length) != 1 || length == 0) {
		return carom_fail(error, CAROM_INVALID_SCENE, "%s: %s", storage->name, text);
	}
	const char *field = text + length;
	const char *outer = outer_key(scene, index, field);
	if (strncmp(field, "is_", strlen("is_")) == 0)
		field += strlen("is_");
	return carom_fail(error, CAROM_INVALID_SCENE, "%s: bodies[%lu].%s%s", storage->name, index, outer, field);
}

static carom_status fill_world(const carom_scene *scene, carom_world *world, carom_error *error)
{
	TRY(carom_world_add(world, scene->bodies, scene->body_count, NULL, error));
	TRY(carom_world_set_joints(world, scene->joint_count, scene->joints, error));
	return carom_world_set_contacts(world, scene->contact_count, scene->contacts, error);
}

/* What else can be wrong as a world is made, like the environment, is not of the file. */
carom_status carom_scene_create_world(const carom_scene *scene, carom_world **world, carom_error *error)
{
	carom_world *made = NULL;
	GIVEN(scene, error);
	GIVEN(world, error);
	if (carom_check_world_def(&scene->world, error))
		return blame_file(scene, error);
	TRY(carom_world_create(&scene->world, &made, error));
	const carom_status status = fill_world(scene, made, error);
	if (status == CAROM_OK) {
		*world = made;
		return CAROM_OK;
	}
	carom_world_destroy(made);
	return status == CAROM_INVALID_ARGUMENT ? blame_file(scene, error) : status;
}
