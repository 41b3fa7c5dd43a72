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
		cut = __builtin_convertvector(smaller(larger(from_tile, zero), zero + T(side)), Whole);
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
		if (seen.count == 0 || waiting == batch)
			finish(tile);
		if (seen.count == 0)
			cover(tile, seen);
		else if (width <= small && height <= small)
			begin<small, small>(seen, std::min(left, side - small), std::min(top, side - small), small);
		else if (width <= half)
			begin<half, 1>(seen, std::min(left, half), top, height);
		else
			begin<side, 1>(seen, 0, top, height);
	}

	void finish(Tile<T> &tile)
	{
		if (waiting > 0)
			tile.spread();
		for (int32_t k = 0; k < waiting; k++) {
			if (strokes[k].columns == small)
				blend<small>(tile, strokes[k], small);
			else if (strokes[k].columns == half)
				blend<half>(tile, strokes[k], strokes[k].rows);
			else
				blend<side>(tile, strokes[k], strokes[k].rows);
		}
		waiting = 0;
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
		if ((cut[BOX_X1] - cut[BOX_X0]) * (cut[BOX_Y1] - cut[BOX_Y0]) == area) {
			tile.fill(fill);
			return;
		}
		tile.spread();
		for (int c = 0; c < 3; c++)
			for (int32_t row = cut[BOX_Y0]; row < cut[BOX_Y1]; row++)
				std::fill(tile.light[c] + row * side + cut[BOX_X0], tile.light[c] + row * side + cut[BOX_X1], fill.channels[c]);
	}

	/* Measures pixels from column `left` and row `top` of the tile on, `height` rows of them. */
	template <int32_t columns, int32_t rows> void begin(const Seen<T> &seen, int32_t left, int32_t top, int32_t height)
	{
		Stroke<T> &stroke = strokes[waiting++];
		Patch<T, columns, rows> patch;
		stroke.columns = columns;
		stroke.rows = height;
		stroke.first = top * side + left;
		stroke.opacity = seen.of(SHAPE_INK, INK_OPACITY);
		stroke.fill = Light<T>(seen.of(SHAPE_INK, INK_FILL));
		stroke.outline = Light<T>(seen.of(SHAPE_INK, INK_OUTLINE));
		for (int32_t row = 0; row < height; row += rows) {
			patch.begin(static_cast<T>(left) - seen.from_tile[BOX_X0], static_cast<T>(top + row) - seen.from_tile[BOX_Y0]);
			measure(patch, seen.records, SHAPE_EDGE);
			if (seen.count > 1) {
				const Records<T> rest(&edges.of(static_cast<int32_t>(seen.of(SHAPE_EDGES, EDGES_REST)), 0));
				for (int32_t k = 0; k < seen.count - 1; k++)
					measure(patch, rest, k);
			}
			patch.mask(seen.box[BOX_X1] - seen.box[BOX_X0], seen.box[BOX_Y1] - seen.box[BOX_Y0]);
			patch.share(stroke.cover + row * columns, 0);
			patch.share(stroke.inside + row * columns, seen.of(SHAPE_INK, INK_WIDTH));
		}
	}

	template <typename Patch> static void measure(Patch &patch, const Records<T> &edges, int32_t k)
	{
		const Edge<T> edge{edges.of(k, EDGE_SLOPE_X), edges.of(k, EDGE_SLOPE_Y), edges.of(k, EDGE_AT), edges.of(k, EDGE_BEND)};
		if (edge.bend > 0)
			patch.beyond_disc(edge);
		else
			patch.beyond_line(edge);
	}

	template <int32_t columns> static void blend(Tile<T> &tile, const Stroke<T> &stroke, int32_t rows)
	{
		for (int c = 0; c < 3; c++) {
			const T line = stroke.outline.channels[c], middle = stroke.fill.channels[c];
			for (int32_t row = 0; row < rows; row++) {
				const T *cover = stroke.cover + row * columns, *inside = stroke.inside + row * columns;
				T *ground = tile.light[c] + stroke.first + row * side;
#pragma omp simd
				for (int32_t i = 0; i < columns; i++)
					ground[i] = ground[i] + stroke.opacity * ((line * (cover[i] - inside[i]) + middle * inside[i]) - cover[i] * ground[i]);
			}
		}
	}

	/* Measuring takes long, but waits for nothing that is drawn: some shapes are measured, and then drawn together, so that processors do much
	 * of it at once. */
	static constexpr int32_t batch = 8;
	Stroke<T> strokes[batch];
	int32_t waiting = 0;
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
	for (int32_t row = 0; row < std::min(side, frame.height - y); row++)
		for (int32_t i = 0; i < std::min(side, frame.width - x); i++)
			visit(row * side + i, (y + row) * frame.width + x + i);
}

/* The passes hand on what they have drawn, unrounded. */
template <typename T> static void take_light(Tile<T> &tile, const T *light, const Frame<T> &frame, int32_t x, int32_t y)
{
	tile.plain = false;
	visit_pixels(frame, x, y, [&](int32_t i, int32_t pixel) {
		for (int c = 0; c < 3; c++)
			tile.light[c][i] = light[4 * pixel + c];
	});
}

template <typename T> static void leave_light(Tile<T> &tile, T *light, const Frame<T> &frame, int32_t x, int32_t y)
{
	tile.spread();
	visit_pixels(frame, x, y, [&](int32_t i, int32_t pixel) {
		for (int c = 0; c < 3; c++)
			light[4 * pixel + c] = tile.light[c][i];
	});
}

/* Writes the tile that begins at column x and row y of the frame. */
template <typename T> static void put_tile(const Tile<T> &tile, const Bytes &picture, const Frame<T> &frame, int32_t x, int32_t y)
{
	constexpr size_t whole_row = sizeof(uint32_t) * side;
	const size_t row_size = std::min(sizeof(uint32_t) * static_cast<size_t>(frame.width - x), whole_row);
	uint32_t pixels[area];
	if (tile.plain)
		round_light<side>(tile, pixels);
	else
		round_light<area>(tile, pixels);
	for (int32_t row = 0; row < std::min(side, frame.height - y); row++) {
		uint8_t *to = picture.texel(x, y + row);
		const uint32_t *from = pixels + (tile.plain ? 0 : side * row);
		if (row_size == whole_row)
			std::memcpy(to, from, whole_row); /* no call: the compiler knows how long it is */
		else
			std::memcpy(to, from, row_size);
	}
}

template <typename T> static void draw_row(const Job<T> &job, const Frame<T> &frame, int32_t row)
{
	const int32_t *ends = job.list(FROM_ENDS) + row * (frame.columns + 1), *list = job.list(FROM_LIST);
	const uint32_t room = static_cast<uint32_t>(job.domain[2]);
	const uint32_t last = std::min(static_cast<uint32_t>(ends[frame.columns]), room);
	Painter<T> painter(job);
	Tile<T> tile;
	for (int32_t c = 0; c < frame.columns; c++) {
		const uint32_t end = std::min(static_cast<uint32_t>(ends[c + 1]), room);
		tile.x = frame.x0 + static_cast<T>(c * side);
		tile.y = frame.y0 + static_cast<T>(row * side);
		tile.fill(frame.ground);
		if (frame.pass & PASS_OVER)
			take_light(tile, job.records(LIGHT), frame, c * side, row * side);
		for (uint32_t k = static_cast<uint32_t>(ends[c]); k < end; k++) {
			painter.fetch(list + k, list + last);
			painter.draw(tile, list[k]);
		}
		painter.finish(tile);
		if (frame.pass & PASS_UNDER)
			leave_light(tile, job.records(LIGHT), frame, c * side, row * side);
		else
			put_tile(tile, job.bytes(TO_PICTURE), frame, c * side, row * side);
	}
}

#if defined(__x86_64__)
/* The same with longer vectors, where the processor has them, or with more of them that are masked: each lane is rounded as before. */
[[gnu::target("avx2"), gnu::flatten]] static void draw_row_avx2(const Job<float> &job, const Frame<float> &frame, int32_t row)
{
	draw_row(job, frame, row);
}

[[gnu::target("avx512f,avx512vl"), gnu::flatten]] static void draw_row_avx512(const Job<float> &job, const Frame<float> &frame, int32_t row)
{
	draw_row(job, frame, row);
}

static auto best_draw_row(float)
{
	if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
		return draw_row_avx512;
	return __builtin_cpu_supports("avx2") ? draw_row_avx2 : draw_row<float>;
}
#endif

template <typename T> static auto best_draw_row(T)
{
	return draw_row<T>;
}

template <typename T> static void distance(const Job<T> &job)
{
	const Frame<T> frame(job.texels(FROM_FRAME));
	const auto draw = best_draw_row(T());
	job.pool.run(job.domain[1], 2, [&](int32_t begin, int32_t end) {
		for (int32_t row = begin; row < end; row++)
			draw(job, frame, row);
	});
}

extern const Stage pixels_distance;
const Stage pixels_distance{"pixels", "distance", {{STAGE_PIXELS, distance<float>, distance<double>}}, nullptr, nullptr};

}
