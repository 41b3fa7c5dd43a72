/* Fewer, fatter passes than the paper's: the hit times come with the first hit of each tile, and a pass takes TILE x TILE
 * texels to one, squares on the diagonal too. Reads m^2 / 2 texels of the first level instead of N^2 / 2. */

__kernel void reduce_tiles(TEX_IN(source), TEX_OUT(reduced), int4 domain)
{
	int x = get_global_id(0), y = get_global_id(1), end = min((y + 1) * TILE, domain.z);
	float4 first = candidate_none();
	if (x >= domain.x || y >= domain.y || x > y)
		return;
	for (int row = y * TILE; row < end; row++)
		for (int column = x * TILE; column <= min(row, x * TILE + TILE - 1); column++)
			first = earlier(first, TEX_LOAD(source, column, row));
	TEX_STORE(reduced, x, y, first);
}
