/* Option 3 [3]: the local coordinates themselves are sent, from a copy of Vertices on the host. */

__kernel void vertices(PLACES_IN, TEX_OUT(placed), int4 domain)
{
	int i = get_global_id(0);
	if (i >= domain.x)
		return;
	float4 sent = ROW_SENT(stream, i);
	float4 transform = transform_of(TEX(linear), TEX(rotational), TEX(transforms), (int)CHANNEL(sent, STREAM_BODY));
	float2 local_place = (float2)(CHANNEL(sent, STREAM_X), CHANNEL(sent, STREAM_Y));
	ROW_STORE(placed, i, placed_vertex(TEX(view), transform, local_place));
}
