#include "cpu/body.hpp"

namespace carom::cpu {

/* Every side's half-plane [2.1]. */
template <typename T> static bool naive(const Convex<T> &polygon, const Vec<T> &point)
{
	Vec<T> from = polygon.vertex(polygon.count - 1);
	for (int32_t k = 0; k < polygon.count; k++) {
		Vec<T> to = polygon.vertex(k);
		if (!(cross(to - from, point - from) > 0))
			return false;
		from = to;
	}
	return true;
}

extern const Stage inside_naive;
const Stage inside_naive{"inside", "naive", {}, naive<float>, naive<double>};

}
