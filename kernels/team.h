/* Clusters are run by teams. On a GPU these are some lanes each of a group, which look at a body's neighbours together; between two meetings all teams of
 * a group do the same, so that its lanes can do it at once. On a CPU a team is a work-item, and so is its group. */

#ifdef CAROM_GPU
#define SHARED __local
#define TEAM_SIZE(wanted) (wanted)
#define GROUP_LANES GROUP_FEW
#define GROUP_LANE (int)get_local_id(0)
#define GROUP_INDEX (int)get_group_id(0)
#define GROUP_COUNT (int)get_num_groups(0)
#define LEADERS_EACH 4
#define MEET() barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)
#define TAKE(counter) atomic_inc(&(counter))
#else
#define SHARED
#define TEAM_SIZE(wanted) 1
#define GROUP_LANES 1
#define GROUP_LANE 0
#define GROUP_INDEX (int)get_global_id(0)
#define GROUP_COUNT (int)get_global_size(0)
#define LEADERS_EACH 1
#define MEET()
#define TAKE(counter) ((counter)++)
#endif

/* What a look found: the first event, when to look again, and how many events the partner had then. */
typedef struct finding {
	float4 first;
	float again;
	int seen;
} finding;

/* What the teams of a group share. */
typedef struct crew {
	int looks[GROUP_LANES][2];         /* of each team: numbers of the two that look, or what follows */
	finding findings[GROUP_LANES + 1]; /* of each lane: every other one of a team looks for the second. A lane that is a team looks for both */
	int leaders[LEADERS_EACH * GROUP_LANES], count, next; /* of clusters that are to be run; the first that no team has taken */
} crew;

#define LOOKS_NOT -1     /* there is no second, */
#define LOOKS_LATER -2   /* neither looks, but the team goes on, */
#define LOOKS_NO_MORE -3 /* or has nothing left to do */

/* What all lanes of a team found becomes that of its first, and of its second. */
void team_reduce(SHARED crew *all, int lane, int lanes)
{
	MEET();
	for (int width = lanes / 2; width > 1; width /= 2) {
		SHARED finding *own = &all->findings[GROUP_LANE], *other = own + width;
		if (lane < width) {
			own->again = smaller(own->again, other->again);
			if (event_before(other->first, own->first)) {
				own->first = other->first;
				own->seen = other->seen;
			}
		}
		MEET();
	}
}
