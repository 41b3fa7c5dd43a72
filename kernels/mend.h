/* New neighbours of a body whose reach has changed since the lists were made: nodes in Extra, which others may be adding to at the same time. Two that
 * find each other at the same time may be noted twice. */

/* Is the other one of the slot's neighbours already? */
bool mend_knows(LIST_IN(spans), LIST_IN(neighbours), LIST_OUT(extra), int s, int other)
{
	for (int k = spans[SPAN(s, SPAN_START)]; k < spans[SPAN(s, SPAN_END)]; k++)
		if (neighbours[k] == other)
			return true;
	for (int node = int_load(extra, s); node >= 0; node = PEEK(extra, node + NODE_LINK))
		if (PEEK(extra, node + NODE_SLOT) == other)
			return true;
	return false;
}

/* Where there is no room the lists are made anew. */
void mend_add(LIST_OUT(status), LIST_OUT(extra), int s, int other)
{
	int node = PEEK(status, STATUS_STALE) ? INT_MAX - NODE_WIDTH : atomic_add(&status[STATUS_EXTRA], NODE_WIDTH), next = int_load(extra, s), seen;
	if (node + NODE_WIDTH > status[STATUS_EXTRA_ROOM]) {
		atomic_or(&status[STATUS_STALE], 1);
		return;
	}
	atomic_xchg(&extra[node + NODE_SLOT], other);
	do {
		seen = next;
		atomic_xchg(&extra[node + NODE_LINK], seen);
		mem_fence(CLK_GLOBAL_MEM_FENCE);
		next = atomic_cmpxchg(&extra[s], seen, node);
	} while (next != seen);
}

void mend_meet(RECORD_IN(slots), LIST_IN(filters), LIST_OUT(status), LIST_IN(spans), LIST_IN(neighbours), LIST_OUT(extra), LIST_OUT(wakes), int s,
	int other)
{
	if (other == s || !slots_meet(slots, filters, s, other) || mend_knows(spans, neighbours, extra, s, other))
		return;
	mend_add(status, extra, s, other);
	mend_add(status, extra, other, s);
	/* where both were changed in the last step, the other may be the one that watches */
	atomic_xchg(&wakes[WAKE(other, WAKE_NEXT)], status[STATUS_AGE]);
}

/* Among the slots in the cells of all levels, and those that are not in the cells any more in which they would be looked for: a lane's part of them. */
void mend_search(RECORD_IN(slots), LIST_IN(filters), RECORD_IN(reach), LIST_OUT(status), LIST_IN(cells), LIST_IN(spans), LIST_IN(neighbours),
	LIST_IN(movers), LIST_OUT(extra), LIST_OUT(wakes), int s, int columns, int rows, int lane, int lanes)
{
	float4 box = reach[s];
	int levels = status[STATUS_LEVELS], count = status[STATUS_MOVERS];
	for (int level = 0; level < CELL_LEVELS; level++) {
		if (!(levels & (1 << level)))
			continue;
		int2 low, high = cells_around(box, level_side(status, level), columns, level_rows(rows, level), &low);
		int width = high.x - low.x + 1, all = width * (high.y - low.y + 1);
		for (int k = lane; k < all; k += lanes) {
			int cell = CELL_WIDTH * cell_index((int2)(low.x + k % width, low.y + k / width), level, columns, rows);
			for (int other = cells[cell + CELL_START]; other < cells[cell + CELL_END]; other++)
				if (boxes_touch(box, reach[other]))
					mend_meet(slots, filters, status, spans, neighbours, extra, wakes, s, other);
		}
	}
	for (int i = lane; i < count; i += 4 * lanes) { /* four are read at once */
		int others[4];
		float4 boxes[4];
		for (int k = 0; k < 4; k++)
			others[k] = movers[min(i + k * lanes, count - 1)];
		for (int k = 0; k < 4; k++)
			boxes[k] = reach[others[k]];
		for (int k = 0; k < 4; k++)
			if (boxes_touch(box, boxes[k]))
				mend_meet(slots, filters, status, spans, neighbours, extra, wakes, s, others[k]);
	}
}

/* A slot's push or velocities are others: all around looks at it again, and it may get farther. True if that is where it was not looked for. */
bool slot_changed(TEX_IN(uniforms), RECORD_OUT(slots), LIST_OUT(status), RECORD_OUT(reach), LIST_OUT(wakes), LIST_OUT(movers), int s, int room)
{
	slot_rouse(status, wakes, s);
	return reach_keep(TEX(uniforms), slots, reach, status, wakes, movers, s, room);
}
