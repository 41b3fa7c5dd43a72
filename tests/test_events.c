/* The step events against the serial queue: as many hits in each step, and everybody where the queue has them. And its bits: the
 * same however the way is cut, for every number of threads and on every device. */
#include <math.h>

#include "foretold.h"
#include "runs.h"

enum { MOST_BODIES = 200 };

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

static foretold_scene foretold_of(const scene *s, const carom_world_def *def, const carom_body_def *bodies)
{
	return (foretold_scene){s->name, def, bodies, s->count, s->restitution > 0.0f};
}

static void runs_as_foretold(void **unused)
{
	(void)unused;
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, (uint64_t)(s - scenes) + 1, bodies);
		const foretold_scene foretold = foretold_of(s, &def, bodies);
		runs_enough(foretold_run(&foretold, runs_affordable(100)) > 30);
	}
}

static void each_step_is_as_foretold(void **unused)
{
	(void)unused;
	for (const scene *s = scenes; s < scenes + SCENES; s++) {
		carom_body_def bodies[MOST_BODIES];
		const carom_world_def def = make(s, (uint64_t)(s - scenes) + 100, bodies);
		const foretold_scene foretold = foretold_of(s, &def, bodies);
		runs_enough(foretold_follow(&foretold, runs_affordable(40)) > 20);
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
