#include "cl/api.h"

#include <dlfcn.h>
#include <string.h>

#include "status.h"

static void *open_loader(void)
{
	static const char *const names[] = {"libOpenCL.so.1", "libOpenCL.so", "/System/Library/Frameworks/OpenCL.framework/OpenCL"};
	for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
		void *loader = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
		if (loader)
			return loader;
	}
	return NULL;
}

bool carom_cl_load(carom_cl_api *api)
{
	void *loader = open_loader(), *symbol;
	if (!loader)
		return false;
#define LOAD(name)                 \
	symbol = dlsym(loader, #name); \
	if (!symbol)                   \
		return false;              \
	memcpy(&api->name, &symbol, sizeof symbol); /* ISO C has no cast from an object's to a function's pointer */
	CAROM_CL_FUNCTIONS(LOAD)
#undef LOAD
	return true;
}

const char *carom_cl_code_name(cl_int code)
{
#define NAMED(name) \
	{               \
		name, #name \
	}
	static const struct {
		cl_int code;
		const char *name;
	} named[] = {
		NAMED(CL_DEVICE_NOT_AVAILABLE),
		NAMED(CL_COMPILER_NOT_AVAILABLE),
		NAMED(CL_MEM_OBJECT_ALLOCATION_FAILURE),
		NAMED(CL_OUT_OF_RESOURCES),
		NAMED(CL_OUT_OF_HOST_MEMORY),
		NAMED(CL_IMAGE_FORMAT_NOT_SUPPORTED),
		NAMED(CL_BUILD_PROGRAM_FAILURE),
		NAMED(CL_INVALID_VALUE),
		NAMED(CL_INVALID_DEVICE),
		NAMED(CL_INVALID_CONTEXT),
		NAMED(CL_INVALID_QUEUE_PROPERTIES),
		NAMED(CL_INVALID_COMMAND_QUEUE),
		NAMED(CL_INVALID_MEM_OBJECT),
		NAMED(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
		NAMED(CL_INVALID_IMAGE_SIZE),
		NAMED(CL_INVALID_BUILD_OPTIONS),
		NAMED(CL_INVALID_PROGRAM_EXECUTABLE),
		NAMED(CL_INVALID_KERNEL_NAME),
		NAMED(CL_INVALID_KERNEL_ARGS),
		NAMED(CL_INVALID_ARG_VALUE),
		NAMED(CL_INVALID_ARG_SIZE),
		NAMED(CL_INVALID_WORK_GROUP_SIZE),
		NAMED(CL_INVALID_GLOBAL_WORK_SIZE),
		NAMED(CL_INVALID_OPERATION),
		NAMED(CL_INVALID_BUFFER_SIZE),
	};
#undef NAMED
	for (size_t i = 0; i < sizeof named / sizeof *named; i++)
		if (named[i].code == code)
			return named[i].name;
	return "OpenCL error";
}

carom_status carom_cl_fail(carom_error *error, cl_int code, const char *what)
{
	const bool memory = code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY || code == CL_OUT_OF_RESOURCES;
	const carom_status status = memory ? CAROM_OUT_OF_MEMORY : CAROM_DEVICE;
	carom_fail(error, status, "%s: %s (%d)", what, carom_cl_code_name(code), (int)code);
	if (error)
		error->opencl_code = code;
	return status;
}
