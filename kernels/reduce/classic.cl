/* The classic reduction [2.2]: the whole square, four texels a fragment; 4 m^2 reads for a pass to m x m. */

__kernel void reduce(TEX_IN(source), TEX_OUT(reduced), int4 domain)
{
	int x = get_global_id(0), y = get_global_id(1);
	if (x >= domain.x || y >= domain.y)
		return;
	TEX_STREAM(reduced, x, y, earliest_of_four(TEX(source), x, y, domain.z));
}
