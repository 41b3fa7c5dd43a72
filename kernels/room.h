/* The room: four half-planes that nothing leaves, met like static bodies [4.1, 4.2]. */

/* Inward normal of wall 0..3 (x = min, y = min, x = max, y = max); *offset: what n . x is on the wall. */
float2 wall_normal(float4 room, int wall, float *offset)
{
	switch (wall) {
	case 0: *offset = CHANNEL(room, ROOM_MIN_X); return (float2)(1.0f, 0.0f);
	case 1: *offset = CHANNEL(room, ROOM_MIN_Y); return (float2)(0.0f, 1.0f);
	case 2: *offset = -CHANNEL(room, ROOM_MAX_X); return (float2)(-1.0f, 0.0f);
	default: *offset = -CHANNEL(room, ROOM_MAX_Y); return (float2)(0.0f, -1.0f);
	}
}

float wall_slop(body k)
{
	return (larger(magnitude(k.x.x), magnitude(k.x.y)) + k.radius) * SLOP;
}

float wall_stillness(body k)
{
	return ((span(k.v) + span(k.a)) + (magnitude(k.w) + magnitude(k.b)) * k.radius) * APPROACH + STILL;
}

/* How far the body is from a wall at time t. */
float wall_gap(VERTICES_IN, body k, float2 n, float offset, float t)
{
	int deepest;
	return (inner(n, place(k.x, k.v, k.a, t)) - offset) + lowest(VERTICES, k, turn_back(body_rotation(k, t), n), &deepest);
}

/* Where polygon k touches a wall at time t: the outermost of the vertices that are hardly farther in than the deepest. */
contact wall_contact(VERTICES_IN, body k, float2 n, float t, float slop)
{
	contact c;
	float2 v = (float2)(k.v.x + t * k.a.x, k.v.y + t * k.a.y);
	float w = k.w + t * k.b;
	c.n = n;
	c.swapped = false;
	c.count = 1;
	c.ref[0] = c.ref[1] = c.inc[0] = c.inc[1] = (float2)(0.0f, 0.0f);
	c.rate[0] = c.rate[1] = inner(n, v);
	if (k.count == 1)
		return c;
	float2 rotation = body_rotation(k, t), m = turn_back(rotation, n);
	int deepest;
	float limit = lowest(VERTICES, k, m, &deepest) + slop, first = INFINITY, last = -INFINITY;
	for (int j = 0; j < k.count; j++) {
		float2 local_vertex = vertex_load(VERTICES, k.first, j);
		float along = cross2(m, local_vertex);
		if (inner(m, local_vertex) > limit)
			continue;
		if (along < first) {
			first = along;
			c.inc[0] = turn(rotation, local_vertex);
		}
		if (along > last) {
			last = along;
			c.inc[1] = turn(rotation, local_vertex);
		}
	}
	c.count = first < last ? 2 : 1;
	c.rate[0] = inner(n, v) - w * cross2(n, c.inc[0]);
	c.rate[1] = inner(n, v) - w * cross2(n, c.inc[1]);
	return c;
}

/* The alternative's own of slot walls: when the body hits the wall, in parts of its step; not <= 1 if it doesn't. */
float circle_wall(body k, float2 n, float offset);
float polygon_wall(VERTICES_IN, body k, float2 n, float offset, float *done);
