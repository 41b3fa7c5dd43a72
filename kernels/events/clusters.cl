/* All the hits of a step: bodies that hit form clusters, and each cluster is a queue of events that one work-item runs. */

__kernel void events_seek(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents),
	LIST_IN(touching), int4 domain)
{
	__local int wanted[GROUP_MOST], first[2], awake[SEEK_EACH * GROUP_MOST], pairs[2 * PAIRS_MOST], awake_count, pair_count;
	int local_id = get_local_id(0), lanes = get_local_size(0), slots_each = (domain.w - 1) / (int)get_global_size(0) + 1;
	int begin = (int)get_group_id(0) * (slots_each * lanes);
	float length = step_length(TEX(uniforms), TEX(clock));
	bool begins = length > 0.0f && lists_are_good(status) && !forces_are_wanted(status) && !status[STATUS_UNDER_WAY];
	int end = begins ? min(begin + slots_each * lanes, domain.w) : 0;
	seeds all;
	all.count = 0;
	if (local_id == 0)
		awake_count = pair_count = 0;
	if (begins && get_global_id(0) == 0)
		status[STATUS_BEGUN] = domain.z, status[STATUS_SLICE] = status[STATUS_SAVED] = 0;
	barrier(CLK_LOCAL_MEM_FENCE);
	for (int s = begin + local_id; s < end; s += lanes)
		if (is_awake(slots, LISTS, s))
			awake[atomic_inc(&awake_count)] = s;
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
	for (int k = local_id; k < awake_count; k += lanes) {
		fetch_awake(slots, LISTS, owners, awake, k, awake_count);
		seek(VERTICES, TEX(uniforms), slots, LISTS, owners, parents, touching, awake[k], length, domain.z, &all, pairs, &pair_count);
	}
	barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
	seek_kept(VERTICES, TEX(uniforms), slots, LISTS, owners, parents, pairs, pair_count, length, domain.z, &all);
	wanted[local_id] = seeds_take(owners, &all);
	barrier(CLK_LOCAL_MEM_FENCE);
	if (local_id == 0)
		seeds_count(status, group_sum(wanted), first, domain.z);
	barrier(CLK_LOCAL_MEM_FENCE);
	if (all.count > 0)
		seeds_keep(LISTS, owners, &all, first[0] + wanted[local_id] % SEEDS_NUMBER, first[1] + wanted[local_id] / SEEDS_NUMBER, domain.z);
}

/* If the slice before is done, and the step has another: that begins. */
__kernel void events_release(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach),
	LIST_OUT(need), LIST_IN(owners), LIST_OUT(parents), int4 domain)
{
	if (status[STATUS_ROUND] != domain.z - 1 || is_last_slice(status, status[STATUS_ACTIVE]))
		return;
	int count = min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	float length = step_length(TEX(uniforms), TEX(clock)), until = slice_end(status, status[STATUS_SLICE] + 1);
	bool stays = true;
	if (get_global_id(0) == 0) {
		status[STATUS_BEGUN] = domain.z;
		status[STATUS_SAVED] = count;
	}
	for (int id = get_global_id(0); id < count; id += get_global_size(0))
		if (active[id] >= 0)
			stays = number_release(slots, reach, status, members, active, work, need, owners, parents, id, until, domain.z, length) && stays;
	if (!stays)
		atomic_or(&status[STATUS_LEFT], 1);
}

__kernel void events_pair(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners),
	LIST_OUT(parents), int4 domain)
{
	if (status[STATUS_BEGUN] != domain.z || !status[STATUS_SAVED])
		return;
	if (get_global_id(0) == 0) {
		status[STATUS_ROUND] = domain.z;
		status[STATUS_SLICE]++;
	}
	for (int id = get_global_id(0); id < status[STATUS_SAVED]; id += get_global_size(0))
		if (active[id] >= 0)
			number_pair(members, active, work, owners, parents, id);
}

__kernel void events_muster(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners),
	LIST_OUT(parents), int4 domain)
{
	if (status[STATUS_ROUND] != domain.z)
		return;
	int count = min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	if (get_global_id(0) == 0)
		status[STATUS_SEEDS] = count;
	for (int id = get_global_id(0); id < count; id += get_global_size(0)) {
		int owner = members[MEMBER(id, MEMBER_OWNER)];
		if (active[id] < 0 || owner < 0 || members[MEMBER(owner, MEMBER_ROUND)] != domain.z)
			continue;
		number_muster(slots, status, members, active, work, owners, parents, id);
	}
}

__kernel void events_resolve(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), RECORD_IN(reach),
	LIST_OUT(need), TEX_IN(friction), LIST_OUT(owners), LIST_OUT(parents), RECORD_OUT(hits), RECORD_OUT(shocks), LIST_IN(touching),
	RECORD_IN(contacts), int4 domain)
{
	if (PEEK(status, STATUS_ROUND) < domain.z)
		return;
	SHARED crew all;
	int seeds = status[STATUS_SEEDS];
	float length = step_length(TEX(uniforms), TEX(clock));
	for (int begin = GROUP_INDEX; begin < seeds; begin += LEADERS_EACH * GROUP_LANES * GROUP_COUNT) {
		fetch_active(slots, LISTS, owners, begin, seeds, domain.z, SPAN_END);
		leaders_gather(members, begin, seeds, domain.z, &all);
		clusters_run(VERTICES, TEX(uniforms), slots, LISTS, work, reach, need, TEX(friction), owners, parents, hits, shocks, touching, contacts,
			domain.z, TEAM_SIZE(domain.w), length, &all);
	}
}

/* Clusters must not meet: bodies of two of them that were changed are looked at as they are now. */
__kernel void events_check(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners),
	LIST_OUT(parents), int4 domain)
{
	if (PEEK(status, STATUS_ROUND) < domain.z)
		return;
	int count = min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	float length = step_length(TEX(uniforms), TEX(clock));
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	for (int id = get_global_id(0); id < count; id += get_global_size(0)) {
		fetch_active(slots, LISTS, owners, id, count, domain.z, SPAN_HALF);
		number_check(VERTICES, slots, LISTS, work, owners, parents, rules, id, domain.z, length);
	}
}
