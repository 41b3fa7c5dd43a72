/* What lies still, of the step contacts: CONTRACT.md, "contacts", Stillness. */

/* What stillness is judged by: the velocity of what carries a slot's island, if that is kinematic, does not turn, and the island touches nothing static; else 0. */
float2 ground_velocity(RECORD_IN(slots), LIST_IN(touching), LIST_IN(islands), LIST_IN(places), int s)
{
	int carrier = touching[TOUCH(islands[s], TOUCHING_CARRIER)];
	if (carrier < 0 || carrier == CARRIER_STATIC || CHANNEL(SLOT_LOAD(slots, places[carrier], SLOT_TURN), TURN_VELOCITY) != 0.0f)
		return (float2)(0.0f, 0.0f);
	float4 place = SLOT_LOAD(slots, places[carrier], SLOT_PLACE);
	return (float2)(place.z, place.w);
}

/* Is a partner that does not give way at rest there? */
bool is_ground(RECORD_IN(slots), int partner, float2 ground)
{
	if (partner < 0)
		return is_zero(ground);
	float4 place = SLOT_LOAD(slots, partner, SLOT_PLACE);
	return place.z == ground.x && place.w == ground.y && CHANNEL(SLOT_LOAD(slots, partner, SLOT_TURN), TURN_VELOCITY) == 0.0f;
}

/* The part of a step's way that a body may go and count as still: the least that forces on it are found within. 0: it touches at less than two points, or what doesn't rub, or
 * what is not dynamic and not at rest. */
float still_within(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub, float2 ground)
{
	float within = 0.0f;
	int count = touching[TOUCH(s, TOUCHING_COUNT)], joined = first_contact(touching, s);
	for (int point = joined, first = first_four(touching, s); rub && point < count; point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, point);
		int other = (int)at[4 * FOUR_PARTNER];
		bool rubs = POINT_IN(grips, GRIP_WIDTH, first, point)[4 * GRIP_FRICTION] > 0.0f;
		if (!rubs || !(partner_gives_way(slots, other) || is_ground(slots, other, ground)))
			return 0.0f;
		within = point == joined ? at[4 * FOUR_TOLERANCE] : smaller(within, at[4 * FOUR_TOLERANCE]);
	}
	return count - joined > 1 ? within : 0.0f;
}

/* Of a body's velocities, or its push, the most that they are anywhere on it: along an axis, or by turning at its radius. */
float still_most(RECORD_IN(slots), int s, float x, float y, float turning)
{
	return larger(larger(fabs(x), fabs(y)), CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS) * fabs(turning));
}

/* How fast it is, seen from the ground. */
float still_speed(RECORD_IN(slots), int s, float2 ground)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE);
	return still_most(slots, s, place.z - ground.x, place.w - ground.y, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY));
}

/* What a body's forces come to, in such a step, changes its velocities at once, or its push. What is at rest stays so if all that moves it comes to hardly anything. */
void slot_take(RECORD_OUT(slots), LIST_IN(status), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub, float4 sum,
	float2 ground, float length)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH), place = SLOT_LOAD(slots, s, SLOT_PLACE);
	float x = sum.x / length, y = sum.y / length, torque = sum.z / length, turning = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY) + torque;
	bool impulses = status[STATUS_PASS] == PASS_IMPULSES, at_rest = still_speed(slots, s, ground) == 0.0f;
	float4 moves = impulses ? (float4)(place.z + x, place.w + y, turning, 0.0f)
							: (float4)(push.x + x / length, push.y + y / length, push.z + torque / length, 0.0f);
	float2 still = impulses ? ground : (float2)(0.0f, 0.0f);
	float way = still_most(slots, s, moves.x - still.x, moves.y - still.y, moves.z) * length;
	if (at_rest && (impulses ? way : way * length) < STILL_PUSH * still_within(slots, contacts, grips, touching, s, rub, ground))
		moves = (float4)(still.x, still.y, 0.0f, 0.0f);
	if (impulses)
		velocities_set(slots, s, moves.x, moves.y, moves.z);
	else
		slots[SLOT_WIDTH * s + SLOT_PUSH] = (float4)(moves.x, moves.y, moves.z, push.w);
}

/* Was any that a body touches at rest as the step began? */
bool still_beside(RECORD_IN(contacts), LIST_IN(touching), RECORD_IN(pushes), int s, float2 ground)
{
	bool beside = false;
	for (int point = first_contact(touching, s), first = first_four(touching, s); point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		int other = (int)POINT_IN(contacts, FOUR_WIDTH, first, point)[4 * FOUR_PARTNER];
		beside = beside || partner_was_at_rest(pushes, other, ground);
	}
	return beside;
}

/* What the island of a slot is on, once its forces are found: bits for its root, and for the slot itself. */
void slot_foot(RECORD_IN(slots), LIST_IN(status), RECORD_IN(contacts), RECORD_IN(grips), LIST_OUT(touching), LIST_IN(islands), int s, bool rub,
	float2 ground)
{
	int own = 0, all = 0;
	for (int point = first_contact(touching, s), first = first_four(touching, s);
		 rub && status[STATUS_PASS] == PASS_FORCES && point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, point), *grip = POINT_IN(grips, GRIP_WIDTH, first, point);
		int other = (int)at[4 * FOUR_PARTNER];
		if (!(at[4 * FOUR_FORCE] > 0.0f))
			continue;
		bool slides = !(fabs(grip[4 * GRIP_FORCE]) < grip[4 * GRIP_BOUND]);
		own |= slides ? FOOTING_SLIDES : 0;
		if (!partner_gives_way(slots, other))
			all |= is_ground(slots, other, ground) && !slides ? FOOTING_FIRM : FOOTING_LOOSE;
	}
	if (own)
		atomic_or(&touching[TOUCH(s, TOUCHING_FOOTING)], own);
	if (all)
		atomic_or(&touching[TOUCH(islands[s], TOUCHING_FOOTING)], all);
}

/* Gives a body what forces on it come to. What is kinematic gets nothing, and is read meanwhile by those that it carries. */
void slot_bear(RECORD_OUT(slots), LIST_IN(status), RECORD_IN(contacts), RECORD_IN(grips), LIST_OUT(touching), LIST_IN(islands), LIST_IN(places),
	int s, bool rub, float length)
{
	if (!slot_is_dynamic(slots, s))
		return;
	float2 ground = ground_velocity(slots, touching, islands, places, s);
	slot_take(slots, status, contacts, grips, touching, s, rub, rests_add(slots, contacts, grips, touching, s, rub, (float4)(0.0f)), ground, length);
	slot_foot(slots, status, contacts, grips, touching, islands, s, rub, ground);
}

/* Does a body slide nowhere, and stand, by its island, on something static? */
bool slot_is_firm(LIST_IN(touching), LIST_IN(islands), int s)
{
	int all = touching[TOUCH(islands[s], TOUCHING_FOOTING)];
	return !(touching[TOUCH(s, TOUCHING_FOOTING)] & FOOTING_SLIDES) && (all & (FOOTING_FIRM | FOOTING_LOOSE)) == FOOTING_FIRM;
}

float velocity_kept(float velocity)
{
	return fabs(velocity) < STILL_LEAST ? 0.0f : velocity;
}

/* What hardly moves after a step comes to rest, unless it gets faster; what stands firm, and moves little, gets slower. */
void slot_settle(RECORD_OUT(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), LIST_IN(islands), RECORD_IN(pushes), int s, bool rub,
	float2 ground, float length)
{
	if (touching[TOUCH(s, TOUCHING_COUNT)] == 0)
		return;
	float4 before = pushes[PUSHES_WIDTH * s + 1], place = SLOT_LOAD(slots, s, SLOT_PLACE);
	float x = velocity_kept(place.z), y = velocity_kept(place.w), turning = velocity_kept(CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY));
	float within = still_within(slots, contacts, grips, touching, s, rub, ground),
		  way = still_most(slots, s, x - ground.x, y - ground.y, turning) * length;
	if (way < still_most(slots, s, before.x - ground.x, before.y - ground.y, before.z) * length + STILL_PUSH * within) {
		if (way < STILL_SPEED * within && still_beside(contacts, touching, pushes, s, ground))
			x = ground.x, y = ground.y, turning = 0.0f;
		else if (way < STILL_SLOW * within && slot_is_firm(touching, islands, s))
			x -= STILL_BRAKE * (x - ground.x), y -= STILL_BRAKE * (y - ground.y), turning -= STILL_BRAKE * turning;
	}
	velocities_set(slots, s, x, y, turning);
}

/* Is nothing left of its push? */
bool slot_is_unpushed(RECORD_IN(slots), int s)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
	return push.x == 0.0f && push.y == 0.0f && push.z == 0.0f;
}

/* After a step, or before one `again`: a slot's push is as it was, and before one its velocities, too; after one it comes to rest, and its forces are kept. */
void slot_release(RECORD_OUT(slots), LIST_IN(status), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_OUT(touching), LIST_IN(islands),
	RECORD_IN(pushes), RECORD_OUT(warm), LIST_OUT(warm_spans), LIST_IN(places), RECORD_OUT(joints), LIST_IN(joined), LIST_IN(wakes), int s,
	bool again, bool rub, float length)
{
	bool borne = slot_is_unpushed(slots, s) && wakes[WAKE(s, WAKE_CHANGED)] != CHANGED_IN(status[STATUS_AGE]); /* and had no event */
	slot_restore(slots, pushes, s, again);
	if (again)
		return;
	float2 ground = ground_velocity(slots, touching, islands, places, s);
	slot_settle(slots, contacts, grips, touching, islands, pushes, s, rub, ground, length);
	joined_keep(slots, status, contacts, touching, islands, pushes, places, joints, joined, s, ground, length);
	forces_keep(slots, status, contacts, grips, touching, islands, pushes, warm, warm_spans, s, rub, ground, length);
	if (!borne || !slot_stayed(slots, pushes, s))
		island_disturb(touching, islands, s);
}

/* Its push is its own again, if it slept. */
void slot_wake(RECORD_OUT(slots), LIST_OUT(status), LIST_OUT(touching), RECORD_IN(pushes), int s)
{
	if (!touching[TOUCH(s, TOUCHING_ASLEEP)])
		return;
	slot_restore(slots, pushes, s, false);
	sleeper_rouse(status, touching, s);
}

/* Does what SLEEP_... says with a slot; true if it fell asleep, or woke. */
bool slot_sleep(RECORD_OUT(slots), LIST_OUT(status), RECORD_IN(contacts), LIST_OUT(touching), RECORD_IN(grips), LIST_IN(islands), RECORD_IN(pushes),
	LIST_IN(places), int s, int what, bool rub, float length)
{
	bool asleep = touching[TOUCH(s, TOUCHING_ASLEEP)];
	if (what == SLEEP_FORGOTTEN)
		touching[TOUCH(s, TOUCHING_ASLEEP)] = touching[TOUCH(s, TOUCHING_MADE)] = 0;
	else if (asleep && (what == SLEEP_ENDS || !slot_stayed(slots, pushes, s))) {
		slot_wake(slots, status, touching, pushes, s);
		island_disturb(touching, islands, s);
		if (what == SLEEP_BEGINS)
			slot_settle(slots, contacts, grips, touching, islands, pushes, s, rub, ground_velocity(slots, touching, islands, places, s), length);
		return true;
	} else if (!asleep && what == SLEEP_BEGINS && touching[TOUCH(s, TOUCHING_COUNT)] > 0 && !island_is_disturbed(touching, islands, s)) {
		float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
		slots[SLOT_WIDTH * s + SLOT_PUSH] = (float4)(0.0f, 0.0f, 0.0f, push.w);
		touching[TOUCH(s, TOUCHING_ASLEEP)] = 1;
		atomic_inc(&status[STATUS_SLEEPERS]);
		return true;
	}
	return false;
}
