/* SPDX-License-Identifier: MIT */
#include "documents.h"

#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

document documents[MAX_DOCUMENTS];
size_t document_count;

void documents_read_text(const char *path, char *text, size_t size)
{
	FILE *file = fopen(path, "rb");
	assert_non_null(file);
	const size_t length = fread(text, 1, size - 1, file);
	fclose(file);
	assert_true(length < size - 1);
	text[length] = '\0';
}

static void read_document(const char *path)
{
	assert_true(document_count < MAX_DOCUMENTS);
	document *to = &documents[document_count++];
	documents_read_text(path, to->text, sizeof to->text);
	assert_in_range(snprintf(to->path, sizeof to->path, "%s", path), 1, sizeof to->path - 1);
}

void documents_read(void)
{
	glob_t found;
	read_document("README.md");
	assert_int_equal(glob("docs/*.md", 0, NULL, &found), 0);
	for (size_t k = 0; k < found.gl_pathc; k++)
		read_document(found.gl_pathv[k]);
	globfree(&found);
}
