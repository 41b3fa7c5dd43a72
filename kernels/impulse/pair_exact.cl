/* Impulse [2.3], with the two contacts of a pair solved together, so that each gets back its share of its own speed and a
 * restitution of 1 keeps the energy. Where that would take a pull, or one contact alone approaches, that one bears it all. */

float2 contact_impulses(body a, body b, contact c, float restitution, float most, float micro, bool event)
{
	(void)event;
	float k00 = coupling(a, b, c, 0, 0), gain0 = gain_of(c.rate[0], restitution, micro);
	bool first = c.rate[0]<most, second = c.count> 1 && c.rate[1] < most;
	if (!second)
		return first ? (float2)(gain0 / k00, 0.0f) : (float2)(0.0f, 0.0f);
	float k11 = coupling(a, b, c, 1, 1), gain1 = gain_of(c.rate[1], restitution, micro);
	if (!first)
		return (float2)(0.0f, gain1 / k11);
	float k01 = coupling(a, b, c, 0, 1), determinant = k00 * k11 - k01 * k01;
	if (determinant > SINGULAR * (k00 * k11)) {
		float j0 = (gain0 * k11 - gain1 * k01) / determinant, j1 = (gain1 * k00 - gain0 * k01) / determinant;
		if (j0 >= 0.0f && j1 >= 0.0f)
			return (float2)(j0, j1);
	}
	return c.rate[0] <= c.rate[1] ? (float2)(gain0 / k00, 0.0f) : (float2)(0.0f, gain1 / k11);
}
