#include "cpu/reduce.hpp"

namespace carom::cpu {

/* Below the diagonal alone, six texels only beside it: the paper's (4+6)-reduction [2.2]. */
template <typename T> static void four_six(const Job<T> &job)
{
	if (job.domain[0] == 1)
		reduce_last(job);
	else
		reduce(job, job.domain[0], [](int32_t y) { return Ends{y - 1, y}; });
}

extern const Stage reduce_four_six;
const Stage reduce_four_six{"reduce", "four_six", {{STAGE_REDUCE, four_six<float>, four_six<double>}}, nullptr, nullptr};

}
