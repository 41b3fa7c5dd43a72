/* UpdateAABB [2.1], the cheaper way: the box about the four updated corners of the body's own box. */

__kernel void aabb(STATE_IN, VERTICES_IN, TEX_IN(clock), TEX_OUT(aabb), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	body k = body_load(STATE, i, step_length(TEX(uniforms), TEX(clock)));
	float2 own_low = (float2)(-k.radius, -k.radius), own_high = (float2)(k.radius, k.radius);
	if (k.count > 1) {
		own_low = own_high = vertex_load(VERTICES, k.first, 0);
		for (int j = 1; j < k.count; j++) {
			float2 v = vertex_load(VERTICES, k.first, j);
			own_low = (float2)(smaller(own_low.x, v.x), smaller(own_low.y, v.y));
			own_high = (float2)(larger(own_high.x, v.x), larger(own_high.y, v.y));
		}
	}
	float2 low = (float2)(INFINITY, INFINITY), high = (float2)(-INFINITY, -INFINITY);
	for (int corner = 0; corner < 8; corner++) {
		float t = (corner & 4) ? 1.0f : 0.0f;
		float2 x = place(k.x, k.v, k.a, t), rotation = k.count == 1 ? (float2)(1.0f, 0.0f) : body_rotation(k, t);
		float2 v = turn(rotation, (float2)((corner & 1) ? own_high.x : own_low.x, (corner & 2) ? own_high.y : own_low.y));
		low = (float2)(smaller(low.x, x.x + v.x), smaller(low.y, x.y + v.y));
		high = (float2)(larger(high.x, x.x + v.x), larger(high.y, x.y + v.y));
	}
	float pad = aabb_pad(k);
	ROW_STORE(aabb, i, (float4)(low.x - pad, low.y - pad, high.x + pad, high.y + pad));
}
