/* Events of bodies in slots, and the clusters in which they are answered: CONTRACT.md, "The step events". */

#define LISTS_IN \
	LIST_OUT(spans), LIST_IN(neighbours), LIST_OUT(status), LIST_OUT(members), LIST_OUT(active), LIST_OUT(found), LIST_IN(extra), LIST_OUT(wakes)
#define LISTS spans, neighbours, status, members, active, found, extra, wakes

/* When two trajectories hit; NO_HIT if they don't, and also if it is later than `until`, perhaps. Bodies are in the order of their indices. Those whose
 * discs stay apart need not be asked. */
float pair_time(VERTICES_IN, RECORD_IN(slots), float4 rules, int s, trajectory k, int other, trajectory o, float length, float until, bool *pause)
{
	float t0 = larger(k.time, o.time), rest = 1.0f - t0;
	k = moved(slots, s, k, t0, length);
	o = moved(slots, other, o, t0, length);
	body a = body_of(slots, s, k, length), b = body_of(slots, other, o, length);
	bool in_order = slot_body(slots, s) > slot_body(slots, other);
	float end = smaller((until - t0) + 1e-6f, rest); /* not before, however that is rounded */
	float4 found = in_order ? bodies_first(VERTICES, a, b, end, rules) : bodies_first(VERTICES, b, a, end, rules);
	float hit = CHANNEL(found, HITTIMES_HIT);
	*pause = !(CHANNEL(found, HITTIMES_DONE) > 0.0f);
	return hit <= rest ? smaller(t0 + hit, 1.0f) : NO_HIT;
}

/* So many steps are sure to be without a hit at a wall. */
bool is_clear_of_walls(TEX_IN(uniforms), RECORD_IN(slots), float4 rules, int s, trajectory way, float length, float steps)
{
	if (!(CHANNEL(rules, RULES_HAS_ROOM) > 0.0f) || !slot_is_dynamic(slots, s))
		return true;
	float4 room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0);
	body k = body_of(slots, s, way, length);
	float push = (steps * steps) * span(k.a), far = steps * span(k.v);
	float pad = (((push + k.radius) + far) + span(k.x)) * ((4.0f * steps) * SLOP) + (k.radius + push);
	float2 end = (float2)(k.x.x + steps * k.v.x, k.x.y + steps * k.v.y);
	return smaller(k.x.x, end.x) - pad >= CHANNEL(room, ROOM_MIN_X) && smaller(k.x.y, end.y) - pad >= CHANNEL(room, ROOM_MIN_Y)
		&& larger(k.x.x, end.x) + pad <= CHANNEL(room, ROOM_MAX_X) && larger(k.x.y, end.y) + pad <= CHANNEL(room, ROOM_MAX_Y);
}

/* When the trajectory hits which wall first. */
float wall_time(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), float4 rules, int s, trajectory k, float length, int *which, bool *pause)
{
	float4 room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0);
	float rest = 1.0f - k.time, first = NO_HIT;
	*which = 0;
	*pause = false;
	if (k.held > 0.0f || is_clear_of_walls(TEX(uniforms), slots, rules, s, k, length, 1.0f))
		return NO_HIT;
	body b = body_of(slots, s, k, length);
	for (int wall = 0; wall < 4; wall++) {
		float offset, done = 1.0f;
		float2 n = wall_normal(room, wall, &offset);
		float t = b.count == 1 ? circle_wall(b, n, offset) : polygon_wall(VERTICES, b, n, offset, &done);
		float u = t <= rest ? smaller(k.time + t, 1.0f) : NO_HIT;
		if (u < first || (u == first && u <= 1.0f)) { /* of equal ones the least column: the last wall */
			first = u;
			*which = wall;
			*pause = !(done > 0.0f);
		}
	}
	return first;
}

/* Is the event (time, row, column) before the other? */
bool event_before(float4 a, float4 b)
{
	if (CHANNEL(a, NEXT_TIME) != CHANNEL(b, NEXT_TIME))
		return CHANNEL(a, NEXT_TIME) < CHANNEL(b, NEXT_TIME);
	if (CHANNEL(a, NEXT_ROW) != CHANNEL(b, NEXT_ROW))
		return CHANNEL(a, NEXT_ROW) < CHANNEL(b, NEXT_ROW);
	return CHANNEL(a, NEXT_COLUMN) < CHANNEL(b, NEXT_COLUMN);
}

/* What others may be changing. It costs as much as changing it. */
int int_load(LIST_OUT(list), int index)
{
	return atomic_or(&list[index], 0);
}

int find_root(LIST_OUT(parents), int s)
{
	for (;;) {
		int parent = int_load(parents, s);
		if (parent == s)
			return s;
		s = parent;
	}
}

/* The larger root hangs itself onto the less; who comes second tries again from what it finds. */
void unite(LIST_OUT(parents), int a, int b)
{
	for (;;) {
		a = find_root(parents, a);
		b = find_root(parents, b);
		if (a == b)
			return;
		int child = a > b ? a : b, parent = a > b ? b : a;
		if (atomic_cmpxchg(&parents[child], child, parent) == child)
			return;
	}
}

/* Two clusters get into each other's way: they are one in the next round. */
void conflict(LIST_OUT(status), LIST_OUT(members), LIST_IN(active), LIST_OUT(parents), int a, int b, int round)
{
	unite(parents, active[a], active[b]);
	atomic_xchg(&members[MEMBER(a, MEMBER_ROUND)], round + 1);
	atomic_xchg(&members[MEMBER(b, MEMBER_ROUND)], round + 1);
	atomic_xchg(&members[MEMBER(a, MEMBER_HEAD)], -1);
	atomic_xchg(&members[MEMBER(b, MEMBER_HEAD)], -1);
	atomic_max(&status[STATUS_ROUND], round + 1);
}

bool lists_are_good(LIST_OUT(status))
{
	return !status[STATUS_STALE] && !status[STATUS_SMALL];
}

#define BOX_EMPTY ((float4)(INFINITY, INFINITY, -INFINITY, -INFINITY))

/* When a slice of the step ends. */
INLINE float slice_end(LIST_IN(status), int slice)
{
	return (float)(slice + 1) / (float)status[STATUS_SLICES];
}

/* Has the step no slice after this one, with so many active bodies? */
bool is_last_slice(LIST_IN(status), int active)
{
	return status[STATUS_SLICE] + 1 >= status[STATUS_SLICES] || !active;
}

/* Does a pass of contacts go on in the next handing over? */
bool iterations_are_wanted(LIST_IN(status))
{
	return status[STATUS_WANTED] > status[STATUS_HANDED];
}

/* Does a step of contacts wait for its forces? */
bool forces_are_wanted(LIST_IN(status))
{
	return iterations_are_wanted(status) || status[STATUS_PASS] == PASS_IMPULSES;
}

/* Goes through a slot's neighbours: k is an index of Neighbours up to `end`, then -2 - an index of Extra's nodes, then -1. */
INLINE int node_cursor(int node)
{
	return node < 0 ? -1 : -2 - node;
}

INLINE int first_neighbour(LIST_IN(spans), LIST_IN(extra), int s, int end)
{
	int k = spans[SPAN(s, SPAN_START)];
	return k < end ? k : node_cursor(extra[s]);
}

INLINE int next_neighbour(LIST_IN(extra), int s, int end, int k)
{
	if (k < 0)
		return node_cursor(extra[(-2 - k) + NODE_LINK]);
	return k + 1 < end ? k + 1 : node_cursor(extra[s]);
}

INLINE int neighbour_of(LIST_IN(neighbours), LIST_IN(extra), int k)
{
	return k < 0 ? extra[(-2 - k) + NODE_SLOT] : neighbours[k];
}

/* How many steps after this one a look is good for: none if it is cut short, for those are longer. */
float steps_ahead(TEX_IN(uniforms), LIST_IN(status), float length)
{
	return length < CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP) ? 0.0f : (float)status[STATUS_AHEAD];
}

/* The step of a time that is counted from this one's beginning, but not this one. */
INLINE int step_of(LIST_IN(status), float time)
{
	return status[STATUS_AGE] + max((int)time, 1);
}

INLINE void wake_before(LIST_IN(status), LIST_OUT(wakes), int s, float time)
{
	atomic_min(&wakes[WAKE(s, WAKE_NEXT)], step_of(status, time));
}
