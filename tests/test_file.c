/* Files that are whole or not there, and PNG files.
 * SPDX-License-Identifier: MIT */
#include "carom.h"

#include <dirent.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <png.h>

#include <cmocka.h>

static char folder[] = "/tmp/carom-test-XXXXXX";

static const char *in_folder(const char *name)
{
	static char path[512];
	snprintf(path, sizeof path, "%s/%s", folder, name);
	return path;
}

static void put_file(const char *name, const char *text)
{
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = {0};
	if (carom_file_create(in_folder(name), &file, &stream, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	fputs(text, stream);
	if (carom_file_commit(file, &error) != CAROM_OK)
		fail_msg("%s", error.text);
}

static void assert_text(const char *name, const char *wanted)
{
	char text[64] = "";
	FILE *file = fopen(in_folder(name), "r");
	assert_non_null(file);
	assert_true(fread(text, 1, sizeof text - 1, file) == strlen(wanted));
	fclose(file);
	assert_string_equal(text, wanted);
}

static int count_files(void)
{
	DIR *opened = opendir(folder);
	int count = 0;
	assert_non_null(opened);
	while (readdir(opened))
		count++;
	closedir(opened);
	return count - 2; /* . and .. */
}

static void a_file_appears_when_it_is_whole(void **state)
{
	(void)state;
	carom_file *file = NULL;
	FILE *stream = NULL;
	assert_int_equal(carom_file_create(in_folder("whole"), &file, &stream, NULL), CAROM_OK);
	fputs("all of it", stream);
	fflush(stream);
	assert_int_not_equal(access(in_folder("whole"), F_OK), 0);
	assert_int_equal(carom_file_commit(file, NULL), CAROM_OK);
	assert_text("whole", "all of it");
	assert_int_equal(count_files(), 1);
	unlink(in_folder("whole"));
}

static void a_file_given_up_leaves_the_old_one(void **state)
{
	(void)state;
	carom_file *file = NULL, *other = NULL;
	FILE *stream = NULL, *other_stream = NULL;
	put_file("old", "old");
	assert_int_equal(carom_file_create(in_folder("old"), &file, &stream, NULL), CAROM_OK);
	assert_int_equal(carom_file_create(in_folder("old"), &other, &other_stream, NULL), CAROM_OK); /* two at once */
	fputs("new", stream);
	fputs("other", other_stream);
	carom_file_destroy(file);
	assert_text("old", "old");
	assert_int_equal(carom_file_commit(other, NULL), CAROM_OK);
	assert_text("old", "other");
	carom_file_destroy(NULL);
	assert_int_equal(count_files(), 1);
	unlink(in_folder("old"));
}

static void assert_refused(const char *path, const char *reason)
{
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = {0};
	assert_int_equal(carom_file_create(path, &file, &stream, &error), CAROM_IO);
	if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, reason))
		fail_msg("expected \"%s\", got \"%s\"", reason, error.text);
	assert_null(file);
}

static void links_and_permissions_stay(void **state)
{
	(void)state;
	struct stat there;
	char link[512];
	put_file("target", "old");
	assert_int_equal(chmod(in_folder("target"), 04640), 0); /* whoever runs it is not the one who replaces it */
	snprintf(link, sizeof link, "%s", in_folder("link"));
	assert_int_equal(symlink("target", link), 0);
	put_file("link", "new");
	assert_text("target", "new");
	assert_int_equal(lstat(link, &there), 0);
	assert_true(S_ISLNK(there.st_mode));
	assert_int_equal(stat(link, &there), 0);
	assert_int_equal(there.st_mode & 07777, 0640);
	unlink(link);
	unlink(in_folder("target"));
}

/* What others have left there, under all the names that there are, stays. */
static void files_of_others_stay(void **state)
{
	(void)state;
	char name[64];
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error;
	for (int k = 0; k < 1000; k++) {
		snprintf(name, sizeof name, "carom.tmp.%ld.%d", (long)getpid(), k);
		FILE *other = fopen(in_folder(name), "w");
		assert_non_null(other);
		fclose(other);
	}
	assert_int_equal(carom_file_create(in_folder("new"), &file, &stream, &error), CAROM_IO);
	for (int k = 0; k < 1000; k++) {
		snprintf(name, sizeof name, "carom.tmp.%ld.%d", (long)getpid(), k);
		assert_int_equal(unlink(in_folder(name)), 0);
	}
}

static void links_may_lead_to_what_is_not_there_yet(void **state)
{
	(void)state;
	struct stat there;
	char link[512];
	snprintf(link, sizeof link, "%s", in_folder("link"));
	assert_int_equal(symlink("below/new", link), 0);
	assert_refused(link, "No such file or directory");
	assert_int_equal(mkdir(in_folder("below"), 0700), 0);
	put_file("link", "new");
	assert_text("below/new", "new");
	assert_int_equal(lstat(link, &there), 0);
	assert_true(S_ISLNK(there.st_mode));
	unlink(link);
	assert_int_equal(symlink("link", link), 0);
	assert_refused(link, "Too many levels of symbolic links");
	unlink(link);
	unlink(in_folder("below/new"));
	rmdir(in_folder("below"));
}

static void names_may_be_as_long_as_any(void **state)
{
	(void)state;
	char name[256] = "";
	memset(name, 'n', 255);
	put_file(name, "long");
	assert_text(name, "long");
	unlink(in_folder(name));
}

/* A pipe comes to stand where the file is to go. */
static void only_files_are_replaced(void **state)
{
	(void)state;
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = {0};
	struct stat there;
	assert_int_equal(carom_file_create(in_folder("pipe"), &file, &stream, &error), CAROM_OK);
	assert_int_equal(mkfifo(in_folder("pipe"), 0600), 0);
	assert_int_equal(carom_file_commit(file, &error), CAROM_IO);
	assert_non_null(strstr(error.text, "/pipe: can't be replaced: File exists"));
	assert_int_equal(stat(in_folder("pipe"), &there), 0);
	assert_true(S_ISFIFO(there.st_mode));
	const int reader = open(in_folder("pipe"), O_RDONLY | O_NONBLOCK);
	char text[8] = "";
	put_file("pipe", "new");
	assert_int_equal(read(reader, text, sizeof text), 3);
	assert_string_equal(text, "new");
	close(reader);
	assert_int_equal(count_files(), 1);
	unlink(in_folder("pipe"));
}

static void put_into_descriptor(const char *before, int descriptor, const char *text)
{
	char path[64];
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = {0};
	snprintf(path, sizeof path, "%s%d", before, descriptor);
	if (carom_file_create(path, &file, &stream, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	fputs(text, stream);
	assert_int_equal(carom_file_commit(file, &error), CAROM_OK);
}

/* Never replaced: there may be more in it, and more to come. */
static void what_is_open_is_gone_on_with(void **state)
{
	(void)state;
	char path[64], link[512], text[64] = "";
	put_file("open", "first ");
	const int descriptor = open(in_folder("open"), O_RDWR | O_APPEND);
	put_into_descriptor("/dev/fd/", descriptor, "second ");
	put_into_descriptor("/proc/self/fd/", descriptor, "third ");
	snprintf(path, sizeof path, "/dev/fd/%d", descriptor);
	snprintf(link, sizeof link, "%s", in_folder("link"));
	assert_int_equal(symlink(path, link), 0);
	put_file("link", "fourth ");
	assert_text("open", "first second third fourth ");
	unlink(in_folder("open"));
	put_into_descriptor("/dev/fd/", descriptor, "fifth"); /* it has no name any more */
	assert_int_equal(pread(descriptor, text, sizeof text, 0), 31);
	assert_string_equal(text, "first second third fourth fifth");
	close(descriptor);
	assert_refused(path, "Bad file descriptor; this descriptor is closed, or open for reading only");
	assert_refused(link, "Bad file descriptor");
	assert_int_equal(open("/dev/null", O_RDONLY), descriptor);
	assert_refused(path, "Bad file descriptor");
	close(descriptor);
	unlink(link);
	assert_int_equal(count_files(), 0);
}

static void what_cannot_be_written_is_named(void **state)
{
	(void)state;
	carom_file *file = NULL;
	FILE *stream = NULL;
	assert_refused(folder, "Is a directory");
	assert_refused("/nowhere/at all", "No such file or directory");
	assert_int_equal(carom_file_create("", &file, &stream, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_file_create(NULL, &file, &stream, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_file_commit(NULL, NULL), CAROM_INVALID_ARGUMENT);
	assert_int_equal(count_files(), 0);
}

/* /dev/full stands for a full disk; devices are written into, never replaced. */
static void a_full_disk_is_an_error(void **state)
{
	(void)state;
	carom_file *file = NULL;
	FILE *stream = NULL;
	carom_error error = {0};
	struct stat there;
	static const uint8_t pixels[4 * 4];
	if (access("/dev/full", W_OK) != 0) {
		print_message("SKIPPED: there is no /dev/full\n");
		skip();
	}
	assert_int_equal(carom_file_create("/dev/full", &file, &stream, NULL), CAROM_OK);
	fputs("too much", stream);
	assert_int_equal(carom_file_commit(file, &error), CAROM_IO);
	assert_string_equal(error.text, "/dev/full: can't be written: No space left on device; free some space or write elsewhere");
	for (int k = 0; k < 2; k++) { /* a failure in the middle, not at the end */
		assert_int_equal(carom_file_create("/dev/full", &file, &stream, NULL), CAROM_OK);
		for (int i = 0; i < 1000000; i++)
			fputs("too much", stream);
		assert_int_equal(carom_file_commit(file, &error), CAROM_IO);
	}
	assert_int_equal(carom_png_write("/dev/full", pixels, 2, 2, &error), CAROM_IO);
	assert_non_null(strstr(error.text, "/dev/full: can't be written"));
	assert_int_equal(stat("/dev/full", &there), 0);
	assert_true(S_ISCHR(there.st_mode));
}

/* So many colours at most, each pixel one. */
static void write_and_read_back(uint32_t colors)
{
	enum { WIDTH = 37, HEIGHT = 23 };
	static uint8_t pixels[WIDTH * HEIGHT * 4], read[WIDTH * HEIGHT * 4];
	carom_error error = {0};
	png_image image = {.version = PNG_IMAGE_VERSION};
	for (uint32_t k = 0; k < WIDTH * HEIGHT; k++) {
		const uint32_t color = k % colors * 70001;
		const uint8_t pixel[4] = {(uint8_t)color, (uint8_t)(color >> 8), (uint8_t)(color >> 16), 255};
		memcpy(pixels + (size_t)4 * k, pixel, sizeof pixel);
	}
	if (carom_png_write(in_folder("picture.png"), pixels, WIDTH, HEIGHT, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	assert_true(png_image_begin_read_from_file(&image, in_folder("picture.png")));
	assert_true(image.width == WIDTH && image.height == HEIGHT && !(image.format & PNG_FORMAT_FLAG_ALPHA));
	assert_int_equal(!!(image.format & PNG_FORMAT_FLAG_COLORMAP), colors <= 256);
	image.format = PNG_FORMAT_RGBA;
	assert_true(png_image_finish_read(&image, NULL, read, 0, NULL));
	assert_memory_equal(pixels, read, sizeof pixels);
	unlink(in_folder("picture.png"));
}

static void pixels_read_back(void **state)
{
	static const uint32_t colors[] = {1, 2, 100, 255, 256, 257, 800};
	(void)state;
	for (size_t k = 0; k < sizeof colors / sizeof *colors; k++)
		write_and_read_back(colors[k]);
}

static void bad_pictures_are_refused(void **state)
{
	(void)state;
	static const uint8_t pixels[4];
	carom_error error = {0};
	assert_int_equal(carom_png_write(in_folder("p.png"), pixels, 0, 1, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_png_write(in_folder("p.png"), pixels, 1, 1000001, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_png_write(in_folder("p.png"), NULL, 1, 1, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_png_write(NULL, pixels, 1, 1, &error), CAROM_INVALID_ARGUMENT);
	assert_int_equal(carom_png_write("/nowhere/p.png", pixels, 1, 1, &error), CAROM_IO);
	assert_int_equal(count_files(), 0);
}

static int make_folder(void **state)
{
	(void)state;
	return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
	(void)state;
	return rmdir(folder); /* fails if a temporary file was left in it */
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_file_appears_when_it_is_whole), cmocka_unit_test(a_file_given_up_leaves_the_old_one),
		cmocka_unit_test(links_and_permissions_stay), cmocka_unit_test(files_of_others_stay),
		cmocka_unit_test(links_may_lead_to_what_is_not_there_yet), cmocka_unit_test(names_may_be_as_long_as_any),
		cmocka_unit_test(only_files_are_replaced), cmocka_unit_test(what_is_open_is_gone_on_with), cmocka_unit_test(what_cannot_be_written_is_named),
		cmocka_unit_test(a_full_disk_is_an_error), cmocka_unit_test(pixels_read_back), cmocka_unit_test(bad_pictures_are_refused)};
	return cmocka_run_group_tests_name("file", tests, make_folder, remove_folder);
}
