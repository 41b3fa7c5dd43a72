/* Shapes in pixels, y down, clipped and measured from the first pixel that they may touch: there floats are exact
 * enough for any shape. */

#define SHAPES_OUT RECORD_OUT(boxes), RECORD_OUT(shapes), RECORD_OUT(edges)
#define SHAPES boxes, shapes, edges

float clamped(float v, float low, float high) /* NaN becomes low */
{
	return smaller(larger(low, v), high);
}

float floor_pixel(float v)
{
	float c = clamped(v, -(float)FARTHEST, (float)FARTHEST), whole = (float)(int)c;
	return whole > c ? whole - 1.0f : whole;
}

bool in_sight(float2 v)
{
	return magnitude(v.x) < SEEN && magnitude(v.y) < SEEN;
}

/* The pixels whose centres may be within half a pixel of what lies between two corners; an empty box for none. */
float4 touched_box(float2 low, float2 high, float margin, float4 clip)
{
	float x0 = larger(floor_pixel(low.x - margin), CHANNEL(clip, BOX_X0));
	float y0 = larger(floor_pixel(low.y - margin), CHANNEL(clip, BOX_Y0));
	float x1 = smaller(-floor_pixel(-(high.x + margin)), CHANNEL(clip, BOX_X1));
	float y1 = smaller(-floor_pixel(-(high.y + margin)), CHANNEL(clip, BOX_Y1));
	bool any = in_sight(low) && in_sight(high) && x0 < x1 && y0 < y1;
	return any ? (float4)(x0, y0, x1, y1) : (float4)(0.0f, 0.0f, 0.0f, 0.0f);
}

bool is_empty(float4 box)
{
	return !(CHANNEL(box, BOX_X0) < CHANNEL(box, BOX_X1));
}

float2 first_pixel(float4 box)
{
	return (float2)(CHANNEL(box, BOX_X0) + 0.5f, CHANNEL(box, BOX_Y0) + 0.5f);
}

/* A shape's mean breadth tells what of it can be seen. What is thinner than a pixel is drawn a pixel wide and paler
 * instead, so that it can't fall between the centres of pixels. */
float growth(float breadth)
{
	return clamped(0.5f * (1.0f - breadth), 0.0f, 0.5f);
}

float least_opacity(float length)
{
	return clamped(LEAST_OPACITY * length, LEAST_OPACITY, LINE_OPACITY);
}

float fill_of(float fill, float outline, float breadth, float length)
{
	bool is_line = breadth < 1.0f && least_opacity(length) >= LINE_OPACITY; /* two outlines and nothing between them */
	return is_line ? outline : fill;
}

float4 ink_of(float fill, float outline, float width, float opacity, float breadth, float length)
{
	float least = least_opacity(length);
	return (float4)(fill_of(fill, outline, breadth, length), outline, clamped(0.125f * breadth, 0.0f, width),
		clamped(opacity, 0.0f, 1.0f) * clamped(breadth, least, 1.0f));
}

/* False: it is not seen. `rest`: where its other edges are. */
bool put_shape(SHAPES_OUT, int shape, float4 box, float4 ink, int rest, int count)
{
	boxes[shape] = box;
	if (is_empty(box))
		return false;
	shapes[SHAPES_WIDTH * shape + SHAPE_BOX] = box;
	shapes[SHAPES_WIDTH * shape + SHAPE_INK] = ink;
	shapes[SHAPES_WIDTH * shape + SHAPE_EDGES] = (float4)((float)rest, (float)count, 0.0f, 0.0f);
	return true;
}

void put_edge(SHAPES_OUT, int shape, int rest, int k, float4 edge)
{
	if (k == 0)
		shapes[SHAPES_WIDTH * shape + SHAPE_EDGE] = edge;
	else
		edges[rest + k - 1] = edge;
}

/* From `from` along a unit vector, with square ends. */
void put_line(SHAPES_OUT, int shape, int rest, float2 from, float2 along, float reach, float breadth, float color, float opacity, float4 clip)
{
	float half_breadth = 0.5f * breadth, x = half_breadth * magnitude(along.y), y = half_breadth * magnitude(along.x);
	float2 to = (float2)(from.x + along.x * reach, from.y + along.y * reach);
	float2 low = (float2)(smaller(from.x, to.x) - x, smaller(from.y, to.y) - y);
	float2 high = (float2)(larger(from.x, to.x) + x, larger(from.y, to.y) + y);
	float size = norm((float2)(high.x - low.x, high.y - low.y));
	float seen_breadth = (reach * breadth) / larger(size, 1.0f), out = growth(seen_breadth);
	float4 box = reach > 0.0f ? touched_box(low, high, out, clip) : (float4)(0.0f, 0.0f, 0.0f, 0.0f);
	if (!put_shape(SHAPES, shape, box, ink_of(color, color, 0.0f, opacity, seen_breadth, size), rest, LINE_EDGES))
		return;
	float2 at = (float2)(first_pixel(box).x - from.x, first_pixel(box).y - from.y), across = (float2)(along.y, -along.x);
	float ahead = inner(along, at), aside = inner(across, at), side = half_breadth + out;
	put_edge(SHAPES, shape, rest, 0, (float4)(-along.x, -along.y, -ahead - out, 0.0f));
	put_edge(SHAPES, shape, rest, 1, (float4)(along.x, along.y, (ahead - reach) - out, 0.0f));
	put_edge(SHAPES, shape, rest, 2, (float4)(-across.x, -across.y, -aside - side, 0.0f));
	put_edge(SHAPES, shape, rest, 3, (float4)(across.x, across.y, aside - side, 0.0f));
}
