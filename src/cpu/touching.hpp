/* Boxes that another one touches, eight at a time. Cells hold few, and how few is hard to foretell: a loop that looks at them one by one waits longer at
 * its ends than it works between. */
#ifndef CAROM_CPU_TOUCHING_HPP
#define CAROM_CPU_TOUCHING_HPP

#include "cpu/reach.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace carom::cpu {

constexpr int32_t eight = 8;

/* A bit for each of eight boxes that touches this one, the first is the lowest. */
template <typename T> [[gnu::always_inline]] inline uint32_t touching(const Box<T> &box, const Box<T> *boxes)
{
	uint32_t bits = 0;
	for (int32_t k = 0; k < eight; k++)
		bits |= static_cast<uint32_t>(box.touches(boxes[k])) << k;
	return bits;
}

#if defined(__SSE2__)
/* Each number of a box is compared at once; the larger two with another sign, so that all four have to be smaller. */
[[gnu::always_inline]] inline uint32_t touching(const Box<float> &box, const Box<float> *boxes)
{
	const __m128 sign = _mm_setr_ps(0, 0, -0.0f, -0.0f), most = _mm_setr_ps(box.max_x, box.max_y, -box.min_x, -box.min_y);
	const auto compare = [=](int32_t k) { return _mm_castps_si128(_mm_cmple_ps(_mm_xor_ps(_mm_loadu_ps(&boxes[k].min_x), sign), most)); };
	const auto pair = [=](int32_t k) { return _mm_packs_epi32(compare(k), compare(k + 1)); };
	const auto four = [=](int32_t k) {
		const __m128i all = _mm_cmpeq_epi32(_mm_packs_epi16(pair(k), pair(k + 2)), _mm_set1_epi32(-1));
		return static_cast<uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(all)));
	};
	return four(0) | four(4) << 4;
}
#endif

/* The places of the bits that are set, for each eight of them. */
class Places
{
public:
	constexpr Places() : rows{}
	{
		for (uint32_t bits = 0; bits < 1U << eight; bits++)
			for (int32_t k = 0; k < eight; k++)
				if (bits >> k & 1)
					rows[bits].places[rows[bits].count++] = k;
	}

	/* Writes eight numbers, of which those count that have a bit; returns their end. */
	[[gnu::always_inline]] int32_t *put(uint32_t bits, int32_t first, int32_t *to) const
	{
		Eight numbers;
		std::memcpy(&numbers, rows[bits].places, sizeof numbers);
		numbers += first;
		std::memcpy(to, &numbers, sizeof numbers);
		return to + rows[bits].count;
	}

private:
	typedef int32_t Eight __attribute__((vector_size(eight * sizeof(int32_t))));
	struct alignas(16) Row {
		int32_t places[eight], count;
	};
	Row rows[1U << eight];
};

constexpr Places places;

}

#endif
