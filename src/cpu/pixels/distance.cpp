#include "cpu/stages.hpp"

#include <algorithm>

namespace carom::cpu {

/* Where the slot's textures are in the list. */
enum : int { FROM_SHAPES, FROM_EDGES, FROM_FRAME, FROM_ENDS, FROM_LIST, LIGHT, TO_PICTURE };

constexpr int32_t side = PIXEL_TILE, area = side * side;

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

/* The pixels of a tile, row by row: one loop over all that a shape may touch, which compilers make vectors of. */
template <typename T> struct Tile {
	T x, y; /* of the first pixel */
	T light[3][area];

	void fill(const Light<T> &ground)
	{
		for (int c = 0; c < 3; c++)
			std::fill(light[c], light[c] + area, ground.channels[c]);
	}
};

template <typename T> T share(T v)
{
	v = v > 0 ? v : 0;
	return v < 1 ? v : 1;
}

/* Pixels of a tile, counted from the first pixel of a shape's box, and how far they are from the shape. */
template <typename T> struct Distances {
	int32_t count = 0;
	T x[area], y[area], far[area];

	/* The rows from `top` to `bottom` - 1 of the tile. */
	Distances(int32_t top, int32_t bottom, T from_x, T from_y)
	{
		for (int32_t row = top; row < bottom; row++) {
			for (int32_t i = 0; i < side; i++, count++) {
				x[count] = from_x + static_cast<T>(i);
				y[count] = from_y + static_cast<T>(row);
				far[count] = -infinite<T>;
			}
		}
	}

	void beyond_line(T slope_x, T slope_y, T at)
	{
		for (int32_t i = 0; i < count; i++)
			far[i] = larger(far[i], (at + slope_y * y[i]) + slope_x * x[i]);
	}

	void beyond_disc(T slope_x, T slope_y, T at, T bend)
	{
		for (int32_t i = 0; i < count; i++) {
			const T s = (at + (slope_y + bend * y[i]) * y[i]) + (slope_x + bend * x[i]) * x[i];
			far[i] = larger(far[i], (2 * s) / (1 + std::sqrt(larger(T(0), 1 + (4 * bend) * s))));
		}
	}

	/* What is outside the box is far. */
	void mask(T width)
	{
		for (int32_t i = 0; i < count; i++)
			far[i] = ((x[i] >= 0) & (x[i] < width)) ? far[i] : T(1);
	}
};

template <typename T> class Painter
{
public:
	explicit Painter(const Job<T> &job) : shapes(job.records(FROM_SHAPES)), edges(job.records(FROM_EDGES)) {}

	void draw(Tile<T> &tile, int32_t shape) const
	{
		const int32_t box = SHAPES_WIDTH * shape + SHAPE_BOX, sides = SHAPES_WIDTH * shape + SHAPE_EDGES;
		const T x0 = shapes.of(box, BOX_X0), y0 = shapes.of(box, BOX_Y0);
		const int32_t top = static_cast<int32_t>(larger(y0 - tile.y, T(0)));
		const int32_t bottom = static_cast<int32_t>(smaller(shapes.of(box, BOX_Y1) - tile.y, T(side)));
		const int32_t first = static_cast<int32_t>(shapes.of(sides, EDGES_FIRST));
		const int32_t count = static_cast<int32_t>(shapes.of(sides, EDGES_COUNT));
		Distances<T> distances(top, bottom, tile.x - x0, tile.y - y0);
		if (count == 0) {
			cover(tile, top * side, distances, shapes.of(box, BOX_X1) - x0, Light<T>(shapes.of(SHAPES_WIDTH * shape + SHAPE_INK, INK_FILL)));
			return;
		}
		for (int32_t k = first; k < first + count; k++)
			measure(distances, k);
		distances.mask(shapes.of(box, BOX_X1) - x0);
		blend(tile, top * side, distances, SHAPES_WIDTH * shape + SHAPE_INK);
	}

	/* Shapes lie in the order of the bodies, which may be anywhere: those that are drawn soon are fetched while others are drawn. */
	[[gnu::always_inline]] void fetch(const int32_t *next, const int32_t *end) const
	{
		if (next + far_ahead < end)
			__builtin_prefetch(&shapes.of(SHAPES_WIDTH * next[far_ahead] + SHAPE_EDGES, 0));
		if (next + near_ahead < end) {
			const int32_t shape = SHAPES_WIDTH * next[near_ahead];
			__builtin_prefetch(&shapes.of(shape + SHAPE_BOX, 0));
			__builtin_prefetch(&edges.of(static_cast<int32_t>(shapes.of(shape + SHAPE_EDGES, EDGES_FIRST)), 0));
		}
	}

private:
	static constexpr int32_t near_ahead = 6, far_ahead = 12;

	void measure(Distances<T> &distances, int32_t edge) const
	{
		const T slope_x = edges.of(edge, EDGE_SLOPE_X), slope_y = edges.of(edge, EDGE_SLOPE_Y), at = edges.of(edge, EDGE_AT);
		const T bend = edges.of(edge, EDGE_BEND);
		if (bend > 0)
			distances.beyond_disc(slope_x, slope_y, at, bend);
		else
			distances.beyond_line(slope_x, slope_y, at);
	}

	/* A shape without edges is its box, opaque. */
	static void cover(Tile<T> &tile, int32_t from, const Distances<T> &distances, T width, const Light<T> &fill)
	{
		for (int c = 0; c < 3; c++) {
			const T light = fill.channels[c];
			T *ground = tile.light[c] + from;
			for (int32_t i = 0; i < distances.count; i++)
				ground[i] = ((distances.x[i] >= 0) & (distances.x[i] < width)) ? light : ground[i];
		}
	}

	void blend(Tile<T> &tile, int32_t from, const Distances<T> &distances, int32_t ink) const
	{
		const Light<T> fill(shapes.of(ink, INK_FILL)), outline(shapes.of(ink, INK_OUTLINE));
		const T width = shapes.of(ink, INK_WIDTH), opacity = shapes.of(ink, INK_OPACITY);
		for (int c = 0; c < 3; c++) {
			const T line = outline.channels[c], middle = fill.channels[c];
			T *ground = tile.light[c] + from;
			for (int32_t i = 0; i < distances.count; i++) {
				const T near = T(0.5) - distances.far[i], cover = share(near), inside = share(near - width);
				ground[i] = ground[i] + opacity * ((line * (cover - inside) + middle * inside) - cover * ground[i]);
			}
		}
	}

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
	visit_pixels(frame, x, y, [&](int32_t i, int32_t pixel) {
		for (int c = 0; c < 3; c++)
			tile.light[c][i] = light[4 * pixel + c];
	});
}

template <typename T> static void leave_light(const Tile<T> &tile, T *light, const Frame<T> &frame, int32_t x, int32_t y)
{
	visit_pixels(frame, x, y, [&](int32_t i, int32_t pixel) {
		for (int c = 0; c < 3; c++)
			light[4 * pixel + c] = tile.light[c][i];
	});
}

/* Writes the tile that begins at column x and row y of the frame. */
template <typename T> static void put_tile(const Tile<T> &tile, const Bytes &picture, const Frame<T> &frame, int32_t x, int32_t y)
{
	int32_t levels[3][area];
	for (int c = 0; c < 3; c++)
		for (int32_t i = 0; i < area; i++)
			levels[c][i] = static_cast<int32_t>(std::sqrt(larger(T(0), tile.light[c][i])) + T(0.5));
	for (int32_t row = 0; row < std::min(side, frame.height - y); row++) {
		uint8_t *pixels = picture.texel(x, y + row);
		for (int32_t i = 0; i < std::min(side, frame.width - x); i++) {
			for (int c = 0; c < 3; c++)
				pixels[4 * i + c] = static_cast<uint8_t>(levels[c][row * side + i]);
			pixels[4 * i + 3] = 255;
		}
	}
}

template <typename T> static void draw_row(const Job<T> &job, const Frame<T> &frame, int32_t row)
{
	const int32_t *ends = job.list(FROM_ENDS) + row * (frame.columns + 1), *list = job.list(FROM_LIST);
	const uint32_t room = static_cast<uint32_t>(job.domain[2]);
	const uint32_t last = std::min(static_cast<uint32_t>(ends[frame.columns]), room);
	const Painter<T> painter(job);
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
		if (frame.pass & PASS_UNDER)
			leave_light(tile, job.records(LIGHT), frame, c * side, row * side);
		else
			put_tile(tile, job.bytes(TO_PICTURE), frame, c * side, row * side);
	}
}

template <typename T> static void distance(const Job<T> &job)
{
	const Frame<T> frame(job.texels(FROM_FRAME));
	job.pool.run(job.domain[1], 2, [&](int32_t begin, int32_t end) {
		for (int32_t row = begin; row < end; row++)
			draw_row(job, frame, row);
	});
}

extern const Stage pixels_distance;
const Stage pixels_distance{"pixels", "distance", {{STAGE_PIXELS, distance<float>, distance<double>}}, nullptr, nullptr};

}
