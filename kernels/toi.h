/* What all alternatives of the toi slot share: the walk over the pairs whose AABBs overlap, a tile a work-item. The tile's
 * first hit comes along, for the reduction. */

/* One byte of four. */
uint byte_of(uint4 texel, int k)
{
	uint low = (k & 1) ? texel.y : texel.x, high = (k & 1) ? texel.w : texel.z;
	return (k & 2) ? high : low;
}

uint4 overlap_load(BYTES_IN(overlap), bool any_there, int column, int i)
{
	return any_there ? BYTES_LOAD(overlap, column, i) : (uint4)(0u, 0u, 0u, 0u);
}

__kernel void toi_first(STATE_IN, VERTICES_IN, TEX_IN(clock), BYTES_IN(tiles), BYTES_IN(overlap), BYTES_IN(before), TEX_OUT(hits), TEX_OUT(tile_hits),
	int4 domain)
{
	int column = get_global_id(0), row = get_global_id(1);
	if (column >= domain.x || row >= domain.y || column > row)
		return;
	uint state = BYTES_LOAD(tiles, column, row).x;
	if (!(state & (TILES_NOW | TILES_BEFORE)))
		return;
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0), first = candidate_none();
	int end = min((row + 1) * TILE, domain.z);
	for (int i = row * TILE; i < end; i++) {
		for (int four = TILE_COLUMNS * column; four < TILE_COLUMNS * (column + 1); four++) {
			uint4 now = overlap_load(TEX(overlap), (state & TILES_NOW) != 0, four, i);
			uint4 old = overlap_load(TEX(before), (state & TILES_BEFORE) != 0, four, i) | now;
			if (!(old.x | old.y | old.z | old.w))
				continue;
			body a = body_load(STATE, i, length);
			for (int k = 0; k < OVERLAP_COLUMNS; k++) {
				int j = four * OVERLAP_COLUMNS + k;
				float4 hit = hit_none();
				if (!byte_of(old, k))
					continue;
				if (byte_of(now, k))
					hit = pair_first(VERTICES, a, body_load(STATE, j, length), 1.0f, rules);
				TEX_STORE(hits, j, i, hit);
				first = earlier(first, candidate(hit, j, i));
			}
		}
	}
	TEX_STORE(tile_hits, column, row, first);
}
