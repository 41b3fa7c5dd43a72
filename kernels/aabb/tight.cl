/* UpdateAABB [2.1]: the box about the updated vertices, over the whole step. */

void enclose(VERTICES_IN, body k, float t, float2 *low, float2 *high)
{
	float2 x = place(k.x, k.v, k.a, t), rotation = body_rotation(k, t);
	for (int j = 0; j < k.count; j++) {
		float2 v = turn(rotation, vertex_load(VERTICES, k.first, j));
		*low = (float2)(smaller(low->x, x.x + v.x), smaller(low->y, x.y + v.y));
		*high = (float2)(larger(high->x, x.x + v.x), larger(high->y, x.y + v.y));
	}
}

void enclose_circle(body k, float t, float2 *low, float2 *high)
{
	float2 x = place(k.x, k.v, k.a, t);
	*low = (float2)(smaller(low->x, x.x - k.radius), smaller(low->y, x.y - k.radius));
	*high = (float2)(larger(high->x, x.x + k.radius), larger(high->y, x.y + k.radius));
}

__kernel void aabb(STATE_IN, VERTICES_IN, TEX_IN(clock), TEX_OUT(aabb), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	body k = body_load(STATE, i, step_length(TEX(uniforms), TEX(clock)));
	float2 low = (float2)(INFINITY, INFINITY), high = (float2)(-INFINITY, -INFINITY);
	for (int end = 0; end < 2; end++) {
		if (k.count == 1)
			enclose_circle(k, (float)end, &low, &high);
		else
			enclose(VERTICES, k, (float)end, &low, &high);
	}
	float pad = aabb_pad(k);
	ROW_STORE(aabb, i, (float4)(low.x - pad, low.y - pad, high.x + pad, high.y + pad));
}
