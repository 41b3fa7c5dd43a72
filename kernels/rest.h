/* What bodies rest on, of the step contacts: CONTRACT.md, "contacts". */

#define CONTACT(s, k, record) (CONTACT_WIDTH * (CONTACTS_MOST * (s) + (k)) + (record))
#define TOUCH(s, field) (TOUCHING_WIDTH * (s) + (field))
#define GRIP(s, k, record) (GRIP_WIDTH * (CONTACTS_MOST * (s) + (k)) + (record))
#define CONTACTS_ALONE 512 /* bodies for which one group iterates alone */

/* The contacts of one slot, while they are found. */
typedef struct rests {
	int count, keys[CONTACTS_MOST];
	bool rub; /* something does, somewhere */
} rests;

/* A contact, and what its points are judged by: how much the stronger push makes in a step, how near it may come, and how much of its gap it may
 * lose in a step, of a gap that is so much larger than `spared`. */
typedef struct rest {
	float4 pair, points[2], grips[2];
	float force, cushion, ease, spared, friction;
} rest;

rest rest_begin(int partner, float2 n, float force, float slop, int pass, float friction)
{
	rest r;
	r.friction = friction;
	r.grips[0] = r.grips[1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	r.pair = (float4)((float)partner, 0.0f, n.x, n.y);
	r.points[0] = r.points[1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	r.force = force;
	r.cushion = smaller(CUSHION * slop, 0.5f * force);
	r.ease = pass == PASS_IMPULSES ? 1.0f : EASE;
	r.spared = pass == PASS_IMPULSES ? 0.5f * r.cushion : r.cushion;
	return r;
}

/* Along a contact: the normal turned by a quarter. */
float2 aside(float2 n)
{
	return (float2)(-n.y, n.x);
}

/* From a body's centre to where another one touches it, if contacts have `lever`, which is 0 for circles; n is away from it. */
float2 touch_lever(body k, float2 lever, float2 n)
{
	return k.count == 1 ? (float2)(k.radius * n.x, k.radius * n.y) : lever;
}

/* How the body slides at a point, as a record of Grips. */
float4 grip_of(float2 n, float2 v, float w, float2 lever, float other_w, float2 other_lever)
{
	float2 way = aside(n);
	float arm = cross2(lever, way), other_arm = cross2(other_lever, way);
	return (float4)(arm, other_arm, inner(way, v) + (w * arm - other_w * other_arm), 0.0f);
}

/* A point, if it does not come too fast. */
void rest_add(rest *r, float rate, float gap, float arm, float other_arm, float4 grip)
{
	if (rate < -(CONTACT_FAST * r->force))
		return;
	r->points[(int)CHANNEL(r->pair, PAIR_POINTS)] = (float4)(arm, other_arm, rate + r->ease * (larger(gap, 0.0f) - r->spared), 0.0f);
	r->grips[(int)CHANNEL(r->pair, PAIR_POINTS)] = grip;
	CHANNEL(r->pair, PAIR_POINTS) += 1.0f;
}

/* Where its key says; the count is more than CONTACTS_MOST once there are too many. Grips only where there is friction at all. */
void rests_insert(rests *all, RECORD_OUT(contacts), RECORD_OUT(grips), int s, rest r, int key)
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
		for (int i = 0; all->rub && i < GRIP_WIDTH; i++)
			grips[GRIP(s, k, i)] = grips[GRIP(s, k - 1, i)];
	}
	all->keys[k] = key;
	contacts[CONTACT(s, k, CONTACT_PAIR)] = r.pair;
	contacts[CONTACT(s, k, CONTACT_POINT)] = r.points[0];
	contacts[CONTACT(s, k, CONTACT_POINT + 1)] = r.points[1];
	contacts[CONTACT(s, k, CONTACT_START)] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	contacts[CONTACT(s, k, CONTACT_STEPS)] = (float4)(0.0f, 0.0f, CONTACT_PART * (EASE * r.cushion), 0.0f);
	if (!all->rub)
		return;
	grips[GRIP(s, k, GRIP_POINT)] = r.grips[0];
	grips[GRIP(s, k, GRIP_POINT + 1)] = r.grips[1];
	grips[GRIP(s, k, GRIP_STARTS)] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	grips[GRIP(s, k, GRIP_BOUNDS)] = (float4)(r.friction, 0.0f, 0.0f, 0.0f);
}

void rest_on_body(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), int s, int other,
	float length, int pass, rests *all)
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
	rest r = rest_begin(other, n, force, slop, pass, friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), key));
	float2 v = (float2)(own.v.x - partner.v.x, own.v.y - partner.v.y), back = (float2)(-n.x, -n.y);
	for (int i = 0; i < c.count; i++) {
		float gap = c.count > 1 ? inner(c.n, c.ref[i]) - k.offset : k.gap;
		float ref = cross2(c.ref[i], n), inc = cross2(c.inc[i], n);
		float2 lever = touch_lever(own, is_incident ? c.inc[i] : c.ref[i], back),
			   other_lever = touch_lever(partner, is_incident ? c.ref[i] : c.inc[i], n);
		rest_add(&r, c.rate[i], gap, is_incident ? inc : ref, is_incident ? ref : inc, grip_of(n, v, own.w, lever, partner.w, other_lever));
	}
	rests_insert(all, contacts, grips, s, r, key);
}

void rest_on_wall(VERTICES_IN, float4 room, RECORD_OUT(contacts), RECORD_OUT(grips), body k, int s, int wall, int pass, float friction, rests *all)
{
	float offset, force = norm(k.a);
	float2 n = wall_normal(room, wall, &offset), none = (float2)(0.0f, 0.0f);
	float height = inner(n, k.x) - offset, speed = inner(n, k.v);
	rest r = rest_begin(-1 - wall, n, force, wall_slop(k), pass, friction);
	if (k.count == 1) {
		if (height - k.radius <= force)
			rest_add(&r, speed, height - k.radius, 0.0f, 0.0f, grip_of(n, k.v, k.w, touch_lever(k, none, (float2)(-n.x, -n.y)), 0.0f, none));
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
				rest_add(&r, speed - k.w * cross2(n, lever), gap, cross2(lever, n), 0.0f, grip_of(n, k.v, k.w, lever, 0.0f, none));
		}
	}
	rests_insert(all, contacts, grips, s, r, -1 - wall);
}

/* How many contacts the body in a slot has; -1: too many. */
int rests_find(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(contacts), RECORD_OUT(grips), int s,
	float length)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0), room = TEX_LOAD(uniforms, UNIFORMS_ROOM, 0);
	rests all;
	int pass = status[STATUS_PASS];
	all.count = 0;
	all.rub = anything_rubs(TEX(uniforms));
	if (slot_is_static(slots, s))
		return 0;
	body k = body_of(slots, s, trajectory_start(slots, s), length);
	bool by_walls = CHANNEL(rules, RULES_HAS_ROOM) > 0.0f && larger(k.restitution, CHANNEL(rules, RULES_RESTITUTION)) < 1.0f && norm(k.a) > 0.0f;
	float rub = by_walls ? friction_of(TEX(uniforms), TEX(friction), slot_body(slots, s), -1) : 0.0f;
	for (int wall = 0; by_walls && wall < 4; wall++)
		rest_on_wall(VERTICES, room, contacts, grips, k, s, wall, pass, rub, &all);
	int end = spans[SPAN(s, SPAN_END)];
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i))
		rest_on_body(VERTICES, TEX(uniforms), TEX(friction), slots, contacts, grips, s, neighbour_of(neighbours, extra, i), length, pass, &all);
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
		if (rub)
			grips[GRIP(s, k, GRIP_STARTS)] = (float4)(0.0f, 0.0f, 1.0f / gives[2], 1.0f / gives[3]);
	}
}

/* An iteration of the friction at a point of contact k, whose normal force is `force` now: the force from which the next one starts. */
float grip_iterate(RECORD_OUT(grips), int s, int k, int point, float force, float4 load, float4 other_load, float2 n, float tolerance, int done,
	float beta, bool *wanted)
{
	float4 at = grips[GRIP(s, k, GRIP_POINT + point)], starts = grips[GRIP(s, k, GRIP_STARTS)], bounds = grips[GRIP(s, k, GRIP_BOUNDS)];
	float2 way = aside(n);
	float slip = CHANNEL(at, GRIP_RATE) + (load_along(load, way, CHANNEL(at, GRIP_ARM)) - load_along(other_load, way, CHANNEL(at, GRIP_OTHER_ARM)));
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
bool rests_iterate(RECORD_IN(slots), LIST_IN(status), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_OUT(loads), int s, int now,
	int done, float length, bool rub)
{
	bool wanted = false;
	float usual = (float)done / (float)(done + 2), beta = rub ? smaller(usual, GRIP_MOMENTUM) : usual;
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS), load = loads[LOADS_OF(s) + now], next = load_begin(slots, status, s, length);
	CHANNEL(next, LOAD_SHARE) = CHANNEL(load, LOAD_SHARE);
	if (done == 0)
		rests_steps(slots, contacts, grips, touching, loads, s, now, rub);
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
			if (rub) {
				float tolerance = CHANNEL(steps, STEPS_TOLERANCE), grip_arm = CHANNEL(grips[GRIP(s, k, GRIP_POINT + point)], GRIP_ARM);
				float grip = grip_iterate(grips, s, k, point, force, load, other_load, n, tolerance, done, beta, &wanted);
				next = load_add(next, grip, aside(n), grip_arm, mass);
			}
		}
		contacts[CONTACT(s, k, CONTACT_START)] = start;
	}
	loads[LOADS_OF(s) + 1 - now] = next;
	return wanted;
}

/* What all forces on a body come to. */
float4 rests_sum(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub)
{
	float4 sum = (float4)(0.0f, 0.0f, 0.0f, 0.0f), mass = SLOT_LOAD(slots, s, SLOT_MASS);
	for (int k = 0; k < touching[TOUCH(s, TOUCHING_COUNT)]; k++) {
		float4 pair = contacts[CONTACT(s, k, CONTACT_PAIR)];
		float2 n = (float2)(CHANNEL(pair, PAIR_NORMAL_X), CHANNEL(pair, PAIR_NORMAL_Y));
		for (int point = 0; point < (int)CHANNEL(pair, PAIR_POINTS); point++) {
			float4 at = contacts[CONTACT(s, k, CONTACT_POINT + point)];
			sum = load_add(sum, CHANNEL(at, POINT_FORCE), n, CHANNEL(at, POINT_ARM), mass);
			if (rub) {
				float4 grip = grips[GRIP(s, k, GRIP_POINT + point)];
				sum = load_add(sum, CHANNEL(grip, GRIP_FORCE), aside(n), CHANNEL(grip, GRIP_ARM), mass);
			}
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
