/* What the fuzz targets share. Each tests/fuzz/fuzz_NAME.c is a target: libFuzzer makes up its inputs in `make fuzz`, and
 * replay.c feeds it those of tests/corpus/NAME in `make check`.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_FUZZ_H
#define CAROM_TESTS_FUZZ_H

#include "carom.h"

/* The target's name, and what it does with an input. */
extern const char fuzz_name[];
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
/* Called once before; fuzz.c has it for all. */
int LLVMFuzzerInitialize(int *argc, char ***argv);

/* The device of every world: the CPU fallback, or what the environment's CAROM_FUZZ_DEVICE says. */
const char *fuzz_device(void);
/* A file of that name in a folder of this process's own, which has to be empty again at the end. */
const char *fuzz_path(const char *name);

/* Ends the process where an invariant does not hold: for libFuzzer a finding. */
#define FUZZ_EXPECT(condition) ((condition) ? (void)0 : fuzz_fail(__FILE__, __LINE__, #condition, NULL))
#define FUZZ_EXPECT_SAID(condition, said) ((condition) ? (void)0 : fuzz_fail(__FILE__, __LINE__, #condition, said))
_Noreturn void fuzz_fail(const char *file, int line, const char *condition, const char *said);

/* An error that no function has filled in yet. */
carom_error fuzz_blank(void);
/* A failure has filled it in, with one line of text; success left it blank. Answers whether it was success. */
bool fuzz_judge(carom_status status, const carom_error *error);

#endif
