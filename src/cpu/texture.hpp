/* What the CPU device has for textures. */
#ifndef CAROM_CPU_TEXTURE_HPP
#define CAROM_CPU_TEXTURE_HPP

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "device.h"
#include "layout.h"

namespace carom::cpu {

constexpr size_t channel_count = 4;

/* Memory from calloc, of which the first bytes may be left out, or that is the host's. */
struct Free {
	size_t skipped;
	bool is_wrapped;

	void operator()(void *memory) const
	{
		if (!is_wrapped)
			std::free(static_cast<char *>(memory) - skipped);
	}
};

struct Texture {
	carom_texel_format format;
	uint32_t width, height;
	std::unique_ptr<void, Free> memory;
};

/* Numbers. In each row the four channels lie apart, all of the first, then all of the second and so on: a loop that needs
 * the hit times alone reads a quarter of the memory, and compilers make vectors of it. */
template <typename T> class Texels
{
public:
	explicit Texels(const Texture &texture) : numbers(static_cast<T *>(texture.memory.get())), width(texture.width) {}

	/* One channel of row y. */
	T *row(int32_t y, int32_t channel) const { return numbers + (static_cast<size_t>(y) * channel_count + static_cast<size_t>(channel)) * width; }

	T &at(int32_t x, int32_t y, int32_t channel) const { return row(y, channel)[x]; }

	/* Of a texture with one texel a body, or another thing, folded into rows. */
	T &of(int32_t index, int32_t channel) const { return at(index & (ROW_SIZE - 1), index >> ROW_LOG2, channel); }

	/* Of a texture with a single row. */
	T &fact(int32_t texel, int32_t channel) const { return at(texel, 0, channel); }

	void set(int32_t x, int32_t y, T first, T second, T third, T fourth) const
	{
		at(x, y, 0) = first;
		at(x, y, 1) = second;
		at(x, y, 2) = third;
		at(x, y, 3) = fourth;
	}

private:
	T *numbers;
	size_t width;
};

/* Records: the four numbers of each lie side by side, so that one that is read by itself is near. */
template <typename T> class Records
{
public:
	explicit Records(T *first) : numbers(first) {}

	T &of(int32_t index, int32_t channel) const { return numbers[static_cast<size_t>(index) * channel_count + static_cast<size_t>(channel)]; }

	void put(int32_t index, T first, T second, T third, T fourth) const
	{
		T *record = &of(index, 0);
		record[0] = first;
		record[1] = second;
		record[2] = third;
		record[3] = fourth;
	}

private:
	T *numbers;
};

/* Bytes, the four of a texel side by side: a row is one byte a column. */
class Bytes
{
public:
	explicit Bytes(const Texture &texture) : bytes(static_cast<uint8_t *>(texture.memory.get())), stride(texture.width * channel_count) {}

	uint8_t *row(int32_t y) const { return bytes + static_cast<size_t>(y) * stride; }
	uint8_t *texel(int32_t x, int32_t y) const { return row(y) + static_cast<size_t>(x) * channel_count; }

private:
	uint8_t *bytes;
	size_t stride;
};

}

#endif
