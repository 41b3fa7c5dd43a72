/* JSON read without a tree, as far as the library itself writes it: known keys, each once, plain numbers and plain strings.
 * SPDX-License-Identifier: MIT */
#include "scene_json.h"

#include <string.h>

bool scene_quick_take(struct scene_text *text, char character)
{
	text->at = scene_skip_space(text->at, text->end);
	if (text->at == text->end || *text->at != character)
		return false;
	text->at++;
	return true;
}

/* The text between two quotes: ASCII, no escapes. */
static bool quick_token(struct scene_text *text, const char **token, size_t *length)
{
	if (!scene_quick_take(text, '"'))
		return false;
	*token = text->at;
	for (; text->at < text->end && *text->at != '"'; text->at++) {
		if (*text->at < ' ' || *text->at > '~' || *text->at == '\\')
			return false;
	}
	*length = (size_t)(text->at - *token);
	return scene_quick_take(text, '"');
}

static bool quick_word(struct scene_text *text, const char *word)
{
	size_t length = strlen(word);
	if ((size_t)(text->end - text->at) < length || memcmp(text->at, word, length) != 0)
		return false;
	text->at += length;
	return true;
}

static bool quick_double(struct scene_text *text, double *number)
{
	text->at = scene_skip_space(text->at, text->end);
	text->at = scene_scan_number(text->at, text->end, number);
	return text->at != NULL;
}

bool scene_quick_number(struct scene_text *text, void *target, const struct scene_range *range)
{
	double number;
	return quick_double(text, &number) && scene_fit_number(number, range, target);
}

bool scene_quick_whole(struct scene_text *text, void *target, const struct scene_range *range)
{
	double number;
	return quick_double(text, &number) && scene_fit_whole(number, range, target);
}

bool scene_quick_pair(struct scene_text *text, void *target, const struct scene_range *range)
{
	carom_vec2 *pair = target;
	return scene_quick_take(text, '[') && scene_quick_number(text, &pair->x, range) && scene_quick_take(text, ',')
		&& scene_quick_number(text, &pair->y, range) && scene_quick_take(text, ']');
}

bool scene_quick_flag(struct scene_text *text, void *target, const struct scene_range *range)
{
	bool *flag = target;
	(void)range;
	text->at = scene_skip_space(text->at, text->end);
	*flag = quick_word(text, "true");
	return *flag || quick_word(text, "false");
}

bool scene_quick_string(struct scene_text *text, void *target, const struct scene_range *range)
{
	const char *token;
	size_t length;
	(void)range;
	char *copy = quick_token(text, &token, &length) ? scene_allocate(text->scene, length + 1) : NULL;
	if (!copy)
		return false;
	memcpy(copy, token, length);
	copy[length] = '\0';
	*(const char **)target = copy;
	return true;
}

bool scene_quick_color(struct scene_text *text, void *target, const struct scene_range *range)
{
	char color[8] = "";
	const char *token;
	size_t length;
	(void)range;
	if (!quick_token(text, &token, &length) || length >= sizeof color)
		return false;
	memcpy(color, token, length);
	return scene_fit_color(color, target);
}

static const struct scene_field *quick_key(struct scene_text *text, const struct scene_field *fields)
{
	const char *token;
	size_t length;
	if (!quick_token(text, &token, &length) || !scene_quick_take(text, ':'))
		return NULL;
	for (; fields->key; fields++) {
		if (strncmp(fields->key, token, length) == 0 && !fields->key[length])
			return fields->quick ? fields : NULL;
	}
	return NULL;
}

bool scene_quick_array(struct scene_text *text, bool (*one)(struct scene_text *text))
{
	if (!scene_quick_take(text, '['))
		return false;
	do {
		if (!one(text))
			return false;
	} while (scene_quick_take(text, ','));
	return scene_quick_take(text, ']');
}

bool scene_quick_object(struct scene_text *text, void *target, const struct scene_field *fields)
{
	unsigned seen = 0;
	if (!scene_quick_take(text, '{'))
		return false;
	do {
		const struct scene_field *field = quick_key(text, fields);
		unsigned bit = field ? 1u << (field - fields) : 0;
		if (!field || seen & bit || !field->quick(text, (char *)target + field->offset, field->range))
			return false;
		seen |= bit;
	} while (scene_quick_take(text, ','));
	return scene_quick_take(text, '}') && !scene_missing_key(fields, seen);
}
