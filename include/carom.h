/** @file
 * Carom: a portable 2D rigid-body simulator that finds every hit at its exact time.
 *
 * SPDX-License-Identifier: MIT
 *
 * Units: metres, kilograms, seconds, radians; y points up; angles turn counter-clockwise.
 * Numbers: the state is held in 32-bit floats, and a world computes the same bits on every device that
 *   divides and takes square roots correctly rounded.
 * Errors: a function that can fail returns a carom_status, leaves its outputs alone when it fails, and fills in the
 *   caller's carom_error if one is given (NULL is fine everywhere). The library never prints, exits or aborts.
 * NULL: is CAROM_INVALID_ARGUMENT where nothing says that it may be given; an array of no items may always be NULL. A function that
 *   returns no status does nothing then, and answers 0, false or NULL.
 * Threads: a world belongs to one thread at a time; different worlds are independent. There is no global state.
 * Lifetime: what a function named ..._create or ..._read hands out is released by the ..._destroy of the same noun;
 *   destroying NULL does nothing. Strings and arrays passed in are copied.
 *
 * The paper cited is "A fully GPU-implemented rigid body simulator"; sections are given as [2.1].
 */
#ifndef CAROM_H
#define CAROM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What the shared library exports. */
#if defined(__GNUC__)
#define CAROM_API __attribute__((visibility("default")))
#else
#define CAROM_API
#endif

/** Also the number of the ABI, in the shared library's name. */
#define CAROM_VERSION_MAJOR 0
/** Below 1.0.0 a new one may change the interface. */
#define CAROM_VERSION_MINOR 1
/** A new one changes nothing of the interface. */
#define CAROM_VERSION_PATCH 0

/** The version of the library that runs: "0.1.0". */
CAROM_API const char *carom_version(void);

/* ---- Errors ------------------------------------------------------------------------------------------------- */

/** What can be wrong: name, sentence. */
#define CAROM_STATUS_LIST(X)                                 \
	X(OK, "no error")                                        \
	X(INVALID_ARGUMENT, "an argument is outside its range")  \
	X(INVALID_SCENE, "the scene is not valid")               \
	X(UNKNOWN_NAME, "no alternative or device of that name") \
	X(OUT_OF_MEMORY, "there is not enough memory")           \
	X(LIMIT, "the device can't hold what the step needs")    \
	X(DEVICE, "the device failed")                           \
	X(IO, "a file could not be read or written")             \
	X(STALLED, "simulated time can't get on")

/** CAROM_OK, CAROM_INVALID_ARGUMENT, ...: the names of CAROM_STATUS_LIST. */
typedef enum carom_status {
#define CAROM_STATUS_ENUM(name, sentence) CAROM_##name, /**< sentence */
	CAROM_STATUS_LIST(CAROM_STATUS_ENUM)
#undef CAROM_STATUS_ENUM
} carom_status;

/** Filled in by a function that fails; untouched by one that succeeds. */
typedef struct carom_error {
	carom_status status;  /**< never CAROM_OK */
	int line;             /**< of the scene file, from 1; 0 where there is none */
	int column;           /**< likewise */
	int opencl_code;      /**< the OpenCL error code, 0 where there is none */
	char text[1024];      /**< what was found, where, and what is allowed; one line, no full stop at the end */
	char build_log[4096]; /**< the head of the OpenCL compiler's log, empty where there is none */
} carom_error;

/** "CAROM_OK", ...; for a value that is no status "CAROM_?" */
CAROM_API const char *carom_status_name(carom_status status);
/** "no error", ... */
CAROM_API const char *carom_status_text(carom_status status);

/* ---- Bodies ------------------------------------------------------------------------------------------------- */

/** A point or a direction. */
typedef struct carom_vec2 {
	float x; /**< to the right */
	float y; /**< up */
} carom_vec2;

#define CAROM_MIN_VERTICES 3  /**< of a polygon */
#define CAROM_MAX_VERTICES 64 /**< of a polygon */

/** What a body looks like. */
typedef enum carom_shape {
	CAROM_CIRCLE,  /**< a disc of `radius` */
	CAROM_POLYGON, /**< the polygon of `vertices`, either way round; it need not be convex, but by the step first_impact */
	CAROM_REGULAR, /**< `sides` vertices on a circle of `radius`, the first on the body's +x axis */
} carom_shape;

#define CAROM_MAX_FRICTION 1000.0f   /**< of a coefficient of friction; more would make no difference */
#define CAROM_COLOR_AUTO 0xFF000000u /**< a colour of the palette, by the body's index */
#define CAROM_CATEGORIES 1u          /**< of a body that is of no other category */
#define CAROM_MASK 0xFFFFFFFFu       /**< of a body that meets all categories */

/** What a body is made from. Start from carom_default_body_def() and set the shape. */
typedef struct carom_body_def {
	carom_shape shape;          /**< decides which of the next four count */
	float radius;               /**< m, > 0: CAROM_CIRCLE and CAROM_REGULAR */
	uint32_t sides;             /**< 3..64: CAROM_REGULAR */
	uint32_t vertex_count;      /**< 3..64: CAROM_POLYGON */
	const carom_vec2 *vertices; /**< m, `vertex_count` of them, in order, any origin: they are recentred on their centre of mass;
	                               each side is longer than a millionth of the length from the first to the farthest, and the area
	                               larger than a millionth of that squared. The polygon meets itself nowhere: of one that is not convex
	                               sides that don't follow each other are farther apart than a millionth of that length */
	carom_vec2 position;        /**< m, of the centre of mass; default (0, 0) */
	carom_vec2 velocity;        /**< m/s; default (0, 0) */
	float angle;                /**< rad; kept in [-pi, pi]; default 0 */
	float angular_velocity;     /**< rad/s; default 0 */
	float density;              /**< kg/m^2, > 0; default 1; used where mass is 0 */
	float mass;                 /**< kg, > 0; 0 (the default) takes it from the density */
	float restitution;          /**< 0..1: the part of the normal speed a hit gives back; a pair takes the larger of its two;
	                               NaN (the default) takes the world's */
	float friction;             /**< 0..1000, Coulomb's: what acts along the surfaces is at most so many times what acts along the normal;
	                               a pair takes the geometric mean of its two; NaN (the default) takes the world's */
	float rolling_friction; /**< 0..1000, of circles, by the step contacts: the torque against rolling on what they rest on is at most so many times
	                               the radius (of two circles the smaller one) times what acts along the normal; a pair takes the larger of its two;
	                               NaN (the default) takes the world's */
	float linear_damping;   /**< 1/s, finite, >= 0: by events and contacts a step of h seconds ends with the velocity divided by
	                               1 + linear_damping h, but of kinematic bodies; NaN (the default) takes the world's */
	float angular_damping;  /**< likewise of the angular velocity */
	carom_vec2 force;       /**< N, constant, at the centre of mass; default (0, 0) */
	float torque;           /**< N m, constant; default 0 */
	bool is_static;         /**< infinite mass and inertia: never moves; velocities and forces must be 0 */
	bool is_kinematic;   /**< infinite mass and inertia, too, but it moves: on and on with its velocities, whatever it hits, also through static and
	                               kinematic bodies and out of the room; forces must be 0. carom_world_set_states gives it other velocities */
	uint32_t categories; /**< bits: what the body is; default CAROM_CATEGORIES. Two bodies hit each other if each is of a category that the
	                               other's mask has, else they pass through each other as if the other was not there; walls stop all */
	uint32_t mask;       /**< bits: the categories that it hits; default CAROM_MASK */
	uint32_t color;      /**< 0xRRGGBB or CAROM_COLOR_AUTO (the default) */
	const char *name;    /**< for people; NULL (the default) for none */
} carom_body_def;

/** What moves. */
typedef struct carom_body_state {
	carom_vec2 position;    /**< m */
	float angle;            /**< rad, in [-pi, pi] */
	carom_vec2 velocity;    /**< m/s */
	float angular_velocity; /**< rad/s */
} carom_body_state;

/** What a body is: everything of it that does not move. The pointers live as long as the world and its bodies do:
 * until the next carom_world_add, carom_world_remove or carom_world_destroy. */
typedef struct carom_body_info {
	carom_shape shape;          /**< as it was given */
	float radius;               /**< m, of a circle or a regular polygon, else of the circle about the centre of mass that holds the body */
	uint32_t vertex_count;      /**< 1 for a circle */
	const carom_vec2 *vertices; /**< m, the outline about the centre of mass, counter-clockwise; NULL for a circle */
	float mass;                 /**< kg; infinite for a static body, and for a kinematic one */
	float inertia;              /**< kg m^2 about the centre of mass; infinite likewise */
	float density;              /**< kg/m^2, as given; 0 where the mass was given */
	float restitution;          /**< 0..1 */
	float friction;             /**< 0..1000 */
	float rolling_friction;     /**< 0..1000 */
	float linear_damping;       /**< 1/s */
	float angular_damping;      /**< 1/s */
	carom_vec2 force;           /**< N */
	float torque;               /**< N m */
	bool is_static;             /**< never moves */
	bool is_kinematic;          /**< moves as its velocities say, and nothing changes them */
	carom_vec2 recentred_by;    /**< m: the centre of mass of the vertices as they were given; (0, 0) if none was moved */
	uint32_t categories;        /**< bits: what it is */
	uint32_t mask;              /**< bits: the categories that it hits */
	uint32_t color;             /**< 0xRRGGBB, or CAROM_COLOR_AUTO */
	const char *name;           /**< NULL for none */
} carom_body_info;

/** A disc without a radius, with the defaults above. */
CAROM_API carom_body_def carom_default_body_def(void);

/* ---- The pipeline: which alternative fills each slot ---------------------------------------------------------- */

/** The names of the chosen alternatives; NULL takes the default. */
typedef struct carom_pipeline {
	const char *step;    /**< events (default), contacts (for what comes to rest), first_impact [2] */
	const char *aabb;    /**< tight (default), loose [2.1] */
	const char *overlap; /**< all_pairs [2.1]; aabb, overlap and reduce are of first_impact alone */
	const char *inside;  /**< naive (default), orourke: the test that toi bisection makes [2.1] */
	const char *toi;     /**< circle_quadratic (default), separating, bisection [2.1, 4.1] */
	const char *walls;   /**< half_planes */
	const char *reduce;  /**< tiled (default), four_six, six, classic [2.2] */
	const char *impulse; /**< pair_exact (default), accumulate [2.3] */
	/* of pictures alone; all give the same */
	const char *transforms; /**< index (default): where bodies are is read on the device; to_cpu: it is read back and sent [3] */
	const char *vertices;   /**< sent are option1: body and ordinal, option2: first vertex and ordinal, option3 (default): coordinates [3] */
} carom_pipeline;

/** Chooses `alternative` for `slot`, both by name. CAROM_UNKNOWN_NAME lists the known ones. */
CAROM_API carom_status carom_pipeline_set(carom_pipeline *pipeline, const char *slot, const char *alternative, carom_error *error);
/** The chosen (or default) alternative of `slot`; NULL if there is no such slot. */
CAROM_API const char *carom_pipeline_get(const carom_pipeline *pipeline, const char *slot);

/** One alternative of one slot, for listing. */
typedef struct carom_stage_info {
	const char *slot;        /**< lives as long as the library */
	const char *alternative; /**< likewise */
	bool is_default;         /**< what NULL in carom_pipeline takes */
	bool on_opencl;          /**< there is a kernel of it */
	bool on_cpu;             /**< there is the same in C++ */
} carom_stage_info;

/** Fills in the index-th (from 0, slots in the order in which a step runs them); false past the last. */
CAROM_API bool carom_stage_list(size_t index, carom_stage_info *info);

/* ---- Devices ------------------------------------------------------------------------------------------------ */

/** A device, as carom_device_list_create and carom_world_get_device tell of it. */
typedef struct carom_device_info {
	char platform[128];      /**< as OpenCL has it; "Carom" of the fallback */
	char name[256];          /**< likewise; "cpu (its model)" */
	char version[128];       /**< of OpenCL; of Carom for the fallback */
	bool is_opencl;          /**< not the CPU fallback */
	bool is_cpu;             /**< computes on the machine's CPU: the fallback, and what OpenCL calls one */
	bool works;              /**< Carom can run on it */
	bool is_default;         /**< in a list of devices: `auto` takes this one */
	bool exact;              /**< divides and takes roots correctly rounded: the same bits as every other exact device */
	bool has_images;         /**< of which Carom can use what it needs; else textures are buffers */
	uint32_t compute_units;  /**< CPU cores of the fallback */
	uint32_t clock_mhz;      /**< 0 where unknown */
	uint64_t memory;         /**< bytes */
	uint64_t max_allocation; /**< bytes of one texture */
	uint32_t max_image_size; /**< texels of an image's side */
	bool uses_images;        /**< of a world's device: its textures are images, not buffers */
	char reason[256];        /**< why it does not work; empty if it does */
} carom_device_info;

/** Lists what there is, in the order in which `auto` tries it: OpenCL devices that are no CPUs, of these the one with the most
 * compute units times clock first; the CPU fallback; OpenCL on CPUs; what does not work. *devices is an array of *count to be released with
 * carom_device_list_destroy. No OpenCL at all is no error: the list then holds the fallback alone. Where OpenCL itself fails, an
 * entry that does not work says how. The environment's CAROM_MAX_IMAGE_SIZE (texels, of OpenCL devices) and CAROM_MAX_ALLOCATION
 * (bytes, of all) lower those limits, to try what a smaller device would do; CAROM_INVALID_ARGUMENT if one is no whole number above 0. */
CAROM_API carom_status carom_device_list_create(carom_device_info **devices, size_t *count, carom_error *error);
/** Releases the list. */
CAROM_API void carom_device_list_destroy(carom_device_info *devices);

/* ---- Worlds ------------------------------------------------------------------------------------------------- */

/** Where an OpenCL device keeps state and pairs. The results are the same. */
typedef enum carom_storage {
	CAROM_STORAGE_AUTO,   /**< images where the device has them, but buffers on CPUs for steps other than first_impact */
	CAROM_STORAGE_IMAGE,  /**< OpenCL image2d */
	CAROM_STORAGE_BUFFER, /**< OpenCL buffers of the same layout */
} carom_storage;

/** What a world is made from. Start from carom_default_world_def(). */
typedef struct carom_world_def {
	float time_step;         /**< s, >= 1.17549435e-38: how long a step of events or contacts lasts, the longest of first_impact; default 1/60.
	                          The last one before an end: see carom_world_advance */
	carom_vec2 gravity;      /**< m/s^2; default (0, 0) */
	float restitution;       /**< 0..1, of the walls and of bodies that have none of their own; default 1 */
	float friction;          /**< 0..1000, of the walls and of bodies that have none of their own; default 0: none */
	float rolling_friction;  /**< likewise */
	float linear_damping;    /**< 1/s, finite, >= 0, of bodies that have none of their own; default 0: none */
	float angular_damping;   /**< likewise */
	bool has_room;           /**< four walls that nothing passes; default none. Centres of mass must start inside, or outside by no more than
	                          a thousandth of it; what of a body is beyond a wall at the start may stay there, but gets no farther */
	carom_vec2 room_min;     /**< m, the lower left corner */
	carom_vec2 room_max;     /**< m, the upper right corner: above room_min in both */
	float epsilon;           /**< part of a step, 2^-22..0.5: the accuracy of toi bisection [2.1]; default 2^-18 */
	uint32_t iterations;     /**< bisections a pass, >= 1 [2.1, `iter`]; 0 (the default) for all in one pass */
	carom_pipeline pipeline; /**< default: all NULL */
	const char *device;      /**< auto (default), cpu, opencl, or part of a platform's or device's name, in any case, not ""; NULL:
	                          the environment's CAROM_DEVICE, else auto */
	carom_storage storage;   /**< default CAROM_STORAGE_AUTO; of an OpenCL device, the CPU fallback has its own */
	uint32_t threads;        /**< of the CPU fallback, 256 at most; 0 (the default) for one a core */
	bool keep_hits;          /**< keep each hit of a call, for carom_world_get_hits; default false */
	bool profile;            /**< measure each kernel, for carom_world_profile; default false, since it takes time itself */
} carom_world_def;

/** Bodies, their state, and the device that moves them. */
typedef struct carom_world carom_world;

/** The defaults above. */
CAROM_API carom_world_def carom_default_world_def(void);

/** An empty world on an opened device. Fails with CAROM_UNKNOWN_NAME for a device or alternative that is not there,
 * CAROM_INVALID_ARGUMENT for a field out of range (named in the error), or one of the environment's CAROM_MAX_IMAGE_SIZE, CAROM_MAX_ALLOCATION and
 * CAROM_KERNEL_DIR (likewise); CAROM_DEVICE, CAROM_OUT_OF_MEMORY.
 * An OpenCL device builds kernels here, and those of pictures when the first is drawn, which may take seconds. While a world of the same kernels lives
 * on that device, the next one shares them, in whichever thread, and is there at once: its step, other alternatives and storage must be the same, not its bodies.
 * So do worlds of one device share the driver's context: what makes a driver give that up ends them all. The environment's
 * CAROM_CACHE names a folder to keep them in for the next world of any process; it is made if it is missing, and nobody else should be
 * able to write there. It changes no bit and is never an error: what it does not have, or not whole, is built. */
CAROM_API carom_status carom_world_create(const carom_world_def *def, carom_world **world, carom_error *error);
/** Releases the world and what it has on its device. */
CAROM_API void carom_world_destroy(carom_world *world);

/** Adds `count` bodies, all or none; *first (may be NULL) becomes the index of the first, the others follow it.
 * CAROM_INVALID_ARGUMENT names the body (as `bodies[k]`, k from 0 in `defs`) and the field. CAROM_LIMIT: a world holds
 * 4,194,304 bodies, 25,165,824 vertices of polygons and names of 4 GiB at most; of a polygon that is not convex, which is kept with its hull and convex pieces of it, up to seven times its vertices count; equal polygons mostly share theirs. By the steps events and contacts, few (a quarter of the bodies) join a world
 * that goes on, before its next step; for more, or the first that has friction or damping, or where there is no room on the device, which is made for a power of two of them, all are loaded anew. */
CAROM_API carom_status carom_world_add(carom_world *world, const carom_body_def *defs, size_t count, uint32_t *first, carom_error *error);

/** Removes the bodies of these indices, all or none; those behind them get lower indices, in the same order. The world goes on with the bits of one that is made of the others as
 * they are now, with their contacts; the hits of the last call are forgotten. By the steps events and contacts few (a 64th of the bodies and 64, and no more than a quarter) leave a world that goes on; many in one call cost little more than one. CAROM_INVALID_ARGUMENT names what is no body, or is there twice (as `indices[k]`). */
CAROM_API carom_status carom_world_remove(carom_world *world, const uint32_t *indices, size_t count, carom_error *error);

/** How many there are. */
CAROM_API size_t carom_world_body_count(const carom_world *world);
/** What a body is. CAROM_INVALID_ARGUMENT if there is no body of that index. */
CAROM_API carom_status carom_world_get_body(const carom_world *world, uint32_t index, carom_body_info *info, carom_error *error);

/** Reads the states of `count` bodies from index `first` on. Waits for the device; by events and contacts few are read without all others. After a step that failed, the last good
 * state is read: that after the steps that its report tells. */
CAROM_API carom_status carom_world_get_states(carom_world *world, uint32_t first, size_t count, carom_body_state *states, carom_error *error);
/** Writes the same, all or none. CAROM_INVALID_ARGUMENT: a number is not finite, a position outside the room by more
 * than a thousandth of it and what rounding makes of a step's way (a kinematic body may be anywhere), a static body moves. To steer a few bodies before
 * each step costs next to nothing by events and contacts, and changes no bit of what a world that is made so would do. */
CAROM_API carom_status carom_world_set_states(carom_world *world, uint32_t first, size_t count, const carom_body_state *states, carom_error *error);
/** A constant force (N, at the centre of mass) and torque (N m), from now on; it may be another one before each step, as cheap as carom_world_set_states. A static or
 * kinematic body takes none: for it anything but 0 is CAROM_INVALID_ARGUMENT. */
CAROM_API carom_status carom_world_set_force(carom_world *world, uint32_t index, carom_vec2 force, float torque, carom_error *error);

/** What the body is and what it hits, from now on: as in carom_body_def. Bodies that overlap as they begin to hit each other get no deeper, and part as they move. Where it is
 * another one than before, the next step of events or contacts looks for all neighbours anew. */
CAROM_API carom_status carom_world_set_filter(carom_world *world, uint32_t index, uint32_t categories, uint32_t mask, carom_error *error);

/** Gravity (m/s^2, finite) from now on; carom_world_get_def has it, too. It may be another one before each step: by events and contacts all bodies then look for hits in it, but none
 * is loaded anew. */
CAROM_API carom_status carom_world_set_gravity(carom_world *world, carom_vec2 gravity, carom_error *error);
/** The time step (s) from now on, as in carom_world_def; carom_world_get_def has it, too. It may be another one before each step, as cheap as carom_world_set_gravity where it gets no
 * more than a fourth longer. */
CAROM_API carom_status carom_world_set_time_step(carom_world *world, float time_step, carom_error *error);

/** A wall of the room, where a contact has a body's index. */
typedef enum carom_wall {
	CAROM_WALL_TOP = -4,    /**< y = room_max.y */
	CAROM_WALL_RIGHT = -3,  /**< x = room_max.x */
	CAROM_WALL_BOTTOM = -2, /**< y = room_min.y */
	CAROM_WALL_LEFT = -1,   /**< x = room_min.x */
} carom_wall;

/** Two bodies, or a body and a wall, that rest on each other, or might, at one or two points. Forces are means of those that bore in the last steps: the last
 * one counts a quarter, the one before three quarters of that and so on, for what one step does too much the next does too little; of steps that change nothing about
 * what bears they stay as they are. A circle with rolling friction has its one point twice, with half of the force each: friction[1] is then, times its radius (of two circles
 * the smaller one), the torque against rolling on `body`, counter-clockwise. */
typedef struct carom_contact {
	uint32_t body;     /**< its index */
	int32_t other;     /**< the index of a body before it, or a carom_wall */
	float normal[2];   /**< N, >= 0: what parts the two, at each point, as `other` sees it the left one first; 0 for a second that there is not */
	float friction[2]; /**< N: what acts on `body` along the surfaces, to the left as `other` sees it; of a circle that rolls see above */
	uint32_t part; /**< 0, but of two bodies of which one is not convex, and that press on each other along several normals: which of these contacts
	                        it is, below CAROM_MAX_PARTS */
} carom_contact;

#define CAROM_MAX_PARTS 4 /**< contacts of two bodies */

/** How many contacts the last step ended with; 0 for steps other than contacts. Waits for the device. */
CAROM_API carom_status carom_world_contact_count(carom_world *world, size_t *count, carom_error *error);
/** Reads `count` of them from number `first` on: in the order of `body`, of one body in that of `other`, and of the same two in that of `part`. */
CAROM_API carom_status carom_world_get_contacts(carom_world *world, size_t first, size_t count, carom_contact *contacts, carom_error *error);
/** Replaces them, all or none. The next step of contacts finds who rests on whom by itself, and its forces sooner when it begins with these: with the
 * states they are what another world needs to go on with the same bits. Other steps take no notice, and forget them. Bodies that are added later change none of them. CAROM_INVALID_ARGUMENT names the contact
 * (as `contacts[k]`) and the field: there is no such body or wall, neither of the two moves, a number that is not finite; or the body: a pair that is there twice with the same part. */
CAROM_API carom_status carom_world_set_contacts(carom_world *world, size_t count, const carom_contact *contacts, carom_error *error);

/** How a joint holds two bodies together. */
typedef enum carom_joint_kind {
	CAROM_REVOLUTE, /**< as a pin: the two anchors are at one place, about which both bodies turn: freely, by a motor, or between two stops */
	CAROM_DISTANCE, /**< as a rod without mass: the two anchors are `length` apart */
	CAROM_ROPE,     /**< as a rope without mass: they are `length` apart at most */
	CAROM_SPRING,   /**< as a spring and a damper without mass: it pulls with `stiffness` times what they are farther apart than `length`, and
	                 `damping` times the speed at which they part */
	CAROM_SLIDER,   /**< the body's anchor stays on a line through the other anchor, which turns with the other body; else as a pin */
} carom_joint_kind;

#define CAROM_GROUND (-1) /**< where a joint has the index of another body: a place in the world */

/** What holds two bodies together, or one in its place, by the step contacts. Start from carom_default_joint(). It can't break, and takes no energy, but for damping, a
 * motor that brakes, a rope that gets tight, and an angle that gets to its stop: forces between the anchors act through each step, and impulses as it begins. Anchors that are not
 * where they belong are brought there, by no more than the bodies' radii a step. */
typedef struct carom_joint {
	carom_joint_kind kind;   /**< a pin, a rod, a rope, a spring or a slider */
	uint32_t body;           /**< its index */
	int32_t other;           /**< the index of another body; default CAROM_GROUND. One of the two must be dynamic */
	carom_vec2 anchor;       /**< m, from the body's centre of mass, in its own frame (at angle 0), no more than 1e9; default (0, 0) */
	carom_vec2 other_anchor; /**< m, likewise of the other body; for CAROM_GROUND the place. NaN (the default): where `anchor` is as it is
	                          given to a world */
	float length;            /**< m, no more than 1e9, of rods, ropes and springs: of a rod or rope from a hundredth of the two radii on, of a spring
	                     at rest, from 0 on; NaN (the default): as far as the anchors are from each other as it is given to a world */
	float axis;              /**< rad, -2 pi..2 pi, of CAROM_SLIDER: which way its line goes in the other body's frame, or the world's; default 0 */
	float stiffness;         /**< N/m, 0..1e12, of CAROM_SPRING; default 0 */
	float damping;           /**< N s/m, likewise. One of the two must be above 0 */
	float
		motor_speed; /**< rad/s, within +-1e9, of CAROM_REVOLUTE and CAROM_SLIDER: the body's angular velocity, less the other one's, that a motor brings
	                     about; default 0: it brakes */
	float motor_torque; /**< N m, 0..1e30: what the motor has at most; default 0: there is none */
	bool has_stops;     /**< of the same: the body's angle, less the other one's, stays between two; default false */
	float lower_angle;  /**< rad, -2 pi..2 pi, if has_stops: not below this; default 0 */
	float upper_angle;  /**< rad, likewise: nor above this, which is as much, so that they don't turn against each other, or less than 2 pi
	                     more; default 0 */
	bool collides;      /**< the two bodies hit each other, too; default false: they pass through each other */
	float force
		[2]; /**< N: what the last step ended with: of CAROM_REVOLUTE what acts on `body`, along x and y; of CAROM_SLIDER to the left of its line, and 0; of the others what pushes
	                     the two apart, below 0 where it pulls, and 0, of a rope that had to be drawn in what the next step stops that with. The next step's begin with it */
	float torque[2]; /**< N m, on `body`, of the same: the motor's, and that of the stops; likewise */
} carom_joint;

/** A CAROM_REVOLUTE of body 0, with the defaults above. */
CAROM_API carom_joint carom_default_joint(void);
/** How many a world has. */
CAROM_API size_t carom_world_joint_count(const carom_world *world);
/** Reads `count` of them from number `first` on, in the order of `body`, of one body in that in which they were given, without any NaN: a `length` that says nothing is 0. Waits for the device. */
CAROM_API carom_status carom_world_get_joints(carom_world *world, size_t first, size_t count, carom_joint *joints, carom_error *error);
/** Replaces them, all or none: a joint more is one more behind those that were read. Those of a body that is removed go with it. It wakes all bodies; a motor gets another speed by it. Each takes about 100 bytes on the device, and where there are any a body 16 more. With states and contacts they are what another world needs to go on with the
 * same bits. CAROM_INVALID_ARGUMENT names the joint (as `joints[k]`) and the field, or that the world's step is not contacts: others hold no joints. */
CAROM_API carom_status carom_world_set_joints(carom_world *world, size_t count, const carom_joint *joints, carom_error *error);

/** Gives the motor of joint number `joint`, a CAROM_REVOLUTE or CAROM_SLIDER, as carom_world_get_joints counts them, another speed (rad/s) and torque (N m; 0: there is none), within what a carom_joint may have: with the
 * bits of a world in which all joints were set anew, but at next to no cost, also between any two steps. Errors as of carom_world_set_joints. */
CAROM_API carom_status carom_world_set_motor(carom_world *world, size_t joint, float speed, float torque, carom_error *error);

/** What a call of carom_world_step or carom_world_advance did. */
typedef struct carom_report {
	uint64_t steps;  /**< steps done */
	uint64_t hits;   /**< hits resolved */
	uint64_t ruled;  /**< of these, by events or contacts: answered by a rule against hits without end, otherwise than by their restitution */
	uint64_t held;   /**< how often a body was held until the end of a step of events or contacts, since it was hit too often in it */
	double advanced; /**< s, simulated */
} carom_report;

/** Runs `steps` steps of the pipeline. A step of events lasts `time_step` and answers all its hits; one of contacts does, too, but bodies that
 * rest on each other, of a restitution below 1 or with friction, push each other and are not hit, and where they are about to meet at less than four times the speed
 * that their pushes make in a step (of what is small, or in a long step: at less than the smaller radius a step) they are stopped, without a bounce; where they rub they are held against each other, too; one of first_impact lasts until the first hit and at most
 * `time_step` [2.2].
 * `report` may be NULL; on failure it tells what was done before. CAROM_STALLED (first_impact alone): time can't get on, and the
 * state is the one at which it stood still. CAROM_LIMIT: places, sizes or speeds are, or in the next step come, above 1e9 (m, m/s, rad/s), where floats overflow, a body would
 * pass the room 2^32 times in a step, or
 * there are more bodies than the step can hold. */
CAROM_API carom_status carom_world_step(carom_world *world, uint64_t steps, carom_report *report, carom_error *error);
/** Runs as many steps as `seconds` (0 to 1.2676506e30) of simulated time take; the last is cut short to end there, or, so that it leaves no sliver, longer than `time_step` by a 4096th
 * at most. Then carom_world_time is the end, exactly. Where less than 1.17549435e-38 s is left, the end is reached. In a world without bodies nothing runs, and no time passes. */
CAROM_API carom_status carom_world_advance(carom_world *world, double seconds, carom_report *report, carom_error *error);
/** The same up to the simulated time `time` (s, not before carom_world_time, up to 1.2676506e30), but at most `most_steps` steps. Calls for the same
 * time go on where the one before ended: cutting the way into several calls changes no bit. */
CAROM_API carom_status carom_world_advance_to(carom_world *world, double time, uint64_t most_steps, carom_report *report, carom_error *error);

/** A hit, with what it did. */
typedef struct carom_hit {
	double time;        /**< s, simulated: when */
	uint32_t body;      /**< its index */
	int32_t other;      /**< the index of a body before it, or a carom_wall */
	carom_vec2 point;   /**< m, where they touched; along a face, where the impulse acts */
	carom_vec2 normal;  /**< 1 long, from `other` to `body` */
	carom_vec2 impulse; /**< N s, on `body`, friction too; the opposite acts on `other` */
	bool is_ruled;      /**< counted in carom_report.ruled */
} carom_hit;

/** How many hits the last carom_world_step or _advance answered, or in its progress callback, this one so far; 0 in a world that was made without
 * `keep_hits`. They are those that its report counts, unless it failed for want of memory. */
CAROM_API size_t carom_world_hit_count(const carom_world *world);
/** Reads `count` of them from number `first` on, in the order of time; of several at the same time each comes after those that led to it. They are kept until
 * the next such call: many short calls need less memory than a long one, and have the same hits, but for the last bits of their times. On all exact devices they
 * have the same bits. */
CAROM_API carom_status carom_world_get_hits(const carom_world *world, size_t first, size_t count, carom_hit *hits, carom_error *error);

/** Called now and then during a step or advance, after as many steps as take about a tenth of a second, but 256 at most, on the calling thread, with what the call has done so far; returning false
 * ends the call early (with CAROM_OK: the report tells how far it got). How often it is called changes no result, while
 * cutting one advance into several cuts steps short. It may read the world, and draw it. What would change it, another step too, is
 * CAROM_INVALID_ARGUMENT then; it must not be destroyed. */
typedef bool (*carom_progress)(void *context, const carom_report *so_far);
/** Has `progress` called from now on, with `context`; NULL for none. */
CAROM_API void carom_world_set_progress(carom_world *world, carom_progress progress, void *context);

/** Simulated seconds since the world was created. */
CAROM_API double carom_world_time(const carom_world *world);
/** What the world was made from, with what was changed since; it lives as long as the world. */
CAROM_API const carom_world_def *carom_world_get_def(const carom_world *world);
/** The device the world runs on. */
CAROM_API carom_status carom_world_get_device(const carom_world *world, carom_device_info *info, carom_error *error);
/** Bytes that a world of `body_count` bodies with `vertex_count` vertices in all, a polygon that is not convex counting with seven times its own at most, takes at most on its device, unless they crowd: a body of events and contacts with more than
 * 16 others within its reach takes 4 more for each, and one of contacts that touches more than six about 100 more for each; and unless many hits are kept at once: there is room for 4096, or as many as bodies, then each takes 64 more. One that is changed between
 * two steps by events or contacts takes 48 to 96 more. Pictures come on top
 * from the first one on: 4 bytes a pixel, and about 300 bytes a circle, or 100 a polygon and 50 a vertex of it (200 where it is not convex, at most), for as many bodies as are drawn
 * at once (less than 2 GiB). 0 for a def, or so many, that no world is made from. */
CAROM_API uint64_t carom_world_memory(const carom_world_def *def, size_t body_count, size_t vertex_count);

/** What a kernel took since the world was created: by OpenCL's profiling events, or the wall clock on the CPU fallback. */
typedef struct carom_kernel_time {
	const char *kernel; /**< "toi_first", ... */
	double seconds;     /**< all launches together */
	uint64_t launches;  /**< how often it ran */
} carom_kernel_time;

/** Fills in the index-th kernel's (from 0, in the order of a step); false past the last, or where the world's def has no
 * `profile`. */
CAROM_API bool carom_world_profile(carom_world *world, size_t index, carom_kernel_time *time);

/** What is measured of a state, in double precision on the host. Static and kinematic bodies do not count. */
typedef struct carom_measure {
	double kinetic_energy;   /**< J */
	double potential_energy; /**< J, of gravity, 0 at the origin */
	double momentum_x;       /**< kg m/s */
	double momentum_y;       /**< kg m/s */
	double angular_momentum; /**< kg m^2/s about the origin */
	double max_penetration;  /**< m: the deepest overlap of two bodies that hit each other, or of a body and a wall, 0 if none; of polygons that are
	                            not convex, that of two convex pieces of them */
} carom_measure;

/** Measures the present state. Waits for the device. */
CAROM_API carom_status carom_world_measure(carom_world *world, carom_measure *measure, carom_error *error);

/** A 64-bit hash (FNV-1a) of the state: of x, y, vx, vy, angle, angular velocity of each body in turn, as the bytes of
 * little-endian floats. Equal hashes mean equal bits. Contacts are not in it. */
CAROM_API carom_status carom_world_hash(carom_world *world, uint64_t *hash, carom_error *error);

/* ---- Queries: what is where ---------------------------------------------------------------------------------- */

/** The bodies of a world in their places, as they were when it was made. It never changes: any number of threads may ask the same one at once, while its world goes
 * on, or is no more. The answers have the same bits on all exact devices. It takes 100 to 200 bytes a body and 40 a vertex, of a polygon that is not convex up to 260. */
typedef struct carom_snapshot carom_snapshot;

/** Makes one of the world as it is now. Waits for the device. */
CAROM_API carom_status carom_snapshot_create(carom_world *world, carom_snapshot **snapshot, carom_error *error);
/** The same of those bodies alone that are of a category in `mask` (bits, as in carom_body_def); CAROM_MASK is for all bodies, also those of no category. Indices stay those of the world. */
CAROM_API carom_status carom_snapshot_create_masked(carom_world *world, uint32_t mask, carom_snapshot **snapshot, carom_error *error);
/** Releases it. */
CAROM_API void carom_snapshot_destroy(carom_snapshot *snapshot);

/** A disc that moves straight from one place to another; with radius 0 a point. */
typedef struct carom_ray {
	carom_vec2 from; /**< m, its centre */
	carom_vec2 to;   /**< m */
	float radius;    /**< m, >= 0 */
} carom_ray;

#define CAROM_NOTHING INT32_MIN /**< where a ray meets neither a body nor a wall */

/** What a ray, or a body that is cast, meets first. */
typedef struct carom_ray_hit {
	int32_t other;     /**< the index of a body, a carom_wall, or CAROM_NOTHING */
	double part;       /**< 0..1: of the way; 1 for CAROM_NOTHING */
	carom_vec2 point;  /**< m, where they touch; `to` for CAROM_NOTHING */
	carom_vec2 normal; /**< 1 long, from what is met to what moves; (0, 0) for CAROM_NOTHING */
} carom_ray_hit;

/** What each of `count` rays meets first: a body, or from inside a wall of the room. Where it meets several at once it is the body with the lowest index. What a ray
 * touches where it begins is not met: a ray that begins in a body looks out of it, and meets no other part of it, either, where that is not convex. CAROM_INVALID_ARGUMENT names what is not finite, or a radius below 0 (as `rays[k]`). */
CAROM_API carom_status carom_snapshot_cast_rays(const carom_snapshot *snapshot, size_t count, const carom_ray *rays, carom_ray_hit *hits,
	carom_error *error);

/** The same of `count` bodies that are not in it, where each moves straight from its position to `to[k]` (m) without turning. Of a def its shape, position and angle count, and its filter:
 * what it may not hit it does not meet. Faces that lie flush touch in the middle of what they share; where several do, two of them. CAROM_INVALID_ARGUMENT names what carom_world_add would (as `bodies[k]`), or
 * `to[k]`, where that is not finite; a position may be outside the room. */
CAROM_API carom_status carom_snapshot_cast_bodies(const carom_snapshot *snapshot, size_t count, const carom_body_def *bodies, const carom_vec2 *to,
	carom_ray_hit *hits, carom_error *error);

/** Which bodies have a point in common with the box from `min` to `max` (m; where both are the same, with that point). *count becomes how many there are; their indices, in
 * ascending order, are written to `indices`, which has room for `room` of them (NULL for none): where there are more, which of them are written is not said. CAROM_INVALID_ARGUMENT: a
 * number is not finite, or one of `min` above that of `max`. */
CAROM_API carom_status carom_snapshot_find(const carom_snapshot *snapshot, carom_vec2 min, carom_vec2 max, uint32_t *indices, size_t room,
	size_t *count, carom_error *error);

/** The same with a body that is not in it: of those that it may hit. Of the def the same counts as for carom_snapshot_cast_bodies, and errors name the same (as `bodies[0]`). */
CAROM_API carom_status carom_snapshot_find_touching(const carom_snapshot *snapshot, const carom_body_def *body, uint32_t *indices, size_t room,
	size_t *count, carom_error *error);

/** The body nearest to a point. */
typedef struct carom_nearest {
	int32_t body;      /**< its index, or CAROM_NOTHING */
	double distance;   /**< m, from the point to the body; 0 for a point in it; what was allowed for CAROM_NOTHING */
	carom_vec2 point;  /**< m, of the body's points the nearest; the point itself where it is in the body, and for CAROM_NOTHING */
	carom_vec2 normal; /**< 1 long, from there to the point; (0, 0) where it is in the body, on it, or for CAROM_NOTHING */
} carom_nearest;

/** Of each of `count` points (m) the body nearest to it, if that is at most `within` away (m, >= 0; INFINITY for any). Of bodies that are equally near, as all are that the point is in,
 * the one with the lowest index; walls are none. CAROM_INVALID_ARGUMENT names what is not finite (as `points[k]`), or a `within` that is below 0 or no number. */
CAROM_API carom_status carom_snapshot_find_nearest(const carom_snapshot *snapshot, size_t count, const carom_vec2 *points, float within,
	carom_nearest *nearest, carom_error *error);

/* ---- Scenes: worlds as JSON files ----------------------------------------------------------------------------- */

/** What a picture shows; its width follows from the picture's. */
typedef struct carom_camera {
	carom_vec2 center; /**< m */
	float height;      /**< m from the bottom to the top of the picture, > 0 */
} carom_camera;

/** A scene as it was read. All of it may be changed before a world is made from it, but not the pointers' owner. */
typedef struct carom_scene {
	carom_world_def world;   /**< all but the bodies */
	bool has_camera;         /**< the scene tells what to show */
	carom_camera camera;     /**< if has_camera */
	size_t body_count;       /**< of `bodies` */
	carom_body_def *bodies;  /**< in the scene's order */
	size_t contact_count;    /**< of `contacts` */
	carom_contact *contacts; /**< what a step of contacts had ended with when the scene was written */
	size_t joint_count;      /**< of `joints` */
	carom_joint *joints;     /**< in the order of their bodies */
	void *storage;           /**< owns the arrays and strings above */
} carom_scene;

/** Reads a scene of the format "carom-scene/1". CAROM_INVALID_SCENE gives line and column, or the JSON path, what was
 * found and what is allowed; CAROM_IO a file that can't be read. A name of an open descriptor of this process, as /dev/stdin is, is read from the
 * place on where that is. */
CAROM_API carom_status carom_scene_read(const char *path, carom_scene **scene, carom_error *error);
/** The same from memory; `name` stands for the file in errors, and NULL for "scene". The text need not end in a NUL. */
CAROM_API carom_status carom_scene_parse(const char *text, size_t length, const char *name, carom_scene **scene, carom_error *error);
/** Releases the scene and all that its pointers point to. */
CAROM_API void carom_scene_destroy(carom_scene *scene);
/** A world with the scene's bodies. Errors name the body by its JSON path. */
CAROM_API carom_status carom_scene_create_world(const carom_scene *scene, carom_world **world, carom_error *error);
/** Writes the world's present state as a scene file that reads back with the same bits; `camera` may be NULL. The file is
 * whole or, on failure, as it was before. CAROM_INVALID_ARGUMENT: a camera that is not finite, or of no height. */
CAROM_API carom_status carom_world_write_scene(carom_world *world, const carom_camera *camera, const char *path, carom_error *error);

/** The same as a text in memory, which ends in a NUL that does not count in *length (which may be NULL): carom_scene_parse reads it. */
CAROM_API carom_status carom_scene_text_create(carom_world *world, const carom_camera *camera, char **text, size_t *length, carom_error *error);
/** Releases the text. */
CAROM_API void carom_scene_text_destroy(char *text);

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

/** A part of the picture drawn again, enlarged, in a corner [figure 5]. */
typedef struct carom_inset {
	carom_vec2 min;  /**< m, its lower left corner */
	carom_vec2 size; /**< m, > 0 */
} carom_inset;

/** How to draw. Start from carom_default_render_def(). */
typedef struct carom_render_def {
	uint32_t width;      /**< pixels, 1..16384; default 1280 */
	uint32_t height;     /**< pixels, 1..16384; default 720 */
	bool has_camera;     /**< default false: the room, or where there is none the bodies, and places they are joined with, fill the picture */
	carom_camera camera; /**< if has_camera */
	bool has_inset;      /**< default false: no part is enlarged */
	carom_inset inset;   /**< if has_inset */
} carom_render_def;

/** The defaults above. */
CAROM_API carom_render_def carom_default_render_def(void);
/** The camera with which carom_world_render would draw `def` now: its own, or one that shows the room, or where there is none the bodies. The pictures of
 * a film share one; without it bodies that move all the same way would seem to stand still. */
CAROM_API carom_status carom_world_fit_camera(carom_world *world, const carom_render_def *def, carom_camera *camera, carom_error *error);
/** Draws the present state, rods as lines below the bodies, into `pixels`: height rows of width RGBA bytes, from the top, opaque. The caller owns them; where it fails, some may have been written. What there
 * is no room for at once is drawn in passes, one over the other, and gives the same picture. CAROM_LIMIT: bodies lie so thickly over one
 * another that the lists of those in each tile of pixels have no room. */
CAROM_API carom_status carom_world_render(carom_world *world, const carom_render_def *def, uint8_t *pixels, carom_error *error);
/** Writes RGBA pixels, rows from the top, as a PNG file; whole or not at all. */
CAROM_API carom_status carom_png_write(const char *path, const uint8_t *pixels, uint32_t width, uint32_t height, carom_error *error);

/* ---- Files -------------------------------------------------------------------------------------------------- */

/** A file being written: until it is whole, what was there before stays, unless that is a device, a pipe or an open descriptor. */
typedef struct carom_file carom_file;
/** Begins a file under a temporary name beside `path`; writes go to *stream. Symbolic links are followed. What is there and no file, a device or a
 * pipe, is written into, and so is an open descriptor of this process that has a name: /dev/stdout, /dev/fd/N. All that write files do so. */
CAROM_API carom_status carom_file_create(const char *path, carom_file **file, FILE **stream, carom_error *error);
/** Flushes and renames it to its own name; on failure what was there before stays, if it was a file. Either way the file is released. */
CAROM_API carom_status carom_file_commit(carom_file *file, carom_error *error);
/** Gives it up and removes the temporary file. */
CAROM_API void carom_file_destroy(carom_file *file);

#ifdef __cplusplus
}
#endif
#endif
