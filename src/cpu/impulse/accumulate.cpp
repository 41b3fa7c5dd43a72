#include "cpu/impulse.hpp"

namespace carom::cpu {

/* The paper's: each point as if it were the only one [2.3]. Of events only the faster one, if one's push drives the other apart, too. */
template <typename T> static Impulses<T> each_alone(const Collision<T> &collision)
{
	Impulses<T> j{};
	const bool single = collision.event && collision.contact.count > 1 && collision.coupling(0, 1) > 0;
	const int faster = single && collision.contact.rate[1] < collision.contact.rate[0];
	for (int i = 0; i < 2; i++) {
		if (collision.is_hit(i) && (!single || i == faster))
			j.at[i] = collision.alone(i);
	}
	return j;
}

template <typename T> static void accumulate(const Job<T> &job)
{
	find_impulse(job, each_alone<T>);
}

extern const Stage impulse_accumulate;
const Stage impulse_accumulate{"impulse", "accumulate", {{STAGE_IMPULSE, accumulate<float>, accumulate<double>}}, nullptr, nullptr, nullptr, nullptr,
	{nullptr, nullptr, each_alone<float>}, {nullptr, nullptr, each_alone<double>}};

}
