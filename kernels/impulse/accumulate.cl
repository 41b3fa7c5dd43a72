/* Impulse [2.3], the paper's: each contact that approaches is given the whole impulse it would need alone. That adds energy where
 * one's impulse helps the other; there, of events, only the faster one gets it. */

float2 contact_impulses(body a, body b, contact c, float restitution, float most, float micro, bool event)
{
	float2 j = (float2)(0.0f, 0.0f);
	bool helps = event && c.count > 1 && coupling(a, b, c, 0, 1) > 0.0f, second = c.rate[1] < c.rate[0];
	if (c.rate[0] < most && !(helps && second))
		j.x = gain_of(c.rate[0], restitution, micro) / coupling(a, b, c, 0, 0);
	if (c.count > 1 && c.rate[1] < most && (second || !helps))
		j.y = gain_of(c.rate[1], restitution, micro) / coupling(a, b, c, 1, 1);
	return j;
}
