/* What bodies rest on, of the step contacts: CONTRACT.md, "contacts". */

#define FOUR(s, four, record) (FOUR_WIDTH * (FOURS_MOST * (s) + (four)) + (record))
#define GRIP(s, four, record) (GRIP_WIDTH * (FOURS_MOST * (s) + (four)) + (record))
#define WARM(body, k, rub) ((CONTACTS_MOST * (body) + (k)) * WARM_WIDTH(rub))
#define CONTACTS_ALONE 512 /* bodies for which one group iterates alone */

/* A point alone, in Contacts or in Grips: its number in a record, from which on each record's is 4 farther. */
#define POINT_AT(width, s, point) (4 * (width) * (FOURS_MOST * (s) + (point) / 4) + (point) % 4)
#define POINT_IN(records, width, s, point) ((__global const float *)(records) + POINT_AT(width, s, point))
#define POINT_OUT(records, width, s, point) ((__global float *)(records) + POINT_AT(width, s, point))

typedef struct rest_point {
	float arm, other_arm, least, grip_arm, grip_other_arm;
} rest_point;

/* A contact, and what its points are judged by: how much the stronger push makes in a step, and how near it may come. */
typedef struct rest {
	int key, partner, count;
	float2 n;
	float force, cushion, friction;
	rest_point points[2];
} rest;

/* The contacts of one slot, while they are found. */
typedef struct rests {
	int count;
	rest of[CONTACTS_MOST];
} rests;

/* Who a partner is: its index, or -1 - wall. */
int partner_key(RECORD_IN(slots), int partner)
{
	if (partner >= 0)
		return slot_body(slots, partner);
	return partner > PARTNER_STATIC(0) ? partner + 1 : PARTNER_STATIC(0) - partner;
}

/* How far a push moves a body in a step, but no farther than what is small beside the smaller body: of more than that nobody says that it is near. */
float rest_force(float push, float radius)
{
	return smaller(push, CONTACT_NEAR * radius);
}

rest rest_begin(int key, int partner, float2 n, float force, float slop, float friction)
{
	rest r;
	r.key = key;
	r.partner = partner;
	r.count = 0;
	r.n = n;
	r.force = force;
	r.cushion = smaller(CUSHION * slop, 0.5f * force);
	r.friction = friction;
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

/* A point, if it does not come too fast: where the body presses, and where it slides. */
void rest_add(rest *r, float fast, float rate, float gap, float2 lever, float2 other_lever, float2 touch, float2 other_touch)
{
	rest_point *to = &r->points[r->count];
	float2 way = aside(r->n);
	if (rate < -(fast * r->force))
		return;
	to->arm = cross2(lever, r->n);
	to->other_arm = cross2(other_lever, r->n);
	to->least = larger(gap, 0.0f) - 0.5f * r->cushion;
	to->grip_arm = cross2(touch, way);
	to->grip_other_arm = cross2(other_touch, way);
	r->count++;
}

/* What counts as near, and as too fast to rest. */
typedef struct nearness {
	float weight; /* what pushes all; 0: each what pushes it */
	float fast;   /* so much of that */
} nearness;

/* Where its key says, but once: a neighbour may be noted twice. The count is more than CONTACTS_MOST once there are too many. */
void rests_insert(rests *all, rest r)
{
	if (r.count == 0 || all->count > CONTACTS_MOST)
		return;
	for (int k = 0; k < all->count; k++)
		if (all->of[k].key == r.key)
			return;
	int k = all->count++;
	if (k == CONTACTS_MOST)
		return;
	for (; k > 0 && all->of[k - 1].key > r.key; k--)
		all->of[k] = all->of[k - 1];
	all->of[k] = r;
}

/* What the stronger push makes in a step; 0 where the bodies are farther from each other than that. */
float near_force(body own, body partner, nearness near)
{
	float push = near.weight > 0.0f ? near.weight : larger(norm(own.a), norm(partner.a));
	float force = rest_force(push, smaller(own.radius, partner.radius));
	float2 d = (float2)(partner.x.x - own.x.x, partner.x.y - own.x.y);
	return norm(d) - (own.radius + partner.radius) > force ? 0.0f : force;
}

/* Of the body in slot s on another, as they are now. */
void rest_on_body(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), int s, body own, int other, body partner, nearness near,
	rests *all)
{
	float force = near_force(own, partner, near);
	if (!(force > 0.0f))
		return;
	int key = slot_body(slots, other);
	float rub = friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), key);
	if (!is_lossy(larger(own.restitution, partner.restitution), rub))
		return;
	bool is_row = slot_body(slots, s) > key;
	body a = is_row ? own : partner, b = is_row ? partner : own;
	pose p = pose_at(a, b, 0.0f);
	axis k = best_axis(VERTICES, a, b, p);
	float slop = pair_slop(a, b);
	if (k.gap > force || k.gap < -(SUNK_MOST * slop))
		return;
	contact c = contact_at(VERTICES, a, b, p, k, force - k.gap);
	axis way = corner_way(VERTICES, a, b, p, k, c, slop);
	if (!axes_are_same(way, k)) {
		k = way;
		c = contact_at(VERTICES, a, b, p, k, force - k.gap);
	}
	bool is_incident = is_row == c.swapped;
	float2 n = is_incident ? c.n : (float2)(-c.n.x, -c.n.y);
	float2 back = (float2)(-n.x, -n.y);
	rest r = rest_begin(key, slot_is_static(slots, other) ? PARTNER_STATIC(key) : other, n, force, slop, rub);
	for (int j = 0; j < c.count; j++) {
		int i = c.swapped ? c.count - 1 - j : j; /* whichever is the reference, in the same order */
		float gap = c.count > 1 ? inner(c.n, c.ref[i]) - k.offset : k.gap;
		float2 lever = is_incident ? c.inc[i] : c.ref[i], other_lever = is_incident ? c.ref[i] : c.inc[i];
		rest_add(&r, near.fast, c.rate[i], gap, lever, other_lever, touch_lever(own, lever, back), touch_lever(partner, other_lever, n));
	}
	rests_insert(all, r);
}

void rest_on_wall(VERTICES_IN, float4 room, body k, int wall, float friction, nearness near, rests *all)
{
	float offset, force = rest_force(near.weight > 0.0f ? near.weight : norm(k.a), k.radius);
	float2 n = wall_normal(room, wall, &offset), none = (float2)(0.0f, 0.0f);
	float height = inner(n, k.x) - offset, speed = inner(n, k.v);
	rest r = rest_begin(-1 - wall, PARTNER_WALL(wall), n, force, wall_slop(k), friction);
	if (k.count == 1) {
		if (height - k.radius <= force)
			rest_add(&r, near.fast, speed, height - k.radius, none, none, touch_lever(k, none, (float2)(-n.x, -n.y)), none);
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
				rest_add(&r, near.fast, speed - k.w * cross2(n, lever), gap, lever, none, lever, none);
		}
	}
	rests_insert(all, r);
}

/* A point that pushes nothing. */
void point_drop(RECORD_OUT(contacts), RECORD_OUT(grips), int s, int point, bool rub)
{
	__global float *at = POINT_OUT(contacts, FOUR_WIDTH, s, point);
	for (int record = 0; record < FOUR_WIDTH; record++)
		at[4 * record] = record == FOUR_PARTNER ? (float)PARTNER_NONE : 0.0f;
	for (int record = 0; rub && record < GRIP_WIDTH; record++)
		POINT_OUT(grips, GRIP_WIDTH, s, point)[4 * record] = 0.0f;
}

/* Writes the points side by side, and how they slide where bodies rub; how many there are. */
int rests_write(const rests *all, RECORD_OUT(contacts), RECORD_OUT(grips), int s, bool rub)
{
	int count = 0;
	for (int k = 0; k < all->count; k++) {
		const rest *r = &all->of[k];
		for (int i = 0; i < r->count; i++, count++) {
			__global float *to = POINT_OUT(contacts, FOUR_WIDTH, s, count);
			point_drop(contacts, grips, s, count, rub);
			to[4 * FOUR_PARTNER] = (float)r->partner;
			to[4 * FOUR_NORMAL_X] = r->n.x;
			to[4 * FOUR_NORMAL_Y] = r->n.y;
			to[4 * FOUR_ARM] = r->points[i].arm;
			to[4 * FOUR_OTHER_ARM] = r->points[i].other_arm;
			to[4 * FOUR_LEAST] = r->points[i].least;
			to[4 * FOUR_TOLERANCE] = CONTACT_PART * (EASE * r->cushion);
			if (!rub)
				continue;
			to = POINT_OUT(grips, GRIP_WIDTH, s, count);
			to[4 * GRIP_FRICTION] = r->friction;
			to[4 * GRIP_ARM] = r->points[i].grip_arm;
			to[4 * GRIP_OTHER_ARM] = r->points[i].grip_other_arm;
		}
	}
	for (int point = count; point % 4 > 0; point++)
		point_drop(contacts, grips, s, point, rub);
	return count;
}

/* Of the body k in slot s on the room's walls. */
void rest_on_walls(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), int s, body k, nearness near, rests *all)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0), room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0);
	if (!(CHANNEL(rules, RULES_HAS_ROOM) > 0.0f) || !(near.weight > 0.0f || norm(k.a) > 0.0f))
		return;
	float rub = friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), -1);
	if (!is_lossy(larger(k.restitution, CHANNEL(rules, RULES_RESTITUTION)), rub))
		return;
	for (int wall = 0; wall < 4; wall++)
		rest_on_wall(VERTICES, room, k, wall, rub, near, all);
}

/* How many points the body in a slot rests on; -1: it has too many contacts. If it is awake, all that sleep near it are disturbed. */
int rests_find(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_IN(pushes), LIST_OUT(touching), LIST_IN(islands),
	RECORD_OUT(contacts), RECORD_OUT(grips), int s, float length)
{
	rests all;
	nearness near = {0.0f, CONTACT_FAST};
	all.count = 0;
	if (slot_is_static(slots, s))
		return 0;
	bool awake = !touching[TOUCH(s, TOUCHING_ASLEEP)], dynamic = slot_is_dynamic(slots, s);
	body k = body_awake(slots, touching, pushes, s, length);
	if (dynamic)
		rest_on_walls(VERTICES, TEX(uniforms), TEX(friction), slots, s, k, near, &all);
	int end = spans[SPAN(s, SPAN_END)];
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i)) {
		int other = neighbour_of(neighbours, extra, i);
		body partner = body_awake(slots, touching, pushes, other, length);
		if (awake && touching[TOUCH(other, TOUCHING_ASLEEP)] && (!dynamic || near_force(k, partner, near) > 0.0f))
			island_disturb(touching, islands, other);
		if (dynamic)
			rest_on_body(VERTICES, TEX(uniforms), TEX(friction), slots, s, k, other, partner, near, &all);
	}
	return all.count > CONTACTS_MOST ? -1 : rests_write(&all, contacts, grips, s, anything_rubs(TEX(uniforms)));
}
