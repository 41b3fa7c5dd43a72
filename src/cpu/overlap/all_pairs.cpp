#include "cpu/stages.hpp"

#include <algorithm>
#include <cstring>

namespace carom::cpu {

static_assert(ROW_SIZE % TILE == 0, "a tile's columns lie in one row of the texture");

/* The boxes of TILE bodies, one channel each. */
template <typename T> struct Columns {
	const T *min_x, *min_y, *max_x, *max_y;

	Columns(const Texels<T> &boxes, int32_t first)
		: min_x(&boxes.of(first, AABB_MIN_X)), min_y(&boxes.of(first, AABB_MIN_Y)), max_x(&boxes.of(first, AABB_MAX_X)),
		  max_y(&boxes.of(first, AABB_MAX_Y))
	{
	}
};

template <typename T> struct Box {
	T min_x, min_y, max_x, max_y;

	Box(const Columns<T> &columns, int32_t k)
		: min_x(columns.min_x[k]), min_y(columns.min_y[k]), max_x(columns.max_x[k]), max_y(columns.max_y[k])
	{
	}

	/* Without branches, so that compilers can make vectors of it. */
	bool is_apart(const Columns<T> &columns, int32_t k) const
	{
		return (max_x < columns.min_x[k]) | (columns.max_x[k] < min_x) | (max_y < columns.min_y[k]) | (columns.max_y[k] < min_y);
	}
};

/* Most tiles are found to be empty here: the loop that the stage's time goes to. */
template <typename T> static bool are_apart(const Columns<T> &rows, int32_t row_count, const Columns<T> &columns)
{
	int32_t apart[TILE];
	std::fill(apart, apart + TILE, -1);
	for (int32_t i = 0; i < row_count; i++) {
		const Box<T> row(rows, i);
		for (int32_t k = 0; k < TILE; k++)
			apart[k] &= row.is_apart(columns, k) ? -1 : 0;
	}
	int32_t all = -1;
	for (int32_t bits : apart)
		all &= bits;
	return all != 0;
}

/* The tile's rows of Overlap; is there anything in them? */
template <typename T>
static bool write_tile(
	const Columns<T> &rows, int32_t row_count, const Columns<T> &columns, bool diagonal, uint8_t bytes[TILE][TILE])
{
	bool any = false;
	for (int32_t i = 0; i < row_count; i++) {
		const Box<T> row(rows, i);
		for (int32_t k = 0; k < TILE; k++) {
			bool overlap = (!diagonal || k < i) && !row.is_apart(columns, k);
			bytes[i][k] = overlap;
			any |= overlap;
		}
	}
	return any;
}

/* Tile (c, r) of a world of `count` bodies. */
template <typename T>
static void do_tile(
	const Texels<T> &boxes, int32_t c, int32_t r, int32_t count, const uint8_t *before, const Bytes &overlap, uint8_t *now)
{
	const Columns<T> rows(boxes, r * TILE), columns(boxes, c * TILE);
	const int32_t row_count = std::min(TILE, count - r * TILE);
	uint8_t bytes[TILE][TILE] = {};
	int bits = (*before & TILES_NOW ? TILES_BEFORE : 0) | (*before & TILES_BEFORE ? TILES_LONG_BEFORE : 0);
	if ((c == r || !are_apart(rows, row_count, columns)) && write_tile(rows, row_count, columns, c == r, bytes))
		bits |= TILES_NOW;
	if (bits & (TILES_NOW | TILES_LONG_BEFORE)) {
		for (int32_t i = 0; i < row_count; i++)
			std::memcpy(overlap.row(r * TILE + i) + c * TILE, bytes[i], TILE);
	}
	const uint8_t texel[channel_count] = {static_cast<uint8_t>(bits)};
	std::memcpy(now, texel, sizeof texel);
}

/* The paper's broad phase: every pair [2.1]. */
template <typename T> static void all_pairs(const Job<T> &job)
{
	const Texels<T> boxes = job.texels(0);
	const Bytes before = job.bytes(1), overlap = job.bytes(2), now = job.bytes(3);
	const int32_t count = job.domain[2];
	job.pool.run((count + TILE - 1) / TILE, 8, [&](int32_t begin, int32_t end) {
		for (int32_t r = begin; r < end; r++) {
			for (int32_t c = 0; c <= r; c++)
				do_tile(boxes, c, r, count, before.texel(c, r), overlap, now.texel(c, r));
		}
	});
}

extern const Stage overlap_all_pairs;
const Stage overlap_all_pairs{"overlap", "all_pairs", {{STAGE_OVERLAP, all_pairs<float>, all_pairs<double>}}, nullptr, nullptr};

}
