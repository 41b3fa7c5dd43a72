/* Filling in the caller's carom_error. */
#ifndef CAROM_STATUS_H
#define CAROM_STATUS_H

#include "carom.h"

#if defined(__GNUC__)
#define CAROM_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define CAROM_PRINTF(text, first)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Fills in *error (unless NULL), the rest of it zero, and returns `status`: `return carom_fail(error, CAROM_IO, "...", ...)`. */
carom_status carom_fail(carom_error *error, carom_status status, const char *format, ...) CAROM_PRINTF(3, 4);

/* What an errno means, in `text`: strerror's own text may change under another thread. */
const char *carom_errno_text(int number, char *text, size_t size);

/* Refuses NULL for a pointer that the caller has to give. */
#define GIVEN(pointer, error)                                                                            \
	do {                                                                                                 \
		if (!(pointer))                                                                                  \
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "%s: found NULL, must be given", #pointer); \
	} while (0)

/* Returns what the call does, if that is an error. */
#define TRY(call)                      \
	do {                               \
		carom_status status_ = (call); \
		if (status_)                   \
			return status_;            \
	} while (0)

#ifdef __cplusplus
}
#endif
#endif
