/* The colours of pictures, 0xRRGGBB.
 *
 * The twelve hues were taken from OKLCH at nearly one lightness and chroma, so that none stands out, and are ordered so
 * that bodies of neighbouring indices differ much.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_PALETTE_H
#define CAROM_PALETTE_H

#include <stdint.h>

#define CAROM_COLOR_GROUND 0xFCFCFAu
#define CAROM_COLOR_SURROUND 0xE4E7EBu
#define CAROM_COLOR_FRAME 0x4A5361u
#define CAROM_COLOR_STATIC 0xB4B9C1u
#define CAROM_COLOR_ACCENT 0xD6184Bu
#define CAROM_COLOR_CASING 0xFFFFFFu

static inline uint32_t carom_palette_color(uint32_t index)
{
	static const uint32_t hues[] = {
		0x5C85D1, 0xF1944F, 0x5DC0A7, 0xC378C7, 0xB0C357, 0x4DA6D6, 0xE86C66, 0x67B373, 0x8E7CD4, 0xECBD51, 0x57BCC7, 0xE48DA8};
	return hues[index % (sizeof hues / sizeof hues[0])];
}

/* The same hue, 9/16 as bright. */
static inline uint32_t carom_darker_color(uint32_t color)
{
	uint32_t red = (color >> 16 & 255) * 9 / 16, green = (color >> 8 & 255) * 9 / 16, blue = (color & 255) * 9 / 16;
	return red << 16 | green << 8 | blue;
}

#endif
