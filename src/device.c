/* Which device a world runs on. */
#include "device.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "layout.h"
#include "status.h"

#ifndef __FLT_EVAL_METHOD__
#define __FLT_EVAL_METHOD__ 0
#endif
_Static_assert(__FLT_EVAL_METHOD__ == 0,
	"floats must be computed as floats, or the bits differ from other devices: build with SSE2, or with -fexcess-precision=fast");

static bool contains(const char *text, const char *part)
{
	size_t size = strlen(part);
	for (; *text; text++)
		if (!strncasecmp(text, part, size))
			return true;
	return false;
}

/* The environment may say less than the device has; nobody can say more. */
static carom_status lower(const char *variable, uint64_t *limit, carom_error *error)
{
	const char *text = getenv(variable);
	char *end;
	uint64_t number;
	if (!text || !*text)
		return CAROM_OK;
	errno = 0;
	number = strtoull(text, &end, 10);
	if (errno || *end || text[0] < '0' || text[0] > '9' || number == 0)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "%s: found '%.64s'; allowed: a whole number above 0", variable, text);
	if (number < *limit)
		*limit = number;
	return CAROM_OK;
}

/* Images, which OpenCL devices have, must hold a row of bodies, or there are none for Carom. */
static carom_status heed_limits(carom_device_info *info, carom_error *error)
{
	uint64_t size = info->max_image_size, allocation = info->max_allocation;
	if (info->is_opencl)
		TRY(lower("CAROM_MAX_IMAGE_SIZE", &size, error));
	TRY(lower("CAROM_MAX_ALLOCATION", &allocation, error));
	info->max_image_size = (uint32_t)size;
	info->max_allocation = allocation;
	info->has_images = info->has_images && size >= ROW_SIZE;
	return CAROM_OK;
}

/* The fallback makes more of the CPU than OpenCL does: it comes before what is but another way to it. */
static void insert_fallback(carom_device_info *list, size_t found)
{
	size_t place = found;
	for (; place > 0 && (list[place - 1].is_cpu || !list[place - 1].works); place--)
		list[place] = list[place - 1];
	carom_cpu_info(&list[place]);
	list[0].is_default = true;
}

carom_status carom_device_list_create(carom_device_info **devices, size_t *count, carom_error *error)
{
	carom_device_info *list = NULL, *grown;
	size_t found = 0;
	carom_status status = CAROM_OK;
	GIVEN(devices, error);
	GIVEN(count, error);
	TRY(carom_cl_list(&list, &found, error));
	grown = realloc(list, (found + 1) * sizeof *list);
	if (!grown) {
		free(list);
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to list the devices");
	}
	insert_fallback(grown, found);
	for (size_t i = 0; !status && i <= found; i++)
		status = heed_limits(&grown[i], error);
	if (status) {
		free(grown);
		return status;
	}
	*devices = grown;
	*count = found + 1;
	return CAROM_OK;
}

void carom_device_list_destroy(carom_device_info *devices)
{
	free(devices);
}

static bool matches(const carom_device_info *info, const char *name)
{
	if (!strcasecmp(name, "auto"))
		return true;
	if (!strcasecmp(name, "cpu"))
		return !info->is_opencl;
	if (!strcasecmp(name, "opencl"))
		return info->is_opencl;
	return contains(info->platform, name) || contains(info->name, name);
}

static carom_status no_such_device(const char *name, bool from_environment, const carom_device_info *list, size_t count, carom_error *error)
{
	char known[512] = "";
	for (size_t i = 0; i < count; i++) {
		size_t used = strlen(known);
		snprintf(known + used, sizeof known - used, "%s'%s'", used ? ", " : "", list[i].name);
	}
	return carom_fail(error, CAROM_UNKNOWN_NAME,
		"%sthere is no device '%.128s'; use auto, cpu, opencl or part of one of these names: %s%s; `carom devices` tells more of them",
		from_environment ? "CAROM_DEVICE: " : "", name, known, count > 1 ? "" : " (no OpenCL device was found)");
}

/* How many of the same names come before: a machine may have several GPUs of a kind. */
static size_t alike_before(const carom_device_info *list, size_t index)
{
	size_t count = 0;
	for (size_t i = 0; i < index; i++)
		count += !strcmp(list[i].platform, list[index].platform) && !strcmp(list[i].name, list[index].name);
	return count;
}

static carom_status open_one(const carom_device_def *def, const carom_device_info *which, size_t alike, carom_device **device, carom_error *error)
{
	if (!which->works)
		return carom_fail(error, CAROM_DEVICE, "the device '%s' can't be used: %s", which->name, which->reason);
	if (which->is_opencl)
		return carom_cl_open(def, which, alike, device, error);
	TRY(carom_cpu_open(def, device, error));
	(*device)->info = *which;
	return CAROM_OK;
}

/* Without a look at OpenCL, whose drivers may be slow to load, or broken. */
static carom_status open_fallback(const carom_device_def *def, carom_device **device, carom_error *error)
{
	carom_device_info info = {0};
	carom_cpu_info(&info);
	TRY(heed_limits(&info, error));
	return open_one(def, &info, 0, device, error);
}

/* The first that opens of those that match: for `auto` and the like a device that fails makes way for the next. */
static carom_status open_first(const carom_device_def *def, const char *name, const carom_device_info *list, size_t count, carom_device **device,
	carom_error *error)
{
	carom_error failed = {0};
	for (size_t i = 0; i < count; i++)
		if (matches(&list[i], name) && !open_one(def, &list[i], alike_before(list, i), device, &failed)) {
			(*device)->info.is_default = false; /* that is for lists */
			return CAROM_OK;
		}
	if (!failed.status)
		return no_such_device(name, !def->name, list, count, error);
	if (error)
		*error = failed;
	return failed.status;
}

carom_status carom_device_open(const carom_device_def *def, carom_device **device, carom_error *error)
{
	const char *name = def->name ? def->name : getenv("CAROM_DEVICE");
	carom_device_info *list = NULL;
	size_t count = 0;
	if (def->name && !*def->name)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "device: found \"\", must be auto, cpu, opencl or part of a name, or NULL");
	TRY(carom_cl_check_override(error));
	if (name && !strcasecmp(name, "cpu"))
		return open_fallback(def, device, error);
	TRY(carom_device_list_create(&list, &count, error));
	const carom_status status = open_first(def, name && *name ? name : "auto", list, count, device, error);
	carom_device_list_destroy(list);
	return status;
}

void carom_device_close(carom_device *device)
{
	if (device)
		device->kind->close(device);
}
