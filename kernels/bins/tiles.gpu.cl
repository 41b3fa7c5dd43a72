/* The same lists as tiles.cl makes, by groups: each lane sees to some rows or columns of tiles, and goes through the shapes in order, which all lanes
 * bring to the group's memory. */

/* The tiles that each of a chunk's shapes touches; how many shapes there are. */
int chunk_load(RECORD_IN(boxes), TEX_IN(frame), int chunk, int shapes, __local int4 *tiles)
{
	int first = chunk * BIN_CHUNK, count = min(BIN_CHUNK, shapes - first);
	float4 box = TEX_LOAD(frame, FRAME_BOX, 0);
	for (int k = get_local_id(0); k < count; k += get_local_size(0))
		tiles[k] = tiles_of(boxes[first + k], box);
	barrier(CLK_LOCAL_MEM_FENCE);
	return count;
}

/* Of each row of tiles: how many of the chunk's shapes touch it, and how many tiles of it they touch. */
__kernel void bin_count(RECORD_IN(boxes), TEX_IN(frame), LIST_OUT(counts), int4 domain)
{
	__local int4 tiles[BIN_CHUNK];
	int chunk = get_group_id(0), rows = frame_fact(TEX(frame), true), count = chunk_load(boxes, TEX(frame), chunk, domain.z, tiles);
	for (int r = get_local_id(0); r < rows && count > 0; r += get_local_size(0)) {
		int shapes = 0, touched = 0;
		for (int k = 0; k < count; k++) {
			bool touches = r >= tiles[k].y && r < tiles[k].w;
			shapes += touches;
			touched += touches ? tiles[k].z - tiles[k].x : 0;
		}
		counts[2 * (chunk * rows + r)] = shapes;
		counts[2 * (chunk * rows + r) + 1] = touched;
	}
}

/* What all lanes have, together; *before becomes what those before this one have. */
int2 lanes_sum(__local int2 *sums, int2 own, int2 *before)
{
	int2 all = (int2)(0, 0);
	sums[get_local_id(0)] = own;
	barrier(CLK_LOCAL_MEM_FENCE);
	for (int k = 0; k < (int)get_local_size(0); k++) {
		if (k == (int)get_local_id(0))
			*before = all;
		all += sums[k];
	}
	barrier(CLK_LOCAL_MEM_FENCE);
	return all;
}

/* Where in its row's part of the list a chunk begins, and how long that part is. */
__kernel void bin_sum(LIST_IN(counts), TEX_IN(frame), LIST_OUT(offsets), LIST_OUT(totals), int4 domain)
{
	__local int2 sums[GROUP_MOST];
	int r = get_group_id(0), rows = frame_fact(TEX(frame), true), lane = get_local_id(0), lanes = get_local_size(0);
	int2 all = (int2)(0, 0), before;
	for (int first = 0; r < rows && first < domain.z; first += lanes) {
		int chunk = first + lane, at = 2 * (chunk * rows + r);
		int2 block = lanes_sum(sums, chunk < domain.z ? (int2)(counts[at], counts[at + 1]) : (int2)(0, 0), &before);
		if (chunk < domain.z)
			offsets[chunk * rows + r] = all.x + before.x;
		all += block;
	}
	for (int k = lane; r < rows && k < 2; k += lanes)
		totals[2 * r + k] = k ? all.y : all.x;
}

__kernel void bin_rows(RECORD_IN(boxes), TEX_IN(frame), LIST_IN(totals), LIST_OUT(offsets), PAIRS_OUT(list), int4 domain)
{
	__local int4 tiles[BIN_CHUNK];
	int chunk = get_group_id(0), rows = frame_fact(TEX(frame), true), count = chunk_load(boxes, TEX(frame), chunk, domain.z, tiles);
	for (int r = get_local_id(0); r < rows && count > 0; r += get_local_size(0)) {
		uint at = (uint)offsets[chunk * rows + r];
		for (int other = 0; other < r; other++)
			at += (uint)totals[2 * other];
		for (int k = 0; k < count; k++) {
			bool touches = r >= tiles[k].y && r < tiles[k].w;
			if (touches && at < (uint)domain.w)
				list[at] = (int2)(chunk * BIN_CHUNK + k, tiles[k].x | tiles[k].z << 16);
			at += touches ? 1 : 0;
		}
	}
}

/* Goes through a row's shapes for a lane's column: `at`, and one more for each that touches it. Where it is to write them they go to the list, from there on. */
uint column_pass(PAIRS_IN(rows), uint begin, uint end, int column, bool writes, uint at, uint room, LIST_OUT(list), __local int2 *block)
{
	for (uint first = begin; first < end; first += BIN_CHUNK) {
		int count = (int)min(end - first, (uint)BIN_CHUNK);
		for (int k = get_local_id(0); k < count; k += get_local_size(0))
			block[k] = rows[first + (uint)k];
		barrier(CLK_LOCAL_MEM_FENCE);
		for (int k = 0; k < count; k++) {
			bool touches = column >= (block[k].y & 0xffff) && column < block[k].y >> 16;
			if (touches && writes && at < room)
				list[at] = block[k].x;
			at += touches ? 1 : 0;
		}
		barrier(CLK_LOCAL_MEM_FENCE);
	}
	return at;
}

__kernel void bin_tiles(TEX_IN(frame), LIST_IN(totals), PAIRS_IN(rows), LIST_OUT(ends), LIST_OUT(list), int4 domain)
{
	__local int2 block[BIN_CHUNK], sums[GROUP_MOST];
	int row = get_group_id(0), columns = frame_fact(TEX(frame), false), lanes = get_local_size(0);
	uint begin = 0, from = 0;
	if (row >= frame_fact(TEX(frame), true))
		return;
	for (int r = 0; r < row; r++) {
		begin += (uint)totals[2 * r];
		from += (uint)totals[2 * r + 1];
	}
	uint end = min(begin + (uint)totals[2 * row], (uint)domain.z);
	for (int first = 0; first <= columns; first += lanes) { /* behind the last column is where all end */
		int column = first + (int)get_local_id(0), its = column < columns ? column : -1;
		int2 before, own = (int2)((int)column_pass(rows, begin, end, its, false, 0, 0, list, block), 0), all = lanes_sum(sums, own, &before);
		if (column <= columns)
			ends[row * (columns + 1) + column] = (int)from + before.x;
		column_pass(rows, begin, end, its, true, from + (uint)before.x, (uint)domain.w, list, block);
		from += (uint)all.x;
	}
}
