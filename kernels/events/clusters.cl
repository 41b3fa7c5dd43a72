/* All the hits of a step: bodies that hit form clusters, and each cluster is a queue of events that one work-item runs. */

__kernel void events_seek(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), int4 domain)
{
	int s = get_global_id(0), wall;
	bool pause;
	float length = step_length(TEX(uniforms), TEX(clock));
	if (s >= domain.x || !(length > 0.0f) || !lists_are_good(status) || status[STATUS_UNDER_WAY])
		return;
	if (s == 0)
		status[STATUS_BEGUN] = domain.z;
	if (status[STATUS_AGE] == 0)
		wakes[WAKE(s, WAKE_CHANGED)] = 0;
	else if (wakes[WAKE(s, WAKE_NEXT)] > status[STATUS_AGE])
		return;
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	trajectory k = trajectory_start(slots, s);
	float ahead = steps_ahead(TEX(uniforms), status, length);
	bool clear = is_clear_of_walls(TEX(uniforms), slots, rules, s, k, length, 1.0f + ahead);
	wakes[WAKE(s, WAKE_NEXT)] = step_of(status, clear ? 1.0f + ahead : 1.0f);
	float t = clear ? NO_HIT : wall_time(VERTICES, TEX(uniforms), slots, rules, s, k, length, &wall, &pause);
	if (t <= 1.0f)
		activate(LISTS, owners, s, -1 - wall, t, pause, domain.z);
	seek_neighbours(VERTICES, slots, LISTS, owners, parents, rules, s, k, length, ahead, domain.z);
}

__kernel void events_muster(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_IN(owners),
	LIST_IN(parents), int4 domain)
{
	if (status[STATUS_ROUND] != domain.z)
		return;
	int count = min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	if (get_global_id(0) == 0)
		status[STATUS_SEEDS] = count;
	for (int id = get_global_id(0); id < count; id += get_global_size(0)) {
		if (active[id] < 0 || members[MEMBER(members[MEMBER(id, MEMBER_OWNER)], MEMBER_ROUND)] != domain.z)
			continue;
		int root_slot = active[id];
		while (parents[root_slot] != root_slot) /* nobody changes that now */
			root_slot = parents[root_slot];
		int root = owners[root_slot];
		if (members[MEMBER(id, MEMBER_HITS)] > 0)
			atomic_sub(&status[STATUS_HITS], members[MEMBER(id, MEMBER_HITS)]);
		if (members[MEMBER(id, MEMBER_EVENTS)] > 0 && CHANNEL(work[WORK_WIDTH * id + WORK_TURN], WORK_HELD) > 0.0f)
			atomic_dec(&status[STATUS_HELD]);
		work_begin(slots, members, work, active[id], id);
		members[MEMBER(id, MEMBER_OWNER)] = root;
		members[MEMBER(id, MEMBER_LINK)] = atomic_xchg(&members[MEMBER(root, MEMBER_HEAD)], id);
	}
}

__kernel void events_resolve(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach),
	LIST_OUT(need), LIST_OUT(owners), LIST_OUT(parents), int4 domain)
{
	if (PEEK(status, STATUS_ROUND) < domain.z)
		return;
	int seeds = status[STATUS_SEEDS];
	float length = step_length(TEX(uniforms), TEX(clock));
	for (int id = get_global_id(0); id < seeds; id += get_global_size(0))
		if (PEEK(members, MEMBER(id, MEMBER_HEAD)) >= 0 && int_load(members, MEMBER(id, MEMBER_ROUND)) == domain.z)
			cluster_run(VERTICES, TEX(uniforms), slots, LISTS, work, reach, need, owners, parents, id, domain.z, length);
}

/* Clusters must not meet: bodies of two of them that were changed are looked at as they are now. */
__kernel void events_check(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_IN(work), LIST_IN(owners),
	LIST_OUT(parents), int4 domain)
{
	if (PEEK(status, STATUS_ROUND) < domain.z)
		return;
	int count = min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	for (int id = get_global_id(0); id < count; id += get_global_size(0)) {
		int s = active[id], owner = members[MEMBER(id, MEMBER_OWNER)];
		/* of a pair one at least was done in this round, and finds the other; in the first round both were, and one look is enough */
		if (s < 0 || members[MEMBER(id, MEMBER_EVENTS)] == 0 || PEEK(members, MEMBER(owner, MEMBER_ROUND)) != domain.z)
			continue;
		int end = spans[SPAN(s, status[STATUS_BEGUN] == domain.z ? SPAN_HALF : SPAN_END)];
		for (int k = first_neighbour(spans, extra, s, end); k != -1; k = next_neighbour(extra, s, end, k)) {
			int other = neighbour_of(neighbours, extra, k), other_id = owners[other];
			if (other_id < 0 || members[MEMBER(other_id, MEMBER_EVENTS)] == 0)
				continue;
			int theirs = members[MEMBER(other_id, MEMBER_OWNER)];
			if (theirs == owner || PEEK(members, MEMBER(theirs, MEMBER_ROUND)) > domain.z)
				continue;
			if (ways_meet(VERTICES, slots, members, work, rules, s, id, other, other_id, length))
				conflict(status, members, active, parents, owner, theirs, domain.z);
			atomic_xchg(&wakes[WAKE(s, WAKE_NEXT)], status[STATUS_AGE] + 1); /* neither knew of the other's change */
			atomic_xchg(&wakes[WAKE(other, WAKE_NEXT)], status[STATUS_AGE] + 1);
		}
	}
}
