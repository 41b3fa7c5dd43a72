/* Impulse [2.3], the paper's: each contact that approaches is given the whole impulse it would need alone. */

float2 contact_impulses(body a, body b, contact c, float restitution, float most, float micro)
{
	float2 j = (float2)(0.0f, 0.0f);
	if (c.rate[0] < most)
		j.x = gain_of(c.rate[0], restitution, micro) / coupling(a, b, c, 0, 0);
	if (c.count > 1 && c.rate[1] < most)
		j.y = gain_of(c.rate[1], restitution, micro) / coupling(a, b, c, 1, 1);
	return j;
}
