/* Whether the step is done, and what the clock says then; one work-item. */

__kernel void events_settle(TEX_IN(uniforms), TEX_IN(clock), LIST_OUT(status), TEX_OUT(now), int4 domain)
{
	if (get_global_id(0) > 0)
		return;
	float4 hit = TEX_LOAD(clock, CLOCK_HIT, 0), step = TEX_LOAD(clock, CLOCK_STEP, 0), time = TEX_LOAD(clock, CLOCK_TIME, 0);
	float4 counts = TEX_LOAD(clock, CLOCK_COUNTS, 0), ruled = TEX_LOAD(clock, CLOCK_RULED, 0);
	float length = step_length(TEX(uniforms), TEX(clock));
	bool begins = lists_are_good(status) && length > 0.0f, waits = begins && forces_are_wanted(status);
	bool good = begins && !waits, left = good && status[STATUS_LEFT],
		 again = status[STATUS_ROUND] > domain.z || !is_last_slice(status, status[STATUS_ACTIVE]);
	bool done = good && !left && !again;
	status[STATUS_COMMIT] = done;
	status[STATUS_UNDER_WAY] = good && !left && again;
	step = (float4)(0.0f, 0.0f, CHANNEL(step, STEP_STALLED), CHANNEL(step, STEP_ENDED));
	if (done) {
		float2 elapsed = add_exactly((float2)(CHANNEL(time, TIME_ELAPSED), CHANNEL(time, TIME_ELAPSED_LOW)), length);
		float2 remaining = time_left(time, length);
		float2 hits = add_exactly((float2)(CHANNEL(counts, COUNTS_HITS), CHANNEL(counts, COUNTS_HITS_LOW)), (float)status[STATUS_HITS]);
		hit = (float4)(NO_HIT, 0.0f, 0.0f, 1.0f);
		step = (float4)(length, length, 0.0f, 0.0f);
		time = (float4)(elapsed.x, elapsed.y, remaining.x, remaining.y);
		counts = (float4)(CHANNEL(counts, COUNTS_STEPS) + 1.0f, hits.x, CHANNEL(counts, COUNTS_HELD) + (float)status[STATUS_HELD], hits.y);
		float2 all_ruled = add_exactly((float2)(CHANNEL(ruled, RULED_HITS), CHANNEL(ruled, RULED_HITS_LOW)), (float)status[STATUS_RULED]);
		ruled.x = all_ruled.x, ruled.y = all_ruled.y;
		status[STATUS_STEPS]++;
		status[STATUS_BUSTLE] = status[STATUS_HITS];
		status[STATUS_ANSWERED] += status[STATUS_HITS];
		status[STATUS_KEPT_BEFORE] = status[STATUS_KEPT];
		bool busy = status[STATUS_ACTIVE] > domain.w / BUSY
			|| CHANNEL(TEX_LOAD(uniforms, UNIFORMS_RUBS, 0), RUBS_DAMPS) > 0.0f; /* a look is good for ways that go on as they are */
		status[STATUS_AGE] = busy || status[STATUS_AHEAD] == 0 ? 0 : status[STATUS_AGE] + 1;
		status[STATUS_AHEAD] = busy ? 0 : HORIZON - 1;
	}
	status[STATUS_MENDED] = status[STATUS_MOVERS];
	status[STATUS_IDLE] += !begins && length > 0.0f;
	status[STATUS_WAITS] += waits;
	status[STATUS_AGAIN] += good && !left && again;
	if (done || left)
		status[STATUS_ACTIVE] = status[STATUS_FOUND] = status[STATUS_HITS] = status[STATUS_RULED] = status[STATUS_HELD] = 0;
	if (left)
		status[STATUS_STALE] = 1;
	TEX_STORE(now, CLOCK_HIT, 0, hit);
	TEX_STORE(now, CLOCK_STEP, 0, step);
	TEX_STORE(now, CLOCK_TIME, 0, time);
	TEX_STORE(now, CLOCK_COUNTS, 0, counts);
	TEX_STORE(now, CLOCK_RULED, 0, ruled);
}
