/* What is written for people: README.md and what it leads to.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_DOCUMENTS_H
#define CAROM_TESTS_DOCUMENTS_H

#include <stddef.h>

#define MAX_DOCUMENTS 8

typedef struct document {
	char path[64], text[1 << 17];
} document;

/* README.md is the first, then those of docs/. */
extern document documents[MAX_DOCUMENTS];
extern size_t document_count;

/* Fills in both, from the root of the repository. */
void documents_read(void);
/* All of a file, which has to have room, and a NUL. */
void documents_read_text(const char *path, char *text, size_t size);

#endif
