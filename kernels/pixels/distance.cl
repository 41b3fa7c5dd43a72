/* The picture: of a tile's pixels a patch of sixteen at once, each blended with the tile's shapes in turn. Colours are held
 * as squares: light adds up nearly as the squares of sRGB values do, so an edge blended in squares is as bright as it
 * should be, for the price of a root. */

#define NEAR_AHEAD 10 /* shapes */
#define FAR_AHEAD 20

float16 share16(float16 v)
{
	v = v > 0.0f ? v : (float16)(0.0f);
	return v < 1.0f ? v : (float16)(1.0f);
}

float4 squared_color(float color)
{
	int rgb = (int)color;
	float red = (float)(rgb >> 16), green = (float)(rgb >> 8 & 255), blue = (float)(rgb & 255);
	return (float4)(red * red, green * green, blue * blue, 0.0f);
}

/* The larger of a distance and the one from an edge to the pixels; x and y are counted from the first pixel of its shape's box. */
float16 beyond(float16 most, float4 edge, float16 x, float16 y)
{
	float bend = CHANNEL(edge, EDGE_BEND);
	float16 s = (CHANNEL(edge, EDGE_AT) + (CHANNEL(edge, EDGE_SLOPE_Y) + bend * y) * y) + (CHANNEL(edge, EDGE_SLOPE_X) + bend * x) * x;
	if (bend > 0.0f) {
		float16 square = 1.0f + (4.0f * bend) * s;
		s = (2.0f * s) / (1.0f + sqrt(square > 0.0f ? square : (float16)(0.0f)));
	}
	return s > most ? s : most;
}

float16 blended(float16 ground, float outline, float fill, float16 cover, float16 inside, float opacity)
{
	return ground + opacity * ((outline * (cover - inside) + fill * inside) - cover * ground);
}

/* Draws a shape on a tile, whose first pixel is (left, top). False: the tile is plain then, all of the shape's fill. */
bool draw(lights *light, RECORD_IN(its), RECORD_IN(edges), float left, float top)
{
	float4 box = its[SHAPE_BOX], ink = its[SHAPE_INK], sides = its[SHAPE_EDGES], edge = its[SHAPE_EDGE];
	float4 fill = squared_color(CHANNEL(ink, INK_FILL)), outline = squared_color(CHANNEL(ink, INK_OUTLINE));
	int rest = (int)CHANNEL(sides, EDGES_REST), count = (int)CHANNEL(sides, EDGES_COUNT);
	float beside = left - CHANNEL(box, BOX_X0), above = top - CHANNEL(box, BOX_Y0), width = CHANNEL(box, BOX_X1) - CHANNEL(box, BOX_X0);
	int4 part = {(int)larger(-beside, 0.0f), (int)larger(-above, 0.0f), (int)smaller(width - beside, (float)PIXEL_TILE),
		(int)smaller(CHANNEL(box, BOX_Y1) - top, (float)PIXEL_TILE)};
	float16 across = beside + (float16)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
	for (int row = part.y & -PATCH_HEIGHT; row < part.w; row += PATCH_HEIGHT) {
		float16 y = (above + (float)row) + (float16)((float8)(0.0f), (float8)(1.0f));
		int16 in_rows = y >= 0.0f && y < CHANNEL(box, BOX_Y1) - CHANNEL(box, BOX_Y0);
		for (int column = part.x & -PATCH_WIDTH; column < part.z; column += PATCH_WIDTH) {
			lights *patch = light + (row / PATCH_HEIGHT * PATCH_COLUMNS + column / PATCH_WIDTH);
			float16 x = across + (float)column;
			int16 in_box = in_rows && x >= 0.0f && x < width;
			if (count == 0) {
				patch->red = in_box ? (float16)(fill.x) : patch->red;
				patch->green = in_box ? (float16)(fill.y) : patch->green;
				patch->blue = in_box ? (float16)(fill.z) : patch->blue;
				continue;
			}
			float16 far = count < 0 ? CHANNEL(edge, EDGE_AT) + beyond_outline(edges, rest, -count, x, y) : beyond((float16)(-INFINITY), edge, x, y);
			for (int k = rest; k < rest + count - 1; k++)
				far = beyond(far, edges[k], x, y);
			float16 near = 0.5f - (in_box ? far : (float16)(1.0f));
			float16 cover = share16(near), inside = share16(near - CHANNEL(ink, INK_WIDTH));
			patch->red = blended(patch->red, outline.x, fill.x, cover, inside, CHANNEL(ink, INK_OPACITY));
			patch->green = blended(patch->green, outline.y, fill.y, cover, inside, CHANNEL(ink, INK_OPACITY));
			patch->blue = blended(patch->blue, outline.z, fill.z, cover, inside, CHANNEL(ink, INK_OPACITY));
		}
	}
	return count != 0 || part.x > 0 || part.y > 0 || part.z < PIXEL_TILE || part.w < PIXEL_TILE;
}

/* A tile. */
__kernel void pixels(RECORD_IN(shapes), RECORD_IN(edges), TEX_IN(frame), LIST_IN(ends), LIST_IN(list), RECORD_OUT(light), BYTES_OUT(picture),
	int4 domain)
{
	int column = get_global_id(0), row = get_global_id(1);
	float4 box = TEX_LOAD(frame, FRAME_BOX, 0), tiles = TEX_LOAD(frame, FRAME_TILES, 0);
	int2 first = (int2)(column, row) * PIXEL_TILE;
	int2 size = (int2)((int)(CHANNEL(box, BOX_X1) - CHANNEL(box, BOX_X0)), (int)(CHANNEL(box, BOX_Y1) - CHANNEL(box, BOX_Y0)));
	int pass = (int)CHANNEL(tiles, TILES_PASS), tile = row * ((int)CHANNEL(tiles, TILES_COLUMNS) + 1) + column;
	if (column >= domain.x)
		return;
	lights all[PATCHES];
	float4 ground = squared_color(CHANNEL(tiles, TILES_GROUND));
	bool plain = !(pass & PASS_OVER);
	for (int p = 0; p < PATCHES; p++) {
		lights below = {(float16)(ground.x), (float16)(ground.y), (float16)(ground.z)};
		all[p] = plain ? below : light_below(light, patch_of(first, p), size);
	}
	uint end = min((uint)ends[tile + 1], (uint)domain.z),
		 last = min((uint)ends[tile - column + (int)CHANNEL(tiles, TILES_COLUMNS)], (uint)domain.z) - 1;
	for (uint k = (uint)ends[tile]; k < end; k++) {
		FETCH(shapes + SHAPES_WIDTH * list[min(k + FAR_AHEAD, last)]);
		FETCH(edges + (int)CHANNEL(shapes[SHAPES_WIDTH * list[min(k + NEAR_AHEAD, last)] + SHAPE_EDGES], EDGES_REST));
		plain = !draw(all, shapes + SHAPES_WIDTH * list[k], edges, CHANNEL(box, BOX_X0) + (float)first.x, CHANNEL(box, BOX_Y0) + (float)first.y);
	}
	uint16 words;
	for (int p = 0; p < PATCHES; p++) {
		words = p == 0 || !plain ? bytes_of(all[p]) : words;
		if (pass & PASS_UNDER)
			keep(all[p], light, patch_of(first, p), size);
		else
			show(words, TEX(picture), patch_of(first, p), size);
	}
}
