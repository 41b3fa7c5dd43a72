/* A hit that joints pass on at once: CONTRACT.md, "The step contacts", Tugs. Its parties are a list as a shock's are, and so are their points, of which the first one's first is where the
 * two hit each other, and the others are of joints. */

/* The two that were hit, the first of which is dynamic: their slots, and how they moved before. */
typedef struct struck {
	int one, other;
	trajectory before, other_before;
	float2 point, n; /* n: towards the first */
	float2 impulse;  /* on it */
	float friction;
} struck;

/* How the body in a slot moves at the tug's time: as it was before it was hit, or before the tug. */
trajectory tug_way(RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), RECORD_OUT(work), LIST_IN(owners), RECORD_OUT(shocks), int s, bool was,
	const struck *hit, const shock *all)
{
	int party = party_of(members, owners, s, all);
	if (was && s == hit->one)
		return hit->before;
	if (was && s == hit->other)
		return hit->other_before;
	return party >= 0 ? party_before(work, shocks, party) : shock_way(slots, status, members, work, owners, s, all);
}

/* Has a party, if it is one, points of joints with slot s? Then that is party id by now. */
bool joints_meet(RECORD_OUT(shocks), int party, int s, int id)
{
	bool any = false;
	for (int point = 0; party >= 0 && point < SHOCK_POINTS && !point_is_none(shocks[SHOCK(party, point) + SHOCK_PUSH]); point++) {
		__global float4 *at = shocks + SHOCK(party, point);
		if (CHANNEL(at[SHOCK_GRIP], SHOCK_FRICTION) == SHOCK_JOINT && CHANNEL(at[SHOCK_PUSH], SHOCK_PARTNER) == (float)s) {
			at[SHOCK_PUSH] = (float4)((float)s, (float)id, 0.0f, 0.0f);
			any = true;
		}
	}
	return any;
}

/* Does a joint's point hold nothing, since in the step it brings the anchors so far, or since by now they part so much faster, or slower, than its force would have it? In m a whole
 * step. */
bool joint_is_loose(RECORD_IN(slots), int s, int partner, float2 n, float arm, float other_arm, float least, float part, const shock *all)
{
	float radii = CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS), other = 0.0f;
	if (partner >= 0) {
		radii += CHANNEL(SLOT_LOAD(slots, partner, SLOT_TURN), TURN_RADIUS);
		other = way_speed(trajectory_start(slots, partner), n, other_arm);
	}
	float begun = (way_speed(trajectory_start(slots, s), n, arm) - other) * all->whole, more = -least - begun;
	float way = all->share * begun + (0.5f * (all->share * all->share)) * more, planned = begun + (all->time * all->share) * more;
	return larger(magnitude(way), magnitude(part * all->whole - planned)) > TUG_LOOSE * radii;
}

/* A party more: it is moved to the time, and its points of joints come behind so many others. They are to have the rates that they had, or none if the tug `stops`. */
bool tug_open(RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), RECORD_OUT(shocks), LIST_IN(touching),
	RECORD_IN(contacts), int id, int one, int point, bool stops, const struck *hit, shock *all, int *first_joined)
{
	int s = active[id], first = touching[TOUCH(s, TOUCHING_FIRST)];
	party_begin(slots, work, shocks, s, id, all);
	for (int other = 0; other < point; other++) { /* until they are there */
		shocks[SHOCK(id, other) + SHOCK_GRIP] = (float4)(0.0f);
		shocks[SHOCK(id, other) + SHOCK_PUSH] = (float4)((float)PARTNER_WALL(0), -1.0f, 0.0f, 0.0f);
	}
	for (int lane = 0; lane < touching[TOUCH(s, TOUCHING_FIRM)] && point < SHOCK_POINTS; lane++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, lane);
		int partner = (int)at[4 * FOUR_PARTNER], party = partner >= 0 ? party_of(members, owners, partner, all) : -1;
		if (joints_meet(shocks, party, s, id))
			continue;
		if (party < 0 && partner >= 0 && slot_is_dynamic(slots, partner)
			&& join(slots, LISTS, work, owners, parents, partner, one, all->leader, all->head, all->round, first_joined) < 0)
			return false;
		float2 n = (float2)(at[4 * FOUR_NORMAL_X], at[4 * FOUR_NORMAL_Y]);
		float arm = at[4 * FOUR_ARM], other_arm = at[4 * FOUR_OTHER_ARM], coming = 0.0f;
		float part = way_speed(tug_way(slots, status, members, work, owners, shocks, s, true, hit, all), n, arm);
		if (partner >= 0) {
			part -= way_speed(tug_way(slots, status, members, work, owners, shocks, partner, true, hit, all), n, other_arm);
			if (party < 0)
				coming = way_speed(tug_way(slots, status, members, work, owners, shocks, partner, false, hit, all), n, other_arm);
		}
		if (joint_is_loose(slots, s, partner, n, arm, other_arm, at[4 * FOUR_LEAST], part, all))
			continue;
		__global float4 *to = shocks + SHOCK(id, point++);
		to[SHOCK_NORMAL] = (float4)(n.x, n.y, arm, other_arm);
		to[SHOCK_GRIP] = (float4)(0.0f, 0.0f, SHOCK_JOINT, stops ? 0.0f : part);
		to[SHOCK_PUSH] = (float4)((float)partner, (float)party, party < 0 && partner >= 0 && slot_is_dynamic(slots, partner) ? coming : 0.0f, 0.0f);
	}
	if (point < SHOCK_POINTS)
		shocks[SHOCK(id, point) + SHOCK_PUSH] = (float4)((float)PARTNER_NONE, -1.0f, 0.0f, 0.0f);
	party_add(members, id, all);
	return true;
}

/* Where the two hit each other; how much the hit has changed their rate. */
float tug_strike(RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_IN(owners), RECORD_OUT(shocks), int id,
	int other, const struck *hit, const shock *all)
{
	__global float4 *to = shocks + SHOCK(id, 0);
	float4 place = work[WORK_WIDTH * id + WORK_PLACE];
	float2 n = hit->n, along = aside(n), lever = (float2)(hit->point.x - CHANNEL(place, LINEAR_X), hit->point.y - CHANNEL(place, LINEAR_Y));
	float arm = cross2(lever, n), other_arm = 0.0f, other_grip_arm = 0.0f, total = inner(hit->impulse, n);
	if (hit->other >= 0) {
		float4 at = tug_way(slots, status, members, work, owners, shocks, hit->other, false, hit, all).place;
		float2 other_lever = (float2)(hit->point.x - CHANNEL(at, LINEAR_X), hit->point.y - CHANNEL(at, LINEAR_Y));
		other_arm = cross2(other_lever, n);
		other_grip_arm = cross2(other_lever, along);
	}
	float4 push = (float4)((float)hit->other, (float)other, total, inner(hit->impulse, along));
	to[SHOCK_NORMAL] = (float4)(n.x, n.y, arm, other_arm);
	to[SHOCK_GRIP] = (float4)(cross2(lever, along), other_grip_arm, hit->friction, parting(slots, work, id, push, n, arm, other_arm));
	to[SHOCK_PUSH] = push;
	float gives = gives_at(member_gives(slots, active, work, id), arm) + gives_at(member_gives(slots, active, work, other), other_arm);
	return total * gives;
}

/* Gives an open point the rate that it is to have. */
bool tug_push(RECORD_IN(slots), LIST_IN(active), RECORD_OUT(work), RECORD_OUT(shocks), int id, int point, float least)
{
	__global float4 *at = shocks + SHOCK(id, point);
	float farther = CHANNEL(at[SHOCK_GRIP], SHOCK_FRICTION) == SHOCK_JOINT ? TUG_FARTHER : 1.0f;
	return point_push(slots, active, work, shocks, id, point, point_rate(slots, work, id, at[SHOCK_NORMAL], at[SHOCK_PUSH]), farther, least);
}

/* Is a party's point one of a joint with a body that the hit has not got to, and which it would move? */
bool tug_goes_on(RECORD_IN(slots), RECORD_OUT(work), RECORD_OUT(shocks), int id, int point, float least)
{
	__global float4 *at = shocks + SHOCK(id, point);
	float rate = point_rate(slots, work, id, at[SHOCK_NORMAL], at[SHOCK_PUSH]);
	return magnitude(CHANNEL(at[SHOCK_GRIP], SHOCK_PART) - rate) >= least;
}

/* What joints gave: their anchors have speeds against each other where they are being brought to where they belong. */
float tug_gain(RECORD_IN(slots), LIST_OUT(members), RECORD_OUT(shocks), int one, const shock *all)
{
	float gain = 0.0f;
	for (int id = all->first; id >= 0; id = party_next(members, id))
		for (int point = id == one ? 1 : 0; point < SHOCK_POINTS; point++) {
			float4 push = shocks[SHOCK(id, point) + SHOCK_PUSH];
			if (point_is_none(push))
				break;
			gain += point_is_open(slots, push) ? CHANNEL(push, SHOCK_IMPULSE) * CHANNEL(shocks[SHOCK(id, point) + SHOCK_GRIP], SHOCK_PART) : 0.0f;
		}
	return gain;
}

/* All move as before it, and the hit is what it was; joints are to have no speeds, and so give nothing. */
void tug_begin_anew(RECORD_IN(slots), LIST_OUT(members), RECORD_OUT(work), RECORD_OUT(shocks), const struck *hit, const shock *all)
{
	__global float4 *struck_at = shocks + SHOCK(all->first, 0) + SHOCK_PUSH;
	for (int id = all->first; id >= 0; id = party_next(members, id)) {
		work_store(work, id, party_before(work, shocks, id));
		for (int point = id == all->first ? 1 : 0; point < SHOCK_POINTS; point++) {
			__global float4 *at = shocks + SHOCK(id, point);
			float4 push = at[SHOCK_PUSH];
			if (point_is_none(push))
				break;
			CHANNEL(at[SHOCK_GRIP], SHOCK_PART) = 0.0f;
			if (point_is_open(slots, push))
				CHANNEL(at[SHOCK_PUSH], SHOCK_IMPULSE) = 0.0f;
		}
	}
	CHANNEL(*struck_at, SHOCK_IMPULSE) = inner(hit->impulse, hit->n);
	CHANNEL(*struck_at, SHOCK_RUB) = inner(hit->impulse, aside(hit->n));
}

#define TUG_LOST 0    /* the cluster has to be given up */
#define TUG_ENDS 1    /* sweeps came to an end, */
#define TUG_GOES_ON 2 /* or did not */

/* In sweeps over all points, until they do no more. */
int tug_sweep(RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), RECORD_OUT(shocks), LIST_IN(touching),
	RECORD_IN(contacts), int one, float least, bool stops, const struck *hit, shock *all, int *first)
{
	bool more = true;
	for (int sweep = 0; sweep < TUG_SWEEPS && more; sweep++) {
		more = false;
		for (int id = all->first; id >= 0; id = party_next(members, id))
			for (int point = id == one ? 1 : 0; point < SHOCK_POINTS; point++) {
				float4 push = shocks[SHOCK(id, point) + SHOCK_PUSH];
				if (point_is_none(push))
					break;
				if (!point_is_open(slots, push)) {
					int partner = (int)CHANNEL(push, SHOCK_PARTNER), party = party_of(members, owners, partner, all);
					if (party < 0) {
						if (all->count == SHOCK_PARTIES || !tug_goes_on(slots, work, shocks, id, point, least))
							continue;
						party = number_of_own(members, owners, partner, all->leader); /* it is one of the cluster since this party is open */
						if (!tug_open(slots, LISTS, work, owners, parents, shocks, touching, contacts, party, one, 0, stops, hit, all, first))
							return TUG_LOST;
					}
					/* also where that one has no room for this point */
					shocks[SHOCK(id, point) + SHOCK_PUSH] = (float4)((float)partner, (float)party, 0.0f, 0.0f);
				}
				more |= tug_push(slots, active, work, shocks, id, point, least);
			}
		more |= tug_push(slots, active, work, shocks, one, 0, least); /* in the end the two part, whatever joints wanted */
	}
	return more ? TUG_GOES_ON : TUG_ENDS;
}

/* Is something kinematic at one of a party's points? */
bool party_is_driven(RECORD_IN(slots), RECORD_OUT(shocks), int id)
{
	for (int point = 0; point < SHOCK_POINTS && !point_is_none(shocks[SHOCK(id, point) + SHOCK_PUSH]); point++) {
		int partner = (int)CHANNEL(shocks[SHOCK(id, point) + SHOCK_PUSH], SHOCK_PARTNER);
		if (partner >= 0 && slot_is_kinematic(slots, partner))
			return true;
	}
	return false;
}

/* Twice the energy that all have more than before the hit: sweeps that come to no end may give some. 0 where they came to one, and something kinematic drives them. */
float tug_energy(RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_IN(owners), RECORD_OUT(shocks),
	int how, const struck *hit, const shock *all)
{
	float gained = 0.0f;
	for (int id = all->first; id >= 0; id = party_next(members, id)) {
		int s = active[id];
		if (how == TUG_ENDS && party_is_driven(slots, shocks, id))
			return 0.0f;
		trajectory was = tug_way(slots, status, members, work, owners, shocks, s, true, hit, all);
		gained += way_energy(slots, s, work_load(work, id)) - way_energy(slots, s, was);
	}
	return gained;
}

/* Does what joints gave, or all energy that there is more, come to too much beside what the hit does? */
bool tug_is_much(RECORD_OUT(shocks), int one, float gained, float changed)
{
	return gained > TUG_GAIN * (CHANNEL(shocks[SHOCK(one, 0) + SHOCK_PUSH], SHOCK_IMPULSE) * changed);
}

/* From the two of a hit, of which the second may be none, -1; false if the cluster has to be given up. */
bool tug_spread(RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents), RECORD_OUT(shocks), LIST_IN(touching),
	RECORD_IN(contacts), int one, int other, const struck *hit, shock *all, int *first)
{
	if (!tug_open(slots, LISTS, work, owners, parents, shocks, touching, contacts, one, one, 1, false, hit, all, first)
		|| (other >= 0 && !tug_open(slots, LISTS, work, owners, parents, shocks, touching, contacts, other, one, 0, false, hit, all, first)))
		return false;
	float changed = tug_strike(slots, status, members, active, work, owners, shocks, one, other, hit, all), least = TUG_WITHIN * changed;
	int how = tug_sweep(slots, LISTS, work, owners, parents, shocks, touching, contacts, one, least, false, hit, all, first);
	if (how != TUG_LOST && tug_is_much(shocks, one, tug_gain(slots, members, shocks, one, all), changed)) {
		tug_begin_anew(slots, members, work, shocks, hit, all);
		how = tug_sweep(slots, LISTS, work, owners, parents, shocks, touching, contacts, one, least, true, hit, all, first);
	}
	if (how == TUG_LOST)
		return false;
	if (tug_is_much(shocks, one, tug_energy(slots, status, members, active, work, owners, shocks, how, hit, all), changed))
		tug_begin_anew(slots, members, work, shocks, hit, all); /* and so it stays: the hit acts on the two alone */
	return true;
}

/* Counts what it did, and to whom; the hit, which is the last one that was counted of a member, has another impulse now. */
void tug_end(RECORD_IN(slots), RECORD_IN(reach), LIST_OUT(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_OUT(need),
	RECORD_OUT(hits), RECORD_OUT(shocks), int id, float sign, const struck *hit, const shock *all)
{
	float4 push = shocks[SHOCK(all->first, 0) + SHOCK_PUSH];
	float2 along = aside(hit->n);
	float total = CHANNEL(push, SHOCK_IMPULSE), rub = CHANNEL(push, SHOCK_RUB);
	int kept = members[MEMBER(id, MEMBER_KEPT)];
	if (status[STATUS_KEPT_ROOM] > 0 && kept >= 0) {
		float4 what = hits[HITS_WIDTH * kept + HITS_WHAT];
		hits[HITS_WIDTH * kept + HITS_WHAT] = (float4)(sign * (total * hit->n.x + rub * along.x), sign * (total * hit->n.y + rub * along.y), what.z,
			what.w);
	}
	for (int m = all->first; m >= 0; m = party_next(members, m)) {
		int s = active[m];
		trajectory k = work_load(work, m);
		members[MEMBER(m, MEMBER_EVENTS)] += 2; /* as of a shock */
		k = held_at_last(slots, members, s, m, k, STUCK_BORNE);
		work_store(work, m, k);
		if (!way_grow(slots, reach, status, work, need, s, m, k, 0.0f, all->length))
			atomic_or(&status[STATUS_LEFT], 1);
	}
}
