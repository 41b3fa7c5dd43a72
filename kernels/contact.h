/* Where two convex bodies touch at one time, and whether that is a hit. */

typedef struct contact {
	float2 n; /* from the reference to the incident body, world directions */
	bool swapped;
	int count;             /* of points */
	float2 ref[2], inc[2]; /* levers: the points from the two bodies' centres; of a circle 0, where its normal passes */
	float rate[2];         /* the speed at which they part, along n */
} contact;

/* How fast the point at `ref` from the reference's centre and `inc` from the incident body's parts, along n. */
float parting_rate(pose p, float2 n, float2 ref, float2 inc)
{
	return (inner(n, p.v) + p.wa * cross2(n, ref)) - p.wb * cross2(n, inc);
}

void contact_add(contact *c, pose p, float2 ref, float2 inc)
{
	c->ref[c->count] = ref;
	c->inc[c->count] = inc;
	c->rate[c->count] = parting_rate(p, c->n, ref, inc);
	c->count++;
}

/* The point is given in a's frame. */
void contact_add_point(contact *c, pose p, float2 point)
{
	float2 ref = turn(p.ra, point);
	contact_add(c, p, ref, (float2)(ref.x - p.d.x, ref.y - p.d.y));
}

/* The edge of b at its deepest vertex that lies flattest on the face, cut to the face's width: its ends that touch. */
void contact_face(VERTICES_IN, body a, body b, pose p, axis k, float slop, contact *c)
{
	float2 relative = relative_rotation(p), d = turn_back(p.ra, p.d);
	float2 m = turn_back(relative, k.n);
	float2 before = vertex_load(VERTICES, b.first, k.deepest > 0 ? k.deepest - 1 : b.count - 1);
	float2 middle = vertex_load(VERTICES, b.first, k.deepest);
	float2 after = vertex_load(VERTICES, b.first, k.deepest + 1 < b.count ? k.deepest + 1 : 0);
	float2 e1 = (float2)(middle.x - before.x, middle.y - before.y), e2 = (float2)(after.x - middle.x, after.y - middle.y);
	bool second = magnitude(inner(m, e2)) * norm(e1) < magnitude(inner(m, e1)) * norm(e2);
	float2 v = turn(relative, second ? middle : before), u = turn(relative, second ? after : middle);
	v = (float2)(v.x + d.x, v.y + d.y);
	u = (float2)(u.x + d.x, u.y + d.y);

	float2 from = vertex_load(VERTICES, a.first, k.face);
	float2 to = vertex_load(VERTICES, a.first, k.face + 1 < a.count ? k.face + 1 : 0);
	float2 tangent = (float2)(-k.n.y, k.n.x);
	float width = inner(tangent, (float2)(to.x - from.x, to.y - from.y));
	/* counter-clockwise edges run against each other: u comes first along the face */
	float start = inner(tangent, (float2)(u.x - from.x, u.y - from.y)), end = inner(tangent, (float2)(v.x - from.x, v.y - from.y));
	if (end < start) {
		float2 w = u;
		float s = start;
		u = v;
		v = w;
		start = end;
		end = s;
	}
	float2 low = u, high = v;
	if (start < 0.0f && end >= 0.0f) {
		float part = -start / (end - start);
		low = (float2)(u.x + part * (v.x - u.x), u.y + part * (v.y - u.y));
	}
	if (end > width && start <= width) {
		float part = (width - start) / (end - start);
		high = (float2)(u.x + part * (v.x - u.x), u.y + part * (v.y - u.y));
	}
	float low_gap = inner(k.n, low) - k.offset, high_gap = inner(k.n, high) - k.offset;
	float limit = k.gap + slop;
	/* of one that lies beside the face only the end that is nearer to it */
	if (!(end < 0.0f) && low_gap <= limit)
		contact_add_point(c, p, low);
	if (!(start > width) && high_gap <= limit)
		contact_add_point(c, p, high);
	if (c->count == 0) {
		float2 point = turn(relative, middle);
		contact_add_point(c, p, (float2)(point.x + d.x, point.y + d.y));
	}
}

/* Where the bodies touch, or would if they were a little nearer: one point, or the two ends of a face contact. */
contact contact_at(VERTICES_IN, body a, body b, pose p, axis k, float slop)
{
	contact c;
	if (k.swapped) {
		body t = a;
		a = b;
		b = t;
		p = pose_swapped(p);
	}
	c.n = turn(p.ra, k.n);
	c.swapped = k.swapped;
	c.count = 0;
	c.ref[1] = c.inc[1] = (float2)(0.0f, 0.0f);
	c.rate[1] = 0.0f;
	if (b.count == 1) {
		float2 rim = (float2)(p.d.x - b.radius * c.n.x, p.d.y - b.radius * c.n.y);
		contact_add(&c, p, a.count == 1 ? (float2)(0.0f, 0.0f) : rim, (float2)(0.0f, 0.0f));
	} else if (k.corner) {
		float2 v = turn(p.rb, vertex_load(VERTICES, b.first, k.deepest));
		contact_add(&c, p, (float2)(p.d.x + v.x, p.d.y + v.y), v);
	} else {
		contact_face(VERTICES, a, b, p, k, slop, &c);
	}
	return c;
}

/* How near is touching: eight units in the last place of the coordinates. */
float pair_slop(body a, body b)
{
	float x = larger(larger(magnitude(a.x.x), magnitude(a.x.y)), larger(magnitude(b.x.x), magnitude(b.x.y)));
	return (x + (a.radius + b.radius)) * SLOP;
}

/* How slow an approach is none: what rounding hides in the velocities. */
float pair_stillness(body a, body b)
{
	float linear_speed = (span(a.v) + span(a.a)) + (span(b.v) + span(b.a));
	float turning = (magnitude(a.w) + magnitude(a.b)) * a.radius + (magnitude(b.w) + magnitude(b.b)) * b.radius;
	return (linear_speed + turning) * APPROACH + STILL;
}

/* How long to go on, at least, from a contact that does not approach: from the first no farther than the slop at the bodies' speeds; from the next, after
 * `before`, longer, so that a search comes to its end. */
float creep_time(float before, float slop, float stillness)
{
	if (before > 0.0f)
		return before < CREEP_SHORT ? smaller(before + before, CREEP_SHORT) : before;
	return smaller(CREEP_MOST, (slop * APPROACH) / stillness);
}

/* What makes a touch a hit. */
typedef struct threshold {
	bool sunk;  /* by rounding, into each other */
	float rate; /* a point with less is hit */
	float
		mended; /* the least speed at which it parts then: of what is sunk a slop a step, eight units in the last place, where rounding spoils one or two */
} threshold;

/* What was found to be a hit is one, whatever rounding did since: `part` is 1 to find it, less to answer it. */
threshold threshold_of(float gap, float slop, float stillness, float part)
{
	threshold h;
	h.sunk = gap < -(part * slop) && gap > -((2.0f - part) * (SUNK_MOST * slop));
	h.rate = h.sunk ? (2.0f - part) * (SUNK_RATE * slop) : -(part * stillness);
	h.mended = h.sunk ? larger(slop, 4.0f * stillness) : 0.0f;
	return h;
}

bool contact_is_hit(contact c, float most)
{
	return c.rate[0] < most || (c.count > 1 && c.rate[1] < most);
}

/* Of the faster point. */
float rate_of(contact c)
{
	return c.count > 1 ? smaller(c.rate[0], c.rate[1]) : c.rate[0];
}

/* Are all points of a contact where the reference's face ends, or beyond; or is it one of a corner? */
bool contact_is_at_corner(VERTICES_IN, body a, body b, pose p, axis k, contact c, float near)
{
	if (k.corner)
		return true;
	body ref = k.swapped ? b : a;
	float2 tangent = (float2)(-c.n.y, c.n.x), rotation = k.swapped ? p.rb : p.ra;
	float begin = inner(tangent, turn(rotation, vertex_load(VERTICES, ref.first, k.face))) + near;
	float end = inner(tangent, turn(rotation, vertex_load(VERTICES, ref.first, k.face + 1 < ref.count ? k.face + 1 : 0))) - near;
	float first = inner(tangent, c.ref[0]), second = c.count > 1 ? inner(tangent, c.ref[1]) : first;
	return (first <= begin && second <= begin) || (first >= end && second >= end);
}

/* The way along which the bodies approach the most slowly, of `*way` and those faces of a along which they touch, or are less than `deep` in each other; `*rate` is how fast. */
void way_seek(VERTICES_IN, body a, body b, pose p, float2 n, float alike, float slop, float deep, bool swapped, axis *way, float *rate)
{
	float2 d = turn_back(p.ra, p.d), relative = relative_rotation(p);
	for (int e = 0; e < a.count; e++) {
		axis k;
		k.n = normal_load(VERTICES, a.first, e, vertex_load(VERTICES, a.first, e + 1 < a.count ? e + 1 : 0));
		k.offset = inner(k.n, vertex_load(VERTICES, a.first, e));
		k.gap = (inner(k.n, d) - k.offset) + lowest(VERTICES, b, turn_back(relative, k.n), &k.deepest);
		if (k.gap < -deep || magnitude(inner(turn(p.ra, k.n), n)) > alike)
			continue;
		k.face = e;
		k.corner = k.swapped = false;
		float other = rate_of(contact_at(VERTICES, a, b, p, k, slop));
		k.swapped = swapped;
		if (other > *rate) {
			*rate = other;
			*way = k;
		}
	}
}

/* Where corners meet rounding alone says which way out is the least deep, and what slides over a flush seam would hit the side of the next body: there the way counts along which
 * the bodies approach the most slowly, if that is less than half as fast. */
axis corner_way(VERTICES_IN, body a, body b, pose p, axis k, contact c, float slop)
{
	float deep = CORNER_DEEP * slop, rate = CORNER_PART * rate_of(c), alike = k.corner ? 2.0f : CORNER_ALIKE;
	axis way = k;
	if (a.count == 1 || b.count == 1 || !(rate < 0.0f) || k.gap < -deep || !contact_is_at_corner(VERTICES, a, b, p, k, c, CORNER_NEAR * deep))
		return k;
	way_seek(VERTICES, a, b, p, c.n, alike, slop, deep, false, &way, &rate);
	way_seek(VERTICES, b, a, pose_swapped(p), c.n, alike, slop, deep, true, &way, &rate);
	return way;
}

/* Of the same pair, are they one? */
bool axes_are_same(axis a, axis b)
{
	return a.corner == b.corner && a.face == b.face && a.swapped == b.swapped;
}

/* Do bodies that hit along k also hit along that way out of the corner? */
bool way_hits(VERTICES_IN, body a, body b, pose p, axis k, axis way, float slop, float stillness, float part)
{
	if (axes_are_same(way, k))
		return true;
	return contact_is_hit(contact_at(VERTICES, a, b, p, way, slop), threshold_of(way.gap, slop, stillness, part).rate);
}

/* Along which a hit of two bodies is answered: not along a way on which there is nothing to answer, for that is one only now, by rounding. */
axis hit_axis(VERTICES_IN, body a, body b, pose p, float slop, float stillness, float part)
{
	axis k = best_axis(VERTICES, a, b, p);
	axis way = corner_way(VERTICES, a, b, p, k, contact_at(VERTICES, a, b, p, k, slop), slop);
	return way_hits(VERTICES, a, b, p, k, way, slop, stillness, part) ? way : k;
}
