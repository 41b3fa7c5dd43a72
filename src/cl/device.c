/* The OpenCL device: textures are images or buffers of the same rows, and arguments are bound by the stage's definition. */
#include "cl/texture.h"

#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"

cl_device *carom_cl_of(const carom_device *device)
{
	return (cl_device *)(uintptr_t)device;
}

static bool has_kernel(const carom_device *device, carom_stage stage)
{
	return carom_cl_of(device)->kernels[stage].kernel != NULL;
}

/* Buffers travel with their width, images know it; and each with the counter of reads, where there is one. Lists are bare. */
static cl_int bind_textures(cl_device *d, carom_stage stage, carom_texture *const *textures, cl_uint *next)
{
	bound_kernel *k = &d->kernels[stage];
	int count = carom_stages[stage].input_count + carom_stages[stage].output_count;
	for (int i = 0; i < count; i++) {
		cl_int width = (cl_int)textures[i]->width, code = CL_SUCCESS;
		bool same = k->textures[i] == textures[i];
		if (!same)
			code = d->cl.clSetKernelArg(k->kernel, *next, sizeof(cl_mem), &textures[i]->memory);
		++*next;
		if (!textures[i]->is_image && !carom_cl_is_list(textures[i]->format)) {
			if (!same && !code)
				code = d->cl.clSetKernelArg(k->kernel, *next, sizeof width, &width);
			++*next;
		}
		if (d->reads && !carom_cl_is_list(textures[i]->format)) {
			if (!same && !code)
				code = d->cl.clSetKernelArg(k->kernel, *next, sizeof(cl_mem), &d->reads);
			++*next;
		}
		k->textures[i] = code ? NULL : textures[i];
		if (code)
			return code;
	}
	return CL_SUCCESS;
}

static bool sorts_shapes(carom_stage stage)
{
	return stage >= STAGE_BIN_COUNT && stage <= STAGE_BIN_TILES;
}

/* How large a stage's groups are to be: smaller ones where there are few work-items, or where each goes its own way, which a GPU runs one after the other. */
static size_t wanted_size(const cl_device *d, carom_stage stage)
{
	if (stage == STAGE_FIRST || stage == STAGE_IMPULSE || (sorts_shapes(stage) && d->is_cpu))
		return 1;
	if (stage == STAGE_MEND)
		return d->is_cpu ? GROUP_FEW : GROUP_WIDE;
	if (stage == STAGE_RESOLVE && !d->is_cpu)
		return GROUP_FEW;
	return GROUP_MOST;
}

/* How many of a stage's items a work-item does. */
static size_t items_together(const cl_device *d, carom_stage stage)
{
	return stage == STAGE_SHAPES && d->is_cpu ? SHAPES_TOGETHER : 1;
}

/* One local size a stage, whatever the domain: PoCL compiles a kernel anew for each. Some devices take only small groups; where a GPU's lanes count on each
 * other that is not enough. */
static cl_int local_size(const cl_device *d, carom_stage stage, cl_kernel kernel, size_t *local)
{
	size_t wanted = wanted_size(d, stage), most = 1;
	cl_int code = d->cl.clGetKernelWorkGroupInfo(kernel, d->context->device, CL_KERNEL_WORK_GROUP_SIZE, sizeof most, &most, NULL);
	*local = wanted < most ? wanted : most;
	if (!code && most < wanted && !d->is_cpu && (stage == STAGE_RESOLVE || sorts_shapes(stage)))
		return CL_INVALID_WORK_GROUP_SIZE;
	return code;
}

/* Adds up what the launches so far took, and forgets them. */
static void read_profile(carom_device *device)
{
	cl_device *d = carom_cl_of(device);
	d->cl.clFinish(d->queue);
	for (size_t i = 0; i < d->pending; i++) {
		carom_kernel_time *time = &device->times[d->event_stages[i]];
		cl_ulong start = 0, end = 0;
		cl_int code = d->cl.clGetEventProfilingInfo(d->events[i], CL_PROFILING_COMMAND_START, sizeof start, &start, NULL);
		if (!code)
			code = d->cl.clGetEventProfilingInfo(d->events[i], CL_PROFILING_COMMAND_END, sizeof end, &end, NULL);
		d->cl.clReleaseEvent(d->events[i]);
		if (!code && end > start)
			time->seconds += 1e-9 * (double)(end - start);
		time->launches++;
	}
	d->pending = 0;
}

static carom_status make_counter(cl_device *d, carom_error *error)
{
	cl_uint zero = 0;
	cl_int code;
	d->reads = d->cl.clCreateBuffer(d->context->id, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, sizeof zero, &zero, &code);
	return code ? carom_cl_device_fail(d, error, code, "no counter of reads can be made") : CAROM_OK;
}

static carom_status count_reads(carom_device *device, uint64_t *texels, carom_error *error)
{
	cl_device *d = carom_cl_of(device);
	cl_uint count = 0, zero = 0;
	cl_int code = CL_SUCCESS;
	if (d->reads)
		code = d->cl.clEnqueueReadBuffer(d->queue, d->reads, CL_TRUE, 0, sizeof count, &count, 0, NULL, NULL);
	if (d->reads && !code)
		code = d->cl.clEnqueueWriteBuffer(d->queue, d->reads, CL_TRUE, 0, sizeof zero, &zero, 0, NULL, NULL);
	if (code)
		return carom_cl_device_fail(d, error, code, "the counter of reads can't be read");
	*texels = count;
	return CAROM_OK;
}

/* Where the next launch's event goes; NULL where nothing is measured. */
static cl_event *next_event(cl_device *d, carom_stage stage)
{
	if (!d->profile)
		return NULL;
	if (d->pending == MAX_PENDING)
		read_profile(&d->base);
	d->event_stages[d->pending] = stage;
	return &d->events[d->pending];
}

/* Keeps the kernel for the stage that names it. */
static cl_int keep_kernel(cl_device *d, cl_kernel kernel)
{
	char name[64] = "";
	cl_int code = d->cl.clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, NULL);
	for (int i = 0; !code && i < STAGE_COUNT; i++) {
		if (strcmp(name, carom_stages[i].kernel) || d->kernels[i].kernel)
			continue;
		d->kernels[i].kernel = kernel;
		return local_size(d, (carom_stage)i, kernel, &d->kernels[i].local);
	}
	d->cl.clReleaseKernel(kernel);
	return code;
}

/* All that the program has: which those are depends on the alternatives. */
static carom_status create_kernels(cl_device *d, cl_program program, carom_error *error)
{
	cl_kernel kernels[2 * STAGE_COUNT];
	cl_uint count = 0;
	cl_int code = d->cl.clCreateKernelsInProgram(program, 2 * STAGE_COUNT, kernels, &count);
	if (code)
		return carom_cl_device_fail(d, error, code, "no kernels can be made");
	for (cl_uint i = 0; i < count; i++) {
		if (code)
			d->cl.clReleaseKernel(kernels[i]);
		else
			code = keep_kernel(d, kernels[i]);
	}
	if (code == CL_INVALID_WORK_GROUP_SIZE)
		return carom_cl_device_fail(d, error, code, "it can't run as many work-items together as a kernel for GPUs needs");
	return code ? carom_cl_device_fail(d, error, code, "a kernel can't be asked for what it is") : CAROM_OK;
}

static void drop_program(cl_device *d, bool draws)
{
	for (int i = 0; i < STAGE_COUNT; i++) {
		if (d->kernels[i].kernel && carom_stage_draws((carom_stage)i) == draws) {
			d->cl.clReleaseKernel(d->kernels[i].kernel);
			d->kernels[i] = (bound_kernel){0};
		}
	}
	if (d->programs[draws])
		carom_cl_drop_program(&d->cl, d->context, d->programs[draws]);
	d->programs[draws] = NULL;
}

/* PoCL builds for a while: a world that draws no picture is spared rendering's program. */
static carom_status build_program(cl_device *d, bool draws, carom_error *error)
{
	carom_status status = carom_cl_take_program(&d->cl, d->context, &d->def, draws, d->base.storage == CAROM_STORAGE_IMAGE, &d->base.info,
		&d->programs[draws], error);
	if (!status)
		status = create_kernels(d, d->programs[draws]->id, error);
	if (status)
		drop_program(d, draws);
	return status;
}

static carom_status run_stage(carom_device *device, carom_stage stage, carom_texture *const *textures, const int32_t domain[4], carom_error *error)
{
	cl_device *d = carom_cl_of(device);
	size_t local[2] = {1, 1}, global[2] = {0, domain[1] > 1 ? (size_t)domain[1] : 1};
	cl_int4 size = {{domain[0], domain[1], domain[2], domain[3]}};
	cl_uint next = 0;
	cl_event *event;
	cl_int code;
	if (carom_stage_draws(stage) && !d->programs[1]) {
		carom_status status = build_program(d, true, error);
		if (status)
			return status;
	}
	if (!d->kernels[stage].kernel)
		return carom_fail(error, CAROM_DEVICE, "%s: the program has no kernel %s", d->base.info.name, carom_stages[stage].kernel);
	local[0] = d->kernels[stage].local;
	const size_t each = items_together(d, stage) * local[0], groups = ((size_t)domain[0] + each - 1) / each;
	global[0] = (carom_stage_runs_groups(stage) ? (size_t)domain[0] : groups) * local[0];
	event = next_event(d, stage);
	code = bind_textures(d, stage, textures, &next);
	if (!code)
		code = d->cl.clSetKernelArg(d->kernels[stage].kernel, next, sizeof size, &size);
	if (!code)
		code = d->cl.clEnqueueNDRangeKernel(d->queue, d->kernels[stage].kernel, 2, NULL, global, local, 0, NULL, event);
	if (!code && event)
		d->pending++;
	return code ? carom_cl_device_fail(d, error, code, carom_stages[stage].kernel) : CAROM_OK;
}

static carom_status flush(carom_device *device, carom_error *error)
{
	cl_int code = carom_cl_of(device)->cl.clFlush(carom_cl_of(device)->queue);
	return code ? carom_cl_device_fail(carom_cl_of(device), error, code, "the queue can't be flushed") : CAROM_OK;
}

static void close_device(carom_device *device)
{
	cl_device *d = carom_cl_of(device);
	for (size_t i = 0; i < d->pending; i++)
		d->cl.clReleaseEvent(d->events[i]);
	drop_program(d, false);
	drop_program(d, true);
	if (d->reads)
		d->cl.clReleaseMemObject(d->reads);
	if (d->queue)
		d->cl.clReleaseCommandQueue(d->queue);
	if (d->context)
		carom_cl_leave(&d->cl, d->context);
	free(d);
}

static const carom_device_class cl_class = {PIXEL_TILE, PIXEL_TILE, close_device, carom_cl_create_texture, NULL, carom_cl_destroy_texture,
	carom_cl_upload, carom_cl_download, has_kernel, run_stage, flush, read_profile, count_reads};

/* On a CPU a texel of an image is a call out of line: there steps that are not the paper's take buffers by themselves. */
static bool prefers_buffers(const carom_device_def *def, const carom_cl_found *found)
{
	return def->storage == CAROM_STORAGE_AUTO && found->info.is_cpu && strcmp(def->pipeline.step, "first_impact");
}

static carom_status choose_storage(cl_device *d, const carom_device_def *def, const carom_cl_found *found, carom_error *error)
{
	carom_device_info *info = &d->base.info;
	bool has_formats = false;
	cl_int code = carom_cl_has_formats(&d->cl, d->context->id, &has_formats);
	if (code)
		return carom_cl_device_fail(d, error, code, "the formats of images can't be asked for");
	info->has_images = info->has_images && has_formats;
	const bool buffers = def->storage == CAROM_STORAGE_BUFFER || !info->has_images || prefers_buffers(def, found);
	d->base.storage = buffers ? CAROM_STORAGE_BUFFER : CAROM_STORAGE_IMAGE;
	if (def->storage == CAROM_STORAGE_IMAGE && !info->has_images)
		return carom_fail(error, CAROM_DEVICE,
			"the device '%s' has no images, or none with sides of %d texels that hold four floats or bytes; "
			"use buffer storage",
			info->name, ROW_SIZE);
	return CAROM_OK;
}

static carom_status set_up(cl_device *d, const carom_device_def *def, const carom_cl_found *found, carom_error *error)
{
	cl_int code;
	carom_status status = carom_cl_enter(&d->cl, found, &d->context, error);
	if (!status)
		status = choose_storage(d, def, found, error);
	if (status)
		return status;
	d->queue = d->cl.clCreateCommandQueue(d->context->id, found->device, def->profile ? CL_QUEUE_PROFILING_ENABLE : 0, &code);
	if (code)
		return carom_cl_device_fail(d, error, code, "no queue can be made");
	if (def->count_reads && (status = make_counter(d, error)))
		return status;
	d->is_cpu = found->info.is_cpu;
	d->def = *def;
	return build_program(d, false, error);
}

static const carom_cl_found *same_device(const carom_cl_found *found, size_t count, const carom_device_info *which, size_t alike)
{
	for (size_t i = 0; i < count; i++)
		if (!strcmp(found[i].info.platform, which->platform) && !strcmp(found[i].info.name, which->name) && alike-- == 0)
			return &found[i];
	return NULL;
}

carom_status carom_cl_open(const carom_device_def *def, const carom_device_info *which, size_t alike, carom_device **device, carom_error *error)
{
	cl_device *d = calloc(1, sizeof *d);
	carom_cl_found *found = NULL;
	const carom_cl_found *mine;
	size_t count = 0;
	carom_status status;
	if (!d)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for a device");
	if (!carom_cl_load(&d->cl)) {
		status = carom_fail(error, CAROM_DEVICE, "there is no OpenCL on this machine");
		goto end;
	}
	status = carom_cl_find(&d->cl, &found, &count, error);
	if (status)
		goto end;
	mine = same_device(found, count, which, alike);
	if (!mine || !mine->info.works) {
		const char *why = mine ? mine->info.reason : count ? found[0].info.reason : "";
		status = carom_fail(error, CAROM_DEVICE, "the device '%s' is gone%s%s", which->name, *why ? ": " : "", why);
		goto end;
	}
	d->base.kind = &cl_class;
	d->base.info = *which;
	d->profile = def->profile;
	status = set_up(d, def, mine, error);
end:
	free(found);
	if (status)
		close_device(&d->base);
	else
		*device = &d->base;
	return status;
}
