/* Vectors and the numerical rules of kernels/CONTRACT.md ("Numbers", "Bodies in step units").
 *
 * The contract fixes every rounding. Of Eigen only what has one way to round is used: sums, differences and multiples of
 * vectors. Its products and reductions are not, for where the compiler may use them they take fused multiply-adds. */
#ifndef CAROM_CPU_NUMBERS_HPP
#define CAROM_CPU_NUMBERS_HPP

#ifndef EIGEN_NO_DEBUG
#define EIGEN_NO_DEBUG /* the library never aborts */
#endif
#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <limits>

#include "layout.h"

namespace carom::cpu {

/* Not aligned, so that it may be passed by value and kept in any struct. */
template <typename T> using Vec = Eigen::Matrix<T, 2, 1, Eigen::DontAlign>;
template <typename V> using Expression = Eigen::MatrixBase<V>;

template <typename T> inline constexpr T infinite = std::numeric_limits<T>::infinity();

template <typename A, typename B> auto inner(const Expression<A> &a, const Expression<B> &b)
{
	return a.x() * b.x() + a.y() * b.y();
}

template <typename A, typename B> auto cross(const Expression<A> &a, const Expression<B> &b)
{
	return a.x() * b.y() - a.y() * b.x();
}

template <typename V> auto norm(const Expression<V> &v)
{
	return std::sqrt(v.x() * v.x() + v.y() * v.y());
}

template <typename V> auto span(const Expression<V> &v)
{
	return std::abs(v.x()) + std::abs(v.y());
}

/* Rotations are vectors (cosine, sine). */
template <typename Q, typename V> auto turn(const Expression<Q> &q, const Expression<V> &v)
{
	return Vec<typename V::Scalar>(q.x() * v.x() - q.y() * v.y(), q.y() * v.x() + q.x() * v.y());
}

template <typename Q, typename V> auto turn_back(const Expression<Q> &q, const Expression<V> &v)
{
	return Vec<typename V::Scalar>(q.x() * v.x() + q.y() * v.y(), q.x() * v.y() - q.y() * v.x());
}

/* Like std::min and std::max, the first of two equal ones; like them, but not like fmin, the first if one is a NaN. */
template <typename T> T smaller(T a, T b)
{
	return b < a ? b : a;
}

template <typename T> T larger(T a, T b)
{
	return b > a ? b : a;
}

template <typename V> auto largest(const Expression<V> &v)
{
	return larger(std::abs(v.x()), std::abs(v.y()));
}

template <typename T> int32_t nearest(T x)
{
	if (!(std::abs(x) < T(LARGEST_TURN)))
		return 0;
	return static_cast<int32_t>(x + std::copysign(T(0.5), x)); /* no branch: signs can't be foretold */
}

/* Cosine and sine by Cephes' polynomials: those of the C library differ from host to host. */
inline Vec<float> rotation_of(float angle)
{
	int32_t q = nearest(angle * TWO_OVER_PI);
	float k = static_cast<float>(q);
	float x = ((angle - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3;
	float z = x * x;
	float s = x + (x * z) * (SINE_3 + z * (SINE_5 + z * SINE_7));
	float c = (1.0f - 0.5f * z) + (z * z) * (COSINE_4 + z * (COSINE_6 + z * COSINE_8));
	const float parts[2] = {c, s};
	return {parts[q & 1] * static_cast<float>(1 - ((q + 1) & 2)), parts[~q & 1] * static_cast<float>(1 - (q & 2))};
}

inline Vec<double> rotation_of(double angle)
{
	return {std::cos(angle), std::sin(angle)};
}

template <typename T> T wrapped(T angle)
{
	/* once as a rule; twice where rounding of many turns left more than half a one */
	for (int i = 0; i < 2; i++) {
		T k = static_cast<T>(nearest(angle * (0.25f * TWO_OVER_PI)));
		angle = ((angle - k * (4 * HALF_PI_1)) - k * (4 * HALF_PI_2)) - k * (4 * HALF_PI_3);
		if (std::abs(angle) <= ANGLE_MOST)
			return angle;
	}
	return 0;
}

/* A number as the sum of two, for times that go on growing by less than their last place. */
template <typename T> struct Sum {
	T high, low;
};

template <typename T> Sum<T> add_exactly(Sum<T> sum, T x)
{
	T s = sum.high + x;
	T b = s - sum.high;
	T e = (sum.high - (s - b)) + (x - b);
	T l = sum.low + e;
	T h = s + l;
	return {h, l - (h - s)};
}

/* The first t >= 0 at which gap + rate t - bend t^2/2 is 0. */
template <typename T> T first_root(T gap, T rate, T bend)
{
	T square = rate * rate + (2 * bend) * gap;
	if (rate < 0)
		return square < 0 ? infinite<T> : (2 * gap) / (std::sqrt(square) - rate);
	if (bend > 0)
		return (rate + std::sqrt(square)) / bend;
	return infinite<T>;
}

template <typename T> T place(T x, T v, T a, T t)
{
	return x + t * (v + (T(0.5) * t) * a);
}

template <typename T> Vec<T> place(const Vec<T> &x, const Vec<T> &v, const Vec<T> &a, T t)
{
	return {place(x.x(), v.x(), a.x(), t), place(x.y(), v.y(), a.y(), t)};
}

}

#endif
