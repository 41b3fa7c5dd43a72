/* What the alternatives of the impulse slot share [2.3]: the step's first hit is looked up, its contact found again, and
 * the alternative's impulses along the normal are put together; one work-item, since one hit ends the step. */

/* How much the rate of one contact changes by a unit impulse at another (or the same): formula (2)'s denominator. */
float coupling(body a, body b, contact c, int i, int k)
{
	float mass = a.inverse_mass + b.inverse_mass;
	float ref = a.inverse_inertia * (cross2(c.ref[i], c.n) * cross2(c.ref[k], c.n));
	float inc = b.inverse_inertia * (cross2(c.inc[i], c.n) * cross2(c.inc[k], c.n));
	return (mass + ref) + inc;
}

/* The impulses' torque about the centre from which the levers go. */
float torque_of(contact c, float2 lever0, float2 lever1, float2 j)
{
	return cross2(lever0, c.n) * j.x + (c.count > 1 ? cross2(lever1, c.n) * j.y : 0.0f);
}

/* The alternative's own: impulses (j0, j1) at the contact's points that part the reference a and the incident body b. */
float2 contact_impulses(body a, body b, contact c, float restitution, float stillness);

float4 room_impulse(STATE_IN, TEX_IN(vertices), float4 hit, float length)
{
	float offset;
	float4 room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0), rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	body k = body_load(STATE, (int)CHANNEL(hit, HIT_ROW), length), walls = k;
	float2 n = wall_normal(room, -1 - (int)CHANNEL(hit, HIT_COLUMN), &offset);
	contact c = wall_contact(TEX(vertices), k, n, CHANNEL(hit, HIT_TIME), wall_slop(k));
	walls.inverse_mass = walls.inverse_inertia = 0.0f;
	float2 j = contact_impulses(walls, k, c, larger(k.restitution, CHANNEL(rules, RULES_RESTITUTION)), wall_stillness(k));
	float total = j.x + j.y;
	float torque = torque_of(c, c.inc[0], c.inc[1], j);
	return (float4)((total * n.x) / length, (total * n.y) / length, torque / length, 0.0f);
}

float4 pair_impulse(STATE_IN, TEX_IN(vertices), float4 hit, float length)
{
	body a = body_load(STATE, (int)CHANNEL(hit, HIT_ROW), length), b = body_load(STATE, (int)CHANNEL(hit, HIT_COLUMN), length);
	pose p = pose_at(a, b, CHANNEL(hit, HIT_TIME));
	float slop = pair_slop(a, b), restitution = larger(a.restitution, b.restitution), stillness = pair_stillness(a, b);
	contact c = contact_at(TEX(vertices), a, b, p, best_axis(TEX(vertices), a, b, p), slop);
	float2 j = c.swapped ? contact_impulses(b, a, c, restitution, stillness) : contact_impulses(a, b, c, restitution, stillness);
	float total = j.x + j.y;
	float ref = -torque_of(c, c.ref[0], c.ref[1], j) / length;
	float inc = torque_of(c, c.inc[0], c.inc[1], j) / length;
	float2 push = (float2)((total * c.n.x) / length, (total * c.n.y) / length);
	return c.swapped ? (float4)(push.x, push.y, inc, ref) : (float4)(-push.x, -push.y, ref, inc);
}

__kernel void impulse(STATE_IN, TEX_IN(vertices), TEX_IN(clock), TEX_OUT(impulse), int4 domain)
{
	(void)domain;
	if (get_global_id(0) > 0)
		return;
	float4 hit = TEX_LOAD(clock, CLOCK_HIT, 0);
	float length = CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH);
	float4 result = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	if (CHANNEL(hit, HIT_TIME) <= 1.0f && CHANNEL(hit, HIT_DONE) > 0.0f)
		result = CHANNEL(hit, HIT_COLUMN) < 0.0f ? room_impulse(STATE, TEX(vertices), hit, length)
		                                         : pair_impulse(STATE, TEX(vertices), hit, length);
	TEX_STORE(impulse, 0, 0, result);
}
