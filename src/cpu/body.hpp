/* Bodies and the clock, as the kernels read them: CONTRACT.md, "Bodies in step units". */
#ifndef CAROM_CPU_BODY_HPP
#define CAROM_CPU_BODY_HPP

#include "cpu/stages.hpp"

namespace carom::cpu {

template <typename T> struct Body {
	Vec<T> x, v, a; /* in a step that is 1 long */
	T r, w, b;      /* angle, angular velocity and acceleration */
	T radius, inverse_mass, inverse_inertia;
	int32_t first, count, pieces; /* vertices, of a polygon that is not convex those of its hull; and its pieces: none of what is convex */

	bool is_circle() const { return count == 1; }
	bool is_dynamic() const { return inverse_mass > 0; } /* what is static, kinematic or held is not */
	Vec<T> place_at(T t) const { return place(x, v, a, t); }
	T angle_at(T t) const { return place(r, w, b, t); }
	Vec<T> velocity_at(T t) const { return v + t * a; }
	T angular_velocity_at(T t) const { return w + t * b; }
};

/* The k-th vertex of a polygon whose first texel is `first`, in its frame. */
template <typename T> Vec<T> vertex_at(const Texels<T> &vertices, int32_t first, int32_t k)
{
	const int32_t texel = first + k / 2;
	return k % 2 ? Vec<T>(vertices.of(texel, VERTICES_X1), vertices.of(texel, VERTICES_Y1))
				 : Vec<T>(vertices.of(texel, VERTICES_X0), vertices.of(texel, VERTICES_Y0));
}

/* A vertex, and the outward normal of the side that follows it, 1 long: as records of Outlines lie in memory. */
template <typename T> struct Corner {
	Vec<T> vertex, normal;
};

static_assert(sizeof(Corner<float>) == 4 * sizeof(float), "records");

template <typename T> Vec<T> side_normal(const Vec<T> &from, const Vec<T> &to)
{
	const Vec<T> edge = to - from;
	const T s = norm(edge);
	return {edge.y() / s, -edge.x() / s};
}

/* A body with its corners at hand; a circle has none. */
template <typename T> struct Convex : Body<T> {
	const Corner<T> *corners;

	Vec<T> vertex(int32_t k) const { return corners[k].vertex; }
	Vec<T> normal(int32_t k) const { return corners[k].normal; }
	int32_t after(int32_t k) const { return k + 1 == this->count ? 0 : k + 1; }
	int32_t before(int32_t k) const { return k == 0 ? this->count - 1 : k - 1; }
};

/* One that holds its corners itself. */
template <typename T> struct HeldConvex : Convex<T> {
	HeldConvex(const Body<T> &body, const Texels<T> &vertices)
	{
		static_cast<Body<T> &>(*this) = body;
		this->corners = held;
		if (body.count == 1)
			return;
		for (int32_t k = 0; k < body.count; k++)
			held[k].vertex = vertex_at(vertices, body.first, k);
		for (int32_t k = 0; k < body.count; k++)
			held[k].normal = side_normal<T>(this->vertex(k), this->vertex(this->after(k)));
	}
	HeldConvex(const HeldConvex &) = delete;
	HeldConvex &operator=(const HeldConvex &) = delete;

private:
	Corner<T> held[CAROM_MAX_VERTICES];
};

/* The bodies of a step of `length` seconds. */
template <typename T> class State
{
public:
	State(const Job<T> &job, T step_length)
		: linear(job.texels(FROM_LINEAR)), rotational(job.texels(FROM_ROTATIONAL)), geometry(job.texels(FROM_GEOMETRY)),
		  forces(job.texels(FROM_FORCES)), uniforms(job.texels(FROM_UNIFORMS)), length(step_length)
	{
	}

	Body<T> body(int32_t i) const
	{
		Body<T> body;
		body.x = {linear.of(i, LINEAR_X), linear.of(i, LINEAR_Y)};
		body.v = {linear.of(i, LINEAR_VX) * length, linear.of(i, LINEAR_VY) * length};
		body.r = rotational.of(i, ROTATIONAL_ANGLE);
		body.w = rotational.of(i, ROTATIONAL_VELOCITY) * length;
		body.radius = rotational.of(i, ROTATIONAL_RADIUS);
		body.first = static_cast<int32_t>(geometry.of(i, GEOMETRY_FIRST));
		body.count = static_cast<int32_t>(geometry.of(i, GEOMETRY_COUNT));
		body.pieces = 0; /* this step is for convex bodies alone */
		body.inverse_mass = 1 / geometry.of(i, GEOMETRY_MASS);
		body.inverse_inertia = 1 / geometry.of(i, GEOMETRY_INERTIA);
		accelerate(body, i);
		return body;
	}

	bool is_dynamic(int32_t i) const { return 1 / geometry.of(i, GEOMETRY_MASS) > 0; }
	bool is_static(int32_t i) const
	{
		return !is_dynamic(i) && linear.of(i, LINEAR_VX) == 0 && linear.of(i, LINEAR_VY) == 0 && rotational.of(i, ROTATIONAL_VELOCITY) == 0;
	}
	T restitution(int32_t i) const { return forces.of(i, FORCES_RESTITUTION); }
	T world(int32_t channel) const { return uniforms.fact(UNIFORMS_WORLD, channel); }
	T room(int32_t channel) const { return uniforms.fact(UNIFORMS_ROOM, channel); }
	T rule(int32_t channel) const { return uniforms.fact(UNIFORMS_RULES, channel); }

	const Texels<T> linear, rotational, geometry, forces, uniforms;
	const T length;

private:
	void accelerate(Body<T> &body, int32_t i) const
	{
		body.a = {0, 0};
		body.b = 0;
		if (!body.is_dynamic())
			return;
		T im = body.inverse_mass;
		body.a.x() = ((world(WORLD_GRAVITY_X) + forces.of(i, FORCES_X) * im) * length) * length;
		body.a.y() = ((world(WORLD_GRAVITY_Y) + forces.of(i, FORCES_Y) * im) * length) * length;
		body.b = ((forces.of(i, FORCES_TORQUE) * body.inverse_inertia) * length) * length;
	}
};

/* The state and the vertices. */
template <typename T> class Shapes : public State<T>
{
public:
	Shapes(const Job<T> &job, T step_length) : State<T>(job, step_length), vertices(job.texels(STATE_COUNT)) {}

	HeldConvex<T> convex(int32_t i) const { return HeldConvex<T>(this->body(i), vertices); }

private:
	const Texels<T> vertices;
};

/* How bodies rub, by their indices: CONTRACT.md, "Friction". */
template <typename T> class Rubs
{
public:
	Rubs(const Texels<T> &uniforms, const Texels<T> &friction)
		: any(uniforms.fact(UNIFORMS_RUBS, RUBS_ANY) > 0), walls(uniforms.fact(UNIFORMS_RUBS, RUBS_WALLS)),
		  rolling_walls(uniforms.fact(UNIFORMS_RUBS, RUBS_ROLLING)), coefficients(friction)
	{
	}

	T at_wall(int32_t i) const { return any ? std::sqrt(of(i) * walls) : T(0); }
	T between(int32_t i, int32_t k) const { return any ? std::sqrt(of(i) * of(k)) : T(0); }
	T rolling_at_wall(int32_t i) const { return any ? larger(rolling_of(i), rolling_walls) : T(0); }
	T rolling_between(int32_t i, int32_t k) const { return any ? larger(rolling_of(i), rolling_of(k)) : T(0); }

	const bool any;

private:
	T of(int32_t i) const { return coefficients.of(i, FRICTION_SLIDING); }
	T rolling_of(int32_t i) const { return coefficients.of(i, FRICTION_ROLLING); }

	const T walls, rolling_walls;
	const Texels<T> coefficients;
};

/* Does a hit of this restitution, of bodies with this coefficient of friction, take energy? What does comes to rest in the end. */
template <typename T> bool loses_energy(T restitution, T friction)
{
	return restitution < 1 || friction > 0;
}

/* How long the step that begins may last, by the clock as the step before left it. */
template <typename T> T step_length(const Texels<T> &clock, const Texels<T> &uniforms)
{
	const T remaining = clock.fact(CLOCK_TIME, TIME_REMAINING), longest = uniforms.fact(UNIFORMS_WORLD, WORLD_TIME_STEP);
	if (clock.fact(CLOCK_STEP, STEP_ENDED) > 0 || remaining < LEAST_STEP)
		return 0;
	return longest * T(LAST_STEP) < remaining ? longest : remaining;
}

/* Of a step of that length, the one in which it is found what rests, and by which forces: the whole time step where it is cut short, so that what lies lies on in it. */
template <typename T> T whole_length(T length, const Texels<T> &uniforms)
{
	return length > 0 ? larger(length, uniforms.fact(UNIFORMS_WORLD, WORLD_TIME_STEP)) : T(0);
}

/* How much of that a step of that length is, of joints, which act in what there is of it. */
template <typename T> T part_of_whole(T length, T whole)
{
	return whole > 0 ? larger(length / whole, T(JOINT_SHORTEST)) : T(1);
}

/* What the clock after a step says of time; where the step went to the end, none remains. */
template <typename T> void add_time(const Texels<T> &clock, const Texels<T> &next, T advanced)
{
	const Sum<T> elapsed = add_exactly({clock.fact(CLOCK_TIME, TIME_ELAPSED), clock.fact(CLOCK_TIME, TIME_ELAPSED_LOW)}, advanced);
	Sum<T> remaining{clock.fact(CLOCK_TIME, TIME_REMAINING), clock.fact(CLOCK_TIME, TIME_REMAINING_LOW)};
	remaining = remaining.high == advanced ? Sum<T>{0, 0} : add_exactly(remaining, -advanced);
	next.set(CLOCK_TIME, 0, elapsed.high, elapsed.low, remaining.high, remaining.low);
}

/* Bodies of the step that begins, for the stages with the textures STATE, vertices, clock, ... */
template <typename T> Shapes<T> shapes_before(const Job<T> &job)
{
	return Shapes<T>(job, step_length(job.texels(STATE_COUNT + 1), job.texels(FROM_UNIFORMS)));
}

/* The first hit, when the clock has it. */
template <typename T> struct FirstHit {
	explicit FirstHit(const Texels<T> &clock)
		: time(clock.fact(CLOCK_HIT, HIT_TIME)), length(clock.fact(CLOCK_STEP, STEP_LENGTH)),
		  row(static_cast<int32_t>(clock.fact(CLOCK_HIT, HIT_ROW))), column(static_cast<int32_t>(clock.fact(CLOCK_HIT, HIT_COLUMN))),
		  done(clock.fact(CLOCK_HIT, HIT_DONE) != 0)
	{
	}

	bool in_step() const { return time <= 1; }
	bool at_wall() const { return column < 0; }
	int32_t wall() const { return -1 - column; }

	T time, length;
	int32_t row, column;
	bool done;
};

}

#endif
