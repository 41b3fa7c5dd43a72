/* New neighbours of a body whose reach has changed since the lists were made: nodes in Extra, which others may be adding to at the same time. */

/* Is the other one of the slot's neighbours already? */
bool mend_knows(LIST_IN(spans), LIST_IN(neighbours), LIST_OUT(extra), int s, int other)
{
	for (int k = spans[SPAN(s, SPAN_START)]; k < spans[SPAN(s, SPAN_END)]; k++)
		if (neighbours[k] == other)
			return true;
	for (int node = int_load(extra, s); node >= 0; node = extra[node + NODE_LINK])
		if (extra[node + NODE_SLOT] == other)
			return true;
	return false;
}

/* Where there is no room the lists are made anew. */
void mend_add(LIST_OUT(status), LIST_OUT(extra), int s, int other)
{
	int node = atomic_add(&status[STATUS_EXTRA], NODE_WIDTH), next = int_load(extra, s), seen;
	if (node + NODE_WIDTH > status[STATUS_EXTRA_ROOM]) {
		atomic_or(&status[STATUS_STALE], 1);
		return;
	}
	extra[node + NODE_SLOT] = other;
	do {
		seen = next;
		extra[node + NODE_LINK] = seen;
		mem_fence(CLK_GLOBAL_MEM_FENCE);
		next = atomic_cmpxchg(&extra[s], seen, node);
	} while (next != seen);
}

void mend_meet(RECORD_IN(reach), LIST_OUT(status), LIST_IN(spans), LIST_IN(neighbours), LIST_OUT(extra), LIST_OUT(wakes), int s, int other)
{
	float4 a = reach[s], b = reach[other];
	if (other == s || b.x > a.z || b.z < a.x || b.y > a.w || b.w < a.y || mend_knows(spans, neighbours, extra, s, other))
		return;
	mend_add(status, extra, s, other);
	mend_add(status, extra, other, s);
	/* where both were changed in the last step, the other may be the one that watches */
	atomic_xchg(&wakes[WAKE(other, WAKE_NEXT)], status[STATUS_AGE]);
}

/* Among the slots in the cells of all levels, and those that are not in the cells any more in which they would be looked for. */
void mend_search(RECORD_IN(reach), LIST_OUT(status), LIST_IN(cells), LIST_IN(spans), LIST_IN(neighbours), LIST_IN(movers), LIST_OUT(extra),
	LIST_OUT(wakes), int s, int columns, int rows)
{
	float4 box = reach[s];
	for (int level = 0; level < CELL_LEVELS; level++) {
		if (!(status[STATUS_LEVELS] & (1 << level)))
			continue;
		int2 low, high = cells_around(box, level_side(status, level), columns, level_rows(rows, level), &low);
		for (int y = low.y; y <= high.y; y++)
			for (int x = low.x; x <= high.x; x++) {
				int cell = CELL_WIDTH * cell_index((int2)(x, y), level, columns, rows);
				for (int other = cells[cell + CELL_START]; other < cells[cell + CELL_END]; other++)
					mend_meet(reach, status, spans, neighbours, extra, wakes, s, other);
			}
	}
	for (int i = 0; i < status[STATUS_MOVERS]; i++)
		mend_meet(reach, status, spans, neighbours, extra, wakes, s, movers[i]);
}
