/* The vertex shader [3]: what its three options share. */

#define PLACES_IN TEX_IN(stream), TEX_IN(linear), TEX_IN(rotational), TEX_IN(transforms), TEX_IN(geometry), TEX_IN(vertices), TEX_IN(view)

/* The vertex of that ordinal of the body whose vertices begin at `first`. */
float2 local_vertex(TEX_IN(vertices), int first, int ordinal)
{
	float4 two = ROW_LOAD(vertices, first + (ordinal >> 1));
	return (ordinal & 1) ? (float2)(CHANNEL(two, VERTICES_X1), CHANNEL(two, VERTICES_Y1))
						 : (float2)(CHANNEL(two, VERTICES_X0), CHANNEL(two, VERTICES_Y0));
}

/* To where the body is, and on to pixels. */
float4 placed_vertex(TEX_IN(view), float4 transform, float2 vertex)
{
	float4 origin = TEX_SENT(view, VIEW_ORIGIN, 0);
	float scale = CHANNEL(TEX_SENT(view, VIEW_SCALE, 0), SCALE_PIXELS);
	float2 v = turn(rotation_of(CHANNEL(transform, TRANSFORMS_ANGLE)), vertex);
	float x = (CHANNEL(transform, TRANSFORMS_X) - CHANNEL(origin, ORIGIN_LEFT)) - CHANNEL(origin, ORIGIN_LEFT_LOW);
	float y = (CHANNEL(origin, ORIGIN_TOP) - CHANNEL(transform, TRANSFORMS_Y)) + CHANNEL(origin, ORIGIN_TOP_LOW);
	return (float4)(v.x * scale, -(v.y * scale), x * scale, y * scale);
}
