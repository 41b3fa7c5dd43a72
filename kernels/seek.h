/* The hits that a step begins with. To count where all work-items count costs as much as the search for a hit: those of a group are counted at once. */

#define SEEDS_MOST 4   /* of a slot; those beyond are counted each alone */
#define PAIRS_MOST 256 /* of a group, that are looked at closely together: else the slots that have some would keep the others waiting */

/* Hits that a slot found, once for each body that they change. */
typedef struct seeds {
	int count;
	int bodies[SEEDS_MOST], partners[SEEDS_MOST], times[SEEDS_MOST]; /* a slot, and as in Found */
	int taken;                                                       /* bits: whose body has no number yet */
} seeds;

/* What the body hits first as the step begins: `partner` is a slot, or -1 - wall; `time` as in Found. */
void found_keep(LIST_OUT(spans), LIST_OUT(status), LIST_OUT(found), int k, int s, int partner, int time)
{
	if (k >= status[STATUS_NODE_ROOM] * NODE_WIDTH / FOUND_WIDTH) {
		atomic_xchg(&spans[SPAN(s, SPAN_FOUND)], FOUND_NO_ROOM);
		return;
	}
	found[FOUND_WIDTH * k + FOUND_PARTNER] = partner;
	found[FOUND_WIDTH * k + FOUND_TIME] = time;
	found[FOUND_WIDTH * k + FOUND_LINK] = atomic_xchg(&spans[SPAN(s, SPAN_FOUND)], k);
}

/* A body has a hit as the step begins: is this the first to find one, so that it gives it a number? */
bool takes(LIST_OUT(owners), int s)
{
	return PEEK(owners, s) == -1 && atomic_cmpxchg(&owners[s], -1, -2) == -1;
}

/* The number is known to others when the kernel has ended. */
void number(LIST_OUT(members), LIST_OUT(active), LIST_OUT(owners), int id, int s, int round)
{
	active[id] = s;
	members[MEMBER(id, MEMBER_OWNER)] = id;
	members[MEMBER(id, MEMBER_ROUND)] = round;
	atomic_xchg(&owners[s], id);
}

/* There is something to be done in this round. */
void begin_round(LIST_OUT(status), int round)
{
	if (PEEK(status, STATUS_ROUND) < round)
		atomic_max(&status[STATUS_ROUND], round);
}

void seeds_add(LISTS_IN, LIST_OUT(owners), seeds *all, int s, int partner, float time, bool pause, int round)
{
	int bits = as_int(pause ? -time : time);
	if (all->count < SEEDS_MOST) {
		all->bodies[all->count] = s;
		all->partners[all->count] = partner;
		all->times[all->count++] = bits;
		return;
	}
	found_keep(spans, status, found, atomic_inc(&status[STATUS_FOUND]), s, partner, bits);
	if (takes(owners, s))
		number(members, active, owners, atomic_inc(&status[STATUS_ACTIVE]), s, round);
	begin_round(status, round);
}

#define SEEDS_NUMBER 65536 /* a group has far fewer entries */

/* How many entries of Found are wanted, and SEEDS_NUMBER times how many numbers, for bodies that have none. */
int seeds_take(LIST_OUT(owners), seeds *all)
{
	int numbers = 0;
	all->taken = 0;
	for (int i = 0; i < all->count; i++) {
		if (!takes(owners, all->bodies[i]))
			continue;
		all->taken |= 1 << i;
		numbers++;
	}
	return all->count + SEEDS_NUMBER * numbers;
}

/* Room for all that the group wants: where its entries and numbers begin. */
void seeds_count(LIST_OUT(status), int sum, __local int *first, int round)
{
	if (sum == 0)
		return;
	first[0] = atomic_add(&status[STATUS_FOUND], sum % SEEDS_NUMBER);
	first[1] = atomic_add(&status[STATUS_ACTIVE], sum / SEEDS_NUMBER);
	begin_round(status, round);
}

void seeds_keep(LISTS_IN, LIST_OUT(owners), const seeds *all, int entry, int id, int round)
{
	for (int i = 0; i < all->count; i++) {
		found_keep(spans, status, found, entry + i, all->bodies[i], all->partners[i], all->times[i]);
		if (all->taken & (1 << i))
			number(members, active, owners, id++, all->bodies[i], round);
	}
}

/* A pair whose discs meet; when to look at it again. */
float seek_pair(VERTICES_IN, RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), float4 rules, int s, int other, float length,
	float ahead, int round, seeds *all)
{
	bool pause, changes = slot_is_dynamic(slots, s), other_changes = slot_is_dynamic(slots, other);
	trajectory k = trajectory_start(slots, s), o = trajectory_start(slots, other);
	float apart = ahead > 0.0f ? steps_apart(VERTICES, body_of(slots, s, k, length), body_of(slots, other, o, length), 1.0f + ahead) : 0.0f;
	if (apart > 0.0f)
		return apart;
	float t = pair_time(VERTICES, slots, rules, s, k, other, o, length, 1.0f, &pause);
	if (!(t <= 1.0f))
		return 1.0f;
	if (changes)
		seeds_add(LISTS, owners, all, s, other, t, pause, round);
	if (other_changes)
		seeds_add(LISTS, owners, all, other, s, t, pause, round);
	if (changes && other_changes && t <= slice_end(status, 0))
		unite(parents, s, other);
	return 1.0f;
}

/* The same of those that the group has kept, by all its work-items. */
void seek_kept(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), __local const int *pairs, int count,
	float length, int round, seeds *all)
{
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	float ahead = steps_ahead(TEX(uniforms), status, length);
	for (int k = get_local_id(0); k < min(count, PAIRS_MOST); k += get_local_size(0)) {
		int s = pairs[2 * k], other = pairs[2 * k + 1];
		wake_before(status, wakes, s, seek_pair(VERTICES, slots, LISTS, owners, parents, rules, s, other, length, ahead, round, all));
	}
}

/* Where the neighbours end whom a slot looks at as a step begins: all, if it was changed, else those that do not look at it. */
INLINE int watched_end(LIST_IN(spans), LIST_IN(wakes), int s)
{
	return spans[SPAN(s, wakes[WAKE(s, WAKE_CHANGED)] > 0 ? SPAN_END : SPAN_HALF)];
}

/* Of a bunch those that this slot watches. */
INLINE ints watched(LIST_IN(status), LIST_IN(wakes), int s, bunch others, int changed, int cursor, int half_end)
{
#define CHANGED(one) wakes[WAKE((others.slots)one, WAKE_CHANGED)]
	ints theirs = (ints)(0), own = (ints)(changed);
	if (status[STATUS_AGE] > 0)
		theirs = (ints)(EACH(CHANGED));
	ints first = cursor < 0 ? (ints)(s) < others.slots : bunch_places(cursor) < (ints)(half_end);
	return others.live & ((own > theirs) | ((own == theirs) & first));
}

/* Is the slot to look for hits in this step? Soon it does. */
bool is_awake(RECORD_IN(slots), LISTS_IN, int s)
{
	if (status[STATUS_AGE] == 0)
		wakes[WAKE(s, WAKE_CHANGED)] = 0;
	else if (wakes[WAKE(s, WAKE_NEXT)] > status[STATUS_AGE])
		return false;
	fetch_span(slots, spans, extra, s);
	return true;
}

/* While one slot looks, what those after it look at is fetched. */
INLINE void fetch_awake(RECORD_IN(slots), LISTS_IN, LIST_IN(owners), __local const int *awake, int k, int count)
{
	if (BUNCH == 1)
		return;
	int next = k + 2 < count ? awake[k + 2] : -1, far = k + 4 < count ? awake[k + 4] : -1;
	if (far >= 0)
		fetch_list(spans, neighbours, far);
	if (next >= 0)
		fetch_neighbours(slots, spans, neighbours, owners, wakes, next, watched_end(spans, wakes, next));
}

/* All bits: in this step the body neither moves nor meets another such one: it sleeps, or where some do, is static. */
INLINE int lies(RECORD_IN(slots), LIST_IN(status), LIST_IN(touching), int s)
{
	return status[STATUS_SLEEPERS] > 0 && (touching[TOUCH(s, TOUCHING_ASLEEP)] || slot_is_static(slots, s)) ? -1 : 0;
}

/* All that the slot looks at: pairs that are to be looked at closely go to those of the group. */
void seek(VERTICES_IN, TEX_IN(uniforms), RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), LIST_IN(touching), int s, float length,
	int round, seeds *all, __local int *pairs, __local int *pair_count)
{
	int wall, changed = wakes[WAKE(s, WAKE_CHANGED)];
	bool pause;
	float4 rules = TEX_LOAD(uniforms, UNIFORMS_RULES, 0);
	trajectory k = trajectory_start(slots, s);
	disc disc_k = disc_at_start(slots, s, length);
	float ahead = steps_ahead(TEX(uniforms), status, length);
	int still = lies(slots, status, touching, s);
	bool clear = still || is_clear_of_walls(TEX(uniforms), slots, rules, s, k, length, 1.0f + ahead);
	float next = clear ? 1.0f + ahead : 1.0f, t = clear ? NO_HIT : wall_time(VERTICES, TEX(uniforms), slots, rules, s, k, length, &wall, &pause);
	if (t <= 1.0f)
		seeds_add(LISTS, owners, all, s, -1 - wall, t, pause, round);
	int half_end = spans[SPAN(s, SPAN_HALF)], end = watched_end(spans, wakes, s);
	for (int i = bunch_first(spans, extra, s, end, 0); i != -1; i = bunch_next(extra, s, end, i, 0, 1)) {
		bunch others = bunch_at(neighbours, extra, end, i);
		ints wanted = watched(status, wakes, s, others, changed, i, half_end);
#define LIES(one) lies(slots, status, touching, (others.slots)one)
		if (still)
			wanted &= ~(ints)(EACH(LIES));
		if (still && !IS_ANY(wanted))
			continue;
		discs all_discs = discs_at_start(slots, s, others.slots, length);
		floats meetings = wanted ? first_meetings(disc_k, &all_discs, ahead) : (floats)(next);
		ints close = meetings <= (floats)(1.0f);
		next = smaller(next, least_of(close ? (floats)(next) : meetings));
		if (!IS_ANY(wanted & close))
			continue;
		for (int n = 0; n < BUNCH; n++, close = TURNED(close), wanted = TURNED(wanted), others.slots = TURNED(others.slots)) {
			int other = FIRST(others.slots);
			if (!(FIRST(close) & FIRST(wanted)))
				continue;
			if (stay_apart(disc_k, disc_at_start(slots, other, length))) {
				next = smaller(next, 1.0f);
				continue;
			}
			int pair = atomic_inc(pair_count);
			if (pair < PAIRS_MOST) {
				pairs[2 * pair] = s;
				pairs[2 * pair + 1] = other;
			} else {
				next = smaller(next, seek_pair(VERTICES, slots, LISTS, owners, parents, rules, s, other, length, ahead, round, all));
			}
		}
	}
	wakes[WAKE(s, WAKE_NEXT)] = step_of(status, next);
}
