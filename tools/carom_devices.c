/* carom devices: what there is to run on.
 * SPDX-License-Identifier: MIT */
#include "carom_check.h"

static void print_facts(const carom_device_info *device)
{
	char memory[32], allocation[32];
	printf("    %u %s", (unsigned)device->compute_units, device->is_opencl ? "compute units" : "cores");
	if (device->clock_mhz)
		printf(" at %u MHz", (unsigned)device->clock_mhz);
	printf(", %s of memory", format_bytes(device->memory, memory, sizeof memory));
	if (device->max_allocation)
		printf(", a texture at most %s", format_bytes(device->max_allocation, allocation, sizeof allocation));
	putchar('\n');
	if (!device->is_opencl)
		return;
	if (device->has_images) {
		printf("    images: texels of four floats and of four bytes, sides up to %u\n", (unsigned)device->max_image_size);
	} else {
		printf("    images: none that will do; textures are kept in buffers\n");
	}
}

static void print_device(const carom_device_info *device)
{
	printf("%s%s%s", device->platform, *device->platform ? ": " : "", device->name);
	printf("%s%s%s%s\n", *device->version ? " (" : "", device->version, *device->version ? ")" : "", device->is_default ? ", the default" : "");
	if (!device->works) {
		printf("    does not work: %s\n", *device->reason ? device->reason : "for a reason unknown");
	} else if (device->exact) {
		printf("    works; exact: the same bits as on every other exact device\n");
	} else {
		printf("    works; not exact: does not promise to round quotients and roots correctly; --check says what it does\n");
	}
	print_facts(device);
}

struct devices_options {
	struct common_options common;
	bool check;
};

static int devices_main(int argc, char **argv)
{
	struct devices_options options = {{0}, false};
	carom_error error;
	carom_device_info *devices = NULL;
	size_t count = 0;
	int code = parse_options(&devices_command, argc, argv, &options.common);
	if (code >= 0)
		return code;
	if (options.check)
		return check_device(&options.common, print_device);
	if (options.common.device || options.common.storage != CAROM_STORAGE_AUTO || options.common.set_count > 0) {
		wrong(&error, "--device, --storage and --set change nothing in the list; --device and --storage need --check");
		return report(&error);
	}
	if (carom_device_list_create(&devices, &count, &error) != CAROM_OK)
		return report(&error);
	for (size_t k = 0; k < count; k++)
		print_device(&devices[k]);
	carom_device_list_destroy(devices);
	return finish_output();
}

static const struct option options_table[] = {
	{"check", NULL, NULL, offsetof(struct devices_options, check),
		"run a small reference scene on the device that --device chooses, and say whether all bits are right"},
	{NULL, NULL, NULL, 0, NULL},
};

const struct command devices_command = {
	.name = "devices",
	.arguments = "",
	.summary = "Lists what OpenCL offers here, what Carom can do with each, and the default",
	.details = "\nEach device by platform and name: parts of either are what --device takes. The CPU fallback is\n"
			   "always there. They are in the order in which --device auto tries them: OpenCL devices that are no\n"
			   "CPUs, the fallback, which is faster than OpenCL on a CPU, then that.\n"
			   "\n--check tries one device instead: how it rounds, and whether a scene that is part of the command\n"
			   "gives the same bits as everywhere, by each step, in images and in buffers, and drawn. It ends\n"
			   "with the exit code 0 only if all is right. --device and --storage choose what is tried; --set is\n"
			   "refused, for a check runs the default pipeline.\n",
	.options = options_table,
	.makes_worlds = true,
	.main = devices_main,
};
