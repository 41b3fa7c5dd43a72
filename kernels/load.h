/* The forces between bodies that rest on each other, and what they make of loads, how bodies move in a step: CONTRACT.md, "contacts". Of points, four are
 * side by side. */

/* Four unit vectors along which bodies press, or slide, and their arms about a body's centre. */
typedef struct ways {
	float4 x, y, arm, other_arm;
} ways;

void ways_of_normals(ways *w, RECORD_IN(contacts), int four)
{
	w->x = contacts[FOUR(four, FOUR_NORMAL_X)];
	w->y = contacts[FOUR(four, FOUR_NORMAL_Y)];
	w->arm = contacts[FOUR(four, FOUR_ARM)];
	w->other_arm = contacts[FOUR(four, FOUR_OTHER_ARM)];
}

void ways_of_grips(ways *w, RECORD_IN(grips), int four, const ways *normals)
{
	float4 along = grips[GRIP(four, GRIP_ALONG)];
	w->x = -normals->y * along;
	w->y = normals->x * along;
	w->arm = grips[GRIP(four, GRIP_ARM)];
	w->other_arm = grips[GRIP(four, GRIP_OTHER_ARM)];
}

/* A slot's first four points, in Contacts and in Grips, */
int first_four(LIST_IN(touching), int s)
{
	return touching[TOUCH(s, TOUCHING_FIRST)];
}

/* and the end of its fours. */
int end_four(LIST_IN(touching), int s)
{
	return touching[TOUCH(s, TOUCHING_FIRST)] + (touching[TOUCH(s, TOUCHING_COUNT)] + 3) / 4;
}

/* The first of its points that is one of a contact. */
int first_contact(LIST_IN(touching), int s)
{
	return touching[TOUCH(s, TOUCHING_JOINED)];
}

/* The rows of a body that has points; else there is none. */
joint_row held_row(RECORD_IN(slots), LIST_IN(touching), RECORD_IN(joints), LIST_IN(joined), int s)
{
	joint_row none = {-1, -1, 0, false};
	return first_contact(touching, s) > 0 ? first_row(joints, joined, slot_body(slots, s), true) : none;
}

/* What of its joints holds aside. */
int first_aside_of(RECORD_IN(slots), LIST_IN(touching), RECORD_IN(joints), LIST_IN(joined), int s, float length)
{
	return first_contact(touching, s) > touching[TOUCH(s, TOUCHING_ROWS)] ? first_aside(joints, joined, slot_body(slots, s), length) : -1;
}

/* Those that are not firm. */
joint_row loose_row(RECORD_IN(slots), LIST_IN(touching), RECORD_IN(joints), LIST_IN(joined), int s)
{
	joint_row none = {-1, -1, 0, false};
	return touching[TOUCH(s, TOUCHING_ROWS)] > touching[TOUCH(s, TOUCHING_FIRM)] ? first_row(joints, joined, slot_body(slots, s), false) : none;
}

/* By how much forces move a body, and turn it. */
float4 rests_mass(RECORD_IN(slots), LIST_IN(touching), int s)
{
	float4 mass = SLOT_LOAD(slots, s, SLOT_MASS);
	CHANNEL(mass, MASS_INVERSE_INERTIA) *= as_float(touching[TOUCH(s, TOUCHING_TURNS)]);
	return mass;
}

/* What forces add to a load, x, y and torque: a sum each of every fourth point, and then of those. */
typedef struct sums {
	float4 x, y, torque;
} sums;

void sums_add(sums *all, float4 forces, const ways *w, float4 mass)
{
	float4 straight = CHANNEL(mass, MASS_INVERSE) * forces, turning = CHANNEL(mass, MASS_INVERSE_INERTIA) * forces;
	all->x += straight * w->x;
	all->y += straight * w->y;
	all->torque += turning * w->arm;
}

float4 sums_with(const sums *all, float4 load)
{
	return (float4)(load.x + ((all->x.x + all->x.y) + (all->x.z + all->x.w)), load.y + ((all->y.x + all->y.y) + (all->y.z + all->y.w)),
		load.z + ((all->torque.x + all->torque.y) + (all->torque.z + all->torque.w)), load.w);
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

/* A sum with what four points do, and after each with how it slides. */
float response_add(float sum, float4 normals, float4 grips)
{
	return (((((((sum + normals.x) + grips.x) + normals.y) + grips.y) + normals.z) + grips.z) + normals.w) + grips.w;
}

/* What four forces along such ways do, each as if it alone pushed the body and it gave way by 1. */
typedef struct responses {
	float4 xx, xy, yy, xt, yt, tt;
} responses;

void responses_of(responses *r, const ways *w, float4 mass)
{
	float straight = CHANNEL(mass, MASS_INVERSE), turning = CHANNEL(mass, MASS_INVERSE_INERTIA), both = sqrt(straight) * sqrt(turning);
	float4 gives = straight + turning * (w->arm * w->arm);
	r->xx = (straight / gives) * (w->x * w->x);
	r->xy = (straight / gives) * (w->x * w->y);
	r->yy = (straight / gives) * (w->y * w->y);
	r->xt = (both / gives) * (w->x * w->arm);
	r->yt = (both / gives) * (w->y * w->arm);
	r->tt = (turning / gives) * (w->arm * w->arm);
}

/* What a body's points, each as if it alone pushed it, have to be multiplied with to bound what all of them do together. */
float rests_share(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub)
{
	float4 mass = rests_mass(slots, touching, s), none = (float4)(0.0f);
	response all = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
	for (int four = first_four(touching, s); four < end_four(touching, s); four++) {
		ways normals;
		ways_of_normals(&normals, contacts, four);
		responses n, g = {none, none, none, none, none, none};
		responses_of(&n, &normals, mass);
		if (rub) {
			int4 rubs = grips[GRIP(four, GRIP_FRICTION)] > 0.0f;
			ways along;
			ways_of_grips(&along, grips, four, &normals);
			responses_of(&g, &along, mass);
			g.xx = rubs ? g.xx : none, g.xy = rubs ? g.xy : none, g.yy = rubs ? g.yy : none;
			g.xt = rubs ? g.xt : none, g.yt = rubs ? g.yt : none, g.tt = rubs ? g.tt : none;
		}
		all.xx = response_add(all.xx, n.xx, g.xx);
		all.xy = response_add(all.xy, n.xy, g.xy);
		all.yy = response_add(all.yy, n.yy, g.yy);
		all.xt = response_add(all.xt, n.xt, g.xt);
		all.yt = response_add(all.yt, n.yt, g.yt);
		all.tt = response_add(all.tt, n.tt, g.tt);
	}
	return response_bound(all);
}

/* How a body would move by itself: as it stands in that pass. */
float4 load_alone(RECORD_IN(slots), bool impulses, int s, float length)
{
	float4 push = SLOT_LOAD(slots, s, SLOT_PUSH), place = SLOT_LOAD(slots, s, SLOT_PLACE);
	float4 load = (float4)(CHANNEL(place, LINEAR_VX) * length, CHANNEL(place, LINEAR_VY) * length,
		CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY) * length, 0.0f);
	if (impulses)
		return load;
	return (float4)(load.x + (CHANNEL(push, PUSH_X) * length) * length, load.y + (CHANNEL(push, PUSH_Y) * length) * length,
		load.z + (CHANNEL(push, PUSH_TORQUE) * length) * length, 0.0f);
}

/* What all forces on a body add to a load. */
float4 rests_add(RECORD_IN(slots), RECORD_IN(contacts), RECORD_IN(grips), LIST_IN(touching), int s, bool rub, float4 load)
{
	float4 mass = rests_mass(slots, touching, s), none = (float4)(0.0f);
	sums all = {none, none, none};
	for (int four = first_four(touching, s); four < end_four(touching, s); four++) {
		ways normals;
		ways_of_normals(&normals, contacts, four);
		sums_add(&all, contacts[FOUR(four, FOUR_FORCE)], &normals, mass);
		if (rub) {
			ways along;
			ways_of_grips(&along, grips, four, &normals);
			sums_add(&all, grips[GRIP(four, GRIP_FORCE)], &along, mass);
		}
	}
	return sums_with(&all, load);
}

/* How much a force at a point parts it. */
float point_gives(float4 mass, float arm)
{
	return CHANNEL(mass, MASS_INVERSE) + CHANNEL(mass, MASS_INVERSE_INERTIA) * (arm * arm);
}

/* By how much rates change forces, once all bodies have their share; 0 where there is no point. */
void rests_steps(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(loads), int s, bool rub)
{
	float4 mass = rests_mass(slots, touching, s);
	float share = CHANNEL(loads[s], LOAD_SHARE);
	for (int point = 0, first = first_four(touching, s); point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		__global float *at = POINT_OUT(contacts, FOUR_WIDTH, first, point), *grip = POINT_OUT(grips, GRIP_WIDTH, rub ? first : 0, point);
		int other = (int)at[4 * FOUR_PARTNER];
		for (int i = 0; i < (rub ? 2 : 1); i++) {
			float arm = i ? grip[4 * GRIP_ARM] : at[4 * FOUR_ARM], other_arm = i ? grip[4 * GRIP_OTHER_ARM] : at[4 * FOUR_OTHER_ARM];
			float gives = share * point_gives(mass, arm);
			if (other >= 0)
				gives += CHANNEL(loads[other], LOAD_SHARE) * point_gives(rests_mass(slots, touching, other), other_arm);
			*(i ? &grip[4 * GRIP_STEP] : &at[4 * FOUR_STEP]) = 1.0f / (i ? gives : gives + at[4 * FOUR_GIVE]);
		}
	}
}

/* The loads of four bodies that move, or of what doesn't: x, y and torque side by side. (Here and below results are handed out by pointers, max has two vectors,
 * and there is no any, nor a choice between comparisons: Oclgrind 21.10 gets the shorter forms wrong.) */
typedef struct moves {
	float4 x, y, torque;
} moves;

void moves_of(moves *all, RECORD_IN(loads), float4 partners)
{
	int4 s = max(convert_int4(partners), (int4)(-1));
	float4 a = loads[s.x], b = loads[s.y], c = loads[s.z], d = loads[s.w];
	all->x = (float4)(a.x, b.x, c.x, d.x);
	all->y = (float4)(a.y, b.y, c.y, d.y);
	all->torque = (float4)(a.z, b.z, c.z, d.z);
}

/* How fast points part, or slide. */
float4 rates_of(const ways *w, float4 load, const moves *others)
{
	return ((w->x * load.x + w->y * load.y) + w->arm * load.z) - ((w->x * others->x + w->y * others->y) + w->other_arm * others->torque);
}

/* What four points' friction does in an iteration, once they have new forces. Returns where another one is wanted. */
int4 grips_iterate(RECORD_OUT(grips), int four, float4 force, const ways *w, float4 load, const moves *others, float4 tolerance, int done, float beta)
{
	__global float4 *at = grips + GRIP(four, 0);
	float4 allowed = at[GRIP_FRICTION] * force, bound = at[GRIP_BOUND], step = at[GRIP_STEP], slip = rates_of(w, load, others);
	float4 most = done < GRIP_FOLLOW ? allowed : bound + GRIP_BLEND * (allowed - bound), pushed = at[GRIP_START] - slip * step;
	float4 below = most < pushed ? most : pushed, held = -most > below ? -most : below;
	at[GRIP_BOUND] = most;
	at[GRIP_START] = held + beta * (held - at[GRIP_FORCE]);
	at[GRIP_FORCE] = held;
	tolerance *= done == 0 ? GRIP_BEGUN : (float)(1 << done / GRIP_PATIENCE);
	float4 left = fabs(held) < most ? slip : allowed - most, few = fabs(held) < most ? GRIP_CREEP * tolerance : (GRIP_SLIDE * tolerance) * step;
	return fabs(left) > few;
}

/* Does a point push and pull as is needed: one that is firm, or holds aside, which those from `rows` on do that are of joints? */
float weakest_at(int point, int firm, int rows, int held)
{
	return point < firm || (point >= rows && point < held) ? -INFINITY : 0.0f;
}

/* The least forces of four points, the first of which is that of a body's. */
float4 weakest_of(int point, int firm, int rows, int held)
{
	return (float4)(weakest_at(point, firm, rows, held), weakest_at(point + 1, firm, rows, held), weakest_at(point + 2, firm, rows, held),
		weakest_at(point + 3, firm, rows, held));
}

/* Four points, of which these, from `begin` to `end`, are of rows and not firm, from this row on: their bounds. */
void loose_bounds(RECORD_IN(joints), LIST_IN(joined), joint_row *row, int begin, int end, float4 arm, float4 least, float length, bool impulses,
	float4 *low, float4 *high)
{
	float lows[4] = {low->x, low->y, low->z, low->w}, highs[4] = {INFINITY, INFINITY, INFINITY, INFINITY};
	float arms[4] = {arm.x, arm.y, arm.z, arm.w}, leasts[4] = {least.x, least.y, least.z, least.w};
	for (int i = begin; i < end; i++, row_next(joints, joined, row)) {
		bounds of = bounds_of(joints, row, arms[i], leasts[i], length, impulses);
		lows[i] = of.low;
		highs[i] = of.high;
	}
	*low = (float4)(lows[0], lows[1], lows[2], lows[3]);
	*high = (float4)(highs[0], highs[1], highs[2], highs[3]);
}

/* One iteration of a body's points, after so many, from the loads of one parity to the other; `anew`: with other steps than the one before. True if another is wanted. */
bool rests_iterate(RECORD_IN(slots), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_IN(touching), RECORD_IN(loads), RECORD_OUT(next_loads),
	RECORD_IN(alone), RECORD_IN(joints), LIST_IN(joined), int s, int done, bool rub, bool impulses, bool anew, float length)
{
	float closer = impulses || done == 0 ? 1.0f : CONTACT_CLOSER;
	float beta = (float)done / (float)(done + 2);
	float4 mass = rests_mass(slots, touching, s), load = loads[s], none = (float4)(0.0f);
	sums next = {none, none, none};
	int4 wanted = (int4)(0);
	if (anew)
		rests_steps(slots, contacts, grips, touching, loads, s, rub);
	joint_row row = loose_row(slots, touching, joints, joined, s);
	int held = first_contact(touching, s), firm = touching[TOUCH(s, TOUCHING_FIRM)], rows = touching[TOUCH(s, TOUCHING_ROWS)];
	for (int four = first_four(touching, s), point = 0; four < end_four(touching, s); four++, point += 4) {
		__global float4 *at = contacts + FOUR(four, 0);
		float4 low = weakest_of(point, firm, rows, held), high = (float4)(INFINITY);
		ways normals;
		ways_of_normals(&normals, contacts, four);
		moves others;
		moves_of(&others, loads, at[FOUR_PARTNER]);
		float4 rate = at[FOUR_LEAST] + rates_of(&normals, load, &others), tolerance = at[FOUR_TOLERANCE];
		int begin = max(firm - point, 0), end = min(rows - point, 4);
		if (begin < end)
			loose_bounds(joints, joined, &row, begin, end, normals.arm, at[FOUR_LEAST], length, impulses, &low, &high);
		if (max(firm, point) < held)
			rate += at[FOUR_GIVE] * at[FOUR_START];
		float4 pushed = at[FOUR_START] - rate * at[FOUR_STEP], force = low > pushed ? low : pushed, left = force > low ? fabs(rate) : -rate;
		if (begin < end) {
			left = force > high ? rate : left;
			force = force > high ? high : force;
		}
		float4 start = force + beta * (force - at[FOUR_FORCE]);
		wanted |= left > closer * tolerance;
		at[FOUR_START] = start;
		at[FOUR_FORCE] = force;
		sums_add(&next, start, &normals, mass);
		if (rub) {
			ways along;
			ways_of_grips(&along, grips, four, &normals);
			wanted |= grips_iterate(grips, four, force, &along, load, &others, tolerance, done, smaller(beta, GRIP_MOMENTUM));
			sums_add(&next, grips[GRIP(four, GRIP_START)], &along, mass);
		}
	}
	next_loads[s] = sums_with(&next, alone[s]);
	return is_any(wanted);
}

void velocities_set(RECORD_OUT(slots), int s, float x, float y, float turning)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE), turn = SLOT_LOAD(slots, s, SLOT_TURN);
	CHANNEL(turn, TURN_VELOCITY) = turning;
	slots[SLOT_WIDTH * s + SLOT_PLACE] = (float4)(place.x, place.y, x, y);
	slots[SLOT_WIDTH * s + SLOT_TURN] = turn;
}

/* What a step begins with, to be brought back. */
void slot_keep(RECORD_IN(slots), RECORD_OUT(pushes), int s)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE);
	pushes[PUSHES_WIDTH * s] = SLOT_LOAD(slots, s, SLOT_PUSH);
	pushes[PUSHES_WIDTH * s + 1] = (float4)(place.z, place.w, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_VELOCITY), 0.0f);
	pushes[PUSHES_WIDTH * s + 2] = (float4)(place.x, place.y, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_ANGLE), 0.0f);
}

/* Was that its velocity, and did it not turn? */
bool was_moving_at(RECORD_IN(pushes), int s, float2 velocity)
{
	float4 velocities = pushes[PUSHES_WIDTH * s + 1];
	return velocities.x == velocity.x && velocities.y == velocity.y && velocities.z == 0.0f;
}

bool partner_gives_way(RECORD_IN(slots), int partner)
{
	return partner >= 0 && slot_is_dynamic(slots, partner);
}

/* Was a partner at rest on ground of that velocity? */
bool partner_was_at_rest(RECORD_IN(pushes), int partner, float2 ground)
{
	return partner < 0 ? is_zero(ground) : was_moving_at(pushes, partner, ground);
}

/* Is it at rest where it was at rest before the step? */
bool slot_stayed(RECORD_IN(slots), RECORD_IN(pushes), int s)
{
	float4 place = SLOT_LOAD(slots, s, SLOT_PLACE), turn = SLOT_LOAD(slots, s, SLOT_TURN);
	float4 before = pushes[PUSHES_WIDTH * s + 2];
	return was_moving_at(pushes, s, (float2)(0.0f, 0.0f)) && place.z == 0.0f && place.w == 0.0f && CHANNEL(turn, TURN_VELOCITY) == 0.0f
		&& place.x == before.x && place.y == before.y && CHANNEL(turn, TURN_ANGLE) == before.z;
}

/* But for which body it is, which others look at meanwhile. */
void slot_restore(RECORD_OUT(slots), RECORD_IN(pushes), int s, bool with_velocities)
{
	float4 velocities = pushes[PUSHES_WIDTH * s + 1];
	vstore3(pushes[PUSHES_WIDTH * s].xyz, 0, (__global float *)(slots + SLOT_WIDTH * s + SLOT_PUSH)); /* to write .xyz writes all four */
	if (with_velocities)
		velocities_set(slots, s, velocities.x, velocities.y, velocities.z);
}
