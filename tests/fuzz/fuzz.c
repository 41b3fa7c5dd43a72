/* What the fuzz targets share: a device, a folder, and judging errors.
 * SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/carom-fuzz-XXXXXX";

_Noreturn void fuzz_fail(const char *file, int line, const char *condition, const char *said)
{
	fprintf(stderr, "%s:%d: does not hold: %s%s%s\n", file, line, condition, said ? ": " : "", said ? said : "");
	abort();
}

const char *fuzz_device(void)
{
	const char *device = getenv("CAROM_FUZZ_DEVICE");
	return device ? device : "cpu";
}

const char *fuzz_path(const char *name)
{
	static char path[sizeof folder + 32];
	snprintf(path, sizeof path, "%s/%.30s", folder, name);
	return path;
}

/* rmdir fails where something is left. */
static void remove_folder(void)
{
	if (rmdir(folder) != 0)
		fuzz_fail(__FILE__, __LINE__, "all files are removed", folder);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
	(void)argc;
	(void)argv;
	if (!getenv("CAROM_FUZZ_DEVICE")) /* OpenCL's compilers would be fuzzed, too: no driver is to be found */
		setenv("OCL_ICD_VENDORS", "/nowhere", 1);
	FUZZ_EXPECT(mkdtemp(folder));
	FUZZ_EXPECT(atexit(remove_folder) == 0);
	return 0;
}

carom_error fuzz_blank(void)
{
	carom_error error;
	memset(&error, 0x5A, sizeof error);
	return error;
}

bool fuzz_judge(carom_status status, const carom_error *error)
{
	const carom_error blank = fuzz_blank();
	if (status == CAROM_OK) {
		FUZZ_EXPECT_SAID(memcmp(error, &blank, sizeof blank) == 0, "success left the error alone");
		return true;
	}
	FUZZ_EXPECT_SAID(error->status == status && strcmp(carom_status_name(status), "CAROM_?") != 0, carom_status_name(status));
	const size_t length = strnlen(error->text, sizeof error->text);
	FUZZ_EXPECT(length > 0 && length < sizeof error->text);
	FUZZ_EXPECT_SAID(error->text[length - 1] != '.', error->text);
	for (size_t k = 0; k < length; k++)
		FUZZ_EXPECT_SAID((unsigned char)error->text[k] >= ' ' && error->text[k] != 0x7F, error->text);
	FUZZ_EXPECT(error->line >= 0 && error->column >= 0 && error->opencl_code == 0 && !*error->build_log);
	return false;
}
