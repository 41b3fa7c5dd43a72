/* Slots, trajectories, and the hits of the step events: CONTRACT.md, "The step events". */
#ifndef CAROM_CPU_SLOTS_HPP
#define CAROM_CPU_SLOTS_HPP

#include "cpu/apart.hpp"
#include "cpu/filters.hpp"
#include "cpu/impulse.hpp"
#include "cpu/pieces.hpp"

#include <limits>

namespace carom::cpu {

/* The records of a slot, as they lie in memory. */
template <typename T> struct Slot {
	T place[4], turn[4], mass[4], push[4];

	bool is_circle() const { return !(mass[MASS_COUNT] > 1); }
	/* Of a polygon that is not convex those of its hull. */
	int32_t vertices() const { return static_cast<int32_t>(vertices_and_pieces() % PIECES); }
	int32_t pieces() const { return static_cast<int32_t>(vertices_and_pieces() / PIECES); }
	/* Not static, nor kinematic: those have infinite mass, and no hit changes them. */
	bool is_dynamic() const { return mass[MASS_INVERSE] > 0; }
	/* A kinematic body: it goes on as it does, whatever it hits. */
	bool is_kinematic() const { return !is_dynamic() && !(place[LINEAR_VX] == 0 && place[LINEAR_VY] == 0 && turn[TURN_VELOCITY] == 0); }
	bool is_static() const { return !is_dynamic() && !is_kinematic(); }
	/* May the bodies hit each other, wherever they are? */
	bool meets(const Slot &other, const Filters &filters) const { return (is_dynamic() || other.is_dynamic()) && filters.let(body(), other.body()); }
	int32_t body() const { return static_cast<int32_t>(push[PUSH_BODY]); }
	T radius() const { return turn[TURN_RADIUS]; }

private:
	uint32_t vertices_and_pieces() const { return static_cast<uint32_t>(static_cast<int32_t>(mass[MASS_COUNT])); }
};

/* A body's way from a time on. */
template <typename T> struct Trajectory {
	T place[4], angle, velocity, time, held;

	explicit Trajectory(const Slot<T> &slot) : angle(slot.turn[TURN_ANGLE]), velocity(slot.turn[TURN_VELOCITY]), time(0), held(0)
	{
		std::memcpy(place, slot.place, sizeof place);
	}
};

/* What is known of a body that events change: the records of Work. */
template <typename T> struct Work {
	T place[4], angle, velocity, time, held, next[4], box[4];

	void keep(const Trajectory<T> &way)
	{
		std::memcpy(place, way.place, sizeof place);
		angle = way.angle, velocity = way.velocity, time = way.time, held = way.held;
	}

	void empty_box()
	{
		box[0] = box[1] = std::numeric_limits<T>::infinity();
		box[2] = box[3] = -box[0];
	}

	Trajectory<T> trajectory(const Slot<T> &slot) const
	{
		Trajectory<T> way(slot);
		std::memcpy(way.place, place, sizeof place);
		way.angle = angle, way.velocity = velocity, way.time = time, way.held = held;
		return way;
	}
};

static_assert(sizeof(Slot<float>) == SLOT_WIDTH * 4 * sizeof(float) && sizeof(Work<float>) == WORK_WIDTH * 4 * sizeof(float), "records");

/* The numbers of a member. */
struct Member {
	int32_t stuck, owner, link, head, events, rapid, seen, round, hits;
	int32_t place; /* in the cluster's heap */
	int32_t fast;  /* 1: one of the hits was not slow */
	int32_t ruled; /* of the hits */
	int32_t kept;  /* the first of them in Hits, -1 for none */
	int32_t unused;
	int32_t pile;  /* 1: it led a cluster that lies in a pile, in this step */
	int32_t begun; /* events, as the slice began */

	void reset() { *this = {0, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0}; }
};

static_assert(sizeof(Member) == MEMBER_WIDTH * sizeof(int32_t) && offsetof(Member, hits) == MEMBER_HITS * sizeof(int32_t)
		&& offsetof(Member, round) == MEMBER_ROUND * sizeof(int32_t) && offsetof(Member, rapid) == MEMBER_RAPID * sizeof(int32_t)
		&& offsetof(Member, stuck) == MEMBER_STUCK * sizeof(int32_t),
	"members");

struct Span {
	int32_t start, half, end;
	int32_t found; /* of a step; while lists are made: the cell */
};

static_assert(sizeof(Span) == SPAN_WIDTH * sizeof(int32_t), "spans");

struct Wake {
	int32_t changed, next;
};

static_assert(sizeof(Wake) == WAKE_WIDTH * sizeof(int32_t), "wakes");

/* A hit that the step begins with. */
struct FoundHit {
	int32_t partner, time, link;
};

static_assert(sizeof(FoundHit) == FOUND_WIDTH * sizeof(int32_t), "found");

/* The centre's motion in step units, with the radius about it. */
template <typename T> struct Disc {
	Lanes<T> way;  /* x, y, vx, vy */
	Lanes<T> push; /* ax, ay; what follows is of no use */
	T radius, time;

	[[gnu::always_inline]] Disc(const Slot<T> &slot, const T *place, T at, bool stands, T length) : radius(slot.radius()), time(at)
	{
		std::memcpy(&way, place, sizeof way);
		std::memcpy(&push, slot.push, sizeof push);
		const T moves = stands ? T(0) : length;
		way = way * Lanes<T>{1, 1, moves, moves};
		push = (push * moves) * moves;
	}

	/* Of a body that no event has changed, as the step begins. */
	[[gnu::always_inline]] Disc(const Slot<T> &slot, T length) : Disc(slot, slot.place, 0, false, length) {}

	T x() const { return way[0]; }
	T y() const { return way[1]; }
	T vx() const { return way[2]; }
	T vy() const { return way[3]; }
	T ax() const { return push[0]; }
	T ay() const { return push[1]; }
	bool falls_like(const Disc &other) const { return ax() == other.ax() && ay() == other.ay(); }

	[[gnu::always_inline]] Disc later(T t) const
	{
		Disc disc = *this;
		const T dt = t - time;
		disc.way += dt * (Lanes<T>{way[2], way[3], push[0], push[1]} + (T(0.5) * dt) * Lanes<T>{push[0], push[1], 0, 0});
		disc.time = t;
		return disc;
	}
};

/* One disc seen from another of the same time. */
template <typename T> struct Between {
	T way[4], push[4]; /* like a disc's */
	T radii;
	T size; /* what rounding depends on, but for the way */
	T rest; /* of the step */

	/* To be used for so many steps after this one. */
	[[gnu::always_inline]] Between(const Disc<T> &own, const Disc<T> &other, T ahead)
		: radii(own.radius + other.radius),
		  size((2 * (std::abs(own.x()) + std::abs(own.y())) + ahead * (std::abs(own.vx()) + std::abs(own.vy()))) + radii), rest(1 - own.time)
	{
		const Lanes<T> moves = other.way - own.way, pushes = other.push - own.push;
		std::memcpy(way, &moves, sizeof way);
		std::memcpy(push, &pushes, sizeof push);
	}
};

/* How one disc moves seen from another, for the rest of the step. Looked at far more often than anything else, so nothing of it has branches,
 * and compilers make vectors of many. */
template <typename T> struct Approach {
	T x, y, vx, vy, rest;
	T size; /* what rounding depends on, but for what is above */
	T most; /* at this distance they touch, whatever pushes them, but for rounding */

	/* For the rest of the step and so many steps more, each of whose ends is rounded. */
	[[gnu::always_inline]] Approach(const Between<T> &two, T ahead) : Approach(two.way, two.push, two.radii, two.size, two.rest, ahead) {}
	[[gnu::always_inline]] Approach(const T *way, const T *push, T radii, T all, T time, T ahead)
		: x(way[0]), y(way[1]), vx(way[2]), vy(way[3]), rest(time + ahead), size((1 + ahead) * (all + ahead * (std::abs(vx) + std::abs(vy)))),
		  most(radii + (1 + ahead) * (1 + ahead) * (std::abs(push[0]) + std::abs(push[1])))
	{
	}

	[[gnu::always_inline]] T reach() const { return most + (size + std::abs(x) + std::abs(y) + std::abs(vx) + std::abs(vy)) * T(4 * SLOP); }

	[[gnu::always_inline]] bool may_touch() const
	{
		const T reach = this->reach();
		const T at = -(x * vx + y * vy) / (vx * vx + vy * vy + std::numeric_limits<T>::min()), late = at > 0 ? at : 0;
		const T t = late < rest ? late : rest, dx = x + t * vx, dy = y + t * vy;
		return !(dx * dx + dy * dy > reach * reach * T(1.00001));
	}

	/* They do not hit before. Circles that fall alike do not any more once they part, and fast enough for what is sunk. */
	T earliest(bool falls_alike) const
	{
		const T reach = this->reach() * T(1.00001), square = x * x + y * y, nearer = -(x * vx + y * vy);
		if (falls_alike && -nearer > (reach - most) * ((std::abs(vx) + std::abs(vy)) + T(0.5 * SUNK_RATE) * (std::abs(x) + std::abs(y))))
			return rest;
		if (!(square > reach * reach) || !(nearer > 0))
			return 0;
		const T distance = std::sqrt(square), side = x * vy - y * vx, under = reach * reach * (vx * vx + vy * vy) - side * side;
		return (distance - reach) * (distance + reach) / (std::sqrt(std::max(under, T(0))) + nearer) * T(0.9999);
	}
};

/* From the later of their times on. */
template <typename T> [[gnu::always_inline]] inline Between<T> between(const Disc<T> &own, const Disc<T> &other, T ahead)
{
	return other.time > own.time ? Between<T>(own.later(other.time), other, ahead) : Between<T>(own, other.later(own.time), ahead);
}

/* What two bodies that are not changed any more do first, from the approach's beginning: they do not hit before `earliest` steps, nor in this one unless
 * they may touch. */
template <typename T> struct Outlook {
	T earliest;
	bool may_touch;

	Outlook(const Approach<T> &approach, const Slot<T> &slot, const Disc<T> &disc, const Slot<T> &other, const Disc<T> &other_disc)
	{
		const bool alike = disc.falls_like(other_disc);
		earliest = std::max(disc.time, other_disc.time) + approach.earliest(alike && slot.is_circle() && other.is_circle());
		may_touch = !(earliest > 1) && (alike || Approach<T>(between(disc, other_disc, T(0)), T(0)).may_touch());
	}
};

/* Trajectories in a step of a length, s. */
template <typename T> struct Mover {
	T length;

	explicit Mover(T step) : length(step) {}

	Body<T> body(const Slot<T> &slot, const Trajectory<T> &way) const
	{
		Body<T> body;
		body.radius = slot.radius();
		body.first = static_cast<int32_t>(slot.mass[MASS_FIRST]);
		body.count = slot.vertices();
		body.pieces = slot.pieces();
		body.x = {way.place[LINEAR_X], way.place[LINEAR_Y]};
		body.r = way.angle;
		const bool stands = way.held > 0, pushed = !stands && slot.is_dynamic();
		body.inverse_mass = stands ? 0 : slot.mass[MASS_INVERSE];
		body.inverse_inertia = stands ? 0 : slot.mass[MASS_INVERSE_INERTIA];
		body.v = stands ? Vec<T>(0, 0) : Vec<T>(way.place[LINEAR_VX] * length, way.place[LINEAR_VY] * length);
		body.w = stands ? 0 : way.velocity * length;
		body.a = pushed ? Vec<T>((slot.push[PUSH_X] * length) * length, (slot.push[PUSH_Y] * length) * length) : Vec<T>(0, 0);
		body.b = pushed ? (slot.push[PUSH_TORQUE] * length) * length : 0;
		return body;
	}

	void move(const Slot<T> &slot, Trajectory<T> &way, T u) const
	{
		if (u == way.time || way.held > 0 || slot.is_static())
			return;
		const Body<T> at = body(slot, way);
		const T dt = u - way.time, part = dt / length;
		const Vec<T> x = at.place_at(dt);
		way.place[LINEAR_X] = x.x();
		way.place[LINEAR_Y] = x.y();
		way.place[LINEAR_VX] = way.place[LINEAR_VX] + part * at.a.x();
		way.place[LINEAR_VY] = way.place[LINEAR_VY] + part * at.a.y();
		way.angle = wrapped(at.angle_at(dt));
		way.velocity = way.velocity + part * at.b;
		way.time = u;
	}
};

/* What the hits of a step depend on. */
template <typename T> class Bodies : public Mover<T>
{
public:
	/* The kernel's first textures are Outlines, Uniforms and the clock, the next the slots. */
	explicit Bodies(const Job<T> &job) : Bodies(job, step_length(job.texels(2), job.texels(1))) {}
	/* In a step of another length. */
	Bodies(const Job<T> &job, T step_length)
		: Mover<T>(step_length), slots(reinterpret_cast<Slot<T> *>(job.records(3))), functions(job.functions), inside(job.inside),
		  uniforms(job.texels(1)), corners(reinterpret_cast<const Corner<T> *>(job.records(0))), rules{rule(RULES_EPSILON), rule(RULES_ITERATIONS)},
		  has_room(rule(RULES_HAS_ROOM) > 0)
	{
	}

	T rule(int32_t channel) const { return uniforms.fact(UNIFORMS_RULES, channel); }
	T time_step() const { return world(WORLD_TIME_STEP); }
	/* s: of the step in which forces are found. */
	T whole() const { return whole_length(length, uniforms); }
	T room(int32_t channel) const { return uniforms.fact(UNIFORMS_ROOM, channel); }
	/* What gravity makes of a speed in a step. */
	T weight() const { return norm(Vec<T>((world(WORLD_GRAVITY_X) * length) * length, (world(WORLD_GRAVITY_Y) * length) * length)); }

	void fill(Convex<T> &convex, const Slot<T> &slot, const Trajectory<T> &way) const
	{
		static_cast<Body<T> &>(convex) = this->body(slot, way);
		convex.corners = corners + convex.first;
	}

	/* Two bodies in the order in which a pair has them. */
	[[gnu::always_inline]] void fill(int32_t s, const Trajectory<T> &way, int32_t other, const Trajectory<T> &other_way, Convex<T> &a,
		Convex<T> &b) const
	{
		const bool in_order = slots[s].body() > slots[other].body();
		fill(in_order ? a : b, slots[s], way);
		fill(in_order ? b : a, slots[other], other_way);
	}

	/* A hit, or only a pause of the search for one. */
	struct Found {
		T time; /* NO_HIT if there is none */
		bool is_pause;
	};

	/* When the two hit; what is later than `until` need not be found. */
	[[gnu::always_inline]] Found pair_time(int32_t s, Trajectory<T> way, int32_t other, Trajectory<T> other_way, T until = 1) const
	{
		const T t0 = larger(way.time, other_way.time), rest = 1 - t0;
		this->move(slots[s], way, t0);
		this->move(slots[other], other_way, t0);
		Convex<T> a, b;
		fill(s, way, other, other_way, a, b);
		return pair_time(a, b, t0, smaller(until - t0 + T(1e-6), rest)); /* not before, however that is rounded */
	}

	/* The same of these two, which are there at t0, within a time from then on. */
	[[gnu::always_inline]] Found pair_time(const Convex<T> &a, const Convex<T> &b, T t0, T within) const
	{
		if (!a.is_dynamic() && !b.is_dynamic())
			return {NO_HIT, false};
		const Pair<T> pair(a, b, inside, within);
		const HitTime<T> found = have_pieces(a, b) ? first_hit_of_pieces(pair, functions.pair_time, rules) : functions.pair_time(pair, rules);
		return {found.hit <= 1 - t0 ? smaller(t0 + found.hit, T(1)) : T(NO_HIT), !(found.done > 0)};
	}

	/* When the body hits which wall first. */
	Found wall_time(int32_t s, const Trajectory<T> &way, int32_t *which) const
	{
		Found first{NO_HIT, false};
		*which = 0;
		if (way.held > 0 || stays_inside(s, way, T(1)))
			return first;
		Convex<T> convex;
		fill(convex, slots[s], way);
		for (int32_t k = 0; k < wall_count; k++) {
			const HitTime<T> found = functions.wall_time(convex, wall(k));
			const T u = found.hit <= 1 - way.time ? smaller(way.time + found.hit, T(1)) : T(NO_HIT);
			if (u <= 1 && u <= first.time)
				first = {u, !(found.done > 0)}, *which = k;
		}
		return first;
	}

	/* Is it sure to stay inside the room for so many steps? */
	bool stays_inside(int32_t s, const Trajectory<T> &way, T steps) const
	{
		if (!has_room || !slots[s].is_dynamic())
			return true;
		const Disc<T> disc(slots[s], way.place, way.time, false, length);
		const T push = steps * steps * (std::abs(disc.ax()) + std::abs(disc.ay())), vx = steps * disc.vx(), vy = steps * disc.vy();
		const T size = disc.radius + push + std::abs(vx) + std::abs(vy) + std::abs(disc.x()) + std::abs(disc.y());
		const T pad = disc.radius + push + steps * (size * T(4 * SLOP));
		return std::min(disc.x(), disc.x() + vx) - pad >= room(ROOM_MIN_X) && std::min(disc.y(), disc.y() + vy) - pad >= room(ROOM_MIN_Y)
			&& std::max(disc.x(), disc.x() + vx) + pad <= room(ROOM_MAX_X) && std::max(disc.y(), disc.y() + vy) + pad <= room(ROOM_MAX_Y);
	}

	bool has_walls() const { return has_room; }
	Wall<T> wall(int32_t k) const { return room_wall(*this, k); }

	Slot<T> *const slots;
	const Functions<T> &functions;
	const InsideTest<T> inside;
	using Mover<T>::length;

private:
	T world(int32_t channel) const { return uniforms.fact(UNIFORMS_WORLD, channel); }

	const Texels<T> uniforms;
	const Corner<T> *const corners;
	const SearchRules<T> rules;
	const bool has_room;
};

}

#endif
