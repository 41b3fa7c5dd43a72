/* The limits of a device that Carom needs beside room for its textures: asked for before anything is made. */
#include <string.h>

#include "cl/api.h"
#include "device.h"
#include "stage.h"

/* What the kernel with the most of them takes: textures to read, textures to write, bytes of arguments. */
static void count_arguments(cl_uint *inputs, cl_uint *outputs, size_t *bytes)
{
	*inputs = *outputs = 0;
	*bytes = 0;
	for (int i = 0; i < STAGE_COUNT; i++) {
		const cl_uint in = (cl_uint)carom_stages[i].input_count, out = (cl_uint)carom_stages[i].output_count;
		const size_t size = (in + out) * (2 * sizeof(cl_mem) + sizeof(cl_int)) + sizeof(cl_int4); /* memory, width, counter of reads; domain */
		*inputs = in > *inputs ? in : *inputs;
		*outputs = out > *outputs ? out : *outputs;
		*bytes = size > *bytes ? size : *bytes;
	}
}

static bool is_too_old(const carom_device_info *info)
{
	unsigned major, minor;
	return sscanf(info->version, "OpenCL %u.%u", &major, &minor) != 2 || major < 1 || (major == 1 && minor < 2);
}

void carom_cl_check_limits(const carom_cl_api *cl, carom_cl_found *f)
{
	carom_device_info *info = &f->info;
	const cl_ulong dimensions = carom_cl_get_number(cl, f, CL_DEVICE_MAX_WORK_ITEM_DIMENSIONS);
	const cl_ulong arguments = carom_cl_get_number(cl, f, CL_DEVICE_MAX_PARAMETER_SIZE);
	cl_uint inputs, outputs;
	size_t bytes;
	count_arguments(&inputs, &outputs, &bytes);
	if (carom_cl_get_number(cl, f, CL_DEVICE_MAX_READ_IMAGE_ARGS) < inputs || carom_cl_get_number(cl, f, CL_DEVICE_MAX_WRITE_IMAGE_ARGS) < outputs)
		info->has_images = false;
	if (info->reason[0])
		return;
	if (is_too_old(info))
		snprintf(info->reason, sizeof info->reason, "it has %.64s; Carom needs OpenCL 1.2", info->version);
	else if (dimensions < 2)
		snprintf(info->reason, sizeof info->reason, "its kernels run over %u dimensions; Carom needs 2", (unsigned)dimensions);
	else if (arguments < bytes)
		snprintf(info->reason, sizeof info->reason, "its kernels take %llu bytes of arguments; Carom needs %zu", (unsigned long long)arguments,
			bytes);
}

/* Can images of texels of four floats and of four bytes be read and written? Full profiles must, but they are asked. */
cl_int carom_cl_has_formats(const carom_cl_api *cl, cl_context context, bool *has)
{
	cl_image_format formats[512];
	cl_uint count = 0;
	bool floats = false, bytes = false;
	cl_int code = cl->clGetSupportedImageFormats(context, CL_MEM_READ_WRITE, CL_MEM_OBJECT_IMAGE2D, 512, formats, &count);
	for (cl_uint i = 0; !code && i < count && i < 512; i++) {
		floats |= formats[i].image_channel_order == CL_RGBA && formats[i].image_channel_data_type == CL_FLOAT;
		bytes |= formats[i].image_channel_order == CL_RGBA && formats[i].image_channel_data_type == CL_UNSIGNED_INT8;
	}
	*has = floats && bytes;
	return code;
}
