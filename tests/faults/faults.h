/* Makes the n-th call of a kind fail. The linker hands the test program the calls of Carom's own code (--wrap, see `wrap`), so
 * drivers and C libraries keep theirs; jansson is handed faults_malloc.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_FAULTS_H
#define CAROM_TESTS_FAULTS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum faults_kind {
	FAULTS_NONE,
	FAULTS_MEMORY,   /* allocations, on any thread, and threads */
	FAULTS_OPENCL,   /* calls of OpenCL: those that create or tell give `code` and nothing else, those that release do so and say `code` */
	FAULTS_PROGRAMS, /* of these the ones that programs need, and that tell what they are made for */
} faults_kind;

/* From now on calls of this kind are counted, and the n-th of them, from 1 on, fails. */
void faults_arm(faults_kind kind, uint64_t nth, int code);
/* The name of the call that failed since; NULL if there were fewer. */
const char *faults_failed(void);
/* The same, and ends the counting. */
const char *faults_disarm(void);

/* Allocates, counted as Carom's own. */
void *faults_malloc(size_t size);

/* OpenCL objects that were created and not released; `kinds` names the calls that created them. */
size_t faults_alive(char *kinds, size_t size);
/* How the machine looks to Carom. */
typedef enum faults_loader {
	LOADER_REAL,
	LOADER_NONE,
	LOADER_OLD,
	LOADER_WITHOUT_PLATFORMS,
	LOADER_WITHOUT_DEVICES,
	LOADER_INEXACT, /* its devices don't promise to round quotients and roots correctly, and refuse to build kernels that ask for it */
	LOADER_GPU,     /* its devices are GPUs */
} faults_loader;
void faults_loader_set(faults_loader how);

/* For the wrapped calls alone: does this one fail? */
int faults_strike(faults_kind kind, const char *call);
int faults_code(void);

#ifdef __cplusplus
}
#endif
#endif
