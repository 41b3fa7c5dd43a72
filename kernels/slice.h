/* The slices of a step: what is kept of one for the next, and the way back to it. */

/* The state of a number as the slice began, as an index of Work and Members behind the numbers; -1 if the number was given since. */
INLINE int saved_index(LIST_IN(status), int id)
{
	return id >= 0 && id < status[STATUS_SAVED] ? status[STATUS_NUMBERS] + id : -1;
}

/* A number's events in the slice. */
INLINE int slice_events(LIST_OUT(members), int id)
{
	return members[MEMBER(id, MEMBER_EVENTS)] - members[MEMBER(id, MEMBER_BEGUN)];
}

bool is_held(RECORD_OUT(work), int index)
{
	return index >= 0 && CHANNEL(work[WORK_WIDTH * index + WORK_TURN], WORK_HELD) > 0.0f;
}

/* Was it an event of the slice that held the number? */
bool slice_holds(LIST_IN(status), RECORD_OUT(work), int id)
{
	return is_held(work, id) && !is_held(work, saved_index(status, id));
}

/* What of a number comes from one index to another: all that events change, but for the hits that they count. */
void state_copy(LIST_OUT(members), RECORD_OUT(work), int from, int to)
{
	for (int k = 0; k < WORK_WIDTH; k++)
		work[WORK_WIDTH * to + k] = work[WORK_WIDTH * from + k];
	members[MEMBER(to, MEMBER_STUCK)] = members[MEMBER(from, MEMBER_STUCK)];
	members[MEMBER(to, MEMBER_EVENTS)] = members[MEMBER(from, MEMBER_EVENTS)];
	members[MEMBER(to, MEMBER_RAPID)] = members[MEMBER(from, MEMBER_RAPID)];
	members[MEMBER(to, MEMBER_SEEN)] = members[MEMBER(from, MEMBER_SEEN)];
	members[MEMBER(to, MEMBER_KEPT)] = members[MEMBER(from, MEMBER_KEPT)];
}

/* The number is as when the slice began; how many events are lost. */
int go_back(RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), int id)
{
	int saved = saved_index(status, id), events = slice_events(members, id);
	if (saved < 0) {
		work_begin(slots, members, work, active[id], id);
		return events;
	}
	state_copy(members, work, saved, id);
	members[MEMBER(id, MEMBER_HITS)] = members[MEMBER(id, MEMBER_RULED)] = 0;
	return events;
}

/* The number of the body that a number is to hit, -1 if that has none. */
int partner_number(LIST_IN(owners), RECORD_OUT(work), int id)
{
	int partner = (int)CHANNEL(work[WORK_WIDTH * id + WORK_NEXT], NEXT_PARTNER);
	return partner < 0 ? -1 : owners[partner];
}

/* A number is kept as it is, and leaves its cluster, unless that lies in a pile: it is nobody's in the slice that begins if it hits nothing before that ends. False if an event has
 * it leave its reach by then. */
bool number_release(RECORD_IN(slots), RECORD_IN(reach), LIST_IN(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_OUT(need),
	LIST_IN(owners), LIST_OUT(parents), int id, float until, int round, float length)
{
	__global float4 *record = work + WORK_WIDTH * id;
	float4 way;
	bool stays = members[MEMBER(id, MEMBER_EVENTS)] == 0 || way_until(slots, reach, need, active[id], work_load(work, id), until, 0.0f, length, &way);
	bool hits = CHANNEL(record[WORK_NEXT], NEXT_TIME) <= until;
	int other_id = hits ? partner_number(owners, work, id) : -1;
	if (other_id >= 0 && members[MEMBER(other_id, MEMBER_EVENTS)] != members[MEMBER(id, MEMBER_SEEN)])
		CHANNEL(record[WORK_NEXT], NEXT_TIME) = NEXT_UNKNOWN; /* what it saw is over */
	record[WORK_BOX] = BOX_EMPTY;
	int owner = members[MEMBER(id, MEMBER_OWNER)];
	if (owner < 0 || !members[MEMBER(owner, MEMBER_PILE)])
		owner = hits ? id : -1;
	members[MEMBER(id, MEMBER_OWNER)] = owner;
	members[MEMBER(id, MEMBER_ROUND)] = owner == id ? round : 0;
	members[MEMBER(id, MEMBER_HEAD)] = -1;
	members[MEMBER(id, MEMBER_BEGUN)] = members[MEMBER(id, MEMBER_EVENTS)];
	members[MEMBER(id, MEMBER_HITS)] = members[MEMBER(id, MEMBER_RULED)] = 0; /* the step's are counted */
	parents[active[id]] = active[owner < 0 ? id : owner];
	state_copy(members, work, id, status[STATUS_NUMBERS] + id);
	return stays;
}

/* Two that hit each other in the slice that begins are in one cluster, and with a pile those that it hits in the step. */
void number_pair(LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_IN(owners), LIST_OUT(parents), int id)
{
	float time = CHANNEL(work[WORK_WIDTH * id + WORK_NEXT], NEXT_TIME);
	if (members[MEMBER(id, MEMBER_OWNER)] < 0 || time == NEXT_UNKNOWN || !(time <= 1.0f))
		return;
	int other_id = partner_number(owners, work, id);
	if (other_id >= 0 && members[MEMBER(other_id, MEMBER_OWNER)] >= 0)
		unite(parents, active[id], active[other_id]);
}

/* A number of a cluster that is to be done, or done again, comes to the root of its union. */
void number_muster(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_IN(owners), LIST_IN(parents),
	int id)
{
	int root_slot = active[id], hits = members[MEMBER(id, MEMBER_HITS)], ruled = members[MEMBER(id, MEMBER_RULED)];
	bool held = slice_events(members, id) > 0 && slice_holds(status, work, id);
	int lost = go_back(slots, status, members, active, work, id);
	while (parents[root_slot] != root_slot) /* nobody changes that now */
		root_slot = parents[root_slot];
	int root = owners[root_slot];
	if (hits > 0)
		atomic_sub(&status[STATUS_HITS], hits);
	if (ruled > 0)
		atomic_sub(&status[STATUS_RULED], ruled);
	if (held)
		atomic_dec(&status[STATUS_HELD]);
	if (lost > 0)
		atomic_add(&status[STATUS_LOST], lost);
	members[MEMBER(id, MEMBER_OWNER)] = root;
	members[MEMBER(id, MEMBER_LINK)] = atomic_xchg(&members[MEMBER(root, MEMBER_HEAD)], id);
}
