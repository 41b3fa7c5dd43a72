/* What all alternatives of the reduce slot share [2.2]: a texel holds the least hit time below it and where it is. Of
 * equal times the one of the lower row, then of the lower column, is the less, so that every order gives the same. */

float4 candidate_none(void)
{
	return (float4)(NO_HIT, 0.0f, 0.0f, 1.0f);
}

/* A texel of HitTimes and where it stands. */
float4 candidate(float4 hit, int x, int y)
{
	return (float4)(CHANNEL(hit, HITTIMES_HIT), (float)y, (float)x, CHANNEL(hit, HITTIMES_DONE));
}

/* The texel (row y, column x) of the texture to reduce: HitTimes in pass 0, the level before in the others. */
float4 reduced_load(TEX_IN(source), int x, int y, int pass)
{
	float4 texel = TEX_LOAD(source, x, y);
	return pass > 0 ? texel : candidate(texel, x, y);
}

float4 earlier(float4 a, float4 b)
{
	float ta = CHANNEL(a, REDUCED_HIT), tb = CHANNEL(b, REDUCED_HIT), ra = CHANNEL(a, REDUCED_ROW), rb = CHANNEL(b, REDUCED_ROW);
	bool later = tb < ta || (tb == ta && (rb < ra || (rb == ra && CHANNEL(b, REDUCED_COLUMN) < CHANNEL(a, REDUCED_COLUMN))));
	return later ? b : a;
}

/* The one of `best` and the texel (row y, column x) that is earlier. In pass 0 the texels must come in the order of their
 * rows and columns: then the times alone decide, which is most of the work of a reduction. */
float4 earlier_at(TEX_IN(source), float4 best, int x, int y, int pass)
{
	float4 texel = TEX_LOAD(source, x, y);
	if (pass > 0)
		return earlier(best, texel);
	return CHANNEL(texel, HITTIMES_HIT) < CHANNEL(best, REDUCED_HIT) ? candidate(texel, x, y) : best;
}

float4 earliest_of_four(TEX_IN(source), int x, int y, int pass)
{
	float4 best = reduced_load(TEX(source), 2 * x, 2 * y, pass);
	best = earlier_at(TEX(source), best, 2 * x + 1, 2 * y, pass);
	best = earlier_at(TEX(source), best, 2 * x, 2 * y + 1, pass);
	return earlier_at(TEX(source), best, 2 * x + 1, 2 * y + 1, pass);
}

/* The four, and the two beside them that lie in squares on the diagonal, which have no fragment of their own. */
float4 earliest_of_six(TEX_IN(source), int x, int y, int pass)
{
	float4 best = reduced_load(TEX(source), 2 * x, 2 * x + 1, pass);
	best = earlier_at(TEX(source), best, 2 * x, 2 * y, pass);
	best = earlier_at(TEX(source), best, 2 * x + 1, 2 * y, pass);
	best = earlier_at(TEX(source), best, 2 * x, 2 * y + 1, pass);
	best = earlier_at(TEX(source), best, 2 * x + 1, 2 * y + 1, pass);
	return earlier_at(TEX(source), best, 2 * y, 2 * y + 1, pass);
}
