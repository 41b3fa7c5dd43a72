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

static double larger_of(carom_vec2 v)
{
	return fmax(fabs((double)v.x), fabs((double)v.y));
}

/* What a body may be at the end of a step, if nothing is in its way: turning counts as speed at the rim. From its texels of Linear and Rotational. */
static carom_range range_of(const carom_world *world, const carom_body *body, const float *l, const float *r)
{
	const double time = (double)world->def.time_step,
				 push = carom_is_dynamic(body) ? larger_of(world->def.gravity) + larger_of(body->force) / (double)body->mass : 0.0,
				 twist = fabs((double)body->torque) / (double)body->inertia;
	carom_range most = {.place = fmax(larger_of((carom_vec2){l[LINEAR_X], l[LINEAR_Y]}), (double)body->bound), .is_kept = true, .time = world->time};
	if (body->is_static)
		return most;
	most.is_kept = world->def.has_room && carom_is_dynamic(body);
	most.spin = fabs((double)r[ROTATIONAL_VELOCITY]) + twist * time;
	most.speed = larger_of((carom_vec2){l[LINEAR_VX], l[LINEAR_VY]}) + push * time + most.spin * (double)body->bound;
	most.push = push + twist * fmax((double)body->bound, 1.0);
	most.heaviest = carom_is_dynamic(body) ? fmax((double)body->mass, (double)body->inertia) : 0.0;
	return most;
}

/* Of all bodies of the two. */
static carom_range both(const carom_range *a, const carom_range *b)
{
	return (carom_range){.place = fmax(a->place, b->place),
		.speed = fmax(a->speed, b->speed),
		.spin = fmax(a->spin, b->spin),
		.push = fmax(a->push, b->push),
		.heaviest = fmax(a->heaviest, b->heaviest),
		.is_kept = a->is_kept && b->is_kept,
		.time = a->time};
}

/* What may have become of it since, if no hit made a body faster. */
static carom_range grown(const carom_range *range, double time)
{
	const double passed = time - range->time, faster = range->push * passed;
	carom_range now = *range;
	now.speed += faster;
	now.spin += faster;
	now.place += now.speed * passed;
	now.time = time;
	return now;
}

static double room_size(const carom_world_def *def)
{
	return fmax((double)def->room_max.x - (double)def->room_min.x, (double)def->room_max.y - (double)def->room_min.y);
}

static const char *excess(const carom_world *world, const carom_range *most)
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
static double good_for(const carom_range *most)
{
	const double speed = fmax(most->speed, most->spin), left = MOST - most->place;
	const double by_speed = (MOST - speed) / most->push; /* infinite where nothing pushes */
	const double by_place = 2.0 * left / (speed + sqrt(speed * speed + 2.0 * most->push * left));
	return most->is_kept ? by_speed : fmin(by_speed, by_place);
}

/* Bodies hit each other, so the heaviest may become the fastest. */
static bool has_momentum(const carom_range *all)
{
	return all->heaviest * fmax(all->speed, all->spin) > MOST_MOMENTUM;
}

carom_status carom_check_range(carom_world *world, carom_error *error)
{
	carom_range all = {.is_kept = true, .time = world->time};
	double good = INFINITY;
	world->good_for = 0.0; /* if this fails, the next step looks again */
	for (size_t i = 0; i < world->body_count; i++) {
		const carom_range most = range_of(world, &carom_world_bodies(world)[i], (const float *)world->linear.items + 4 * i,
			(const float *)world->rotational.items + 4 * i);
		const char *what = excess(world, &most);
		if (what)
			return carom_fail(error, CAROM_LIMIT, "body %zu: %s is too large for a step in 32-bit floats; allowed: up to 1e9 m, m/s and rad/s", i,
				what);
		good = fmin(good, good_for(&most));
		all = both(&all, &most);
	}
	if (has_momentum(&all))
		return carom_fail(error, CAROM_LIMIT,
			"a body of %g kg or kg m^2 and a speed of %g m/s or rad/s make a momentum too large for a step in 32-bit floats", all.heaviest,
			fmax(all.speed, all.spin));
	world->range = all;
	world->good_for = good;
	return CAROM_OK;
}

/* As all bodies together had changed bodies' pushes, and were as fast as the fastest: mostly that is still far from what can't be computed. */
bool carom_range_holds(carom_world *world)
{
	static const float still[4] = {0.0f};
	const carom_change *changes = world->changes.items;
	const size_t count = carom_change_count(world);
	const carom_range before = grown(&world->range, world->time);
	carom_range all = before;
	if (world->unsent & UNSENT_GRAVITY) {
		all.push += larger_of(world->def.gravity);
		all.speed += all.push * (double)world->def.time_step;
	}
	const size_t first = world->newest & PLACE_SLOTS ? world->events.known : world->body_count;
	for (size_t i = first; i < world->body_count; i++) {
		const carom_range most = range_of(world, &carom_world_bodies(world)[i], (const float *)world->linear.items + 4 * i,
			(const float *)world->rotational.items + 4 * i);
		all = both(&all, &most);
	}
	for (size_t k = 0; k < count; k++) {
		const bool moves = changes[k].moves;
		carom_range most = range_of(world, &carom_world_bodies(world)[changes[k].body], moves ? changes[k].linear : still,
			moves ? changes[k].rotational : still);
		most.speed += moves ? 0.0 : before.speed;
		most.spin += moves ? 0.0 : before.spin;
		all = both(&all, &most);
	}
	if (count > 0 || first < world->body_count || world->unsent & UNSENT_DEF) {
		if (excess(world, &all) || has_momentum(&all))
			return false;
		world->range = all;
		world->good_for = fmin(world->good_for, good_for(&all));
	}
	return world->good_for >= (double)world->def.time_step;
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
