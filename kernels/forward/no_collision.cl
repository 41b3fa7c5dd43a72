/* NoCollisionForward [2.3]: nothing was hit, and every body moves to the end of the step. */

__kernel void forward_no_collision(STATE_IN, TEX_IN(clock), TEX_OUT(new_linear), TEX_OUT(new_rotational), int4 domain)
{
	int i = get_global_id(0);
	float4 l, r, hit = TEX_LOAD(clock, CLOCK_HIT, 0);
	float length = CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH);
	if (i >= domain.x || CHANNEL(hit, HIT_TIME) <= 1.0f)
		return;
	if (length > 0.0f) {
		body_forward(STATE, i, 1.0f, length, &l, &r);
	} else {
		l = ROW_LOAD(linear, i);
		r = ROW_LOAD(rotational, i);
	}
	ROW_STORE(new_linear, i, l);
	ROW_STORE(new_rotational, i, r);
}
