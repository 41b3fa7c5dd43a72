/* The step events against the serial queue: as many hits in each step, and everybody where the queue has them. And its bits: the
 * same however the way is cut, for every number of threads and on every device. */
#include <math.h>

#include "forecast.h"
#include "runs.h"

enum { MOST_BODIES = 200, SQUEEZED = 500 /* hits in a step: what is squeezed has as many, which nobody can foretell */ };

typedef struct scene {
	const char *name;
	scenery_shapes shapes;
	size_t count;
	float pitch, speed;
	bool has_room, mixed_restitution;
	float gravity, restitution, friction, time_step;
	bool all_move;
	float driven; /* m/s, rad/s: up to which most of what else is static is kinematic; 0: none */
	bool filtered;
	float damping; /* 1/s, about */
} scene;

static const scene scenes[] = {
	{"20 circles", SCENERY_CIRCLES, 20, 1.2f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.05f, false, 0.0f, false, 0.0f},
	{"200 circles", SCENERY_CIRCLES, 200, 1.15f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, false, 0.0f, false, 0.0f},
	{"circles without a room", SCENERY_CIRCLES, 100, 1.15f, 2.0f, false, false, 0.0f, 1.0f, 0.0f, 0.02f, true, 0.0f, false, 0.0f},
	{"circles that fall", SCENERY_CIRCLES, 100, 1.2f, 3.0f, true, false, -10.0f, 0.8f, 0.0f, 1.0f / 60.0f, false, 0.0f, false, 0.0f},
	{"20 polygons", SCENERY_POLYGONS, 20, 1.2f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.05f, false, 0.0f, false, 0.0f},
	{"120 polygons", SCENERY_POLYGONS, 120, 1.2f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, false, 0.0f, false, 0.0f},
	{"polygons without a room", SCENERY_POLYGONS, 80, 1.1f, 2.0f, false, false, 0.0f, 0.9f, 0.0f, 0.02f, true, 0.0f, false, 0.0f},
	{"polygons that fall", SCENERY_POLYGONS, 60, 1.2f, 3.0f, true, true, -10.0f, 0.3f, 0.0f, 1.0f / 60.0f, false, 0.0f, false, 0.0f},
	{"150 of all kinds", SCENERY_MIXED, 150, 1.2f, 3.0f, true, true, 0.0f, 0.7f, 0.0f, 1.0f / 60.0f, false, 0.0f, false, 0.0f},
	{"all kinds that fall", SCENERY_MIXED, 100, 1.2f, 4.0f, true, true, -3.0f, 0.9f, 0.0f, 0.05f, false, 0.0f, false, 0.0f},
	{"circles that don't bounce", SCENERY_CIRCLES, 100, 1.2f, 3.0f, true, false, 0.0f, 0.0f, 0.0f, 0.02f, false, 0.0f, false, 0.0f},
	{"circles that fall and hardly bounce", SCENERY_CIRCLES, 100, 1.2f, 3.0f, true, false, -10.0f, 0.1f, 0.0f, 1.0f / 60.0f, false, 0.0f, false,
		0.0f},
	{"long steps", SCENERY_MIXED, 60, 1.2f, 4.0f, true, false, -1.0f, 1.0f, 0.0f, 0.2f, false, 0.0f, false, 0.0f},
	{"circles that rub", SCENERY_CIRCLES, 100, 1.15f, 3.0f, true, false, 0.0f, 0.9f, 0.3f, 0.02f, false, 0.0f, false, 0.0f},
	{"polygons that rub", SCENERY_POLYGONS, 80, 1.2f, 3.0f, true, false, 0.0f, 1.0f, 0.5f, 0.02f, false, 0.0f, false, 0.0f},
	{"all kinds that fall and rub", SCENERY_MIXED, 120, 1.15f, 4.0f, true, true, -3.0f, 0.9f, 0.7f, 1.0f / 60.0f, false, 0.0f, false, 0.0f},
	{"circles among kinematic ones", SCENERY_CIRCLES, 100, 1.2f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, false, 2.0f, false, 0.0f},
	{"polygons among kinematic ones", SCENERY_POLYGONS, 80, 1.2f, 3.0f, true, false, -3.0f, 0.9f, 0.0f, 0.02f, false, 2.0f, false, 0.0f},
	{"all kinds that fall and rub, driven", SCENERY_MIXED, 120, 1.15f, 4.0f, true, true, -3.0f, 0.9f, 0.7f, 1.0f / 60.0f, false, 4.0f, false, 0.0f},
	{"circles that pass through some", SCENERY_CIRCLES, 150, 1.1f, 3.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, false, 0.0f, true, 0.0f},
	{"all kinds that fall and pass through some", SCENERY_MIXED, 120, 1.15f, 4.0f, true, true, -3.0f, 0.9f, 0.3f, 1.0f / 60.0f, false, 2.0f, true,
		0.0f},
	{"circles that are damped", SCENERY_CIRCLES, 150, 1.1f, 4.0f, true, false, 0.0f, 1.0f, 0.0f, 0.02f, false, 0.0f, false, 0.5f},
	{"all kinds that fall, rub and are damped", SCENERY_MIXED, 120, 1.25f, 4.0f, true, true, -3.0f, 0.9f, 0.3f, 1.0f / 60.0f, false, 2.0f, false,
		2.0f},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static carom_world_def make(const scene *s, uint64_t seed, carom_body_def *bodies)
{
	const float half = 0.5f * s->pitch * ceilf(sqrtf((float)s->count)) + 0.6f;
	carom_world_def def = s->has_room ? runs_room(half, half) : runs_def();
	scenery_random random = {seed};
	scenery_bodies(&random, s->shapes, s->count, s->pitch, s->speed, bodies);
	if (s->driven > 0.0f)
		scenery_drive(&random, s->count, s->driven, bodies);
	for (size_t i = 0; i < s->count; i++) {
		if (s->filtered)
			scenery_filter(&random, &bodies[i]);
		if (s->mixed_restitution)
			bodies[i].restitution = scenery_uniform(&random, 0.3f, 1.0f);
		if (s->friction > 0.0f)
			bodies[i].friction = scenery_uniform(&random, 0.0f, 2.0f * s->friction);
		if (s->damping > 0.0f) {
			bodies[i].linear_damping = scenery_uniform(&random, 0.0f, 2.0f * s->damping);
			bodies[i].angular_damping = scenery_uniform(&random, 0.0f, 2.0f * s->damping);
		}
		if (s->all_move) { /* towards the middle, or they would fly apart */
			bodies[i].is_static = false;
			bodies[i].velocity.x -= bodies[i].position.x;
			bodies[i].velocity.y -= bodies[i].position.y;
		}
	}
	def.gravity.y = s->gravity;
	def.restitution = s->restitution;
	def.friction = s->friction;
	def.time_step = s->time_step;
	return def;
}

/* How much of a run was looked at. */
typedef struct tally {
	uint64_t steps, hits, held, unsure;
	double needed; /* of what was allowed */
} tally;

static void check_step(tally *sum, const forecast *f, carom_world *world, const scene *s, const scenery_device *device)
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

static void report(const tally *sum, const scene *s, const scenery_device *device)
{
	print_message("%s on %s%s: %llu steps, %llu hits, %llu held; %llu steps not foretold; %.2g of what is allowed\n", s->name, device->name,
		device->storage == CAROM_STORAGE_IMAGE ? " images" : "", (unsigned long long)sum->steps, (unsigned long long)sum->hits,
		(unsigned long long)sum->held, (unsigned long long)sum->unsure, sum->needed);
}

/* From one start, until chaos has made the forecast worthless. */
static void run_as_foretold(const scene *s, const carom_world_def *def, const carom_body_def *bodies, carom_world **worlds)
{
	forecast f = forecast_of(runs_queue(def, bodies, s->count));
	f.counts = s->restitution > 0.0f;
	tally sums[3] = {{0}};
	for (uint64_t i = 0; f.sure && i < runs_affordable(100); i++) {
		forecast_step(&f, (double)def->time_step);
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
		runs_enough(sums[d].hits > 30);
		carom_world_destroy(worlds[d]);
	}
	forecast_destroy(&f);
}

static void runs_as_foretold(void **unused)
{
	(void)unused;
	assert_true(scenery_device_count <= 3);
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, (uint64_t)(s - scenes) + 1, bodies);
		carom_world *worlds[3] = {NULL};
		SCENERY_EACH_DEVICE(device)
			worlds[device - scenery_devices] = runs_world(&def, device, bodies, s->count);
		run_as_foretold(s, &def, bodies, worlds);
	}
}

/* Each step by itself, from where the library is: so thousands of hits can be foretold. All devices are where the first one is. */
static void follow(const scene *s, const carom_world_def *def, const carom_body_def *bodies, carom_world *world, carom_world *other,
	const scenery_device *device)
{
	forecast f = forecast_of(runs_queue(def, bodies, s->count));
	f.counts = s->restitution > 0.0f;
	tally sum = {0};
	bool squeezes = false;
	for (uint64_t i = 0; i < runs_affordable(40); i++) {
		if (squeezes) {
			runs_step(world, 1);
		} else {
			forecast_follow(&f, world);
			forecast_step(&f, (double)def->time_step);
			check_step(&sum, &f, world, s, device);
			squeezes = !f.sure && f.middle->hit_count >= SQUEEZED;
		}
		if (other)
			runs_step(other, 1);
		if (other && runs_hash(other) != runs_hash(world))
			fail_msg("%s, step %llu: the bits differ from device to device", s->name, (unsigned long long)i);
	}
	report(&sum, s, device);
	runs_enough(sum.hits > 20);
	forecast_destroy(&f);
}

static void each_step_is_as_foretold(void **unused)
{
	(void)unused;
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, (uint64_t)(s - scenes) + 100, bodies);
		carom_world *first = runs_world(&def, &scenery_devices[0], bodies, s->count);
		carom_world *second = runs_world(&def, &scenery_devices[scenery_device_count - 1], bodies, s->count);
		if (first || second)
			follow(s, &def, bodies, first ? first : second, first ? second : NULL, &scenery_devices[first ? 0 : scenery_device_count - 1]);
		carom_world_destroy(first);
		carom_world_destroy(second);
	}
}

/* ---- Bits */

static void devices_and_calls_change_no_bit(void **unused)
{
	(void)unused;
	const uint64_t steps = runs_affordable(20);
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, 7, bodies);
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			for (int cut = 0; cut < 3; cut++) {
				carom_world *world = runs_world(&def, device, bodies, s->count);
				if (world)
					runs_same_hash(&first, runs_hash_after(world, steps, cut == 0 ? 1 : cut == 1 ? 2 : steps), device);
			}
		}
	}
}

static void threads_change_no_bit(void **unused)
{
	(void)unused;
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		carom_world_def def = make(s, 8, bodies);
		uint64_t first = 0;
		for (uint32_t threads = 1; threads <= 3; threads++) {
			def.threads = threads;
			carom_world *world = runs_world(&def, &scenery_devices[0], bodies, s->count);
			if (world)
				runs_same_hash(&first, runs_hash_after(world, runs_affordable(60), 1), &scenery_devices[0]);
		}
	}
}

/* To 0.777 s, no whole number of steps, in one call and seven steps at a time; two time steps. */
static void advancing_in_pieces_changes_no_bit(void **unused)
{
	(void)unused;
	for (int length = 0; length < 2; length++) {
		carom_body_def bodies[MOST_BODIES];
		carom_world_def def = make(&scenes[8], 9, bodies);
		uint64_t first = 0, hits = 0;
		def.time_step = length ? 0.01f : 0.0371f;
		SCENERY_EACH_DEVICE(device) {
			for (int pieces = 0; pieces < 2; pieces++) {
				carom_world *world = runs_world(&def, device, bodies, scenes[8].count);
				carom_report done = {.steps = 1};
				carom_error error;
				if (!world)
					break;
				uint64_t sum = 0;
				for (; done.steps > 0; sum += done.hits)
					scenery_check(carom_world_advance_to(world, 0.777, pieces ? 7 : UINT64_MAX, &done, &error), &error);
				runs_near(carom_world_time(world), 0.777, 1e-9);
				assert_true(hits == 0 || hits == sum);
				hits = sum;
				runs_same_hash(&first, runs_hash_after(world, 0, 1), device);
			}
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(runs_as_foretold), cmocka_unit_test(each_step_is_as_foretold),
		cmocka_unit_test(devices_and_calls_change_no_bit), cmocka_unit_test(threads_change_no_bit),
		cmocka_unit_test(advancing_in_pieces_changes_no_bit)};
	return cmocka_run_group_tests_name("events", tests, NULL, NULL);
}
