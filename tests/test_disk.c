/* Disks that are full and folders that can't be written to: files are whole or as they were, and nothing temporary stays.
 * SPDX-License-Identifier: MIT */
#include "command.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
enum { SIDE = 256, LARGEST = 16384 }; /* bytes of a file, less than a noisy picture takes */

static const char *path_of(const char *name)
{
	static char path[192];
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	return path;
}

static void put_old(const char *name)
{
	FILE *file = fopen(path_of(name), "w");
	assert_non_null(file);
	fputs("old", file);
	fclose(file);
}

static bool is_old(const char *name)
{
	char text[8] = "";
	FILE *file = fopen(path_of(name), "r");
	const bool old = file && fread(text, 1, sizeof text, file) == 3 && strcmp(text, "old") == 0;
	if (file)
		fclose(file);
	return old;
}

static const uint8_t *noise(void)
{
	static uint8_t pixels[4 * SIDE * SIDE];
	uint32_t number = 1;
	for (size_t k = 0; k < sizeof pixels; k++)
		pixels[k] = (uint8_t)((number = number * 1664525u + 1013904223u) >> 24);
	return pixels;
}

/* Of more bodies than a small file holds. */
static carom_world *large_world(void)
{
	carom_world_def def = carom_default_world_def();
	carom_body_def body = carom_default_body_def();
	carom_world *world = NULL;
	def.device = "cpu";
	body.radius = 0.5f;
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_OK);
	for (body.position.x = 0; body.position.x < 500; body.position.x++)
		assert_int_equal(carom_world_add(world, &body, 1, NULL, NULL), CAROM_OK);
	return world;
}

/* Each of the library's ways to write a file, by number; CAROM_OK past the last. */
static carom_status write_one(int way, carom_world *world, const char *path, carom_error *error)
{
	carom_file *file = NULL;
	FILE *stream = NULL;
	switch (way) {
	case 0: return carom_world_write_scene(world, NULL, path, error);
	case 1: return carom_png_write(path, noise(), SIDE, SIDE, error);
	case 2:
		if (carom_file_create(path, &file, &stream, error) != CAROM_OK)
			return error->status;
		for (int k = 0; k < LARGEST; k++)
			fputs("more", stream);
		return carom_file_commit(file, error);
	default: return CAROM_OK;
	}
}

static void limit_files(rlim_t bytes)
{
	const struct rlimit limit = {bytes, RLIM_INFINITY};
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

/* With a limit of the files' size, which stands for a disk that fills up while it is written to. */
static void a_disk_that_fills_up(void **state)
{
	(void)state;
	carom_world *world = large_world();
	signal(SIGXFSZ, SIG_IGN);
	for (int way = 0; way < 3; way++) {
		carom_error error = {.status = CAROM_OK};
		put_old("file");
		limit_files(LARGEST);
		const carom_status status = write_one(way, world, path_of("file"), &error);
		limit_files(RLIM_INFINITY);
		if (status != CAROM_IO || !strstr(error.text, "/file: can't be written: ") || !strstr(error.text, "File too large"))
			fail_msg("%d: %s: %s", way, carom_status_name(status), error.text);
		assert_true(is_old("file"));
		assert_int_equal(write_one(way, world, path_of("file"), &error), CAROM_OK);
		assert_false(is_old("file"));
	}
	carom_world_destroy(world);
	check("rm $D/file; ls $D", 0, "");
	assert_string_equal(call.out, "err\nout\n");
}

/* In a process that is not root, whom no permission stops: how many things went wrong. */
static int write_forbidden(carom_world *world)
{
	int wrong = 0;
	if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0))
		return 99;
	for (int way = 0; way < 3; way++) {
		static const char *const names[] = {"locked/new", "locked/old", "forbidden", "old/below"};
		static const char *const reasons[] = {"Permission denied", "Permission denied", "Permission denied", "Not a directory"};
		for (size_t k = 0; k < COUNT(names); k++) {
			carom_error error = {.status = CAROM_OK};
			wrong += write_one(way, world, path_of(names[k]), &error) != CAROM_IO || !strstr(error.text, reasons[k]);
		}
	}
	return wrong;
}

static void folders_that_cannot_be_written_to(void **state)
{
	(void)state;
	carom_world *world = large_world();
	int status = 0;
	put_old("forbidden");
	put_old("old");
	check("mkdir $D/locked; chmod 755 $D", 0, "");
	put_old("locked/old");
	check("chmod 444 $D/forbidden; chmod 666 $D/old $D/locked/old; chmod 555 $D/locked", 0, "");
	const pid_t child = fork();
	if (child == 0)
		_exit(write_forbidden(world));
	assert_int_equal(waitpid(child, &status, 0), child);
	carom_world_destroy(world);
	assert_true(is_old("forbidden") && is_old("old") && is_old("locked/old"));
	check("ls $D $D/locked | grep -c '[.]tmp[.]'; chmod 755 $D/locked; rm -r $D/locked $D/forbidden $D/old", 0, "");
	assert_string_equal(call.out, "0\n");
	if (WIFEXITED(status) && WEXITSTATUS(status) == 99) {
		print_message("SKIPPED: root can't become another user here\n");
		skip();
	}
	assert_true(WIFEXITED(status));
	assert_int_equal(WEXITSTATUS(status), 0);
}

/* A folder comes to stand where the file is to go. */
static void names_that_cannot_be_taken(void **state)
{
	(void)state;
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = {.status = CAROM_OK};
	assert_int_equal(carom_file_create(path_of("taken"), &file, &stream, &error), CAROM_OK);
	assert_int_equal(mkdir(path_of("taken"), 0700), 0);
	fputs("new", stream);
	assert_int_equal(carom_file_commit(file, &error), CAROM_IO);
	assert_non_null(strstr(error.text, "/taken: can't be replaced: Is a directory"));
	check("rmdir $D/taken; ls $D", 0, "");
	assert_string_equal(call.out, "err\nout\n");
}

/* The limit is in blocks of 512 bytes; the frames that were whole before it stay. */
static void the_command_on_a_full_disk(void **state)
{
	(void)state;
	const char *const files[] = {"s.json", "t.csv", "p.png", "a.npy"};
	for (size_t k = 0; k < COUNT(files); k++)
		put_old(files[k]);
	check("ulimit -f 8; $C run scenes/circles_1024.json --steps 3 --device cpu --out $D/s.json", 1, "s.json: can't be written: File too large");
	check("ulimit -f 1; $C run scenes/mixed.json --steps 30 --device cpu --stats $D/t.csv", 1, "t.csv: can't be written: File too large");
	check("ulimit -f 1; $C run scenes/mixed.json --steps 30 --device cpu --states $D/t.csv", 1, "t.csv: can't be written: File too large");
	check("ulimit -f 1; $C run scenes/mixed.json --steps 3 --device cpu --states $D/a.npy", 1, "a.npy: can't be written: File too large");
	check("ulimit -f 1; $C run scenes/mixed.json --steps 300 --device cpu --states $D/a.npy 2>&1 | grep -c written", 0, "");
	assert_string_equal(call.out, "1\n");
	check("ulimit -f 1; $C run scenes/mixed.json --steps 3 --device cpu --png $D/p.png", 1, "p.png: can't be written: ");
	check("ulimit -f 1; $C generate --shape circle --count 100 --out $D/s.json", 1, "s.json: can't be written: File too large");
	check("ulimit -f 1; $C run scenes/mixed.json --steps 3 --device cpu --frames $D/film", 1, "frame_000000.png: can't be written: ");
	for (size_t k = 0; k < COUNT(files); k++)
		assert_true(is_old(files[k]));
	check("rm $D/s.json $D/t.csv $D/p.png $D/a.npy; rmdir $D/film; ls $D", 0, "");
	assert_string_equal(call.out, "err\nout\n");
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_disk_that_fills_up), cmocka_unit_test(folders_that_cannot_be_written_to),
		cmocka_unit_test(names_that_cannot_be_taken), cmocka_unit_test(the_command_on_a_full_disk)};
	return cmocka_run_group_tests_name("disk", tests, make_folder, remove_folder);
}
