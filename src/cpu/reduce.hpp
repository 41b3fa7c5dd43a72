/* What the alternatives of the slot reduce share: one pass from a square of candidates to the one half its size. [2.2] */
#ifndef CAROM_CPU_REDUCE_HPP
#define CAROM_CPU_REDUCE_HPP

#include "cpu/candidate.hpp"
#include "cpu/stages.hpp"

namespace carom::cpu {

/* HitTimes as candidates, for the first pass. */
template <typename T> class HitTimesSource
{
public:
	explicit HitTimesSource(const Texels<T> &hit_times) : texels(hit_times) {}
	Candidate<T> at(int32_t x, int32_t y) const
	{
		return {texels.at(x, y, HITTIMES_HIT), static_cast<T>(y), static_cast<T>(x), texels.at(x, y, HITTIMES_DONE)};
	}

private:
	Texels<T> texels;
};

template <typename T> class ReducedSource
{
public:
	explicit ReducedSource(const Texels<T> &reduced) : texels(reduced) {}
	Candidate<T> at(int32_t x, int32_t y) const { return candidate_at(texels, x, y); }

private:
	Texels<T> texels;
};

/* The same, counting what is read. */
template <typename Source> class CountedSource
{
public:
	CountedSource(const Source &counted, std::atomic<uint64_t> &counter) : source(counted), reads(counter) {}
	auto at(int32_t x, int32_t y) const
	{
		reads.fetch_add(1, std::memory_order_relaxed);
		return source.at(x, y);
	}

private:
	const Source &source;
	std::atomic<uint64_t> &reads;
};

/* The 2 x 2 square that fragment (x, y) stands for. */
template <typename Source> auto four(const Source &source, int32_t x, int32_t y)
{
	return first_of(first_of(source.at(2 * x, 2 * y), source.at(2 * x + 1, 2 * y)),
		first_of(source.at(2 * x, 2 * y + 1), source.at(2 * x + 1, 2 * y + 1)));
}

/* And the texels below the diagonal in the squares on it, left and below, for which no fragment stands. */
template <typename Source> auto six(const Source &source, int32_t x, int32_t y)
{
	return first_of(four(source, x, y), first_of(source.at(2 * x, 2 * x + 1), source.at(2 * y, 2 * y + 1)));
}

/* Runs the slot: `reduce_row(source, y, m, put)` calls put(x, candidate) for its fragments of row y. */
template <typename T, typename Source, typename ReduceRow> void reduce_from(const Job<T> &job, const Source &source, ReduceRow reduce_row)
{
	const Texels<T> target = job.texels(1);
	const int32_t m = job.domain[0];
	job.pool.run(m, 32, [&](int32_t begin, int32_t end) {
		for (int32_t y = begin; y < end; y++) {
			T *hit = target.row(y, REDUCED_HIT), *row = target.row(y, REDUCED_ROW);
			T *column = target.row(y, REDUCED_COLUMN), *done = target.row(y, REDUCED_DONE);
			reduce_row(source, y, m, [=](int32_t x, const Candidate<T> &candidate) {
				hit[x] = candidate.hit;
				row[x] = candidate.row;
				column[x] = candidate.column;
				done[x] = candidate.done;
			});
		}
	});
}

template <typename T, typename Source, typename ReduceRow> void reduce_source(const Job<T> &job, const Source &source, ReduceRow reduce_row)
{
	if (job.reads)
		reduce_from(job, CountedSource<Source>(source, *job.reads), reduce_row);
	else
		reduce_from(job, source, reduce_row);
}

template <typename T, typename ReduceRow> void reduce(const Job<T> &job, ReduceRow reduce_row)
{
	if (job.domain[2] == 0)
		reduce_source(job, HitTimesSource<T>(job.texels(0)), reduce_row);
	else
		reduce_source(job, ReducedSource<T>(job.texels(0)), reduce_row);
}

/* The last pass of those that keep below the diagonal: one texel is left there. */
template <typename T> void reduce_last(const Job<T> &job)
{
	reduce(job, [](const auto &source, int32_t, int32_t, auto put) { put(0, source.at(0, 1)); });
}

}

#endif
