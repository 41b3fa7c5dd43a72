/* A libOpenCL that writes where Carom fills, and is Oclgrind in all else: Oclgrind 21.10 takes what was filled for uninitialized.
 * tools/conformance builds it.
 * SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "cl/functions.h"

/* `count` times the same bytes; NULL without the memory. */
static char *repeat(const void *bytes, size_t size, size_t count)
{
	char *all = malloc(size * count);
	for (size_t i = 0; all && i < count; i++)
		memcpy(all + size * i, bytes, size);
	return all;
}

cl_int CL_API_CALL clEnqueueFillBuffer(cl_command_queue command_queue, cl_mem buffer, const void *pattern, size_t pattern_size, size_t offset,
	size_t size, cl_uint num_events_in_wait_list, const cl_event *event_wait_list, cl_event *event)
{
	char *all = repeat(pattern, pattern_size, size / pattern_size);
	if (!all)
		return CL_OUT_OF_HOST_MEMORY;
	const cl_int code = clEnqueueWriteBuffer(command_queue, buffer, CL_TRUE, offset, size, all, num_events_in_wait_list, event_wait_list, event);
	free(all);
	return code;
}

/* Of texels of four floats, or of four bytes that the colour has as ints: Carom has no others. */
cl_int CL_API_CALL clEnqueueFillImage(cl_command_queue command_queue, cl_mem image, const void *fill_color, const size_t *origin,
	const size_t *region, cl_uint num_events_in_wait_list, const cl_event *event_wait_list, cl_event *event)
{
	cl_uchar bytes[4];
	size_t texel = 0;
	cl_int code = clGetImageInfo(image, CL_IMAGE_ELEMENT_SIZE, sizeof texel, &texel, NULL);
	if (code)
		return code;
	for (int i = 0; i < 4; i++)
		bytes[i] = (cl_uchar)((const cl_uint *)fill_color)[i];
	char *all = repeat(texel == sizeof bytes ? bytes : fill_color, texel, region[0] * region[1] * region[2]);
	if (!all)
		return CL_OUT_OF_HOST_MEMORY;
	code = clEnqueueWriteImage(command_queue, image, CL_TRUE, origin, region, 0, 0, all, num_events_in_wait_list, event_wait_list, event);
	free(all);
	return code;
}
