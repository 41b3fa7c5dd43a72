/* All the hits of a step: bodies that hit form clusters, and each cluster is a queue of events that one work-item runs. */

__kernel void events_seek(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), int4 domain)
{
	__local int wanted[GROUP_MOST], first[2], awake[SEEK_EACH * GROUP_MOST], pairs[2 * PAIRS_MOST], awake_count, pair_count;
	int local_id = get_local_id(0), lanes = get_local_size(0), slots_each = (domain.w - 1) / (int)get_global_size(0) + 1;
	int begin = (int)get_group_id(0) * (slots_each * lanes);
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	bool begins = length > 0.0f && lists_are_good(status) && !forces_are_wanted(status) && !status[STATUS_UNDER_WAY];
	int end = begins ? min(begin + slots_each * lanes, domain.w) : 0;
	seeds all;
	all.count = 0;
	if (local_id == 0)
		awake_count = pair_count = 0;
	if (begins && get_global_id(0) == 0)
		status[STATUS_BEGUN] = domain.z;
	barrier(CLK_LOCAL_MEM_FENCE);
	for (int s = begin + local_id; s < end; s += lanes)
		if (is_awake(slots, LISTS, s))
			awake[atomic_inc(&awake_count)] = s;
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
	for (int k = local_id; k < awake_count; k += lanes) {
		fetch_awake(slots, LISTS, owners, awake, k, awake_count);
		seek(VERTICES, TEX(uniforms), slots, LISTS, owners, parents, awake[k], length, domain.z, &all, pairs, &pair_count);
	}
	barrier(CLK_LOCAL_MEM_FENCE);
	for (int k = local_id; k < min(pair_count, PAIRS_MOST); k += lanes)
		seek_pair(VERTICES, slots, LISTS, owners, parents, rules, pairs[2 * k], pairs[2 * k + 1], length, domain.z, &all);
	wanted[local_id] = seeds_take(owners, &all);
	barrier(CLK_LOCAL_MEM_FENCE);
	if (local_id == 0)
		seeds_count(status, group_sum(wanted), first, domain.z);
	barrier(CLK_LOCAL_MEM_FENCE);
	if (all.count > 0)
		seeds_keep(LISTS, owners, &all, first[0] + wanted[local_id] % SEEDS_NUMBER, first[1] + wanted[local_id] / SEEDS_NUMBER, domain.z);
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
		if (members[MEMBER(id, MEMBER_RULED)] > 0)
			atomic_sub(&status[STATUS_RULED], members[MEMBER(id, MEMBER_RULED)]);
		if (members[MEMBER(id, MEMBER_EVENTS)] > 0 && CHANNEL(work[WORK_WIDTH * id + WORK_TURN], WORK_HELD) > 0.0f)
			atomic_dec(&status[STATUS_HELD]);
		work_begin(slots, members, work, active[id], id);
		members[MEMBER(id, MEMBER_OWNER)] = root;
		members[MEMBER(id, MEMBER_LINK)] = atomic_xchg(&members[MEMBER(root, MEMBER_HEAD)], id);
	}
}

__kernel void events_resolve(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach),
	LIST_OUT(need), TEX_IN(friction), LIST_OUT(owners), LIST_OUT(parents), LIST_IN(touching), RECORD_OUT(hits), RECORD_OUT(shocks), int4 domain)
{
	if (PEEK(status, STATUS_ROUND) < domain.z)
		return;
	SHARED crew all;
	int seeds = status[STATUS_SEEDS];
	float length = step_length(TEX(uniforms), TEX(clock));
	for (int begin = GROUP_INDEX; begin < seeds; begin += LEADERS_EACH * GROUP_LANES * GROUP_COUNT) {
		fetch_active(slots, LISTS, owners, begin, seeds, domain.z, SPAN_END);
		leaders_gather(members, begin, seeds, domain.z, &all);
		clusters_run(VERTICES, TEX(uniforms), slots, LISTS, work, reach, need, TEX(friction), owners, parents, touching, hits, shocks, domain.z,
			TEAM_SIZE(domain.w), length, &all);
	}
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
		fetch_active(slots, LISTS, owners, id, count, domain.z, SPAN_HALF);
		int s = active[id], owner = members[MEMBER(id, MEMBER_OWNER)];
		/* of a pair one at least was done in this round, and finds the other; in the first round both were, and one look is enough */
		if (s < 0 || members[MEMBER(id, MEMBER_EVENTS)] == 0 || PEEK(members, MEMBER(owner, MEMBER_ROUND)) != domain.z)
			continue;
		int end = spans[SPAN(s, status[STATUS_BEGUN] == domain.z ? SPAN_HALF : SPAN_END)];
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
				if (theirs == owner || PEEK(members, MEMBER(theirs, MEMBER_ROUND)) > domain.z)
					continue;
				if (ways_meet(VERTICES, slots, members, work, rules, s, id, other, other_id, length))
					conflict(status, members, active, parents, owner, theirs, domain.z);
				atomic_xchg(&wakes[WAKE(s, WAKE_NEXT)], status[STATUS_AGE] + 1); /* neither knew of the other's change */
				atomic_xchg(&wakes[WAKE(other, WAKE_NEXT)], status[STATUS_AGE] + 1);
			}
		}
	}
}
