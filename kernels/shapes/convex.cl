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

void put_circle(TEX_IN(placed), TEX_IN(view), SHAPES_OUT, int vertex, int shape, int rest, float4 ink, bool has_line)
{
	float4 p = ROW_LOAD(placed, vertex), clip = TEX_LOAD(view, VIEW_CLIP, 0);
	float line = CHANNEL(TEX_LOAD(view, VIEW_SCALE, 0), SCALE_LINE), outline = CHANNEL(ink, INK_OUTLINE);
	float2 to_rim = offset_of(p), c = center_of(p);
	float radius = norm(to_rim), breadth = ((DISC_AREA * radius) * radius) / larger(2.0f * radius, 1.0f);
	float r = radius + growth(breadth);
	float4 box = touched_box((float2)(c.x - r, c.y - r), (float2)(c.x + r, c.y + r), 0.0f, clip);
	bool seen = put_shape(SHAPES, shape, box, ink_of(CHANNEL(ink, INK_FILL), outline, line, 1.0f, breadth, 2.0f * radius), rest, 1);
	if (has_line && !(seen && radius >= SHOW_ANGLE)) {
		boxes[shape + 1] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	} else if (has_line) {
		float2 along = (float2)(to_rim.x / radius, to_rim.y / radius);
		float opacity = (radius - SHOW_ANGLE) * (1.0f / SHOW_ANGLE);
		put_line(SHAPES, shape + 1, rest, c, along, radius - 0.5f * line, line, outline, opacity, clip);
	}
	if (!seen)
		return;
	/* the difference of two large squares as a product: a rim is sharp however large the disc */
	float2 f = first_pixel(box), at = (float2)(f.x - c.x, f.y - c.y);
	float square = magnitude(at.x) > magnitude(at.y) ? ((c.x - r) - f.x) * ((c.x + r) - f.x) + at.y * at.y
													 : ((c.y - r) - f.y) * ((c.y + r) - f.y) + at.x * at.x;
	put_edge(SHAPES, shape, rest, 0, (float4)(at.x / r, at.y / r, square / (2.0f * r), 1.0f / (2.0f * r)));
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

__kernel void shapes(TEX_IN(draws), TEX_IN(marks), TEX_IN(placed), TEX_IN(view), SHAPES_OUT, int4 domain)
{
	int i = get_global_id(0), mark_count = domain.z, k = i - mark_count;
	if (i >= domain.x)
		return;
	float4 start = TEX_LOAD(view, VIEW_FIRST, 0);
	int shape = (int)CHANNEL(start, FIRST_SHAPE), rest = (int)CHANNEL(start, FIRST_EDGE);
	if (k < 0) {
		put_mark(TEX(marks), TEX(view), SHAPES, i, shape + i, rest + LINE_REST * i);
		return;
	}
	float4 parts = ROW_LOAD(draws, DRAWS_WIDTH * k + DRAW_PARTS), ink = ROW_LOAD(draws, DRAWS_WIDTH * k + DRAW_INK);
	int vertex = (int)CHANNEL(parts, PARTS_VERTEX), count = (int)CHANNEL(parts, PARTS_COUNT);
	shape += mark_count + (int)CHANNEL(parts, PARTS_SHAPE);
	rest += LINE_REST * mark_count + (int)CHANNEL(parts, PARTS_EDGE);
	if (count == 1)
		put_circle(TEX(placed), TEX(view), SHAPES, vertex, shape, rest, ink, CHANNEL(start, FIRST_LINES) > 0.0f);
	else if (count < 0)
		put_outline(TEX(placed), TEX(view), SHAPES, vertex, -count, shape, rest, ink);
	else
		put_polygon(TEX(placed), TEX(view), SHAPES, vertex, count, shape, rest, ink);
}
