/* carom bench: that it measures what it says, and what it writes. The figures themselves are the machine's.
 * SPDX-License-Identifier: MIT */
#include "bench.h"

static void check_row(size_t row, double bodies)
{
	assert_true(number(row, BODIES) == bodies && number(row, SECONDS) > 0 && number(row, REPETITIONS) >= 10);
	assert_true(number(row, RUN) == (double)(1 + (row - 1) % 2));
	assert_true(fabs(number(row, PER_1000) * number(row, REPETITIONS) / (1000 * number(row, SECONDS)) - 1) < 1e-6);
	assert_true(*csv.at[row][DEVICE] && strstr(csv.at[row][PIPELINE], "step=first_impact aabb=tight overlap=all_pairs"));
	assert_true(strcmp(csv.at[row][SHAPE], "circle") == 0 || strcmp(csv.at[row][SHAPE], "triangle") == 0);
}

/* ---- Tests ---- */

static void all_tables_are_measured(void **state)
{
	(void)state;
	static const struct {
		const char *table, *title;
		size_t figures;
	} tables[] = {
		{"table1", "Table 1: ", 2}, {"table2", "Table 2: ", 4}, {"table3", "Table 3: ", 12}, {"table4", "Table 4: ", 8}, {"table5", "Table 5: ", 9}};
	char line[256], name[32];
	bool charts = has_charts();
	snprintf(line, sizeof line, "$C bench all --device cpu --sizes 12 " FAST " --csv $D/t.csv %s", charts ? "--plot $D/p.q.png" : "");
	check(line, 0, NULL);
	assert_string_equal(call.err, "");
	read_csv("t.csv");
	assert_int_equal(count(VERSION, carom_version()), csv.rows - 1);
	assert_int_equal(count(TABLE, "scale") + count(TABLE, "tunnel") + count(TABLE, "heap") + count(TABLE, "rays"), 0);
	for (size_t row = 1; row < csv.rows; row++)
		check_row(row, 12);
	for (size_t k = 0; k < COUNT(tables); k++) {
		assert_non_null(strstr(call.out, tables[k].title));
		assert_int_equal(count(TABLE, tables[k].table), 2 * tables[k].figures);
		snprintf(name, sizeof name, "p.q-%s.png", tables[k].table);
		if (charts)
			check_chart(name);
	}
	assert_int_equal(count(STORAGE, "memory"), csv.rows - 1);
	assert_non_null(strstr(call.out, "What is named OpenCL was left out"));
}

/* The chart's strip below its only panel, with the numbers of bodies: so many pixels of it are dark. */
static size_t read_labels(const char *name, uint8_t *strip, size_t size)
{
	char path[128];
	png_image image = {.version = PNG_IMAGE_VERSION};
	size_t dark = 0;
	snprintf(path, sizeof path, "%s/%s", call.folder, name);
	assert_true(png_image_begin_read_from_file(&image, path));
	image.format = PNG_FORMAT_GRAY;
	uint8_t *pixels = malloc(PNG_IMAGE_SIZE(image));
	assert_non_null(pixels);
	assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL) && image.height > 141 && size == 20 * image.width);
	memcpy(strip, pixels + (image.height - 141) * image.width, size);
	for (size_t k = 0; k < size; k++)
		dark += strip[k] < 128;
	free(pixels);
	return dark;
}

/* Sizes may be asked for in any order; the chart has them in theirs, all with a label. */
static void charts_are_in_the_order_of_bodies(void **state)
{
	(void)state;
	static uint8_t rising[20 * 1696], falling[20 * 1696];
	if (!has_charts())
		return;
	check("$C bench table1 --device cpu --sizes 8,64 " FAST " --plot $D/rising.png", 0, "");
	check("$C bench table1 --device cpu --sizes 64,8 " FAST " --plot $D/falling.png", 0, "");
	assert_true(read_labels("rising.png", rising, sizeof rising) > 20);
	read_labels("falling.png", falling, sizeof falling);
	assert_memory_equal(rising, falling, sizeof rising);
}

/* Where the paper's step keeps its textures on the first OpenCL device by itself. */
static bool uses_images(void)
{
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	carom_device_info info;
	def.device = "opencl";
	def.pipeline.step = "first_impact";
	assert_int_equal(carom_world_create(&def, &world, NULL), CAROM_OK);
	assert_int_equal(carom_world_get_device(world, &info, NULL), CAROM_OK);
	carom_world_destroy(world);
	return info.uses_images;
}

static void opencl_has_its_columns(void **state)
{
	(void)state;
	if (!has_opencl())
		return;
	check("$C bench table4 --device opencl --storage buffer --sizes 12 " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 1 + 2 * 16);
	assert_int_equal(count(STORAGE, "buffer"), 2 * 8);
	assert_int_equal(count(STORAGE, "memory"), 2 * 8);
	assert_int_equal(count(ALTERNATIVE, "OpenCL-bisection"), 2 * 4);
	assert_non_null(strstr(call.out, "textures in buffers"));
	check("$C bench table5 --device opencl --sizes 12 " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(count(STORAGE, uses_images() ? "image" : "buffer"), csv.rows - 1);
	assert_non_null(strstr(call.out, uses_images() ? "textures in images" : "textures in buffers"));
	assert_non_null(strstr(call.out, "OpenCL's, by profiling events"));
}

/* The figure of that alternative in run 1; NULL for none. */
static const char *paper_of(const char *bodies, const char *alternative)
{
	for (size_t row = 1; row < csv.rows; row++) {
		if (strcmp(csv.at[row][BODIES], bodies) == 0 && strcmp(csv.at[row][ALTERNATIVE], alternative) == 0)
			return csv.at[row][PAPER];
	}
	return NULL;
}

static void the_papers_figures_stand_beside_its_sizes(void **state)
{
	(void)state;
	check("$C bench table2 --device cpu --sizes 100,256,512 " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 1 + 2 * 3 * 4);
	assert_string_equal(paper_of("256", "classic"), "1.422");
	assert_string_equal(paper_of("512", "four_six"), "1.438");
	assert_string_equal(paper_of("512", "tiled"), "");
	assert_string_equal(paper_of("100", "six"), "");
	assert_non_null(strstr(call.out, "1.42"));
	assert_non_null(strstr(call.out, "10, scaled"));
}

static void launches_and_settings_are_told(void **state)
{
	(void)state;
	check("$C bench table1 --device cpu --sizes 20 --set inside=orourke " FAST " --csv $D/t.csv", 0, "");
	read_csv("t.csv");
	assert_int_equal(csv.rows, 5);
	for (size_t row = 1; row < csv.rows; row++) {
		bool outside = strcmp(csv.at[row][ALTERNATIVE], "outside") == 0;
		assert_non_null(strstr(csv.at[row][PIPELINE], " inside=orourke toi=bisection "));
		assert_true(number(row, ITERATIONS) == (outside ? 1 : 0));
		assert_true(number(row, LAUNCHES) == number(row, REPETITIONS) * (outside ? 18 : 1));
	}
}

static void wrong_calls_exit_with_2(void **state)
{
	(void)state;
	static const struct {
		const char *line, *said;
	} calls[] = {
		{"$C bench table6", "table6: no such table; allowed: table1, table2, table3, table4, table5, scale, tunnel, heap, rays, all"},
		{"$C bench table1 table2", "one argument too many"},
		{"$C bench table1 --runs 0", "--runs: found \"0\"; allowed: a whole number from 1 to 99"},
		{"$C bench table1 --runs 100", "allowed: a whole number from 1 to 99"},
		{"$C bench table1 --seconds 0", "--seconds: found \"0\"; allowed: a number above 0"},
		{"$C bench table1 --sizes 7", "--sizes: found \"7\"; allowed: at most 16 numbers of bodies, 8 to 1048576"},
		{"$C bench table1 --sizes 8,", "--sizes: found \"8,\""},
		{"$C bench table1 --sizes 8,,9", "--sizes: found \"8,,9\""},
		{"$C bench table1 --sizes 1048577", "--sizes: found \"1048577\""},
		{"$C bench table1 --sizes 9,9,9,9,9,9,9,9,9,9,9,9,9,9,9,9,9", "at most 16 numbers"},
		{"$C bench table1 --sizes 12 --device nowhere", "nowhere"},
		{"$C bench scale --sizes 12 --device nowhere", "nowhere"},
		{"$C bench scale --set step=guess", "--set: the slot 'step' has no alternative 'guess'"},
		{"$C bench table1 --sizes 12 " FAST " --set step=events", "table1 can't be measured: --set: found step=events; allowed: step=first_impact"},
		{"$C bench table2 --sizes 12 " FAST " --set step=contacts",
			"table2 can't be measured: --set: found step=contacts; allowed: step=first_impact"},
		{"$C bench table3 --sizes 12 " FAST " --set step=events", "table3 can't be measured: --set: found step=events; allowed: step=first_impact"},
		{"$C bench table4 --sizes 12 " FAST " --set step=events", "table4 can't be measured: --set: found step=events; allowed: step=first_impact"},
		{"$C bench table5 --sizes 12 " FAST " --set step=events", "table5 can't be measured: --set: found step=events; allowed: step=first_impact"},
		{"$C bench all --sizes 12 " FAST " --set step=events", "table1 can't be measured: --set: found step=events; allowed: step=first_impact"},
		{"$C bench tunnel --set step=first_impact", "tunnel can't be measured: --set: found step=first_impact; allowed: step=events"},
		{"$C bench tunnel --device nowhere", "nowhere"},
		{"$C bench heap --set step=events", "heap can't be measured: --set: found step=events; it measures contacts and events"},
		{"$C bench heap --sizes 12 --device nowhere", "nowhere"},
		{"$C bench scale --runs 0", "--runs: found \"0\""},
		{"$C bench table1 --set reduce=guess", "--set: the slot 'reduce' has no alternative 'guess'"},
	};
	for (size_t k = 0; k < COUNT(calls); k++)
		check(calls[k].line, 2, calls[k].said);
}

/* Before anything is measured. */
static void files_that_cannot_be_written_fail(void **state)
{
	(void)state;
	check("$C bench table4 --csv $D/nowhere/t.csv --device cpu", 1, "nowhere/t.csv");
	assert_string_equal(call.out, "");
	check("$C bench table1 --sizes 12 --csv $D/left.csv --device nowhere; test ! -e $D/left.csv", 0, NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(all_tables_are_measured), cmocka_unit_test(opencl_has_its_columns),
		cmocka_unit_test(the_papers_figures_stand_beside_its_sizes), cmocka_unit_test(launches_and_settings_are_told),
		cmocka_unit_test(charts_are_in_the_order_of_bodies), cmocka_unit_test(wrong_calls_exit_with_2),
		cmocka_unit_test(files_that_cannot_be_written_fail)};
	return cmocka_run_group_tests_name("bench", tests, make_folder, remove_folder);
}
