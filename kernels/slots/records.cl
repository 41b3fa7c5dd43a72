/* The state as records in slots, one a body, and back; and of some bodies alone, what the host changes and reads. */

/* A body's push, from its texel of Forces. */
float4 push_of(TEX_IN(uniforms), float4 f, float inverse_mass, float inverse_inertia, int i)
{
	float4 world = TEX_LOAD(uniforms, UNIFORMS_WORLD, 0);
	if (!(inverse_mass > 0.0f))
		return (float4)(0.0f, 0.0f, 0.0f, (float)i);
	return (float4)(CHANNEL(world, WORLD_GRAVITY_X) + CHANNEL(f, FORCES_X) * inverse_mass,
		CHANNEL(world, WORLD_GRAVITY_Y) + CHANNEL(f, FORCES_Y) * inverse_mass, CHANNEL(f, FORCES_TORQUE) * inverse_inertia, (float)i);
}

__kernel void slots_load(STATE_IN, RECORD_OUT(slots), LIST_OUT(need), LIST_OUT(places), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	float4 r = ROW_LOAD(rotational, i), g = ROW_LOAD(geometry, i), f = ROW_LOAD(forces, i);
	float inverse_mass = 1.0f / CHANNEL(g, GEOMETRY_MASS), inverse_inertia = 1.0f / CHANNEL(g, GEOMETRY_INERTIA);
	slots[SLOT_WIDTH * i + SLOT_PLACE] = ROW_LOAD(linear, i);
	slots[SLOT_WIDTH * i + SLOT_TURN] = (float4)(CHANNEL(r, ROTATIONAL_ANGLE), CHANNEL(r, ROTATIONAL_VELOCITY), CHANNEL(r, ROTATIONAL_RADIUS),
		CHANNEL(f, FORCES_RESTITUTION));
	slots[SLOT_WIDTH * i + SLOT_MASS] = (float4)(inverse_mass, inverse_inertia, 2.0f * CHANNEL(g, GEOMETRY_FIRST), CHANNEL(g, GEOMETRY_COUNT));
	slots[SLOT_WIDTH * i + SLOT_PUSH] = push_of(TEX(uniforms), f, inverse_mass, inverse_inertia, i);
	need[i] = 0;
	places[i] = i;
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

__kernel void slots_unload(RECORD_IN(slots), TEX_OUT(linear), TEX_OUT(rotational), int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x)
		return;
	int i = slot_body(slots, s);
	float4 r = SLOT_LOAD(slots, s, SLOT_TURN);
	ROW_STORE(linear, i, SLOT_LOAD(slots, s, SLOT_PLACE));
	ROW_STORE(rotational, i, (float4)(CHANNEL(r, TURN_ANGLE), CHANNEL(r, TURN_VELOCITY), CHANNEL(r, TURN_RADIUS), 0.0f));
}
