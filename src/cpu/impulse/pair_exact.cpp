#include "cpu/impulse.hpp"

namespace carom::cpu {

/* The impulses that turn both points' rates round, if both push. */
template <typename T> static bool solve(const Collision<T> &collision, Impulses<T> &j)
{
	const Contact<T> &c = collision.contact;
	const T i_ref = collision.ref_inertia, i_inc = collision.inc_inertia, gain0 = collision.gain(0), gain1 = collision.gain(1);
	const T r0 = cross(c.ref[0], c.n), r1 = cross(c.ref[1], c.n), s0 = cross(c.inc[0], c.n), s1 = cross(c.inc[1], c.n);
	const T dr = r1 - r0, ds = s1 - s0, twist = r0 * ds - s0 * dr;
	/* k00 k11 - k01 k01, without the parts that cancel: of points near each other nothing would be left */
	const T det = (collision.ref_mass + collision.inc_mass) * (i_ref * (dr * dr) + i_inc * (ds * ds)) + (i_ref * twist) * (i_inc * twist);
	const T k00 = collision.coupling(0, 0), k01 = collision.coupling(0, 1), k11 = collision.coupling(1, 1);
	if (!(det > SINGULAR * (k00 * k11)))
		return false;
	const T above0 = -(i_ref * (r0 * dr) + i_inc * (s0 * ds)), above1 = i_ref * (r1 * dr) + i_inc * (s1 * ds); /* k00 - k01, k11 - k01 */
	/* their sum by the sum of both equations: whatever rounding makes of the difference, the points together get what is theirs */
	const T difference = (2 * ((gain1 - gain0) * k01) + (gain1 * above0 - gain0 * above1)) / det;
	const T sum = (2 * (gain0 + gain1) - difference * (above1 - above0)) / ((k00 + k11) + 2 * k01);
	j = {{T(0.5) * (sum - difference), T(0.5) * (sum + difference)}};
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
