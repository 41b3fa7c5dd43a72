/* What joints hold, as points of Contacts that pull as well as push: CONTRACT.md, "contacts", Joints. */

/* What is held at a side: where it is, and how it gets to the end of a way; a place in the world stays. */
typedef struct held {
	float2 x, way, lever, last_lever;
	float angle, turned, radius, inverse_mass, inverse_inertia;
} held;

held held_place(float2 place)
{
	held h;
	h.x = place;
	h.way = h.lever = h.last_lever = (float2)(0.0f, 0.0f);
	h.angle = h.turned = h.radius = h.inverse_mass = h.inverse_inertia = 0.0f;
	return h;
}

held held_body(RECORD_IN(slots), int s, float2 anchor)
{
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), turns = SLOT_LOAD(slots, s, SLOT_TURN), mass = SLOT_LOAD(slots, s, SLOT_MASS);
	held h = held_place((float2)(CHANNEL(at, LINEAR_X), CHANNEL(at, LINEAR_Y)));
	h.lever = h.last_lever = turn(rotation_of(CHANNEL(turns, TURN_ANGLE)), anchor);
	h.angle = CHANNEL(turns, TURN_ANGLE);
	h.radius = CHANNEL(turns, TURN_RADIUS);
	h.inverse_mass = CHANNEL(mass, MASS_INVERSE);
	h.inverse_inertia = CHANNEL(mass, MASS_INVERSE_INERTIA);
	return h;
}

/* How far a body gets along an axis in a step, which is the part k of a whole one (here and below): as it moves now, or by what forces make of that. */
float held_way(float velocity, float length, float k, float load, bool by_velocity)
{
	float before = by_velocity ? k : k * (1.0f - 0.5f * k), after = by_velocity ? 0.0f : 0.5f * (k * k);
	return (velocity * length) * before + load * after;
}

held held_moving(RECORD_IN(slots), RECORD_IN(loads), int s, float2 anchor, float length, float k, bool by_velocity)
{
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), turns = SLOT_LOAD(slots, s, SLOT_TURN), load = loads[s];
	held h = held_body(slots, s, anchor);
	h.way = (float2)(held_way(CHANNEL(at, LINEAR_VX), length, k, load.x, by_velocity),
		held_way(CHANNEL(at, LINEAR_VY), length, k, load.y, by_velocity));
	h.turned = smaller(larger(held_way(CHANNEL(turns, TURN_VELOCITY), length, k, load.z, by_velocity), -JOINT_TURN), JOINT_TURN);
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

/* m, its radius of gyration; 0 of what does not move, or turn. */
float held_gyration(held h)
{
	return h.inverse_inertia > 0.0f ? sqrt(h.inverse_mass / h.inverse_inertia) : 0.0f;
}

/* How a joint holds the body of a side, seen from the other: along n, by so much. */
typedef struct hold {
	float2 n[2], gone; /* gone: how far the anchors get, one seen from the other */
	float target[2];
	float distance, last_distance, straight; /* of the anchors, where they have one; and how much of the two is in the middle */
	float arm, turned, sign;                 /* m, of what turns; rad, from the middle of the stops */
	float2 slid, last_slid;                  /* of a slider, from the anchor on its line to the other, as the way begins and ends */
	float line_turned;
	bool slides;
} hold;

/* To the left of a slider's line, seen from one of its sides. */
float2 line_normal(float angle, float sign)
{
	float2 along = rotation_of(angle);
	return (float2)(sign * -along.y, sign * along.x);
}

/* A slider, whose line goes with that one of the two. */
void hold_slide(hold *h, float axis, held owner, float2 first, bool at_end)
{
	float angle = owner.angle + axis;
	h->slides = true;
	h->slid = (float2)(h->sign * first.x, h->sign * first.y);
	h->last_slid = (float2)(h->sign * (first.x + h->gone.x), h->sign * (first.y + h->gone.y));
	h->line_turned = owner.turned;
	h->n[0] = line_normal(angle + (at_end ? owner.turned : 0.5f * owner.turned), h->sign);
	h->n[1] = (float2)(0.0f, 0.0f);
	h->target[0] = -inner(line_normal(angle, h->sign), first);
	h->target[1] = 0.0f;
}

hold hold_of(RECORD_IN(joints), int side, held own, held other, bool at_end)
{
	hold h;
	float2 first = (float2)((own.x.x - other.x.x) + (own.lever.x - other.lever.x), (own.x.y - other.x.y) + (own.lever.y - other.lever.y));
	h.gone = (float2)((own.way.x - other.way.x) + ((own.last_lever.x - own.lever.x) - (other.last_lever.x - other.lever.x)),
		(own.way.y - other.way.y) + ((own.last_lever.y - own.lever.y) - (other.last_lever.y - other.lever.y)));
	h.sign = side & 1 ? -1.0f : 1.0f;
	h.slides = false;
	h.slid = h.last_slid = (float2)(0.0f, 0.0f);
	h.line_turned = 0.0f;
	if (joint_turns(joints, side)) {
		float angle = side & 1 ? other.angle - own.angle : own.angle - other.angle;
		if (joint_kind(joints, side) == JOINT_PIN) {
			h.n[0] = (float2)(h.sign, 0.0f);
			h.n[1] = (float2)(0.0f, h.sign);
			h.target[0] = -inner(h.n[0], first);
			h.target[1] = -inner(h.n[1], first);
		} else {
			hold_slide(&h, CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH), side & 1 ? own : other, first, at_end);
		}
		h.distance = h.last_distance = h.straight = 0.0f;
		h.arm = h.turned = 0.0f;
		if (CHANNEL(joint_drive(joints, side), DRIVE_HALF) < 0.0f && !joint_has_motor(joints, side))
			return h;
		h.arm = larger(held_gyration(own), held_gyration(other));
		h.turned = wrapped(angle - CHANNEL(joint_drive(joints, side), DRIVE_MIDDLE));
		return h;
	}
	float2 last = (float2)(first.x + h.gone.x, first.y + h.gone.y), twice = at_end ? last : (float2)(first.x + last.x, first.y + last.y);
	float length = CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH), size = norm(twice);
	h.distance = norm(first);
	h.last_distance = norm(last);
	h.n[0] = size > 0.0f ? (float2)(twice.x / size, twice.y / size) : (float2)(h.sign, 0.0f);
	h.n[1] = (float2)(0.0f, 0.0f);
	h.target[0] = at_end ? length - h.distance : (length - h.distance) * ((length + h.distance) / larger(size, length));
	h.target[1] = 0.0f;
	h.straight = h.distance + h.last_distance > 0.0f ? size / (h.distance + h.last_distance) : 1.0f;
	h.arm = h.turned = 0.0f;
	return h;
}

float2 part_way(const hold *h, int part)
{
	if (part_turns(part))
		return (float2)(0.0f, 0.0f);
	return part == PART_ROPE ? (float2)(-h->n[0].x, -h->n[0].y) : part == PART_PIN_Y ? h->n[1] : h->n[0];
}

/* Of one of the two; what turns has the same of both, and a slider's line turns with the body that has it. */
float part_arm(const hold *h, int part, held body, bool is_own, bool at_end)
{
	if (part_turns(part))
		return part == PART_UPPER ? -(h->sign * h->arm) : h->sign * h->arm;
	float2 n = part_way(h, part), middle = (float2)(0.5f * (h->slid.x + h->last_slid.x), 0.5f * (h->slid.y + h->last_slid.y));
	float arm = held_arm(body, n, at_end);
	if (!h->slides || is_own != (h->sign < 0.0f))
		return arm;
	return arm + (at_end ? cross2(h->last_slid, n) : cross2(middle, n) * (1.0f + (h->line_turned * h->line_turned) * (1.0f / 12.0f)));
}

/* How far the two are to get along it; at least, where it pushes one way alone. */
float part_target(RECORD_IN(joints), int side, const hold *h, int part)
{
	float stop = CHANNEL(joint_drive(joints, side), DRIVE_HALF);
	if (part == PART_LOWER)
		return -((h->turned + stop) * h->arm);
	if (part == PART_UPPER)
		return -((stop - h->turned) * h->arm);
	if (part == PART_FIXED)
		return -(h->turned * h->arm);
	return part == PART_ROPE ? -h->target[0] : part == PART_PIN_Y ? h->target[1] : h->target[0];
}

/* What is at a side's other end, as it is. */
held held_other(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), int side)
{
	int partner = joint_partner(joints, side);
	float2 anchor = joint_anchor(joints, side ^ 1);
	return partner < 0 ? held_place(anchor) : held_body(slots, places[partner], anchor);
}

/* How many points joints of the body in a slot have, how many of these are firm, and how many are rows': none of what is not dynamic. If it is awake, all that it is joined with is disturbed in its sleep. */
int4 joined_find(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), LIST_OUT(touching), LIST_IN(islands), int s, float length)
{
	int rows = 0, firm = 0, others = 0;
	bool awake = !touching[TOUCH(s, TOUCHING_ASLEEP)];
	if (joined[JOINED_COUNT] == 0 || slot_is_static(slots, s))
		return (int4)(0);
	for (joint_row row = first_row(joints, joined, slot_body(slots, s), true); row.side >= 0; row_next(joints, joined, &row)) {
		int partner = joint_partner(joints, row.side);
		rows++;
		firm += row.firm ? 1 : 0;
		if (awake && partner >= 0 && touching[TOUCH(places[partner], TOUCHING_ASLEEP)])
			island_disturb(touching, islands, places[partner]);
	}
	for (int side = first_aside(joints, joined, slot_body(slots, s), length); side >= 0; side = next_aside(joints, joined, side, length))
		others++;
	return slot_is_dynamic(slots, s) ? (int4)(rows + others, firm, rows, 0) : (int4)(0);
}

/* What forces at their points are found within. */
float held_tolerance(held own, held other)
{
	float place = larger(larger(magnitude(own.x.x), magnitude(own.x.y)), larger(magnitude(other.x.x), magnitude(other.x.y)));
	float levers = larger(magnitude(own.lever.x), magnitude(own.lever.y)) + larger(magnitude(other.lever.x), magnitude(other.lever.y));
	return JOINT_PART * (((place + (own.radius + other.radius)) + levers) * SLOP);
}

/* One of them as the step begins: along n, with those arms. */
void point_hold(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), int side, RECORD_OUT(contacts), RECORD_OUT(grips), int first, int point,
	float2 n, float2 arms, float least, float tolerance, bool rub)
{
	int partner = joint_partner(joints, side), code = PARTNER_WALL(0);
	if (partner >= 0)
		code = slot_is_static(slots, places[partner]) ? PARTNER_STATIC(partner) : places[partner];
	__global float *to = POINT_OUT(contacts, FOUR_WIDTH, first, point);
	point_drop(contacts, grips, first, point, rub);
	to[4 * FOUR_PARTNER] = (float)code;
	to[4 * FOUR_NORMAL_X] = n.x;
	to[4 * FOUR_NORMAL_Y] = n.y;
	to[4 * FOUR_ARM] = arms.x;
	to[4 * FOUR_OTHER_ARM] = arms.y;
	to[4 * FOUR_LEAST] = least;
	to[4 * FOUR_TOLERANCE] = tolerance;
}

/* So many points of a slot's joints, as the step begins. What pushes one way may get as far as its bound by impulses; what holds aside does nothing yet. */
void joined_write(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), LIST_OUT(touching), RECORD_OUT(contacts), RECORD_OUT(grips),
	int s, int4 points, float length, float k, bool rub)
{
	int point = 0, first = first_four(touching, s);
	touching[TOUCH(s, TOUCHING_JOINED)] = points.x;
	touching[TOUCH(s, TOUCHING_FIRM)] = points.y;
	touching[TOUCH(s, TOUCHING_ROWS)] = points.z;
	touching[TOUCH(s, TOUCHING_TURNS)] = as_int(1.0f);
	held own, other;
	hold h;
	float tolerance;
	for (joint_row row = held_row(slots, touching, joints, joined, s); row.side >= 0; row_next(joints, joined, &row), point++) {
		int side = row.side, part = row_part(joints, &row);
		if (row.point == 0) {
			own = held_body(slots, s, joint_anchor(joints, side));
			other = held_other(slots, places, joints, side);
			h = hold_of(joints, side, own, other, true);
			tolerance = held_tolerance(own, other);
		}
		float2 arms = (float2)(part_arm(&h, part, own, true, true), part_arm(&h, part, other, false, true));
		float free = part_pushes_one_way(part) ? -part_target(joints, side, &h, part) : 0.0f;
		float least = free > JOINT_REACHED * tolerance ? free / k : 0.0f;
		point_hold(slots, places, joints, side, contacts, grips, first, point, part_way(&h, part), arms, least, tolerance, rub);
	}
	for (int side = first_aside_of(slots, touching, joints, joined, s, length); side >= 0; side = next_aside(joints, joined, side, length), point++) {
		float2 none = (float2)(0.0f, 0.0f);
		tolerance = held_tolerance(held_body(slots, s, joint_anchor(joints, side)), held_other(slots, places, joints, side));
		point_hold(slots, places, joints, side, contacts, grips, first, point, none, none, 0.0f, tolerance, rub);
	}
}
