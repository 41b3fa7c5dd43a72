/* Outlines of polygons, and how far pixels are from the nearest side of one. It is the outline itself that is measured, not convex pieces of the polygon: inside there is nothing
 * to be seen of where these meet. */

float2 offset_of(float4 placed)
{
	return (float2)(CHANNEL(placed, PLACED_X), CHANNEL(placed, PLACED_Y));
}

float2 center_of(float4 placed)
{
	return (float2)(CHANNEL(placed, PLACED_CENTER_X), CHANNEL(placed, PLACED_CENTER_Y));
}

/* What a polygon takes, about its centre. */
typedef struct extent {
	float2 low, high;
	float twice_area, size;
} extent;

extent extent_of(TEX_IN(placed), int vertex, int count)
{
	float2 first = offset_of(ROW_LOAD(placed, vertex)), before = (float2)(0.0f, 0.0f);
	extent all = {first, first, 0.0f, 0.0f};
	for (int k = 1; k < count; k++) {
		float2 v = offset_of(ROW_LOAD(placed, vertex + k)), from_first = (float2)(v.x - first.x, v.y - first.y);
		all.low = (float2)(smaller(all.low.x, v.x), smaller(all.low.y, v.y));
		all.high = (float2)(larger(all.high.x, v.x), larger(all.high.y, v.y));
		all.twice_area = all.twice_area + cross2(from_first, before);
		before = from_first;
	}
	all.size = norm((float2)(all.high.x - all.low.x, all.high.y - all.low.y));
	return all;
}

float mean_breadth(extent all)
{
	return (0.5f * all.twice_area) / larger(all.size, 1.0f);
}

float4 box_of(extent all, float2 center, float margin, float4 clip)
{
	float2 low = (float2)(center.x + all.low.x, center.y + all.low.y), high = (float2)(center.x + all.high.x, center.y + all.high.y);
	return touched_box(low, high, margin, clip);
}

float length_around(TEX_IN(placed), int vertex, int count)
{
	float sum = 0.0f;
	float2 first = offset_of(ROW_LOAD(placed, vertex)), from = first;
	for (int k = 0; k < count; k++) {
		float2 to = k + 1 < count ? offset_of(ROW_LOAD(placed, vertex + k + 1)) : first;
		sum = sum + norm((float2)(to.x - from.x, to.y - from.y));
		from = to;
	}
	return sum;
}

/* A side between two points that are counted as pixels are; one that was lost in rounding is taken to go along x. */
void put_side(RECORD_OUT(edges), int at, float2 from, float2 to, float2 shift)
{
	float2 side = (float2)(to.x - from.x, to.y - from.y);
	float length = norm(side);
	float2 n = length > 0.0f ? (float2)(-side.y / length, side.x / length) : (float2)(0.0f, 1.0f);
	float distance = inner(n, (float2)(shift.x - from.x, shift.y - from.y));
	edges[at + SIDE_LINE] = (float4)(n.x, n.y, distance, 0.0f);
	edges[at + SIDE_ENDS] = (float4)(from.x - shift.x, from.y - shift.y, to.x - shift.x, to.y - shift.y);
}

/* Of a polygon that is not convex. How broad it is on the average tells its way around: it may be long and wound up. It is not taken for a line, though, where all of it together is broad. */
void put_outline(TEX_IN(placed), TEX_IN(view), SHAPES_OUT, int vertex, int count, int shape, int rest, float4 ink)
{
	extent all = extent_of(TEX(placed), vertex, count);
	float2 c = center_of(ROW_LOAD(placed, vertex)), first = offset_of(ROW_LOAD(placed, vertex)), from = first;
	float line = CHANNEL(TEX_LOAD(view, VIEW_SCALE, 0), SCALE_LINE), around = length_around(TEX(placed), vertex, count);
	float breadth = (0.5f * all.twice_area) / larger(0.5f * around, 1.0f), out = growth(breadth);
	float4 box = box_of(all, c, out, TEX_LOAD(view, VIEW_CLIP, 0));
	float4 seen = ink_of(CHANNEL(ink, INK_FILL), CHANNEL(ink, INK_OUTLINE), line, 1.0f, breadth, all.size);
	CHANNEL(seen, INK_FILL) = fill_of(CHANNEL(ink, INK_FILL), CHANNEL(ink, INK_OUTLINE), mean_breadth(all), all.size);
	if (!put_shape(SHAPES, shape, box, seen, rest, -count))
		return;
	float2 f = first_pixel(box), shift = (float2)(f.x - c.x, f.y - c.y);
	put_edge(SHAPES, shape, rest, 0, (float4)(0.0f, 0.0f, -out, 0.0f));
	for (int k = 0; k < count; k++) {
		float2 to = k + 1 < count ? offset_of(ROW_LOAD(placed, vertex + k + 1)) : first;
		put_side(edges, rest + SIDE_WIDTH * k, from, to, shift);
		from = to;
	}
}

/* How far pixels are from a side's line, outwards. */
float16 beyond_line(float4 line, float16 x, float16 y)
{
	return (CHANNEL(line, EDGE_AT) + CHANNEL(line, EDGE_SLOPE_Y) * y) + CHANNEL(line, EDGE_SLOPE_X) * x;
}

/* How far they are past one of its ends, along it. */
float16 past_ends(float4 line, float4 ends, float16 x, float16 y)
{
	float2 along = (float2)(CHANNEL(line, EDGE_SLOPE_Y), -CHANNEL(line, EDGE_SLOPE_X));
	float16 way = along.y * y + along.x * x, before = inner(along, ends.lo) - way, behind = way - inner(along, ends.hi);
	float16 past = behind > before ? behind : before;
	return past > 0.0f ? past : (float16)(0.0f);
}

/* Whether a ray from them along x crosses it. Where its line is seen from afar rounding may not tell on which side of it they are: there its ends do. */
int16 crosses_side(float4 ends, float16 s, float16 x, float16 y)
{
	float low = smaller(CHANNEL(ends, ENDS_FROM_X), CHANNEL(ends, ENDS_TO_X)), high = larger(CHANNEL(ends, ENDS_FROM_X), CHANNEL(ends, ENDS_TO_X));
	int16 beside = (CHANNEL(ends, ENDS_FROM_Y) <= y) ^ (CHANNEL(ends, ENDS_TO_Y) <= y), before_both = x < low, before_one = x < high;
	int16 before = (CHANNEL(ends, ENDS_FROM_Y) < CHANNEL(ends, ENDS_TO_Y) ? s : -s) > 0.0f;
	return beside & (before_both | (before_one & before));
}

/* How far they are from the outline of so many sides, below 0 inside. */
SELDOM float16 beyond_outline(RECORD_IN(edges), int rest, int count, float16 x, float16 y)
{
	float16 least = (float16)(INFINITY);
	int16 inside = (int16)(0);
	for (int k = rest; k < rest + SIDE_WIDTH * count; k += SIDE_WIDTH) {
		float4 line = edges[k + SIDE_LINE], ends = edges[k + SIDE_ENDS];
		float16 s = beyond_line(line, x, y), past = past_ends(line, ends, x, y), square = s * s + past * past;
		least = square < least ? square : least;
		inside ^= crosses_side(ends, s, x, y);
	}
	float16 distance = sqrt(least);
	return inside ? -distance : distance;
}
