/* What is made of many parts, or has light parts that hold heavy ones: iterations may not find its forces in one step. It holds all the same, and gets no energy from that. On every
 * device.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "joined.h"

#define TURN 6.28318530717958648

/* The body is at that angle to the other one, and stays so. */
static carom_joint fixed(uint32_t body, int32_t other, carom_vec2 anchor, carom_vec2 other_anchor, float angle)
{
	carom_joint joint = joined_pin(body, other, anchor.x, anchor.y);
	joint.other_anchor = other_anchor;
	joint.has_stops = true;
	joint.lower_angle = joint.upper_angle = angle;
	return joint;
}

/* ---- A drum, of bars that are fixed to each other and to a spoke, which a motor turns; with balls in it, which pass the spoke */

enum { SIDES = 24, SPOKE = SIDES, ROWS = 9, BALLS = ROWS * ROWS, FIRST_BALL = SPOKE + 1 };
#define RADIUS 3.0
#define SPEED 1.0f

static void set_bar(double angle, float length, carom_body_def *bar)
{
	*bar = scenery_box((float)(RADIUS * cos(angle)), (float)(RADIUS * sin(angle)), 0.0f, 0.0f, 0.1f, length);
	bar->angle = (float)angle;
}

static carom_world *drum(const scenery_device *device)
{
	carom_world_def def = joined_free(RUNS_GRAVITY);
	carom_body_def bodies[FIRST_BALL + BALLS];
	carom_joint joints[SIDES + 3];
	const float half = (float)(RADIUS * tan(0.5 * TURN / SIDES));
	def.restitution = 0.3f;
	def.friction = 0.5f;
	for (int i = 0; i < SIDES; i++) {
		set_bar(i * TURN / SIDES, 2.0f * half, &bodies[i]);
		joints[i] = fixed((uint32_t)i, (i + 1) % SIDES, (carom_vec2){0.0f, half}, (carom_vec2){0.0f, -half},
			(float)(i + 1 < SIDES ? -TURN / SIDES : TURN - TURN / SIDES));
	}
	bodies[SPOKE] = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 2.0f * (float)RADIUS, 0.1f);
	bodies[SPOKE].mask = 0;
	for (int side = 0; side < 2; side++) {
		joints[SIDES + side] = fixed(SPOKE, side * SIDES / 2, (carom_vec2){side ? -(float)RADIUS : (float)RADIUS, 0.0f}, (carom_vec2){0.0f, 0.0f},
			side ? -(float)(0.5 * TURN) : 0.0f);
	}
	joints[SIDES + 2] = joined_pin(SPOKE, CAROM_GROUND, 0.0f, 0.0f);
	joints[SIDES + 2].motor_speed = SPEED;
	joints[SIDES + 2].motor_torque = 1e4f;
	for (int i = 0; i < BALLS; i++)
		bodies[FIRST_BALL + i] = scenery_circle(0.4f * (float)(i % ROWS - ROWS / 2), 0.4f * (float)(i / ROWS - ROWS / 2), 0.0f, 0.0f, 0.17f);
	carom_world *world = runs_world(&def, device, bodies, FIRST_BALL + BALLS);
	if (world)
		joined_set(world, SIDES + 3, joints);
	return world;
}

static void a_drum_turns_what_is_in_it(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = drum(device);
		if (!world)
			continue;
		for (int k = 0; k < 20; k++) {
			runs_step(world, 6);
			assert_true(joined_slack(world) < 0.03);
			if (k > 10)
				runs_near((double)runs_state(world, SPOKE).angular_velocity, (double)SPEED, 0.1);
			for (uint32_t i = FIRST_BALL; i < FIRST_BALL + BALLS; i++) {
				const carom_body_state ball = runs_state(world, i);
				assert_true(hypot((double)ball.position.x, (double)ball.position.y) < RADIUS);
			}
		}
		runs_near((double)runs_state(world, SPOKE).angle, 2.0 * (double)SPEED, 0.1);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- Light parts */

enum { SPOKES = 12 };

/* Blocks about a hub that turns a thousand times as easily as one of them does about it: as heavy on all sides, it hangs as it is. */
static void a_star_on_a_light_hub_gets_no_energy(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = joined_free(RUNS_GRAVITY);
		carom_body_def bodies[SPOKES + 1];
		carom_joint joints[SPOKES + 1];
		bodies[SPOKES] = scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.1f);
		joints[SPOKES] = joined_pin(SPOKES, CAROM_GROUND, 0.0f, 0.0f);
		for (int i = 0; i < SPOKES; i++) {
			set_bar((i + 0.5) * TURN / SPOKES, 0.5f, &bodies[i]);
			joints[i] = fixed((uint32_t)i, SPOKES, (carom_vec2){-(float)RADIUS, 0.0f}, (carom_vec2){0.0f, 0.0f}, bodies[i].angle);
		}
		carom_world *world = runs_world(&def, device, bodies, SPOKES + 1);
		if (!world)
			continue;
		joined_set(world, SPOKES + 1, joints);
		const double begin = runs_energy(world);
		for (int k = 0; k < 10; k++) {
			runs_step(world, 12);
			assert_true(runs_energy(world) < begin + 1e-4);
			assert_true(joined_slack(world) < 0.1);
		}
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- A chain of light links on which something heavy swings; where bodies rub */

enum { MOST_LINKS = 20 };

static carom_world *chain(const scenery_device *device, int links, float length, float link_mass, float mass)
{
	const float angle = 0.5f, x = length * sinf(angle), y = -length * cosf(angle), half = 0.5f * length;
	carom_world_def def = joined_free(RUNS_GRAVITY);
	carom_body_def bodies[MOST_LINKS + 1];
	carom_joint joints[MOST_LINKS + 1];
	def.friction = 0.5f;
	for (int i = 0; i < links; i++) {
		bodies[i] = scenery_box(x * ((float)i + 0.5f), y * ((float)i + 0.5f), 0.0f, 0.0f, 0.1f, length);
		bodies[i].angle = angle;
		bodies[i].mass = link_mass;
		joints[i] = joined_pin((uint32_t)i, i - 1, 0.0f, half);
		joints[i].other_anchor = (carom_vec2){0.0f, i > 0 ? -half : 0.0f};
	}
	bodies[links] = scenery_circle(x * (float)links, y * (float)links, 0.0f, 0.0f, half);
	bodies[links].mass = mass;
	joints[links] = joined_pin((uint32_t)links, links - 1, 0.0f, 0.0f);
	joints[links].other_anchor = (carom_vec2){0.0f, -half};
	carom_world *world = runs_world(&def, device, bodies, (uint32_t)links + 1);
	if (world)
		joined_set(world, (size_t)links + 1, joints);
	return world;
}

/* A hundred times the weight of each link, where a step is short enough for the links' angles; and where it is too long for them, up to a thousand times. */
static void a_chain_of_light_links_bears(void **unused)
{
	static const struct {
		int links;
		float length, link_mass, mass; /* m, kg */
		double slack;                  /* m */
	} cases[] = {{10, 1.0f, 0.1f, 10.0f, 1e-4}, {10, 1.0f, 0.1f, 100.0f, 2e-3}, {20, 0.22f, 0.02f, 5.0f, 1e-3}, {20, 0.22f, 0.02f, 20.0f, 2e-3}};
	(void)unused;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = chain(device, cases[i].links, cases[i].length, cases[i].link_mass, cases[i].mass);
			if (!world)
				continue;
			for (int k = 0; k < 20; k++) {
				runs_step(world, 15);
				assert_true(joined_slack(world) < cases[i].slack);
			}
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* ---- A beam that floats, of bars that are fixed to each other in a row: a ball hits it beside its middle */

#define BARS 40

static carom_world *beam(const scenery_device *device, int bars)
{
	carom_world_def def = joined_free(0.0f);
	carom_body_def bodies[BARS + 1];
	carom_joint joints[BARS];
	for (int i = 0; i < bars; i++) {
		bodies[i] = scenery_box((float)i - 0.5f * (float)(bars - 1), 0.0f, 0.0f, 0.0f, 1.0f, 0.2f);
		joints[i] = fixed((uint32_t)i, i - 1, (carom_vec2){-0.5f, 0.0f}, (carom_vec2){0.5f, 0.0f}, 0.0f);
	}
	bodies[bars] = scenery_circle(0.25f, 1.0f, 0.0f, -1.0f, 0.25f);
	bodies[bars].mass = 0.2f;
	carom_world *world = runs_world(&def, device, bodies, (size_t)bars + 1);
	if (world)
		joined_set(world, (size_t)bars - 1, joints + 1);
	return world;
}

/* (Until 30 November 2026 one of 40 bars had up to eight times the energy after three seconds, and one of 80 twelve times.) */
static void a_long_beam_gets_no_energy(void **unused)
{
	(void)unused;
	for (int bars = BARS / 2; bars <= BARS; bars += BARS / 2) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = beam(device, bars);
			if (!world)
				continue;
			const double begun = runs_energy(world);
			for (uint64_t k = 0; k < runs_affordable(300); k += 3) {
				runs_step(world, 3);
				assert_true(runs_energy(world) < 1.0001 * begun);
			}
			assert_true(joined_slack(world) < 0.01);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_drum_turns_what_is_in_it),
		cmocka_unit_test(a_star_on_a_light_hub_gets_no_energy),
		cmocka_unit_test(a_chain_of_light_links_bears),
		cmocka_unit_test(a_long_beam_gets_no_energy),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
