/* Joints, of the step contacts: what they hold stays where it belongs, and they neither take nor give energy. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runs.h"

/* Without a room, and without loss in hits. */
static carom_world_def free_space(float gravity)
{
	carom_world_def def = carom_default_world_def();
	def.pipeline.step = "contacts";
	def.gravity = (carom_vec2){0.0f, -gravity};
	return def;
}

static carom_joint pin(uint32_t body, int32_t other, float x, float y)
{
	carom_joint joint = carom_default_joint();
	joint.body = body;
	joint.other = other;
	joint.anchor = (carom_vec2){x, y};
	return joint;
}

static carom_joint rod(uint32_t body, int32_t other, float other_x, float other_y)
{
	carom_joint joint = pin(body, other, 0.0f, 0.0f);
	joint.kind = CAROM_DISTANCE;
	joint.other_anchor = (carom_vec2){other_x, other_y};
	return joint;
}

static void set(carom_world *world, size_t count, const carom_joint *joints)
{
	carom_error error;
	scenery_check(carom_world_set_joints(world, count, joints, &error), &error);
}

static void place(carom_world *world, int32_t body, carom_vec2 anchor, double *x, double *y)
{
	const carom_body_state state = body == CAROM_GROUND ? (carom_body_state){.angle = 0.0f} : runs_state(world, (uint32_t)body);
	const double c = cos((double)state.angle), s = sin((double)state.angle);
	*x = (double)state.position.x + c * (double)anchor.x - s * (double)anchor.y;
	*y = (double)state.position.y + s * (double)anchor.x + c * (double)anchor.y;
}

/* How far the worst joint is from where it belongs, m. */
static double slack(carom_world *world)
{
	double worst = 0.0;
	for (size_t k = 0; k < carom_world_joint_count(world); k++) {
		carom_joint joint;
		carom_error error;
		double x, y, other_x, other_y;
		scenery_check(carom_world_get_joints(world, k, 1, &joint, &error), &error);
		place(world, (int32_t)joint.body, joint.anchor, &x, &y);
		place(world, joint.other, joint.other_anchor, &other_x, &other_y);
		worst = fmax(worst, fabs(hypot(x - other_x, y - other_y) - (double)joint.length));
	}
	return worst;
}

static double energy(carom_world *world)
{
	const carom_measure measure = runs_measure(world);
	return measure.kinetic_energy + measure.potential_energy;
}

static double force_of(carom_world *world, size_t k)
{
	carom_joint joint;
	carom_error error;
	scenery_check(carom_world_get_joints(world, k, 1, &joint, &error), &error);
	return hypot((double)joint.force[0], (double)joint.force[1]);
}

/* ---- One pendulum */

/* Let go at an angle, it is back after a period, by a rod or by a pin, and swings as high as before. A rod of 1 m: 2 pi sqrt(1 / g) (1 + a^2 / 16 + 11 a^4 / 3072), and
 * with a mass that is not a point, by I / (m r) in place of 1 m. */
static void a_pendulum_keeps_its_period_and_its_height(void **unused)
{
	(void)unused;
	for (int is_pin = 0; is_pin < 2; is_pin++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const double a = 0.5, r = is_pin ? 0.5 : 1.0, length = is_pin ? (1.0 + 0.2 * 0.2) / 12.0 / r + r : r;
			const double period = 2.0 * 3.14159265358979 * sqrt(length / RUNS_GRAVITY) * (1.0 + a * a / 16.0 + 11.0 * pow(a, 4.0) / 3072.0);
			carom_world_def def = free_space(RUNS_GRAVITY);
			carom_body_def bob = is_pin ? scenery_box((float)(r * sin(a)), (float)(-r * cos(a)), 0.0f, 0.0f, 0.2f, 1.0f)
										: scenery_circle((float)(r * sin(a)), (float)(-r * cos(a)), 0.0f, 0.0f, 0.1f);
			const carom_joint joint = is_pin ? pin(0, CAROM_GROUND, 0.0f, 0.5f) : rod(0, CAROM_GROUND, 0.0f, 0.0f);
			bob.angle = is_pin ? (float)a : 0.0f;
			carom_world *world = runs_world(&def, device, &bob, 1);
			if (!world)
				continue;
			set(world, 1, &joint);
			carom_body_info info;
			carom_error error;
			scenery_check(carom_world_get_body(world, 0, &info, &error), &error);
			const double begin = energy(world), mass = (double)info.mass, range = (double)RUNS_GRAVITY * mass * r * (1.0 - cos(a));
			for (int swing = 1; swing <= 10; swing++) {
				runs_advance(world, period);
				assert_true(slack(world) < 3e-6);
				runs_near(energy(world), begin, 1e-3 * range * swing);
			}
			runs_near((double)runs_state(world, 0).position.x, r * sin(a), 0.02 * r);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What hangs still has the weight on its joint, and stays there. */
static void what_hangs_weighs(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = free_space(RUNS_GRAVITY);
		carom_body_def bodies[3] = {scenery_circle(0.0f, -1.0f, 0.0f, 0.0f, 0.2f), scenery_box(0.0f, -2.0f, 0.0f, 0.0f, 0.2f, 1.0f),
			scenery_circle(3.0f, 0.0f, 0.0f, 0.0f, 0.2f)};
		const carom_joint joints[3] = {rod(0, CAROM_GROUND, 0.0f, 0.0f), pin(1, 0, 0.0f, 0.5f), pin(2, CAROM_GROUND, 0.0f, 0.0f)};
		carom_joint after[3];
		carom_error error;
		for (int i = 0; i < 3; i++)
			bodies[i].mass = (float)(i + 1);
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		set(world, 3, joints);
		runs_step(world, 120);
		for (uint32_t i = 0; i < 3; i++) {
			const carom_body_state state = runs_state(world, i);
			runs_near((double)state.position.x, (double)bodies[i].position.x, 1e-5);
			runs_near((double)state.position.y, (double)bodies[i].position.y, 1e-5);
		}
		scenery_check(carom_world_get_joints(world, 0, 3, after, &error), &error);
		runs_near((double)after[0].force[0], -3.0 * (double)RUNS_GRAVITY, 0.05);
		runs_near((double)after[1].force[1], 2.0 * (double)RUNS_GRAVITY, 0.05);
		runs_near((double)after[2].force[1], 3.0 * (double)RUNS_GRAVITY, 0.05);
		assert_true(after[0].force[1] == 0.0f && after[0].length == 1.0f && after[1].length == 0.0f);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- Chains */

enum { LINKS = 10 };

/* Bars of 1 m from (0, 0) to the right, or balls on rods, that turn about it as one. */
static carom_world *chain(const scenery_device *device, bool of_rods, float gravity, float turning)
{
	carom_world_def def = free_space(gravity);
	carom_body_def bodies[LINKS];
	carom_joint joints[LINKS];
	for (int i = 0; i < LINKS; i++) {
		const float x = of_rods ? (float)i + 1.0f : (float)i + 0.5f;
		bodies[i] = of_rods ? scenery_circle(x, 0.0f, 0.0f, turning * x, 0.2f) : scenery_box(x, 0.0f, 0.0f, turning * x, 1.0f, 0.2f);
		bodies[i].angular_velocity = turning;
		joints[i] = of_rods ? rod((uint32_t)i, i - 1, 0.0f, 0.0f) : pin((uint32_t)i, i - 1, -0.5f, 0.0f);
	}
	carom_world *world = runs_world(&def, device, bodies, LINKS);
	if (world)
		set(world, LINKS, joints);
	return world;
}

/* A chain that turns like a stick goes on so: with tensions of 28 and 40 N, and neither its energy nor its angular momentum changes by a thousandth in 10 s. */
static void a_chain_that_turns_goes_on(void **unused)
{
	(void)unused;
	for (int of_rods = 0; of_rods < 2; of_rods++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = chain(device, of_rods, 0.0f, 2.0f);
			if (!world)
				continue;
			const carom_measure before = runs_measure(world);
			for (int k = 0; k < 10; k++) {
				runs_step(world, 60);
				const carom_measure after = runs_measure(world);
				assert_true(slack(world) < 1e-5);
				runs_near(after.kinetic_energy, before.kinetic_energy, 1e-3 * before.kinetic_energy);
				runs_near(after.angular_momentum, before.angular_momentum, 1e-3 * before.angular_momentum);
			}
			assert_true(force_of(world, 0) > 25.0);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* A chain that falls whips, faster than steps can follow; it holds together, and gets no energy from that. */
static void a_chain_that_falls_holds(void **unused)
{
	(void)unused;
	for (int of_rods = 0; of_rods < 2; of_rods++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = chain(device, of_rods, RUNS_GRAVITY, 0.0f);
			if (!world)
				continue;
			const double begin = energy(world);
			double most = 0.0;
			for (int k = 0; k < 100; k++) {
				runs_step(world, 6);
				most = fmax(most, energy(world) - begin);
				assert_true(slack(world) < 0.1);
			}
			assert_true(most < 0.2);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* Far too fast for the time step: what it can't follow it slows, and nothing flies apart. */
static void what_is_too_fast_loses_energy(void **unused)
{
	(void)unused;
	uint64_t first = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = chain(device, false, 0.0f, 20.0f);
		if (!world)
			continue;
		double before = runs_measure(world).kinetic_energy;
		for (int k = 0; k < 20; k++) {
			runs_step(world, 15);
			const double after = runs_measure(world).kinetic_energy;
			assert_true(after < 1.01 * before);
			before = after;
		}
		assert_true(slack(world) < 0.05);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- What is joined, and what it touches */

enum { PLANKS = 8 };

/* Planks of 1 m between two posts that are 7.6 m apart, and a box on them. */
static carom_world *bridge(const scenery_device *device, float damping)
{
	carom_world_def def = free_space(RUNS_GRAVITY);
	carom_body_def bodies[PLANKS + 3];
	carom_joint joints[PLANKS + 1];
	const carom_body_def plank = scenery_box(0.0f, -0.1f, 0.0f, 0.0f, 1.0f, 0.1f), post = scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.4f, 0.4f);
	def.restitution = 0.0f;
	def.friction = 0.5f;
	def.linear_damping = def.angular_damping = damping;
	for (int i = 0; i < PLANKS; i++) {
		bodies[i] = plank;
		bodies[i].position.x = 0.95f * ((float)i - 3.5f);
		joints[i] = pin((uint32_t)i, i > 0 ? i - 1 : PLANKS, -0.5f, 0.0f);
		joints[i].other_anchor = i > 0 ? (carom_vec2){0.5f, 0.0f} : (carom_vec2){0.2f, 0.0f};
	}
	joints[PLANKS] = pin(PLANKS - 1, PLANKS + 1, 0.5f, 0.0f);
	joints[PLANKS].other_anchor = (carom_vec2){-0.2f, 0.0f};
	for (int side = 0; side < 2; side++) {
		bodies[PLANKS + side] = post;
		bodies[PLANKS + side].position.x = side ? 4.0f : -4.0f;
		bodies[PLANKS + side].is_static = true;
	}
	bodies[PLANKS + 2] = scenery_box(0.3f, 0.6f, 0.0f, 0.0f, 0.8f, 0.8f);
	carom_world *world = runs_world(&def, device, bodies, PLANKS + 3);
	if (world)
		set(world, PLANKS + 1, joints);
	return world;
}

/* Its ends bear what it and the box weigh together, and the box lies on it. */
static void a_bridge_bears(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = bridge(device, 2.0f);
		carom_joint ends[PLANKS + 1];
		carom_error error;
		if (!world)
			continue;
		runs_step(world, 600);
		scenery_check(carom_world_get_joints(world, 0, PLANKS + 1, ends, &error), &error);
		runs_near((double)ends[0].force[1] + (double)ends[PLANKS].force[1], (PLANKS * 0.1 + 0.64) * (double)RUNS_GRAVITY, 0.2);
		for (uint32_t i = 0; i < PLANKS + 3; i++) {
			const carom_body_state state = runs_state(world, i);
			assert_true(fabsf(state.velocity.x) < 0.01f && fabsf(state.velocity.y) < 0.01f);
		}
		assert_true(slack(world) < 1e-4);
		const float height = runs_state(world, PLANKS + 2).position.y;
		assert_true(height < 0.2f && height > -1.5f);
		assert_true(runs_measure(world).max_penetration < 1e-3); /* joined planks overlap, and do not count */
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* A bar that turns about a post in which it is goes on, unless the two collide; and once they are joined no more it flies away. */
static void the_joined_pass_each_other(void **unused)
{
	(void)unused;
	for (int collides = 0; collides < 2; collides++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world_def def = free_space(0.0f);
			carom_body_def bodies[2] = {scenery_box(0.0f, 0.0f, 0.0f, 0.0f, 0.3f, 0.3f), scenery_box(0.5f, 0.0f, 0.0f, 0.5f, 1.0f, 0.1f)};
			carom_joint joint = pin(1, 0, -0.5f, 0.0f);
			bodies[0].is_static = true;
			bodies[1].angular_velocity = 1.0f;
			joint.collides = collides;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			set(world, 1, &joint);
			const uint64_t hits = runs_step(world, 60).hits;
			assert_true((hits > 0) == collides);
			if (!collides)
				runs_near((double)runs_state(world, 1).angle, 1.0, 1e-3);
			set(world, 0, NULL);
			assert_int_equal(carom_world_joint_count(world), 0);
			runs_step(world, 60);
			const carom_vec2 away = runs_state(world, 1).position;
			assert_true(collides || hypotf(away.x, away.y) > 0.6f);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* What is joined with a kinematic body goes where that takes it, and pulls along what is joined with it. */
static void the_kinematic_leads(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = free_space(0.0f);
		carom_body_def bodies[3] = {scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.2f), scenery_circle(1.0f, 0.0f, 0.0f, 0.0f, 0.2f),
			scenery_box(2.5f, 0.0f, 0.0f, 0.0f, 1.0f, 0.2f)};
		carom_joint joints[2] = {rod(1, 0, 0.0f, 0.0f), pin(2, 1, -0.5f, 0.0f)};
		bodies[0].is_kinematic = true;
		bodies[0].velocity.x = -2.0f;
		def.linear_damping = def.angular_damping = 1.0f;
		carom_world *world = runs_world(&def, device, bodies, 3);
		if (!world)
			continue;
		joints[1].other_anchor = (carom_vec2){1.0f, 0.0f};
		set(world, 2, joints);
		runs_step(world, 120);
		runs_near((double)runs_state(world, 0).position.x, -4.0, 1e-4);
		runs_near((double)runs_state(world, 1).position.x, -3.0, 1e-4);
		runs_near((double)runs_state(world, 2).position.x, -1.5, 1e-4);
		assert_true(slack(world) < 1e-5);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* Two boxes on the ground with a rod between them come to rest and sleep; who pushes one wakes both, and so does who takes the rod away. */
static void what_is_joined_sleeps_together(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = runs_resting("contacts", 20.0f, 10.0f);
		carom_body_def bodies[2] = {scenery_box(0.0f, 0.6f, 0.5f, 0.0f, 1.0f, 1.0f), scenery_box(3.0f, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f)};
		const carom_joint joint = rod(1, 0, 0.0f, 0.0f);
		def.friction = 0.5f;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		set(world, 1, &joint);
		runs_step(world, 240);
		const uint64_t hash = runs_hash(world);
		runs_step(world, 60);
		assert_true(runs_hash(world) == hash);
		carom_body_state state = runs_state(world, 0);
		const float before = runs_state(world, 1).position.x;
		carom_error error;
		state.velocity.x = 3.0f;
		scenery_check(carom_world_set_states(world, 0, 1, &state, &error), &error);
		runs_step(world, 30);
		assert_true(runs_state(world, 1).position.x > before + 0.1f);
		assert_true(slack(world) < 1e-4);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* ---- The state, and who changes it */

enum { CROWD = 40 };

/* Bodies of all kinds in a room, each joined with one before it, or with the world. */
static carom_world *tangle(const scenery_device *device, uint64_t seed)
{
	carom_world_def def = runs_resting("contacts", 10.0f, 12.0f);
	carom_body_def bodies[CROWD];
	carom_joint joints[CROWD];
	scenery_random random = {seed};
	size_t count = 0;
	def.friction = 0.4f;
	scenery_bodies(&random, SCENERY_MIXED, CROWD, 1.4f, 2.0f, bodies);
	for (uint32_t i = 0; i < CROWD; i++) {
		bodies[i].position.y += 6.0f;
		const int32_t other = i % 7 == 0 ? CAROM_GROUND : (int32_t)(i - 1);
		if (bodies[i].is_static)
			continue;
		joints[count] = pin(i, other, scenery_uniform(&random, -0.5f, 0.5f), 0.2f);
		if (i % 2) {
			joints[count].kind = CAROM_DISTANCE;
			joints[count].other_anchor = other == CAROM_GROUND ? (carom_vec2){0.0f, 11.0f} : (carom_vec2){0.1f, 0.0f};
		}
		joints[count].collides = i % 3 == 0;
		count++;
	}
	carom_world *world = runs_world(&def, device, bodies, CROWD);
	if (world)
		set(world, count, joints);
	return world;
}

/* Who reads what was written goes on with the same bits: forces are a part of the state. */
static void what_is_written_goes_on(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		carom_world *world = tangle(device, 3), *other;
		carom_scene *scene = NULL;
		carom_error error;
		char *text = NULL;
		size_t length = 0;
		if (!world)
			continue;
		runs_step(world, 40);
		scenery_check(carom_scene_text_create(world, NULL, &text, &length, &error), &error);
		assert_non_null(strstr(text, "{\"kind\": \"revolute\", "));
		assert_non_null(strstr(text, "\"collides\": true"));
		scenery_check(carom_scene_parse(text, length, NULL, &scene, &error), &error);
		carom_scene_text_destroy(text);
		assert_int_equal(scene->joint_count, carom_world_joint_count(world));
		scene->world.device = device->name;
		scene->world.storage = device->storage;
		scenery_check(carom_scene_create_world(scene, &other, &error), &error);
		carom_scene_destroy(scene);
		runs_step(world, 30);
		runs_step(other, 30);
		assert_true(runs_hash(world) == runs_hash(other));
		carom_world_destroy(world);
		carom_world_destroy(other);
	}
}

/* However many threads and calls, in images or buffers, the same bits. */
static void a_tangle_is_the_same_everywhere(void **unused)
{
	(void)unused;
	for (uint64_t seed = 1; seed <= 4; seed++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_world *world = tangle(device, seed);
			if (world)
				runs_same_hash(&first, runs_hash_after(world, 90, seed % 2 ? 1 : 9), device);
		}
	}
}

/* A body takes its joints with it; those of others stay, by their new indices, and the world goes on as one that is made so. */
static void who_goes_takes_its_joints(void **unused)
{
	uint64_t first = 0;
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		static const uint32_t gone[] = {4};
		carom_error error;
		carom_joint before[LINKS], after[LINKS];
		carom_world *world = chain(device, false, RUNS_GRAVITY, 0.0f);
		if (!world)
			continue;
		runs_step(world, 20);
		scenery_check(carom_world_get_joints(world, 0, LINKS, before, &error), &error);
		scenery_check(carom_world_remove(world, gone, 1, &error), &error);
		assert_int_equal(carom_world_joint_count(world), LINKS - 2);
		scenery_check(carom_world_get_joints(world, 0, LINKS - 2, after, &error), &error);
		assert_true(after[3].body == 3 && after[3].other == 2 && after[4].body == 5 && after[4].other == 4);
		assert_memory_equal(after[4].force, before[6].force, sizeof after[4].force);
		runs_step(world, 60);
		assert_true(slack(world) < 1e-3);
		assert_true(runs_state(world, 8).position.y < -5.0f); /* what hung on it falls */
		const carom_body_def more = scenery_circle(20.0f, 0.0f, 0.0f, 0.0f, 0.5f);
		scenery_check(carom_world_add(world, &more, 1, NULL, &error), &error);
		runs_step(world, 10);
		assert_true(slack(world) < 1e-3);
		runs_same_hash(&first, runs_hash(world), device);
		carom_world_destroy(world);
	}
}

/* What is wrong with a joint is said, and nothing is changed. */
static void wrong_joints_are_errors(void **unused)
{
	static const struct {
		const char *text;
		carom_joint joint;
	} cases[] = {
		{"joints[1].kind: found 7, must be", {.kind = (carom_joint_kind)7, .body = 1}},
		{"joints[1].body: found 3, the world has 3 bodies", {.body = 3}},
		{"joints[1].other: found 1, must be the index of another one of 3 bodies", {.body = 1, .other = 1}},
		{"joints[1].other: found -2, must be", {.body = 1, .other = -2}},
		{"joints[1].other: found 3, must be", {.body = 1, .other = 3}},
		{"joints[1]: one of the two must be dynamic, and body 2 is static", {.body = 2, .other = CAROM_GROUND}},
		{"joints[1].anchor: found (2e+09, 0)", {.body = 1, .other = 0, .anchor = {2e9f, 0.0f}}},
		{"joints[1].other_anchor: found (0, inf)", {.body = 1, .other = 0, .other_anchor = {0.0f, INFINITY}}},
		{"joints[1].length: found 0.001, must be a number from 0.01", {.kind = CAROM_DISTANCE, .body = 1, .length = 0.001f}},
		{"joints[1].length: found inf", {.kind = CAROM_DISTANCE, .body = 1, .length = INFINITY}},
		{"joints[1].force: must be two finite numbers (N)", {.body = 1, .other = 0, .force = {0.0f, NAN}}},
	};
	carom_body_def bodies[3] = {
		scenery_circle(0.0f, 0.0f, 0.0f, 0.0f, 0.5f), scenery_circle(2.0f, 0.0f, 0.0f, 0.0f, 0.5f), scenery_circle(4.0f, 0.0f, 0.0f, 0.0f, 0.5f)};
	carom_world_def def = free_space(0.0f);
	carom_error error;
	(void)unused;
	bodies[2].is_static = true;
	carom_world *world = runs_world(&def, scenery_devices, bodies, 3);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const carom_joint joints[2] = {rod(0, 1, 0.0f, 0.0f), cases[i].joint};
		assert_int_equal(carom_world_set_joints(world, 2, joints, &error), CAROM_INVALID_ARGUMENT);
		if (!strstr(error.text, cases[i].text))
			fail_msg("%zu: %s", i, error.text);
		assert_int_equal(carom_world_joint_count(world), 0);
	}
	carom_world_destroy(world);
	def.pipeline.step = "events";
	world = runs_world(&def, scenery_devices, bodies, 3);
	const carom_joint joint = rod(0, 1, 0.0f, 0.0f);
	assert_int_equal(carom_world_set_joints(world, 1, &joint, &error), CAROM_INVALID_ARGUMENT);
	assert_string_equal(error.text, "joints: the step events holds none; take the step contacts");
	scenery_check(carom_world_set_joints(world, 0, NULL, &error), &error);
	carom_world_destroy(world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_pendulum_keeps_its_period_and_its_height),
		cmocka_unit_test(what_hangs_weighs),
		cmocka_unit_test(a_chain_that_turns_goes_on),
		cmocka_unit_test(a_chain_that_falls_holds),
		cmocka_unit_test(what_is_too_fast_loses_energy),
		cmocka_unit_test(a_bridge_bears),
		cmocka_unit_test(the_joined_pass_each_other),
		cmocka_unit_test(the_kinematic_leads),
		cmocka_unit_test(what_is_joined_sleeps_together),
		cmocka_unit_test(what_is_written_goes_on),
		cmocka_unit_test(a_tangle_is_the_same_everywhere),
		cmocka_unit_test(who_goes_takes_its_joints),
		cmocka_unit_test(wrong_joints_are_errors),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
