/* SPDX-License-Identifier: MIT */
#include "walk.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cl/functions.h"
#include "runs.h"
#include "scenes.h"
#include "world.h"

enum { BODIES = 24, STEPS = 3, WIDTH = 64, HEIGHT = 48 };

static char folder[] = "/tmp/carom-test-XXXXXX";

int walk_make_folder(void **state)
{
	(void)state;
	return mkdtemp(folder) ? 0 : -1;
}

/* Fails if a temporary file was left in it. */
int walk_remove_folder(void **state)
{
	(void)state;
	return rmdir(folder);
}

int walk_code(uint64_t nth)
{
	static const int codes[] = {
		CL_OUT_OF_HOST_MEMORY, CL_OUT_OF_RESOURCES, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_DEVICE_NOT_AVAILABLE, CL_BUILD_PROGRAM_FAILURE};
	return codes[nth % COUNT(codes)];
}

static void nothing_is_alive(const char *call)
{
	char kinds[1024];
	scenery_forget_kernels();
	if (faults_alive(kinds, sizeof kinds))
		fail_msg("after %s failed there are objects of%s", call ? call : "nothing", kinds);
}

/* ---- Opening */

static void write_text(const char *path, const char *text, size_t length)
{
	FILE *file = fopen(path, "wb");
	assert_non_null(file);
	assert_true(fwrite(text, 1, length, file) == length);
	fclose(file);
}

/* The first picture: the device makes ready for it. */
static carom_status draw_first(carom_world *world, carom_error *error)
{
	carom_render_def def = carom_default_render_def();
	uint8_t pixels[4 * WIDTH * HEIGHT];
	carom_error other;
	def.width = WIDTH;
	def.height = HEIGHT;
	const carom_status status = carom_world_render(world, &def, pixels, error);
	if (status)
		scenery_check(carom_world_render(world, &def, pixels, &other), &other);
	return status;
}

static carom_status open_all(const char *path, const scenery_device *device, const char *step, carom_error *error)
{
	carom_scene *scene = NULL;
	carom_world *world = NULL;
	carom_status status = carom_scene_read(path, &scene, error);
	if (!status) {
		scene->world.device = device->name;
		scene->world.storage = device->storage;
		scene->world.pipeline.step = step;
		scene->world.threads = 3;
		status = carom_scene_create_world(scene, &world, error);
	}
	if (!status)
		status = draw_first(world, error);
	carom_world_destroy(world);
	carom_scene_destroy(scene);
	return status;
}

bool walk_opening(const scenery_device *device, const char *step, faults_kind kind, walk_judge *judge)
{
	const carom_world_def def = carom_default_world_def();
	carom_world *world = scenery_world(&def, device);
	char path[128];
	const char *failed = "";
	if (!world)
		return false;
	carom_world_destroy(world);
	scenery_forget_kernels(); /* they are to be built in each run */
	snprintf(path, sizeof path, "%s/everything.json", folder);
	write_text(path, everything, sizeof everything - 1);
	for (uint64_t n = 1; failed; n++) {
		carom_error error = {.status = CAROM_OK};
		faults_arm(kind, n, walk_code(n));
		const carom_status status = open_all(path, device, step, &error);
		failed = faults_disarm();
		if (status || failed)
			judge(failed, status, &error);
		nothing_is_alive(failed);
	}
	unlink(path);
	return true;
}

/* ---- Running */

typedef struct walk {
	carom_world *world;
	carom_body_state start[BODIES];
	uint64_t hashes[STEPS + 1]; /* after so many steps */
	uint64_t steps;             /* done */
	double times[STEPS + 1];    /* s, likewise, since the start */
	double begun;               /* s: the world's time at the start */
	bool grows;                 /* the lists, and steps are all there is */
	char scene[128], picture[128];
	uint8_t expected[4 * WIDTH * HEIGHT];
} walk;

static carom_status take_steps(walk *w, carom_error *error)
{
	carom_report report = {0};
	const carom_status status = carom_world_step(w->world, STEPS - w->steps, &report, error);
	w->steps += report.steps;
	return status;
}

static carom_status measure(walk *w, carom_error *error)
{
	carom_measure all;
	return carom_world_measure(w->world, &all, error);
}

static carom_status hash(walk *w, carom_error *error)
{
	uint64_t found = 0;
	const carom_status status = carom_world_hash(w->world, &found, error);
	assert_true(status || found == w->hashes[w->steps]);
	return status;
}

static carom_status write_scene(walk *w, carom_error *error)
{
	return carom_world_write_scene(w->world, NULL, w->scene, error);
}

static carom_status draw(walk *w, carom_error *error)
{
	carom_render_def def = carom_default_render_def();
	uint8_t pixels[sizeof w->expected];
	def.width = WIDTH;
	def.height = HEIGHT;
	carom_status status = carom_world_render(w->world, &def, pixels, error);
	if (!status)
		assert_memory_equal(pixels, w->expected, sizeof pixels);
	return status ? status : carom_png_write(w->picture, pixels, WIDTH, HEIGHT, error);
}

/* Where a time is not told it is not counted. */
static carom_status profile(walk *w, carom_error *error)
{
	carom_kernel_time time;
	(void)error;
	for (size_t i = 0; carom_world_profile(w->world, i, &time); i++)
		assert_true(time.seconds >= 0.0 && time.seconds < 1e3);
	return CAROM_OK;
}

/* Back to the start, with no texture on the device. */
static void begin_anew(walk *w)
{
	carom_error error;
	scenery_check(carom_world_set_states(w->world, 0, BODIES, w->start, &error), &error);
	scenery_check(carom_world_set_contacts(w->world, 0, NULL, &error), &error);
	scenery_check(carom_textures_fetch(w->world, &error), &error); /* or what was set would be lost, too */
	carom_textures_destroy(w->world);
	profile(w, &error); /* the device forgets its launches */
	if (w->grows) {
		scenery_check(carom_textures_update(w->world, &error), &error);
		w->world->events.room = w->world->events.node_room = 1; /* say the lists, which hold more */
		w->world->events.slices = 2;                            /* and numbers are to have room to be saved */
	}
	w->world->batch = 1;
	w->steps = 0;
	w->begun = carom_world_time(w->world);
	write_text(w->scene, "old", 3);
	write_text(w->picture, "old", 3);
}

static void is_old(const char *path)
{
	char text[8] = "";
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	assert_true(fread(text, 1, sizeof text, file) == 3);
	assert_string_equal(text, "old");
	fclose(file);
}

static void state_is_good(walk *w, const char *call)
{
	if (runs_hash(w->world) != w->hashes[w->steps])
		fail_msg("%s failed: the state is not that after %llu steps", call, (unsigned long long)w->steps);
	runs_near(carom_world_time(w->world) - w->begun, w->times[w->steps], 1e-9);
}

/* `failed` is the call before this one, and becomes this one. Arguments of kernels are many and alike: of those in a row all fail, but only
 * the first is gone on after. */
static void go_through(walk *w, faults_kind kind, uint64_t n, walk_judge *judge, const char **failed)
{
	const char *const before = *failed;
	static carom_status (*const all[])(walk *, carom_error *) = {take_steps, measure, hash, write_scene, draw, profile};
	const size_t count = w->grows ? 1 : COUNT(all);
	carom_error error = {.status = CAROM_OK};
	carom_status status = CAROM_OK;
	size_t i = 0;
	begin_anew(w);
	faults_arm(kind, n, walk_code(n));
	while (i < count && !faults_failed() && !(status = all[i](w, &error)))
		i++;
	*failed = faults_disarm();
	if (!status && (!*failed || i == COUNT(all)))
		return;
	judge(*failed, status, &error);
	state_is_good(w, *failed);
	if (all[i] == write_scene)
		is_old(w->scene);
	if (all[i] == draw)
		is_old(w->picture);
	if (strcmp(before, *failed) == 0)
		return;
	for (; i < count; i++)
		scenery_check(all[i](w, &error), &error);
	assert_true(runs_hash(w->world) == w->hashes[STEPS]);
}

static walk *walk_of(carom_world *world)
{
	walk *w = calloc(1, sizeof *w);
	carom_render_def def = carom_default_render_def();
	carom_error error;
	assert_non_null(w);
	w->world = world;
	snprintf(w->scene, sizeof w->scene, "%s/state.json", folder);
	snprintf(w->picture, sizeof w->picture, "%s/frame.png", folder);
	scenery_check(carom_world_get_states(world, 0, BODIES, w->start, &error), &error);
	for (int i = 0; i <= STEPS; i++) {
		w->hashes[i] = runs_hash(world);
		w->times[i] = carom_world_time(world);
		if (i < STEPS)
			assert_true(runs_step(world, 1).steps == 1);
	}
	def.width = WIDTH;
	def.height = HEIGHT;
	scenery_check(carom_world_render(world, &def, w->expected, &error), &error);
	return w;
}

static carom_world *crowd(const scenery_device *device, const char *step)
{
	carom_world_def def = runs_room(4.0f, 4.0f);
	carom_body_def bodies[BODIES];
	scenery_random random = {5};
	def.pipeline.step = step;
	def.time_step = 0.0625f;
	if (!strcmp(step, "contacts")) { /* something has to be borne */
		def.gravity.y = -10.0f;
		def.restitution = 0.0f;
	}
	def.threads = 1; /* or the order of the calls were another each time */
	def.profile = true;
	scenery_bodies(&random, SCENERY_MIXED, BODIES, 1.25f, 6.0f, bodies);
	for (int i = 0; i < BODIES && def.gravity.y < 0.0f; i++)
		bodies[i].restitution = 0.0f;
	bodies[0].name = "named";
	return runs_world(&def, device, bodies, BODIES);
}

static bool walk_world(const scenery_device *device, const char *step, bool grows, faults_kind kind, walk_judge *judge)
{
	carom_world *world = crowd(device, step);
	const char *failed = "";
	if (!world)
		return false;
	walk *w = walk_of(world);
	uint64_t n = 0;
	w->grows = grows;
	while (failed)
		go_through(w, kind, ++n, judge, &failed);
	print_message("%s, %s%s: %llu calls\n", device->name, step, grows ? " with lists that grow" : "", (unsigned long long)n - 1);
	unlink(w->scene);
	unlink(w->picture);
	carom_world_destroy(world);
	nothing_is_alive(NULL);
	free(w);
	return true;
}

void walk_running(const scenery_device *device, const char *step, faults_kind kind, walk_judge *judge)
{
	walk_world(device, step, false, kind, judge);
}

bool walk_growing(const scenery_device *device, faults_kind kind, walk_judge *judge)
{
	return walk_world(device, "events", true, kind, judge);
}

/* ---- Steering */

/* Where no other body is: to have two in one place would take most of the time. */
static const carom_body_state steered[2] = {{{3.4f, 3.4f}, 0.0f, {-4.0f, -3.0f}, 0.0f}, {{-3.4f, 3.4f}, 0.5f, {3.0f, -5.0f}, 2.0f}};

/* The states that were read are those of the body that is not steered. */
static carom_status steer(carom_world *world, carom_body_state *read, carom_report *report, carom_error *error)
{
	carom_status status = carom_world_set_states(world, 0, 2, steered, error);
	if (!status)
		status = carom_world_set_force(world, 2, (carom_vec2){3.0f, -2.0f}, 1.0f, error);
	if (!status)
		status = carom_world_set_gravity(world, (carom_vec2){1.0f, -2.0f}, error);
	if (!status)
		status = carom_world_set_time_step(world, 0.125f, error);
	if (!status)
		status = carom_world_set_filter(world, 4, 2, CAROM_MASK - 2, error);
	if (!status)
		status = carom_world_get_states(world, 3, 1, read, error);
	return status ? status : carom_world_step(world, 1, report, error);
}

static void restart(carom_world *world, const carom_body_state *start)
{
	carom_error error;
	scenery_check(carom_world_set_states(world, 0, BODIES, start, &error), &error);
	scenery_check(carom_world_set_force(world, 2, (carom_vec2){0.0f, 0.0f}, 0.0f, &error), &error);
	scenery_check(carom_world_set_gravity(world, (carom_vec2){0.0f, 0.0f}, &error), &error);
	scenery_check(carom_world_set_time_step(world, 0.0625f, &error), &error);
	scenery_check(carom_world_set_filter(world, 4, CAROM_CATEGORIES, CAROM_MASK, &error), &error);
	runs_step(world, 1);
	world->events.change_room = 0; /* say so: it grows */
}

bool walk_steering(const scenery_device *device, faults_kind kind, walk_judge *judge)
{
	carom_world *world = crowd(device, "events");
	carom_body_state start[BODIES], other;
	const char *failed = "";
	uint64_t n, first = 0;
	carom_error error;
	if (!world)
		return false;
	scenery_check(carom_world_get_states(world, 0, BODIES, start, &error), &error);
	restart(world, start);
	other = runs_state(world, 3);
	for (n = 1; failed; n++) {
		carom_body_state read = other;
		carom_report report = {0};
		restart(world, start);
		faults_arm(kind, n, walk_code(n));
		const carom_status status = steer(world, &read, &report, &error);
		failed = faults_disarm();
		if (status)
			judge(failed, status, &error);
		if (status && report.steps == 0)
			scenery_check(steer(world, &read, &report, &error), &error);
		assert_memory_equal(&read, &other, sizeof read);
		runs_same_hash(&first, runs_hash(world), device);
	}
	print_message("%s, steered: %llu calls\n", device->name, (unsigned long long)n - 1);
	carom_world_destroy(world);
	nothing_is_alive(NULL);
	return true;
}
