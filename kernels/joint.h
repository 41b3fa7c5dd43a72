/* Joints, and which points they have: CONTRACT.md, "contacts", Joints. */

#define JOINT(joint, record) (JOINT_WIDTH * (joint) + (record))

/* What a point of a joint is for; from PART_MOTOR on what turns. */
#define PART_PIN_X 0
#define PART_PIN_Y 1
#define PART_ROD 2
#define PART_ROPE 3
#define PART_SPRING 4
#define PART_LINE 5
#define PART_MOTOR 6
#define PART_LOWER 7
#define PART_UPPER 8
#define PART_FIXED 9

/* A point of a body's joints, or where there are no more: they come joint by joint, first those that are firm, which push and pull as is needed. A side is a joint and which of its two bodies (see Joined), -1: none. */
typedef struct joint_row {
	int first, side, point;
	bool firm;
} joint_row;

float4 joint_drive(RECORD_IN(joints), int side)
{
	return joints[JOINT(side / 2, JOINT_DRIVE)];
}

int joint_kind(RECORD_IN(joints), int side)
{
	return (int)CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_KIND);
}

/* Do its bodies turn against each other about the anchor? */
bool joint_turns(RECORD_IN(joints), int side)
{
	int kind = joint_kind(joints, side);
	return kind == JOINT_PIN || kind == JOINT_SLIDER;
}

bool joint_has_motor(RECORD_IN(joints), int side)
{
	return CHANNEL(joint_drive(joints, side), DRIVE_TORQUE) > 0.0f;
}

/* Do its bodies stay at one angle to each other? */
bool joint_is_fixed(RECORD_IN(joints), int side)
{
	return joint_turns(joints, side) && CHANNEL(joint_drive(joints, side), DRIVE_HALF) == 0.0f;
}

/* How many points a side's joint has that are firm, or that are not. */
int joint_points(RECORD_IN(joints), int side, bool firm)
{
	int kind = joint_kind(joints, side);
	if (!joint_turns(joints, side))
		return firm == (kind == JOINT_ROD) ? 1 : 0;
	if (firm)
		return (kind == JOINT_PIN ? 2 : 1) + (joint_is_fixed(joints, side) ? 1 : 0);
	return (joint_has_motor(joints, side) ? 1 : 0) + (CHANNEL(joint_drive(joints, side), DRIVE_HALF) > 0.0f ? 2 : 0);
}

/* The next row that there is, from this one on. */
void row_find(RECORD_IN(joints), LIST_IN(joined), joint_row *row)
{
	while (row->side >= 0 && row->point == joint_points(joints, row->side, row->firm)) {
		row->point = 0;
		row->side = joined[JOINED_NEXT(joined[JOINED_BODIES], row->side)];
		if (row->side < 0 && row->firm) {
			row->firm = false;
			row->side = row->first;
		}
	}
}

/* A body's first, or first that is not firm. */
joint_row first_row(RECORD_IN(joints), LIST_IN(joined), int body, bool firm)
{
	int side = joined[JOINED_COUNT] > 0 ? joined[JOINED_FIRST + body] : -1;
	joint_row row = {side, side, 0, firm};
	row_find(joints, joined, &row);
	return row;
}

void row_next(RECORD_IN(joints), LIST_IN(joined), joint_row *row)
{
	row->point++;
	row_find(joints, joined, row);
}

int row_part(RECORD_IN(joints), const joint_row *row)
{
	int kind = joint_kind(joints, row->side), k = row->point;
	if (!joint_turns(joints, row->side))
		return kind == JOINT_ROD ? PART_ROD : kind == JOINT_ROPE ? PART_ROPE : PART_SPRING;
	if (row->firm && kind == JOINT_SLIDER)
		return k ? PART_FIXED : PART_LINE;
	if (row->firm)
		return k == 2 ? PART_FIXED : k ? PART_PIN_Y : PART_PIN_X;
	if (joint_has_motor(joints, row->side) && k-- == 0)
		return PART_MOTOR;
	return k ? PART_UPPER : PART_LOWER;
}

bool part_turns(int part)
{
	return part >= PART_MOTOR;
}

bool part_pushes_one_way(int part)
{
	return part == PART_ROPE || part == PART_LOWER || part == PART_UPPER;
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

/* What a spring pulls with, kg: by how far its anchors are apart, and by their speed; and by what that, as a way of a whole step, comes to be in such a part of one. */
typedef struct springing {
	float stiffness, damping, per_way;
	bool at_end; /* it acts as at the step's end, not in its middle */
} springing;

springing spring_of(RECORD_IN(joints), int side, float length, float part)
{
	float4 drive = joint_drive(joints, side);
	springing spring;
	spring.stiffness = smaller((CHANNEL(drive, SPRING_STIFFNESS) * length) * length, SPRING_MOST);
	spring.damping = smaller(CHANNEL(drive, SPRING_DAMPING) * length, SPRING_MOST);
	spring.at_end = (0.5f * spring.stiffness + spring.damping) * CHANNEL(drive, DRIVE_GIVES) > SPRING_STIFF;
	spring.per_way = spring.at_end ? part * (spring.stiffness * part + spring.damping)
								   : 0.5f * (part * part) * (0.5f * spring.stiffness + spring.damping / part);
	spring.per_way = larger(spring.per_way, SPRING_LEAST);
	return spring;
}

/* How a side's joint holds aside, kg: what it does, by the tension that the last step ended with, against a way across it; 0 of one that is not too fast in that for the step, and of what turns. */
float joint_aside(RECORD_IN(joints), int side, float length)
{
	float tension = larger(-((CHANNEL(joints[JOINT(side / 2, JOINT_FORCES)], JOINT_FORCE) * length) * length), 0.0f);
	float rest = CHANNEL(joints[JOINT(side / 2, JOINT_PARTIES)], JOINT_LENGTH), holds = tension / rest;
	if (joint_turns(joints, side) || !(tension > 0.0f))
		return 0.0f;
	if (joint_kind(joints, side) == JOINT_SPRING) {
		springing spring = spring_of(joints, side, length, 1.0f);
		holds = spring.at_end ? (tension * spring.stiffness) / (rest * spring.stiffness + tension) : 0.0f;
	}
	return holds * CHANNEL(joint_drive(joints, side), DRIVE_GIVES) > JOINT_STIFF ? holds : 0.0f;
}

/* The first side of the same body, from this one on, that holds aside; -1: none. */
int aside_from(RECORD_IN(joints), LIST_IN(joined), int side, float length)
{
	while (side >= 0 && !(joint_aside(joints, side, length) > 0.0f))
		side = joined[JOINED_NEXT(joined[JOINED_BODIES], side)];
	return side;
}

int first_aside(RECORD_IN(joints), LIST_IN(joined), int body, float length)
{
	return aside_from(joints, joined, joined[JOINED_COUNT] > 0 ? joined[JOINED_FIRST + body] : -1, length);
}

int next_aside(RECORD_IN(joints), LIST_IN(joined), int side, float length)
{
	return aside_from(joints, joined, joined[JOINED_NEXT(joined[JOINED_BODIES], side)], length);
}

/* Where it is kept what a joint's point does. */
int part_kept(int part)
{
	return part == PART_MOTOR ? JOINT_TORQUE : part_turns(part) ? JOINT_STOP : part == PART_PIN_Y ? JOINT_FORCE + 1 : JOINT_FORCE;
}

float joint_kept(RECORD_IN(joints), int side, int part)
{
	return ((__global const float *)(joints + JOINT(side / 2, JOINT_FORCES)))[part_kept(part)];
}

/* A force that was kept, as a point with that arm begins with it. */
float part_begins(int part, float kept, float arm)
{
	float force = kept;
	if (part_turns(part))
		force = magnitude(arm) > 0.0f ? kept / magnitude(arm) : 0.0f;
	if (part == PART_LOWER)
		return larger(force, 0.0f);
	return part_pushes_one_way(part) ? larger(0.0f - force, 0.0f) : force;
}

/* What one that pushes one way has to take back. */
float part_back(RECORD_IN(joints), int side, int part, float arm)
{
	if (part == PART_ROPE)
		return larger(CHANNEL(joints[JOINT(side / 2, JOINT_FORCES)], JOINT_BACK), 0.0f);
	return part_begins(part, 0.0f - joint_kept(joints, side, part), arm);
}

/* What a force at a joint's point may be. */
typedef struct bounds {
	float low, high;
} bounds;

/* Impulses at a bound that bodies have reached, so that `least` is 0, take back what its force made of a speed if it brought them there in the last step, as is kept then: they stop there. */
bounds bounds_of(RECORD_IN(joints), const joint_row *row, float arm, float least, float length, bool impulses)
{
	int part = row_part(joints, row);
	bounds of = {part_pushes_one_way(part) ? 0.0f : -INFINITY, INFINITY};
	if (part_pushes_one_way(part) && impulses && !(least > 0.0f))
		of.low = 0.0f - (part_back(joints, row->side, part, arm) * length) * length;
	if (part == PART_MOTOR)
		of.high = impulses ? 0.0f : ((CHANNEL(joint_drive(joints, row->side), DRIVE_TORQUE) * length) * length) / magnitude(arm);
	if (part == PART_SPRING && impulses)
		of.high = 0.0f;
	if (part == PART_MOTOR || (part == PART_SPRING && impulses))
		of.low = -of.high;
	return of;
}
