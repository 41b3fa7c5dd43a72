/* Scene files: what is wrong is found and named, what is right arrives.
 * SPDX-License-Identifier: MIT */
#include "scenes.h"

#include <dirent.h>
#include <sys/socket.h>
#include <unistd.h>

#define HEAD "{ \"format\": \"carom-scene/1\", \"bodies\": "

/* ---- What is wrong ---- */

/* Reads the scene and, if it reads, makes a world of it. */
static carom_status make_world(const char *path, carom_error *error)
{
	carom_scene *scene = NULL;
	carom_world *world = NULL;
	carom_status status = carom_scene_read(path, &scene, error);
	if (status == CAROM_OK) {
		scene->world.device = "cpu";
		status = carom_scene_create_world(scene, &world, error);
	} else {
		assert_null(scene);
	}
	carom_world_destroy(world);
	carom_scene_destroy(scene);
	return status;
}

static void read_line(const char *path, char *line, int size)
{
	FILE *file = fopen(path, "r");
	if (!file || !fgets(line, size, file))
		fail_msg("%s: no line to be read", path);
	line[strcspn(line, "\n")] = '\0';
	fclose(file);
}

/* tests/bad/NAME.json has to fail with what tests/bad/NAME.txt says. */
static void check_bad(const char *name)
{
	char path[512], fragment[512];
	carom_error error = {0};
	size_t stem = strlen(name) - strlen(".json");
	snprintf(path, sizeof path, "tests/bad/%.*s.txt", (int)stem, name);
	read_line(path, fragment, sizeof fragment);
	snprintf(path, sizeof path, "tests/bad/%s", name);
	carom_status status = make_world(path, &error);
	if (status != CAROM_INVALID_SCENE || error.status != status)
		fail_msg("%s: expected CAROM_INVALID_SCENE, got %s %s", path, carom_status_name(status), error.text);
	if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, fragment))
		fail_msg("%s: expected \"%s\", got \"%s\"", path, fragment, error.text);
	if (strpbrk(error.text, "\n\r\t") || error.text[strlen(error.text) - 1] == '.')
		fail_msg("%s: not one line without a full stop: \"%s\"", path, error.text);
}

static void bad_files_are_named(void **state)
{
	(void)state;
	DIR *folder = opendir("tests/bad");
	struct dirent *entry;
	int count = 0;
	assert_non_null(folder);
	while ((entry = readdir(folder))) {
		const char *end = strrchr(entry->d_name, '.');
		if (!end || strcmp(end, ".json") != 0)
			continue;
		check_bad(entry->d_name);
		count++;
	}
	closedir(folder);
	assert_true(count > 100);
}

static void check_text(const char *text, size_t length, carom_status wanted, const char *fragment)
{
	carom_error error = {0};
	carom_scene *scene = NULL;
	carom_status status = carom_scene_parse(text, length, "memory", &scene, &error);
	if (status != wanted || (fragment && !strstr(error.text, fragment)))
		fail_msg("expected %s \"%s\", got %s \"%s\"", carom_status_name(wanted), fragment ? fragment : "", carom_status_name(status), error.text);
	assert_int_equal(scene != NULL, status == CAROM_OK);
	carom_scene_destroy(scene);
}

/* `head`, then ten million times `filler`, then `tail`. */
static void check_long(const char *head, char filler, const char *tail, carom_status wanted, const char *fragment)
{
	size_t before = strlen(head), many = 10000000, after = strlen(tail);
	char *text = malloc(before + many + after);
	assert_non_null(text);
	memcpy(text, head, before);
	memset(text + before, filler, many);
	memcpy(text + before + many, tail, after);
	check_text(text, before + many + after, wanted, fragment);
	free(text);
}

static void long_nonsense_fails_quickly(void **state)
{
	(void)state;
	check_long("", '[', "", CAROM_INVALID_SCENE, "memory:1:2049: not valid JSON: maximum parsing depth reached");
	check_long(HEAD, '[', "", CAROM_INVALID_SCENE, "maximum parsing depth reached");
	check_long(HEAD, '{', "", CAROM_INVALID_SCENE, "not valid JSON");
	check_long(HEAD, ']', "", CAROM_INVALID_SCENE, "not valid JSON");
	check_long(HEAD "[", ',', "] }", CAROM_INVALID_SCENE, "a body expected");
	check_long(HEAD "[\"", '\\', "", CAROM_INVALID_SCENE, "not valid JSON");
	check_long(HEAD "[{\"", 'x', "\": 1}] }", CAROM_INVALID_SCENE, "unknown key");
	check_long(HEAD "[{\"circle\": {\"radius\": ", '1', "}}] }", CAROM_INVALID_SCENE, "real number overflow");
	check_long(HEAD "[{\"circle\": {\"radius\": 0.", '1', "}}] }", CAROM_OK, NULL);
	check_long(HEAD "[{\"circle\": {\"radius\": 0.5}, \"name\": \"", 'x', "\"}] }", CAROM_OK, NULL);
	check_long(HEAD, ' ', "[] }", CAROM_OK, NULL);
	check_long("", '\0', "", CAROM_INVALID_SCENE, "not valid JSON");
}

static void unreadable_files_are_named(void **state)
{
	(void)state;
	carom_error error = {0};
	carom_scene *scene = NULL;
	assert_int_equal(carom_scene_read("tests/no such file.json", &scene, &error), CAROM_IO);
	assert_non_null(strstr(error.text, "tests/no such file.json: can't be read: No such file"));
	assert_int_equal(carom_scene_read("tests", &scene, &error), CAROM_IO);
	assert_non_null(strstr(error.text, "tests: can't be read: Is a directory"));
	assert_int_equal(carom_scene_read("", &scene, &error), CAROM_IO);
	assert_int_equal(carom_scene_read(NULL, &scene, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_scene_parse(NULL, 1, "x", &scene, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_scene_parse("", 0, NULL, &scene, NULL), CAROM_INVALID_SCENE);
	assert_int_equal(carom_scene_parse(NULL, 0, NULL, &scene, NULL), CAROM_INVALID_SCENE);
	assert_null(scene);
	carom_scene_destroy(NULL);
}

/* ---- What is right ---- */

static void values_arrive(void **state)
{
	(void)state;
	carom_scene *scene = parse(everything, sizeof everything - 1);
	const carom_body_def *bodies = scene->bodies;
	assert_int_equal(scene->body_count, 4);
	assert_true(scene->world.time_step == 0.01f && scene->world.gravity.y == -9.81f && signbit(scene->world.gravity.x));
	assert_true(scene->world.has_room && scene->world.room_max.y == 4.1f && scene->world.restitution == 0.9f);
	assert_string_equal(scene->world.pipeline.toi, "bisection");
	assert_null(scene->world.pipeline.aabb);
	assert_true(scene->world.epsilon == 0x1p-10f && scene->world.iterations == 3);
	assert_true(scene->has_camera && scene->camera.height == 7 && scene->camera.center.y == -0.1f);
	assert_true(bodies[0].shape == CAROM_CIRCLE && bodies[0].radius == 0.1f && bodies[0].position.y == 1e-7f);
	assert_true(bodies[0].velocity.x == 0.1f && bodies[0].angle == -0.3f && bodies[0].angular_velocity == 1e-3f);
	assert_true(bodies[0].density == 7.8f && bodies[0].restitution == 0.25f && bodies[0].mass == 0);
	assert_true(bodies[0].force.x == 0.1f && bodies[0].torque == -0.7f && bodies[0].color == 0xCC33FF && !bodies[0].is_static);
	assert_string_equal(bodies[0].name, "a \"quoted\" \\ \x01 \n \xC3\xA9 \xF0\x9F\x8E\xB1 ]}");
	assert_true(bodies[1].shape == CAROM_REGULAR && bodies[1].sides == 5 && bodies[1].mass == 0.17f && bodies[1].color == 0x012345);
	assert_true(bodies[2].shape == CAROM_POLYGON && bodies[2].vertex_count == 4 && bodies[2].vertices[3].x == 6.7f);
	assert_true(signbit(bodies[2].position.x) && isnan(bodies[2].restitution) && bodies[2].color == CAROM_COLOR_AUTO);
	assert_true(bodies[3].is_static && !bodies[3].name);
	carom_scene_destroy(scene);
}

static void keys_may_be_escaped_and_bodies_none(void **state)
{
	(void)state;
	static const char escaped[] = "{ \"format\": \"carom-scene/1\", \"b\\u006fdies\": [ {\"circle\": {\"radius\": 1}} ] }";
	static const char none[] = HEAD "[ \n ] }";
	static const char decoy[] = "{ \"format\": \"carom-scene/1\", \"camera\": {\"center\": [0, 0], \"height\": 1}, \"bodies\":[\n"
								"{\"name\": \"\\\"bodies\\\": [\", \"circle\": {\"radius\": 2}} ] }";
	carom_scene *scene = parse(escaped, sizeof escaped - 1);
	assert_int_equal(scene->body_count, 1);
	carom_scene_destroy(scene);
	scene = parse(none, sizeof none - 1);
	assert_int_equal(scene->body_count, 0);
	carom_scene_destroy(scene);
	scene = parse(decoy, sizeof decoy - 1);
	assert_int_equal(scene->body_count, 1);
	assert_string_equal(scene->bodies[0].name, "\"bodies\": [");
	carom_scene_destroy(scene);
}

/* A text that is cut off anywhere is refused, and one with a wrong byte anywhere does no harm. */
static void damaged_texts_do_no_harm(void **state)
{
	(void)state;
	static const char wrong[] = "{}[],:\"\\0-xe \n\xFF";
	char text[sizeof everything];
	for (size_t length = 0; length < sizeof everything - 1; length++) {
		char *cut = malloc(length + 1); /* just as long, for the sanitizers to see a look beyond */
		assert_non_null(cut);
		memcpy(cut, everything, length);
		check_text(cut, length, CAROM_INVALID_SCENE, "memory");
		free(cut);
	}
	for (size_t k = 0; k < sizeof everything - 1; k++) {
		for (size_t w = 0; w < sizeof wrong; w++) {
			carom_scene *scene = NULL;
			memcpy(text, everything, sizeof text);
			text[k] = wrong[w];
			carom_status status = carom_scene_parse(text, sizeof text - 1, "memory", &scene, NULL);
			assert_true(status == CAROM_OK || status == CAROM_INVALID_SCENE);
			carom_scene_destroy(scene);
		}
	}
}

/* A socket can't be opened by its name in /dev/fd. */
static void a_socket_may_be_read(void **state)
{
	static const char text[] = HEAD "[{\"circle\": {\"radius\": 2}}] }";
	int sockets[2];
	char path[64];
	carom_scene *scene = NULL;
	carom_error error = {0};
	(void)state;
	assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, sockets), 0);
	assert_int_equal(write(sockets[0], text, strlen(text)), strlen(text));
	close(sockets[0]);
	snprintf(path, sizeof path, "/dev/fd/%d", sockets[1]);
	if (carom_scene_read(path, &scene, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	assert_int_equal(scene->body_count, 1);
	carom_scene_destroy(scene);
	close(sockets[1]);
	assert_int_equal(carom_scene_read(path, &scene, &error), CAROM_IO);
	assert_non_null(strstr(error.text, ": can't be read: Bad file descriptor"));
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(bad_files_are_named), cmocka_unit_test(long_nonsense_fails_quickly),
		cmocka_unit_test(unreadable_files_are_named), cmocka_unit_test(values_arrive), cmocka_unit_test(keys_may_be_escaped_and_bodies_none),
		cmocka_unit_test(damaged_texts_do_no_harm), cmocka_unit_test(a_socket_may_be_read)};
	return cmocka_run_group_tests_name("scene", tests, NULL, NULL);
}
