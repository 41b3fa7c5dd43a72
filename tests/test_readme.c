/* What README.md, what it leads to in docs/, and the manual page say is true: the example, the commands with their output, options, tables, scenes.
 * SPDX-License-Identifier: MIT */
#include "command.h"
#include "documents.h"

#include <limits.h>

#define MAX_COMMANDS 16

static char manual[1 << 16], bootstrap[1 << 14];

static const char *readme;

/* What the command says of itself: the help of each subcommand. */
static struct {
	char name[32], help[1 << 14];
} commands[MAX_COMMANDS];
static size_t command_count;

/* Like snprintf, but everything has to fit. */
static void format(char *text, size_t size, const char *form, ...)
{
	va_list arguments;
	va_start(arguments, form);
	int length = vsnprintf(text, size, form, arguments);
	va_end(arguments);
	assert_in_range(length, 0, size - 1);
}

/* ---- Setting up ---- */

static void read_help(const char *name)
{
	char line[128];
	assert_true(command_count < MAX_COMMANDS);
	format(commands[command_count].name, sizeof commands->name, "%s", name);
	format(line, sizeof line, "$C %s --help", name);
	check(line, 0, NULL);
	format(commands[command_count++].help, sizeof commands->help, "%s", call.out);
}

/* The subcommands stand in a list, each after two spaces. */
static void read_helps(void)
{
	char list[4096], name[32];
	check("$C --help", 0, NULL);
	format(list, sizeof list, "%s", call.out);
	for (const char *at = strstr(list, "\n  "); at; at = strstr(at + 1, "\n  ")) {
		if (sscanf(at, "\n  %31[a-z]", name) == 1)
			read_help(name);
	}
}

/* In the folder of the tests everything lies as in the repository, but is not written to; `carom` and `cc` are the ones
 * under test, the fallback the device, so that what is printed is the same on every machine. */
static int set_up(void **state)
{
	char path[PATH_MAX], line[2048];
	const char *build = getenv("CAROM_BUILD");
	if (make_folder(state) || !realpath(build ? build : "build", path))
		return -1;
	format(line, sizeof line, "ln -s \"$PWD/include\" \"$PWD/scenes\" \"$PWD/tests\" $D && ln -s '%s' $D/build", path);
	check(line, 0, NULL);
	setenv("CAROM_DEVICE", "cpu", 1);
	setenv("CAROM_SANITIZERS", strstr(path, "/sanitize") ? "-fsanitize=address,undefined build/tests/sanitize/loaded.o -rdynamic" : "", 1);
	documents_read();
	readme = documents[0].text;
	documents_read_text("tools/carom.1", manual, sizeof manual);
	documents_read_text("tools/bootstrap", bootstrap, sizeof bootstrap);
	read_helps();
	return 0;
}

/* ---- Reading Markdown ---- */

/* Copies the next fenced block of that language at or after *at, which moves behind it; false if there is none. */
static bool next_block(const char **at, const char *language, char *block, size_t size)
{
	char fence[32];
	format(fence, sizeof fence, "\n```%s\n", language);
	const char *from = strstr(*at, fence);
	if (!from)
		return false;
	from += strlen(fence);
	const char *to = strstr(from - 1, "\n```\n");
	assert_non_null(to);
	format(block, size, "%.*s", (int)(to + 1 - from), from);
	*at = to + 4;
	return true;
}

/* A section's text, without its heading. */
static void copy_section(const char *heading, char *text, size_t size)
{
	const char *from = strstr(readme, heading);
	assert_non_null(from);
	from += strlen(heading);
	const char *to = strstr(from, "\n## ");
	format(text, size, "%.*s", to ? (int)(to - from) : (int)strlen(from), from);
}

/* Runs a line in the folder. */
static int run_there(const char *line)
{
	char text[3000];
	format(text, sizeof text,
		"cd $D; PATH=\"$D/build:$PATH\"; cc() { "
		"command ${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Werror $CAROM_SANITIZERS \"$@\"; }; %s",
		line);
	return shell(text);
}

/* ---- The example ---- */

static void write_example(char *wanted, size_t size)
{
	char source[8192], path[128];
	const char *at = readme;
	assert_true(next_block(&at, "c", source, sizeof source));
	assert_true(next_block(&at, "text", wanted, size));
	format(path, sizeof path, "%s/example.c", call.folder);
	FILE *file = fopen(path, "w");
	assert_non_null(file);
	fputs(source, file);
	assert_int_equal(fclose(file), 0);
}

static void the_example_prints_what_is_said(void **state)
{
	static const char compile[] = "\n    cc -Iinclude ";
	char wanted[4096], line[1024];
	int ways = 0;
	(void)state;
	write_example(wanted, sizeof wanted);
	for (const char *at = strstr(readme, compile); at; at = strstr(at + 1, compile)) {
		format(line, sizeof line, "%.*s && ./example", (int)strcspn(at + 1, "\n"), at + 1);
		if (run_there(line) != 0 || strcmp(call.out, wanted) != 0)
			fail_msg("%s\nprinted \"%s%s\", README.md says \"%s\"", line, call.out, call.err, wanted);
		ways++;
	}
	assert_int_equal(ways, 2);
}

/* ---- The command ---- */

/* A line "$ command" and what must come of it; answers what follows it in the block. */
static const char *check_line(const char *path, const char *at)
{
	char line[2048], wanted[8192];
	const char *output = at + strcspn(at, "\n") + 1;
	format(line, sizeof line, "{ %.*s; } 2>&1", (int)(output - at) - 3, at + 2);
	const char *end = strncmp(output, "$ ", 2) == 0 ? output : strstr(output, "\n$ ");
	end = !end ? output + strlen(output) : end == output ? end : end + 1;
	format(wanted, sizeof wanted, "%.*s", (int)(end - output), output);
	run_there(line);
	if (strcmp(call.out, wanted) != 0)
		fail_msg("%s\nprinted \"%s\", %s says \"%s\"", line, call.out, path, wanted);
	return end;
}

static void the_command_prints_what_is_said(void **state)
{
	char block[8192];
	int lines = 0;
	(void)state;
	for (size_t k = 0; k < document_count; k++) {
		const char *at = documents[k].text;
		while (next_block(&at, "console", block, sizeof block)) {
			for (const char *line = block; *line; lines++)
				line = check_line(documents[k].path, line);
		}
	}
	assert_true(lines >= 5);
}

/* Whether "--name" is in the help of that command, or, where it is NULL, of any. */
static bool is_option(const char *command, const char *name)
{
	char option[64];
	format(option, sizeof option, "\n  --%s ", name);
	for (size_t k = 0; k < command_count; k++) {
		if ((!command || strcmp(command, commands[k].name) == 0) && strstr(commands[k].help, option))
			return true;
	}
	return false;
}

/* The subcommand that this line calls before `option`; NULL for none. */
static const char *command_before(const char *line, const char *option)
{
	char words[64];
	for (size_t k = 0; k < command_count; k++) {
		format(words, sizeof words, "carom %s ", commands[k].name);
		const char *at = strstr(line, words);
		if (at && at < option)
			return commands[k].name;
	}
	return NULL;
}

/* The head of tools/bootstrap has a line for each. */
static bool is_option_of_bootstrap(const char *line, const char *at, const char *name)
{
	const char *script = strstr(line, "tools/bootstrap --");
	char head[80];
	format(head, sizeof head, "\n# --%s: ", name);
	return script && script < at && strstr(bootstrap, head);
}

static void check_options(const char *path, const char *line)
{
	char name[64];
	for (const char *at = strstr(line, "--"); at; at = strstr(at + 2, "--")) {
		const char *command = command_before(line, at);
		if (sscanf(at, "--%63[a-z]", name) == 1 && !is_option(command, name) && !is_option_of_bootstrap(line, at, name))
			fail_msg("%s has --%s, which `carom %s` does not know: %s", path, name, command ? command : "COMMAND", line);
	}
}

static void every_option_shown_exists(void **state)
{
	(void)state;
	char line[1024];
	for (size_t k = 0; k < document_count; k++) {
		for (const char *at = documents[k].text; *at; at += at[strcspn(at, "\n")] ? strcspn(at, "\n") + 1 : strlen(at)) {
			format(line, sizeof line, "%.*s", (int)strcspn(at, "\n"), at);
			if (!strstr(line, "pkg-config") && !strstr(line, "|---"))
				check_options(documents[k].path, line);
		}
	}
}

static void every_command_is_described(void **state)
{
	(void)state;
	char words[64];
	assert_true(command_count >= 4);
	for (size_t k = 0; k < command_count; k++) {
		format(words, sizeof words, "carom %s", commands[k].name);
		if (!strstr(readme, words))
			fail_msg("README.md does not tell of `%s`", words);
		format(words, sizeof words, "carom %s\n", commands[k].name);
		if (!strstr(manual, words))
			fail_msg("tools/carom.1 does not tell of `%s`", words);
	}
}

static void the_manual_has_every_option_and_no_other(void **state)
{
	(void)state;
	char name[64], option[80];
	for (size_t k = 0; k < command_count; k++) {
		for (const char *at = strstr(commands[k].help, "\n  --"); at; at = strstr(at + 1, "\n  --")) {
			assert_int_equal(sscanf(at, "\n  --%63[a-z]", name), 1);
			format(option, sizeof option, "\\-\\-%s", name);
			if (!strstr(manual, option))
				fail_msg("tools/carom.1 lacks --%s of `carom %s`", name, commands[k].name);
		}
	}
	for (const char *at = strstr(manual, "\\-\\-"); at; at = strstr(at + 1, "\\-\\-")) {
		if (sscanf(at, "\\-\\-%63[a-z]", name) == 1 && !is_option(NULL, name))
			fail_msg("tools/carom.1 has --%s, which no command knows", name);
	}
}

/* ---- The pipeline ---- */

/* A row of the table of slots, as far as it names them. */
static void format_row(const carom_stage_info *info, char *row, size_t size)
{
	format(row, size, "\n| `%s` | `%s`%s |", info->slot, info->alternative, info->is_default ? " (default)" : "");
}

static void the_table_of_slots_is_what_there_is(void **state)
{
	(void)state;
	char section[16384], row[128];
	carom_stage_info info;
	size_t rows = 0, known = 0;
	copy_section("\n## Pipeline\n", section, sizeof section);
	for (const char *at = strstr(section, "\n| `"); at; at = strstr(at + 1, "\n| `"))
		rows++;
	for (; carom_stage_list(known, &info); known++) {
		format_row(&info, row, sizeof row);
		if (!strstr(section, row))
			fail_msg("README.md lacks the row%s", row);
	}
	assert_int_equal(rows, known);
}

/* ---- Scenes ---- */

static void every_scene_shown_is_one(void **state)
{
	(void)state;
	char block[8192];
	const char *at = readme;
	carom_error error;
	int scenes = 0;
	for (; next_block(&at, "json", block, sizeof block); scenes++) {
		carom_scene *scene = NULL;
		carom_world *world = NULL;
		if (carom_scene_parse(block, strlen(block), "README.md", &scene, &error) || carom_scene_create_world(scene, &world, &error)
			|| carom_world_step(world, 100, NULL, &error))
			fail_msg("%s", error.text);
		carom_world_destroy(world);
		carom_scene_destroy(scene);
	}
	assert_true(scenes > 0);
}

/* The reader tells what it allows where it finds a key it doesn't know: "...; allowed: a, b, c". */
static void check_keys(const char *scene, const char *header)
{
	char section[16384], row[80], *key, *rest = NULL;
	carom_error error = {0};
	carom_scene *made = NULL;
	int keys = 0, rows = 0;
	copy_section(header, section, sizeof section);
	*strstr(section, "\n\n") = '\0';
	assert_int_equal(carom_scene_parse(scene, strlen(scene), "scene", &made, &error), CAROM_INVALID_SCENE);
	key = strstr(error.text, "allowed: ");
	assert_non_null(key);
	for (key = strtok_r(key + strlen("allowed: "), ", ", &rest); key; key = strtok_r(NULL, ", ", &rest), keys++) {
		format(row, sizeof row, "\n| `%.60s` | ", key);
		if (!strstr(section, row))
			fail_msg("README.md lacks the key %s in the table%s", key, header);
	}
	for (const char *at = strstr(section, "\n| `"); at; at = strstr(at + 1, "\n| `"))
		rows++;
	assert_int_equal(rows, keys);
}

static void the_tables_of_keys_are_the_readers(void **state)
{
	(void)state;
	check_keys("{\"format\": \"carom-scene/1\", \"bodies\": [], \"?\": 0}", "\n| key of the scene |");
	check_keys("{\"format\": \"carom-scene/1\", \"bodies\": [{\"?\": 0}]}", "\n| key of a body |");
	check_keys("{\"format\": \"carom-scene/1\", \"bodies\": [{\"joints\": [{\"?\": 0}]}]}", "\n| key of a joint |");
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(the_example_prints_what_is_said), cmocka_unit_test(the_command_prints_what_is_said),
		cmocka_unit_test(every_option_shown_exists), cmocka_unit_test(every_command_is_described),
		cmocka_unit_test(the_manual_has_every_option_and_no_other), cmocka_unit_test(the_table_of_slots_is_what_there_is),
		cmocka_unit_test(every_scene_shown_is_one), cmocka_unit_test(the_tables_of_keys_are_the_readers)};
	return cmocka_run_group_tests_name("readme", tests, set_up, remove_folder);
}
