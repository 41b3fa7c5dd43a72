/* What forces at several points of a body do together: CONTRACT.md, "The step contacts", Shares. */
#ifndef CAROM_CPU_RESPONSE_HPP
#define CAROM_CPU_RESPONSE_HPP

#include "cpu/lanes.hpp"
#include "cpu/numbers.hpp"

namespace carom::cpu {

/* A symmetric matrix of x, y and torque: its diagonal, and beside it xy, xt, yt. */
template <typename T> struct Response {
	T own[3] = {}, beside[3] = {};

	Response squared() const
	{
		const T(&d)[3] = own, xy = beside[0], xt = beside[1], yt = beside[2];
		return {{(d[0] * d[0] + xy * xy) + xt * xt, (xy * xy + d[1] * d[1]) + yt * yt, (xt * xt + yt * yt) + d[2] * d[2]},
			{(d[0] * xy + xy * d[1]) + xt * yt, (d[0] * xt + xy * yt) + xt * d[2], (xy * xt + d[1] * yt) + yt * d[2]}};
	}

	/* The sum of the squares of all its eigenvalues. */
	T squares() const
	{
		return ((own[0] * own[0] + own[1] * own[1]) + own[2] * own[2])
			+ 2 * ((beside[0] * beside[0] + beside[1] * beside[1]) + beside[2] * beside[2]);
	}

	/* Of its eigenvalues: by its rows, and by their eighth powers, of which the largest is the most of the sum. */
	T bound() const
	{
		const T xy = std::abs(beside[0]), xt = std::abs(beside[1]), yt = std::abs(beside[2]);
		const T rows[] = {(std::abs(own[0]) + xy) + xt, (xy + std::abs(own[1])) + yt, (xt + yt) + std::abs(own[2])};
		return smaller(larger(larger(rows[0], rows[1]), rows[2]), std::sqrt(std::sqrt(std::sqrt(squared().squared().squares()))));
	}
};

/* What forces at four points along a unit vector each do, by themselves as if each alone gave way by 1. */
template <typename T> class Responses
{
public:
	Responses(T straight, T turning, T both, const Lanes<T> &x, const Lanes<T> &y, const Lanes<T> &arm)
		: Responses(x, y, arm, straight + turning * (arm * arm), straight, turning, both)
	{
	}

	void add(int32_t i, Response<T> &all) const
	{
		all.own[0] += xx[i], all.own[1] += yy[i], all.own[2] += tt[i];
		all.beside[0] += xy[i], all.beside[1] += xt[i], all.beside[2] += yt[i];
	}

private:
	Responses(const Lanes<T> &x, const Lanes<T> &y, const Lanes<T> &arm, const Lanes<T> &give, T straight, T turning, T both)
		: xx((straight / give) * (x * x)), xy((straight / give) * (x * y)), yy((straight / give) * (y * y)), xt((both / give) * (x * arm)),
		  yt((both / give) * (y * arm)), tt((turning / give) * (arm * arm))
	{
	}

	const Lanes<T> xx, xy, yy, xt, yt, tt;
};

}

#endif
