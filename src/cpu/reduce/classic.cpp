#include "cpu/reduce.hpp"

namespace carom::cpu {

/* The whole square [2.2]. */
template <typename T> static void classic(const Job<T> &job)
{
	reduce(job, [](const auto &source, int32_t y, int32_t m, auto put) {
		for (int32_t x = 0; x < m; x++)
			put(x, four(source, x, y));
	});
}

extern const Stage reduce_classic;
const Stage reduce_classic{"reduce", "classic", {{STAGE_REDUCE, classic<float>, classic<double>}}, nullptr, nullptr};

}
