/* What bodies rest on, of the step contacts: CONTRACT.md, "contacts". */

#define CONTACT(s, k, record) (CONTACT_WIDTH * (CONTACTS_MOST * (s) + (k)) + (record))
#define TOUCH(s, field) (TOUCHING_WIDTH * (s) + (field))
#define WARM(body, k, rub) ((CONTACTS_MOST * (body) + (k)) * WARM_WIDTH(rub))
#define GRIP(s, k, record) (GRIP_WIDTH * (CONTACTS_MOST * (s) + (k)) + (record))
#define CONTACTS_ALONE 512 /* bodies for which one group iterates alone */

/* The contacts of one slot, while they are found. */
typedef struct rests {
	int count, keys[CONTACTS_MOST];
	bool rub; /* something does, somewhere */
} rests;

/* A contact, and what its points are judged by: how much the stronger push makes in a step, and how near it may come. */
typedef struct rest {
	float4 pair, points[2], grips[2];
	float force, cushion, friction;
} rest;

rest rest_begin(int partner, float2 n, float force, float slop, float friction)
{
	rest r;
	r.friction = friction;
	r.grips[0] = r.grips[1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	r.pair = (float4)((float)partner, 0.0f, n.x, n.y);
	r.points[0] = r.points[1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	r.force = force;
	r.cushion = smaller(CUSHION * slop, 0.5f * force);
	return r;
}

/* Along a contact: the normal turned by a quarter. */
float2 aside(float2 n)
{
	return (float2)(-n.y, n.x);
}

/* From a body's centre to where another one touches it, if contacts have `lever`, which is 0 for circles; n is away from it. */
float2 touch_lever(body k, float2 lever, float2 n)
{
	return k.count == 1 ? (float2)(k.radius * n.x, k.radius * n.y) : lever;
}

/* Where the body slides at a point, as a record of Grips. */
float4 grip_of(float2 n, float2 lever, float2 other_lever)
{
	float2 way = aside(n);
	return (float4)(cross2(lever, way), cross2(other_lever, way), 0.0f, 0.0f);
}

/* A point, if it does not come too fast. */
void rest_add(rest *r, float rate, float gap, float arm, float other_arm, float4 grip)
{
	if (rate < -(CONTACT_FAST * r->force))
		return;
	r->points[(int)CHANNEL(r->pair, PAIR_POINTS)] = (float4)(arm, other_arm, larger(gap, 0.0f) - 0.5f * r->cushion, 0.0f);
	r->grips[(int)CHANNEL(r->pair, PAIR_POINTS)] = grip;
	CHANNEL(r->pair, PAIR_POINTS) += 1.0f;
}

/* Where its key says; the count is more than CONTACTS_MOST once there are too many. Grips only where there is friction at all. */
void rests_insert(rests *all, RECORD_OUT(contacts), RECORD_OUT(grips), int s, rest r, int key)
{
	if (!(CHANNEL(r.pair, PAIR_POINTS) > 0.0f) || all->count > CONTACTS_MOST)
		return;
	int k = all->count++;
	if (k == CONTACTS_MOST)
		return;
	for (; k > 0 && all->keys[k - 1] > key; k--) {
		all->keys[k] = all->keys[k - 1];
		for (int i = 0; i < CONTACT_WIDTH; i++)
			contacts[CONTACT(s, k, i)] = contacts[CONTACT(s, k - 1, i)];
		for (int i = 0; all->rub && i < GRIP_WIDTH; i++)
			grips[GRIP(s, k, i)] = grips[GRIP(s, k - 1, i)];
	}
	all->keys[k] = key;
	contacts[CONTACT(s, k, CONTACT_PAIR)] = r.pair;
	contacts[CONTACT(s, k, CONTACT_POINT)] = r.points[0];
	contacts[CONTACT(s, k, CONTACT_POINT + 1)] = r.points[1];
	contacts[CONTACT(s, k, CONTACT_START)] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	contacts[CONTACT(s, k, CONTACT_STEPS)] = (float4)(0.0f, 0.0f, CONTACT_PART * (EASE * r.cushion), 0.0f);
	if (!all->rub)
		return;
	grips[GRIP(s, k, GRIP_POINT)] = r.grips[0];
	grips[GRIP(s, k, GRIP_POINT + 1)] = r.grips[1];
	grips[GRIP(s, k, GRIP_STARTS)] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	grips[GRIP(s, k, GRIP_BOUNDS)] = (float4)(r.friction, 0.0f, 0.0f, 0.0f);
}

void rest_on_body(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), int s, int other,
	float length, rests *all)
{
	body own = body_of(slots, s, trajectory_start(slots, s), length), partner = body_of(slots, other, trajectory_start(slots, other), length);
	float force = larger(norm(own.a), norm(partner.a));
	float2 d = (float2)(partner.x.x - own.x.x, partner.x.y - own.x.y);
	if (!(larger(own.restitution, partner.restitution) < 1.0f) || !(force > 0.0f) || norm(d) - (own.radius + partner.radius) > force)
		return;
	int key = slot_body(slots, other);
	bool is_row = slot_body(slots, s) > key;
	body a = is_row ? own : partner, b = is_row ? partner : own;
	pose p = pose_at(a, b, 0.0f);
	axis k = best_axis(VERTICES, a, b, p);
	float slop = pair_slop(a, b);
	if (k.gap > force || k.gap < -(SUNK_MOST * slop))
		return;
	contact c = contact_at(VERTICES, a, b, p, k, force - k.gap);
	bool is_incident = is_row == c.swapped;
	float2 n = is_incident ? c.n : (float2)(-c.n.x, -c.n.y);
	rest r = rest_begin(other, n, force, slop, friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), key));
	float2 back = (float2)(-n.x, -n.y);
	for (int j = 0; j < c.count; j++) {
		int i = c.swapped ? c.count - 1 - j : j; /* whichever is the reference, in the same order */
		float gap = c.count > 1 ? inner(c.n, c.ref[i]) - k.offset : k.gap;
		float ref = cross2(c.ref[i], n), inc = cross2(c.inc[i], n);
		float2 lever = touch_lever(own, is_incident ? c.inc[i] : c.ref[i], back),
			   other_lever = touch_lever(partner, is_incident ? c.ref[i] : c.inc[i], n);
		rest_add(&r, c.rate[i], gap, is_incident ? inc : ref, is_incident ? ref : inc, grip_of(n, lever, other_lever));
	}
	rests_insert(all, contacts, grips, s, r, key);
}

void rest_on_wall(VERTICES_IN, float4 room, RECORD_OUT(contacts), RECORD_OUT(grips), body k, int s, int wall, float friction, rests *all)
{
	float offset, force = norm(k.a);
	float2 n = wall_normal(room, wall, &offset), none = (float2)(0.0f, 0.0f);
	float height = inner(n, k.x) - offset, speed = inner(n, k.v);
	rest r = rest_begin(-1 - wall, n, force, wall_slop(k), friction);
	if (k.count == 1) {
		if (height - k.radius <= force)
			rest_add(&r, speed, height - k.radius, 0.0f, 0.0f, grip_of(n, touch_lever(k, none, (float2)(-n.x, -n.y)), none));
	} else {
		float2 rotation = body_rotation(k, 0.0f), m = turn_back(rotation, n);
		int deepest;
		lowest(VERTICES, k, m, &deepest);
		float2 low = vertex_load(VERTICES, k.first, deepest);
		float2 before = vertex_load(VERTICES, k.first, deepest > 0 ? deepest - 1 : k.count - 1);
		float2 after = vertex_load(VERTICES, k.first, deepest + 1 < k.count ? deepest + 1 : 0);
		bool with_after = inner(m, after) < inner(m, before);
		float2 ends[2] = {with_after ? low : before, with_after ? after : low};
		for (int i = 0; i < 2; i++) {
			float gap = height + inner(m, ends[i]);
			float2 lever = turn(rotation, ends[i]);
			if (gap <= force)
				rest_add(&r, speed - k.w * cross2(n, lever), gap, cross2(lever, n), 0.0f, grip_of(n, lever, none));
		}
	}
	rests_insert(all, contacts, grips, s, r, -1 - wall);
}

/* How many contacts the body in a slot has; -1: too many. */
int rests_find(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(contacts), RECORD_OUT(grips), int s,
	float length)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0), room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0);
	rests all;
	all.count = 0;
	all.rub = anything_rubs(TEX(uniforms));
	if (slot_is_static(slots, s))
		return 0;
	body k = body_of(slots, s, trajectory_start(slots, s), length);
	bool by_walls = CHANNEL(rules, RULES_HAS_ROOM) > 0.0f && larger(k.restitution, CHANNEL(rules, RULES_RESTITUTION)) < 1.0f && norm(k.a) > 0.0f;
	float rub = by_walls ? friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), -1) : 0.0f;
	for (int wall = 0; by_walls && wall < 4; wall++)
		rest_on_wall(VERTICES, room, contacts, grips, k, s, wall, rub, &all);
	int end = spans[SPAN(s, SPAN_END)];
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i))
		rest_on_body(VERTICES, TEX(uniforms), TEX(friction), slots, contacts, grips, s, neighbour_of(neighbours, extra, i), length, &all);
	return all.count > CONTACTS_MOST ? -1 : all.count;
}
