/* The (4+6)-reduction [2.2]: six texels beside the diagonal, four elsewhere; 2 (m^2 - 1) reads for a pass to m x m, and
 * one for the last, whose only fragment takes the one pair that is left. */

__kernel void reduce(TEX_IN(source), TEX_OUT(reduced), int4 domain)
{
	int x = get_global_id(0), y = get_global_id(1), pass = domain.z;
	if (domain.x == 1)
		reduce_last(TEX(source), TEX(reduced), pass);
	else if (y < domain.y && x < y) /* pass 0, most of the work, by itself: so its fragments need not ask which pass it is */
		TEX_STREAM(reduced, x, y,
			x + 1 == y     ? earliest_of_six(TEX(source), x, y, pass)
				: pass > 0 ? earliest_of_four(TEX(source), x, y, pass)
						   : earliest_of_four(TEX(source), x, y, 0));
}
