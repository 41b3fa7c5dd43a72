/* Build helper: writes the kernels as one C source, so that the library needs no files at run time.
 *
 * SPDX-License-Identifier: MIT
 *
 * embed OUT FILE...
 * FILE is kernels/SLOT/NAME.cl or kernels/NAME.h. The table is sorted by path. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int complain(const char *what, const char *path)
{
	fprintf(stderr, "embed: %s: ", path);
	perror(what);
	return 1;
}

static int compare_paths(const void *a, const void *b)
{
	return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Numbers, because compilers may limit the length of a string literal. Octal above 127, where a plain number would not
 * fit into a char that is signed, or a negative one into a char that isn't. */
static int write_text(FILE *out, size_t index, const char *path)
{
	FILE *in = fopen(path, "rb");
	if (!in)
		return complain("can't be opened", path);
	fprintf(out, "\nstatic const char text_%zu[] = {", index);
	int c;
	for (size_t count = 0; (c = getc(in)) != EOF && c != 0; count++) {
		fputs(count % 24 == 0 ? "\n\t" : " ", out);
		fprintf(out, c < 128 ? "%d," : "'\\%o',", (unsigned)c);
	}
	fputs("\n\t0\n};\n", out);
	if (c == 0)
		fprintf(stderr, "embed: %s: holds a NUL byte, so it is no kernel\n", path);
	int failed = ferror(in) ? complain("can't be read", path) : c == 0;
	fclose(in);
	return failed;
}

static int write_row(FILE *out, size_t index, const char *path)
{
	const char *name = strrchr(path, '/');
	const char *slot = strchr(path, '/');
	const char *end = strrchr(path, '.');
	if (!name || !end || end < name) {
		fprintf(stderr, "embed: %s: want kernels/SLOT/NAME.cl or kernels/NAME.h\n", path);
		return 1;
	}
	int slot_length = slot == name ? 0 : (int)(name - slot - 1);
	int name_length = (int)(end - name - 1);
	fprintf(out, "\t{\"%.*s\", \"%.*s\", ", slot_length, slot + 1, name_length, name + 1);
	fprintf(out, "\"%s\", text_%zu},\n", path, index);
	return 0;
}

static int write_source(FILE *out, size_t count, char **paths)
{
	int failed = 0;
	fputs("#include \"cl/kernels.h\"\n", out);
	for (size_t i = 0; i < count; i++)
		failed |= write_text(out, i, paths[i]);
	fputs("\nconst carom_kernel_source carom_kernel_sources[] = {\n", out);
	for (size_t i = 0; i < count; i++)
		failed |= write_row(out, i, paths[i]);
	fprintf(out, "\t{NULL, NULL, NULL, NULL},\n};\n\nconst size_t carom_kernel_source_count = %zu;\n", count);
	return failed;
}

int main(int argc, char **argv)
{
	if (argc < 2) {
		fputs("usage: embed OUT FILE...\n", stderr);
		return 2;
	}
	size_t count = (size_t)argc - 2;
	char **paths = argv + 2;
	qsort(paths, count, sizeof *paths, compare_paths);
	FILE *out = fopen(argv[1], "wb");
	if (!out)
		return complain("can't be written", argv[1]);
	int failed = write_source(out, count, paths);
	failed |= ferror(out);
	if (fclose(out) != 0 || failed) {
		fprintf(stderr, "embed: %s: not written\n", argv[1]);
		remove(argv[1]);
		return 1;
	}
	return 0;
}
