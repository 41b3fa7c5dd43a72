/* How bodies become members of a cluster that is run, and clusters one. */

/* The number of a body as a member of the cluster, else -1: of all others the way counts as the step began. */
int number_of_own(LIST_OUT(members), LIST_IN(owners), int s, int leader)
{
	int id = PEEK(owners, s);
	return id >= 0 && PEEK(members, MEMBER(id, MEMBER_OWNER)) == leader ? id : -1;
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
	int other = number_of_own(members, owners, s, leader);
	if (other >= 0)
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
