/* Colours of sixteen pixels at once, two rows of a tile: as squares, whole until the picture is written. */

typedef struct lights {
	float16 red, green, blue;
} lights;

uint16 levels(float16 squared)
{
	return convert_uint16(sqrt(squared > 0.0f ? squared : (float16)(0.0f)) + 0.5f);
}

/* Of 16 pixels number k is this one, if the frame has it. */
int2 pixel_of(int2 first, int k)
{
	return (int2)(first.x + k % PIXEL_TILE, first.y + k / PIXEL_TILE);
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

void show(lights all, BYTES_OUT(picture), int2 first, int2 size)
{
	uint reds[16], greens[16], blues[16];
	vstore16(levels(all.red), 0, reds);
	vstore16(levels(all.green), 0, greens);
	vstore16(levels(all.blue), 0, blues);
	for (int k = 0; k < 16; k++) {
		int2 at = pixel_of(first, k);
		if (at.x < size.x && at.y < size.y)
			BYTES_STORE(picture, at.x, at.y, (uint4)(reds[k], greens[k], blues[k], 255));
	}
}
