/* What is kept of forces from step to step: the last ones, with which a step begins, and what it leaves to the next: CONTRACT.md, "contacts", Begin. */

/* What a point's forces were, in N, and the records of its contact. */
typedef struct last_forces {
	int partner;
	float4 forces, held;
	float force, friction;
} last_forces;

/* Of a slot's next point, with that partner: zeros if the last step had no such contact. False if it is none. */
bool last_forces_of(RECORD_IN(slots), RECORD_IN(warm), LIST_IN(warm_counts), int s, int partner, bool rub, last_forces *last)
{
	if (partner == PARTNER_NONE)
		return false;
	bool second = partner == last->partner;
	if (!second) {
		int body = slot_body(slots, s), key = partner_key(slots, partner), k = 0;
		while (k < warm_counts[body] && (int)CHANNEL(warm[WARM(body, k, rub)], WARM_PARTNER) != key)
			k++;
		bool found = k < warm_counts[body];
		last->partner = partner;
		last->forces = found ? warm[WARM(body, k, rub)] : (float4)(0.0f);
		last->held = found && rub ? warm[WARM(body, k, true) + 1] : (float4)(0.0f);
	}
	last->force = second ? last->forces.z : last->forces.y;
	last->friction = second ? last->held.y : last->held.x;
	return true;
}

/* A force between a slot and a partner in a step's units; 0 if it is too large for either to begin with. */
float force_begun(RECORD_IN(slots), int s, int partner, float force, float length)
{
	float start = (force * length) * length, inverse_mass = CHANNEL(SLOT_LOAD(slots, s, SLOT_MASS), MASS_INVERSE);
	if (partner >= 0)
		inverse_mass = larger(inverse_mass, CHANNEL(SLOT_LOAD(slots, partner, SLOT_MASS), MASS_INVERSE));
	return fabs(start) * inverse_mass <= WARM_MOST ? start : 0.0f;
}

/* Once impulses have stopped what comes together forces let it come nearer by less, and begin with those of the last steps. */
void rests_warm(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(warm), LIST_IN(warm_counts), int s, bool rub,
	float length)
{
	last_forces last = {.partner = PARTNER_NONE};
	for (int point = 0; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global float *at = POINT_OUT(contacts, FOUR_WIDTH, s, point), *grip = POINT_OUT(grips, GRIP_WIDTH, rub ? s : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		if (!last_forces_of(slots, warm, warm_counts, s, other, rub, &last))
			continue;
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
	LIST_IN(warm_counts), int s, bool rub, bool bears, float length)
{
	last_forces last = {.partner = PARTNER_NONE};
	bool same = true;
	for (int point = 0; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global float *at = POINT_OUT(contacts, FOUR_WIDTH, s, point), *grip = POINT_OUT(grips, GRIP_WIDTH, rub ? s : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		if (!last_forces_of(slots, warm, warm_counts, s, other, rub, &last))
			continue;
		bool lasts = force_begun(slots, s, other, last.force, length) > 0.0f, rubs = rub && grip[4 * GRIP_FRICTION] > 0.0f;
		float follow = rubs ? (bears && was_at_rest(pushes, s) && (other < 0 || was_at_rest(pushes, other)) ? 0.0f : GRIP_WARM_FOLLOW) : WARM_FOLLOW;
		at[4 * FOUR_FORCE] = force_mean(at[4 * FOUR_FORCE], last.force, lasts, follow, length);
		if (rub)
			grip[4 * GRIP_FORCE] = force_mean(grip[4 * GRIP_FORCE], last.friction, lasts, follow, length);
		same = same && at[4 * FOUR_FORCE] == last.force && (!rub || grip[4 * GRIP_FORCE] == last.friction);
	}
	return same;
}

/* Keeps the forces on a body, in such a step, for the next one. If this one did not begin with them its island is not to fall asleep. */
void forces_keep(RECORD_IN(slots), LIST_IN(status), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_OUT(touching), LIST_IN(islands), RECORD_IN(pushes),
	RECORD_OUT(warm), LIST_OUT(warm_counts), int s, bool rub, float length)
{
	int body = slot_body(slots, s), count = 0, before = PARTNER_NONE;
	if (!forces_mean(slots, contacts, grips, touching, pushes, warm, warm_counts, s, rub, island_bears(status, touching, islands, s), length))
		island_disturb(touching, islands, s);
	for (int point = 0; point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, s, point), *grip = POINT_IN(grips, GRIP_WIDTH, rub ? s : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		if (other == PARTNER_NONE)
			continue;
		int second = other == before, to = WARM(body, count - second, rub);
		float force = at[4 * FOUR_FORCE], held = grip[4 * GRIP_FORCE];
		warm[to] = second ? (float4)(warm[to].x, warm[to].y, force, 0.0f) : (float4)((float)partner_key(slots, other), force, 0.0f, 0.0f);
		if (rub)
			warm[to + 1] = second ? (float4)(warm[to + 1].x, held, 0.0f, 0.0f) : (float4)(held, 0.0f, 0.0f, 0.0f);
		before = other;
		count += !second;
	}
	warm_counts[body] = count;
}
