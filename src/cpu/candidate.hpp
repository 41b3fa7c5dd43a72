/* What the search for the first hit compares: a hit time, and where it is. A texel of Reduced or of TileHits. */
#ifndef CAROM_CPU_CANDIDATE_HPP
#define CAROM_CPU_CANDIDATE_HPP

#include "cpu/texture.hpp"

namespace carom::cpu {

template <typename T> struct Candidate {
	T hit, row, column, done;
};

template <typename T> constexpr Candidate<T> no_candidate{NO_HIT, 0, 0, 1};

/* By time, then row, then column: so the order in which they are looked at does not count. */
template <typename T> bool is_before(const Candidate<T> &a, const Candidate<T> &b)
{
	/* Without branches, so that compilers can make vectors of it. */
	return (a.hit < b.hit) | ((a.hit == b.hit) & ((a.row < b.row) | ((a.row == b.row) & (a.column < b.column))));
}

template <typename T> Candidate<T> first_of(const Candidate<T> &a, const Candidate<T> &b)
{
	bool is_b = is_before(b, a);
	return {is_b ? b.hit : a.hit, is_b ? b.row : a.row, is_b ? b.column : a.column, is_b ? b.done : a.done};
}

template <typename T> Candidate<T> candidate_at(const Texels<T> &texels, int32_t x, int32_t y)
{
	return {texels.at(x, y, REDUCED_HIT), texels.at(x, y, REDUCED_ROW), texels.at(x, y, REDUCED_COLUMN), texels.at(x, y, REDUCED_DONE)};
}

template <typename T> void put_candidate(const Texels<T> &texels, int32_t x, int32_t y, const Candidate<T> &candidate)
{
	texels.at(x, y, REDUCED_HIT) = candidate.hit;
	texels.at(x, y, REDUCED_ROW) = candidate.row;
	texels.at(x, y, REDUCED_COLUMN) = candidate.column;
	texels.at(x, y, REDUCED_DONE) = candidate.done;
}

}

#endif
