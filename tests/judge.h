/* Judges the stages on a device: each is given the same textures as two others, the CPU's instances in float and in double. */
#ifndef JUDGE_H
#define JUDGE_H

#include "scenery.h"
#include "world.h"

enum { JUDGE_BODIES = 90 }; /* no power of two, and enough for seven levels */

typedef struct judgement {
	carom_world *reference, *oracle, *device; /* CPU in float, CPU in double, the device under test */
	size_t decisions, disputed;               /* hit or no hit: asked, and answered otherwise by the oracle */
	size_t wrong_bits;                        /* texels whose bits differ from the reference */
	size_t wrong_values;                      /* numbers that differ from the oracle by more than rounding */
} judgement;

/* A crowded room with that alternative, in whatever else the stages need. */
carom_world_def judge_arena(const char *slot, const char *alternative);
/* JUDGE_BODIES random bodies of all shapes, some of which overlap, with forces. */
void judge_fill(carom_world *world, uint64_t seed);
/* A world on the CPU's instance in double: what the others are held against. */
carom_world *judge_oracle(const carom_world_def *def);
/* Three steps, stage by stage. False where the device is not there. */
bool judge(const char *slot, const char *alternative, const scenery_device *device, uint64_t seed, judgement *b);

#endif
