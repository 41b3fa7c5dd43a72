/* The state as records in slots, one a body, and back; and of some bodies alone, what the host changes and reads. */

__kernel void slots_load(STATE_IN, RECORD_OUT(slots), LIST_OUT(need), LIST_OUT(places), int4 domain)
{
	int i = get_global_id(0);
	if (i < domain.x)
		slot_fill(TEX(uniforms), slots, need, places, i, ROW_LOAD(linear, i), ROW_LOAD(rotational, i), ROW_LOAD(geometry, i), ROW_LOAD(forces, i));
}

/* Behind the others, where its slot is in no list yet. */
__kernel void slots_add(TEX_IN(uniforms), RECORD_IN(changes), RECORD_OUT(slots), LIST_OUT(need), LIST_OUT(places), RECORD_OUT(reach),
	LIST_OUT(status), LIST_OUT(wakes), LIST_OUT(movers), LIST_OUT(spans), LIST_OUT(extra), LIST_OUT(owners), LIST_OUT(parents), int4 domain)
{
	int k = get_global_id(0), s = domain.w + k;
	if (k >= domain.x)
		return;
	RECORD_IN(own) = changes + ADDED_WIDTH * k;
	slot_fill(TEX(uniforms), slots, need, places, s, own[ADDED_LINEAR], own[ADDED_ROTATIONAL], own[ADDED_GEOMETRY], own[ADDED_FORCES]);
	owners[s] = extra[s] = -1;
	parents[s] = s;
	spans[SPAN(s, SPAN_START)] = spans[SPAN(s, SPAN_HALF)] = spans[SPAN(s, SPAN_END)] = 0;
	spans[SPAN(s, SPAN_FOUND)] = FOUND_NONE;
	reach[s] = NO_REACH;
	if (!PEEK(status, STATUS_STALE))
		slot_changed(TEX(uniforms), slots, status, reach, wakes, movers, s, domain.z);
}

/* Bodies go, one after the other, and then the others get their new indices. */
__kernel void slots_remove(RECORD_IN(changes), RECORD_OUT(slots), LIST_OUT(places), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(wakes),
	LIST_OUT(movers), LIST_OUT(spans), LIST_OUT(neighbours), LIST_OUT(extra), int4 domain)
{
	int lane = get_local_id(0), lanes = get_local_size(0), gone = get_group_id(0) == 0 ? domain.z : 0;
	for (int k = 0; k < gone && lane == 0; k++) {
		int s = places[(int)CHANNEL(changes[k], REMOVED_BODY)], last = (int)CHANNEL(changes[k], REMOVED_LAST);
		slot_take_over(slots, places, s, last);
		if (!status[STATUS_STALE])
			lists_let_go(slots, reach, status, wakes, movers, spans, neighbours, extra, s, last, domain.w);
	}
	barrier(CLK_GLOBAL_MEM_FENCE);
	int left = gone > 0 ? (int)CHANNEL(changes[gone - 1], REMOVED_LAST) : 0, each = (left + lanes - 1) / lanes;
	for (int s = each * lane; s < min(each * (lane + 1), left); s++) {
		int i = slot_body(slots, s);
		i -= removed_below(changes, gone, i);
		((__global float *)(slots + SLOT_WIDTH * s + SLOT_PUSH))[PUSH_BODY] = (float)i;
		places[i] = s;
	}
}

__kernel void slots_change(TEX_IN(uniforms), RECORD_IN(changes), LIST_IN(places), RECORD_OUT(slots), RECORD_OUT(reach), LIST_OUT(status),
	LIST_OUT(wakes), LIST_OUT(movers), TEX_OUT(forces), int4 domain)
{
	int k = get_global_id(0);
	if (k >= domain.x)
		return;
	float4 turn_record = changes[CHANGES_WIDTH * k + CHANGES_TURN], f = changes[CHANGES_WIDTH * k + CHANGES_FORCES];
	int i = (int)CHANNEL(turn_record, CHANGE_BODY), s = places[i];
	float4 constants = SLOT_LOAD(slots, s, SLOT_TURN), mass = SLOT_LOAD(slots, s, SLOT_MASS);
	if (CHANNEL(turn_record, CHANGE_MOVES) > 0.0f) {
		slots[SLOT_WIDTH * s + SLOT_PLACE] = changes[CHANGES_WIDTH * k + CHANGES_PLACE];
		slots[SLOT_WIDTH * s + SLOT_TURN] = (float4)(CHANNEL(turn_record, CHANGE_ANGLE), CHANNEL(turn_record, CHANGE_VELOCITY),
			CHANNEL(constants, TURN_RADIUS), CHANNEL(constants, TURN_RESTITUTION));
	}
	slots[SLOT_WIDTH * s + SLOT_PUSH] = push_of(TEX(uniforms), f, CHANNEL(mass, MASS_INVERSE), CHANNEL(mass, MASS_INVERSE_INERTIA), i);
	ROW_STORE(forces, i, f);
	if (!PEEK(status, STATUS_STALE))
		slot_changed(TEX(uniforms), slots, status, reach, wakes, movers, s, domain.z);
}

/* Gravity, or the time step, is another one: of that kinematic bodies, too, get farther. */
__kernel void slots_push(TEX_IN(uniforms), TEX_IN(forces), RECORD_OUT(slots), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(wakes), LIST_OUT(movers),
	int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x || slot_is_static(slots, s))
		return;
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	int i = slot_body(slots, s);
	slots[SLOT_WIDTH * s + SLOT_PUSH] = push_of(TEX(uniforms), ROW_LOAD(forces, i), CHANNEL(mass, MASS_INVERSE), CHANNEL(mass, MASS_INVERSE_INERTIA),
		i);
	if (!PEEK(status, STATUS_STALE))
		slot_changed(TEX(uniforms), slots, status, reach, wakes, movers, s, domain.z);
}

/* Motors, as the host has changed them between two steps; what they turn is disturbed in its sleep. */
__kernel void slots_drive(RECORD_IN(changes), LIST_IN(places), RECORD_OUT(joints), LIST_OUT(touching), LIST_IN(islands), int4 domain)
{
	int k = get_global_id(0);
	if (k >= domain.x)
		return;
	int joint = (int)CHANNEL(changes[k], DRIVEN_JOINT);
	float4 parties = joints[JOINT(joint, JOINT_PARTIES)];
	vstore2(changes[k].yz, 0, (__global float *)(joints + JOINT(joint, JOINT_DRIVE))); /* speed and torque */
	for (int i = 0; i < 2; i++) {
		int body = (int)(i ? CHANNEL(parties, JOINT_OTHER) : CHANNEL(parties, JOINT_BODY));
		if (body >= 0 && touching[TOUCH(places[body], TOUCHING_ASLEEP)])
			island_disturb(touching, islands, places[body]);
	}
}

__kernel void slots_pick(LIST_IN(places), RECORD_IN(slots), RECORD_OUT(changes), int4 domain)
{
	int k = get_global_id(0);
	if (k >= domain.x)
		return;
	int i = domain.z + k, s = places[i];
	float4 r = SLOT_LOAD(slots, s, SLOT_TURN);
	changes[CHANGES_WIDTH * k + CHANGES_PLACE] = SLOT_LOAD(slots, s, SLOT_PLACE);
	changes[CHANGES_WIDTH * k + CHANGES_TURN] = (float4)(CHANNEL(r, TURN_ANGLE), CHANNEL(r, TURN_VELOCITY), (float)i, 1.0f);
}

__kernel void slots_unload(RECORD_IN(slots), LIST_IN(places), TEX_OUT(linear), TEX_OUT(rotational), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	int s = places[i];
	float4 r = SLOT_LOAD(slots, s, SLOT_TURN);
	ROW_STORE(linear, i, SLOT_LOAD(slots, s, SLOT_PLACE));
	ROW_STORE(rotational, i, (float4)(CHANNEL(r, TURN_ANGLE), CHANNEL(r, TURN_VELOCITY), CHANNEL(r, TURN_RADIUS), 0.0f));
}
