/* CollisionForward [2.3]: every body moves to the first hit, and the two that meet take the impulse. */

__kernel void forward_collision(STATE_IN, TEX_IN(clock), TEX_IN(impulse), TEX_OUT(new_linear), TEX_OUT(new_rotational), int4 domain)
{
	int i = get_global_id(0);
	float4 l, r, hit = TEX_LOAD(clock, CLOCK_HIT, 0);
	float length = CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH);
	if (i >= domain.x || !(CHANNEL(hit, HIT_TIME) <= 1.0f))
		return;
	body_forward(STATE, i, CHANNEL(hit, HIT_TIME), length, &l, &r);
	float sign = i == (int)CHANNEL(hit, HIT_ROW) ? 1.0f : i == (int)CHANNEL(hit, HIT_COLUMN) ? -1.0f : 0.0f;
	if (sign != 0.0f) {
		float4 j = TEX_LOAD(impulse, IMPULSE_PUSH, 0), g = ROW_LOAD(geometry, i);
		float inverse_mass = 1.0f / CHANNEL(g, GEOMETRY_MASS), inverse_inertia = 1.0f / CHANNEL(g, GEOMETRY_INERTIA);
		float torque = sign > 0.0f ? CHANNEL(j, IMPULSE_TORQUE_A) : CHANNEL(j, IMPULSE_TORQUE_B);
		CHANNEL(l, LINEAR_VX) += (sign * CHANNEL(j, IMPULSE_X)) * inverse_mass;
		CHANNEL(l, LINEAR_VY) += (sign * CHANNEL(j, IMPULSE_Y)) * inverse_mass;
		CHANNEL(r, ROTATIONAL_VELOCITY) += torque * inverse_inertia;
	}
	ROW_STORE(new_linear, i, l);
	ROW_STORE(new_rotational, i, r);
}
