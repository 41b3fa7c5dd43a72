/* Is a point strictly inside a polygon? Every half-plane is asked [2.1]. */

bool inside(VERTICES_IN, body k, float2 point)
{
	float2 from = vertex_load(VERTICES, k.first, k.count - 1);
	for (int j = 0; j < k.count; j++) {
		float2 to = vertex_load(VERTICES, k.first, j);
		float2 edge = (float2)(to.x - from.x, to.y - from.y);
		if (!(cross2(edge, (float2)(point.x - from.x, point.y - from.y)) > 0.0f))
			return false;
		from = to;
	}
	return true;
}
