/* The picture: eight pixels of a tile's row at once, each blended with the tile's shapes in turn. Colours are held as
 * squares: light adds up nearly as the squares of sRGB values do, so an edge blended in squares is as bright as it
 * should be, for the price of a root. */

typedef struct light8 {
	float8 red, green, blue;
} light8;

float8 share8(float8 v)
{
	v = v > 0.0f ? v : (float8)(0.0f);
	return v < 1.0f ? v : (float8)(1.0f);
}

float4 squared_color(float color)
{
	int rgb = (int)color;
	float red = (float)(rgb >> 16), green = (float)(rgb >> 8 & 255), blue = (float)(rgb & 255);
	return (float4)(red * red, green * green, blue * blue, 0.0f);
}

/* The signed distance from the shape to the pixels; x and y are counted from the first pixel of its box. */
float8 distance8(TEX_IN(edges), int first, int count, float8 x, float y)
{
	float8 most = (float8)(-INFINITY);
	for (int k = first; k < first + count; k++) {
		float4 edge = ROW_LOAD(edges, k);
		float bend = CHANNEL(edge, EDGE_BEND), at = CHANNEL(edge, EDGE_AT) + (CHANNEL(edge, EDGE_SLOPE_Y) + bend * y) * y;
		float8 s = at + (CHANNEL(edge, EDGE_SLOPE_X) + bend * x) * x;
		if (bend > 0.0f) {
			float8 square = 1.0f + (4.0f * bend) * s;
			s = (2.0f * s) / (1.0f + sqrt(square > 0.0f ? square : (float8)(0.0f)));
		}
		most = s > most ? s : most;
	}
	return most;
}

float8 blended(float8 ground, float outline, float fill, float8 cover, float8 inside, float opacity)
{
	return ground + opacity * ((outline * (cover - inside) + fill * inside) - cover * ground);
}

void blend(light8 *light, TEX_IN(shapes), TEX_IN(edges), int shape, float4 box, float x, float y)
{
	float4 ink = ROW_LOAD(shapes, SHAPES_WIDTH * shape + SHAPE_INK), sides = ROW_LOAD(shapes, SHAPES_WIDTH * shape + SHAPE_EDGES);
	int first = (int)CHANNEL(sides, EDGES_FIRST), count = (int)CHANNEL(sides, EDGES_COUNT);
	float8 across = (x - CHANNEL(box, BOX_X0)) + (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
	float8 far = distance8(TEX(edges), first, count, across, y - CHANNEL(box, BOX_Y0));
	far = across >= 0.0f && across < CHANNEL(box, BOX_X1) - CHANNEL(box, BOX_X0) ? far : (float8)(1.0f);
	float8 near = 0.5f - far, cover = share8(near), inside = share8(near - CHANNEL(ink, INK_WIDTH));
	float4 fill = squared_color(CHANNEL(ink, INK_FILL)), outline = squared_color(CHANNEL(ink, INK_OUTLINE));
	float opacity = CHANNEL(ink, INK_OPACITY);
	light->red = blended(light->red, outline.x, fill.x, cover, inside, opacity);
	light->green = blended(light->green, outline.y, fill.y, cover, inside, opacity);
	light->blue = blended(light->blue, outline.z, fill.z, cover, inside, opacity);
}

uint8 level8(float8 squared)
{
	return convert_uint8(sqrt(squared > 0.0f ? squared : (float8)(0.0f)) + 0.5f);
}

__kernel void pixels(TEX_IN(shapes), TEX_IN(edges), TEX_IN(frame), LIST_IN(ends), LIST_IN(list), BYTES_OUT(picture), int4 domain)
{
	int item = get_global_id(0), row = get_global_id(1), column = item / PIXEL_TILE;
	int x = column * PIXEL_TILE, y = row * PIXEL_TILE + item % PIXEL_TILE;
	float4 frame_box = TEX_LOAD(frame, FRAME_BOX, 0), tiles = TEX_LOAD(frame, FRAME_TILES, 0);
	int width = (int)(CHANNEL(frame_box, BOX_X1) - CHANNEL(frame_box, BOX_X0));
	if (item >= domain.x || y >= (int)(CHANNEL(frame_box, BOX_Y1) - CHANNEL(frame_box, BOX_Y0)))
		return;
	float4 ground = squared_color(CHANNEL(tiles, TILES_GROUND));
	light8 light = {(float8)(ground.x), (float8)(ground.y), (float8)(ground.z)};
	int tile = row * ((int)CHANNEL(tiles, TILES_COLUMNS) + 1) + column;
	float left = CHANNEL(frame_box, BOX_X0) + (float)x, top = CHANNEL(frame_box, BOX_Y0) + (float)y;
	uint end = min((uint)ends[tile + 1], (uint)domain.z);
	for (uint k = (uint)ends[tile]; k < end; k++) {
		float4 box = ROW_LOAD(shapes, SHAPES_WIDTH * list[k] + SHAPE_BOX);
		if (top >= CHANNEL(box, BOX_Y0) && top < CHANNEL(box, BOX_Y1))
			blend(&light, TEX(shapes), TEX(edges), list[k], box, left, top);
	}
	uint reds[8], greens[8], blues[8];
	vstore8(level8(light.red), 0, reds);
	vstore8(level8(light.green), 0, greens);
	vstore8(level8(light.blue), 0, blues);
	for (int k = 0; k < min(PIXEL_TILE, width - x); k++)
		BYTES_STORE(picture, x + k, y, (uint4)(reds[k], greens[k], blues[k], 255));
}
