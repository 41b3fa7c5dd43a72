#include "cpu/forward.hpp"

namespace carom::cpu {

template <typename T> static void add_impulse(Motion<T> &motion, const Texels<T> &impulse, const Body<T> &body, T sign, int32_t torque)
{
	motion.v.x() = motion.v.x() + (sign * impulse.fact(0, IMPULSE_X)) * body.inverse_mass;
	motion.v.y() = motion.v.y() + (sign * impulse.fact(0, IMPULSE_Y)) * body.inverse_mass;
	motion.velocity = motion.velocity + impulse.fact(0, torque) * body.inverse_inertia;
}

/* To the first hit, which is then over [2.3]. */
template <typename T> static void collision(const Job<T> &job)
{
	const FirstHit<T> hit(job.texels(STATE_COUNT));
	if (!hit.in_step())
		return;
	const Texels<T> impulse = job.texels(STATE_COUNT + 1);
	const Next<T> next{job.texels(STATE_COUNT + 2), job.texels(STATE_COUNT + 3)};
	move_bodies(job, next, hit, hit.time, [&](Motion<T> &motion, const State<T> &state, int32_t i) {
		if (i == hit.row)
			add_impulse(motion, impulse, state.body(i), T(1), IMPULSE_TORQUE_A);
		else if (i == hit.column)
			add_impulse(motion, impulse, state.body(i), T(-1), IMPULSE_TORQUE_B);
	});
}

extern const Stage forward_collision;
const Stage forward_collision{"forward", "collision", {{STAGE_COLLISION, collision<float>, collision<double>}}, nullptr, nullptr};

}
