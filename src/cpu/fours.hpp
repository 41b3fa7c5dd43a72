/* Room for the points of bodies, in Contacts and in Grips, and for the forces that these leave, in Warm: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_FOURS_HPP
#define CAROM_CPU_FOURS_HPP

#include "cpu/rests.hpp"

#include <vector>

namespace carom::cpu {

/* How many more fours a slot needs for so many points; 0 if it has enough. */
inline int32_t fours_wanted(const Touching &touching, int32_t points, const int32_t *status)
{
	const int32_t fours = (points + lane_count - 1) / lane_count, own = touching.made == status[STATUS_MADE] ? touching.room : 0;
	return fours <= own ? 0 : own > 0 ? fours + fours / 2 : fours;
}

/* Room for the points of bodies that lie side by side, side by side: what two threads change is not to be in one line of a cache. Where there is none they have no points. */
inline void take_fours(const std::vector<RestingBody> &bodies, Touching *touching, int32_t *status)
{
	int32_t wanted = 0;
	for (const RestingBody &body : bodies)
		wanted += fours_wanted(touching[body.s], body.points, status);
	int32_t first = wanted > 0 ? fetch_add(&status[STATUS_FOURS], wanted) : 0;
	const bool has_room = first <= status[STATUS_FOURS_ROOM] - wanted;
	if (!has_room)
		__atomic_store_n(&status[STATUS_SMALL], 1, __ATOMIC_RELAXED);
	for (const RestingBody &body : bodies) {
		Touching &own = touching[body.s];
		const int32_t room = fours_wanted(own, body.points, status);
		if (room > 0 && has_room)
			own.first = first, own.room = room, own.made = status[STATUS_MADE];
		own.count = room > 0 && !has_room ? 0 : body.points;
		const JoinedCount joined = own.count > 0 ? body.joined : JoinedCount{};
		own.joined = joined.all, own.firm = joined.firm, own.rows = joined.rows;
		first += room;
	}
}

/* Room for the forces that a slot's contacts are going to leave. */
template <typename T> void take_warm(const Rests<T> &rests, const Warm<T> &warm, int32_t s)
{
	int32_t contacts = 0;
	rests.each_point(s, [&](const Points<T> &, const Grips<T> &, int32_t, Partner, int32_t point) { contacts += point == 0; });
	if (!warm.take(rests.slots[s].body(), contacts))
		__atomic_store_n(&rests.status[STATUS_SMALL], 1, __ATOMIC_RELAXED);
}

}

#endif
