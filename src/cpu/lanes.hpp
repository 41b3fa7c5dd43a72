/* Four numbers side by side, each rounded as if it were alone. Which corner is the nearest, say, processors can't foretell:
 * to compute all of them costs less than branches that go wrong. */
#ifndef CAROM_CPU_LANES_HPP
#define CAROM_CPU_LANES_HPP

#include "cpu/body.hpp"

namespace carom::cpu {

constexpr int32_t lane_count = 4;

template <typename T> struct LaneType;
template <> struct LaneType<float> {
	typedef float Lanes __attribute__((vector_size(lane_count * sizeof(float))));
};
template <> struct LaneType<double> {
	typedef double Lanes __attribute__((vector_size(lane_count * sizeof(double))));
};
template <typename T> using Lanes = typename LaneType<T>::Lanes;

#if defined(__SSE2__)
/* Compilers make four instructions of each of these, where the processor has one. */
[[gnu::always_inline]] inline Lanes<float> larger(const Lanes<float> &a, const Lanes<float> &b)
{
	return __builtin_ia32_maxps(b, a);
}

[[gnu::always_inline]] inline Lanes<float> smaller(const Lanes<float> &a, const Lanes<float> &b)
{
	return __builtin_ia32_minps(b, a);
}
#endif

/* Of two the lanes i, j, k, l, those of the second from lane_count on. GCC and Clang have no common way to say it. */
template <int i, int j, int k, int l, typename T> [[gnu::always_inline]] inline void pick(const Lanes<T> &a, const Lanes<T> &b, Lanes<T> &to)
{
#ifdef __clang__
	to = __builtin_shufflevector(a, b, i, j, k, l);
#else
	to = __builtin_shuffle(a, b, decltype(a < b){i, j, k, l});
#endif
}

/* Rows become columns. */
template <typename T> [[gnu::always_inline]] inline void transpose(Lanes<T> (&rows)[lane_count])
{
	Lanes<T> low[2], high[2];
	for (int half = 0; half < 2; half++) {
		pick<0, 4, 1, 5, T>(rows[2 * half], rows[2 * half + 1], low[half]);
		pick<2, 6, 3, 7, T>(rows[2 * half], rows[2 * half + 1], high[half]);
	}
	pick<0, 1, 4, 5, T>(low[0], low[1], rows[0]);
	pick<2, 3, 6, 7, T>(low[0], low[1], rows[1]);
	pick<0, 1, 4, 5, T>(high[0], high[1], rows[2]);
	pick<2, 3, 6, 7, T>(high[0], high[1], rows[3]);
}

/* Of a number, or of each. */
template <typename V> [[gnu::always_inline]] inline V magnitude(const V &v)
{
	return v < 0 ? -v : v;
}

/* nearest of each. */
template <typename T> [[gnu::always_inline]] inline auto nearest_of(const Lanes<T> &x)
{
	const Lanes<T> zero{}, half = zero + T(0.5), most = zero + T(LARGEST_TURN);
	const auto whole = __builtin_convertvector(x + (x < 0 ? -half : half), decltype(x < 0));
	return ((x < most) & (x > -most)) ? whole : decltype(x < 0){};
}

/* wrapped of each. */
template <typename T> [[gnu::always_inline]] inline void wrap(Lanes<T> &angle)
{
	const Lanes<T> k = __builtin_convertvector(nearest_of<T>(angle * T(0.25f * TWO_OVER_PI)), Lanes<T>);
	const Lanes<T> once = ((angle - k * T(4 * HALF_PI_1)) - k * T(4 * HALF_PI_2)) - k * T(4 * HALF_PI_3);
	const auto done = magnitude(once) <= T(ANGLE_MOST);
	if ((done[0] & done[1] & done[2] & done[3]) != 0) {
		angle = once;
		return;
	}
	for (int32_t i = 0; i < lane_count; i++)
		angle[i] = wrapped<T>(angle[i]);
}

/* rotation_of each: cosines and sines. */
[[gnu::always_inline]] inline void rotations(const Lanes<float> &angle, Lanes<float> &cosine, Lanes<float> &sine)
{
	const auto q = nearest_of<float>(angle * TWO_OVER_PI);
	const Lanes<float> k = __builtin_convertvector(q, Lanes<float>);
	const Lanes<float> x = ((angle - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3, z = x * x;
	const Lanes<float> s = x + (x * z) * (SINE_3 + z * (SINE_5 + z * SINE_7));
	const Lanes<float> c = (1.0f - 0.5f * z) + (z * z) * (COSINE_4 + z * (COSINE_6 + z * COSINE_8));
	const auto swapped = (q & 1) != 0;
	cosine = (swapped ? s : c) * __builtin_convertvector(1 - ((q + 1) & 2), Lanes<float>);
	sine = (swapped ? c : s) * __builtin_convertvector(1 - (q & 2), Lanes<float>);
}

inline void rotations(const Lanes<double> &angle, Lanes<double> &cosine, Lanes<double> &sine)
{
	for (int32_t i = 0; i < lane_count; i++) {
		const Vec<double> rotation = rotation_of(angle[i]);
		cosine[i] = rotation.x(), sine[i] = rotation.y();
	}
}

/* Corners of a polygon from one on; where there are no more, the last one again. */
template <typename T> struct FourCorners {
	Lanes<T> x, y, nx, ny;

	[[gnu::always_inline]] FourCorners(const Convex<T> &polygon, int32_t first)
	{
		const Corner<T> *c = polygon.corners;
		const int32_t last = polygon.count - 1, i0 = first, i1 = std::min(first + 1, last), i2 = std::min(first + 2, last),
					  i3 = std::min(first + 3, last);
		x = Lanes<T>{c[i0].vertex.x(), c[i1].vertex.x(), c[i2].vertex.x(), c[i3].vertex.x()};
		y = Lanes<T>{c[i0].vertex.y(), c[i1].vertex.y(), c[i2].vertex.y(), c[i3].vertex.y()};
		nx = Lanes<T>{c[i0].normal.x(), c[i1].normal.x(), c[i2].normal.x(), c[i3].normal.x()};
		ny = Lanes<T>{c[i0].normal.y(), c[i1].normal.y(), c[i2].normal.y(), c[i3].normal.y()};
	}
};

/* first_root of each. */
template <typename T> [[gnu::always_inline]] inline void first_roots(const Lanes<T> &gap, const Lanes<T> &rate, T bend, Lanes<T> &roots)
{
	const Lanes<T> square = rate * rate + (2 * bend) * gap;
	Lanes<T> root;
	for (int32_t i = 0; i < lane_count; i++)
		root[i] = std::sqrt(square[i]);
	const Lanes<T> none = Lanes<T>{} + infinite<T>, flat = Lanes<T>{} + bend;
	const Lanes<T> falling = square < 0 ? none : (2 * gap) / (root - rate), rising = bend > 0 ? (rate + root) / flat : none;
	roots = rate < 0 ? falling : rising;
}

}

#endif
