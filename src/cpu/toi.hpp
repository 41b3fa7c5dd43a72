/* What the alternatives of the slot toi share: a pair, its texel of HitTimes, and the search for the pairs to look at. */
#ifndef CAROM_CPU_TOI_HPP
#define CAROM_CPU_TOI_HPP

#include "cpu/contact.hpp"
#include "cpu/reduce.hpp"

#include <algorithm>

namespace carom::cpu {

/* A texel of HitTimes. */
template <typename T> struct HitTime {
	T min, max, done, hit;
};

template <typename T> HitTime<T> no_hit()
{
	return {0, 1, 1, NO_HIT};
}

template <typename T> HitTime<T> hit_at(T t)
{
	return {t, t, 1, t};
}

template <typename T> HitTime<T> pause_at(T t)
{
	return {t, t, 0, t};
}

template <typename T> struct Pair {
	const Convex<T> &a, &b; /* the row's body and the column's */
	InsideTest<T> inside;
	T slop, stillness;

	Pair(const Convex<T> &row, const Convex<T> &column, InsideTest<T> inside_test)
		: a(row), b(column), inside(inside_test), slop(pair_slop(row, column)), stillness(pair_stillness(row, column))
	{
	}

	bool are_circles() const { return a.is_circle() && b.is_circle(); }
	bool approaches(const Pose<T> &pose, const Axis<T> &axis) const
	{
		return contact_at(a, b, pose, axis, slop).approaches(stillness);
	}
};

/* Calls visit(row, column, now) for every pair of a tile that overlaps now, or did a step before. */
template <typename Visit> void visit_tile(const Bytes &overlap, const Bytes &before, int32_t row, int32_t column, int32_t last, int state, Visit visit)
{
	for (int32_t i = row * TILE; i < last; i++) {
		for (int32_t j = column * TILE; j < (column + 1) * TILE; j++) {
			const bool now = state & TILES_NOW && overlap.row(i)[j], old = state & TILES_BEFORE && before.row(i)[j];
			if (now || old)
				visit(i, j, now);
		}
	}
}

/* The pairs to look at, tile by tile: `find(row, column, now)` gives the pair's texel of HitTimes. */
template <typename T, typename Find> void visit_pairs(const Job<T> &job, const Texels<T> &hit_times, const Texels<T> &tile_hits, Find find)
{
	const Bytes tiles = job.bytes(STATE_COUNT + 2), overlap = job.bytes(STATE_COUNT + 3), before = job.bytes(STATE_COUNT + 4);
	job.pool.run(job.domain[1], 4, [&](int32_t begin, int32_t end) {
		for (int32_t r = begin; r < end; r++) {
			for (int32_t c = 0; c <= r; c++) {
				const int state = tiles.row(r)[4 * c];
				if (!(state & (TILES_NOW | TILES_BEFORE)))
					continue;
				Candidate<T> first{NO_HIT, 0, 0, 1};
				visit_tile(overlap, before, r, c, std::min((r + 1) * TILE, job.domain[2]), state, [&](int32_t i, int32_t j, bool now) {
					const HitTime<T> hit = find(i, j, now);
					hit_times.set(j, i, hit.min, hit.max, hit.done, hit.hit);
					first = first_of(first, Candidate<T>{hit.hit, static_cast<T>(i), static_cast<T>(j), hit.done});
				});
				tile_hits.set(c, r, first.hit, first.row, first.column, first.done);
			}
		}
	});
}

/* The slot's first kernel: `find(pair)` gives the hit time of a pair whose boxes overlap and of which one body moves. */
template <typename T, typename Find> void find_hits(const Job<T> &job, Find find)
{
	const Shapes<T> shapes = shapes_before(job);
	visit_pairs(job, job.texels(STATE_COUNT + 5), job.texels(STATE_COUNT + 6), [&](int32_t row, int32_t column, bool now) {
		if (!now || (shapes.is_static(row) && shapes.is_static(column)))
			return no_hit<T>();
		const Convex<T> a = shapes.convex(row), b = shapes.convex(column);
		return find(Pair<T>(a, b, job.inside));
	});
}

}

#endif
