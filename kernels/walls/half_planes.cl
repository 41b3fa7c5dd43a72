/* The first hit of each body with the room's walls; a work-item does a group of bodies. */

/* A circle's hit with one wall is a root of a quadratic: exact, with and without gravity. */
float circle_wall(body k, float2 n, float offset)
{
	float rate = inner(n, k.v), push = inner(n, k.a), stillness = wall_stillness(k), gap = (inner(n, k.x) - offset) - k.radius;
	float t = first_root(larger(gap, 0.0f), rate, -push);
	threshold h = threshold_of(gap, wall_slop(k), stillness, 1.0f);
	if (h.sunk && rate < h.rate)
		return 0.0f;
	/* too slow an approach is none; it becomes one when the push has made it faster */
	if (t <= 1.0f && rate + t * push >= -stillness)
		t = push < 0.0f ? larger(t, (-stillness - rate) / push) : INFINITY;
	return t;
}

float wall_safe_time(VERTICES_IN, body k, float2 n, float offset, float t, float margin)
{
	float rest = 1.0f - t, spin = magnitude(k.w + t * k.b) + magnitude(k.b) * rest;
	float bend = ((spin * spin) * k.radius + larger(-inner(n, k.a), 0.0f)) + magnitude(k.b) * k.radius;
	float2 x = place(k.x, k.v, k.a, t), m = turn_back(body_rotation(k, t), n);
	float2 v = (float2)(k.v.x + t * k.a.x, k.v.y + t * k.a.y);
	float base = inner(n, x) - offset, rate = inner(n, v), w = k.w + t * k.b, least = INFINITY;
	for (int j = 0; j < k.count; j++) {
		float2 p = vertex_load(VERTICES, k.first, j);
		float gap = larger((base + inner(m, p)) - margin, 0.0f);
		least = smaller(least, first_root(gap, rate - w * cross2(m, p), bend));
	}
	return least;
}

/* As for pairs: conservative advancement. *done is 0 if the search was not finished. */
SELDOM float polygon_wall(VERTICES_IN, body k, float2 n, float offset, float *done)
{
	float slop = wall_slop(k), stillness = wall_stillness(k), creep = 0.0f, way = ((inner(n, k.x) - offset) - k.radius) - slop;
	float t = way > 0.0f ? first_root(way, inner(n, k.v), -inner(n, k.a)) : 0.0f; /* the circle about it gets there */
	for (int i = 0; i < SEARCH_LIMIT; i++) {
		if (!(t <= 1.0f))
			return INFINITY;
		float gap = wall_gap(VERTICES, k, n, offset, t);
		bool touching = gap <= slop;
		if (touching && contact_is_hit(wall_contact(VERTICES, k, n, t, slop), threshold_of(gap, slop, stillness, 1.0f).rate))
			return t;
		float safe = wall_safe_time(VERTICES, k, n, offset, t, (touching ? -MARGIN : MARGIN) * slop);
		if (touching)
			creep = creep_time(creep, slop, stillness);
		t = t + (touching ? larger(safe, creep) : safe);
	}
	*done = 0.0f;
	return smaller(t, 1.0f);
}

#ifndef CAROM_OUTLINES /* first_impact alone has it */
__kernel void walls(STATE_IN, VERTICES_IN, TEX_IN(clock), TEX_OUT(walls), int4 domain)
{
	int group = get_global_id(0), count = domain.z;
	if (group >= domain.x)
		return;
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0), rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	float4 first = (float4)(NO_HIT, 0.0f, 0.0f, 1.0f);
	int end = CHANNEL(rules, RULES_HAS_ROOM) > 0.0f ? min((group + 1) * WALLS_GROUP, count) : 0;
	for (int i = group * WALLS_GROUP; i < end; i++) {
		body k = body_load(STATE, i, length);
		if (!(k.inverse_mass > 0.0f))
			continue;
		for (int wall = 0; wall < 4; wall++) {
			float offset, done = 1.0f;
			float2 n = wall_normal(room, wall, &offset);
			float t = k.count == 1 ? circle_wall(k, n, offset) : polygon_wall(VERTICES, k, n, offset, &done);
			if (t <= 1.0f && t < CHANNEL(first, WALLS_HIT))
				first = (float4)(t, (float)i, (float)wall, done);
		}
	}
	ROW_STORE(walls, group, first);
}
#endif
