/* Calls that draw, write and read.
 * SPDX-License-Identifier: MIT */
#include "calls.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TOO_WIDE = 16385 };

void calls_render(calls *c)
{
	carom_render_def def = bytes_render_def(&c->bytes);
	carom_error error = fuzz_blank();
	const size_t size = (size_t)def.width * def.height * 4;
	uint8_t *pixels = malloc(size);
	FUZZ_EXPECT(pixels);
	memset(pixels, 1, size);
	const uint8_t wrong = c->bytes.tame ? 255 : bytes_byte(&c->bytes);
	if (wrong < 8)
		def.width = wrong % 2 ? TOO_WIDE : 0;
	const snapshot before = calls_look(c);
	carom_camera camera;
	if (carom_world_fit_camera(*c->slot, &def, &camera, NULL) == CAROM_OK)
		FUZZ_EXPECT(camera.height > 0);
	if (calls_judge(c, carom_world_render(*c->slot, &def, pixels, &error), &error)) {
		calls_note(c, pixels, size);
		for (size_t k = 3; k < size; k += 4)
			FUZZ_EXPECT(pixels[k] == 255);
	} else {
		FUZZ_EXPECT(!c->bytes.tame && pixels[0] == 1 && pixels[size - 1] == 1);
	}
	free(pixels);
	calls_same(c, before);
	FUZZ_EXPECT(carom_world_render(*c->slot, NULL, NULL, NULL) == CAROM_INVALID_ARGUMENT);
}

void calls_png(calls *c)
{
	static const uint8_t pixels[8 * 8 * 4] = {1, 2, 3, 255};
	static const char *const paths[] = {"", "/nowhere/picture.png", "/"};
	const uint32_t which = bytes_below(&c->bytes, 8), width = bytes_below(&c->bytes, 9), height = bytes_below(&c->bytes, 9);
	const char *path = which < 3 ? paths[which] : which == 3 ? NULL : fuzz_path("picture.png");
	carom_error error = fuzz_blank();
	if (calls_judge(c, carom_png_write(path, which == 4 ? NULL : pixels, which == 5 ? TOO_WIDE * TOO_WIDE : width, height, &error), &error)) {
		FUZZ_EXPECT(which > 5 && width > 0 && height > 0 && unlink(path) == 0);
	} else {
		FUZZ_EXPECT(which <= 5 || width == 0 || height == 0);
	}
}

/* A file is there when it was committed, and not before. */
void calls_file(calls *c)
{
	static const char *const paths[] = {"", "/nowhere/file", "/"};
	const uint32_t which = bytes_below(&c->bytes, 8);
	const char *path = which < 3 ? paths[which] : which == 3 ? NULL : fuzz_path("file");
	const bool commits = bytes_chance(&c->bytes, 2);
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = fuzz_blank();
	if (!calls_judge(c, carom_file_create(path, &file, &stream, &error), &error)) {
		FUZZ_EXPECT(!file && !stream && which <= 3);
		return;
	}
	FUZZ_EXPECT(which > 3 && fputs("text", stream) >= 0 && access(path, F_OK) != 0);
	if (commits)
		FUZZ_EXPECT(calls_judge(c, carom_file_commit(file, &error), &error) && unlink(path) == 0);
	else
		carom_file_destroy(file);
	FUZZ_EXPECT(access(path, F_OK) != 0 && carom_file_commit(NULL, NULL) == CAROM_INVALID_ARGUMENT);
}

/* ---- Scenes */

static uint64_t hash_of(carom_world *world)
{
	uint64_t hash = 0;
	FUZZ_EXPECT(carom_world_hash(world, &hash, NULL) == CAROM_OK);
	return hash;
}

/* The world's scene takes its place, as it were stopped and resumed. */
void calls_scene(calls *c)
{
	const char *path = fuzz_path("state.json");
	const carom_camera camera = {{1, 2}, 3};
	carom_scene *scene = NULL;
	carom_world *again = NULL;
	carom_error error = fuzz_blank();
	const bool has_camera = bytes_chance(&c->bytes, 2);
	FUZZ_EXPECT(calls_judge(c, carom_world_write_scene(*c->slot, has_camera ? &camera : NULL, path, &error), &error));
	FUZZ_EXPECT_SAID(calls_judge(c, carom_scene_read(path, &scene, &error), &error), error.text);
	unlink(path);
	FUZZ_EXPECT(scene->has_camera == has_camera && scene->body_count == carom_world_body_count(*c->slot));
	scene->world.device = fuzz_device();
	scene->world.threads = c->threads;
	FUZZ_EXPECT_SAID(calls_judge(c, carom_scene_create_world(scene, &again, &error), &error), error.text);
	FUZZ_EXPECT(hash_of(again) == hash_of(*c->slot));
	carom_world_destroy(*c->slot);
	*c->slot = again;
	carom_scene_destroy(scene);
}

/* A small scene with bytes of the input in it. */
void calls_parse(calls *c)
{
	static const char text[] = "{\"format\": \"carom-scene/1\", \"bodies\": [{\"circle\": {\"radius\": 0.5}, \"angle\": 00000000}]}";
	char damaged[sizeof text];
	carom_scene *scene = NULL;
	carom_world *world = NULL;
	carom_error error = fuzz_blank();
	const size_t length = bytes_chance(&c->bytes, 4) ? bytes_below(&c->bytes, sizeof text) : sizeof text - 1;
	memcpy(damaged, text, sizeof text);
	for (int k = 0; k < 8; k++)
		damaged[sizeof text - 12 + (size_t)k] = (char)bytes_byte(&c->bytes);
	if (!calls_judge(c, carom_scene_parse(damaged, length, bytes_chance(&c->bytes, 2) ? "memory" : NULL, &scene, &error), &error)) {
		FUZZ_EXPECT(!scene && error.status == CAROM_INVALID_SCENE);
		return;
	}
	scene->world.device = fuzz_device();
	scene->bodies[0].position.x = bytes_wild(&c->bytes);
	if (!calls_judge(c, carom_scene_create_world(scene, &world, &error), &error))
		FUZZ_EXPECT(!world && error.status == CAROM_INVALID_SCENE);
	carom_world_destroy(world);
	carom_scene_destroy(scene);
}
