/* Index [3]: where the body is, is read from the state as it lies on the device. */

float4 transform_of(TEX_IN(linear), TEX_IN(rotational), TEX_IN(transforms), int body)
{
	float4 l = ROW_LOAD(linear, body), r = ROW_LOAD(rotational, body);
	return (float4)(CHANNEL(l, LINEAR_X), CHANNEL(l, LINEAR_Y), CHANNEL(r, ROTATIONAL_ANGLE), 0.0f);
}
