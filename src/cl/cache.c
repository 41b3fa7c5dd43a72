/* Programs that were built before, as files in the folder that the environment's CAROM_CACHE names. A file has the key, which is all that decides what is
 * built, then the program, then a checksum of both: drivers crash where a program is cut short. Whatever is wrong with a file or the folder, kernels are
 * built from their sources, as if there were none. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cl/api.h"

struct carom_cl_entry {
	char path[4096];
	char *key; /* text, with the NUL at its end */
	size_t size;
};

/* FNV-1a */
static uint64_t hash(const char *bytes, size_t size)
{
	uint64_t h = 14695981039346656037u;
	for (size_t i = 0; i < size; i++)
		h = (h ^ (unsigned char)bytes[i]) * 1099511628211u;
	return h;
}

static bool write_device(FILE *key, const carom_cl_api *cl, cl_device_id device)
{
	static const cl_platform_info of_platform[] = {CL_PLATFORM_NAME, CL_PLATFORM_VERSION};
	static const cl_device_info of_device[] = {CL_DEVICE_VENDOR, CL_DEVICE_NAME, CL_DEVICE_VERSION, CL_DRIVER_VERSION};
	char text[4096] = "";
	cl_platform_id platform;
	cl_int code = cl->clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
	for (size_t i = 0; !code && i < sizeof of_platform / sizeof *of_platform; i++) {
		code = cl->clGetPlatformInfo(platform, of_platform[i], sizeof text, text, NULL);
		fprintf(key, "%s\n", text);
	}
	for (size_t i = 0; !code && i < sizeof of_device / sizeof *of_device; i++) {
		code = cl->clGetDeviceInfo(device, of_device[i], sizeof text, text, NULL);
		fprintf(key, "%s\n", text);
	}
	return !code;
}

static bool make_key(carom_cl_entry *e, const carom_cl_api *cl, cl_device_id device, const char *options, const char *text)
{
	FILE *key = open_memstream(&e->key, &e->size);
	if (!key)
		return false;
	fprintf(key, "carom %s\n", carom_version());
	const bool known = write_device(key, cl, device);
	fprintf(key, "%s\n%s", options, text);
	fputc('\0', key);
	const bool whole = !ferror(key);
	return !fclose(key) && whole && known;
}

carom_cl_entry *carom_cl_cache_find(const carom_cl_api *cl, cl_device_id device, const char *options, const char *text)
{
	const char *folder = getenv("CAROM_CACHE");
	carom_cl_entry *e = folder && *folder ? calloc(1, sizeof *e) : NULL;
	if (!e)
		return NULL;
	if (make_key(e, cl, device, options, text)) {
		int length = snprintf(e->path, sizeof e->path, "%s/carom-%016" PRIx64 ".kernels", folder, hash(e->key, e->size));
		if (length > 0 && (size_t)length < sizeof e->path) {
			mkdir(folder, 0700); /* its owner's alone: what is in it is run */
			return e;
		}
	}
	carom_cl_cache_leave(e);
	return NULL;
}

void carom_cl_cache_leave(carom_cl_entry *e)
{
	if (e)
		free(e->key);
	free(e);
}

static bool is_whole(const carom_cl_entry *e, const char *file, size_t size)
{
	uint64_t checksum;
	if (size <= e->size + sizeof checksum || memcmp(file, e->key, e->size) != 0)
		return false;
	memcpy(&checksum, file + size - sizeof checksum, sizeof checksum);
	return checksum == hash(file, size - sizeof checksum);
}

cl_program carom_cl_cache_load(const carom_cl_entry *e, const carom_cl_api *cl, cl_context context, cl_device_id device, const char *options)
{
	size_t size = 0;
	char *file = e ? carom_cl_read_file(e->path, &size) : NULL;
	cl_program program = NULL;
	if (file && is_whole(e, file, size)) {
		const unsigned char *binary = (const unsigned char *)file + e->size;
		const size_t length = size - e->size - sizeof(uint64_t);
		cl_int code;
		program = cl->clCreateProgramWithBinary(context, 1, &device, &length, &binary, NULL, &code);
		if (program && cl->clBuildProgram(program, 1, &device, options, NULL, NULL)) {
			cl->clReleaseProgram(program);
			program = NULL;
		}
	}
	free(file);
	return program;
}

static void write_file(const char *path, const char *bytes, size_t size)
{
	carom_file *file;
	FILE *stream;
	if (carom_file_create(path, &file, &stream, NULL))
		return;
	fwrite(bytes, 1, size, stream);
	carom_file_commit(file, NULL);
}

void carom_cl_cache_keep(const carom_cl_entry *e, const carom_cl_api *cl, cl_program program)
{
	size_t length = 0;
	if (!e || cl->clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof length, &length, NULL) || !length)
		return;
	const size_t size = e->size + length;
	char *file = malloc(size + sizeof(uint64_t));
	if (!file)
		return;
	unsigned char *binary = (unsigned char *)file + e->size;
	if (!cl->clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL)) {
		memcpy(file, e->key, e->size);
		const uint64_t checksum = hash(file, size);
		memcpy(file + size, &checksum, sizeof checksum);
		write_file(e->path, file, size + sizeof checksum);
	}
	free(file);
}
