/* Which shapes each tile of pixels has, in painter's order: sorted by rows of tiles, then by column. Chunks of shapes are
 * counted and written by one work-item each, so the order holds without atomics. On a GPU tiles.gpu.cl stands for this. */

/* Of each row of tiles: how many of the chunk's shapes touch it, and how many tiles of it they touch. */
__kernel void bin_count(RECORD_IN(boxes), TEX_IN(frame), LIST_OUT(counts), int4 domain)
{
	int chunk = get_global_id(0), rows = frame_fact(TEX(frame), true);
	if (chunk >= domain.x)
		return;
	__global int *mine = counts + 2 * chunk * rows;
	float4 box = TEX_LOAD(frame, FRAME_BOX, 0);
	for (int r = 0; r < 2 * rows; r++)
		mine[r] = 0;
	for (int k = chunk * BIN_CHUNK; k < min((chunk + 1) * BIN_CHUNK, domain.z); k++) {
		int4 t = tiles_of(boxes[k], box);
		for (int r = t.y; r < t.w; r++) {
			mine[2 * r]++;
			mine[2 * r + 1] += t.z - t.x;
		}
	}
}

/* Where in its row's part of the list a chunk begins, and how long that part is. */
__kernel void bin_sum(LIST_IN(counts), TEX_IN(frame), LIST_OUT(offsets), LIST_OUT(totals), int4 domain)
{
	int r = get_global_id(0), rows = domain.x, shapes = 0, tiles = 0;
	if (r >= rows)
		return;
	for (int chunk = 0; chunk < domain.z; chunk++) {
		offsets[chunk * rows + r] = shapes;
		shapes += counts[2 * (chunk * rows + r)];
		tiles += counts[2 * (chunk * rows + r) + 1];
	}
	totals[2 * r] = shapes;
	totals[2 * r + 1] = tiles;
}

__kernel void bin_rows(RECORD_IN(boxes), TEX_IN(frame), LIST_IN(totals), LIST_OUT(offsets), PAIRS_OUT(list), int4 domain)
{
	int chunk = get_global_id(0), rows = frame_fact(TEX(frame), true), start = 0;
	if (chunk >= domain.x)
		return;
	__global int *mine = offsets + chunk * rows;
	float4 box = TEX_LOAD(frame, FRAME_BOX, 0);
	for (int r = 0; r < rows; r++) {
		mine[r] += start;
		start += totals[2 * r];
	}
	for (int k = chunk * BIN_CHUNK; k < min((chunk + 1) * BIN_CHUNK, domain.z); k++) {
		int4 t = tiles_of(boxes[k], box);
		for (int r = t.y; r < t.w; r++) {
			uint at = (uint)mine[r]++;
			if (at < (uint)domain.w)
				list[at] = (int2)(k, t.x | t.z << 16);
		}
	}
}

__kernel void bin_tiles(TEX_IN(frame), LIST_IN(totals), PAIRS_IN(rows), LIST_OUT(ends), LIST_OUT(list), int4 domain)
{
	int row = get_global_id(0), columns = frame_fact(TEX(frame), false);
	uint begin = 0, from = 0, room = (uint)domain.w;
	if (row >= domain.x)
		return;
	for (int r = 0; r < row; r++) {
		begin += (uint)totals[2 * r];
		from += (uint)totals[2 * r + 1];
	}
	uint end = min(begin + (uint)totals[2 * row], (uint)domain.z);
	__global int *mine = ends + row * (columns + 1);
	for (int c = 0; c <= columns; c++)
		mine[c] = 0;
	for (uint k = begin; k < end; k++) {
		int its = rows[k].y;
		for (int c = its & 0xffff; c < its >> 16; c++)
			mine[c]++;
	}
	for (int c = 0; c <= columns; c++)
		mine[c] = (int)(from += (uint)mine[c]);
	for (uint k = end; k-- > begin;) { /* from the back: each tile's end becomes its beginning */
		int2 its = rows[k];
		for (int c = its.y & 0xffff; c < its.y >> 16; c++) {
			uint at = (uint)--mine[c];
			if (at < room)
				list[at] = its.x;
		}
	}
}
