/* Most pairs of polygons whose circles touch in a step stay apart. That can be proved in a fraction of the time that the search for their hit takes: CONTRACT.md, "toi". */
#ifndef CAROM_CPU_APART_HPP
#define CAROM_CPU_APART_HPP

#include "cpu/toi.hpp"

namespace carom::cpu {

/* How fast a point of one body moves against an axis that turns with the other, and how fast that changes: bounds for so many steps, whichever is the other. Lengths are
 * |x| + |y|, which is no less. */
template <typename T> struct Haste {
	T rate, bend;

	[[gnu::always_inline]] Haste(const Convex<T> &a, const Convex<T> &b, T steps)
	{
		const T push = span(b.a - a.a), speed = span(b.v - a.v) + push * steps, reach = span(b.x - a.x) + speed * steps;
		const T twist = larger(std::abs(a.b), std::abs(b.b)), relative_twist = std::abs(a.b - b.b), radius = larger(a.radius, b.radius);
		const T spin = larger(std::abs(a.w), std::abs(b.w)) + twist * steps, turning = std::abs(a.w - b.w) + relative_twist * steps;
		rate = speed + spin * reach + turning * radius;
		bend = (turning * turning * radius + spin * spin * reach + 2 * spin * speed) + (push + twist * reach + relative_twist * radius);
	}

	/* A face that is so far from the other body as a time begins and as it ends separates them all the while, and so far that a search gets there in less than SEARCH_LIMIT
	 * steps: each takes at least 2 gap / (2 rate + sqrt(2 bend gap)). */
	T enough(T time, T slop) const
	{
		const T bent = bend * (time * time);
		return bent * T(1.0 / 8) + larger(larger(rate * time * T(APART_RATE), bent * T(APART_BEND)), T(APART_SLOPS) * slop);
	}
};

/* (cosine, sine), to a millionth for angles up to APART_ANGLE: four at once, for four rotation_of make a step of triangles a twentieth longer. */
template <typename T> [[gnu::always_inline]] inline void find_rotations(const Lanes<T> &angle, Lanes<T> &c, Lanes<T> &s)
{
	typedef decltype(angle < Lanes<T>{}) Quarters;
	constexpr T whole = T(3) / (2 * std::numeric_limits<T>::epsilon()); /* what is added to it is rounded to an integer */
	const Lanes<T> k = (angle * TWO_OVER_PI + whole) - whole, x = ((angle - k * HALF_PI_1) - k * HALF_PI_2) - k * HALF_PI_3, z = x * x;
	const Lanes<T> sine = x + (x * z) * (SINE_3 + z * (SINE_5 + z * SINE_7));
	const Lanes<T> cosine = (1 - T(0.5) * z) + (z * z) * (COSINE_4 + z * (COSINE_6 + z * COSINE_8));
	const Quarters q = __builtin_convertvector(k, Quarters), odd = -(q & 1);
	c = (odd ? sine : cosine) * __builtin_convertvector(1 - ((q + 1) & 2), Lanes<T>);
	s = (odd ? cosine : sine) * __builtin_convertvector(1 - (q & 2), Lanes<T>);
}

/* Two polygons at two times, each seen from the other; the lanes are: from A at the first, at the second, from B at the first, at the second. Where one has fewer corners its last
 * counts for those that it lacks. */
template <typename T> class FourViews
{
public:
	static constexpr int32_t most_corners = 8;

	FourViews(const Convex<T> &a, const Convex<T> &b, T first, T second) : count(std::max(a.count, b.count))
	{
		const Vec<T> d = b.x - a.x, v = b.v - a.v, acceleration = b.a - a.a, d1 = place(d, v, acceleration, first),
					 d2 = place(d, v, acceleration, second);
		const Lanes<T> angles{a.angle_at(first), a.angle_at(second), b.angle_at(first), b.angle_at(second)};
		const Lanes<T> dx{d1.x(), d2.x(), -d1.x(), -d2.x()}, dy{d1.y(), d2.y(), -d1.y(), -d2.y()};
		Lanes<T> own_c, own_s, other_c, other_s;
		find_rotations<T>(angles, own_c, own_s);
		pick<2, 3, 0, 1, T>(own_c, own_c, other_c);
		pick<2, 3, 0, 1, T>(own_s, own_s, other_s);
		const Lanes<T> c = own_c * other_c + own_s * other_s, s = own_c * other_s - own_s * other_c;
		const Lanes<T> from_x = own_c * dx + own_s * dy, from_y = own_c * dy - own_s * dx;
		for (int32_t k = 0; k < count; k++) {
			Lanes<T> p, q, vertex_x, vertex_y, face_x, face_y;
			load_corner(a, k, p);
			load_corner(b, k, q);
			pick<4, 4, 0, 0, T>(p, q, vertex_x), pick<5, 5, 1, 1, T>(p, q, vertex_y), pick<0, 0, 4, 4, T>(p, q, face_x),
				pick<1, 1, 5, 5, T>(p, q, face_y);
			pick<2, 2, 6, 6, T>(p, q, normal_x[k]), pick<3, 3, 7, 7, T>(p, q, normal_y[k]);
			x[k] = from_x + (c * vertex_x - s * vertex_y);
			y[k] = from_y + (s * vertex_x + c * vertex_y);
			offset[k] = normal_x[k] * face_x + normal_y[k] * face_y;
		}
	}

	/* Is a face so far from the other body at both times? */
	bool are_apart(T far) const
	{
		Lanes<T> best = Lanes<T>{} - infinite<T>, swapped;
		for (int32_t face = 0; face < count; face++) {
			Lanes<T> low = Lanes<T>{} + infinite<T>;
			for (int32_t k = 0; k < count; k++) {
				const Lanes<T> height = normal_x[face] * x[k] + normal_y[face] * y[k];
				low = height < low ? height : low;
			}
			low -= offset[face];
			pick<1, 0, 3, 2, T>(low, low, swapped);
			low = swapped < low ? swapped : low;
			best = low > best ? low : best;
		}
		return (best[0] > far) | (best[2] > far);
	}

private:
	/* A record of Outlines, whole. */
	static void load_corner(const Convex<T> &body, int32_t k, Lanes<T> &corner)
	{
		std::memcpy(&corner, reinterpret_cast<const T *>(body.corners + std::min(k, body.count - 1)), sizeof corner);
	}

	int32_t count;
	Lanes<T> x[most_corners], y[most_corners], normal_x[most_corners], normal_y[most_corners], offset[most_corners];
};

/* Do two bodies surely stay apart from t to `until`, in steps? */
template <typename T> bool polygons_stay_apart(const Convex<T> &a, const Convex<T> &b, T t, T until, T slop)
{
	const T steps = larger(until, T(1));
	const auto is_easy = [steps](const Convex<T> &body) {
		return !body.is_circle() && body.count <= FourViews<T>::most_corners
			&& std::abs(body.r) + (std::abs(body.w) + std::abs(body.b) * steps) * steps < T(APART_ANGLE);
	};
	return is_easy(a) && is_easy(b) && FourViews<T>(a, b, t, until).are_apart(Haste<T>(a, b, steps).enough(until - t, slop));
}

/* For how many whole steps from the beginning of this one, 2 to `most`, two polygons surely stay apart, though the end of each is rounded; 0 where that is not proved. */
template <typename T> T steps_apart(const Convex<T> &a, const Convex<T> &b, T most)
{
	const T radii = a.radius + b.radius, rate = span(b.v - a.v) + larger(std::abs(a.w), std::abs(b.w)) * radii;
	const T steps = static_cast<T>(static_cast<int32_t>(smaller(T(FORESIGHT) * radii / rate, most)));
	const T slop = (1 + steps) * (pair_slop(a, b) + steps * (span(a.v) + span(b.v) + steps * (span(a.a) + span(b.a))) * T(SLOP));
	return steps >= 2 && polygons_stay_apart(a, b, T(0), steps, slop) ? steps : T(0);
}

}

#endif
