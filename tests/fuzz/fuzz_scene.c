/* The reader of scenes: any bytes. What is accepted is written and read again as the same scene, what is refused is named.
 * SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char fuzz_name[] = "scene";

/* The text of a file, to be freed. */
static char *read_text(const char *path, size_t *length)
{
	FILE *file = fopen(path, "rb");
	FUZZ_EXPECT(file && fseek(file, 0, SEEK_END) == 0);
	const long size = ftell(file);
	FUZZ_EXPECT(size >= 0);
	rewind(file);
	char *text = malloc((size_t)size + 1);
	FUZZ_EXPECT(text && fread(text, 1, (size_t)size, file) == (size_t)size);
	fclose(file);
	*length = (size_t)size;
	return text;
}

/* Line and column are of a place in the text, or behind its last character. */
static void judge_place(const char *text, size_t length, const carom_error *error)
{
	const char *line = text, *end = text + length;
	int columns = 0;
	FUZZ_EXPECT(error->line > 0 || error->column == 0);
	for (int k = 1; k < error->line; k++) {
		line = memchr(line, '\n', (size_t)(end - line));
		FUZZ_EXPECT_SAID(line, error->text);
		line++;
	}
	for (; line < end && *line != '\n'; line++)
		columns += ((unsigned char)*line & 0xC0) != 0x80;
	FUZZ_EXPECT_SAID(error->column <= columns, error->text);
}

/* A world of the text, or NULL where it is refused as it has to be. */
static carom_world *world_of(const char *text, size_t length, carom_scene **scene)
{
	carom_world *world = NULL, *const no_world = world;
	carom_error error = fuzz_blank();
	*scene = NULL;
	if (!fuzz_judge(carom_scene_parse(text, length, "fuzz", scene, &error), &error)) {
		FUZZ_EXPECT_SAID(error.status == CAROM_INVALID_SCENE && strncmp(error.text, "fuzz:", 5) == 0, error.text);
		FUZZ_EXPECT(!*scene);
		judge_place(text, length, &error);
		return NULL;
	}
	FUZZ_EXPECT(*scene);
	(*scene)->world.device = fuzz_device();
	(*scene)->world.threads = 1;
	if (!fuzz_judge(carom_scene_create_world(*scene, &world, &error), &error)) {
		FUZZ_EXPECT_SAID(error.status == CAROM_INVALID_SCENE && strncmp(error.text, "fuzz: ", 6) == 0, error.text);
		FUZZ_EXPECT(world == no_world && error.line == 0);
	}
	return world;
}

static uint64_t hash_of(carom_world *world)
{
	uint64_t hash = 0;
	FUZZ_EXPECT(carom_world_hash(world, &hash, NULL) == CAROM_OK);
	return hash;
}

static char *written(carom_world *world, const carom_scene *scene, size_t *length)
{
	const char *path = fuzz_path("scene.json");
	carom_error error = fuzz_blank();
	FUZZ_EXPECT_SAID(fuzz_judge(carom_world_write_scene(world, scene->has_camera ? &scene->camera : NULL, path, &error), &error), error.text);
	char *text = read_text(path, length);
	unlink(path);
	return text;
}

/* Written, read and written again: the same state, and the same bytes, which tell of all that a scene can hold. */
static void write_and_read(carom_world *world, const carom_scene *scene)
{
	size_t length, length_again;
	char *text = written(world, scene, &length);
	carom_scene *scene_again;
	carom_world *again = world_of(text, length, &scene_again);
	FUZZ_EXPECT_SAID(again, "what was written can be read");
	FUZZ_EXPECT(hash_of(again) == hash_of(world) && carom_world_body_count(again) == carom_world_body_count(world));
	char *text_again = written(again, scene_again, &length_again);
	FUZZ_EXPECT_SAID(length_again == length && memcmp(text_again, text, length) == 0, text_again);
	free(text_again);
	free(text);
	carom_world_destroy(again);
	carom_scene_destroy(scene_again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	carom_scene *scene;
	carom_world *world = world_of((const char *)data, size, &scene);
	if (world)
		write_and_read(world, scene);
	carom_world_destroy(world);
	carom_scene_destroy(scene);
	return 0;
}
