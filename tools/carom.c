/* The carom command: picks the subcommand.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static const struct command *const commands[] = {
	&run_command,
	&generate_command,
	&query_command,
	&devices_command,
	&stages_command,
	&bench_command,
};

#define COMMAND_COUNT (sizeof commands / sizeof *commands)

static void print_help(void)
{
	printf("usage: carom COMMAND [arguments] [options]\n\n"
		   "Carom simulates 2D rigid bodies and finds every hit at its exact time, on OpenCL devices and on the CPU.\n\n"
		   "commands:\n");
	for (size_t k = 0; k < COMMAND_COUNT; k++)
		printf("  %-12s%s\n", commands[k]->name, commands[k]->summary);
	printf("\n`carom COMMAND --help` tells more of a command; `carom --version` prints the version.\n\n"
		   "Results go to stdout, everything else to stderr.\n"
		   "exit codes: 0 done, 1 the work failed (a device, a disk), 2 the call or the input was wrong,\n"
		   "            130 interrupted (143 by SIGTERM, 129 by SIGHUP)\n"
		   "environment: CAROM_DEVICE  the device if --device is not given; `man carom` has more\n");
}

static int fail_call(const char *found)
{
	fprintf(stderr, "carom: %s; allowed:", found);
	for (size_t k = 0; k < COMMAND_COUNT; k++)
		fprintf(stderr, "%s %s", k ? "," : "", commands[k]->name);
	fprintf(stderr, ", --help, --version\n");
	return EXIT_WRONG;
}

/* A standard stream that is closed stays unusable: else the next file that is opened would be taken for it. */
static void keep_closed(void)
{
	for (int k = STDIN_FILENO; k <= STDERR_FILENO; k++) {
		if (fcntl(k, F_GETFD) < 0)
			open("/dev/null", k == STDIN_FILENO ? O_WRONLY : O_RDONLY);
	}
}

int main(int argc, char **argv)
{
	keep_closed();
	signal(SIGXFSZ, SIG_IGN); /* a file that may grow no further is an error like a full disk */
	if (argc < 2)
		return fail_call("the command is missing");
	if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
		print_help();
		return finish_output();
	}
	if (strcmp(argv[1], "--version") == 0) {
		printf("carom %s\n", carom_version());
		return finish_output();
	}
	for (size_t k = 0; k < COMMAND_COUNT; k++) {
		if (strcmp(argv[1], commands[k]->name) == 0)
			return commands[k]->main(argc - 1, argv + 1);
	}
	char found[80];
	snprintf(found, sizeof found, "%.40s: no such command", argv[1]);
	return fail_call(found);
}
