/* What several test programs need: devices to run on, and random bodies. */
#ifndef SCENERY_H
#define SCENERY_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "carom.h"

/* The devices every test runs on: the CPU fallback, and OpenCL with each kind of storage. */
typedef struct scenery_device {
	const char *name;
	carom_storage storage;
} scenery_device;

extern const scenery_device scenery_devices[];
extern const size_t scenery_device_count;

/* The default def, with the paper's step. */
carom_world_def scenery_first_impact(void);

/* A world on that device, or the test fails with what the library says. NULL where there is no OpenCL device, which is
 * said, and is a failure where the environment's CAROM_NO_SKIP is set. */
carom_world *scenery_world(const carom_world_def *def, const scenery_device *device);

/* What OpenCL built for the last eight of these is kept until the program ends, for worlds to come, or until it is forgotten here. */
void scenery_forget_kernels(void);

/* A world of its own for each device: `body` is run once on each. */
#define SCENERY_EACH_DEVICE(device) for (const scenery_device *device = scenery_devices; device < scenery_devices + scenery_device_count; device++)

/* Fails the test with the library's words. */
void scenery_check(carom_status status, const carom_error *error);

/* Numbers that are the same everywhere: uniform in [low, high). */
typedef struct scenery_random {
	uint64_t state;
} scenery_random;
float scenery_uniform(scenery_random *random, float low, float high);

/* `count` bodies of radius 0.3 to 0.5 in random order on a jittered lattice of that pitch (m) about the origin: circles, regular and
 * irregular polygons, some of them static. Only circles or only polygons where `shapes` says so. */
typedef enum scenery_shapes { SCENERY_MIXED, SCENERY_CIRCLES, SCENERY_POLYGONS } scenery_shapes;
void scenery_bodies(scenery_random *random, scenery_shapes shapes, size_t count, float pitch, float speed, carom_body_def *defs);

/* Makes most of the static ones kinematic, with velocities up to so many m/s and rad/s. */
void scenery_drive(scenery_random *random, size_t count, float speed, carom_body_def *defs);

/* Makes the body one of three categories, or of two, and lets it pass through some of them. */
void scenery_filter(scenery_random *random, carom_body_def *def);

/* SCENERY_CROWD of them in a room, in which much is hit; NULL where there is no such device. */
enum { SCENERY_CROWD = 40 };
carom_world *scenery_crowd(const scenery_device *device, uint64_t seed, uint32_t threads);

/* FNV-1a, of a picture say. */
uint64_t scenery_hash(const uint8_t *bytes, size_t size);

/* One body, moving with (vx, vy). */
carom_body_def scenery_circle(float x, float y, float vx, float vy, float radius);
carom_body_def scenery_box(float x, float y, float vx, float vy, float width, float height);

#endif
