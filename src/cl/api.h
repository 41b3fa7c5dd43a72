/* OpenCL, found at run time: the library starts on machines that have none. */
#ifndef CAROM_CL_API_H
#define CAROM_CL_API_H

#include "carom.h"
#include "cl/functions.h"
#include "device.h"

typedef struct carom_cl_api {
#define CAROM_CL_MEMBER(name) __typeof__(&name) name;
	CAROM_CL_FUNCTIONS(CAROM_CL_MEMBER)
#undef CAROM_CL_MEMBER
} carom_cl_api;

/* False where there is no OpenCL loader, or one that is older than OpenCL 1.2. It stays loaded: drivers don't survive
 * being unloaded. */
bool carom_cl_load(carom_cl_api *api);

/* "CL_OUT_OF_RESOURCES", ...; "OpenCL error" for what is not in the list */
const char *carom_cl_code_name(cl_int code);
/* Fills in the error with the code's name: `what` says what could not be done. CAROM_OUT_OF_MEMORY or CAROM_DEVICE. */
carom_status carom_cl_fail(carom_error *error, cl_int code, const char *what);

/* A device as OpenCL knows it, beside what users are told of it. */
typedef struct carom_cl_found {
	cl_platform_id platform;
	cl_device_id device;
	carom_device_info info;
} carom_cl_found;

/* All devices, the fastest that works first, CPUs after all others; *found is to be freed. */
carom_status carom_cl_find(const carom_cl_api *cl, carom_cl_found **found, size_t *count, carom_error *error);

/* 0 where the device does not say; then it does not work, and its reason tells. */
cl_ulong carom_cl_get_number(const carom_cl_api *cl, carom_cl_found *found, cl_device_info what);
/* Finds fault with the device (info.reason), or with its images alone (info.has_images), where it has less than Carom needs. */
void carom_cl_check_limits(const carom_cl_api *cl, carom_cl_found *found);
/* Can images hold what Carom puts into them? */
cl_int carom_cl_has_formats(const carom_cl_api *cl, cl_context context, bool *has);

/* The text of the program of the chosen alternatives, of the step's slots or of those that draw, to be freed. */
carom_status carom_cl_collect(const carom_pipeline *pipeline, bool draws, bool is_gpu, char **text, carom_error *error);

#define CAROM_CL_OPTIONS 256 /* characters at most */

/* A program that was built, with what it was built from. */
typedef struct carom_cl_program {
	cl_program id;
	char options[CAROM_CL_OPTIONS], *text;
	size_t users;
	struct carom_cl_program *next;
} carom_cl_program;

/* A device's context, with its programs: all worlds on the device share it. */
typedef struct carom_cl_context {
	cl_context id;
	cl_device_id device;
	carom_cl_program *programs;
	size_t users;
	struct carom_cl_context *next;
} carom_cl_context;

/* The context of that device, until it is left. These four may be called by several threads at once. */
carom_status carom_cl_enter(const carom_cl_api *cl, const carom_cl_found *found, carom_cl_context **context, carom_error *error);
void carom_cl_leave(const carom_cl_api *cl, carom_cl_context *context);
/* The program of the chosen alternatives, likewise, until it is dropped; built, where no other world has it. Then others wait. The head of the
 * build's log goes into the error. */
carom_status carom_cl_take_program(const carom_cl_api *cl, carom_cl_context *context, const carom_device_def *def, bool draws, bool images,
	const carom_device_info *info, carom_cl_program **program, carom_error *error);
void carom_cl_drop_program(const carom_cl_api *cl, carom_cl_context *context, carom_cl_program *program);

/* A place for a program among those kept in the folder that CAROM_CACHE names. NULL, which all take, where nothing is kept. */
typedef struct carom_cl_entry carom_cl_entry;
carom_cl_entry *carom_cl_cache_find(const carom_cl_api *cl, cl_device_id device, const char *options, const char *text);
/* The program, built; NULL if it is not there, or not what it was when it was kept. */
cl_program carom_cl_cache_load(const carom_cl_entry *entry, const carom_cl_api *cl, cl_context context, cl_device_id device, const char *options);
/* Keeps a program that was built, in place of what is there, if it can. */
void carom_cl_cache_keep(const carom_cl_entry *entry, const carom_cl_api *cl, cl_program program);
void carom_cl_cache_leave(carom_cl_entry *entry);

/* All of a file, with a NUL behind it, to be freed; NULL if it can't be read. */
char *carom_cl_read_file(const char *path, size_t *size);

#endif
