#include "cpu/impulse.hpp"

namespace carom::cpu {

/* The impulses that turn both points' rates round, if both push. */
template <typename T> static bool solve(const Collision<T> &collision, Impulses<T> &j)
{
	T k00 = collision.coupling(0, 0), k01 = collision.coupling(0, 1), k11 = collision.coupling(1, 1);
	T gain0 = collision.gain(0), gain1 = collision.gain(1);
	T det = k00 * k11 - k01 * k01;
	if (!(det > SINGULAR * (k00 * k11)))
		return false;
	j = {{(gain0 * k11 - gain1 * k01) / det, (gain1 * k00 - gain0 * k01) / det}};
	return j.at[0] >= 0 && j.at[1] >= 0;
}

/* The two points together, so that a face contact keeps the energy: each alone would count the push twice. */
template <typename T> static Impulses<T> together(const Collision<T> &collision)
{
	Impulses<T> j{};
	bool first = collision.is_hit(0), second = collision.is_hit(1);
	if (!first && !second)
		return j;
	if (first && second) {
		if (solve(collision, j))
			return j;
		second = collision.contact.rate[1] < collision.contact.rate[0];
		j = {};
	}
	j.at[second ? 1 : 0] = collision.alone(second ? 1 : 0);
	return j;
}

template <typename T> static void pair_exact(const Job<T> &job)
{
	find_impulse(job, together<T>);
}

extern const Stage impulse_pair_exact;
const Stage impulse_pair_exact{"impulse", "pair_exact", {{STAGE_IMPULSE, pair_exact<float>, pair_exact<double>}}, nullptr, nullptr, nullptr, nullptr,
	{nullptr, nullptr, together<float>}, {nullptr, nullptr, together<double>}};

}
