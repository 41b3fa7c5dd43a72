/* Chipmunk 7 beside Carom: the only file that knows it.
 * SPDX-License-Identifier: MIT */
#include "carom_peer.h"

#include <chipmunk/chipmunk.h>

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define WALLS 4

struct chipmunk_world {
	cpSpace *space;
	size_t count;
	cpBody **bodies;
	cpShape **shapes; /* of the bodies, then of the walls */
	double time_step;
};

static const char *version(void)
{
	return cpVersionString;
}

static cpShape *add_shape(cpSpace *space, cpShape *shape, double restitution, float friction)
{
	cpShapeSetElasticity(shape, restitution);
	cpShapeSetFriction(shape, sqrt((double)friction)); /* of two it takes the product */
	return cpSpaceAddShape(space, shape);
}

/* (Of two restitutions it takes the product: with walls bodies have their own.) */
static void add_walls(cpSpace *space, const struct peer_scene *scene, cpShape **shapes)
{
	const double l = (double)scene->room_min.x, r = (double)scene->room_max.x, thick = (double)PEER_WALL;
	const double b = (double)scene->room_min.y, t = (double)scene->room_max.y;
	const cpBB boxes[WALLS] = {
		cpBBNew(l - thick, b - thick, l, t + thick),
		cpBBNew(r, b - thick, r + thick, t + thick),
		cpBBNew(l - thick, b - thick, r + thick, b),
		cpBBNew(l - thick, t, r + thick, t + thick),
	};
	for (size_t k = 0; k < WALLS; k++)
		shapes[k] = add_shape(space, cpBoxShapeNew2(cpSpaceGetStaticBody(space), boxes[k], 0), 1, scene->friction);
}

static cpShape *make_shape(cpBody *body, const carom_body_info *info)
{
	cpVect vertices[CAROM_MAX_VERTICES];
	if (info->shape == CAROM_CIRCLE)
		return cpCircleShapeNew(body, (double)info->radius, cpvzero);
	for (uint32_t k = 0; k < info->vertex_count; k++)
		vertices[k] = cpv((double)info->vertices[k].x, (double)info->vertices[k].y);
	return cpPolyShapeNewRaw(body, (int)info->vertex_count, vertices, 0);
}

static cpBody *add_body(cpSpace *space, const carom_body_info *info, const carom_body_state *state, cpShape **shape)
{
	cpBody *body = info->is_static ? cpBodyNewStatic()
		: info->is_kinematic       ? cpBodyNewKinematic()
								   : cpBodyNew((double)info->mass, (double)info->inertia);
	cpSpaceAddBody(space, body);
	cpBodySetPosition(body, cpv((double)state->position.x, (double)state->position.y));
	cpBodySetAngle(body, (double)state->angle);
	cpBodySetVelocity(body, cpv((double)state->velocity.x, (double)state->velocity.y));
	cpBodySetAngularVelocity(body, (double)state->angular_velocity);
	*shape = add_shape(space, make_shape(body, info), (double)info->restitution, info->friction);
	return body;
}

/* The space first: it looks at the bodies once more. */
static void destroy(void *world)
{
	struct chipmunk_world *made = world;
	if (!made)
		return;
	if (made->space)
		cpSpaceFree(made->space);
	for (size_t k = 0; made->space && k < made->count + WALLS; k++)
		cpShapeFree(made->shapes[k]);
	for (size_t k = 0; made->space && k < made->count; k++)
		cpBodyFree(made->bodies[k]);
	free(made->shapes);
	free(made->bodies);
	free(made);
}

/* Where it was compiled with assertions, as Debian's is, it says so on standard output, which is for results. */
static cpSpace *create_space(void)
{
	fflush(stdout);
	int kept = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
	if (kept >= 0 && nowhere >= 0)
		dup2(nowhere, STDOUT_FILENO);
	cpSpace *space = cpSpaceNew(); /* which never lets bodies sleep unless it is told to */
	fflush(stdout);
	if (kept >= 0 && nowhere >= 0)
		dup2(kept, STDOUT_FILENO);
	if (kept >= 0)
		close(kept);
	if (nowhere >= 0)
		close(nowhere);
	return space;
}

static void *create(const struct peer_scene *scene)
{
	struct chipmunk_world *made = calloc(1, sizeof *made);
	if (!made)
		return NULL;
	made->count = scene->count;
	made->time_step = (double)scene->time_step;
	made->bodies = malloc(scene->count * sizeof(cpBody *));
	made->shapes = malloc((scene->count + WALLS) * sizeof(cpShape *));
	if (!made->bodies || !made->shapes) {
		destroy(made);
		return NULL;
	}
	made->space = create_space();
	cpSpaceSetGravity(made->space, cpv((double)scene->gravity.x, (double)scene->gravity.y));
	for (size_t k = 0; k < scene->count; k++) {
		made->bodies[k] = add_body(made->space, &scene->bodies[k], &scene->states[k], &made->shapes[k]);
		cpShapeSetUserData(made->shapes[k], (void *)(intptr_t)(k + 1)); /* of walls it is NULL */
	}
	add_walls(made->space, scene, made->shapes + scene->count);
	return made;
}

static void step(void *world)
{
	struct chipmunk_world *made = world;
	cpSpaceStep(made->space, made->time_step);
}

static void get_states(const void *world, carom_body_state *states)
{
	const struct chipmunk_world *made = world;
	for (size_t k = 0; k < made->count; k++) {
		cpVect at = cpBodyGetPosition(made->bodies[k]), velocity = cpBodyGetVelocity(made->bodies[k]);
		states[k] = (carom_body_state){
			.position = {(float)at.x, (float)at.y},
			.angle = (float)cpBodyGetAngle(made->bodies[k]),
			.velocity = {(float)velocity.x, (float)velocity.y},
			.angular_velocity = (float)cpBodyGetAngularVelocity(made->bodies[k]),
		};
	}
}

static int32_t cast(const void *world, carom_vec2 from, carom_vec2 to)
{
	const struct chipmunk_world *made = world;
	const cpShape *shape = cpSpaceSegmentQueryFirst(made->space, cpv((double)from.x, (double)from.y), cpv((double)to.x, (double)to.y), 0,
		CP_SHAPE_FILTER_ALL, NULL);
	return shape ? (int32_t)(intptr_t)cpShapeGetUserData(shape) - 1 : -1;
}

const struct peer peer_chipmunk = {
	.name = "Chipmunk",
	.settings = "10 iterations, which is its default, like all else",
	.version = version,
	.create = create,
	.step = step,
	.get_states = get_states,
	.cast = cast,
	.destroy = destroy,
};
