/* Devices that don't promise to round quotients and roots correctly: they are said to be so, and worlds run on them.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "../tools/carom_tool.h"
#include "faults/faults.h"
#include "scenery.h"

static int round_as_they_will(void **unused)
{
	(void)unused;
	faults_loader_set(LOADER_INEXACT);
	return 0;
}

static int round_again(void **unused)
{
	(void)unused;
	faults_loader_set(LOADER_REAL);
	return 0;
}

/* The fallback alone is exact. */
static void devices_are_not_exact(void **unused)
{
	(void)unused;
	carom_device_info *devices = NULL;
	carom_error error;
	size_t count = 0;
	scenery_check(carom_device_list_create(&devices, &count, &error), &error);
	for (size_t i = 0; i < count; i++)
		assert_true(devices[i].exact == !devices[i].is_opencl);
	carom_device_list_destroy(devices);
}

/* Their kernels are built without the option that such a device refuses, and find hits. */
static void worlds_run(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = scenery_crowd(device, 1, 0);
		carom_device_info info;
		carom_report report;
		carom_error error;
		if (!world)
			continue;
		scenery_check(carom_world_get_device(world, &info, &error), &error);
		assert_true(info.exact == !info.is_opencl);
		scenery_check(carom_world_step(world, 20, &report, &error), &error);
		assert_true(report.steps == 20 && report.hits > 0);
		carom_world_destroy(world);
	}
}

/* What `carom devices` prints. */
static void list_devices(char *text, size_t size)
{
	static char name[] = "devices";
	char *arguments[] = {name, NULL};
	FILE *file = tmpfile();
	int code, kept = dup(STDOUT_FILENO);
	assert_true(file && kept >= 0 && fflush(stdout) == 0 && dup2(fileno(file), STDOUT_FILENO) >= 0);
	code = devices_command.main(1, arguments);
	dup2(kept, STDOUT_FILENO);
	close(kept);
	rewind(file);
	text[fread(text, 1, size - 1, file)] = '\0';
	fclose(file);
	assert_int_equal(code, 0);
}

static size_t times_in(const char *text, const char *part)
{
	size_t count = 0;
	for (; (text = strstr(text, part)); text++)
		count++;
	return count;
}

static void the_list_says_so(void **unused)
{
	(void)unused;
	static char text[65536];
	carom_device_info *devices = NULL;
	carom_error error;
	size_t count = 0, inexact = 0;
	scenery_check(carom_device_list_create(&devices, &count, &error), &error);
	for (size_t i = 0; i < count; i++)
		inexact += devices[i].is_opencl && devices[i].works;
	carom_device_list_destroy(devices);
	list_devices(text, sizeof text);
	assert_int_equal(times_in(text, "    works; not exact: does not promise to round quotients and roots correctly; --check says what it does\n"),
		inexact);
	assert_int_equal(times_in(text, "    works; exact: the same bits as on every other exact device\n"), 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(devices_are_not_exact), cmocka_unit_test(worlds_run), cmocka_unit_test(the_list_says_so)};
	return cmocka_run_group_tests_name("faults_inexact", tests, round_as_they_will, round_again);
}
