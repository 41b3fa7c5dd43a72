#include "cpu/body.hpp"

namespace carom::cpu {

template <typename T> static bool is_left(const Convex<T> &polygon, int32_t from, int32_t to, const Vec<T> &point)
{
	Vec<T> corner = polygon.vertex(from);
	return cross(polygon.vertex(to) - corner, point - corner) > 0;
}

/* O'Rourke's: the wedge from vertex 0 that the point lies in, by bisection, and then the one side that closes it [2.1]. */
template <typename T> static bool orourke(const Convex<T> &polygon, const Vec<T> &point)
{
	int32_t low = 1, high = polygon.count - 1;
	if (!is_left(polygon, 0, low, point) || !is_left(polygon, high, 0, point))
		return false;
	while (high - low > 1) {
		int32_t middle = (low + high) / 2;
		(is_left(polygon, 0, middle, point) ? low : high) = middle;
	}
	return is_left(polygon, low, high, point);
}

extern const Stage inside_orourke;
const Stage inside_orourke{"inside", "orourke", {}, orourke<float>, orourke<double>};

}
