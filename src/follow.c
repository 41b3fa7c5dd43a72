/* Where the names of files lead. What stands for a descriptor is not opened by its name: that would begin at the start of a file, and fails with sockets.
 * SPDX-License-Identifier: MIT */
#include "follow.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define MOST_LINKS 40 /* one after the other, as in Linux */
#define MOST_DIGITS 9

static bool put_path(char *whole, const char *folder, size_t length, const char *name)
{
	if (length + strlen(name) + 2 > PATH_MAX) {
		errno = ENAMETOOLONG;
		return false;
	}
	memmove(whole, folder, length);
	whole[length] = '/';
	memmove(whole + length + 1, name, strlen(name) + 1);
	return true;
}

/* Is it the folder of this process's descriptors? Linux has one for each thread, too. */
static bool is_of_descriptors(const char *folder, size_t length)
{
	char own[PATH_MAX];
	if (length == strlen("/dev/fd") && memcmp(folder, "/dev/fd", length) == 0)
		return true;
	if (!realpath("/proc/self", own))
		return false;
	const size_t of_own = strlen(own);
	return length > of_own && memcmp(folder, own, of_own) == 0 && folder[of_own] == '/' && memcmp(folder + length - 3, "/fd", 3) == 0;
}

static int descriptor_of(const char *path)
{
	static const char *const streams[] = {"/dev/stdin", "/dev/stdout", "/dev/stderr"};
	for (int k = 0; k < 3; k++) {
		if (strcmp(path, streams[k]) == 0)
			return k;
	}
	const char *slash = strrchr(path, '/');
	const size_t digits = slash ? strspn(slash + 1, "0123456789") : 0;
	if (digits == 0 || digits > MOST_DIGITS || slash[1 + digits] || !is_of_descriptors(path, (size_t)(slash - path)))
		return -1;
	return (int)strtol(slash + 1, NULL, 10);
}

/* Follows the links in the path but for its last name. */
static bool resolve_folder(char *path)
{
	char folder[PATH_MAX], name[PATH_MAX];
	char *slash = strrchr(path, '/');
	snprintf(name, sizeof name, "%s", slash ? slash + 1 : path);
	if (slash)
		slash[slash == path] = '\0';
	if (!realpath(slash ? path : ".", folder))
		return false;
	return put_path(path, folder, strcmp(folder, "/") == 0 ? 0 : strlen(folder), name);
}

/* One link further; *done if there is none. */
static bool follow_link(char *path, bool *done)
{
	char link[PATH_MAX], next[PATH_MAX];
	struct stat there;
	const ssize_t length = readlink(path, link, sizeof link - 1);
	*done = length < 0; /* no link, or nothing: what else is wrong shows when it is opened */
	if (*done)
		return true;
	link[length] = '\0';
	if (link[0] == '/') {
		memcpy(next, link, (size_t)length + 1);
	} else if (!put_path(next, path, (size_t)(strrchr(path, '/') - path), link)) {
		return false;
	}
	*done = stat(path, &there) == 0 && lstat(next, &there) != 0; /* pipes and deleted files in /proc: what the link says is no path */
	if (!*done)
		snprintf(path, PATH_MAX, "%s", next);
	return true;
}

bool carom_follow(const char *name, carom_target *target)
{
	char *path = target->path;
	bool done = false;
	if (strlen(name) >= PATH_MAX) {
		errno = ENAMETOOLONG;
		return false;
	}
	snprintf(path, PATH_MAX, "%s", name);
	target->descriptor = descriptor_of(path);
	for (int k = 0; !done && target->descriptor < 0; k++) {
		if (k > MOST_LINKS) {
			errno = ELOOP;
			return false;
		}
		if (!resolve_folder(path))
			return false;
		target->descriptor = descriptor_of(path);
		if (target->descriptor < 0 && !follow_link(path, &done))
			return false;
	}
	if (target->descriptor >= 0)
		snprintf(path, PATH_MAX, "%s", name);
	return true;
}

int carom_duplicate(int descriptor, int refused)
{
	const int flags = fcntl(descriptor, F_GETFL);
	if (flags >= 0 && (flags & O_ACCMODE) != refused)
		return fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
	errno = EBADF;
	return -1;
}
