#include "cpu/filters.hpp"
#include "cpu/stages.hpp"

#include <algorithm>
#include <cstring>

namespace carom::cpu {

constexpr int32_t block = 64 * TILE; /* columns that are looked at together: their boxes stay in the nearest cache */

static_assert(ROW_SIZE % block == 0, "a block's columns lie in one row of the texture");

/* The boxes of bodies from `first` on, one channel each. */
template <typename T> struct Columns {
	const T *min_x, *min_y, *max_x, *max_y;

	Columns(const Texels<T> &boxes, int32_t first)
		: min_x(&boxes.of(first, AABB_MIN_X)), min_y(&boxes.of(first, AABB_MIN_Y)), max_x(&boxes.of(first, AABB_MAX_X)),
		  max_y(&boxes.of(first, AABB_MAX_Y))
	{
	}
};

template <typename T> struct Sides {
	T min_x, min_y, max_x, max_y;

	Sides(const Columns<T> &columns, int32_t k) : min_x(columns.min_x[k]), min_y(columns.min_y[k]), max_x(columns.max_x[k]), max_y(columns.max_y[k])
	{
	}

	/* Without branches, so that compilers can make vectors of it. */
	bool is_apart(const Columns<T> &columns, int32_t k) const
	{
		return (max_x < columns.min_x[k]) | (columns.max_x[k] < min_x) | (max_y < columns.min_y[k]) | (columns.max_y[k] < min_y);
	}
};

/* Which columns' boxes overlap one of the rows'. Most tiles are found to be empty by this, so here the stage's time goes. */
template <typename T> static void find_near(const Columns<T> &rows, int32_t row_count, const Columns<T> &columns, int32_t count, int32_t near[block])
{
	std::fill(near, near + count, 0);
	for (int32_t i = 0; i < row_count; i++) {
		const Sides<T> row(rows, i);
		for (int32_t k = 0; k < count; k++)
			near[k] |= row.is_apart(columns, k) ? 0 : 1;
	}
}

/* Pairs of a tile, by row and column. */
struct TileBytes {
	uint8_t bytes[TILE][TILE] = {};
	bool any = false;
};

template <typename T> class Overlaps
{
public:
	explicit Overlaps(const Job<T> &job)
		: boxes(job.texels(0)), filters(job.list(1)), tiles_before(job.bytes(2)), overlap(job.bytes(3)), tiles(job.bytes(4)), count(job.domain[2])
	{
	}

	void find_row(int32_t r) const
	{
		const Columns<T> rows(boxes, r * TILE);
		const int32_t end = (r + 1) * TILE;
		int32_t near[block];
		for (int32_t first = 0; first < end; first += block) {
			const int32_t last = std::min(first + block, end);
			find_near(rows, std::min(TILE, count - r * TILE), Columns<T>(boxes, first), last - first, near);
			for (int32_t column = first; column < last; column += TILE) {
				const int32_t *of_tile = near + (column - first);
				do_tile(column / TILE, r, std::any_of(of_tile, of_tile + TILE, [](int32_t bit) { return bit != 0; }));
			}
		}
	}

private:
	void do_tile(int32_t c, int32_t r, bool may_overlap) const
	{
		const uint8_t before = *tiles_before.texel(c, r);
		int bits = (before & TILES_NOW ? TILES_BEFORE : 0) | (before & TILES_BEFORE ? TILES_LONG_BEFORE : 0);
		if (may_overlap || (bits & TILES_LONG_BEFORE))
			bits |= write_tile(c, r, bits);
		uint8_t *texel = tiles.texel(c, r);
		texel[0] = static_cast<uint8_t>(bits);
		texel[1] = texel[2] = texel[3] = 0;
	}

	TileBytes look_at(int32_t c, int32_t r, int32_t row_count) const
	{
		const Columns<T> rows(boxes, r * TILE), columns(boxes, c * TILE);
		TileBytes tile;
		for (int32_t i = 0; i < row_count; i++) {
			const Sides<T> row(rows, i);
			for (int32_t k = 0; k < (c == r ? i : TILE); k++) {
				const bool is_overlap = !row.is_apart(columns, k) && filters.let(r * TILE + i, c * TILE + k);
				tile.bytes[i][k] = is_overlap;
				tile.any |= is_overlap;
			}
		}
		return tile;
	}

	int write_tile(int32_t c, int32_t r, int bits) const
	{
		const int32_t row_count = std::min(TILE, count - r * TILE);
		const TileBytes tile = look_at(c, r, row_count);
		for (int32_t i = 0; i < row_count && (tile.any || (bits & TILES_LONG_BEFORE)); i++)
			std::memcpy(overlap.row(r * TILE + i) + c * TILE, tile.bytes[i], TILE);
		return tile.any ? TILES_NOW : 0;
	}

	const Texels<T> boxes;
	const Filters filters;
	const Bytes tiles_before, overlap, tiles;
	const int32_t count;
};

/* The paper's broad phase: every pair [2.1]. */
template <typename T> static void all_pairs(const Job<T> &job)
{
	const Overlaps<T> overlaps(job);
	job.pool.run(job.domain[0], 8, [&](int32_t begin, int32_t end) {
		for (int32_t r = begin; r < end; r++)
			overlaps.find_row(r);
	});
}

extern const Stage overlap_all_pairs;
const Stage overlap_all_pairs{"overlap", "all_pairs", {{STAGE_OVERLAP, all_pairs<float>, all_pairs<double>}}, nullptr, nullptr};

}
