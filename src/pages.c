/* Large pages: what is read here and there is found sooner in them. */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise */
#include <sys/mman.h>
#include <unistd.h>
#endif
#include <stdint.h>

#include "device.h"

void carom_prefer_large_pages(void *memory, size_t size)
{
#ifdef MADV_HUGEPAGE
	const size_t page = (size_t)sysconf(_SC_PAGESIZE), skipped = (page - (uintptr_t)memory % page) % page;
	if (size >= CAROM_LARGE_PAGES)
		(void)madvise((char *)memory + skipped, size - skipped, MADV_HUGEPAGE);
#else
	(void)memory;
	(void)size;
#endif
}
