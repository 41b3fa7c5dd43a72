/* Two convex bodies at one time: the axis that separates them best, and their contact. CONTRACT.md, "The geometry of two
 * convex bodies at time t". */
#ifndef CAROM_CPU_CONVEX_HPP
#define CAROM_CPU_CONVEX_HPP

#include "cpu/lanes.hpp"

namespace carom::cpu {

/* A's and B's, B seen from A. */
template <typename T> struct Pose {
	Vec<T> d, v;     /* from A to B, in the world */
	Vec<T> ra, rb;   /* rotations */
	T wa, wb;        /* angular velocities */
	Vec<T> relative; /* takes B's frame to A's */

	Pose swapped() const { return {-d, -v, rb, ra, wb, wa, turn_back(rb, ra)}; }
	Vec<T> to_a(const Vec<T> &point_of_b) const { return turn(relative, point_of_b) + turn_back(ra, d); }
};

template <typename T> Pose<T> pose(const Convex<T> &a, const Convex<T> &b, T t)
{
	Vec<T> x = b.x - a.x, v = b.v - a.v, acceleration = b.a - a.a;
	Vec<T> ra = rotation_of(a.angle_at(t)), rb = rotation_of(b.angle_at(t));
	return {place(x, v, acceleration, t), v + t * acceleration, ra, rb, a.angular_velocity_at(t), b.angular_velocity_at(t), turn_back(ra, rb)};
}

template <typename T> T pair_slop(const Body<T> &a, const Body<T> &b)
{
	return (larger(largest(a.x), largest(b.x)) + (a.radius + b.radius)) * SLOP;
}

/* The speed below which an approach is lost in rounding. */
template <typename T> T pair_stillness(const Body<T> &a, const Body<T> &b)
{
	T straight = (span(a.v) + span(a.a)) + (span(b.v) + span(b.a));
	T turning = (std::abs(a.w) + std::abs(a.b)) * a.radius + (std::abs(b.w) + std::abs(b.b)) * b.radius;
	return (straight + turning) * APPROACH + STILL;
}

template <typename T> struct Lowest {
	T height;
	int32_t vertex;
};

/* The point of the body least along m. */
template <typename T> Lowest<T> lowest(const Convex<T> &body, const Vec<T> &m)
{
	if (body.is_circle())
		return {-body.radius, 0};
	Lowest<T> least{inner(m, body.vertex(0)), 0};
	for (int32_t k = 1; k < body.count; k++) {
		T height = inner(m, body.vertex(k));
		if (height < least.height)
			least = {height, k};
	}
	return least;
}

constexpr int32_t no_face = -1;

template <typename T> struct Axis {
	bool from_b;     /* the reference body is B */
	Vec<T> n;        /* unit, outward, in the reference's frame */
	T offset, gap;   /* of the reference along n; from there to the other, the incident body */
	int32_t deepest; /* vertex of the incident body */
	int32_t face;    /* of the reference; no_face: it is a corner, or a circle */

	bool is_same(const Axis &other) const { return face == other.face && from_b == other.from_b; } /* of the same pair */
};

template <typename T> Axis<T> axis_along(const Convex<T> &b, const Pose<T> &pose, const Vec<T> &n, T offset, int32_t face)
{
	Lowest<T> low = lowest(b, turn_back(pose.relative, n));
	T gap = (inner(n, turn_back(pose.ra, pose.d)) - offset) + low.height;
	return {false, n, offset, gap, low.vertex, face};
}

template <typename T> Axis<T> face_of(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, int32_t face)
{
	return axis_along(b, pose, a.normal(face), inner(a.normal(face), a.vertex(face)), face);
}

/* The face of A that B is farthest in front of, or least behind. */
template <typename T> Axis<T> face_axis(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose)
{
	const Vec<T> d = turn_back(pose.ra, pose.d);
	T most = 0;
	int32_t face = 0;
	for (int32_t first = 0; first < a.count; first += lane_count) {
		const FourCorners<T> c(a, first);
		const Lanes<T> mx = pose.relative.x() * c.nx + pose.relative.y() * c.ny, my = pose.relative.x() * c.ny - pose.relative.y() * c.nx;
		Lanes<T> low = b.is_circle() ? Lanes<T>{} - b.radius : mx * b.vertex(0).x() + my * b.vertex(0).y();
		for (int32_t k = 1; k < b.count; k++) {
			const Lanes<T> height = mx * b.vertex(k).x() + my * b.vertex(k).y();
			low = height < low ? height : low;
		}
		const Lanes<T> gap = ((c.nx * d.x() + c.ny * d.y()) - (c.nx * c.x + c.ny * c.y)) + low;
		for (int32_t i = 0; i < lane_count; i++) {
			const bool is_more = first + i == 0 || gap[i] > most;
			face = is_more ? first + i : face;
			most = is_more ? gap[i] : most;
		}
	}
	return face_of(a, b, pose, face);
}

/* From a corner of A to a point of B, both in A's frame. */
template <typename T>
Axis<T> corner_axis(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, const Vec<T> &from, const Vec<T> &to, const Axis<T> &fallback)
{
	Vec<T> e = to - from;
	T s = norm(e);
	if (!(s > 0))
		return fallback;
	Vec<T> n(e.x() / s, e.y() / s);
	Axis<T> axis = axis_along(b, pose, n, -lowest<T>(a, -n).height, no_face);
	/* (Beyond the end of a face a circle is nearest to the corner; that the gap is larger may be lost in rounding, which would turn n by 1e-3.) */
	return b.is_circle() || axis.gap > fallback.gap ? axis : fallback;
}

/* The face that a circle is in front of, if that is one beside it: of faces nearly in one line rounding alone says from which it is the farthest. */
template <typename T> Axis<T> circle_face(const Convex<T> &a, const Convex<T> &circle, const Pose<T> &pose, const Vec<T> &point, Axis<T> axis)
{
	for (int32_t k = 0; k < a.count; k++) {
		const int32_t face = axis.face, next = a.after(face), last = a.before(face);
		const Vec<T> from = a.vertex(face), to = a.vertex(next), edge = to - from;
		const T along = inner(edge, point - from);
		int32_t other = face;
		if (along > inner(edge, edge) && inner(Vec<T>(a.vertex(a.after(next)) - to), Vec<T>(point - to)) > 0)
			other = next;
		else if (along < 0 && inner(Vec<T>(from - a.vertex(last)), Vec<T>(point - from)) < 0)
			other = last;
		if (other == face)
			break;
		axis = face_of(a, circle, pose, other);
	}
	return axis;
}

/* A's best face, or where the bodies are apart and B is nearest to one of its ends, that corner. */
template <typename T> Axis<T> polygon_axis(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose)
{
	Axis<T> face = face_axis(a, b, pose);
	if (!(face.gap + (b.is_circle() ? b.radius : 0) > 0))
		return face;
	Vec<T> point = b.is_circle() ? turn_back(pose.ra, pose.d) : pose.to_a(b.vertex(face.deepest));
	if (b.is_circle())
		face = circle_face(a, b, pose, point, face);
	Vec<T> from = a.vertex(face.face), to = a.vertex(a.after(face.face)), edge = to - from;
	T along = inner(edge, point - from);
	if (along < 0)
		return corner_axis(a, b, pose, from, point, face);
	if (along > inner(edge, edge))
		return corner_axis(a, b, pose, to, point, face);
	return face;
}

template <typename T> Axis<T> circle_axis(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose)
{
	Vec<T> e = turn_back(pose.ra, pose.d);
	T s = norm(e);
	Vec<T> n = s == 0 ? Vec<T>(1, 0) : Vec<T>(e.x() / s, e.y() / s);
	return {false, n, a.radius, (s - a.radius) - b.radius, 0, no_face};
}

template <typename T> Axis<T> axis_from_b(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose)
{
	Axis<T> axis = polygon_axis(b, a, pose.swapped());
	axis.from_b = true;
	return axis;
}

template <typename T> Axis<T> best_axis(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose)
{
	if (a.is_circle() && b.is_circle())
		return circle_axis(a, b, pose);
	if (b.is_circle())
		return polygon_axis(a, b, pose);
	Axis<T> from_b = axis_from_b(a, b, pose);
	if (a.is_circle())
		return from_b;
	Axis<T> from_a = polygon_axis(a, b, pose);
	return from_b.gap > from_a.gap ? from_b : from_a;
}

}

#endif
