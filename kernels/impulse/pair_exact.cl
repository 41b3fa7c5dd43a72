/* Impulse [2.3], with the two contacts of a pair solved together, so that each gets back its share of its own speed and a
 * restitution of 1 keeps the energy. Where that would take a pull, or one contact alone approaches, that one bears it all. */

/* (k00 k11 - k01 k01, k11 - k01, k00 - k01), of what differs between the points alone: where they are near each other nothing is left of the numbers themselves. */
float3 coupling_differences(body a, body b, contact c)
{
	float ref = cross2(c.ref[0], c.n), inc = cross2(c.inc[0], c.n), ref_1 = cross2(c.ref[1], c.n), inc_1 = cross2(c.inc[1], c.n);
	float ref_way = ref_1 - ref, inc_way = inc_1 - inc, twist = ref * inc_way - inc * ref_way;
	float turning = a.inverse_inertia * (ref_way * ref_way) + b.inverse_inertia * (inc_way * inc_way);
	float determinant = (a.inverse_mass + b.inverse_mass) * turning + (a.inverse_inertia * twist) * (b.inverse_inertia * twist);
	return (float3)(determinant, a.inverse_inertia * (ref_1 * ref_way) + b.inverse_inertia * (inc_1 * inc_way),
		-(a.inverse_inertia * (ref * ref_way) + b.inverse_inertia * (inc * inc_way)));
}

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
	float3 by = coupling_differences(a, b, c);
	if (by.x > SINGULAR * (k00 * k11)) {
		float k01 = coupling(a, b, c, 0, 1), difference = (2.0f * ((gain1 - gain0) * k01) + (gain1 * by.z - gain0 * by.y)) / by.x;
		float sum = (2.0f * (gain0 + gain1) - difference * (by.y - by.z)) / ((k00 + k11) + 2.0f * k01);
		float j0 = 0.5f * (sum - difference), j1 = 0.5f * (sum + difference);
		if (j0 >= 0.0f && j1 >= 0.0f)
			return (float2)(j0, j1);
	}
	return c.rate[0] <= c.rate[1] ? (float2)(gain0 / k00, 0.0f) : (float2)(0.0f, gain1 / k11);
}
