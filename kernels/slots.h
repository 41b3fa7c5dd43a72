/* Bodies in slots, and their trajectories: CONTRACT.md, "The step events". */

#define SLOT_LOAD(slots, s, record) ((slots)[SLOT_WIDTH * (s) + (record)])
#define MEMBER(id, field) (MEMBER_WIDTH * (id) + (field))
#define SPAN(s, field) (SPAN_WIDTH * (s) + (field))
#define WAKE(s, field) (WAKE_WIDTH * (s) + (field))
#define TOUCH(s, field) (TOUCHING_WIDTH * (s) + (field))

/* How a body moves from `time` on. */
typedef struct trajectory {
	float4 place; /* as in Linear */
	float angle, velocity;
	float time; /* part of the step */
	float held; /* 1: it does not move until the step ends */
} trajectory;

trajectory trajectory_start(RECORD_IN(slots), int s)
{
	float4 turn_record = SLOT_LOAD(slots, s, SLOT_TURN);
	trajectory k;
	k.place = SLOT_LOAD(slots, s, SLOT_PLACE);
	k.angle = CHANNEL(turn_record, TURN_ANGLE);
	k.velocity = CHANNEL(turn_record, TURN_VELOCITY);
	k.time = k.held = 0.0f;
	return k;
}

trajectory work_load(__global const float4 *work, int id)
{
	float4 turn_record = work[WORK_WIDTH * id + WORK_TURN];
	trajectory k;
	k.place = work[WORK_WIDTH * id + WORK_PLACE];
	k.angle = CHANNEL(turn_record, WORK_ANGLE);
	k.velocity = CHANNEL(turn_record, WORK_VELOCITY);
	k.time = CHANNEL(turn_record, WORK_TIME);
	k.held = CHANNEL(turn_record, WORK_HELD);
	return k;
}

void work_store(__global float4 *work, int id, trajectory k)
{
	work[WORK_WIDTH * id + WORK_PLACE] = k.place;
	work[WORK_WIDTH * id + WORK_TURN] = (float4)(k.angle, k.velocity, k.time, k.held);
}

/* Neither static nor kinematic: those have infinite mass, and no hit changes them. */
INLINE bool slot_is_dynamic(RECORD_IN(slots), int s)
{
	return CHANNEL(SLOT_LOAD(slots, s, SLOT_MASS), MASS_INVERSE) > 0.0f;
}

INLINE bool slot_is_static(RECORD_IN(slots), int s)
{
	if (slot_is_dynamic(slots, s))
		return false;
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE);
	return CHANNEL(at, LINEAR_VX) == 0.0f && CHANNEL(at, LINEAR_VY) == 0.0f && CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY) == 0.0f;
}

INLINE bool slot_is_kinematic(RECORD_IN(slots), int s)
{
	return !slot_is_dynamic(slots, s) && !slot_is_static(slots, s);
}

/* Alone, for somebody may be writing what is beside it. */
int slot_body(RECORD_IN(slots), int s)
{
	return (int)((__global const float *)(slots + SLOT_WIDTH * s + SLOT_PUSH))[PUSH_BODY];
}

/* What a push makes of a way in a step of that length. */
INLINE float2 push_way(float4 push, float length)
{
	return (float2)((CHANNEL(push, PUSH_X) * length) * length, (CHANNEL(push, PUSH_Y) * length) * length);
}

/* The body in step units, as if the step began at the trajectory's time. */
body body_of(RECORD_IN(slots), int s, trajectory k, float length)
{
	float4 constants = SLOT_LOAD(slots, s, SLOT_TURN), mass = SLOT_LOAD(slots, s, SLOT_MASS), push = SLOT_LOAD(slots, s, SLOT_PUSH);
	body b;
	b.index = s;
	int count = (int)CHANNEL(mass, MASS_COUNT);
	b.first = (int)CHANNEL(mass, MASS_FIRST);
	b.count = count % PIECES;
	b.pieces = count / PIECES;
	b.radius = CHANNEL(constants, TURN_RADIUS);
	b.restitution = CHANNEL(constants, TURN_RESTITUTION);
	b.inverse_mass = CHANNEL(mass, MASS_INVERSE);
	b.inverse_inertia = CHANNEL(mass, MASS_INVERSE_INERTIA);
	b.x = (float2)(CHANNEL(k.place, LINEAR_X), CHANNEL(k.place, LINEAR_Y));
	b.r = k.angle;
	b.v = b.a = (float2)(0.0f, 0.0f);
	b.w = b.b = 0.0f;
	if (k.held > 0.0f) {
		b.inverse_mass = b.inverse_inertia = 0.0f;
		return b;
	}
	b.v = (float2)(CHANNEL(k.place, LINEAR_VX) * length, CHANNEL(k.place, LINEAR_VY) * length);
	b.w = k.velocity * length;
	if (b.inverse_mass > 0.0f) {
		b.a = push_way(push, length);
		b.b = (CHANNEL(push, PUSH_TORQUE) * length) * length;
	}
	return b;
}

/* The trajectory, told from time u on. */
INLINE trajectory moved(RECORD_IN(slots), int s, trajectory k, float u, float length)
{
	if (u == k.time || k.held > 0.0f || slot_is_static(slots, s))
		return k;
	body b = body_of(slots, s, k, length);
	float dt = u - k.time, scale = dt / length;
	float2 x = place(b.x, b.v, b.a, dt);
	k.place = (float4)(x.x, x.y, CHANNEL(k.place, LINEAR_VX) + scale * b.a.x, CHANNEL(k.place, LINEAR_VY) + scale * b.a.y);
	k.angle = wrapped(place1(b.r, b.w, b.b, dt));
	k.velocity = k.velocity + scale * b.b;
	k.time = u;
	return k;
}

/* The centre of a body, and the circle about it that holds the body: enough to see that most pairs stay apart. */
typedef struct disc {
	float2 x, v, a; /* step units */
	float radius, time;
} disc;

disc disc_of(RECORD_IN(slots), int s, float4 place_record, float time, bool held, float length)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
	disc d;
	float unit = held ? 0.0f : length;
	d.x = (float2)(CHANNEL(place_record, LINEAR_X), CHANNEL(place_record, LINEAR_Y));
	d.v = (float2)(CHANNEL(place_record, LINEAR_VX) * unit, CHANNEL(place_record, LINEAR_VY) * unit);
	d.a = push_way(push, unit);
	d.radius = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS);
	d.time = time;
	return d;
}

disc disc_at_start(RECORD_IN(slots), int s, float length)
{
	return disc_of(slots, s, SLOT_LOAD(slots, s, SLOT_PLACE), 0.0f, false, length);
}

/* Before which time, counted from the step's beginning, two discs surely have no hit, while nothing changes their ways: in this step and `ahead` steps more.
 * The way of one seen from the other is a line but for what their pushes differ, which the distance allows for. Circles that fall alike have none
 * once they part, and fast enough for what is sunk. */
INLINE float first_meeting(disc a, disc b, float ahead, bool circles)
{
	float t0 = larger(a.time, b.time), da = t0 - a.time, db = t0 - b.time, last = 1.0f + ahead, never = last + 1.0f;
	float2 from = place(a.x, a.v, a.a, da), to = place(b.x, b.v, b.a, db), d = (float2)(to.x - from.x, to.y - from.y);
	float2 v = (float2)((b.v.x + db * b.a.x) - (a.v.x + da * a.a.x), (b.v.y + db * b.a.y) - (a.v.y + da * a.a.y));
	float differ = (last * last) * span((float2)(b.a.x - a.a.x, b.a.y - a.a.y)), reach = a.radius + b.radius;
	float slack = ((span(from) + span(to)) + (reach + last * ((span(v) + span(a.v)) + span(b.v)))) * (8.0f * SLOP);
	float most = ((reach + differ) + slack) * 1.00001f, square = most * most, distance = inner(d, d), approach = inner(d, v), speed = inner(v, v);
	if (approach >= 0.0f && (distance > square || (circles && differ == 0.0f && approach > slack * (span(v) + (0.5f * SUNK_RATE) * span(d)))))
		return never;
	if (!(distance > square))
		return t0;
	float x = cross2(d, v), under = square * speed - x * x, far = sqrt(distance);
	if (under < 0.0f)
		return never;
	return t0 + (((far - most) * (far + most)) / (sqrt(under) - approach)) * 0.9999f;
}

/* The same of two bodies' trajectories in this step alone. */
INLINE bool stay_apart(disc a, disc b)
{
	return first_meeting(a, b, 0.0f, false) > 1.0f;
}

/* Of circles that fall alike it is known when they have no hit any more. */
bool are_plain(RECORD_IN(slots), int s, int other)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH), other_push = SLOT_LOAD(slots, other, SLOT_PUSH);
	return CHANNEL(SLOT_LOAD(slots, s, SLOT_MASS), MASS_COUNT) == 1.0f && CHANNEL(SLOT_LOAD(slots, other, SLOT_MASS), MASS_COUNT) == 1.0f
		&& CHANNEL(push, PUSH_X) == CHANNEL(other_push, PUSH_X) && CHANNEL(push, PUSH_Y) == CHANNEL(other_push, PUSH_Y);
}
