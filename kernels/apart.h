/* Most pairs of polygons whose circles touch in a step stay apart, which can be proved faster than a search would find it out: CONTRACT.md, "toi". No result depends on
 * what is proved here, so it need not be rounded in a certain way. */

/* (cosine, sine), to a millionth for angles up to APART_ANGLE: four at once, for four rotation_of make a step of triangles a twenty-fifth longer. */
INLINE void rotations_of(float4 angle, float4 *c, float4 *s)
{
	float4 k = (angle * TWO_OVER_PI + 12582912.0f) - 12582912.0f; /* 3 2^22: what is added to it is rounded to an integer */
	int4 quarters = convert_int4(k), odd = -(quarters & 1);
	float4 x = ((angle - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3, z = x * x;
	float4 sine = x + (x * z) * (SINE_3 + z * (SINE_5 + z * SINE_7));
	float4 cosine = (1.0f - 0.5f * z) + (z * z) * (COSINE_4 + z * (COSINE_6 + z * COSINE_8));
	*c = select(cosine, sine, odd) * convert_float4(1 - ((quarters + 1) & 2));
	*s = select(sine, cosine, odd) * convert_float4(1 - (quarters & 2));
}

/* How far a face has to be from the other body at a time of so many steps, and some time after that, so that it separates them in between, however they turn, and so that a search would get there in
 * less than SEARCH_LIMIT steps, each of which is at least 2 gap / (2 rate + sqrt(2 bend gap)) long. Lengths are |x| + |y|, which is no less. */
float apart_enough(body a, body b, float steps, float time, float slop)
{
	float push = span((float2)(b.a.x - a.a.x, b.a.y - a.a.y)), speed = span((float2)(b.v.x - a.v.x, b.v.y - a.v.y)) + push * steps;
	float reach = span((float2)(b.x.x - a.x.x, b.x.y - a.x.y)) + speed * steps, radius = larger(a.radius, b.radius);
	float twist = larger(magnitude(a.b), magnitude(b.b)), twisting = magnitude(a.b - b.b);
	float spin = larger(magnitude(a.w), magnitude(b.w)) + twist * steps, turning = magnitude(a.w - b.w) + twisting * steps;
	float rate = (speed + spin * reach + turning * radius) * time;
	float bend = ((turning * turning * radius + spin * spin * reach + 2.0f * spin * speed) + (push + twist * reach + twisting * radius))
		* (time * time);
	return 0.125f * bend + larger(larger(rate * APART_RATE, bend * APART_BEND), APART_SLOPS * slop);
}

/* The corner and the normal of a side, the last one where there are no more. */
INLINE float4 corner_load(VERTICES_IN, body k, int j)
{
	int at = j < k.count ? j : k.count - 1;
	float2 from = vertex_load(VERTICES, k.first, at), to = vertex_load(VERTICES, k.first, at + 1 < k.count ? at + 1 : 0);
	float2 n = normal_load(VERTICES, k.first, at, to);
	return (float4)(from.x, from.y, n.x, n.y);
}

/* (Not of vectors of two: Oclgrind, where it looks for uninitialized values, can't read them.) */
INLINE float4 twice_each(float p, float q)
{
	return (float4)(p, p, q, q);
}

/* Is it exact enough how far a body is turned after so many steps? */
bool is_turned_exactly(body k, float steps)
{
	return magnitude(k.r) + (magnitude(k.w) + magnitude(k.b) * steps) * steps < APART_ANGLE;
}

/* Do two polygons surely stay apart from t until then? The lanes are: from A at t, from A then, from B at t, from B then. */
bool polygons_stay_apart(VERTICES_IN, body a, body b, float t, float until, float slop)
{
	float steps = larger(until, 1.0f);
	if (a.count == 1 || b.count == 1 || !is_turned_exactly(a, steps) || !is_turned_exactly(b, steps))
		return false;
	float2 x = (float2)(b.x.x - a.x.x, b.x.y - a.x.y), v = (float2)(b.v.x - a.v.x, b.v.y - a.v.y), push = (float2)(b.a.x - a.a.x, b.a.y - a.a.y);
	float2 d = place(x, v, push, t), e = place(x, v, push, until);
	float4 angle = (float4)(place1(a.r, a.w, a.b, t), place1(a.r, a.w, a.b, until), place1(b.r, b.w, b.b, t), place1(b.r, b.w, b.b, until));
	float4 dx = (float4)(d.x, e.x, -d.x, -e.x), dy = (float4)(d.y, e.y, -d.y, -e.y), own_c, own_s, far = (float4)(-INFINITY);
	rotations_of(angle, &own_c, &own_s);
	float4 c = own_c * own_c.zwxy + own_s * own_s.zwxy, s = own_c * own_s.zwxy - own_s * own_c.zwxy;
	float4 own_x = own_c * dx + own_s * dy, own_y = own_c * dy - own_s * dx;
	int most = max(a.count, b.count);
	for (int j = 0; j < most; j++) {
		float4 p = corner_load(VERTICES, a, j), q = corner_load(VERTICES, b, j);
		float4 nx = twice_each(p.z, q.z), ny = twice_each(p.w, q.w), mx = c * nx + s * ny, my = c * ny - s * nx, low = (float4)(INFINITY);
		for (int k = 0; k < most; k++) {
			float2 at_a = vertex_load(VERTICES, a.first, min(k, a.count - 1)), at_b = vertex_load(VERTICES, b.first, min(k, b.count - 1));
			float4 height = mx * twice_each(at_b.x, at_a.x) + my * twice_each(at_b.y, at_a.y);
			low = select(low, height, height < low);
		}
		low += (nx * own_x + ny * own_y) - (nx * twice_each(p.x, q.x) + ny * twice_each(p.y, q.y));
		low = select(low, low.yxwz, low.yxwz < low);
		far = select(far, low, low > far);
	}
	float enough = apart_enough(a, b, steps, until - t, slop);
	return far.x > enough || far.z > enough;
}

/* For how many whole steps from the beginning of this one, 2 to `most`, two polygons surely stay apart, though the end of each is rounded; 0 where that is not proved. */
float steps_apart(VERTICES_IN, body a, body b, float most)
{
	float radii = a.radius + b.radius;
	float rate = span((float2)(b.v.x - a.v.x, b.v.y - a.v.y)) + larger(magnitude(a.w), magnitude(b.w)) * radii;
	float steps = trunc(smaller((FORESIGHT * radii) / rate, most));
	float speed = (span(a.v) + span(b.v)) + steps * (span(a.a) + span(b.a)), slop = (1.0f + steps) * (pair_slop(a, b) + (steps * speed) * SLOP);
	return steps >= 2.0f && polygons_stay_apart(VERTICES, a, b, 0.0f, steps, slop) ? steps : 0.0f;
}
