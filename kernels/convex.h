/* Two convex bodies at one time: the axis that separates them best. */

/* Body B seen from body A at one time; lengths in metres, rates in metres a step. */
typedef struct pose {
	float2 d, v;   /* centre of B minus centre of A; its velocity */
	float2 ra, rb; /* rotations */
	float wa, wb;  /* angular velocities */
} pose;

/* A direction n fixed to the reference body, whose points have n . q <= offset, q from its centre. The other body, the
 * incident one, has its deepest vertex at n . q = offset + gap. */
typedef struct axis {
	bool swapped; /* the reference is B */
	bool corner;  /* from a corner (or a circle), not from a face */
	int face;     /* of the reference, where it is a face */
	int deepest;  /* vertex of the incident body */
	float2 n;     /* in the reference's frame */
	float offset, gap;
} axis;

pose pose_at(body a, body b, float t)
{
	pose p;
	float2 x = (float2)(b.x.x - a.x.x, b.x.y - a.x.y), v = (float2)(b.v.x - a.v.x, b.v.y - a.v.y);
	float2 acceleration = (float2)(b.a.x - a.a.x, b.a.y - a.a.y);
	p.d = place(x, v, acceleration, t);
	p.v = (float2)(v.x + t * acceleration.x, v.y + t * acceleration.y);
	p.ra = body_rotation(a, t);
	p.rb = body_rotation(b, t);
	p.wa = a.w + t * a.b;
	p.wb = b.w + t * b.b;
	return p;
}

pose pose_swapped(pose p)
{
	pose q;
	q.d = (float2)(-p.d.x, -p.d.y);
	q.v = (float2)(-p.v.x, -p.v.y);
	q.ra = p.rb;
	q.rb = p.ra;
	q.wa = p.wb;
	q.wb = p.wa;
	return q;
}

/* The rotation that takes the frame of B to that of A. */
float2 relative_rotation(pose p)
{
	return turn_back(p.ra, p.rb);
}

/* The least m . v over the body's vertices (a circle's: its rim), and which vertex it is. */
float lowest(VERTICES_IN, body k, float2 m, int *which)
{
	float low = INFINITY;
	*which = 0;
	if (k.count == 1)
		return -k.radius;
	for (int j = 0; j < k.count; j++) {
		float h = inner(m, vertex_load(VERTICES, k.first, j));
		if (h < low) {
			low = h;
			*which = j;
		}
	}
	return low;
}

/* The face of polygon a that keeps b farthest away. */
axis face_axis(VERTICES_IN, body a, body b, pose p)
{
	axis best;
	float2 d = turn_back(p.ra, p.d), relative = relative_rotation(p);
	float2 from = vertex_load(VERTICES, a.first, 0);
	best.swapped = false;
	best.corner = false;
	best.face = best.deepest = 0;
	best.n = (float2)(1.0f, 0.0f);
	best.offset = 0.0f;
	best.gap = -INFINITY;
	for (int e = 0; e < a.count; e++) {
		float2 to = vertex_load(VERTICES, a.first, e + 1 < a.count ? e + 1 : 0);
		float2 n = normal_load(VERTICES, a.first, e, to);
		float offset = inner(n, from);
		int deepest;
		float low = lowest(VERTICES, b, turn_back(relative, n), &deepest);
		float gap = (inner(n, d) - offset) + low;
		if (gap > best.gap) {
			best.face = e;
			best.deepest = deepest;
			best.n = n;
			best.offset = offset;
			best.gap = gap;
		}
		from = to;
	}
	return best;
}

/* An axis from corner `from` of a to the point `to` of b, both in a's frame; `fallback` where that is none or is worse. */
axis corner_axis(VERTICES_IN, body a, body b, pose p, float2 from, float2 to, axis fallback)
{
	float2 e = (float2)(to.x - from.x, to.y - from.y);
	float size = norm(e);
	axis k = fallback;
	if (!(size > 0.0f))
		return fallback;
	k.corner = true;
	k.n = (float2)(e.x / size, e.y / size);
	/* over all of a, or an axis from the wrong corner would count a's own body as gap */
	k.offset = -lowest(VERTICES, a, (float2)(-k.n.x, -k.n.y), &k.deepest);
	k.gap = (inner(k.n, turn_back(p.ra, p.d)) - k.offset) + lowest(VERTICES, b, turn_back(relative_rotation(p), k.n), &k.deepest);
	/* a circle is nearest to that corner, though rounding may hide that the gap is larger; n differs by its root */
	return b.count == 1 || k.gap > fallback.gap ? k : fallback;
}

/* Beyond an end of a's face, is a circle in front of the one beside it: the next one, or the one before? */
int beside_face(VERTICES_IN, body a, float2 point, int face)
{
	int next = face + 1 < a.count ? face + 1 : 0, last = face > 0 ? face - 1 : a.count - 1;
	float2 from = vertex_load(VERTICES, a.first, face), to = vertex_load(VERTICES, a.first, next), edge = (float2)(to.x - from.x, to.y - from.y);
	float along = inner(edge, (float2)(point.x - from.x, point.y - from.y));
	if (along > inner(edge, edge)) {
		float2 end = vertex_load(VERTICES, a.first, next + 1 < a.count ? next + 1 : 0);
		return inner((float2)(end.x - to.x, end.y - to.y), (float2)(point.x - to.x, point.y - to.y)) > 0.0f ? next : face;
	}
	float2 begin = vertex_load(VERTICES, a.first, last);
	return along < 0.0f && inner((float2)(from.x - begin.x, from.y - begin.y), (float2)(point.x - from.x, point.y - from.y)) < 0.0f ? last : face;
}

/* The axis of the face that a circle is in front of, or beyond an end of: where two are nearly one rounding alone says which keeps it the farthest away. */
axis circle_face(VERTICES_IN, body a, body b, float2 point, axis face)
{
	int at = face.face, before = -1;
	for (int i = 0; i < a.count && at != before; i++) {
		before = at;
		at = beside_face(VERTICES, a, point, at);
	}
	if (at == face.face)
		return face;
	axis k = face;
	k.face = at;
	k.n = normal_load(VERTICES, a.first, at, vertex_load(VERTICES, a.first, at + 1 < a.count ? at + 1 : 0));
	k.offset = inner(k.n, vertex_load(VERTICES, a.first, at));
	k.gap = (inner(k.n, point) - k.offset) - b.radius;
	return k;
}

/* Where the deepest point of b lies beyond an end of the face, b may be nearest to that end's corner instead. */
axis refined_axis(VERTICES_IN, body a, body b, pose p, axis face)
{
	float2 point = turn_back(p.ra, p.d);
	if (b.count > 1) {
		float2 v = turn(relative_rotation(p), vertex_load(VERTICES, b.first, face.deepest));
		point = (float2)(point.x + v.x, point.y + v.y);
	} else {
		face = circle_face(VERTICES, a, b, point, face);
	}
	float2 from = vertex_load(VERTICES, a.first, face.face);
	float2 to = vertex_load(VERTICES, a.first, face.face + 1 < a.count ? face.face + 1 : 0);
	float2 edge = (float2)(to.x - from.x, to.y - from.y);
	float along = inner(edge, (float2)(point.x - from.x, point.y - from.y));
	if (along < 0.0f)
		return corner_axis(VERTICES, a, b, p, from, point, face);
	if (along > inner(edge, edge))
		return corner_axis(VERTICES, a, b, p, to, point, face);
	return face;
}

axis polygon_axis(VERTICES_IN, body a, body b, pose p)
{
	axis face = face_axis(VERTICES, a, b, p);
	/* a circle is judged by its centre, which is still outside when its rim is a little inside */
	if (face.gap + (b.count == 1 ? b.radius : 0.0f) > 0.0f)
		return refined_axis(VERTICES, a, b, p, face);
	return face;
}

/* The axis with the largest gap: above 0 exactly when the bodies are apart, and then never above their distance. */
axis best_axis(VERTICES_IN, body a, body b, pose p)
{
	axis first, second;
	if (a.count == 1 && b.count == 1) {
		float2 d = turn_back(p.ra, p.d);
		float size = norm(d);
		first.swapped = false;
		first.corner = true;
		first.face = first.deepest = 0;
		first.n = size > 0.0f ? (float2)(d.x / size, d.y / size) : (float2)(1.0f, 0.0f);
		first.offset = a.radius;
		first.gap = (size - a.radius) - b.radius;
		return first;
	}
	if (a.count > 1) {
		first = polygon_axis(VERTICES, a, b, p);
		if (b.count == 1)
			return first;
	}
	second = polygon_axis(VERTICES, b, a, pose_swapped(p));
	second.swapped = true;
	return a.count > 1 && first.gap >= second.gap ? first : second;
}
