/* What the files of the carom command share. Of the library it sees carom.h alone, as any user does.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TOOL_H
#define CAROM_TOOL_H

#include "carom.h"

#if defined(__GNUC__)
#define TOOL_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define TOOL_PRINTF(text, first)
#endif

enum {
	EXIT_DONE = 0,
	EXIT_FAILED = 1, /* the work failed: a device, a disk */
	EXIT_WRONG = 2,  /* the call or the input was wrong; 128 and the signal's number where there was an interruption */
};

#define MAX_ARGUMENTS 4
#define MAX_SETS 32

/* The options that every command takes, or every one that makes worlds, and what stands between the options. Every command's options begin with it. */
struct common_options {
	const char *device; /* NULL if not given */
	carom_storage storage;
	const char *sets[MAX_SETS]; /* "slot=alternative" */
	size_t set_count;
	bool quiet, help, version;
	const char *arguments[MAX_ARGUMENTS];
	size_t argument_count;
};

/* Reads an option's value into `target`, or says in `error` what was found and what is allowed. */
typedef carom_status read_option(const char *text, void *target, carom_error *error);

struct option {
	const char *name;  /* without the dashes; NULL ends a table */
	const char *value; /* what the help calls its value; NULL for a flag, whose target is a bool */
	read_option *read; /* NULL for a flag */
	size_t offset;     /* in the command's options */
	const char *help;
};

struct command {
	const char *name;
	const char *arguments; /* for the help: "SCENE.json", or "" */
	size_t least_arguments, most_arguments;
	const char *summary; /* a line */
	const char *details; /* paragraphs for the help */
	const struct option *options;
	bool makes_worlds;                  /* takes --device, --storage and --set, too */
	int (*main)(int argc, char **argv); /* the exit code; argv[0] is the command's name */
};

extern const struct command run_command, generate_command, query_command, devices_command, stages_command, bench_command;

/* ---- carom_options.c */

/* Fills in *options, whose defaults are set. Answers -1 to go on, else the exit code: help was given, or the call is wrong. */
int parse_options(const struct command *command, int argc, char **argv, struct common_options *options);
void print_command_help(const struct command *command);
read_option read_text;     /* into a const char * */
read_option read_count;    /* into a uint64_t */
read_option read_number;   /* into a double, finite, written in decimals */
read_option read_positive; /* into a double, above 0 */
/* Floats with commas between them: how many there are; 0 if something is none, or there are more than `most`. */
size_t read_floats(const char *text, float *numbers, size_t most);
/* What the options say of the world. */
carom_status apply_options(const struct common_options *options, carom_world_def *world, carom_error *error);

/* ---- carom_paths.c */

/* The name of a file to be read: - is /dev/stdin. */
const char *input_name(const char *text);
read_option read_input;  /* the same, into a const char * */
read_option read_output; /* into a const char *: the name of a file; - is /dev/stdout */
read_option read_path;   /* the same where standard output can't be meant */
/* Begins the file and gives it up: what could go wrong at the end goes wrong now. Pipes are left alone: their readers would take this for the end. */
carom_status try_path(const char *path, carom_error *error);
/* Would what is in one be lost by writing to the other? Names are followed to where they lead, and a file may have several. */
bool are_one_file(const char *a, const char *b);
/* Are both the same open descriptor, in which what is written to them at once would mix? */
bool are_one_stream(const char *a, const char *b);

/* ---- carom_interrupt.c */

/* From now on the first SIGINT or SIGTERM is only taken down, the second ends the process. */
void catch_interruptions(void);
bool is_interrupted(void);
/* The exit code: 128 and the signal's number, as shells count, or `code` where there was none. */
int interrupted_code(int code);
/* An error where there was one, for commands that have nothing to show then. */
carom_status fail_interrupted(carom_error *error);

/* ---- carom_report.c */

/* Fills in *error; answers CAROM_INVALID_ARGUMENT. */
carom_status wrong(carom_error *error, const char *format, ...) TOOL_PRINTF(2, 3);
/* Likewise CAROM_OUT_OF_MEMORY. */
carom_status out_of_memory(carom_error *error, const char *format, ...) TOOL_PRINTF(2, 3);
/* "carom: ..." on stderr, then the build log if there is one; answers the exit code for it. */
int report(const carom_error *error);
/* The same for a file that was to be read: what can't be read is wrong input. */
int report_input(const carom_error *error);
/* A line on stderr, "carom: ...", unless --quiet. */
void say(const struct common_options *options, const char *format, ...) TOOL_PRINTF(2, 3);
/* Flushes stdout; EXIT_FAILED, and says so, if what was printed did not get through. */
int finish_output(void);
/* What is hit or met, in a table: a body's index, or the name of a wall. */
void print_other(FILE *file, int32_t other);
/* "1.5 MiB" */
const char *format_bytes(uint64_t bytes, char *text, size_t size);
/* s, from any beginning, never going back */
double wall_seconds(void);

#endif
