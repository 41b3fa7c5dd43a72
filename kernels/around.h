/* The bodies around one, four side by side: what is read of them is read at once, and most are seen to stay apart without a look at each. */

/* Slots, and which of the four there are. */
typedef struct fours {
	int4 slots, live;
} fours;

/* Those that a cursor of first_neighbour shows; those beyond the last are the last again, and not live. */
INLINE fours fours_at(LIST_IN(neighbours), LIST_IN(extra), int end, int cursor)
{
	fours all;
	if (cursor < 0) {
		all.slots = (int4)(extra[(-2 - cursor) + NODE_SLOT]);
		all.live = (int4)(-1, 0, 0, 0);
		return all;
	}
	all.slots.x = neighbours[cursor];
	all.slots.y = neighbours[min(cursor + 1, end - 1)];
	all.slots.z = neighbours[min(cursor + 2, end - 1)];
	all.slots.w = neighbours[min(cursor + 3, end - 1)];
	all.live = (int4)(cursor, cursor + 1, cursor + 2, cursor + 3) < (int4)(end);
	return all;
}

/* The cursor behind them. */
INLINE int fours_next(LIST_IN(extra), int s, int end, int cursor)
{
	if (cursor < 0)
		return node_cursor(extra[(-2 - cursor) + NODE_LINK]);
	return cursor + 4 < end ? cursor + 4 : node_cursor(extra[s]);
}

/* Whether one of the four is the case: any() is not the same on every device. */
INLINE bool is_any(int4 flags)
{
	return flags.x | flags.y | flags.z | flags.w;
}

/* Discs, as `disc` has them, and which are of circles that fall as that other one does. */
typedef struct discs {
	float4 x, y, vx, vy, ax, ay, radius, time;
	int4 plain;
} discs;

/* Of the bodies in the slots `others`. */
INLINE discs discs_of(RECORD_IN(slots), int s, int4 others, disc a, disc b, disc c, disc d)
{
	discs all;
	all.x = (float4)(a.x.x, b.x.x, c.x.x, d.x.x);
	all.y = (float4)(a.x.y, b.x.y, c.x.y, d.x.y);
	all.vx = (float4)(a.v.x, b.v.x, c.v.x, d.v.x);
	all.vy = (float4)(a.v.y, b.v.y, c.v.y, d.v.y);
	all.ax = (float4)(a.a.x, b.a.x, c.a.x, d.a.x);
	all.ay = (float4)(a.a.y, b.a.y, c.a.y, d.a.y);
	all.radius = (float4)(a.radius, b.radius, c.radius, d.radius);
	all.time = (float4)(a.time, b.time, c.time, d.time);
	all.plain = -(int4)(are_plain(slots, s, others.x), are_plain(slots, s, others.y), are_plain(slots, s, others.z), are_plain(slots, s, others.w));
	return all;
}

/* As the step begins. */
INLINE discs discs_at_start(RECORD_IN(slots), int s, int4 others, float length)
{
	return discs_of(slots, s, others, disc_at_start(slots, others.x, length), disc_at_start(slots, others.y, length),
		disc_at_start(slots, others.z, length), disc_at_start(slots, others.w, length));
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
