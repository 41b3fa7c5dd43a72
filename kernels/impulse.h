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

/* By how much the rate of a contact is to grow. Of bodies pushed together `micro` is the least speed at which they part. */
float gain_of(float rate, float restitution, float micro)
{
	return -rate < micro ? micro - rate : -(1.0f + restitution) * rate;
}

/* The alternative's own: impulses (j0, j1) that part the reference a and the incident body b, at those of the contact's points with a rate below `most`.
 * Of an `event` they add no energy. */
float2 contact_impulses(body a, body b, contact c, float restitution, float most, float micro, bool event);

/* How a hit is answered: MICRO or 0, what a crowd makes of that, and of the stillness, and the part that threshold_of takes. */
typedef struct rules_of_hit {
	float restitution, micro, crowd, shake, part;
	float slow;        /* below so much of what the stronger push makes of a speed in a step */
	float weight;      /* what gravity makes of one: a push that a crowd counts, though forces may bear it */
	float bound;       /* a crowd counts no more of a push than that, or the approach */
	float friction;    /* coefficient */
	bool rapid, event; /* event: of the step events */
} rules_of_hit;

/* What a hit did. */
typedef struct impact {
	float total;  /* impulse of the two points together */
	bool lossy;   /* it takes energy, by restitution or friction */
	bool slow;    /* it does, and was slow by its rules */
	bool ruled;   /* its rules made something else of it than its restitution would */
	float4 where; /* as in IMPULSE_WHERE */
} impact;

/* What is rapid again and again is elastic, but where a push brings the bodies together only up to the speed that it makes in a step: what falls on a
 * body at rest, which is in many rapid hits, is no collapse. */
float restitution_of(rules_of_hit rules, contact c, float micro)
{
	bool fast = micro > 0.0f && -rate_of(c) > micro * (1.0f / MICRO);
	return rules.rapid && !fast ? 1.0f : rules.restitution;
}

/* The speed at which a contact parts at least: `micro` by a push along the normal; in a crowd by the stronger `push` on the bodies and by `still`, their
 * stillness. */
float least_speed(rules_of_hit rules, contact c, float micro, float push, float still)
{
	float counted = smaller(larger(push, rules.weight), larger(rules.bound, -rate_of(c)));
	return larger(micro, larger(rules.crowd * counted, rules.shake * still));
}

rules_of_hit first_impact_rules(float restitution, float friction)
{
	rules_of_hit rules;
	rules.restitution = restitution;
	rules.friction = friction;
	rules.micro = rules.crowd = rules.shake = rules.weight = rules.bound = 0.0f;
	rules.part = rules.slow = 1.0f;
	rules.rapid = rules.event = false;
	return rules;
}

/* Answered by that restitution and that least speed, which its rules gave. */
impact impact_of(rules_of_hit rules, contact c, float push, float restitution, float least, float2 j)
{
	bool lossy = is_lossy(rules.restitution, rules.friction);
	impact hit = {j.x + j.y, lossy, lossy && -rate_of(c) < rules.slow * larger(push, rules.weight),
		restitution != rules.restitution || -rate_of(c) < least, (float4)(0.0f, 0.0f, 0.0f, 0.0f)};
	return hit;
}

/* Where impulses at the points of a contact come to, from a body's centre: `sign` times the normal from there to the rim of a circle. */
float2 push_lever(body k, contact c, float2 lever0, float2 lever1, float part, float sign)
{
	if (k.count == 1)
		return (float2)((sign * k.radius) * c.n.x, (sign * k.radius) * c.n.y);
	if (c.count == 1)
		return lever0;
	return (float2)(lever0.x + part * (lever1.x - lever0.x), lever0.y + part * (lever1.y - lever0.y));
}

/* Where impulses j act at time t on the incident body, and the normal towards A, which is incident where `sign` is 1, else -1. */
float4 contact_place(body incident, contact c, float2 j, float t, float sign)
{
	float total = j.x + j.y, part = total > 0.0f ? j.y / total : 0.0f;
	float2 from = place(incident.x, incident.v, incident.a, t), lever = push_lever(incident, c, c.inc[0], c.inc[1], part, -1.0f);
	return (float4)(from.x + lever.x, from.y + lever.y, sign * c.n.x, sign * c.n.y);
}

/* What the impulses j along the normal do to the incident body (x, y, torque) and about the reference's centre, and what friction does then: it takes
 * as much of the sliding as it can, and no more than there is. v, wa and wb are the bodies' motion from each other before. */
float4 contact_push(body a, body b, contact c, float2 v, float wa, float wb, float2 j, float friction)
{
	float total = j.x + j.y, on_b = torque_of(c, c.inc[0], c.inc[1], j), on_a = -torque_of(c, c.ref[0], c.ref[1], j);
	float4 push = (float4)(total * c.n.x, total * c.n.y, on_b, on_a);
	if (!(friction > 0.0f && total > 0.0f))
		return push;
	float2 way = (float2)(-c.n.y, c.n.x);
	float2 from_a = push_lever(a, c, c.ref[0], c.ref[1], j.y / total, 1.0f), from_b = push_lever(b, c, c.inc[0], c.inc[1], j.y / total, -1.0f);
	float arm_a = cross2(from_a, way), arm_b = cross2(from_b, way);
	float slip = (inner(way, v) + (wa + a.inverse_inertia * on_a) * cross2(way, from_a)) - (wb + b.inverse_inertia * on_b) * cross2(way, from_b);
	float gives = ((a.inverse_mass + b.inverse_mass) + a.inverse_inertia * (arm_a * arm_a)) + b.inverse_inertia * (arm_b * arm_b);
	float most = friction * total, force = larger(smaller(-slip / gives, most), -most);
	return (float4)(push.x + force * way.x, push.y + force * way.y, push.z + force * arm_b, push.w - force * arm_a);
}

/* Of body k's contact with a wall at time t of its step. */
SELDOM float4 wall_push(VERTICES_IN, float4 room, body k, int wall, float t, rules_of_hit rules, float length, impact *hit)
{
	float offset;
	body walls = k;
	walls.count = 0; /* no circle */
	float2 n = wall_normal(room, wall, &offset);
	contact c = wall_contact(VERTICES, k, n, t, wall_slop(k));
	walls.inverse_mass = walls.inverse_inertia = 0.0f;
	float micro = larger(-(rules.micro * inner(n, k.a)), 0.0f), still = wall_stillness(k);
	threshold h = threshold_of(wall_gap(VERTICES, k, n, offset, t), wall_slop(k), still, rules.part);
	float restitution = restitution_of(rules, c, micro), least = least_speed(rules, c, micro, norm(k.a), still);
	float2 j = contact_impulses(walls, k, c, restitution, h.rate, larger(least, h.mended), rules.event);
	*hit = impact_of(rules, c, norm(k.a), restitution, least, j);
	hit->where = contact_place(k, c, j, t, 1.0f);
	float2 v = (float2)(k.v.x + t * k.a.x, k.v.y + t * k.a.y);
	float4 push = contact_push(walls, k, c, v, 0.0f, k.w + t * k.b, j, rules.friction);
	return (float4)(push.x / length, push.y / length, push.z / length, 0.0f);
}

/* Of the contact of bodies a and b, the row's and the column's, at time t of their step. */
SELDOM float4 pair_push(VERTICES_IN, body a, body b, float t, rules_of_hit rules, float length, impact *hit)
{
	pose p = pose_at(a, b, t);
	float slop = pair_slop(a, b), still = pair_stillness(a, b);
	bool pieces = has_pieces(a, b);
	encounter m = pieces ? pieces_encounter(VERTICES, a, b, p, slop, still, rules.part) : encounter_of(VERTICES, a, b, p, slop, still, rules.part);
	axis k = m.k;
	contact c = m.at.c;
	threshold h = threshold_of(k.gap, slop, still, rules.part);
	float pull = rules.micro * inner(c.n, (float2)(b.a.x - a.a.x, b.a.y - a.a.y)), micro = larger(c.swapped ? pull : -pull, 0.0f);
	float push = larger(norm(a.a), norm(b.a)), restitution = restitution_of(rules, c, micro), least = least_speed(rules, c, micro, push, still),
		  parting = larger(least, h.mended);
	body ref = c.swapped ? b : a, inc = c.swapped ? a : b;
	pose seen = c.swapped ? pose_swapped(p) : p;
	float2 j = contact_impulses(ref, inc, c, restitution, h.rate, parting, rules.event);
	*hit = impact_of(rules, c, push, restitution, least, j);
	hit->where = contact_place(inc, c, j, t, c.swapped ? 1.0f : -1.0f);
	float4 done = contact_push(ref, inc, c, seen.v, seen.wa, seen.wb, j, rules.friction);
	float2 along = (float2)(done.x / length, done.y / length);
	return c.swapped ? (float4)(along.x, along.y, done.z / length, done.w / length) : (float4)(-along.x, -along.y, done.w / length, done.z / length);
}

#ifndef CAROM_OUTLINES /* first_impact alone has it */
float4 hit_push(STATE_IN, VERTICES_IN, TEX_IN(friction), float4 hit, float length, impact *done)
{
	int row = (int)CHANNEL(hit, HIT_ROW), column = (int)CHANNEL(hit, HIT_COLUMN);
	float t = CHANNEL(hit, HIT_TIME), rub = friction_of(TEX(uniforms), TEX(friction), row, max(column, -1));
	body a = body_load(STATE, row, length);
	if (column >= 0) {
		body b = body_load(STATE, column, length);
		return pair_push(VERTICES, a, b, t, first_impact_rules(larger(a.restitution, b.restitution), rub), length, done);
	}
	return wall_push(VERTICES, TEX_LOAD(uniforms, UNIFORMS_ROOM, 0), a, -1 - column, t,
		first_impact_rules(larger(a.restitution, CHANNEL(TEX_LOAD(uniforms, UNIFORMS_RULES, 0), RULES_RESTITUTION)), rub), length, done);
}

__kernel void impulse(STATE_IN, VERTICES_IN, TEX_IN(clock), TEX_IN(friction), TEX_OUT(impulse), int4 domain)
{
	(void)domain;
	if (get_global_id(0) > 0)
		return;
	float4 hit = TEX_LOAD(clock, CLOCK_HIT, 0);
	float length = CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH);
	float4 result = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	impact done = {0.0f, false, false, false, result};
	if (CHANNEL(hit, HIT_TIME) <= 1.0f && CHANNEL(hit, HIT_DONE) > 0.0f)
		result = hit_push(STATE, VERTICES, TEX(friction), hit, length, &done);
	TEX_STORE(impulse, IMPULSE_PUSH, 0, result);
	TEX_STORE(impulse, IMPULSE_WHERE, 0, done.where);
}
#endif
