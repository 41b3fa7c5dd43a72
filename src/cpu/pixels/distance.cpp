#include "cpu/pixels.hpp"

#include <cstring>

namespace carom::cpu {

/* Where the slot's textures are in the list. */
enum : int { FROM_SHAPES, FROM_EDGES, FROM_FRAME, FROM_ENDS, FROM_LIST, LIGHT, TO_PICTURE };

/* A shape as a tile sees it. */
template <typename T> struct Seen {
	const Records<T> records; /* its own */
	Lanes<T> box, from_tile;
	Whole cut;     /* columns and rows of the tile, as the box has them */
	int32_t count; /* edges */

	Seen(const Records<T> &own, const Tile<T> &tile) : records(own), count(static_cast<int32_t>(of(SHAPE_EDGES, EDGES_COUNT)))
	{
		const Lanes<T> zero{};
		std::memcpy(&box, &records.of(SHAPE_BOX, 0), sizeof box);
		from_tile = box - Lanes<T>{tile.x, tile.y, tile.x, tile.y};
		cut = __builtin_convertvector(smaller(larger(from_tile, zero), Lanes<T>{tile_width, tile_height, tile_width, tile_height}), Whole);
	}

	T of(int32_t part, int32_t channel) const { return records.of(part, channel); }
};

template <typename T> class Painter
{
public:
	explicit Painter(const Job<T> &job) : shapes(job.records(FROM_SHAPES)), edges(job.records(FROM_EDGES)) {}

	/* In the end of a tile `finish` must be called. */
	void draw(Tile<T> &tile, int32_t shape)
	{
		const Seen<T> seen(Records<T>(&shapes.of(SHAPES_WIDTH * shape, 0)), tile);
		const int32_t left = seen.cut[BOX_X0], top = seen.cut[BOX_Y0], width = seen.cut[BOX_X1] - left, height = seen.cut[BOX_Y1] - top;
		const bool is_small = width <= small && height <= small;
		const int32_t columns = is_small ? small : (width + block - 1) / block * block, rows = is_small ? small : height;
		if (seen.count == 0 || waiting == batch || taken + columns * rows > tile_area)
			finish(tile);
		if (seen.count == 0)
			cover(tile, seen);
		else if (is_small)
			begin<small, small>(seen, std::min(left, tile_width - small), std::min(top, tile_height - small), small, small);
		else
			begin<block, 1>(seen, std::min(left, tile_width - columns), top, columns, height);
	}

	void finish(Tile<T> &tile)
	{
		for (int32_t k = 0; k < waiting; k++) {
			const Stroke<T> &stroke = strokes[k];
			tile.open(stroke.first % tile_width, stroke.first / tile_width, stroke.columns, stroke.rows);
			if (stroke.columns == small)
				blend<small, small>(tile, stroke, small, small);
			else
				blend<block, 1>(tile, stroke, stroke.columns, stroke.rows);
		}
		waiting = taken = 0;
	}

	/* Shapes lie in the order of the bodies, which may be anywhere: those that are drawn soon are fetched while others are drawn. */
	[[gnu::always_inline]] void fetch(const int32_t *next, const int32_t *end) const
	{
		if (next + far_ahead < end)
			__builtin_prefetch(&shapes.of(SHAPES_WIDTH * next[far_ahead], 0));
		if (next + near_ahead < end)
			__builtin_prefetch(&edges.of(static_cast<int32_t>(shapes.of(SHAPES_WIDTH * next[near_ahead] + SHAPE_EDGES, EDGES_REST)), 0));
	}

private:
	static constexpr int32_t near_ahead = 10, far_ahead = 20;

	/* A shape without edges is its box, opaque. */
	static void cover(Tile<T> &tile, const Seen<T> &seen)
	{
		const Light<T> fill(seen.of(SHAPE_INK, INK_FILL));
		const Whole cut = seen.cut;
		if ((cut[BOX_X1] - cut[BOX_X0]) * (cut[BOX_Y1] - cut[BOX_Y0]) == tile_area) {
			tile.fill(fill);
			return;
		}
		tile.open(cut[BOX_X0], cut[BOX_Y0], cut[BOX_X1] - cut[BOX_X0], cut[BOX_Y1] - cut[BOX_Y0]);
		for (int c = 0; c < 3; c++)
			for (int32_t row = cut[BOX_Y0]; row < cut[BOX_Y1]; row++)
				std::fill(tile.light[c] + row * tile_width + cut[BOX_X0], tile.light[c] + row * tile_width + cut[BOX_X1], fill.channels[c]);
	}

	/* Measures so many columns and rows of pixels, from column `left` and row `top` of the tile on, some at a time. */
	template <int32_t wide, int32_t high> void begin(const Seen<T> &seen, int32_t left, int32_t top, int32_t columns, int32_t rows)
	{
		Stroke<T> &stroke = strokes[waiting++];
		stroke.columns = columns;
		stroke.rows = rows;
		stroke.first = top * tile_width + left;
		stroke.opacity = seen.of(SHAPE_INK, INK_OPACITY);
		stroke.fill = Light<T>(seen.of(SHAPE_INK, INK_FILL));
		stroke.outline = Light<T>(seen.of(SHAPE_INK, INK_OUTLINE));
		stroke.cover = covers + taken;
		stroke.inside = insides + taken;
		for (int32_t row = 0; row < rows; row += high) {
			for (int32_t column = 0; column < columns; column += wide) {
				Patch<T, wide, high> patch;
				patch.begin(static_cast<T>(left + column) - seen.from_tile[BOX_X0], static_cast<T>(top + row) - seen.from_tile[BOX_Y0]);
				if (seen.count > 0)
					measure_edges(patch, seen);
				else
					measure_outline(patch, seen);
				patch.mask(seen.box[BOX_X1] - seen.box[BOX_X0], seen.box[BOX_Y1] - seen.box[BOX_Y0]);
				patch.share(covers + taken, 0);
				patch.share(insides + taken, seen.of(SHAPE_INK, INK_WIDTH));
				taken += wide * high;
			}
		}
	}

	Records<T> rest_of(const Seen<T> &seen) const { return Records<T>(&edges.of(static_cast<int32_t>(seen.of(SHAPE_EDGES, EDGES_REST)), 0)); }

	template <typename Patch> void measure_edges(Patch &patch, const Seen<T> &seen) const
	{
		measure(patch, seen.records, SHAPE_EDGE);
		if (seen.count > 1) {
			const Records<T> rest = rest_of(seen);
			for (int32_t k = 0; k < seen.count - 1; k++)
				measure(patch, rest, k);
		}
	}

	template <typename Patch> void measure_outline(Patch &patch, const Seen<T> &seen) const
	{
		const Records<T> rest = rest_of(seen);
		patch.beyond_outline(seen.of(SHAPE_EDGE, EDGE_AT), [&](const auto &visit) {
			for (int32_t k = 0; k < -seen.count; k++) {
				const int32_t line = SIDE_WIDTH * k + SIDE_LINE, ends = SIDE_WIDTH * k + SIDE_ENDS;
				visit(Side<T>{rest.of(line, EDGE_SLOPE_X), rest.of(line, EDGE_SLOPE_Y), rest.of(line, EDGE_AT), rest.of(ends, ENDS_FROM_X),
					rest.of(ends, ENDS_FROM_Y), rest.of(ends, ENDS_TO_X), rest.of(ends, ENDS_TO_Y)});
			}
		});
	}

	template <typename Patch> static void measure(Patch &patch, const Records<T> &edges, int32_t k)
	{
		const Edge<T> edge{edges.of(k, EDGE_SLOPE_X), edges.of(k, EDGE_SLOPE_Y), edges.of(k, EDGE_AT), edges.of(k, EDGE_BEND)};
		if (edge.bend > 0)
			patch.beyond_disc(edge);
		else
			patch.beyond_line(edge);
	}

	/* `wide` columns of `high` rows at a time: what of the light is the stroke's, then that over what was there. */
	template <int32_t wide, int32_t high> static void blend(Tile<T> &tile, const Stroke<T> &stroke, int32_t columns, int32_t rows)
	{
		constexpr int32_t count = wide * high;
		const T opacity = stroke.opacity;
		const int32_t first = stroke.first;
		const T *cover = stroke.cover, *inside = stroke.inside;
		for (int32_t row = 0; row < rows; row += high) {
			for (int32_t column = 0; column < columns; column += wide, cover += count, inside += count) {
				T own[3][count], covered[count];
				for (int c = 0; c < 3; c++) {
					const T line = stroke.outline.channels[c], middle = stroke.fill.channels[c];
#pragma omp simd
					for (int32_t i = 0; i < count; i++)
						own[c][i] = line * (cover[i] - inside[i]) + middle * inside[i];
				}
				std::copy(cover, cover + count, covered);
				for (int c = 0; c < 3; c++) {
					for (int32_t k = 0; k < high; k++) {
						T *ground = tile.light[c] + first + (row + k) * tile_width + column;
#pragma omp simd
						for (int32_t i = 0; i < wide; i++)
							ground[i] = ground[i] + opacity * (own[c][k * wide + i] - covered[k * wide + i] * ground[i]);
					}
				}
			}
		}
	}

	/* Measuring takes long, but waits for nothing that is drawn: some shapes are measured, and then drawn together, so that processors do much
	 * of it at once. */
	static constexpr int32_t batch = 16;
	Stroke<T> strokes[batch];
	alignas(64) T covers[tile_area], insides[tile_area]; /* side by side, for most are small */
	int32_t waiting = 0, taken = 0;
	const Records<T> shapes, edges;
};

template <typename T> struct Frame {
	T x0, y0;
	int32_t width, height, columns, pass;
	Light<T> ground;

	explicit Frame(const Texels<T> &frame)
		: x0(frame.fact(FRAME_BOX, BOX_X0)), y0(frame.fact(FRAME_BOX, BOX_Y0)), width(static_cast<int32_t>(frame.fact(FRAME_BOX, BOX_X1) - x0)),
		  height(static_cast<int32_t>(frame.fact(FRAME_BOX, BOX_Y1) - y0)), columns(static_cast<int32_t>(frame.fact(FRAME_TILES, TILES_COLUMNS))),
		  pass(static_cast<int32_t>(frame.fact(FRAME_TILES, TILES_PASS))), ground(frame.fact(FRAME_TILES, TILES_GROUND))
	{
	}
};

/* Calls `visit(i, pixel)` for each pixel i of the tile that the frame has, with its number there; the tile begins at column x and row y. */
template <typename T, typename Visit> static void visit_pixels(const Frame<T> &frame, int32_t x, int32_t y, Visit visit)
{
	for (int32_t row = 0; row < std::min(tile_height, frame.height - y); row++)
		for (int32_t i = 0; i < std::min(tile_width, frame.width - x); i++)
			visit(row * tile_width + i, (y + row) * frame.width + x + i);
}

/* The passes hand on what they have drawn, unrounded. */
template <typename T> static void take_light(Tile<T> &tile, const T *light, const Frame<T> &frame, int32_t x, int32_t y)
{
	tile.open(0, 0, tile_width, tile_height);
	visit_pixels(frame, x, y, [&](int32_t i, int32_t pixel) {
		for (int c = 0; c < 3; c++)
			tile.light[c][i] = light[4 * pixel + c];
	});
}

template <typename T> static void leave_light(Tile<T> &tile, T *light, const Frame<T> &frame, int32_t x, int32_t y)
{
	tile.open(0, 0, tile_width, tile_height);
	visit_pixels(frame, x, y, [&](int32_t i, int32_t pixel) {
		for (int c = 0; c < 3; c++)
			light[4 * pixel + c] = tile.light[c][i];
	});
}

/* Writes the tile that begins at column x and row y of the frame. */
template <typename T> static void put_tile(const Tile<T> &tile, const Bytes &picture, const Frame<T> &frame, int32_t x, int32_t y)
{
	const int32_t width = std::min(tile_width, frame.width - x);
	uint32_t plain[block], pixels[tile_width];
	round_light<block>(tile.ground, 0, plain);
	for (int32_t row = 0; row < std::min(tile_height, frame.height - y); row++) {
		const int32_t first = row * tile_width;
		if (tile.plain_left == 0)
			round_light<tile_width>(tile.light, first, pixels);
		for (int32_t column = 0; tile.plain_left > 0 && column < tile_width; column += block) {
			if (!tile.plain[row / block][column / block])
				round_light<block>(tile.light, first + column, pixels + column);
			else if (row % block == 0) /* and so are the block's other rows */
				std::memcpy(pixels + column, plain, sizeof plain);
		}
		if (width == tile_width)
			std::memcpy(picture.texel(x, y + row), pixels, sizeof pixels); /* no call: the compiler knows how long it is */
		else
			std::memcpy(picture.texel(x, y + row), pixels, sizeof *pixels * static_cast<size_t>(width));
	}
}

/* Some tiles, which are numbered row by row. */
template <typename T> static void draw_tiles(const Job<T> &job, const Frame<T> &frame, int32_t begin, int32_t end)
{
	const auto place = [&](int32_t tile, int32_t later) { /* each row has one end more than tiles */
		const int32_t at = job.list(FROM_ENDS)[tile + tile / frame.columns + later];
		return job.list(FROM_LIST) + std::min(static_cast<uint32_t>(at), static_cast<uint32_t>(job.domain[2]));
	};
	const int32_t *const all = place(end - 1, 1);
	Painter<T> painter(job);
	Tile<T> tile;
	for (int32_t k = begin; k < end; k++) {
		const int32_t x = k % frame.columns * tile_width, y = k / frame.columns * tile_height;
		tile.x = frame.x0 + static_cast<T>(x);
		tile.y = frame.y0 + static_cast<T>(y);
		tile.fill(frame.ground);
		if (frame.pass & PASS_OVER)
			take_light(tile, job.records(LIGHT), frame, x, y);
		for (const int32_t *next = place(k, 0), *const last = place(k, 1); next < last; next++) {
			painter.fetch(next, all);
			painter.draw(tile, *next);
		}
		painter.finish(tile);
		if (frame.pass & PASS_UNDER)
			leave_light(tile, job.records(LIGHT), frame, x, y);
		else
			put_tile(tile, job.bytes(TO_PICTURE), frame, x, y);
	}
}

#if defined(__x86_64__)
/* The same with longer vectors, where the processor has them, or with more of them that are masked: each lane is rounded as before. */
[[gnu::target("avx2"), gnu::flatten]] static void draw_tiles_avx2(const Job<float> &job, const Frame<float> &frame, int32_t begin, int32_t end)
{
	draw_tiles(job, frame, begin, end);
}

[[gnu::target("avx512f,avx512vl"), gnu::flatten]] static void draw_tiles_avx512(const Job<float> &job, const Frame<float> &frame, int32_t begin,
	int32_t end)
{
	draw_tiles(job, frame, begin, end);
}

static auto best_draw_tiles(float)
{
	if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
		return draw_tiles_avx512;
	return __builtin_cpu_supports("avx2") ? draw_tiles_avx2 : draw_tiles<float>;
}
#endif

template <typename T> static auto best_draw_tiles(T)
{
	return draw_tiles<T>;
}

template <typename T> static void distance(const Job<T> &job)
{
	const Frame<T> frame(job.texels(FROM_FRAME));
	const auto draw = best_draw_tiles(T());
	job.pool.run(job.domain[0] * job.domain[1], 16, [&](int32_t begin, int32_t end) { draw(job, frame, begin, end); });
}

extern const Stage pixels_distance;
const Stage pixels_distance{"pixels", "distance", {{STAGE_PIXELS, distance<float>, distance<double>}}, nullptr, nullptr};

}
