/* What all alternatives of the toi slot share: the walk over the pairs whose AABBs overlap. A work-item does the four
 * pairs of one texel of Overlap; what did not overlap in this step nor in the one before is NO_HIT already. */

/* The alternative's own: a texel of HitTimes for two bodies [2.1, Bisection1]. */
float4 pair_first(TEX_IN(vertices), body a, body b, float4 rules);

#define PAIR(bits, j)                                                                                        \
	if (bits & OVERLAP_NOW)                                                                                   \
		TEX_STORE(hits, j, i, pair_first(TEX(vertices), a, body_load(STATE, j, length), rules));              \
	else if (bits)                                                                                            \
		TEX_STORE(hits, j, i, hit_none());

__kernel void toi_first(STATE_IN, TEX_IN(vertices), TEX_IN(clock), BYTES_IN(overlap), TEX_OUT(hits), int4 domain)
{
	int column = get_global_id(0), i = get_global_id(1), j = column * OVERLAP_COLUMNS;
	if (column >= domain.x || i >= domain.y || j >= i)
		return;
	uint4 bits = BYTES_LOAD(overlap, column, i);
	if (!(bits.x | bits.y | bits.z | bits.w))
		return;
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	body a = body_load(STATE, i, length);
	PAIR(bits.x, j)
	PAIR(bits.y, j + 1)
	PAIR(bits.z, j + 2)
	PAIR(bits.w, j + 3)
}
