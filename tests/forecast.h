/* What the queue foretells, and how far it can be trusted: it is run again from states that are shaken as rounding might shake
 * them, and where these runs part from one another the library may part too, but by no more than a small multiple.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_FORECAST_H
#define CAROM_TESTS_FORECAST_H

#include "queue.h"

enum { FORECAST_SHAKEN = 6 };

typedef struct forecast {
	queue *middle, *shaken[FORECAST_SHAKEN];
	double (*apart)[2]; /* of each body: m, and m/s, by which the shaken runs were ever off */
	bool *doubtful;     /* bodies that did not have as many events in all of them, or that hit one of these */
	bool sure;          /* none is doubtful, and the runs are still near one another */
	bool counts;        /* events, too: but how many are those of bodies that don't bounce, and stay in touch, rounding decides */
	scenery_random random;
} forecast;

forecast forecast_of(queue *middle);
void forecast_destroy(forecast *f);

/* Begins again from where the world is. */
void forecast_follow(forecast *f, carom_world *world);
void forecast_step(forecast *f, double length);
/* Fails unless the world's bodies are where they were foretold, but for doubtful ones; `what` says which. Gives the
 * largest part of what was allowed that was needed. */
double forecast_check(const forecast *f, carom_world *world, const char *what);
/* The first hits of the last step. */
void forecast_print(const forecast *f);

#endif
