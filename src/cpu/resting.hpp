/* What bodies rest on, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_RESTING_HPP
#define CAROM_CPU_RESTING_HPP

#include "cpu/sleep.hpp"
#include "cpu/warm.hpp"

#include <algorithm>
#include <vector>

namespace carom::cpu {

/* Whom a point is shared with, as one number. */
struct Partner {
	int32_t code = PARTNER_NONE;

	Partner() = default;

	template <typename T> explicit Partner(T number) : code(static_cast<int32_t>(number)) {}

	/* Of another one's index, or -1 - wall. */
	static Partner that_stays(int32_t key) { return Partner(key < 0 ? PARTNER_WALL(-1 - key) : PARTNER_STATIC(key)); }

	bool is_none() const { return code == PARTNER_NONE; }
	bool moves() const { return code >= 0; }
	int32_t slot() const { return std::max(code, -1); } /* -1: of what does not move */
	template <typename T> int32_t key(const Slot<T> *slots) const
	{
		return moves() ? slots[code].body() : code > PARTNER_STATIC(0) ? -1 - (PARTNER_WALL(0) - code) : PARTNER_STATIC(0) - code;
	}
};

/* Four points of a body's joints and contacts side by side, in order; where there are no more, points that push nothing. */
template <typename T> struct Points {
	Lanes<T> partner; /* see Partner */
	Lanes<T> normal_x, normal_y, arm, other_arm, least, tolerance, step, force, start, give;

	void drop(int32_t i)
	{
		partner[i] = PARTNER_NONE;
		for (Lanes<T> *of : {&normal_x, &normal_y, &arm, &other_arm, &least, &tolerance, &step, &force, &start, &give})
			(*of)[i] = 0;
	}
};

/* How they slide, where bodies rub, along what is left of the normal; or roll. */
template <typename T> struct Grips {
	Lanes<T> friction, arm, other_arm, step, bound, force, start, along;

	void drop(int32_t i)
	{
		for (Lanes<T> *of : {&friction, &arm, &other_arm, &step, &bound, &force, &start, &along})
			(*of)[i] = 0;
	}

	/* The ways of their forces. */
	Lanes<T> x(const Points<T> &points) const { return -points.normal_y * along; }
	Lanes<T> y(const Points<T> &points) const { return points.normal_x * along; }
};

static_assert(sizeof(Points<float>) == FOUR_WIDTH * 4 * sizeof(float) && sizeof(Grips<float>) == GRIP_WIDTH * 4 * sizeof(float), "records");

/* Where a body slides at a point, seen from its partner: n is towards it, levers go from the two centres to the point. */
template <typename T> struct Slip {
	T arm = 0, other_arm = 0;

	Slip() = default;
	Slip(const Vec<T> &n, const Vec<T> &lever, const Vec<T> &other_lever)
	{
		const Vec<T> along(-n.y(), n.x());
		arm = cross(lever, along), other_arm = cross(other_lever, along);
	}
};

/* Contacts say 0 for circles, where a normal passes the centre. */
template <typename T> Vec<T> touched_at(const Convex<T> &body, const Vec<T> &lever, const Vec<T> &way_there)
{
	return body.is_circle() ? Vec<T>(body.radius * way_there) : lever;
}

/* A contact, seen from one of its bodies. */
template <typename T> struct Resting {
	struct Point {
		T arm, other_arm, least;
		Slip<T> slip;
	};

	int32_t key, points;
	Partner partner;
	Vec<T> n; /* from the partner */
	T force, tolerance, friction;
	Point at[2];
	T rolling = 0, rolling_arm = 0; /* the coefficient of rolling friction, which circles may have, and the arm of its force about both centres */

	/* How many points are written: that of a circle with rolling friction twice. */
	int32_t written() const { return points == 1 && rolling > 0 ? 2 : points; }
};

/* What is a contact. */
template <typename T> struct Nearness {
	T weight = 0; /* what pushes all of them; 0: each what pushes it */
	T fast = T(CONTACT_FAST);

	/* What the push moves, but no more than what is near beside the smaller body. */
	T force(T push, T radius) const { return smaller(weight > 0 ? weight : push, T(CONTACT_NEAR) * radius); }
};

/* How many points a body's joints have. */
struct JoinedCount {
	int32_t all = 0, firm = 0, rows = 0; /* firm: the first ones, which push and pull as is needed; rows: those before the ones that hold aside */
};

/* A slot, and which of the contacts that were found are its body's. */
struct RestingBody {
	int32_t s, points;
	JoinedCount joined; /* of these, the first ones */
	size_t first, end;
};

/* Finds the contacts of one body after the other. */
template <typename T> class RestFinder
{
public:
	RestFinder(const Clusters<T> &all, const Rubs<T> &friction) : clusters(all), rubs(friction) {}

	/* What the body rests on. If it does not sleep itself, that is disturbed in its sleep; what is kinematic disturbs what is near. */
	RestingBody find(int32_t s, const Sleepers<T> &sleepers)
	{
		Slot<T> room, other_room;
		const Slot<T> &slot = sleepers.awake(clusters.slots[s], s, room);
		const bool is_awake = !sleepers.sleeps(s), is_dynamic = slot.is_dynamic();
		const Nearness<T> nearness;
		first = found.size();
		if (slot.is_static())
			return {s, 0, {}, first, first};
		if (is_dynamic && !(is_awake && clusters.stays_inside(s, Trajectory<T>(slot), T(1))))
			walls(slot, Trajectory<T>(slot), nearness);
		clusters.each_neighbour(s, clusters.spans[s].end, [&](int32_t other, bool) {
			const Slot<T> &other_slot = sleepers.awake(clusters.slots[other], other, other_room);
			if (!may_rest(slot.radius() + other_slot.radius() + std::max(strength(slot), strength(other_slot)), slot.place, other_slot.place))
				return;
			if (is_dynamic)
				pair(slot, Trajectory<T>(slot), other, other_slot, Trajectory<T>(other_slot), nearness);
			else if (sleepers.sleeps(other))
				sleepers.disturb(other);
		});
		RestingBody body{s, 0, {}, first, found.size()};
		for (size_t k = first; k < found.size(); k++) {
			body.points += found[k].written();
			if (const Partner partner = found[k].partner; is_awake && partner.moves() && sleepers.sleeps(partner.slot()))
				sleepers.disturb(partner.slot());
		}
		return body;
	}

	/* Writes a body's points in order, behind those of joints, and how they slide, where anything rubs. */
	void write(const RestingBody &body, Points<T> *to, Grips<T> *grips) const
	{
		int32_t written = body.joined.all;
		for (size_t k = body.first; k < body.end; k++) {
			const Resting<T> &rest = found[k];
			const int32_t count = rest.written();
			for (int32_t point = 0; point < count; point++, written++) {
				const bool rolls = point == rest.points;
				const auto &at = rest.at[rolls ? 0 : point];
				Points<T> &points = to[written / lane_count];
				const int32_t i = written % lane_count;
				points.drop(i);
				points.partner[i] = static_cast<T>(rest.partner.code);
				points.normal_x[i] = rest.n.x(), points.normal_y[i] = rest.n.y();
				points.arm[i] = at.arm, points.other_arm[i] = at.other_arm;
				points.least[i] = at.least, points.tolerance[i] = rest.tolerance;
				if (!rubs.any)
					continue;
				Grips<T> &gripping = grips[written / lane_count];
				gripping.drop(i);
				gripping.friction[i] = (rolls ? rest.rolling : rest.friction) * (count > rest.points ? T(2) : T(1));
				gripping.arm[i] = rolls ? rest.rolling_arm : at.slip.arm;
				gripping.other_arm[i] = rolls ? rest.rolling_arm : at.slip.other_arm;
				gripping.along[i] = rolls ? T(0) : T(1);
			}
		}
		for (; written % lane_count > 0; written++) {
			to[written / lane_count].drop(written % lane_count);
			if (rubs.any)
				grips[written / lane_count].drop(written % lane_count);
		}
	}

	/* Calls `visit(contact)` for each that a moving body has, by the partners' indices, but for those with a slot that `is_known(slot)`. `way` is where it is, `way_of(slot)` where
	 * another one is then. */
	template <typename WayOf, typename IsKnown, typename Visit>
	void each(int32_t s, const Trajectory<T> &way, const Nearness<T> &nearness, const WayOf &way_of, const IsKnown &is_known, const Visit &visit)
	{
		found.clear();
		first = 0;
		walls(clusters.slots[s], way, nearness);
		clusters.each_neighbour(s, clusters.spans[s].end, [&](int32_t other, bool) {
			if (is_known(other))
				return;
			const Trajectory<T> other_way = way_of(other);
			if (may_rest(clusters.slots[s].radius() + clusters.slots[other].radius() + nearness.weight, way.place, other_way.place))
				pair(clusters.slots[s], way, other, clusters.slots[other], other_way, nearness);
		});
		for (const Resting<T> &rest : found)
			visit(rest);
	}

private:
	/* What is known of a contact before its points are. */
	struct Rules {
		T force, slop, fast;

		Rules(T push, T radius, T rounding, const Nearness<T> &nearness) : force(nearness.force(push, radius)), slop(rounding), fast(nearness.fast) {}

		T cushion() const { return smaller(T(CUSHION) * slop, T(0.5) * force); }
	};

	T strength(const Slot<T> &slot) const { return (std::abs(slot.push[PUSH_X]) + std::abs(slot.push[PUSH_Y])) * clusters.length * clusters.length; }

	/* False for most whose centres are more than that apart. */
	static bool may_rest(T most, const T *place, const T *other)
	{
		most *= T(1.0001);
		return std::abs(place[LINEAR_X] - other[LINEAR_X]) <= most && std::abs(place[LINEAR_Y] - other[LINEAR_Y]) <= most;
	}

	/* Adds a point, if it does not come too fast. */
	static void add(Resting<T> &rest, const Rules &rules, T rate, T gap, T arm, T other_arm, const Slip<T> &slip)
	{
		if (!(rate < -(rules.fast * rules.force)))
			rest.at[rest.points++] = {arm, other_arm, larger(gap, T(0)) - T(0.5) * rules.cushion(), slip};
	}

	/* By the partner's index, all those with it in order. */
	void insert(const Resting<T> *rests, int32_t count)
	{
		if (count == 0)
			return;
		auto place = found.end();
		const auto begin = place - static_cast<ptrdiff_t>(found.size() - first);
		while (place != begin && (place - 1)->key > rests->key)
			--place;
		if (place != begin && (place - 1)->key == rests->key)
			return; /* two that became neighbours at the same time may have noted each other twice */
		found.insert(place, rests, rests + count);
	}

	static Resting<T> begin(int32_t key, Partner partner, const Vec<T> &n, const Rules &rules, T friction)
	{
		return {key, 0, partner, n, rules.force, T(CONTACT_PART) * (T(EASE) * rules.cushion()), friction, {}};
	}

	void pair(const Slot<T> &slot, const Trajectory<T> &way, int32_t other, const Slot<T> &other_slot, const Trajectory<T> &other_way,
		const Nearness<T> &nearness)
	{
		const T friction = rubs.between(slot.body(), other_slot.body());
		if (!loses_energy(larger(slot.turn[TURN_RESTITUTION], other_slot.turn[TURN_RESTITUTION]), friction))
			return;
		const bool is_row = slot.body() > other_slot.body();
		Convex<T> a, b;
		clusters.fill(is_row ? a : b, slot, way);
		clusters.fill(is_row ? b : a, other_slot, other_way);
		const Rules rules(larger(norm(a.a), norm(b.a)), smaller(a.radius, b.radius), pair_slop(a, b), nearness);
		const Vec<T> d = b.x - a.x;
		if (!(rules.force > 0) || norm(d) - (a.radius + b.radius) > rules.force)
			return;
		const Pose<T> at = pose(a, b, T(0));
		Touches<T> touches;
		if (have_pieces(a, b))
			touches.find_of_pieces(a, b, at, rules.force, rules.slop);
		else
			touches.count = touches.find(a, b, at, rules.force, rules.slop, touches.of[0]);
		Resting<T> rests[PAIR_RESTS];
		int32_t count = 0;
		for (int32_t k = 0; k < touches.count; k++) {
			Resting<T> &rest = rests[count];
			rest = begin(other_slot.body(), other_slot.is_static() ? Partner::that_stays(other_slot.body()) : Partner(other), {0, 0}, rules,
				friction);
			rest.rolling = a.is_circle() || b.is_circle() ? rubs.rolling_between(slot.body(), other_slot.body()) : T(0);
			add_touch(rest, touches.of[k], a, b, is_row, rules);
			count += rest.points > 0;
		}
		insert(rests, count);
	}

	/* The points of a contact of A and B, as it is seen from the row body or the other. */
	static void add_touch(Resting<T> &rest, const Touch<T> &touch, const Convex<T> &a, const Convex<T> &b, bool is_row, const Rules &rules)
	{
		const Contact<T> &c = touch.contact;
		const Convex<T> &body = is_row ? a : b, &partner = is_row ? b : a;
		const bool is_incident = is_row == c.from_b;
		const Vec<T> n = rest.n = is_incident ? c.n : Vec<T>(-c.n);
		for (int32_t i = 0; i < c.count; i++) {
			const int32_t k = c.from_b ? c.count - 1 - i : i; /* whichever is the reference, in the same order */
			const Vec<T> &own = is_incident ? c.inc[k] : c.ref[k], &others = is_incident ? c.ref[k] : c.inc[k];
			add(rest, rules, c.rate[k], touch.gaps[k], cross(own, n), cross(others, n),
				Slip<T>(n, touched_at<T>(body, own, -n), touched_at<T>(partner, others, n)));
		}
		if (a.is_circle() || b.is_circle()) {
			const T radius = !a.is_circle() ? b.radius : !b.is_circle() ? a.radius : smaller(a.radius, b.radius);
			rest.rolling_arm = is_row ? radius : -radius;
		}
	}

	void walls(const Slot<T> &slot, const Trajectory<T> &way, const Nearness<T> &nearness)
	{
		const T friction = rubs.at_wall(slot.body());
		if (!clusters.has_walls() || !loses_energy(larger(slot.turn[TURN_RESTITUTION], clusters.rule(RULES_RESTITUTION)), friction))
			return;
		Convex<T> body;
		clusters.fill(body, slot, way);
		const Rules rules(norm(body.a), body.radius, wall_slop(body), nearness);
		const T rolling = rubs.rolling_at_wall(slot.body());
		for (int32_t k = 0; rules.force > 0 && k < wall_count; k++)
			wall(body, friction, rolling, rules, k);
	}

	void wall(const Convex<T> &body, T friction, T rolling, const Rules &rules, int32_t k)
	{
		const Wall<T> wall = clusters.wall(k);
		const T height = wall.height(body.x), speed = inner(wall.n, body.v);
		Resting<T> rest = begin(-1 - k, Partner::that_stays(-1 - k), wall.n, rules, friction);
		const auto slip = [&](const Vec<T> &lever) { return Slip<T>(wall.n, lever, {0, 0}); };
		if (body.is_circle()) {
			rest.rolling = rolling, rest.rolling_arm = body.radius;
			if (height - body.radius <= rules.force)
				add(rest, rules, speed, height - body.radius, 0, 0, slip(touched_at<T>(body, {0, 0}, -wall.n)));
		} else {
			const Vec<T> rotation = rotation_of(body.r), m = turn_back(rotation, wall.n);
			const int32_t deepest = lowest(body, m).vertex, before = body.before(deepest), after = body.after(deepest);
			const bool with_after = inner(m, body.vertex(after)) < inner(m, body.vertex(before));
			for (int32_t vertex : {with_after ? deepest : before, with_after ? after : deepest}) {
				const T gap = height + inner(m, body.vertex(vertex));
				const Vec<T> lever = turn(rotation, body.vertex(vertex));
				if (gap <= rules.force)
					add(rest, rules, speed - body.w * cross(wall.n, lever), gap, cross(lever, wall.n), 0, slip(lever));
			}
		}
		insert(&rest, rest.points > 0);
	}

	const Clusters<T> &clusters;
	const Rubs<T> &rubs;
	std::vector<Resting<T>> found;
	size_t first = 0; /* of the body */
};

}

#endif
