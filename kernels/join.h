/* How bodies become members of a cluster that is run, and clusters one. */

/* The number of a body as a member of the cluster, else -1: of all others the way counts as the step began. */
int number_of_own(LIST_OUT(members), LIST_IN(owners), int s, int leader)
{
	int id = PEEK(owners, s);
	return id >= 0 && PEEK(members, MEMBER(id, MEMBER_OWNER)) == leader ? id : -1;
}

/* The same, or the index of its state as the slice began; -1 where that is the step's beginning, too. */
int number_seen(LIST_IN(status), LIST_OUT(members), LIST_IN(owners), int s, int leader)
{
	int id = number_of_own(members, owners, s, leader);
	return id >= 0 ? id : saved_index(status, PEEK(owners, s));
}

/* The body in slot s, which has no number, gets one and is the cluster's; -1 if somebody else was before, or there are no more. */
int give_number(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_OUT(active), RECORD_OUT(work), LIST_OUT(owners), int s, int leader)
{
	int id = atomic_inc(&status[STATUS_ACTIVE]);
	if (id >= status[STATUS_NUMBERS])
		return -1;
	active[id] = s;
	atomic_xchg(&members[MEMBER(id, MEMBER_OWNER)], leader);
	work_begin(slots, members, work, s, id);
	mem_fence(CLK_GLOBAL_MEM_FENCE);
	if (atomic_cmpxchg(&owners[s], -1, id) == -1)
		return id;
	active[id] = -1;
	member_reset(members, id);
	return -1;
}

/* The cluster owns the body in slot s from now on, if nobody else does: its number, or -1, also if there are no more. It comes behind a member in the list. */
int claim(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_OUT(active), RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), int s,
	int leader, int before)
{
	int id = int_load(owners, s);
	if (id < 0)
		id = give_number(slots, status, members, active, work, owners, s, leader);
	else if (atomic_cmpxchg(&members[MEMBER(id, MEMBER_OWNER)], -1, leader) != -1)
		id = -1;
	if (id < 0)
		return -1;
	atomic_xchg(&parents[s], active[leader]);
	members[MEMBER(id, MEMBER_LINK)] = members[MEMBER(before, MEMBER_LINK)];
	members[MEMBER(before, MEMBER_LINK)] = id;
	return id;
}

/* Whose cluster the body in a slot is in; `nobodys` if it is in none. */
int cluster_of(LIST_OUT(members), LIST_OUT(owners), int s, int nobodys)
{
	int id = int_load(owners, s), owner = id < 0 ? -1 : int_load(members, MEMBER(id, MEMBER_OWNER));
	return owner < 0 ? nobodys : owner;
}

/* All the clusters around this one are one with it in the next round. */
void spread(LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), int leader, int head, int round)
{
	for (int m = head; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
		int s = active[m], end = spans[SPAN(s, SPAN_END)];
		for (int k = first_neighbour(spans, extra, s, end); k != -1; k = next_neighbour(extra, s, end, k)) {
			int owner = cluster_of(members, owners, neighbour_of(neighbours, extra, k), leader);
			if (owner != leader)
				conflict(status, members, active, parents, leader, owner, round);
		}
	}
}

/* Are two bodies, the second a dynamic one, so near as the step begins that a cluster in a pile that has one takes the other? */
bool is_near(RECORD_IN(slots), int s, int other)
{
	float4 a = SLOT_LOAD(slots, s, SLOT_PLACE), b = SLOT_LOAD(slots, other, SLOT_PLACE);
	float r = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS), other_r = CHANNEL(SLOT_LOAD(slots, other, SLOT_TURN), TURN_RADIUS);
	float2 between = (float2)(CHANNEL(b, LINEAR_X) - CHANNEL(a, LINEAR_X), CHANNEL(b, LINEAR_Y) - CHANNEL(a, LINEAR_Y));
	float reach = (r + other_r) + PILE_GAP * smaller(r, other_r);
	return slot_is_dynamic(slots, other) && inner(between, between) < reach * reach;
}

/* What is near to a cluster, if it lies in a pile, becomes its own before it is run, as long as there are numbers enough for what is hit. False: other clusters have some of it,
 * and are one with this in the next round. */
bool is_complete(RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), int leader, int head, int round)
{
	int most = status[STATUS_NUMBERS] - min(status[STATUS_NUMBERS] / 4, NUMBERS_SPARE / 2), piled = head;
	bool alone = true;
	while (piled >= 0 && !members[MEMBER(piled, MEMBER_PILE)])
		piled = members[MEMBER(piled, MEMBER_LINK)];
	if (piled >= 0)
		members[MEMBER(leader, MEMBER_PILE)] = 1;
	for (int m = piled >= 0 ? head : -1; m >= 0; m = members[MEMBER(m, MEMBER_LINK)]) {
		int s = active[m], end = spans[SPAN(s, SPAN_END)];
		for (int k = first_neighbour(spans, extra, s, end); k != -1; k = next_neighbour(extra, s, end, k)) {
			int other = neighbour_of(neighbours, extra, k);
			if (!is_near(slots, s, other))
				continue;
			if (cluster_of(members, owners, other, -1) < 0 && (PEEK(owners, other) >= 0 || PEEK(status, STATUS_ACTIVE) < most))
				claim(slots, status, members, active, work, owners, parents, other, leader, m);
			int owner = cluster_of(members, owners, other, leader);
			if (owner != leader) {
				conflict(status, members, active, parents, leader, owner, round);
				alone = false;
			}
		}
	}
	return alone;
}

/* The number of the body in a slot as a member of the cluster, which it becomes if it is nobody's; -1 if it can't, and then the cluster is given up. */
int join(RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), int s, int id, int leader, int head, int round,
	int *first)
{
	int other = number_of_own(members, owners, s, leader);
	if (other >= 0)
		return other; /* nobody else takes it away */
	other = claim(slots, status, members, active, work, owners, parents, s, leader, head);
	if (other >= 0) {
		*first = heap_insert(members, work, *first, other);
		return other;
	}
	other = int_load(owners, s);
	if (other < 0) {
		atomic_or(&status[STATUS_LEFT], 1); /* so many numbers were lost: the step begins again */
		return -1;
	}
	int owner = int_load(members, MEMBER(other, MEMBER_OWNER));
	if (owner == leader)
		return other;
	conflict(status, members, active, parents, leader, owner, round);
	if (slice_events(members, id) >= PILE_EVENTS)
		members[MEMBER(leader, MEMBER_PILE)] = 1;
	if (round - status[STATUS_BEGUN] >= SPREAD_ROUND)
		spread(LISTS, owners, parents, leader, head, round);
	return -1;
}
