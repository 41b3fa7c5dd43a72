/* The first hit of the step, of a pair or with a wall, and how far it brings the clock; one work-item. */

__kernel void first(TEX_IN(reduced), TEX_IN(walls), TEX_IN(uniforms), TEX_IN(clock), TEX_OUT(now), int4 domain)
{
	if (get_global_id(0) > 0)
		return;
	float4 world = TEX_LOAD(uniforms, UNIFORMS_WORLD, 0), step = TEX_LOAD(clock, CLOCK_STEP, 0);
	float4 time = TEX_LOAD(clock, CLOCK_TIME, 0), counts = TEX_LOAD(clock, CLOCK_COUNTS, 0);
	float4 hit = (float4)(NO_HIT, 0.0f, 0.0f, 1.0f);
	if (domain.z > 1)
		hit = TEX_LOAD(reduced, 0, 0);
	for (int group = 0; group < domain.w; group++) {
		float4 wall = ROW_LOAD(walls, group);
		if (CHANNEL(wall, WALLS_HIT) < CHANNEL(hit, HIT_TIME))
			hit = (float4)(CHANNEL(wall, WALLS_HIT), CHANNEL(wall, WALLS_BODY), -1.0f - CHANNEL(wall, WALLS_WALL), CHANNEL(wall, WALLS_DONE));
	}
	float length = step_length(TEX(uniforms), TEX(clock)), stalled = CHANNEL(step, STEP_STALLED);
	float advanced = CHANNEL(hit, HIT_TIME) <= 1.0f ? CHANNEL(hit, HIT_TIME) * length : length;
	float2 elapsed = add_exactly((float2)(CHANNEL(time, TIME_ELAPSED), CHANNEL(time, TIME_ELAPSED_LOW)), advanced);
	float2 remaining = time_left(time, advanced);
	if (length > 0.0f) {
		float limit = (float)STALL_LIMIT + (float)STALL_LIMIT_BODY * (float)domain.z;
		bool stands = CHANNEL(hit, HIT_TIME) <= 1.0f && advanced < STALL_LENGTH * CHANNEL(world, WORLD_TIME_STEP);
		bool resolved = CHANNEL(hit, HIT_TIME) <= 1.0f && CHANNEL(hit, HIT_DONE) > 0.0f;
		stalled = stands ? stalled + 1.0f : 0.0f;
		step = (float4)(length, advanced, stalled, stalled > limit ? 1.0f : 0.0f);
		time = (float4)(elapsed.x, elapsed.y, remaining.x, remaining.y);
		counts = (float4)(CHANNEL(counts, COUNTS_STEPS) + 1.0f, CHANNEL(counts, COUNTS_HITS) + (resolved ? 1.0f : 0.0f), 0.0f, 0.0f);
	} else {
		float4 last = TEX_LOAD(clock, CLOCK_HIT, 0); /* who it was that stalled */
		hit = (float4)(NO_HIT, CHANNEL(last, HIT_ROW), CHANNEL(last, HIT_COLUMN), 1.0f);
		step = (float4)(0.0f, 0.0f, stalled, CHANNEL(step, STEP_ENDED));
	}
	TEX_STORE(now, CLOCK_HIT, 0, hit);
	TEX_STORE(now, CLOCK_STEP, 0, step);
	TEX_STORE(now, CLOCK_TIME, 0, time);
	TEX_STORE(now, CLOCK_COUNTS, 0, counts);
	TEX_STORE(now, CLOCK_RULED, 0, TEX_LOAD(clock, CLOCK_RULED, 0));
}
