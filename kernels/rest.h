/* What bodies rest on, of the step contacts: CONTRACT.md, "contacts". */

#define CONTACT(s, k, record) (CONTACT_WIDTH * (CONTACTS_MOST * (s) + (k)) + (record))
#define TOUCH(s, field) (TOUCHING_WIDTH * (s) + (field))
#define CONTACTS_ALONE 512 /* bodies for which one group iterates alone */

/* The contacts of one slot, while they are found. */
typedef struct rests {
	int count, keys[CONTACTS_MOST];
} rests;

/* A contact, and what its points are judged by: how much the stronger push makes in a step, how near it may come, and how much of its gap it may
 * lose in a step, of a gap that is so much larger than `spared`. */
typedef struct rest {
	float4 pair, points[2];
	float force, cushion, ease, spared;
} rest;

rest rest_begin(int partner, float2 n, float force, float slop, int pass)
{
	rest r;
	r.pair = (float4)((float)partner, 0.0f, n.x, n.y);
	r.points[0] = r.points[1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	r.force = force;
	r.cushion = smaller(CUSHION * slop, 0.5f * force);
	r.ease = pass == PASS_IMPULSES ? 1.0f : EASE;
	r.spared = pass == PASS_IMPULSES ? 0.5f * r.cushion : r.cushion;
	return r;
}

/* A point, if it does not come too fast. */
void rest_add(rest *r, float rate, float gap, float arm, float other_arm)
{
	if (rate < -(CONTACT_FAST * r->force))
		return;
	r->points[(int)CHANNEL(r->pair, PAIR_POINTS)] = (float4)(arm, other_arm, rate + r->ease * (larger(gap, 0.0f) - r->spared), 0.0f);
	CHANNEL(r->pair, PAIR_POINTS) += 1.0f;
}

/* Where its key says; the count is more than CONTACTS_MOST once there are too many. */
void rests_insert(rests *all, RECORD_OUT(contacts), int s, rest r, int key)
{
	if (!(CHANNEL(r.pair, PAIR_POINTS) > 0.0f) || all->count > CONTACTS_MOST)
		return;
	int k = all->count++;
	if (k == CONTACTS_MOST)
		return;
	for (; k > 0 && all->keys[k - 1] > key; k--) {
		all->keys[k] = all->keys[k - 1];
		for (int i = 0; i < CONTACT_WIDTH; i++)
			contacts[CONTACT(s, k, i)] = contacts[CONTACT(s, k - 1, i)];
	}
	all->keys[k] = key;
	contacts[CONTACT(s, k, CONTACT_PAIR)] = r.pair;
	contacts[CONTACT(s, k, CONTACT_POINT)] = r.points[0];
	contacts[CONTACT(s, k, CONTACT_POINT + 1)] = r.points[1];
	contacts[CONTACT(s, k, CONTACT_START)] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	contacts[CONTACT(s, k, CONTACT_STEPS)] = (float4)(0.0f, 0.0f, CONTACT_PART * (EASE * r.cushion), 0.0f);
}

void rest_on_body(VERTICES_IN, RECORD_IN(slots), RECORD_OUT(contacts), int s, int other, float length, int pass, rests *all)
{
	body own = body_of(slots, s, trajectory_start(slots, s), length), partner = body_of(slots, other, trajectory_start(slots, other), length);
	float force = larger(norm(own.a), norm(partner.a));
	float2 d = (float2)(partner.x.x - own.x.x, partner.x.y - own.x.y);
	if (!(larger(own.restitution, partner.restitution) < 1.0f) || !(force > 0.0f) || norm(d) - (own.radius + partner.radius) > force)
		return;
	int key = slot_body(slots, other);
	bool is_row = slot_body(slots, s) > key;
	body a = is_row ? own : partner, b = is_row ? partner : own;
	pose p = pose_at(a, b, 0.0f);
	axis k = best_axis(VERTICES, a, b, p);
	float slop = pair_slop(a, b);
	if (k.gap > force || k.gap < -(SUNK_MOST * slop))
		return;
	contact c = contact_at(VERTICES, a, b, p, k, force - k.gap);
	bool is_incident = is_row == c.swapped;
	float2 n = is_incident ? c.n : (float2)(-c.n.x, -c.n.y);
	rest r = rest_begin(other, n, force, slop, pass);
	for (int i = 0; i < c.count; i++) {
		float gap = c.count > 1 ? inner(c.n, c.ref[i]) - k.offset : k.gap;
		float ref = cross2(c.ref[i], n), inc = cross2(c.inc[i], n);
		rest_add(&r, c.rate[i], gap, is_incident ? inc : ref, is_incident ? ref : inc);
	}
	rests_insert(all, contacts, s, r, key);
}

void rest_on_wall(VERTICES_IN, float4 room, RECORD_OUT(contacts), body k, int s, int wall, int pass, rests *all)
{
	float offset, force = norm(k.a);
	float2 n = wall_normal(room, wall, &offset);
	float height = inner(n, k.x) - offset, speed = inner(n, k.v);
	rest r = rest_begin(-1 - wall, n, force, wall_slop(k), pass);
	if (k.count == 1) {
		if (height - k.radius <= force)
			rest_add(&r, speed, height - k.radius, 0.0f, 0.0f);
	} else {
		float2 rotation = body_rotation(k, 0.0f), m = turn_back(rotation, n);
		int deepest;
		lowest(VERTICES, k, m, &deepest);
		float2 low = vertex_load(VERTICES, k.first, deepest);
		float2 before = vertex_load(VERTICES, k.first, deepest > 0 ? deepest - 1 : k.count - 1);
		float2 after = vertex_load(VERTICES, k.first, deepest + 1 < k.count ? deepest + 1 : 0);
		float2 ends[2] = {low, inner(m, after) < inner(m, before) ? after : before};
		for (int i = 0; i < 2; i++) {
			float gap = height + inner(m, ends[i]);
			float2 lever = turn(rotation, ends[i]);
			if (gap <= force)
				rest_add(&r, speed - k.w * cross2(n, lever), gap, cross2(lever, n), 0.0f);
		}
	}
	rests_insert(all, contacts, s, r, -1 - wall);
}

/* How many contacts the body in a slot has; -1: too many. */
int rests_find(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, RECORD_OUT(contacts), int s, float length)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0), room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0);
	rests all;
	int pass = status[STATUS_PASS];
	all.count = 0;
	if (slot_is_static(slots, s))
		return 0;
	body k = body_of(slots, s, trajectory_start(slots, s), length);
	bool by_walls = CHANNEL(rules, RULES_HAS_ROOM) > 0.0f && larger(k.restitution, CHANNEL(rules, RULES_RESTITUTION)) < 1.0f && norm(k.a) > 0.0f;
	for (int wall = 0; by_walls && wall < 4; wall++)
		rest_on_wall(VERTICES, room, contacts, k, s, wall, pass, &all);
	int end = spans[SPAN(s, SPAN_END)];
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i))
		rest_on_body(VERTICES, slots, contacts, s, neighbour_of(neighbours, extra, i), length, pass, &all);
	return all.count > CONTACTS_MOST ? -1 : all.count;
}

/* An acceleration along n and about the centre at its arm. */
float load_along(float4 load, float2 n, float arm)
{
	return (n.x * load.x + n.y * load.y) + arm * load.z;
}

float4 load_add(float4 load, float force, float2 n, float arm, float4 mass)
{
	float straight = CHANNEL(mass, MASS_INVERSE) * force, turning = CHANNEL(mass, MASS_INVERSE_INERTIA) * force;
	return (float4)(load.x + straight * n.x, load.y + straight * n.y, load.z + turning * arm, load.w);
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

/* What a body's points, each as if it alone pushed it, have to be multiplied with to bound what all of them do together. */
float rests_share(RECORD_IN(slots), RECORD_IN(contacts), LIST_IN(touching), int s)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	float straight = CHANNEL(mass, MASS_INVERSE), turning = CHANNEL(mass, MASS_INVERSE_INERTIA), both = sqrt(straight) * sqrt(turning);
	response all = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		float x = CHANNEL(pair, PAIR_NORMAL_X), y = CHANNEL(pair, PAIR_NORMAL_Y);
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++) {
			float arm = CHANNEL(contacts[CONTACT(s, k, CONTACT_POINT + point)], POINT_ARM), gives = point_gives(mass, arm);
			all.xx += (straight / gives) * (x * x);
			all.xy += (straight / gives) * (x * y);
			all.yy += (straight / gives) * (y * y);
			all.xt += (both / gives) * (x * arm);
			all.yt += (both / gives) * (y * arm);
			all.tt += (turning / gives) * (arm * arm);
		}
	}
	return response_bound(all);
}

/* What acts on a body besides, in a step that is 1 long: on what is stopped at once nothing. */
float4 load_begin(RECORD_IN(slots), LIST_IN(status), int s, float length)
{
	if (status[STATUS_PASS] == PASS_IMPULSES)
		return (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH);
	return (float4)((CHANNEL(push, PUSH_X) * length) * length, (CHANNEL(push, PUSH_Y) * length) * length,
		(CHANNEL(push, PUSH_TORQUE) * length) * length, 0.0f);
}

/* By how much rates change forces, once all bodies have their share. */
void rests_steps(RECORD_IN(slots), RECORD_OUT(contacts), LIST_IN(touching), RECORD_IN(loads), int s, int now)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS), load = loads[LOADS_OF(s) + now];
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 steps = contacts[CONTACT(s, k, CONTACT_STEPS)];
		int other = (int)CHANNEL(contacts[CONTACT(s, k, CONTACT_PAIR)], PAIR_PARTNER);
		bool moves = other >= 0 && !slot_is_static(slots, other);
		float gives[2];
		for (int point = 0; point < 2; point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			gives[point] = CHANNEL(load, LOAD_SHARE) * point_gives(mass, CHANNEL(at, POINT_ARM));
			if (moves)
				gives[point] += CHANNEL(loads[LOADS_OF(other) + now], LOAD_SHARE)
					* point_gives(SLOT_LOAD(slots, other, SLOT_MASS), CHANNEL(at, POINT_OTHER_ARM));
		}
		contacts[CONTACT(s, k, CONTACT_STEPS)] = (float4)(1.0f / gives[0], 1.0f / gives[1], CHANNEL(steps, STEPS_TOLERANCE), 0.0f);
	}
}

/* One iteration of a body's contacts, after so many, from the loads of one parity to the other. True if another is wanted. */
bool rests_iterate(RECORD_IN(slots), LIST_IN(status), RECORD_OUT(contacts), LIST_IN(touching), RECORD_OUT(loads), int s, int now, int done,
	float length)
{
	bool wanted = false;
	float beta = (float)done / (float)(done + 2);
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS), load = loads[LOADS_OF(s) + now], next = load_begin(slots, status, s, length);
	CHANNEL(next, LOAD_SHARE) = CHANNEL(load, LOAD_SHARE);
	if (done == 0)
		rests_steps(slots, contacts, touching, loads, s, now);
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)], start = contacts[CONTACT(s, k, CONTACT_START)];
		float4 steps = contacts[CONTACT(s, k, CONTACT_STEPS)], other_load = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
		float2 n = (float2)(CHANNEL(pair, PAIR_NORMAL_X), CHANNEL(pair, PAIR_NORMAL_Y));
		int other = (int)CHANNEL(pair, PAIR_PARTNER);
		if (other >= 0 && !slot_is_static(slots, other))
			other_load = loads[LOADS_OF(other) + now];
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			float arm = CHANNEL(at, POINT_ARM), from = point ? start.y : start.x, step = point ? steps.y : steps.x;
			float rate = CHANNEL(at, POINT_RATE) + (load_along(load, n, arm) - load_along(other_load, n, CHANNEL(at, POINT_OTHER_ARM)));
			float force = larger(from - rate * step, 0.0f), to = force + beta * (force - CHANNEL(at, POINT_FORCE));
			wanted = wanted || (force > 0.0f ? fabs(rate) : -rate) > CHANNEL(steps, STEPS_TOLERANCE);
			start = point ? (float4)(start.x, to, 0.0f, 0.0f) : (float4)(to, start.y, 0.0f, 0.0f);
			CHANNEL(at, POINT_FORCE) = force;
			contacts[CONTACT(s, k, CONTACT_POINT + point)] = at;
			next = load_add(next, to, n, arm, mass);
		}
		contacts[CONTACT(s, k, CONTACT_START)] = start;
	}
	loads[LOADS_OF(s) + 1 - now] = next;
	return wanted;
}

/* What all forces on a body come to. */
float4 rests_sum(RECORD_IN(slots), RECORD_IN(contacts), LIST_IN(touching), int s)
{
	float4 sum = (float4)(0.0f, 0.0f, 0.0f, 0.0f), mass = SLOT_LOAD(slots, s, SLOT_MASS);
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		float2 n = (float2)(CHANNEL(pair, PAIR_NORMAL_X), CHANNEL(pair, PAIR_NORMAL_Y));
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			sum = load_add(sum, CHANNEL(at, POINT_FORCE), n, CHANNEL(at, POINT_ARM), mass);
		}
	}
	return sum;
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

void slot_restore(RECORD_OUT(slots), RECORD_IN(pushes), int s, bool with_velocities)
{
	float4 velocities = pushes[PUSHES_WIDTH * s + 1];
	slots[SLOT_WIDTH * s + SLOT_PUSH] = pushes[PUSHES_WIDTH * s];
	if (with_velocities)
		velocities_set(slots, s, velocities.x, velocities.y, velocities.z);
}

/* A slot's push or velocities are others: all around looks at it again, and it may get farther. True if that is where it was not looked for. */
bool slot_changed(TEX_IN(uniforms), RECORD_OUT(slots), LIST_OUT(status), RECORD_OUT(reach), LIST_OUT(wakes), LIST_OUT(movers), int s, int room)
{
	wakes[WAKE(s, WAKE_CHANGED)] = wakes[WAKE(s, WAKE_NEXT)] = status[STATUS_AGE];
	return reach_keep(TEX(uniforms), slots, reach, status, wakes, movers, s, room);
}
