/* Finds the bodies in a scene's text without understanding the rest.
 *
 * A JSON tree takes some 1.4 KB a body, so a million bodies are read one by one. The scan trusts nothing: it only cuts,
 * and what it cuts, the parser still has to accept, the text around the bodies included.
 * SPDX-License-Identifier: MIT */
#include "scene.h"

#include <string.h>

const char *scene_skip_space(const char *at, const char *end)
{
	while (at < end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r'))
		at++;
	return at;
}

/* `at` is an opening quote; the answer follows the closing one. */
static const char *skip_string(const char *at, const char *end)
{
	for (at++; at < end && *at != '"'; at++) {
		if (*at == '\\' && at + 1 < end)
			at++;
	}
	return at < end ? at + 1 : end;
}

/* To the bracket that closes what `at` is in, or to the next comma of this level. */
static const char *skip_level(const char *at, const char *end, bool to_comma)
{
	size_t depth = 0;
	while (at < end) {
		switch (*at) {
		case '"': at = skip_string(at, end); continue;
		case '{':
		case '[': depth++; break;
		case '}':
		case ']':
			if (depth == 0)
				return at;
			depth--;
			break;
		case ',':
			if (to_comma && depth == 0)
				return at;
			break;
		default: break;
		}
		at++;
	}
	return end;
}

/* After `"bodies" : [` if that is what stands at `at`, else NULL. */
static const char *match_bodies(const char *at, const char *end)
{
	static const char key[] = "\"bodies\"";
	size_t length = sizeof key - 1;
	if ((size_t)(end - at) < length || memcmp(at, key, length) != 0)
		return NULL;
	at = scene_skip_space(at + length, end);
	if (at == end || *at != ':')
		return NULL;
	at = scene_skip_space(at + 1, end);
	return at < end && *at == '[' ? at + 1 : NULL;
}

bool scene_find_bodies(const char *text, const char *end, const char **bodies, const char **bodies_end)
{
	const char *at = scene_skip_space(text, end);
	if (at == end || *at != '{')
		return false;
	for (at++; at < end && *at != '}' && *at != ']';) {
		const char *found = match_bodies(at, end);
		if (found) {
			*bodies = found;
			*bodies_end = skip_level(found, end, false);
			return true;
		}
		if (*at == '"') {
			at = skip_string(at, end);
		} else if (*at == '{' || *at == '[') {
			at = skip_level(at + 1, end, false);
			if (at < end)
				at++;
		} else {
			at++;
		}
	}
	return false;
}

const char *scene_element_end(const char *text, const char *end)
{
	return skip_level(text, end, true);
}
