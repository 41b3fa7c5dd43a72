#include "cpu/reduce.hpp"

#include <algorithm>

namespace carom::cpu {

/* Whole tiles at a time, from the tiles' first hits on, the diagonal with them. */
template <typename T> static void tiled(const Job<T> &job)
{
	const ReducedSource<T> source(job.texels(0));
	const int32_t size = job.domain[2];
	reduce_from(job, source, [size](const auto &from, int32_t y, int32_t, auto put) {
		for (int32_t x = 0; x <= y; x++) {
			Candidate<T> first{NO_HIT, 0, 0, 1};
			for (int32_t row = y * TILE; row < std::min((y + 1) * TILE, size); row++) {
				for (int32_t column = x * TILE; column < (x + 1) * TILE && column <= row; column++)
					first = first_of(first, from.at(column, row));
			}
			put(x, first);
		}
	});
}

extern const Stage reduce_tiled;
const Stage reduce_tiled{"reduce", "tiled", {{STAGE_REDUCE_TILES, tiled<float>, tiled<double>}}, nullptr, nullptr};

}
