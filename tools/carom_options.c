/* Options from tables: `--name value`, `--name=value`, flags, arguments in between, `--` before arguments that begin with a dash.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Values ---- */

carom_status read_text(const char *text, void *target, carom_error *error)
{
	if (!*text)
		return wrong(error, "found nothing; allowed: a text that is not empty");
	*(const char **)target = text;
	return CAROM_OK;
}

carom_status read_count(const char *text, void *target, carom_error *error)
{
	char *end = NULL;
	errno = 0;
	unsigned long long count = strtoull(text, &end, 10);
	if (*text < '0' || *text > '9' || *end || errno) /* strtoull itself would take spaces and a minus */
		return wrong(error, "found \"%s\"; allowed: a whole number, 0 or more", text);
	*(uint64_t *)target = count;
	return CAROM_OK;
}

carom_status read_number(const char *text, void *target, carom_error *error)
{
	char *end = NULL;
	const bool is_plain = *text != '+' && text[strspn(text, "0123456789.eE+-")] == '\0'; /* strtod itself would take spaces and 0x10 */
	double number = strtod(text, &end);
	if (!is_plain || end == text || *end || !isfinite(number))
		return wrong(error, "found \"%s\"; allowed: a number", text);
	*(double *)target = number;
	return CAROM_OK;
}

carom_status read_positive(const char *text, void *target, carom_error *error)
{
	double number = 0;
	if (read_number(text, &number, error) != CAROM_OK || number <= 0)
		return wrong(error, "found \"%s\"; allowed: a number above 0", text);
	*(double *)target = number;
	return CAROM_OK;
}

size_t read_floats(const char *text, float *numbers, size_t most)
{
	for (size_t k = 0; k < most; k++) {
		char part[64];
		double number = 0;
		carom_error ignored;
		const size_t length = strcspn(text, ",");
		snprintf(part, sizeof part, "%.*s", (int)length, text);
		if (length >= sizeof part || read_number(part, &number, &ignored) != CAROM_OK || fabs(number) > (double)FLT_MAX)
			return 0;
		numbers[k] = (float)number;
		if (text[length] == '\0')
			return k + 1;
		text += length + 1;
	}
	return 0;
}

static carom_status read_storage(const char *text, void *target, carom_error *error)
{
	if (strcmp(text, "image") != 0 && strcmp(text, "buffer") != 0)
		return wrong(error, "found \"%s\"; allowed: image, buffer", text);
	*(carom_storage *)target = strcmp(text, "image") == 0 ? CAROM_STORAGE_IMAGE : CAROM_STORAGE_BUFFER;
	return CAROM_OK;
}

static carom_status set_slot(carom_pipeline *pipeline, const char *text, carom_error *error)
{
	char slot[64];
	const char *equals = strchr(text, '=');
	size_t length = equals ? (size_t)(equals - text) : 0;
	if (length == 0 || length >= sizeof slot || !equals[1])
		return wrong(error, "found \"%s\"; allowed: slot=alternative, as `carom stages` lists them", text);
	memcpy(slot, text, length);
	slot[length] = '\0';
	return carom_pipeline_set(pipeline, slot, equals + 1, error);
}

/* Looked at at once, so that a wrong name is found before anything is done. */
static carom_status read_set(const char *text, void *target, carom_error *error)
{
	struct common_options *options = target;
	carom_pipeline pipeline = {0};
	if (options->set_count == MAX_SETS)
		return wrong(error, "found more than %d; allowed: one a slot", MAX_SETS);
	carom_status status = set_slot(&pipeline, text, error);
	const size_t slot = strcspn(text, "=") + 1;
	for (size_t k = 0; status == CAROM_OK && k < options->set_count; k++) {
		if (strncmp(options->sets[k], text, slot) == 0)
			status = wrong(error, "found \"%s\" and \"%s\"; allowed: one a slot", options->sets[k], text);
	}
	if (status == CAROM_OK)
		options->sets[options->set_count++] = text;
	return status;
}

carom_status apply_options(const struct common_options *options, carom_world_def *world, carom_error *error)
{
	carom_status status = CAROM_OK;
	world->device = options->device; /* NULL: CAROM_DEVICE of the environment, else auto */
	world->storage = options->storage;
	for (size_t k = 0; status == CAROM_OK && k < options->set_count; k++)
		status = set_slot(&world->pipeline, options->sets[k], error);
	return status;
}

static const struct option of_worlds[] = {
	{"device", "NAME", read_text, offsetof(struct common_options, device),
		"auto, cpu, opencl, or part of a platform's or device's name; by default what CAROM_DEVICE says, else auto"},
	{"storage", "KIND", read_storage, offsetof(struct common_options, storage),
		"image or buffer: how an OpenCL device holds textures; by default what suits the device"},
	{"set", "SLOT=NAME", read_set, 0,
		"the alternative for a slot, over the scene's; once a slot; `carom stages` lists them, and the slots that take it"},
	{NULL, NULL, NULL, 0, NULL},
};

static const struct option of_all[] = {
	{"quiet", NULL, NULL, offsetof(struct common_options, quiet), "only errors on stderr"},
	{"help", NULL, NULL, offsetof(struct common_options, help), "this text"},
	{"version", NULL, NULL, offsetof(struct common_options, version), "the version"},
	{NULL, NULL, NULL, 0, NULL},
};

/* ---- Calls ---- */

static const struct option *find_option(const struct option *table, const char *name, size_t length)
{
	for (; table->name; table++) {
		if (strlen(table->name) == length && memcmp(table->name, name, length) == 0)
			return table;
	}
	return NULL;
}

/* Was the option at argv[index] given before? No value begins with two dashes, so what does is an option. */
static bool is_given_before(char **argv, int index)
{
	const size_t length = strcspn(argv[index], "=");
	for (int k = 1; k < index; k++) {
		if (strcspn(argv[k], "=") == length && memcmp(argv[k], argv[index], length) == 0)
			return true;
	}
	return false;
}

/* Takes the option at argv[*index] and its value. */
static carom_status take_option(const struct command *command, int argc, char **argv, int *index, struct common_options *options, carom_error *error)
{
	const char *name = argv[*index] + 2, *equals = strchr(name, '='), *value = equals ? equals + 1 : NULL;
	size_t length = equals ? (size_t)(equals - name) : strlen(name);
	const struct option *option = find_option(command->options, name, length);
	if (!option && command->makes_worlds)
		option = find_option(of_worlds, name, length);
	if (!option)
		option = find_option(of_all, name, length);
	if (!option)
		return wrong(error, "%s: no such option: `carom %s --help` lists them", argv[*index], command->name);
	void *target = (char *)options + option->offset;
	if (!option->read) {
		*(bool *)target = true;
		return value ? wrong(error, "--%s takes no value", option->name) : CAROM_OK;
	}
	if (!value && (*index + 1 >= argc || strncmp(argv[*index + 1], "--", 2) == 0)) /* --option=--value is a way */
		return wrong(error, "--%s: the value is missing: --%s %s", option->name, option->name, option->value);
	if (option->read != read_set && is_given_before(argv, *index))
		return wrong(error, "--%s: found twice; allowed: once", option->name);
	if (!value)
		value = argv[++*index];
	carom_error found;
	carom_status status = option->read(value, target, &found);
	if (status != CAROM_OK)
		wrong(error, "--%s: %.900s", option->name, found.text);
	return status;
}

static carom_status take_argument(const struct command *command, const char *text, struct common_options *options, carom_error *error)
{
	if (options->argument_count == command->most_arguments)
		return wrong(error, "%s: one argument too many: `carom %s --help` shows the usage", text, command->name);
	options->arguments[options->argument_count++] = text;
	return CAROM_OK;
}

static carom_status take_all(const struct command *command, int argc, char **argv, struct common_options *options, carom_error *error)
{
	bool options_ended = false;
	carom_status status = CAROM_OK;
	for (int k = 1; status == CAROM_OK && k < argc; k++) {
		if (!options_ended && strcmp(argv[k], "--") == 0) {
			options_ended = true;
		} else if (!options_ended && strcmp(argv[k], "-h") == 0) {
			options->help = true;
		} else if (!options_ended && strncmp(argv[k], "--", 2) == 0) {
			status = take_option(command, argc, argv, &k, options, error);
		} else if (!options_ended && argv[k][0] == '-' && argv[k][1]) {
			status = wrong(error, "%s: no such option: `carom %s --help` lists them", argv[k], command->name);
		} else {
			status = take_argument(command, argv[k], options, error);
		}
	}
	return status;
}

int parse_options(const struct command *command, int argc, char **argv, struct common_options *options)
{
	carom_error error;
	carom_status status = take_all(command, argc, argv, options, &error);
	if (status == CAROM_OK && options->help) {
		print_command_help(command);
		return finish_output();
	}
	if (status == CAROM_OK && options->version) {
		printf("carom %s\n", carom_version());
		return finish_output();
	}
	if (status == CAROM_OK && options->argument_count < command->least_arguments)
		status = wrong(&error, "%s: %s is missing: `carom %s --help` shows the usage", command->name, command->arguments, command->name);
	return status == CAROM_OK ? -1 : report(&error);
}

/* ---- Help ---- */

/* Words up to column 100, from column `indent` on. */
static void print_wrapped(const char *text, int column, int indent)
{
	const char *space = "";
	while (*text) {
		int length = (int)strcspn(text, " ");
		if (column + 1 + length > 100) {
			printf("\n%*s", indent, "");
			column = indent;
			space = "";
		}
		column += printf("%s%.*s", space, length, text);
		text += length;
		text += strspn(text, " ");
		space = " ";
	}
	putchar('\n');
}

static void print_table(const struct option *table)
{
	for (; table->name; table++) {
		int column = printf("  --%s%s%s", table->name, table->value ? " " : "", table->value ? table->value : "");
		printf("%*s", column < 26 ? 26 - column : 2, "");
		print_wrapped(table->help, column < 26 ? 26 : column + 2, 26);
	}
}

void print_command_help(const struct command *command)
{
	printf("usage: carom %s%s%s [options]\n\n%s.\n%s", command->name, *command->arguments ? " " : "", command->arguments, command->summary,
		command->details);
	if (command->options->name)
		printf("\noptions:\n");
	print_table(command->options);
	if (command->makes_worlds) {
		printf("\noptions of every command that simulates:\n");
		print_table(of_worlds);
	}
	printf("\noptions of every command:\n");
	print_table(of_all);
}
