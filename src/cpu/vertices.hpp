/* The vertex shader: CONTRACT.md, "Rendering". */
#ifndef CAROM_CPU_VERTICES_HPP
#define CAROM_CPU_VERTICES_HPP

#include <algorithm>
#include <cstring>

#include "cpu/lanes.hpp"
#include "cpu/stages.hpp"

namespace carom::cpu {

/* Where the slot's textures are in the list. */
enum : int { PLACE_STREAM, PLACE_LINEAR, PLACE_ROTATIONAL, PLACE_TRANSFORMS, PLACE_GEOMETRY, PLACE_VERTICES, PLACE_VIEW, PLACE_OUTPUT };

/* A texture of which each access is counted, where accesses are [3, table 3]. */
template <typename T> class Accessed
{
public:
	Accessed(const Job<T> &job, int index) : texels(job.texels(index)), reads(job.reads) {}

	struct Texel {
		T channels[channel_count];
		T operator[](int channel) const { return channels[channel]; }
		int32_t whole(int channel) const { return static_cast<int32_t>(channels[channel]); }
	};

	Texel of(int32_t i) const
	{
		if (reads)
			reads->fetch_add(1, std::memory_order_relaxed);
		return {{texels.of(i, 0), texels.of(i, 1), texels.of(i, 2), texels.of(i, 3)}};
	}

private:
	const Texels<T> texels;
	std::atomic<uint64_t> *const reads;
};

/* From the world to pixels. */
template <typename T> struct Projection {
	T left, left_low, top, top_low, scale;

	explicit Projection(const Texels<T> &view)
		: left(view.fact(VIEW_ORIGIN, ORIGIN_LEFT)), left_low(view.fact(VIEW_ORIGIN, ORIGIN_LEFT_LOW)), top(view.fact(VIEW_ORIGIN, ORIGIN_TOP)),
		  top_low(view.fact(VIEW_ORIGIN, ORIGIN_TOP_LOW)), scale(view.fact(VIEW_SCALE, SCALE_PIXELS))
	{
	}
};

/* A vertex before it is placed. */
template <typename T> struct Sent {
	int32_t body;
	Vec<T> local;
};

/* (Ordinals may be below 0: halves are rounded down.) */
template <typename T> Vec<T> local_vertex(const Accessed<T> &vertices, int32_t first, int32_t ordinal)
{
	const int32_t is_second = ordinal & 1;
	const auto two = vertices.of(first + (ordinal - is_second) / 2);
	return is_second ? Vec<T>(two[VERTICES_X1], two[VERTICES_Y1]) : Vec<T>(two[VERTICES_X0], two[VERTICES_Y0]);
}

/* Vertices that are placed together, several side by side. */
template <typename T> struct Batch {
	static constexpr int32_t many = Transforms<T>::many;
	Transforms<T> at;
	T local_x[many], local_y[many]; /* in the body's frame */

	void take(int32_t k, const Sent<T> &sent) { at.body[k] = sent.body, local_x[k] = sent.local.x(), local_y[k] = sent.local.y(); }

	/* The first `count` of them, to the i-th vertex and those after it, which lie in one row. */
	void place(const Projection<T> &to, const Texels<T> &placed, int32_t i, int32_t count) const
	{
		T *const columns[] = {&placed.of(i, PLACED_X), &placed.of(i, PLACED_Y), &placed.of(i, PLACED_CENTER_X), &placed.of(i, PLACED_CENTER_Y)};
		for (int32_t k = 0; k < count; k += lane_count) {
			Lanes<T> x, y, angle, lx, ly, cosine, sine;
			std::memcpy(&x, at.x + k, sizeof x), std::memcpy(&y, at.y + k, sizeof y), std::memcpy(&angle, at.angle + k, sizeof angle);
			std::memcpy(&lx, local_x + k, sizeof lx), std::memcpy(&ly, local_y + k, sizeof ly);
			rotations(angle, cosine, sine);
			const Lanes<T> channels[] = {(cosine * lx - sine * ly) * to.scale, -((sine * lx + cosine * ly) * to.scale),
				((x - to.left) - to.left_low) * to.scale, ((to.top - y) + to.top_low) * to.scale};
			for (int32_t c = 0; c < 4; c++) {
				if (count - k >= lane_count)
					std::memcpy(columns[c] + k, &channels[c], sizeof channels[c]); /* no call: the compiler knows how long it is */
				else
					std::memcpy(columns[c] + k, &channels[c], sizeof(T) * static_cast<size_t>(count - k));
			}
		}
	}
};

/* `receive(i)` gives the i-th vertex as the option has it sent. */
template <typename T, typename Receive> void place_vertices(const Job<T> &job, const Receive &receive)
{
	const Projection<T> to(job.texels(PLACE_VIEW));
	const Texels<T> placed = job.texels(PLACE_OUTPUT);
	job.pool.run(job.domain[0], 1024, [&](int32_t begin, int32_t end) {
		Batch<T> batch{};
		for (int32_t i = begin, count; i < end; i += count) {
			count = std::min({Batch<T>::many, end - i, ROW_SIZE - (i & (ROW_SIZE - 1))});
			for (int32_t k = 0; k < count; k++)
				batch.take(k, receive(i + k));
			job.find_transforms(job, batch.at, count);
			batch.place(to, placed, i, count);
		}
	});
}

}

#endif
