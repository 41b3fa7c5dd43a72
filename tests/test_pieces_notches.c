/* What touches a polygon where it points inwards touches pieces there whose sides are the polygon's, and no cut: of shapes that one would draw.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "concave.h"
#include "count.h"
#include "pieces.h"

#define NEAR 1e-5 /* m */
#define ALONG 1e-3

typedef struct side {
	double x, y, way_x, way_y; /* its beginning; 1 long */
} side;

static side side_of(carom_vec2 a, carom_vec2 b)
{
	const double x = (double)b.x - (double)a.x, y = (double)b.y - (double)a.y, size = hypot(x, y);
	return (side){(double)a.x, (double)a.y, x / size, y / size};
}

/* How far a point is in front of it. */
static double in_front(const side *s, carom_vec2 p)
{
	return s->way_y * ((double)p.x - s->x) - s->way_x * ((double)p.y - s->y);
}

static double sine(const side *a, const side *b)
{
	return a->way_x * b->way_y - a->way_y * b->way_x;
}

/* Is the corner within the piece, or not at it, or at a side that lies along one of the two that meet in it? */
static bool is_good_at(const carom_vec2 *piece, uint32_t count, carom_vec2 corner, const side *before, const side *after)
{
	double most = -HUGE_VAL;
	bool is_along = false;
	for (uint32_t k = 0; k < count; k++) {
		const side s = side_of(piece[k], piece[(k + 1) % count]);
		const double front = in_front(&s, corner);
		most = fmax(most, front);
		is_along = is_along || (fabs(front) < NEAR && (fabs(sine(&s, before)) < ALONG || fabs(sine(&s, after)) < ALONG));
	}
	return is_along || fabs(most) > NEAR;
}

static void check(const carom_vec2 *outline, uint32_t count, const char *name)
{
	carom_pieces pieces;
	carom_pieces_make(outline, count, &pieces);
	for (uint32_t k = 0; k < count; k++) {
		const side before = side_of(outline[(k + count - 1) % count], outline[k]), after = side_of(outline[k], outline[(k + 1) % count]);
		const carom_vec2 *piece = pieces.vertices;
		if (sine(&before, &after) > 0.0)
			continue;
		for (uint32_t i = 0; i < pieces.count; piece += pieces.sizes[i++])
			if (!is_good_at(piece, pieces.sizes[i], outline[k], &before, &after))
				fail_msg("%s: at vertex %u there is a cut of piece %u", name, k, i);
	}
}

static void no_cut_is_where_it_points_inwards(void **unused)
{
	static const carom_vec2 level_l[] = {{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}},
							other_l[] = {{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 1.9f}, {-2, 1.9f}};
	static const carom_vec2 valley[] = {{-3, 0.5f}, {3, 0.5f}, {3, 4}, {0, 1}, {-3, 4}},
							step[] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
	static const carom_vec2 t[] = {{-1, 2}, {-0.25f, 2}, {-0.25f, -1}, {0.25f, -1}, {0.25f, 2}, {1, 2}, {1, 2.5f}, {-1, 2.5f}};
	(void)unused;
	for (int kind = 0; kind < CONCAVE_KINDS; kind++) {
		const carom_body_def def = concave_body((concave_kind)kind, 0);
		check(def.vertices, def.vertex_count, (const char *[]){"L", "U", "C", "cross", "star", "hook", "arrow", "comb"}[kind]);
	}
	check(level_l, COUNT(level_l), "an L with equal arms");
	check(other_l, COUNT(other_l), "an L with nearly equal arms");
	check(valley, COUNT(valley), "a valley");
	check(step, COUNT(step), "stairs");
	check(t, COUNT(t), "a T");
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(no_cut_is_where_it_points_inwards)};
	return cmocka_run_group_tests_name("pieces_notches", tests, NULL, NULL);
}
