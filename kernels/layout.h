/* The facts that the OpenCL kernels and the CPU stages share: where each number lies in which texture, and the constants
 * of the numerical rules. No maths here: each side has its own (see CONTRACT.md). */
#ifndef CAROM_LAYOUT_H
#define CAROM_LAYOUT_H

/* Textures of one texel a body are folded into rows of this many texels; up to 4,096 bodies they are the paper's 2^n x 1. */
#define ROW_LOG2 12
#define ROW_SIZE (1 << ROW_LOG2)

/* Linear [2]: state */
#define LINEAR_X 0  /* m */
#define LINEAR_Y 1
#define LINEAR_VX 2 /* m/s */
#define LINEAR_VY 3

/* Rotational [2]: state, and a constant that the broad phase wants beside it */
#define ROTATIONAL_ANGLE 0    /* rad, in [-pi, pi] */
#define ROTATIONAL_VELOCITY 1 /* rad/s */
#define ROTATIONAL_RADIUS 2   /* m, of the circle about the centre of mass that holds the body; constant */

/* Geometry [2] */
#define GEOMETRY_FIRST 0   /* index of the body's first texel in Vertices */
#define GEOMETRY_COUNT 1   /* of vertices; 1 for a circle */
#define GEOMETRY_MASS 2    /* kg; infinite for a static body */
#define GEOMETRY_INERTIA 3 /* kg m^2; infinite for a static body */

/* Vertices [2]: two vertices a texel, counter-clockwise, about the centre of mass; a body begins at a new texel. A
 * circle's only vertex is (radius, 0). */
#define VERTICES_X0 0
#define VERTICES_Y0 1
#define VERTICES_X1 2
#define VERTICES_Y1 3

/* Forces: what acts on a body besides gravity, and its restitution */
#define FORCES_X 0 /* N */
#define FORCES_Y 1
#define FORCES_TORQUE 2 /* N m */
#define FORCES_RESTITUTION 3

/* Uniforms: what is the same for every body; three texels in a row */
#define UNIFORMS_WIDTH 3
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
#define UNIFORMS_RULES 2 /* texel */
#define RULES_EPSILON 0    /* accuracy of the bisection, part of a step */
#define RULES_ITERATIONS 1 /* bisections a pass */
#define RULES_HAS_ROOM 2   /* 0 or 1 */
#define RULES_RESTITUTION 3 /* of the walls */

/* Clock: how far the simulation is; four texels in a row, ping-pong */
#define CLOCK_WIDTH 4
#define CLOCK_HIT 0 /* texel: the first hit of the step */
#define HIT_TIME 0  /* part of the step, NO_HIT if there is none */
#define HIT_ROW 1   /* body A */
#define HIT_COLUMN 2 /* body B, or -1 - wall */
#define HIT_DONE 3  /* 1: a hit; 0: only a pause, the search goes on in the next step */
#define CLOCK_STEP 1 /* texel */
#define STEP_LENGTH 0   /* s that the step could last */
#define STEP_ADVANCED 1 /* s that it lasted */
#define STEP_STALLED 2  /* steps in a row that did not get on */
#define STEP_ENDED 3    /* 1 once time has stalled */
#define CLOCK_TIME 2 /* texel: sums of two floats, high and low part */
#define TIME_ELAPSED 0
#define TIME_ELAPSED_LOW 1
#define TIME_REMAINING 2
#define TIME_REMAINING_LOW 3
#define CLOCK_COUNTS 3 /* texel */
#define COUNTS_STEPS 0
#define COUNTS_HITS 1

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
#define TILES_NOW 1         /* a pair overlaps in this step */
#define TILES_BEFORE 2      /* one did in the step before: HitTimes holds something old */
#define TILES_LONG_BEFORE 4 /* one did two steps ago: so does the Overlap that is overwritten */
#define OVERLAP_GROUP 4     /* tiles, one above the other, that a work-item of the overlap slot does */

/* HitTimes [2.1], row i, column j < i; what is not written in a step is NO_HIT from the steps before */
#define HITTIMES_MIN 0  /* the interval that encloses the hit */
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

/* Impulse [2.3]: of the first hit; +J acts on A, -J on B */
#define IMPULSE_X 0 /* N s */
#define IMPULSE_Y 1
#define IMPULSE_TORQUE_A 2 /* N m s about A's centre of mass */
#define IMPULSE_TORQUE_B 3 /* of -J about B's */

/* Numerical rules */
#define SLOP 9.5367431640625e-7f     /* 2^-20: bodies this far apart touch, as a part of the coordinates' size: eight units in the last place */
#define APPROACH 9.5367431640625e-7f /* 2^-20: a slower approach, as a part of the speeds, is lost in rounding and is none */
#define SEARCH_LIMIT 64              /* steps of one search for a hit; what is not found by then pauses */
#define CREEP_MOST 0.000244140625f   /* 2^-12 and 2^-20 of a step: from a contact that does not approach a search goes on for */
#define CREEP_LEAST 9.5367431640625e-7f /* the time in which the bodies move by no more than the slop, between these two */
#define STALL_LENGTH 9.5367431640625e-7f /* 2^-20 of the time step: a step that lasts less did not get on */
#define STALL_LIMIT 4096             /* of those in a row, and 16 a body, are a stall */
#define STALL_LIMIT_BODY 16
#define SINGULAR 0.000244140625f     /* 2^-12: two contacts nearer to one another than this, by the determinant, count as one */

/* Sine and cosine: pi/2 in three parts, and minimax polynomials on [-pi/4, pi/4] (Cephes) */
#define LARGEST_TURN 1073741824.0f /* 2^30: a larger number of quarter turns has no fraction left, and counts as 0 */
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
