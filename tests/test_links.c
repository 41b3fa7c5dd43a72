/* Every picture and page that README.md and docs/ lead to is there, and every heading.
 * SPDX-License-Identifier: MIT */
#include "documents.h"

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* What a link to a heading calls it. */
static void format_anchor(const char *heading, char *anchor, size_t size)
{
	size_t length = 0;
	for (; *heading && *heading != '\n'; heading++) {
		const char c = *heading;
		assert_true(length < size - 1);
		if (isalnum((unsigned char)c) || c == '-' || c == '_' || c == ' ')
			anchor[length++] = (char)(c == ' ' ? '-' : tolower((unsigned char)c));
	}
	anchor[length] = '\0';
}

static bool has_heading(const document *in, const char *wanted)
{
	char anchor[256];
	for (const char *at = strstr(in->text, "\n#"); at; at = strstr(at + 1, "\n#")) {
		format_anchor(at + 1 + strspn(at + 1, "#") + 1, anchor, sizeof anchor);
		if (strcmp(anchor, wanted) == 0)
			return true;
	}
	return false;
}

static const document *document_at(const char *path)
{
	for (size_t k = 0; k < document_count; k++) {
		if (strcmp(documents[k].path, path) == 0)
			return &documents[k];
	}
	return NULL;
}

/* Links are as seen from the document's folder; those into a document may name a heading. */
static void check_link(const document *from, const char *link)
{
	const char *anchor = link + strcspn(link, "#"), *up = strncmp(link, "../", 3) == 0 ? link + 3 : NULL;
	const int folder = strchr(from->path, '/') && !up ? (int)(strchr(from->path, '/') + 1 - from->path) : 0;
	char path[512];
	if (anchor == link)
		snprintf(path, sizeof path, "%s", from->path);
	else
		snprintf(path, sizeof path, "%.*s%.*s", folder, from->path, (int)(anchor - (up ? up : link)), up ? up : link);
	if (access(path, R_OK) != 0)
		fail_msg("%s leads to %s, which is not there", from->path, path);
	const document *to = document_at(path);
	if (*anchor && (!to || !has_heading(to, anchor + 1)))
		fail_msg("%s leads to %s, which has no such heading", from->path, link);
}

static void every_link_leads_somewhere(void **state)
{
	(void)state;
	char link[256];
	int links = 0;
	documents_read();
	for (size_t k = 0; k < document_count; k++) {
		for (const char *at = strstr(documents[k].text, "]("); at; at = strstr(at + 1, "](")) {
			snprintf(link, sizeof link, "%.*s", (int)strcspn(at + 2, ")\n"), at + 2);
			if (strncmp(link, "http", 4) == 0)
				continue;
			check_link(&documents[k], link);
			links++;
		}
	}
	assert_true(links > 10);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(every_link_leads_somewhere)};
	return cmocka_run_group_tests_name("links", tests, NULL, NULL);
}
