/* Tiles of pixels, and how far pixels are from edges: CONTRACT.md, "pixels". */
#ifndef CAROM_CPU_PIXELS_HPP
#define CAROM_CPU_PIXELS_HPP

#include <algorithm>
#include <cstring>

#include "cpu/lanes.hpp"

namespace carom::cpu {

constexpr int32_t side = PIXEL_TILE, half = side / 2, small = 4, area = side * side;

/* Colours as squares: light adds up nearly as the squares of sRGB values do. */
template <typename T> struct Light {
	T channels[3];

	Light() = default;
	explicit Light(T color)
	{
		const int32_t rgb = static_cast<int32_t>(color);
		for (int c = 0; c < 3; c++) {
			const T level = static_cast<T>(rgb >> (16 - 8 * c) & 255);
			channels[c] = level * level;
		}
	}
};

/* The pixels of a tile, row by row. While all are alike it is plain, and the first row stands for all. */
template <typename T> struct Tile {
	T x, y; /* of the first pixel */
	bool plain;
	T light[3][area];

	void fill(const Light<T> &all)
	{
		plain = true;
		for (int c = 0; c < 3; c++)
			std::fill(light[c], light[c] + side, all.channels[c]);
	}

	/* Before a part of it changes. */
	void spread()
	{
		if (!plain)
			return;
		plain = false;
		for (T *channel : light)
			std::fill(channel + side, channel + area, channel[0]);
	}
};

template <typename T> struct Edge {
	T slope_x, slope_y, at, bend;
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
};

/* What a shape does to some pixels of a tile, row by row: how much of each it covers, and how much of that is inside its outline. */
template <typename T> struct Stroke {
	int32_t columns, rows, first; /* the first pixel */
	T opacity;
	Light<T> fill, outline;
	T cover[area], inside[area];
};

/* The four rows of a small stroke side by side. */
template <typename T> struct BlockType;
template <> struct BlockType<float> {
	typedef float Block __attribute__((vector_size(small * small * sizeof(float))));
};
template <> struct BlockType<double> {
	typedef double Block __attribute__((vector_size(small * small * sizeof(double))));
};
template <typename T> using Block = typename BlockType<T>::Block;

template <typename T> [[gnu::always_inline]] inline void take_rows(const T *first, Block<T> &block)
{
	Lanes<T> rows[small];
	for (int32_t row = 0; row < small; row++)
		std::memcpy(&rows[row], first + row * side, sizeof rows[row]);
#if !defined(__GNUC__) || defined(__clang__) || __GNUC__ >= 12
	const auto upper = __builtin_shufflevector(rows[0], rows[1], 0, 1, 2, 3, 4, 5, 6, 7);
	const auto lower = __builtin_shufflevector(rows[2], rows[3], 0, 1, 2, 3, 4, 5, 6, 7);
	block = __builtin_shufflevector(upper, lower, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#else
	std::memcpy(&block, rows, sizeof block); /* processors wait until it lies in the cache */
#endif
}

template <typename T> [[gnu::always_inline]] inline void put_rows(const Block<T> &block, T *first)
{
	Lanes<T> rows[small];
	std::memcpy(rows, &block, sizeof rows);
	for (int32_t row = 0; row < small; row++)
		std::memcpy(first + row * side, &rows[row], sizeof rows[row]);
}

/* Where in a word the byte lies that is number `c` in memory. */
constexpr int32_t shift_of(int c)
{
	return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? 8 * c : 24 - 8 * c;
}

/* The bytes of the tile's first pixels, `count` of them, as words, of which compilers make vectors. */
template <int32_t count, typename T> void round_light(const Tile<T> &tile, uint32_t *pixels)
{
#pragma omp simd
	for (int32_t i = 0; i < count; i++) {
		uint32_t word = uint32_t(255) << shift_of(3);
		for (int c = 0; c < 3; c++)
			word |= static_cast<uint32_t>(static_cast<int32_t>(std::sqrt(larger(T(0), tile.light[c][i])) + T(0.5))) << shift_of(c);
		pixels[i] = word;
	}
}

}

#endif
