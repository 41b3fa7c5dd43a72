/* The first contact by separating axes: no crossing is missed, however fast, and whether or not a vertex gets inside. */

float4 pair_first(VERTICES_IN, body a, body b, float until, float4 rules)
{
	(void)rules;
	if (!(a.inverse_mass > 0.0f) && !(b.inverse_mass > 0.0f))
		return hit_none();
	return search_separating(VERTICES, a, b, until);
}
