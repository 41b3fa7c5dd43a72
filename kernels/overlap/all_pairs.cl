/* OverlapAABB [2.1]: every pair of the lower triangle; a work-item does a tile of 4 x 4 pairs. */

uint overlap_bits(float4 a, float4 b, bool pair, uint before)
{
	bool apart = CHANNEL(a, AABB_MAX_X) < CHANNEL(b, AABB_MIN_X) || CHANNEL(b, AABB_MAX_X) < CHANNEL(a, AABB_MIN_X)
		|| CHANNEL(a, AABB_MAX_Y) < CHANNEL(b, AABB_MIN_Y) || CHANNEL(b, AABB_MAX_Y) < CHANNEL(a, AABB_MIN_Y);
	uint old = (before & OVERLAP_NOW) ? OVERLAP_BEFORE : 0u;
	return pair && !apart ? (old | OVERLAP_NOW) : old;
}

__kernel void overlap(TEX_IN(aabb), BYTES_IN(before), BYTES_OUT(now), int4 domain)
{
	int count = domain.z, column = get_global_id(0), tile = get_global_id(1);
	int j = column * OVERLAP_COLUMNS;
	if (column >= domain.x || tile >= domain.y || column > tile)
		return;
	float4 b0 = ROW_LOAD(aabb, j), b1 = ROW_LOAD(aabb, j + 1), b2 = ROW_LOAD(aabb, j + 2), b3 = ROW_LOAD(aabb, j + 3);
	for (int row = 0; row < OVERLAP_TILE; row++) {
		int i = tile * OVERLAP_TILE + row;
		if (i >= count)
			return;
		float4 a = ROW_LOAD(aabb, i);
		uint4 old = BYTES_LOAD(before, column, i), new;
		new.x = overlap_bits(a, b0, j < i, old.x);
		new.y = overlap_bits(a, b1, j + 1 < i, old.y);
		new.z = overlap_bits(a, b2, j + 2 < i, old.z);
		new.w = overlap_bits(a, b3, j + 3 < i, old.w);
		BYTES_STORE(now, column, i, new);
	}
}
