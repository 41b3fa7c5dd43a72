/* A device: something that holds textures and runs the stages' kernels over them. Two kinds exist, src/cl and src/cpu. */
#ifndef CAROM_DEVICE_H
#define CAROM_DEVICE_H

#include "carom.h"
#include "stage.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct carom_device carom_device;
typedef struct carom_texture carom_texture; /* each kind of device has its own */

typedef enum carom_texel_format {
	TEXELS_FLOAT,  /* four floats */
	TEXELS_BYTE,   /* four bytes */
	TEXELS_LIST,   /* one int; on every device a buffer: to kernels these are lists */
	TEXELS_RECORD, /* four floats, the same: records. On the CPU the four lie side by side */
} carom_texel_format;

/* Rows first: (x, y) is column x of row y. Functions that fail fill in the error. */
typedef struct carom_device_class {
	uint32_t tile_width, tile_height; /* pixels, of the tiles in which it draws */
	void (*close)(carom_device *device);
	/* Fills every texel with `fill` (floats; converted for bytes). CAROM_LIMIT if the device can't hold it. Errors call the texture
	 * by its name, which stays the caller's. */
	carom_status (*create)(carom_device *device, const char *name, carom_texel_format format, uint32_t width, uint32_t height, const float fill[4],
		carom_texture **texture, carom_error *error);
	/* Makes one of bytes that lie at `texels`, which stay the caller's: what kernels write there need not be downloaded. NULL where the device's memory is not the host's. */
	carom_status (*wrap)(carom_device *device, const char *name, uint32_t width, uint32_t height, void *texels, carom_texture **texture,
		carom_error *error);
	void (*destroy)(carom_device *device, carom_texture *texture);
	/* Whole rows from row 0 on, 4 x width floats or bytes each, or width ints. Uploading may return before it is done, but not before
	 * `texels` may be reused; downloading waits. */
	carom_status (*upload)(carom_device *device, carom_texture *texture, uint32_t rows, const void *texels, carom_error *error);
	carom_status (*download)(carom_device *device, carom_texture *texture, uint32_t rows, void *texels, carom_error *error);
	/* Does the chosen alternative have this kernel? */
	bool (*has)(const carom_device *device, carom_stage stage);
	/* Runs a stage's kernel once over domain[0] x domain[1] work-items, after all that was run before; may return at once.
	 * `textures` are those of the stage's definition. */
	carom_status (*run)(carom_device *device, carom_stage stage, carom_texture *const *textures, const int32_t domain[4], carom_error *error);
	/* Hands all that was run to the device, without waiting. */
	carom_status (*flush)(carom_device *device, carom_error *error);
	/* Brings device->times up to date, after waiting. */
	void (*profile)(carom_device *device);
	/* How many texels the kernels have read since it was asked last, below 2^32, where the def said to count them; 0 where it
	 * did not. The CPU device counts only in the slots reduce and vertices; and a pass of reduce that is counted asks each fragment,
	 * while others first ask whether any of a row has a hit. Waits. */
	carom_status (*reads)(carom_device *device, uint64_t *texels, carom_error *error);
} carom_device_class;

struct carom_device {
	const carom_device_class *kind;
	carom_device_info info;
	carom_storage storage;                /* what it really uses; BUFFER for the CPU */
	carom_kernel_time times[STAGE_COUNT]; /* where the def asked for a profile */
};

#define CAROM_MOST_THREADS 256 /* of the CPU device: a mistyped number should not take the machine down */

typedef struct carom_device_def {
	const char *name; /* auto, cpu, opencl, or part of a name; NULL: CAROM_DEVICE, else auto */
	carom_storage storage;
	uint32_t threads;        /* of the CPU device, CAROM_MOST_THREADS at most; 0 for one a core */
	carom_pipeline pipeline; /* resolved */
	bool profile;
	bool count_reads; /* for tests; it takes much time */
} carom_device_def;

/* Opens the device of that name: CAROM_UNKNOWN_NAME lists what there is. */
carom_status carom_device_open(const carom_device_def *def, carom_device **device, carom_error *error);
void carom_device_close(carom_device *device);

/* The two kinds. carom_cl_list lists every OpenCL device, the fastest that works first, CPUs after all others; none is no error. */
carom_status carom_cl_list(carom_device_info **devices, size_t *count, carom_error *error);
/* Fails where the environment's CAROM_KERNEL_DIR names no folder of kernels. */
carom_status carom_cl_check_override(carom_error *error);
/* Of the devices that are called so the one with so many `alike` before it in that list. */
carom_status carom_cl_open(const carom_device_def *def, const carom_device_info *which, size_t alike, carom_device **device, carom_error *error);
bool carom_cl_has_alternative(const char *slot, const char *alternative);
/* The index-th name of an alternative of `slot`, by name; NULL past the last. */
const char *carom_cl_alternative(const char *slot, size_t index);

#define CAROM_LARGE_PAGES (2u << 20) /* bytes: less holds no large page */
/* Asks the system for large pages for memory that nobody has touched yet; where it has none, or none fits, nothing happens. */
void carom_prefer_large_pages(void *memory, size_t size);

void carom_cpu_info(carom_device_info *info);
carom_status carom_cpu_open(const carom_device_def *def, carom_device **device, carom_error *error);
/* The same stages in double precision: the tests' oracle. Uploads floats and downloads doubles (bytes stay bytes). */
carom_status carom_cpu_open_double(const carom_device_def *def, carom_device **device, carom_error *error);
const char *carom_cpu_alternative(const char *slot, size_t index);
bool carom_cpu_has_alternative(const char *slot, const char *alternative);

#ifdef __cplusplus
}
#endif
#endif
