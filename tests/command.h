/* Runs the carom command as a process, for its tests. CAROM_BUILD says where it is, build/ by default.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_COMMAND_H
#define CAROM_TESTS_COMMAND_H

#include "carom.h"
#include "count.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

/* What the last call printed, and the folder for the files of the tests. */
struct call {
	char folder[64], out[65536], err[65536];
};

static struct call call = {.folder = "/tmp/carom-test-XXXXXX"};

static inline void read_into(const char *name, char *text, size_t size)
{
	char path[128];
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	FILE *file = fopen(path, "rb");
	if (!file)
		fail_msg("%s: not there", path);
	text[fread(text, 1, size - 1, file)] = '\0';
	fclose(file);
}

/* Runs a shell line in which $C is the command and $D the folder; fills in call.out and call.err; the exit code. */
static inline int shell(const char *line)
{
	char text[4096];
	const char *build = getenv("CAROM_BUILD");
	snprintf(text, sizeof text, "C='%s/carom'; D='%s'; { %s; } >\"$D/out\" 2>\"$D/err\" </dev/null", build ? build : "build", call.folder, line);
	int status = system(text);
	read_into("out", call.out, sizeof call.out);
	read_into("err", call.err, sizeof call.err);
	return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* The line has to end with this exit code, and say the text on stderr (NULL for anything). */
static inline void check(const char *line, int code, const char *said)
{
	int found = shell(line);
	if (found != code || (said && !strstr(call.err, said)))
		fail_msg("%s: expected exit code %d and \"%s\", got %d and\n%s", line, code, said ? said : "", found, call.err);
}

static inline int make_folder(void **state)
{
	(void)state;
	return mkdtemp(call.folder) ? 0 : -1;
}

static inline int remove_folder(void **state)
{
	char line[128];
	(void)state;
	snprintf(line, sizeof line, "rm -r '%s'", call.folder);
	return system(line);
}

/* Whether the command finds an OpenCL device; says so if it doesn't, which is a failure where nothing may be skipped. */
static inline bool has_opencl(void)
{
	int code = shell("$C run scenes/thin_wall.json --steps 0 --device opencl");
	if (code == 0)
		return true;
	if (getenv("CAROM_NO_SKIP"))
		fail_msg("%s", call.err);
	print_message("SKIPPED on opencl: %s", call.err);
	return false;
}

#endif
