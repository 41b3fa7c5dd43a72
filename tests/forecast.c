/* SPDX-License-Identifier: MIT */
#include "forecast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SHAKE 1e-6      /* at first, of the numbers' size: CONTRACT's slop, by which hits may come early, and some ulp */
#define ROUNDING 2.5e-7 /* in each step and each event: two units in the last place */
#define FAR 1e-2        /* m: what is off by that much may as well hit something else */
#define MARGIN 3.0      /* six runs show the width of what may happen, but not its end */
#define MOST_EVENTS 100000

forecast forecast_of(queue *middle)
{
	middle->skin = 0.75;
	forecast f = {.middle = middle, .sure = true, .counts = true, .random = {42}};
	f.apart = calloc(middle->count, sizeof *f.apart);
	f.doubtful = calloc(middle->count, sizeof *f.doubtful);
	assert_true(f.apart && f.doubtful);
	for (int i = 0; i < FORECAST_SHAKEN; i++) {
		f.shaken[i] = queue_copy(middle);
		f.shaken[i]->skin = (double)i / (FORECAST_SHAKEN - 1); /* a search may end anywhere within the slop */
		queue_shake(f.shaken[i], &f.random, SHAKE);
	}
	return f;
}

void forecast_destroy(forecast *f)
{
	for (int i = 0; i < FORECAST_SHAKEN; i++)
		queue_destroy(f->shaken[i]);
	queue_destroy(f->middle);
	free(f->apart);
	free(f->doubtful);
}

void forecast_follow(forecast *f, carom_world *world)
{
	queue_follow(f->middle, world);
	f->sure = true;
	memset(f->apart, 0, f->middle->count * sizeof *f->apart);
	memset(f->doubtful, 0, f->middle->count * sizeof *f->doubtful);
	for (int i = 0; i < FORECAST_SHAKEN; i++) {
		memcpy(f->shaken[i]->bodies, f->middle->bodies, f->middle->count * sizeof *f->middle->bodies);
		queue_shake(f->shaken[i], &f->random, SHAKE);
	}
}

/* In metres, and metres a second; what is turned counts by how far the body reaches. */
static void off(const exact_body *a, const exact_body *b, double *by)
{
	const double turned = a->count > 1 ? fabs(remainder(a->angle - b->angle, 6.283185307179586)) * a->bound : 0.0;
	by[0] = hypot(a->x - b->x, a->y - b->y) + turned;
	by[1] = hypot(a->vx - b->vx, a->vy - b->vy) + (a->count > 1 ? fabs(a->w - b->w) * a->bound : 0.0);
}

static void look_apart(forecast *f, const queue *shaken)
{
	for (size_t k = 0; k < f->middle->count; k++) {
		const queue_body *expected = &f->middle->bodies[k], *found = &shaken->bodies[k];
		double by[2];
		off(&expected->at, &found->at, by);
		f->apart[k][0] = fmax(f->apart[k][0], by[0]);
		f->apart[k][1] = fmax(f->apart[k][1], by[1]);
		f->doubtful[k] = f->doubtful[k] || by[0] > FAR || (f->counts && found->events != expected->events) || found->held != expected->held;
	}
}

/* Doubt is caught by hitting who has it. */
static void spread_doubt(forecast *f)
{
	for (bool spreads = true; spreads;) {
		spreads = false;
		for (size_t i = 0; i < f->middle->hit_count; i++) {
			const queue_hit *hit = &f->middle->hits[i];
			if (hit->column < 0 || f->doubtful[hit->row] == f->doubtful[hit->column])
				continue;
			if (f->middle->bodies[hit->row].inverse_mass > 0.0 && f->middle->bodies[hit->column].inverse_mass > 0.0)
				f->doubtful[hit->row] = f->doubtful[hit->column] = spreads = true;
		}
	}
	for (size_t k = 0; k < f->middle->count; k++)
		f->sure = f->sure && !f->doubtful[k];
}

void forecast_step(forecast *f, double length)
{
	queue_step(f->middle, length, MOST_EVENTS);
	for (int i = 0; i < FORECAST_SHAKEN; i++) {
		queue *shaken = f->shaken[i];
		queue_shake(shaken, &f->random, ROUNDING);
		shaken->shaken_by = &f->random;
		shaken->rounding = ROUNDING;
		queue_step(shaken, length, MOST_EVENTS);
		f->sure = f->sure && (!f->counts || (shaken->hit_count == f->middle->hit_count && shaken->ruled == f->middle->ruled));
		look_apart(f, shaken);
	}
	spread_doubt(f);
}

void forecast_print(const forecast *f)
{
	const queue *q = f->middle;
	for (size_t i = 0; i < q->hit_count && i < 40; i++)
		print_message("	%.9g: %d %d\n", q->hits[i].time, q->hits[i].row, q->hits[i].column);
}

double forecast_check(const forecast *f, carom_world *world, const char *what)
{
	queue *found = queue_copy(f->middle);
	double most = 0.0;
	queue_follow(found, world);
	for (size_t k = 0; k < found->count; k++) {
		double by[2];
		if (f->doubtful[k])
			continue;
		off(&f->middle->bodies[k].at, &found->bodies[k].at, by);
		for (int i = 0; i < 2; i++) {
			most = fmax(most, by[i] > 0.0 ? by[i] / (MARGIN * f->apart[k][i]) : 0.0);
			if (by[i] <= MARGIN * f->apart[k][i])
				continue;
			forecast_print(f);
			fail_msg("%s: body %zu is off by %.3g m%s, foretold within %.3g", what, k, by[i], i ? "/s" : "", MARGIN * f->apart[k][i]);
		}
	}
	queue_destroy(found);
	return most;
}
