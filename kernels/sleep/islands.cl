/* Who sleeps after a step, and who wakes since the host is about to change something. */

/* After a step islands fall asleep that it left as they were, and bodies wake that something moved in their sleep; or what else domain.w says. */
__kernel void sleep_begin(RESTS_IN, RECORD_IN(pushes), RECORD_OUT(reach), LIST_OUT(wakes), LIST_OUT(movers), LIST_IN(places), int4 domain)
{
	int s = get_global_id(0);
	if (s >= domain.x || (domain.w == SLEEP_BEGINS && (!status[STATUS_BORNE] || status[STATUS_PASS] > 0)))
		return;
	float length = whole_length(TEX(uniforms), CHANNEL(TEX_LOAD(clock, CLOCK_STEP, 0), STEP_LENGTH));
	if (slot_sleep(slots, status, contacts, touching, grips, islands, pushes, places, s, domain.w, anything_rubs(TEX(uniforms)), length)
		&& !PEEK(status, STATUS_STALE))
		slot_changed(TEX(uniforms), slots, status, reach, wakes, movers, s, domain.z);
}

/* What the host is going to change wakes, with all of its island; what is static wakes all, for any may lean on it. */
__kernel void sleep_end(RECORD_IN(changes), LIST_IN(places), RECORD_IN(slots), LIST_OUT(status), LIST_OUT(touching), LIST_IN(islands), int4 domain)
{
	int k = get_global_id(0);
	if (k >= domain.x)
		return;
	int s = places[(int)CHANNEL(changes[CHANGES_WIDTH * k + CHANGES_TURN], CHANGE_BODY)];
	if (touching[TOUCH(s, TOUCHING_ASLEEP)]) {
		sleeper_rouse(status, touching, s);
		island_disturb(touching, islands, s);
	} else if (slot_is_static(slots, s))
		atomic_or(&status[STATUS_ROUSED], 1);
}
