/* Where a body may get while the lists of neighbours are good, and the cells where it is looked for. */
#ifndef CAROM_CPU_REACH_HPP
#define CAROM_CPU_REACH_HPP

#include "cpu/slots.hpp"

#include <algorithm>

namespace carom::cpu {

/* None of these changes a result: they decide how long lists last. */
constexpr float speed_margin = 1.25f; /* of a body's speed: hits may make it faster */
constexpr float pace_part = 1.3f;     /* of the mean speed, which counts for bodies that are slower */
constexpr float cell_part = 3.0f;     /* of the mean speed: few bodies are too fast for the cells of their size */
constexpr float typical_part = 1.8f;  /* of the mean of the speeds' roots, squared, which a few fast bodies change little */
constexpr float fast_part = 4.0f;     /* of the pace: bodies that get farther are not looked for so long, for they would know too many */
constexpr float drift_part = 1.34f;   /* of what the pace is for a step */
constexpr float hit_part = 4.0f;      /* of the hits a body and step: lists are made for 1 / (1 + that) of the time, for each hit looks through two */
constexpr float most_steps = 6.0f;    /* that lists are made for at most */
constexpr float least_steps = 1.5f;   /* and at least */
constexpr int32_t levels_below = 2;   /* a body looks for others so many levels below its own; those farther below look for it */

static_assert(least_steps > drift_part, "else lists are too old as soon as they are made");

inline int32_t fetch_add(int32_t *number, int32_t by)
{
	return __atomic_fetch_add(number, by, __ATOMIC_RELAXED);
}

inline bool lists_are_good(const int32_t *status)
{
	return !status[STATUS_STALE] && !status[STATUS_SMALL];
}

/* Has the step no slice after this one? */
inline bool is_last_slice(const int32_t *status)
{
	return status[STATUS_SLICE] + 1 >= status[STATUS_SLICES]
		|| __atomic_load_n(&status[STATUS_ACTIVE], __ATOMIC_RELAXED) == 0; /* clusters may get members meanwhile */
}

inline float as_float(int32_t bits)
{
	float number;
	std::memcpy(&number, &bits, sizeof number);
	return number;
}

inline int32_t as_bits(float number)
{
	int32_t bits;
	std::memcpy(&bits, &number, sizeof bits);
	return bits;
}

template <typename T> struct Box {
	T min_x, min_y, max_x, max_y;

	/* Without branches, and with one comparison: of single ones compilers make branches. */
	bool touches(const Box &other) const
	{
		const T x = std::max(min_x - other.max_x, other.min_x - max_x), y = std::max(min_y - other.max_y, other.min_y - max_y);
		return std::max(x, y) <= 0;
	}
	/* Touches no other. */
	static Box nowhere() { return {T(1e30), T(1e30), T(-1e30), T(-1e30)}; }
	T half() const { return T(0.5) * std::max(max_x - min_x, max_y - min_y); }
	T middle_x() const { return T(0.5) * (min_x + max_x); }
	T middle_y() const { return T(0.5) * (min_y + max_y); }
	/* the largest extent from a place */
	T half(const T *place) const { return std::max(std::max(place[0] - min_x, max_x - place[0]), std::max(place[1] - min_y, max_y - place[1])); }
};

struct Cell {
	int32_t x, y;
};

/* Each level of the grid is a torus. */
struct Grid {
	float side;
	int32_t columns, rows;

	float side_of(int32_t level) const { return side * static_cast<float>(1 << level); }
	/* The cells of a box's level are as large as its half at least; it is in that of its middle. */
	template <typename T> int32_t level_of(const Box<T> &box) const
	{
		const T half = box.half();
		int32_t level = 0;
		while (level < CELL_LEVELS - 1 && T(side_of(level)) < half)
			level++;
		return level;
	}
	template <typename T> static int32_t step(T x, T side)
	{
		const T cells = std::min(std::max(x / side, T(-1e9)), T(1e9));
		const int32_t whole = static_cast<int32_t>(cells); /* std::floor is a call, where processors may lack it */
		return whole - (static_cast<T>(whole) > cells);
	}
	template <typename T> Cell cell_at(T x, T y, int32_t level) const { return {step(x, T(side_of(level))), step(y, T(side_of(level)))}; }
	int32_t rows_of(int32_t level) const { return std::max(rows >> level, 1); }
	/* The first cell of a row. */
	int32_t row_of(int32_t y, int32_t level) const { return (CELL_FIRST_ROW(rows, level) + (y & (rows_of(level) - 1))) * columns; }
	int32_t column_of(int32_t x) const { return x & (columns - 1); }
};

/* The slots by their cells. */
template <typename T> struct CellList {
	const int32_t *cells;
	const Grid grid;

	/* All the slots in the cells of a level that a box of that level could touch, in a few runs. */
	template <typename Visit> void each(const Box<T> &box, int32_t level, Visit visit) const
	{
		const T side = T(grid.side_of(level));
		const Cell low = grid.cell_at(box.min_x - side, box.min_y - side, level), high = grid.cell_at(box.max_x + side, box.max_y + side, level);
		const int32_t last_x = std::min(high.x, low.x + grid.columns - 1),
					  last_y = std::min(high.y, low.y + grid.rows_of(level) - 1); /* once round */
		for (int32_t y = low.y; y <= last_y; y++) {
			const int32_t row = grid.row_of(y, level), first = row + grid.column_of(low.x), last = row + grid.column_of(last_x);
			if (last < first)
				visit(start(row), finish(last));
			visit(start(first), finish(last < first ? row + grid.columns - 1 : last));
		}
	}

private:
	int32_t start(int32_t cell) const { return cells[CELL_WIDTH * cell + CELL_START]; }
	int32_t finish(int32_t cell) const { return cells[CELL_WIDTH * cell + CELL_END]; }
};

template <typename T> struct ReachRules {
	T window, brief, pace;

	explicit ReachRules(const int32_t *status)
		: window(T(as_float(status[STATUS_WINDOW]))), brief(T(as_float(status[STATUS_BRIEF]))), pace(T(as_float(status[STATUS_PACE])))
	{
	}
};

template <typename T> Box<T> static_box(const Slot<T> &slot, const Corner<T> *corners)
{
	const T x = slot.place[LINEAR_X], y = slot.place[LINEAR_Y], pad = (std::abs(x) + std::abs(y) + slot.radius()) * T(4 * SLOP);
	const int32_t count = slot.vertices(), first = static_cast<int32_t>(slot.mass[MASS_FIRST]);
	const T grow = count == 1 ? pad + slot.radius() : pad;
	Box<T> box{x, y, x, y};
	const Vec<T> rotation = rotation_of(slot.turn[TURN_ANGLE]);
	for (int32_t k = 0; count > 1 && k < count; k++) {
		const Vec<T> v = turn(rotation, corners[first + k].vertex);
		box = {std::min(box.min_x, x + v.x()), std::min(box.min_y, y + v.y()), std::max(box.max_x, x + v.x()), std::max(box.max_y, y + v.y())};
	}
	return {box.min_x - grow, box.min_y - grow, box.max_x + grow, box.max_y + grow};
}

/* Of a body that moves. */
template <typename T> Box<T> reach_about(const Slot<T> &slot, T need, const ReachRules<T> &rules)
{
	const T x = slot.place[LINEAR_X], y = slot.place[LINEAR_Y];
	const Vec<T> v(slot.place[LINEAR_VX], slot.place[LINEAR_VY]), push(slot.push[PUSH_X], slot.push[PUSH_Y]);
	const T speed = norm(v) + norm(push) * rules.window, far = speed_margin * speed * rules.window;
	const T ahead = far > fast_part * rules.pace ? speed_margin * speed * rules.brief : far;
	T way = std::max(std::max(rules.pace, ahead), speed_margin * need);
	way += slot.radius() + (std::abs(x) + std::abs(y) + slot.radius()) * T(8 * SLOP);
	return {x - way, y - way, x + way, y + way};
}

/* Bodies that get other boxes, and new neighbours before the next step. */
template <typename T> class MoverList
{
public:
	MoverList(const Slot<T> *all, T *reach, int32_t *to_status, int32_t *wake, int32_t *to_movers, int32_t movers_room)
		: slots(all), boxes(reinterpret_cast<Box<T> *>(reach)), status(to_status), wakes(reinterpret_cast<Wake *>(wake)), movers(to_movers),
		  room(movers_room)
	{
	}

	/* Few do: apart, it is not in the way of the others. */
	[[gnu::noinline]] void move(int32_t s) const
	{
		const int32_t k = fetch_add(&status[STATUS_MOVERS], 1);
		if (k >= room) {
			__atomic_store_n(&status[STATUS_STALE], 1, __ATOMIC_RELAXED);
			return;
		}
		movers[k] = s;
		boxes[s] = reach_about(slots[s], T(0), ReachRules<T>(status));
		rouse(s);
	}

	/* A slot that is known by another number. */
	void rename(int32_t from, int32_t to) const { std::replace(movers, movers + std::min(status[STATUS_MOVERS], room), from, to); }

protected:
	void rouse(int32_t s) const { wakes[s] = {CHANGED_AFTER(status[STATUS_AGE]), status[STATUS_AGE]}; }

	const Slot<T> *const slots;
	Box<T> *const boxes;
	int32_t *const status;

private:
	Wake *const wakes;
	int32_t *const movers;
	const int32_t room;
};

/* Bodies that might get out of their boxes in the next step get others. */
template <typename T> class ReachKeeper : MoverList<T>
{
public:
	ReachKeeper(const Slot<T> *all, T *reach, int32_t *to_status, int32_t *wake, int32_t *to_movers, int32_t movers_room, const Texels<T> &uniforms)
		: MoverList<T>(all, reach, to_status, wake, to_movers, movers_room), step(uniforms.fact(UNIFORMS_WORLD, WORLD_TIME_STEP)),
		  common(drift_part * T(as_float(status[STATUS_PACE])) * (step / T(as_float(status[STATUS_WINDOW]))))
	{
	}
	using MoverList<T>::move;

	/* True if it got another. */
	[[gnu::always_inline]] bool keep(int32_t s) const
	{
		const bool leaves = may_leave(slots[s], boxes[s]);
		if (leaves)
			move(s);
		return leaves;
	}

	/* Which of the four from a slot on might leave their boxes; their places and pushes have the four of a component side by side. */
	template <typename Which>
	[[gnu::always_inline]] void may_leave(int32_t s, const Lanes<T> *place, const Lanes<T> *push, const Lanes<T> &radius, Which &which) const
	{
		Lanes<T> box[lane_count];
		std::memcpy(box, boxes + s, sizeof box);
		transpose<T>(box);
		const Lanes<T> zero{}, squares = place[LINEAR_VX] * place[LINEAR_VX] + place[LINEAR_VY] * place[LINEAR_VY];
		Lanes<T> speed;
		for (int32_t i = 0; i < lane_count; i++)
			speed[i] = std::sqrt(squares[i]);
		const Lanes<T> push_x = magnitude(push[PUSH_X]), push_y = magnitude(push[PUSH_Y]);
		const Lanes<T> far = T(speed_margin) * ((speed + (push_x + push_y) * step) * step), way = (far < common ? zero + common : far) + radius;
		which = (place[LINEAR_X] - way < box[0]) | (place[LINEAR_Y] - way < box[1]) | (place[LINEAR_X] + way > box[2])
			| (place[LINEAR_Y] + way > box[3]);
	}

	/* Of a body whose push is another one: all around looks at it again. */
	bool pushed(int32_t s) const
	{
		rouse(s);
		return keep(s);
	}

	/* How far the body may go in the next step. */
	[[gnu::always_inline]] T way_of(const Slot<T> &slot) const
	{
		const T speed = std::sqrt(slot.place[LINEAR_VX] * slot.place[LINEAR_VX] + slot.place[LINEAR_VY] * slot.place[LINEAR_VY])
			+ (std::abs(slot.push[PUSH_X]) + std::abs(slot.push[PUSH_Y])) * step;
		return speed * step;
	}

private:
	using MoverList<T>::boxes;
	using MoverList<T>::rouse;
	using MoverList<T>::slots;
	using MoverList<T>::status;

	[[gnu::always_inline]] bool may_leave(const Slot<T> &slot, const Box<T> &box) const
	{
		const T x = slot.place[LINEAR_X], y = slot.place[LINEAR_Y];
		const T way = std::max(speed_margin * way_of(slot), common) + slot.radius();
		return (x - way < box.min_x) | (y - way < box.min_y) | (x + way > box.max_x) | (y + way > box.max_y);
	}

	const T step, common;
};

template <typename T> Box<T> reach_box(const Slot<T> &slot, T need, const ReachRules<T> &rules, const Corner<T> *corners)
{
	return slot.is_static() ? static_box(slot, corners) : reach_about(slot, need, rules);
}

}

#endif
