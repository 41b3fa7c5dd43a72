/* What lies still, of the step contacts: CONTRACT.md, "contacts", Stillness. */

/* The part of a step's way that a body may go and count as still: the least that forces on it are found within. 0: it touches at less than two points, or what doesn't rub, or
 * what is kinematic. */
float still_within(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub)
{
	float within = 0.0f;
	int points = 0;
	for (int point = 0; rub && point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, s, point);
		int other = (int)at[4 * FOUR_PARTNER];
		if (other == PARTNER_NONE)
			continue;
		if (!(POINT_IN(grips, GRIP_WIDTH, s, point)[4 * GRIP_FRICTION] > 0.0f) || (other >= 0 && !slot_is_dynamic(slots, other)))
			return 0.0f;
		within = points++ == 0 ? at[4 * FOUR_TOLERANCE] : smaller(within, at[4 * FOUR_TOLERANCE]);
	}
	return points > 1 ? within : 0.0f;
}

/* Of a body's velocities, or its push, the most that they are anywhere on it: along an axis, or by turning at its radius. */
float still_most(RECORD_IN(slots), int s, float x, float y, float turning)
{
	return larger(larger(fabs(x), fabs(y)), CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS) * fabs(turning));
}

float still_speed(RECORD_IN(slots), int s)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE);
	return still_most(slots, s, place.z, place.w, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY));
}

/* Nothing pushes what is at rest, if all that does comes to hardly anything, forces too. */
void slot_stay(RECORD_OUT(slots), LIST_IN(status), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub, float length)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
	float way = (still_most(slots, s, push.x, push.y, push.z) * length) * length;
	if (status[STATUS_PASS] == PASS_FORCES && still_speed(slots, s) == 0.0f
		&& way < STILL_PUSH * still_within(slots, contacts, grips, touching, s, rub))
		slots[SLOT_WIDTH * s + SLOT_PUSH] = (float4)(0.0f, 0.0f, 0.0f, push.w);
}

/* Was any that a body touches at rest as the step began? */
bool still_beside(RECORD_IN(contacts), LIST_IN(touching), RECORD_IN(pushes), int s)
{
	for (int point = 0; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		int other = (int)POINT_IN(contacts, FOUR_WIDTH, s, point)[4 * FOUR_PARTNER];
		if (other == PARTNER_NONE)
			continue;
		float4 velocities = pushes[PUSHES_WIDTH * max(other, 0) + 1];
		if (other < 0 || (velocities.x == 0.0f && velocities.y == 0.0f && velocities.z == 0.0f))
			return true;
	}
	return false;
}

/* What hardly moves after a step comes to rest, unless it gets faster. */
void slot_come_to_rest(RECORD_OUT(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), RECORD_IN(pushes), int s, bool rub, float length)
{
	float4 before = pushes[PUSHES_WIDTH * s + 1];
	float within = still_within(slots, contacts, grips, touching, s, rub), way = still_speed(slots, s) * length;
	float way_before = still_most(slots, s, before.x, before.y, before.z) * length;
	if (way < STILL_SPEED * within && way < way_before + STILL_PUSH * within && still_beside(contacts, touching, pushes, s))
		velocities_set(slots, s, 0.0f, 0.0f, 0.0f);
}

/* Is nothing left of its push? */
bool slot_is_unpushed(RECORD_IN(slots), int s)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
	return push.x == 0.0f && push.y == 0.0f && push.z == 0.0f;
}

/* Its push is its own again, if it slept. */
void slot_wake(RECORD_OUT(slots), LIST_OUT(touching), RECORD_IN(pushes), int s)
{
	if (touching[TOUCH(s, TOUCHING_ASLEEP)])
		slot_restore(slots, pushes, s, false);
	touching[TOUCH(s, TOUCHING_ASLEEP)] = 0;
}

/* Does what SLEEP_... says with a slot; true if it fell asleep, or woke. */
bool slot_sleep(RECORD_OUT(slots), RECORD_IN(contacts), LIST_OUT(touching), RECORD_IN(grips), LIST_IN(islands), RECORD_IN(pushes), int s, int what,
	bool rub, float length)
{
	bool asleep = touching[TOUCH(s, TOUCHING_ASLEEP)];
	if (what == SLEEP_FORGOTTEN)
		touching[TOUCH(s, TOUCHING_ASLEEP)] = 0;
	else if (asleep && (what == SLEEP_ENDS || !slot_stayed(slots, pushes, s))) {
		slot_wake(slots, touching, pushes, s);
		island_disturb(touching, islands, s);
		if (what == SLEEP_BEGINS)
			slot_come_to_rest(slots, contacts, grips, touching, pushes, s, rub, length);
		return true;
	} else if (!asleep && what == SLEEP_BEGINS && touching[TOUCH(s, TOUCHING_COUNT)] > 0 && !island_is_disturbed(touching, islands, s)) {
		float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
		slots[SLOT_WIDTH * s + SLOT_PUSH] = (float4)(0.0f, 0.0f, 0.0f, push.w);
		touching[TOUCH(s, TOUCHING_ASLEEP)] = 1;
		return true;
	}
	return false;
}
