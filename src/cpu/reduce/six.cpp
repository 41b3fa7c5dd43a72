#include "cpu/reduce.hpp"

namespace carom::cpu {

/* Below the diagonal alone, all fragments alike: the paper's 6-reduction [2.2]. */
template <typename T> static void six_everywhere(const Job<T> &job)
{
	if (job.domain[0] == 1) {
		reduce_last(job);
		return;
	}
	reduce(job, [](const auto &source, int32_t y, int32_t, auto put) {
		for (int32_t x = 0; x < y; x++)
			put(x, six(source, x, y));
	});
}

extern const Stage reduce_six;
const Stage reduce_six{"reduce", "six", {{STAGE_REDUCE, six_everywhere<float>, six_everywhere<double>}}, nullptr, nullptr};

}
