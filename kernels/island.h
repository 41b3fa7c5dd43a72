/* Islands: dynamic bodies that touch each other, directly or by others. Each iterates by itself: CONTRACT.md, "contacts". What an island wants is with its root. */

#define RESTS_IN                                                                                                                       \
	TEX_IN(uniforms), TEX_IN(clock), RECORD_OUT(slots), LIST_OUT(status), RECORD_OUT(contacts), LIST_OUT(touching), RECORD_OUT(grips), \
		LIST_OUT(islands)

/* The body in a slot and those that it touches are of one island; and what it touches that is not dynamic. */
void island_join(RECORD_IN(slots), RECORD_IN(contacts), LIST_OUT(touching), LIST_OUT(islands), int s)
{
	int carrier = -1;
	for (int point = 0, before = PARTNER_NONE, first = first_four(touching, s); point < touching[TOUCH(s, TOUCHING_COUNT)]; point++) {
		int other = (int)POINT_IN(contacts, FOUR_WIDTH, first, point)[4 * FOUR_PARTNER];
		if (other > s && other != before && slot_is_dynamic(slots, other)) /* of two bodies one says so, once */
			unite(islands, s, other);
		if (other < 0)
			carrier = CARRIER_STATIC;
		else if (!slot_is_dynamic(slots, other))
			carrier = max(carrier, slot_body(slots, other));
		before = other;
	}
	touching[TOUCH(s, TOUCHING_CARRIER)] = carrier;
}

/* All are joined: the root of a slot's island, which is its parent from now on, and has the largest of the island's carriers. */
int island_root(LIST_OUT(touching), LIST_OUT(islands), int s)
{
	int root = find_root(islands, s);
	if (root != int_load(islands, s))
		atomic_xchg(&islands[s], root);
	if (root != s && touching[TOUCH(s, TOUCHING_CARRIER)] >= 0)
		atomic_max(&touching[TOUCH(root, TOUCHING_CARRIER)], touching[TOUCH(s, TOUCHING_CARRIER)]);
	return root;
}

/* One iteration of a body, after so many, if its island wants it. True if that wants another. */
bool island_iterate(RECORD_IN(slots), LIST_IN(status), RECORD_OUT(contacts), RECORD_OUT(grips), LIST_OUT(touching), LIST_OUT(islands),
	RECORD_OUT(loads), LIST_IN(places), RECORD_IN(joints), LIST_IN(joined), int s, int done, bool rub, float length, float part)
{
	bool impulses = status[STATUS_PASS] == PASS_IMPULSES;
	bool held = first_contact(touching, s) > 0;
	int number = status[STATUS_FIRST] + done, most = !(rub && impulses) ? CONTACT_ITERATIONS : held ? JOINT_IMPULSES : GRIP_IMPULSES;
	int root = done == 0 ? island_root(touching, islands, s) : islands[s], wants = TOUCH(root, TOUCHING_WANTED);
	if (PEEK(touching, wants) < number)
		return false;
	int capacity = status[STATUS_CAPACITY];
	__global float4 *now = loads + LOADS_OF(capacity, number & 1), *next = loads + LOADS_OF(capacity, 1 - (number & 1)),
					*alone = loads + LOADS_OF(capacity, LOADS_ALONE);
	bool aims = joined[JOINED_COUNT] > 0 && !impulses;
	if (aims && is_aimed(done) && held) {
		joined_aim(slots, contacts, touching, now, places, joints, joined, s, island_is_tired(touching, root), length, part);
		/* with which the next one has its steps */
		CHANNEL(alone[s], LOAD_SHARE) = rests_share(slots, contacts, grips, touching, s, rub);
	}
	bool wanted = rests_iterate(slots, contacts, grips, touching, now, next, alone, joints, joined, s, done, rub, impulses,
		done == 0 || (aims && is_aimed(done - 1)), length);
	if (impulses && held && done + 1 == most)
		island_tire(slots, contacts, touching, joints, joined, s, root, wanted, length);
	if (!wanted || done + 1 >= most)
		return false;
	if (PEEK(touching, wants) == number)
		atomic_max(&touching[wants], number + 1);
	return true;
}

/* Did what the second pass began with bear an island? */
bool island_bears(LIST_IN(status), LIST_IN(touching), LIST_IN(islands), int s)
{
	return touching[TOUCH(islands[s], TOUCHING_WANTED)] == status[STATUS_FIRST];
}
