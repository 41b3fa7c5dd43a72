/* Where a body may get while the lists of neighbours are good, and the cells in which it is looked for. */

#define REACH_FACTOR 1.25f  /* of a body's speed: hits may make it faster */
#define PACE_FACTOR 1.3f    /* of the mean speed, which counts for bodies that are slower */
#define CELL_FACTOR 3.0f    /* of the mean speed: few bodies are too fast for the cells of their size */
#define TYPICAL_FACTOR 1.8f /* of the mean of the speeds' roots, squared, which a few fast bodies change little */
#define NEAR_LEVELS 2       /* a body looks for smaller ones so many levels below; those farther below look for it */
#define FAST_FACTOR 4.0f    /* of the pace: bodies that get farther are not looked for so long, for they would know too many */
#define DRIFT_FACTOR 1.34f  /* of the pace, a part of it that bodies can go in a step by a hit */
#define HIT_FACTOR 4.0f     /* of the hits a body and step: lists are made for 1 / (1 + that) of the time, for each hit looks through two */
#define MOST_STEPS 6.0f     /* that lists are made for at most, */
#define LEAST_STEPS 1.5f    /* and at least: more than DRIFT_FACTOR, or they are too old as soon as they are made */

/* Lists begin. */
void status_begin(LIST_OUT(status))
{
	status[STATUS_SMALL] = status[STATUS_KEPT] > status[STATUS_KEPT_ROOM];
	status[STATUS_STALE] = status[STATUS_UNDER_WAY] = status[STATUS_LEFT] = status[STATUS_AGE] = status[STATUS_MENDED] = 0;
	status[STATUS_WANTED] = status[STATUS_BORNE] = status[STATUS_TOUCHING] = status[STATUS_PASS] = status[STATUS_RULED] = status[STATUS_THRONGS] = 0;
	status[STATUS_FOURS] = 0;
	status[STATUS_MADE]++;
	status[STATUS_LITTERED] = min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	for (int i = STATUS_ACTIVE; i <= STATUS_MOVERS; i++)
		status[i] = 0;
	status[STATUS_LEVELS] = 1;
	status[STATUS_EXTRA] = status[STATUS_CAPACITY];
	status[STATUS_BUILDS]++;
}

/* s, how long lists are to last. */
float pace_window(LIST_IN(status), int count, float time_step)
{
	return time_step * larger(MOST_STEPS / (1.0f + HIT_FACTOR * ((float)status[STATUS_BUSTLE] / (float)count)), LEAST_STEPS);
}

/* Of a lane's part of a sample of the bodies that move: sums of their speeds' squares and roots, and of their radii, and how many there are. */
float4 pace_sample(RECORD_IN(slots), int count, float window, int lane, int lanes)
{
	int step = count / 256 + 1;
	float4 sum = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	for (int s = lane * step; s < count; s += lanes * step) {
		float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), acceleration = SLOT_LOAD(slots, s, SLOT_PUSH);
		if (!slot_is_dynamic(slots, s))
			continue;
		float speed = norm((float2)(at.z, at.w)) + norm((float2)(acceleration.x, acceleration.y)) * window;
		sum += (float4)(speed * speed, sqrt(speed), CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS), 1.0f);
	}
	return sum;
}

/* How far bodies go, from such a sample, but so many tenths of a radius at least. None of this changes a result: it only decides how long lists last. */
void pace_choose(float4 sum, float window, float brief, float tenths, LIST_OUT(status))
{
	float many = larger(sum.w, 1.0f), size = sum.z / many, typical = TYPICAL_FACTOR * (sum.y / many) * (sum.y / many);
	float way = smaller(REACH_FACTOR * window * sqrt(sum.x / many), larger(REACH_FACTOR * window * typical, size));
	float pace = larger(PACE_FACTOR * way, tenths * 0.1f * size), side = 1.01f * (size + larger(pace, CELL_FACTOR * way));
	status[STATUS_PACE] = as_int(pace);
	status[STATUS_CELL] = as_int(side > 0.0f && side < 1e30f ? side : 1.0f);
	status[STATUS_WINDOW] = as_int(window);
	status[STATUS_BRIEF] = as_int(brief);
}

/* A static body's box is tight. */
float4 static_box(VERTICES_IN, RECORD_IN(slots), int s)
{
	body k = body_of(slots, s, trajectory_start(slots, s), 1.0f);
	float2 rotation = rotation_of(k.r), low = k.x, high = k.x;
	float pad = ((magnitude(k.x.x) + magnitude(k.x.y)) + k.radius) * (4.0f * SLOP);
	for (int j = 0; j < k.count && k.count > 1; j++) {
		float2 v = turn(rotation, vertex_load(VERTICES, k.first, j));
		low = (float2)(smaller(low.x, k.x.x + v.x), smaller(low.y, k.x.y + v.y));
		high = (float2)(larger(high.x, k.x.x + v.x), larger(high.y, k.x.y + v.y));
	}
	float grow = k.count > 1 ? pad : pad + k.radius;
	return (float4)(low.x - grow, low.y - grow, high.x + grow, high.y + grow);
}

/* Of a body that moves. */
float4 reach_about(RECORD_IN(slots), int s, float need, LIST_IN(status))
{
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), push = SLOT_LOAD(slots, s, SLOT_PUSH);
	float window = as_float(status[STATUS_WINDOW]), pace = as_float(status[STATUS_PACE]),
		  radius = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS);
	float speed = norm((float2)(at.z, at.w)) + norm((float2)(push.x, push.y)) * window;
	if (REACH_FACTOR * speed * window > FAST_FACTOR * pace)
		window = as_float(status[STATUS_BRIEF]);
	float way = larger(larger(pace, REACH_FACTOR * speed * window), REACH_FACTOR * need);
	way += radius + ((magnitude(at.x) + magnitude(at.y)) + radius) * (8.0f * SLOP);
	return (float4)(at.x - way, at.y - way, at.x + way, at.y + way);
}

float4 reach_box(VERTICES_IN, RECORD_IN(slots), int s, float need, LIST_IN(status))
{
	return slot_is_static(slots, s) ? static_box(VERTICES, slots, s) : reach_about(slots, s, need, status);
}

float level_side(LIST_IN(status), int level)
{
	return as_float(status[STATUS_CELL]) * (float)(1 << level);
}

float half_of(float4 box)
{
	return 0.5f * larger(box.z - box.x, box.w - box.y);
}

/* The level whose cells are at least half as large as the box, which is in the cell of its middle. */
int reach_level(float4 box, float side)
{
	float half_size = half_of(box);
	int level = 0;
	while (level < CELL_LEVELS - 1 && side < half_size) {
		side *= 2.0f;
		level++;
	}
	return level;
}

int cell_floor(float x)
{
	return (int)floor(x < -1e9f ? -1e9f : x > 1e9f ? 1e9f : x);
}

int2 cell_of(float2 x, float side)
{
	return (int2)(cell_floor(x.x / side), cell_floor(x.y / side));
}

/* Each level of the grid is a torus with half as many rows as the one before. */
int level_rows(int rows, int level)
{
	return max(rows >> level, 1);
}

int row_level(int rows, int row)
{
	int level = 0;
	while (row >= CELL_FIRST_ROW(rows, level + 1))
		level++;
	return level;
}

/* The last and the first of the cells of a level in which bodies could be whose boxes touch this one; once round is enough. */
int2 cells_around(float4 box, float side, int columns, int rows, int2 *low)
{
	*low = cell_of((float2)(box.x - side, box.y - side), side);
	int2 high = cell_of((float2)(box.z + side, box.w + side), side);
	return (int2)(min(high.x, low->x + columns - 1), min(high.y, low->y + rows - 1));
}

int cell_index(int2 cell, int level, int columns, int rows)
{
	return (CELL_FIRST_ROW(rows, level) + (cell.y & (level_rows(rows, level) - 1))) * columns + (cell.x & (columns - 1));
}

void member_reset(LIST_OUT(members), int id)
{
	__global int *m = members + MEMBER(id, 0);
	m[MEMBER_OWNER] = m[MEMBER_LINK] = m[MEMBER_HEAD] = m[MEMBER_KEPT] = -1;
	m[MEMBER_EVENTS] = m[MEMBER_BEGUN] = m[MEMBER_RAPID] = m[MEMBER_STUCK] = m[MEMBER_SEEN] = m[MEMBER_ROUND] = m[MEMBER_HITS] = m[MEMBER_RULED] =
		m[MEMBER_PILE] = 0;
}

/* What a step that was not done has left of its clusters. */
void litter_clear(LIST_IN(status), LIST_OUT(members), LIST_OUT(owners), LIST_OUT(parents), int s, int count)
{
	if (!status[STATUS_LITTERED])
		return;
	owners[s] = -1;
	parents[s] = s;
	for (int id = s; id < status[STATUS_LITTERED]; id += count)
		member_reset(members, id);
}

#define CELLS_EACH 4 /* that a work-item takes together */

/* The bodies in such cells, from one of a row on. */
int cells_count(LIST_IN(row), int from)
{
	int sum = 0;
	for (int k = from; k < from + CELLS_EACH; k++)
		sum += row[CELL_WIDTH * k + CELL_COUNT];
	return sum;
}

/* They get their places from that one on, and are to be counted anew. */
void cells_place(LIST_OUT(row), int from, int place)
{
	for (int k = from; k < from + CELLS_EACH; k++) {
		__global int *cell = row + CELL_WIDTH * k;
		cell[CELL_START] = cell[CELL_END] = place;
		place += cell[CELL_COUNT];
		cell[CELL_COUNT] = 0;
	}
}

/* All that a group wants; what each of its work-items wants becomes what those before it do. To be done by one of them. */
int group_sum(__local int *wanted)
{
	int sum = 0;
	for (int i = 0; i < (int)get_local_size(0); i++) {
		int own = wanted[i];
		wanted[i] = sum;
		sum += own;
	}
	return sum;
}

/* Room for `count` ints in Neighbours; -1 if there is not enough. */
int neighbours_take(LIST_OUT(status), int count)
{
	int throngs = count / THRONG;
	bool too_many = throngs > 0 && atomic_add(&status[STATUS_THRONGS], throngs) > THRONGS_MOST - throngs;
	int start = too_many ? INT_MAX : atomic_add(&status[STATUS_NEIGHBOURS], count);
	if (start <= status[STATUS_ROOM] - count)
		return start;
	atomic_or(&status[STATUS_SMALL], 1);
	return -1;
}

/* Do two reaches touch? Of four comparisons by themselves LLVM makes one of vectors, and Oclgrind takes 255 for its truth. */
INLINE bool boxes_touch(float4 a, float4 b)
{
	return !is_any((float4)(b.x, b.y, a.x, a.y) > (float4)(a.z, a.w, b.z, b.w));
}

#define NEAR_MOST 48 /* more neighbours are searched twice */

typedef struct near_list {
	int ahead, behind;        /* pairs that this slot tests, and those that the other does */
	int found[NEAR_MOST + 1]; /* those ahead from the first on, those behind from the last; between is room for one that is not near */
} near_list;

/* Of two bodies of different levels one looks for the other, and tells it. */
void node_push(LIST_OUT(status), LIST_OUT(nodes), LIST_OUT(members), int other, int s)
{
	int node = PEEK(status, STATUS_NODES) > NODES_MOST ? INT_MAX : atomic_inc(&status[STATUS_NODES]);
	if (node >= status[STATUS_NODE_ROOM]) {
		atomic_or(&status[STATUS_SMALL], 1);
		return;
	}
	nodes[NODE_WIDTH * node + NODE_SLOT] = s;
	nodes[NODE_WIDTH * node + NODE_LINK] = atomic_xchg(&members[MEMBER(other, MEMBER_HEAD)], node);
}

/* May the bodies of two slots hit each other, wherever they are? */
bool slots_meet(RECORD_IN(slots), LIST_IN(filters), int s, int other)
{
	if (!slot_is_dynamic(slots, s) && !slot_is_dynamic(slots, other))
		return false;
	return !filters[FILTERS_ANY] || filter_lets(filters, slot_body(slots, s), slot_body(slots, other));
}

/* The slots of one level in places [from, to) whose reach touches this one's, that are all ahead of it or all behind. With half_at < 0 they are counted,
 * and kept while there is room in the list; else they are written to Neighbours, those behind from `half_at` on. What is not near is kept, too, but not
 * counted: whether it is near is hard to foretell, and so there is no branch. */
INLINE void near_range(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_OUT(nodes), LIST_OUT(members), int s, float4 box,
	bool meets_all, bool same_level, bool ahead, int from, int to, near_list *list, LIST_OUT(neighbours), int half_at)
{
	int count = ahead ? list->ahead : list->behind;
	for (int other = from; other < to; other++) {
		bool near = boxes_touch(box, reach[other]);
		if (!meets_all && near && !slots_meet(slots, filters, s, other))
			near = false;
		if (half_at < 0)
			list->found[ahead ? min(count, NEAR_MOST) : max(NEAR_MOST - count, 0)] = other;
		else if (near)
			neighbours[ahead ? count : half_at + count] = other;
		count += near ? 1 : 0;
		if (!same_level && near && half_at < 0)
			node_push(status, nodes, members, other, s);
	}
	if (ahead)
		list->ahead = count;
	else
		list->behind = count;
}

/* Those of one level in places [from, to). */
INLINE void near_ranges(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_OUT(nodes), LIST_OUT(members), int s, float4 box,
	bool meets_all, bool same_level, int from, int to, near_list *list, LIST_OUT(neighbours), int half_at)
{
	if (same_level) {
		near_range(slots, filters, reach, status, nodes, members, s, box, meets_all, true, false, from, min(to, s), list, neighbours, half_at);
		from = max(from, s + 1);
	}
	near_range(slots, filters, reach, status, nodes, members, s, box, meets_all, same_level, true, from, to, list, neighbours, half_at);
}

void near_search(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_IN(cells), LIST_OUT(nodes), LIST_OUT(members), int s,
	int columns, int rows, near_list *list, LIST_OUT(neighbours), int half_at)
{
	float4 box = reach[s];
	int own = reach_level(box, as_float(status[STATUS_CELL])), levels = status[STATUS_LEVELS];
	bool meets_all = slot_is_dynamic(slots, s) && !filters[FILTERS_ANY];
	for (int level = max(own - NEAR_LEVELS, 0); levels >> level; level++) {
		if (!(levels & (1 << level)) || (level > own && level <= own + NEAR_LEVELS))
			continue;
		float side = level_side(status, level);
		int2 low, high = cells_around(box, side, columns, level_rows(rows, level), &low);
		for (int y = low.y; y <= high.y; y++) {
			int first = cell_index((int2)(low.x, y), level, columns, rows), last = cell_index((int2)(high.x, y), level, columns, rows);
			int row = first - (first & (columns - 1));
			int from = cells[CELL_WIDTH * first + CELL_START], to = cells[CELL_WIDTH * last + CELL_END];
			if (last < first) {
				near_ranges(slots, filters, reach, status, nodes, members, s, box, meets_all, level == own, cells[CELL_WIDTH * row + CELL_START], to,
					list, neighbours, half_at);
				to = cells[CELL_WIDTH * (row + columns - 1) + CELL_END];
			}
			near_ranges(slots, filters, reach, status, nodes, members, s, box, meets_all, level == own, from, to, list, neighbours, half_at);
		}
	}
}

/* Those that the list had no room for are found once more. */
void near_again(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_IN(cells), LIST_OUT(nodes), LIST_OUT(members), int s,
	int columns, int rows, int half_at, LIST_OUT(neighbours))
{
	near_list again;
	again.ahead = again.behind = 0;
	near_search(slots, filters, reach, status, cells, nodes, members, s, columns, rows, &again, neighbours, half_at);
}

void near_write(const near_list *list, int start, int half_end, int end, LIST_OUT(neighbours))
{
	for (int k = start; k < half_end; k++)
		neighbours[k] = list->found[k - start];
	for (int k = half_end; k < end; k++)
		neighbours[k] = list->found[NEAR_MOST - (k - half_end)];
}

/* What smaller bodies found beside this one joins its span. */
void span_gather(LIST_OUT(status), LIST_OUT(spans), LIST_OUT(neighbours), LIST_IN(nodes), LIST_OUT(members), int s)
{
	int start = spans[SPAN(s, SPAN_START)], middle = spans[SPAN(s, SPAN_HALF)], end = spans[SPAN(s, SPAN_END)], extra = 0;
	for (int k = members[MEMBER(s, MEMBER_HEAD)]; k >= 0; k = nodes[NODE_WIDTH * k + NODE_LINK])
		extra++;
	int to = neighbours_take(status, (end - start) + extra);
	if (to >= 0) {
		spans[SPAN(s, SPAN_START)] = to;
		spans[SPAN(s, SPAN_HALF)] = to + (middle - start);
		for (int k = start; k < end; k++)
			neighbours[to++] = neighbours[k];
		for (int k = members[MEMBER(s, MEMBER_HEAD)]; k >= 0; k = nodes[NODE_WIDTH * k + NODE_LINK])
			neighbours[to++] = nodes[NODE_WIDTH * k + NODE_SLOT];
		spans[SPAN(s, SPAN_END)] = to;
	}
	members[MEMBER(s, MEMBER_HEAD)] = -1;
}

/* Between two steps the slot has got another way: it looks at all around it in the next. */
void slot_rouse(LIST_IN(status), LIST_OUT(wakes), int s)
{
	wakes[WAKE(s, WAKE_CHANGED)] = CHANGED_AFTER(status[STATUS_AGE]);
	wakes[WAKE(s, WAKE_NEXT)] = status[STATUS_AGE];
}

/* How far the body may go in the next step. */
float way_ahead(RECORD_IN(slots), int s, float step)
{
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE), push = SLOT_LOAD(slots, s, SLOT_PUSH);
	float speed = norm((float2)(CHANNEL(at, LINEAR_VX), CHANNEL(at, LINEAR_VY)));
	return (speed + norm((float2)(CHANNEL(push, PUSH_X), CHANNEL(push, PUSH_Y))) * step) * step;
}

/* Might the body leave its reach in the next step? */
bool leaves_reach(TEX_IN(uniforms), RECORD_IN(slots), LIST_OUT(status), float4 box, int s)
{
	float step = CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP);
	float4 at = SLOT_LOAD(slots, s, SLOT_PLACE);
	float common = as_float(status[STATUS_PACE]) * (step / as_float(status[STATUS_WINDOW]));
	float way = larger(REACH_FACTOR * way_ahead(slots, s, step), DRIFT_FACTOR * common) + CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS);
	float x = CHANNEL(at, LINEAR_X), y = CHANNEL(at, LINEAR_Y);
	return x - way < CHANNEL(box, AABB_MIN_X) || y - way < CHANNEL(box, AABB_MIN_Y) || x + way > CHANNEL(box, AABB_MAX_X)
		|| y + way > CHANNEL(box, AABB_MAX_Y);
}

/* A body gets another reach, and new neighbours before the next step. */
void slot_moves(RECORD_IN(slots), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(wakes), LIST_OUT(movers), int s, int room)
{
	int mover = atomic_inc(&status[STATUS_MOVERS]);
	if (mover < room)
		movers[mover] = s;
	else
		atomic_or(&status[STATUS_STALE], 1);
	reach[s] = reach_about(slots, s, 0.0f, status);
	slot_rouse(status, wakes, s);
}

/* A body that might leave its reach gets another one. True if it does. */
bool reach_keep(TEX_IN(uniforms), RECORD_IN(slots), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(wakes), LIST_OUT(movers), int s, int room)
{
	bool leaves = leaves_reach(TEX(uniforms), slots, status, reach[s], s);
	if (leaves)
		slot_moves(slots, reach, status, wakes, movers, s, room);
	return leaves;
}
