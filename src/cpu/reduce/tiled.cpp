#include "cpu/candidate.hpp"
#include "cpu/stages.hpp"

#include <algorithm>

namespace carom::cpu {

/* The first candidate of the tile, in a square of live size `size` of which what lies above the diagonal is not looked at. Counts
 * what is. */
template <typename T> static Candidate<T> first_in_tile(const Texels<T> &source, int32_t x, int32_t y, int32_t size, std::atomic<uint64_t> *reads)
{
	Candidate<T> first = candidate_at(source, x * TILE, y * TILE);
	for (int32_t row = y * TILE; row < std::min((y + 1) * TILE, size); row++) {
		const T *hits = source.row(row, REDUCED_HIT);
		const int32_t end = std::min((x + 1) * TILE, row + 1);
		if (reads)
			reads->fetch_add(static_cast<uint64_t>(end - x * TILE), std::memory_order_relaxed);
		for (int32_t column = x * TILE; column < end; column++) {
			if (hits[column] <= first.hit)
				first = first_of(first, candidate_at(source, column, row));
		}
	}
	return first;
}

/* Begins with the first hits of the tiles that toi looked at, and takes a whole tile of them a fragment. */
template <typename T> static void tiled(const Job<T> &job)
{
	const Texels<T> source = job.texels(0), target = job.texels(1);
	job.pool.run(job.domain[1], 8, [&](int32_t begin, int32_t end) {
		for (int32_t y = begin; y < end; y++) {
			for (int32_t x = 0; x <= y; x++)
				put_candidate(target, x, y, first_in_tile(source, x, y, job.domain[2], job.reads));
		}
	});
}

extern const Stage reduce_tiled;
const Stage reduce_tiled{"reduce", "tiled", {{STAGE_REDUCE_TILES, tiled<float>, tiled<double>}}, nullptr, nullptr};

}
