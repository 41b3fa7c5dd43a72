#include "cpu/shapes.hpp"

namespace carom::cpu {

/* Where the slot's textures are in the list. */
enum : int { FROM_DRAWS, FROM_MARKS, FROM_PLACED, FROM_VIEW, TO_BOXES, TO_SHAPES, TO_EDGES };

template <typename T> struct Scene {
	const Texels<T> draws, marks, placed;
	const ShapeWriter<T> to;
	const T line;
	const PixelBox<T> picture, clip;

	Scene(const Job<T> &job, const Texels<T> &view)
		: draws(job.texels(FROM_DRAWS)), marks(job.texels(FROM_MARKS)), placed(job.texels(FROM_PLACED)),
		  to(job.records(TO_BOXES), job.records(TO_SHAPES), job.records(TO_EDGES)),
		  line(view.fact(VIEW_SCALE, SCALE_LINE)), picture{0, 0, view.fact(VIEW_SCALE, SCALE_WIDTH), view.fact(VIEW_SCALE, SCALE_HEIGHT)},
		  clip{view.fact(VIEW_CLIP, BOX_X0), view.fact(VIEW_CLIP, BOX_Y0), view.fact(VIEW_CLIP, BOX_X1), view.fact(VIEW_CLIP, BOX_Y1)}
	{
	}

	Vec<T> offset(int32_t vertex) const { return {placed.of(vertex, PLACED_X), placed.of(vertex, PLACED_Y)}; }
	Vec<T> center(int32_t vertex) const { return {placed.of(vertex, PLACED_CENTER_X), placed.of(vertex, PLACED_CENTER_Y)}; }
};

template <typename T> static void draw_mark(const Scene<T> &scene, int32_t i, int32_t shape, int32_t rest)
{
	const int32_t place = MARKS_WIDTH * i + MARK_PLACE, style = MARKS_WIDTH * i + MARK_STYLE;
	const T x0 = scene.marks.of(place, 0), y0 = scene.marks.of(place, 1), x1 = scene.marks.of(place, 2), y1 = scene.marks.of(place, 3);
	const T color = scene.marks.of(style, STYLE_COLOR), breadth = scene.marks.of(style, STYLE_BREADTH);
	if (!(breadth > 0)) {
		scene.to.shape(shape, {x0, y0, x1, y1}, {color, color, 0, 1}, rest, 0);
		return;
	}
	const Vec<T> way(x1 - x0, y1 - y0);
	const T reach = norm(way);
	const Line<T> line{{x0, y0}, {way.x() / reach, way.y() / reach}, reach, breadth, color, 1};
	line.write(scene.to, shape, rest, scene.picture);
}

template <typename T> static void draw_circle(const Scene<T> &scene, int32_t vertex, int32_t shape, int32_t rest, const Ink<T> &ink)
{
	const Vec<T> to_rim = scene.offset(vertex), c = scene.center(vertex);
	const T radius = norm(to_rim), breadth = ((T(DISC_AREA) * radius) * radius) / larger(2 * radius, T(1)), r = radius + growth(breadth);
	const PixelBox<T> box = touched<T>({c.x() - r, c.y() - r}, {c.x() + r, c.y() + r}, 0, scene.clip);
	if (!scene.to.shape(shape, box, seen(ink, breadth, 2 * radius), rest, 1)) {
		scene.to.hide(shape + 1);
		return;
	}
	const Vec<T> f = box.first_pixel(), d = f - c;
	/* By indices, not by a branch: which way is as likely as the other. */
	const T centers[2] = {c.y(), c.x()}, firsts[2] = {f.y(), f.x()}, ways[2] = {d.y(), d.x()};
	const int main = std::abs(d.x()) > std::abs(d.y());
	const T square = ((centers[main] - r) - firsts[main]) * ((centers[main] + r) - firsts[main]) + ways[!main] * ways[!main];
	scene.to.edge(shape, rest, 0, {d.x() / r, d.y() / r}, square / (2 * r), 1 / (2 * r));
	if (!(radius >= SHOW_ANGLE)) {
		scene.to.hide(shape + 1);
		return;
	}
	const Vec<T> along(to_rim.x() / radius, to_rim.y() / radius);
	const T opacity = (radius - SHOW_ANGLE) * (1 / SHOW_ANGLE);
	const Line<T> line{c, along, radius - T(0.5) * scene.line, scene.line, ink.outline, opacity};
	line.write(scene.to, shape + 1, rest, scene.clip);
}

/* (Single numbers: where compilers copy vectors as words that were written by halves, processors wait.) */
template <typename T> struct Extent {
	T low_x, low_y, high_x, high_y, area;

	Vec<T> low() const { return {low_x, low_y}; }
	Vec<T> high() const { return {high_x, high_y}; }
};

template <typename T> static Extent<T> measure(const Scene<T> &scene, int32_t vertex, int32_t count)
{
	const T x0 = scene.placed.of(vertex, PLACED_X), y0 = scene.placed.of(vertex, PLACED_Y);
	Extent<T> all{x0, y0, x0, y0, 0};
	T before_x = 0, before_y = 0, twice = 0;
	for (int32_t k = 1; k < count; k++) {
		const T x = scene.placed.of(vertex + k, PLACED_X), y = scene.placed.of(vertex + k, PLACED_Y);
		all.low_x = smaller(all.low_x, x);
		all.low_y = smaller(all.low_y, y);
		all.high_x = larger(all.high_x, x);
		all.high_y = larger(all.high_y, y);
		twice = twice + cross(Vec<T>(x - x0, y - y0), Vec<T>(before_x, before_y));
		before_x = x - x0;
		before_y = y - y0;
	}
	all.area = T(0.5) * twice;
	return all;
}

template <typename T> static void draw_polygon(const Scene<T> &scene, int32_t vertex, int32_t count, int32_t shape, int32_t rest, const Ink<T> &ink)
{
	const Extent<T> all = measure(scene, vertex, count);
	const Vec<T> c = scene.center(vertex);
	const T size = norm(all.high() - all.low()), breadth = all.area / larger(size, T(1)), out = growth(breadth);
	const PixelBox<T> box = touched<T>(c + all.low(), c + all.high(), out, scene.clip);
	if (!scene.to.shape(shape, box, seen(ink, breadth, size), rest, count))
		return;
	const Vec<T> d = box.first_pixel() - c;
	for (int32_t k = 0; k < count; k++) {
		const Vec<T> from = scene.offset(vertex + k), to = scene.offset(vertex + (k + 1 < count ? k + 1 : 0)), side = to - from;
		const T length = norm(side);
		const Vec<T> n(-side.y() / length, side.x() / length);
		if (length > 0)
			scene.to.edge(shape, rest, k, n, inner(n, d - from) - out, 0);
		else
			scene.to.edge(shape, rest, k, {0, 0}, NO_EDGE, 0);
	}
}

template <typename T> static void draw_body(const Scene<T> &scene, int32_t k, int32_t shape, int32_t rest)
{
	const int32_t parts = DRAWS_WIDTH * k + DRAW_PARTS, with = DRAWS_WIDTH * k + DRAW_INK;
	const int32_t vertex = static_cast<int32_t>(scene.draws.of(parts, PARTS_VERTEX));
	const int32_t count = static_cast<int32_t>(scene.draws.of(parts, PARTS_COUNT));
	const Ink<T> ink{scene.draws.of(with, INK_FILL), scene.draws.of(with, INK_OUTLINE), scene.line, 1};
	shape += static_cast<int32_t>(scene.draws.of(parts, PARTS_SHAPE));
	rest += static_cast<int32_t>(scene.draws.of(parts, PARTS_EDGE));
	if (count == 1)
		draw_circle(scene, vertex, shape, rest, ink);
	else
		draw_polygon(scene, vertex, count, shape, rest, ink);
}

template <typename T> static void convex(const Job<T> &job)
{
	const Texels<T> view = job.texels(FROM_VIEW);
	const Scene<T> scene(job, view);
	const int32_t marks = job.domain[2];
	const int32_t shape = static_cast<int32_t>(view.fact(VIEW_FIRST, FIRST_SHAPE));
	const int32_t rest = static_cast<int32_t>(view.fact(VIEW_FIRST, FIRST_EDGE));
	job.pool.run(job.domain[0], 512, [&](int32_t begin, int32_t end) {
		for (int32_t i = begin; i < end; i++) {
			if (i < marks)
				draw_mark(scene, i, shape + i, rest + LINE_REST * i);
			else
				draw_body(scene, i - marks, shape + marks, rest + LINE_REST * marks);
		}
	});
}

extern const Stage shapes_convex;
const Stage shapes_convex{"shapes", "convex", {{STAGE_SHAPES, convex<float>, convex<double>}}, nullptr, nullptr};

}
