/* The answer to one event: CONTRACT.md, "Answer". */

/* Work of a body that no event has changed yet. */
void work_begin(RECORD_IN(slots), LIST_OUT(members), RECORD_OUT(work), int s, int id)
{
	work_store(work, id, trajectory_start(slots, s));
	work[WORK_WIDTH * id + WORK_NEXT] = (float4)(NO_HIT, 0.0f, 0.0f, 0.0f);
	work[WORK_WIDTH * id + WORK_BOX] = BOX_EMPTY;
	members[MEMBER(id, MEMBER_EVENTS)] = members[MEMBER(id, MEMBER_RAPID)] = members[MEMBER(id, MEMBER_STUCK)] = 0;
	members[MEMBER(id, MEMBER_BEGUN)] = members[MEMBER(id, MEMBER_HITS)] = members[MEMBER(id, MEMBER_RULED)] = 0;
	members[MEMBER(id, MEMBER_KEPT)] = -1;
}

/* Where its middle gets in such a part of the step, and what it looks at beside that: the least x and y, and the most. */
float4 way_box(body b, float rest, float margin)
{
	float pad = ((0.125f * rest) * rest) * span(b.a) + (span(b.x) + b.radius) * (4.0f * SLOP) + margin;
	float2 end = place(b.x, b.v, b.a, rest);
	return (float4)(smaller(b.x.x, end.x) - pad, smaller(b.x.y, end.y) - pad, larger(b.x.x, end.x) + pad, larger(b.x.y, end.y) + pad);
}

/* Where a body's middle gets by that time of the step, as such a box. False if it leaves its reach by then: Need says how far it gets in the step. */
bool way_until(RECORD_IN(slots), RECORD_IN(reach), LIST_OUT(need), int s, trajectory k, float time, float margin, float length, float4 *way)
{
	body b = body_of(slots, s, k, length);
	float4 most = reach[s], at = SLOT_LOAD(slots, s, SLOT_PLACE);
	*way = way_box(b, time - k.time, margin);
	if (way->x - b.radius >= most.x && way->y - b.radius >= most.y && way->z + b.radius <= most.z && way->w + b.radius <= most.w)
		return true;
	float4 all = way_box(b, 1.0f - k.time, margin);
	need[s] = as_int(larger(larger(CHANNEL(at, LINEAR_X) - all.x, all.z - CHANNEL(at, LINEAR_X)),
		larger(CHANNEL(at, LINEAR_Y) - all.y, all.w - CHANNEL(at, LINEAR_Y))));
	return false;
}

/* The box of the way in the slice grows by what is left of it; false if the body leaves its reach in it. */
bool way_grow(RECORD_IN(slots), RECORD_IN(reach), LIST_IN(status), RECORD_OUT(work), LIST_OUT(need), int s, int id, trajectory k, float margin,
	float length)
{
	float4 rest, box = work[WORK_WIDTH * id + WORK_BOX];
	bool stays = way_until(slots, reach, need, s, k, slice_end(status, status[STATUS_SLICE]), margin, length, &rest);
	work[WORK_WIDTH * id + WORK_BOX] = (float4)(smaller(box.x, rest.x), smaller(box.y, rest.y), larger(box.z, rest.z), larger(box.w, rest.w));
	return stays;
}

/* No faster than when the step began. */
trajectory limited(trajectory k, trajectory start)
{
	float2 v = (float2)(CHANNEL(k.place, LINEAR_VX), CHANNEL(k.place, LINEAR_VY));
	float2 first = (float2)(CHANNEL(start.place, LINEAR_VX), CHANNEL(start.place, LINEAR_VY));
	if (inner(v, v) > inner(first, first)) {
		CHANNEL(k.place, LINEAR_VX) = first.x;
		CHANNEL(k.place, LINEAR_VY) = first.y;
	}
	k.velocity = magnitude(k.velocity) > magnitude(start.velocity) ? start.velocity : k.velocity;
	return k;
}

/* What had too many events is held from now on, and so is what is stuck, which unless it was in a fast hit is slowed, too. */
trajectory held_at_last(RECORD_IN(slots), LIST_OUT(members), int s, int id, trajectory k, int most_stuck)
{
	int stuck = members[MEMBER(id, MEMBER_STUCK)];
	bool is_stuck = (stuck & ~STUCK_FAST) > most_stuck;
	if (members[MEMBER(id, MEMBER_EVENTS)] > HOLD_LIMIT || is_stuck)
		k.held = 1.0f;
	return is_stuck && !(stuck & STUCK_FAST) ? limited(k, trajectory_start(slots, s)) : k;
}

/* A party's new trajectory, by the impulse `sign` j and the torque on it, and what is counted of the event. */
trajectory pushed(RECORD_IN(slots), LIST_OUT(members), int s, int id, trajectory k, float4 j, float sign, float torque, bool rapid, bool borne,
	impact hit)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	int before = members[MEMBER(id, MEMBER_STUCK)], fast = hit.total > 0.0f && !hit.slow ? STUCK_FAST : before & STUCK_FAST;
	int stuck = rapid && hit.slow ? (before & ~STUCK_FAST) + 1 : 0;
	CHANNEL(k.place, LINEAR_VX) += (sign * CHANNEL(j, IMPULSE_X)) * CHANNEL(mass, MASS_INVERSE);
	CHANNEL(k.place, LINEAR_VY) += (sign * CHANNEL(j, IMPULSE_Y)) * CHANNEL(mass, MASS_INVERSE);
	k.velocity += torque * CHANNEL(mass, MASS_INVERSE_INERTIA);
	members[MEMBER(id, MEMBER_EVENTS)]++;
	members[MEMBER(id, MEMBER_RAPID)] += rapid ? 1 : 0;
	members[MEMBER(id, MEMBER_STUCK)] = stuck | fast;
	return held_at_last(slots, members, s, id, k, borne ? STUCK_BORNE : STUCK_MOST);
}

/* Is an event at time u a rapid one of the body? */
bool is_rapid(LIST_OUT(members), int id, trajectory k, float u)
{
	return id >= 0 && !(k.held > 0.0f) && members[MEMBER(id, MEMBER_EVENTS)] > 0 && u - k.time < RAPID;
}

bool had_enough(LIST_OUT(members), int id, bool rapid)
{
	return rapid && members[MEMBER(id, MEMBER_RAPID)] >= RAPID_MOST;
}

/* Is it one that events change? */
bool can_change(RECORD_IN(slots), int s, trajectory k)
{
	return !(k.held > 0.0f) && slot_is_dynamic(slots, s);
}

rules_of_hit event_rules(float restitution, float friction, bool rapid, int events, bool borne, float weight)
{
	rules_of_hit rules;
	rules.friction = friction;
	rules.restitution = restitution;
	rules.micro = is_lossy(restitution, friction) ? MICRO : 0.0f;
	rules.crowd = rules.shake = 0.0f;
	int beyond = events - (borne ? CROWD_BORNE : CROWD);
	if (is_lossy(restitution, friction) && beyond > 0) {
		rules.crowd = smaller((float)beyond * (borne ? CROWD_BORNE_PART : CROWD_PART), borne ? CROWD_BORNE_MOST : CROWD_MOST);
		rules.shake = (float)(1 << min(beyond / CROWD_DOUBLING, CROWD_DOUBLINGS));
	}
	rules.part = 0.5f;
	rules.slow = borne ? CONTACT_FAST : 1.0f;
	rules.weight = weight;
	rules.bound = borne ? CROWD_BORNE_WEIGHTS * weight : INFINITY;
	rules.rapid = rapid;
	rules.event = true;
	return rules;
}

/* Counts a hit as one of the member's, and keeps it where hits are kept; false if there is no room. */
bool hit_count(LIST_OUT(status), LIST_OUT(members), RECORD_OUT(hits), int id, float4 next, float4 j, impact hit)
{
	members[MEMBER(id, MEMBER_HITS)]++;
	members[MEMBER(id, MEMBER_RULED)] += hit.ruled ? 1 : 0;
	if (status[STATUS_KEPT_ROOM] == 0)
		return true;
	int k = atomic_inc(&status[STATUS_KEPT]);
	if (k >= status[STATUS_KEPT_ROOM])
		return false;
	__global float4 *to = hits + HITS_WIDTH * k;
	to[HITS_WHO] = (float4)(CHANNEL(next, NEXT_TIME), CHANNEL(next, NEXT_ROW), CHANNEL(next, NEXT_COLUMN), 0.0f);
	to[HITS_WHERE] = hit.where;
	to[HITS_WHAT] = (float4)(CHANNEL(j, IMPULSE_X), CHANNEL(j, IMPULSE_Y), hit.ruled ? 1.0f : 0.0f, (float)members[MEMBER(id, MEMBER_KEPT)]);
	to[HITS_WHEN] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	members[MEMBER(id, MEMBER_KEPT)] = k;
	return true;
}

/* What gravity makes of a speed in a step. */
float weight_of(TEX_IN(uniforms), float length)
{
	float4 world = TEX_LOAD(uniforms, UNIFORMS_WORLD, 0);
	return norm((float2)((CHANNEL(world, WORLD_GRAVITY_X) * length) * length, (CHANNEL(world, WORLD_GRAVITY_Y) * length) * length));
}

/* How the two of an event moved before it, and what it did: the impulse is on the row body. */
typedef struct answered {
	trajectory own, other;
	impact hit;
	float2 impulse;
} answered;

/* Answers the event `next` of the member in slot s; `other_id` is the partner's number, if it has one. True if it is a shock. If a body leaves its reach the step begins again, but
 * goes on as long as it tells what others need, too. */
bool answer(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), RECORD_IN(reach), LIST_OUT(status), LIST_OUT(members),
	RECORD_OUT(work), LIST_OUT(need), RECORD_OUT(hits), float4 rules, int s, int id, int other_id, float4 next, float length, answered *what)
{
	int other = (int)CHANNEL(next, NEXT_PARTNER), events = members[MEMBER(id, MEMBER_EVENTS)];
	bool borne = status[STATUS_BORNE]; /* do forces bear what rests? */
	float u = CHANNEL(next, NEXT_TIME), weight = weight_of(TEX(uniforms), length);
	bool shocks = borne && weight > 0.0f, enough = false; /* what is rapid again and again */
	impact hit = {0.0f, false, false, false, (float4)(0.0f, 0.0f, 0.0f, 0.0f)};
	bool wall = other < 0, first = wall || (int)CHANNEL(next, NEXT_ROW) == slot_body(slots, s), stays = true;
	trajectory k = work_load(work, id), o = k, was = k, other_was = k;
	float4 j = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	bool pause = CHANNEL(next, NEXT_PARTNER) != (float)other, rapid = !pause && is_rapid(members, id, was, u), other_rapid = false;
	k = moved(slots, s, k, u, length);
	body b = body_of(slots, s, k, length);
	if (wall && !pause) {
		float rub = friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), -1);
		enough = had_enough(members, id, rapid);
		rules_of_hit how = event_rules(larger(b.restitution, CHANNEL(rules, RULES_RESTITUTION)), rub, enough && !shocks, events, borne, weight);
		j = wall_push(VERTICES, TEX_LOAD(uniforms, UNIFORMS_ROOM, 0), b, -1 - other, 0.0f, how, length, &hit);
	} else if (!wall) {
		o = other_was = slot_is_dynamic(slots, other) ? work_load(work, other_id) : trajectory_start(slots, other);
		o = moved(slots, other, o, u, length);
	}
	if (!wall && !pause) {
		body c = body_of(slots, other, o, length);
		events = other_id >= 0 ? max(events, members[MEMBER(other_id, MEMBER_EVENTS)]) : events;
		other_rapid = is_rapid(members, other_id, other_was, u);
		enough = had_enough(members, id, rapid) || had_enough(members, other_id, other_rapid);
		float rub = friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), slot_body(slots, other));
		rules_of_hit how = event_rules(larger(b.restitution, c.restitution), rub, enough && !shocks, events, borne, weight);
		j = first ? pair_push(VERTICES, b, c, 0.0f, how, length, &hit) : pair_push(VERTICES, c, b, 0.0f, how, length, &hit);
	}
	what->own = k;
	what->other = o;
	what->hit = hit;
	what->impulse = (float2)(CHANNEL(j, IMPULSE_X), CHANNEL(j, IMPULSE_Y));
	if (hit.total > 0.0f)
		stays = hit_count(status, members, hits, id, next, j, hit);
	if (can_change(slots, s, was)) {
		k = pushed(slots, members, s, id, k, j, first ? 1.0f : -1.0f, first ? CHANNEL(j, IMPULSE_TORQUE_A) : CHANNEL(j, IMPULSE_TORQUE_B), rapid,
			borne, hit);
		work_store(work, id, k);
		stays = way_grow(slots, reach, status, work, need, s, id, k, 0.0f, length) && stays;
	}
	if (!wall && can_change(slots, other, other_was)) {
		o = pushed(slots, members, other, other_id, o, j, first ? -1.0f : 1.0f, first ? CHANNEL(j, IMPULSE_TORQUE_B) : CHANNEL(j, IMPULSE_TORQUE_A),
			other_rapid, borne, hit);
		work_store(work, other_id, o);
		stays = way_grow(slots, reach, status, work, need, other, other_id, o, 0.0f, length) && stays;
	}
	if (!stays)
		atomic_or(&status[STATUS_LEFT], 1);
	return enough && shocks && hit.lossy;
}
