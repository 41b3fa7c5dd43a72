/* What the alternatives of the slot aabb share: CONTRACT.md, "aabb". */
#ifndef CAROM_CPU_AABB_HPP
#define CAROM_CPU_AABB_HPP

#include "cpu/body.hpp"

namespace carom::cpu {

template <typename T> struct Hull {
	Vec<T> min = Vec<T>::Constant(infinite<T>), max = Vec<T>::Constant(-infinite<T>);

	void hold(const Vec<T> &point)
	{
		min = {smaller(min.x(), point.x()), smaller(min.y(), point.y())};
		max = {larger(max.x(), point.x()), larger(max.y(), point.y())};
	}
};

/* How far the body may leave the box of its places at 0 and 1 in between, and what rounding may add. */
template <typename T> T padding(const Body<T> &body)
{
	T spin = std::abs(body.w) + std::abs(body.b);
	T bend = norm(body.a) + (body.is_circle() ? 0 : (std::abs(body.b) + spin * spin) * body.radius);
	T size = larger(largest(body.x), largest(body.place_at(1))) + body.radius;
	return T(0.125) * bend + size * (2 * SLOP);
}

/* Runs the slot: `hold(box, convex, t)` puts the body at t into the box. */
template <typename T, typename Hold> void find_boxes(const Job<T> &job, Hold hold)
{
	const Shapes<T> shapes = shapes_before(job);
	const Texels<T> boxes = job.texels(STATE_COUNT + 2);
	job.pool.run(job.domain[0], 256, [&](int32_t begin, int32_t end) {
		for (int32_t i = begin; i < end; i++) {
			const HeldConvex<T> convex = shapes.convex(i);
			Hull<T> box;
			hold(box, convex, T(0));
			hold(box, convex, T(1));
			T pad = padding(convex);
			boxes.of(i, AABB_MIN_X) = box.min.x() - pad;
			boxes.of(i, AABB_MIN_Y) = box.min.y() - pad;
			boxes.of(i, AABB_MAX_X) = box.max.x() + pad;
			boxes.of(i, AABB_MAX_Y) = box.max.y() + pad;
		}
	});
}

}

#endif
