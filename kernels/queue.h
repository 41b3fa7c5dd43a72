/* The queue of events of one cluster, run by a team. */

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

/* Numbers of the bodies in the slots, if they have some. */
INLINE ints numbers_of(LIST_IN(owners), ints others)
{
#define NUMBER_OF(one) PEEK(owners, (others)one)
	return (ints)(EACH(NUMBER_OF));
}

/* Of those that are members of the cluster; of the others the indices of their states as the slice began, -1 where that is the step's beginning, too. */
INLINE ints numbers_seen(LIST_IN(status), LIST_OUT(members), LIST_IN(owners), ints others, int leader)
{
#define OWNER_OF(one) PEEK(members, MEMBER((known)one, MEMBER_OWNER))
	ints none = (ints)(-1), ids = numbers_of(owners, others), known = ids < (ints)(0) ? (ints)(0) : ids, theirs = (ints)(EACH(OWNER_OF));
	/* nobody else writes or takes away those that are members */
	ints saved = ((ids >= (ints)(0)) & (ids < (ints)(status[STATUS_SAVED]))) ? ids + (ints)(status[STATUS_NUMBERS]) : none;
	return ((ids >= (ints)(0)) & (theirs == (ints)(leader))) ? ids : saved;
}

/* Of a state that is seen by this index. */
INLINE disc disc_seen(RECORD_IN(slots), RECORD_OUT(work), int other, int id, float length)
{
	__global const float4 *from = id < 0 ? slots + SLOT_WIDTH * other : work + WORK_WIDTH * id;
	float4 turn_record = from[WORK_TURN];
	float time = id < 0 ? 0.0f : CHANNEL(turn_record, WORK_TIME);
	return disc_of(slots, other, from[WORK_PLACE], time, id >= 0 && CHANNEL(turn_record, WORK_HELD) > 0.0f, length);
}

INLINE discs discs_seen(RECORD_IN(slots), RECORD_OUT(work), int s, ints others, ints ids, float length)
{
#define AS_SEEN(one) disc_seen(slots, work, (others)one, (ids)one, length)
	disc all[BUNCH] = {EACH(AS_SEEN)};
	return discs_of(slots, s, others, all);
}

/* The first event of a member, by what is known now, as far as a lane's part of the neighbours goes, the first lane's with the walls. For later steps
 * the pair is the member's, or if both were changed the one's for which it is: so both keep when to look again. Of two that look at once, the partner and it, or one that is
 * none (-1), and of a shock's parties that look one after the other, the later one looks for their hit. */
finding look(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners), float4 rules, int id, int leader,
	float length, int partner, bool is_later, int lane, int lanes)
{
	int s = active[id], wall, seen = 0, end = spans[SPAN(s, SPAN_END)];
	trajectory k = work_load(work, id);
	disc disc_k = disc_of_trajectory(slots, s, k, length);
	bool pause;
	float ahead = steps_ahead(TEX(uniforms), status, length);
	bool clear = lane > 0 || (!(k.held > 0.0f) && is_clear_of_walls(TEX(uniforms), slots, rules, s, k, length, 1.0f + ahead));
	float4 first = (float4)(NO_HIT, 0.0f, 0.0f, 0.0f);
	float again = clear ? 1.0f + ahead : 1.0f, t = clear ? NO_HIT : wall_time(VERTICES, TEX(uniforms), slots, rules, s, k, length, &wall, &pause);
	if (t <= 1.0f)
		first = event_of(slots, s, -1 - wall, t, pause);
	for (int i = bunch_first(spans, extra, s, end, lane); i != -1; i = bunch_next(extra, s, end, i, lane, lanes)) {
		bunch others = bunch_at(neighbours, extra, end, i);
		discs discs_now = discs_at_start(slots, s, others.slots, length); /* nearly always; it need not wait for who they are */
		ints ids = numbers_seen(status, members, owners, others.slots, leader);
		if (IS_ANY(ids >= (ints)(0)))
			discs_now = discs_seen(slots, work, s, others.slots, ids, length);
		floats meetings = others.live ? first_meetings(disc_k, &discs_now, ahead) : (floats)(again);
		again = smaller(again, least_of(meetings));
		if (!IS_ANY(others.live & ((meetings <= (floats)(1.0f)) | (ids >= (ints)(0)))))
			continue;
		for (int n = 0; n < BUNCH;
			 n++, others.slots = TURNED(others.slots), others.live = TURNED(others.live), ids = TURNED(ids), meetings = TURNED(meetings)) {
			int other = FIRST(others.slots), other_id = FIRST(ids),
				events = FIRST(others.live) && other_id >= 0 ? members[MEMBER(other_id, MEMBER_EVENTS)] : 0;
			if (events > 0 && other_id < status[STATUS_NUMBERS])
				wake_before(status, wakes, other, FIRST(meetings));
			float until = smaller(CHANNEL(first, NEXT_TIME), 1.0f);
			if (!FIRST(others.live) || FIRST(meetings) > until)
				continue;
			if (other_id >= 0 && (other_id == partner ? !is_later : members[MEMBER(other_id, MEMBER_SEEN)] < 0))
				continue;
			/* not asked yet by what looks at four, or at more steps than this one */
			if ((BUNCH > 1 || ahead > 0.0f) && stay_apart(disc_k, disc_seen(slots, work, other, other_id, length)))
				continue;
			trajectory o = other_id < 0 ? trajectory_start(slots, other) : work_load(work, other_id);
			t = pair_time(VERTICES, slots, rules, s, k, other, o, length, until, &pause);
			if (!(t <= 1.0f) || t > CHANNEL(first, NEXT_TIME))
				continue;
			float4 next = event_of(slots, s, other, t, pause);
			if (event_before(next, first)) {
				first = next;
				seen = events;
			}
		}
	}
	finding all = {first, again, seen};
	return all;
}

/* The same as the slice begins: it was found before, or is to be looked for before all. */
void recall(RECORD_IN(slots), LIST_IN(spans), LIST_IN(status), LIST_OUT(members), LIST_IN(active), LIST_IN(found), RECORD_OUT(work), int id)
{
	if (saved_index(status, id) >= 0)
		return; /* it is kept */
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

/* Adds up what a finished cluster did; of one that is given up all is lost. */
void cluster_count(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), int head, bool finished)
{
	int hits = 0, ruled = 0, held = 0, lost = 0;
	for (int m = head; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
		hits += members[MEMBER(m, MEMBER_HITS)];
		ruled += members[MEMBER(m, MEMBER_RULED)];
		held += slice_holds(status, work, m) ? 1 : 0;
		if (!finished)
			lost += go_back(slots, status, members, active, work, m);
		else if (!is_last_slice(status, PEEK(status, STATUS_ACTIVE)) && slice_events(members, m) >= PILE_EVENTS)
			members[MEMBER(PEEK(members, MEMBER(m, MEMBER_OWNER)), MEMBER_PILE)] = 1; /* it stays together */
	}
	if (finished && hits > 0)
		atomic_add(&status[STATUS_HITS], hits);
	if (finished && ruled > 0)
		atomic_add(&status[STATUS_RULED], ruled);
	if (finished && held > 0)
		atomic_add(&status[STATUS_HELD], held);
	if (lost > 0)
		atomic_add(&status[STATUS_LOST], lost);
}

/* How many members the cluster has that this number leads in the round, none if it leads none; 3 for more, too. */
int cluster_size(LIST_OUT(members), int leader, int round)
{
	int m = PEEK(members, MEMBER(leader, MEMBER_HEAD)), size = 0;
	if (m >= 0 && int_load(members, MEMBER(leader, MEMBER_ROUND)) != round)
		return 0;
	for (; m >= 0 && size < 3; m = members[MEMBER(m, MEMBER_LINK)])
		size++;
	return size;
}

/* The leaders that a group's lanes find among the numbers from `begin` on, of all groups in turn: those of large clusters first, for these take longest. */
void leaders_gather(LIST_OUT(members), int begin, int end, int round, SHARED crew *all)
{
	int ids[LEADERS_EACH], sizes[LEADERS_EACH];
	for (int k = 0; k < LEADERS_EACH; k++) {
		ids[k] = begin + (k * GROUP_LANES + GROUP_LANE) * GROUP_COUNT;
		sizes[k] = ids[k] < end ? cluster_size(members, ids[k], round) : 0;
	}
	if (GROUP_LANE == 0)
		all->count = all->next = 0;
	for (int large = 1; large >= 0; large--) {
		MEET();
		for (int k = 0; k < LEADERS_EACH; k++)
			if (sizes[k] > 0 && (sizes[k] > 2) == large)
				all->leaders[TAKE(all->count)] = ids[k];
	}
	MEET();
}

/* Has a cluster, by its heap, another event until then? */
bool goes_on(RECORD_OUT(work), int first, float until)
{
	return first >= 0 && CHANNEL(work[WORK_WIDTH * first + WORK_NEXT], NEXT_TIME) <= until;
}

/* Is a hit of these two, the second of which may be none, -1, passed on by joints? */
bool is_tug(LIST_IN(status), LIST_IN(active), LIST_IN(touching), int id, int other_id, const answered *what)
{
	if (!status[STATUS_BORNE] || !(what->hit.total > 0.0f))
		return false;
	return touching[TOUCH(active[id], TOUCHING_FIRM)] > 0 || (other_id >= 0 && touching[TOUCH(active[other_id], TOUCHING_FIRM)] > 0);
}

/* Passes it on, from the row body if that is dynamic; false if the cluster has to be given up. */
bool cluster_tug(TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach), LIST_OUT(need), LIST_OUT(owners),
	LIST_OUT(parents), RECORD_OUT(hits), RECORD_OUT(shocks), LIST_IN(touching), RECORD_IN(contacts), int id, int other_id, int partner,
	const answered *what, shock *all, int *first)
{
	int s = active[id], own = slot_body(slots, s), others = partner < 0 ? partner : slot_body(slots, partner);
	bool is_row = own > others, is_first = is_row || other_id < 0;
	float sign = is_row == is_first ? 1.0f : -1.0f;
	struck hit = {s, partner < 0 ? PARTNER_WALL(-1 - partner) : partner, what->own, what->other, what->hit.where.xy,
		(float2)(sign * what->hit.where.z, sign * what->hit.where.w), (float2)(sign * what->impulse.x, sign * what->impulse.y),
		friction_of(TEX(uniforms), TEX(friction), own, max(others, -1))};
	if (!is_first) {
		hit.one = partner;
		hit.other = s;
		hit.before = what->other;
		hit.other_before = what->own;
	}
	if (!tug_spread(slots, LISTS, work, owners, parents, shocks, touching, contacts, is_first ? id : other_id, is_first ? other_id : id, &hit, all,
			first))
		return false;
	tug_end(slots, reach, status, members, active, work, need, hits, shocks, id, sign, &hit, all);
	return true;
}

/* Answers the first event of a cluster. Who is to look then: both parties, whom it changed, or the one whose event was not known, or two of a shock's, and others from *party
 * on; nobody where the cluster is given up. */
int2 cluster_answer(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach), LIST_OUT(need), TEX_IN(friction),
	LIST_OUT(owners), LIST_OUT(parents), RECORD_OUT(hits), RECORD_OUT(shocks), LIST_IN(touching), RECORD_IN(contacts), float4 rules, int leader,
	int head, int round, float length, int *first, int *party)
{
	int id = *first, other_id = -1;
	float4 next = work[WORK_WIDTH * id + WORK_NEXT];
	int other = (int)CHANNEL(next, NEXT_PARTNER);
	bool is_known = CHANNEL(next, NEXT_TIME) != NEXT_UNKNOWN;
	if (is_known && other >= 0 && slot_is_dynamic(slots, other)) {
		other_id = join(slots, LISTS, work, owners, parents, other, id, leader, head, round, first);
		if (other_id < 0)
			return (int2)(LOOKS_LATER, LOOKS_NOT);
		is_known = members[MEMBER(other_id, MEMBER_EVENTS)] == members[MEMBER(id, MEMBER_SEEN)];
	}
	if (!is_known)
		return (int2)(id, LOOKS_NOT);
	answered what;
	bool shocks_others = answer(VERTICES, TEX(uniforms), TEX(friction), slots, reach, status, members, work, need, hits, rules, active[id], id,
		other_id, next, length, &what);
	bool tugs = !shocks_others && is_tug(status, active, touching, id, other_id, &what);
	if (!shocks_others && !tugs)
		return (int2)(id, other_id);
	shock all;
	shock_begin(TEX(uniforms), CHANNEL(next, NEXT_TIME), leader, head, round, length, &all);
	if (tugs) {
		if (!cluster_tug(TEX(uniforms), TEX(friction), slots, LISTS, work, reach, need, owners, parents, hits, shocks, touching, contacts, id,
				other_id, other, &what, &all, first))
			return (int2)(LOOKS_LATER, LOOKS_NOT);
	} else {
		bool in_order = other_id < 0 || slot_body(slots, active[id]) > slot_body(slots, other);
		if (!shock_spread(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, work, owners, parents, shocks, in_order ? id : other_id,
				in_order ? other_id : id, &all, first))
			return (int2)(LOOKS_LATER, LOOKS_NOT);
		shock_end(slots, reach, status, members, active, work, need, hits, shocks, &all);
	}
	*party = all.first;
	return parties_take(members, party);
}

/* Runs the clusters of `all`. A team's first lane does what is done one after the other; all look. */
void clusters_run(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach), LIST_OUT(need), TEX_IN(friction),
	LIST_OUT(owners), LIST_OUT(parents), RECORD_OUT(hits), RECORD_OUT(shocks), LIST_IN(touching), RECORD_IN(contacts), int round, int lanes,
	float length, SHARED crew *all)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	float until = slice_end(status, status[STATUS_SLICE]);
	int lane = GROUP_LANE % lanes, teams = GROUP_LANES / lanes, each = max(lanes / 2, 1); /* lanes for one that looks */
	SHARED int *looks = all->looks[GROUP_LANE / lanes];
	SHARED finding *findings = &all->findings[GROUP_LANE - lane];
	int leader = -1, head = -1, first = -1; /* of the first lane's cluster, */
	int party = -1;                         /* and of its last event, if that was a shock, the first that has not looked again */
	for (;;) {
		while (lane == 0 && party < 0 && !goes_on(work, first, until)) {
			int k = TAKE(all->next);
			if (head >= 0)
				cluster_count(slots, status, members, active, work, head, first >= 0);
			head = first = -1;
			if (k >= all->count)
				break;
			leader = all->leaders[k];
			head = int_load(members, MEMBER(leader, MEMBER_HEAD)); /* -1: another cluster got into the way just now */
			if (!is_complete(slots, LISTS, work, owners, parents, leader, head, round))
				continue;
			for (int m = head; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
				FETCH(reach + active[m]); /* to be asked when it was hit */
				recall(slots, spans, status, members, active, found, work, m);
				first = heap_insert(members, work, first, m);
			}
		}
		if (lane == 0) {
			int2 who = (int2)(LOOKS_NO_MORE, LOOKS_NOT);
			if (party >= 0)
				who = parties_take(members, &party);
			else if (first >= 0)
				who = cluster_answer(VERTICES, TEX(uniforms), slots, LISTS, work, reach, need, TEX(friction), owners, parents, hits, shocks, touching,
					contacts, rules, leader, head, round, length, &first, &party);
			if (who.x == LOOKS_LATER)
				first = -1;
			looks[0] = who.x;
			looks[1] = who.y;
		}
		MEET();
		bool over = true;
		for (int k = 0; k < teams; k++)
			over = over && all->looks[k][0] == LOOKS_NO_MORE;
		if (over)
			break;
		/* at one place, for this is most of the program, and of the time of a GPU */
		for (int k = lane & 1; k < 2; k += min(lanes, 2))
			if (looks[k] >= 0)
				findings[lanes > 1 ? lane : k] = look(VERTICES, TEX(uniforms), slots, LISTS, work, owners, rules, looks[k],
					PEEK(members, MEMBER(looks[k], MEMBER_OWNER)), length, looks[1 - k], k > 0, lane / 2, each);
		team_reduce(all, lane, lanes);
		for (int k = 0; k < 2 && lane == 0; k++) {
			int id = looks[k];
			if (id < 0)
				break;
			wakes[WAKE(active[id], WAKE_NEXT)] = step_of(status, findings[k].again);
			work[WORK_WIDTH * id + WORK_NEXT] = findings[k].first;
			members[MEMBER(id, MEMBER_SEEN)] = findings[k].seen;
			first = heap_update(members, work, first, id);
		}
	}
	MEET(); /* all have seen that it is over */
}

/* While one number's turn is, what those after it look at is fetched: neighbours up to that field of their spans. Not of few numbers, for that is in
 * caches, nor in a later round of a step, where most have no turn. */
INLINE void fetch_active(RECORD_IN(slots), LISTS_IN, LIST_IN(owners), int id, int count, int round, int end)
{
	if (BUNCH == 1 || count < 4096 || status[STATUS_BEGUN] != round)
		return;
	int next = id + 2 < count ? active[id + 2] : -1, far = id + 4 < count ? active[id + 4] : -1, farther = id + 6 < count ? active[id + 6] : -1;
	if (farther >= 0)
		fetch_span(slots, spans, extra, farther);
	if (far >= 0)
		fetch_list(spans, neighbours, far);
	if (next >= 0)
		fetch_neighbours(slots, spans, neighbours, owners, wakes, next, spans[SPAN(next, end)]);
}

/* What comes of two bodies that different clusters changed in the slice. */
#define MEETING_NONE 0
#define MEETING_LATER 1 /* they hit after it */
#define MEETING_NOW 2   /* they get in each other's way */

int meeting(VERTICES_IN, RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), RECORD_OUT(work), float4 rules, int s, int id, int other, int other_id,
	float length)
{
	float4 a = work[WORK_WIDTH * id + WORK_BOX], b = work[WORK_WIDTH * other_id + WORK_BOX];
	float reach = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS) + CHANNEL(SLOT_LOAD(slots, other, SLOT_TURN), TURN_RADIUS);
	float until = slice_end(status, status[STATUS_SLICE]);
	bool meet = !(a.x - reach > b.z || a.z + reach < b.x || a.y - reach > b.w || a.w + reach < b.y), pause;
	if (!meet && !(until < 1.0f))
		return MEETING_NONE;
	if (meet && (slice_events(members, id) > 1 || slice_events(members, other_id) > 1))
		return MEETING_NOW;
	trajectory k = work_load(work, id), o = work_load(work, other_id);
	if (stay_apart(disc_of_trajectory(slots, s, k, length), disc_of_trajectory(slots, other, o, length)))
		return MEETING_NONE;
	float t = pair_time(VERTICES, slots, rules, s, k, other, o, length, 1.0f, &pause);
	return t <= until ? MEETING_NOW : t <= 1.0f ? MEETING_LATER : MEETING_NONE;
}

/* Looks whether a number that a cluster has changed in this round meets what others changed. */
void number_check(VERTICES_IN, RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners), LIST_OUT(parents), float4 rules, int id, int round,
	float length)
{
	int s = active[id], owner = members[MEMBER(id, MEMBER_OWNER)];
	if (s < 0 || owner < 0 || slice_events(members, id) == 0 || PEEK(members, MEMBER(owner, MEMBER_ROUND)) != round)
		return;
	/* Of a pair that was changed in the slice one at least was done in this round, and finds the other; in the first round both were, and one look is enough. What was changed
	 * in an earlier slice finds nobody any more. */
	int end = spans[SPAN(s, status[STATUS_BEGUN] == round && !status[STATUS_SAVED] ? SPAN_HALF : SPAN_END)];
	for (int k = bunch_first(spans, extra, s, end, 0); k != -1; k = bunch_next(extra, s, end, k, 0, 1)) {
		bunch others = bunch_at(neighbours, extra, end, k);
		ints ids = others.live ? numbers_of(owners, others.slots) : (ints)(-1);
		if (!IS_ANY(ids >= (ints)(0)))
			continue;
		for (int n = 0; n < BUNCH; n++, others.slots = TURNED(others.slots), ids = TURNED(ids)) {
			int other = FIRST(others.slots), other_id = FIRST(ids);
			if (other_id < 0 || members[MEMBER(other_id, MEMBER_EVENTS)] == 0)
				continue;
			int theirs = members[MEMBER(other_id, MEMBER_OWNER)];
			if (theirs == owner || (theirs >= 0 && PEEK(members, MEMBER(theirs, MEMBER_ROUND)) > round))
				continue;
			int what = slice_events(members, other_id) > 0 ? meeting(VERTICES, slots, status, members, work, rules, s, id, other, other_id, length)
														   : MEETING_NONE;
			if (what == MEETING_NOW)
				conflict(status, members, active, parents, owner, theirs, round);
			if (what == MEETING_LATER)
				CHANNEL(work[WORK_WIDTH * id + WORK_NEXT], NEXT_TIME) = NEXT_UNKNOWN;
			atomic_xchg(&wakes[WAKE(s, WAKE_NEXT)], status[STATUS_AGE] + 1); /* neither knew of the other's change */
			atomic_xchg(&wakes[WAKE(other, WAKE_NEXT)], status[STATUS_AGE] + 1);
		}
	}
}
