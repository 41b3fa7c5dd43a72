/* What the tests of carom bench share: the CSV it writes, and its charts.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_BENCH_H
#define CAROM_TESTS_BENCH_H

#include "command.h"

#include <math.h>
#include <png.h>

#define FIELDS 23
#define FAST "--runs 2 --seconds 0.0001 --quiet"

enum field {
	VERSION,
	TABLE,
	PART,
	DEVICE,
	STORAGE,
	BODIES,
	SHAPE,
	ALTERNATIVE,
	PIPELINE,
	ITERATIONS,
	RUN,
	REPETITIONS,
	LAUNCHES,
	SECONDS,
	PER_1000,
	PAPER,
	DRIFT,
	OVERLAP,
	COPY_RATE,
	SPEED,
	PASSED,
	OFF,
	HITS
};

/* ---- CSV ---- */

static char text[1 << 20];

struct csv {
	size_t rows;
	char *at[512][FIELDS];
};

static struct csv csv;

/* Cuts the field at `at` off, quotes removed; answers what follows its comma or newline. */
static inline char *cut_field(char *at, char **field, char *end)
{
	char *to = at;
	bool quoted = *at == '"';
	*field = at;
	at += quoted;
	while (*at && (quoted || (*at != ',' && *at != '\n'))) {
		if (quoted && *at == '"' && *++at != '"')
			break;
		*to++ = *at++;
	}
	*end = *at;
	if (*at != ',' && *at != '\n')
		fail_msg("a field that does not end: %.40s", *field);
	*to = '\0';
	return at + 1;
}

static inline void read_csv(const char *name)
{
	char path[128], end = 0;
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	text[fread(text, 1, sizeof text - 1, file)] = '\0';
	fclose(file);
	csv.rows = 0;
	for (char *at = text; *at; csv.rows++) {
		assert_true(csv.rows < COUNT(csv.at));
		for (size_t k = 0; k < FIELDS; k++) {
			at = cut_field(at, &csv.at[csv.rows][k], &end);
			assert_true(end == (k + 1 < FIELDS ? ',' : '\n'));
		}
	}
}

static inline double number(size_t row, enum field field)
{
	char *end = NULL;
	double value = strtod(csv.at[row][field], &end);
	if (!*csv.at[row][field] || *end || !(value >= 0))
		fail_msg("row %zu, field %d: \"%s\" is no figure", row, (int)field, csv.at[row][field]);
	return value;
}

/* How many rows have that in the field. */
static inline size_t count(enum field field, const char *value)
{
	size_t found = 0;
	for (size_t row = 1; row < csv.rows; row++)
		found += strcmp(csv.at[row][field], value) == 0;
	return found;
}

/* ---- Charts ---- */

static inline void check_chart(const char *name)
{
	char path[128];
	png_image image = {.version = PNG_IMAGE_VERSION};
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	if (!png_image_begin_read_from_file(&image, path))
		fail_msg("%s: %s", name, image.message);
	image.format = PNG_FORMAT_GRAY;
	uint8_t *pixels = malloc(PNG_IMAGE_SIZE(image));
	assert_non_null(pixels);
	assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
	assert_true(image.width >= 800 && image.height >= 400);
	double sum = 0, squares = 0, all = (double)image.width * image.height;
	for (size_t k = 0; k < PNG_IMAGE_SIZE(image); k++) {
		sum += pixels[k];
		squares += (double)pixels[k] * pixels[k];
	}
	double mean = sum / all, variance = squares / all - mean * mean;
	if (mean < 200 || variance < 20)
		fail_msg("%s: a mean of %g and a variance of %g", name, mean, variance);
	free(pixels);
}

/* A build with CAIRO=no says so at once. */
static inline bool has_charts(void)
{
	if (shell("$C bench table1 --sizes 12 --plot $D/none.png --device cpu --runs 1 --seconds 0.0001 --quiet") == 0)
		return true;
	if (!strstr(call.err, "built without cairo"))
		fail_msg("%s", call.err);
	if (getenv("CAROM_NO_SKIP"))
		fail_msg("%s", call.err);
	print_message("SKIPPED charts: %s", call.err);
	return false;
}

#endif
