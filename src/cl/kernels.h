/* The kernels' sources, embedded by the build in the order of their paths. */
#ifndef CAROM_CL_KERNELS_H
#define CAROM_CL_KERNELS_H

#include <stddef.h>

typedef struct carom_kernel_source {
	const char *slot; /* "toi"; "" for a header */
	const char *name; /* "bisection" */
	const char *path; /* "kernels/toi/bisection.cl" */
	const char *text;
} carom_kernel_source;

extern const carom_kernel_source carom_kernel_sources[];
extern const size_t carom_kernel_source_count;

#endif
