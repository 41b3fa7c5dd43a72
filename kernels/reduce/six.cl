/* The 6-reduction [2.2]: fragments of the lower triangle alone, six texels each; 3 (m^2 - m) reads for a pass to m x m,
 * and one for the last, whose only fragment takes the one pair that is left. */

__kernel void reduce(TEX_IN(source), TEX_OUT(reduced), int4 domain)
{
	int x = get_global_id(0), y = get_global_id(1);
	if (domain.x == 1)
		reduce_last(TEX(source), TEX(reduced), domain.z);
	else if (y < domain.y && x < y)
		TEX_STREAM(reduced, x, y, earliest_of_six(TEX(source), x, y, domain.z));
}
