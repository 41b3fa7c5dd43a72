#include "cpu/forward.hpp"

namespace carom::cpu {

/* To the end of the step, where nothing is hit in it [2.3]. */
template <typename T> static void no_collision(const Job<T> &job)
{
	const FirstHit<T> hit(job.texels(STATE_COUNT));
	if (!(hit.time > 1))
		return;
	const Next<T> next{job.texels(STATE_COUNT + 1), job.texels(STATE_COUNT + 2)};
	move_bodies(job, next, hit, T(1), [](Motion<T> &, const State<T> &, int32_t) {});
}

extern const Stage forward_no_collision;
const Stage forward_no_collision{"forward", "no_collision", {{STAGE_NO_COLLISION, no_collision<float>, no_collision<double>}}, nullptr, nullptr};

}
