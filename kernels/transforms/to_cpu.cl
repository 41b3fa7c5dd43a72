/* toCPU [3]: the host has read the state back, and sends where the body is. */

float4 transform_of(TEX_IN(linear), TEX_IN(rotational), TEX_IN(transforms), int body)
{
	return ROW_SENT(transforms, body);
}
