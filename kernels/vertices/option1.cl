/* Option 1 [3]: body and ordinal are sent; Geometry tells where the body's vertices are. */

__kernel void vertices(PLACES_IN, TEX_OUT(placed), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	float4 sent = ROW_SENT(stream, i);
	int body = (int)CHANNEL(sent, STREAM_X);
	float4 g = ROW_LOAD(geometry, body), transform = transform_of(TEX(linear), TEX(rotational), TEX(transforms), body);
	float2 local_place = local_vertex(TEX(vertices), (int)CHANNEL(g, GEOMETRY_FIRST), (int)CHANNEL(sent, STREAM_Y));
	ROW_STORE(placed, i, placed_vertex(TEX(view), transform, local_place));
}
