/* Bisection1 and Bisection2 [2.1]: a pair that overlaps at the end of the step is halved in time towards its first
 * overlap, `iterations` times a pass. Two polygons overlap where a vertex of one is inside the other. */

bool vertex_inside(VERTICES_IN, body a, body b, pose p)
{
	float2 d = turn_back(p.ra, p.d), relative = relative_rotation(p);
	for (int j = 0; j < b.count; j++) {
		float2 v = turn(relative, vertex_load(VERTICES, b.first, j));
		if (inside(VERTICES, a, (float2)(d.x + v.x, d.y + v.y)))
			return true;
	}
	return false;
}

bool pair_overlaps(VERTICES_IN, body a, body b, float t)
{
	pose p = pose_at(a, b, t);
	if (a.count == 1 && b.count == 1)
		return norm(p.d) < a.radius + b.radius;
	if (a.count == 1 || b.count == 1)
		return best_axis(VERTICES, a, b, p).gap < 0.0f;
	return vertex_inside(VERTICES, a, b, p) || vertex_inside(VERTICES, b, a, pose_swapped(p));
}

bool pair_is_hit(VERTICES_IN, body a, body b, float t)
{
	pose p = pose_at(a, b, t);
	axis k = best_axis(VERTICES, a, b, p);
	float slop = pair_slop(a, b);
	return contact_is_hit(contact_at(VERTICES, a, b, p, k, slop), threshold_of(k.gap, slop, pair_stillness(a, b), 1.0f).rate);
}

float4 bisect(VERTICES_IN, body a, body b, float min_time, float max_time, float4 rules)
{
	int iterations = (int)CHANNEL(rules, RULES_ITERATIONS);
	float epsilon = CHANNEL(rules, RULES_EPSILON);
	for (int i = 0; i < iterations && max_time - min_time > epsilon; i++) {
		float middle = 0.5f * (max_time + min_time);
		if (pair_overlaps(VERTICES, a, b, middle))
			max_time = middle;
		else
			min_time = middle;
	}
	if (max_time - min_time > epsilon)
		return (float4)(min_time, max_time, 0.0f, min_time);
	return pair_is_hit(VERTICES, a, b, min_time) ? (float4)(min_time, max_time, 1.0f, min_time) : hit_none();
}

float4 pair_first(VERTICES_IN, body a, body b, float until, float4 rules)
{
	(void)until;
	if (!(a.inverse_mass > 0.0f) && !(b.inverse_mass > 0.0f))
		return hit_none();
	if (pair_overlaps(VERTICES, a, b, 0.0f))
		return pair_is_hit(VERTICES, a, b, 0.0f) ? hit_at(0.0f) : hit_none();
	if (!pair_overlaps(VERTICES, a, b, 1.0f))
		return hit_none();
	return bisect(VERTICES, a, b, 0.0f, 1.0f, rules);
}

float4 pair_next(STATE_IN, VERTICES_IN, float4 hit, int i, int j, float length)
{
	if (CHANNEL(hit, HITTIMES_DONE) > 0.0f)
		return hit;
	return bisect(VERTICES, body_load(STATE, i, length), body_load(STATE, j, length), CHANNEL(hit, HITTIMES_MIN), CHANNEL(hit, HITTIMES_MAX),
		TEX_LOAD(uniforms, UNIFORMS_RULES, 0));
}

#ifndef CAROM_OUTLINES /* first_impact alone has it */
__kernel void toi_next(STATE_IN, VERTICES_IN, TEX_IN(clock), BYTES_IN(tiles), BYTES_IN(overlap), BYTES_IN(before), TEX_IN(old_hits), TEX_OUT(hits),
	TEX_OUT(tile_hits), int4 domain)
{
	int column = get_global_id(0), row = get_global_id(1);
	if (column >= domain.x || row >= domain.y || column > row)
		return;
	uint state = BYTES_LOAD(tiles, column, row).x;
	if (!(state & (TILES_NOW | TILES_BEFORE)))
		return;
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 first = candidate_none();
	int end = min((row + 1) * TILE, domain.z);
	for (int i = row * TILE; i < end; i++) {
		for (int four = TILE_COLUMNS * column; four < TILE_COLUMNS * (column + 1); four++) {
			uint4 old = overlap_load(TEX(before), (state & TILES_BEFORE) != 0, four, i)
				| overlap_load(TEX(overlap), (state & TILES_NOW) != 0, four, i);
			for (int k = 0; k < OVERLAP_COLUMNS; k++) {
				int j = four * OVERLAP_COLUMNS + k;
				if (!byte_of(old, k))
					continue;
				float4 hit = pair_next(STATE, VERTICES, TEX_LOAD(old_hits, j, i), i, j, length);
				TEX_STORE(hits, j, i, hit);
				first = earlier(first, candidate(hit, j, i));
			}
		}
	}
	TEX_STORE(tile_hits, column, row, first);
}
#endif
