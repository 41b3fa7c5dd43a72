/* JSON values as they stand in a scene file.
 * SPDX-License-Identifier: MIT */
#include "scene.h"

#include <string.h>

void scene_put_number(FILE *stream, float number)
{
	char text[SCENE_NUMBER_SIZE];
	size_t length = scene_format_number(number, text);
	fwrite(text, 1, length, stream);
}

void scene_put_pair(FILE *stream, carom_vec2 pair)
{
	putc('[', stream);
	scene_put_number(stream, pair.x);
	fputs(", ", stream);
	scene_put_number(stream, pair.y);
	putc(']', stream);
}

/* The bytes of the UTF-8 character at `text`, 0 if there is none. */
static size_t character_length(const unsigned char *text)
{
	static const unsigned long smallest[] = {0, 0, 0x80, 0x800, 0x10000}; /* less is overlong */
	size_t length = *text < 0x80 ? 1 : *text >= 0xF0 ? 4 : *text >= 0xE0 ? 3 : 2;
	if (length == 1)
		return 1;
	if (*text < 0xC0)
		return 0; /* the middle of a character */
	unsigned long code = *text & (0x7Fu >> length);
	for (size_t k = 1; k < length; k++) {
		if ((text[k] & 0xC0) != 0x80)
			return 0;
		code = code << 6 | (text[k] & 0x3Fu);
	}
	bool surrogate = code >= 0xD800 && code <= 0xDFFF;
	return code >= smallest[length] && code <= 0x10FFFF && !surrogate && *text < 0xF8 ? length : 0;
}

/* A name may hold anything; what is no UTF-8 becomes the replacement character, so that the file can be read. */
void scene_put_string(FILE *stream, const char *string)
{
	const unsigned char *at = (const unsigned char *)string;
	putc('"', stream);
	while (*at) {
		size_t length = character_length(at);
		if (length == 0) {
			fputs("\xEF\xBF\xBD", stream);
			at++;
			continue;
		}
		if (*at < 0x20) {
			fprintf(stream, "\\u%04x", (unsigned)*at);
		} else {
			if (*at == '"' || *at == '\\')
				putc('\\', stream);
			fwrite(at, 1, length, stream);
		}
		at += length;
	}
	putc('"', stream);
}

static bool same_pair(carom_vec2 a, carom_vec2 b)
{
	return memcmp(&a, &b, sizeof a) == 0; /* bits: -0 is written */
}

bool scene_same_number(float a, float b)
{
	return memcmp(&a, &b, sizeof a) == 0;
}

void scene_put_number_key(FILE *stream, const char *key, float number, float default_number)
{
	if (scene_same_number(number, default_number))
		return;
	fprintf(stream, ", \"%s\": ", key);
	scene_put_number(stream, number);
}

void scene_put_pair_key(FILE *stream, const char *key, carom_vec2 pair, carom_vec2 default_pair)
{
	if (same_pair(pair, default_pair))
		return;
	fprintf(stream, ", \"%s\": ", key);
	scene_put_pair(stream, pair);
}

void scene_put_bits_key(FILE *stream, const char *key, uint32_t bits, uint32_t default_bits)
{
	if (bits != default_bits)
		fprintf(stream, ", \"%s\": %lu", key, (unsigned long)bits);
}
