/* Which pairs may hit each other: each of the two must be of a category that the other's mask has. */

INLINE bool filter_lets(LIST_IN(filters), int a, int b)
{
	return (filters[FILTER(a, FILTER_CATEGORIES)] & filters[FILTER(b, FILTER_MASK)])
		&& (filters[FILTER(b, FILTER_CATEGORIES)] & filters[FILTER(a, FILTER_MASK)]);
}
