/* Float rules: the same bits on every device. Only + - * / sqrt, comparisons, conversions; no contraction; no built-in
 * whose result may differ (dot, length, sin, mad, ...). The order of the operations is that of CONTRACT.md. */
#pragma OPENCL FP_CONTRACT OFF

/* For what inner loops call: compilers for CPUs do not inline it all by themselves; those that do not optimize leave traces of it that Oclgrind does not know. */
#if defined(__clang__) && defined(__OPTIMIZE__) && !defined(CAROM_GPU)
#define INLINE __attribute__((always_inline))
#else
#define INLINE
#endif

/* For what is long and seldom called: compilers for GPUs put all in one, which then takes so many registers that few work-items run at once. */
#if defined(__NV_CL_C_VERSION) && defined(CAROM_OUTLINES)
#define SELDOM __attribute__((noinline))
#else
#define SELDOM
#endif

/* Whether one of four is the case: any() is not the same on every device. */
INLINE bool is_zero(float2 v)
{
	return v.x == 0.0f && v.y == 0.0f;
}

INLINE bool is_any(int4 flags)
{
	return flags.x | flags.y | flags.z | flags.w;
}

float2 turn(float2 rotation, float2 v) /* rotation = (cosine, sine) */
{
	return (float2)(rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y);
}

float2 turn_back(float2 rotation, float2 v)
{
	return (float2)(rotation.x * v.x + rotation.y * v.y, rotation.x * v.y - rotation.y * v.x);
}

INLINE float inner(float2 a, float2 b)
{
	return a.x * b.x + a.y * b.y;
}

INLINE float cross2(float2 a, float2 b)
{
	return a.x * b.y - a.y * b.x;
}

float norm(float2 v)
{
	return sqrt(v.x * v.x + v.y * v.y);
}

INLINE float magnitude(float x)
{
	return x < 0.0f ? -x : x;
}

/* |x| + |y|: a cheap bound of a vector's length */
INLINE float span(float2 v)
{
	return magnitude(v.x) + magnitude(v.y);
}

INLINE float smaller(float a, float b)
{
	return b < a ? b : a;
}

INLINE float larger(float a, float b)
{
	return b > a ? b : a;
}

/* The nearest whole number, halves away from 0; 0 for what is too large to be one. */
int nearest(float x)
{
	if (!(magnitude(x) < LARGEST_TURN))
		return 0;
	return (int)(x < 0.0f ? x - 0.5f : x + 0.5f);
}

/* (cosine, sine) of `angle`; the error is about a unit in the last place up to some thousand turns */
float2 rotation_of(float angle)
{
	int quarters = nearest(angle * TWO_OVER_PI);
	float k = (float)quarters;
	float x = ((angle - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3;
	float z = x * x;
	float s = x + (x * z) * (SINE_3 + z * (SINE_5 + z * SINE_7));
	float c = (1.0f - 0.5f * z) + (z * z) * (COSINE_4 + z * (COSINE_6 + z * COSINE_8));
	/* by the two bits of quarters & 3; a switch goes wrong for -2 in Oclgrind 21.10 */
	float2 turned = (quarters & 1) ? (float2)(-s, c) : (float2)(c, s);
	return (quarters & 2) ? (float2)(-turned.x, -turned.y) : turned;
}

float without_turns(float angle)
{
	float k = (float)nearest(angle * (0.25f * TWO_OVER_PI));
	return ((angle - k * (4.0f * HALF_PI_1)) - k * (4.0f * HALF_PI_2)) - k * (4.0f * HALF_PI_3);
}

/* The same direction in [-pi, pi]; of so many turns that rounding has lost it, 0. */
float wrapped(float angle)
{
	float once = without_turns(angle);
	if (magnitude(once) <= ANGLE_MOST)
		return once;
	float twice = without_turns(once);
	return magnitude(twice) <= ANGLE_MOST ? twice : 0.0f;
}

/* sum + x, where sum is the unevaluated sum of a high and a low part (two-sum, then renormalised) */
float2 add_exactly(float2 sum, float x)
{
	float s = sum.x + x;
	float b = s - sum.x;
	float e = (sum.x - (s - b)) + (x - b);
	float low = sum.y + e;
	float high = s + low;
	return (float2)(high, low - (high - s));
}

/* The first time t >= 0 at which gap + rate t - bend t^2 / 2 falls to 0, for gap >= 0; INFINITY if it never does. */
float first_root(float gap, float rate, float bend)
{
	float square = rate * rate + (2.0f * bend) * gap;
	if (rate < 0.0f)
		return square < 0.0f ? INFINITY : (2.0f * gap) / (sqrt(square) - rate);
	return bend > 0.0f ? (rate + sqrt(square)) / bend : INFINITY;
}
