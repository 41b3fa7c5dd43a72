/* What the parts of the OpenCL device share. */
#ifndef CAROM_CL_TEXTURE_H
#define CAROM_CL_TEXTURE_H

#include "cl/api.h"
#include "device.h"

#define MAX_PENDING 1024

/* The last argument set, to spare the calls that would change nothing. */
typedef struct bound_kernel {
	cl_kernel kernel; /* NULL where the alternative has none */
	size_t local;     /* work-items of a group */
	const carom_texture *textures[CAROM_MAX_TEXTURES];
} bound_kernel;

typedef struct cl_device {
	carom_device base;
	carom_cl_api cl;
	carom_cl_context *context;
	cl_command_queue queue;
	bool is_cpu;
	carom_device_def def;          /* as given; only its pipeline and flags are good for later */
	carom_cl_program *programs[2]; /* of the step's stages, and of rendering's, which is NULL until the first is run */
	cl_mem reads;                  /* one uint; NULL where reads are not counted */
	bound_kernel kernels[STAGE_COUNT];
	bool profile;
	size_t pending; /* launches whose times are not read yet */
	cl_event events[MAX_PENDING];
	carom_stage event_stages[MAX_PENDING];
} cl_device;

struct carom_texture {
	cl_mem memory;
	bool is_image;
	const char *name;
	carom_texel_format format;
	uint32_t width, height;
};

cl_device *carom_cl_of(const carom_device *device);
/* Is it a buffer whatever the storage, and bare to kernels? */
bool carom_cl_is_list(carom_texel_format format);
carom_status carom_cl_device_fail(const cl_device *d, carom_error *error, cl_int code, const char *what);

/* texture.c: of the device's class */
carom_status carom_cl_create_texture(carom_device *device, const char *name, carom_texel_format format, uint32_t width, uint32_t height,
	const float fill[4], carom_texture **texture, carom_error *error);
void carom_cl_destroy_texture(carom_device *device, carom_texture *texture);
carom_status carom_cl_upload(carom_device *device, carom_texture *t, uint32_t rows, const void *texels, carom_error *error);
carom_status carom_cl_download(carom_device *device, carom_texture *t, uint32_t rows, void *texels, carom_error *error);

#endif
