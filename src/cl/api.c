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
#define LOAD(name)                                    \
	symbol = dlsym(loader, #name);                     \
	if (!symbol)                                       \
		return false;                                  \
	memcpy(&api->name, &symbol, sizeof symbol); /* ISO C has no cast from an object's to a function's pointer */
	CAROM_CL_FUNCTIONS(LOAD)
#undef LOAD
	return true;
}

static const char *code_name(cl_int code)
{
	switch (code) {
#define NAME(name) \
	case name: return #name;
		NAME(CL_DEVICE_NOT_AVAILABLE) NAME(CL_COMPILER_NOT_AVAILABLE) NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE) NAME(CL_OUT_OF_RESOURCES)
		NAME(CL_OUT_OF_HOST_MEMORY) NAME(CL_IMAGE_FORMAT_NOT_SUPPORTED) NAME(CL_BUILD_PROGRAM_FAILURE) NAME(CL_INVALID_VALUE)
		NAME(CL_INVALID_DEVICE) NAME(CL_INVALID_CONTEXT) NAME(CL_INVALID_QUEUE_PROPERTIES) NAME(CL_INVALID_COMMAND_QUEUE)
		NAME(CL_INVALID_MEM_OBJECT) NAME(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR) NAME(CL_INVALID_IMAGE_SIZE) NAME(CL_INVALID_BUILD_OPTIONS)
		NAME(CL_INVALID_PROGRAM_EXECUTABLE) NAME(CL_INVALID_KERNEL_NAME) NAME(CL_INVALID_KERNEL_ARGS) NAME(CL_INVALID_ARG_VALUE)
		NAME(CL_INVALID_ARG_SIZE) NAME(CL_INVALID_WORK_GROUP_SIZE) NAME(CL_INVALID_GLOBAL_WORK_SIZE) NAME(CL_INVALID_OPERATION)
		NAME(CL_INVALID_BUFFER_SIZE)
#undef NAME
	default: return "OpenCL error";
	}
}

carom_status carom_cl_fail(carom_error *error, carom_status status, cl_int code, const char *what)
{
	carom_fail(error, status, "%s: %s (%d)", what, code_name(code), (int)code);
	if (error)
		error->opencl_code = code;
	return status;
}
