/* Every call of OpenCL of a small run fails in turn: an error names what failed, nothing is lost, all objects are released.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cl/api.h"
#include "faults/walk.h"

static int grown;       /* lists that could not */
static int spared;      /* calls of the cache, which is done without */
static cl_uint drivers; /* of which one that can't be asked for its devices is left out */
static char cache[] = "/tmp/carom-test-XXXXXX";

static void opencl_failed(const char *call, carom_status status, const carom_error *error)
{
	if (!call) {
		fail_msg("nothing failed, but: %s", error->text);
		return;
	}
	if (!status && drivers > 1 && strcmp(call, "clGetDeviceIDs") == 0)
		return;
	/* what is released is gone, whatever the call says */
	if (!status ? strncmp(call, "clRelease", 9) != 0 : error->status != status || !strstr(error->text, ": CL_") || strstr(error->text, "(null)"))
		fail_msg("%s failed: %s: %s", call, carom_status_name(status), error->text);
	if ((strcmp(call, "clCreateBuffer") == 0 || strcmp(call, "clCreateImage") == 0) && !strstr(error->text, " KiB), can't be made: CL_"))
		fail_msg("%s: no texture is named", error->text);
	grown += strstr(error->text, "Neighbours, ") && strstr(error->text, "can't be made");
}

static void empty_cache(void)
{
	char line[128];
	snprintf(line, sizeof line, "rm -f '%s'/*", cache);
	assert_int_equal(system(line), 0);
}

/* Without these kernels are built from their sources, or not kept. */
static void cache_failed(const char *call, carom_status status, const carom_error *error)
{
	static const char *const calls[] = {"clGetPlatformInfo", "clGetDeviceInfo", "clCreateProgramWithBinary", "clBuildProgram", "clGetProgramInfo"};
	for (size_t i = 0; call && !status && i < sizeof calls / sizeof *calls; i++) {
		if (strcmp(call, calls[i]) == 0) {
			spared++;
			return;
		}
	}
	opencl_failed(call, status, error);
}

static void empty_cache_failed(const char *call, carom_status status, const carom_error *error)
{
	if (call && strcmp(call, "clBuildProgram") == 0)
		assert_int_not_equal(status, CAROM_OK);
	cache_failed(call, status, error);
	empty_cache();
}

/* With a cache that is empty each time, then with one that has all; what programs do not need is the same then. For each of two programs two calls ask
 * for the platform and five for the device, and two get the program from the cache or into it. */
static void worlds_that_open(void **unused)
{
	(void)unused;
	static const struct {
		faults_kind kind;
		walk_judge *judge;
	} walks[] = {{FAULTS_PROGRAMS, empty_cache_failed}, {FAULTS_OPENCL, cache_failed}};
	assert_non_null(mkdtemp(cache));
	setenv("CAROM_CACHE", cache, 1);
	for (int i = 0; i < 2; i++) {
		spared = 0;
		if (walk_opening(&scenery_devices[2], "events", walks[i].kind, walks[i].judge)) /* with images it is the same */
			assert_true(drivers > 1 ? spared >= 2 * (2 + 5 + 2) : spared == 2 * (2 + 5 + 2));
	}
	unsetenv("CAROM_CACHE");
	empty_cache();
	assert_int_equal(rmdir(cache), 0);
}

static void worlds_that_run(void **unused)
{
	const char *all = getenv("CAROM_LONG_TESTS"); /* contacts makes three times as many calls, for the same reasons */
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		if (!strcmp(device->name, "cpu"))
			continue;
		walk_running(device, device->storage == CAROM_STORAGE_IMAGE ? "first_impact" : "events", FAULTS_OPENCL, opencl_failed);
		if (device->storage == CAROM_STORAGE_BUFFER && all && *all)
			walk_running(device, "contacts", FAULTS_OPENCL, opencl_failed);
	}
}

static void bodies_are_steered(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device)
		walk_steering(device, FAULTS_OPENCL, opencl_failed);
}

static void bodies_come_and_go(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device)
		walk_roster(device, FAULTS_OPENCL, opencl_failed);
}

static void lists_that_grow(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device)
		if (device->storage == CAROM_STORAGE_BUFFER && walk_growing(device, FAULTS_OPENCL, opencl_failed))
			assert_true(grown > 0);
}

/* Without OpenCL Carom runs on the CPU by itself, and says what is missing where OpenCL is asked for. */
static void machines_without_opencl(void **unused)
{
	(void)unused;
	static const faults_loader machines[] = {LOADER_NONE, LOADER_OLD, LOADER_WITHOUT_PLATFORMS, LOADER_WITHOUT_DEVICES};
	for (size_t i = 0; i < sizeof machines / sizeof *machines; i++) {
		carom_world_def def = carom_default_world_def();
		carom_device_info *devices = NULL, info;
		carom_world *world = NULL;
		carom_error error;
		size_t count = 0;
		faults_loader_set(machines[i]);
		scenery_check(carom_device_list_create(&devices, &count, &error), &error);
		assert_true(count == 1 && devices[0].works && devices[0].is_default && !devices[0].is_opencl);
		carom_device_list_destroy(devices);
		def.device = "auto";
		scenery_check(carom_world_create(&def, &world, &error), &error);
		scenery_check(carom_world_get_device(world, &info, &error), &error);
		assert_false(info.is_opencl);
		carom_world_destroy(world);
		def.device = "opencl";
		assert_int_equal(carom_world_create(&def, &world, &error), CAROM_UNKNOWN_NAME);
		assert_non_null(strstr(error.text, "no OpenCL device was found"));
		faults_loader_set(LOADER_REAL);
	}
}

/* A loader that fails is told of, and `auto` goes on without it. */
static void failures_are_listed(void **unused)
{
	(void)unused;
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	carom_device_info *devices = NULL;
	carom_error error;
	size_t count = 0;
	faults_arm(FAULTS_OPENCL, 1, CL_OUT_OF_HOST_MEMORY);
	scenery_check(carom_device_list_create(&devices, &count, &error), &error);
	if (!faults_disarm()) {
		print_message("SKIPPED: there is no OpenCL\n");
		carom_device_list_destroy(devices);
		skip();
	}
	assert_true(count == 2 && devices[0].is_default && devices[1].is_opencl && !devices[1].works);
	assert_string_equal(devices[1].reason, "clGetPlatformIDs fails: CL_OUT_OF_HOST_MEMORY (-6)");
	carom_device_list_destroy(devices);
	faults_arm(FAULTS_OPENCL, 1, CL_OUT_OF_HOST_MEMORY);
	def.device = "auto";
	scenery_check(carom_world_create(&def, &world, &error), &error);
	faults_disarm();
	carom_world_destroy(world);
}

/* Is it OpenCL that `auto` takes? */
static bool auto_takes_opencl(void)
{
	carom_world_def def = carom_default_world_def();
	carom_device_info info;
	carom_world *world = NULL;
	carom_error error;
	def.device = "auto";
	scenery_check(carom_world_create(&def, &world, &error), &error);
	scenery_check(carom_world_get_device(world, &info, &error), &error);
	carom_world_destroy(world);
	return info.is_opencl;
}

/* GPUs come before the fallback, and that before OpenCL on the CPU. */
static void the_fastest_is_the_default(void **unused)
{
	(void)unused;
	static const faults_loader machines[] = {LOADER_GPU, LOADER_REAL};
	for (size_t i = 0; i < sizeof machines / sizeof *machines; i++) {
		carom_device_info *devices = NULL;
		carom_error error;
		size_t count = 0, gpus = 0;
		faults_loader_set(machines[i]);
		scenery_check(carom_device_list_create(&devices, &count, &error), &error);
		if (count == 1)
			print_message("SKIPPED: there is no OpenCL\n");
		for (size_t k = 0; k < count; k++)
			gpus += devices[k].works && !devices[k].is_cpu;
		assert_true(gpus > 0 || count == 1 || machines[i] == LOADER_REAL);
		for (size_t k = 0; k < count; k++)
			assert_true(devices[k].is_default == (k == 0) && devices[k].is_opencl == (k != gpus));
		assert_true(auto_takes_opencl() == (gpus > 0));
		carom_device_list_destroy(devices);
	}
}

static int count_drivers(void **state)
{
	carom_cl_api cl;
	if (carom_cl_load(&cl) && cl.clGetPlatformIDs(0, NULL, &drivers))
		drivers = 0;
	return walk_make_folder(state);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(machines_without_opencl), cmocka_unit_test(failures_are_listed),
		cmocka_unit_test(the_fastest_is_the_default), cmocka_unit_test(worlds_that_open), cmocka_unit_test(worlds_that_run),
		cmocka_unit_test(lists_that_grow), cmocka_unit_test(bodies_are_steered), cmocka_unit_test(bodies_come_and_go)};
	return cmocka_run_group_tests_name("faults_opencl", tests, count_drivers, walk_remove_folder);
}
