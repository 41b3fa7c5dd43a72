/* Contexts and programs. Worlds on one device share a context, and of the programs built in it those that are alike: to build takes up to seconds. Each is
 * released with the last world that uses it. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "cl/api.h"
#include "status.h"

static carom_cl_context *contexts; /* of all worlds of the process */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static carom_status create_context(const carom_cl_api *cl, const carom_cl_found *found, carom_cl_context **context, carom_error *error)
{
	const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM, (cl_context_properties)found->platform, 0};
	carom_cl_context *c = calloc(1, sizeof *c);
	cl_int code;
	if (!c)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for a context");
	c->id = cl->clCreateContext(properties, 1, &found->device, NULL, NULL, &code);
	if (code) {
		char what[640];
		free(c);
		snprintf(what, sizeof what, "%s: no context can be made", found->info.name);
		return carom_cl_fail(error, code, what);
	}
	c->device = found->device;
	c->users = 1;
	c->next = contexts;
	*context = contexts = c;
	return CAROM_OK;
}

static carom_status share_context(const carom_cl_api *cl, const carom_cl_found *found, carom_cl_context **context, carom_error *error)
{
	for (carom_cl_context *c = contexts; c; c = c->next) {
		if (c->device != found->device)
			continue;
		c->users++;
		*context = c;
		return CAROM_OK;
	}
	return create_context(cl, found, context, error);
}

carom_status carom_cl_enter(const carom_cl_api *cl, const carom_cl_found *found, carom_cl_context **context, carom_error *error)
{
	pthread_mutex_lock(&lock);
	const carom_status status = share_context(cl, found, context, error);
	pthread_mutex_unlock(&lock);
	return status;
}

void carom_cl_leave(const carom_cl_api *cl, carom_cl_context *context)
{
	pthread_mutex_lock(&lock);
	if (--context->users == 0) {
		carom_cl_context **link = &contexts;
		while (*link != context)
			link = &(*link)->next;
		*link = context->next;
		cl->clReleaseContext(context->id);
		free(context);
	}
	pthread_mutex_unlock(&lock);
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

static carom_status build_text(const carom_cl_api *cl, const carom_cl_context *context, const char *options, const char *text, cl_program *program,
	carom_error *error)
{
	cl_int code;
	cl_program built = cl->clCreateProgramWithSource(context->id, 1, &text, NULL, &code);
	if (built)
		code = cl->clBuildProgram(built, 1, &context->device, options, NULL, NULL);
	if (!code) {
		*program = built;
		return CAROM_OK;
	}
	const carom_status status = carom_cl_fail(error, code, "the kernels can't be built");
	if (built) {
		keep_log(cl, built, context->device, error);
		cl->clReleaseProgram(built);
	}
	return status;
}

/* From the cache, or from the text into it. */
static carom_status make_program(const carom_cl_api *cl, const carom_cl_context *context, const char *options, const char *text, cl_program *program,
	carom_error *error)
{
	carom_cl_entry *kept = carom_cl_cache_find(cl, context->device, options, text);
	carom_status status = CAROM_OK;
	cl_program loaded = carom_cl_cache_load(kept, cl, context->id, context->device, options);
	if (loaded) {
		*program = loaded;
	} else {
		status = build_text(cl, context, options, text, program, error);
		if (!status)
			carom_cl_cache_keep(kept, cl, *program);
	}
	carom_cl_cache_leave(kept);
	return status;
}

static void destroy_program(const carom_cl_api *cl, carom_cl_program *program)
{
	if (program->id)
		cl->clReleaseProgram(program->id);
	free(program->text);
	free(program);
}

/* Takes `text`. */
static carom_status create_program(const carom_cl_api *cl, carom_cl_context *context, const char *options, char *text, carom_cl_program **program,
	carom_error *error)
{
	carom_cl_program *p = calloc(1, sizeof *p);
	if (!p) {
		free(text);
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for a program");
	}
	p->text = text;
	snprintf(p->options, sizeof p->options, "%s", options);
	const carom_status status = make_program(cl, context, options, text, &p->id, error);
	if (status) {
		destroy_program(cl, p);
		return status;
	}
	p->users = 1;
	p->next = context->programs;
	*program = context->programs = p;
	return CAROM_OK;
}

/* One of the context's, or a new one; takes `text`. */
static carom_status share_program(const carom_cl_api *cl, carom_cl_context *context, const char *options, char *text, carom_cl_program **program,
	carom_error *error)
{
	for (carom_cl_program *p = context->programs; p; p = p->next) {
		if (strcmp(p->options, options) || strcmp(p->text, text))
			continue;
		free(text);
		p->users++;
		*program = p;
		return CAROM_OK;
	}
	return create_program(cl, context, options, text, program, error);
}

carom_status carom_cl_take_program(const carom_cl_api *cl, carom_cl_context *context, const carom_device_def *def, bool draws, bool images,
	const carom_device_info *info, carom_cl_program **program, carom_error *error)
{
	/* the macro brings back the image functions that PoCL 7.1 hides from OpenCL C 1.2 */
	char options[CAROM_CL_OPTIONS], *text;
	TRY(carom_cl_collect(&def->pipeline, draws, !info->is_cpu, &text, error));
	snprintf(options, sizeof options, "-cl-std=CL1.2 -D__opencl_c_images=1%s%s%s%s%s", images ? " -DCAROM_IMAGES" : "",
		!draws && strcmp(carom_pipeline_get(&def->pipeline, "step"), "first_impact") ? " -DCAROM_OUTLINES" : "",
		def->count_reads ? " -DCAROM_COUNT_READS" : "", info->is_cpu ? "" : " -DCAROM_GPU",
		info->exact ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
	pthread_mutex_lock(&lock);
	const carom_status status = share_program(cl, context, options, text, program, error);
	pthread_mutex_unlock(&lock);
	return status;
}

void carom_cl_drop_program(const carom_cl_api *cl, carom_cl_context *context, carom_cl_program *program)
{
	pthread_mutex_lock(&lock);
	if (--program->users == 0) {
		carom_cl_program **link = &context->programs;
		while (*link != program)
			link = &(*link)->next;
		*link = program->next;
		destroy_program(cl, program);
	}
	pthread_mutex_unlock(&lock);
}
