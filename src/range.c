/* Numbers that a step can compute with. Any finite state can be held, drawn and written; but the kernels multiply and square
 * what they are given, and where that leaves the floats a state is lost. So it is looked at before the first step from it, and again
 * before gravity, forces and speeds could have brought a body there. */
#include <math.h>

#include "layout.h"
#include "status.h"
#include "world.h"

#define MOST 1e9                /* m, m/s, rad/s: four factors of that size are below the largest float, 3.4e38 */
#define MOST_TRAVEL 1e18        /* m, rad: what a step may add to a place */
#define MOST_ROOMS 4294967296.0 /* of ways in a step: in more, times that floats can't tell from each other lie on both sides of a wall */
#define MOST_MOMENTUM 1e36      /* kg m/s, kg m^2/s */

/* What a body may be at the end of a step, if nothing is in its way: turning counts as speed at the rim. */
typedef struct reached {
	double place, speed, spin; /* m, m/s, rad/s */
	double push;               /* m/s^2, or rad/s^2: by how much both may grow */
	bool is_kept;              /* by the room */
} reached;

static double larger_of(carom_vec2 v)
{
	return fmax(fabs((double)v.x), fabs((double)v.y));
}

static reached reach_of(const carom_world *world, size_t index)
{
	const carom_body *body = &carom_world_bodies(world)[index];
	const float *l = (const float *)world->linear.items + 4 * index, *r = (const float *)world->rotational.items + 4 * index;
	const double time = (double)world->def.time_step,
				 push = carom_is_dynamic(body) ? larger_of(world->def.gravity) + larger_of(body->force) / (double)body->mass : 0.0,
				 twist = fabs((double)body->torque) / (double)body->inertia;
	reached most = {.place = fmax(larger_of((carom_vec2){l[LINEAR_X], l[LINEAR_Y]}), (double)body->bound)};
	most.is_kept = world->def.has_room && carom_is_dynamic(body);
	if (body->is_static)
		return most;
	most.spin = fabs((double)r[ROTATIONAL_VELOCITY]) + twist * time;
	most.speed = larger_of((carom_vec2){l[LINEAR_VX], l[LINEAR_VY]}) + push * time + most.spin * (double)body->bound;
	most.push = push + twist * fmax((double)body->bound, 1.0);
	return most;
}

static double room_size(const carom_world_def *def)
{
	return fmax((double)def->room_max.x - (double)def->room_min.x, (double)def->room_max.y - (double)def->room_min.y);
}

static const char *excess(const carom_world *world, const reached *most)
{
	const carom_world_def *def = &world->def;
	if (def->has_room && (larger_of(def->room_min) > MOST || larger_of(def->room_max) > MOST))
		return "the room";
	if (most->place > MOST)
		return "its place or its size";
	if (most->speed > MOST || most->spin > MOST)
		return "its speed, or what a step of so much push adds to it,";
	const double way = most->speed * (double)def->time_step;
	if (fmax(way, most->spin * (double)def->time_step) > MOST_TRAVEL || (def->has_room && way > MOST_ROOMS * room_size(def)))
		return "its way in one step";
	if (!most->is_kept && most->place + way > MOST)
		return "its place, or how far a step brings it,";
	return NULL;
}

/* s: until what pushes add makes the speed too large; and the place, where no room keeps a body. What hits do is not foreseen. */
static double good_for(const reached *most)
{
	const double speed = fmax(most->speed, most->spin), left = MOST - most->place;
	const double by_speed = (MOST - speed) / most->push; /* infinite where nothing pushes */
	const double by_place = 2.0 * left / (speed + sqrt(speed * speed + 2.0 * most->push * left));
	return most->is_kept ? by_speed : fmin(by_speed, by_place);
}

/* Bodies hit each other, so the heaviest may become the fastest. */
carom_status carom_check_range(carom_world *world, carom_error *error)
{
	double heaviest = 0.0, fastest = 0.0, good = INFINITY;
	world->good_for = 0.0; /* if this fails, the next step looks again */
	for (size_t i = 0; i < world->body_count; i++) {
		const carom_body *body = &carom_world_bodies(world)[i];
		const reached most = reach_of(world, i);
		const char *what = excess(world, &most);
		if (what)
			return carom_fail(error, CAROM_LIMIT, "body %zu: %s is too large for a step in 32-bit floats; allowed: up to 1e9 m, m/s and rad/s", i,
				what);
		if (!body->is_static)
			good = fmin(good, good_for(&most));
		heaviest = carom_is_dynamic(body) ? fmax(heaviest, fmax((double)body->mass, (double)body->inertia)) : heaviest;
		fastest = fmax(fastest, fmax(most.speed, most.spin));
	}
	if (heaviest * fastest > MOST_MOMENTUM)
		return carom_fail(error, CAROM_LIMIT,
			"a body of %g kg or kg m^2 and a speed of %g m/s or rad/s make a momentum too large for a step in 32-bit floats", heaviest, fastest);
	world->good_for = good;
	return CAROM_OK;
}

static bool is_between(float x, float least, float most, double slack)
{
	return (double)x >= (double)least - slack && (double)x <= (double)most + slack;
}

/* By more than a thousandth of it, and what rounding makes of the way in a step: a run may end a little outside, and goes on from there. */
bool carom_outside_room(const carom_world_def *def, carom_vec2 p, carom_vec2 v)
{
	const double way = hypot((double)v.x, (double)v.y) * (double)def->time_step, slack = room_size(def) / 1024 + way / (1 << 20);
	return def->has_room && !(is_between(p.x, def->room_min.x, def->room_max.x, slack) && is_between(p.y, def->room_min.y, def->room_max.y, slack));
}
