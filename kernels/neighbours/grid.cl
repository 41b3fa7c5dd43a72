/* Lists of the neighbours that a body could reach for a while, by a grid of cells that has a level for every size. */

__kernel void neighbours_pace(TEX_IN(uniforms), RECORD_IN(slots), LIST_OUT(status), int4 domain)
{
	__local float4 found[GROUP_MOST];
	int lane = get_local_id(0), lanes = get_local_size(0);
	float step = CHANNEL(TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), WORLD_TIME_STEP), window = pace_window(status, domain.z, step);
	if (get_group_id(0) == 0)
		found[lane] = pace_sample(slots, domain.z, window, lane, lanes);
	barrier(CLK_LOCAL_MEM_FENCE);
	if (get_global_id(0) > 0)
		return;
	for (int k = 1; k < lanes; k++)
		found[0] += found[k];
	status_begin(status);
	pace_choose(found[0], window, LEAST_STEPS * step, (float)domain.w, status);
}

__kernel void neighbours_reach(VERTICES_IN, RECORD_IN(slots), LIST_IN(need), LIST_OUT(status), LIST_OUT(spans), LIST_OUT(cells), int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x)
		return;
	float4 box = reach_box(VERTICES, slots, s, as_float(need[s]), status);
	int level = reach_level(box, as_float(status[STATUS_CELL]));
	int cell = cell_index(cell_of((float2)(0.5f * (box.x + box.z), 0.5f * (box.y + box.w)), level_side(status, level)), level, domain.z, domain.w);
	spans[SPAN(s, SPAN_CELL)] = cell;
	atomic_inc(&cells[CELL_WIDTH * cell + CELL_COUNT]);
	if (level > 0) /* most are of level 0, which counts as there */
		atomic_or(&status[STATUS_LEVELS], 1 << level);
}

/* A row of cells, and so a group, gets its places together, so that cells beside each other are so in memory. Levels without bodies are skipped. */
__kernel void neighbours_cells(LIST_OUT(status), LIST_OUT(cells), int4 domain)
{
	__local int wanted[GROUP_MOST], first, next;
	int row = get_global_id(1), lane = get_local_id(0), lanes = get_local_size(0), begin = CELLS_EACH * lane, sum = 0;
	bool live = get_group_id(0) == 0 && status[STATUS_LEVELS] & (1 << row_level(domain.w, row));
	int columns = live ? domain.z : 0;
	__global int *all = cells + (size_t)CELL_WIDTH * (size_t)(row * domain.z);
	for (int i = begin; i < columns; i += CELLS_EACH * lanes)
		sum += cells_count(all, i);
	wanted[lane] = sum;
	barrier(CLK_LOCAL_MEM_FENCE);
	if (lane == 0 && live)
		next = atomic_add(&status[STATUS_PLACED], group_sum(wanted));
	barrier(CLK_LOCAL_MEM_FENCE);
	for (int i = begin; i - begin < columns; i += CELLS_EACH * lanes) {
		wanted[lane] = i < columns ? cells_count(all, i) : 0;
		barrier(CLK_LOCAL_MEM_FENCE);
		if (lane == 0) {
			first = next;
			next += group_sum(wanted);
		}
		barrier(CLK_LOCAL_MEM_FENCE);
		if (i < columns)
			cells_place(all, i, first + wanted[lane]);
	}
}

__kernel void neighbours_sort(VERTICES_IN, RECORD_IN(slots), LIST_IN(need), LIST_IN(status), LIST_IN(spans), LIST_OUT(cells), RECORD_OUT(new_slots),
	LIST_OUT(new_need), RECORD_OUT(reach), LIST_OUT(members), LIST_OUT(owners), LIST_OUT(parents), LIST_OUT(places), int4 domain)
{
	int s = get_global_id(0), to = s < domain.x ? atomic_inc(&cells[CELL_WIDTH * spans[SPAN(s, SPAN_CELL)] + CELL_END]) : 0;
	barrier(CLK_LOCAL_MEM_FENCE); /* on a CPU an atomic operation waits for what was written before: so all of a group come first */
	if (s >= domain.x)
		return;
	for (int k = 0; k < SLOT_WIDTH; k++)
		new_slots[SLOT_WIDTH * to + k] = SLOT_LOAD(slots, s, k);
	reach[to] = reach_box(VERTICES, slots, s, as_float(need[s]), status);
	new_need[to] = status[STATUS_COMMIT] ? 0 : need[s];
	places[slot_body(slots, s)] = to;
	litter_clear(status, members, owners, parents, s, domain.x);
}

__kernel void neighbours_near(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_IN(cells), LIST_OUT(spans),
	LIST_OUT(neighbours), LIST_OUT(nodes), LIST_OUT(members), LIST_OUT(extra), int4 domain)
{
	__local int wanted[GROUP_MOST], first;
	int s = get_global_id(0), local_id = get_local_id(0);
	near_list list;
	list.ahead = list.behind = 0;
	if (s < domain.x && PEEK(status, STATUS_THRONGS) <= THRONGS_MOST)
		near_search(slots, filters, reach, status, cells, nodes, members, s, domain.z, domain.w, &list, neighbours, -1);
	wanted[local_id] = list.ahead + list.behind;
	barrier(CLK_LOCAL_MEM_FENCE);
	if (local_id == 0)
		first = neighbours_take(status, group_sum(wanted));
	barrier(CLK_LOCAL_MEM_FENCE);
	if (s >= domain.x)
		return;
	int all = first < 0 ? 0 : list.ahead + list.behind, start = first < 0 ? 0 : first + wanted[local_id], half_end = start + min(all, list.ahead);
	extra[s] = -1;
	spans[SPAN(s, SPAN_START)] = start;
	spans[SPAN(s, SPAN_HALF)] = half_end;
	spans[SPAN(s, SPAN_END)] = start + all;
	spans[SPAN(s, SPAN_FOUND)] = FOUND_NONE;
	if (all > NEAR_MOST)
		near_again(slots, filters, reach, status, cells, nodes, members, s, domain.z, domain.w, list.ahead, neighbours + start);
	else
		near_write(&list, start, half_end, start + all, neighbours);
}

__kernel void neighbours_gather(LIST_OUT(status), LIST_OUT(spans), LIST_OUT(neighbours), LIST_IN(nodes), LIST_OUT(members), int4 domain)
{
	int s = get_global_id(0);
	if (s < domain.x && members[MEMBER(s, MEMBER_HEAD)] >= 0)
		span_gather(status, spans, neighbours, nodes, members, s);
}

/* The neighbours of bodies that have got another reach, each by a group. */
__kernel void neighbours_mend(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_IN(cells), LIST_IN(spans),
	LIST_IN(neighbours), LIST_IN(movers), LIST_OUT(extra), LIST_OUT(wakes), int4 domain)
{
	if (PEEK(status, STATUS_STALE) || status[STATUS_SMALL])
		return;
	int lane = get_local_id(0), lanes = get_local_size(0), group = get_group_id(0), groups = get_num_groups(0);
	for (int i = status[STATUS_MENDED] + group; i < status[STATUS_MOVERS]; i += groups)
		mend_search(slots, filters, reach, status, cells, spans, neighbours, movers, extra, wakes, movers[i], domain.z, domain.w, lane, lanes);
}
