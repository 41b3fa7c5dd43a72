/* What the alternatives of the slot reduce share: one pass from a square of candidates to the one half its size. [2.2] */
#ifndef CAROM_CPU_REDUCE_HPP
#define CAROM_CPU_REDUCE_HPP

#include <algorithm>

#include "cpu/candidate.hpp"
#include "cpu/stages.hpp"

namespace carom::cpu {

/* What a pass reads: HitTimes in the first, the level before in the others. */
template <typename T> class Source
{
public:
	explicit Source(const Job<T> &job) : texels(job.texels(0)), is_first(job.domain[2] == 0), reads(job.reads) {}

	Candidate<T> at(int32_t x, int32_t y) const
	{
		if (reads)
			reads->fetch_add(1, std::memory_order_relaxed);
		if (!is_first)
			return candidate_at(texels, x, y);
		const T hit = texels.at(x, y, HITTIMES_HIT);
		return hit < NO_HIT ? Candidate<T>{hit, static_cast<T>(y), static_cast<T>(x), texels.at(x, y, HITTIMES_DONE)} : no_candidate<T>;
	}

	/* What is counted has to be read with at. */
	bool is_counted() const { return reads; }
	const T *hits(int32_t y) const { return texels.row(y, is_first ? HITTIMES_HIT : REDUCED_HIT); }

private:
	Texels<T> texels;
	bool is_first;
	std::atomic<uint64_t> *reads;
};

/* The 2 x 2 square that a fragment stands for. */
struct Four {
	/* Has any of the fragments `begin` to `end` - 1 of row y a hit? Without branches, so that compilers can make vectors of it. */
	template <typename T> static bool any(const Source<T> &source, int32_t begin, int32_t end, int32_t y)
	{
		const T *above = source.hits(2 * y), *below = source.hits(2 * y + 1);
		int found = 0;
		for (int32_t x = 2 * begin; x < 2 * end; x++)
			found |= (above[x] < NO_HIT) | (below[x] < NO_HIT);
		return found;
	}

	template <typename T> static Candidate<T> first(const Source<T> &source, int32_t x, int32_t y)
	{
		return first_of(first_of(source.at(2 * x, 2 * y), source.at(2 * x + 1, 2 * y)),
			first_of(source.at(2 * x, 2 * y + 1), source.at(2 * x + 1, 2 * y + 1)));
	}
};

/* And the texels below the diagonal in the squares on it, left and below, for which no fragment stands. */
struct Six {
	template <typename T> static bool any(const Source<T> &source, int32_t begin, int32_t end, int32_t y)
	{
		int found = source.hits(2 * y + 1)[2 * y] < NO_HIT;
		for (int32_t x = begin; x < end; x++)
			found |= source.hits(2 * x + 1)[2 * x] < NO_HIT;
		return found | Four::any(source, begin, end, y);
	}

	template <typename T> static Candidate<T> first(const Source<T> &source, int32_t x, int32_t y)
	{
		return first_of(Four::first(source, x, y), first_of(source.at(2 * x, 2 * x + 1), source.at(2 * y, 2 * y + 1)));
	}
};

/* Fragments `begin` to `end` - 1 of row y. Mostly none has a hit, and what each has need not be asked. */
template <typename Fragment, typename T> void reduce_some(const Source<T> &source, const Texels<T> &target, int32_t begin, int32_t end, int32_t y)
{
	if (begin >= end)
		return;
	if (source.is_counted() || Fragment::any(source, begin, end, y)) {
		for (int32_t x = begin; x < end; x++)
			put_candidate(target, x, y, Fragment::first(source, x, y));
		return;
	}
	std::fill(target.row(y, REDUCED_HIT) + begin, target.row(y, REDUCED_HIT) + end, no_candidate<T>.hit);
	std::fill(target.row(y, REDUCED_ROW) + begin, target.row(y, REDUCED_ROW) + end, no_candidate<T>.row);
	std::fill(target.row(y, REDUCED_COLUMN) + begin, target.row(y, REDUCED_COLUMN) + end, no_candidate<T>.column);
	std::fill(target.row(y, REDUCED_DONE) + begin, target.row(y, REDUCED_DONE) + end, no_candidate<T>.done);
}

/* Where a row's fragments of four texels end, and where all do: the others take six. */
struct Ends {
	int32_t fours, all;
};

constexpr int32_t stretch = 64; /* fragments that are looked at together */

/* Runs the slot, `block` columns of a few rows after the other; `ends(y)` says which fragments row y has. */
template <typename T, typename FindEnds> void reduce(const Job<T> &job, int32_t block, FindEnds ends)
{
	const Source<T> source(job);
	const Texels<T> target = job.texels(1);
	job.pool.run(job.domain[0], 32, [&](int32_t first, int32_t last) {
		for (int32_t left = 0; left < ends(last - 1).all; left += block) {
			for (int32_t y = first; y < last; y++) {
				const Ends row = ends(y);
				for (int32_t begin = left; begin < std::min(left + block, row.all); begin += stretch) {
					reduce_some<Four>(source, target, begin, std::min(begin + stretch, row.fours), y);
					reduce_some<Six>(source, target, std::max(begin, row.fours), std::min(begin + stretch, row.all), y);
				}
			}
		}
	});
}

/* The last pass of those that keep below the diagonal: one texel is left there. */
template <typename T> void reduce_last(const Job<T> &job)
{
	put_candidate(job.texels(1), 0, 0, Source<T>(job).at(0, 1));
}

}

#endif
