/* What the forces of the last step do as this one begins. */

/* A force between a slot and a partner in a step's units; 0 if it is too large for either to begin with. */
float force_begun(RECORD_IN(slots), int s, int partner, float force, float length)
{
	float start = (force * length) * length, inverse_mass = CHANNEL(SLOT_LOAD(slots, s, SLOT_MASS), MASS_INVERSE);
	if (partner >= 0)
		inverse_mass = larger(inverse_mass, CHANNEL(SLOT_LOAD(slots, partner, SLOT_MASS), MASS_INVERSE));
	return fabs(start) * inverse_mass <= WARM_MOST ? start : 0.0f;
}

/* The force that the last step left at a row's point; none at a stop that is not reached, whose is the other one's. */
float row_last(RECORD_IN(slots), RECORD_IN(joints), const joint_row *row, int s, __global const float *at, float length)
{
	int part = row_part(joints, row);
	float last = part_begins(part, joint_kept(joints, row->side, part), at[4 * FOUR_ARM]);
	return force_begun(slots, s, (int)at[4 * FOUR_PARTNER], part_turns(part) && at[4 * FOUR_LEAST] > 0.0f ? 0.0f : last, length);
}

/* How fast those hold a body's angle, by what they pull at its levers, as a spring would. */
float joined_hold(RECORD_IN(slots), RECORD_IN(contacts), LIST_IN(touching), RECORD_IN(joints), LIST_IN(joined), int s, float length)
{
	int point = 0, first = first_four(touching, s);
	float2 lever = (float2)(0.0f, 0.0f);
	float holds = 0.0f;
	for (joint_row row = held_row(slots, touching, joints, joined, s); row.side >= 0; row_next(joints, joined, &row), point++) {
		__global const float *at = POINT_IN(contacts, FOUR_WIDTH, first, point);
		if (row.point == 0)
			lever = held_body(slots, s, joint_anchor(joints, row.side)).lever;
		if (!part_turns(row_part(joints, &row)))
			holds += row_last(slots, joints, &row, s, at, length) * (at[4 * FOUR_NORMAL_X] * lever.x + at[4 * FOUR_NORMAL_Y] * lever.y);
	}
	return holds * CHANNEL(SLOT_LOAD(slots, s, SLOT_MASS), MASS_INVERSE_INERTIA);
}

/* Did impulses of the joints of a root's island come to no end, though none of them is tense? Then forces would not, either, and might give energy. */
bool island_is_tired(LIST_IN(touching), int root)
{
	return (touching[TOUCH(root, TOUCHING_FOOTING)] & (FOOTING_TIRED | FOOTING_TENSE)) == FOOTING_TIRED;
}

/* After the last iteration of impulses that a body with joints can have: says that of its island, if it wants one more. */
void island_tire(RECORD_IN(slots), RECORD_IN(contacts), LIST_OUT(touching), RECORD_IN(joints), LIST_IN(joined), int s, int root, bool wants,
	float length)
{
	bool tense = joined_hold(slots, contacts, touching, joints, joined, s, length) > JOINT_STIFF
		|| touching[TOUCH(s, TOUCHING_JOINED)] > touching[TOUCH(s, TOUCHING_ROWS)];
	atomic_or(&touching[TOUCH(root, TOUCHING_FOOTING)], (wants ? FOOTING_TIRED : 0) | (tense ? FOOTING_TENSE : 0));
}
