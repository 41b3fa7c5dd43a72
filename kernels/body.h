/* Bodies in motion [1, figure 1]. Velocities and accelerations are in step units: a step lasts 1, so that a velocity is
 * the way made in a step. */

typedef struct body {
	int index, first, count; /* first texel and number of vertices; of what is not convex those of its hull */
	int pieces;              /* of what is not convex; else 0 */
	float2 x, v, a;          /* position at the start of the step, velocity, acceleration */
	float r, w, b;           /* angle, angular velocity, angular acceleration */
	float radius;
	float inverse_mass, inverse_inertia;
	float restitution;
} body;

#define STATE_IN TEX_IN(linear), TEX_IN(rotational), TEX_IN(geometry), TEX_IN(forces), TEX_IN(uniforms)
#define STATE TEX(linear), TEX(rotational), TEX(geometry), TEX(forces), TEX(uniforms)

/* The motion of a body: constant accelerations, so that Y(t) is a polynomial and is followed exactly. */
body body_load(STATE_IN, int index, float length)
{
	float4 l = ROW_LOAD(linear, index), r = ROW_LOAD(rotational, index);
	float4 g = ROW_LOAD(geometry, index), f = ROW_LOAD(forces, index);
	float4 world = TEX_LOAD(uniforms, UNIFORMS_WORLD, 0);
	body k;
	k.index = index;
	k.first = (int)CHANNEL(g, GEOMETRY_FIRST);
	k.count = (int)CHANNEL(g, GEOMETRY_COUNT);
	k.pieces = 0; /* the step first_impact has none */
	k.radius = CHANNEL(r, ROTATIONAL_RADIUS);
	k.restitution = CHANNEL(f, FORCES_RESTITUTION);
	k.inverse_mass = 1.0f / CHANNEL(g, GEOMETRY_MASS);
	k.inverse_inertia = 1.0f / CHANNEL(g, GEOMETRY_INERTIA);
	k.x = (float2)(CHANNEL(l, LINEAR_X), CHANNEL(l, LINEAR_Y));
	k.v = (float2)(CHANNEL(l, LINEAR_VX) * length, CHANNEL(l, LINEAR_VY) * length);
	k.r = CHANNEL(r, ROTATIONAL_ANGLE);
	k.w = CHANNEL(r, ROTATIONAL_VELOCITY) * length;
	k.a = (float2)(0.0f, 0.0f);
	k.b = 0.0f;
	if (k.inverse_mass > 0.0f) {
		k.a.x = ((CHANNEL(world, WORLD_GRAVITY_X) + CHANNEL(f, FORCES_X) * k.inverse_mass) * length) * length;
		k.a.y = ((CHANNEL(world, WORLD_GRAVITY_Y) + CHANNEL(f, FORCES_Y) * k.inverse_mass) * length) * length;
		k.b = ((CHANNEL(f, FORCES_TORQUE) * k.inverse_inertia) * length) * length;
	}
	return k;
}

/* x + t (v + t a / 2), with x the start, v the velocity and a the acceleration */
INLINE float2 place(float2 x, float2 v, float2 a, float t)
{
	return (float2)(x.x + t * (v.x + (0.5f * t) * a.x), x.y + t * (v.y + (0.5f * t) * a.y));
}

float place1(float x, float v, float a, float t)
{
	return x + t * (v + (0.5f * t) * a);
}

float2 body_rotation(body k, float t)
{
	return rotation_of(place1(k.r, k.w, k.b, t));
}

bool anything_rubs(TEX_IN(uniforms))
{
	return CHANNEL(TEX_LOAD(uniforms, UNIFORMS_RUBS, 0), RUBS_ANY) > 0.0f;
}

/* A body's coefficients of friction and of rolling friction, by its index, or those of the walls: -1. */
float2 frictions_of(TEX_IN(uniforms), TEX_IN(friction), int index)
{
	if (index < 0) {
		float4 walls = TEX_LOAD(uniforms, UNIFORMS_RUBS, 0);
		return (float2)(CHANNEL(walls, RUBS_WALLS), CHANNEL(walls, RUBS_ROLLING));
	}
	float4 own = ROW_LOAD(friction, index);
	return (float2)(CHANNEL(own, FRICTION_SLIDING), CHANNEL(own, FRICTION_ROLLING));
}

/* The coefficient of friction of two bodies, by their indices, or of one and the walls: -1. */
float friction_of(TEX_IN(uniforms), TEX_IN(friction), int body, int other)
{
	if (!anything_rubs(TEX(uniforms)))
		return 0.0f;
	return sqrt(frictions_of(TEX(uniforms), TEX(friction), body).x * frictions_of(TEX(uniforms), TEX(friction), other).x);
}

/* Of rolling friction, likewise. */
float rolling_of(TEX_IN(uniforms), TEX_IN(friction), int body, int other)
{
	if (!anything_rubs(TEX(uniforms)))
		return 0.0f;
	return larger(frictions_of(TEX(uniforms), TEX(friction), body).y, frictions_of(TEX(uniforms), TEX(friction), other).y);
}

/* Whether the hits of two bodies take energy: these come to rest in the end. The larger restitution, and the coefficient of friction. */
bool is_lossy(float restitution, float friction)
{
	return restitution < 1.0f || friction > 0.0f;
}

/* How long the step that begins may last; 0 when the time is over. */
float step_length(TEX_IN(uniforms), TEX_IN(clock))
{
	float4 step = TEX_LOAD(clock, CLOCK_STEP, 0), time = TEX_LOAD(clock, CLOCK_TIME, 0);
	float time_step = CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP), remaining = CHANNEL(time, TIME_REMAINING);
	if (CHANNEL(step, STEP_ENDED) > 0.0f || remaining < LEAST_STEP)
		return 0.0f;
	return remaining <= time_step * LAST_STEP ? remaining : time_step;
}

/* Of a step of that length, the one in which it is found what rests, and by which forces: the whole time step where it is cut short, so that what lies lies on in it. */
float whole_length(TEX_IN(uniforms), float length)
{
	return length > 0.0f ? larger(length, CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP)) : 0.0f;
}

/* How much of that a step of that length is, of joints, which act in what there is of it. */
float part_of_whole(float length, float whole)
{
	return whole > 0.0f ? larger(length / whole, JOINT_SHORTEST) : 1.0f;
}

/* What remains after a step: nothing if that was to be the last, for what a float can't tell of its length is no step. */
float2 time_left(float4 time, float advanced)
{
	float2 remaining = (float2)(CHANNEL(time, TIME_REMAINING), CHANNEL(time, TIME_REMAINING_LOW));
	return advanced == remaining.x ? (float2)(0.0f, 0.0f) : add_exactly(remaining, -advanced);
}

/* The j-th vertex of a polygon whose first is at `first`, in the polygon's frame [2, figure 2], and the normal of the side that begins there and ends
 * at `to`. The step events has them side by side, in Outlines. */
#ifdef CAROM_OUTLINES
#define VERTICES_IN RECORD_IN(vertices)
#define VERTICES vertices

float2 vertex_load(VERTICES_IN, int first, int j)
{
	float4 corner = vertices[first + j];
	return (float2)(CHANNEL(corner, OUTLINE_X), CHANNEL(corner, OUTLINE_Y));
}

float2 normal_load(VERTICES_IN, int first, int j, float2 to)
{
	float4 corner = vertices[first + j];
	return (float2)(CHANNEL(corner, OUTLINE_NORMAL_X), CHANNEL(corner, OUTLINE_NORMAL_Y));
}

float4 piece_record(VERTICES_IN, int index)
{
	return vertices[index];
}
#else
#define VERTICES_IN TEX_IN(vertices)
#define VERTICES TEX(vertices)

float2 vertex_load(VERTICES_IN, int first, int j)
{
	float4 two = ROW_LOAD(vertices, first + (j >> 1));
	return (j & 1) ? (float2)(CHANNEL(two, VERTICES_X1), CHANNEL(two, VERTICES_Y1)) : (float2)(CHANNEL(two, VERTICES_X0), CHANNEL(two, VERTICES_Y0));
}

float2 normal_load(VERTICES_IN, int first, int j, float2 to)
{
	float2 from = vertex_load(VERTICES, first, j), e = (float2)(to.x - from.x, to.y - from.y);
	float size = norm(e);
	return (float2)(e.y / size, -e.x / size);
}

float4 piece_record(VERTICES_IN, int index) /* nobody asks */
{
	return ROW_LOAD(vertices, index);
}
#endif

/* How far a body's way bends out of the box about its two ends, with the distance that counts as touching. */
float aabb_pad(body k)
{
	float2 end = place(k.x, k.v, k.a, 1.0f);
	float spin = magnitude(k.w) + magnitude(k.b);
	float bend = norm(k.a) + (k.count == 1 ? 0.0f : (magnitude(k.b) + spin * spin) * k.radius);
	float size = larger(larger(magnitude(k.x.x), magnitude(k.x.y)), larger(magnitude(end.x), magnitude(end.y))) + k.radius;
	return 0.125f * bend + size * (2.0f * SLOP);
}
