/* OpenCL as Carom finds it: every call goes on to the machine's loader, unless it is the one to fail.
 * SPDX-License-Identifier: MIT */
#include "faults.h"

#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <tuple>
#include <type_traits>

#include "cl/functions.h"

static faults_loader loader;

void faults_loader_set(faults_loader how)
{
	loader = how;
}

/* ---- Objects */

struct Object {
	const void *handle; /* NULL where the place is free */
	const char *call;
};

static Object objects[4096];

static void created(const void *handle, const char *call)
{
	for (Object &object : objects) {
		if (!object.handle) {
			object = {handle, call};
			return;
		}
	}
}

static void released(const void *handle)
{
	for (Object &object : objects) {
		if (object.handle == handle) {
			object = {};
			return;
		}
	}
}

size_t faults_alive(char *kinds, size_t size)
{
	size_t count = 0, used = 0;
	kinds[0] = '\0';
	for (const Object &object : objects) {
		if (!object.handle)
			continue;
		count++;
		if (used < size)
			used += static_cast<size_t>(std::snprintf(kinds + used, size - used, " %s", object.call));
	}
	return count;
}

/* ---- Calls */

/* The functions by number, which is what tells the instances of Call apart. */
enum Function {
#define NUMBER(name) number_##name,
	CAROM_CL_FUNCTIONS(NUMBER)
#undef NUMBER
		function_count
};

static void *functions[function_count]; /* the loader's own */

static const char *const names[] = {
#define NAME(name) #name,
	CAROM_CL_FUNCTIONS(NAME)
#undef NAME
};

static bool starts(const char *text, const char *part)
{
	return std::strncmp(text, part, std::strlen(part)) == 0;
}

static bool fails_now(const char *call)
{
	const bool is_of_programs = std::strstr(call, "Program") || starts(call, "clGetPlatform") || starts(call, "clGetDevice");
	return faults_strike(FAULTS_OPENCL, call) || (is_of_programs && faults_strike(FAULTS_PROGRAMS, call));
}

template <typename Value> static const void *handle_of(Value value)
{
	if constexpr (std::is_pointer_v<Value>)
		return value;
	else
		return nullptr;
}

template <int function, typename Pointer> struct Call;

template <int function, typename Result, typename... Arguments> struct Call<function, Result (*)(Arguments...)> {
	static Result call(Arguments... arguments)
	{
		const std::tuple<Arguments...> all(arguments...);
		const auto first = std::get<0>(all);
		const bool releases = starts(names[function], "clRelease") || function == number_clEnqueueUnmapMemObject;
		const bool fails = fails_now(names[function]);
		if (fails && !releases)
			return failure(std::get<sizeof...(Arguments) - 1>(all));
		if constexpr (function == number_clEnqueueUnmapMemObject)
			released(std::get<2>(all));
		else if (releases)
			released(handle_of(first));
		const Result result = reinterpret_cast<Result (*)(Arguments...)>(functions[function])(arguments...);
		note(result, all);
		if constexpr (std::is_same_v<Result, cl_int>)
			return fails ? faults_code() : result;
		else
			return result;
	}

private:
	/* What creates says why not by its last argument. */
	template <typename Last> static Result failure(Last last)
	{
		if constexpr (std::is_same_v<Result, cl_int>) {
			return faults_code();
		} else {
			*last = faults_code();
			return nullptr;
		}
	}

	static void note(Result result, const std::tuple<Arguments...> &all)
	{
		if constexpr (function == number_clCreateKernelsInProgram) {
			for (cl_uint k = 0; result == CL_SUCCESS && k < *std::get<3>(all); k++)
				created(std::get<2>(all)[k], names[function]);
		} else if constexpr (function == number_clEnqueueNDRangeKernel) {
			if (result == CL_SUCCESS && std::get<8>(all))
				created(*std::get<8>(all), names[function]);
		} else if constexpr (!std::is_same_v<Result, cl_int>) {
			if (result)
				created(result, names[function]);
		}
	}
};

static cl_int no_platforms(cl_uint, cl_platform_id *, cl_uint *count)
{
	*count = 0;
	return -1001; /* CL_PLATFORM_NOT_FOUND_KHR */
}

static cl_int inexact_info(cl_device_id device, cl_device_info name, size_t size, void *value, size_t *used)
{
	const auto real = reinterpret_cast<decltype(&clGetDeviceInfo)>(functions[number_clGetDeviceInfo]);
	const cl_int code = real(device, name, size, value, used);
	if (code == CL_SUCCESS && name == CL_DEVICE_SINGLE_FP_CONFIG && value)
		*static_cast<cl_device_fp_config *>(value) &= ~static_cast<cl_device_fp_config>(CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT);
	return code;
}

static cl_int gpu_info(cl_device_id device, cl_device_info name, size_t size, void *value, size_t *used)
{
	const auto real = reinterpret_cast<decltype(&clGetDeviceInfo)>(functions[number_clGetDeviceInfo]);
	const cl_int code = real(device, name, size, value, used);
	if (code == CL_SUCCESS && name == CL_DEVICE_TYPE && value)
		*static_cast<cl_device_type *>(value) = CL_DEVICE_TYPE_GPU;
	return code;
}

/* Where the device can't, the option is an error. */
static cl_int inexact_build(cl_program program, cl_uint count, const cl_device_id *devices, const char *options, void (*told)(cl_program, void *),
	void *data)
{
	if (std::strstr(options, "-cl-fp32-correctly-rounded-divide-sqrt"))
		return CL_INVALID_BUILD_OPTIONS;
	return reinterpret_cast<decltype(&clBuildProgram)>(functions[number_clBuildProgram])(program, count, devices, options, told, data);
}

static cl_int no_devices(cl_platform_id, cl_device_type, cl_uint, cl_device_id *, cl_uint *)
{
	return CL_DEVICE_NOT_FOUND;
}

/* ---- What Carom links with */

extern "C" void *__real_dlopen(const char *path, int flags);
extern "C" void *__wrap_dlopen(const char *path, int flags);
extern "C" void *__wrap_dlopen(const char *path, int flags)
{
	return loader == LOADER_NONE ? nullptr : __real_dlopen(path, flags);
}

extern "C" void *__real_dlsym(void *handle, const char *name);
extern "C" void *__wrap_dlsym(void *handle, const char *name);
extern "C" void *__wrap_dlsym(void *handle, const char *name)
{
	void *const real = __real_dlsym(handle, name);
	if (loader == LOADER_OLD && std::strcmp(name, "clEnqueueFillImage") == 0) /* of OpenCL 1.2 */
		return nullptr;
	if (loader == LOADER_WITHOUT_PLATFORMS && std::strcmp(name, "clGetPlatformIDs") == 0)
		return reinterpret_cast<void *>(no_platforms);
	if (loader == LOADER_WITHOUT_DEVICES && std::strcmp(name, "clGetDeviceIDs") == 0)
		return reinterpret_cast<void *>(no_devices);
	if ((loader == LOADER_INEXACT || loader == LOADER_GPU) && std::strcmp(name, "clGetDeviceInfo") == 0) {
		functions[number_clGetDeviceInfo] = real;
		return reinterpret_cast<void *>(loader == LOADER_GPU ? gpu_info : inexact_info);
	}
	if (loader == LOADER_INEXACT && std::strcmp(name, "clBuildProgram") == 0) {
		functions[number_clBuildProgram] = real;
		return reinterpret_cast<void *>(inexact_build);
	}
#define SHIM(function)                                                                       \
	if (std::strcmp(name, #function) == 0) {                                                 \
		functions[number_##function] = real;                                                 \
		return reinterpret_cast<void *>(Call<number_##function, decltype(&function)>::call); \
	}
	CAROM_CL_FUNCTIONS(SHIM)
#undef SHIM
	return real;
}
