/* The end of a step of events: every body moves there from its last event, or from the step's beginning. */

/* The member's hits came to pass, in the step that the clock has counted last. */
void hits_confirm(TEX_IN(clock), LIST_IN(members), RECORD_OUT(hits), int id, float length)
{
	int first = members[MEMBER(id, MEMBER_KEPT)];
	if (first < 0)
		return;
	float4 time = TEX_LOAD(clock, CLOCK_TIME, 0);
	float step = CHANNEL(TEX_LOAD(clock, CLOCK_COUNTS, 0), COUNTS_STEPS);
	for (int k = first; k >= 0; k = (int)CHANNEL(hits[HITS_WIDTH * k + HITS_WHAT], WHAT_LINK))
		hits[HITS_WIDTH * k + HITS_WHEN] = (float4)(CHANNEL(time, TIME_ELAPSED), CHANNEL(time, TIME_ELAPSED_LOW), length, step);
}

/* A velocity as a step of that length ends; what hardly moves stops, for devices may have no smaller numbers. */
float damped(float velocity, float damping, float length)
{
	float slower = velocity / (1.0f + damping * length);
	return damping > 0.0f && fabs(slower) < STILL_LEAST ? 0.0f : slower;
}

void damp(TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), int s, trajectory *k, float length)
{
	if (!(CHANNEL(TEX_LOAD(uniforms, UNIFORMS_RUBS, 0), RUBS_DAMPS) > 0.0f))
		return;
	float4 own = ROW_LOAD(friction, slot_body(slots, s));
	CHANNEL(k->place, LINEAR_VX) = damped(CHANNEL(k->place, LINEAR_VX), CHANNEL(own, FRICTION_LINEAR_DAMPING), length);
	CHANNEL(k->place, LINEAR_VY) = damped(CHANNEL(k->place, LINEAR_VY), CHANNEL(own, FRICTION_LINEAR_DAMPING), length);
	k->velocity = damped(k->velocity, CHANNEL(own, FRICTION_ANGULAR_DAMPING), length);
}

__kernel void drift(TEX_IN(uniforms), TEX_IN(clock), RECORD_OUT(slots), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(members), RECORD_IN(work),
	LIST_OUT(owners), LIST_OUT(parents), LIST_OUT(spans), LIST_OUT(wakes), LIST_OUT(movers), RECORD_OUT(hits), TEX_IN(friction), int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x || !(status[STATUS_COMMIT] || status[STATUS_LEFT]))
		return;
	if (s == 0 && status[STATUS_COMMIT])
		status[STATUS_PASS] = 0;
	int id = owners[s];
	float length = CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH);
	if (status[STATUS_COMMIT] && !slot_is_static(slots, s)) {
		float4 constants = SLOT_LOAD(slots, s, SLOT_TURN);
		trajectory k = moved(slots, s, id >= 0 ? work_load(work, id) : trajectory_start(slots, s), 1.0f, length);
		damp(TEX(uniforms), TEX(friction), slots, s, &k, length);
		slots[SLOT_WIDTH * s + SLOT_PLACE] = k.place;
		slots[SLOT_WIDTH * s + SLOT_TURN] = (float4)(k.angle, k.velocity, CHANNEL(constants, TURN_RADIUS), CHANNEL(constants, TURN_RESTITUTION));
		reach_keep(TEX(uniforms), slots, reach, status, wakes, movers, s, domain.z);
	}
	if (id >= 0) {
		if (status[STATUS_COMMIT])
			hits_confirm(TEX(clock), members, hits, id, length);
		if (members[MEMBER(id, MEMBER_EVENTS)] > 0)
			wakes[WAKE(s, WAKE_CHANGED)] = CHANGED_IN(status[STATUS_AGE]);
		else /* it has not looked how it goes on */
			wakes[WAKE(s, WAKE_NEXT)] = status[STATUS_AGE];
		member_reset(members, id);
		owners[s] = -1;
		parents[s] = s;
		spans[SPAN(s, SPAN_FOUND)] = FOUND_NONE;
	}
}
