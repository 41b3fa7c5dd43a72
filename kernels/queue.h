/* The queue of events of one cluster, run by one work-item. */

disc disc_of_trajectory(RECORD_IN(slots), int s, trajectory k, float length)
{
	return disc_of(slots, s, k.place, k.time, k.held > 0.0f, length);
}

/* The event of a member's hit with a partner: a slot, or -1 - wall. */
float4 event_of(RECORD_IN(slots), int s, int partner, float time, bool pause)
{
	int k = slot_body(slots, s), other = partner < 0 ? partner : slot_body(slots, partner);
	return (float4)(time, (float)max(k, other), (float)min(k, other), (float)partner + (pause ? (partner < 0 ? -0.5f : 0.5f) : 0.0f));
}

/* Numbers of those of the four that are members of the cluster, -1 of the others. */
INLINE int4 members_of(LIST_OUT(members), LIST_IN(owners), int4 others, int leader)
{
	int4 none = (int4)(-1), ids = (int4)(PEEK(owners, others.x), PEEK(owners, others.y), PEEK(owners, others.z), PEEK(owners, others.w));
	int4 known = ids < (int4)(0) ? (int4)(0) : ids;
	int4 theirs = (int4)(PEEK(members, MEMBER(known.x, MEMBER_OWNER)), PEEK(members, MEMBER(known.y, MEMBER_OWNER)),
		PEEK(members, MEMBER(known.z, MEMBER_OWNER)), PEEK(members, MEMBER(known.w, MEMBER_OWNER)));
	return ((ids >= (int4)(0)) & (theirs == (int4)(leader))) ? ids : none; /* nobody else writes or takes away those that are */
}

/* Of a member as it is now, of all others as the step began. */
INLINE disc disc_seen(RECORD_IN(slots), RECORD_OUT(work), int other, int id, float length)
{
	__global const float4 *from = id < 0 ? slots + SLOT_WIDTH * other : work + WORK_WIDTH * id;
	float4 turn_record = from[WORK_TURN];
	float time = id < 0 ? 0.0f : CHANNEL(turn_record, WORK_TIME);
	return disc_of(slots, other, from[WORK_PLACE], time, id >= 0 && CHANNEL(turn_record, WORK_HELD) > 0.0f, length);
}

INLINE discs discs_seen(RECORD_IN(slots), RECORD_OUT(work), int s, int4 others, int4 ids, float length)
{
	return discs_of(slots, s, others, disc_seen(slots, work, others.x, ids.x, length), disc_seen(slots, work, others.y, ids.y, length),
		disc_seen(slots, work, others.z, ids.z, length), disc_seen(slots, work, others.w, ids.w, length));
}

/* The first event of a member, by what is known now. For later steps the pair is the member's, or if both were changed the one's for which it is: so
 * both keep when to look again. With the partner in its last event, -1 for none, the next one is found once for both: *found_with is (its time, 1 for a
 * pause), and (0, -1) before. */
void look(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners), float4 rules, int id, int leader,
	float length, int partner, float2 *found_with)
{
	int s = active[id], wall, seen = 0, end = spans[SPAN(s, SPAN_END)];
	trajectory k = work_load(work, id);
	disc disc_k = disc_of_trajectory(slots, s, k, length);
	bool pause;
	float ahead = steps_ahead(TEX(uniforms), status, length);
	bool clear = !(k.held > 0.0f) && is_clear_of_walls(TEX(uniforms), slots, rules, s, k, length, 1.0f + ahead);
	float4 first = (float4)(NO_HIT, 0.0f, 0.0f, 0.0f);
	float again = clear ? 1.0f + ahead : 1.0f, t = clear ? NO_HIT : wall_time(VERTICES, TEX(uniforms), slots, rules, s, k, length, &wall, &pause);
	if (t <= 1.0f)
		first = event_of(slots, s, -1 - wall, t, pause);
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = fours_next(extra, s, end, i)) {
		fours others = fours_at(neighbours, extra, end, i);
		discs all = discs_at_start(slots, s, others.slots, length); /* nearly always; it need not wait for who they are */
		int4 ids = members_of(members, owners, others.slots, leader);
		if (is_any(ids >= (int4)(0)))
			all = discs_seen(slots, work, s, others.slots, ids, length);
		float4 meetings = others.live ? first_meetings(disc_k, &all, ahead) : (float4)(again);
		again = smaller(again, smaller(smaller(meetings.x, meetings.y), smaller(meetings.z, meetings.w)));
		if (!is_any(others.live & ((meetings <= (float4)(1.0f)) | (ids >= (int4)(0)))))
			continue;
		for (int n = 0; n < 4; n++, others.slots = others.slots.yzwx, others.live = others.live.yzwx, ids = ids.yzwx, meetings = meetings.yzwx) {
			int other = others.slots.x, other_id = ids.x, events = others.live.x && other_id >= 0 ? members[MEMBER(other_id, MEMBER_EVENTS)] : 0;
			if (events > 0)
				wake_before(status, wakes, other, meetings.x);
			float until = smaller(CHANNEL(first, NEXT_TIME), 1.0f);
			if (!others.live.x || meetings.x > until || stay_apart(disc_k, disc_seen(slots, work, other, other_id, length)))
				continue;
			bool is_partner = other_id >= 0 && other_id == partner, is_known = is_partner && found_with->y >= 0.0f;
			trajectory o = other_id < 0 ? trajectory_start(slots, other) : work_load(work, other_id);
			pause = is_known && found_with->y > 0.0f;
			t = is_known ? found_with->x : pair_time(VERTICES, slots, rules, s, k, other, o, length, is_partner ? 1.0f : until, &pause);
			if (is_partner)
				*found_with = (float2)(t, pause ? 1.0f : 0.0f);
			if (!(t <= 1.0f) || t > CHANNEL(first, NEXT_TIME))
				continue;
			float4 next = event_of(slots, s, other, t, pause);
			if (event_before(next, first)) {
				first = next;
				seen = events;
			}
		}
	}
	wakes[WAKE(s, WAKE_NEXT)] = step_of(status, again);
	work[WORK_WIDTH * id + WORK_NEXT] = first;
	members[MEMBER(id, MEMBER_SEEN)] = seen;
}

/* The same while no event has changed anything: it was found before, or is to be looked for before all. */
void recall(RECORD_IN(slots), LIST_IN(spans), LIST_OUT(members), LIST_IN(active), LIST_IN(found), RECORD_OUT(work), int id)
{
	int s = active[id], k = spans[SPAN(s, SPAN_FOUND)];
	float4 first = (float4)(NO_HIT, 0.0f, 0.0f, 0.0f);
	for (; k >= 0; k = found[FOUND_WIDTH * k + FOUND_LINK]) {
		int bits = found[FOUND_WIDTH * k + FOUND_TIME];
		float4 next = event_of(slots, s, found[FOUND_WIDTH * k + FOUND_PARTNER], magnitude(as_float(bits)), bits < 0);
		if (event_before(next, first))
			first = next;
	}
	if (k == FOUND_NO_ROOM)
		CHANNEL(first, NEXT_TIME) = NEXT_UNKNOWN;
	work[WORK_WIDTH * id + WORK_NEXT] = first;
	members[MEMBER(id, MEMBER_SEEN)] = 0;
}

/* The cluster owns the body in slot s from now on, if nobody else does: its number, or -1. It comes second in the list, so that the head stays. */
int claim(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_OUT(active), RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), int s,
	int leader, int head)
{
	int id = atomic_inc(&status[STATUS_ACTIVE]);
	if (id >= status[STATUS_NUMBERS]) {
		atomic_or(&status[STATUS_LEFT], 1); /* so many were lost: the step begins again */
		return -1;
	}
	active[id] = s;
	atomic_xchg(&members[MEMBER(id, MEMBER_OWNER)], leader);
	work_begin(slots, members, work, s, id);
	mem_fence(CLK_GLOBAL_MEM_FENCE);
	if (atomic_cmpxchg(&owners[s], -1, id) != -1) {
		active[id] = -1;
		member_reset(members, id);
		return -1;
	}
	atomic_xchg(&parents[s], active[leader]);
	members[MEMBER(id, MEMBER_LINK)] = members[MEMBER(head, MEMBER_LINK)];
	members[MEMBER(head, MEMBER_LINK)] = id;
	return id;
}

/* All the clusters around this one are one with it in the next round. */
void spread(LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), int leader, int head, int round)
{
	for (int m = head; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
		int s = active[m], end = spans[SPAN(s, SPAN_END)];
		for (int k = first_neighbour(spans, extra, s, end); k != -1; k = next_neighbour(extra, s, end, k)) {
			int id = int_load(owners, neighbour_of(neighbours, extra, k)), owner = id < 0 ? leader : int_load(members, MEMBER(id, MEMBER_OWNER));
			if (owner != leader)
				conflict(status, members, active, parents, leader, owner, round);
		}
	}
}

/* The number of the body in a slot as a member of the cluster, which it becomes if it is nobody's; -1 if it can't, and then the cluster is given up. */
int join(RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), int s, int id, int leader, int head, int round,
	int *first)
{
	int other = PEEK(owners, s);
	if (other >= 0 && PEEK(members, MEMBER(other, MEMBER_OWNER)) == leader)
		return other; /* nobody else takes it away */
	other = int_load(owners, s);
	if (other < 0) {
		other = claim(slots, status, members, active, work, owners, parents, s, leader, head);
		if (other >= 0) {
			*first = heap_insert(members, work, *first, other);
			return other;
		}
		other = int_load(owners, s);
	}
	if (other < 0)
		return -1; /* there are no more numbers */
	int owner = int_load(members, MEMBER(other, MEMBER_OWNER));
	if (owner == leader)
		return other;
	conflict(status, members, active, parents, leader, owner, round);
	if (round - status[STATUS_BEGUN] >= SPREAD_ROUND || members[MEMBER(id, MEMBER_EVENTS)] >= SPREAD_EVENTS)
		spread(LISTS, owners, parents, leader, head, round);
	return -1;
}

/* Adds up what a finished cluster did; of one that is given up nothing counts. */
void cluster_count(LIST_OUT(status), LIST_OUT(members), RECORD_OUT(work), int head, bool finished)
{
	int hits = 0, ruled = 0, held = 0;
	for (int m = head; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
		hits += members[MEMBER(m, MEMBER_HITS)];
		ruled += members[MEMBER(m, MEMBER_RULED)];
		held += CHANNEL(work[WORK_WIDTH * m + WORK_TURN], WORK_HELD) > 0.0f ? 1 : 0;
		if (!finished)
			members[MEMBER(m, MEMBER_HITS)] = members[MEMBER(m, MEMBER_RULED)] = members[MEMBER(m, MEMBER_EVENTS)] = 0;
	}
	if (finished && hits > 0)
		atomic_add(&status[STATUS_HITS], hits);
	if (finished && ruled > 0)
		atomic_add(&status[STATUS_RULED], ruled);
	if (finished && held > 0)
		atomic_add(&status[STATUS_HELD], held);
}

void cluster_run(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach), LIST_OUT(need), TEX_IN(friction),
	LIST_OUT(owners), LIST_OUT(parents), LIST_IN(touching), int leader, int round, float length)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	int head = int_load(members, MEMBER(leader, MEMBER_HEAD));
	int first = -1;
	bool finished = false;
	float2 found_with;
	if (head < 0)
		return; /* another cluster got into the way just now */
	for (int m = head; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
		recall(slots, spans, members, active, found, work, m);
		first = heap_insert(members, work, first, m);
	}
	for (;;) {
		int id = first, other_id = -1;
		float4 next = work[WORK_WIDTH * id + WORK_NEXT];
		int other = (int)CHANNEL(next, NEXT_PARTNER);
		bool is_known = CHANNEL(next, NEXT_TIME) != NEXT_UNKNOWN;
		finished = !(CHANNEL(next, NEXT_TIME) <= 1.0f);
		if (finished)
			break;
		if (is_known && other >= 0 && !slot_is_static(slots, other)) {
			other_id = join(slots, LISTS, work, owners, parents, other, id, leader, head, round, &first);
			if (other_id < 0)
				break;
			is_known = members[MEMBER(other_id, MEMBER_EVENTS)] == members[MEMBER(id, MEMBER_SEEN)];
		}
		found_with = (float2)(0.0f, -1.0f);
		if (is_known)
			answer(VERTICES, TEX(uniforms), TEX(friction), slots, reach, status, members, work, need, touching, rules, active[id], id, other_id, next,
				length);
		/* both look again, or what was not known is looked for: at one place, for this is most of the program, and of the time of a GPU */
		for (int m = id, partner = is_known ? other_id : -1; m >= 0; m = m == id ? partner : -1) {
			look(VERTICES, TEX(uniforms), slots, LISTS, work, owners, rules, m, leader, length, m == id ? partner : id, &found_with);
			first = heap_update(members, work, first, m);
		}
	}
	cluster_count(status, members, work, head, finished);
}

/* Do two changed bodies of different clusters get in each other's way? */
bool ways_meet(VERTICES_IN, RECORD_IN(slots), LIST_OUT(members), __global const float4 *work, float4 rules, int s, int id, int other, int other_id,
	float length)
{
	float4 a = work[WORK_WIDTH * id + WORK_BOX], b = work[WORK_WIDTH * other_id + WORK_BOX];
	float reach = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS) + CHANNEL(SLOT_LOAD(slots, other, SLOT_TURN), TURN_RADIUS);
	if (a.x - reach > b.z || a.z + reach < b.x || a.y - reach > b.w || a.w + reach < b.y)
		return false;
	if (members[MEMBER(id, MEMBER_EVENTS)] > 1 || members[MEMBER(other_id, MEMBER_EVENTS)] > 1)
		return true;
	trajectory k = work_load(work, id), o = work_load(work, other_id);
	bool pause;
	return !stay_apart(disc_of_trajectory(slots, s, k, length), disc_of_trajectory(slots, other, o, length))
		&& pair_time(VERTICES, slots, rules, s, k, other, o, length, 1.0f, &pause) <= 1.0f;
}
