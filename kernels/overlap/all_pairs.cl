/* OverlapAABB [2.1]: every pair of the lower triangle, eight columns at once; a work-item does a few tiles. */

/* Eight columns' boxes. */
typedef struct boxes {
	float8 min_x, min_y, max_x, max_y;
	int8 index, categories, masks;
} boxes;

boxes boxes_load(TEX_IN(aabb), LIST_IN(filters), int j)
{
	boxes b;
	int of[2 * TILE] = {0};
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
	for (int k = 0; k < 2 * TILE && filters[FILTERS_ANY]; k++)
		of[k] = filters[FILTER(j, k)];
	b.categories = (int8)(of[0], of[2], of[4], of[6], of[8], of[10], of[12], of[14]);
	b.masks = (int8)(of[1], of[3], of[5], of[7], of[9], of[11], of[13], of[15]);
	return b;
}

/* -1 in the columns whose boxes overlap that of row i, and that may hit its body; 0 in the others and from the diagonal on */
int8 overlaps(TEX_IN(aabb), LIST_IN(filters), boxes b, int i)
{
	float4 a = ROW_LOAD(aabb, i);
	int8 all = (b.index < i) & (b.min_x <= CHANNEL(a, AABB_MAX_X)) & (b.max_x >= CHANNEL(a, AABB_MIN_X)) & (b.min_y <= CHANNEL(a, AABB_MAX_Y))
		& (b.max_y >= CHANNEL(a, AABB_MIN_Y));
	if (filters[FILTERS_ANY])
		all &= ((b.categories & filters[FILTER(i, FILTER_MASK)]) != 0) & ((b.masks & filters[FILTER(i, FILTER_CATEGORIES)]) != 0);
	return all;
}

void overlap_store(TEX_IN(aabb), LIST_IN(filters), BYTES_OUT(now), boxes b, int column, int i)
{
	uint8 bits = as_uint8(overlaps(TEX(aabb), filters, b, i)) & 1u;
	BYTES_STORE(now, TILE_COLUMNS * column, i, bits.lo);
	BYTES_STORE(now, TILE_COLUMNS * column + 1, i, bits.hi);
}

__kernel void overlap(TEX_IN(aabb), LIST_IN(filters), BYTES_IN(before), BYTES_OUT(now), BYTES_OUT(tiles), int4 domain)
{
	int column = get_global_id(0), first = get_global_id(1) * OVERLAP_GROUP, last = min(first + OVERLAP_GROUP, domain.x);
	if (column >= domain.x || column >= last)
		return;
	boxes b = boxes_load(TEX(aabb), filters, column * TILE);
	for (int row = max(first, column); row < last; row++) {
		int8 any_row = (int8)(0);
		int end = min((row + 1) * TILE, domain.z);
		for (int i = row * TILE; i < end; i++)
			any_row |= overlaps(TEX(aabb), filters, b, i);
		uint old = BYTES_LOAD(before, column, row).x;
		uint state = (any(any_row) ? TILES_NOW : 0u) | ((old & TILES_NOW) ? TILES_BEFORE : 0u) | ((old & TILES_BEFORE) ? TILES_LONG_BEFORE : 0u);
		BYTES_STORE(tiles, column, row, (uint4)(state, 0u, 0u, 0u));
		if (!(state & (TILES_NOW | TILES_LONG_BEFORE)))
			continue;
		for (int i = row * TILE; i < end; i++)
			overlap_store(TEX(aabb), filters, TEX(now), b, column, i);
	}
}
