/* The state as records in slots, one a body, and back. */

__kernel void slots_load(STATE_IN, RECORD_OUT(slots), LIST_OUT(need), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	float4 r = ROW_LOAD(rotational, i), g = ROW_LOAD(geometry, i), f = ROW_LOAD(forces, i), world = TEX_LOAD(uniforms, UNIFORMS_WORLD, 0);
	float inverse_mass = 1.0f / CHANNEL(g, GEOMETRY_MASS), inverse_inertia = 1.0f / CHANNEL(g, GEOMETRY_INERTIA);
	float4 push = (float4)(0.0f, 0.0f, 0.0f, (float)i);
	if (inverse_mass > 0.0f)
		push = (float4)(CHANNEL(world, WORLD_GRAVITY_X) + CHANNEL(f, FORCES_X) * inverse_mass,
			CHANNEL(world, WORLD_GRAVITY_Y) + CHANNEL(f, FORCES_Y) * inverse_mass, CHANNEL(f, FORCES_TORQUE) * inverse_inertia, (float)i);
	slots[SLOT_WIDTH * i + SLOT_PLACE] = ROW_LOAD(linear, i);
	slots[SLOT_WIDTH * i + SLOT_TURN] = (float4)(CHANNEL(r, ROTATIONAL_ANGLE), CHANNEL(r, ROTATIONAL_VELOCITY), CHANNEL(r, ROTATIONAL_RADIUS),
		CHANNEL(f, FORCES_RESTITUTION));
	slots[SLOT_WIDTH * i + SLOT_MASS] = (float4)(inverse_mass, inverse_inertia, 2.0f * CHANNEL(g, GEOMETRY_FIRST), CHANNEL(g, GEOMETRY_COUNT));
	slots[SLOT_WIDTH * i + SLOT_PUSH] = push;
	need[i] = 0;
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
