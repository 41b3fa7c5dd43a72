/* Shapes in pixels, y down, clipped and measured from the first pixel that they may touch: there floats are exact
 * enough for any shape. */

#define SHAPES_OUT RECORD_OUT(boxes), RECORD_OUT(shapes), RECORD_OUT(edges)
#define SHAPES boxes, shapes, edges

/* What has a number of its own for each shape is found of four at once, as of each alone; who has one shape takes the first. */

INLINE float4 clamped(float4 v, float4 low, float4 high) /* NaN becomes low */
{
	float4 up = v > low ? v : low;
	return up > high ? high : up;
}

INLINE float4 floor_pixel(float4 v)
{
	float4 c = clamped(v, (float4)(-(float)FARTHEST), (float4)((float)FARTHEST)), whole = convert_float4(convert_int4(c));
	return whole > c ? whole - 1.0f : whole;
}

INLINE int4 are_in_sight(float4 v)
{
	return (v < SEEN) & (v > -SEEN);
}

/* The pixels whose centres may be within half a pixel of what lies between two corners; an empty box for none. */
float4 touched_box(float2 low, float2 high, float margin, float4 clip)
{
	float4 out = floor_pixel((float4)(low.x - margin, low.y - margin, -(high.x + margin), -(high.y + margin)));
	float x0 = larger(out.x, CHANNEL(clip, BOX_X0)), y0 = larger(out.y, CHANNEL(clip, BOX_Y0));
	float x1 = smaller(-out.z, CHANNEL(clip, BOX_X1)), y1 = smaller(-out.w, CHANNEL(clip, BOX_Y1));
	bool any = !is_any(~are_in_sight((float4)(low.x, low.y, high.x, high.y))) && x0 < x1 && y0 < y1;
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
INLINE float4 growths(float4 breadth)
{
	return clamped(0.5f * (1.0f - breadth), (float4)(0.0f), (float4)(0.5f));
}

float growth(float breadth)
{
	return growths((float4)(breadth)).x;
}

INLINE float4 least_opacities(float4 length)
{
	return clamped(LEAST_OPACITY * length, (float4)(LEAST_OPACITY), (float4)(LINE_OPACITY));
}

/* What is long and thin is a line: two outlines and nothing between them. */
INLINE float4 fills_of(float4 fill, float4 outline, float4 breadth, float4 length)
{
	return ((breadth < 1.0f) & (least_opacities(length) >= LINE_OPACITY)) ? outline : fill;
}

INLINE float4 widths_of(float width, float4 breadth)
{
	return clamped(0.125f * breadth, (float4)(0.0f), (float4)(width));
}

INLINE float4 opacities_of(float opacity, float4 breadth, float4 length)
{
	float4 most = (float4)(1.0f);
	return clamped((float4)(opacity), (float4)(0.0f), most) * clamped(breadth, least_opacities(length), most);
}

float fill_of(float fill, float outline, float breadth, float length)
{
	return fills_of((float4)(fill), (float4)(outline), (float4)(breadth), (float4)(length)).x;
}

float4 ink_of(float fill, float outline, float width, float opacity, float breadth, float length)
{
	return (float4)(fill_of(fill, outline, breadth, length), outline, widths_of(width, (float4)(breadth)).x,
		opacities_of(opacity, (float4)(breadth), (float4)(length)).x);
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
