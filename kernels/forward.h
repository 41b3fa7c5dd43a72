/* What NoCollisionForward and CollisionForward share [2.3]: bodies are moved to part t of the step. */

/* The velocities at part t of the step, and the new position and angle; the radius rides along. */
void body_forward(STATE_IN, int i, float t, float length, float4 *l, float4 *r)
{
	float4 old = ROW_LOAD(rotational, i), old_linear = ROW_LOAD(linear, i);
	body k = body_load(STATE, i, length);
	float2 x = place(k.x, k.v, k.a, t);
	float scale = t / length;
	*l = (float4)(x.x, x.y, CHANNEL(old_linear, LINEAR_VX) + scale * k.a.x, CHANNEL(old_linear, LINEAR_VY) + scale * k.a.y);
	*r = (float4)(wrapped(place1(k.r, k.w, k.b, t)), CHANNEL(old, ROTATIONAL_VELOCITY) + scale * k.b, k.radius, 0.0f);
	if (!(k.inverse_mass > 0.0f) && k.v.x == 0.0f && k.v.y == 0.0f && k.w == 0.0f) { /* a static body is copied */
		*l = old_linear;
		*r = old;
	}
}
