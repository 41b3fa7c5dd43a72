#include "cpu/stages.hpp"

#include <algorithm>

namespace carom::cpu {

/* Where the slot's textures are in the list. */
enum : int { FROM_SHAPES, FROM_EDGES, FROM_FRAME, FROM_ENDS, FROM_LIST, TO_PICTURE };

/* The pixels of a tile's row: a fixed count lets the compiler use SIMD. */
constexpr int lanes = PIXEL_TILE;

template <typename T> struct Lanes {
	T at[lanes];

	template <typename Function> void each(Function function)
	{
		for (int i = 0; i < lanes; i++)
			at[i] = function(i);
	}
};

/* Colours as squares: light adds up nearly as the squares of sRGB values do. */
template <typename T> struct Light {
	T channels[3];

	explicit Light(T color)
	{
		const int32_t rgb = static_cast<int32_t>(color);
		for (int c = 0; c < 3; c++) {
			const T level = static_cast<T>(rgb >> (16 - 8 * c) & 255);
			channels[c] = level * level;
		}
	}
};

template <typename T> struct Tile {
	Lanes<T> light[lanes][3]; /* row, channel */
};

template <typename T> T share(T v)
{
	v = v > 0 ? v : 0;
	return v < 1 ? v : 1;
}

template <typename T> class Painter
{
  public:
	explicit Painter(const Job<T> &job) : shapes(job.texels(FROM_SHAPES)), edges(job.texels(FROM_EDGES)) {}

	/* Blends a shape with the tile whose first pixel is (x, y). */
	void draw(Tile<T> &tile, int32_t shape, T x, T y) const
	{
		const int32_t box = SHAPES_WIDTH * shape + SHAPE_BOX, with = SHAPES_WIDTH * shape + SHAPE_INK;
		const int32_t sides = SHAPES_WIDTH * shape + SHAPE_EDGES;
		const T y0 = shapes.of(box, BOX_Y0), y1 = shapes.of(box, BOX_Y1), width = shapes.of(with, INK_WIDTH);
		const Light<T> fill(shapes.of(with, INK_FILL)), outline(shapes.of(with, INK_OUTLINE));
		const int32_t first = static_cast<int32_t>(shapes.of(sides, EDGES_FIRST));
		const int32_t count = static_cast<int32_t>(shapes.of(sides, EDGES_COUNT));
		const int top = static_cast<int>(larger(y0 - y, T(0))), bottom = static_cast<int>(smaller(y1 - y, T(lanes)));
		const T left = x - shapes.of(box, BOX_X0), breadth = shapes.of(box, BOX_X1) - shapes.of(box, BOX_X0);
		for (int row = top; row < bottom; row++) {
			Lanes<T> far = distance(first, count, left, (y + static_cast<T>(row)) - y0);
			mask(far, left, breadth);
			blend(tile.light[row], far, fill, outline, width, shapes.of(with, INK_OPACITY));
		}
	}

  private:
	/* From the shape to the pixels from x on, both counted from the first pixel of its box. */
	Lanes<T> distance(int32_t first, int32_t count, T x, T y) const
	{
		Lanes<T> most;
		most.each([](int) { return -infinite<T>; });
		for (int32_t k = first; k < first + count; k++) {
			const T bend = edges.of(k, EDGE_BEND), slope = edges.of(k, EDGE_SLOPE_X);
			const T at = edges.of(k, EDGE_AT) + (edges.of(k, EDGE_SLOPE_Y) + bend * y) * y;
			Lanes<T> s;
			s.each([=](int i) {
				const T across = x + static_cast<T>(i);
				return at + (slope + bend * across) * across;
			});
			if (bend > 0)
				s.each([&](int i) { return (2 * s.at[i]) / (1 + std::sqrt(larger(T(0), 1 + (4 * bend) * s.at[i]))); });
			most.each([&](int i) { return larger(most.at[i], s.at[i]); });
		}
		return most;
	}

	/* What is outside the box is far. */
	static void mask(Lanes<T> &far, T left, T breadth)
	{
		far.each([&](int i) {
			const T across = left + static_cast<T>(i);
			return across >= 0 && across < breadth ? far.at[i] : T(1);
		});
	}

	static void blend(Lanes<T> light[3], const Lanes<T> &far, const Light<T> &fill, const Light<T> &outline, T width, T opacity)
	{
		Lanes<T> cover, inside;
		cover.each([&](int i) { return share(T(0.5) - far.at[i]); });
		inside.each([&](int i) { return share((T(0.5) - far.at[i]) - width); });
		for (int c = 0; c < 3; c++) {
			const T line = outline.channels[c], middle = fill.channels[c];
			Lanes<T> &ground = light[c];
			ground.each([&](int i) {
				const T own = line * (cover.at[i] - inside.at[i]) + middle * inside.at[i];
				return ground.at[i] + opacity * (own - cover.at[i] * ground.at[i]);
			});
		}
	}

	const Texels<T> shapes, edges;
};

template <typename T> static void fill_tile(Tile<T> &tile, const Light<T> &ground)
{
	for (auto &row : tile.light)
		for (int c = 0; c < 3; c++)
			row[c].each([&](int) { return ground.channels[c]; });
}

template <typename T> static void put_row(const Lanes<T> light[3], uint8_t *pixels, int32_t width)
{
	int32_t levels[3][lanes];
	for (int c = 0; c < 3; c++)
		for (int i = 0; i < lanes; i++)
			levels[c][i] = static_cast<int32_t>(std::sqrt(larger(T(0), light[c].at[i])) + T(0.5));
	for (int32_t i = 0; i < std::min(width, lanes); i++) {
		for (int c = 0; c < 3; c++)
			pixels[4 * i + c] = static_cast<uint8_t>(levels[c][i]);
		pixels[4 * i + 3] = 255;
	}
}

template <typename T> static void draw_row(const Job<T> &job, int32_t row)
{
	const Texels<T> frame = job.texels(FROM_FRAME);
	const T x0 = frame.fact(FRAME_BOX, BOX_X0), y0 = frame.fact(FRAME_BOX, BOX_Y0);
	const int32_t width = static_cast<int32_t>(frame.fact(FRAME_BOX, BOX_X1) - x0);
	const int32_t height = static_cast<int32_t>(frame.fact(FRAME_BOX, BOX_Y1) - y0);
	const int32_t columns = static_cast<int32_t>(frame.fact(FRAME_TILES, TILES_COLUMNS)), y = row * lanes;
	const int32_t *ends = job.list(FROM_ENDS) + row * (columns + 1), *list = job.list(FROM_LIST);
	const Light<T> ground(frame.fact(FRAME_TILES, TILES_GROUND));
	const Painter<T> painter(job);
	Tile<T> tile;
	for (int32_t c = 0; c < columns; c++) {
		const uint32_t end = std::min(static_cast<uint32_t>(ends[c + 1]), static_cast<uint32_t>(job.domain[2]));
		fill_tile(tile, ground);
		for (uint32_t k = static_cast<uint32_t>(ends[c]); k < end; k++)
			painter.draw(tile, list[k], x0 + static_cast<T>(c * lanes), y0 + static_cast<T>(y));
		for (int32_t i = 0; i < std::min(lanes, height - y); i++)
			put_row(tile.light[i], job.bytes(TO_PICTURE).texel(c * lanes, y + i), width - c * lanes);
	}
}

template <typename T> static void distance(const Job<T> &job)
{
	job.pool.run(job.domain[1], 2, [&](int32_t begin, int32_t end) {
		for (int32_t row = begin; row < end; row++)
			draw_row(job, row);
	});
}

extern const Stage pixels_distance;
const Stage pixels_distance{"pixels", "distance", {{STAGE_PIXELS, distance<float>, distance<double>}}, nullptr, nullptr};

}
