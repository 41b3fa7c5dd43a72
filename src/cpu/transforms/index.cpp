#include "cpu/vertices.hpp"

namespace carom::cpu {

/* From the state, where it lies [3, Index]. */
template <typename T> static Transform<T> index(const Job<T> &job, int32_t body)
{
	const auto l = Accessed<T>(job, PLACE_LINEAR).of(body), r = Accessed<T>(job, PLACE_ROTATIONAL).of(body);
	return {l[LINEAR_X], l[LINEAR_Y], r[ROTATIONAL_ANGLE]};
}

extern const Stage transforms_index;
const Stage transforms_index{"transforms", "index", {}, nullptr, nullptr, index<float>, index<double>};

}
