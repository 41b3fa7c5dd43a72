/* Polygons that are not convex, by the step events, where it is known without a computer what is hit, when, and how. On every device.
 * SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>

#include "concave.h"
#include "runs.h"

static carom_body_def fixed(carom_body_def def)
{
	def.is_static = true;
	return def;
}

/* With its hits. */
static carom_world_def hit_def(float gravity)
{
	carom_world_def def = runs_def();
	def.gravity.y = -gravity;
	def.keep_hits = true;
	return def;
}

static void expect_velocity(carom_world *world, uint32_t index, double x, double y, double tolerance)
{
	const carom_body_state state = runs_state(world, index);
	runs_near((double)state.velocity.x, x, tolerance);
	runs_near((double)state.velocity.y, y, tolerance);
}

/* ---- In a cup */

/* Its centre of mass is at the height of 0: legs 1 wide and 4 high, 2 apart, and a floor between them, 1 high. */
static const carom_vec2 cup[8] = {{-2, -1.7f}, {2, -1.7f}, {2, 2.3f}, {1, 2.3f}, {1, -0.7f}, {-1, -0.7f}, {-1, 2.3f}, {-2, 2.3f}};

/* To and fro between the legs, which come back at it if they may: the speed against each other stays. */
static void ball_in_a_cup(void **unused)
{
	(void)unused;
	for (int is_free = 0; is_free < 2; is_free++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			carom_body_def bodies[2] = {concave_outline(cup, 8), scenery_circle(0.0f, 0.0f, 3.0f, 0.0f, 0.25f)};
			const carom_world_def def = hit_def(0.0f);
			size_t count;
			bodies[0].is_static = !is_free;
			bodies[1].mass = 2.0f;
			bodies[1].position.y = bodies[0].position.y;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			runs_advance(world, 3.0);
			carom_hit *hits = runs_hits(world, &count);
			assert_int_equal(count, 6);
			for (size_t k = 0; k < count; k++) {
				runs_near(hits[k].time, 0.25 + 0.5 * (double)k, 1e-5);
				runs_near((double)hits[k].normal.x, k % 2 ? 1.0 : -1.0, 1e-5);
			}
			free(hits);
			if (is_free)
				runs_near(runs_measure(world).momentum_x, 6.0, 1e-5);
			else
				expect_velocity(world, 1, 3.0, 0.0, 1e-5);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* ---- In a funnel */

static const carom_vec2 funnel[5] = {{-3, -1}, {3, -1}, {3, 3}, {0, 0}, {-3, 3}};

/* Down upon one side, level over to the other one, and up. */
static void ball_in_a_funnel(void **unused)
{
	(void)unused;
	const double g = 10.0, r = 0.5, fall = 2.0, v = sqrt(2.0 * g * fall), over = (sqrt(v * v + 4.0 * g) - v) / g;
	SCENERY_EACH_DEVICE(device) {
		const carom_body_def bodies[2] = {
			fixed(concave_outline(funnel, 5)), scenery_circle(1.0f, (float)(1.0 + r * sqrt(2.0) + fall), 0.0f, 0.0f, (float)r)};
		const carom_world_def def = hit_def(10.0f);
		size_t count;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_advance(world, v / g + over + 0.01);
		carom_hit *hits = runs_hits(world, &count);
		assert_int_equal(count, 2);
		runs_near(hits[0].time, v / g, 2e-6);
		runs_near((double)hits[0].normal.x, -sqrt(0.5), 1e-6);
		runs_near((double)hits[0].point.x, 1.0 + r * sqrt(0.5), 1e-5);
		runs_near(hits[1].time, v / g + over, 2e-6);
		runs_near((double)hits[1].normal.x, sqrt(0.5), 1e-6);
		free(hits);
		/* the speed down becomes one to the right, and the one to the left one up */
		expect_velocity(world, 1, g * over, v - g * 0.01, 1e-4);
		carom_world_destroy(world);
	}
}

/* Upon both sides at once: it goes back where it came from. */
static void ball_in_the_middle_of_a_funnel(void **unused)
{
	(void)unused;
	const double fall = 1.25;
	SCENERY_EACH_DEVICE(device) {
		const carom_body_def bodies[2] = {fixed(concave_outline(funnel, 5)), scenery_circle(0.0f, (float)(0.5 * sqrt(2.0) + fall), 0.0f, 0.0f, 0.5f)};
		const carom_world_def def = hit_def(10.0f);
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_advance(world, 0.6);
		expect_velocity(world, 1, 0.0, 4.0, 1e-3);
		assert_int_equal(carom_world_hit_count(world), 2);
		carom_world_destroy(world);
	}
}

/* ---- In a notch */

static const carom_vec2 notched[6] = {{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}};

/* A box, level with the notch, meets its two sides after 0.3 s and `later`, and flies back; all is turned by an angle. */
static void box_in_a_notch(const scenery_device *device, float later, float angle, uint64_t *hash)
{
	carom_body_def bodies[2] = {fixed(concave_outline(notched, 6)), scenery_box(0.5f + later, 0.8f, -1.0f, -1.0f, 1.0f, 1.0f)};
	const carom_world_def def = hit_def(0.0f);
	const float c = cosf(angle), s = sinf(angle);
	for (int k = 0; k < 2; k++) {
		const carom_vec2 at = bodies[k].position, v = bodies[k].velocity;
		bodies[k].position = (carom_vec2){c * at.x - s * at.y, s * at.x + c * at.y};
		bodies[k].velocity = (carom_vec2){c * v.x - s * v.y, s * v.x + c * v.y};
		bodies[k].angle = angle;
	}
	size_t count;
	carom_world *world = runs_world(&def, device, bodies, 2);
	if (!world)
		return;
	runs_advance(world, 1.0);
	carom_hit *hits = runs_hits(world, &count);
	runs_near(hits[0].time, fmin(0.3, (double)later), 1e-5);
	runs_near(hits[count - 1].time, fmax(0.3, (double)later), 1e-5);
	free(hits);
	assert_true(count == 2);
	expect_velocity(world, 1, (double)(c - s), (double)(c + s), 2e-5);
	runs_near((double)runs_state(world, 1).angular_velocity, 0.0, 1e-4);
	runs_same_hash(hash, runs_hash(world), device);
	carom_world_destroy(world);
}

static void box_flies_into_a_notch(void **unused)
{
	(void)unused;
	static const float laters[] = {0.3f, 0.5f, 0.1f}, angles[] = {0.0f, 0.5f, 2.0f};
	for (size_t i = 0; i < 9; i++) {
		uint64_t hash = 0;
		SCENERY_EACH_DEVICE(device)
			box_in_a_notch(device, laters[i / 3], angles[i % 3], &hash);
	}
}

/* ---- In a cave */

/* Walls 0.5 thick, and a mouth on the right, 0.2 high. */
static const carom_vec2 cave[12] = {{-2, -2}, {2, -2}, {2, -0.1f}, {1.5f, -0.1f}, {1.5f, -1.5f}, {-1.5f, -1.5f}, {-1.5f, 1.5f}, {1.5f, 1.5f},
	{1.5f, 0.1f}, {2, 0.1f}, {2, 2}, {-2, 2}};

/* At 1,000 m/s through the mouth, against the wall behind it, and out again. */
static void fast_ball_finds_the_mouth(void **unused)
{
	(void)unused;
	SCENERY_EACH_DEVICE(device) {
		const carom_body_def bodies[2] = {fixed(concave_outline(cave, 12)), scenery_circle(30.0f, 0.0f, -1000.0f, 0.0f, 0.05f)};
		const carom_world_def def = hit_def(0.0f);
		size_t count;
		carom_world *world = runs_world(&def, device, bodies, 2);
		if (!world)
			continue;
		runs_advance(world, 0.05);
		carom_hit *hits = runs_hits(world, &count);
		assert_int_equal(count, 1);
		runs_near(hits[0].time, (30.0 + 1.45) / 1000.0, 1e-7);
		runs_near((double)hits[0].point.x, -1.5, 1e-4);
		free(hits);
		runs_near((double)runs_state(world, 1).position.x, -1.45 + 1000.0 * (0.05 - 0.03145), 1e-2);
		carom_world_destroy(world);
	}
}

/* One that is too large for the mouth stays in the cave, whatever it does, and one that is small leaves it nowhere else. */
static void fast_balls_stay_in_a_cave(void **unused)
{
	(void)unused;
	for (int is_small = 0; is_small < 2; is_small++) {
		uint64_t first = 0;
		SCENERY_EACH_DEVICE(device) {
			const carom_body_def bodies[2] = {fixed(concave_outline(cave, 12)), scenery_circle(0.3f, 0.2f, 617.0f, 787.0f, is_small ? 0.02f : 0.15f)};
			const carom_world_def def = hit_def(0.0f);
			uint64_t hits = 0;
			bool is_out = false;
			carom_world *world = runs_world(&def, device, bodies, 2);
			if (!world)
				continue;
			for (uint64_t i = 0; i < runs_affordable(is_small ? 120 : 60) && !is_out; i++) {
				hits += runs_step(world, 1).hits;
				const carom_body_state state = runs_state(world, 1);
				is_out = state.position.x > 1.5f;
				assert_true(concave_overlap(world, 1e-5) <= 1e-5);
				if (!is_out)
					assert_true(fabsf(state.position.x) < 1.5f && fabsf(state.position.y) < 1.5f);
				else
					assert_true(is_small);
				runs_near(hypot((double)state.velocity.x, (double)state.velocity.y) / hypot(617.0, 787.0), 1.0, 1e-5);
			}
			print_message("%llu hits, %s\n", (unsigned long long)hits, is_out ? "out" : "in");
			runs_enough(is_out || hits > 400);
			runs_same_hash(&first, runs_hash(world), device);
			carom_world_destroy(world);
		}
	}
}

/* ---- What interlocks */

/* A T whose head is in a cave, and too long for its mouth. */
static const carom_vec2 bolt[8] = {{0.5f, -1}, {1, -1}, {1, -0.05f}, {3, -0.05f}, {3, 0.05f}, {1, 0.05f}, {1, 1}, {0.5f, 1}};

/* They rattle, and are drawn apart by `pull`, but the head does not get out. */
static void rattle(const scenery_device *device, float pull, float restitution, uint64_t *hash)
{
	carom_body_def bodies[2] = {concave_outline(cave, 12), concave_outline(bolt, 8)};
	carom_world_def def = hit_def(0.0f);
	def.restitution = restitution;
	bodies[0].angular_velocity = 0.3f;
	bodies[0].velocity = (carom_vec2){-2.0f, 0.4f};
	bodies[1].velocity = (carom_vec2){9.0f, -1.0f};
	bodies[0].force.x = -pull;
	bodies[1].force.x = pull;
	uint64_t hits = 0;
	carom_world *world = runs_world(&def, device, bodies, 2);
	if (!world)
		return;
	const carom_measure begun = runs_measure(world);
	for (uint64_t i = 0; i < runs_affordable(300); i++) {
		hits += runs_step(world, 1).hits;
		const carom_body_state c = runs_state(world, 0), b = runs_state(world, 1);
		/* the middle of the head, as the cave sees it */
		const double turn = (double)b.angle - (double)c.angle, lever = 0.75 - (double)bodies[1].position.x;
		const double x = (double)b.position.x - (double)c.position.x, y = (double)b.position.y - (double)c.position.y;
		const double across = cos((double)c.angle) * x + sin((double)c.angle) * y + lever * cos(turn) + (double)bodies[0].position.x;
		assert_true(fabs(across) < 1.5);
		assert_true(concave_overlap(world, 2e-5) <= 2e-5);
	}
	const carom_measure ended = runs_measure(world);
	print_message("%llu hits\n", (unsigned long long)hits);
	runs_enough(hits > 15);
	runs_near(ended.momentum_x, begun.momentum_x, 1e-4 * fabs(begun.momentum_x) + 1e-3);
	if (pull == 0.0f && restitution == 1.0f)
		runs_near(ended.kinetic_energy / begun.kinetic_energy, 1.0, 1e-5);
	runs_same_hash(hash, runs_hash(world), device);
	carom_world_destroy(world);
}

static void what_interlocks_is_not_drawn_apart(void **unused)
{
	(void)unused;
	uint64_t hashes[3] = {0};
	SCENERY_EACH_DEVICE(device) {
		rattle(device, 0.0f, 1.0f, &hashes[0]);
		rattle(device, 0.0f, 0.5f, &hashes[1]);
		rattle(device, 20.0f, 0.5f, &hashes[2]);
	}
}

/* ---- On two legs */

static const carom_vec2 table[8] = {{-2, 1}, {-2, -2}, {-1.5f, -2}, {-1.5f, 0.5f}, {1.5f, 0.5f}, {1.5f, -2}, {2, -2}, {2, 1}};

/* Falls flat upon a static box or a floor, and comes back: hit at the outer ends of its two legs, it is not turned. */
static void table_falls_flat(void **unused)
{
	(void)unused;
	for (int onto_floor = 0; onto_floor < 2; onto_floor++) {
		SCENERY_EACH_DEVICE(device) {
			const carom_body_def bodies[2] = {concave_outline(table, 8), fixed(scenery_box(0.0f, -3.75f, 0.0f, 0.0f, 8.0f, 1.0f))};
			carom_world_def def = hit_def(10.0f);
			size_t count;
			def.has_room = onto_floor;
			def.room_min = (carom_vec2){-5.0f, -3.25f};
			def.room_max = (carom_vec2){5.0f, 5.0f};
			carom_world *world = runs_world(&def, device, bodies, onto_floor ? 1 : 2);
			if (!world)
				continue;
			const double energy = runs_energy(world);
			runs_advance(world, 1.0);
			runs_near((double)runs_state(world, 0).position.y, (double)bodies[0].position.y, 1e-4);
			runs_near((double)runs_state(world, 0).angle, 0.0, 1e-5);
			runs_near((runs_energy(world) - energy) / 10.0, 0.0, 1e-5);
			carom_hit *hits = runs_hits(world, &count);
			assert_int_equal(count, 1);
			runs_near(hits[0].time, 0.5, 2e-6);
			free(hits);
			carom_world_destroy(world);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(ball_in_a_cup), cmocka_unit_test(ball_in_a_funnel),
		cmocka_unit_test(ball_in_the_middle_of_a_funnel), cmocka_unit_test(box_flies_into_a_notch), cmocka_unit_test(fast_ball_finds_the_mouth),
		cmocka_unit_test(fast_balls_stay_in_a_cave), cmocka_unit_test(what_interlocks_is_not_drawn_apart), cmocka_unit_test(table_falls_flat)};
	return cmocka_run_group_tests_name("concave", tests, NULL, NULL);
}
