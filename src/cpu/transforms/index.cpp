#include "cpu/vertices.hpp"

namespace carom::cpu {

/* From the state, where it lies [3, Index]. */
template <typename T> static void index(const Job<T> &job, Transforms<T> &transforms, int32_t count)
{
	const Accessed<T> linear(job, PLACE_LINEAR), rotational(job, PLACE_ROTATIONAL);
	for (int32_t k = 0; k < count; k++) {
		const auto l = linear.of(transforms.body[k]), r = rotational.of(transforms.body[k]);
		transforms.x[k] = l[LINEAR_X], transforms.y[k] = l[LINEAR_Y], transforms.angle[k] = r[ROTATIONAL_ANGLE];
	}
}

extern const Stage transforms_index;
const Stage transforms_index{"transforms", "index", {}, nullptr, nullptr, index<float>, index<double>};

}
