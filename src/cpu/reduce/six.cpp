#include "cpu/reduce.hpp"

namespace carom::cpu {

/* What so many fragments of a row read beside the diagonal, a texel a row, stays in the cache for the next row. */
constexpr int32_t near_diagonal = 128;

/* Below the diagonal alone, all fragments alike: the paper's 6-reduction [2.2]. */
template <typename T> static void six_everywhere(const Job<T> &job)
{
	if (job.domain[0] == 1)
		reduce_last(job);
	else
		reduce(job, near_diagonal, [](int32_t y) { return Ends{0, y}; });
}

extern const Stage reduce_six;
const Stage reduce_six{"reduce", "six", {{STAGE_REDUCE, six_everywhere<float>, six_everywhere<double>}}, nullptr, nullptr};

}
