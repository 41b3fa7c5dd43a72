/* What is seen of circles, found of four at once. */

/* Rows become columns. */
INLINE void put_columns(float4 *to, float4 a, float4 b, float4 c, float4 d)
{
	to[0] = (float4)(a.x, b.x, c.x, d.x);
	to[1] = (float4)(a.y, b.y, c.y, d.y);
	to[2] = (float4)(a.z, b.z, c.z, d.z);
	to[3] = (float4)(a.w, b.w, c.w, d.w);
}

/* The pixels along an axis that four may touch, within limits: from *begin up to *end, or none. */
INLINE int4 touched(float4 low, float4 high, float least, float most, float4 *begin, float4 *end)
{
	float4 first = floor_pixel(low), last = -floor_pixel(-high);
	*begin = first > least ? first : (float4)(least);
	*end = last > most ? (float4)(most) : last;
	return are_in_sight(low) & are_in_sight(high) & (*begin < *end);
}

/* Of each, as in Boxes and Shapes, by their rims and centres and by what the host wants. */
INLINE void find_circles(const float4 *placed, const float4 *wanted, float line, float4 clip, float4 *box, float4 *ink, float4 *edge)
{
	float4 from[4], none = (float4)(0.0f), x0, y0, x1, y1;
	put_columns(from, placed[0], placed[1], placed[2], placed[3]);
	float4 x = from[PLACED_CENTER_X], y = from[PLACED_CENTER_Y], rim_x = from[PLACED_X], rim_y = from[PLACED_Y];
	float4 radius = sqrt(rim_x * rim_x + rim_y * rim_y);
	float4 across = 2.0f * radius, breadth = ((DISC_AREA * radius) * radius) / (across > 1.0f ? across : (float4)(1.0f));
	float4 r = radius + growths(breadth);
	int4 any = touched(x - r, x + r, CHANNEL(clip, BOX_X0), CHANNEL(clip, BOX_X1), &x0, &x1)
		& touched(y - r, y + r, CHANNEL(clip, BOX_Y0), CHANNEL(clip, BOX_Y1), &y0, &y1);
	put_columns(box, any ? x0 : none, any ? y0 : none, any ? x1 : none, any ? y1 : none);
	/* the difference of two large squares as a product: a rim is sharp however large the disc */
	float4 fx = x0 + 0.5f, fy = y0 + 0.5f, dx = fx - x, dy = fy - y;
	int4 is_beside = fabs(dx) > fabs(dy);
	float4 center = is_beside ? x : y, first = is_beside ? fx : fy, other = is_beside ? dy : dx;
	float4 square = ((center - r) - first) * ((center + r) - first) + other * other, twice = 2.0f * r;
	put_columns(edge, dx / r, dy / r, square / twice, 1.0f / twice);
	put_columns(from, wanted[0], wanted[1], wanted[2], wanted[3]);
	put_columns(ink, fills_of(from[INK_FILL], from[INK_OUTLINE], breadth, across), from[INK_OUTLINE], widths_of(line, breadth),
		opacities_of(1.0f, breadth, across));
}
