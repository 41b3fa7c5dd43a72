/* What is used of OpenCL. */
#ifndef CAROM_CL_FUNCTIONS_H
#define CAROM_CL_FUNCTIONS_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

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
	X(clCreateProgramWithBinary)  \
	X(clGetProgramInfo)           \
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
	X(clEnqueueMapBuffer)         \
	X(clEnqueueUnmapMemObject)    \
	X(clEnqueueNDRangeKernel)     \
	X(clFlush)                    \
	X(clFinish)                   \
	X(clGetEventProfilingInfo)    \
	X(clReleaseEvent)

#endif
