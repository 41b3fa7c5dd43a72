/* The vertex shader: CONTRACT.md, "Rendering". */
#ifndef CAROM_CPU_VERTICES_HPP
#define CAROM_CPU_VERTICES_HPP

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

template <typename T> Vec<T> local_vertex(const Accessed<T> &vertices, int32_t first, int32_t ordinal)
{
	const auto two = vertices.of(first + ordinal / 2);
	return ordinal % 2 ? Vec<T>(two[VERTICES_X1], two[VERTICES_Y1]) : Vec<T>(two[VERTICES_X0], two[VERTICES_Y0]);
}

/* `receive(i)` gives the i-th vertex as the option has it sent. */
template <typename T, typename Receive> void place_vertices(const Job<T> &job, const Receive &receive)
{
	const Projection<T> to(job.texels(PLACE_VIEW));
	const Texels<T> placed = job.texels(PLACE_OUTPUT);
	job.pool.run(job.domain[0], 1024, [&](int32_t begin, int32_t end) {
		int32_t body = -1;
		Transform<T> at{};
		Vec<T> rotation(1, 0);
		for (int32_t i = begin; i < end; i++) {
			const Sent<T> sent = receive(i);
			if (sent.body != body || job.reads) { /* the vertices of a body follow one another */
				body = sent.body;
				at = job.transform(job, body);
				rotation = rotation_of(at.angle);
			}
			const Vec<T> v = turn(rotation, sent.local);
			placed.of(i, PLACED_X) = v.x() * to.scale;
			placed.of(i, PLACED_Y) = -(v.y() * to.scale);
			placed.of(i, PLACED_CENTER_X) = ((at.x - to.left) - to.left_low) * to.scale;
			placed.of(i, PLACED_CENTER_Y) = ((to.top - at.y) + to.top_low) * to.scale;
		}
	});
}

}

#endif
