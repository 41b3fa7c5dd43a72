#include "cpu/vertices.hpp"

namespace carom::cpu {

/* From what was read back and is sent [3, toCPU]. */
template <typename T> static Transform<T> to_cpu(const Job<T> &job, int32_t body)
{
	const Texels<T> sent = job.texels(PLACE_TRANSFORMS);
	return {sent.of(body, TRANSFORMS_X), sent.of(body, TRANSFORMS_Y), sent.of(body, TRANSFORMS_ANGLE)};
}

extern const Stage transforms_to_cpu;
const Stage transforms_to_cpu{"transforms", "to_cpu", {}, nullptr, nullptr, to_cpu<float>, to_cpu<double>};

}
