/* A program of a world, for its steps or for its pictures: the kernels' headers, then the chosen alternatives, in the order
 * of the slots. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cl/api.h"
#include "cl/kernels.h"
#include "device.h"
#include "stage.h"
#include "status.h"

/* Each header stands after those it needs. */
static const char *const headers[2][32] = {
	{"layout", "texture", "numbers", "filter", "body", "convex", "apart", "search", "room", "reduce", "toi", "impulse", "forward", "slots", "reach",
		"cluster", "around", "mend", "answer", "heap", "team", "join", "rest", "shock", "queue", "seek", "load", "kept"},
	{"layout", "texture", "numbers", "vertices", "shapes", "tiles", "light"},
};

#define MAX_PARTS 64

typedef struct sources {
	char *text[MAX_PARTS];
	size_t count;
	bool is_gpu;
} sources;

static const carom_kernel_source *source_named(const char *slot, const char *name)
{
	for (size_t i = 0; i < carom_kernel_source_count; i++)
		if (!strcmp(carom_kernel_sources[i].slot, slot) && !strcmp(carom_kernel_sources[i].name, name))
			return &carom_kernel_sources[i];
	return NULL;
}

/* NAME.gpu is no alternative: append takes it for NAME. */
static bool is_alternative(const char *name)
{
	return !strchr(name, '.');
}

bool carom_cl_has_alternative(const char *slot, const char *alternative)
{
	return source_named(slot, alternative) && is_alternative(alternative);
}

const char *carom_cl_alternative(const char *slot, size_t index)
{
	for (size_t i = 0; i < carom_kernel_source_count; i++)
		if (!strcmp(carom_kernel_sources[i].slot, slot) && is_alternative(carom_kernel_sources[i].name) && index-- == 0)
			return carom_kernel_sources[i].name;
	return NULL;
}

char *carom_cl_read_file(const char *path, size_t *size)
{
	FILE *file = fopen(path, "rb");
	struct stat info;
	char *bytes = NULL;
	if (!file)
		return NULL;
	if (!fstat(fileno(file), &info) && S_ISREG(info.st_mode) && (bytes = malloc((size_t)info.st_size + 1))) {
		*size = fread(bytes, 1, (size_t)info.st_size, file);
		bytes[*size] = 0;
	}
	fclose(file);
	return bytes;
}

/* While developing, CAROM_KERNEL_DIR names a folder to read kernels from instead; NULL where it is not set. */
static const char *override_folder(void)
{
	const char *folder = getenv("CAROM_KERNEL_DIR");
	return folder && *folder ? folder : NULL;
}

/* NULL where the folder does not have it. */
static char *read_override(const char *path)
{
	const char *folder = override_folder();
	char name[4096];
	size_t size;
	if (!folder)
		return NULL;
	snprintf(name, sizeof name, "%s/%s", folder, path + strlen("kernels/"));
	return carom_cl_read_file(name, &size);
}

carom_status carom_cl_check_override(carom_error *error)
{
	const char *folder = override_folder();
	bool is_used = !folder;
	for (size_t i = 0; !is_used && i < carom_kernel_source_count; i++) {
		char *text = read_override(carom_kernel_sources[i].path);
		is_used = text != NULL;
		free(text);
	}
	if (is_used)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "CAROM_KERNEL_DIR: found '%.256s', which has none of the kernels, as %s is one", folder,
		carom_kernel_sources[0].path + strlen("kernels/"));
}

/* For a GPU an alternative's kernels may be written in another way, in NAME.gpu.cl. */
static carom_status append(sources *all, const char *slot, const char *name, carom_error *error)
{
	char other[64];
	snprintf(other, sizeof other, "%s.gpu", name);
	const carom_kernel_source *for_gpu = all->is_gpu ? source_named(slot, other) : NULL, *source = for_gpu ? for_gpu : source_named(slot, name);
	char *changed, *text;
	size_t size;
	if (!source)
		return carom_fail(error, CAROM_UNKNOWN_NAME, "the slot '%s' has no alternative '%s' for OpenCL", slot, name);
	changed = read_override(source->path);
	size = strlen(changed ? changed : source->text) + strlen(source->path) + 32;
	text = malloc(size);
	if (text) {
		snprintf(text, size, "#line 1 \"%s\"\n%s\n", source->path, changed ? changed : source->text);
		all->text[all->count++] = text;
	}
	free(changed);
	return text ? CAROM_OK : carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the kernels' sources");
}

static carom_status append_slot(sources *all, const carom_slot *slot, const carom_pipeline *pipeline, carom_error *error)
{
	const char *chosen = carom_pipeline_get(pipeline, slot->name), *name;
	if (!strcmp(slot->name, "step"))
		return CAROM_OK;
	if (chosen)
		return append(all, slot->name, chosen, error);
	for (size_t i = 0; (name = carom_cl_alternative(slot->name, i)); i++) {
		carom_status status = append(all, slot->name, name, error);
		if (status)
			return status;
	}
	return CAROM_OK;
}

static bool is_used(carom_usage usage, const char *step, bool draws)
{
	const bool dense = !strcmp(step, "first_impact");
	if (draws || usage == USED_PICTURES)
		return draws && usage == USED_PICTURES;
	return usage == USED_ALL || (usage == USED_FIRST_IMPACT && dense) || (usage == USED_EVENTS && !dense)
		|| (usage == USED_CONTACTS && !strcmp(step, "contacts"));
}

static carom_status collect(sources *all, const carom_pipeline *pipeline, bool draws, carom_error *error)
{
	carom_status status = CAROM_OK;
	for (const char *const *header = headers[draws]; !status && *header; header++)
		status = append(all, "", *header, error);
	for (size_t i = 0; !status && i < carom_slot_count; i++)
		if (is_used(carom_slots[i].usage, carom_pipeline_get(pipeline, "step"), draws))
			status = append_slot(all, &carom_slots[i], pipeline, error);
	return status;
}

static void keep_log(const carom_cl_api *cl, cl_program program, cl_device_id device, carom_error *error)
{
	size_t size = 0;
	char *log;
	if (!error || cl->clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, NULL, &size) || !(log = calloc(1, size + 1)))
		return;
	cl->clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log, NULL);
	snprintf(error->build_log, sizeof error->build_log, "%s", log);
	free(log);
}

static carom_status build_sources(const carom_cl_api *cl, cl_context context, cl_device_id device, const char *options, const sources *all,
	cl_program *program, carom_error *error)
{
	cl_int code;
	cl_program built = cl->clCreateProgramWithSource(context, (cl_uint)all->count, (const char **)all->text, NULL, &code);
	if (built)
		code = cl->clBuildProgram(built, 1, &device, options, NULL, NULL);
	if (!code) {
		*program = built;
		return CAROM_OK;
	}
	const carom_status status = carom_cl_fail(error, code, "the kernels can't be built");
	if (built) {
		keep_log(cl, built, device, error);
		cl->clReleaseProgram(built);
	}
	return status;
}

/* From the cache, or from the sources into it. */
static carom_status make_program(const carom_cl_api *cl, cl_context context, cl_device_id device, const char *options, const sources *all,
	cl_program *program, carom_error *error)
{
	carom_cl_entry *kept = carom_cl_cache_find(cl, device, options, all->text, all->count);
	carom_status status = CAROM_OK;
	cl_program loaded = carom_cl_cache_load(kept, cl, context, device, options);
	if (loaded) {
		*program = loaded;
	} else {
		status = build_sources(cl, context, device, options, all, program, error);
		if (!status)
			carom_cl_cache_keep(kept, cl, *program);
	}
	carom_cl_cache_leave(kept);
	return status;
}

carom_status carom_cl_build(const carom_cl_api *cl, cl_context context, cl_device_id device, const carom_device_def *def, bool draws, bool images,
	const carom_device_info *info, cl_program *program, carom_error *error)
{
	/* the macro brings back the image functions that PoCL 7.1 hides from OpenCL C 1.2 */
	char options[256];
	sources all = {.is_gpu = !info->is_cpu};
	carom_status status = collect(&all, &def->pipeline, draws, error);
	snprintf(options, sizeof options, "-cl-std=CL1.2 -D__opencl_c_images=1%s%s%s%s%s", images ? " -DCAROM_IMAGES" : "",
		!draws && strcmp(carom_pipeline_get(&def->pipeline, "step"), "first_impact") ? " -DCAROM_OUTLINES" : "",
		def->count_reads ? " -DCAROM_COUNT_READS" : "", all.is_gpu ? " -DCAROM_GPU" : "",
		info->exact ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
	if (!status)
		status = make_program(cl, context, device, options, &all, program, error);
	for (size_t i = 0; i < all.count; i++)
		free(all.text[i]);
	return status;
}
