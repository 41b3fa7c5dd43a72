/* Option 2 [3]: the body's place in Vertices and the ordinal are sent: Geometry need not be read. */

__kernel void vertices(PLACES_IN, TEX_OUT(placed), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	float4 sent = ROW_SENT(stream, i);
	float4 transform = transform_of(TEX(linear), TEX(rotational), TEX(transforms), (int)CHANNEL(sent, STREAM_BODY));
	float2 local_place = local_vertex(TEX(vertices), (int)CHANNEL(sent, STREAM_X), (int)CHANNEL(sent, STREAM_Y));
	ROW_STORE(placed, i, placed_vertex(TEX(view), transform, local_place));
}
