/* A world: the bodies as the host knows them, and the textures of the device. */
#ifndef CAROM_WORLD_H
#define CAROM_WORLD_H

#include "carom.h"
#include "definition.h"
#include "device.h"
#include "pieces.h"
#include "step/step.h"

/* What a step is another one for, if a body has it. */
typedef enum carom_trait {
	TRAIT_RUBS = 1,  /* friction, or rolling friction */
	TRAIT_DAMPS = 2, /* damping */
} carom_trait;

/* A body as it is kept: what carom_body_info tells, with offsets instead of pointers. */
typedef struct carom_body {
	uint8_t shape;                        /* carom_shape */
	bool is_static : 1, is_kinematic : 1; /* one of them, or none */
	bool is_convex : 1;
	uint8_t vertex_count;    /* 1 for a circle */
	uint8_t hull_count;      /* vertices of the convex hull, but for those within a side: where there are none else, all */
	uint8_t piece_count;     /* 0 for one that is convex, and so are */
	uint16_t piece_vertices; /* those of all pieces */
	uint32_t vertex_first;   /* in world->vertices, an even number; a circle has none there */
	float radius;            /* as given; 0 for a polygon */
	float bound;             /* of the circle about the centre of mass */
	float mass, inertia, density, restitution, friction, rolling_friction, linear_damping, angular_damping, torque;
	carom_vec2 force, recentred_by;
	uint32_t color, categories, mask;
	uint32_t change; /* number + 1 in world->changes, 0 for none */
	uint32_t name;   /* offset + 1 in world->names, 0 for none */
} carom_body;

/* A body that the device goes on with, as soon as it is told. */
typedef struct carom_change {
	uint32_t body;
	bool moves;                     /* to this state; else its force and torque alone are others */
	float linear[4], rotational[4]; /* as in the textures */
} carom_change;

/* Of finite mass, so that hits and forces change how it moves. */
static inline bool carom_is_dynamic(const carom_body *body)
{
	return !body->is_static && !body->is_kinematic;
}

/* A growing array of bytes. */
typedef struct carom_array {
	void *items;
	size_t used, room; /* bytes */
} carom_array;

/* Where `size` more bytes go; NULL if there is no memory, or may be where they are none. */
void *carom_array_grow(carom_array *array, size_t size);
/* For qsort of uint32_t. */
int carom_compare_indices(const void *left, const void *right);

/* Front and back; the same texture twice where there is only one. */
typedef struct carom_pair {
	carom_texture *front, *back;
} carom_pair;

#define CAROM_MAX_LEVELS 16
#define CAROM_NOTES 256 /* polygons that others are compared with */

/* Where one of them has its vertices, and its pieces; count 0: it is none. */
typedef struct carom_note {
	uint32_t first;
	uint16_t piece_vertices;
	uint8_t count, hull_count, piece_count;
} carom_note;

/* What the step events has on the device, and how it is driven: none of it changes a result. */
typedef struct carom_events {
	uint32_t room, node_room; /* ints of Neighbours, nodes of Nodes */
	uint32_t hit_room;        /* hits of Hits; 0: none are kept */
	uint32_t fours_room;      /* fours of points in Contacts */
	uint32_t warm_room;       /* contacts in Warm */
	uint32_t joint_room;      /* joints in Joints */
	uint32_t hits_taken;      /* of those in Hits, which has some of a step that is under way */
	uint32_t columns, rows;   /* of cells */
	uint32_t steps_a_list;    /* steps handed over between two makings of the lists */
	uint32_t rounds;          /* handed over a step */
	uint32_t slices;          /* of a step, */
	bool saves;               /* and Work and Members have room for the state in which one begins */
	uint32_t iterations;      /* handed over a pass of the step contacts */
	uint32_t since;           /* steps handed over since the last making, */
	float list_step;          /* s: the time step that the world had then */
	bool looks_ahead;         /* most bodies do not look for hits in each step */
	uint32_t good;            /* makings since one died before its time */
	int32_t round, iteration; /* numbers of the last ones handed over */
	bool in_batch;            /* where one begins: the one before broke off, and left the lists as they were */
	bool within;              /* the last one ended within a step: of clusters that are under way, or whose forces were being found */
	uint32_t change_room;     /* records of Changes */
	uint32_t known;           /* bodies that have slots; those behind them are to be told of */
	bool told;                /* since the last batch, of bodies that are elsewhere */
	size_t outlines;          /* bytes of world->vertices that Outlines has */
	uint32_t picks;           /* calls since the last batch that read bodies from their slots alone */
	uint32_t idle;            /* batches in a row that ended no step, */
	uint32_t stale;           /* and of these those that ended with lists that were too old, or too short */
	uint32_t doublings;       /* of how far the slowest bodies are taken to get, until such a step has come to its end */
} carom_events;

/* What there is on the device for pictures; all zero while none has been drawn. */
typedef struct carom_canvas {
	uint32_t room[ROLE_COUNT];                     /* texels or ints that a texture of rendering holds */
	uint32_t width, height;                        /* of Picture */
	size_t body_count;                             /* of the world when these were counted: */
	uint64_t all_vertices, all_sides, all_circles; /* of all bodies; what Edges has of polygons */
	float largest_circle;                          /* m, a radius */
	bool has_lines;                                /* circles have a shape more for their radius line */
	uint64_t first, end;                           /* of the bodies that Stream and Draws are of, in the order in which they are drawn */
	uint32_t bodies, vertices, edges, shapes;      /* that these have */
} carom_canvas;

/* Where a state of all bodies may be. */
typedef enum carom_place {
	PLACE_HOST = 1,     /* linear and rotational */
	PLACE_TEXTURES = 2, /* Linear and Rotational */
	PLACE_SLOTS = 4,    /* of the step events */
} carom_place;

/* What holds for all bodies, or is told of all together, where it has changed since the device was told. */
typedef enum carom_unsent {
	UNSENT_GRAVITY = 1,
	UNSENT_TIME_STEP = 2,
	UNSENT_DEF = UNSENT_GRAVITY | UNSENT_TIME_STEP,
	UNSENT_FILTERS = 4,
	UNSENT_INDICES = 8, /* which body has which friction and filter */
} carom_unsent;

/* What a body may be at the end of a step, or the most that any of some may be. */
typedef struct carom_range {
	double place, speed, spin; /* m, m/s, rad/s */
	double push;               /* m/s^2, or rad/s^2: by how much both may grow */
	double heaviest;           /* kg or kg m^2, of dynamic bodies */
	bool is_kept;              /* by the room, or it does not move */
	double time;               /* s: when that was so */
} carom_range;

struct carom_world {
	carom_world_def def;     /* as given, its pipeline too */
	carom_pipeline pipeline; /* resolved */
	char device_name[128];   /* what def.device points to */
	const carom_step *step;
	carom_device *device;

	carom_array bodies;   /* carom_body */
	carom_array vertices; /* carom_vec2, two a texel of Vertices: of polygons, an even number each; many of those that are equal share them */
	carom_note notes[CAROM_NOTES];
	carom_array names;
	carom_array linear, rotational; /* four floats a body */
	carom_array contacts;           /* carom_contact, in order */
	carom_array joints;             /* carom_joint */
	carom_array apart;              /* pairs of bodies that joints keep from hitting each other, sorted: the lower index times 2^32, and the higher */
	carom_array changes;            /* carom_change, of bodies that each has one alone */
	carom_array hits;               /* carom_hit: those of the last call, where they are kept */
	size_t body_count, circle_count;
	size_t waste;        /* bytes of vertices and names that may be of bodies that are gone alone */
	unsigned traits;     /* carom_trait: what some body has */
	unsigned newest;     /* carom_place: all that have the newest state, but for `changes` */
	bool bodies_current; /* the device's constant textures are those of the bodies */
	bool slots_current;  /* its slots are of the bodies as they are, but for what is to be told of; else they are to be loaded anew */
	unsigned unsent;     /* carom_unsent: what the device, as it goes on, is to be told beside `changes` */
	carom_array driven;  /* uint32_t: joints whose motor the device is to be told of */
	bool contacts_current, contacts_sent; /* the host has the device's contacts and joints' forces; the device has the host's contacts and joints */

	uint32_t capacity;         /* bodies the textures hold, a power of two; 0 while there are none */
	uint32_t vertex_capacity;  /* texels of Vertices, likewise, */
	uint32_t polygon_capacity; /* and those of them that are polygons' */
	uint32_t filter_room;      /* ints of Filters */
	uint32_t friction_room;    /* texels of Friction */
	carom_pair textures[ROLE_COUNT];
	carom_texture *levels[CAROM_MAX_LEVELS]; /* of the reduction */
	bool prepared;                           /* the step has its textures, too */
	carom_events events;
	carom_canvas canvas;
	float stalled;      /* steps in a row that did not get on */
	double time;        /* s */
	double begun;       /* s: when the clock was started */
	double good_for;    /* s: the time in which no body leaves what the floats can hold, */
	carom_range range;  /* of all of them, when that was looked at */
	double target;      /* s: where the clock was set to end; NAN for nowhere */
	float remaining[2]; /* s, until then, as the clock has it: a sum of two */
	uint64_t batch;     /* steps handed over at once */
	bool in_call;       /* of a step or an advance: what is called in it must leave the world as it is */
	carom_progress progress;
	void *progress_context;
};

/* Bodies that the device goes on with and is to be told of. */
static inline size_t carom_change_count(const carom_world *world)
{
	return world->changes.used / sizeof(carom_change);
}

/* bodies.c */
carom_status carom_body_make(const carom_body_def *def, const carom_world_def *world, size_t index, carom_body *body, carom_vec2 *vertices,
	carom_error *error);
carom_body *carom_world_bodies(const carom_world *world);
/* world.c: are there so many things from number `first` on? If not, the error says what `there_are`. And of bodies: */
carom_status carom_check_span(const char *things, size_t first, size_t count, const char *there_are, size_t known, carom_error *error);
carom_status carom_check_bodies(const carom_world *world, uint32_t first, size_t count, carom_error *error);
/* An angle within a turn, as kernels keep it. */
float carom_wrapped(float angle);
/* Which of carom_trait a body has. */
unsigned carom_traits_of(const carom_body *body);
/* Once something rubs, or nothing does any more, the step needs other textures: of bodies from that index on that are new, or of all from 0. */
void carom_look_for_traits(carom_world *world, size_t first);

/* outlines.c. Has the world room for the vertices of one body more? */
#define CAROM_MOST_VERTICES (6u << 22) /* with those of circles they take 2^24 texels at most, and so do the indices of these */
bool carom_outlines_have_room(const carom_world *world, const carom_body *body);
/* How many of world->vertices a body has. */
uint32_t carom_outline_size(const carom_body *body);
/* Where in world->vertices a polygon's hull begins: with the polygon itself, where it is that. */
uint32_t carom_outline_hull(const carom_body *body);
/* What it is put together of. */
void carom_outline_pieces(const carom_world *world, const carom_body *body, carom_pieces *pieces);
/* Texels of Vertices that polygons take; those of circles, in their order, follow. */
uint32_t carom_polygon_texels(const carom_world *world);
/* Keeps a polygon's vertices and pieces, and sets what the body knows of them; false if there is no memory. */
bool carom_outlines_add(carom_world *world, carom_body *body, const carom_vec2 *vertices);
/* Fills in Outlines. */
carom_status carom_outlines_send(carom_world *world, carom_error *error);
/* advance.c: refuses to change a world from its own progress callback */
carom_status carom_check_idle(const carom_world *world, carom_error *error);
/* range.c: CAROM_LIMIT where a step from here would leave the floats; else says how long none will, in good_for */
carom_status carom_check_range(carom_world *world, carom_error *error);
/* Is a step good without that, for all that is known? Changes that the device has not been told of are considered. */
bool carom_range_holds(carom_world *world);
/* tell.c: can the device go on with bodies that are changed, come or go, without being loaded anew? */
bool carom_goes_on(const carom_world *world);
/* It is told as it goes on; where it can't, it is loaded anew. */
void carom_tell_later(carom_world *world, carom_unsent what);
/* Of so many bodies, are these few? Where many are set, come or go it costs less to load all. */
bool carom_are_few(size_t count, size_t of);
/* Tells it of bodies that are changed or have come, */
carom_status carom_changes_send(carom_world *world, carom_error *error);
/* that others have come, from index `first` on, or gone, */
void carom_roster_changed(carom_world *world, size_t first);
/* and of some that go, in order, which the host still has. */
carom_status carom_removed_send(carom_world *world, const uint32_t *indices, uint32_t count, carom_error *error);
/* Room in Changes for so many records, and as many numbers for the host, to be given to free. */
carom_status carom_records_create(carom_world *world, uint32_t count, float **records, carom_error *error);
/* Hands them over, and lets go of the host's. */
carom_status carom_records_send(carom_world *world, uint32_t count, float *records, carom_error *error);
/* Nothing of bodies on the device is as it is now. */
void carom_load_anew(carom_world *world);
/* Can a body not be here, at this speed? */
bool carom_outside_room(const carom_world_def *def, carom_vec2 p, carom_vec2 v);

/* textures.c: texels of a texture of one texel an item, folded into rows */
uint32_t carom_row_width(uint32_t items);
uint32_t carom_row_count(uint32_t items);
uint32_t carom_capacity(size_t items); /* the power of two that holds them, at least TILE */
carom_status carom_textures_create(carom_world *world, carom_role role, bool pair, uint32_t width, uint32_t height, const float fill[4],
	carom_error *error);
/* One of bytes that lie at `texels`, where the device can wrap them. */
carom_status carom_textures_wrap(carom_world *world, carom_role role, uint32_t width, uint32_t height, void *texels, carom_error *error);
/* A level of the reduction, size x size. */
carom_status carom_levels_create(carom_world *world, int level, uint32_t size, const float fill[4], carom_error *error);
void carom_textures_destroy(carom_world *world);
void carom_textures_drop(carom_world *world, carom_role role);
/* Makes the device's textures of the state those of the host, creating them if they are too small or not there. */
carom_status carom_textures_hold(carom_world *world, carom_error *error);
/* The same, and makes the step's own. */
carom_status carom_textures_update(carom_world *world, carom_error *error);
/* Is it known, where the device has the newest state, what bodies are? */
bool carom_bodies_are_known(const carom_world *world);
/* Do the textures hold the bodies, and are they not much larger? */
bool carom_textures_fit(const carom_world *world, size_t body_count, size_t circle_count);
/* Brings the state back to the host. */
carom_status carom_textures_fetch(carom_world *world, carom_error *error);
uint64_t carom_textures_memory(size_t body_count, size_t vertex_count, bool pairs);
/* contacts.c: what the step contacts keeps of the last step, to the device before a batch, and back */
carom_status carom_contacts_send(carom_world *world, carom_error *error);
carom_status carom_contacts_fetch(carom_world *world, carom_error *error);
/* Where Warm is too small, a larger one, which is to be sent. */
carom_status carom_contacts_grow(carom_world *world, carom_error *error);
/* joints.c: all of them to the device, and the forces back; a part of what contacts.c moves */
carom_status carom_joints_send(carom_world *world, carom_error *error);
carom_status carom_joints_fetch(carom_world *world, carom_error *error);
/* Motors that were changed since, once the bodies are in their slots. */
carom_status carom_joints_drive(carom_world *world, carom_error *error);
size_t carom_joint_count(const carom_world *world);
/* Do its bodies turn against each other about the anchor? */
bool carom_joint_turns(const carom_joint *joint);
/* joint_check.c: whom joint number k may hold; and once all is said, by which numbers */
carom_status carom_joint_check_parties(const carom_world *world, size_t k, const carom_joint *joint, carom_error *error);
carom_status carom_joint_check_numbers(const carom_world *world, size_t k, const carom_joint *joint, carom_error *error);
/* Those of bodies that go, as `numbers` says, go with them; see remove.c. */
void carom_joints_close(carom_world *world, const uint32_t *numbers, uint32_t gone);
/* joined_pairs.c: those of so many joints; false if there is no memory, which is never so where they get fewer */
bool carom_apart_find(carom_array *apart, const carom_joint *joints, size_t count);
/* Does a joint keep the two from hitting each other? How many pairs there are, and them into Filters, which has room for four times as many ints behind the bodies. */
bool carom_joints_part(const carom_world *world, size_t a, size_t b);
size_t carom_apart_count(const carom_world *world);
void carom_apart_fill(const carom_world *world, int32_t *filters);
/* hits.c: takes those of Hits from number `first` on, in order */
carom_status carom_hits_take(carom_world *world, uint32_t first, uint32_t end, carom_error *error);
/* One more. */
carom_status carom_hits_add(carom_world *world, const carom_hit *hit, carom_error *error);
/* textures_send.c: what bodies are, as the device has it */
carom_status carom_textures_send(carom_world *world, carom_error *error);
carom_status carom_uniforms_send(carom_world *world, carom_error *error);
carom_status carom_filters_send(carom_world *world, carom_error *error);
carom_status carom_friction_send(carom_world *world, carom_error *error);
void carom_geometry_fill(const carom_body *body, float texel[4]); /* of Geometry, with the first vertex of a polygon alone */
void carom_forces_fill(const carom_body *body, float texel[4]);   /* of Forces */
/* Is the world's device one that runs many work-items at once, and slowly each? */
bool carom_is_gpu(const carom_world *world);
/* Runs a stage over the world's textures: fronts to read, backs to write. */
carom_status carom_run(carom_world *world, carom_stage stage, int32_t x, int32_t y, int32_t z, int32_t w, carom_error *error);
void carom_swap(carom_world *world, carom_role role);

#endif
