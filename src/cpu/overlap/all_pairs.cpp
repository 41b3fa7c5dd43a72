#include "cpu/stages.hpp"

#include <algorithm>

namespace carom::cpu {

/* The columns of one tile against row i: bit k is set where column k's box overlaps the row's, below the diagonal. */
template <typename T> static uint32_t overlaps(const Texels<T> &boxes, int32_t first, int32_t i)
{
	const int32_t fold = first >> ROW_LOG2, at = first & (ROW_SIZE - 1);
	const T *min_x = boxes.row(fold, AABB_MIN_X) + at, *min_y = boxes.row(fold, AABB_MIN_Y) + at;
	const T *max_x = boxes.row(fold, AABB_MAX_X) + at, *max_y = boxes.row(fold, AABB_MAX_Y) + at;
	const T left = boxes.of(i, AABB_MIN_X), bottom = boxes.of(i, AABB_MIN_Y);
	const T right = boxes.of(i, AABB_MAX_X), top = boxes.of(i, AABB_MAX_Y);
	uint32_t bits = 0;
	for (int32_t k = 0; k < TILE; k++) {
		bool apart = (right < min_x[k]) | (max_x[k] < left) | (top < min_y[k]) | (max_y[k] < bottom);
		bits |= static_cast<uint32_t>(!apart & (first + k < i)) << k;
	}
	return bits;
}

/* What a tile's texel says, from what it said a step ago. */
static int tile_state(bool any, int old)
{
	return (any ? TILES_NOW : 0) | (old & TILES_NOW ? TILES_BEFORE : 0) | (old & TILES_BEFORE ? TILES_LONG_BEFORE : 0);
}

/* The paper's broad phase: every pair [2.1]. */
template <typename T> static void all_pairs(const Job<T> &job)
{
	const Texels<T> boxes = job.texels(0);
	const Bytes before = job.bytes(1), now = job.bytes(2), tiles = job.bytes(3);
	const int32_t count = job.domain[2];
	job.pool.run(job.domain[0], 8, [&](int32_t begin, int32_t end) {
		for (int32_t r = begin; r < end; r++) {
			const int32_t last = std::min((r + 1) * TILE, count);
			for (int32_t c = 0; c <= r; c++) {
				uint32_t bits[TILE] = {}, any = 0;
				for (int32_t i = r * TILE; i < last; i++)
					any |= bits[i % TILE] = overlaps(boxes, c * TILE, i);
				const int state = tile_state(any != 0, before.row(r)[4 * c]);
				tiles.row(r)[4 * c] = static_cast<uint8_t>(state);
				for (int32_t i = r * TILE; i < last && state & (TILES_NOW | TILES_LONG_BEFORE); i++) {
					for (int32_t k = 0; k < TILE; k++)
						now.row(i)[c * TILE + k] = (bits[i % TILE] >> k) & 1;
				}
			}
		}
	});
}

extern const Stage overlap_all_pairs;
const Stage overlap_all_pairs{"overlap", "all_pairs", {{STAGE_OVERLAP, all_pairs<float>, all_pairs<double>}}, nullptr, nullptr};

}
