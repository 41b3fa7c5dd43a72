/* What the forces of joints are to do, once it is known where all would get with those that there are: CONTRACT.md, "contacts", Joints. */

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

/* A side's joint, once it is known where all would get. */
typedef struct aimed {
	held own, other;
	hold h;
	bool stiff, tired; /* tired: so is the island */
} aimed;

void aim_look(aimed *aim, RECORD_IN(slots), RECORD_IN(loads), LIST_IN(places), RECORD_IN(joints), int side, int s, int partner, float length, float k,
	bool by_velocity)
{
	aim->stiff = by_velocity;
	aim->own = held_moving(slots, loads, s, joint_anchor(joints, side), length, k, by_velocity);
	aim->other = held_other(slots, places, joints, side);
	if (partner >= 0)
		aim->other = held_moving(slots, loads, partner, joint_anchor(joints, side ^ 1), length, k, by_velocity);
	aim->h = hold_of(joints, side, aim->own, aim->other, by_velocity);
}

/* Is a step too long for what a side's joint does? What its forces make turn adds to itself, or the anchors are far from where they belong, or the island is tired, or a spring could not swing. */
bool joint_is_stiff(RECORD_IN(joints), int side, const aimed *aim, float force, float length, float k)
{
	int kind = joint_kind(joints, side);
	float gives = held_gives(aim->own) + held_gives(aim->other), far = JOINT_FAR * (aim->own.radius + aim->other.radius), target = aim->h.target[0];
	if (kind == JOINT_SPRING)
		return spring_of(joints, side, length, k).at_end;
	if (!joint_turns(joints, side))
		gives += (aim->own.inverse_mass + aim->other.inverse_mass) / CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH);
	if (kind == JOINT_SLIDER)
		gives += larger(magnitude(aim->h.slid.x), magnitude(aim->h.slid.y)) * (side & 1 ? aim->own : aim->other).inverse_inertia;
	return (aim->tired && kind != JOINT_ROPE) || force * gives > JOINT_STIFF || (kind == JOINT_ROPE ? -target : magnitude(target)) > far
		|| magnitude(aim->h.target[1]) > far;
}

/* So that they have that rate, as a way of a whole step, when the step ends. */
float least_at_last(float rate, float parts, float k)
{
	return -((rate - (1.0f - k) * parts) / k);
}

/* What a spring pulls with where all get as they would now, but for what it gives way by then. */
float spring_least(RECORD_IN(joints), int side, const aimed *aim, float2 n, float parts, float length, float k)
{
	springing spring = spring_of(joints, side, length, k);
	float rest = CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH), distance = aim->h.distance, last = aim->h.last_distance;
	if (aim->stiff) {
		float pull = spring.stiffness * ((last - k * parts) - rest);
		return (pull + (spring.stiffness * k + spring.damping) * ((1.0f - k) * parts)) / spring.per_way;
	}
	float way = inner(n, aim->h.gone), mean = 0.5f * (distance + last) - rest;
	float pull = spring.stiffness * (aim->h.straight * mean - 0.5f * way) + (spring.damping / k) * (aim->h.straight * (last - distance) - way);
	return (2.0f / k - 1.0f) * parts + pull / spring.per_way;
}

/* By the end of the step each anchor, or angle, is where it belongs; of a short step as much nearer as it is of a whole one. */
float part_least(RECORD_IN(joints), int side, const aimed *aim, int part, float parts, float k)
{
	float radii = aim->own.radius + aim->other.radius, most = JOINT_MOST * radii, wanted = part_target(joints, side, &aim->h, part);
	bool one_way = part_pushes_one_way(part), eases = aim->stiff;
	float target = one_way ? smaller(wanted, most) : larger(smaller(wanted, most), -most);
	if (part_turns(part))
		eases = one_way ? wanted > JOINT_FAR * radii : aim->tired || magnitude(wanted) > JOINT_FAR * radii;
	if (eases)
		return least_at_last(EASE * target, parts, k);
	return (2.0f / k - 1.0f) * parts - (2.0f / (k * k)) * (one_way && target < 0.0f ? target : k * target);
}

/* The forces that a joint's first point has, and, of a pin, its second. */
float row_forces(RECORD_IN(contacts), int first, int point, int part)
{
	float force = magnitude(POINT_IN(contacts, FOUR_WIDTH, first, point)[4 * FOUR_FORCE]);
	return part == PART_PIN_X ? force + magnitude(POINT_IN(contacts, FOUR_WIDTH, first, point + 1)[4 * FOUR_FORCE]) : force;
}

/* A point acts along n, with those arms. */
void point_aim(__global float *to, float2 n, float arm, float other_arm)
{
	to[4 * FOUR_NORMAL_X] = n.x;
	to[4 * FOUR_NORMAL_Y] = n.y;
	to[4 * FOUR_ARM] = arm;
	to[4 * FOUR_OTHER_ARM] = other_arm;
}

/* What holds aside, where all would get as they move now: against what forces make of that across it, as its tension will turn with it. */
void aside_aim(__global float *to, RECORD_IN(slots), RECORD_IN(loads), LIST_IN(places), RECORD_IN(joints), int side, int s, float length, float k)
{
	int partner = (int)to[4 * FOUR_PARTNER];
	aimed aim;
	aim_look(&aim, slots, loads, places, joints, side, s, partner, length, k, true);
	float2 n = aside(aim.h.n[0]);
	float arm = held_arm(aim.own, n, true), other_arm = held_arm(aim.other, n, true);
	point_aim(to, n, arm, other_arm);
	to[4 * FOUR_LEAST] = -(way_along(slots, s, n, arm, length) - way_along(slots, partner, n, other_arm, length));
	to[4 * FOUR_GIVE] = 1.0f / larger(joint_aside(joints, side, length) * (0.5f * (k * k)), SPRING_LEAST);
}

/* What forces are to do, once it is known where all would get with those that there are. */
void joined_aim(RECORD_IN(slots), RECORD_OUT(contacts), LIST_IN(touching), RECORD_IN(loads), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined),
	int s, bool tired, float length, float k)
{
	int point = 0, rows = touching[TOUCH(s, TOUCHING_ROWS)], first = first_four(touching, s);
	aimed aim;
	aim.tired = tired;
	for (joint_row row = held_row(slots, touching, joints, joined, s); row.side >= 0; row_next(joints, joined, &row), point++) {
		int part = row_part(joints, &row), side = row.side;
		__global float *to = POINT_OUT(contacts, FOUR_WIDTH, first, point);
		int partner = (int)to[4 * FOUR_PARTNER];
		if (row.point == 0) {
			aim_look(&aim, slots, loads, places, joints, side, s, partner, length, k, false);
			if (!part_turns(part) && joint_is_stiff(joints, side, &aim, row_forces(contacts, first, point, part), length, k))
				aim_look(&aim, slots, loads, places, joints, side, s, partner, length, k, true);
		}
		float2 n = part_way(&aim.h, part);
		float arm = part_arm(&aim.h, part, aim.own, true, aim.stiff), other_arm = part_arm(&aim.h, part, aim.other, false, aim.stiff);
		float parts = way_along(slots, s, n, arm, length) - way_along(slots, partner, n, other_arm, length);
		point_aim(to, n, arm, other_arm);
		if (part == PART_SPRING)
			to[4 * FOUR_GIVE] = 1.0f / spring_of(joints, side, length, k).per_way;
		if (part == PART_MOTOR)
			to[4 * FOUR_LEAST] = least_at_last((CHANNEL(joint_drive(joints, side), DRIVE_SPEED) * length) * aim.h.arm, parts, k);
		else if (part == PART_SPRING)
			to[4 * FOUR_LEAST] = spring_least(joints, side, &aim, n, parts, length, k);
		else
			to[4 * FOUR_LEAST] = part_least(joints, side, &aim, part, parts, k);
	}
	for (int side = first_aside_of(slots, touching, joints, joined, s, length); side >= 0; side = next_aside(joints, joined, side, length), rows++)
		aside_aim(POINT_OUT(contacts, FOUR_WIDTH, first, rows), slots, loads, places, joints, side, s, length, k);
}
