/* The forces that the last steps ended with, of the step contacts: CONTRACT.md, "contacts". */
#ifndef CAROM_CPU_WARM_HPP
#define CAROM_CPU_WARM_HPP

#include "cpu/forest.hpp"

#include <algorithm>
#include <cstdint>

namespace carom::cpu {

/* Of a contact, in N. */
template <typename T> struct WarmForces {
	T normal[2] = {0, 0}, friction[2] = {0, 0};
};

/* Where a body's contacts are. */
struct WarmSpan {
	int32_t start, count, room;
};

static_assert(sizeof(WarmSpan) == WARM_SPAN_WIDTH * sizeof(int32_t), "spans");

/* Of all bodies, by index. */
template <typename T> class Warm
{
public:
	Warm(T *all_records, int32_t *all_spans, bool bodies_rub)
		: records(all_records), head(all_spans), spans(reinterpret_cast<WarmSpan *>(all_spans) + 1), width(4 * WARM_WIDTH(bodies_rub)),
		  rubs(bodies_rub)
	{
	}

	bool has_any(int32_t body) const { return spans[body].count > 0; }

	/* Sees to it that there is room for so many contacts of a body; those that it has go along. False: there is none. */
	bool take(int32_t body, int32_t contacts) const
	{
		WarmSpan &span = spans[body];
		if (contacts <= span.room)
			return true;
		const int32_t more = contacts + contacts / 2, start = fetch_add(&head[WARM_TAKEN], more);
		if (start > head[WARM_ROOM] - more)
			return false;
		std::copy_n(at(span.start), width * static_cast<size_t>(span.count), at(start));
		span.start = start;
		span.room = more;
		return true;
	}

	/* Of the next contact with that partner; zeros if there was none. It is looked for from contact k on, for it is asked for all in order. */
	WarmForces<T> of(int32_t body, int32_t partner, int32_t &k) const
	{
		WarmForces<T> forces;
		const WarmSpan &span = spans[body];
		const auto key = [&] { return static_cast<int32_t>(at(span.start + k)[WARM_PARTNER]); };
		while (k < span.count && key() < partner)
			k++;
		if (k == span.count || key() != partner)
			return forces;
		const T *record = at(span.start + k++);
		for (int32_t i = 0; i < 2; i++) {
			forces.normal[i] = record[WARM_FORCES + i];
			forces.friction[i] = rubs ? record[4 + WARM_FRICTION + i] : T(0);
		}
		return forces;
	}

	/* Contact k, with that partner, of no forces yet. */
	void begin(int32_t body, int32_t k, int32_t partner) const
	{
		at(spans[body].start + k)[WARM_PARTNER] = static_cast<T>(partner);
		for (int32_t point = 0; point < 2; point++)
			keep(body, k, point, 0, 0);
	}

	void keep(int32_t body, int32_t k, int32_t point, T normal, T friction) const
	{
		T *record = at(spans[body].start + k);
		record[WARM_FORCES + point] = normal;
		if (rubs)
			record[4 + WARM_FRICTION + point] = friction;
	}

	void keep_count(int32_t body, int32_t count) const { spans[body].count = count; }

private:
	T *at(int32_t contact) const { return records + width * static_cast<size_t>(contact); }

	T *const records;
	int32_t *const head; /* see WARM_TAKEN */
	WarmSpan *const spans;
	const size_t width;
	const bool rubs;
};

}

#endif
