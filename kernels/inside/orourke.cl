/* Is a point strictly inside a polygon? By bisection among the wedges from the first vertex, in O(log n) [2.1, O'Rourke]. */

bool left_of(float2 from, float2 to, float2 point)
{
	return cross2((float2)(to.x - from.x, to.y - from.y), (float2)(point.x - from.x, point.y - from.y)) > 0.0f;
}

bool inside(VERTICES_IN, body k, float2 point)
{
	float2 apex = vertex_load(VERTICES, k.first, 0);
	int low = 1, high = k.count - 1;
	if (!left_of(apex, vertex_load(VERTICES, k.first, low), point))
		return false;
	if (!left_of(vertex_load(VERTICES, k.first, high), apex, point))
		return false;
	while (high - low > 1) {
		int middle = (low + high) >> 1;
		if (left_of(apex, vertex_load(VERTICES, k.first, middle), point))
			low = middle;
		else
			high = middle;
	}
	return left_of(vertex_load(VERTICES, k.first, low), vertex_load(VERTICES, k.first, high), point);
}
