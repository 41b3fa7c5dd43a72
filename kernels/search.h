/* The search for the first hit of two bodies within a step, as texels of HitTimes. */

float4 hit_none(void)
{
	return (float4)(0.0f, 1.0f, 1.0f, NO_HIT);
}

float4 hit_at(float t)
{
	return (float4)(t, t, 1.0f, t);
}

/* The search was not finished: the step ends at t, and the next one goes on from there. */
float4 hit_pause(float t)
{
	return (float4)(t, t, 0.0f, t);
}

/* How long from time t on the bodies surely stay apart by a margin: each vertex of the incident body has a distance from the axis
 * that is at least gap + rate s - bend s^2 / 2. */
float safe_time(VERTICES_IN, body a, body b, pose p, axis k, float t, float margin)
{
	float2 acceleration = (float2)(b.a.x - a.a.x, b.a.y - a.a.y);
	float rest = 1.0f - t;
	if (k.swapped) {
		body other = a;
		a = b;
		b = other;
		p = pose_swapped(p);
	}
	float2 m = turn_back(relative_rotation(p), k.n), n = turn(p.ra, k.n);
	float push = norm(acceleration), speed = norm(p.v) + push * rest, reach = norm(p.d) + speed * rest;
	/* That circles turn changes no distance. */
	float wa = a.count == 1 ? 0.0f : p.wa, wb = b.count == 1 ? wa : p.wb, twist = a.count == 1 ? 0.0f : a.b, other_twist = b.count == 1 ? twist : b.b;
	float spin = magnitude(wa) + magnitude(twist) * rest, turning = magnitude(wa - wb) + magnitude(twist - other_twist) * rest;
	float bend = (((turning * turning) * b.radius + (spin * spin) * reach) + (2.0f * spin) * speed)
		+ ((push + magnitude(twist) * reach) + magnitude(twist - other_twist) * b.radius);
	float base = inner(n, p.d) - k.offset, rate = inner(n, p.v) + wa * cross2(n, p.d);
	if (b.count == 1)
		return first_root(larger((base - b.radius) - margin, 0.0f), rate, bend);
	float least = INFINITY;
	for (int j = 0; j < b.count; j++) {
		float2 v = vertex_load(VERTICES, b.first, j);
		float gap = larger((base + inner(m, v)) - margin, 0.0f);
		least = smaller(least, first_root(gap, rate + (wa - wb) * cross2(m, v), bend));
	}
	return least;
}

/* When the centres of two bodies come within reach of each other, without pushes. */
float centres_near(body a, body b, float reach)
{
	float2 d = (float2)(b.x.x - a.x.x, b.x.y - a.x.y), v = (float2)(b.v.x - a.v.x, b.v.y - a.v.y);
	float way = norm(d) - reach, x = cross2(d, v), approach = inner(d, v), under = (reach * reach) * inner(v, v) - x * x;
	if (way <= 0.0f)
		return 0.0f;
	if (approach >= 0.0f || under < 0.0f)
		return INFINITY;
	return (way * (norm(d) + reach)) / (sqrt(under) - approach);
}

/* When the circles about two bodies can touch at the earliest: a bound that skips most of a fast body's way. */
float circles_touch(body a, body b, float slop)
{
	float push = norm((float2)(b.a.x - a.a.x, b.a.y - a.a.y)), reach = (a.radius + b.radius) + slop;
	if (!(push > 0.0f))
		return centres_near(a, b, reach);
	float way = norm((float2)(b.x.x - a.x.x, b.x.y - a.x.y)) - reach;
	return way <= 0.0f ? 0.0f : way / (norm((float2)(b.v.x - a.v.x, b.v.y - a.v.y)) + push);
}

/* Nearer to that where pushes differ: no hit and no pause is before. */
float circles_meet(body a, body b, float slop)
{
	return centres_near(a, b, ((a.radius + b.radius) + slop) + 0.5f * norm((float2)(b.a.x - a.a.x, b.a.y - a.a.y)));
}

/* Do two bodies that touch hit each other? */
bool axis_hits(VERTICES_IN, body a, body b, pose p, axis k, float slop, float stillness)
{
	contact c = contact_at(VERTICES, a, b, p, k, slop);
	if (!contact_is_hit(c, threshold_of(k.gap, slop, stillness, 1.0f).rate))
		return false;
	return way_hits(VERTICES, a, b, p, k, corner_way(VERTICES, a, b, p, k, c, slop), slop, stillness, 1.0f);
}

/* Conservative advancement: from one time at which the bodies are surely still apart to the next, until they touch, or that is not asked for any more. */
SELDOM float4 search_separating(VERTICES_IN, body a, body b, float until)
{
	float slop = pair_slop(a, b), stillness = pair_stillness(a, b);
	float t = circles_touch(a, b, slop), creep = 0.0f;
	if (t <= until && polygons_stay_apart(VERTICES, a, b, t, until, slop))
		return hit_none();
	for (int i = 0; i < 2 * SEARCH_LIMIT; i++) {
		if (i == SEARCH_LIMIT) {
			float meet = circles_meet(a, b, slop);
			if (!(smaller(t, 1.0f) < meet))
				break;
			t = meet;
		}
		if (!(t <= until))
			return hit_none();
		pose p = pose_at(a, b, t);
		axis k = best_axis(VERTICES, a, b, p);
		bool touching = k.gap <= slop;
		if (touching && axis_hits(VERTICES, a, b, p, k, slop, stillness))
			return hit_at(t);
		float safe = safe_time(VERTICES, a, b, p, k, t, (touching ? -MARGIN : MARGIN) * slop);
		if (touching)
			creep = creep_time(creep, slop, stillness);
		t = t + (touching ? larger(safe, creep) : safe);
	}
	return hit_pause(smaller(t, 1.0f));
}

/* The hit time of two circles without relative acceleration [4.1]: the first root of |d + t v| = ra + rb. */
float4 search_circles(body a, body b)
{
	float2 d = (float2)(b.x.x - a.x.x, b.x.y - a.x.y), v = (float2)(b.v.x - a.v.x, b.v.y - a.v.y);
	float reach = a.radius + b.radius, distance = norm(d), approach = inner(d, v);
	float gap = (distance - reach) * (distance + reach), slop = pair_slop(a, b), stillness = pair_stillness(a, b);
	if (gap <= 0.0f)
		return approach < threshold_of(distance - reach, slop, stillness, 1.0f).rate * distance ? hit_at(0.0f) : hit_none();
	float x = cross2(d, v), under = (reach * reach) * inner(v, v) - x * x;
	/* the root of `under` is the speed of approach at the hit, times reach */
	if (approach >= 0.0f || under <= 0.0f || sqrt(under) <= stillness * reach)
		return hit_none();
	float t = gap / (sqrt(under) - approach);
	return t <= 1.0f ? hit_at(t) : hit_none();
}

/* Of each alternative of the slot toi: a texel of HitTimes for two bodies [2.1, Bisection1]. Hits later than `until`, at most 1, need not be found. */
float4 pair_first(VERTICES_IN, body a, body b, float until, float4 rules);
