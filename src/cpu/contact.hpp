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

/* The pose is the reference's. */
template <typename T> void add_point(Contact<T> &contact, const Pose<T> &pose, const Vec<T> &ref, const Vec<T> &inc)
{
	const Vec<T> &n = contact.n;
	contact.add(ref, inc, (inner(n, pose.v) + pose.wa * cross(n, ref)) - pose.wb * cross(n, inc));
}

template <typename T> struct Segment {
	Vec<T> low, high;
	bool beside; /* it lies beside the face */
};

/* The edge at the incident body's deepest vertex that lies along the face, in the reference's frame. */
template <typename T> Segment<T> incident_edge(const Convex<T> &incident, const Pose<T> &pose, const Axis<T> &axis)
{
	Vec<T> middle = incident.vertex(axis.deepest);
	Vec<T> before = incident.vertex(incident.before(axis.deepest)), after = incident.vertex(incident.after(axis.deepest));
	Vec<T> m = turn_back(pose.relative, axis.n), e1 = middle - before, e2 = after - middle;
	bool second = std::abs(inner(m, e2)) * norm(e1) < std::abs(inner(m, e1)) * norm(e2);
	Vec<T> v = pose.to_a(second ? middle : before), u = pose.to_a(second ? after : middle);
	return {u, v, false};
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
	if (start < 0 && end > 0)
		edge.low = u + (-start / (end - start)) * (v - u);
	if (end > width && start < width)
		edge.high = u + ((width - start) / (end - start)) * (v - u);
	edge.beside = end < 0 || start > width;
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
	for (const Vec<T> &p : {edge.low, edge.high}) {
		if (!edge.beside && inner(axis.n, p) - axis.offset <= axis.gap + slop)
			add(p);
	}
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

}

#endif
