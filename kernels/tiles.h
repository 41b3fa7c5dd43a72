/* Tiles of pixels, that shapes are sorted into. */

/* The tiles that a shape touches: first column and row, and those behind the last; none: the columns are equal. */
int4 tiles_of(float4 box, float4 frame)
{
	if (is_empty(box))
		return (int4)(0, 0, 0, 0);
	int x0 = (int)(larger(CHANNEL(box, BOX_X0), CHANNEL(frame, BOX_X0)) - CHANNEL(frame, BOX_X0));
	int y0 = (int)(larger(CHANNEL(box, BOX_Y0), CHANNEL(frame, BOX_Y0)) - CHANNEL(frame, BOX_Y0));
	int x1 = (int)(smaller(CHANNEL(box, BOX_X1), CHANNEL(frame, BOX_X1)) - CHANNEL(frame, BOX_X0));
	int y1 = (int)(smaller(CHANNEL(box, BOX_Y1), CHANNEL(frame, BOX_Y1)) - CHANNEL(frame, BOX_Y0));
	if (x0 >= x1 || y0 >= y1)
		return (int4)(0, 0, 0, 0);
	return (int4)(x0, y0, x1 + PIXEL_TILE - 1, y1 + PIXEL_TILE - 1) / PIXEL_TILE;
}

int frame_fact(TEX_IN(frame), bool rows)
{
	float4 tiles = TEX_LOAD(frame, FRAME_TILES, 0);
	return (int)(rows ? CHANNEL(tiles, TILES_ROWS) : CHANNEL(tiles, TILES_COLUMNS));
}
