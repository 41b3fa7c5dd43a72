/* The (4+6)-reduction [2.2]: six texels beside the diagonal, four elsewhere; 2 (m^2 - 1) reads for a pass to m x m, and
 * one for the last, whose only fragment takes the one pair that is left. */

__kernel void reduce(TEX_IN(source), TEX_OUT(reduced), int4 domain)
{
	int x = get_global_id(0), y = get_global_id(1);
	if (domain.x == 1) {
		if (x == 0 && y == 0)
			TEX_STORE(reduced, 0, 0, reduced_load(TEX(source), 0, 1, domain.z));
		return;
	}
	if (y >= domain.y || x >= y)
		return;
	float4 first = x + 1 == y ? earliest_of_six(TEX(source), x, y, domain.z) : earliest_of_four(TEX(source), x, y, domain.z);
	TEX_STORE(reduced, x, y, first);
}
