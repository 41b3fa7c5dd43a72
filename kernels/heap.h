/* The members of a cluster by their first events: a pairing heap, whose root has the earliest. Its links are in Members, -1 for none. */

#define HEAP(id, field) members[MEMBER(id, field)]

/* One heap of two; their roots have no siblings. */
int heap_meld(LIST_OUT(members), RECORD_OUT(work), int a, int b)
{
	if (a < 0 || b < 0)
		return a < 0 ? b : a;
	bool swaps = event_before(work[WORK_WIDTH * b + WORK_NEXT], work[WORK_WIDTH * a + WORK_NEXT]);
	int root = swaps ? b : a, child = swaps ? a : b, older = HEAP(root, MEMBER_CHILD);
	HEAP(child, MEMBER_SIBLING) = older;
	HEAP(child, MEMBER_BEFORE) = root;
	if (older >= 0)
		HEAP(older, MEMBER_BEFORE) = child;
	HEAP(root, MEMBER_CHILD) = child;
	return root;
}

/* One heap of a list of siblings: two by two, then all, from the last on. */
int heap_gather(LIST_OUT(members), RECORD_OUT(work), int first)
{
	int pairs = -1, root = -1;
	while (first >= 0) {
		int second = HEAP(first, MEMBER_SIBLING), rest = second >= 0 ? HEAP(second, MEMBER_SIBLING) : -1;
		int pair = heap_meld(members, work, first, second);
		HEAP(pair, MEMBER_SIBLING) = pairs;
		pairs = pair;
		first = rest;
	}
	while (pairs >= 0) {
		int pair = pairs;
		pairs = HEAP(pair, MEMBER_SIBLING);
		root = heap_meld(members, work, root, pair);
	}
	return root;
}

int heap_insert(LIST_OUT(members), RECORD_OUT(work), int root, int id)
{
	HEAP(id, MEMBER_CHILD) = -1;
	return heap_meld(members, work, root, id);
}

/* Its event may have changed before. */
int heap_remove(LIST_OUT(members), RECORD_OUT(work), int root, int id)
{
	int children = heap_gather(members, work, HEAP(id, MEMBER_CHILD));
	if (id == root)
		return children;
	int before = HEAP(id, MEMBER_BEFORE), next = HEAP(id, MEMBER_SIBLING);
	if (HEAP(before, MEMBER_CHILD) == id)
		HEAP(before, MEMBER_CHILD) = next;
	else
		HEAP(before, MEMBER_SIBLING) = next;
	if (next >= 0)
		HEAP(next, MEMBER_BEFORE) = before;
	return heap_meld(members, work, root, children);
}

/* The member's event has changed. */
int heap_update(LIST_OUT(members), RECORD_OUT(work), int root, int id)
{
	return heap_insert(members, work, heap_remove(members, work, root, id), id);
}
