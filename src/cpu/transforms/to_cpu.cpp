#include "cpu/vertices.hpp"

namespace carom::cpu {

/* From what was read back and is sent [3, toCPU]. */
template <typename T> static void to_cpu(const Job<T> &job, Transforms<T> &transforms, int32_t count)
{
	const Texels<T> sent = job.texels(PLACE_TRANSFORMS);
	for (int32_t k = 0; k < count; k++) {
		const int32_t body = transforms.body[k];
		transforms.x[k] = sent.of(body, TRANSFORMS_X), transforms.y[k] = sent.of(body, TRANSFORMS_Y);
		transforms.angle[k] = sent.of(body, TRANSFORMS_ANGLE);
	}
}

extern const Stage transforms_to_cpu;
const Stage transforms_to_cpu{"transforms", "to_cpu", {}, nullptr, nullptr, to_cpu<float>, to_cpu<double>};

}
