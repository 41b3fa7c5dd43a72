/* The text of a program, for a world's steps or for its pictures: the kernels' headers, then the chosen alternatives, in the
 * order of the slots. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cl/api.h"
#include "cl/kernels.h"
#include "device.h"
#include "stage.h"
#include "status.h"

/* Of steps, each after those it needs, and whose it is: to read them takes a compiler longer than the alternatives. */
static const struct {
	const char *name;
	carom_usage usage;
} headers[] = {
	{"layout", USED_ALL},
	{"texture", USED_ALL},
	{"numbers", USED_ALL},
	{"filter", USED_ALL},
	{"body", USED_ALL},
	{"convex", USED_ALL},
	{"contact", USED_ALL},
	{"apart", USED_ALL},
	{"search", USED_ALL},
	{"room", USED_ALL},
	{"reduce", USED_FIRST_IMPACT},
	{"toi", USED_FIRST_IMPACT},
	{"pieces", USED_ALL},
	{"impulse", USED_ALL},
	{"forward", USED_FIRST_IMPACT},
	{"slots", USED_EVENTS},
	{"reach", USED_EVENTS},
	{"cluster", USED_EVENTS},
	{"around", USED_EVENTS},
	{"mend", USED_EVENTS},
	{"roster", USED_EVENTS},
	{"answer", USED_EVENTS},
	{"slice", USED_EVENTS},
	{"heap", USED_EVENTS},
	{"team", USED_EVENTS},
	{"join", USED_EVENTS},
	{"sleep", USED_EVENTS},
	{"rest", USED_EVENTS},
	{"push", USED_EVENTS},
	{"shock", USED_EVENTS},
	{"tug", USED_EVENTS},
	{"queue", USED_EVENTS},
	{"seek", USED_EVENTS},
	{"joint", USED_EVENTS},
	{"load", USED_CONTACTS},
	{"held", USED_CONTACTS},
	{"aim", USED_CONTACTS},
	{"last", USED_CONTACTS},
	{"island", USED_CONTACTS},
	{"kept", USED_CONTACTS},
	{"still", USED_CONTACTS},
};

static const char *const headers_of_pictures[] = {"layout", "texture", "numbers", "vertices", "shapes", "circles", "outline", "tiles", "light"};

#define COUNT(list) (sizeof(list) / sizeof *(list))

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

typedef struct sources {
	FILE *text;
	bool is_gpu;
} sources;

/* For a GPU an alternative's kernels may be written in another way, in NAME.gpu.cl. */
static carom_status append(const sources *to, const char *slot, const char *name, carom_error *error)
{
	char other[64];
	snprintf(other, sizeof other, "%s.gpu", name);
	const carom_kernel_source *for_gpu = to->is_gpu ? source_named(slot, other) : NULL, *source = for_gpu ? for_gpu : source_named(slot, name);
	char *changed;
	if (!source)
		return carom_fail(error, CAROM_UNKNOWN_NAME, "the slot '%s' has no alternative '%s' for OpenCL", slot, name);
	changed = read_override(source->path);
	fprintf(to->text, "#line 1 \"%s\"\n%s\n", source->path, changed ? changed : source->text);
	free(changed);
	return CAROM_OK;
}

static carom_status append_slot(const sources *to, const carom_slot *slot, const carom_pipeline *pipeline, carom_error *error)
{
	const char *chosen = carom_pipeline_get(pipeline, slot->name), *name;
	if (!strcmp(slot->name, "step"))
		return CAROM_OK;
	if (chosen)
		return append(to, slot->name, chosen, error);
	for (size_t i = 0; (name = carom_cl_alternative(slot->name, i)); i++)
		TRY(append(to, slot->name, name, error));
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

static carom_status append_all(const sources *to, const carom_pipeline *pipeline, bool draws, carom_error *error)
{
	const char *step = carom_pipeline_get(pipeline, "step");
	for (size_t i = 0; draws && i < COUNT(headers_of_pictures); i++)
		TRY(append(to, "", headers_of_pictures[i], error));
	for (size_t i = 0; i < COUNT(headers); i++)
		if (is_used(headers[i].usage, step, draws))
			TRY(append(to, "", headers[i].name, error));
	for (size_t i = 0; i < carom_slot_count; i++)
		if (is_used(carom_slots[i].usage, step, draws))
			TRY(append_slot(to, &carom_slots[i], pipeline, error));
	return CAROM_OK;
}

carom_status carom_cl_collect(const carom_pipeline *pipeline, bool draws, bool is_gpu, char **text, carom_error *error)
{
	char *all = NULL;
	size_t size;
	const sources to = {open_memstream(&all, &size), is_gpu};
	if (!to.text)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the kernels' sources");
	carom_status status = append_all(&to, pipeline, draws, error);
	const bool is_cut = ferror(to.text) != 0;
	if ((fclose(to.text) || is_cut) && !status)
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the kernels' sources");
	if (status)
		free(all);
	else
		*text = all;
	return status;
}
