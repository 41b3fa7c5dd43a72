/* The rules of events for what would be hits without end: CONTRACT.md, "The step events", Answer. */
#ifndef CAROM_CPU_RULES_HPP
#define CAROM_CPU_RULES_HPP

#include "cpu/slots.hpp"

#include <algorithm>

namespace carom::cpu {

/* What is to be known of the parties' events before this one, in the step. */
template <typename T> struct Past {
	bool rapid;
	int32_t events;
	bool borne; /* by forces: the step contacts */
	bool shock; /* what is rapid again and again is one */

	/* The speed with which a crowd comes apart at least, `push` and `weight` as below. Where forces bear what rests only gravity may add to the speed of the approach. */
	T crowd_speed(T rate, T push, T weight, T stillness) const
	{
		const int32_t beyond = events - (borne ? CROWD_BORNE : CROWD);
		if (beyond <= 0)
			return 0;
		const T part = smaller(T(beyond) * T(borne ? CROWD_BORNE_PART : CROWD_PART), T(borne ? CROWD_BORNE_MOST : CROWD_MOST));
		const T bounded = borne ? smaller(push, larger(T(CROWD_BORNE_WEIGHTS) * weight, -rate)) : push;
		return larger(part * bounded, stillness * static_cast<T>(1 << std::min(beyond / CROWD_DOUBLING, CROWD_DOUBLINGS)));
	}
};

/* What is rapid again and again is elastic, but where a push brings the bodies together only up to the speed that it makes in a step. `pull` is how they
 * are pushed along the normal, `push` how the one that is pushed most is, in whatever direction, `weight` what gravity makes of a speed in a step. How they slide is known already. */
template <typename T> void set_event_rules(Collision<T> &collision, T restitution, T pull, T most_push, T weight, T stillness, const Past<T> &past)
{
	const Contact<T> &c = collision.contact;
	const T rate = c.count > 1 ? smaller(c.rate[0], c.rate[1]) : c.rate[0];
	const T push = larger(most_push, weight);
	const bool lossy = loses_energy(restitution, collision.slide.friction);
	const T micro = lossy ? larger(-(T(MICRO) * pull), T(0)) : T(0);
	const bool fast = micro > 0 && -rate > micro * (1 / T(MICRO));
	collision.micro = lossy ? larger(micro, past.crowd_speed(rate, push, weight, stillness)) : T(0);
	collision.lossy = lossy;
	collision.slow = lossy && -rate < (past.borne ? T(CONTACT_FAST) * push : push);
	collision.event = true;
	collision.restitution = past.rapid && !past.shock && !fast ? T(1) : restitution;
	collision.ruled = collision.restitution != restitution || -rate < collision.micro;
}

/* What is stuck gets no more than the speeds with which it began. */
template <typename T> void limit(Trajectory<T> &way, const Trajectory<T> &begun)
{
	const Vec<T> v(way.place[LINEAR_VX], way.place[LINEAR_VY]), first(begun.place[LINEAR_VX], begun.place[LINEAR_VY]);
	if (inner(first, first) < inner(v, v)) {
		way.place[LINEAR_VX] = first.x();
		way.place[LINEAR_VY] = first.y();
	}
	if (std::abs(begun.velocity) < std::abs(way.velocity))
		way.velocity = begun.velocity;
}

/* What had too many events is held from now on, and so is what is stuck, which is slowed, too, unless it was in a fast hit. */
template <typename T> void hold_at_last(const Member &member, int32_t most_stuck, const Trajectory<T> &begun, Trajectory<T> &way)
{
	const bool is_stuck = member.stuck > most_stuck;
	if (is_stuck && !member.fast)
		limit(way, begun);
	if (member.events > HOLD_LIMIT || is_stuck)
		way.held = 1;
}

}

#endif
