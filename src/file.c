/* Files that are whole or not there: written under a temporary name in the same folder, then renamed. Only files are replaced: what is no file is written into.
 * SPDX-License-Identifier: MIT */
#include "follow.h"
#include "status.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Names tried before giving up: a crash may have left some behind, but not this many of one process id. */
#define MAX_ATTEMPTS 1000
#define STREAM_BUFFER 65536

struct carom_file {
	carom_target target; /* where it ends up */
	char *temporary;     /* NULL for a descriptor, a device or a pipe, which are written directly: renaming onto /dev/null would replace it */
	FILE *stream;
};

static carom_status fail_io(carom_error *error, const char *path, const char *did, int number, const char *advice)
{
	char reason[128];
	return carom_fail(error, CAROM_IO, "%s: %s: %s; %s", path, did, carom_errno_text(number, reason, sizeof reason), advice);
}

/* Opens a name that nobody has: O_EXCL rather than a counter, which would be global state. It is short, for the file's own may be as long as names get. */
static int open_temporary(carom_file *file, mode_t mode)
{
	const char *path = file->target.path;
	const int folder = (int)(strrchr(path, '/') - path);
	const size_t size = (size_t)folder + 64;
	file->temporary = malloc(size);
	if (!file->temporary)
		return -1;
	for (int attempt = 0; attempt < MAX_ATTEMPTS; attempt++) {
		snprintf(file->temporary, size, "%.*s/carom.tmp.%ld.%d", folder, path, (long)getpid(), attempt);
		int descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
		if (descriptor >= 0)
			return descriptor;
		if (errno != EEXIST)
			break;
	}
	const int number = errno;
	free(file->temporary); /* it has no such file, so that there is none to remove */
	file->temporary = NULL;
	errno = number;
	return -1;
}

/* What is there now decides how to write: a file is replaced with its permissions kept, anything else is written into. */
static int open_beside(carom_file *file)
{
	const char *path = file->target.path;
	struct stat there;
	int descriptor;
	if (stat(path, &there) != 0)
		return errno == ENOENT ? open_temporary(file, 0666) : -1;
	if (S_ISDIR(there.st_mode)) {
		errno = EISDIR;
		return -1;
	}
	if (!S_ISREG(there.st_mode))
		return open(path, O_WRONLY | O_CLOEXEC);
	if (access(path, W_OK) != 0)
		return -1;
	descriptor = open_temporary(file, 0600);
	if (descriptor >= 0)
		fchmod(descriptor, there.st_mode & 0777); /* whom a program runs as is not given to a new owner; some file systems have no permissions */
	return descriptor;
}

static int open_target(carom_file *file, const char *path, const char **advice)
{
	*advice = "give a file in a folder that exists and can be written to";
	if (!carom_follow(path, &file->target))
		return -1;
	if (file->target.descriptor < 0)
		return open_beside(file);
	*advice = "this descriptor is closed, or open for reading only";
	return carom_duplicate(file->target.descriptor, O_RDONLY);
}

/* Takes its name, unless something has come to stand there that is no file. */
static bool take_name(const carom_file *file)
{
	struct stat there;
	if (lstat(file->target.path, &there) != 0 || S_ISREG(there.st_mode))
		return rename(file->temporary, file->target.path) == 0;
	errno = S_ISDIR(there.st_mode) ? EISDIR : EEXIST;
	return false;
}

carom_status carom_file_create(const char *path, carom_file **file, FILE **stream, carom_error *error)
{
	carom_file *made = NULL;
	const char *advice;
	int descriptor;
	GIVEN(path, error);
	GIVEN(file, error);
	GIVEN(stream, error);
	if (!*path)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "path: found \"\", must be the name of a file");
	made = calloc(1, sizeof *made);
	if (!made)
		goto no_memory;
	descriptor = open_target(made, path, &advice);
	if (descriptor >= 0)
		made->stream = fdopen(descriptor, "wb");
	if (!made->stream) {
		int number = errno;
		if (descriptor >= 0)
			close(descriptor);
		if (number == ENOMEM)
			goto no_memory;
		carom_file_destroy(made);
		return fail_io(error, path, "can't be written", number, advice);
	}
	setvbuf(made->stream, NULL, _IOFBF, STREAM_BUFFER);
	*file = made;
	*stream = made->stream;
	return CAROM_OK;
no_memory:
	carom_file_destroy(made);
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "%s: there is not enough memory to open it", path);
}

carom_status carom_file_commit(carom_file *file, carom_error *error)
{
	carom_status status = CAROM_OK;
	int number = 0;
	GIVEN(file, error);
	errno = 0;
	/* An earlier write may have failed and set the flag only: its errno is lost, a full disk the likeliest cause. */
	if (fflush(file->stream) != 0 || ferror(file->stream))
		number = errno ? errno : ENOSPC;
	if (fclose(file->stream) != 0 && !number)
		number = errno;
	file->stream = NULL;
	if (number) {
		status = fail_io(error, file->target.path, "can't be written", number,
			file->temporary ? "what was there before stays; free some space or write elsewhere" : "free some space or write elsewhere");
	} else if (file->temporary && !take_name(file)) {
		status = fail_io(error, file->target.path, "can't be replaced", errno, "what was there before stays; check the folder's permissions");
	} else {
		free(file->temporary);
		file->temporary = NULL;
	}
	carom_file_destroy(file);
	return status;
}

void carom_file_destroy(carom_file *file)
{
	if (!file)
		return;
	if (file->stream)
		fclose(file->stream);
	if (file->temporary)
		unlink(file->temporary);
	free(file->temporary);
	free(file);
}
