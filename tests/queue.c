/* The queue's steps: what comes next, and how it is answered.
 * SPDX-License-Identifier: MIT */
#include "queue.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout.h"

/* ---- A step's units */

static void begin(queue_body *k, double length)
{
	k->at.vx *= length;
	k->at.vy *= length;
	k->at.w *= length;
	k->at.ax = k->push[0] * length * length;
	k->at.ay = k->push[1] * length * length;
	k->at.b = k->push[2] * length * length;
	k->time = 0.0;
	k->events = k->rapid = k->stuck = 0;
	k->held = false;
}

/* Does nothing change how it moves? */
static bool is_driven(const queue_body *k)
{
	return k->held || !(k->inverse_mass > 0.0);
}

static void move(queue_body *k, double time)
{
	if (k->held)
		return;
	touch_move(&k->at, time - k->time);
	k->time = time;
}

static void end(queue_body *k, double length)
{
	move(k, 1.0);
	k->at.vx /= length * (1.0 + k->damping * length);
	k->at.vy /= length * (1.0 + k->damping * length);
	k->at.w /= length * (1.0 + k->angular_damping * length);
}

/* The body as a hit at `time` sees it: a held one stands still, whatever its velocity was. */
static exact_body seen_at(const queue_body *k, double time)
{
	queue_body copy = *k;
	move(&copy, time);
	if (k->held)
		copy.at.vx = copy.at.vy = copy.at.w = copy.at.ax = copy.at.ay = copy.at.b = 0.0;
	return copy.at;
}

/* ---- What comes next */

static double *next_of(queue *q, int row, int column)
{
	return &q->next[(size_t)row * (q->count + WALLS) + (size_t)(column + WALLS)];
}

/* No part of either comes farther, so that most pairs need no more than this; and each is to hit what the other is. */
static bool can_meet(const queue_body *a, const queue_body *b)
{
	if ((a->categories & b->mask) == 0 || (b->categories & a->mask) == 0)
		return false;
	const double x = b->at.x - a->at.x, y = b->at.y - a->at.y, apart = a->at.bound + b->at.bound;
	const double far = hypot(a->at.vx, a->at.vy) + hypot(a->at.ax, a->at.ay) + hypot(b->at.vx, b->at.vy) + hypot(b->at.ax, b->at.ay);
	return x * x + y * y <= (apart + 2.0 * far + 1e-3) * (apart + 2.0 * far + 1e-3);
}

static double find(const queue *q, int row, int column)
{
	const queue_body *a = &q->bodies[row], *b = column < 0 ? NULL : &q->bodies[column];
	const double from = b ? fmax(a->time, b->time) : a->time;
	if ((is_driven(a) && (!b || is_driven(b))) || (b ? !can_meet(a, b) : !q->room.is_there))
		return INFINITY;
	const exact_body first = seen_at(a, from);
	if (!b)
		return from + touch_wall_time(&first, &q->room, -1 - column, q->skin, 1.0 - from);
	const exact_body second = seen_at(b, from);
	return from + touch_pair_time(&first, &second, q->skin, 1.0 - from);
}

static void look(queue *q, int body)
{
	if (!(q->bodies[body].inverse_mass > 0.0))
		return;
	for (int column = -WALLS; column < body; column++)
		*next_of(q, body, column) = find(q, body, column);
	for (int row = body + 1; row < (int)q->count; row++)
		*next_of(q, row, body) = find(q, row, body);
}

static queue_hit first_hit(queue *q)
{
	queue_hit first = {INFINITY, 0, 0};
	for (int row = 0; row < (int)q->count; row++) {
		for (int column = -WALLS; column < row; column++) {
			const double time = *next_of(q, row, column);
			if (time < first.time)
				first = (queue_hit){time, row, column};
		}
	}
	return first;
}

/* ---- The answer */

typedef struct party {
	queue_body *body; /* NULL: a wall */
	double inverse_mass, inverse_inertia;
} party;

static party party_of(queue_body *k)
{
	if (!k || is_driven(k))
		return (party){k, 0.0, 0.0};
	return (party){k, k->inverse_mass, k->inverse_inertia};
}

static double arm(const touch *t, const double *lever)
{
	return lever[0] * t->normal[1] - lever[1] * t->normal[0];
}

static double coupling(const touch *t, const party *r, const party *k, int i, int j)
{
	return r->inverse_mass + k->inverse_mass + r->inverse_inertia * arm(t, t->reference[i]) * arm(t, t->reference[j])
		+ k->inverse_inertia * arm(t, t->incident[i]) * arm(t, t->incident[j]);
}

typedef struct rules {
	double restitution, micro, crowd, shake, stillness;
	bool rapid; /* again and again */
} rules;

/* By how much the rate of a point is to grow. */
static double gain(double rate, const rules *how)
{
	return -rate < how->micro ? how->micro - rate : -(1.0 + how->restitution) * rate;
}

/* Both points of a face contact together where both are pushed apart; else the one that approaches faster alone. */
static void solve(const touch *t, const party *r, const party *k, const rules *how, double *j)
{
	const double k00 = coupling(t, r, k, 0, 0), k01 = coupling(t, r, k, 0, 1), k11 = coupling(t, r, k, 1, 1), det = k00 * k11 - k01 * k01;
	const double gain0 = gain(t->rate[0], how), gain1 = gain(t->rate[1], how);
	const bool first = -t->rate[0] > how->stillness, second = t->count > 1 && -t->rate[1] > how->stillness;
	j[0] = j[1] = 0.0;
	if (first && second && det > (double)SINGULAR * k00 * k11) {
		j[0] = (gain0 * k11 - gain1 * k01) / det;
		j[1] = (gain1 * k00 - gain0 * k01) / det;
		if (j[0] >= 0.0 && j[1] >= 0.0)
			return;
		j[0] = j[1] = 0.0;
	}
	if (first && !(second && t->rate[1] < t->rate[0]))
		j[0] = gain0 / k00;
	else if (second)
		j[1] = gain1 / k11;
}

static void push(const touch *t, const party *p, const double (*levers)[2], const double *j, double sign)
{
	if (!p->body || is_driven(p->body))
		return;
	p->body->at.vx += sign * (j[0] + j[1]) * t->normal[0] * p->inverse_mass;
	p->body->at.vy += sign * (j[0] + j[1]) * t->normal[1] * p->inverse_mass;
	p->body->at.w += sign * (j[0] * arm(t, levers[0]) + j[1] * arm(t, levers[1])) * p->inverse_inertia;
}

/* Where the normal impulses act together, from the body's centre; `way` is 1 where the normal leads there. */
static void lever_of(const touch *t, const party *p, const double (*levers)[2], const double *j, double way, double *lever)
{
	for (int i = 0; i < 2; i++) {
		if (!p->body)
			lever[i] = 0.0;
		else if (p->body->at.count == 1)
			lever[i] = way * p->body->at.bound * t->normal[i];
		else
			lever[i] = (j[0] * levers[0][i] + (t->count > 1 ? j[1] * levers[1][i] : 0.0)) / (j[0] + j[1]);
	}
}

/* How fast a point of the party moves along the surfaces. */
static double sliding(const touch *t, const party *p, const double *lever)
{
	if (!p->body || p->body->held)
		return 0.0;
	return (p->body->at.vy + p->body->at.w * lever[0]) * t->normal[0] - (p->body->at.vx - p->body->at.w * lever[1]) * t->normal[1];
}

static void drag(const touch *t, const party *p, const double *lever, double impulse)
{
	if (!p->body || is_driven(p->body))
		return;
	p->body->at.vx -= impulse * t->normal[1] * p->inverse_mass;
	p->body->at.vy += impulse * t->normal[0] * p->inverse_mass;
	p->body->at.w += impulse * (lever[0] * t->normal[0] + lever[1] * t->normal[1]) * p->inverse_inertia;
}

/* Coulomb's law, once the bodies have their new velocities: friction stops their sliding, or does what it can to it. */
static void rub(const touch *t, const party *reference, const party *incident, double friction, const double *j)
{
	double from[2], to[2], most = friction * (j[0] + j[1]), gives;
	if (!(most > 0.0))
		return;
	lever_of(t, reference, t->reference, j, 1.0, from);
	lever_of(t, incident, t->incident, j, -1.0, to);
	const double arm_from = from[0] * t->normal[0] + from[1] * t->normal[1], arm_to = to[0] * t->normal[0] + to[1] * t->normal[1];
	gives = reference->inverse_mass + incident->inverse_mass + reference->inverse_inertia * arm_from * arm_from
		+ incident->inverse_inertia * arm_to * arm_to;
	const double slip = sliding(t, incident, to) - sliding(t, reference, from), impulse = fmax(-most, fmin(most, -slip / gives));
	drag(t, incident, to, impulse);
	drag(t, reference, from, -impulse);
}

static bool is_rapid(const queue_body *k, double time)
{
	return k && !is_driven(k) && k->events > 0 && time - k->time < (double)RAPID;
}

static void count_event(queue *q, queue_body *k, bool rapid, bool slow)
{
	if (!k || is_driven(k))
		return;
	k->rapid += rapid;
	k->stuck = rapid && slow ? k->stuck + 1 : 0;
	if (++k->events > HOLD_LIMIT || k->stuck > STUCK_MOST) {
		k->held = true;
		q->held++;
	}
}

static void record(queue *q, queue_hit hit, bool ruled)
{
	q->ruled += ruled;
	if (q->hit_count == q->hit_room) {
		q->hit_room += 1024;
		q->hits = realloc(q->hits, q->hit_room * sizeof *q->hits);
		assert_non_null(q->hits);
	}
	q->hits[q->hit_count++] = hit;
}

/* CONTRACT's 1 to 4: an approach needs half the stillness, what is rapid again and again is elastic, what is pushed together parts with a little speed, and a
 * crowd with more. */
static rules rules_of(const queue *q, const queue_body *a, const queue_body *b, double time)
{
	const double restitution = fmax(a->restitution, b ? b->restitution : q->room.restitution);
	const bool rapid = (is_rapid(a, time) && a->rapid >= RAPID_MOST) || (is_rapid(b, time) && b->rapid >= RAPID_MOST);
	const double events = fmax(a->events, b ? b->events : 0), crowd = fmin(fmax(events - CROWD, 0.0) * (double)CROWD_PART, (double)CROWD_MOST);
	const double shake = events > CROWD ? exp2(fmin(floor((events - CROWD) / CROWD_DOUBLING), CROWD_DOUBLINGS)) : 0.0;
	return restitution < 1.0 ? (rules){restitution, (double)MICRO, crowd, shake, 0.5, rapid} : (rules){restitution, 0.0, 0.0, 0.0, 0.5, rapid};
}

/* How fast a push makes of them what it will, in a step; 0 where it parts them. */
static double pull_of(const touch *t, const exact_body *a, const exact_body *b)
{
	const double sign = b && t->swapped ? -1.0 : 1.0, x = b ? b->ax - a->ax : a->ax, y = b ? b->ay - a->ay : a->ay;
	return fmax(-sign * (t->normal[0] * x + t->normal[1] * y), 0.0);
}

static void shake_party(const queue *q, queue_body *k)
{
	if (q->shaken_by && k && !is_driven(k))
		queue_shake_body(&k->at, q->shaken_by, q->rounding);
}

static void answer(queue *q, queue_hit hit)
{
	queue_body *a = &q->bodies[hit.row], *b = hit.column < 0 ? NULL : &q->bodies[hit.column];
	rules how = rules_of(q, a, b, hit.time);
	const bool rapid[2] = {is_rapid(a, hit.time), is_rapid(b, hit.time)};
	double j[2];
	move(a, hit.time);
	if (b)
		move(b, hit.time);
	const exact_body first = seen_at(a, hit.time), second = b ? seen_at(b, hit.time) : first;
	const touch t = b ? touch_pair(&first, &second) : touch_wall(&first, &q->room, -1 - hit.column);
	const party pa = party_of(a), pb = party_of(b), *reference = b && !t.swapped ? &pa : &pb, *incident = reference == &pa ? &pb : &pa;
	const double still = touch_stillness(&first, b ? &second : NULL), approach = t.count > 1 ? fmax(-t.rate[0], -t.rate[1]) : -t.rate[0];
	how.stillness *= still;
	how.micro *= pull_of(&t, &first, b ? &second : NULL);
	const double pushed = fmax(q->weight, fmax(hypot(first.ax, first.ay), hypot(second.ax, second.ay)));
	const bool slow = how.restitution < 1.0 && approach < pushed;
	const double usual = how.restitution;
	if (how.rapid && !(how.micro > 0.0 && approach > how.micro / (double)MICRO))
		how.restitution = 1.0;
	how.micro = fmax(how.micro, fmax(how.crowd * pushed, how.shake * still));
	solve(&t, reference, incident, &how, j);
	push(&t, incident, t.incident, j, 1.0);
	push(&t, reference, t.reference, j, -1.0);
	rub(&t, reference, incident, sqrt(a->friction * (b ? b->friction : q->friction)), j);
	if (j[0] + j[1] > 0.0)
		record(q, hit, how.restitution != usual || approach < how.micro);
	shake_party(q, a);
	shake_party(q, b);
	count_event(q, a, rapid[0], slow);
	count_event(q, b, rapid[1], slow);
}

void queue_step(queue *q, double length, size_t most)
{
	size_t events = 0;
	q->hit_count = q->held = q->ruled = 0;
	q->weight = q->gravity * length * length;
	for (size_t i = 0; i < q->count; i++)
		begin(&q->bodies[i], length);
	for (int i = 0; i < (int)q->count; i++) {
		for (int column = -WALLS; column < i; column++)
			*next_of(q, i, column) = find(q, i, column);
	}
	for (queue_hit hit = first_hit(q); hit.time <= 1.0; hit = first_hit(q)) {
		if (events++ >= most)
			fail_msg("the queue has more than %zu events in a step: at %.9g of it bodies %d and %d", most, hit.time, hit.row, hit.column);
		answer(q, hit);
		look(q, hit.row);
		if (hit.column >= 0)
			look(q, hit.column);
	}
	for (size_t i = 0; i < q->count; i++)
		end(&q->bodies[i], length);
}
