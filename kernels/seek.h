/* The hits that the step begins with, of the pairs that this slot watches. */
void seek_neighbours(VERTICES_IN, RECORD_IN(slots), LISTS_IN, LIST_OUT(owners), LIST_OUT(parents), float4 rules, int s, trajectory k, float length,
	float ahead, int round)
{
	disc disc_k = disc_of(slots, s, k.place, 0.0f, false, length);
	int changed = wakes[WAKE(s, WAKE_CHANGED)], half_end = spans[SPAN(s, SPAN_HALF)], end = changed > 0 ? spans[SPAN(s, SPAN_END)] : half_end;
	for (int i = first_neighbour(spans, extra, s, end); i != -1; i = next_neighbour(extra, s, end, i)) {
		int other = neighbour_of(neighbours, extra, i), other_changed = status[STATUS_AGE] > 0 ? wakes[WAKE(other, WAKE_CHANGED)] : 0;
		bool watches = changed > other_changed || (changed == other_changed && (i < 0 ? s < other : i < half_end)), pause;
		if (!watches || boxes_apart(disc_k, slots, other, length, 1.0f + ahead))
			continue;
		disc disc_o = disc_of(slots, other, SLOT_LOAD(slots, other, SLOT_PLACE), 0.0f, false, length);
		float meeting = first_meeting(disc_k, disc_o, ahead, are_plain(slots, s, other));
		wake_before(status, wakes, s, meeting);
		if (meeting > 1.0f || stay_apart(disc_k, disc_o))
			continue;
		float t = pair_time(VERTICES, slots, rules, s, k, other, trajectory_start(slots, other), length, 1.0f, &pause);
		if (!(t <= 1.0f))
			continue;
		bool changes = !slot_is_static(slots, s), other_changes = !slot_is_static(slots, other);
		if (changes)
			activate(LISTS, owners, s, other, t, pause, round);
		if (other_changes)
			activate(LISTS, owners, other, s, t, pause, round);
		if (changes && other_changes)
			unite(parents, s, other);
	}
}
