/* Allocations that fail, and which of the counted calls does.
 * SPDX-License-Identifier: MIT */
#include "faults.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>
#include <thread>

static faults_kind armed;
static uint64_t nth;
static int given_code;
static std::atomic<uint64_t> calls;
static std::atomic<const char *> failed;

void faults_arm(faults_kind kind, uint64_t n, int code)
{
	calls = 0;
	failed = nullptr;
	nth = n;
	given_code = code;
	armed = kind;
}

const char *faults_failed()
{
	return failed;
}

const char *faults_disarm()
{
	armed = FAULTS_NONE;
	return failed;
}

int faults_strike(faults_kind kind, const char *call)
{
	if (armed != kind || ++calls != nth)
		return 0;
	failed = call;
	return 1;
}

int faults_code()
{
	return given_code;
}

static bool no_memory(const char *call)
{
	if (!faults_strike(FAULTS_MEMORY, call))
		return false;
	errno = ENOMEM;
	return true;
}

/* A function of C that gives NULL where memory ends. */
#define WRAP(result, name, parameters, arguments)                    \
	extern "C" result __real_##name parameters;                      \
	extern "C" result __wrap_##name parameters;                      \
	extern "C" result __wrap_##name parameters                       \
	{                                                                \
		return no_memory(#name) ? nullptr : __real_##name arguments; \
	}

WRAP(void *, malloc, (size_t size), (size))
WRAP(void *, calloc, (size_t count, size_t size), (count, size))
WRAP(void *, realloc, (void *memory, size_t size), (memory, size))
WRAP(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
WRAP(char *, strdup, (const char *text), (text))
WRAP(char *, realpath, (const char *path, char *resolved), (path, resolved))
WRAP(FILE *, fopen, (const char *path, const char *mode), (path, mode))
WRAP(FILE *, fdopen, (int descriptor, const char *mode), (descriptor, mode))
/* new (std::nothrow) */
WRAP(void *, _ZnwmRKSt9nothrow_t, (size_t size, const std::nothrow_t &nothrow), (size, nothrow))

extern "C" int __real_posix_memalign(void **memory, size_t alignment, size_t size);
extern "C" int __wrap_posix_memalign(void **memory, size_t alignment, size_t size);
extern "C" int __wrap_posix_memalign(void **memory, size_t alignment, size_t size)
{
	return no_memory("posix_memalign") ? ENOMEM : __real_posix_memalign(memory, alignment, size);
}

/* The operators new that throw. */
#define WRAP_NEW(name, parameters, arguments)  \
	extern "C" void *__real_##name parameters; \
	extern "C" void *__wrap_##name parameters; \
	extern "C" void *__wrap_##name parameters  \
	{                                          \
		if (no_memory("operator new"))         \
			throw std::bad_alloc();            \
		return __real_##name arguments;        \
	}

WRAP_NEW(_Znwm, (size_t size), (size))
WRAP_NEW(_Znam, (size_t size), (size))
WRAP_NEW(_ZnwmSt11align_val_t, (size_t size, std::align_val_t alignment), (size, alignment))

void *faults_malloc(size_t size)
{
	return no_memory("jansson's malloc") ? nullptr : __real_malloc(size);
}

/* What std::thread of the GNU library starts a thread with, beside what it allocates. */
#define START_THREAD(prefix) prefix##_ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateESt14default_deleteIS1_EEPFvvE
extern "C" void START_THREAD(__real_)(std::thread *thread, void *state, void (*depends)());
extern "C" void START_THREAD(__wrap_)(std::thread *thread, void *state, void (*depends)());
extern "C" void START_THREAD(__wrap_)(std::thread *thread, void *state, void (*depends)())
{
	if (no_memory("std::thread"))
		throw std::system_error(EAGAIN, std::generic_category());
	START_THREAD(__real_)(thread, state, depends);
}
