/* Names of files that the command reads and writes.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define MOST_LINKS 40 /* one after the other, as in Linux */

const char *input_name(const char *text)
{
	return strcmp(text, "-") == 0 ? "/dev/stdin" : text;
}

carom_status read_input(const char *text, void *target, carom_error *error)
{
	return read_text(input_name(text), target, error);
}

carom_status read_output(const char *text, void *target, carom_error *error)
{
	return read_text(strcmp(text, "-") == 0 ? "/dev/stdout" : text, target, error);
}

carom_status read_path(const char *text, void *target, carom_error *error)
{
	if (strcmp(text, "-") == 0)
		return wrong(error, "found \"-\", which would be standard output; allowed: a name; ./- is one");
	return read_text(text, target, error);
}

carom_status try_path(const char *path, carom_error *error)
{
	carom_file *file = NULL;
	FILE *stream = NULL;
	struct stat there;
	if (stat(path, &there) == 0 && S_ISFIFO(there.st_mode))
		return CAROM_OK;
	carom_status status = carom_file_create(path, &file, &stream, error);
	carom_file_destroy(file);
	return status;
}

/* ---- Two names of one file ---- */

/* The name without links in its folder; false where there is no such folder. */
static bool resolve_folder(const char *name, char path[PATH_MAX])
{
	const char *slash = strrchr(name, '/');
	char folder[PATH_MAX];
	snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - name) + 1 : 1, slash ? name : ".");
	if (!realpath(folder, path))
		return false;
	const size_t length = strlen(path);
	return (size_t)snprintf(path + length, PATH_MAX - length, "/%s", slash ? slash + 1 : name) < PATH_MAX - length;
}

/* Where the name leads, also if nothing is there yet; false if nowhere. */
static bool resolve(const char *name, char path[PATH_MAX])
{
	char at[PATH_MAX], link[PATH_MAX];
	snprintf(at, sizeof at, "%s", name);
	for (int k = 0; k <= MOST_LINKS; k++) {
		if (realpath(at, path))
			return true;
		if (!resolve_folder(at, path))
			return false;
		const ssize_t length = readlink(path, link, sizeof link - 1);
		if (length < 0)
			return true;
		link[length] = '\0';
		const int folder = link[0] == '/' ? 0 : (int)(strrchr(path, '/') - path) + 1;
		if (snprintf(at, sizeof at, "%.*s%s", folder, path, link) >= (int)sizeof at)
			return false;
	}
	return false;
}

/* Of a descriptor, which is gone on with. */
static bool is_stream(const char *name)
{
	return strncmp(name, "/dev/std", 8) == 0 || strncmp(name, "/dev/fd/", 8) == 0 || strncmp(name, "/proc/self/fd/", 14) == 0;
}

static bool are_same(const struct stat *a, const struct stat *b)
{
	return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

bool are_one_stream(const char *a, const char *b)
{
	struct stat there, other;
	return is_stream(a) && is_stream(b) && stat(a, &there) == 0 && stat(b, &other) == 0 && are_same(&there, &other);
}

bool are_one_file(const char *a, const char *b)
{
	char first[PATH_MAX], second[PATH_MAX];
	struct stat there, other;
	if (is_stream(a) && is_stream(b))
		return false;
	if (stat(a, &there) == 0 && stat(b, &other) == 0) /* terminals and /dev/null take what comes */
		return are_same(&there, &other) && !S_ISCHR(there.st_mode);
	return resolve(a, first) && resolve(b, second) && strcmp(first, second) == 0;
}
