/* Every allocation of a small run fails in turn: an error says so, nothing is lost, nothing leaks (which the sanitizers see).
 * SPDX-License-Identifier: MIT */
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "faults/walk.h"

/* What can be done without, fewer threads say, is no failure. Where its own memory ends jansson takes some scenes for broken. */
static void there_is_no_memory(const char *call, carom_status status, const carom_error *error)
{
	const bool blamed = call && strncmp(call, "jansson", 7) == 0 && status == CAROM_INVALID_SCENE;
	if (status && (!call || (status != CAROM_OUT_OF_MEMORY && !blamed) || error->status != status || !*error->text))
		fail_msg("%s failed: %s: %s", call ? call : "nothing", carom_status_name(status), error->text);
}

static void worlds_that_open(void **unused)
{
	(void)unused;
	json_set_alloc_funcs(faults_malloc, free);
	SCENERY_EACH_DEVICE(device)
		if (device->storage != CAROM_STORAGE_IMAGE) /* it is the same as with buffers */
			walk_opening(device, "events", FAULTS_MEMORY, there_is_no_memory);
	json_set_alloc_funcs(malloc, free);
}

static void worlds_that_run(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		walk_running(device, "events", FAULTS_MEMORY, there_is_no_memory);
		walk_running(device, "first_impact", FAULTS_MEMORY, there_is_no_memory);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(worlds_that_open), cmocka_unit_test(worlds_that_run)};
	return cmocka_run_group_tests_name("faults_memory", tests, walk_make_folder, walk_remove_folder);
}
