/* Textures of the OpenCL device: images, or buffers of the same rows. */
#include <stdlib.h>
#include <string.h>

#include "cl/texture.h"
#include "status.h"

#define SMALL 16384 /* bytes, at most */

static size_t texel_size(carom_texel_format format)
{
	return format == TEXELS_FLOAT || format == TEXELS_RECORD ? 4 * sizeof(float) : 4; /* bytes, or an int */
}

bool carom_cl_is_list(carom_texel_format format)
{
	return format == TEXELS_LIST || format == TEXELS_RECORD;
}

carom_status carom_cl_device_fail(const cl_device *d, carom_error *error, cl_int code, const char *what)
{
	char text[640];
	snprintf(text, sizeof text, "%s: %s", d->base.info.name, what);
	return carom_cl_fail(error, code, text);
}

static size_t size_of(const carom_texture *t, uint32_t rows)
{
	return (size_t)t->width * rows * texel_size(t->format);
}

/* Of a CPU, to which reading whole textures takes a fifth less then. It has to be asked for before they are touched. */
static cl_int ask_for_large_pages(cl_device *d, carom_texture *t)
{
	const size_t size = size_of(t, t->height);
	cl_int code;
	if (size < CAROM_LARGE_PAGES)
		return CL_SUCCESS; /* the calls take longer than what they are about */
	void *memory = d->cl.clEnqueueMapBuffer(d->queue, t->memory, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, size, 0, NULL, NULL, &code);
	if (code)
		return code;
	carom_prefer_large_pages(memory, size);
	return d->cl.clEnqueueUnmapMemObject(d->queue, t->memory, memory, 0, NULL, NULL);
}

/* Those of small worlds, each of which would take the queue as long as a kernel. */
static cl_int make_small_buffer(cl_device *d, carom_texture *t, const void *texel)
{
	const size_t size = size_of(t, t->height);
	char texels[SMALL];
	cl_int code;
	for (size_t i = 0; i < size; i += texel_size(t->format))
		memcpy(texels + i, texel, texel_size(t->format));
	t->memory = d->cl.clCreateBuffer(d->context->id, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, size, texels, &code);
	return code;
}

/* Drivers allocate when a texture is first touched: filling it now makes it fail now. */
static cl_int make_buffer(cl_device *d, carom_texture *t, const void *texel)
{
	const size_t size = size_of(t, t->height);
	cl_int code;
	if (size <= SMALL)
		return make_small_buffer(d, t, texel);
	t->memory = d->cl.clCreateBuffer(d->context->id, CL_MEM_READ_WRITE, size, NULL, &code);
	if (!code && d->is_cpu)
		code = ask_for_large_pages(d, t);
	if (!code)
		code = d->cl.clEnqueueFillBuffer(d->queue, t->memory, texel, texel_size(t->format), 0, size, 0, NULL, NULL);
	return code ? code : d->cl.clFinish(d->queue);
}

static cl_int make_image(cl_device *d, carom_texture *t, const void *color)
{
	const cl_image_format format = {CL_RGBA, t->format == TEXELS_FLOAT ? CL_FLOAT : CL_UNSIGNED_INT8};
	const cl_image_desc desc = {.image_type = CL_MEM_OBJECT_IMAGE2D, .image_width = t->width, .image_height = t->height};
	const size_t origin[3] = {0, 0, 0}, region[3] = {t->width, t->height, 1};
	cl_int code;
	t->memory = d->cl.clCreateImage(d->context->id, CL_MEM_READ_WRITE, &format, &desc, NULL, &code);
	if (!code)
		code = d->cl.clEnqueueFillImage(d->queue, t->memory, color, origin, region, 0, NULL, NULL);
	return code ? code : d->cl.clFinish(d->queue);
}

/* Every texel is `fill`. */
static cl_int make_texture(cl_device *d, carom_texture *t, const float fill[4])
{
	const bool floats = texel_size(t->format) == sizeof(float[4]);
	cl_uint color[4];
	cl_uchar bytes[4];
	for (int i = 0; i < 4; i++) {
		bytes[i] = (cl_uchar)fill[i];
		color[i] = bytes[i];
	}
	if (t->is_image)
		return make_image(d, t, floats ? (const void *)fill : color);
	return make_buffer(d, t, floats ? (const void *)fill : bytes);
}

void carom_cl_destroy_texture(carom_device *device, carom_texture *texture)
{
	if (!texture)
		return;
	/* an address may come again for another texture: forget what was bound */
	for (int i = 0; i < STAGE_COUNT; i++)
		memset(carom_cl_of(device)->kernels[i].textures, 0, sizeof carom_cl_of(device)->kernels[i].textures);
	if (texture->memory)
		carom_cl_of(device)->cl.clReleaseMemObject(texture->memory);
	free(texture);
}

static carom_status check_limits(const cl_device *d, const carom_texture *t, carom_error *error)
{
	const carom_device_info *info = &d->base.info;
	const uint64_t bytes = size_of(t, t->height);
	if (t->is_image && (t->width > info->max_image_size || t->height > info->max_image_size))
		return carom_fail(error, CAROM_LIMIT,
			"%s, %u x %u texels, can't be made: the sides of images on '%s' have at most %u; buffer storage has no such limit", t->name, t->width,
			t->height, info->name, info->max_image_size);
	if (bytes > info->max_allocation)
		return carom_fail(error, CAROM_LIMIT, "%s, %u x %u texels, can't be made: it takes %llu bytes, and '%s' gives at most %llu for one", t->name,
			t->width, t->height, (unsigned long long)bytes, info->name, (unsigned long long)info->max_allocation);
	return CAROM_OK;
}

static carom_status fail(const carom_device *device, const carom_texture *t, cl_int code, const char *what, carom_error *error)
{
	char text[256];
	snprintf(text, sizeof text, "%s, %u x %u texels (%zu KiB), can't be %s", t->name, (unsigned)t->width, (unsigned)t->height,
		(size_of(t, t->height) + 1023) / 1024, what);
	return carom_cl_device_fail(carom_cl_of(device), error, code, text);
}

carom_status carom_cl_create_texture(carom_device *device, const char *name, carom_texel_format format, uint32_t width, uint32_t height,
	const float fill[4], carom_texture **texture, carom_error *error)
{
	cl_device *d = carom_cl_of(device);
	carom_texture *t = calloc(1, sizeof *t);
	carom_status status;
	cl_int code;
	if (!t)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the texture %s", name);
	t->name = name;
	t->width = width;
	t->height = height;
	t->format = format;
	t->is_image = device->storage == CAROM_STORAGE_IMAGE && !carom_cl_is_list(format);
	status = check_limits(d, t, error);
	if (status) {
		free(t);
		return status;
	}
	code = make_texture(d, t, fill);
	if (code) {
		status = fail(device, t, code, "made", error);
		carom_cl_destroy_texture(device, t);
		return status;
	}
	*texture = t;
	return CAROM_OK;
}

carom_status carom_cl_upload(carom_device *device, carom_texture *t, uint32_t rows, const void *texels, carom_error *error)
{
	cl_device *d = carom_cl_of(device);
	size_t origin[3] = {0, 0, 0}, region[3] = {t->width, rows, 1};
	cl_int code = t->is_image ? d->cl.clEnqueueWriteImage(d->queue, t->memory, CL_TRUE, origin, region, 0, 0, texels, 0, NULL, NULL)
							  : d->cl.clEnqueueWriteBuffer(d->queue, t->memory, CL_TRUE, 0, size_of(t, rows), texels, 0, NULL, NULL);
	return code ? fail(device, t, code, "written", error) : CAROM_OK;
}

carom_status carom_cl_download(carom_device *device, carom_texture *t, uint32_t rows, void *texels, carom_error *error)
{
	cl_device *d = carom_cl_of(device);
	size_t origin[3] = {0, 0, 0}, region[3] = {t->width, rows, 1};
	cl_int code = t->is_image ? d->cl.clEnqueueReadImage(d->queue, t->memory, CL_TRUE, origin, region, 0, 0, texels, 0, NULL, NULL)
							  : d->cl.clEnqueueReadBuffer(d->queue, t->memory, CL_TRUE, 0, size_of(t, rows), texels, 0, NULL, NULL);
	return code ? fail(device, t, code, "read", error) : CAROM_OK;
}
