/* Worlds written as scenes: there and back with the same bits.
 * SPDX-License-Identifier: MIT */
#include "hollows.h"
#include "scenes.h"

#include <dirent.h>
#include <unistd.h>

static char folder[] = "/tmp/carom-test-XXXXXX";

static const char *in_folder(const char *name)
{
	static char path[256];
	snprintf(path, sizeof path, "%s/%s", folder, name);
	return path;
}

static char *read_text(const char *path)
{
	static char text[1 << 20];
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	text[fread(text, 1, sizeof text - 1, file)] = '\0';
	fclose(file);
	return text;
}

static void assert_same_world(carom_world *a, carom_world *b)
{
	size_t count = carom_world_body_count(a);
	uint64_t hash_a = 0, hash_b = 1;
	assert_int_equal(count, carom_world_body_count(b));
	assert_int_equal(carom_world_hash(a, &hash_a, NULL), CAROM_OK);
	assert_int_equal(carom_world_hash(b, &hash_b, NULL), CAROM_OK);
	assert_true(hash_a == hash_b);
	for (uint32_t k = 0; k < count; k++) {
		carom_body_info x, y;
		assert_int_equal(carom_world_get_body(a, k, &x, NULL), CAROM_OK);
		assert_int_equal(carom_world_get_body(b, k, &y, NULL), CAROM_OK);
		assert_true(x.shape == y.shape && x.vertex_count == y.vertex_count && x.is_static == y.is_static && x.is_kinematic == y.is_kinematic
			&& x.color == y.color && x.categories == y.categories && x.mask == y.mask);
		assert_memory_equal(&x.radius, &y.radius, sizeof x.radius);
		assert_memory_equal(&x.mass, &y.mass, sizeof x.mass);
		assert_memory_equal(&x.inertia, &y.inertia, sizeof x.inertia);
		assert_memory_equal(&x.density, &y.density, sizeof x.density);
		assert_memory_equal(&x.restitution, &y.restitution, sizeof x.restitution);
		assert_memory_equal(&x.friction, &y.friction, sizeof x.friction);
		assert_memory_equal(&x.rolling_friction, &y.rolling_friction, sizeof x.rolling_friction);
		assert_memory_equal(&x.linear_damping, &y.linear_damping, sizeof x.linear_damping);
		assert_memory_equal(&x.angular_damping, &y.angular_damping, sizeof x.angular_damping);
		assert_memory_equal(&x.force, &y.force, sizeof x.force);
		assert_memory_equal(&x.torque, &y.torque, sizeof x.torque);
		if (x.vertices)
			assert_memory_equal(x.vertices, y.vertices, x.vertex_count * sizeof *x.vertices);
		assert_int_equal(x.name != NULL, y.name != NULL);
		if (x.name)
			assert_string_equal(x.name, y.name);
	}
}

/* Writes the world and answers the one that is read back; the file then has the name "there.json". */
static carom_world *there_and_back(carom_world *world, const carom_camera *camera, carom_scene **scene)
{
	carom_error error = {0};
	if (carom_world_write_scene(world, camera, in_folder("there.json"), &error) != CAROM_OK)
		fail_msg("%s", error.text);
	if (carom_scene_read(in_folder("there.json"), scene, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	char *text = NULL;
	size_t length = 0;
	if (carom_scene_text_create(world, camera, &text, &length, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	assert_int_equal(length, strlen(text));
	assert_string_equal(text, read_text(in_folder("there.json")));
	carom_scene_text_destroy(text);
	return world_of(*scene);
}

static void check_round_trip(carom_scene *scene)
{
	carom_scene *read = NULL, *again = NULL;
	carom_world *world = world_of(scene);
	carom_world *back = there_and_back(world, scene->has_camera ? &scene->camera : NULL, &read);
	char *text = strdup(read_text(in_folder("there.json")));
	assert_non_null(text);
	assert_same_world(world, back);
	assert_memory_equal(&scene->world.gravity, &read->world.gravity, sizeof scene->world.gravity);
	assert_memory_equal(&scene->world.time_step, &read->world.time_step, sizeof scene->world.time_step);
	assert_memory_equal(&scene->world.epsilon, &read->world.epsilon, sizeof scene->world.epsilon);
	assert_memory_equal(&scene->world.room_max, &read->world.room_max, sizeof scene->world.room_max);
	assert_true(scene->world.iterations == read->world.iterations && scene->world.restitution == read->world.restitution);
	assert_true(scene->world.friction == read->world.friction && scene->world.rolling_friction == read->world.rolling_friction);
	assert_true(scene->has_camera == read->has_camera && scene->camera.height == read->camera.height);
	carom_world *third = there_and_back(back, read->has_camera ? &read->camera : NULL, &again);
	assert_string_equal(text, read_text(in_folder("there.json")));
	free(text);
	carom_world_destroy(world);
	carom_world_destroy(back);
	carom_world_destroy(third);
	carom_scene_destroy(read);
	carom_scene_destroy(again);
}

static void everything_reads_back_with_the_same_bits(void **state)
{
	(void)state;
	carom_scene *scene = parse(everything, sizeof everything - 1);
	check_round_trip(scene);
	carom_scene_destroy(scene);
	unlink(in_folder("there.json"));
}

static void check_bodies_read_back(const carom_body_def *bodies, size_t count)
{
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL, *back;
	carom_scene *scene = NULL;
	carom_error error = {0};
	def.device = "cpu";
	if (carom_world_create(&def, &world, &error) != CAROM_OK || carom_world_add(world, bodies, count, NULL, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	back = there_and_back(world, NULL, &scene);
	assert_same_world(world, back);
	carom_world_destroy(world);
	carom_world_destroy(back);
	carom_scene_destroy(scene);
	unlink(in_folder("there.json"));
}

static carom_body_def polygon(const carom_vec2 *vertices, uint32_t count)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_POLYGON;
	def.vertices = vertices;
	def.vertex_count = count;
	return def;
}

/* Rounding moves the centre of mass of what is thin: that is no reason to move its vertices again. Planks that lie along no axis, and slivers. */
static void thin_polygons_read_back_with_the_same_bits(void **state)
{
	enum { COUNT = 200 };
	carom_body_def bodies[COUNT];
	carom_vec2 vertices[COUNT][4];
	(void)state;
	for (int k = 0; k < COUNT; k++) {
		const float x = cosf(0.37f * (float)k), y = sinf(0.37f * (float)k), thin = k % 2 ? 1e-3f : 4e-6f;
		const carom_vec2 plank[4] = {{0, 0}, {x, y}, {x - thin * y, y + thin * x}, {0.2f * x - thin * y, 0.2f * y + thin * x}};
		memcpy(vertices[k], plank, sizeof plank);
		bodies[k] = polygon(vertices[k], 4);
	}
	check_bodies_read_back(bodies, COUNT);
}

/* Nor what has many long sides about a small area. */
static void hollow_polygons_read_back_with_the_same_bits(void **state)
{
	enum { COUNT = 500 };
	static carom_vec2 vertices[COUNT][CAROM_MAX_VERTICES];
	carom_body_def bodies[COUNT];
	scenery_random random = {21};
	(void)state;
	for (int k = 0; k < COUNT; k++) {
		const uint32_t count = hollows_make(&random, (hollow_kind)(k % HOLLOW_KINDS), 1.0f, vertices[k]);
		for (uint32_t i = 0; i < count; i++)
			vertices[k][i].y *= k % 2 ? 1.0f : 0.01f;
		bodies[k] = polygon(vertices[k], count);
	}
	check_bodies_read_back(bodies, COUNT);
}

static void every_scene_reads_back_with_the_same_bits(void **state)
{
	(void)state;
	DIR *scenes = opendir("scenes");
	struct dirent *entry;
	assert_non_null(scenes);
	while ((entry = readdir(scenes))) {
		char path[512];
		carom_scene *scene = NULL;
		carom_error error = {0};
		if (!strstr(entry->d_name, ".json"))
			continue;
		snprintf(path, sizeof path, "scenes/%s", entry->d_name);
		if (carom_scene_read(path, &scene, &error) != CAROM_OK)
			fail_msg("%s", error.text);
		check_round_trip(scene);
		carom_scene_destroy(scene);
	}
	closedir(scenes);
	unlink(in_folder("there.json"));
}

/* Any bits a float can have, but for infinities and NaN, in the states. */
static void awkward_floats_read_back_with_the_same_bits(void **state)
{
	(void)state;
	static const float awkward[] = {0.1f, -0.0f, 1e-45f, 1.17549435e-38f, 3.40282347e38f, -16777216, 0.333333343f, 9.99999975e-5f, 123456792,
		1.00000012f, 0.99999994f, 2.71828175f};
	carom_world_def def = carom_default_world_def();
	carom_body_def body = carom_default_body_def();
	carom_world *world = NULL;
	carom_scene *read = NULL;
	carom_body_state states[COUNT(awkward)];
	def.device = "cpu";
	body.radius = 0.1f;
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_OK);
	for (size_t k = 0; k < COUNT(awkward); k++) {
		body.position.x = (float)k;
		states[k] = (carom_body_state){{awkward[k], -awkward[k]}, 0.1f, {awkward[k], awkward[k]}, awkward[k]};
		assert_int_equal(carom_world_add(world, &body, 1, NULL, NULL), CAROM_OK);
	}
	assert_int_equal(carom_world_set_states(world, 0, COUNT(awkward), states, NULL), CAROM_OK);
	carom_world *back = there_and_back(world, NULL, &read);
	assert_same_world(world, back);
	carom_world_destroy(world);
	carom_world_destroy(back);
	carom_scene_destroy(read);
	unlink(in_folder("there.json"));
}

/* Whatever can be chosen is written; a new slot that the writer does not know shows here. */
static void every_choice_of_a_slot_reads_back(void **state)
{
	(void)state;
	carom_stage_info info;
	for (size_t k = 0; carom_stage_list(k, &info); k++) {
		carom_world_def def = carom_default_world_def();
		carom_world *world = NULL;
		carom_scene *read = NULL;
		carom_error error = {0};
		def.device = "cpu";
		if (!info.on_cpu || carom_pipeline_set(&def.pipeline, info.slot, info.alternative, NULL) != CAROM_OK)
			continue; /* some slots are none to choose for */
		if (carom_world_create(&def, &world, &error) != CAROM_OK)
			fail_msg("%s", error.text);
		carom_world *back = there_and_back(world, NULL, &read);
		char key[96];
		snprintf(key, sizeof key, "\"%s\": \"%s\"", info.slot, info.alternative);
		assert_non_null(strstr(read_text(in_folder("there.json")), key));
		assert_string_equal(carom_pipeline_get(&read->world.pipeline, info.slot), info.alternative);
		carom_world_destroy(world);
		carom_world_destroy(back);
		carom_scene_destroy(read);
	}
	unlink(in_folder("there.json"));
}

/* A world whose file was written and read back goes on as if nothing had happened; so does one of contacts, which are in the file. */
static void stop_and_resume_is_exact(void **state)
{
	static const char *const scenes[] = {"scenes/mixed.json", "scenes/pyramid.json"};
	(void)state;
	for (size_t k = 0; k < COUNT(scenes); k++) {
		carom_scene *scene = NULL, *read = NULL;
		carom_error error = {0};
		if (carom_scene_read(scenes[k], &scene, &error) != CAROM_OK)
			fail_msg("%s", error.text);
		carom_world *world = world_of(scene);
		assert_int_equal(carom_world_step(world, 100, NULL, NULL), CAROM_OK);
		carom_world *back = there_and_back(world, NULL, &read);
		assert_true((strstr(scenes[k], "pyramid") != NULL) == (read->contact_count > 0));
		assert_int_equal(carom_world_step(world, 100, NULL, NULL), CAROM_OK);
		assert_int_equal(carom_world_step(back, 100, NULL, NULL), CAROM_OK);
		assert_same_world(world, back);
		carom_world_destroy(world);
		carom_world_destroy(back);
		carom_scene_destroy(scene);
		carom_scene_destroy(read);
		unlink(in_folder("there.json"));
	}
}

/* A name of every two bytes there are, between which an x stands: what is no UTF-8 is written as something that is. */
static void names_of_any_bytes_read_back(void **state)
{
	(void)state;
	static char name[255 * 255 * 3 + 1];
	char *end = name;
	for (unsigned first = 1; first < 256; first++) {
		for (unsigned second = 1; second < 256; second++) {
			*end++ = (char)first;
			*end++ = (char)second;
			*end++ = 'x';
		}
	}
	carom_world_def def = carom_default_world_def();
	carom_body_def body = carom_default_body_def();
	carom_world *world = NULL;
	carom_scene *read = NULL, *again = NULL;
	def.device = "cpu";
	body.radius = 1;
	body.name = name;
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_OK);
	assert_int_equal(carom_world_add(world, &body, 1, NULL, NULL), CAROM_OK);
	carom_world *back = there_and_back(world, NULL, &read);
	assert_non_null(strstr(read->bodies[0].name, "x\n\x1Fx"));
	assert_non_null(strstr(read->bodies[0].name, "x\xC3\xA9x"));
	assert_non_null(strstr(read->bodies[0].name, "x\xEF\xBF\xBD\xEF\xBF\xBDx")); /* twice the replacement character */
	carom_world *third = there_and_back(back, NULL, &again);
	assert_string_equal(read->bodies[0].name, again->bodies[0].name);
	carom_world_destroy(world);
	carom_world_destroy(back);
	carom_world_destroy(third);
	carom_scene_destroy(read);
	carom_scene_destroy(again);
}

/* A camera that could not be read again is refused, and the file stays as it was. */
static void a_wrong_camera_is_not_written(void **state)
{
	(void)state;
	static const carom_camera cameras[] = {{{0, 0}, NAN}, {{0, 0}, INFINITY}, {{0, 0}, 0}, {{0, 0}, -1}, {{NAN, 0}, 1}, {{0, -INFINITY}, 1}};
	const carom_camera right = {{1, 2}, 3};
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	def.device = "cpu";
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_OK);
	assert_int_equal(carom_world_write_scene(world, &right, in_folder("there.json"), NULL), CAROM_OK);
	char *before = strdup(read_text(in_folder("there.json")));
	assert_non_null(before);
	for (size_t k = 0; k < COUNT(cameras); k++) {
		carom_error error = {0};
		assert_int_equal(carom_world_write_scene(world, &cameras[k], in_folder("there.json"), &error), CAROM_INVALID_ARGUMENT);
		assert_true(error.status == CAROM_INVALID_ARGUMENT && strstr(error.text, "camera: found center ("));
		char *text = NULL;
		assert_int_equal(carom_scene_text_create(world, &cameras[k], &text, NULL, NULL), CAROM_INVALID_ARGUMENT);
		assert_null(text);
		assert_string_equal(read_text(in_folder("there.json")), before);
	}
	free(before);
	carom_world_destroy(world);
	unlink(in_folder("there.json"));
}

static int make_folder(void **state)
{
	(void)state;
	return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
	(void)state;
	unlink(in_folder("there.json"));
	return rmdir(folder); /* fails if a temporary file was left in it */
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(everything_reads_back_with_the_same_bits),
		cmocka_unit_test(thin_polygons_read_back_with_the_same_bits), cmocka_unit_test(hollow_polygons_read_back_with_the_same_bits),
		cmocka_unit_test(every_scene_reads_back_with_the_same_bits), cmocka_unit_test(awkward_floats_read_back_with_the_same_bits),
		cmocka_unit_test(every_choice_of_a_slot_reads_back), cmocka_unit_test(stop_and_resume_is_exact),
		cmocka_unit_test(names_of_any_bytes_read_back), cmocka_unit_test(a_wrong_camera_is_not_written)};
	return cmocka_run_group_tests_name("scene_write", tests, make_folder, remove_folder);
}
