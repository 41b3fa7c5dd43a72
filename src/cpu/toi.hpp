/* What the alternatives of the slot toi share: a pair, its texel of HitTimes, and the search for the pairs to look at. */
#ifndef CAROM_CPU_TOI_HPP
#define CAROM_CPU_TOI_HPP

#include "cpu/candidate.hpp"
#include "cpu/contact.hpp"

#include <algorithm>
#include <cstring>

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
	T until; /* of the step: hits after it need not be found */

	Pair(const Convex<T> &row, const Convex<T> &column, InsideTest<T> inside_test, T end = 1)
		: a(row), b(column), inside(inside_test), slop(pair_slop(row, column)), stillness(pair_stillness(row, column)), until(end)
	{
	}

	bool are_circles() const { return a.is_circle() && b.is_circle(); }
	bool is_hit(const Pose<T> &pose, const Axis<T> &axis) const
	{
		const Contact<T> contact = contact_at(a, b, pose, axis, slop);
		if (!contact.is_below(Threshold<T>(axis.gap, slop, stillness).rate))
			return false;
		return way_is_hit(a, b, pose, axis, corner_way(a, b, pose, axis, contact, slop), slop, stillness, T(0));
	}
};

/* Where the slot's textures are in the list, after STATE, vertices and clock. */
enum : int { FROM_TILES = STATE_COUNT + 2, FROM_OVERLAP, FROM_OVERLAP_BEFORE, TOI_COUNT };

static_assert(TILE == sizeof(uint64_t), "a row of a tile is looked at as one number");

inline bool are_zero(const uint8_t *bytes)
{
	uint64_t all;
	std::memcpy(&all, bytes, sizeof all);
	return all == 0;
}

/* Looks at the tiles: `find(row, column, now)` gives the texel of a pair that overlaps now or only did before. */
template <typename T, typename Find> class TileSearch
{
public:
	TileSearch(const Job<T> &job, const Texels<T> &to, const Find &find_hit)
		: tiles(job.bytes(FROM_TILES)), overlap(job.bytes(FROM_OVERLAP)), overlap_before(job.bytes(FROM_OVERLAP_BEFORE)), hit_times(to),
		  find(find_hit), count(job.domain[2])
	{
	}

	/* Writes HitTimes; the first hit of what it writes goes to `first`. False: there was nothing to write. */
	bool search(int32_t c, int32_t r, Candidate<T> &first) const
	{
		static const uint8_t none[TILE] = {};
		const uint8_t tile = *tiles.texel(c, r);
		if (!(tile & (TILES_NOW | TILES_BEFORE)))
			return false;
		for (int32_t i = r * TILE; i < std::min((r + 1) * TILE, count); i++) {
			const uint8_t *before = tile & TILES_BEFORE ? overlap_before.row(i) + c * TILE : none;
			search_row(i, c * TILE, overlap.row(i) + c * TILE, before, first);
		}
		return true;
	}

private:
	void search_row(int32_t row, int32_t column, const uint8_t *now, const uint8_t *before, Candidate<T> &first) const
	{
		if (are_zero(now) && are_zero(before))
			return;
		for (int32_t k = 0; k < TILE; k++) {
			if (!now[k] && !before[k])
				continue;
			const HitTime<T> hit = find(row, column + k, now[k] != 0);
			hit_times.set(column + k, row, hit.min, hit.max, hit.done, hit.hit);
			first = first_of(first, {hit.hit, static_cast<T>(row), static_cast<T>(column + k), hit.done});
		}
	}

	const Bytes tiles, overlap, overlap_before;
	const Texels<T> hit_times;
	const Find &find;
	const int32_t count;
};

/* Writes HitTimes and TileHits, which are the textures from `output` on. */
template <typename T, typename Find> void search_tiles(const Job<T> &job, int output, const Find &find)
{
	const TileSearch<T, Find> tiles(job, job.texels(output), find);
	const Texels<T> tile_hits = job.texels(output + 1);
	job.pool.run(job.domain[1], 2, [&](int32_t begin, int32_t end) {
		for (int32_t r = begin; r < end; r++) {
			for (int32_t c = 0; c <= r; c++) {
				Candidate<T> first = no_candidate<T>;
				if (tiles.search(c, r, first))
					put_candidate(tile_hits, c, r, first);
			}
		}
	});
}

/* The slot's first kernel: `find(pair)` gives the hit time of a pair whose boxes overlap and of which one body moves. */
template <typename T, typename Find> void find_hits(const Job<T> &job, Find find)
{
	const Shapes<T> shapes = shapes_before(job);
	search_tiles(job, TOI_COUNT, [&](int32_t row, int32_t column, bool now) {
		if (!now || (!shapes.is_dynamic(row) && !shapes.is_dynamic(column)))
			return no_hit<T>();
		const HeldConvex<T> a = shapes.convex(row), b = shapes.convex(column);
		return find(Pair<T>(a, b, job.inside));
	});
}

}

#endif
