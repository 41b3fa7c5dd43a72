/* The pieces of polygons that are not convex, of random ones: they are convex, and together they are the polygon.
 * SPDX-License-Identifier: MIT */
#include <math.h>

#include "count.h"
#include "hollows.h"
#include "pieces.h"

enum { POLYGONS = 3000, POINTS = 200 };
#define ROUNDED 2e-6 /* m, of polygons of a radius of 1: what rounding to floats does to a piece */

/* How far a point is in front of a convex polygon's sides, at most. */
static double in_front(const carom_vec2 *piece, uint32_t count, double x, double y)
{
	double most = -HUGE_VAL;
	for (uint32_t k = 0; k < count; k++) {
		const carom_vec2 a = piece[k], b = piece[(k + 1) % count];
		const double ex = (double)b.x - (double)a.x, ey = (double)b.y - (double)a.y;
		most = fmax(most, (ey * (x - (double)a.x) - ex * (y - (double)a.y)) / hypot(ex, ey));
	}
	return most;
}

static double in_front_of_all(const carom_pieces *pieces, double x, double y)
{
	const carom_vec2 *piece = pieces->vertices;
	double least = HUGE_VAL;
	for (uint32_t k = 0; k < pieces->count; piece += pieces->sizes[k++])
		least = fmin(least, in_front(piece, pieces->sizes[k], x, y));
	return least;
}

static void check_points(scenery_random *random, const solid *s, const carom_pieces *pieces, int polygon)
{
	for (int i = 0; i < POINTS; i++) {
		const uint32_t k = (uint32_t)scenery_uniform(random, 0, (float)s->count - 0.01f);
		const double half = i % 2 ? 0.1 : 1.0; /* near a corner, or anywhere */
		const double x = (i % 2 ? s->corners[k][0] : 0) + half * (double)scenery_uniform(random, -1, 1);
		const double y = (i % 2 ? s->corners[k][1] : 0) + half * (double)scenery_uniform(random, -1, 1);
		const double of_outline = hollows_distance(s, x, y), of_pieces = in_front_of_all(pieces, x, y);
		if (fabs(of_outline) > ROUNDED && (of_outline < 0 ? of_pieces > ROUNDED : of_pieces < -ROUNDED))
			fail_msg("polygon %d, (%.9g, %.9g): %g from the polygon, %g from its pieces", polygon, x, y, of_outline, of_pieces);
	}
}

static void pieces_are_the_polygon(void **unused)
{
	scenery_random random = {11};
	(void)unused;
	for (int i = 0; i < POLYGONS; i++) {
		carom_vec2 vertices[CAROM_MAX_VERTICES];
		carom_pieces pieces;
		const uint32_t count = hollows_make(&random, (hollow_kind)(i % HOLLOW_KINDS), 1.0f, vertices);
		const solid s = hollows_solid(vertices, count);
		carom_pieces_make(vertices, count, &pieces);
		check_points(&random, &s, &pieces, i);
	}
}

/* Of the cuts that are needed no more than two end in each corner that points inwards (Hertel and Mehlhorn). */
static void pieces_are_few(void **unused)
{
	scenery_random random = {12};
	size_t all = 0, corners = 0, needed = 0;
	(void)unused;
	for (int i = 0; i < POLYGONS; i++) {
		carom_vec2 vertices[CAROM_MAX_VERTICES];
		carom_pieces pieces;
		const uint32_t count = hollows_make(&random, (hollow_kind)(i % HOLLOW_KINDS), 1.0f, vertices), reflex = hollows_reflex(vertices, count);
		carom_pieces_make(vertices, count, &pieces);
		if (pieces.count > 2 * reflex + 1 || pieces.count > CAROM_MOST_PIECES)
			fail_msg("polygon %d: %u pieces of %u vertices, of which %u turn to the right", i, pieces.count, count, reflex);
		all += pieces.count;
		needed += 1 + reflex / 2;
		for (uint32_t k = 0; k < pieces.count; k++) {
			assert_true(pieces.sizes[k] >= 3);
			corners += pieces.sizes[k];
		}
	}
	print_message("%zu pieces of polygons that need %zu at least, %.2f vertices each\n", all, needed, (double)corners / (double)all);
}

/* As far as floats can tell: a vertex that is moved by their rounding turns no more. */
static void check_convex(const carom_pieces *pieces, int polygon)
{
	const carom_vec2 *piece = pieces->vertices;
	for (uint32_t k = 0; k < pieces->count; piece += pieces->sizes[k++])
		for (uint32_t v = 0; v < pieces->sizes[k]; v++) {
			const double front = in_front(piece, pieces->sizes[k], (double)piece[v].x, (double)piece[v].y);
			if (front > ROUNDED)
				fail_msg("polygon %d, piece %u: vertex %u is %g in front of a side", polygon, k, v, front);
		}
}

static void pieces_are_convex(void **unused)
{
	scenery_random random = {13};
	(void)unused;
	for (int i = 0; i < POLYGONS; i++) {
		carom_vec2 vertices[CAROM_MAX_VERTICES];
		carom_pieces pieces;
		carom_pieces_make(vertices, hollows_make(&random, (hollow_kind)(i % HOLLOW_KINDS), 1.0f, vertices), &pieces);
		check_convex(&pieces, i);
	}
}

/* The upper piece can't grow over the cut: where that begins it is flat. */
static void a_cut_goes_on_a_side(void **unused)
{
	static const carom_vec2 corners[] = {{1, 0}, {2, 0}, {2, 1}, {3, 2}, {0, 2}, {0, 1}, {1, 1}};
	const solid s = hollows_solid(corners, COUNT(corners));
	scenery_random random = {15};
	carom_pieces pieces;
	(void)unused;
	carom_pieces_make(corners, COUNT(corners), &pieces);
	check_convex(&pieces, 0);
	check_points(&random, &s, &pieces, 0);
}

/* Vertices of the polygon alone, convex without a flat one, and the polygon is in it, but for vertices within its sides. */
static void hull_holds_the_polygon(void **unused)
{
	scenery_random random = {14};
	(void)unused;
	for (int i = 0; i < POLYGONS; i++) {
		carom_vec2 vertices[CAROM_MAX_VERTICES];
		carom_pieces pieces;
		const uint32_t count = hollows_make(&random, (hollow_kind)(i % HOLLOW_KINDS), 1.0f, vertices);
		carom_pieces_make(vertices, count, &pieces);
		assert_true(pieces.hull_count >= 3 && pieces.hull_count <= count && hollows_reflex(pieces.hull, pieces.hull_count) == 0);
		for (uint32_t k = 0; k < count; k++)
			assert_true(in_front(pieces.hull, pieces.hull_count, (double)vertices[k].x, (double)vertices[k].y) < 1e-6);
		for (uint32_t k = 0; k < pieces.hull_count; k++) {
			uint32_t same = 0;
			while (same < count && (vertices[same].x != pieces.hull[k].x || vertices[same].y != pieces.hull[k].y))
				same++;
			assert_true(same < count);
		}
	}
}

/* An L is two bars, each as long as the L. */
static void pieces_of_an_l_overlap(void **unused)
{
	static const carom_vec2 corners[] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
	carom_pieces pieces;
	(void)unused;
	carom_pieces_make(corners, COUNT(corners), &pieces);
	assert_int_equal(pieces.count, 2);
	assert_int_equal(pieces.hull_count, 5);
	double least = HUGE_VAL; /* how deep the corner that points inwards is in both */
	for (uint32_t k = 0; k < 2; k++)
		least = fmin(least, -in_front(pieces.vertices + (k ? pieces.sizes[0] : 0), pieces.sizes[k], 0.9, 0.9));
	print_message("%u and %u vertices; a tenth from the corner it is %g deep in both\n", pieces.sizes[0], pieces.sizes[1], least);
	assert_true(least > 0.01);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(pieces_are_the_polygon), cmocka_unit_test(pieces_are_few),
		cmocka_unit_test(pieces_are_convex), cmocka_unit_test(a_cut_goes_on_a_side), cmocka_unit_test(hull_holds_the_polygon),
		cmocka_unit_test(pieces_of_an_l_overlap)};
	return cmocka_run_group_tests_name("pieces", tests, NULL, NULL);
}
