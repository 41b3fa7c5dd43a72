/* Impulses at one point of two bodies: CONTRACT.md, "The step contacts", Shocks and Tugs. Who they push has a number, its party; what is held stands. */

#define SHOCK_BEGAN(id) (SHOCK_RECORDS * (id))
#define SHOCK(id, point) (SHOCK_BEGAN(id) + 1 + SHOCK_WIDTH * (point))

/* m/s along n; what is held stands. */
float way_speed(trajectory k, float2 n, float arm)
{
	return k.held > 0.0f ? 0.0f : inner(n, (float2)(CHANNEL(k.place, LINEAR_VX), CHANNEL(k.place, LINEAR_VY))) + k.velocity * arm;
}

/* Is the point's partner a party, or one that nothing pushes? */
bool point_is_open(RECORD_IN(slots), float4 push)
{
	int partner = (int)CHANNEL(push, SHOCK_PARTNER);
	return partner < 0 || CHANNEL(push, SHOCK_NUMBER) >= 0.0f || !slot_is_dynamic(slots, partner);
}

bool point_is_none(float4 push)
{
	return CHANNEL(push, SHOCK_PARTNER) == (float)PARTNER_NONE;
}

/* How fast a party parts from the partner of an open point along n, which has the arms. */
float parting(RECORD_IN(slots), RECORD_OUT(work), int id, float4 push, float2 n, float arm, float other_arm)
{
	float own = way_speed(work_load(work, id), n, arm);
	int other = (int)CHANNEL(push, SHOCK_NUMBER), partner = (int)CHANNEL(push, SHOCK_PARTNER);
	if (other < 0 && partner < 0)
		return own;
	return own - way_speed(other >= 0 ? work_load(work, other) : trajectory_start(slots, partner), n, other_arm);
}

/* Twice the kinetic energy of the body in slot s that moves so, 0 if it is held. */
float way_energy(RECORD_IN(slots), int s, trajectory k)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	float straight = CHANNEL(mass, MASS_INVERSE), turning = CHANNEL(mass, MASS_INVERSE_INERTIA), energy = 0.0f;
	float x = CHANNEL(k.place, LINEAR_VX), y = CHANNEL(k.place, LINEAR_VY);
	if (k.held > 0.0f)
		return 0.0f;
	if (straight > 0.0f)
		energy = (x * x + y * y) / straight;
	return turning > 0.0f ? energy + (k.velocity * k.velocity) / turning : energy;
}

float point_rate(RECORD_IN(slots), RECORD_OUT(work), int id, float4 normal, float4 push)
{
	float2 n = (float2)(CHANNEL(normal, SHOCK_X), CHANNEL(normal, SHOCK_Y));
	if (!point_is_open(slots, push))
		return way_speed(work_load(work, id), n, CHANNEL(normal, SHOCK_ARM)) - CHANNEL(push, SHOCK_IMPULSE);
	return parting(slots, work, id, push, n, CHANNEL(normal, SHOCK_ARM), CHANNEL(normal, SHOCK_OTHER_ARM));
}

/* (inverse mass, inverse inertia); what is none or is held has none. */
float2 member_gives(RECORD_IN(slots), LIST_IN(active), RECORD_OUT(work), int id)
{
	if (id < 0 || CHANNEL(work[WORK_WIDTH * id + WORK_TURN], WORK_HELD) > 0.0f)
		return (float2)(0.0f, 0.0f);
	float4 mass = SLOT_LOAD(slots, active[id], SLOT_MASS);
	return (float2)(CHANNEL(mass, MASS_INVERSE), CHANNEL(mass, MASS_INVERSE_INERTIA));
}

float gives_at(float2 gives, float arm)
{
	return gives.x + gives.y * (arm * arm);
}

void member_push(RECORD_OUT(work), int id, float2 gives, float2 impulse, float torque)
{
	if (id < 0)
		return;
	trajectory k = work_load(work, id);
	CHANNEL(k.place, LINEAR_VX) += gives.x * impulse.x;
	CHANNEL(k.place, LINEAR_VY) += gives.x * impulse.y;
	k.velocity += gives.y * torque;
	work_store(work, id, k);
}

/* Gives an open point, which has that rate, the one that it is to have, or goes `farther` times as far; only those of joints pull. False if that is a change of less than `least`. */
bool point_push(RECORD_IN(slots), LIST_IN(active), RECORD_OUT(work), RECORD_OUT(shocks), int id, int point, float rate, float farther, float least)
{
	__global float4 *at = shocks + SHOCK(id, point);
	float4 normal = at[SHOCK_NORMAL], grip = at[SHOCK_GRIP], push = at[SHOCK_PUSH];
	int other = (int)CHANNEL(push, SHOCK_NUMBER);
	float2 gives = member_gives(slots, active, work, id), other_gives = member_gives(slots, active, work, other);
	float arm = CHANNEL(normal, SHOCK_ARM), other_arm = CHANNEL(normal, SHOCK_OTHER_ARM), before = CHANNEL(push, SHOCK_IMPULSE);
	float give = gives_at(gives, arm) + gives_at(other_gives, other_arm), part = CHANNEL(grip, SHOCK_PART);
	if (!(give > 0.0f))
		return false;
	float lacking = (part - rate) / give, enough = before + farther * lacking;
	float impulse = CHANNEL(grip, SHOCK_FRICTION) == SHOCK_JOINT ? enough : larger(enough, 0.0f);
	float more = impulse - before;
	if (!(magnitude(more) * give >= least))
		return false;
	float2 n = (float2)(CHANNEL(normal, SHOCK_X), CHANNEL(normal, SHOCK_Y)), along = aside(n);
	CHANNEL(push, SHOCK_IMPULSE) = impulse;
	member_push(work, id, gives, (float2)(more * n.x, more * n.y), more * arm);
	member_push(work, other, other_gives, (float2)(-(more * n.x), -(more * n.y)), -(more * other_arm));
	if (CHANNEL(grip, SHOCK_FRICTION) > 0.0f) {
		float grip_arm = CHANNEL(grip, SHOCK_GRIP_ARM), other_grip_arm = CHANNEL(grip, SHOCK_OTHER_GRIP_ARM), rubbed = CHANNEL(push, SHOCK_RUB);
		float slip = parting(slots, work, id, push, along, grip_arm, other_grip_arm), most = CHANNEL(grip, SHOCK_FRICTION) * impulse;
		float rub = larger(smaller(rubbed - slip / (gives_at(gives, grip_arm) + gives_at(other_gives, other_grip_arm)), most), -most);
		float change = rub - rubbed;
		CHANNEL(push, SHOCK_RUB) = rub;
		member_push(work, id, gives, (float2)(change * along.x, change * along.y), change * grip_arm);
		member_push(work, other, other_gives, (float2)(-(change * along.x), -(change * along.y)), -(change * other_grip_arm));
	}
	at[SHOCK_PUSH] = push;
	return true;
}

/* What a kinematic partner of an open point gave by it. */
float point_driven(RECORD_IN(slots), float4 normal, float4 grip, float4 push)
{
	int partner = (int)CHANNEL(push, SHOCK_PARTNER);
	if (partner < 0 || CHANNEL(push, SHOCK_NUMBER) >= 0.0f)
		return 0.0f;
	trajectory k = trajectory_start(slots, partner);
	float2 n = (float2)(CHANNEL(normal, SHOCK_X), CHANNEL(normal, SHOCK_Y));
	return CHANNEL(push, SHOCK_IMPULSE) * way_speed(k, n, CHANNEL(normal, SHOCK_OTHER_ARM))
		+ CHANNEL(push, SHOCK_RUB) * way_speed(k, aside(n), CHANNEL(grip, SHOCK_OTHER_GRIP_ARM));
}
