/* The main of a fuzz target without libFuzzer: runs it on the files named, or on its corpus, as `make check` does.
 * SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <dirent.h>
#include <stdlib.h>

/* A buffer just as long as the file, for the sanitizers to see a look beyond. */
static bool replay(const char *path)
{
	FILE *file = fopen(path, "rb");
	if (!file || fseek(file, 0, SEEK_END) != 0) {
		fprintf(stderr, "%s: can't be read\n", path);
		return false;
	}
	const long size = ftell(file);
	uint8_t *data = malloc(size > 0 ? (size_t)size : 1);
	rewind(file);
	bool is_read = data && size >= 0 && fread(data, 1, (size_t)size, file) == (size_t)size;
	fclose(file);
	if (is_read)
		LLVMFuzzerTestOneInput(data, (size_t)size);
	free(data);
	return is_read;
}

static size_t replay_corpus(const char *folder)
{
	char path[512];
	size_t count = 0;
	DIR *listing = opendir(folder);
	struct dirent *entry;
	while (listing && (entry = readdir(listing))) {
		if (entry->d_name[0] == '.')
			continue;
		snprintf(path, sizeof path, "%s/%.255s", folder, entry->d_name);
		if (!replay(path))
			exit(1);
		count++;
	}
	if (listing)
		closedir(listing);
	return count;
}

int main(int argc, char **argv)
{
	char folder[64];
	LLVMFuzzerInitialize(&argc, &argv);
	for (int k = 1; k < argc; k++) {
		if (!replay(argv[k]))
			return 1;
	}
	if (argc > 1)
		return 0;
	snprintf(folder, sizeof folder, "tests/corpus/%.32s", fuzz_name);
	const size_t count = replay_corpus(folder);
	printf("%zu inputs of %s\n", count, folder);
	return count > 0 ? 0 : 1;
}
