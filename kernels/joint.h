/* What joints hold, as points of Contacts that pull as well as push: CONTRACT.md, "contacts", Joints. */

#define JOINT(joint, record) (JOINT_WIDTH * (joint) + (record))

/* A body's first joint, as a side (see Joined), -1 for none; and the same body's next one. */
int first_side(LIST_IN(joined), int body)
{
	return joined[JOINED_COUNT] > 0 ? joined[JOINED_FIRST + body] : -1;
}

int next_side(LIST_IN(joined), int side)
{
	return joined[JOINED_NEXT(joined[JOINED_BODIES], side)];
}

/* The first of those that have points; -1 for none. */
int held_side(RECORD_IN(slots), LIST_IN(touching), LIST_IN(joined), int s)
{
	return first_contact(touching, s) > 0 ? first_side(joined, slot_body(slots, s)) : -1;
}

bool joint_is_pin(RECORD_IN(joints), int side)
{
	return CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH) < 0.0f;
}

int joint_points(RECORD_IN(joints), int side)
{
	return joint_is_pin(joints, side) ? 2 : 1;
}

/* The body at a side's other end, -1: a place in the world. */
int joint_partner(RECORD_IN(joints), int side)
{
	float4 parties = joints[JOINT(side / 2, JOINT_PARTIES)];
	return (int)(side & 1 ? CHANNEL(parties, JOINT_BODY) : CHANNEL(parties, JOINT_OTHER));
}

float2 joint_anchor(RECORD_IN(joints), int side)
{
	float4 anchors = joints[JOINT(side / 2, JOINT_ANCHORS)];
	return side & 1 ? anchors.zw : anchors.xy;
}

/* How many points joints of the body in a slot have: none of what is not dynamic. If it is awake, all that it is joined with is disturbed in its sleep. */
int joined_find(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), LIST_OUT(touching), LIST_IN(islands), int s)
{
	int points = 0;
	bool awake = !touching[TOUCH(s, TOUCHING_ASLEEP)];
	if (joined[JOINED_COUNT] == 0 || slot_is_static(slots, s))
		return 0;
	for (int side = first_side(joined, slot_body(slots, s)); side >= 0; side = next_side(joined, side)) {
		int partner = joint_partner(joints, side);
		points += joint_points(joints, side);
		if (awake && partner >= 0 && touching[TOUCH(places[partner], TOUCHING_ASLEEP)])
			island_disturb(touching, islands, places[partner]);
	}
	return slot_is_dynamic(slots, s) ? points : 0;
}

/* What is held at a side: where it is, and how it gets to the end of a way; a place in the world stays. */
typedef struct held {
	float2 x, way, lever, last_lever;
	float turned, radius, inverse_mass, inverse_inertia;
} held;

held held_place(float2 place)
{
	held h;
	h.x = place;
	h.way = h.lever = h.last_lever = (float2)(0.0f, 0.0f);
	h.turned = h.radius = h.inverse_mass = h.inverse_inertia = 0.0f;
	return h;
}

held held_body(RECORD_IN(slots), int s, float2 anchor)
{
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), turns = SLOT_LOAD(slots, s, SLOT_TURN), mass = SLOT_LOAD(slots, s, SLOT_MASS);
	held h = held_place((float2)(CHANNEL(at, LINEAR_X), CHANNEL(at, LINEAR_Y)));
	h.lever = h.last_lever = turn(rotation_of(CHANNEL(turns, TURN_ANGLE)), anchor);
	h.radius = CHANNEL(turns, TURN_RADIUS);
	h.inverse_mass = CHANNEL(mass, MASS_INVERSE);
	h.inverse_inertia = CHANNEL(mass, MASS_INVERSE_INERTIA);
	return h;
}

/* How far a body gets along an axis in a step: as it moves now, or by what forces make of that. */
float held_way(float velocity, float length, float load, bool by_velocity)
{
	return by_velocity ? velocity * length : 0.5f * (velocity * length + load);
}

held held_moving(RECORD_IN(slots), RECORD_IN(loads), int s, float2 anchor, int now, float length, bool by_velocity)
{
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), turns = SLOT_LOAD(slots, s, SLOT_TURN), load = loads[LOADS_OF(s) + now];
	held h = held_body(slots, s, anchor);
	h.way = (float2)(held_way(CHANNEL(at, LINEAR_VX), length, load.x, by_velocity), held_way(CHANNEL(at, LINEAR_VY), length, load.y, by_velocity));
	h.turned = smaller(larger(held_way(CHANNEL(turns, TURN_VELOCITY), length, load.z, by_velocity), -JOINT_TURN), JOINT_TURN);
	h.last_lever = turn(rotation_of(CHANNEL(turns, TURN_ANGLE) + h.turned), anchor);
	return h;
}

/* So that it times the angle is what the anchor gets along n; or as it is in the end. */
float held_arm(held h, float2 n, bool at_end)
{
	if (at_end)
		return cross2(h.last_lever, n);
	float2 middle = (float2)(0.5f * (h.lever.x + h.last_lever.x), 0.5f * (h.lever.y + h.last_lever.y));
	return cross2(middle, n) * (1.0f + (h.turned * h.turned) * (1.0f / 12.0f));
}

/* How much a force at the anchor turns it. */
float held_gives(held h)
{
	return larger(magnitude(h.lever.x), magnitude(h.lever.y)) * h.inverse_inertia;
}

/* How a joint's points hold the body of a side, seen from the other: along n, by so much. */
typedef struct hold {
	float2 n[2];
	float target[2];
} hold;

hold hold_of(RECORD_IN(joints), int side, held own, held other, bool at_end)
{
	hold h;
	float sign = side & 1 ? -1.0f : 1.0f;
	float2 first = (float2)((own.x.x - other.x.x) + (own.lever.x - other.lever.x), (own.x.y - other.x.y) + (own.lever.y - other.lever.y));
	float2 gone = (float2)((own.way.x - other.way.x) + ((own.last_lever.x - own.lever.x) - (other.last_lever.x - other.lever.x)),
		(own.way.y - other.way.y) + ((own.last_lever.y - own.lever.y) - (other.last_lever.y - other.lever.y)));
	if (joint_is_pin(joints, side)) {
		h.n[0] = (float2)(sign, 0.0f);
		h.n[1] = (float2)(0.0f, sign);
		h.target[0] = -inner(h.n[0], first);
		h.target[1] = -inner(h.n[1], first);
		return h;
	}
	float2 last = (float2)(first.x + gone.x, first.y + gone.y), twice = at_end ? last : (float2)(first.x + last.x, first.y + last.y);
	float length = CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH), distance = norm(first), size = norm(twice);
	h.n[0] = size > 0.0f ? (float2)(twice.x / size, twice.y / size) : (float2)(sign, 0.0f);
	h.n[1] = (float2)(0.0f, 0.0f);
	h.target[0] = at_end ? length - distance : (length - distance) * ((length + distance) / larger(size, length));
	h.target[1] = 0.0f;
	return h;
}

/* What is at a side's other end, as it is. */
held held_other(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), int side)
{
	int partner = joint_partner(joints, side);
	float2 anchor = joint_anchor(joints, side ^ 1);
	return partner < 0 ? held_place(anchor) : held_body(slots, places[partner], anchor);
}

/* So many points of a slot's joints, as the step begins. */
void joined_write(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), LIST_OUT(touching), RECORD_OUT(contacts), RECORD_OUT(grips),
	int s, int points, bool rub)
{
	int point = 0, first = first_four(touching, s);
	touching[TOUCH(s, TOUCHING_JOINED)] = points;
	for (int side = held_side(slots, touching, joined, s); side >= 0; side = next_side(joined, side)) {
		int partner = joint_partner(joints, side), code = PARTNER_WALL(0);
		held own = held_body(slots, s, joint_anchor(joints, side)), other = held_other(slots, places, joints, side);
		hold h = hold_of(joints, side, own, other, false);
		if (partner >= 0)
			code = slot_is_static(slots, places[partner]) ? PARTNER_STATIC(partner) : places[partner];
		float place = larger(larger(magnitude(own.x.x), magnitude(own.x.y)), larger(magnitude(other.x.x), magnitude(other.x.y)));
		float levers = larger(magnitude(own.lever.x), magnitude(own.lever.y)) + larger(magnitude(other.lever.x), magnitude(other.lever.y));
		for (int k = 0; k < joint_points(joints, side); k++, point++) {
			__global float *to = POINT_OUT(contacts, FOUR_WIDTH, first, point);
			point_drop(contacts, grips, first, point, rub);
			to[4 * FOUR_PARTNER] = (float)code;
			to[4 * FOUR_NORMAL_X] = h.n[k].x;
			to[4 * FOUR_NORMAL_Y] = h.n[k].y;
			to[4 * FOUR_ARM] = cross2(own.lever, h.n[k]);
			to[4 * FOUR_OTHER_ARM] = cross2(other.lever, h.n[k]);
			to[4 * FOUR_TOLERANCE] = JOINT_PART * (((place + (own.radius + other.radius)) + levers) * SLOP);
		}
	}
}

/* Is it looked, after so many iterations, where all would get? */
bool is_aimed(int done)
{
	return done >= 0 && done < 31 && (JOINT_AIMED >> done & 1);
}

/* What a body moves along n, and turns by its arm, in a step as it moves now. */
float way_along(RECORD_IN(slots), int s, float2 n, float arm, float length)
{
	if (s < 0)
		return 0.0f;
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE);
	return (n.x * (CHANNEL(at, LINEAR_VX) * length) + n.y * (CHANNEL(at, LINEAR_VY) * length))
		+ arm * (CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY) * length);
}

/* Is a step too long for what a side's joint does? What its forces make turn adds to itself, or the anchors are far from where they belong. */
bool joint_is_stiff(RECORD_IN(contacts), RECORD_IN(joints), int side, int first, int point, held own, held other, hold h)
{
	float force = 0.0f, gives = held_gives(own) + held_gives(other), far = JOINT_FAR * (own.radius + other.radius);
	for (int k = 0; k < joint_points(joints, side); k++)
		force += magnitude(POINT_IN(contacts, FOUR_WIDTH, first, point + k)[4 * FOUR_FORCE]);
	if (!joint_is_pin(joints, side))
		gives += (own.inverse_mass + other.inverse_mass) / CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH);
	return force * gives > JOINT_STIFF || magnitude(h.target[0]) > far || magnitude(h.target[1]) > far;
}

/* What forces are to do, once it is known where all would get with those that there are. */
void joined_aim(RECORD_IN(slots), RECORD_OUT(contacts), LIST_IN(touching), RECORD_IN(loads), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined),
	int s, int now, float length)
{
	int point = 0, first = first_four(touching, s);
	for (int side = held_side(slots, touching, joined, s); side >= 0; side = next_side(joined, side)) {
		int partner = (int)POINT_IN(contacts, FOUR_WIDTH, first, point)[4 * FOUR_PARTNER];
		float2 own_anchor = joint_anchor(joints, side), other_anchor = joint_anchor(joints, side ^ 1);
		held own = held_moving(slots, loads, s, own_anchor, now, length, false), other = held_other(slots, places, joints, side);
		if (partner >= 0)
			other = held_moving(slots, loads, partner, other_anchor, now, length, false);
		hold h = hold_of(joints, side, own, other, false);
		bool stiff = joint_is_stiff(contacts, joints, side, first, point, own, other, h);
		if (stiff) {
			own = held_moving(slots, loads, s, own_anchor, now, length, true);
			if (partner >= 0)
				other = held_moving(slots, loads, partner, other_anchor, now, length, true);
			h = hold_of(joints, side, own, other, true);
		}
		float most = JOINT_MOST * (own.radius + other.radius);
		for (int k = 0; k < joint_points(joints, side); k++, point++) {
			__global float *to = POINT_OUT(contacts, FOUR_WIDTH, first, point);
			float target = larger(smaller(h.target[k], most), -most), arm = held_arm(own, h.n[k], stiff), other_arm = held_arm(other, h.n[k], stiff);
			to[4 * FOUR_NORMAL_X] = h.n[k].x;
			to[4 * FOUR_NORMAL_Y] = h.n[k].y;
			to[4 * FOUR_ARM] = arm;
			to[4 * FOUR_OTHER_ARM] = other_arm;
			to[4 * FOUR_LEAST] = stiff
				? -(EASE * target)
				: (way_along(slots, s, h.n[k], arm, length) - way_along(slots, partner, h.n[k], other_arm, length)) - 2.0f * target;
		}
	}
}
