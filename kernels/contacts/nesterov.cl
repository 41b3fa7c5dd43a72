/* The forces between bodies that rest on each other: a projected gradient, accelerated as Nesterov did. */

__kernel void contacts_begin(TEX_IN(uniforms), TEX_IN(clock), LIST_OUT(status), int4 domain)
{
	if (get_global_id(0) > 0)
		return;
	bool waits = iterations_are_wanted(status);
	if (status[STATUS_PASS] == 0)
		status[STATUS_TOUCHING] = status[STATUS_BORNE] = 0;
	float length = whole_length(TEX(uniforms), step_length(TEX(uniforms), TEX(clock)));
	if (!(length > 0.0f) || !lists_are_good(status) || status[STATUS_UNDER_WAY] || (!waits && status[STATUS_PASS] == PASS_FORCES))
		return;
	status[STATUS_HANDED] = domain.w;
	if (!waits)
		pass_begin(status, domain.z, length);
}

/* First of those that are awake; then of those that they wake. */
__kernel void contacts_find(VERTICES_IN, TEX_IN(uniforms), TEX_IN(clock), RECORD_IN(slots), LISTS_IN, RECORD_OUT(contacts), LIST_OUT(touching),
	LIST_IN(owners), LIST_IN(parents), RECORD_OUT(pushes), TEX_IN(friction), RECORD_OUT(grips), LIST_IN(warm_spans), LIST_OUT(islands),
	LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x || status[STATUS_FIRST] != domain.z || status[STATUS_PASS] != PASS_IMPULSES || !is_due(status, touching, islands, s, domain.w))
		return;
	if (!domain.w)
		slot_keep(slots, pushes, s);
	islands[s] = s;
	float step = step_length(TEX(uniforms), TEX(clock)), length = whole_length(TEX(uniforms), step);
	int4 held = joined_find(slots, places, joints, joined, touching, islands, s, length);
	int count = rests_find(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, pushes, touching, islands, contacts, grips, s, held.x, length);
	touching[TOUCH(s, TOUCHING_COUNT)] = count;
	joined_write(slots, places, joints, joined, touching, contacts, grips, s, count > 0 ? held : (int4)(0), length, part_of_whole(step, length),
		anything_rubs(TEX(uniforms)));
	if (count > 0 || warm_count(slots, warm_spans, s) > 0 || slot_is_kinematic(slots, s)) /* what rests on that one goes by its load */
		touching[TOUCH(atomic_inc(&status[STATUS_TOUCHING]), TOUCHING_SLOT)] = s;
}

__kernel void contacts_join(RESTS_IN, RECORD_OUT(loads), RECORD_OUT(warm), LIST_OUT(warm_spans), RECORD_IN(pushes), RECORD_IN(joints),
	LIST_IN(joined), LIST_IN(places), int4 domain)
{
	float length = whole_length(TEX(uniforms), step_length(TEX(uniforms), TEX(clock)));
	bool rub = anything_rubs(TEX(uniforms)), impulses = status[STATUS_PASS] == PASS_IMPULSES, due = status[STATUS_FIRST] == domain.z;
	int capacity = status[STATUS_CAPACITY];
	for (int i = get_global_id(0); due && i < status[STATUS_TOUCHING]; i += get_global_size(0)) {
		int s = touching[TOUCH(i, TOUCHING_SLOT)];
		touching[TOUCH(s, TOUCHING_WANTED)] = domain.z;
		if (impulses) {
			slot_wake(slots, status, touching, pushes, s);
			touching[TOUCH(s, TOUCHING_RESTLESS)] = touching[TOUCH(s, TOUCHING_FOOTING)] = 0;
			warm_take(slots, status, contacts, touching, warm, warm_spans, s, rub);
			island_join(slots, contacts, touching, islands, s);
		} else {
			joined_warm(slots, places, contacts, touching, islands, joints, joined, s, length);
			rests_warm(slots, contacts, grips, touching, warm, warm_spans, s, rub, length);
		}
		float4 load = load_alone(slots, impulses, s, length);
		CHANNEL(load, LOAD_SHARE) = rests_share(slots, contacts, grips, touching, s, rub);
		loads[LOADS_OF(capacity, LOADS_ALONE) + s] = load;
		loads[LOADS_OF(capacity, domain.z & 1) + s] = impulses ? load : rests_add(slots, contacts, grips, touching, s, rub, load);
	}
}

/* One iteration, each group of what lies together; or where few bodies touch all there are, by one group alone, for which they cost less than launches. */
__kernel void contacts_iterate(RESTS_IN, RECORD_OUT(loads), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), int4 domain)
{
	__local int more;
	int touches = status[STATUS_TOUCHING], done = domain.z - status[STATUS_FIRST];
	bool again, alone = touches <= CONTACTS_ALONE, rub = anything_rubs(TEX(uniforms));
	float step = step_length(TEX(uniforms), TEX(clock)), length = whole_length(TEX(uniforms), step), part = part_of_whole(step, length);
	if (PEEK(status, STATUS_WANTED) < domain.z || (alone && get_group_id(0) > 0))
		return;
	int share = alone ? touches : touches / (int)get_num_groups(0) + 1, first = share * (int)get_group_id(0), last = min(first + share, touches);
	do {
		bool wanted = false;
		for (int i = first + (int)get_local_id(0); i < last; i += get_local_size(0))
			wanted |= island_iterate(slots, status, contacts, grips, touching, islands, loads, places, joints, joined,
				touching[TOUCH(i, TOUCHING_SLOT)], done, rub, length, part);
		done++;
		if (get_local_id(0) == 0)
			more = 0;
		barrier(CLK_LOCAL_MEM_FENCE);
		if (wanted)
			atomic_or(&more, 1);
		barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
		again = more;
		barrier(CLK_LOCAL_MEM_FENCE);
	} while (again && alone);
	if (again && get_local_id(0) == 0)
		atomic_max(&status[STATUS_WANTED], domain.z + 1);
}

__kernel void contacts_apply(RESTS_IN, RECORD_OUT(reach), LIST_OUT(wakes), LIST_OUT(movers), LIST_OUT(need), LIST_IN(places), int4 domain)
{
	float length = whole_length(TEX(uniforms), step_length(TEX(uniforms), TEX(clock)));
	if (status[STATUS_HANDED] != domain.w || iterations_are_wanted(status))
		return;
	if (get_global_id(0) == 0)
		status[STATUS_BORNE] = 1;
	for (int i = get_global_id(0); i < status[STATUS_TOUCHING]; i += get_global_size(0)) {
		int s = touching[TOUCH(i, TOUCHING_SLOT)];
		slot_bear(slots, status, contacts, grips, touching, islands, places, s, anything_rubs(TEX(uniforms)), length);
		if (slot_changed(TEX(uniforms), slots, status, reach, wakes, movers, s, domain.z)) /* lists made anew for this step know none of this */
			need[s] = as_int(way_ahead(slots, s, CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP)));
	}
}

/* After a step the pushes are as they were, and its forces are kept; before one that begins again the velocities, too, are as they were. */
__kernel void contacts_release(RESTS_IN, RECORD_IN(pushes), RECORD_OUT(reach), LIST_OUT(wakes), LIST_OUT(movers), RECORD_OUT(warm),
	LIST_OUT(warm_spans), LIST_IN(places), RECORD_OUT(joints), LIST_IN(joined), int4 domain)
{
	bool again = domain.w, rub = anything_rubs(TEX(uniforms)), due = status[STATUS_BORNE] && (status[STATUS_PASS] > 0) == again;
	float length = whole_length(TEX(uniforms), CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH)); /* of the step that is done */
	for (int i = get_global_id(0); due && i < status[STATUS_TOUCHING]; i += get_global_size(0)) {
		int s = touching[TOUCH(i, TOUCHING_SLOT)];
		slot_release(slots, status, contacts, grips, touching, islands, pushes, warm, warm_spans, places, joints, joined, wakes, s, again, rub,
			length);
		slot_changed(TEX(uniforms), slots, status, reach, wakes, movers, s, domain.z);
	}
}
