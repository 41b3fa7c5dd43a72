#include "cpu/aabb.hpp"

namespace carom::cpu {

/* The paper's AABB, from the vertices where they are [2.1]. */
template <typename T> static void hold_vertices(Hull<T> &box, const Convex<T> &convex, T t)
{
	Vec<T> x = convex.place_at(t);
	if (convex.is_circle()) {
		box.hold({x.x() - convex.radius, x.y() - convex.radius});
		box.hold({x.x() + convex.radius, x.y() + convex.radius});
		return;
	}
	Vec<T> rotation = rotation_of(convex.angle_at(t));
	for (int32_t k = 0; k < convex.count; k++)
		box.hold(x + turn(rotation, convex.vertex(k)));
}

template <typename T> static void tight(const Job<T> &job)
{
	find_boxes(job, hold_vertices<T>);
}

extern const Stage aabb_tight;
const Stage aabb_tight{"aabb", "tight", {{STAGE_AABB, tight<float>, tight<double>}}, nullptr, nullptr};

}
