/* The end of a step of events: every body moves there from its last event, or from the step's beginning. */

/* Might the body leave its reach in the next step? */
bool leaves_reach(TEX_IN(uniforms), RECORD_IN(slots), LIST_IN(status), float4 box, int s, float4 at)
{
	float step = CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP);
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
	float speed = norm((float2)(CHANNEL(at, LINEAR_VX), CHANNEL(at, LINEAR_VY)))
		+ norm((float2)(CHANNEL(push, PUSH_X), CHANNEL(push, PUSH_Y))) * step;
	float common = as_float(status[STATUS_PACE]) * (step / as_float(status[STATUS_WINDOW]));
	float way = larger(REACH_FACTOR * speed * step, DRIFT_FACTOR * common) + CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS);
	float x = CHANNEL(at, LINEAR_X), y = CHANNEL(at, LINEAR_Y);
	return x - way < CHANNEL(box, AABB_MIN_X) || y - way < CHANNEL(box, AABB_MIN_Y) || x + way > CHANNEL(box, AABB_MAX_X)
		|| y + way > CHANNEL(box, AABB_MAX_Y);
}

__kernel void forward_drift(TEX_IN(uniforms), TEX_IN(clock), RECORD_OUT(slots), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(members),
	RECORD_IN(work), LIST_OUT(owners), LIST_OUT(parents), LIST_OUT(spans), LIST_OUT(wakes), LIST_OUT(movers), int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x || !(status[STATUS_COMMIT] || status[STATUS_LEFT]))
		return;
	int id = owners[s];
	float length = CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH);
	if (status[STATUS_COMMIT] && !slot_is_static(slots, s)) {
		float4 constants = SLOT_LOAD(slots, s, SLOT_TURN);
		trajectory k = moved(slots, s, id >= 0 ? work_load(work, id) : trajectory_start(slots, s), 1.0f, length);
		slots[SLOT_WIDTH * s + SLOT_PLACE] = k.place;
		slots[SLOT_WIDTH * s + SLOT_TURN] = (float4)(k.angle, k.velocity, CHANNEL(constants, TURN_RADIUS), CHANNEL(constants, TURN_RESTITUTION));
		if (leaves_reach(TEX(uniforms), slots, status, reach[s], s, k.place)) {
			int mover = atomic_inc(&status[STATUS_MOVERS]);
			if (mover < domain.z)
				movers[mover] = s;
			else
				atomic_or(&status[STATUS_STALE], 1);
			reach[s] = reach_about(slots, s, 0.0f, status);
			wakes[WAKE(s, WAKE_CHANGED)] = wakes[WAKE(s, WAKE_NEXT)] = status[STATUS_AGE];
		}
	}
	if (id >= 0) {
		/* one that no event changed has not looked how it goes on */
		wakes[WAKE(s, members[MEMBER(id, MEMBER_EVENTS)] > 0 ? WAKE_CHANGED : WAKE_NEXT)] = status[STATUS_AGE];
		member_reset(members, id);
		owners[s] = -1;
		parents[s] = s;
		spans[SPAN(s, SPAN_FOUND)] = FOUND_NONE;
	}
}
