/* carom stages: what the slots of the pipeline can be filled with.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <string.h>

/* Can it be chosen by name? */
static bool is_choice(const carom_stage_info *info)
{
	carom_pipeline pipeline = {0};
	return carom_pipeline_set(&pipeline, info->slot, info->alternative, NULL) == CAROM_OK;
}

static int stages_main(int argc, char **argv)
{
	struct common_options options = {0};
	carom_stage_info info;
	const char *slot = "";
	int code = parse_options(&stages_command, argc, argv, &options);
	if (code >= 0)
		return code;
	printf("%-10s %-20s %-8s %-8s %-8s\n", "slot", "alternative", "opencl", "cpu", "--set");
	for (size_t k = 0; carom_stage_list(k, &info); k++) {
		bool same = strcmp(slot, info.slot) == 0;
		printf("%-10s %-20s %-8s %-8s %-8s%s\n", same ? "" : info.slot, info.alternative, info.on_opencl ? "yes" : "no", info.on_cpu ? "yes" : "no",
			is_choice(&info) ? "yes" : "no", info.is_default ? " default" : "");
		slot = info.slot;
	}
	return finish_output();
}

static const struct option options_table[] = {{NULL, NULL, NULL, 0, NULL}};

const struct command stages_command = {
	.name = "stages",
	.arguments = "",
	.summary = "Lists every slot of the pipeline, its alternatives and the devices that have them",
	.details = "\nAn alternative is chosen by --set SLOT=NAME, or in the \"pipeline\" of a scene, where the\n"
			   "column --set says yes; the other slots have no choice. Slots are listed in the order in which a step\n"
			   "runs them.\n",
	.options = options_table,
	.main = stages_main,
};
