#include "cpu/search.hpp"

namespace carom::cpu {

/* Advances by times that are safe, whatever the shapes. */
template <typename T> static void separating(const Job<T> &job)
{
	find_hits(job, separating_search<T>);
}

template <typename T> static HitTime<T> time(const Pair<T> &pair, const SearchRules<T> &)
{
	return separating_search(pair);
}

extern const Stage toi_separating;
const Stage toi_separating{"toi", "separating", {{STAGE_TOI_FIRST, separating<float>, separating<double>}}, nullptr, nullptr, nullptr, nullptr,
	{time<float>}, {time<double>}};

}
