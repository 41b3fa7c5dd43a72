/* The slots of the pipeline and their kernels: which textures each reads and writes, in the order of its arguments. What
 * they compute, to the order of the operations, is in kernels/CONTRACT.md. */
#ifndef CAROM_STAGE_H
#define CAROM_STAGE_H

#include "carom.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The textures by what they are for. Those that a kernel both reads and writes are pairs, a front and a back. */
typedef enum carom_role {
	ROLE_LINEAR,     /* pair; one texel a body, as the next four */
	ROLE_ROTATIONAL, /* pair */
	ROLE_GEOMETRY,
	ROLE_FORCES,
	ROLE_FRICTION,
	ROLE_FILTERS,        /* list, FILTER_WIDTH a body behind its head, and bodies behind those; of the head alone where all meet all */
	ROLE_VERTICES,       /* one texel two vertices */
	ROLE_UNIFORMS,       /* UNIFORMS_WIDTH x 1 */
	ROLE_CLOCK,          /* pair, CLOCK_WIDTH x 1 */
	ROLE_AABB,           /* one texel a body */
	ROLE_TILES,          /* pair of bytes, N / TILE x N / TILE */
	ROLE_OVERLAP,        /* pair of bytes, N / OVERLAP_COLUMNS x N */
	ROLE_OVERLAP_BEFORE, /* the back of Overlap, to read */
	ROLE_HIT_TIMES,      /* N x N; a pair where toi takes several passes */
	ROLE_TILE_HITS,      /* N / TILE x N / TILE */
	ROLE_WALLS,          /* one texel WALLS_GROUP bodies */
	ROLE_REDUCED,        /* pair: the level before and the level to make */
	ROLE_IMPULSE,        /* IMPULSE_WIDTH x 1 */
	/* of the step events: records and lists, which a kernel may change in place wherever they stand */
	ROLE_OUTLINES,   /* records, one a vertex of polygons */
	ROLE_SLOTS,      /* pair of records, SLOT_WIDTH a slot: a slot is a body, sorted by place */
	ROLE_NEED,       /* pair of lists, float bits: m, how far from its place a body needs to get */
	ROLE_CHANGES,    /* records, CHANGES_WIDTH a body that is changed or picked, ADDED_WIDTH one that is added, 1 one that is removed */
	ROLE_REACH,      /* records, one a slot */
	ROLE_WORK,       /* records, WORK_WIDTH a slot */
	ROLE_MEMBERS,    /* list, MEMBER_WIDTH a slot */
	ROLE_PLACES,     /* list, one a body: its slot */
	ROLE_OWNERS,     /* list, one a slot */
	ROLE_PARENTS,    /* the same */
	ROLE_ACTIVE,     /* list: the slots of bodies in clusters */
	ROLE_SPANS,      /* list, SPAN_WIDTH a slot */
	ROLE_NEIGHBOURS, /* list: slots */
	ROLE_NODES,      /* list, NODE_WIDTH a node */
	ROLE_EXTRA,      /* list, one a slot, and NODE_WIDTH a node */
	ROLE_MOVERS,     /* list: slots */
	ROLE_WAKE,       /* list, WAKE_WIDTH a slot */
	ROLE_CELLS,      /* list, CELL_WIDTH a cell */
	ROLE_STATUS,     /* list, STATUS_WIDTH */
	ROLE_HITS,       /* records, HITS_WIDTH a hit; one alone where none are kept */
	/* of the step contacts, likewise */
	ROLE_GRIPS,      /* records, GRIP_WIDTH a four of points; of one alone where nothing rubs */
	ROLE_CONTACTS,   /* records, FOUR_WIDTH a four of points; of one alone by events */
	ROLE_TOUCHING,   /* list, TOUCHING_WIDTH a slot; of one int by events */
	ROLE_ISLANDS,    /* list, one a slot */
	ROLE_SHOCKS,     /* records, SHOCK_RECORDS a number; one alone by events; the CPU keeps its own */
	ROLE_LOADS,      /* records, LOADS_LISTS a slot */
	ROLE_PUSHES,     /* records, PUSHES_WIDTH a slot */
	ROLE_WARM,       /* records, one a contact of a body, or two where something rubs: part of the state */
	ROLE_WARM_SPANS, /* list, WARM_SPAN_WIDTH a body, and before them as many for all */
	ROLE_JOINTS,     /* records, JOINT_WIDTH a joint: their forces are part of the state */
	ROLE_JOINED,     /* list, of bodies and of joints: see JOINED_COUNT; of its head alone where there are no joints */
	/* of pictures, made when the first is drawn; lists are those of ints */
	ROLE_STREAM,      /* one texel a vertex */
	ROLE_TRANSFORMS,  /* one texel a body */
	ROLE_VIEW,        /* VIEW_WIDTH x 1 */
	ROLE_PLACED,      /* one texel a vertex */
	ROLE_DRAWS,       /* DRAWS_WIDTH texels a body */
	ROLE_MARKS,       /* MARKS_WIDTH texels a mark */
	ROLE_BOXES,       /* one record a shape */
	ROLE_SHAPES,      /* SHAPES_WIDTH records a shape */
	ROLE_EDGES,       /* one record an edge, but for the first of each shape */
	ROLE_FRAME,       /* FRAME_WIDTH x 1 */
	ROLE_BIN_COUNTS,  /* list: two of each chunk and row of tiles */
	ROLE_BIN_OFFSETS, /* list: the same */
	ROLE_BIN_TOTALS,  /* list: two of each row of tiles */
	ROLE_ROW_LIST,    /* list: the shapes of each row of tiles, two ints each */
	ROLE_TILE_ENDS,   /* list: columns + 1 of each row of tiles */
	ROLE_TILE_LIST,   /* list: the shapes of each tile */
	ROLE_LIGHT,       /* records, one a pixel; one alone where a single pass draws all */
	ROLE_PICTURE,     /* bytes, a texel a pixel */
	ROLE_COUNT
} carom_role;

typedef enum carom_stage {
	STAGE_AABB,         /* domain: (bodies) */
	STAGE_OVERLAP,      /* (tile columns, groups of OVERLAP_GROUP tile rows, bodies) */
	STAGE_TOI_FIRST,    /* (tile columns, tile rows, bodies) */
	STAGE_TOI_NEXT,     /* the same; only some alternatives have it */
	STAGE_WALLS,        /* (groups, 1, bodies) */
	STAGE_REDUCE,       /* (m, m, pass): from HitTimes on */
	STAGE_REDUCE_TILES, /* (m, m, live size of the source): from TileHits on; an alternative has either this or STAGE_REDUCE */
	STAGE_FIRST,        /* (1, 1, bodies, groups; 0 groups where there is no room) */
	STAGE_IMPULSE,      /* (1) */
	STAGE_NO_COLLISION, /* (bodies) */
	STAGE_COLLISION,    /* (bodies) */
	/* the step events; "share": work-items that share what is active, `round` being the number of the round */
	STAGE_LOAD,    /* (slots): the state into slots */
	STAGE_CHANGE,  /* (changed bodies, 1, room in Movers): what the host has changed, into slots */
	STAGE_ADD,     /* (added bodies, 1, room in Movers, the first of them): behind the others */
	STAGE_REMOVE,  /* (one group, 1, removed bodies, room in Movers): and the others get their new indices */
	STAGE_PUSH,    /* (slots, 1, room in Movers): gravity into slots, once it is another one, or the time step */
	STAGE_DRIVE,   /* (joints): motors that the host has changed, by Changes, into Joints */
	STAGE_PICK,    /* (bodies, 1, the first of them): their states into Changes */
	STAGE_PACE,    /* (one group, 1, slots, tenths of a radius that all get at least) */
	STAGE_REACH,   /* (slots, 1, cells a row, rows) */
	STAGE_CELLS,   /* (one group, rows of all levels, cells a row, rows) */
	STAGE_SORT,    /* (slots) */
	STAGE_NEAR,    /* (slots, 1, cells a row, rows) */
	STAGE_GATHER,  /* (slots) */
	STAGE_MEND,    /* (groups, 1, cells a row, rows) */
	STAGE_SEEK,    /* (slots, or one for SEEK_EACH of them, 1, round, slots) */
	STAGE_RELEASE, /* (share, 1, round) */
	STAGE_PAIR,    /* the same */
	STAGE_MUSTER,  /* the same */
	STAGE_RESOLVE, /* (groups, 1, round, lanes of a team) */
	STAGE_CHECK,   /* (share, 1, round) */
	STAGE_SETTLE,  /* (1, 1, round, slots) */
	STAGE_DRIFT,   /* (slots, 1, room in Movers) */
	STAGE_UNLOAD,  /* (slots): the slots into the state */
	/* the step contacts; iterations are numbered like rounds */
	STAGE_CONTACTS_BEGIN,   /* (1, 1, first iteration, last) */
	STAGE_CONTACTS_FIND,    /* (slots, 1, first iteration, 0: of those that are awake; 1: of those that they wake) */
	STAGE_CONTACTS_JOIN,    /* (share, 1, first iteration) */
	STAGE_CONTACTS_ITERATE, /* (share, 1, iteration) */
	STAGE_CONTACTS_APPLY,   /* (share, 1, room in Movers, last iteration) */
	STAGE_CONTACTS_RELEASE, /* (share, 1, room in Movers, 0: after a step; 1: before one begins again) */
	STAGE_SLEEP_BEGIN,      /* (slots, 1, room in Movers, SLEEP_...) */
	STAGE_SLEEP_END,        /* (changed bodies, 1): before STAGE_CHANGE */
	/* rendering [3] */
	STAGE_VERTICES,  /* (vertices) */
	STAGE_SHAPES,    /* (marks + bodies, 1, marks) */
	STAGE_BIN_COUNT, /* (groups: chunks, 1, shapes) */
	STAGE_BIN_SUM,   /* (groups: rows of tiles, 1, chunks) */
	STAGE_BIN_ROWS,  /* (groups: chunks, 1, shapes, room in the list) */
	STAGE_BIN_TILES, /* (groups: rows of tiles, 1, room in the rows' list, room in the tiles') */
	STAGE_PIXELS,    /* (tile columns, rows of tiles, room in the tiles' list): a tile of pixels */
	STAGE_COUNT
} carom_stage;

#define CAROM_MAX_TEXTURES 24

typedef struct carom_stage_def {
	const char *slot;
	const char *alternative; /* NULL: the pipeline chooses */
	const char *kernel;      /* its name in OpenCL C */
	int input_count, output_count;
	carom_role textures[CAROM_MAX_TEXTURES]; /* inputs (fronts), then outputs (backs) */
} carom_stage_def;

extern const carom_stage_def carom_stages[STAGE_COUNT];

/* Whose program a slot is part of: drivers for GPUs build for long, so that each has only what it runs. */
typedef enum carom_usage {
	USED_ALL, /* by all steps */
	USED_FIRST_IMPACT,
	USED_EVENTS, /* and contacts */
	USED_CONTACTS,
	USED_PICTURES,
} carom_usage;

/* All slots in the order in which a step runs them, with the field of carom_pipeline that chooses, and their default. */
typedef struct carom_slot {
	const char *name;
	size_t field; /* offset in carom_pipeline; SIZE_MAX where nothing is to choose */
	const char *standard;
	carom_usage usage;
} carom_slot;

extern const carom_slot carom_slots[];
extern const size_t carom_slot_count;

/* Does domain[0] count groups of work-items? How large they are is the device's choice. Of all other stages it counts items, of which a work-item does one, or a few. */
bool carom_stage_runs_groups(carom_stage stage);
/* Is the stage one of rendering? Those of a device are made ready when the first is run. */
bool carom_stage_draws(carom_stage stage);
bool carom_slot_draws(const char *name);

/* Fills in the defaults and checks every name. */
carom_status carom_pipeline_resolve(const carom_pipeline *pipeline, carom_pipeline *resolved, carom_error *error);

#ifdef __cplusplus
}
#endif
#endif
