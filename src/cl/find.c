/* Which OpenCL devices there are, and what Carom can do with each. */
#include <stdlib.h>
#include <string.h>

#include "cl/api.h"
#include "device.h"
#include "status.h"

#define NO_PLATFORM (-1001) /* CL_PLATFORM_NOT_FOUND_KHR: a loader without a driver says so by an error */
#define UNNAMED "an OpenCL device"

/* The first of the reasons stays. */
static void refuse(carom_device_info *info, const char *call, cl_int code)
{
	if (code && !info->reason[0])
		snprintf(info->reason, sizeof info->reason, "%s fails: %s (%d)", call, carom_cl_code_name(code), (int)code);
}

/* Two words a device has for itself may be longer than we keep; the query then needs a buffer that holds all. */
static void get_text(const carom_cl_api *cl, carom_cl_found *f, cl_device_info what, char *text, size_t size)
{
	char all[4096] = "";
	cl_int code = cl->clGetDeviceInfo(f->device, what, sizeof all, all, NULL);
	refuse(&f->info, "clGetDeviceInfo", code);
	snprintf(text, size, "%s", code ? "" : all);
}

cl_ulong carom_cl_get_number(const carom_cl_api *cl, carom_cl_found *f, cl_device_info what)
{
	union {
		cl_ulong wide;
		cl_uint narrow;
	} value = {0};
	size_t size = 0;
	cl_int code = cl->clGetDeviceInfo(f->device, what, sizeof value, &value, &size);
	refuse(&f->info, "clGetDeviceInfo", code);
	return code ? 0 : size == sizeof value.wide ? value.wide : value.narrow;
}

static void judge(const carom_cl_api *cl, carom_cl_found *f)
{
	carom_device_info *info = &f->info;
	char profile[64];
	const bool available = carom_cl_get_number(cl, f, CL_DEVICE_AVAILABLE) != 0,
			   compiles = carom_cl_get_number(cl, f, CL_DEVICE_COMPILER_AVAILABLE) != 0;
	const bool little_endian = carom_cl_get_number(cl, f, CL_DEVICE_ENDIAN_LITTLE) != 0;
	get_text(cl, f, CL_DEVICE_PROFILE, profile, sizeof profile);
	if (info->reason[0])
		return; /* what was not answered can't be judged */
	if (!available)
		snprintf(info->reason, sizeof info->reason, "it is not available");
	else if (!compiles)
		snprintf(info->reason, sizeof info->reason, "it has no compiler");
	else if (!little_endian)
		snprintf(info->reason, sizeof info->reason, "it is big-endian");
	else if (strcmp(profile, "FULL_PROFILE"))
		snprintf(info->reason, sizeof info->reason, "its profile is %s, not FULL_PROFILE", profile);
	info->works = !info->reason[0];
}

static void describe(const carom_cl_api *cl, carom_cl_found *f)
{
	carom_device_info *info = &f->info;
	char platform[4096] = "";
	refuse(info, "clGetPlatformInfo", cl->clGetPlatformInfo(f->platform, CL_PLATFORM_NAME, sizeof platform, platform, NULL));
	snprintf(info->platform, sizeof info->platform, "%.*s", (int)sizeof info->platform - 1, platform);
	cl_ulong width = carom_cl_get_number(cl, f, CL_DEVICE_IMAGE2D_MAX_WIDTH), height = carom_cl_get_number(cl, f, CL_DEVICE_IMAGE2D_MAX_HEIGHT);
	get_text(cl, f, CL_DEVICE_NAME, info->name, sizeof info->name);
	if (!info->name[0])
		snprintf(info->name, sizeof info->name, UNNAMED);
	get_text(cl, f, CL_DEVICE_VERSION, info->version, sizeof info->version);
	info->is_opencl = true;
	info->is_cpu = (carom_cl_get_number(cl, f, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU) && !getenv("CAROM_AS_GPU");
	info->exact = (carom_cl_get_number(cl, f, CL_DEVICE_SINGLE_FP_CONFIG) & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
	info->has_images = carom_cl_get_number(cl, f, CL_DEVICE_IMAGE_SUPPORT) != 0;
	info->compute_units = (uint32_t)carom_cl_get_number(cl, f, CL_DEVICE_MAX_COMPUTE_UNITS);
	info->clock_mhz = (uint32_t)carom_cl_get_number(cl, f, CL_DEVICE_MAX_CLOCK_FREQUENCY);
	info->memory = carom_cl_get_number(cl, f, CL_DEVICE_GLOBAL_MEM_SIZE);
	info->max_allocation = carom_cl_get_number(cl, f, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
	info->max_image_size = info->has_images ? (uint32_t)(width < height ? width : height) : 0;
	carom_cl_check_limits(cl, f);
	judge(cl, f);
}

/* Devices that work first, among them GPUs and accelerators, among those the most units times clock. */
static double rank(const carom_cl_found *f)
{
	double speed = (double)f->info.compute_units * (double)(f->info.clock_mhz ? f->info.clock_mhz : 1);
	if (!f->info.works)
		return 0.0;
	return f->info.is_cpu ? speed : 1e12 + speed;
}

/* By rank; few and stable, so that equal devices keep the loader's order. */
static void sort(carom_cl_found *found, size_t count)
{
	for (size_t i = 1; i < count; i++) {
		carom_cl_found f = found[i];
		double r = rank(&f);
		size_t k = i;
		for (; k > 0 && rank(&found[k - 1]) < r; k--)
			found[k] = found[k - 1];
		found[k] = f;
	}
}

static carom_status no_memory(carom_error *error)
{
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to list the OpenCL devices");
}

/* NULL without the memory. */
static carom_cl_found *append_one(carom_cl_found **found, size_t *count)
{
	carom_cl_found *grown = realloc(*found, (*count + 1) * sizeof **found);
	if (!grown)
		return NULL;
	*found = grown;
	memset(&grown[*count], 0, sizeof *grown);
	return &grown[(*count)++];
}

/* Devices that can't be asked for are listed as one that does not work, so that users hear why they are not there. */
static carom_status append_failure(carom_cl_found **found, size_t *count, const char *call, cl_int code, carom_error *error)
{
	carom_cl_found *f = append_one(found, count);
	if (!f)
		return no_memory(error);
	snprintf(f->info.name, sizeof f->info.name, UNNAMED);
	f->info.is_opencl = true;
	refuse(&f->info, call, code);
	return CAROM_OK;
}

static carom_status append(const carom_cl_api *cl, cl_platform_id platform, carom_cl_found **found, size_t *count, carom_error *error)
{
	cl_uint more = 0;
	cl_device_id devices[64];
	cl_int code = cl->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 64, devices, &more);
	if (code && code != CL_DEVICE_NOT_FOUND)
		return append_failure(found, count, "clGetDeviceIDs", code, error);
	for (cl_uint i = 0; !code && i < more && i < 64; i++) {
		carom_cl_found *f = append_one(found, count);
		if (!f)
			return no_memory(error);
		f->platform = platform;
		f->device = devices[i];
		describe(cl, f);
	}
	return CAROM_OK;
}

carom_status carom_cl_find(const carom_cl_api *cl, carom_cl_found **found, size_t *count, carom_error *error)
{
	cl_platform_id platforms[32];
	cl_uint platform_count = 0;
	*found = NULL;
	*count = 0;
	cl_int code = cl->clGetPlatformIDs(32, platforms, &platform_count);
	carom_status status = code && code != NO_PLATFORM ? append_failure(found, count, "clGetPlatformIDs", code, error) : CAROM_OK;
	for (cl_uint i = 0; !status && !code && i < platform_count && i < 32; i++)
		status = append(cl, platforms[i], found, count, error);
	if (status) {
		free(*found);
		*found = NULL;
		return status;
	}
	sort(*found, *count);
	return CAROM_OK;
}

carom_status carom_cl_list(carom_device_info **devices, size_t *count, carom_error *error)
{
	carom_cl_api cl;
	carom_cl_found *found;
	carom_status status;
	*devices = NULL;
	*count = 0;
	if (!carom_cl_load(&cl))
		return CAROM_OK;
	status = carom_cl_find(&cl, &found, count, error);
	if (status || !*count)
		return status;
	*devices = malloc(*count * sizeof **devices);
	if (!*devices)
		status = no_memory(error);
	for (size_t i = 0; *devices && i < *count; i++)
		(*devices)[i] = found[i].info;
	free(found);
	return status;
}
