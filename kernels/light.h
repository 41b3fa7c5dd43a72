/* Colours of a patch, sixteen pixels in two rows: as squares, whole until the picture is written. */

#define PATCH_WIDTH 8
#define PATCH_HEIGHT 2
#define PATCH_COLUMNS (PIXEL_TILE / PATCH_WIDTH) /* of a tile */
#define PATCHES (PATCH_COLUMNS * PIXEL_TILE / PATCH_HEIGHT)

typedef struct lights {
	float16 red, green, blue;
} lights;

uint16 levels(float16 squared)
{
	return convert_uint16(sqrt(squared > 0.0f ? squared : (float16)(0.0f)) + 0.5f);
}

/* The four of a pixel as a word, as it lies in memory. */
uint16 bytes_of(lights all)
{
	return levels(all.red) | levels(all.green) << 8 | levels(all.blue) << 16 | 255u << 24;
}

/* The first pixel of patch p of a tile. */
int2 patch_of(int2 first, int p)
{
	return first + (int2)(p % PATCH_COLUMNS * PATCH_WIDTH, p / PATCH_COLUMNS * PATCH_HEIGHT);
}

/* Of a patch's pixels number k is this one, if the frame has it. */
int2 pixel_of(int2 first, int k)
{
	return (int2)(first.x + k % PATCH_WIDTH, first.y + k / PATCH_WIDTH);
}

lights light_below(RECORD_IN(light), int2 first, int2 size)
{
	float reds[16], greens[16], blues[16];
	for (int k = 0; k < 16; k++) {
		int2 at = min(pixel_of(first, k), size - 1);
		float4 below = light[at.y * size.x + at.x];
		reds[k] = CHANNEL(below, LIGHT_RED);
		greens[k] = CHANNEL(below, LIGHT_GREEN);
		blues[k] = CHANNEL(below, LIGHT_BLUE);
	}
	lights all = {vload16(0, reds), vload16(0, greens), vload16(0, blues)};
	return all;
}

void keep(lights all, RECORD_OUT(light), int2 first, int2 size)
{
	float reds[16], greens[16], blues[16];
	vstore16(all.red, 0, reds);
	vstore16(all.green, 0, greens);
	vstore16(all.blue, 0, blues);
	for (int k = 0; k < 16; k++) {
		int2 at = pixel_of(first, k);
		if (at.x < size.x && at.y < size.y)
			light[at.y * size.x + at.x] = (float4)(reds[k], greens[k], blues[k], 0.0f);
	}
}

void show_row(const uint *words, BYTES_OUT(picture), int x, int y, int2 size)
{
	if (y >= size.y)
		return;
	if (x + 8 <= size.x) {
		BYTES_STORE8(picture, x, y, vload8(0, words));
		return;
	}
	for (int k = 0; x + k < size.x; k++)
		BYTES_STORE(picture, x + k, y, convert_uint4(as_uchar4(words[k])));
}

void show(uint16 words, BYTES_OUT(picture), int2 first, int2 size)
{
	uint each[16]; /* rather than .lo and .hi, for Oclgrind takes what .hi has for uninitialized */
	vstore16(words, 0, each);
	show_row(each, TEX(picture), first.x, first.y, size);
	show_row(each + PATCH_WIDTH, TEX(picture), first.x, first.y + 1, size);
}
