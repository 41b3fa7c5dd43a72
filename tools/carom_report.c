/* What the command says, and the exit code that goes with it.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <errno.h>
#include <stdarg.h>
#include <string.h>
#include <time.h>

static carom_status fill(carom_error *error, carom_status status, const char *format, va_list arguments)
{
	memset(error, 0, sizeof *error);
	error->status = status;
	vsnprintf(error->text, sizeof error->text, format, arguments);
	return status;
}

carom_status wrong(carom_error *error, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	const carom_status status = fill(error, CAROM_INVALID_ARGUMENT, format, arguments);
	va_end(arguments);
	return status;
}

carom_status out_of_memory(carom_error *error, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	const carom_status status = fill(error, CAROM_OUT_OF_MEMORY, format, arguments);
	va_end(arguments);
	return status;
}

static int exit_code(carom_status status)
{
	switch (status) {
	case CAROM_OK: return EXIT_DONE;
	case CAROM_INVALID_ARGUMENT:
	case CAROM_INVALID_SCENE:
	case CAROM_UNKNOWN_NAME:
	case CAROM_LIMIT: return EXIT_WRONG;
	case CAROM_OUT_OF_MEMORY:
	case CAROM_DEVICE:
	case CAROM_IO:
	case CAROM_STALLED: return EXIT_FAILED;
	}
	return EXIT_FAILED;
}

int report(const carom_error *error)
{
	fprintf(stderr, "carom: %s\n", *error->text ? error->text : carom_status_text(error->status));
	if (*error->build_log)
		fprintf(stderr, "%s\n", error->build_log);
	return exit_code(error->status);
}

int report_input(const carom_error *error)
{
	int code = report(error);
	return error->status == CAROM_IO ? EXIT_WRONG : code;
}

void say(const struct common_options *options, const char *format, ...)
{
	va_list arguments;
	if (options->quiet)
		return;
	fputs("carom: ", stderr);
	va_start(arguments, format);
	vfprintf(stderr, format, arguments);
	va_end(arguments);
	putc('\n', stderr);
}

int finish_output(void)
{
	errno = 0;
	if (fflush(stdout) == 0 && !ferror(stdout))
		return EXIT_DONE;
	fprintf(stderr, "carom: standard output can't be written: %s\n", strerror(errno ? errno : EIO));
	return EXIT_FAILED;
}

void print_other(FILE *file, int32_t other)
{
	static const char *const walls[] = {"left", "bottom", "right", "top"};
	if (other < 0)
		fputs(walls[CAROM_WALL_LEFT - other], file);
	else
		fprintf(file, "%d", (int)other);
}

const char *format_bytes(uint64_t bytes, char *text, size_t size)
{
	static const char *const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB"};
	double amount = (double)bytes;
	size_t unit = 0;
	while (amount >= 1024 && unit + 1 < sizeof units / sizeof *units) {
		amount /= 1024;
		unit++;
	}
	snprintf(text, size, unit && amount < 100 ? "%.1f %s" : "%.0f %s", amount, units[unit]);
	return text;
}

double wall_seconds(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}
