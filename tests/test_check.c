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

/* A kernel with a part of it replaced, and what is said of the device then, and the exit code. */
static void finds(const char *kernel, const char *good, const char *bad, const char *said, int code)
{
	char line[2048];
	snprintf(line, sizeof line, "mkdir -p $D/k/%s && rmdir $D/k/%s && sed 's|%s|%s|' kernels/%s >$D/k/%s && ! cmp -s kernels/%s $D/k/%s", kernel,
		kernel, good, bad, kernel, kernel, kernel, kernel);
	check(line, 0, NULL);
	check("CAROM_KERNEL_DIR=$D/k $C devices --check --device opencl --storage buffer", code, NULL);
	says(said);
	check("rm -r $D/k", 0, NULL);
}

static void wrong_devices_are_found(void **state)
{
	(void)state;
	if (!has_opencl())
		return;
	finds("slots/records.cl", "1.0f / CHANNEL(g, GEOMETRY_MASS)", "0.9999999f / CHANNEL(g, GEOMETRY_MASS)", "quotients: 0 of 255", 1);
	finds("slots/records.cl", "CHANNEL(world, WORLD_GRAVITY_Y) + CHANNEL(f, FORCES_Y) \\* inverse_mass",
		"fma(CHANNEL(f, FORCES_Y), inverse_mass, CHANNEL(world, WORLD_GRAVITY_Y))", "rounded once (contraction)", 1);
	finds("slots/records.cl", "SLOT_PLACE\\] = ROW_LOAD(linear, i);",
		"SLOT_PLACE] = ROW_LOAD(linear, i) + (float4)(0.0f, 0.0f, 1e-30f, 0.0f) - (float4)(0.0f, 0.0f, 1e-30f, 0.0f);", "denormals: made 0", 0);
	finds("search.h", "gap / (sqrt(under)", "gap / (0.9999f \\* sqrt(under)", "square roots: 2 of 256 hits", 1);
	finds("load.h", "done + 2)", "done + 3)", "contacts in buffers: ", 1);
	finds("answer.h", "= hit.where;", "= -hit.where;", "events in buffers: 26677a7583aba31e, right\n    events in buffers, its hits: ", 1);
	finds("pixels/distance.cl", "0.5f", "0.50001f", "first_impact in buffers, drawn: ", 1);
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
