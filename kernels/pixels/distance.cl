/* The picture: of a tile's pixels two rows at once, each blended with the tile's shapes in turn. Colours are held as
 * squares: light adds up nearly as the squares of sRGB values do, so an edge blended in squares is as bright as it
 * should be, for the price of a root. */

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

/* The signed distance from the shape to the pixels; x and y are counted from the first pixel of its box. */
float16 distance16(RECORD_IN(edges), int first, int count, float16 x, float16 y)
{
	float16 most = (float16)(-INFINITY);
	for (int k = first; k < first + count; k++) {
		float4 edge = edges[k];
		float bend = CHANNEL(edge, EDGE_BEND);
		float16 s = (CHANNEL(edge, EDGE_AT) + (CHANNEL(edge, EDGE_SLOPE_Y) + bend * y) * y) + (CHANNEL(edge, EDGE_SLOPE_X) + bend * x) * x;
		if (bend > 0.0f) {
			float16 square = 1.0f + (4.0f * bend) * s;
			s = (2.0f * s) / (1.0f + sqrt(square > 0.0f ? square : (float16)(0.0f)));
		}
		most = s > most ? s : most;
	}
	return most;
}

float16 blended(float16 ground, float outline, float fill, float16 cover, float16 inside, float opacity)
{
	return ground + opacity * ((outline * (cover - inside) + fill * inside) - cover * ground);
}

void draw(lights *light, RECORD_IN(shapes), RECORD_IN(edges), int shape, float4 box, float16 x, float16 y)
{
	float4 ink = shapes[SHAPES_WIDTH * shape + SHAPE_INK], sides = shapes[SHAPES_WIDTH * shape + SHAPE_EDGES];
	float4 fill = squared_color(CHANNEL(ink, INK_FILL)), outline = squared_color(CHANNEL(ink, INK_OUTLINE));
	int count = (int)CHANNEL(sides, EDGES_COUNT);
	float opacity = CHANNEL(ink, INK_OPACITY);
	int16 inside_box = x >= CHANNEL(box, BOX_X0) && x < CHANNEL(box, BOX_X1) && y >= CHANNEL(box, BOX_Y0) && y < CHANNEL(box, BOX_Y1);
	if (count == 0) {
		light->red = inside_box ? (float16)(fill.x) : light->red;
		light->green = inside_box ? (float16)(fill.y) : light->green;
		light->blue = inside_box ? (float16)(fill.z) : light->blue;
		return;
	}
	float16 far = distance16(edges, (int)CHANNEL(sides, EDGES_FIRST), count, x - CHANNEL(box, BOX_X0), y - CHANNEL(box, BOX_Y0));
	float16 near = 0.5f - (inside_box ? far : (float16)(1.0f));
	float16 cover = share16(near), inside = share16(near - CHANNEL(ink, INK_WIDTH));
	light->red = blended(light->red, outline.x, fill.x, cover, inside, opacity);
	light->green = blended(light->green, outline.y, fill.y, cover, inside, opacity);
	light->blue = blended(light->blue, outline.z, fill.z, cover, inside, opacity);
}

__kernel void pixels(RECORD_IN(shapes), RECORD_IN(edges), TEX_IN(frame), LIST_IN(ends), LIST_IN(list), RECORD_OUT(light), BYTES_OUT(picture),
	int4 domain)
{
	int item = get_global_id(0), row = get_global_id(1), column = item / (PIXEL_TILE / 2);
	int2 first = (int2)(column * PIXEL_TILE, row * PIXEL_TILE + item % (PIXEL_TILE / 2) * 2);
	float4 box = TEX_LOAD(frame, FRAME_BOX, 0), tiles = TEX_LOAD(frame, FRAME_TILES, 0);
	int2 size = (int2)((int)(CHANNEL(box, BOX_X1) - CHANNEL(box, BOX_X0)), (int)(CHANNEL(box, BOX_Y1) - CHANNEL(box, BOX_Y0)));
	int pass = (int)CHANNEL(tiles, TILES_PASS);
	if (item >= domain.x || first.y >= size.y)
		return;
	float4 ground = squared_color(CHANNEL(tiles, TILES_GROUND));
	lights all = {(float16)(ground.x), (float16)(ground.y), (float16)(ground.z)};
	if (pass & PASS_OVER)
		all = light_below(light, first, size);
	float left = CHANNEL(box, BOX_X0) + (float)first.x, top = CHANNEL(box, BOX_Y0) + (float)first.y;
	float16 xs = left + (float16)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
	float16 ys = (float16)((float8)(top), (float8)(top + 1.0f));
	int tile = row * ((int)CHANNEL(tiles, TILES_COLUMNS) + 1) + column;
	uint end = min((uint)ends[tile + 1], (uint)domain.z);
	for (uint k = (uint)ends[tile]; k < end; k++) {
		float4 its = shapes[SHAPES_WIDTH * list[k] + SHAPE_BOX];
		if (top + 1.0f >= CHANNEL(its, BOX_Y0) && top < CHANNEL(its, BOX_Y1))
			draw(&all, shapes, edges, list[k], its, xs, ys);
	}
	if (pass & PASS_UNDER)
		keep(all, light, first, size);
	else
		show(all, TEX(picture), first, size);
}
