#include "cpu/mender.hpp"
#include "cpu/touching.hpp"

#include <algorithm>
#include <vector>

namespace carom::cpu {

constexpr int32_t chunk = 1024; /* slots */

template <typename T> static Slot<T> *slots_of(const Job<T> &job, int index)
{
	return reinterpret_cast<Slot<T> *>(job.records(index));
}

/* How far bodies go in the time that lists are to last, from a sample of them. */
template <typename T> static void pace(const Job<T> &job)
{
	const Slot<T> *slots = slots_of(job, 1);
	int32_t *status = job.list(2);
	const int32_t count = job.domain[2], step = count / 256 + 1;
	const float bustle = static_cast<float>(status[STATUS_BUSTLE]) / static_cast<float>(count);
	const float step_time = static_cast<float>(job.texels(0).fact(UNIFORMS_WORLD, WORLD_TIME_STEP));
	const float window = step_time * std::max(most_steps / (1 + hit_part * bustle), least_steps);
	float squares = 0, roots = 0, radius = 0, many = 0;
	for (int32_t s = 0; s < count; s += step) {
		if (!slots[s].is_dynamic())
			continue;
		const float vx = static_cast<float>(slots[s].place[LINEAR_VX]), vy = static_cast<float>(slots[s].place[LINEAR_VY]);
		const float speed = std::hypot(vx, vy) + static_cast<float>(std::hypot(slots[s].push[PUSH_X], slots[s].push[PUSH_Y])) * window;
		squares += speed * speed;
		roots += std::sqrt(speed);
		radius += static_cast<float>(slots[s].radius());
		many++;
	}
	many = std::max(many, 1.0f);
	radius /= many;
	const float mean = std::sqrt(squares / many) * window * speed_margin;
	const float typical = typical_part * (roots / many) * (roots / many) * window * speed_margin;
	const float way = std::min(mean, std::max(typical, radius)); /* those at rest need not know all that a few fast ones could hit */
	const float distance = std::max(pace_part * way, static_cast<float>(job.domain[3]) * 0.1f * radius);
	const float side = 1.01f * (radius + std::max(distance, cell_part * way));
	for (int field : {STATUS_STALE, STATUS_UNDER_WAY, STATUS_LEFT, STATUS_ACTIVE, STATUS_NEIGHBOURS, STATUS_NODES, STATUS_LEVELS, STATUS_PLACED,
			 STATUS_HITS, STATUS_RULED, STATUS_HELD, STATUS_FOUND, STATUS_AGE, STATUS_MENDED, STATUS_MOVERS, STATUS_TOUCHING, STATUS_BORNE,
			 STATUS_PASS, STATUS_THRONGS, STATUS_FOURS})
		status[field] = 0;
	status[STATUS_SMALL] = status[STATUS_KEPT] > status[STATUS_KEPT_ROOM];
	status[STATUS_EXTRA] = status[STATUS_CAPACITY];
	status[STATUS_BUILDS]++;
	status[STATUS_MADE]++;
	status[STATUS_PACE] = as_bits(distance);
	status[STATUS_BRIEF] = as_bits(least_steps * step_time);
	status[STATUS_CELL] = as_bits(side > 0 && side < 1e30f ? side : 1.0f);
	status[STATUS_WINDOW] = as_bits(window);
}

template <typename T> static void reach(const Job<T> &job)
{
	const Corner<T> *corners = reinterpret_cast<const Corner<T> *>(job.records(0));
	const Slot<T> *slots = slots_of(job, 1);
	const int32_t *need = job.list(2);
	int32_t *status = job.list(3), *cells = job.list(5);
	Span *spans = reinterpret_cast<Span *>(job.list(4));
	const Grid grid{as_float(status[STATUS_CELL]), job.domain[2], job.domain[3]};
	const ReachRules<T> rules(status);
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) {
		int32_t levels = 0;
		for (int32_t s = begin; s < end; s++) {
			const Box<T> box = reach_box(slots[s], T(as_float(need[s])), rules, corners);
			const int32_t level = grid.level_of(box);
			const Cell at = grid.cell_at(box.middle_x(), box.middle_y(), level);
			spans[s].found = grid.row_of(at.y, level) + grid.column_of(at.x);
			fetch_add(&cells[CELL_WIDTH * spans[s].found + CELL_COUNT], 1);
			levels |= 1 << level;
		}
		__atomic_fetch_or(&status[STATUS_LEVELS], levels, __ATOMIC_RELAXED);
	});
}

template <typename T> static void cells(const Job<T> &job)
{
	int32_t *status = job.list(0), *all = job.list(1);
	const Grid grid{as_float(status[STATUS_CELL]), job.domain[2], job.domain[3]};
	for (int32_t level = 0; status[STATUS_LEVELS] >> level; level++) {
		if (!(status[STATUS_LEVELS] & (1 << level)))
			continue;
		job.pool.run(grid.rows_of(level), 16, [&](int32_t begin, int32_t end) {
			int32_t *first = all + static_cast<ptrdiff_t>(CELL_WIDTH) * grid.row_of(begin, level), sum = 0;
			const int32_t many = (end - begin) * grid.columns;
			for (int32_t i = 0; i < many; i++)
				sum += first[CELL_WIDTH * i + CELL_COUNT];
			int32_t next = fetch_add(&status[STATUS_PLACED], sum);
			for (int32_t i = 0; i < many; i++) {
				int32_t *cell = first + CELL_WIDTH * i;
				cell[CELL_START] = cell[CELL_END] = next;
				next += cell[CELL_COUNT];
				cell[CELL_COUNT] = 0;
			}
		});
	}
}

template <typename T> static void sort(const Job<T> &job)
{
	const Corner<T> *corners = reinterpret_cast<const Corner<T> *>(job.records(0));
	const Slot<T> *slots = slots_of(job, 1);
	Slot<T> *to = slots_of(job, 6);
	Box<T> *boxes = reinterpret_cast<Box<T> *>(job.records(8));
	Member *members = reinterpret_cast<Member *>(job.list(9));
	const Span *spans = reinterpret_cast<const Span *>(job.list(4));
	const int32_t *need = job.list(2), *status = job.list(3);
	int32_t *all = job.list(5), *new_need = job.list(7), *owners = job.list(10), *parents = job.list(11), *new_places = job.list(12);
	const ReachRules<T> rules(status);
	const bool forget = status[STATUS_COMMIT] != 0;
	for (int32_t id = job.domain[0]; id < status[STATUS_NUMBERS]; id++)
		members[id].reset();
	const auto move = [&](int32_t s, int32_t place) {
		to[place] = slots[s];
		boxes[place] = reach_box(slots[s], T(as_float(need[s])), rules, corners);
		new_need[place] = forget ? 0 : need[s];
		members[place].reset();
		owners[place] = -1;
		parents[place] = place;
		new_places[slots[s].body()] = place;
	};
	/* Some at a time get their places before all that is written there: whoever counts for all threads waits until what it wrote is in its cache. */
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) {
		int32_t taken[32];
		for (int32_t s = begin, count; s < end; s += count) {
			count = std::min<int32_t>(end - s, std::size(taken));
			for (int32_t k = 0; k < count; k++)
				taken[k] = fetch_add(&all[CELL_WIDTH * spans[s + k].found + CELL_END], 1);
			for (int32_t k = 0; k < count; k++)
				move(s + k, taken[k]);
		}
	});
}

/* Slots that grow in number. */
class Finds
{
public:
	void clear() { count = 0; }
	/* From an end on there is room for more, and eight besides; where it moves, what lies before goes along. */
	int32_t *room(int32_t *end, int32_t more)
	{
		const size_t kept = static_cast<size_t>(end - slots.data()), needed = kept + static_cast<size_t>(more + eight);
		if (slots.size() < needed)
			slots.resize(2 * needed);
		return slots.data() + kept;
	}
	void keep(const int32_t *end) { count = static_cast<size_t>(end - slots.data()); }
	/* In eights, for there are few: what is too much is not kept. */
	void add(const Finds &other)
	{
		int32_t *to = room(end(), other.size());
		for (int32_t k = 0; k < other.size(); k += eight)
			std::copy_n(other.begin() + k, eight, to + k);
		keep(to + other.size());
	}
	int32_t size() const { return static_cast<int32_t>(count); }
	const int32_t *begin() const { return slots.data(); }
	int32_t *end() { return slots.data() + count; }

private:
	std::vector<int32_t> slots;
	size_t count = 0;
};

/* Where so many more begin in Neighbours; -1 if there is no room for them. */
static int32_t take_room(int32_t *status, int32_t many)
{
	const int32_t throngs = many / THRONG;
	const bool is_counted = throngs == 0 || fetch_add(&status[STATUS_THRONGS], throngs) <= THRONGS_MOST - throngs;
	const int32_t start = is_counted ? fetch_add(&status[STATUS_NEIGHBOURS], many) : 0;
	if (is_counted && start <= status[STATUS_ROOM] - many)
		return start;
	__atomic_store_n(&status[STATUS_SMALL], 1, __ATOMIC_RELAXED);
	return -1;
}

/* The search for neighbours of a few slots; what they find lies here until it is known how much it is. */
template <typename T> class Search
{
public:
	explicit Search(const Job<T> &job)
		: slots(slots_of(job, 0)), filters(job.list(1)), boxes(reinterpret_cast<Box<T> *>(job.records(2))), status(job.list(3)),
		  spans(reinterpret_cast<Span *>(job.list(5))), neighbours(job.list(6)), nodes(job.list(7)), members(reinterpret_cast<Member *>(job.list(8))),
		  extra(job.list(9)), grid{as_float(status[STATUS_CELL]), job.domain[2], job.domain[3]}, cells{job.list(4), grid},
		  levels(status[STATUS_LEVELS]), count(job.domain[0])
	{
	}

	void run(int32_t begin, int32_t end)
	{
		static thread_local Finds found, behind;
		found.clear();
		for (int32_t s = begin; s < end; s++) {
			spans[s].start = found.size();
			behind.clear();
			if (found.size() / THRONG + __atomic_load_n(&status[STATUS_THRONGS], __ATOMIC_RELAXED) <= THRONGS_MOST)
				search(s, found, behind);
			spans[s].half = found.size();
			found.add(behind);
			spans[s].end = found.size();
		}
		const int32_t start = take_room(status, found.size());
		const bool fits = start >= 0;
		std::fill(extra + begin, extra + end, -1);
		if (fits)
			std::copy_n(found.begin(), found.size(), neighbours + start);
		for (int32_t s = begin; s < end; s++) {
			Span &span = spans[s];
			span = fits ? Span{start + span.start, start + span.half, start + span.end, FOUND_NONE} : Span{0, 0, 0, FOUND_NONE};
		}
	}

private:
	void search(int32_t s, Finds &ahead, Finds &behind)
	{
		const Box<T> box = boxes[s];
		const int32_t own = grid.level_of(box);
		for (int32_t level = std::max(own - levels_below, 0); levels >> level; level++) {
			if (!(levels & (1 << level)) || (level > own && level <= own + levels_below))
				continue;
			if (level == own) {
				search_alike(s, box, own, ahead, behind);
				continue;
			}
			cells.each(box, level, [&](int32_t first, int32_t end) {
				for (int32_t other = first; other < end; other++)
					if (box.touches(boxes[other]) && slots[s].meets(slots[other], filters))
						meet(s, other, ahead);
			});
		}
	}

	/* On the slot's own level, where most are. */
	void search_alike(int32_t s, const Box<T> &box, int32_t level, Finds &ahead, Finds &behind) const
	{
		const bool meets_all = slots[s].is_dynamic() && !filters.any;
		int32_t *after = ahead.end(), *before = behind.end();
		cells.each(box, level, [&](int32_t first, int32_t end) {
			after = ahead.room(after, end - first);
			before = behind.room(before, end - first);
			for (; first < end; first += eight) {
				uint32_t bits = touching(box, first) & ((1U << std::min(end - first, eight)) - 1);
				if (!meets_all)
					bits = meeting(s, first, bits);
				const int32_t own = std::min(std::max(s - first, -1), eight); /* its place among the eight */
				before = places.put(bits & ((1U << std::max(own, 0)) - 1), first, before);
				after = places.put(bits & (~0U << (own + 1)), first, after);
			}
		});
		ahead.keep(after);
		behind.keep(before);
	}

	uint32_t touching(const Box<T> &box, int32_t first) const
	{
		if (first + eight <= count)
			return cpu::touching(box, boxes + first);
		Box<T> last[eight] = {};
		std::copy(boxes + first, boxes + count, last);
		return cpu::touching(box, last);
	}

	/* Of the eight from `first` on that have a bit, those whose bodies may hit this slot's. */
	uint32_t meeting(int32_t s, int32_t first, uint32_t bits) const
	{
		uint32_t all = bits;
		for (; bits; bits &= bits - 1) {
			const int32_t k = __builtin_ctz(bits);
			if (!slots[s].meets(slots[first + k], filters))
				all &= ~(1U << k);
		}
		return all;
	}

	/* Of two bodies of different levels one looks, and tells the other. */
	void meet(int32_t s, int32_t other, Finds &ahead)
	{
		int32_t *end = ahead.room(ahead.end(), 1);
		*end = other;
		ahead.keep(end + 1);
		const bool too_many = __atomic_load_n(&status[STATUS_NODES], __ATOMIC_RELAXED) > NODES_MOST;
		const int32_t node = too_many ? -1 : fetch_add(&status[STATUS_NODES], 1);
		if (too_many || node >= status[STATUS_NODE_ROOM]) {
			__atomic_store_n(&status[STATUS_SMALL], 1, __ATOMIC_RELAXED);
			return;
		}
		nodes[NODE_WIDTH * node + NODE_SLOT] = s;
		nodes[NODE_WIDTH * node + NODE_LINK] = __atomic_exchange_n(&members[other].head, node, __ATOMIC_RELAXED);
	}

	const Slot<T> *const slots;
	const Filters filters;
	const Box<T> *const boxes;
	int32_t *const status;
	Span *const spans;
	int32_t *const neighbours, *const nodes;
	Member *const members;
	int32_t *const extra;
	const Grid grid;
	const CellList<T> cells;
	const int32_t levels, count;
};

template <typename T> static void search_some(const Job<T> &job, int32_t begin, int32_t end)
{
	Search<T>(job).run(begin, end);
}

#if defined(__x86_64__)
/* The same in fewer instructions, where the processor has them. */
[[gnu::target("avx2"), gnu::flatten]] static void search_some_avx2(const Job<float> &job, int32_t begin, int32_t end)
{
	search_some(job, begin, end);
}

static auto best_search(float)
{
	return __builtin_cpu_supports("avx2") ? search_some_avx2 : search_some<float>;
}
#endif

template <typename T> static auto best_search(T)
{
	return search_some<T>;
}

template <typename T> static void near(const Job<T> &job)
{
	const auto search = best_search(T());
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) { search(job, begin, end); });
}

template <typename T> static void gather(const Job<T> &job)
{
	int32_t *status = job.list(0), *neighbours = job.list(2);
	Span *spans = reinterpret_cast<Span *>(job.list(1));
	const int32_t *nodes = job.list(3);
	Member *members = reinterpret_cast<Member *>(job.list(4));
	job.pool.run(job.domain[0], 4096, [&](int32_t begin, int32_t end) {
		for (int32_t s = begin; s < end; s++) {
			int32_t more = 0, own = spans[s].end - spans[s].start;
			if (members[s].head < 0)
				continue;
			for (int32_t k = members[s].head; k >= 0; k = nodes[NODE_WIDTH * k + NODE_LINK])
				more++;
			int32_t to = take_room(status, own + more);
			if (to >= 0) {
				std::copy(neighbours + spans[s].start, neighbours + spans[s].end, neighbours + to);
				spans[s] = {to, to + spans[s].half - spans[s].start, to + own + more, FOUND_NONE};
				to += own;
				for (int32_t k = members[s].head; k >= 0; k = nodes[NODE_WIDTH * k + NODE_LINK])
					neighbours[to++] = nodes[NODE_WIDTH * k + NODE_SLOT];
			}
			members[s].head = -1;
		}
	});
}

template <typename T> static void mend(const Job<T> &job)
{
	const Mender<T> mender(job);
	const int32_t *status = job.list(3), *movers = job.list(7), first = status[STATUS_MENDED];
	if (!lists_are_good(status))
		return;
	job.pool.run(status[STATUS_MOVERS] - first, 16, [&](int32_t begin, int32_t end) {
		for (int32_t k = first + begin; k < first + end; k++)
			mender.mend(movers[k]);
	});
}

extern const Stage neighbours_grid;
const Stage neighbours_grid{"neighbours", "grid",
	{{STAGE_PACE, pace<float>, pace<double>}, {STAGE_REACH, reach<float>, reach<double>}, {STAGE_CELLS, cells<float>, cells<double>},
		{STAGE_SORT, sort<float>, sort<double>}, {STAGE_NEAR, near<float>, near<double>}, {STAGE_GATHER, gather<float>, gather<double>},
		{STAGE_MEND, mend<float>, mend<double>}},
	nullptr, nullptr};

}
