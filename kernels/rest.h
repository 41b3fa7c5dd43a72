/* What bodies rest on, of the step contacts: CONTRACT.md, "contacts". */

#define FOUR(four, record) (FOUR_WIDTH * (four) + (record))
#define GRIP(four, record) (GRIP_WIDTH * (four) + (record))
#define CONTACTS_ALONE 512  /* bodies for which one group iterates alone */
#define CONTACTS_AT_ONCE 12 /* of a body, that are found with one look at its neighbours; no fewer than SHOCK_POINTS */

/* A point alone of those from a four on, in Contacts or in Grips: its number in a record, from which on each record's is 4 farther. */
#define POINT_AT(width, first, point) (4 * (width) * ((first) + (point) / 4) + (point) % 4)
#define POINT_IN(records, width, first, point) ((__global const float *)(records) + POINT_AT(width, first, point))
#define POINT_OUT(records, width, first, point) ((__global float *)(records) + POINT_AT(width, first, point))

typedef struct rest_point {
	float arm, other_arm, least, grip_arm, grip_other_arm;
} rest_point;

/* A contact, and what its points are judged by: how much the stronger push makes in a step, and how near it may come. */
typedef struct rest {
	int order; /* of a body's contacts: the partner's key, and which one it is of the two */
	int partner, count;
	float2 n;
	float force, cushion, friction;
	float rolling, rolling_arm; /* the coefficient of rolling friction, which circles may have, and its force's arm about both centres */
	rest_point points[2];
} rest;

/* How many points are written of a contact: that of a circle that has rolling friction twice. */
int rest_lanes(const rest *r)
{
	return r->count == 1 && r->rolling > 0.0f ? 2 : r->count;
}

/* The contacts of one slot, while they are found: the first ones, in their order, after one. */
typedef struct rests {
	int after;  /* as in rest */
	int count;  /* of those here */
	int points; /* of all, or more, if they are counted */
	bool left;  /* there may be more than there is room for */
	bool counts;
	rest of[CONTACTS_AT_ONCE];
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

/* Contact `part` with the partner of that key. */
int order_of(int key, int part)
{
	return PAIR_RESTS * key + part;
}

rest rest_begin(int order, int partner, float2 n, float force, float slop, float friction)
{
	rest r;
	r.order = order;
	r.partner = partner;
	r.count = 0;
	r.n = n;
	r.force = force;
	r.cushion = smaller(CUSHION * slop, 0.5f * force);
	r.friction = friction;
	r.rolling = r.rolling_arm = 0.0f;
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

void rests_begin(rests *all, int after, bool counts)
{
	all->after = after;
	all->counts = counts;
	all->count = all->points = 0;
	all->left = false;
}

/* Is it known of contacts with that key that they are none of these? */
bool rests_are_others(rests *all, int key)
{
	bool beyond = all->count == CONTACTS_AT_ONCE && order_of(key, 0) > all->of[CONTACTS_AT_ONCE - 1].order;
	all->left = all->left || beyond;
	return order_of(key, PAIR_RESTS - 1) <= all->after || (beyond && !all->counts);
}

/* Where its order says, but once: a neighbour may be noted twice. */
void rests_insert(rests *all, rest r)
{
	if (r.count == 0 || r.order <= all->after)
		return;
	for (int k = 0; k < all->count; k++)
		if (all->of[k].order == r.order)
			return;
	bool full = all->count == CONTACTS_AT_ONCE;
	all->points += rest_lanes(&r);
	all->left = all->left || full;
	if (full && r.order > all->of[CONTACTS_AT_ONCE - 1].order)
		return;
	int k = full ? CONTACTS_AT_ONCE - 1 : all->count++;
	for (; k > 0 && all->of[k - 1].order > r.order; k--)
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

/* The contact `part` of the body in slot s with another. */
rest rest_of(TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), int s, body own, int other, body partner, nearness near, float force, float slop,
	float rub, const grounding *at, int part)
{
	int key = slot_body(slots, other);
	bool is_row = slot_body(slots, s) > key;
	contact c = at->c;
	bool is_incident = is_row == c.swapped;
	float2 n = is_incident ? c.n : (float2)(-c.n.x, -c.n.y);
	float2 back = (float2)(-n.x, -n.y);
	rest r = rest_begin(order_of(key, part), slot_is_static(slots, other) ? PARTNER_STATIC(key) : other, n, force, slop, rub);
	for (int j = 0; j < c.count; j++) {
		int i = c.swapped ? c.count - 1 - j : j; /* whichever is the reference, in the same order */
		float2 lever = is_incident ? c.inc[i] : c.ref[i], other_lever = is_incident ? c.ref[i] : c.inc[i];
		rest_add(&r, near.fast, c.rate[i], at->gap[i], lever, other_lever, touch_lever(own, lever, back), touch_lever(partner, other_lever, n));
	}
	if (own.count == 1 || partner.count == 1) {
		float radius = partner.count > 1 ? own.radius : own.count > 1 ? partner.radius : smaller(own.radius, partner.radius);
		r.rolling = rolling_of(TEX(uniforms), TEX(friction), slot_body(slots, s), key);
		r.rolling_arm = is_row ? radius : -radius;
	}
	return r;
}

/* Of the body in slot s on another, as they are now. */
void rest_on_body(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), int s, body own, int other, body partner, nearness near,
	rests *all)
{
	int key = slot_body(slots, other);
	float force = near_force(own, partner, near);
	if (!(force > 0.0f) || rests_are_others(all, key))
		return;
	float rub = friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), key);
	if (!is_lossy(larger(own.restitution, partner.restitution), rub))
		return;
	bool is_row = slot_body(slots, s) > key;
	body a = is_row ? own : partner, b = is_row ? partner : own;
	pose p = pose_at(a, b, 0.0f);
	float slop = pair_slop(a, b);
	grounding at[PAIR_RESTS];
	int count = has_pieces(a, b) ? pieces_find(VERTICES, a, b, p, force, slop, at) : grounding_find(VERTICES, a, b, p, force, slop, at) ? 1 : 0;
	for (int part = 0; part < count; part++)
		rests_insert(all, rest_of(TEX(uniforms), TEX(friction), slots, s, own, other, partner, near, force, slop, rub, &at[part], part));
}

void rest_on_wall(VERTICES_IN, float4 room, body k, int wall, float friction, float rolling, nearness near, rests *all)
{
	float offset, force = rest_force(near.weight > 0.0f ? near.weight : norm(k.a), k.radius);
	float2 n = wall_normal(room, wall, &offset), none = (float2)(0.0f, 0.0f);
	float height = inner(n, k.x) - offset, speed = inner(n, k.v);
	rest r = rest_begin(order_of(-1 - wall, 0), PARTNER_WALL(wall), n, force, wall_slop(k), friction);
	if (k.count == 1) {
		r.rolling = rolling;
		r.rolling_arm = k.radius;
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

/* Is a point, from that one on, of the same contact as the one before it? */
bool is_second(RECORD_IN(contacts), int first, int point, int from)
{
	__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, point), *before = POINT_IN(contacts, FOUR_WIDTH, first, max(point - 1, 0));
	return point > from && at[4 * FOUR_PARTNER] == before[4 * FOUR_PARTNER] && at[4 * FOUR_NORMAL_X] == before[4 * FOUR_NORMAL_X]
		&& at[4 * FOUR_NORMAL_Y] == before[4 * FOUR_NORMAL_Y];
}

/* A point that pushes nothing. */
void point_drop(RECORD_OUT(contacts), RECORD_OUT(grips), int first, int point, bool rub)
{
	__global float *at = POINT_OUT(contacts, FOUR_WIDTH, first, point);
	for (int record = 0; record < FOUR_WIDTH; record++)
		at[4 * record] = record == FOUR_PARTNER ? (float)PARTNER_NONE : 0.0f;
	for (int record = 0; rub && record < GRIP_WIDTH; record++)
		POINT_OUT(grips, GRIP_WIDTH, first, point)[4 * record] = 0.0f;
}

/* Writes the points side by side, behind so many others, and how they slide where bodies rub; how many there are then. */
int rests_write(const rests *all, RECORD_OUT(contacts), RECORD_OUT(grips), int first, int count, bool rub)
{
	for (int k = 0; k < all->count; k++) {
		const rest *r = &all->of[k];
		int lanes = rest_lanes(r);
		for (int i = 0; i < lanes; i++, count++) {
			__global float *to = POINT_OUT(contacts, FOUR_WIDTH, first, count);
			bool rolls = i == r->count;
			rest_point at = r->points[rolls ? 0 : i];
			point_drop(contacts, grips, first, count, rub);
			to[4 * FOUR_PARTNER] = (float)r->partner;
			to[4 * FOUR_NORMAL_X] = r->n.x;
			to[4 * FOUR_NORMAL_Y] = r->n.y;
			to[4 * FOUR_ARM] = at.arm;
			to[4 * FOUR_OTHER_ARM] = at.other_arm;
			to[4 * FOUR_LEAST] = at.least;
			to[4 * FOUR_TOLERANCE] = CONTACT_PART * (EASE * r->cushion);
			if (!rub)
				continue;
			to = POINT_OUT(grips, GRIP_WIDTH, first, count);
			to[4 * GRIP_FRICTION] = (rolls ? r->rolling : r->friction) * (lanes > r->count ? 2.0f : 1.0f);
			to[4 * GRIP_ARM] = rolls ? r->rolling_arm : at.grip_arm;
			to[4 * GRIP_OTHER_ARM] = rolls ? r->rolling_arm : at.grip_other_arm;
			to[4 * GRIP_ALONG] = rolls ? 0.0f : 1.0f;
		}
	}
	for (int point = count; point % 4 > 0; point++)
		point_drop(contacts, grips, first, point, rub);
	return count;
}

/* Sees to it that a slot has room for so many points: what it has, or more. False: there is none. */
bool fours_take(LIST_OUT(status), LIST_OUT(touching), int s, int points)
{
	int fours = (points + 3) / 4;
	bool any = touching[TOUCH(s, TOUCHING_MADE)] == status[STATUS_MADE];
	if (fours == 0 || (any && fours <= touching[TOUCH(s, TOUCHING_ROOM)]))
		return true;
	int room = any ? fours + fours / 2 : fours; /* of what grows, little is left behind */
	int first = atomic_add(&status[STATUS_FOURS], room);
	if (first > status[STATUS_FOURS_ROOM] - room) {
		atomic_or(&status[STATUS_SMALL], 1);
		return false;
	}
	touching[TOUCH(s, TOUCHING_FIRST)] = first;
	touching[TOUCH(s, TOUCHING_ROOM)] = room;
	touching[TOUCH(s, TOUCHING_MADE)] = status[STATUS_MADE];
	return true;
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
	float roll = rolling_of(TEX(uniforms), TEX(friction), slot_body(slots, s), -1);
	for (int wall = 0; wall < 4; wall++)
		rest_on_wall(VERTICES, room, k, wall, rub, roll, near, all);
}

/* What an awake body touches is disturbed in its sleep. */
void rests_disturb(const rests *all, LIST_OUT(touching), LIST_IN(islands))
{
	for (int k = 0; k < all->count; k++)
		if (all->of[k].partner >= 0 && touching[TOUCH(all->of[k].partner, TOUCHING_ASLEEP)])
			island_disturb(touching, islands, all->of[k].partner);
}

/* How many points the body in a slot has: so many of joints, which are to be written yet, and where it rests. If it is awake, all that it touches is disturbed in its sleep; what is kinematic, and finds no contacts, disturbs what is near. */
int rests_find(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_IN(pushes), LIST_OUT(touching), LIST_IN(islands),
	RECORD_OUT(contacts), RECORD_OUT(grips), int s, int joined, float length)
{
	rests all;
	nearness near = {0.0f, CONTACT_FAST};
	int count = joined, after = INT_MIN;
	if (slot_is_static(slots, s))
		return 0;
	bool awake = !touching[TOUCH(s, TOUCHING_ASLEEP)], dynamic = slot_is_dynamic(slots, s);
	body k = body_awake(slots, touching, pushes, s, length);
	do {
		rests_begin(&all, after, after == INT_MIN);
		if (dynamic)
			rest_on_walls(VERTICES, TEX(uniforms), TEX(friction), slots, s, k, near, &all);
		int end = spans[SPAN(s, SPAN_END)];
		for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i)) {
			int other = neighbour_of(neighbours, extra, i);
			body partner = body_awake(slots, touching, pushes, other, length);
			if (!dynamic && touching[TOUCH(other, TOUCHING_ASLEEP)] && near_force(k, partner, near) > 0.0f)
				island_disturb(touching, islands, other);
			if (dynamic)
				rest_on_body(VERTICES, TEX(uniforms), TEX(friction), slots, s, k, other, partner, near, &all);
		}
		if (awake)
			rests_disturb(&all, touching, islands);
		if (all.counts && !fours_take(status, touching, s, joined + all.points))
			return 0;
		count = rests_write(&all, contacts, grips, touching[TOUCH(s, TOUCHING_FIRST)], count, anything_rubs(TEX(uniforms)));
		after = all.count > 0 ? all.of[all.count - 1].order : after;
	} while (all.left);
	return count;
}
