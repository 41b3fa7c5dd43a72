/* Which OpenCL devices there are, and what Carom can do with each. */
#include <stdlib.h>
#include <string.h>

#include "cl/api.h"
#include "device.h"
#include "status.h"

/* Two words a device has for itself may be longer than we keep; the query then needs a buffer that holds all. */
static void get_text(const carom_cl_api *cl, cl_device_id device, cl_device_info what, char *text, size_t size)
{
	char all[4096] = "";
	if (cl->clGetDeviceInfo(device, what, sizeof all, all, NULL))
		all[0] = 0;
	snprintf(text, size, "%s", all);
}

static cl_ulong get_number(const carom_cl_api *cl, cl_device_id device, cl_device_info what)
{
	union {
		cl_ulong wide;
		cl_uint narrow;
	} value = {0};
	size_t size = 0;
	if (cl->clGetDeviceInfo(device, what, sizeof value, &value, &size))
		return 0;
	return size == sizeof value.wide ? value.wide : value.narrow;
}

static void judge(const carom_cl_api *cl, carom_cl_found *f)
{
	carom_device_info *info = &f->info;
	char profile[64];
	get_text(cl, f->device, CL_DEVICE_PROFILE, profile, sizeof profile);
	if (!get_number(cl, f->device, CL_DEVICE_AVAILABLE))
		snprintf(info->reason, sizeof info->reason, "it is not available");
	else if (!get_number(cl, f->device, CL_DEVICE_COMPILER_AVAILABLE))
		snprintf(info->reason, sizeof info->reason, "it has no compiler");
	else if (!get_number(cl, f->device, CL_DEVICE_ENDIAN_LITTLE))
		snprintf(info->reason, sizeof info->reason, "it is big-endian");
	else if (strcmp(profile, "FULL_PROFILE"))
		snprintf(info->reason, sizeof info->reason, "its profile is %s, not FULL_PROFILE", profile);
	info->works = !info->reason[0];
}

static void describe(const carom_cl_api *cl, carom_cl_found *f)
{
	carom_device_info *info = &f->info;
	cl_ulong width = get_number(cl, f->device, CL_DEVICE_IMAGE2D_MAX_WIDTH), height = get_number(cl, f->device, CL_DEVICE_IMAGE2D_MAX_HEIGHT);
	memset(info, 0, sizeof *info);
	cl->clGetPlatformInfo(f->platform, CL_PLATFORM_NAME, sizeof info->platform - 1, info->platform, NULL);
	get_text(cl, f->device, CL_DEVICE_NAME, info->name, sizeof info->name);
	get_text(cl, f->device, CL_DEVICE_VERSION, info->version, sizeof info->version);
	info->is_opencl = true;
	info->exact = (get_number(cl, f->device, CL_DEVICE_SINGLE_FP_CONFIG) & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
	info->has_images = get_number(cl, f->device, CL_DEVICE_IMAGE_SUPPORT) != 0;
	info->compute_units = (uint32_t)get_number(cl, f->device, CL_DEVICE_MAX_COMPUTE_UNITS);
	info->clock_mhz = (uint32_t)get_number(cl, f->device, CL_DEVICE_MAX_CLOCK_FREQUENCY);
	info->memory = get_number(cl, f->device, CL_DEVICE_GLOBAL_MEM_SIZE);
	info->max_allocation = get_number(cl, f->device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
	info->max_image_size = info->has_images ? (uint32_t)(width < height ? width : height) : 0;
	carom_cl_check_limits(cl, f);
	judge(cl, f);
}

/* Devices that work first, among them GPUs and accelerators, among those the most units times clock. */
static double rank(const carom_cl_api *cl, const carom_cl_found *f)
{
	double speed = (double)f->info.compute_units * (double)(f->info.clock_mhz ? f->info.clock_mhz : 1);
	cl_ulong type = get_number(cl, f->device, CL_DEVICE_TYPE);
	if (!f->info.works)
		return 0.0;
	return type & CL_DEVICE_TYPE_CPU ? speed : 1e12 + speed;
}

/* By rank; few and stable, so that equal devices keep the loader's order. */
static void sort(const carom_cl_api *cl, carom_cl_found *found, size_t count)
{
	for (size_t i = 1; i < count; i++) {
		carom_cl_found f = found[i];
		double r = rank(cl, &f);
		size_t k = i;
		for (; k > 0 && rank(cl, &found[k - 1]) < r; k--)
			found[k] = found[k - 1];
		found[k] = f;
	}
}

static carom_status append(const carom_cl_api *cl, cl_platform_id platform, carom_cl_found **found, size_t *count, carom_error *error)
{
	cl_uint more = 0;
	cl_device_id devices[64];
	carom_cl_found *grown;
	if (cl->clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 64, devices, &more) || !more)
		return CAROM_OK;
	if (more > 64)
		more = 64;
	grown = realloc(*found, (*count + more) * sizeof **found);
	if (!grown)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to list the OpenCL devices");
	*found = grown;
	for (cl_uint i = 0; i < more; i++) {
		carom_cl_found *f = &grown[(*count)++];
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
	if (cl->clGetPlatformIDs(32, platforms, &platform_count))
		return CAROM_OK; /* a loader without a driver says so by an error */
	for (cl_uint i = 0; i < platform_count && i < 32; i++) {
		carom_status status = append(cl, platforms[i], found, count, error);
		if (status) {
			free(*found);
			*found = NULL;
			return status;
		}
	}
	sort(cl, *found, *count);
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
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to list the OpenCL devices");
	for (size_t i = 0; *devices && i < *count; i++)
		(*devices)[i] = found[i].info;
	free(found);
	return status;
}
