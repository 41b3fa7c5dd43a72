#include "cpu/aabb.hpp"

namespace carom::cpu {

template <typename T> static Hull<T> local_box(const Convex<T> &convex)
{
	Hull<T> local;
	if (convex.is_circle()) {
		local.hold({-convex.radius, -convex.radius});
		local.hold({convex.radius, convex.radius});
	}
	for (int32_t k = 0; k < convex.count && !convex.is_circle(); k++)
		local.hold(convex.vertex(k));
	return local;
}

/* The box of the turned corners of the local box: larger than tight's, at four points whatever the body [2.1]. */
template <typename T> static void hold_corners(Hull<T> &box, const Convex<T> &convex, T t)
{
	Vec<T> x = convex.place_at(t);
	Vec<T> rotation = convex.is_circle() ? Vec<T>(1, 0) : rotation_of(convex.angle_at(t));
	Hull<T> local = local_box(convex);
	for (const Vec<T> &corner : {local.min, Vec<T>(local.max.x(), local.min.y()), local.max, Vec<T>(local.min.x(), local.max.y())})
		box.hold(x + turn(rotation, corner));
}

template <typename T> static void loose(const Job<T> &job)
{
	find_boxes(job, hold_corners<T>);
}

extern const Stage aabb_loose;
const Stage aabb_loose{"aabb", "loose", {{STAGE_AABB, loose<float>, loose<double>}}, nullptr, nullptr};

}
