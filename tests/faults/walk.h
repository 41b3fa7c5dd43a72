/* A small run gone through again and again, each time with another call that fails.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_WALK_H
#define CAROM_TESTS_WALK_H

#include "faults.h"
#include "scenery.h"

/* Judges an error, given the name of the call that failed. */
typedef void walk_judge(const char *call, carom_status status, const carom_error *error);

/* Reads a scene, makes a world and draws it: the n-th call of the kind fails, for every n. Nothing may be left over, and what could not be
 * drawn can be, when it is tried again. False where there is no such device. */
bool walk_opening(const scenery_device *device, const char *step, faults_kind kind, walk_judge *judge);

/* Steps, measures, hashes, writes and draws a world that has no textures yet, likewise. After a failure the state is that after the
 * steps that are reported, files are as they were before, and what failed works when it is tried again. */
void walk_running(const scenery_device *device, const char *step, faults_kind kind, walk_judge *judge);

/* The first steps of events alone, whose lists of neighbours are too small and grow, likewise. False where there is no such device. */
bool walk_growing(const scenery_device *device, faults_kind kind, walk_judge *judge);

/* Bodies of a world that goes on are changed and read, and it takes a step, likewise. False where there is no such device. */
bool walk_steering(const scenery_device *device, faults_kind kind, walk_judge *judge);

/* Bodies of such a world go and others come, between its steps, likewise. False where there is no such device. */
bool walk_roster(const scenery_device *device, faults_kind kind, walk_judge *judge);

/* The code that the n-th call gives. */
int walk_code(uint64_t nth);

/* A folder for the files. */
int walk_make_folder(void **state);
int walk_remove_folder(void **state);

#endif
