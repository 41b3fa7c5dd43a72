/* carom devices --check: says that a right device is right, and finds each way of being wrong.
 * SPDX-License-Identifier: MIT */
#include "command.h"

static void says(const char *text)
{
	if (!strstr(call.out, text))
		fail_msg("\"%s\" is not in\n%s%s", text, call.out, call.err);
}

static void fallback_is_right(void **state)
{
	(void)state;
	check("$C devices --check --device cpu", 0, "");
	says("quotients: 255 of 255 correctly rounded\n");
	says("products and sums: each is rounded\n");
	says("denormals: kept\n");
	says("    events: ");
	says("    events, its hits: ");
	says("    first_impact, drawn: ");
	says("\nright: ");
	assert_null(strstr(call.out, "WRONG"));
	assert_string_equal(call.err, "");
}

static void opencl_is_right_in_both_storages(void **state)
{
	(void)state;
	if (!has_opencl())
		return;
	check("$C devices --check --device opencl", 0, "");
	says("square roots: 256 of 256 hits");
	says("events in images: ");
	says("first_impact in buffers, drawn: ");
	says("\nright: ");
	check("$C devices --check --device opencl --storage buffer", 0, "");
	assert_null(strstr(call.out, "in images: "));
	check("CAROM_MAX_IMAGE_SIZE=4095 $C devices --check --device opencl", 0, "");
	says("images: none that will do");
	assert_null(strstr(call.out, "in images: "));
}

/* The check says that this is wrong. */
static void says_wrong(const char *what)
{
	const char *line = strstr(call.out, what);
	says(what);
	assert_int_equal(strncmp(line + strlen(what) + strlen("0123456789abcdef"), ", WRONG: ", strlen(", WRONG: ")), 0);
}

/* Replaces a part of a kernel, in a folder that is read instead. */
static void spoil(const char *kernel, const char *good, const char *bad)
{
	char line[2048];
	snprintf(line, sizeof line,
		"[ -e $D/k/%s ] || { mkdir -p $D/k/%s && rmdir $D/k/%s && cp kernels/%s $D/k/%s; } && cp $D/k/%s $D/was && sed -i 's|%s|%s|' $D/k/%s "
		"&& ! cmp -s $D/was $D/k/%s",
		kernel, kernel, kernel, kernel, kernel, kernel, good, bad, kernel, kernel);
	check(line, 0, NULL);
}

/* With what was spoilt, which then is forgotten. */
static void check_spoilt(int code)
{
	check("CAROM_KERNEL_DIR=$D/k $C devices --check --device opencl --storage buffer; code=$?; rm -r $D/k; exit $code", code, NULL);
}

/* Kernels take long to build: several things are wrong at once where each shows by itself. */
static void wrong_devices_are_found(void **state)
{
	(void)state;
	if (!has_opencl())
		return;
	spoil("roster.h", "1.0f / CHANNEL(g, GEOMETRY_MASS)", "0.9999999f / CHANNEL(g, GEOMETRY_MASS)");
	check_spoilt(1);
	says("quotients: 0 of 255");
	spoil("roster.h", "CHANNEL(world, WORLD_GRAVITY_Y) + CHANNEL(f, FORCES_Y) \\* inverse_mass",
		"fma(CHANNEL(f, FORCES_Y), inverse_mass, CHANNEL(world, WORLD_GRAVITY_Y))");
	spoil("search.h", "gap / (sqrt(under)", "gap / (0.9999f \\* sqrt(under)");
	check_spoilt(1);
	says("quotients: 255 of 255");
	says("rounded once (contraction)");
	says("square roots: 2 of 256 hits");
	spoil("roster.h", "SLOT_PLACE\\] = l;", "SLOT_PLACE] = l + (float4)(0.0f, 0.0f, 1e-30f, 0.0f) - (float4)(0.0f, 0.0f, 1e-30f, 0.0f);");
	check_spoilt(0);
	says("denormals: made 0");
	spoil("load.h", "done + 2)", "done + 3)");
	spoil("answer.h", "= hit.where;", "= -hit.where;");
	spoil("pixels/distance.cl", "0.5f", "0.50001f");
	check_spoilt(1);
	says("events in buffers: ae6d85b586319664, right");
	says_wrong("events in buffers, its hits: ");
	says_wrong("contacts in buffers: ");
	says_wrong("first_impact in buffers, drawn: ");
}

/* What can't even be built is told, and the rest is tried. */
static void a_failing_device_is_told(void **state)
{
	(void)state;
	if (!has_opencl())
		return;
	check("mkdir -p $D/k/reduce && echo 'not OpenCL C' >$D/k/reduce/tiled.cl", 0, NULL);
	check("CAROM_KERNEL_DIR=$D/k $C devices --check --device opencl", 1, "the kernels can't be built");
}

static void wrong_calls_exit_with_2(void **state)
{
	(void)state;
	check("$C devices --check --device abacus", 2, "there is no device 'abacus'");
	check("$C devices --check --device cpu --set toi=bisection", 2, "--set: a check runs the default pipeline");
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(fallback_is_right), cmocka_unit_test(opencl_is_right_in_both_storages),
		cmocka_unit_test(wrong_devices_are_found), cmocka_unit_test(a_failing_device_is_told), cmocka_unit_test(wrong_calls_exit_with_2)};
	return cmocka_run_group_tests_name("check", tests, make_folder, remove_folder);
}
