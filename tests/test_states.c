/* `carom run --states`: where all bodies are at the times of frames, as a table and as an array of NumPy.
 * SPDX-License-Identifier: MIT */
#include "command.h"

#include <math.h>

#define BODIES 111 /* of scenes/mixed.json */
#define FRAMES 5   /* a second of four frames, and the first */
#define HEADER 128 /* bytes before the array */

/* What the library does with the same scene. */
static carom_world *make_world(const char *device)
{
	carom_scene *scene = NULL;
	carom_world *world = NULL;
	carom_error error = {0};
	if (carom_scene_read("scenes/mixed.json", &scene, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	scene->world.device = device;
	if (carom_scene_create_world(scene, &world, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	carom_scene_destroy(scene);
	assert_int_equal(carom_world_body_count(world), BODIES);
	return world;
}

static void read_world(carom_world *world, double until, carom_body_state *states)
{
	carom_error error = {0};
	if (until > 0 && carom_world_advance_to(world, until, UINT64_MAX, NULL, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	if (carom_world_get_states(world, 0, BODIES, states, &error) != CAROM_OK)
		fail_msg("%s", error.text);
}

/* Six numbers of a row, behind its time and its body, which have to be these. */
static const char *read_row(const char *row, double time, unsigned long body, carom_body_state *state)
{
	float numbers[6];
	char *end;
	assert_true(fabs(strtod(row, &end) - time) < 1e-9 && *end == ',');
	assert_int_equal(strtoul(end + 1, &end, 10), body);
	for (int k = 0; k < 6; k++) {
		assert_int_equal(*end, ',');
		numbers[k] = strtof(end + 1, &end);
	}
	assert_int_equal(*end, '\n');
	memcpy(state, numbers, sizeof *state);
	return end + 1;
}

static void read_file(const char *name, void *to, size_t size)
{
	char path[128];
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	assert_int_equal(fread(to, 1, size, file), size);
	assert_int_equal(fgetc(file), EOF);
	fclose(file);
}

/* Both files hold the library's numbers, bit for bit. */
static void check_device(const char *name)
{
	static struct {
		char header[HEADER];
		carom_body_state states[FRAMES][BODIES];
	} array;
	static const char columns[] = "time_s,body,x_m,y_m,angle_rad,velocity_x_m_s,velocity_y_m_s,angular_velocity_rad_s\n";
	char line[256];
	carom_body_state expected[BODIES], found;
	snprintf(line, sizeof line, "for f in csv npy; do $C run scenes/mixed.json --time 1 --fps 4 --states $D/s.$f --device %s || exit 9; done", name);
	check(line, 0, "/s.npy\n");
	read_file("s.npy", &array, sizeof array);
	check("cat $D/s.csv", 0, NULL);
	assert_memory_equal(call.out, columns, strlen(columns));
	const char *row = call.out + strlen(columns);
	const uint16_t one = 1;
	snprintf(line, sizeof line, "%cf4', 'fortran_order': False, 'shape': (%d, %d, 6), }", *(const unsigned char *)&one ? '<' : '>', FRAMES, BODIES);
	assert_memory_equal(array.header, "\x93NUMPY\x01\x00\x76\x00{'descr': '", 21);
	assert_memory_equal(array.header + 21, line, strlen(line));
	assert_int_equal(strspn(array.header + 21 + strlen(line), " "), HEADER - 21 - strlen(line) - 1);
	assert_int_equal(array.header[HEADER - 1], '\n');
	carom_world *world = make_world(name);
	for (int frame = 0; frame < FRAMES; frame++) {
		read_world(world, frame / 4.0, expected);
		assert_memory_equal(array.states[frame], expected, sizeof expected);
		for (unsigned long k = 0; k < BODIES; k++) {
			row = read_row(row, frame / 4.0, k, &found);
			assert_memory_equal(&found, &expected[k], sizeof found);
		}
	}
	assert_int_equal(*row, '\0');
	assert_true(memcmp(array.states[0], array.states[FRAMES - 1], sizeof expected) != 0);
	carom_world_destroy(world);
	check("rm $D/s.csv $D/s.npy", 0, NULL);
}

static void they_are_those_of_the_library(void **state)
{
	(void)state;
	check_device("cpu");
	if (has_opencl())
		check_device("opencl");
}

/* As frames, with which they go: after whole steps, or as far as a run came. */
static void they_go_with_frames(void **state)
{
	(void)state;
	check("$C run scenes/mixed.json --steps 31 --fps 10 --states - --frames $D/f --size 64x36 --quiet --device cpu >$D/s; ls $D/f | wc -l; cut -d, "
		  "-f1 $D/s | "
		  "uniq",
		0, "");
	assert_string_equal(call.out, "6\ntime_s\n0\n0.100000005215\n0.200000010431\n0.300000015646\n0.400000020862\n0.500000026077\n");
	check("$C run scenes/mixed.json --steps 31 --fps 10 --hash --states $D/s --quiet --device cpu; $C run scenes/mixed.json --steps 31 --hash "
		  "--quiet --device cpu",
		0, "");
	assert_memory_equal(call.out, call.out + 17, 17); /* they change no bit */
	check("echo '{\"format\": \"carom-scene/1\", \"bodies\": []}' | $C run - --states $D/s --quiet; wc -l <$D/s", 0, "");
	assert_string_equal(call.out, "1\n");
	check("rm -r $D/f $D/s", 0, "");
}

static void what_cannot_be_is_said(void **state)
{
	(void)state;
	check("$C run scenes/mixed.json --states /dev/stdout --hits -", 2, "--hits and --states: both tables go to /dev/stdout");
	check("$C run scenes/mixed.json --states $D/a --stats $D/./a", 2, "two of --out, --png, --stats, --hits, --states and --frames write there");
	check("cp scenes/mixed.json $D/a; $C run $D/a --states $D/a; code=$?; rm $D/a; exit $code", 2, "--states would replace the scene");
	check("$C run scenes/mixed.json --states $D/no/a.csv", 1, "/no/a.csv: can't be written");
	check("$C run scenes/mixed.json --states /dev/full --device cpu", 1, "/dev/full: can't be written");
	check("mkfifo $D/p.npy; cat $D/p.npy >$D/a & $C run scenes/mixed.json --states $D/p.npy; code=$?; wait; rm $D/p.npy $D/a; exit $code", 2,
		"/p.npy: an array can't go through a pipe, for its head is written in the end; a name without .npy is a table");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(they_are_those_of_the_library),
		cmocka_unit_test(they_go_with_frames),
		cmocka_unit_test(what_cannot_be_is_said),
	};
	return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
