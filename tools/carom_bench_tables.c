/* The paper's tables: what each compares, and its figures, in seconds for 1,000 repetitions. They were measured on an
 * NVIDIA GeForce 7900 GS and an Intel Core 2 Duo of 1.86 GHz.
 * SPDX-License-Identifier: MIT */
#include "carom_bench.h"

#define ITEMS(array) array, sizeof(array) / sizeof *(array)
#define PAPER(...) ((const double[PAPER_SIZES]){__VA_ARGS__})
#define BISECTION               \
	{                           \
		"toi_first", "toi_next" \
	}

/* ---- Table 1 [2.1] ---- */

static const struct bench_subject bisection_subjects[] = {
	{"inside", 3, WORK_STEPS, PLACE_CHOSEN, 0, {"toi=bisection"}, false},
	{"outside", 3, WORK_STEPS, PLACE_CHOSEN, 1, {"toi=bisection"}, false},
};

static const struct bench_column bisection_columns[] = {
	{"inside", 0, BISECTION, PAPER(0.61, 0.72, 0.76, 1.14), NULL, NULL, 0},
	{"outside", 1, BISECTION, PAPER(1.15, 1.7875, 10.2, 10.6), NULL, NULL, 1},
};

static const struct bench_part bisection_parts[] = {{"triangles", ITEMS(bisection_subjects), ITEMS(bisection_columns)}};

const struct bench_table bench_table1 = {
	.name = "table1",
	.title = "Table 1: 1,000 runs of the bisection kernels",
	.chart = "Table 1: bisection inside the kernel and outside",
	.unit = "seconds for 1,000 runs (ms each)",
	.notes = "The kernels are toi_first and toi_next with toi=bisection, which finds a hit time to 2^-18 of a step.\n"
			 "inside: one pass makes all 18 halvings; outside: 18 passes make one each.\n"
			 "The paper does not say its epsilon, nor how full its scene is; this one is filled to a quarter.\n",
	.least = 8,
	.most = 11,
	.parts = ITEMS(bisection_parts),
};

/* ---- Table 2 [2.2] ---- */

static const struct bench_subject reduce_subjects[] = {
	{"classic", 3, WORK_STEPS, PLACE_CHOSEN, 0, {"reduce=classic"}, false},
	{"six", 3, WORK_STEPS, PLACE_CHOSEN, 0, {"reduce=six"}, false},
	{"four_six", 3, WORK_STEPS, PLACE_CHOSEN, 0, {"reduce=four_six"}, false},
	{"tiled", 3, WORK_STEPS, PLACE_CHOSEN, 0, {"reduce=tiled"}, false},
};

static const struct bench_column reduce_columns[] = {
	{"classic", 0, {"reduce"}, PAPER(1.422, 1.75, 2.031, 3.187, 14.265), NULL, NULL, 0},
	{"six", 1, {"reduce"}, PAPER(1.625, 1.906, 2.047, 2.437, 10.939), NULL, NULL, 1},
	{"four_six", 2, {"reduce"}, PAPER(1.532, 1.438, 1.656, 1.831, 6.484), NULL, NULL, 2},
	{"tiled", 3, {"reduce_tiles"}, NULL, NULL, "tiled (not in the paper)", 3},
};

static const struct bench_part reduce_parts[] = {{"triangles", ITEMS(reduce_subjects), ITEMS(reduce_columns)}};

const struct bench_table bench_table2 = {
	.name = "table2",
	.title = "Table 2: 1,000 complete minimisations of the hit times",
	.chart = "Table 2: the least of all hit times",
	.unit = "seconds for 1,000 minimisations (ms each)",
	.notes = "The kernel is reduce, or reduce_tiles for tiled, all passes of a step together.\n"
			 "tiled is not the whole work: it begins with TileHits, the minimum of each 8 x 8 pairs, which toi writes.\n",
	.least = 8,
	.most = 12,
	.parts = ITEMS(reduce_parts),
};

/* ---- Table 3 [3] ---- */

static const struct bench_subject picture_subjects[] = {
	{"option 1, index", 3, WORK_PICTURES, PLACE_CHOSEN, 0, {"vertices=option1", "transforms=index"}, false},
	{"option 1, to_cpu", 3, WORK_PICTURES, PLACE_CHOSEN, 0, {"vertices=option1", "transforms=to_cpu"}, false},
	{"option 2, index", 3, WORK_PICTURES, PLACE_CHOSEN, 0, {"vertices=option2", "transforms=index"}, false},
	{"option 2, to_cpu", 3, WORK_PICTURES, PLACE_CHOSEN, 0, {"vertices=option2", "transforms=to_cpu"}, false},
	{"option 3, index", 3, WORK_PICTURES, PLACE_CHOSEN, 0, {"vertices=option3", "transforms=index"}, false},
	{"option 3, to_cpu", 3, WORK_PICTURES, PLACE_CHOSEN, 0, {"vertices=option3", "transforms=to_cpu"}, false},
};

static const struct bench_column picture_columns[] = {
	{"option 1, index", 0, {NULL}, PAPER(16.6599, 25.9099, 51.58, 117.26), "index: whole renderings", "option 1", 0},
	{"option 1, to_cpu", 1, {NULL}, PAPER(16.6599, 26.2399, 49.11, 102.279), "to_cpu: whole renderings", "option 1", 0},
	{"option 2, index", 2, {NULL}, PAPER(16.6499, 25.87, 50.91, 102.379), "index: whole renderings", "option 2", 1},
	{"option 2, to_cpu", 3, {NULL}, PAPER(16.6499, 23.9699, 45.6399, 89.75), "to_cpu: whole renderings", "option 2", 1},
	{"option 3, index", 4, {NULL}, PAPER(16.6599, 16.67, 33.33, 65.5299), "index: whole renderings", "option 3", 2},
	{"option 3, to_cpu", 5, {NULL}, PAPER(16.6599, 16.6599, 16.6599, 16.6599), "to_cpu: whole renderings", "option 3", 2},
};

static const struct bench_column vertex_columns[] = {
	{"option 1, index", 0, {"vertices"}, NULL, "index: the kernel vertices alone", "option 1", 0},
	{"option 1, to_cpu", 1, {"vertices"}, NULL, "to_cpu: the kernel vertices alone", "option 1", 0},
	{"option 2, index", 2, {"vertices"}, NULL, "index: the kernel vertices alone", "option 2", 1},
	{"option 2, to_cpu", 3, {"vertices"}, NULL, "to_cpu: the kernel vertices alone", "option 2", 1},
	{"option 3, index", 4, {"vertices"}, NULL, "index: the kernel vertices alone", "option 3", 2},
	{"option 3, to_cpu", 5, {"vertices"}, NULL, "to_cpu: the kernel vertices alone", "option 3", 2},
};

static const struct bench_part picture_parts[] = {
	{"triangles, whole renderings", ITEMS(picture_subjects), ITEMS(picture_columns)},
	{"triangles, of that the kernel vertices", ITEMS(picture_subjects), ITEMS(vertex_columns)},
};

const struct bench_table bench_table3 = {
	.name = "table3",
	.title = "Table 3: 1,000 renderings by the six combinations of the rendering phase",
	.chart = "Table 3: the rendering phase",
	.unit = "seconds for 1,000 renderings (ms each)",
	.notes = "A whole rendering is one call of carom_world_render, by the wall clock: 640 x 480 pixels, drawn and read back\n"
			 "to the host. The six differ only in how vertices are placed: in the kernel vertices, and with to_cpu in reading\n"
			 "the state back and sending it again, which is in no kernel's time. The pixels take the rest.\n"
			 "The paper's 16.66 s are 1/60 s a picture: its display's, and only an upper bound of what its work takes.\n",
	.least = 8,
	.most = 11,
	.parts = ITEMS(picture_parts),
};

/* ---- Table 4 [4] ---- */

static const struct bench_subject circle_subjects[] = {
	{"OpenCL-algebraic", 0, WORK_STEPS, PLACE_OPENCL, 0, {"toi=circle_quadratic"}, false},
	{"OpenCL-bisection", 0, WORK_STEPS, PLACE_OPENCL, 0, {"toi=bisection"}, false},
	{"CPU-algebraic", 0, WORK_STEPS, PLACE_CPU, 0, {"toi=circle_quadratic"}, false},
	{"CPU-bisection", 0, WORK_STEPS, PLACE_CPU, 0, {"toi=bisection"}, false},
};

static const struct bench_subject drawn_circle_subjects[] = {
	{"OpenCL-algebraic", 0, WORK_DRAWN_STEPS, PLACE_OPENCL, 0, {"toi=circle_quadratic"}, false},
	{"OpenCL-bisection", 0, WORK_DRAWN_STEPS, PLACE_OPENCL, 0, {"toi=bisection"}, false},
	{"CPU-algebraic", 0, WORK_DRAWN_STEPS, PLACE_CPU, 0, {"toi=circle_quadratic"}, false},
	{"CPU-bisection", 0, WORK_DRAWN_STEPS, PLACE_CPU, 0, {"toi=bisection"}, false},
};

static const struct bench_subject polygon_subjects[] = {
	{"OpenCL-bisection", 3, WORK_STEPS, PLACE_OPENCL, 0, {"toi=bisection"}, true},
	{"OpenCL-separating", 3, WORK_STEPS, PLACE_OPENCL, 0, {"toi=separating"}, true},
	{"CPU-bisection", 3, WORK_STEPS, PLACE_CPU, 0, {"toi=bisection"}, true},
	{"CPU-separating", 3, WORK_STEPS, PLACE_CPU, 0, {"toi=separating"}, true},
};

static const struct bench_subject drawn_polygon_subjects[] = {
	{"OpenCL-bisection", 3, WORK_DRAWN_STEPS, PLACE_OPENCL, 0, {"toi=bisection"}, true},
	{"OpenCL-separating", 3, WORK_DRAWN_STEPS, PLACE_OPENCL, 0, {"toi=separating"}, true},
	{"CPU-bisection", 3, WORK_DRAWN_STEPS, PLACE_CPU, 0, {"toi=bisection"}, true},
	{"CPU-separating", 3, WORK_DRAWN_STEPS, PLACE_CPU, 0, {"toi=separating"}, true},
};

static const struct bench_column circle_columns[] = {
	{"OpenCL-algebraic", 0, {NULL}, NULL, NULL, NULL, 2},
	{"OpenCL-bisection", 1, {NULL}, NULL, NULL, NULL, 0},
	{"CPU-algebraic", 2, {NULL}, NULL, NULL, NULL, 3},
	{"CPU-bisection", 3, {NULL}, NULL, NULL, NULL, 1},
};

static const struct bench_column drawn_circle_columns[] = {
	{"OpenCL-algebraic", 0, {NULL}, PAPER(33.62, 50.16, 83.49, 166.79), NULL, NULL, 2},
	{"OpenCL-bisection", 1, {NULL}, PAPER(33.56, 50.16, 83.47, 166.89), NULL, NULL, 0},
	{"CPU-algebraic", 2, {NULL}, NULL, NULL, NULL, 3},
	{"CPU-bisection", 3, {NULL}, PAPER(33.33, 86.14, 356.42, 1603.1), NULL, NULL, 1},
};

/* The paper's: the plain sums of table 5's rows. */
static const struct bench_column polygon_columns[] = {
	{"OpenCL-bisection", 0, {NULL}, PAPER(1.3789, 1.9768, 3.9899, 11.58), NULL, NULL, 0},
	{"OpenCL-separating", 1, {NULL}, NULL, NULL, NULL, 4},
	{"CPU-bisection", 2, {NULL}, NULL, NULL, NULL, 1},
	{"CPU-separating", 3, {NULL}, NULL, NULL, NULL, 5},
};

static const struct bench_column drawn_polygon_columns[] = {
	{"OpenCL-bisection", 0, {NULL}, PAPER(17.47, 17.5, 26.83, 67.62), NULL, NULL, 0},
	{"OpenCL-separating", 1, {NULL}, NULL, NULL, NULL, 4},
	{"CPU-bisection", 2, {NULL}, PAPER(16.66, 36.27, 192.63, 810), NULL, NULL, 1},
	{"CPU-separating", 3, {NULL}, NULL, NULL, NULL, 5},
};

static const struct bench_part case_parts[] = {
	{"circles, drawn", ITEMS(drawn_circle_subjects), ITEMS(drawn_circle_columns)},
	{"triangles, drawn", ITEMS(drawn_polygon_subjects), ITEMS(drawn_polygon_columns)},
	{"circles, not drawn", ITEMS(circle_subjects), ITEMS(circle_columns)},
	{"triangles, not drawn (paper: kernels alone)", ITEMS(polygon_subjects), ITEMS(polygon_columns)},
};

const struct bench_table bench_table4 = {
	.name = "table4",
	.title = "Table 4: 1,000 whole steps, by the wall clock",
	.chart = "Table 4: whole steps",
	.unit = "seconds for 1,000 steps (ms each)",
	.notes = "Compare like with like. The paper's table 4 includes drawing and waiting for the display: its small rows are\n"
			 "multiples of 1/60 s a step. So it stands beside our steps with a picture of 640 x 480 pixels each, drawn into\n"
			 "memory; we wait for no display. Beside our OpenCL-bisection of triangles without drawing stands the sum of the\n"
			 "paper's table 5, the kernels alone: 11.6 ms a step at 2^11. For the rest it has no figure without drawing.\n"
			 "The defaults are algebraic for circles (toi=circle_quadratic) and separating for triangles: no hit is missed.\n"
			 "Walls are as in the paper: circles are reflected by a room's; of the bodies with triangles four are static boxes.\n"
			 "CPU is Carom's CPU fallback.\n",
	.least = 8,
	.most = 11,
	.parts = ITEMS(case_parts),
};

/* ---- Table 5 [4] ---- */

#define FORWARD "forward_no_collision", "forward_collision"

static const struct bench_subject kernel_subjects[] = {{"all kernels", 3, WORK_STEPS, PLACE_CHOSEN, 0, {"toi=bisection"}, true}};

static const struct bench_column kernel_columns[] = {
	{"Update", 0, {"aabb"}, PAPER(0.1599, 0.17, 0.1899, 0.23), "Update", "", 0},
	{"Overlap", 0, {"overlap"}, PAPER(0.25, 0.6869, 2.47, 9.46), "Overlap", "", 0},
	{"Bisection", 0, BISECTION, PAPER(0.61, 0.72, 0.76, 1.14), "Bisection", "", 0},
	{"Impulse", 0, {"impulse"}, PAPER(0.32, 0.32, 0.36, 0.52), "Impulse", "", 0},
	{"Forward", 0, {FORWARD}, PAPER(0.039, 0.0799, 0.21, 0.23), "Forward", "", 0},
	{"sum of these", 0, {"aabb", "overlap", "toi_first", "toi_next", "impulse", FORWARD}, PAPER(1.3789, 1.9768, 3.9899, 11.58), "Sum of these five",
		"", 0},
	{"reduce", 0, {"reduce", "reduce_tiles"}, NULL, "Reduce (in the paper: table 2)", "", 0},
	{"first", 0, {"first"}, NULL, "First (not in the paper)", "", 0},
	{"whole step", 0, {NULL}, NULL, "Sum of these five", "whole step by the wall clock", 1},
};

static const struct bench_part kernel_parts[] = {{"triangles", ITEMS(kernel_subjects), ITEMS(kernel_columns)}};

const struct bench_table bench_table5 = {
	.name = "table5",
	.title = "Table 5: the kernels in 1,000 steps",
	.chart = "Table 5: the kernels of a step",
	.unit = "seconds for 1,000 steps (ms each)",
	.notes = "Update is the kernel aabb, Bisection toi_first with toi=bisection, Forward forward_no_collision and\n"
			 "forward_collision. The paper runs Impulse and CollisionForward only after a collision. Ours run in each step,\n"
			 "since the device decides whether it collides; what is not needed does nothing. Our Impulse has one texel, for the\n"
			 "pair that hits, the paper's N x N. reduce and first are not in the paper's table: its reduction is table 2. Four of\n"
			 "the bodies are walls, static boxes, as in the paper. whole step is the wall clock while kernels are measured: launches\n"
			 "and waiting are in it.\n",
	.least = 8,
	.most = 11,
	.parts = ITEMS(kernel_parts),
};
