/* carom bench scale, tunnel, heap and rays: Carom beside other engines. The figures themselves are the machine's and theirs.
 * SPDX-License-Identifier: MIT */
#include "bench.h"

/* Measures the table and reads what it wrote, which is of nothing else. */
static void read_table(const char *table, const char *options)
{
	char line[256];
	snprintf(line, sizeof line, "$C bench %s --quiet --csv $D/t.csv %s", table, options);
	check(line, 0, NULL);
	assert_string_equal(call.err, "");
	read_csv("t.csv");
	assert_int_equal(count(TABLE, table), csv.rows - 1);
}

/* ---- scale ---- */

/* The engines beside Carom that are in this build: what it says of those that are not. */
static size_t count_peers(void)
{
	static const char *const names[] = {"Box2D", "Chipmunk"};
	char line[64];
	size_t found = 0;
	for (size_t k = 0; k < COUNT(names); k++) {
		snprintf(line, sizeof line, "\n%s: not in this build", names[k]);
		bool is_there = !strstr(call.out, line);
		snprintf(line, sizeof line, "\n%s ", names[k]);
		assert_true(is_there == (strstr(call.out, line) != NULL));
		assert_true(is_there == (count(ALTERNATIVE, names[k]) > 0));
		found += is_there;
	}
	return found;
}

/* 12 bodies are the most that were measured, so it is told of them what is kept. */
static void check_kept(size_t row)
{
	char *end = NULL;
	bool ours = strncmp(csv.at[row][ALTERNATIVE], "Carom", 5) == 0;
	double drift = strtod(csv.at[row][DRIFT], &end);
	assert_true(end != csv.at[row][DRIFT] && !*end && number(row, BODIES) == 12 && number(row, REPETITIONS) == 1000);
	assert_true(ours ? fabs(drift) < 1e-4 && number(row, OVERLAP) < 1e-4 : drift > -1 && number(row, OVERLAP) < 1);
	assert_true(number(row, RUN) == 1 && number(row, SECONDS) > 0);
}

static void check_scale_row(size_t row, const char *step)
{
	char setting[64];
	bool ours = strncmp(csv.at[row][ALTERNATIVE], "Carom", 5) == 0;
	snprintf(setting, sizeof setting, "step=%s ", step);
	assert_true(ours == (strncmp(csv.at[row][PIPELINE], setting, strlen(setting)) == 0));
	assert_true(*csv.at[row][DEVICE] && *csv.at[row][PIPELINE] && !*csv.at[row][PAPER]);
	assert_true(strcmp(csv.at[row][SHAPE], "circle") == 0 || strcmp(csv.at[row][SHAPE], "triangle") == 0);
	assert_true(number(row, COPY_RATE) > 1e6 && number(row, LAUNCHES) == 0);
	assert_true(fabs(number(row, PER_1000) * number(row, REPETITIONS) / (1000 * number(row, SECONDS)) - 1) < 1e-6);
	if (strstr(csv.at[row][PART], ", kept")) {
		check_kept(row);
		return;
	}
	assert_true(!strstr(csv.at[row][PART], ", a picture") || (ours && number(row, REPETITIONS) == 1));
	assert_true(number(row, BODIES) == 8 || number(row, BODIES) == 12);
	assert_true(number(row, SECONDS) > 0 && number(row, REPETITIONS) >= 1 && number(row, RUN) >= 1 && number(row, RUN) <= 2);
	assert_true(!*csv.at[row][DRIFT] && !*csv.at[row][OVERLAP]);
}

/* Two shapes, two sizes, two runs, with a picture of Carom's behind each, and a row of what is kept. */
static void check_scale(const char *options, const char *step, size_t devices)
{
	char line[256];
	snprintf(line, sizeof line, "--sizes 8,12 " FAST " %s", options);
	read_table("scale", line);
	assert_int_equal(csv.rows, 1 + 2 * devices * (2 * 2 * 2 + 1) + 2 * count_peers() * (2 * 2 + 1));
	assert_int_equal(count(VERSION, carom_version()), csv.rows - 1);
	for (size_t row = 1; row < csv.rows; row++)
		check_scale_row(row, step);
	assert_int_equal(count(ALTERNATIVE, "Carom, CPU fallback"), 2 * 9);
	assert_int_equal(count(ALTERNATIVE, "Carom, OpenCL"), (devices - 1) * 2 * 9);
	assert_int_equal(count(PART, "circles, a picture"), devices * 2 * 2);
	assert_non_null(strstr(call.out, "kept in 1000 steps of 12 bodies"));
}

static void scale_is_measured(void **state)
{
	(void)state;
	check_scale("--device cpu --set step=first_impact", "first_impact", 1);
	assert_non_null(strstr(call.out, "can't be compared"));
	if (has_opencl()) {
		check_scale("--device opencl --storage buffer --set step=first_impact", "first_impact", 2);
		assert_int_equal(count(STORAGE, "buffer"), 2 * 9);
	}
	check_scale("--device cpu", "events", 1);
	assert_null(strstr(call.out, "can't be compared"));
}

static void scale_has_a_chart(void **state)
{
	(void)state;
	if (!has_charts())
		return;
	check("$C bench scale --device cpu --sizes 8,12,20 --set step=first_impact " FAST " --plot $D/scale.png", 0, "");
	check_chart("scale.png");
}

/* What does not fit is left out, and that is said. */
static void scale_goes_on_without_what_does_not_fit(void **state)
{
	(void)state;
	check("$C bench scale --device cpu --sizes 12,262144 --set step=first_impact " FAST " --csv $D/t.csv", 0, "");
	assert_non_null(strstr(call.out, "  262144  Carom, CPU fallback           -  left out: "));
	read_csv("t.csv");
	assert_int_equal(count(BODIES, "262144"), 0);
	assert_true(count(BODIES, "12") > 0);
}

/* ---- tunnel ---- */

/* In Carom none passes; Chipmunk looks at no time between two steps, so that there a wall is flown over. */
static void check_tunnel_row(size_t row)
{
	const bool pairs = strcmp(csv.at[row][PART], "pairs") == 0;
	const double drift = strtod(csv.at[row][DRIFT], NULL), passed = number(row, PASSED);
	assert_true(number(row, BODIES) == 16 && number(row, REPETITIONS) == 60 && number(row, SPEED) >= 1 && number(row, SECONDS) > 0);
	assert_true(passed <= (pairs ? 8 : 16) && drift >= -1 && *csv.at[row][PIPELINE]);
	assert_true(pairs ? number(row, OFF) < 20 : !*csv.at[row][OFF]);
	if (strncmp(csv.at[row][ALTERNATIVE], "Carom", 5) == 0)
		assert_true(passed == 0 && fabs(drift) < 1e-5 && (!pairs || number(row, OFF) < 1e-5 * number(row, SPEED)));
	if (strcmp(csv.at[row][ALTERNATIVE], "Chipmunk") == 0 && number(row, SPEED) == 1000)
		assert_true(passed > 0);
}

static void check_tunnel(const char *options, size_t devices)
{
	read_table("tunnel", options);
	const size_t bullets = count(ALTERNATIVE, "Box2D, bullets");
	assert_int_equal(csv.rows, 1 + 12 * (devices + count_peers()) + bullets);
	assert_int_equal(bullets, count(ALTERNATIVE, "Box2D"));
	assert_int_equal(count(PART, "wall"), count(PART, "pairs"));
	assert_int_equal(count(SPEED, "1000"), (csv.rows - 1) / 6);
	assert_int_equal(count(ALTERNATIVE, "Carom, OpenCL"), 12 * (devices - 1));
	for (size_t row = 1; row < csv.rows; row++)
		check_tunnel_row(row);
}

static void nothing_of_ours_tunnels(void **state)
{
	(void)state;
	check_tunnel("--device cpu", 1);
	if (has_opencl())
		check_tunnel("--device opencl --storage image", 2);
	if (has_charts())
		check("$C bench tunnel --device cpu --plot $D/tunnel.png", 2, "tunnel can't be measured: --plot: it has no chart");
}

/* ---- heap ---- */

static void check_heap_row(size_t row)
{
	const bool ours = strncmp(csv.at[row][ALTERNATIVE], "Carom", 5) == 0, lying = strstr(csv.at[row][PART], ", lying") != NULL;
	assert_true(number(row, BODIES) == 8 && number(row, REPETITIONS) == (lying ? 120 : 180) && number(row, SECONDS) > 0);
	assert_true(number(row, RUN) >= 1 && number(row, RUN) <= 2 && *csv.at[row][PIPELINE]);
	assert_true((*csv.at[row][OVERLAP] != 0) == lying && (*csv.at[row][HITS] != 0) == (lying && ours));
	if (ours && lying)
		assert_true(number(row, OVERLAP) < 1e-4);
}

/* Of the rows lying of an engine. */
static double hits_of(const char *engine)
{
	double sum = 0;
	for (size_t row = 1; row < csv.rows; row++)
		sum += *csv.at[row][HITS] && strcmp(csv.at[row][ALTERNATIVE], engine) == 0 ? number(row, HITS) : 0;
	return sum;
}

/* Three heaps, two runs, falling and lying. Hits are fewer where forces bear what lies, and the same on both devices. */
static void check_heap(const char *options, size_t devices)
{
	char line[128];
	snprintf(line, sizeof line, "--sizes 8 --runs 2 %s", options);
	read_table("heap", line);
	assert_int_equal(csv.rows, 1 + 12 * (devices + 1 + count_peers()));
	for (size_t row = 1; row < csv.rows; row++)
		check_heap_row(row);
	assert_true(hits_of("Carom, CPU fallback, contacts") < 0.5 * hits_of("Carom, CPU fallback, events"));
	if (devices > 1)
		assert_true(hits_of("Carom, OpenCL, contacts") == hits_of("Carom, CPU fallback, contacts"));
}

static void heaps_are_measured(void **state)
{
	(void)state;
	check_heap("--device cpu", 1);
	if (has_opencl())
		check_heap("--device opencl", 2);
	if (has_charts())
		check("$C bench heap --device cpu --plot $D/heap.png", 2, "heap can't be measured: --plot: it has no chart");
}

/* ---- rays ---- */

/* Two shapes, two lengths, two runs. All engines meet as many bodies. */
static void rays_are_measured(void **state)
{
	(void)state;
	double met[4] = {0};
	read_table("rays", "--sizes 40 --runs 2 --device cpu");
	assert_int_equal(csv.rows, 1 + 8 * (1 + count_peers()));
	for (size_t row = 1; row < csv.rows; row++) {
		const size_t kind = (size_t)(strstr(csv.at[row][PART], ", 100 m") != NULL) + 2 * (size_t)(strcmp(csv.at[row][SHAPE], "triangle") == 0);
		assert_true(number(row, BODIES) == 40 && number(row, REPETITIONS) == 10000 && number(row, SECONDS) > 0 && *csv.at[row][DEVICE]);
		met[kind] = met[kind] > 0 ? met[kind] : number(row, HITS);
		assert_true(number(row, HITS) > 1000 && number(row, HITS) == met[kind]);
	}
	assert_true(met[0] < met[1] && met[2] < met[3]);
	if (has_charts())
		check("$C bench rays --device cpu --plot $D/rays.png", 2, "rays can't be measured: --plot: it has no chart");
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(scale_is_measured), cmocka_unit_test(scale_has_a_chart),
		cmocka_unit_test(scale_goes_on_without_what_does_not_fit), cmocka_unit_test(nothing_of_ours_tunnels), cmocka_unit_test(heaps_are_measured),
		cmocka_unit_test(rays_are_measured)};
	return cmocka_run_group_tests_name("bench, beside other engines", tests, make_folder, remove_folder);
}
