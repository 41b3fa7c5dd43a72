/* Which pairs may hit each other: each of the two must be of a category that the other's mask has, and none of those that the other never meets. */

INLINE bool filter_excepts(LIST_IN(filters), int a, int b)
{
	int at = filters[FILTER(a, FILTER_EXCEPT)];
	while (at > 0 && filters[at] >= 0 && filters[at] != b)
		at++;
	return at > 0 && filters[at] == b;
}

INLINE bool filter_lets(LIST_IN(filters), int a, int b)
{
	return (filters[FILTER(a, FILTER_CATEGORIES)] & filters[FILTER(b, FILTER_MASK)])
		&& (filters[FILTER(b, FILTER_CATEGORIES)] & filters[FILTER(a, FILTER_MASK)]) && !filter_excepts(filters, a, b);
}
