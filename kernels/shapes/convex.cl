/* What is drawn of each body, and the marks below them. */

void put_mark(TEX_IN(marks), TEX_IN(view), SHAPES_OUT, int i, int shape, int rest)
{
	float4 place = ROW_LOAD(marks, MARKS_WIDTH * i + MARK_PLACE), style = ROW_LOAD(marks, MARKS_WIDTH * i + MARK_STYLE);
	float4 scale = TEX_LOAD(view, VIEW_SCALE, 0);
	float4 picture = (float4)(0.0f, 0.0f, CHANNEL(scale, SCALE_WIDTH), CHANNEL(scale, SCALE_HEIGHT));
	float color = CHANNEL(style, STYLE_COLOR), breadth = CHANNEL(style, STYLE_BREADTH);
	if (!(breadth > 0.0f)) {
		put_shape(SHAPES, shape, place, (float4)(color, color, 0.0f, 1.0f), rest, 0);
		return;
	}
	float2 from = place.lo, to = place.hi, way = (float2)(to.x - from.x, to.y - from.y);
	float reach = norm(way);
	put_line(SHAPES, shape, rest, from, (float2)(way.x / reach, way.y / reach), reach, breadth, color, 1.0f, picture);
}

/* A circle as it was found, and, where circles have one, the line from its centre to its rim. */
void put_circle(SHAPES_OUT, int shape, int rest, float4 box, float4 ink, float4 edge, float4 at, float line, bool has_line, float4 clip)
{
	bool seen = put_shape(SHAPES, shape, box, ink, rest, 1);
	if (seen)
		put_edge(SHAPES, shape, rest, 0, edge);
	if (!has_line)
		return;
	float2 to_rim = offset_of(at);
	float radius = norm(to_rim);
	if (seen && radius >= SHOW_ANGLE)
		put_line(SHAPES, shape + 1, rest, center_of(at), (float2)(to_rim.x / radius, to_rim.y / radius), radius - 0.5f * line, line,
			CHANNEL(ink, INK_OUTLINE), (radius - SHOW_ANGLE) * (1.0f / SHOW_ANGLE), clip);
	else
		boxes[shape + 1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
}

void put_polygon(TEX_IN(placed), TEX_IN(view), SHAPES_OUT, int vertex, int count, int shape, int rest, float4 ink)
{
	extent all = extent_of(TEX(placed), vertex, count);
	float2 c = center_of(ROW_LOAD(placed, vertex)), first = offset_of(ROW_LOAD(placed, vertex)), from = first;
	float line = CHANNEL(TEX_LOAD(view, VIEW_SCALE, 0), SCALE_LINE), breadth = mean_breadth(all), out = growth(breadth);
	float4 box = box_of(all, c, out, TEX_LOAD(view, VIEW_CLIP, 0));
	float4 seen = ink_of(CHANNEL(ink, INK_FILL), CHANNEL(ink, INK_OUTLINE), line, 1.0f, breadth, all.size);
	if (!put_shape(SHAPES, shape, box, seen, rest, count))
		return;
	float2 f = first_pixel(box), at = (float2)(f.x - c.x, f.y - c.y);
	for (int k = 0; k < count; k++) {
		float2 to = k + 1 < count ? offset_of(ROW_LOAD(placed, vertex + k + 1)) : first;
		float2 side = (float2)(to.x - from.x, to.y - from.y);
		float length = norm(side), nx = -side.y / length, ny = side.x / length;
		bool lost = !(length > 0.0f);
		float distance = (nx * (at.x - from.x) + ny * (at.y - from.y)) - out;
		put_edge(SHAPES, shape, rest, k, lost ? (float4)(0.0f, 0.0f, NO_EDGE, 0.0f) : (float4)(nx, ny, distance, 0.0f));
		from = to;
	}
}

#ifdef CAROM_GPU
#define TOGETHER 1
#else
#define TOGETHER SHAPES_TOGETHER
#endif

__kernel void shapes(TEX_IN(draws), TEX_IN(marks), TEX_IN(placed), TEX_IN(view), SHAPES_OUT, int4 domain)
{
	int i = TOGETHER * (int)get_global_id(0), mark_count = domain.z, first = i - mark_count, end = domain.x - mark_count;
	float4 start = TEX_LOAD(view, VIEW_FIRST, 0), clip = TEX_LOAD(view, VIEW_CLIP, 0);
	float line = CHANNEL(TEX_LOAD(view, VIEW_SCALE, 0), SCALE_LINE);
	int shape = (int)CHANNEL(start, FIRST_SHAPE), rest = (int)CHANNEL(start, FIRST_EDGE), count[SHAPES_TOGETHER];
	float4 parts[SHAPES_TOGETHER], at[SHAPES_TOGETHER], ink[SHAPES_TOGETHER], box[SHAPES_TOGETHER], seen[SHAPES_TOGETHER], edge[SHAPES_TOGETHER];
	bool any = false;
	for (int k = i; k < min(i + TOGETHER, mark_count); k++)
		put_mark(TEX(marks), TEX(view), SHAPES, k, shape + k, rest + LINE_REST * k);
	for (int k = 0; k < SHAPES_TOGETHER; k++) {
		parts[k] = at[k] = ink[k] = (float4)(0.0f);
		if (k < TOGETHER && first + k >= 0 && first + k < end) {
			parts[k] = ROW_LOAD(draws, DRAWS_WIDTH * (first + k) + DRAW_PARTS);
			ink[k] = ROW_LOAD(draws, DRAWS_WIDTH * (first + k) + DRAW_INK);
			at[k] = ROW_LOAD(placed, (int)CHANNEL(parts[k], PARTS_VERTEX));
		}
		count[k] = (int)CHANNEL(parts[k], PARTS_COUNT); /* 0: there is no body */
		any = any || count[k] == 1;
	}
	if (any)
		find_circles(at, ink, line, clip, box, seen, edge);
	shape += mark_count;
	rest += LINE_REST * mark_count;
	for (int k = 0; k < TOGETHER; k++) {
		int vertex = (int)CHANNEL(parts[k], PARTS_VERTEX), own = shape + (int)CHANNEL(parts[k], PARTS_SHAPE),
			more = rest + (int)CHANNEL(parts[k], PARTS_EDGE);
		if (count[k] == 1)
			put_circle(SHAPES, own, more, box[k], seen[k], edge[k], at[k], line, CHANNEL(start, FIRST_LINES) > 0.0f, clip);
		else if (count[k] < 0)
			put_outline(TEX(placed), TEX(view), SHAPES, vertex, -count[k], own, more, ink[k]);
		else if (count[k] > 0)
			put_polygon(TEX(placed), TEX(view), SHAPES, vertex, count[k], own, more, ink[k]);
	}
}
