/* The bodies around one, in bunches: on a CPU four side by side, so that what is read of them is read at once, and most are seen to stay apart without a
 * look at each; on a GPU one, for its lanes are side by side already. */

#ifdef CAROM_GPU
#define BUNCH 1
#define EACH(what) what()
#define FIRST(bunch) (bunch)
#define TURNED(bunch) (bunch)
#define IS_ANY(flags) ((flags) != 0)
typedef int ints;
typedef float floats;
#else
#define BUNCH 4
#define EACH(what) what(.x), what(.y), what(.z), what(.w)
#define FIRST(bunch) (bunch).x
#define TURNED(bunch) (bunch).yzwx
#define IS_ANY(flags) is_any(flags)
typedef int4 ints;
typedef float4 floats;
#endif

INLINE float least_of(floats all)
{
#ifdef CAROM_GPU
	return all;
#else
	return smaller(smaller(all.x, all.y), smaller(all.z, all.w));
#endif
}

/* Indices of Neighbours that a cursor shows. */
INLINE ints bunch_places(int cursor)
{
#ifdef CAROM_GPU
	return cursor;
#else
	return (int4)(cursor, cursor + 1, cursor + 2, cursor + 3);
#endif
}

/* Slots, and which of them there are. */
typedef struct bunch {
	ints slots, live;
} bunch;

/* Those that a cursor of first_neighbour shows; those beyond the last are the last again, and not live. */
INLINE bunch bunch_at(LIST_IN(neighbours), LIST_IN(extra), int end, int cursor)
{
	bunch all;
#ifdef CAROM_GPU
	all.slots = neighbour_of(neighbours, extra, cursor);
	all.live = 1;
#else
	if (cursor < 0) {
		all.slots = (int4)(extra[(-2 - cursor) + NODE_SLOT]);
		all.live = (int4)(-1, 0, 0, 0);
		return all;
	}
	all.slots.x = neighbours[cursor];
	all.slots.y = neighbours[min(cursor + 1, end - 1)];
	all.slots.z = neighbours[min(cursor + 2, end - 1)];
	all.slots.w = neighbours[min(cursor + 3, end - 1)];
	all.live = bunch_places(cursor) < (int4)(end);
#endif
	return all;
}

/* The node so many after this one; -1 if there are not so many. */
INLINE int node_after(LIST_IN(extra), int node, int count)
{
	for (; count > 0 && node >= 0; count--)
		node = extra[node + NODE_LINK];
	return node;
}

/* A lane's part of the neighbours: its first cursor, */
INLINE int bunch_first(LIST_IN(spans), LIST_IN(extra), int s, int end, int lane)
{
	int k = spans[SPAN(s, SPAN_START)] + BUNCH * lane;
	return k < end ? k : node_cursor(node_after(extra, extra[s], lane));
}

/* and the one behind those that a cursor shows. */
INLINE int bunch_next(LIST_IN(extra), int s, int end, int cursor, int lane, int lanes)
{
	if (cursor < 0)
		return node_cursor(node_after(extra, extra[(-2 - cursor) + NODE_LINK], lanes - 1));
	return cursor + BUNCH * lanes < end ? cursor + BUNCH * lanes : node_cursor(node_after(extra, extra[s], lane));
}

#ifdef CAROM_GPU
typedef struct discs {
	disc one;
	bool plain;
} discs;

INLINE discs discs_of(RECORD_IN(slots), int s, ints others, const disc *of)
{
	discs all = {*of, are_plain(slots, s, others)};
	return all;
}

INLINE float first_meetings(disc a, const discs *b, float ahead)
{
	return first_meeting(a, b->one, ahead, b->plain);
}
#else
/* Discs, as `disc` has them, and which are of circles that fall as that other one does. */
typedef struct discs {
	float4 x, y, vx, vy, ax, ay, radius, time;
	int4 plain;
} discs;

/* Of the bodies in the slots `others`. */
INLINE discs discs_of(RECORD_IN(slots), int s, ints others, const disc *of)
{
	discs all;
	all.x = (float4)(of[0].x.x, of[1].x.x, of[2].x.x, of[3].x.x);
	all.y = (float4)(of[0].x.y, of[1].x.y, of[2].x.y, of[3].x.y);
	all.vx = (float4)(of[0].v.x, of[1].v.x, of[2].v.x, of[3].v.x);
	all.vy = (float4)(of[0].v.y, of[1].v.y, of[2].v.y, of[3].v.y);
	all.ax = (float4)(of[0].a.x, of[1].a.x, of[2].a.x, of[3].a.x);
	all.ay = (float4)(of[0].a.y, of[1].a.y, of[2].a.y, of[3].a.y);
	all.radius = (float4)(of[0].radius, of[1].radius, of[2].radius, of[3].radius);
	all.time = (float4)(of[0].time, of[1].time, of[2].time, of[3].time);
	all.plain = -(int4)(are_plain(slots, s, others.x), are_plain(slots, s, others.y), are_plain(slots, s, others.z), are_plain(slots, s, others.w));
	return all;
}

INLINE float4 magnitudes(float4 x)
{
	return x < (float4)(0.0f) ? -x : x;
}

/* first_meeting with each of the four. */
INLINE float4 first_meetings(disc a, const discs *b, float ahead)
{
	float last = 1.0f + ahead;
	float4 own = (float4)(a.time), none = (float4)(0.0f), never = (float4)(last + 1.0f), t0 = b->time > own ? b->time : own;
	float4 da = t0 - own, db = t0 - b->time, half_da = 0.5f * da, half_db = 0.5f * db;
	float4 from_x = a.x.x + da * (a.v.x + half_da * a.a.x), from_y = a.x.y + da * (a.v.y + half_da * a.a.y);
	float4 to_x = b->x + db * (b->vx + half_db * b->ax), to_y = b->y + db * (b->vy + half_db * b->ay), dx = to_x - from_x, dy = to_y - from_y;
	float4 vx = (b->vx + db * b->ax) - (a.v.x + da * a.a.x), vy = (b->vy + db * b->ay) - (a.v.y + da * a.a.y);
	float4 differ = (last * last) * (magnitudes(b->ax - a.a.x) + magnitudes(b->ay - a.a.y)), reach = a.radius + b->radius;
	float4 spans = (magnitudes(vx) + magnitudes(vy)) + span(a.v),
		   far = (magnitudes(from_x) + magnitudes(from_y)) + (magnitudes(to_x) + magnitudes(to_y));
	float4 slack = (far + (reach + last * (spans + (magnitudes(b->vx) + magnitudes(b->vy))))) * (8.0f * SLOP);
	float4 most = ((reach + differ) + slack) * 1.00001f, square = most * most;
	float4 distance = dx * dx + dy * dy, approach = dx * vx + dy * vy, speed = vx * vx + vy * vy;
	float4 enough = slack * ((magnitudes(vx) + magnitudes(vy)) + (0.5f * SUNK_RATE) * (magnitudes(dx) + magnitudes(dy)));
	int4 apart = distance > square, parts = (approach >= none) & (apart | (b->plain & (differ == none) & (approach > enough)));
	float4 cross = dx * vy - dy * vx, under = square * speed - cross * cross, length = sqrt(distance);
	int4 misses = parts | (apart & (under < none));
	float4 until = t0 + (((length - most) * (length + most)) / (sqrt(under < none ? none : under) - approach)) * 0.9999f;
	return misses ? never : apart ? until : t0;
}
#endif

/* As the step begins. */
INLINE discs discs_at_start(RECORD_IN(slots), int s, ints others, float length)
{
#define AT_START(one) disc_at_start(slots, (others)one, length)
	disc all[BUNCH] = {EACH(AT_START)};
	return discs_of(slots, s, others, all);
}

/* What is read of a slot that looks around is fetched before: where its neighbours are listed, then the list, then what is asked of the neighbours. In
 * worlds that caches can't hold, a look on a CPU takes as long as it waits for these. */
INLINE void fetch_span(RECORD_IN(slots), LIST_IN(spans), LIST_IN(extra), int s)
{
	FETCH(slots + SLOT_WIDTH * s);
	FETCH(spans + SPAN(s, 0));
	FETCH(extra + s);
}

INLINE void fetch_list(LIST_IN(spans), LIST_IN(neighbours), int s)
{
	FETCH(neighbours + spans[SPAN(s, SPAN_START)]);
	FETCH(neighbours + spans[SPAN(s, SPAN_END)]);
}

INLINE void fetch_neighbours(RECORD_IN(slots), LIST_IN(spans), LIST_IN(neighbours), LIST_IN(owners), LIST_IN(wakes), int s, int end)
{
	for (int k = spans[SPAN(s, SPAN_START)]; k < end; k++) {
		FETCH(slots + SLOT_WIDTH * neighbours[k]);
		FETCH(owners + neighbours[k]);
		FETCH(wakes + WAKE(neighbours[k], 0));
	}
}
