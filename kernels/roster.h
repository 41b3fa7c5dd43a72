/* Bodies come and go between two steps. Slots stay without gaps: the body of the last one takes over that of one that goes, and the lists forget both. */

/* A body's push, from its texel of Forces. */
float4 push_of(TEX_IN(uniforms), float4 f, float inverse_mass, float inverse_inertia, int i)
{
	float4 world = TEX_LOAD(uniforms, UNIFORMS_WORLD, 0);
	if (!(inverse_mass > 0.0f))
		return (float4)(0.0f, 0.0f, 0.0f, (float)i);
	return (float4)(CHANNEL(world, WORLD_GRAVITY_X) + CHANNEL(f, FORCES_X) * inverse_mass,
		CHANNEL(world, WORLD_GRAVITY_Y) + CHANNEL(f, FORCES_Y) * inverse_mass, CHANNEL(f, FORCES_TORQUE) * inverse_inertia, (float)i);
}

/* A body that the slots did not know, into the slot of its index: from its texels of Linear, Rotational, Geometry and Forces. */
void slot_fill(TEX_IN(uniforms), RECORD_OUT(slots), LIST_OUT(need), LIST_OUT(places), int i, float4 l, float4 r, float4 g, float4 f)
{
	float inverse_mass = 1.0f / CHANNEL(g, GEOMETRY_MASS), inverse_inertia = 1.0f / CHANNEL(g, GEOMETRY_INERTIA);
	slots[SLOT_WIDTH * i + SLOT_PLACE] = l;
	slots[SLOT_WIDTH * i + SLOT_TURN] = (float4)(CHANNEL(r, ROTATIONAL_ANGLE), CHANNEL(r, ROTATIONAL_VELOCITY), CHANNEL(r, ROTATIONAL_RADIUS),
		CHANNEL(f, FORCES_RESTITUTION));
	slots[SLOT_WIDTH * i + SLOT_MASS] = (float4)(inverse_mass, inverse_inertia, 2.0f * CHANNEL(g, GEOMETRY_FIRST), CHANNEL(g, GEOMETRY_COUNT));
	slots[SLOT_WIDTH * i + SLOT_PUSH] = push_of(TEX(uniforms), f, inverse_mass, inverse_inertia, i);
	need[i] = 0;
	places[i] = i;
}

/* A reach that touches none. */
#define NO_REACH (float4)(1e30f, 1e30f, -1e30f, -1e30f)

void slot_take_over(RECORD_OUT(slots), LIST_OUT(places), int s, int last)
{
	places[slot_body(slots, last)] = s;
	for (int k = 0; k < SLOT_WIDTH; k++)
		slots[SLOT_WIDTH * s + k] = SLOT_LOAD(slots, last, k);
}

/* The slot's neighbours are those that it had, but for one. */
void neighbour_forget(LIST_OUT(spans), LIST_OUT(neighbours), LIST_OUT(extra), int s, int gone)
{
	int half_end = spans[SPAN(s, SPAN_HALF)], end = spans[SPAN(s, SPAN_END)], link = s;
	for (int k = spans[SPAN(s, SPAN_START)]; k < end;) {
		if (neighbours[k] != gone) {
			k++;
		} else if (k < half_end) {
			neighbours[k] = neighbours[--half_end];
			neighbours[half_end] = neighbours[--end];
		} else {
			neighbours[k] = neighbours[--end];
		}
	}
	spans[SPAN(s, SPAN_HALF)] = half_end;
	spans[SPAN(s, SPAN_END)] = end;
	while (extra[link] >= 0) {
		int node = extra[link];
		if (extra[node + NODE_SLOT] == gone)
			extra[link] = extra[node + NODE_LINK];
		else
			link = node + NODE_LINK;
	}
}

/* The slot has no neighbours, and is nobody's. */
void neighbours_part(LIST_OUT(spans), LIST_OUT(neighbours), LIST_OUT(extra), int s)
{
	for (int k = spans[SPAN(s, SPAN_START)]; k < spans[SPAN(s, SPAN_END)]; k++)
		neighbour_forget(spans, neighbours, extra, neighbours[k], s);
	for (int node = extra[s]; node >= 0; node = extra[node + NODE_LINK])
		neighbour_forget(spans, neighbours, extra, extra[node + NODE_SLOT], s);
	spans[SPAN(s, SPAN_HALF)] = spans[SPAN(s, SPAN_END)] = spans[SPAN(s, SPAN_START)];
	extra[s] = -1;
}

/* The last slot is in no list any more. What was in it is in slot `s` now, and gets neighbours there. */
void lists_let_go(RECORD_IN(slots), RECORD_OUT(reach), LIST_OUT(status), LIST_OUT(wakes), LIST_OUT(movers), LIST_OUT(spans), LIST_OUT(neighbours),
	LIST_OUT(extra), int s, int last, int room)
{
	neighbours_part(spans, neighbours, extra, s);
	neighbours_part(spans, neighbours, extra, last);
	for (int i = 0; i < min(status[STATUS_MOVERS], room); i++)
		movers[i] = movers[i] == last ? s : movers[i];
	if (s != last)
		slot_moves(slots, reach, status, wakes, movers, s, room);
	reach[last] = NO_REACH;
}

/* Of bodies that go, in the order of their indices, how many are below one. */
int removed_below(RECORD_IN(changes), int gone, int body)
{
	int low = 0, high = gone;
	while (low < high) {
		int middle = (low + high) / 2;
		if ((int)CHANNEL(changes[middle], REMOVED_BODY) < body)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}
