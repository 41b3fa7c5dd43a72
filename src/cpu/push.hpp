/* Impulses at one point of two bodies: CONTRACT.md, "The step contacts", Shocks and Tugs. */
#ifndef CAROM_CPU_PUSH_HPP
#define CAROM_CPU_PUSH_HPP

#include "cpu/slots.hpp"

namespace carom::cpu {

/* A body that impulses push at one moment; what is held stands. */
template <typename T> struct Pushed {
	T vx, vy, w, inverse_mass, inverse_inertia;

	Pushed() : vx(0), vy(0), w(0), inverse_mass(0), inverse_inertia(0) {}
	Pushed(const Slot<T> &slot, const Trajectory<T> &way) : Pushed()
	{
		if (way.held > 0)
			return;
		vx = way.place[LINEAR_VX], vy = way.place[LINEAR_VY], w = way.velocity;
		inverse_mass = slot.mass[MASS_INVERSE], inverse_inertia = slot.mass[MASS_INVERSE_INERTIA];
	}

	T speed(const Vec<T> &n, T arm) const { return inner(n, Vec<T>(vx, vy)) + w * arm; }
	/* Twice its kinetic energy. */
	T energy() const
	{
		const T straight = inverse_mass > 0 ? (vx * vx + vy * vy) / inverse_mass : T(0);
		return inverse_inertia > 0 ? straight + (w * w) / inverse_inertia : straight;
	}

	T gives(T arm) const { return inverse_mass + inverse_inertia * (arm * arm); }

	void take(const Vec<T> &impulse, T torque)
	{
		vx += inverse_mass * impulse.x();
		vy += inverse_mass * impulse.y();
		w += inverse_inertia * torque;
	}
};

/* How fast a body on that way moves along n; what is held stands. */
template <typename T> T speed_on(const Trajectory<T> &way, const Vec<T> &n, T arm)
{
	return way.held > 0 ? T(0) : inner(n, Vec<T>(way.place[LINEAR_VX], way.place[LINEAR_VY])) + way.velocity * arm;
}

/* Where a body is pushed, and its partner the other way. */
template <typename T> struct PushPoint {
	Vec<T> n;                   /* towards the body */
	T arm, other_arm;           /* of the two, along n, */
	T grip_arm, other_grip_arm; /* and along the surfaces */
	T friction, part;           /* part: how fast the point is to part, */
	T coming, slipping;         /* how fast a partner that is not pushed moves along n, and along the surfaces */
	T impulse, rub;             /* on the body */

	Vec<T> along() const { return {-n.y(), n.x()}; }

	/* How fast the body parts from the partner; null where that is not pushed. */
	T parting(const Pushed<T> &body, const Pushed<T> *other) const { return body.speed(n, arm) - (other ? other->speed(n, other_arm) : coming); }

	T gives(const Pushed<T> &body, const Pushed<T> *other, T own_arm, T others_arm) const
	{
		return body.gives(own_arm) + (other ? other->gives(others_arm) : T(0));
	}

	/* Lets the point part, which does so at that rate, as it is to, or goes `farther` times as far; only what `pulls` pulls. False if that is a change of less than `least`. */
	bool push(Pushed<T> &body, Pushed<T> *other, T rate, T farther, T least, bool pulls)
	{
		const T all = gives(body, other, arm, other_arm);
		if (!(all > 0))
			return false;
		const T wanted = impulse + farther * ((part - rate) / all), after = pulls ? wanted : larger(wanted, T(0)), more = after - impulse;
		if (!(std::abs(more) * all >= least))
			return false;
		impulse = after;
		act(body, other, more * n, more * arm, more * other_arm);
		if (!(friction > 0))
			return true;
		const Vec<T> way = along();
		const T slip = body.speed(way, grip_arm) - (other ? other->speed(way, other_grip_arm) : slipping), most = friction * impulse;
		const T rubbed = larger(smaller(rub - slip / gives(body, other, grip_arm, other_grip_arm), most), -most), change = rubbed - rub;
		rub = rubbed;
		act(body, other, change * way, change * grip_arm, change * other_grip_arm);
		return true;
	}

private:
	static void act(Pushed<T> &body, Pushed<T> *other, const Vec<T> &impulse, T torque, T other_torque)
	{
		body.take(impulse, torque);
		if (other)
			other->take(-impulse, -other_torque);
	}
};

}

#endif
