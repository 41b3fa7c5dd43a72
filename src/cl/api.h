/* OpenCL, found at run time: the library starts on machines that have none. */
#ifndef CAROM_CL_API_H
#define CAROM_CL_API_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "carom.h"
#include "device.h"

/* Each function that is used, by name. */
#define CAROM_CL_FUNCTIONS(X)     \
	X(clGetPlatformIDs)           \
	X(clGetPlatformInfo)          \
	X(clGetDeviceIDs)             \
	X(clGetDeviceInfo)            \
	X(clCreateContext)            \
	X(clReleaseContext)           \
	X(clGetSupportedImageFormats) \
	X(clCreateCommandQueue)       \
	X(clReleaseCommandQueue)      \
	X(clCreateProgramWithSource)  \
	X(clBuildProgram)             \
	X(clGetProgramBuildInfo)      \
	X(clReleaseProgram)           \
	X(clCreateKernelsInProgram)   \
	X(clGetKernelInfo)            \
	X(clGetKernelWorkGroupInfo)   \
	X(clReleaseKernel)            \
	X(clSetKernelArg)             \
	X(clCreateBuffer)             \
	X(clCreateImage)              \
	X(clReleaseMemObject)         \
	X(clEnqueueFillBuffer)        \
	X(clEnqueueFillImage)         \
	X(clEnqueueWriteBuffer)       \
	X(clEnqueueReadBuffer)        \
	X(clEnqueueWriteImage)        \
	X(clEnqueueReadImage)         \
	X(clEnqueueNDRangeKernel)     \
	X(clFlush)                    \
	X(clFinish)                   \
	X(clGetEventProfilingInfo)    \
	X(clReleaseEvent)

typedef struct carom_cl_api {
#define CAROM_CL_MEMBER(name) __typeof__(&name) name;
	CAROM_CL_FUNCTIONS(CAROM_CL_MEMBER)
#undef CAROM_CL_MEMBER
} carom_cl_api;

/* False where there is no OpenCL loader, or one that is older than OpenCL 1.2. It stays loaded: drivers don't survive
 * being unloaded. */
bool carom_cl_load(carom_cl_api *api);

/* Fills in the error with the code's name: `what` says what could not be done. */
carom_status carom_cl_fail(carom_error *error, carom_status status, cl_int code, const char *what);

/* A device as OpenCL knows it, beside what users are told of it. */
typedef struct carom_cl_found {
	cl_platform_id platform;
	cl_device_id device;
	carom_device_info info;
} carom_cl_found;

/* All devices, the fastest that works first; *found is to be freed. */
carom_status carom_cl_find(const carom_cl_api *cl, carom_cl_found **found, size_t *count, carom_error *error);

/* Finds fault with the device (info.reason), or with its images alone (info.has_images), where it has less than Carom needs. */
void carom_cl_check_limits(const carom_cl_api *cl, carom_cl_found *found);
bool carom_cl_has_formats(const carom_cl_api *cl, cl_context context);

/* Builds the program of the chosen alternatives, of the step's slots or of those that draw; the head of the
 * log goes into the error. */
carom_status carom_cl_build(const carom_cl_api *cl, cl_context context, cl_device_id device, const carom_device_def *def, bool draws, bool images,
	bool exact, cl_program *program, carom_error *error);

#endif
