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

/* Of body k's contact with a wall at time t of its step; *total: of the two points together. */
float4 wall_push(TEX_IN(vertices), float4 room, body k, int wall, float t, float restitution, float length, float *total)
{
	float offset;
	body walls = k;
	float2 n = wall_normal(room, wall, &offset);
	contact c = wall_contact(TEX(vertices), k, n, t, wall_slop(k));
	walls.inverse_mass = walls.inverse_inertia = 0.0f;
	float2 j = contact_impulses(walls, k, c, restitution, wall_stillness(k));
	*total = j.x + j.y;
	float torque = torque_of(c, c.inc[0], c.inc[1], j);
	return (float4)((*total * n.x) / length, (*total * n.y) / length, torque / length, 0.0f);
}

/* Of the contact of bodies a and b, the row's and the column's, at time t of their step. */
float4 pair_push(TEX_IN(vertices), body a, body b, float t, float length, float *total)
{
	pose p = pose_at(a, b, t);
	float slop = pair_slop(a, b), restitution = larger(a.restitution, b.restitution), stillness = pair_stillness(a, b);
	contact c = contact_at(TEX(vertices), a, b, p, best_axis(TEX(vertices), a, b, p), slop);
	float2 j = c.swapped ? contact_impulses(b, a, c, restitution, stillness) : contact_impulses(a, b, c, restitution, stillness);
	*total = j.x + j.y;
	float ref = -torque_of(c, c.ref[0], c.ref[1], j) / length;
	float inc = torque_of(c, c.inc[0], c.inc[1], j) / length;
	float2 push = (float2)((*total * c.n.x) / length, (*total * c.n.y) / length);
	return c.swapped ? (float4)(push.x, push.y, inc, ref) : (float4)(-push.x, -push.y, ref, inc);
}

float4 hit_push(STATE_IN, TEX_IN(vertices), float4 hit, float length)
{
	int column = (int)CHANNEL(hit, HIT_COLUMN);
	float t = CHANNEL(hit, HIT_TIME), total;
	body a = body_load(STATE, (int)CHANNEL(hit, HIT_ROW), length);
	if (column >= 0)
		return pair_push(TEX(vertices), a, body_load(STATE, column, length), t, length, &total);
	return wall_push(TEX(vertices), TEX_LOAD(uniforms, UNIFORMS_ROOM, 0), a, -1 - column, t,
		larger(a.restitution, CHANNEL(TEX_LOAD(uniforms, UNIFORMS_RULES, 0), RULES_RESTITUTION)), length, &total);
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
		result = hit_push(STATE, TEX(vertices), hit, length);
	TEX_STORE(impulse, 0, 0, result);
}
