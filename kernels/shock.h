/* A hit that passes on at once to all that the bodies press on: CONTRACT.md, "The step contacts", Shocks. */

/* Those that it has moved to its time, its parties, are a list in Members until they have looked again. */
typedef struct shock {
	int first, last, count;
	float time, length, weight;
	float whole, share;      /* s: a whole step; and how much of that this one is */
	int leader, head, round; /* of the cluster */
} shock;

void shock_begin(TEX_IN(uniforms), float time, int leader, int head, int round, float length, shock *all)
{
	all->first = all->last = -1;
	all->count = 0;
	all->time = time;
	all->length = length;
	all->weight = weight_of(TEX(uniforms), length);
	all->whole = whole_length(TEX(uniforms), length);
	all->share = part_of_whole(length, all->whole);
	all->leader = leader;
	all->head = head;
	all->round = round;
}

/* The party after that one, -1 for none. */
int party_next(LIST_OUT(members), int id)
{
	int seen = members[MEMBER(id, MEMBER_SEEN)];
	return seen == -1 ? -1 : -2 - seen;
}

/* The next two, who look again. */
int2 parties_take(LIST_OUT(members), int *party)
{
	int2 who = (int2)(*party, LOOKS_NOT);
	*party = party_next(members, who.x);
	if (*party >= 0) {
		who.y = *party;
		*party = party_next(members, who.y);
	}
	return who;
}

trajectory shock_way(RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), RECORD_OUT(work), LIST_IN(owners), int s, const shock *all)
{
	int id = number_seen(status, members, owners, s, all->leader);
	return moved(slots, s, id >= 0 ? work_load(work, id) : trajectory_start(slots, s), all->time, all->length);
}

/* A party as it became one. */
trajectory party_before(RECORD_OUT(work), RECORD_OUT(shocks), int id)
{
	float4 began = shocks[SHOCK_BEGAN(id)];
	trajectory k = work_load(work, id);
	CHANNEL(k.place, LINEAR_VX) = began.x;
	CHANNEL(k.place, LINEAR_VY) = began.y;
	k.velocity = began.z;
	return k;
}

/* It becomes one, and is moved to the time. */
void party_begin(RECORD_IN(slots), RECORD_OUT(work), RECORD_OUT(shocks), int s, int id, const shock *all)
{
	trajectory k = moved(slots, s, work_load(work, id), all->time, all->length);
	shocks[SHOCK_BEGAN(id)] = (float4)(CHANNEL(k.place, LINEAR_VX), CHANNEL(k.place, LINEAR_VY), k.velocity, 0.0f);
	work_store(work, id, k);
}

/* The number of the body in a slot as a party, else -1. */
int party_of(LIST_OUT(members), LIST_IN(owners), int s, const shock *all)
{
	int id = number_of_own(members, owners, s, all->leader);
	return id >= 0 && members[MEMBER(id, MEMBER_SEEN)] < 0 ? id : -1;
}

/* Has a party, if it is one, points with slot s? Then that is party id by now, and they are open. */
bool points_meet(RECORD_OUT(shocks), int party, int s, int id)
{
	bool any = false;
	for (int point = 0; party >= 0 && point < SHOCK_POINTS && !point_is_none(shocks[SHOCK(party, point) + SHOCK_PUSH]); point++) {
		__global float4 *push = shocks + SHOCK(party, point) + SHOCK_PUSH;
		if (CHANNEL(*push, SHOCK_PARTNER) == (float)s) {
			*push = (float4)((float)s, (float)id, 0.0f, 0.0f);
			any = true;
		}
	}
	return any;
}

/* A party's points, from those of its contacts. */
void points_write(RECORD_IN(slots), LIST_IN(status), LIST_OUT(members), RECORD_OUT(work), LIST_IN(owners), RECORD_OUT(shocks), int id,
	const rests *found, const shock *all)
{
	int point = 0;
	for (int k = 0; k < found->count; k++) {
		const rest *r = &found->of[k];
		int party = r->partner >= 0 ? party_of(members, owners, r->partner, all) : -1;
		float part = ((SHOCK_PARTING * r->force) * (1.0f - all->time)) / all->length;
		for (int i = 0; i < r->count && point < SHOCK_POINTS; i++, point++) {
			rest_point at = r->points[i];
			__global float4 *to = shocks + SHOCK(id, point);
			float coming = r->partner >= 0 && party < 0 && slot_is_dynamic(slots, r->partner)
				? way_speed(shock_way(slots, status, members, work, owners, r->partner, all), r->n, at.other_arm)
				: 0.0f;
			to[SHOCK_NORMAL] = (float4)(r->n.x, r->n.y, at.arm, at.other_arm);
			to[SHOCK_GRIP] = (float4)(at.grip_arm, at.grip_other_arm, r->friction, part);
			to[SHOCK_PUSH] = (float4)((float)r->partner, (float)party, coming, 0.0f);
		}
	}
	if (point < SHOCK_POINTS)
		shocks[SHOCK(id, point) + SHOCK_PUSH] = (float4)((float)PARTNER_NONE, -1.0f, 0.0f, 0.0f);
}

/* What the body in slot s, which becomes party id, rests on, but for what a party has a point for. */
void shock_rests(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners), RECORD_OUT(shocks),
	int s, int id, body own, const shock *all, rests *contacts)
{
	int end = spans[SPAN(s, SPAN_END)];
	nearness near = {all->weight, INFINITY};
	rests_begin(contacts, INT_MIN, false);
	rest_on_walls(VERTICES, TEX(uniforms), TEX(friction), slots, s, own, near, contacts);
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i)) {
		int other = neighbour_of(neighbours, extra, i);
		if (points_meet(shocks, party_of(members, owners, other, all), s, id))
			continue;
		body partner = body_of(slots, other, shock_way(slots, status, members, work, owners, other, all), all->length);
		rest_on_body(VERTICES, TEX(uniforms), TEX(friction), slots, s, own, other, partner, near, contacts);
	}
}

/* Party id is the last of the list from now on. */
void party_add(LIST_OUT(members), int id, shock *all)
{
	members[MEMBER(id, MEMBER_SEEN)] = -1;
	if (all->count++ > 0)
		members[MEMBER(all->last, MEMBER_SEEN)] = -2 - id;
	else
		all->first = id;
	all->last = id;
}

/* A party more: it is moved to the time, and where it may be pushed, or push, is found. */
void shock_open(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_IN(owners), RECORD_OUT(shocks),
	int id, shock *all)
{
	int s = active[id];
	rests contacts;
	party_begin(slots, work, shocks, s, id, all);
	body own = body_of(slots, s, work_load(work, id), all->length);
	shock_rests(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, work, owners, shocks, s, id, own, all, &contacts);
	points_write(slots, status, members, work, owners, shocks, id, &contacts, all);
	party_add(members, id, all);
}

/* Of one that joins; those that it began with had theirs. */
void event_count(LIST_OUT(members), RECORD_OUT(work), int id, float time)
{
	bool rapid = is_rapid(members, id, work_load(work, id), time);
	int stuck = members[MEMBER(id, MEMBER_STUCK)];
	members[MEMBER(id, MEMBER_RAPID)] += rapid ? 1 : 0;
	members[MEMBER(id, MEMBER_STUCK)] = rapid ? stuck + 1 : stuck & STUCK_FAST;
}

/* Have all more energy than before by more than it takes to part, and than kinematic partners gave? */
bool shock_gains(RECORD_IN(slots), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), RECORD_OUT(shocks), const shock *all)
{
	float gained = 0.0f, given = 0.0f, had = 0.0f;
	for (int id = all->first; id >= 0; id = party_next(members, id)) {
		float was = way_energy(slots, active[id], party_before(work, shocks, id));
		gained += way_energy(slots, active[id], work_load(work, id)) - was;
		had += was;
		for (int point = 0; point < SHOCK_POINTS; point++) {
			__global float4 *at = shocks + SHOCK(id, point);
			float4 grip = at[SHOCK_GRIP], push = at[SHOCK_PUSH];
			if (point_is_none(push))
				break;
			if (!point_is_open(slots, push))
				continue;
			given += CHANNEL(push, SHOCK_IMPULSE) * CHANNEL(grip, SHOCK_PART);
			given += point_driven(slots, at[SHOCK_NORMAL], grip, push);
		}
	}
	return gained > 2.0f * given + SHOCK_GAIN * had;
}

/* All move as before it. */
void shock_begin_anew(RECORD_IN(slots), LIST_OUT(members), RECORD_OUT(work), RECORD_OUT(shocks), const shock *all)
{
	for (int id = all->first; id >= 0; id = party_next(members, id)) {
		work_store(work, id, party_before(work, shocks, id));
		for (int point = 0; point < SHOCK_POINTS; point++) {
			__global float4 *push = shocks + SHOCK(id, point) + SHOCK_PUSH;
			if (point_is_none(*push))
				break;
			if (point_is_open(slots, *push))
				CHANNEL(*push, SHOCK_IMPULSE) = CHANNEL(*push, SHOCK_RUB) = 0.0f;
		}
	}
}

/* In sweeps over all points, until they do no more; false if the cluster has to be given up. */
bool shock_sweep(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents),
	RECORD_OUT(shocks), int one, float farther, shock *all, int *first)
{
	bool more = true;
	for (int sweep = 0; sweep < SHOCK_SWEEPS && more; sweep++) {
		more = false;
		for (int id = all->first; id >= 0; id = party_next(members, id))
			for (int point = 0; point < SHOCK_POINTS; point++) {
				float4 push = shocks[SHOCK(id, point) + SHOCK_PUSH];
				if (point_is_none(push))
					break;
				float rate = point_rate(slots, work, id, shocks[SHOCK(id, point) + SHOCK_NORMAL], push);
				bool open = point_is_open(slots, push);
				if (!(rate < 0.0f) && !(open && CHANNEL(push, SHOCK_IMPULSE) > 0.0f))
					continue;
				if (!open && all->count < SHOCK_PARTIES) {
					int joined = join(slots, LISTS, work, owners, parents, (int)CHANNEL(push, SHOCK_PARTNER), one, all->leader, all->head, all->round,
						first);
					if (joined < 0)
						return false;
					event_count(members, work, joined, all->time);
					shock_open(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, work, owners, shocks, joined, all);
					open = true;
				}
				float least = SHOCK_WITHIN * CHANNEL(shocks[SHOCK(id, point) + SHOCK_GRIP], SHOCK_PART);
				more |= open && point_push(slots, active, work, shocks, id, point, rate, farther, least);
			}
	}
	return true;
}

/* From those two, of which the second may be none, -1; false if the cluster has to be given up. */
bool shock_spread(VERTICES_IN, TEX_IN(uniforms), TEX_IN(friction), RECORD_IN(slots), LISTS_IN, RECORD_OUT(work), LIST_OUT(owners), LIST_OUT(parents),
	RECORD_OUT(shocks), int one, int other, shock *all, int *first)
{
	shock_open(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, work, owners, shocks, one, all);
	if (other >= 0)
		shock_open(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, work, owners, shocks, other, all);
	for (float farther = SHOCK_FARTHER;; farther = 1.0f) { /* not two calls of what is large, and inlined */
		if (!shock_sweep(VERTICES, TEX(uniforms), TEX(friction), slots, LISTS, work, owners, parents, shocks, one, farther, all, first))
			return false;
		if (farther == 1.0f || !shock_gains(slots, members, active, work, shocks, all))
			return true;
		shock_begin_anew(slots, members, work, shocks, all);
	}
}

/* The hits of one party's points; how many points they are of, from that on. */
int party_hit(RECORD_IN(slots), LIST_OUT(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), RECORD_OUT(hits), RECORD_OUT(shocks), int id,
	int point, float time)
{
	__global float4 *at = shocks + SHOCK(id, point), *next = at + SHOCK_WIDTH;
	float4 normal = at[SHOCK_NORMAL], grip = at[SHOCK_GRIP], push = at[SHOCK_PUSH];
	float4 next_normal = point + 1 < SHOCK_POINTS ? next[SHOCK_NORMAL] : normal;
	bool two = point + 1 < SHOCK_POINTS && CHANNEL(next[SHOCK_PUSH], SHOCK_PARTNER) == CHANNEL(push, SHOCK_PARTNER)
		&& CHANNEL(next_normal, SHOCK_X) == CHANNEL(normal, SHOCK_X) && CHANNEL(next_normal, SHOCK_Y) == CHANNEL(normal, SHOCK_Y);
	float total = CHANNEL(push, SHOCK_IMPULSE), rub = CHANNEL(push, SHOCK_RUB), arm = CHANNEL(normal, SHOCK_ARM),
		  grip_arm = CHANNEL(grip, SHOCK_GRIP_ARM);
	if (two) {
		total += CHANNEL(next[SHOCK_PUSH], SHOCK_IMPULSE);
		rub += CHANNEL(next[SHOCK_PUSH], SHOCK_RUB);
		float part = CHANNEL(next[SHOCK_PUSH], SHOCK_IMPULSE) / total;
		arm = arm + part * (CHANNEL(next[SHOCK_NORMAL], SHOCK_ARM) - arm);
		grip_arm = grip_arm + part * (CHANNEL(next[SHOCK_GRIP], SHOCK_GRIP_ARM) - grip_arm);
	}
	if (!point_is_open(slots, push) || !(total > 0.0f))
		return two ? 2 : 1;
	int partner = (int)CHANNEL(push, SHOCK_PARTNER), row = slot_body(slots, active[id]), column = partner_key(slots, partner);
	float sign = row > column ? 1.0f : -1.0f;
	float2 n = (float2)(CHANNEL(normal, SHOCK_X), CHANNEL(normal, SHOCK_Y)), along = aside(n);
	float4 place_record = work[WORK_WIDTH * id + WORK_PLACE];
	float2 from = (float2)(CHANNEL(place_record, LINEAR_X), CHANNEL(place_record, LINEAR_Y));
	impact hit = {total, true, true, true,
		(float4)(from.x + (grip_arm * n.x - arm * along.x), from.y + (grip_arm * n.y - arm * along.y), sign * n.x, sign * n.y)};
	float4 j = (float4)(sign * (total * n.x + rub * along.x), sign * (total * n.y + rub * along.y), 0.0f, 0.0f);
	if (!hit_count(status, members, hits, id, (float4)(time, (float)max(row, column), (float)min(row, column), 0.0f), j, hit))
		atomic_or(&status[STATUS_LEFT], 1);
	return two ? 2 : 1;
}

/* Counts what it did, and to whom. */
void shock_end(RECORD_IN(slots), RECORD_IN(reach), LIST_OUT(status), LIST_OUT(members), LIST_IN(active), RECORD_OUT(work), LIST_OUT(need),
	RECORD_OUT(hits), RECORD_OUT(shocks), const shock *all)
{
	for (int id = all->first; id >= 0; id = party_next(members, id)) {
		int s = active[id];
		for (int point = 0; point < SHOCK_POINTS && !point_is_none(shocks[SHOCK(id, point) + SHOCK_PUSH]);)
			point += party_hit(slots, status, members, active, work, hits, shocks, id, point, all->time);
		trajectory k = work_load(work, id);
		members[MEMBER(id, MEMBER_EVENTS)] += 2; /* the way there, and what it got: who looks at it knows that it is not as it was */
		k = held_at_last(slots, members, s, id, k, STUCK_BORNE);
		work_store(work, id, k);
		float margin = rest_force(all->weight, CHANNEL(SLOT_LOAD(slots, s, SLOT_TURN), TURN_RADIUS));
		if (!way_grow(slots, reach, status, work, need, s, id, k, margin, all->length))
			atomic_or(&status[STATUS_LEFT], 1);
	}
}
