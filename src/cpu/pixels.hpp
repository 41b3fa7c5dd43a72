/* Tiles of pixels, and how far pixels are from edges: CONTRACT.md, "pixels". */
#ifndef CAROM_CPU_PIXELS_HPP
#define CAROM_CPU_PIXELS_HPP

#include <algorithm>
#include <cstring>

#include "cpu/lanes.hpp"

namespace carom::cpu {

/* Of tiles, in pixels: the larger they are the fewer shapes lie in several, while their light is near; and the lower, the fewer pages of the picture are written at once. */
constexpr int32_t tile_width = 64, tile_height = 32, tile_area = tile_width * tile_height;
constexpr int32_t block = 16, small = 4; /* pixels that are dealt with together: as many rows as columns */

typedef int32_t Whole __attribute__((vector_size(lane_count * sizeof(int32_t))));

/* Colours as squares: light adds up nearly as the squares of sRGB values do. */
template <typename T> struct Light {
	Lanes<T> channels;

	Light() = default;
	explicit Light(T color)
	{
		const Whole parts = (Whole{} + static_cast<int32_t>(color)) & Whole{0xff0000, 0xff00, 0xff, 0};
		const Lanes<T> level = __builtin_convertvector(parts, Lanes<T>) * Lanes<T>{1 / T(0x10000), 1 / T(0x100), 1, 0};
		channels = level * level;
	}
};

/* The pixels of a tile, row by row. Blocks of them on which nothing was drawn yet are plain: one row stands for all. */
template <typename T> struct Tile {
	T x, y; /* of the first pixel */
	bool plain[tile_height / block][tile_width / block];
	int32_t plain_left;                                  /* blocks */
	alignas(64) T light[3][tile_area], ground[3][block]; /* whole lines of the cache, a row each */

	void fill(const Light<T> &all)
	{
		std::memset(plain, true, sizeof plain);
		plain_left = sizeof plain / sizeof **plain;
		for (int c = 0; c < 3; c++)
			std::fill(ground[c], ground[c] + block, all.channels[c]);
	}

	/* Before pixels change: so many columns and rows. */
	void open(int32_t left, int32_t top, int32_t columns, int32_t rows)
	{
		if (plain_left == 0)
			return;
		for (int32_t row = top / block; row * block < top + rows; row++) {
			for (int32_t column = left / block; column * block < left + columns; column++) {
				if (plain[row][column])
					open_block(row, column);
			}
		}
	}

private:
	void open_block(int32_t row, int32_t column)
	{
		plain[row][column] = false;
		plain_left--;
		for (int c = 0; c < 3; c++)
			for (int32_t i = 0; i < block; i++)
				std::memcpy(light[c] + (row * block + i) * tile_width + column * block, ground[c], sizeof ground[c]);
	}
};

template <typename T> struct Edge {
	T slope_x, slope_y, at, bend;
};

/* Of an outline. */
template <typename T> struct Side {
	T slope_x, slope_y, at, from_x, from_y, to_x, to_y;
};

/* Some pixels of a tile, so many that compilers make vectors of them: counted from the first pixel of a shape's box. */
template <typename T, int32_t columns, int32_t rows> struct Patch {
	static constexpr int32_t count = columns * rows;
	T x[count], y[count], far[count];

	void begin(T from_x, T from_y)
	{
#pragma omp simd
		for (int32_t i = 0; i < count; i++) {
			x[i] = from_x + static_cast<T>(i % columns);
			y[i] = from_y + static_cast<T>(i / columns);
			far[i] = -infinite<T>;
		}
	}

	void beyond_line(const Edge<T> &edge)
	{
#pragma omp simd
		for (int32_t i = 0; i < count; i++)
			far[i] = larger(far[i], (edge.at + edge.slope_y * y[i]) + edge.slope_x * x[i]);
	}

	void beyond_disc(const Edge<T> &edge)
	{
		T s[count], square[count];
#pragma omp simd
		for (int32_t i = 0; i < count; i++) {
			s[i] = (edge.at + (edge.slope_y + edge.bend * y[i]) * y[i]) + (edge.slope_x + edge.bend * x[i]) * x[i];
			square[i] = larger(T(0), 1 + (4 * edge.bend) * s[i]);
		}
#pragma omp simd
		for (int32_t i = 0; i < count; i++)
			far[i] = larger(far[i], (2 * s[i]) / (1 + std::sqrt(square[i])));
	}

	/* How far they are from an outline: how near its nearest side is (squares: roots can wait), and whether a ray along x leaves it once more than it enters it. */
	template <typename Visit> void beyond_outline(T shift, const Visit &visit_sides)
	{
		T least[count], sign[count];
		std::fill(least, least + count, infinite<T>);
		std::fill(sign, sign + count, T(1));
		visit_sides([&](const Side<T> &side) { beside(side, least, sign); });
#pragma omp simd
		for (int32_t i = 0; i < count; i++)
			far[i] = shift + sign[i] * std::sqrt(least[i]);
	}

	/* What is outside the box is far. */
	void mask(T width, T height)
	{
#pragma omp simd
		for (int32_t i = 0; i < count; i++)
			far[i] = ((x[i] >= 0) & (x[i] < width) & (y[i] >= 0) & (y[i] < height)) ? far[i] : T(1);
	}

	/* (One loop a limit: in one for both compilers don't see that they are a minimum and a maximum.) */
	void share(T *of, T outline) const
	{
#pragma omp simd
		for (int32_t i = 0; i < count; i++)
			of[i] = larger(T(0), (T(0.5) - far[i]) - outline);
#pragma omp simd
		for (int32_t i = 0; i < count; i++)
			of[i] = smaller(T(1), of[i]);
	}

private:
	/* (Where a side is far, rounding may not tell on which side of its line a pixel is; then its ends do.) */
	void beside(const Side<T> &side, T *least, T *sign) const
	{
		const T begin = side.slope_y * side.from_x - side.slope_x * side.from_y, end = side.slope_y * side.to_x - side.slope_x * side.to_y;
		const T left = smaller(side.from_x, side.to_x), right = larger(side.from_x, side.to_x), sense = side.from_y < side.to_y ? 1 : -1;
#pragma omp simd
		for (int32_t i = 0; i < count; i++) {
			const T s = (side.at + side.slope_y * y[i]) + side.slope_x * x[i], way = -side.slope_x * y[i] + side.slope_y * x[i];
			const T over = larger(larger(begin - way, way - end), T(0));
			const bool is_level = (side.from_y <= y[i]) != (side.to_y <= y[i]);
			least[i] = smaller(least[i], s * s + over * over);
			sign[i] = (is_level & ((x[i] < left) | ((x[i] < right) & (sense * s > 0)))) ? -sign[i] : sign[i];
		}
	}
};

/* What a shape does to some pixels of a tile, row by row: how much of each it covers, and how much of that is inside its outline. */
template <typename T> struct Stroke {
	int32_t columns, rows, first; /* the first pixel */
	T opacity;
	Light<T> fill, outline;
	T *cover, *inside;
};

/* Where in a word the byte lies that is number `c` in memory. */
constexpr int32_t shift_of(int c)
{
	return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? 8 * c : 24 - 8 * c;
}

/* The bytes of pixels from one on as words, of which compilers make vectors. */
template <int32_t count, typename T, size_t room> void round_light(const T (&light)[3][room], int32_t first, uint32_t *pixels)
{
	const auto level = [](T square) { return static_cast<uint32_t>(static_cast<int32_t>(std::sqrt(larger(T(0), square)) + T(0.5))); };
	const T *const red = light[0] + first, *const green = light[1] + first, *const blue = light[2] + first;
#pragma omp simd
	for (int32_t i = 0; i < count; i++)
		pixels[i] = level(red[i]) << shift_of(0) | level(green[i]) << shift_of(1) | level(blue[i]) << shift_of(2) | uint32_t(255) << shift_of(3);
}

}

#endif
