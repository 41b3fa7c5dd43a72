/* Islands that sleep: each step would leave them as they are, to the bit, and so none looks at them until they are disturbed: CONTRACT.md, "contacts". */

/* A slot's island, by its root, is to wake; or is not to fall asleep. */
void island_disturb(LIST_OUT(touching), LIST_IN(islands), int s)
{
	atomic_or(&touching[TOUCH(islands[s], TOUCHING_RESTLESS)], 1);
}

bool island_is_disturbed(LIST_IN(touching), LIST_IN(islands), int s)
{
	return touching[TOUCH(islands[s], TOUCHING_RESTLESS)] != 0;
}

/* A slot that sleeps no more. */
void sleeper_rouse(LIST_OUT(status), LIST_OUT(touching), int s)
{
	touching[TOUCH(s, TOUCHING_ASLEEP)] = 0;
	atomic_dec(&status[STATUS_SLEEPERS]);
}

/* Is a slot one of those that are awake; or else that slept, and wake? */
bool is_due(LIST_IN(status), LIST_IN(touching), LIST_IN(islands), int s, bool wakes)
{
	bool asleep = touching[TOUCH(s, TOUCHING_ASLEEP)];
	return wakes ? asleep && (status[STATUS_ROUSED] || island_is_disturbed(touching, islands, s)) : !asleep;
}

/* A pass begins, with that iteration. All wake for a step of another length than the last one's. */
void pass_begin(LIST_OUT(status), int first, float length)
{
	status[STATUS_MOST] = max(status[STATUS_MOST], status[STATUS_WANTED] - status[STATUS_FIRST] + 1);
	status[STATUS_ROUSED] = status[STATUS_PASS] == 0 && (status[STATUS_ROUSED] || as_int(length) != status[STATUS_SLEPT]);
	status[STATUS_SLEPT] = as_int(length);
	status[STATUS_FIRST] = status[STATUS_WANTED] = first;
	status[STATUS_PASS]++;
}

/* As the step begins: with the push that it has awake, if it sleeps. */
body body_awake(RECORD_IN(slots), LIST_IN(touching), RECORD_IN(pushes), int s, float length)
{
	body b = body_of(slots, s, trajectory_start(slots, s), length);
	if (touching[TOUCH(s, TOUCHING_ASLEEP)]) {
		float4 push = pushes[PUSHES_WIDTH * s];
		b.a = push_way(push, length);
		b.b = (CHANNEL(push, PUSH_TORQUE) * length) * length;
	}
	return b;
}
