/* OverlapAABB [2.1]: every pair of the lower triangle, eight columns at once; a work-item does a few tiles. */

/* Eight columns' boxes. */
typedef struct boxes {
	float8 min_x, min_y, max_x, max_y;
	int8 index;
} boxes;

boxes boxes_load(TEX_IN(aabb), int j)
{
	boxes b;
	float4 t[TILE];
	for (int k = 0; k < TILE; k++)
		t[k] = ROW_LOAD(aabb, j + k);
	b.index = (int8)(j, j + 1, j + 2, j + 3, j + 4, j + 5, j + 6, j + 7);
#define EIGHT(channel)                                                                                                               \
	(float8)(CHANNEL(t[0], channel), CHANNEL(t[1], channel), CHANNEL(t[2], channel), CHANNEL(t[3], channel), CHANNEL(t[4], channel), \
		CHANNEL(t[5], channel), CHANNEL(t[6], channel), CHANNEL(t[7], channel))
	b.min_x = EIGHT(AABB_MIN_X);
	b.min_y = EIGHT(AABB_MIN_Y);
	b.max_x = EIGHT(AABB_MAX_X);
	b.max_y = EIGHT(AABB_MAX_Y);
#undef EIGHT
	return b;
}

/* -1 in the columns whose boxes overlap that of row i, 0 in the others and from the diagonal on */
int8 overlaps(TEX_IN(aabb), boxes b, int i)
{
	float4 a = ROW_LOAD(aabb, i);
	return (b.index < i) & (b.min_x <= CHANNEL(a, AABB_MAX_X)) & (b.max_x >= CHANNEL(a, AABB_MIN_X)) & (b.min_y <= CHANNEL(a, AABB_MAX_Y))
		& (b.max_y >= CHANNEL(a, AABB_MIN_Y));
}

/* Of these, -1 in those whose bodies may hit that of row i. */
int8 let_through(LIST_IN(filters), int8 columns, int first, int i)
{
#define LETS(k) (filter_lets(filters, first + (k), i) ? -1 : 0)
	return columns & (int8)(LETS(0), LETS(1), LETS(2), LETS(3), LETS(4), LETS(5), LETS(6), LETS(7));
#undef LETS
}

void overlap_store(TEX_IN(aabb), LIST_IN(filters), BYTES_OUT(now), boxes b, int column, int i)
{
	int8 found = overlaps(TEX(aabb), b, i);
	uint8 bits = as_uint8(filters[FILTERS_ANY] ? let_through(filters, found, TILE * column, i) : found) & 1u;
	BYTES_STORE(now, TILE_COLUMNS * column, i, bits.lo);
	BYTES_STORE(now, TILE_COLUMNS * column + 1, i, bits.hi);
}

__kernel void overlap(TEX_IN(aabb), LIST_IN(filters), BYTES_IN(before), BYTES_OUT(now), BYTES_OUT(tiles), int4 domain)
{
	int column = get_global_id(0), first = get_global_id(1) * OVERLAP_GROUP, last = min(first + OVERLAP_GROUP, domain.x);
	if (column >= domain.x || column >= last)
		return;
	boxes b = boxes_load(TEX(aabb), column * TILE);
	for (int row = max(first, column); row < last; row++) {
		int8 any_row = (int8)(0);
		int end = min((row + 1) * TILE, domain.z);
		for (int i = row * TILE; i < end; i++)
			any_row |= overlaps(TEX(aabb), b, i);
		if (filters[FILTERS_ANY] && any(any_row)) {
			any_row = (int8)(0);
			for (int i = row * TILE; i < end; i++)
				any_row |= let_through(filters, overlaps(TEX(aabb), b, i), TILE * column, i);
		}
		uint old = BYTES_LOAD(before, column, row).x;
		uint state = (any(any_row) ? TILES_NOW : 0u) | ((old & TILES_NOW) ? TILES_BEFORE : 0u) | ((old & TILES_BEFORE) ? TILES_LONG_BEFORE : 0u);
		BYTES_STORE(tiles, column, row, (uint4)(state, 0u, 0u, 0u));
		if (!(state & (TILES_NOW | TILES_LONG_BEFORE)))
			continue;
		for (int i = row * TILE; i < end; i++)
			overlap_store(TEX(aabb), filters, TEX(now), b, column, i);
	}
}
