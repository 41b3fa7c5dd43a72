/* Bodies that are not convex, by their convex pieces: CONTRACT.md, "Polygons that are not convex". */

/* A body is asked for one piece after the other. */
typedef struct piece {
	body self;     /* like the whole, with the vertices of the piece */
	int next;      /* where those of the next one begin */
	float2 middle; /* of a circle about the piece, from the whole's centre, */
	float far;     /* how far that is, */
	float radius;  /* and of the circle */
} piece;

bool has_pieces(body a, body b)
{
	return a.pieces > 0 || b.pieces > 0;
}

int piece_count(body whole)
{
	return max(whole.pieces, 1);
}

/* Where the records of pieces are. */
int piece_table(body whole)
{
	return whole.first + whole.count + whole.count % 2;
}

/* Where the first one's vertices begin. */
int first_piece(body whole)
{
	return piece_table(whole) + whole.pieces;
}

/* Piece i, whose vertices begin at `first`, of a body that is so turned; of what is convex, itself. */
piece piece_load(VERTICES_IN, body whole, float2 rotation, int i, int first)
{
	piece p = {whole, first, (float2)(0.0f, 0.0f), 0.0f, whole.radius};
	if (whole.pieces == 0)
		return p;
	float4 record = piece_record(VERTICES, piece_table(whole) + i);
	float2 middle = (float2)(CHANNEL(record, PIECE_X), CHANNEL(record, PIECE_Y));
	p.self.first = first;
	p.self.count = (int)CHANNEL(record, PIECE_COUNT);
	p.self.pieces = 0;
	p.next = first + p.self.count;
	p.middle = turn(rotation, middle);
	p.far = norm(middle);
	p.radius = CHANNEL(record, PIECE_RADIUS);
	return p;
}

/* Do two pieces surely not come within reach until t? Their circles go straight on, and aside by no more than turns and pushes take them. */
bool pieces_are_far(const piece *a, const piece *b, float t, float reach)
{
	float2 d = (float2)((b->self.x.x - a->self.x.x) + (b->middle.x - a->middle.x), (b->self.x.y - a->self.x.y) + (b->middle.y - a->middle.y));
	float2 e = (float2)(t * (b->self.v.x - a->self.v.x), t * (b->self.v.y - a->self.v.y));
	float2 push = (float2)(b->self.a.x - a->self.a.x, b->self.a.y - a->self.a.y);
	float turned = (magnitude(a->self.w) + 0.5f * magnitude(a->self.b)) * a->far;
	float other_turned = (magnitude(b->self.w) + 0.5f * magnitude(b->self.b)) * b->far;
	float near = (a->radius + b->radius) + (((0.5f * span(push) + turned) + other_turned) * t + reach);
	float approach = inner(d, e), square = inner(e, e);
	if (approach >= 0.0f)
		return norm(d) > near;
	if (-approach >= square)
		return norm((float2)(d.x + e.x, d.y + e.y)) > near;
	return magnitude(cross2(d, e)) > near * sqrt(square);
}

/* A pair of pieces, and which ones they are. */
typedef struct piece_pair {
	piece a, b;
	int i, j;
} piece_pair;

/* Before the first one. */
piece_pair pairs_begin(body b)
{
	piece_pair at;
	at.i = -1;
	at.j = piece_count(b) - 1;
	return at;
}

/* Goes on to the next one that is not far, of bodies that are so turned; false if there is none. */
bool next_pair(VERTICES_IN, body a, body b, float2 ra, float2 rb, float t, float reach, piece_pair *at)
{
	do {
		bool ends = at->j + 1 == piece_count(b);
		if (ends && ++at->i == piece_count(a))
			return false;
		if (ends)
			at->a = piece_load(VERTICES, a, ra, at->i, at->i > 0 ? at->a.next : first_piece(a));
		at->j = ends ? 0 : at->j + 1;
		at->b = piece_load(VERTICES, b, rb, at->j, at->j > 0 ? at->b.next : first_piece(b));
	} while (pieces_are_far(&at->a, &at->b, t, reach));
	return true;
}

/* The first hit of two bodies of which one at least has pieces. */
SELDOM float4 pieces_first(VERTICES_IN, body a, body b, float until, float4 rules)
{
	float2 ra = body_rotation(a, 0.0f), rb = body_rotation(b, 0.0f);
	float reach = APART_SLOPS * pair_slop(a, b), end = until;
	float4 best = hit_none();
	piece_pair at = pairs_begin(b);
	while (next_pair(VERTICES, a, b, ra, rb, 1.0f, reach, &at)) {
		float4 hit = pair_first(VERTICES, at.a.self, at.b.self, end, rules);
		if (CHANNEL(hit, HITTIMES_HIT) < CHANNEL(best, HITTIMES_HIT))
			best = hit;
		end = smaller(end, CHANNEL(best, HITTIMES_HIT));
	}
	return best;
}

/* The first hit of any two bodies. */
float4 bodies_first(VERTICES_IN, body a, body b, float until, float4 rules)
{
	return has_pieces(a, b) ? pieces_first(VERTICES, a, b, until, rules) : pair_first(VERTICES, a, b, until, rules);
}

/* The two points of a contact, or its one, with how far each is from touching. */
typedef struct grounding {
	contact c;
	float gap[2];
} grounding;

void grounding_set(grounding *to, int i, pose p, float2 ref, float2 inc, float gap)
{
	to->c.ref[i] = ref;
	to->c.inc[i] = inc;
	to->c.rate[i] = parting_rate(to->c.swapped ? pose_swapped(p) : p, to->c.n, ref, inc);
	to->gap[i] = gap;
}

/* Of the other contact's normal, as seen from the same reference: the sign. */
float same_sense(const grounding *to, const grounding *other)
{
	return to->c.swapped == other->c.swapped ? 1.0f : -1.0f;
}

/* Do two bodies press along one normal at both? */
bool are_alike(const grounding *to, const grounding *other)
{
	return same_sense(to, other) * inner(other->c.n, to->c.n) > PIECES_ALIKE;
}

/* What is alike becomes one contact, of the outermost points. */
void grounding_merge(grounding *to, const grounding *other, pose p, float near)
{
	bool same = same_sense(to, other) > 0.0f;
	float2 way = (float2)(-to->c.n.y, to->c.n.x);
	for (int i = 0; i < other->c.count; i++) {
		float2 ref = same ? other->c.ref[i] : other->c.inc[i], inc = same ? other->c.inc[i] : other->c.ref[i];
		float at = inner(way, ref);
		bool before = at<inner(way, to->c.ref[0]) - near, behind = at> inner(way, to->c.ref[to->c.count - 1]) + near;
		if (before && to->c.count == 1) {
			to->c.ref[1] = to->c.ref[0], to->c.inc[1] = to->c.inc[0];
			to->c.rate[1] = to->c.rate[0], to->gap[1] = to->gap[0];
		}
		if (before || behind) {
			to->c.count = 2;
			grounding_set(to, before ? 0 : 1, p, ref, inc, other->gap[i]);
		}
	}
}

/* How near points are to each other that count as one. */
float merge_near(float slop)
{
	return (CORNER_NEAR * CORNER_DEEP) * slop;
}

/* Two convex bodies as they hit each other: along an axis, at a contact. */
typedef struct encounter {
	axis k;
	grounding at; /* without gaps */
	int touches;  /* 0: no, 1: yes, 2: and is hit */
} encounter;

encounter encounter_of(VERTICES_IN, body a, body b, pose p, float slop, float still, float part)
{
	encounter m;
	m.k = hit_axis(VERTICES, a, b, p, slop, still, part);
	m.at.c = contact_at(VERTICES, a, b, p, m.k, slop);
	m.at.gap[0] = m.at.gap[1] = 0.0f;
	m.touches = m.k.gap <= PIECES_TOUCH * slop ? (contact_is_hit(m.at.c, threshold_of(m.k.gap, slop, still, part).rate) ? 2 : 1) : 0;
	return m;
}

/* Is the hit rather along this one: of what touches, and of this what is hit, the fastest approach, else what is nearest? */
bool meets_rather(const encounter *m, const encounter *than)
{
	if (m->touches != than->touches)
		return m->touches > than->touches;
	return m->touches ? rate_of(m->at.c) < rate_of(than->at.c) : m->k.gap < than->k.gap;
}

/* Goes through the pairs of pieces that are within reach: finds the one along which the hit is, or, `merges`, the points that all have along that normal. False if there is no pair. */
bool encounters_pass(VERTICES_IN, body a, body b, pose p, float slop, float still, float part, float reach, bool merges, encounter *best)
{
	bool any = merges;
	piece_pair at = pairs_begin(b);
	while (next_pair(VERTICES, a, b, p.ra, p.rb, 0.0f, reach, &at)) {
		encounter m = encounter_of(VERTICES, at.a.self, at.b.self, p, slop, still, part);
		if (merges && m.touches && are_alike(&best->at, &m.at))
			grounding_merge(&best->at, &m.at, p, merge_near(slop));
		if (!merges && (!any || meets_rather(&m, best))) {
			*best = m;
			any = true;
		}
	}
	return any;
}

/* Of bodies of which one at least has pieces. */
SELDOM encounter pieces_encounter(VERTICES_IN, body a, body b, pose p, float slop, float still, float part)
{
	encounter best;
	float reach = APART_SLOPS * slop;
	if (!encounters_pass(VERTICES, a, b, p, slop, still, part, reach, false, &best)) { /* what bisection found may not be so near yet */
		reach = INFINITY;
		encounters_pass(VERTICES, a, b, p, slop, still, part, reach, false, &best);
	}
	if (a.count > 1 && b.count > 1)
		encounters_pass(VERTICES, a, b, p, slop, still, part, reach, true, &best);
	return best;
}

/* Where two convex bodies press on each other, or would if they were a little nearer; false if they are too far from that. */
bool grounding_find(VERTICES_IN, body a, body b, pose p, float force, float slop, grounding *at)
{
	axis k = best_axis(VERTICES, a, b, p);
	if (k.gap > force || k.gap < -(SUNK_MOST * slop))
		return false;
	at->c = contact_at(VERTICES, a, b, p, k, force - k.gap);
	axis way = corner_way(VERTICES, a, b, p, k, at->c, slop);
	if (!axes_are_same(way, k)) {
		k = way;
		at->c = contact_at(VERTICES, a, b, p, k, force - k.gap);
	}
	for (int i = 0; i < 2; i++)
		at->gap[i] = at->c.count > 1 ? inner(at->c.n, at->c.ref[i]) - k.offset : k.gap;
	return true;
}

/* One more, or a part of one of so many; how many there are then. A circle touches at one point. */
int grounding_add(grounding *all, int count, const grounding *at, pose p, bool is_circle, float slop)
{
	for (int k = 0; k < count; k++) {
		if (!are_alike(&all[k], at))
			continue;
		if (!is_circle)
			grounding_merge(&all[k], at, p, merge_near(slop));
		else if (at->gap[0] < all[k].gap[0])
			all[k] = *at;
		return count;
	}
	if (count < PAIR_RESTS)
		all[count++] = *at;
	return count;
}

/* Of bodies of which one at least has pieces; how many normals there are along which they press on each other. */
SELDOM int pieces_find(VERTICES_IN, body a, body b, pose p, float force, float slop, grounding *all)
{
	int count = 0;
	piece_pair at = pairs_begin(b);
	while (next_pair(VERTICES, a, b, p.ra, p.rb, 0.0f, force, &at)) {
		grounding found;
		if (grounding_find(VERTICES, at.a.self, at.b.self, p, force, slop, &found))
			count = grounding_add(all, count, &found, p, a.count == 1 || b.count == 1, slop);
	}
	return count;
}
