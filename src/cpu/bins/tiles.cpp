#include "cpu/pixels.hpp"

#include <algorithm>
#include <cstring>

namespace carom::cpu {

struct Tiles {
	int32_t column, row, column_end, row_end;
};

/* The frame, cut into tiles. */
template <typename T> class Tiling
{
public:
	const int32_t columns, rows;

	Tiling(const Records<T> &of_shapes, const Texels<T> &frame)
		: columns(static_cast<int32_t>(frame.fact(FRAME_TILES, TILES_COLUMNS))), rows(static_cast<int32_t>(frame.fact(FRAME_TILES, TILES_ROWS))),
		  boxes(of_shapes), least(corner(frame, BOX_X0, BOX_Y0)), most(corner(frame, BOX_X1, BOX_Y1))
	{
	}

	/* Which tiles a shape touches. */
	Tiles of(int32_t shape) const
	{
		Lanes<T> box;
		std::memcpy(&box, &boxes.of(shape, 0), sizeof box);
		const Lanes<T> cut = smaller(larger(box, least), most);
		if (!(cut[BOX_X0] < cut[BOX_X1] && cut[BOX_Y0] < cut[BOX_Y1]))
			return {0, 0, 0, 0}; /* not seen, as most radius lines */
		const Lanes<T> parts{T(1) / tile_width, T(1) / tile_height, T(1) / tile_width, T(1) / tile_height};
		const Whole tiles = __builtin_convertvector(((cut - least) + Lanes<T>{0, 0, tile_width - 1, tile_height - 1}) * parts, Whole);
		return {tiles[BOX_X0], tiles[BOX_Y0], tiles[BOX_X1], tiles[BOX_Y1]};
	}

private:
	/* Of the frame, as both corners of a box. */
	static Lanes<T> corner(const Texels<T> &frame, int32_t x, int32_t y)
	{
		const T at_x = frame.fact(FRAME_BOX, x), at_y = frame.fact(FRAME_BOX, y);
		return Lanes<T>{at_x, at_y, at_x, at_y};
	}

	const Records<T> boxes;
	const Lanes<T> least, most;
};

/* Calls `visit(shape, row, tiles)` for the shapes of a chunk, in order, and the rows that each touches. */
template <typename T, typename Visit> void visit_chunk(const Job<T> &job, const Tiling<T> &tiling, int32_t chunk, Visit visit)
{
	for (int32_t k = chunk * BIN_CHUNK; k < std::min((chunk + 1) * BIN_CHUNK, job.domain[2]); k++) {
		const Tiles tiles = tiling.of(k);
		for (int32_t r = tiles.row; r < tiles.row_end; r++)
			visit(k, r, tiles);
	}
}

template <typename T> static void count(const Job<T> &job)
{
	const Tiling<T> tiling(Records<T>(job.records(0)), job.texels(1));
	int32_t *counts = job.list(2);
	job.pool.run(job.domain[0], 8, [&](int32_t begin, int32_t end) {
		std::fill(counts + 2 * begin * tiling.rows, counts + 2 * end * tiling.rows, 0);
		for (int32_t c = begin; c < end; c++) {
			visit_chunk(job, tiling, c, [&](int32_t, int32_t r, const Tiles &tiles) {
				counts[2 * (c * tiling.rows + r)]++;
				counts[2 * (c * tiling.rows + r) + 1] += tiles.column_end - tiles.column;
			});
		}
	});
}

template <typename T> static void sum(const Job<T> &job)
{
	const int32_t rows = job.domain[0], chunks = job.domain[2];
	const int32_t *counts = job.list(0);
	int32_t *offsets = job.list(2), *totals = job.list(3);
	std::fill(totals, totals + 2 * rows, 0);
	for (int32_t c = 0; c < chunks; c++) {
		for (int32_t r = 0; r < rows; r++) {
			offsets[c * rows + r] = totals[2 * r];
			totals[2 * r] += counts[2 * (c * rows + r)];
			totals[2 * r + 1] += counts[2 * (c * rows + r) + 1];
		}
	}
}

/* Positions in lists are unsigned: what is beyond all room may wrap around, and the picture is drawn again. */
static uint32_t up(int32_t &position)
{
	const uint32_t before = static_cast<uint32_t>(position);
	position = static_cast<int32_t>(before + 1);
	return before;
}

/* Columns in RowList, beside their shape. */
static int32_t packed(const Tiles &tiles)
{
	return tiles.column | tiles.column_end << 16;
}

/* Calls `visit(shape, column)` for what entry k of RowList has. */
template <typename Visit> void visit_columns(const int32_t *list, uint32_t k, Visit visit)
{
	const int32_t shape = list[2 * size_t(k)], columns = list[2 * size_t(k) + 1];
	for (int32_t c = columns & 0xffff; c < columns >> 16; c++)
		visit(shape, c);
}

template <typename T> static void sort_by_row(const Job<T> &job)
{
	const Tiling<T> tiling(Records<T>(job.records(0)), job.texels(1));
	const int32_t *totals = job.list(2);
	int32_t *offsets = job.list(3), *list = job.list(4);
	const uint32_t room = static_cast<uint32_t>(job.domain[3]);
	job.pool.run(job.domain[0], 8, [&](int32_t begin, int32_t end) {
		for (int32_t c = begin; c < end; c++) {
			int32_t *mine = offsets + c * tiling.rows;
			uint32_t start = 0;
			for (int32_t r = 0; r < tiling.rows; start += static_cast<uint32_t>(totals[2 * r++]))
				mine[r] = static_cast<int32_t>(static_cast<uint32_t>(mine[r]) + start);
			visit_chunk(job, tiling, c, [&](int32_t k, int32_t r, const Tiles &tiles) {
				const uint32_t at = up(mine[r]);
				if (at < room) {
					list[2 * size_t(at)] = k;
					list[2 * size_t(at) + 1] = packed(tiles);
				}
			});
		}
	});
}

/* One row of tiles: its shapes are counted a column, then written. */
template <typename T> static void sort_row(const Job<T> &job, int32_t columns, int32_t row)
{
	const int32_t *totals = job.list(1), *shapes = job.list(2);
	int32_t *ends = job.list(3) + row * (columns + 1), *list = job.list(4);
	uint32_t begin = 0, start = 0;
	for (int32_t r = 0; r < row; r++) {
		begin += static_cast<uint32_t>(totals[2 * r]);
		start += static_cast<uint32_t>(totals[2 * r + 1]);
	}
	const uint32_t end = std::min(begin + static_cast<uint32_t>(totals[2 * row]), static_cast<uint32_t>(job.domain[2]));
	std::vector<uint32_t> next(static_cast<size_t>(columns) + 1, 0);
	for (uint32_t k = begin; k < end; k++)
		visit_columns(shapes, k, [&](int32_t, int32_t c) { next[static_cast<size_t>(c)]++; });
	for (int32_t c = 0; c <= columns; c++) {
		const uint32_t count = next[static_cast<size_t>(c)];
		next[static_cast<size_t>(c)] = start;
		ends[c] = static_cast<int32_t>(start);
		start += count;
	}
	for (uint32_t k = begin; k < end; k++) {
		visit_columns(shapes, k, [&](int32_t shape, int32_t c) {
			const uint32_t at = next[static_cast<size_t>(c)]++;
			if (at < static_cast<uint32_t>(job.domain[3]))
				list[at] = shape;
		});
	}
}

template <typename T> static void sort_by_tile(const Job<T> &job)
{
	const int32_t columns = static_cast<int32_t>(job.texels(0).fact(FRAME_TILES, TILES_COLUMNS));
	job.pool.run(job.domain[0], 4, [&](int32_t begin, int32_t end) {
		for (int32_t r = begin; r < end; r++)
			sort_row<T>(job, columns, r);
	});
}

extern const Stage bins_tiles;
const Stage bins_tiles{"bins", "tiles",
	{{STAGE_BIN_COUNT, count<float>, count<double>}, {STAGE_BIN_SUM, sum<float>, sum<double>},
		{STAGE_BIN_ROWS, sort_by_row<float>, sort_by_row<double>}, {STAGE_BIN_TILES, sort_by_tile<float>, sort_by_tile<double>}},
	nullptr, nullptr};

}
