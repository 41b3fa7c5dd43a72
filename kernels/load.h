/* The forces between bodies that rest on each other, and what they make of loads, how bodies move in a step: CONTRACT.md, "contacts". */

/* A load along n and about the centre at its arm. */
float load_along(float4 load, float2 n, float arm)
{
	return (n.x * load.x + n.y * load.y) + arm * load.z;
}

/* What forces add to a load: a sum each of every fourth point, and then of those. */
typedef struct sums {
	float4 of[4];
	int point;
} sums;

sums sums_none(void)
{
	sums none;
	for (int i = 0; i < 4; i++)
		none.of[i] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	none.point = 0;
	return none;
}

/* A force along n, at the point that is now. */
void sums_add(sums *all, float force, float2 n, float arm, float4 mass)
{
	float straight = CHANNEL(mass, MASS_INVERSE) * force, turning = CHANNEL(mass, MASS_INVERSE_INERTIA) * force;
	float4 *to = &all->of[all->point & 3];
	*to = (float4)(to->x + straight * n.x, to->y + straight * n.y, to->z + turning * arm, 0.0f);
}

float4 sums_all(const sums *all, float4 load)
{
	const float4 *of = all->of;
	return load + ((of[0] + of[1]) + (of[2] + of[3]));
}

/* How much a force at a point parts it. */
float point_gives(float4 mass, float arm)
{
	return CHANNEL(mass, MASS_INVERSE) + CHANNEL(mass, MASS_INVERSE_INERTIA) * (arm * arm);
}

/* A symmetric matrix of x, y and turning. */
typedef struct response {
	float xx, xy, yy, xt, yt, tt;
} response;

response response_squared(response m)
{
	response square;
	square.xx = (m.xx * m.xx + m.xy * m.xy) + m.xt * m.xt;
	square.xy = (m.xx * m.xy + m.xy * m.yy) + m.xt * m.yt;
	square.yy = (m.xy * m.xy + m.yy * m.yy) + m.yt * m.yt;
	square.xt = (m.xx * m.xt + m.xy * m.yt) + m.xt * m.tt;
	square.yt = (m.xy * m.xt + m.yy * m.yt) + m.yt * m.tt;
	square.tt = (m.xt * m.xt + m.yt * m.yt) + m.tt * m.tt;
	return square;
}

/* The largest eigenvalue is not larger than its rows, nor than the root of the sum of all eigenvalues' eighth powers, which is near it. */
float response_bound(response m)
{
	float row = larger(larger((fabs(m.xx) + fabs(m.xy)) + fabs(m.xt), (fabs(m.xy) + fabs(m.yy)) + fabs(m.yt)),
		(fabs(m.xt) + fabs(m.yt)) + fabs(m.tt));
	response p = response_squared(response_squared(m));
	float squares = ((p.xx * p.xx + p.yy * p.yy) + p.tt * p.tt) + 2.0f * ((p.xy * p.xy + p.xt * p.xt) + p.yt * p.yt);
	return smaller(row, sqrt(sqrt(sqrt(squares))));
}

/* Adds a force along n with that arm, as if it alone pushed the body. */
void response_add(response *all, float4 mass, float2 n, float arm)
{
	float straight = CHANNEL(mass, MASS_INVERSE), turning = CHANNEL(mass, MASS_INVERSE_INERTIA), both = sqrt(straight) * sqrt(turning);
	float gives = point_gives(mass, arm);
	all->xx += (straight / gives) * (n.x * n.x);
	all->xy += (straight / gives) * (n.x * n.y);
	all->yy += (straight / gives) * (n.y * n.y);
	all->xt += (both / gives) * (n.x * arm);
	all->yt += (both / gives) * (n.y * arm);
	all->tt += (turning / gives) * (arm * arm);
}

/* What a body's points, each as if it alone pushed it, have to be multiplied with to bound what all of them do together. */
float rests_share(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	response all = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		float2 n = (float2)(CHANNEL(pair, PAIR_NORMAL_X), CHANNEL(pair, PAIR_NORMAL_Y));
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++) {
			response_add(&all, mass, n, CHANNEL(contacts[CONTACT(s, k, CONTACT_POINT + point)], POINT_ARM));
			if (rub && grips[GRIP(s, k, GRIP_BOUNDS)].x > 0.0f)
				response_add(&all, mass, aside(n), CHANNEL(grips[GRIP(s, k, GRIP_POINT + point)], GRIP_ARM));
		}
	}
	return response_bound(all);
}

/* How a body would move by itself: as it stands in that pass. */
float4 load_alone(RECORD_IN(slots), LIST_IN(status), int s, float length)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH), place = SLOT_LOAD(slots, s, SLOT_PLACE);
	float4 load = (float4)(CHANNEL(place, LINEAR_VX) * length, CHANNEL(place, LINEAR_VY) * length,
		CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY) * length, 0.0f);
	if (status[STATUS_PASS] == PASS_IMPULSES)
		return load;
	return (float4)(load.x + (CHANNEL(push, PUSH_X) * length) * length, load.y + (CHANNEL(push, PUSH_Y) * length) * length,
		load.z + (CHANNEL(push, PUSH_TORQUE) * length) * length, 0.0f);
}

/* What all forces on a body add to a load. */
float4 rests_add(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub, float4 load)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	sums all = sums_none();
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		float2 n = (float2)(CHANNEL(pair, PAIR_NORMAL_X), CHANNEL(pair, PAIR_NORMAL_Y));
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++, all.point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			sums_add(&all, CHANNEL(at, POINT_FORCE), n, CHANNEL(at, POINT_ARM), mass);
			if (rub) {
				float4 grip = grips[GRIP(s, k, GRIP_POINT + point)];
				sums_add(&all, CHANNEL(grip, GRIP_FORCE), aside(n), CHANNEL(grip, GRIP_ARM), mass);
			}
		}
	}
	return sums_all(&all, load);
}

/* Contacts of which the other body has too many push nothing. */
void rests_drop(RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), int s, bool rub)
{
	float4 none = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		int other = (int)CHANNEL(pair, PAIR_PARTNER);
		if (other < 0 || touching[TOUCH(other, TOUCHING_COUNT)] >= 0)
			continue;
		for (int i = 0; i < CONTACT_WIDTH; i++)
			contacts[CONTACT(s, k, i)] = none;
		contacts[CONTACT(s, k, CONTACT_PAIR)] = (float4)(-1.0f, CHANNEL(pair, PAIR_POINTS), 0.0f, 0.0f);
		for (int i = 0; rub && i < GRIP_WIDTH; i++)
			grips[GRIP(s, k, i)] = none;
	}
}

/* What is begun with, of a force of the last step: in units of this one, and none that is too large for either body. */
float force_begun(float force, float part, float inverse_mass, float length)
{
	float start = part * ((force * length) * length);
	return fabs(start) * inverse_mass <= WARM_MOST ? start : 0.0f;
}

/* Once impulses have stopped what comes together forces let it come nearer by less, and begin with those that pushed there in the last step. */
void rests_warm(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(warm), LIST_IN(warm_counts), int s,
	bool rub, float length)
{
	int body = slot_body(slots, s);
	float own_mass = CHANNEL(SLOT_LOAD(slots, s, SLOT_MASS), MASS_INVERSE);
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float tolerance = CHANNEL(contacts[CONTACT(s, k, CONTACT_STEPS)], STEPS_TOLERANCE);
		int other = (int)CHANNEL(contacts[CONTACT(s, k, CONTACT_PAIR)], PAIR_PARTNER), key = other < 0 ? other : slot_body(slots, other), last = 0;
		while (last < warm_counts[body] && (int)CHANNEL(warm[WARM(body, last, rub)], WARM_PARTNER) != key)
			last++;
		float4 bounds = rub ? grips[GRIP(s, k, GRIP_BOUNDS)] : (float4)(0.0f, 0.0f, 0.0f, 0.0f), forces = 0.0f, held = 0.0f;
		if (last < warm_counts[body] && tolerance > 0.0f) {
			forces = warm[WARM(body, last, rub)];
			held = rub ? warm[WARM(body, last, true) + 1] : held;
		}
		float part = bounds.x > 0.0f ? 1.0f : WARM_PART, mass = other < 0 ? own_mass : larger(own_mass, CHANNEL(SLOT_LOAD(slots, other, SLOT_MASS), MASS_INVERSE));
		float2 start = (float2)(force_begun(forces.y, part, mass, length), force_begun(forces.z, part, mass, length));
		float2 grip = (float2)(force_begun(held.x, part, mass, length), force_begun(held.y, part, mass, length));
		contacts[CONTACT(s, k, CONTACT_START)] = (float4)(start.x, start.y, 0.0f, 0.0f);
		if (rub) {
			grips[GRIP(s, k, GRIP_STARTS)] = (float4)(grip.x, grip.y, 0.0f, 0.0f);
			grips[GRIP(s, k, GRIP_BOUNDS)] = (float4)(bounds.x, bounds.x * start.x, bounds.x * start.y, 0.0f);
		}
		for (int point = 0; point < 2; point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			CHANNEL(at, POINT_LEAST) = EASE * CHANNEL(at, POINT_LEAST) - (0.5f / CONTACT_PART) * tolerance;
			CHANNEL(at, POINT_FORCE) = point ? start.y : start.x;
			contacts[CONTACT(s, k, CONTACT_POINT + point)] = at;
			if (rub)
				CHANNEL(grips[GRIP(s, k, GRIP_POINT + point)], GRIP_FORCE) = point ? grip.y : grip.x;
		}
	}
}

/* By how much rates change forces, once all bodies have their share. */
void rests_steps(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(loads), int s, int now, bool rub)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS), load = loads[LOADS_OF(s) + now];
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 steps = contacts[CONTACT(s, k, CONTACT_STEPS)];
		int other = (int)CHANNEL(contacts[CONTACT(s, k, CONTACT_PAIR)], PAIR_PARTNER);
		float gives[4]; /* of the normals, then of friction */
		for (int i = 0; i < (rub ? 4 : 2); i++) {
			float4 at = i < 2 ? contacts[CONTACT(s, k, CONTACT_POINT + i)] : grips[GRIP(s, k, GRIP_POINT + i - 2)]; /* both begin with arms */
			gives[i] = CHANNEL(load, LOAD_SHARE) * point_gives(mass, CHANNEL(at, POINT_ARM));
			if (other >= 0 && !slot_is_static(slots, other))
				gives[i] += CHANNEL(loads[LOADS_OF(other) + now], LOAD_SHARE)
					* point_gives(SLOT_LOAD(slots, other, SLOT_MASS), CHANNEL(at, POINT_OTHER_ARM));
		}
		contacts[CONTACT(s, k, CONTACT_STEPS)] = (float4)(1.0f / gives[0], 1.0f / gives[1], CHANNEL(steps, STEPS_TOLERANCE), 0.0f);
		if (rub) {
			float4 starts = grips[GRIP(s, k, GRIP_STARTS)];
			grips[GRIP(s, k, GRIP_STARTS)] = (float4)(starts.x, starts.y, 1.0f / gives[2], 1.0f / gives[3]);
		}
	}
}

/* An iteration of the friction at a point of contact k, whose normal force is `force` now: the force from which the next one starts. */
float grip_iterate(RECORD_OUT(grips), int s, int k, int point, float force, float4 load, float4 other_load, float2 n, float tolerance, int done,
	float beta, bool *wanted)
{
	float4 at = grips[GRIP(s, k, GRIP_POINT + point)], starts = grips[GRIP(s, k, GRIP_STARTS)], bounds = grips[GRIP(s, k, GRIP_BOUNDS)];
	float2 way = aside(n);
	float slip = load_along(load, way, CHANNEL(at, GRIP_ARM)) - load_along(other_load, way, CHANNEL(at, GRIP_OTHER_ARM));
	float allowed = bounds.x * force, before = point ? bounds.z : bounds.y, from = point ? starts.y : starts.x, step = point ? starts.w : starts.z;
	float most = done < GRIP_FOLLOW ? allowed : before + GRIP_BLEND * (allowed - before);
	float held = larger(smaller(from - slip * step, most), -most), to = held + beta * (held - CHANNEL(at, GRIP_FORCE));
	if (fabs(held) < most)
		*wanted = *wanted || fabs(slip) > GRIP_CREEP * tolerance;
	else
		*wanted = *wanted || fabs(allowed - most) > (GRIP_SLIDE * tolerance) * step;
	CHANNEL(at, GRIP_FORCE) = held;
	grips[GRIP(s, k, GRIP_POINT + point)] = at;
	grips[GRIP(s, k, GRIP_STARTS)] = point ? (float4)(starts.x, to, starts.z, starts.w) : (float4)(to, starts.y, starts.z, starts.w);
	grips[GRIP(s, k, GRIP_BOUNDS)] = point ? (float4)(bounds.x, bounds.y, most, 0.0f) : (float4)(bounds.x, most, bounds.z, 0.0f);
	return to;
}

/* One iteration of a body's contacts, after so many, from the loads of one parity to the other. True if another is wanted. */
bool rests_iterate(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_OUT(loads), int s, int now, int done, bool rub)
{
	bool wanted = false;
	float usual = (float)done / (float)(done + 2), beta = rub ? smaller(usual, GRIP_MOMENTUM) : usual;
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS), load = loads[LOADS_OF(s) + now];
	sums next = sums_none();
	if (done == 0)
		rests_steps(slots, contacts, grips, touching, loads, s, now, rub);
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)], start = contacts[CONTACT(s, k, CONTACT_START)];
		float4 steps = contacts[CONTACT(s, k, CONTACT_STEPS)], other_load = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
		float2 n = (float2)(CHANNEL(pair, PAIR_NORMAL_X), CHANNEL(pair, PAIR_NORMAL_Y));
		int other = (int)CHANNEL(pair, PAIR_PARTNER);
		if (other >= 0 && !slot_is_static(slots, other))
			other_load = loads[LOADS_OF(other) + now];
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++, next.point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			float arm = CHANNEL(at, POINT_ARM), from = point ? start.y : start.x, step = point ? steps.y : steps.x;
			float rate = CHANNEL(at, POINT_LEAST) + (load_along(load, n, arm) - load_along(other_load, n, CHANNEL(at, POINT_OTHER_ARM)));
			float force = larger(from - rate * step, 0.0f), to = force + beta * (force - CHANNEL(at, POINT_FORCE));
			wanted = wanted || (force > 0.0f ? fabs(rate) : -rate) > CHANNEL(steps, STEPS_TOLERANCE);
			start = point ? (float4)(start.x, to, 0.0f, 0.0f) : (float4)(to, start.y, 0.0f, 0.0f);
			CHANNEL(at, POINT_FORCE) = force;
			contacts[CONTACT(s, k, CONTACT_POINT + point)] = at;
			sums_add(&next, to, n, arm, mass);
			if (rub) {
				float tolerance = CHANNEL(steps, STEPS_TOLERANCE), grip_arm = CHANNEL(grips[GRIP(s, k, GRIP_POINT + point)], GRIP_ARM);
				float grip = grip_iterate(grips, s, k, point, force, load, other_load, n, tolerance, done, beta, &wanted);
				sums_add(&next, grip, aside(n), grip_arm, mass);
			}
		}
		contacts[CONTACT(s, k, CONTACT_START)] = start;
	}
	loads[LOADS_OF(s) + 1 - now] = sums_all(&next, loads[LOADS_OF(s) + LOADS_ALONE]);
	return wanted;
}

void velocities_set(RECORD_OUT(slots), int s, float x, float y, float turning)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE), turn = SLOT_LOAD(slots, s, SLOT_TURN);
	CHANNEL(turn, TURN_VELOCITY) = turning;
	slots[SLOT_WIDTH * s + SLOT_PLACE] = (float4)(place.x, place.y, x, y);
	slots[SLOT_WIDTH * s + SLOT_TURN] = turn;
}

/* What a body's forces come to, in such a step, changes its velocities at once, or its push. */
void slot_take(RECORD_OUT(slots), LIST_IN(status), int s, float4 sum, float length)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH), place = SLOT_LOAD(slots, s, SLOT_PLACE);
	float x = sum.x / length, y = sum.y / length, torque = sum.z / length;
	if (status[STATUS_PASS] == PASS_IMPULSES)
		velocities_set(slots, s, place.z + x, place.w + y, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY) + torque);
	else
		slots[SLOT_WIDTH * s + SLOT_PUSH] = (float4)(push.x + x / length, push.y + y / length, push.z + torque / length, push.w);
}

/* What a step begins with, to be brought back. */
void slot_keep(RECORD_IN(slots), RECORD_OUT(pushes), int s)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE);
	pushes[PUSHES_WIDTH * s] = SLOT_LOAD(slots, s, SLOT_PUSH);
	pushes[PUSHES_WIDTH * s + 1] = (float4)(place.z, place.w, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY), 0.0f);
}

/* But for which body it is, which others look at meanwhile. */
void slot_restore(RECORD_OUT(slots), RECORD_IN(pushes), int s, bool with_velocities)
{
	float4 velocities = pushes[PUSHES_WIDTH * s + 1];
	slots[SLOT_WIDTH * s + SLOT_PUSH].xyz = pushes[PUSHES_WIDTH * s].xyz;
	if (with_velocities)
		velocities_set(slots, s, velocities.x, velocities.y, velocities.z);
}

/* Keeps the forces on a body, in such a step, for the next one. */
void forces_keep(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), RECORD_OUT(warm), LIST_OUT(warm_counts), int s, bool rub,
	float length)
{
	int body = slot_body(slots, s), count = 0;
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		int other = (int)CHANNEL(pair, PAIR_PARTNER), points = (int)CHANNEL(pair, PAIR_POINTS), at = WARM(body, count, rub);
		if (!(CHANNEL(contacts[CONTACT(s, k, CONTACT_STEPS)], STEPS_TOLERANCE) > 0.0f))
			continue;
		float4 first = contacts[CONTACT(s, k, CONTACT_POINT)], second = contacts[CONTACT(s, k, CONTACT_POINT + 1)];
		warm[at] = (float4)((float)(other < 0 ? other : slot_body(slots, other)), (CHANNEL(first, POINT_FORCE) / length) / length,
			points > 1 ? (CHANNEL(second, POINT_FORCE) / length) / length : 0.0f, 0.0f);
		if (rub) {
			first = grips[GRIP(s, k, GRIP_POINT)], second = grips[GRIP(s, k, GRIP_POINT + 1)];
			warm[at + 1] = (float4)((CHANNEL(first, GRIP_FORCE) / length) / length,
				points > 1 ? (CHANNEL(second, GRIP_FORCE) / length) / length : 0.0f, 0.0f, 0.0f);
		}
		count++;
	}
	warm_counts[body] = count;
}

/* A slot's push or velocities are others: all around looks at it again, and it may get farther. True if that is where it was not looked for. */
bool slot_changed(TEX_IN(uniforms), RECORD_OUT(slots), LIST_OUT(status), RECORD_OUT(reach), LIST_OUT(wakes), LIST_OUT(movers), int s, int room)
{
	wakes[WAKE(s, WAKE_CHANGED)] = wakes[WAKE(s, WAKE_NEXT)] = status[STATUS_AGE];
	return reach_keep(TEX(uniforms), slots, reach, status, wakes, movers, s, room);
}
