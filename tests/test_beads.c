/* Light beads on rods, ropes and springs that bear heavy things: what tension holds them aside with is too fast for a step. They stay where they belong, with the same bits on every device, and
 * get no energy and no momentum from that.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "joined.h"

enum { BEADS = 20 };
#define LENGTH 0.22f /* m, from bead to bead */
#define BEAD 0.01f   /* kg */
#define STIFFNESS 1e5f

/* From that end of a line that leans by an angle from straight down; behind the beads a ball. It is held at (0, 0), or swings freely. */
typedef struct line {
	carom_joint_kind kind;
	float mass;    /* kg, of the ball */
	float angle;   /* rad */
	float gravity; /* m/s^2 */
	float turning; /* rad/s, about (0, 0) */
	bool held;
} line;

static carom_world *line_create(const scenery_device *device, line of)
{
	const float x = LENGTH * sinf(of.angle), y = -LENGTH * cosf(of.angle);
	const carom_world_def def = joined_free(of.gravity);
	carom_body_def bodies[BEADS + 1];
	carom_joint joints[BEADS + 1];
	size_t count = 0;
	for (int i = 0; i <= BEADS; i++) {
		const float n = (float)i + 1.0f;
		bodies[i] = scenery_circle(x * n, y * n, -of.turning * y * n, of.turning * x * n, i < BEADS ? 0.05f : 0.1f);
		bodies[i].mass = i < BEADS ? BEAD : of.mass;
		if (i == 0 && !of.held)
			continue;
		joints[count] = joined_rod((uint32_t)i, i - 1, 0.0f, 0.0f);
		joints[count].kind = of.kind;
		joints[count].stiffness = of.kind == CAROM_SPRING ? STIFFNESS : 0.0f;
		count++;
	}
	carom_world *world = runs_world(&def, device, bodies, BEADS + 1);
	if (world)
		joined_set(world, count, joints);
	return world;
}

/* They swing by half a radian, in whole steps and in parts of them. */
static void beads_bear(void **unused)
{
	static const struct {
		carom_joint_kind kind;
		float mass;
		double slack; /* m: of a spring twice what the weight draws it by, and what the swing does */
	} cases[] = {{CAROM_DISTANCE, 0.8f, 2e-4}, {CAROM_DISTANCE, 5.0f, 5e-4}, {CAROM_DISTANCE, 20.0f, 1e-2}, {CAROM_ROPE, 5.0f, 3e-3},
		{CAROM_SPRING, 0.8f, 2.2e-4}, {CAROM_SPRING, 5.0f, 1.2e-3}};
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = line_create(device,
				(line){.kind = cases[i].kind, .mass = cases[i].mass, .angle = 0.5f, .gravity = RUNS_GRAVITY, .held = true});
			if (!world)
				continue;
			for (int k = 0; k < 12; k++) {
				if (k < 6)
					runs_step(world, 15);
				else
					runs_advance(world, 0.25 + 0.003 * k);
				assert_true(joined_slack(world) < cases[i].slack);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Nothing holds what turns about itself. */
static void free_beads_keep_momentum_and_energy(void **unused)
{
	static const carom_joint_kind kinds[] = {CAROM_DISTANCE, CAROM_ROPE};
	(void)unused;
	for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = line_create(device, (line){.kind = kinds[i], .mass = 20.0f, .turning = 3.0f});
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			runs_step(world, 600);
			const carom_measure after = runs_measure(world);
			runs_near(after.kinetic_energy / before.kinetic_energy, 1.0, 1e-5);
			runs_near(after.angular_momentum / before.angular_momentum, 1.0, 1e-5);
			runs_near(after.momentum_x, before.momentum_x, 1e-3);
			runs_near(after.momentum_y, before.momentum_y, 1e-3);
			assert_true(joined_slack(world) < 1e-4);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(beads_bear),
		cmocka_unit_test(free_beads_keep_momentum_and_energy),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
