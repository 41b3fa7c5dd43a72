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

/* What a texel (row y, column x) of the texture to reduce says: HitTimes in pass 0, the level before in the others. */
float4 candidate_in(float4 texel, int x, int y, int pass)
{
	if (pass > 0)
		return texel;
	return CHANNEL(texel, HITTIMES_HIT) < NO_HIT ? candidate(texel, x, y) : candidate_none();
}

float4 earlier(float4 a, float4 b)
{
	float ta = CHANNEL(a, REDUCED_HIT), tb = CHANNEL(b, REDUCED_HIT), ra = CHANNEL(a, REDUCED_ROW), rb = CHANNEL(b, REDUCED_ROW);
	bool later = tb < ta || (tb == ta && (rb < ra || (rb == ra && CHANNEL(b, REDUCED_COLUMN) < CHANNEL(a, REDUCED_COLUMN))));
	return later ? b : a;
}

/* Is there no hit among texels of which these are the least channels? So it is nearly everywhere: a pass is a loop of a few loads, this question and
 * a store, if what is done with a hit is kept out of it. */
bool is_none(float4 least, int pass)
{
	return (pass > 0 ? CHANNEL(least, REDUCED_HIT) : CHANNEL(least, HITTIMES_HIT)) >= NO_HIT;
}

/* Of a square whose first texel is (row y, column x). */
__attribute__((noinline)) float4 earliest_in(float4 a, float4 b, float4 c, float4 d, int x, int y, int pass)
{
	float4 above = earlier(candidate_in(a, x, y, pass), candidate_in(b, x + 1, y, pass));
	float4 below = earlier(candidate_in(c, x, y + 1, pass), candidate_in(d, x + 1, y + 1, pass));
	return earlier(above, below);
}

/* Of two texels below the diagonal, in columns x and y. */
__attribute__((noinline)) float4 earliest_beside(float4 a, float4 b, int x, int y, int pass)
{
	return earlier(candidate_in(a, x, x + 1, pass), candidate_in(b, y, y + 1, pass));
}

float4 earliest_of_four(TEX_IN(source), int x, int y, int pass)
{
	float4 a = TEX_LOAD(source, 2 * x, 2 * y), b = TEX_LOAD(source, 2 * x + 1, 2 * y);
	float4 c = TEX_LOAD(source, 2 * x, 2 * y + 1), d = TEX_LOAD(source, 2 * x + 1, 2 * y + 1);
	return is_none(min(min(a, b), min(c, d)), pass) ? candidate_none() : earliest_in(a, b, c, d, 2 * x, 2 * y, pass);
}

/* The four, and the two beside them that lie in squares on the diagonal, which have no fragment of their own. */
float4 earliest_of_six(TEX_IN(source), int x, int y, int pass)
{
	float4 a = TEX_LOAD(source, 2 * x, 2 * y), b = TEX_LOAD(source, 2 * x + 1, 2 * y), left = TEX_LOAD(source, 2 * x, 2 * x + 1);
	float4 c = TEX_LOAD(source, 2 * x, 2 * y + 1), d = TEX_LOAD(source, 2 * x + 1, 2 * y + 1), right = TEX_LOAD(source, 2 * y, 2 * y + 1);
	if (is_none(min(min(min(a, b), min(c, d)), min(left, right)), pass))
		return candidate_none();
	return earlier(earliest_in(a, b, c, d, 2 * x, 2 * y, pass), earliest_beside(left, right, 2 * x, 2 * y, pass));
}

/* The last pass of those that keep below the diagonal: one texel is left there. */
void reduce_last(TEX_IN(source), TEX_OUT(reduced), int pass)
{
	if (get_global_id(0) == 0 && get_global_id(1) == 0)
		TEX_STORE(reduced, 0, 0, candidate_in(TEX_LOAD(source, 0, 1), 0, 1, pass));
}
