/* Where two bodies, or a body and a wall, touch, and how fast they approach there: CONTRACT.md, "Contact". */
#ifndef CAROM_CPU_CONTACT_HPP
#define CAROM_CPU_CONTACT_HPP

#include "cpu/convex.hpp"

#include <utility>

namespace carom::cpu {

/* One or two points of a reference body and an incident one. */
template <typename T> struct Contact {
	bool from_b; /* B is the reference and A is incident, else the other way round */
	Vec<T> n;    /* from the reference to the incident body, in the world */
	int count = 0;
	Vec<T> ref[2], inc[2]; /* levers, from the bodies' centres */
	T rate[2];             /* at which the points part */

	void add(const Vec<T> &from_ref, const Vec<T> &from_inc, T point_rate)
	{
		ref[count] = from_ref;
		inc[count] = from_inc;
		rate[count++] = point_rate;
	}

	T slowest() const { return count > 1 ? smaller(rate[0], rate[1]) : rate[0]; }
	/* Is a point's rate below that? */
	bool is_below(T limit) const { return (count > 0 && rate[0] < limit) || (count > 1 && rate[1] < limit); }
};

/* When bodies that touch hit each other, and when rounding has sunk them into each other. What was found so is so still when it is answered: then the thresholds are
 * nearer, by `loose` of them. */
template <typename T> struct Threshold {
	bool sunk;
	T rate;    /* a point with less is hit */
	T parting; /* what is sunk parts at least so fast */

	Threshold(T gap, T slop, T stillness, T loose = 0)
		: sunk(-gap > (1 - loose) * slop && -gap < (1 + loose) * (T(SUNK_MOST) * slop)),
		  rate(sunk ? (1 + loose) * (T(SUNK_RATE) * slop) : -((1 - loose) * stillness)), parting(sunk ? larger(slop, 4 * stillness) : T(0))
	{
	}
};

/* How fast a point parts; the pose is the reference's. */
template <typename T> T rate_at(const Vec<T> &n, const Pose<T> &pose, const Vec<T> &ref, const Vec<T> &inc)
{
	return (inner(n, pose.v) + pose.wa * cross(n, ref)) - pose.wb * cross(n, inc);
}

template <typename T> void add_point(Contact<T> &contact, const Pose<T> &pose, const Vec<T> &ref, const Vec<T> &inc)
{
	contact.add(ref, inc, rate_at<T>(contact.n, pose, ref, inc));
}

template <typename T> struct Segment {
	Vec<T> low, high;
	bool before, behind; /* it lies beside the face */
};

/* The edge at the incident body's deepest vertex that lies along the face, in the reference's frame. */
template <typename T> Segment<T> incident_edge(const Convex<T> &incident, const Pose<T> &pose, const Axis<T> &axis)
{
	Vec<T> middle = incident.vertex(axis.deepest);
	Vec<T> before = incident.vertex(incident.before(axis.deepest)), after = incident.vertex(incident.after(axis.deepest));
	Vec<T> m = turn_back(pose.relative, axis.n), e1 = middle - before, e2 = after - middle;
	bool second = std::abs(inner(m, e2)) * norm(e1) < std::abs(inner(m, e1)) * norm(e2);
	Vec<T> v = pose.to_a(second ? middle : before), u = pose.to_a(second ? after : middle);
	return {u, v, false, false};
}

/* The part of the edge in front of the face. */
template <typename T> Segment<T> clipped(Segment<T> edge, const Convex<T> &reference, const Axis<T> &axis)
{
	Vec<T> from = reference.vertex(axis.face), to = reference.vertex(reference.after(axis.face));
	Vec<T> tangent(-axis.n.y(), axis.n.x());
	T width = inner(tangent, to - from), start = inner(tangent, edge.low - from), end = inner(tangent, edge.high - from);
	if (end < start) {
		std::swap(edge.low, edge.high);
		std::swap(start, end);
	}
	const Vec<T> u = edge.low, v = edge.high;
	if (start < 0 && end >= 0)
		edge.low = u + (-start / (end - start)) * (v - u);
	if (end > width && start <= width)
		edge.high = u + ((width - start) / (end - start)) * (v - u);
	edge.before = end < 0;
	edge.behind = start > width;
	return edge;
}

template <typename T>
void add_face_points(Contact<T> &contact, const Convex<T> &reference, const Convex<T> &incident, const Pose<T> &pose, const Axis<T> &axis, T slop)
{
	Segment<T> edge = clipped(incident_edge(incident, pose, axis), reference, axis);
	auto add = [&](const Vec<T> &p) {
		Vec<T> ref = turn(pose.ra, p);
		add_point<T>(contact, pose, ref, ref - pose.d);
	};
	const auto is_near = [&](const Vec<T> &p) { return inner(axis.n, p) - axis.offset <= axis.gap + slop; };
	if (!edge.before && is_near(edge.low)) /* of one beside it only the end that is nearer to it */
		add(edge.low);
	if (!edge.behind && is_near(edge.high))
		add(edge.high);
	if (contact.count == 0)
		add(pose.to_a(incident.vertex(axis.deepest)));
}

/* The least a search goes on from a contact that does not approach: from the first the time in which the bodies move by the slop, and then, `before` being
 * the last, longer, for what turns fast and does not get away within a few of them would take too many. */
template <typename T> T creep_time(T before, T slop, T stillness)
{
	return before > 0 ? larger(before, smaller(2 * before, T(CREEP_SHORT))) : smaller(T(CREEP_MOST), (slop * T(APPROACH)) / stillness);
}

template <typename T> Contact<T> contact_at(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose_of_a, const Axis<T> &axis, T slop)
{
	const Convex<T> &reference = axis.from_b ? b : a, &incident = axis.from_b ? a : b;
	const Pose<T> pose = axis.from_b ? pose_of_a.swapped() : pose_of_a;
	Contact<T> contact{};
	contact.from_b = axis.from_b;
	contact.n = turn(pose.ra, axis.n);
	if (incident.is_circle()) {
		Vec<T> ref = pose.d - incident.radius * contact.n;
		add_point<T>(contact, pose, reference.is_circle() ? Vec<T>(0, 0) : ref, Vec<T>(0, 0));
	} else if (axis.face == no_face) {
		Vec<T> inc = turn(pose.rb, incident.vertex(axis.deepest));
		add_point<T>(contact, pose, pose.d + inc, inc);
	} else {
		add_face_points(contact, reference, incident, pose, axis, slop);
	}
	return contact;
}

/* Is the contact at a corner: an axis from one, or all its points where the face ends, or beyond? */
template <typename T>
bool is_at_corner(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose_of_a, const Axis<T> &axis, const Contact<T> &contact, T near)
{
	const Convex<T> &reference = axis.from_b ? b : a;
	if (axis.face == no_face)
		return true;
	const Vec<T> rotation = axis.from_b ? pose_of_a.rb : pose_of_a.ra, tangent(-contact.n.y(), contact.n.x());
	const T begin = inner(tangent, turn(rotation, reference.vertex(axis.face))),
			end = inner(tangent, turn(rotation, reference.vertex(reference.after(axis.face))));
	bool before = true, behind = true;
	for (int i = 0; i < contact.count; i++) {
		const T at = inner(tangent, contact.ref[i]);
		before = before && at <= begin + near;
		behind = behind && at >= end - near;
	}
	return before || behind;
}

/* A way out of a corner, and how fast the bodies approach along it. */
template <typename T> struct Way {
	Axis<T> axis;
	T rate;
};

/* The face of A, if any is, along which the bodies touch, though by rounding they are a little deep, and approach more slowly than that way. */
template <typename T>
void seek_slower(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, const Vec<T> &n, T alike, T slop, T deep, bool from_b, Way<T> &way)
{
	for (int32_t face = 0; face < a.count; face++) {
		Axis<T> axis = axis_along(b, pose, a.normal(face), inner(a.normal(face), a.vertex(face)), face);
		if (axis.gap < -deep || std::abs(inner(turn(pose.ra, axis.n), n)) > alike)
			continue;
		const T rate = contact_at(a, b, pose, axis, slop).slowest();
		axis.from_b = from_b;
		if (rate > way.rate)
			way = {axis, rate};
	}
}

/* Where corners meet there is more than one way out, and rounding alone says which is the least deep: what slides over a flush seam would hit the side of the next body.
 * There the way counts along which the bodies approach the most slowly, if that is less than half as fast. */
template <typename T>
Axis<T> corner_way(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, const Axis<T> &axis, const Contact<T> &contact, T slop)
{
	const T deep = T(CORNER_DEEP) * slop, alike = axis.face == no_face ? T(2) : T(CORNER_ALIKE);
	Way<T> way{axis, T(CORNER_PART) * contact.slowest()};
	if (a.is_circle() || b.is_circle() || !(way.rate < 0) || axis.gap < -deep || !is_at_corner(a, b, pose, axis, contact, T(CORNER_NEAR) * deep))
		return axis;
	seek_slower(a, b, pose, contact.n, alike, slop, deep, false, way);
	seek_slower(b, a, pose.swapped(), contact.n, alike, slop, deep, true, way);
	return way.axis;
}

/* Is there something to answer along a way out of a corner? On the bodies' own axis there is. */
template <typename T>
bool way_is_hit(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, const Axis<T> &own, const Axis<T> &way, T slop, T stillness, T loose)
{
	return way.is_same(own) || contact_at(a, b, pose, way, slop).is_below(Threshold<T>(way.gap, slop, stillness, loose).rate);
}

/* Along which a hit of two bodies is answered: not along a way on which there is nothing to answer, for that is one only now, by rounding. */
template <typename T> Axis<T> hit_axis(const Convex<T> &a, const Convex<T> &b, const Pose<T> &pose, T slop, T stillness, T loose)
{
	const Axis<T> own = best_axis(a, b, pose), way = corner_way(a, b, pose, own, contact_at(a, b, pose, own, slop), slop);
	return way_is_hit(a, b, pose, own, way, slop, stillness, loose) ? way : own;
}

}

#endif
