/* Every function of carom.h, called in any order with any arguments: what the header promises has to hold. Each input is run
 * twice, with different numbers of threads, and has to give the same both times.
 * SPDX-License-Identifier: MIT */
#include "calls.h"

#include <stdlib.h>

const char fuzz_name[] = "api";

#define MOST_CALLS 64
#define MOST_WORK 24

static uint64_t run_calls(const uint8_t *data, size_t size, uint32_t threads)
{
	calls c = {.bytes = {.at = data, .end = data + size}, .threads = threads, .work = MOST_WORK, .trace = 14695981039346656037u};
	c.bytes.tame = bytes_byte(&c.bytes) & 1;
	for (int k = 0; k < MOST_CALLS && c.bytes.at < c.bytes.end; k++)
		calls_make(&c);
	for (size_t k = 0; k < MOST_WORLDS; k++)
		carom_world_destroy(c.worlds[k]);
	return c.trace;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	const uint64_t once = run_calls(data, size, 1), again = run_calls(data, size, size % 4 == 0 ? 3 : 1); /* threads are slow to begin */
	FUZZ_EXPECT_SAID(once == again, "the same calls give the same");
	return 0;
}
