#include "cpu/search.hpp"

namespace carom::cpu {

/* Advances by times that are safe, whatever the shapes. */
template <typename T> static void separating(const Job<T> &job)
{
	find_hits(job, separating_search<T>);
}

extern const Stage toi_separating;
const Stage toi_separating{"toi", "separating", {{STAGE_TOI_FIRST, separating<float>, separating<double>}}, nullptr, nullptr};

}
