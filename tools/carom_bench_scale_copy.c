/* What the memory can do, so that steps can be compared with it: one array copied to another by several threads.
 * SPDX-License-Identifier: MIT */
#include "carom_bench_scale.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#define TIMES 5
#define MAX_THREADS 256

struct part {
	char *to;
	const char *from;
	size_t bytes;
};

static void *copy_part(void *context)
{
	const struct part *part = context;
	memcpy(part->to, part->from, part->bytes);
	return NULL;
}

/* Each thread copies its part; the caller has one too. */
static void copy(char *to, const char *from, size_t bytes, unsigned threads)
{
	pthread_t others[MAX_THREADS];
	struct part parts[MAX_THREADS];
	bool begun[MAX_THREADS] = {false};
	for (unsigned k = 0; k < threads; k++) {
		size_t at = bytes / threads * k, end = k + 1 < threads ? bytes / threads * (k + 1) : bytes;
		parts[k] = (struct part){to + at, from + at, end - at};
		begun[k] = k > 0 && pthread_create(&others[k], NULL, copy_part, &parts[k]) == 0;
	}
	for (unsigned k = 0; k < threads; k++) {
		if (!begun[k])
			copy_part(&parts[k]);
	}
	for (unsigned k = 0; k < threads; k++) {
		if (begun[k])
			pthread_join(others[k], NULL);
	}
}

void scale_measure_copy(struct scale_result *result, size_t bytes, unsigned threads)
{
	char *from = malloc(bytes), *to = malloc(bytes);
	threads = threads < 1 ? 1 : threads > MAX_THREADS ? MAX_THREADS : threads;
	result->copy_bytes = bytes;
	result->copy_threads = threads;
	if (from && to) {
		memset(from, 1, bytes);
		copy(to, from, bytes, threads); /* touches every page */
	}
	for (int k = 0; from && to && k < TIMES; k++) {
		double begun = wall_seconds();
		copy(to, from, bytes, threads);
		double rate = 2.0 * (double)bytes / (wall_seconds() - begun);
		result->copy_rate = rate > result->copy_rate ? rate : result->copy_rate;
	}
	free(from);
	free(to);
}
