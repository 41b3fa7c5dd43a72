/* Worlds that run the step events, and what their tests ask of them.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_RUNS_H
#define CAROM_TESTS_RUNS_H

#include "queue.h"
#include "scenery.h"

/* The default world with the step events. */
carom_world_def runs_def(void);
/* With a room about the origin. */
carom_world_def runs_room(float half_width, float half_height);
/* With a room from the ground y = 0 up, gravity, restitution 0.3 and that step. */
#define RUNS_GRAVITY 10.0f /* m/s^2, down */
carom_world_def runs_resting(const char *step, float half_width, float height);
/* With these bodies; NULL where there is no such device. */
carom_world *runs_world(const carom_world_def *def, const scenery_device *device, const carom_body_def *bodies, size_t count);
/* A crowd of bodies of all kinds that fall in the left part of a room, with friction, with a profile; the right one is free from x = 0 on. NULL likewise. */
#define RUNS_CROWD 300
carom_world *runs_crowd(const scenery_device *device, const char *step, bool filtered);
/* A scene of that path, to be changed at will; and its world, without contacts, and by other steps than that without joints; for it the scene is given up; likewise NULL. */
carom_scene *runs_read(const char *path);
carom_world *runs_scene(carom_scene *scene, const scenery_device *device);
/* The queue over the same world. */
queue *runs_queue(const carom_world_def *def, const carom_body_def *bodies, size_t count);

/* All bodies are loaded anew by the next step: there was one more. */
void runs_load_anew(carom_world *world);

carom_report runs_step(carom_world *world, uint64_t steps);
carom_report runs_advance(carom_world *world, double seconds);
carom_body_state runs_state(carom_world *world, uint32_t index);
carom_measure runs_measure(carom_world *world);
/* Kinetic and potential, J. */
double runs_energy(carom_world *world);
/* To be destroyed. */
carom_snapshot *runs_snapshot(carom_world *world);
uint64_t runs_hash(carom_world *world);
/* The hits of the last call, to be given to free. */
carom_hit *runs_hits(carom_world *world, size_t *count);
/* Are they alike to the bit, but for the time? */
bool runs_same_hit(const carom_hit *a, const carom_hit *b);
/* The same hits on every device: *first is NULL before those of the first, which it keeps, to be given to free; others are freed. */
void runs_same_hits(carom_hit **first, size_t *first_count, carom_hit *hits, size_t count);
/* The hash after so many steps, in so many calls; destroys the world. */
uint64_t runs_hash_after(carom_world *world, uint64_t steps, uint64_t calls);

void runs_near(double found, double expected, double tolerance);
/* The same hash on every device: `first` is 0 before the first. */
void runs_same_hash(uint64_t *first, uint64_t hash, const scenery_device *device);

/* So many steps, or a tenth under the sanitizers, which are ten times slower. */
uint64_t runs_affordable(uint64_t steps);
/* Was enough seen? Not asked under the sanitizers, where runs are short. */
void runs_enough(bool enough);

/* Seconds that the process has computed, on all its threads: on a busy machine these are no more. */
double runs_seconds(void);

/* What takes longer hangs; without optimization all takes ten times as long. */
#ifdef __OPTIMIZE__
#define RUNS_SECONDS_MOST 20.0
#else
#define RUNS_SECONDS_MOST 200.0
#endif

#endif
