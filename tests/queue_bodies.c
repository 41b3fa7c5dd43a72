/* The bodies of a queue, and where it takes them from.
 * SPDX-License-Identifier: MIT */
#include "queue.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void take_place(queue_body *k, const carom_body_state *s)
{
	k->at.x = (double)s->position.x;
	k->at.y = (double)s->position.y;
	k->at.angle = (double)s->angle;
	k->at.vx = (double)s->velocity.x;
	k->at.vy = (double)s->velocity.y;
	k->at.w = (double)s->angular_velocity;
}

void queue_follow(queue *q, carom_world *world)
{
	carom_error error;
	for (uint32_t i = 0; i < q->count; i++) {
		carom_body_state s;
		scenery_check(carom_world_get_states(world, i, 1, &s, &error), &error);
		take_place(&q->bodies[i], &s);
	}
}

static void take_body(queue_body *k, carom_world *world, uint32_t index)
{
	const carom_world_def *def = carom_world_get_def(world);
	carom_body_info info;
	carom_error error;
	scenery_check(carom_world_get_body(world, index, &info, &error), &error);
	k->at = exact_of(world, index);
	k->inverse_mass = 1.0 / (double)info.mass;
	k->inverse_inertia = 1.0 / (double)info.inertia;
	k->restitution = (double)info.restitution;
	k->friction = (double)info.friction;
	k->damping = info.is_kinematic ? 0.0 : (double)info.linear_damping;
	k->angular_damping = info.is_kinematic ? 0.0 : (double)info.angular_damping;
	k->categories = info.categories;
	k->mask = info.mask;
	if (k->inverse_mass > 0.0) {
		k->push[0] = (double)def->gravity.x + (double)info.force.x * k->inverse_mass;
		k->push[1] = (double)def->gravity.y + (double)info.force.y * k->inverse_mass;
		k->push[2] = (double)info.torque * k->inverse_inertia;
	}
}

static void allocate(queue *q, size_t count)
{
	q->count = count;
	q->bodies = calloc(count, sizeof *q->bodies);
	q->next = calloc(count * (count + WALLS), sizeof *q->next);
	q->hit_room = 1024;
	q->hits = calloc(q->hit_room, sizeof *q->hits);
	assert_true(q->bodies && q->next && q->hits);
}

queue *queue_of(carom_world *world)
{
	const carom_world_def *def = carom_world_get_def(world);
	queue *q = calloc(1, sizeof *q);
	assert_non_null(q);
	allocate(q, carom_world_body_count(world));
	for (uint32_t i = 0; i < q->count; i++)
		take_body(&q->bodies[i], world, i);
	q->room = (touch_room){def->has_room, {(double)def->room_min.x, (double)def->room_min.y}, {(double)def->room_max.x, (double)def->room_max.y},
		(double)def->restitution};
	q->friction = (double)def->friction;
	q->gravity = hypot((double)def->gravity.x, (double)def->gravity.y);
	queue_follow(q, world);
	return q;
}

queue *queue_copy(const queue *other)
{
	queue *q = calloc(1, sizeof *q);
	assert_non_null(q);
	allocate(q, other->count);
	memcpy(q->bodies, other->bodies, q->count * sizeof *q->bodies);
	q->room = other->room;
	q->friction = other->friction;
	return q;
}

void queue_destroy(queue *q)
{
	free(q->bodies);
	free(q->next);
	free(q->hits);
	free(q);
}

static double shake(scenery_random *random, double size, double relative)
{
	return size * relative * (double)scenery_uniform(random, -1.0f, 1.0f);
}

void queue_shake_body(exact_body *k, scenery_random *random, double relative)
{
	const double size = fabs(k->x) + fabs(k->y) + k->bound, speed = fabs(k->vx) + fabs(k->vy) + fabs(k->w) * k->bound;
	k->x += shake(random, size, relative);
	k->y += shake(random, size, relative);
	k->vx += shake(random, speed, relative);
	k->vy += shake(random, speed, relative);
	if (k->count == 1)
		return;
	k->angle += shake(random, 1.0, relative);
	k->w += shake(random, speed / k->bound, relative);
}

void queue_shake(queue *q, scenery_random *random, double relative)
{
	for (queue_body *k = q->bodies; k < q->bodies + q->count; k++) {
		const bool is_static = !(k->inverse_mass > 0.0) && k->at.vx == 0.0 && k->at.vy == 0.0 && k->at.w == 0.0;
		if (!is_static)
			queue_shake_body(&k->at, random, relative);
	}
}

double queue_kinetic_energy(const queue *q)
{
	double sum = 0.0;
	for (const queue_body *k = q->bodies; k < q->bodies + q->count; k++) {
		if (k->inverse_mass > 0.0)
			sum += 0.5 * ((k->at.vx * k->at.vx + k->at.vy * k->at.vy) / k->inverse_mass + k->at.w * k->at.w / k->inverse_inertia);
	}
	return sum;
}

double queue_momentum(const queue *q, int axis)
{
	double sum = 0.0;
	for (const queue_body *k = q->bodies; k < q->bodies + q->count; k++)
		sum += (axis ? k->at.vy : k->at.vx) / k->inverse_mass;
	return sum;
}
