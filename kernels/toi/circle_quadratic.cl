/* Circles algebraically [4.1], where their distance is a quadratic of time; every other pair by separating axes. */

float4 pair_first(VERTICES_IN, body a, body b, float until, float4 rules)
{
	(void)rules;
	if (!(a.inverse_mass > 0.0f) && !(b.inverse_mass > 0.0f))
		return hit_none();
	if (a.count == 1 && b.count == 1 && a.a.x == b.a.x && a.a.y == b.a.y)
		return search_circles(a, b);
	return search_separating(VERTICES, a, b, until);
}
