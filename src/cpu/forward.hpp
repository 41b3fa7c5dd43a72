/* What the alternatives of the slot forward share: CONTRACT.md, "forward". [2.3] */
#ifndef CAROM_CPU_FORWARD_HPP
#define CAROM_CPU_FORWARD_HPP

#include "cpu/body.hpp"

namespace carom::cpu {

/* What moves of a body, in seconds. */
template <typename T> struct Motion {
	Vec<T> x, v;
	T angle, velocity;
};

template <typename T> Motion<T> motion_at(const State<T> &state, int32_t i, T t)
{
	const Body<T> body = state.body(i);
	const T part = t / state.length;
	return {body.place_at(t), {state.linear.of(i, LINEAR_VX) + part * body.a.x(), state.linear.of(i, LINEAR_VY) + part * body.a.y()},
		wrapped(body.angle_at(t)), state.rotational.of(i, ROTATIONAL_VELOCITY) + part * body.b};
}

/* The textures to write. */
template <typename T> struct Next {
	Texels<T> linear, rotational;

	void copy(const State<T> &state, int32_t i) const
	{
		for (int32_t channel = 0; channel < 4; channel++) {
			linear.of(i, channel) = state.linear.of(i, channel);
			rotational.of(i, channel) = state.rotational.of(i, channel);
		}
	}

	void put(const State<T> &state, int32_t i, const Motion<T> &motion) const
	{
		linear.of(i, LINEAR_X) = motion.x.x();
		linear.of(i, LINEAR_Y) = motion.x.y();
		linear.of(i, LINEAR_VX) = motion.v.x();
		linear.of(i, LINEAR_VY) = motion.v.y();
		rotational.of(i, ROTATIONAL_ANGLE) = motion.angle;
		rotational.of(i, ROTATIONAL_VELOCITY) = motion.velocity;
		rotational.of(i, ROTATIONAL_RADIUS) = state.rotational.of(i, ROTATIONAL_RADIUS);
		rotational.of(i, 3) = 0;
	}
};

/* Runs the slot to time t; `change(motion, state, i)` is what happens to a body there. */
template <typename T, typename Change> void move_bodies(const Job<T> &job, const Next<T> &next, const FirstHit<T> &hit, T t, Change change)
{
	const State<T> state(job, hit.length);
	job.pool.run(job.domain[0], 512, [&](int32_t begin, int32_t end) {
		for (int32_t i = begin; i < end; i++) {
			if (state.is_static(i) || hit.length == 0) {
				next.copy(state, i);
				continue;
			}
			Motion<T> motion = motion_at(state, i, t);
			change(motion, state, i);
			next.put(state, i, motion);
		}
	});
}

}

#endif
