/* Whatever comes of a wild world, it is the same on every device, with any number of threads, in however many slices, when a run stops and goes on, and whoever looks at whom. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "layout.h"
#include "runs.h"
#include "step/events.h"
#include "wild.h"

/* What a run came to. */
typedef struct outcome {
	uint64_t hash, hits, ruled, held;
} outcome;

static void go_on(carom_world *world, uint32_t steps, uint32_t calls, outcome *o)
{
	for (uint32_t i = 0; i < calls; i++) {
		const carom_report report = runs_step(world, steps / calls);
		o->hits += report.hits;
		o->ruled += report.ruled;
		o->held += report.held;
	}
}

static outcome end(carom_world *world, outcome o)
{
	o.hash = runs_hash(world);
	carom_world_destroy(world);
	return o;
}

/* This, like those that follow, destroys the world. */
static outcome run(carom_world *world, uint32_t steps, uint32_t calls)
{
	outcome o = {0};
	go_on(world, steps, calls, &o);
	return end(world, o);
}

/* Written to a scene half of the way, and read again. */
static outcome run_in_halves(carom_world *world, uint32_t steps)
{
	char path[] = "/tmp/carom-wild-XXXXXX";
	carom_error error;
	carom_scene *scene = NULL;
	outcome o = {0};
	const int file = mkstemp(path);
	assert_true(file >= 0 && close(file) == 0);
	go_on(world, steps / 2, 1, &o);
	scenery_check(carom_world_write_scene(world, NULL, path, &error), &error);
	carom_world_destroy(world);
	scenery_check(carom_scene_read(path, &scene, &error), &error);
	assert_int_equal(unlink(path), 0);
	scene->world.device = "cpu";
	scenery_check(carom_scene_create_world(scene, &world, &error), &error);
	carom_scene_destroy(scene);
	go_on(world, steps - steps / 2, 1, &o);
	return end(world, o);
}

/* With new lists for each step, so that all look at each other in it. */
static outcome run_looking(carom_world *world, uint32_t steps)
{
	outcome o = {0};
	for (uint32_t i = 0; i < steps; i++) {
		carom_events_drop_lists(world);
		go_on(world, 1, 1, &o);
	}
	return end(world, o);
}

/* Each step falls into so many slices, as where it is crowded. */
static outcome run_in_slices(carom_world *world, uint32_t steps, uint32_t slices)
{
	outcome o = {0};
	for (uint32_t i = 0; i < steps; i++) {
		world->events.slices = slices;
		go_on(world, 1, 1, &o);
	}
	return end(world, o);
}

/* What `wild_change` does before each step; `anew`: and then all are loaded anew. */
static outcome run_steered(carom_world *world, uint32_t steps, bool anew)
{
	const float time_step = carom_world_get_def(world)->time_step;
	outcome o = {0};
	for (uint32_t i = 0; i < steps; i++) {
		wild_change(world, i, time_step);
		if (anew)
			runs_load_anew(world);
		go_on(world, 1, 1, &o);
	}
	return end(world, o);
}

static void check_same(const outcome *first, outcome found, const scenery_device *device, const char *how)
{
	if (found.hash != first->hash || found.hits != first->hits || found.ruled != first->ruled || found.held != first->held)
		fail_msg("%s%s, %s: hash %016llx, %llu hits, %llu ruled, %llu held; at first it was %016llx, %llu, %llu, %llu", device->name,
			device->storage == CAROM_STORAGE_IMAGE ? " images" : "", how, (unsigned long long)found.hash, (unsigned long long)found.hits,
			(unsigned long long)found.ruled, (unsigned long long)found.held, (unsigned long long)first->hash, (unsigned long long)first->hits,
			(unsigned long long)first->ruled, (unsigned long long)first->held);
}

/* On one thread of the CPU fallback, and in all other ways. */
static void check_one_outcome(wild_world *wild, uint32_t steps)
{
	const scenery_device *cpu = scenery_devices;
	const uint32_t slices = 2 + wild->count % (SLICES_MOST - 1);
	wild->def.threads = 1;
	const outcome first = run(wild_create(wild, cpu), steps, 1);
	print_message("%u bodies, %u joints, %llu hits\n", (unsigned)wild->count, (unsigned)wild->joint_count, (unsigned long long)first.hits);
	check_same(&first, run_looking(wild_create(wild, cpu), steps), cpu, "looking each step");
	const outcome steered = run_steered(wild_create(wild, cpu), steps, true);
	check_same(&steered, run_steered(wild_create(wild, cpu), steps, false), cpu, "steered");
	wild->def.threads = 2;
	check_same(&first, run_in_slices(wild_create(wild, cpu), steps, slices), cpu, "in slices");
	check_same(&first, run_in_halves(wild_create(wild, cpu), steps), cpu, "in halves");
	for (; wild->def.threads <= 3; wild->def.threads++)
		check_same(&first, run(wild_create(wild, cpu), steps, steps), cpu, "step by step");
	for (const scenery_device *device = scenery_devices + 1; device < scenery_devices + scenery_device_count; device++) {
		carom_world *world = wild_create(wild, device);
		if (!world)
			continue;
		check_same(&first, run(world, steps, 1), device, "in one go");
		check_same(&first, run_in_slices(wild_create(wild, device), steps, slices), device, "in slices");
	}
}

/* In each of these worlds a pause was found or not, by chance, or a hit upon what was held not found. */
static void wild_worlds_have_one_outcome(void **unused)
{
	(void)unused;
	static const uint64_t seeds[] = {42, 143, 494, 612, 812};
	static wild_world wild;
	for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
		print_message("seed %u: ", (unsigned)seeds[i]);
		wild_make(seeds[i], &wild);
		check_one_outcome(&wild, (uint32_t)runs_affordable(120));
	}
}

/* Here bodies are held, and a hit upon one of them was counted again with what it was lost with. */
static void held_bodies_have_one_count(void **unused)
{
	(void)unused;
	static wild_world wild;
	wild_make_wider(2136, &wild);
	check_one_outcome(&wild, (uint32_t)runs_affordable(60));
}

/* A rod that can't hold has its bodies metres apart, and each is hit in a cluster of its own: whether it passes a hit on depends on how both move by then. */
static void bodies_joined_from_afar_have_one_outcome(void **unused)
{
	(void)unused;
	static wild_world wild;
	wild_make_wider(531, &wild);
	check_one_outcome(&wild, (uint32_t)runs_affordable(60));
}

/* Do bodies come to rest in it, and sleep? */
static bool may_lie(const wild_world *wild)
{
	const char *step = carom_pipeline_get(&wild->def.pipeline, "step");
	return step && !strcmp(step, "contacts") && wild->def.friction > 0.0f && wild->count < 64;
}

/* For so many seconds, from some seed on: `make wild`. */
static void other_worlds_have_one_outcome(void **unused)
{
	(void)unused;
	static wild_world wild;
	const char *limit = getenv("CAROM_WILD_SECONDS"), *from = getenv("CAROM_WILD_SEED");
	const double seconds = limit ? strtod(limit, NULL) : 0.0;
	const time_t begun = time(NULL);
	for (uint64_t seed = from ? strtoull(from, NULL, 10) : 1; difftime(time(NULL), begun) < seconds; seed++) {
		print_message("CAROM_WILD_SEED=%llu: ", (unsigned long long)seed);
		wild_make_wider(seed, &wild);
		if (seed % 2)
			wild_add_watchers(&wild);
		check_one_outcome(&wild, (uint32_t)runs_affordable(may_lie(&wild) ? 240 : 60));
	}
}

int main(void)
{
	const struct CMUnitTest kept[] = {cmocka_unit_test(wild_worlds_have_one_outcome), cmocka_unit_test(held_bodies_have_one_count),
		cmocka_unit_test(bodies_joined_from_afar_have_one_outcome)},
							others[] = {cmocka_unit_test(other_worlds_have_one_outcome)};
	if (getenv("CAROM_WILD_SECONDS"))
		return cmocka_run_group_tests_name("events_wild_others", others, NULL, NULL);
	return cmocka_run_group_tests_name("events_wild", kept, NULL, NULL);
}
