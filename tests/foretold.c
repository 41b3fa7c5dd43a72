/* SPDX-License-Identifier: MIT */
#include "foretold.h"

#include <math.h>

#include "forecast.h"
#include "runs.h"

enum { SQUEEZED = 500 /* hits in a step: what is squeezed has as many, which nobody can foretell */, MOST_DEVICES = 3 };

/* How much of a run was looked at. */
typedef struct tally {
	uint64_t steps, hits, held, unsure;
	double needed; /* of what was allowed */
} tally;

static void check_step(tally *sum, const forecast *f, carom_world *world, const foretold_scene *s, const scenery_device *device)
{
	const carom_report report = runs_step(world, 1);
	char what[128];
	snprintf(what, sizeof what, "%s on %s, step %llu", s->name, device->name, (unsigned long long)sum->steps + sum->unsure);
	sum->needed = fmax(sum->needed, forecast_check(f, world, what));
	if (!f->sure) {
		sum->unsure++;
		return;
	}
	if (f->counts && (report.hits != f->middle->hit_count || report.ruled != f->middle->ruled || report.held != f->middle->held)) {
		forecast_print(f);
		fail_msg("%s: %llu hits, %llu ruled and %llu held, foretold were %zu, %zu and %zu", what, (unsigned long long)report.hits,
			(unsigned long long)report.ruled, (unsigned long long)report.held, f->middle->hit_count, f->middle->ruled, f->middle->held);
	}
	sum->steps++;
	sum->hits += report.hits;
	sum->held += report.held;
}

static void report(const tally *sum, const foretold_scene *s, const scenery_device *device)
{
	print_message("%s on %s%s: %llu steps, %llu hits, %llu held; %llu steps not foretold; %.2g of what is allowed\n", s->name, device->name,
		device->storage == CAROM_STORAGE_IMAGE ? " images" : "", (unsigned long long)sum->steps, (unsigned long long)sum->hits,
		(unsigned long long)sum->held, (unsigned long long)sum->unsure, sum->needed);
}

static forecast forecast_for(const foretold_scene *s)
{
	forecast f = forecast_of(runs_queue(s->def, s->bodies, s->count));
	f.counts = s->counts;
	return f;
}

uint64_t foretold_run(const foretold_scene *s, uint64_t steps)
{
	forecast f = forecast_for(s);
	carom_world *worlds[MOST_DEVICES] = {NULL};
	tally sums[MOST_DEVICES] = {{0}};
	uint64_t fewest = UINT64_MAX;
	assert_true(scenery_device_count <= MOST_DEVICES);
	SCENERY_EACH_DEVICE(device)
		worlds[device - scenery_devices] = runs_world(s->def, device, s->bodies, s->count);
	for (uint64_t i = 0; f.sure && i < steps; i++) {
		forecast_step(&f, (double)s->def->time_step);
		SCENERY_EACH_DEVICE(device) {
			const size_t d = (size_t)(device - scenery_devices);
			if (worlds[d])
				check_step(&sums[d], &f, worlds[d], s, device);
		}
	}
	SCENERY_EACH_DEVICE(device) {
		const size_t d = (size_t)(device - scenery_devices);
		if (!worlds[d])
			continue;
		report(&sums[d], s, device);
		fewest = sums[d].hits < fewest ? sums[d].hits : fewest;
		carom_world_destroy(worlds[d]);
	}
	forecast_destroy(&f);
	return fewest;
}

static uint64_t follow(const foretold_scene *s, uint64_t steps, carom_world *world, carom_world *other, const scenery_device *device)
{
	forecast f = forecast_for(s);
	tally sum = {0};
	bool squeezes = false;
	for (uint64_t i = 0; i < steps; i++) {
		if (squeezes) {
			runs_step(world, 1);
		} else {
			forecast_follow(&f, world);
			forecast_step(&f, (double)s->def->time_step);
			check_step(&sum, &f, world, s, device);
			squeezes = !f.sure && f.middle->hit_count >= SQUEEZED;
		}
		if (other)
			runs_step(other, 1);
		if (other && runs_hash(other) != runs_hash(world))
			fail_msg("%s, step %llu: the bits differ from device to device", s->name, (unsigned long long)i);
	}
	report(&sum, s, device);
	forecast_destroy(&f);
	return sum.hits;
}

uint64_t foretold_follow(const foretold_scene *s, uint64_t steps)
{
	const scenery_device *first = scenery_devices, *last = scenery_devices + scenery_device_count - 1;
	carom_world *world = runs_world(s->def, first, s->bodies, s->count), *other = runs_world(s->def, last, s->bodies, s->count);
	uint64_t hits = UINT64_MAX;
	if (world || other)
		hits = follow(s, steps, world ? world : other, world ? other : NULL, world ? first : last);
	carom_world_destroy(world);
	carom_world_destroy(other);
	return hits;
}
