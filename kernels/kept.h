/* What is kept of forces from step to step: the last ones, with which a step begins, and what it leaves to the next: CONTRACT.md, "contacts", Begin. */

/* The record of contact k of those that begin in Warm at one, and a field of a body's span. */
#define WARM(start, k, rub) (((start) + (k)) * WARM_WIDTH(rub))
#define WARM_SPAN(body, field) (WARM_SPAN_WIDTH * ((body) + 1) + (field))

/* Of how many contacts of a slot's body forces are kept. */
int warm_count(RECORD_IN(slots), LIST_IN(warm_spans), int s)
{
	return warm_spans[WARM_SPAN(slot_body(slots, s), WARM_SPAN_COUNT)];
}

/* What a point's forces were, in N, and the records of its contact; contacts are asked for in order. */
typedef struct last_forces {
	int partner, k;
	bool found;
	float4 forces, held;
	float force, friction;
} last_forces;

/* Of a slot's next point, with that partner, which may be the `second` one of a contact: zeros if the last step had no such contact. */
void last_forces_of(RECORD_IN(slots), RECORD_IN(warm), LIST_IN(warm_spans), int s, int partner, bool second, bool rub, last_forces *last)
{
	if (!second) {
		int key = partner_key(slots, partner), count = warm_count(slots, warm_spans, s);
		int start = warm_spans[WARM_SPAN(slot_body(slots, s), WARM_SPAN_START)];
		last->k += partner == last->partner && last->found; /* one more of the same two */
		while (last->k < count && (int)CHANNEL(warm[WARM(start, last->k, rub)], WARM_PARTNER) < key)
			last->k++;
		int at = WARM(start, last->k, rub);
		bool found = last->k < count && (int)CHANNEL(warm[at], WARM_PARTNER) == key;
		last->partner = partner;
		last->found = found;
		last->forces = found ? warm[at] : (float4)(0.0f);
		last->held = found && rub ? warm[at + 1] : (float4)(0.0f);
	}
	last->force = second ? last->forces.z : last->forces.y;
	last->friction = second ? last->held.y : last->held.x;
}

/* Sees to it that there is room for the forces of as many contacts as a slot has now; what is kept goes along. */
void warm_take(RECORD_IN(slots), LIST_OUT(status), RECORD_IN(contacts), LIST_IN(touching), RECORD_OUT(warm), LIST_OUT(warm_spans), int s, bool rub)
{
	int contacts_now = 0, from = first_contact(touching, s), first = first_four(touching, s);
	for (int point = from; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++)
		contacts_now += !is_second(contacts, first, point, from);
	__global int *span = warm_spans + WARM_SPAN(slot_body(slots, s), 0);
	if (contacts_now <= span[WARM_SPAN_ROOM])
		return;
	int room = contacts_now + contacts_now / 2, start = atomic_add(&warm_spans[WARM_TAKEN], room);
	if (start > warm_spans[WARM_ROOM] - room) {
		atomic_or(&status[STATUS_SMALL], 1);
		return;
	}
	for (int i = 0; i < WARM(0, span[WARM_SPAN_COUNT], rub); i++)
		warm[WARM(start, 0, rub) + i] = warm[WARM(span[WARM_SPAN_START], 0, rub) + i];
	span[WARM_SPAN_START] = start;
	span[WARM_SPAN_ROOM] = room;
}

/* Once impulses have stopped what comes together forces let it come nearer by less, and begin with those of the last steps. */
void rests_warm(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(warm), LIST_IN(warm_spans), int s, bool rub,
	float length)
{
	last_forces last = {.partner = PARTNER_NONE};
	int from = first_contact(touching, s), first = first_four(touching, s);
	for (int point = from; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global float *at = POINT_OUT(contacts, FOUR_WIDTH, first, point), *grip = POINT_OUT(grips, GRIP_WIDTH, rub ? first : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		last_forces_of(slots, warm, warm_spans, s, other, is_second(contacts, first, point, from), rub, &last);
		at[4 * FOUR_LEAST] = EASE * at[4 * FOUR_LEAST] - (0.5f / CONTACT_PART) * at[4 * FOUR_TOLERANCE];
		float friction = rub ? grip[4 * GRIP_FRICTION] : 0.0f, part = friction > 0.0f ? 1.0f : WARM_PART;
		float force = part * force_begun(slots, s, other, last.force, length);
		at[4 * FOUR_FORCE] = at[4 * FOUR_START] = force;
		if (!rub)
			continue;
		grip[4 * GRIP_BOUND] = friction * force;
		grip[4 * GRIP_FORCE] = grip[4 * GRIP_START] = part * force_begun(slots, s, other, last.friction, length);
	}
}

/* What the next step begins with, in N: the mean of a force and of what there was before, or that force alone. */
float force_mean(float force, float before, bool lasts, float follow, float length)
{
	float now = (force / length) / length;
	return lasts ? before + follow * (now - before) : now;
}

/* In the place of a body's forces, where such began this step. True if they are what it began with. */
bool forces_mean(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(pushes), RECORD_IN(warm),
	LIST_IN(warm_spans), int s, bool rub, bool bears, float2 ground, float length)
{
	last_forces last = {.partner = PARTNER_NONE};
	bool same = true;
	int from = first_contact(touching, s), first = first_four(touching, s);
	for (int point = from; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global float *at = POINT_OUT(contacts, FOUR_WIDTH, first, point), *grip = POINT_OUT(grips, GRIP_WIDTH, rub ? first : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		last_forces_of(slots, warm, warm_spans, s, other, is_second(contacts, first, point, from), rub, &last);
		bool lasts = force_begun(slots, s, other, last.force, length) > 0.0f, rubs = rub && grip[4 * GRIP_FRICTION] > 0.0f;
		bool rests = bears && was_moving_at(pushes, s, ground) && partner_was_at_rest(pushes, other, ground);
		float follow = rubs ? (rests ? 0.0f : GRIP_WARM_FOLLOW) : WARM_FOLLOW;
		at[4 * FOUR_FORCE] = force_mean(at[4 * FOUR_FORCE], last.force, lasts, follow, length);
		if (rub)
			grip[4 * GRIP_FORCE] = force_mean(grip[4 * GRIP_FORCE], last.friction, lasts, follow, length);
		same = same && at[4 * FOUR_FORCE] == last.force && (!rub || grip[4 * GRIP_FORCE] == last.friction);
	}
	return same;
}

/* Keeps the forces on a body, in such a step, for the next one. If this one did not begin with them its island is not to fall asleep. */
void forces_keep(RECORD_IN(slots), LIST_IN(status), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_OUT(touching), LIST_IN(islands), RECORD_IN(pushes),
	RECORD_OUT(warm), LIST_OUT(warm_spans), int s, bool rub, float2 ground, float length)
{
	int body = slot_body(slots, s), start = warm_spans[WARM_SPAN(body, WARM_SPAN_START)], count = 0;
	int from = first_contact(touching, s), first = first_four(touching, s);
	if (!forces_mean(slots, contacts, grips, touching, pushes, warm, warm_spans, s, rub, island_bears(status, touching, islands, s), ground, length))
		island_disturb(touching, islands, s);
	for (int point = from; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, point), *grip = POINT_IN(grips, GRIP_WIDTH, rub ? first : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		int second = is_second(contacts, first, point, from), to = WARM(start, count - second, rub);
		float force = at[4 * FOUR_FORCE], held = rub ? grip[4 * GRIP_FORCE] : 0.0f;
		warm[to] = second ? (float4)(warm[to].x, warm[to].y, force, 0.0f) : (float4)((float)partner_key(slots, other), force, 0.0f, 0.0f);
		if (rub)
			warm[to + 1] = second ? (float4)(warm[to + 1].x, held, 0.0f, 0.0f) : (float4)(held, 0.0f, 0.0f, 0.0f);
		count += !second;
	}
	warm_spans[WARM_SPAN(body, WARM_SPAN_COUNT)] = count;
}

/* A force at a point with that arm as it is kept: of two stops as a torque in which the other one's, which was kept `beside`, has the opposite sign; `back`: of a stop, as what it has to take back. */
float part_keeps(int part, float now, float arm, float beside, bool back)
{
	float size = magnitude(now) < JOINT_LEAST ? 0.0f : now, force = back ? 0.0f - size : size;
	if (part == PART_ROPE)
		return 0.0f - size;
	if (part == PART_UPPER)
		return size > 0.0f ? 0.0f - force * magnitude(arm) : beside;
	return part_turns(part) ? force * magnitude(arm) : force;
}

__global float *joint_forces(RECORD_OUT(joints), int side)
{
	return (__global float *)(joints + JOINT(side / 2, JOINT_FORCES));
}

/* Is what a side's joint holds farther than that from where it belongs, or, of a spring that is too stiff for the step, from where the last force has it? Then that was not right: what
 * iterations can't find would add up from step to step. */
bool joint_strays(RECORD_IN(slots), LIST_IN(places), RECORD_IN(joints), int side, held own, float far, float length)
{
	hold h = hold_of(joints, side, own, held_other(slots, places, joints, side), true);
	if (joint_kind(joints, side) == JOINT_SPRING) {
		float stiffness = CHANNEL(joint_drive(joints, side), SPRING_STIFFNESS);
		float stretched = CHANNEL(joints[JOINT(side / 2, JOINT_FORCES)], JOINT_FORCE) / stiffness;
		return stiffness > 0.0f && spring_of(joints, side, length, 1.0f).at_end && magnitude(stretched - h.target[0]) > far;
	}
	return larger(magnitude(h.target[0]), magnitude(h.target[1])) > far || (joint_is_fixed(joints, side) && magnitude(h.turned * h.arm) > far);
}

/* Forces begin with the last ones, unless a joint strays, or the island is tired. Where those hold the body's angle too fast for the step forces turn it less. */
void joined_warm(RECORD_IN(slots), LIST_IN(places), RECORD_OUT(contacts), LIST_OUT(touching), LIST_IN(islands), RECORD_IN(joints), LIST_IN(joined),
	int s, float length)
{
	int point = 0, first = first_four(touching, s);
	bool tired = island_is_tired(touching, islands[s]), strays = false;
	for (joint_row row = held_row(slots, touching, joints, joined, s); row.side >= 0; row_next(joints, joined, &row), point++) {
		__global float *at = POINT_OUT(contacts, FOUR_WIDTH, first, point);
		if (row.point == 0)
			strays = joint_strays(slots, places, joints, row.side, held_body(slots, s, joint_anchor(joints, row.side)),
				JOINT_ASTRAY * at[4 * FOUR_TOLERANCE], length);
		at[4 * FOUR_FORCE] = at[4 * FOUR_START] = tired || strays ? 0.0f : row_last(slots, joints, &row, s, at, length);
	}
	float holds = joined_hold(slots, contacts, touching, joints, joined, s, length);
	touching[TOUCH(s, TOUCHING_TURNS)] = as_int(holds > JOINT_STIFF ? 1.0f / (1.0f + 0.5f * holds) : 1.0f);
}

/* What is held at a side as it was when the step began. (Others may be writing to slots what they are now.) */
held held_before(RECORD_IN(slots), RECORD_IN(pushes), int s, float2 anchor)
{
	if (slot_is_static(slots, s))
		return held_body(slots, s, anchor);
	float4 before = pushes[PUSHES_WIDTH * s + 2], mass = SLOT_LOAD(slots, s, SLOT_MASS);
	held h = held_place(before.xy);
	h.lever = h.last_lever = turn(rotation_of(before.z), anchor);
	h.angle = before.z;
	h.inverse_mass = CHANNEL(mass, MASS_INVERSE);
	h.inverse_inertia = CHANNEL(mass, MASS_INVERSE_INERTIA);
	return h;
}

/* Were its bodies beyond the bound of what pushes one way when the step began? */
bool was_beyond(RECORD_IN(slots), RECORD_IN(pushes), LIST_IN(places), RECORD_IN(joints), int side, int part, int s, float tolerance)
{
	int partner = joint_partner(joints, side);
	float2 anchor = joint_anchor(joints, side ^ 1);
	held own = held_before(slots, pushes, s, joint_anchor(joints, side));
	held other = partner < 0 ? held_place(anchor) : held_before(slots, pushes, places[partner], anchor);
	hold h = hold_of(joints, side, own, other, true);
	return part_target(joints, side, &h, part) > JOINT_REACHED * tolerance;
}

/* Keeps the forces for the next step, each at one of its two bodies. If this one did not begin with them its island is not to fall asleep. */
void joined_keep(RECORD_IN(slots), LIST_IN(status), RECORD_IN(contacts), LIST_OUT(touching), LIST_IN(islands), RECORD_IN(pushes), LIST_IN(places),
	RECORD_OUT(joints), LIST_IN(joined), int s, float2 ground, float length)
{
	int point = 0, first = first_four(touching, s);
	bool bears = first_contact(touching, s) > 0 && island_bears(status, touching, islands, s) && was_moving_at(pushes, s, ground), same = true;
	float beside = 0.0f; /* what was kept of the point before */
	for (joint_row row = held_row(slots, touching, joints, joined, s); row.side >= 0; row_next(joints, joined, &row), point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, point);
		int partner = (int)at[4 * FOUR_PARTNER], part = row_part(joints, &row);
		if ((row.side & 1 && partner_gives_way(slots, partner)) || (bears && partner_was_at_rest(pushes, partner, ground)))
			continue;
		float force = (at[4 * FOUR_FORCE] / length) / length, last = part_begins(part, joint_kept(joints, row.side, part), at[4 * FOUR_ARM]);
		bool back = part_pushes_one_way(part)
			&& (force > JOINT_BROUGHT * last || (force > 0.0f && part_back(joints, row.side, part, at[4 * FOUR_ARM]) > 0.0f))
			&& was_beyond(slots, pushes, places, joints, row.side, part, s, at[4 * FOUR_TOLERANCE]);
		beside = part_keeps(part, force, at[4 * FOUR_ARM], beside, back);
		if (part == PART_LOWER)
			continue; /* it is kept with the upper one */
		__global float *to = joint_forces(joints, row.side) + part_kept(part);
		same = same && beside == *to;
		*to = beside;
		if (part == PART_ROPE) {
			float taken = back ? 0.0f - beside : 0.0f;
			same = same && taken == to[JOINT_BACK - JOINT_FORCE];
			to[JOINT_BACK - JOINT_FORCE] = taken;
		}
	}
	if (!same)
		island_disturb(touching, islands, s);
}
