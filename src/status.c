#include "status.h"

#include <stdarg.h>
#include <string.h>

#define TEXT(number) #number
#define VERSION(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *carom_version(void)
{
	return VERSION(CAROM_VERSION_MAJOR, CAROM_VERSION_MINOR, CAROM_VERSION_PATCH);
}

const char *carom_status_name(carom_status status)
{
	switch (status) {
#define CASE(name, sentence) \
	case CAROM_##name: return "CAROM_" #name;
		CAROM_STATUS_LIST(CASE)
#undef CASE
	}
	return "CAROM_?";
}

const char *carom_status_text(carom_status status)
{
	switch (status) {
#define CASE(name, sentence) \
	case CAROM_##name: return sentence;
		CAROM_STATUS_LIST(CASE)
#undef CASE
	}
	return "unknown status";
}

const char *carom_errno_text(int number, char *text, size_t size)
{
	if (strerror_r(number, text, size))
		snprintf(text, size, "error %d", number);
	return text;
}

carom_status carom_fail(carom_error *error, carom_status status, const char *format, ...)
{
	if (error) {
		va_list arguments;
		memset(error, 0, sizeof *error);
		error->status = status;
		va_start(arguments, format);
		vsnprintf(error->text, sizeof error->text, format, arguments);
		va_end(arguments);
	}
	return status;
}
