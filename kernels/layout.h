/* The facts that the OpenCL kernels and the CPU stages share: where each number lies in which texture, and the constants
 * of the numerical rules. No maths here: each side has its own (see CONTRACT.md). */
#ifndef CAROM_LAYOUT_H
#define CAROM_LAYOUT_H

/* Textures of one texel a body are folded into rows of this many texels; up to 4,096 bodies they are the paper's 2^n x 1. */
#define ROW_LOG2 12
#define ROW_SIZE (1 << ROW_LOG2)

/* Linear [2]: state */
#define LINEAR_X 0 /* m */
#define LINEAR_Y 1
#define LINEAR_VX 2 /* m/s */
#define LINEAR_VY 3

/* Rotational [2]: state, and a constant that the broad phase wants beside it */
#define ROTATIONAL_ANGLE 0    /* rad, in [-pi, pi] */
#define ROTATIONAL_VELOCITY 1 /* rad/s */
#define ROTATIONAL_RADIUS 2   /* m, of the circle about the centre of mass that holds the body; constant */

/* Geometry [2] */
#define GEOMETRY_FIRST 0   /* index of the body's first texel in Vertices */
#define GEOMETRY_COUNT 1   /* of vertices; 1 for a circle; of a polygon that is not convex those of its hull, and PIECES for each piece */
#define GEOMETRY_MASS 2    /* kg; infinite for a static or kinematic body */
#define GEOMETRY_INERTIA 3 /* kg m^2; infinite likewise */

/* Vertices [2]: two vertices a texel, counter-clockwise, about the centre of mass; a body begins at a new texel. A
 * circle's only vertex is (radius, 0). */
#define VERTICES_X0 0
#define VERTICES_Y0 1
#define VERTICES_X1 2
#define VERTICES_Y1 3

#define PIECES 128

/* Forces: what acts on a body besides gravity, and its restitution */
#define FORCES_X 0 /* N */
#define FORCES_Y 1
#define FORCES_TORQUE 2 /* N m */
#define FORCES_RESTITUTION 3

/* Friction: what brakes a body, a texel each */
#define FRICTION_SLIDING 0        /* the coefficient; a pair takes the geometric mean of its two */
#define FRICTION_ROLLING 1        /* likewise; a pair takes the larger */
#define FRICTION_LINEAR_DAMPING 2 /* 1/s */
#define FRICTION_ANGULAR_DAMPING 3

/* Filters: which pairs may hit each other. A list: whether any may not; only then three ints a body follow, and behind those the bodies that some never meet, whatever they are:
 * those that a joint holds. */
#define FILTERS_ANY 0 /* 0 or 1 */
#define FILTERS_FIRST 4
#define FILTER_WIDTH 3
#define FILTER_CATEGORIES 0 /* bits: what the body is */
#define FILTER_MASK 1       /* bits: the categories that it meets */
#define FILTER_EXCEPT 2     /* where in the list the bodies begin that it never meets, -1 behind the last; 0: there are none */
#define FILTER(body, part) (FILTERS_FIRST + FILTER_WIDTH * (body) + (part))

/* Uniforms: what is the same for every body; four texels in a row */
#define UNIFORMS_WIDTH 4
#define UNIFORMS_WORLD 0 /* texel */
#define WORLD_COUNT 0    /* bodies */
#define WORLD_TIME_STEP 1
#define WORLD_GRAVITY_X 2
#define WORLD_GRAVITY_Y 3
#define UNIFORMS_ROOM 1 /* texel */
#define ROOM_MIN_X 0
#define ROOM_MIN_Y 1
#define ROOM_MAX_X 2
#define ROOM_MAX_Y 3
#define UNIFORMS_RULES 2    /* texel */
#define RULES_EPSILON 0     /* accuracy of the bisection, part of a step */
#define RULES_ITERATIONS 1  /* bisections a pass */
#define RULES_HAS_ROOM 2    /* 0 or 1 */
#define RULES_RESTITUTION 3 /* of the walls */
#define UNIFORMS_RUBS 3     /* texel */
#define RUBS_WALLS 0        /* their coefficient of friction */
#define RUBS_ANY 1          /* 0 or 1: something has friction, or rolling friction */
#define RUBS_ROLLING 2      /* the walls' coefficient of rolling friction */
#define RUBS_DAMPS 3        /* 0 or 1: something has damping */

/* Clock: how far the simulation is; five texels in a row, ping-pong */
#define CLOCK_WIDTH 5
#define CLOCK_HIT 0     /* texel: the first hit of the step */
#define HIT_TIME 0      /* part of the step, NO_HIT if there is none */
#define HIT_ROW 1       /* body A */
#define HIT_COLUMN 2    /* body B, or -1 - wall */
#define HIT_DONE 3      /* 1: a hit; 0: only a pause, the search goes on in the next step */
#define CLOCK_STEP 1    /* texel */
#define STEP_LENGTH 0   /* s that the step could last */
#define STEP_ADVANCED 1 /* s that it lasted */
#define STEP_STALLED 2  /* steps in a row that did not get on */
#define STEP_ENDED 3    /* 1 once time has stalled */
#define CLOCK_TIME 2    /* texel: sums of two floats, high and low part */
#define TIME_ELAPSED 0
#define TIME_ELAPSED_LOW 1
#define TIME_REMAINING 2 /* below LEAST_STEP: it is over */
#define TIME_REMAINING_LOW 3
#define CLOCK_COUNTS 3 /* texel */
#define COUNTS_STEPS 0
#define COUNTS_HITS 1 /* sum of two floats */
#define COUNTS_HITS_LOW 3
#define COUNTS_HELD 2 /* bodies that were held, see HOLD_LIMIT */
#define CLOCK_RULED 4 /* texel: hits that rules against hits without end answered, sum of two floats */
#define RULED_HITS 0
#define RULED_HITS_LOW 1

#define LAST_STEP \
	(1.0f         \
		+ 1.0f    \
			/ 4096.0f) /* time steps that the last one before an end may last: a time step is a float, and so many hardly ever end where they are meant to */
#define LEAST_STEP 1.17549435e-38f /* s, the least normal float: what is divided by less may become infinite */

/* AABB [2.1] of the body over the whole step */
#define AABB_MIN_X 0
#define AABB_MIN_Y 1
#define AABB_MAX_X 2
#define AABB_MAX_Y 3

/* Overlap [2.1]: one byte a pair, 1 if the AABBs overlap; four columns a texel, so that the format is one that every
 * device has. Ping-pong: the back keeps the step before. */
#define OVERLAP_COLUMNS 4

/* Tiles: one texel a tile of TILE x TILE pairs, ping-pong. A tile where nothing overlaps costs no more than this texel:
 * its pairs in HitTimes say NO_HIT from earlier steps. First byte, bits: */
#define TILE 8
#define TILE_COLUMNS (TILE / OVERLAP_COLUMNS) /* texels of Overlap in a tile's row */
#define TILES_NOW 1                           /* a pair overlaps in this step */
#define TILES_BEFORE 2                        /* one did in the step before: HitTimes holds something old */
#define TILES_LONG_BEFORE 4                   /* one did two steps ago: so does the Overlap that is overwritten */
#define OVERLAP_GROUP 4                       /* tiles, one above the other, that a work-item of the overlap slot does */

/* HitTimes [2.1], row i, column j < i; what is not written in a step is NO_HIT from the steps before */
#define HITTIMES_MIN 0 /* the interval that encloses the hit */
#define HITTIMES_MAX 1
#define HITTIMES_DONE 2 /* 1: found or rejected; 0: go on searching */
#define HITTIMES_HIT 3  /* part of the step, in [0, 1], or NO_HIT */
#define NO_HIT 2.0f

/* TileHits: the first hit of each tile; Reduced [2.2]: its levels, each a half (tiled: a TILE-th) of the one before, the
 * last one texel. Both: */
#define REDUCED_HIT 0 /* the least HITTIMES_HIT below, and where it is */
#define REDUCED_ROW 1
#define REDUCED_COLUMN 2
#define REDUCED_DONE 3

/* Walls: the first hit of a group of bodies with a wall */
#define WALLS_GROUP 16 /* bodies a texel */
#define WALLS_HIT 0
#define WALLS_BODY 1
#define WALLS_WALL 2 /* 0: x = min, 1: y = min, 2: x = max, 3: y = max */
#define WALLS_DONE 3

/* Impulse [2.3]: of the first hit; two texels in a row */
#define IMPULSE_WIDTH 2
#define IMPULSE_PUSH 0 /* texel; +J acts on A, -J on B */
#define IMPULSE_X 0    /* N s */
#define IMPULSE_Y 1
#define IMPULSE_TORQUE_A 2 /* N m s about A's centre of mass */
#define IMPULSE_TORQUE_B 3 /* of -J about B's */
#define IMPULSE_WHERE 1    /* texel */
#define WHERE_X 0          /* m, of the contact */
#define WHERE_Y 1
#define WHERE_NORMAL_X 2 /* towards A, 1 long */
#define WHERE_NORMAL_Y 3

/* ---- The step events. Bodies are kept in slots sorted by place; records are lists of four floats, lists are of ints. */

/* Slots: four records a slot. Which body it is, is a number below 2^22. */
#define SLOT_WIDTH 4
#define SLOT_PLACE 0 /* record: the channels of Linear */
#define SLOT_TURN 1  /* record */
#define TURN_ANGLE 0
#define TURN_VELOCITY 1
#define TURN_RADIUS 2
#define TURN_RESTITUTION 3
#define SLOT_MASS 2    /* record */
#define MASS_INVERSE 0 /* 1 / kg; 0 for a static or kinematic body */
#define MASS_INVERSE_INERTIA 1
#define MASS_FIRST 2 /* in Outlines; GEOMETRY_COUNT */
#define MASS_COUNT 3
#define SLOT_PUSH 3 /* record */
#define PUSH_X 0    /* m/s^2: gravity and force; 0 of what has no inverse mass */
#define PUSH_Y 1
#define PUSH_TORQUE 2 /* rad/s^2 */
#define PUSH_BODY 3   /* index of the body */

/* Outlines: a record a vertex of polygons, from twice the body's GEOMETRY_FIRST on, which MASS_FIRST is */
#define OUTLINE_X 0
#define OUTLINE_Y 1
#define OUTLINE_NORMAL_X 2 /* outward, 1 long, of the side from here to the next vertex */
#define OUTLINE_NORMAL_Y 3
/* Of a polygon that is not convex these are its hull's; behind them, from the next even index on, a record for each piece follows, and then the vertices of one piece after the other. */
#define PIECE_COUNT 0 /* of vertices */
#define PIECE_X 1     /* m: the middle of a circle that holds it, in the body's frame */
#define PIECE_Y 2
#define PIECE_RADIUS 3

/* Reach: a record a slot, the box (AABB's channels) that the body does not leave while the lists of neighbours are good */

/* Bodies that events change in a step get numbers, one after the other, by which Active has their slots, Owners their slots' numbers, and Work and
 * Members what is known of them: few lines of memory, used again and again. */

/* Work: four records a number */
#define WORK_WIDTH 4
#define WORK_PLACE 0 /* record: as SLOT_PLACE, at WORK_TIME */
#define WORK_TURN 1  /* record */
#define WORK_ANGLE 0
#define WORK_VELOCITY 1
#define WORK_TIME 2          /* part of the step */
#define WORK_HELD 3          /* 1: it stays where it is until the step ends */
#define WORK_NEXT 2          /* record: the body's first event, by what is known */
#define NEXT_TIME 0          /* part of the step, NO_HIT if there is none */
#define NEXT_UNKNOWN (-1.0f) /* this time: it is to be looked for, before all others */
#define NEXT_ROW 1           /* bodies: the larger index, the less; or the body and -1 - wall */
#define NEXT_COLUMN 2
#define NEXT_PARTNER 3 /* its slot, or -1 - wall; a half farther from 0 if the event is only a pause of the search */
#define WORK_BOX 3     /* record: AABB's channels, of the way since its first event in the slice, to the slice's end */

/* A step has STATUS_SLICES slices of the same length, one after the other. When all that hits before the end of one is answered, clusters fall apart, and what was found stays:
 * clusters that get into each other's way later begin anew from there. Where there are more slices than one Work and Members have as many again behind the numbers: the state as
 * the slice began, of the numbers that were given then, STATUS_SAVED of them. */
#define SLICES_MOST 16

/* So many numbers more than bodies, since a cluster loses one where another claims the body first. */
#define NUMBERS_SPARE 4096

/* From this round of a slice on a cluster that meets another is united with all around it: in a dense crowd most would meet, one after the other. */
#define SPREAD_ROUND 2

/* A cluster that meets another when the body that is to hit had so many events lies in a pile: all that is near is going to be in it, and each time that it begins anew much is
 * lost. So before it is run again it takes bodies on that are nearer to its own than this part of the smaller one's radius, and those near them, and is united with clusters that have such. */
#define PILE_EVENTS 8
#define PILE_GAP 0.5f

/* Members: sixteen ints a number */
#define MEMBER_WIDTH 16
#define MEMBER_STUCK 0    /* its last events, one after the other, that were rapid and slow hits; and STUCK_FAST, if one in the step was not slow */
#define MEMBER_OWNER 1    /* number of the cluster's leader */
#define MEMBER_LINK 2     /* next member of the cluster, -1 for none */
#define MEMBER_HEAD 3     /* of a leader: the first member; -1 if it leads none */
#define MEMBER_EVENTS 4   /* of the body in this step */
#define MEMBER_RAPID 5    /* of these, rapid ones */
#define MEMBER_SEEN 6     /* events of the partner when NEXT was found; below 0: it is to look again, as a shock's parties are, see party_next */
#define MEMBER_HITS 8     /* answered with an impulse, counted at one of the two bodies */
#define MEMBER_ROUND 7    /* of a leader: the round in which the cluster is to be done */
#define MEMBER_CHILD 9    /* of the cluster's heap, where it is made of links: the first below this one, */
#define MEMBER_SIBLING 10 /* the next of those it belongs to, */
#define MEMBER_BEFORE 11  /* and the one before, or for the first the one above */
#define MEMBER_RULED 12   /* of its hits: those that were answered otherwise than by their restitution */
#define MEMBER_KEPT 13    /* the first of its hits in Hits, -1 for none */
#define MEMBER_PILE 14    /* 1: it led a cluster that lies in a pile, in this step */
#define MEMBER_BEGUN 15   /* EVENTS, as the slice began */

/* Owners: the number of the body in the slot, -1 for none, -2: just being given one; Active: the slot of the number, -1 for none; Parents: union-find of slots */

/* Places: an int a body, its slot */

/* Changes: three records a body that the host changes between two steps, or picks to read its state */
#define CHANGES_WIDTH 3
#define CHANGES_PLACE 0 /* record: as in Linear */
#define CHANGES_TURN 1  /* record */
#define CHANGE_ANGLE 0
#define CHANGE_VELOCITY 1
#define CHANGE_BODY 2
#define CHANGE_MOVES 3   /* 1: that is its state now; 0: only its forces are others */
#define CHANGES_FORCES 2 /* record: as in Forces */
/* or four a body that comes, with the first vertex of a polygon alone, */
#define ADDED_WIDTH 4
#define ADDED_LINEAR 0 /* records: as in the textures of that name */
#define ADDED_ROTATIONAL 1
#define ADDED_GEOMETRY 2
#define ADDED_FORCES 3
/* or one a body that goes, in the order of their indices */
#define REMOVED_BODY 0
#define REMOVED_LAST 1 /* the last slot there is when it goes: one fewer for each */

/* Spans: four ints a slot */
#define SPAN_WIDTH 4
#define SPAN_START 0 /* in Neighbours: those to test a pair with, */
#define SPAN_HALF 1  /* then those that test it themselves */
#define SPAN_END 2
#define SPAN_CELL 3
#define SPAN_FOUND 3 /* once the lists are made: the first of its hits that the step begins with, or one of the next two */
#define FOUND_NONE -1
#define FOUND_NO_ROOM -2 /* some were not kept: it is to be looked for them again */

/* Movers: slots whose reach has changed since the lists were made. Extra: an int a slot, where in Extra its neighbours begin that are not in its span, -1 for
 * none; behind those ints nodes like those of Nodes */

/* Wake: two ints a slot, steps as STATUS_AGE counts them. Of two neighbours the one that was changed later watches the other; of two that were changed
 * alike the one that has the other in its span's first part. */
#define WAKE_WIDTH 2
#define WAKE_CHANGED 0                       /* when the body last changed its way, as CHANGED_IN or CHANGED_AFTER, 0: not since all was looked at */
#define WAKE_NEXT 1                          /* the step in which to look again: before, it has no hit with what it watches, nor with a wall */
#define CHANGED_IN(next) (2 * (next))        /* by an event in the step before that one */
#define CHANGED_AFTER(next) (2 * (next) + 1) /* between the two: what had an event has looked at it as it was */
#define HORIZON 6 /* steps that one look is good for; 1 where a BUSY-th of the bodies or more are in clusters: it would not pay */
#define BUSY 6

/* Hits: four records a hit, where hits are kept: those of a cluster as they were answered, one after the other, but between them those of others; also some that did
 * not come to pass, of steps or clusters that began again */
#define HITS_WIDTH 4
#define HITS_MOST (1 << 24) /* as many as a float can count */
#define HITS_WHO 0          /* record */
#define WHO_TIME 0          /* part of the step */
#define WHO_ROW 1           /* bodies, as in NEXT_ROW */
#define WHO_COLUMN 2
#define HITS_WHERE 1     /* record: as IMPULSE_WHERE; A is the row body */
#define HITS_WHAT 2      /* record */
#define WHAT_IMPULSE_X 0 /* N s, on the row body; the other gets the opposite */
#define WHAT_IMPULSE_Y 1
#define WHAT_RULED 2 /* 1: it counts in STATUS_RULED */
#define WHAT_LINK 3  /* the next hit of the member, -1 for none */
#define HITS_WHEN 3  /* record, of those that came to pass: the clock's TIME_ELAPSED after the step, */
#define WHEN_ELAPSED 0
#define WHEN_ELAPSED_LOW 1
#define WHEN_LENGTH 2 /* s, of the step, */
#define WHEN_STEP 3   /* and COUNTS_STEPS with it; 0: it did not */

/* Cells: three ints a cell. Each level has rows of its own, half as many as the level before, and one at least. */
#define CELL_WIDTH 3
#define CELL_COUNT 0
#define CELL_START 1
#define CELL_END 2
#define CELL_LEVELS 24                             /* each with cells twice as large as the one before */
#define CELL_ROWS(rows) (2 * (rows) + CELL_LEVELS) /* of all levels */
#define CELL_FIRST_ROW(rows, level) (2 * (rows) - (2 * (rows) >> (level)) + (level))

/* Nodes: two ints; small bodies found beside a large one */
#define NODE_WIDTH 2
#define NODE_SLOT 0
#define NODE_LINK 1

/* Found: what lies in Nodes once the lists are made, three ints a hit and body */
#define FOUND_WIDTH 3
#define FOUND_PARTNER 0 /* its slot, or -1 - wall */
#define FOUND_TIME 1    /* float bits; the sign: it is only a pause of the search */
#define FOUND_LINK 2    /* as SPAN_FOUND */

/* Contacts, of the step contacts: points of what joints hold a body, and then of what it leans on, or is leaned on by, in the order of the others' indices, walls (-1 - wall) first, one or
 * two points each. Ten records for four points side by side; where there are no more, points of zeros. A slot's fours follow each other; Touching tells where they begin. */
#define FOUR_WIDTH 11
#define FOUR_PARTNER 0  /* as below */
#define FOUR_NORMAL_X 1 /* from the partner to this body, 1 long */
#define FOUR_NORMAL_Y 2
#define FOUR_ARM 3       /* m: the normal's arm about this body's centre, */
#define FOUR_OTHER_ARM 4 /* and about the partner's */
#define FOUR_LEAST 5     /* m a step: how fast the points may come together */
#define FOUR_TOLERANCE 6 /* m a step */
#define FOUR_STEP 7      /* kg: by how much a rate changes a force in an iteration */
#define FOUR_FORCE 8     /* kg m / step^2, 0 or more, but of joints */
#define FOUR_START 9     /* that from which the next iteration starts */
#define FOUR_GIVE 10     /* 1/kg: by how much it gives way of itself, of joints */
/* The other's slot if it moves, as a kinematic body does, else one of these. */
#define PARTNER_NONE (-1)
#define PARTNER_WALL(wall) (-2 - (wall))
#define PARTNER_STATIC(index) (-6 - (index))

/* Grips, where bodies rub: how the points of Contacts slide along u = (-n.y, n.x); eight records for four of them. Where a circle has rolling friction its one point is there
 * twice: at the second no force acts along u, but a torque against rolling, as a force with the arms GRIP_ARM. Each has half of the normal force, and so twice the coefficient. */
#define GRIP_WIDTH 8
#define GRIP_FRICTION 0  /* the coefficient */
#define GRIP_ARM 1       /* m: u's arm about this body's centre, */
#define GRIP_OTHER_ARM 2 /* and about the partner's */
#define GRIP_STEP 3      /* kg */
#define GRIP_BOUND 4     /* kg m / step^2: what the force may not exceed now */
#define GRIP_FORCE 5
#define GRIP_START 6
#define GRIP_ALONG 7 /* 1; 0 where it is rolling friction */

/* Warm: the forces that the last steps ended with, as means that follow the last one by WARM_FOLLOW: what a step ends with makes up for what the one before
 * left within its tolerance, and so differs from what bears. A body's contacts are in the order of Contacts: a record each, or where bodies
 * rub two. The next step begins with them, where the two do not rub with a WARM_PART: from more on iterations
 * end, within their tolerance, with forces that part what they ought to bear, and heaps slosh on. Where they rub they follow by GRIP_WARM_FOLLOW, for what stops them is no more what bears them; and what bears bodies at rest without another
 * iteration is kept as it is. */
#define WARM_WIDTH(rub) ((rub) ? 2 : 1)
#define WARM_PARTNER 0  /* the other's index, or -1 - wall */
#define WARM_FORCES 1   /* two, N */
#define WARM_FRICTION 0 /* of the second record: two, N */
#define WARM_PART 0.9f
#define WARM_FOLLOW 0.25f
#define GRIP_WARM_FOLLOW 0.125f
#define WARM_MOST 1e6f /* m/step^2, of either body: a larger force is not begun with */

/* WarmSpans: three ints a body, by its index: where its contacts are in Warm; and before them three for all */
#define WARM_SPAN_WIDTH 3
#define WARM_SPAN_START 0
#define WARM_SPAN_COUNT 1
#define WARM_SPAN_ROOM 2 /* contacts that there is room for */
#define WARM_TAKEN 0     /* for all: contacts that there has been asked room for, */
#define WARM_ROOM 1      /* and that there is room for in Warm */

/* Joints: four records a joint, in the order in which they were given. The step contacts has points of them: in Contacts they come first of a body's, in the order of its joints: those that
 * are firm, which push and pull as is needed, and behind these the loose ones. */
#define JOINT_WIDTH 4
#define JOINT_PARTIES 0 /* record: the two bodies' indices; */
#define JOINT_BODY 0
#define JOINT_OTHER 1 /* -1: it is a place in the world; */
#define JOINT_LENGTH \
	2 /* m, how far the anchors are from each other, of a rope at most, of a spring at rest; of a slider rad, which way its line goes in the other's frame; */
#define JOINT_KIND 3 /* what it is: */
#define JOINT_PIN 0
#define JOINT_ROD 1
#define JOINT_ROPE 2
#define JOINT_SPRING 3
#define JOINT_SLIDER 4
#define JOINT_ANCHORS 1    /* record: m, from the centre of mass, in the body's own frame, x and y of each; or of the world */
#define JOINT_FORCES 2     /* record, part of the state: what acted on the body in the last step, */
#define JOINT_FORCE 0      /* N: away from the other's anchor, or of a pin along x, and then along y, or of a slider to the left of its line; */
#define JOINT_BACK 1       /* N: of a rope, what the next step takes back of it; */
#define JOINT_TORQUE 2     /* N m, of a motor; */
#define JOINT_STOP 3       /* and of stops */
#define JOINT_DRIVE 3      /* record: of a pin or a slider */
#define DRIVE_SPEED 0      /* rad/s, of the body against the other one, which a motor wants; */
#define DRIVE_TORQUE 1     /* N m, with no more than this, 0: there is none; */
#define DRIVE_MIDDLE 2     /* rad, between the two stops; and */
#define DRIVE_HALF 3       /* as far from each, 0: it does not turn, below 0: there are none; or of a spring */
#define SPRING_STIFFNESS 0 /* N/m */
#define DRIVE_GIVES 2      /* 1/kg, likewise, and of a rod or a rope: how much a force at its anchors parts them, at most */
#define SPRING_DAMPING 1   /* N s/m */

/* Changes of Joints: a record each */
#define DRIVEN_JOINT 0
#define DRIVEN_SPEED 1
#define DRIVEN_TORQUE 2

/* Joined: a list: how many joints there are, and bodies behind that: of each a side of its first joint, -1 for none, and then of each side the same body's next one. Side 2 j is the
 * body's of joint j, 2 j + 1 the other's. */
#define JOINED_COUNT 0
#define JOINED_BODIES 1
#define JOINED_FIRST 4
#define JOINED_NEXT(bodies, side) (JOINED_FIRST + (bodies) + (side))

/* Touching: ints of each slot */
#define TOUCHING_WIDTH 14
#define TOUCHING_COUNT 0          /* of its points */
#define TOUCHING_SLOT 1           /* a list: slots with contacts, in this step or in the last, and kinematic bodies that move */
#define TOUCHING_WANTED 2         /* of a root: the last iteration that its island wants */
#define TOUCHING_RESTLESS 3       /* of a root: 1: not all of its island is as the step began; of one that sleeps: it is to wake */
#define TOUCHING_ASLEEP 4         /* 1: each step would leave it, and all of its island, as it is: its push is kept, and 0 in the slot */
#define TOUCHING_FOOTING 5        /* bits: of a root, what its island is on: */
#define FOOTING_FIRM 1            /* its ground, on which it does not slide; */
#define FOOTING_LOOSE 2           /* something else, or on which it slides; and of each slot, root or not: */
#define FOOTING_SLIDES 4          /* its body slides somewhere; of a root: */
#define FOOTING_TIRED 8           /* joints of its island wanted more iterations of impulses than there are, */
#define FOOTING_TENSE 16          /* and forces of the last step hold an angle, or a place across a joint, too fast for the step */
#define TOUCHING_FIRST 6          /* of its fours in Contacts and Grips; there is room for */
#define TOUCHING_ROOM 7           /* so many, */
#define TOUCHING_MADE 8           /* as long as this is STATUS_MADE */
#define TOUCHING_CARRIER 9        /* of a root: the largest index of the kinematic bodies that its island touches, -1: none; or: */
#define CARRIER_STATIC 0x7fffffff /* it touches something static */
#define TOUCHING_JOINED 10        /* how many of its points, the first ones, are of joints, */
#define TOUCHING_FIRM 11          /* and of these, the first ones, are firm; */
#define TOUCHING_ROWS 12          /* those behind so many hold aside */
#define TOUCHING_TURNS 13         /* the bits of a float: by which part of its inverse inertia forces turn the body; 1, unless joints hold it */

/* What sleep_begin is for */
#define SLEEP_BEGINS 0    /* after a step, of islands that it left as they were; what was moved in its sleep wakes */
#define SLEEP_ENDS 1      /* of all */
#define SLEEP_FORGOTTEN 2 /* slots are loaded anew */

/* Islands: an int a slot, its parent in its island: dynamic bodies that touch each other, directly or by others. A root is its own; once there was an iteration, all have the root. */

/* Loads: three lists of a record a slot: how it moves in a step, x, y, angle, in the iterations with even numbers and in the others, and by itself; and its share. What an iteration
 * reads lies apart from what it writes, for else threads wait for each other's lines. Before each list is the record of slot -1, of what does not move: zeros. */
#define LOADS_LISTS 3
#define LOADS_OF(capacity, list) ((list) * ((capacity) + 1) + 1) /* the list's first slot */
#define LOADS_ALONE 2
#define LOAD_SHARE 3 /* as if so many points alone pushed it */

/* Pushes: three records a slot, before the step: SLOT_PUSH; the velocities vx, vy, angular; the place x, y, angle */
#define PUSHES_WIDTH 3

/* Shocks: SHOCK_RECORDS a number: the velocities vx, vy, angular with which a body became a party; and SHOCK_POINTS points, each of three records: where what it is hit with passes on */
#define SHOCK_WIDTH 3
#define SHOCK_POINTS 12
#define SHOCK_RECORDS (1 + SHOCK_WIDTH * SHOCK_POINTS)
#define SHOCK_NORMAL 0 /* towards the body: x, y; and the arms about its centre and the other's, m */
#define SHOCK_GRIP 1   /* arms along the surfaces; the coefficient of friction; the speed at which the point is to part, m/s */
#define SHOCK_PUSH \
	2 /* the partner, as in Contacts, and its number if it is a party, else -1; the impulses along the normal and along the surfaces, N s, or, while a
                          * partner that moves is no party, how fast it comes along the normal, m/s */
#define SHOCK_X 0
#define SHOCK_Y 1
#define SHOCK_ARM 2
#define SHOCK_OTHER_ARM 3
#define SHOCK_GRIP_ARM 0
#define SHOCK_OTHER_GRIP_ARM 1
#define SHOCK_FRICTION 2
#define SHOCK_JOINT (-1.0f) /* in its place: it is a point of a joint, of a tug */
#define SHOCK_PART 3
#define SHOCK_PARTNER 0
#define SHOCK_NUMBER 1
#define SHOCK_IMPULSE 2
#define SHOCK_RUB 3

#define GROUP_MOST 64  /* work-items of a group */
#define GROUP_FEW 32   /* of a smaller one, */
#define GROUP_WIDE 256 /* and of one that looks for one body's neighbours, on a GPU */
#define SEEK_EACH 4    /* slots at most for each of those that look for hits, where most sleep: those that do not are shared */

/* Status: ints, and some floats in their bits */
#define STATUS_WIDTH 64
#define STATUS_STALE 0     /* 1: the lists of neighbours are to be made anew before the next step */
#define STATUS_SMALL 1     /* 1: Neighbours, Nodes, Hits, Contacts or Warm has too little room */
#define STATUS_UNDER_WAY 2 /* 1: a step is, with clusters to do again */
#define STATUS_COMMIT 3    /* 1: the step is done */
#define STATUS_LEFT 4      /* 1: a body would leave its reach: the step begins again, with other lists */
#define STATUS_ROUND 5     /* the last round that has clusters to do; rounds are numbered on and on */
#define STATUS_BEGUN 6     /* the slice's first round */
#define STATUS_SEEDS 7     /* numbers given when the round began */
#define STATUS_NUMBERS 8   /* there are for bodies that events change */
#define STATUS_ROOM 9      /* ints there are in Neighbours */
#define STATUS_NODE_ROOM 10
#define STATUS_LEVELS 11     /* bits: levels that have bodies */
#define STATUS_PACE 12       /* float bits, m: what the slower bodies may go before the lists are stale */
#define STATUS_CELL 13       /* float bits, m: the side of a cell of level 0 */
#define STATUS_WINDOW 14     /* float bits, s: how long the lists are to last */
#define STATUS_BUILDS 15     /* since the host asked: how often lists were made, */
#define STATUS_STEPS 16      /* steps done, */
#define STATUS_IDLE 17       /* not begun for want of lists, */
#define STATUS_AGAIN 18      /* and not done since they needed more rounds */
#define STATUS_AGE 19        /* steps since all was looked at; 0: all is to be */
#define STATUS_EXTRA_ROOM 20 /* ints there are in Extra */
#define STATUS_MENDED 21     /* of Movers: those that are with their new neighbours */
#define STATUS_AHEAD 22      /* steps after this one that a look is good for */
#define STATUS_LITTERED 31   /* numbers that a step which was not done has left as they were, when the lists were made; of OpenCL devices */
#define STATUS_BUSTLE 28     /* hits of the last step that is done: where there are many, shorter lists are better */
#define STATUS_BRIEF 29      /* float bits, s: how long the lists of bodies are to last that are far faster than most */
/* Of the step contacts, whose iterations are numbered on and on: */
#define STATUS_WANTED 23   /* the last iteration that is wanted; if that is after STATUS_HANDED, the step waits for its forces */
#define STATUS_FIRST 24    /* the first of those now */
#define STATUS_HANDED 25   /* the last that was handed over */
#define STATUS_BORNE 26    /* 1: pushes or velocities are changed */
#define STATUS_WAITS 27    /* since the host asked: steps not done since they needed more iterations; of OpenCL devices, as WANTED and MOST */
#define STATUS_PASS 30     /* of the step: 0: not begun yet, */
#define PASS_IMPULSES 1    /* what comes together is stopped, */
#define PASS_FORCES 2      /* and borne */
#define STATUS_ROUSED 58   /* 1: all wake in the next step */
#define STATUS_SLEPT 54    /* float bits, s: the step in which those that sleep would stay as they are */
#define STATUS_SLEEPERS 55 /* bodies that sleep */
#define STATUS_MOST 56     /* since the host asked: the most iterations of a pass that is done */
#define STATUS_MADE 57     /* how often lists of neighbours were made since the slots were loaded: each time Contacts is empty again */
/* What many count at the same time is no neighbour of what they all read. */
#define STATUS_ACTIVE 32     /* numbers given */
#define STATUS_FOUND 33      /* hits in Found */
#define STATUS_HITS 34       /* of the step */
#define STATUS_HELD 35       /* bodies, of the step */
#define STATUS_NEIGHBOURS 36 /* ints wanted in Neighbours */
#define STATUS_NODES 37      /* nodes wanted */
#define STATUS_PLACED 38     /* slots that have got their place */
#define STATUS_MOVERS 39     /* slots in Movers */
#define STATUS_EXTRA 40      /* ints wanted in Extra */
#define STATUS_THRONGS 43    /* of THRONG ints that were wanted at once in Neighbours */
#define THRONG 1024
#define THRONGS_MOST (1 << 20) /* more are not counted in NEIGHBOURS, which would overflow: there is no room for them */
#define NODES_MOST (1 << 29)   /* likewise */
#define STATUS_TOUCHING 41     /* slots with contacts */
#define STATUS_RULED 42        /* of the step's hits */
#define STATUS_KEPT 44 /* hits wanted in Hits since the host asked; above the room the step begins again, and none begins until the host made room */
#define STATUS_KEPT_BEFORE 45 /* of these, when the last step was done: those behind are of one that is under way, or began again */
#define STATUS_FOURS 47       /* fours of points wanted in Contacts since the lists were made */
#define STATUS_LOST 46        /* since the host asked: events of bodies in clusters that were given up, or done again */
/* What nobody changes but the host. */
#define STATUS_KEPT_ROOM 48  /* hits there are room for in Hits; 0: none are kept */
#define STATUS_CAPACITY 49   /* slots that there may be: so many heads Extra has before its first node */
#define STATUS_SLICES 50     /* of a step */
#define STATUS_FOURS_ROOM 59 /* fours there are in Contacts */
/* Of these: */
#define STATUS_SLICE 51    /* the one that clusters are run in, 0 for the first */
#define STATUS_SAVED 52    /* numbers that had been given when it began, if it is a later one; 0 in the first */
#define STATUS_ANSWERED 53 /* hits of the steps done since the host asked */

/* Rules of events, for what would be hits without end. Rapid hits, less than RAPID of a step after the body's event before,
 * are elastic once the body had RAPID_MOST of them in the step (the TC model, late), unless what pushes the bodies together has made them faster than in a step.
 * Bodies that are pushed together, and meet more slowly than MICRO of what the push makes of their speed in a step, part with that speed
 * (microcollisions). So do bodies in a crowd, pushed together or not: beyond CROWD events that one of them had in the step, this speed grows by CROWD_PART
 * with each, up to CROWD_MOST of what the stronger push makes of a speed in a step; and by the
 * stillness, doubled after each CROWD_DOUBLING events up to CROWD_DOUBLINGS times, for what turning bodies press together. A body that is in more than HOLD_LIMIT events of one step is held until its end;
 * so is one that is stuck where there is no room to part: of which STUCK_MOST events, one after the other, were rapid and lossy hits, slower than what the stronger push makes of a speed in a step.
 * Unless it was in a hit that was not slow, it is no faster then than when the step began: what holds it may not make it faster from step to step.
 * Where forces bear what rests, the next step's impulses stop what a crowd does: there it is one from CROWD_BORNE events on, and parts sooner and faster, slow is
 * what they stop, and STUCK_BORNE events are enough. But of a push no more counts than CROWD_BORNE_WEIGHTS of what gravity makes, or than the approach: forces grow with what they hold back,
 * and with it what a crowd would get from them.
 *
 * There what would be elastic is a shock instead, under gravity: the hit passes on at once to what is nearer than what gravity makes in a step (or CONTACT_NEAR of the smaller radius),
 * by impulses at the points that approach, without a bounce, until each parts with SHOCK_PARTING of the speed that gravity makes in the rest of the step, within SHOCK_WITHIN of that,
 * or for SHOCK_SWEEPS sweeps over all points, each of which goes SHOCK_FARTHER times as far as would bring it alone there; it gets to SHOCK_PARTIES bodies. What rubs may gain by going so far: where all have more energy in the end
 * than it takes to part, by SHOCK_GAIN of what they had, it goes on once more, as far as would bring each point alone there.
 *
 * A hit of what is joined is a tug, if it is no shock: the hit goes on to all that is joined, until no rate is farther from what it is to be than TUG_WITHIN of what the hit changed,
 * or for TUG_SWEEPS. Joints go TUG_FARTHER times as far as would bring each alone there: what a hit does then gets through a row of many in as many sweeps, not their square. Where joints that bring their anchors somewhere would give more than a TUG_GAIN of what the hit does, it goes on once more, as if no anchor were to move against another; and where all have more energy in the end by that much it acts on the two alone. Joints that bring their anchors farther than TUG_LOOSE of both radii
 * in the step hold nothing, nor do those whose anchors part by so much more, or less, a step than their force would have it. */
#define RAPID 0.0009765625f
#define RAPID_MOST 8
#define MICRO 0.03125f
#define CROWD 32
#define CROWD_PART 0.0078125f
#define CROWD_MOST 0.25f
#define CROWD_BORNE 8
#define CROWD_BORNE_PART 0.125f
#define CROWD_BORNE_MOST 1.0f
#define CROWD_BORNE_WEIGHTS 2.0f
#define CROWD_DOUBLING 8
#define CROWD_DOUBLINGS 10
#define SHOCK_PARTIES 64
#define SHOCK_SWEEPS 32
#define SHOCK_FARTHER 1.6f
#define SHOCK_GAIN 0.00000095367431640625f
#define TUG_SWEEPS 256
#define TUG_FARTHER 1.75f
#define TUG_GAIN 0.015625f
#define TUG_WITHIN 0.0000152587890625f
#define TUG_LOOSE 0.125f
#define SHOCK_PARTING 0.5f
#define SHOCK_WITHIN 0.5f
#define HOLD_LIMIT 4096
#define STUCK_MOST 1024
#define STUCK_BORNE 32
#define STUCK_FAST 65536

/* Rules of contacts. Two bodies, of which one is pushed, are in contact where their gap is not larger than what the stronger push makes in a step, |a|,
 * or a CONTACT_NEAR of the smaller radius if that is less, at the points that approach more slowly than CONTACT_FAST |a|. Impulses stop what would come nearer in the step than to half a cushion: CUSHION slops, or
 * |a| / 2 if that is less. Then forces let them come nearer by EASE of the gap in a step, down to a cushion. Both are found within a CONTACT_PART of
 * EASE of a cushion, or by CONTACT_ITERATIONS iterations; forces that need more than one within a CONTACT_CLOSER of that, so that the next step needs none.
 *
 * Where bodies rub, the bound of a force of friction follows what the normal force allows at once in the first GRIP_FOLLOW iterations, and then by a
 * GRIP_BLEND of what is missing: in many iterations the two would drive each other on, and so would friction that has more momentum than GRIP_MOMENTUM. What does not slide may
 * creep by GRIP_CREEP of what normal forces are found within: little is left of that when coordinates are rounded; what slides is slowed within a
 * GRIP_SLIDE of it; each GRIP_PATIENCE iterations this may be twice as much: what moves on needs no more, and what lies still comes to it in a few steps.
 * Where bodies rub and slide impulses come to no end: GRIP_IMPULSES iterations do, for what those leave is a hit. In the first iteration twice as much counts,
 * GRIP_BEGUN: so a step may need no more, and then its forces are those of the next one, too.
 *
 * A body that rubs at all points, two at least, comes to rest where it touches what is at rest, moves in a step by less than STILL_SPEED of what forces are found within, and gets no
 * faster but by less than STILL_PUSH of that. One at rest stays where its forces leave less than STILL_PUSH. One that does not slide, of an island that stands firm,
 * loses STILL_BRAKE of its velocities while it moves by less than STILL_SLOW of that and gets no faster: else a column trembles on within what forces are found within.
 * Velocities below STILL_LEAST of what touches anything, or is damped, are none: some devices take for 0 what is less still, and others are slow with it. */
#define STILL_SPEED 0.125f
#define STILL_SLOW 4.0f
#define STILL_BRAKE 0.5f
#define STILL_PUSH 0.015625f
#define STILL_LEAST 1e-18f /* m/s, rad/s */
#define GRIP_BEGUN 2.0f
#define GRIP_FOLLOW 16
#define GRIP_BLEND 0.0625f
#define GRIP_MOMENTUM 0.9375f
#define GRIP_CREEP 0.0078125f
#define GRIP_SLIDE 0.25f
#define GRIP_PATIENCE 16
#define GRIP_IMPULSES 64
#define CONTACT_NEAR 0.25f /* of the smaller body's radius: farther is not near, however long a step is */
#define CONTACT_FAST 4.0f
#define EASE 0.5f
#define CUSHION 64.0f
#define CONTACT_PART 0.75f
#define CONTACT_CLOSER 0.75f
#define CONTACT_ITERATIONS 256

/* Joints. Impulses leave the anchors no speed against each other, within a JOINT_PART of a slop in a step; forces bring them to where they belong by the end of the step, by no more than JOINT_MOST
 * of both radii, along ways that are right in the middle of the step, so that they take no energy and give none; it is looked where that is before the iterations of
 * JOINT_AIMED, and a body is taken to turn by no more than JOINT_TURN. A step is too long for that where what a force makes turn in it, by its arm's growth, is more than JOINT_STIFF, and might grow from
 * step to step, or where anchors are farther from where they belong than JOINT_FAR of both radii: there forces take the speed along the ways at the step's end, as impulses do, and bring
 * anchors by EASE of the way. Where anchors, or angles that are fixed, are JOINT_ASTRAY times what they are found within from where they belong, forces begin with none: the last ones were not
 * right, and iterations that come to no end would add to them from step to step. So does all of an island whose impulses came to no end, and there, too, forces take the speed along the ways at the step's end: what
 * they don't find then is lost, and never given. But where joints are tense they bear what they do by the last forces alone, and go on with those. What last forces pull at a body's levers holds its angle, like a spring: where that makes it turn by more than JOINT_STIFF
 * times as far as it is from there, in a step, forces turn it less, as if they knew where it will be. A tension holds likewise where its ends are across it: of what has a length that is a point
 * more, which holds aside as if it knew how far forces take them. What pushes one way has reached its bound within JOINT_REACHED times what it is found within; if it was beyond it as a step began, and is brought
 * there by a force of more than JOINT_BROUGHT times the one before, impulses of the next step take back what that made of a speed. */
#define JOINT_PART 0.25f
#define JOINT_REACHED 4.0f
#define JOINT_BROUGHT 2.0f
#define JOINT_ASTRAY 16.0f
#define JOINT_IMPULSES 128 /* iterations, in place of GRIP_IMPULSES, of bodies that rub and are joined: what those leave is no hit */
#define JOINT_MOST 1.0f
#define JOINT_AIMED 0x10117 /* bits: 0, 1, 2, 4, 8, 16 */
#define JOINT_TURN 1.0f     /* rad */
#define JOINT_FAR 0.01f
#define JOINT_STIFF 1.5f
#define JOINT_SHORTEST 0.015625f /* of a whole step, as long joints take a shorter one to be */
#define JOINT_LEAST 1e-30f       /* N or N m, what is less is none: what fades would come where not all devices count */
#define SPRING_STIFF \
	2.0f /* what a spring does against a way, by how much its force parts the anchors: above, a step is too long to swing, and it acts as at the step's end */
#define SPRING_LEAST 1e-30f /* kg, that a spring, or what holds aside, is taken to answer with, so that it can be divided by, */
#define SPRING_MOST 1e20f   /* and its stiffness and damping, each, so that it can be multiplied by */

/* ---- Rendering [3] */

/* Stream: what is sent to place each vertex, in the order in which bodies are drawn; one texel a vertex. Depends on the
 * alternative: option1 (body, ordinal), option2 (first texel in Vertices, ordinal), option3 the local coordinates. */
#define STREAM_X 0
#define STREAM_Y 1
#define STREAM_BODY 2 /* the uniform that options 2 and 3 need beside: whose transform it is */

/* Transforms: sent where the transform is not read from the state; one texel a body */
#define TRANSFORMS_X 0 /* m */
#define TRANSFORMS_Y 1
#define TRANSFORMS_ANGLE 2 /* rad */

/* View: from the world to pixels, y down; four texels in a row */
#define VIEW_WIDTH 4
#define VIEW_ORIGIN 0 /* texel: of the upper left corner, m, sums of two floats */
#define ORIGIN_LEFT 0
#define ORIGIN_LEFT_LOW 1
#define ORIGIN_TOP 2
#define ORIGIN_TOP_LOW 3
#define VIEW_SCALE 1   /* texel */
#define SCALE_PIXELS 0 /* a metre */
#define SCALE_LINE 1   /* pixels: the breadth of thin lines */
#define SCALE_WIDTH 2  /* pixels: of the picture */
#define SCALE_HEIGHT 3
#define VIEW_CLIP 2 /* texel: a box of pixels, as those below */
#define BOX_X0 0
#define BOX_Y0 1
#define BOX_X1 2 /* the first pixel outside */
#define BOX_Y1 3
#define VIEW_FIRST 3  /* texel */
#define FIRST_SHAPE 0 /* where this view's shapes and edges begin */
#define FIRST_EDGE 1
#define FIRST_LINES 2 /* 1: each circle has a second shape, its radius line; 0: none is large enough */

/* Placed: one texel a vertex, in the stream's order; pixels, y down */
#define PLACED_X 0 /* from the body's centre */
#define PLACED_Y 1
#define PLACED_CENTER_X 2
#define PLACED_CENTER_Y 3

/* Draws: what the host knows of a body to draw; two texels a body, in the order in which they are drawn */
#define DRAWS_WIDTH 2
#define DRAW_PARTS 0   /* texel */
#define PARTS_VERTEX 0 /* the first in Stream and Placed */
#define PARTS_COUNT 1  /* of vertices; below 0: so many of a polygon that is not convex */
#define PARTS_EDGE 2   /* the first in Edges: a polygon has all but one there at most, or SIDE_WIDTH a side, a circle LINE_REST of its radius line */
#define PARTS_SHAPE 3  /* a polygon has one, a circle one or two */
#define DRAW_INK 1     /* texel, the channels of SHAPE_INK */

/* Marks: what is drawn below the bodies: boxes of whole pixels, and lines; two texels a mark */
#define MARKS_WIDTH 2
#define MARK_PLACE 0 /* texel: a box, or the ends of a line (x, y, x, y) */
#define MARK_STYLE 1 /* texel */
#define STYLE_COLOR 0
#define STYLE_BREADTH 1 /* pixels, of a line; 0: a box */

/* Boxes: a record a shape, in painter's order: the pixels that it may touch; none: it is not seen, and Shapes has nothing of it */

/* Shapes: four records a shape, which are a line of a cache; so many bodies a work-item are found together on a CPU */
#define SHAPES_WIDTH 4
#define SHAPES_TOGETHER 4
#define SHAPE_BOX 0 /* record: as in Boxes */
#define SHAPE_INK 1 /* record */
#define INK_FILL 0  /* 0xRRGGBB as a number */
#define INK_OUTLINE 1
#define INK_WIDTH 2   /* pixels, of the outline */
#define INK_OPACITY 3 /* 0..1 */
#define SHAPE_EDGES 2 /* record */
#define EDGES_REST 0  /* the second edge in Edges, and those after it */
#define EDGES_COUNT 1 /* 0: the whole box; below 0: so many sides of an outline, all in Edges */
#define SHAPE_EDGE 3  /* record: the first edge; of an outline what is added to the distance from it, as EDGE_AT */
#define LINE_EDGES 4  /* of a line */
#define LINE_REST 3   /* those of them that are in Edges */

/* Edges: a record each, a half plane, or with a bend > 0 a disc of radius 1 / (2 bend): inside is where
 * at + x slope_x + y slope_y + (x^2 + y^2) bend < 0, with x and y from the centre of the box's first pixel */
#define EDGE_SLOPE_X 0
#define EDGE_SLOPE_Y 1
#define EDGE_AT 2
#define EDGE_BEND 3
/* The outline of a polygon that is not convex: two records a side */
#define SIDE_WIDTH 2
#define SIDE_LINE 0 /* record: the half plane that it bounds, an edge */
#define SIDE_ENDS 1 /* record: from the centre of the box's first pixel */
#define ENDS_FROM_X 0
#define ENDS_FROM_Y 1
#define ENDS_TO_X 2
#define ENDS_TO_Y 3

/* Frame: the part of the picture that is drawn at once; two texels in a row */
#define FRAME_WIDTH 2
#define FRAME_BOX 0   /* texel */
#define FRAME_TILES 1 /* texel */
#define TILES_COLUMNS 0
#define TILES_ROWS 1
#define TILES_GROUND 2 /* colour, 0xRRGGBB as a number */
#define TILES_PASS 3   /* bits: a picture of more shapes than there is room for at once is drawn in passes, one over the other */
#define PASS_OVER 1    /* not the first: it begins with Light */
#define PASS_UNDER 2   /* not the last: it leaves Light, and no picture */

/* Light: of a pass, a record a pixel of the frame, row by row: squares of colours */
#define LIGHT_RED 0
#define LIGHT_GREEN 1
#define LIGHT_BLUE 2

/* Lists of whole numbers: shapes sorted by rows of tiles of pixels, then by tile */
#define PIXEL_TILE 16 /* of kernels: each is a work-item's */
#define BIN_CHUNK 256 /* shapes that a work-item sorts */

/* How a picture looks */
#define SEEN 1e15f          /* pixels: squares of what is farther away would not fit in a float */
#define FARTHEST 1000000    /* pixels: beyond any picture, and far from an int's end */
#define LEAST_OPACITY 0.15f /* of a dot far smaller than a pixel: it still shows on the ground */
#define LINE_OPACITY 0.75f  /* at least, of a line however thin: of a body of five pixels or more */
#define SHOW_ANGLE 4.0f     /* pixels of radius: a circle that is smaller has no room for its radius line */
#define NO_EDGE -1e30f      /* the distance to a side that was lost in rounding */
#define DISC_AREA 3.14159265f

/* Numerical rules */
#define SLOP 9.5367431640625e-7f /* 2^-20: bodies this far apart touch, as a part of the coordinates' size: eight units in the last place */
#define SUNK_MOST 16.0f          /* slops: what overlaps by more than one and less than so many, rounding has sunk; that is a hit unless it parts */
#define SUNK_RATE 0.125f         /* slops a step, a unit in the last place, or faster */
#define STILL 1e-24f             /* m a step: and so much slower is none anyway, for of less than a float's least number no impulse can be made */
#define APPROACH 9.5367431640625e-7f /* 2^-20: a slower approach, as a part of the speeds, is lost in rounding and is none */
#define SEARCH_LIMIT 64              /* steps of one search for a hit; what is not found by then pauses */
#define MARGIN \
	0.5f /* slops: a search goes on to where so much is left; from a contact that does not approach, to where the bodies overlap by so much */
/* A proof that two polygons stay apart asks for a gap that is so large, as a part of how far they move against each other in the time, of how far that bends, and in slops, that their search would
 * take less than SEARCH_LIMIT steps: 1 / APART_RATE + 1 / sqrt(2 APART_BEND) at most, and a fifteenth more for MARGIN, which are 42. */
#define APART_RATE 0.03125f
#define APART_BEND 0.01f
#define APART_SLOPS 8.0f
#define APART_ANGLE 1000.0f /* larger ones are not turned exactly enough */
#define FORESIGHT 0.3f      /* of their radii: polygons that move by more, one seen from the other, are likely to get together */
/* From a contact that does not approach a search goes on for the time in which bodies move by the slop, at most CREEP_MOST (2^-12 of a step); from the next
 * for twice as long while that is below CREEP_SHORT (2^-20). */
#define CREEP_MOST 0.000244140625f
#define CREEP_SHORT 9.5367431640625e-7f
#define STALL_LENGTH 9.5367431640625e-7f /* 2^-20 of the time step: a step that lasts less did not get on */
#define STALL_LIMIT 4096                 /* of those in a row, and 16 a body, are a stall */
#define STALL_LIMIT_BODY 16
#define CORNER_ALIKE 0.9f              /* of two unit vectors: they are no two ways out of a corner */
#define CORNER_DEEP 2.0f               /* slops: so deep bodies touch along a way out of a corner, for what rests is sunk by one now and then */
#define CORNER_NEAR 4.0f               /* times that: a contact so near a face's end is at a corner */
#define PIECES_TOUCH 2.0f              /* slops: pieces this near touch, where bodies of which they are a part have hit each other */
#define PIECES_ALIKE 0.9999f           /* the cosine of an angle: along normals that differ by less pieces are hit together */
#define PAIR_RESTS 4                   /* normals along which two bodies press, that are told from each other */
#define CORNER_PART 0.5f               /* of an approach: along another way it is slower than that */
#define SINGULAR 2.384185791015625e-7f /* 2^-22: two contacts nearer to one another than this, by the determinant, count as one */

/* Sine and cosine: pi/2 in three parts, and minimax polynomials on [-pi/4, pi/4] (Cephes) */
#define LARGEST_TURN 1073741824.0f /* 2^30: a larger number of quarter turns has no fraction left, and counts as 0 */
#define ANGLE_MOST 3.1416f         /* rad: half a turn, and what rounding makes it longer */
#define TWO_OVER_PI 0.636619772367581343f
#define HALF_PI_1 1.5703125f
#define HALF_PI_2 4.837512969970703125e-4f
#define HALF_PI_3 7.54978995489188216e-8f
#define SINE_3 -1.6666654611e-1f
#define SINE_5 8.3321608736e-3f
#define SINE_7 -1.9515295891e-4f
#define COSINE_4 4.166664568298827e-2f
#define COSINE_6 -1.388731625493765e-3f
#define COSINE_8 2.443315711809948e-5f

#endif
