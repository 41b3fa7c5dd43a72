#include "cpu/shapes.hpp"

#include <algorithm>

namespace carom::cpu {

/* Where the slot's textures are in the list. */
enum : int { FROM_DRAWS, FROM_MARKS, FROM_PLACED, FROM_VIEW, TO_BOXES, TO_SHAPES, TO_EDGES };

template <typename T> struct Scene {
	const Texels<T> draws, marks, placed;
	const ShapeWriter<T> to;
	const T line;
	const bool has_lines; /* of circles' radii */
	const PixelBox<T> picture, clip;

	Scene(const Job<T> &job, const Texels<T> &view)
		: draws(job.texels(FROM_DRAWS)), marks(job.texels(FROM_MARKS)), placed(job.texels(FROM_PLACED)),
		  to(job.records(TO_BOXES), job.records(TO_SHAPES), job.records(TO_EDGES)), line(view.fact(VIEW_SCALE, SCALE_LINE)),
		  has_lines(view.fact(VIEW_FIRST, FIRST_LINES) > 0), picture{0, 0, view.fact(VIEW_SCALE, SCALE_WIDTH), view.fact(VIEW_SCALE, SCALE_HEIGHT)},
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

/* What is seen of some circles. No circle waits for another, so compilers make vectors of them. */
template <typename T> struct Circles {
	static constexpr int32_t many = 8;

	/* To be set: the centres, and from there to the rim; pixels. */
	T x[many], y[many], rim_x[many], rim_y[many];
	T middle[many], outline[many]; /* of the ink */

	T radius[many], x0[many], y0[many], x1[many], y1[many], fill[many], width[many], opacity[many];
	T slope_x[many], slope_y[many], at[many], bend[many];

	/* (Single numbers, for of vectors of two compilers don't make vectors of many.) */
	void find(const PixelBox<T> &clip, T line)
	{
#pragma omp simd
		for (int32_t i = 0; i < many; i++) {
			radius[i] = std::sqrt(rim_x[i] * rim_x[i] + rim_y[i] * rim_y[i]);
			const T breadth = ((T(DISC_AREA) * radius[i]) * radius[i]) / larger(2 * radius[i], T(1)), r = radius[i] + growth(breadth);
			const Pixels<T> columns(x[i] - r, x[i] + r, T(0), clip.x0, clip.x1), rows(y[i] - r, y[i] + r, T(0), clip.y0, clip.y1);
			const bool any_column = columns.any(), any_row = rows.any(), any = any_column & any_row;
			x0[i] = any ? columns.begin : 0, x1[i] = any ? columns.end : 0;
			y0[i] = any ? rows.begin : 0, y1[i] = any ? rows.end : 0;
			fill[i] = fill_of(middle[i], outline[i], breadth, 2 * radius[i]);
			width[i] = outline_of(line, breadth);
			opacity[i] = opacity_of(T(1), breadth, 2 * radius[i]);
			const T fx = x0[i] + T(0.5), fy = y0[i] + T(0.5), dx = fx - x[i], dy = fy - y[i];
			const bool is_beside = std::abs(dx) > std::abs(dy);
			const T center = is_beside ? x[i] : y[i], first = is_beside ? fx : fy, other = is_beside ? dy : dx;
			const T square = ((center - r) - first) * ((center + r) - first) + other * other;
			slope_x[i] = dx / r, slope_y[i] = dy / r, at[i] = square / (2 * r), bend[i] = 1 / (2 * r);
		}
	}

	/* Circle i as that shape, and its radius line, where circles have them, as the next. */
	void write(int32_t i, const Scene<T> &scene, int32_t shape, int32_t rest) const
	{
		const PixelBox<T> box{x0[i], y0[i], x1[i], y1[i]};
		const bool is_seen = scene.to.shape(shape, box, {fill[i], outline[i], width[i], opacity[i]}, rest, 1);
		if (is_seen)
			scene.to.edge(shape, rest, 0, {slope_x[i], slope_y[i]}, at[i], bend[i]);
		if (!scene.has_lines)
			return;
		if (!is_seen || !(radius[i] >= SHOW_ANGLE)) {
			scene.to.hide(shape + 1);
			return;
		}
		const Vec<T> along(rim_x[i] / radius[i], rim_y[i] / radius[i]);
		const Line<T> line{{x[i], y[i]}, along, radius[i] - T(0.5) * scene.line, scene.line, outline[i], (radius[i] - SHOW_ANGLE) * (1 / SHOW_ANGLE)};
		line.write(scene.to, shape + 1, rest, scene.clip);
	}
};

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

/* What the host knows of a body. */
template <typename T> struct Drawn {
	int32_t vertex, count, shape, rest;
	Ink<T> ink;

	Drawn(const Scene<T> &scene, int32_t k)
		: vertex(part(scene, k, PARTS_VERTEX)), count(part(scene, k, PARTS_COUNT)), shape(part(scene, k, PARTS_SHAPE)),
		  rest(part(scene, k, PARTS_EDGE)), ink{scene.draws.of(DRAWS_WIDTH * k + DRAW_INK, INK_FILL),
												scene.draws.of(DRAWS_WIDTH * k + DRAW_INK, INK_OUTLINE), scene.line, 1}
	{
	}

private:
	static int32_t part(const Scene<T> &scene, int32_t k, int32_t channel)
	{
		return static_cast<int32_t>(scene.draws.of(DRAWS_WIDTH * k + DRAW_PARTS, channel));
	}
};

/* Bodies from k on, as many as Circles has room for or fewer. */
template <typename T> static void draw_bodies(const Scene<T> &scene, int32_t k, int32_t count, int32_t shape, int32_t rest)
{
	Circles<T> circles;
	for (int32_t i = 0; i < Circles<T>::many; i++) {
		const Drawn<T> body(scene, k + std::min(i, count - 1));
		const Vec<T> c = scene.center(body.vertex), to_rim = scene.offset(body.vertex);
		circles.x[i] = c.x(), circles.y[i] = c.y(), circles.rim_x[i] = to_rim.x(), circles.rim_y[i] = to_rim.y();
		circles.middle[i] = body.ink.fill, circles.outline[i] = body.ink.outline;
	}
	circles.find(scene.clip, scene.line);
	for (int32_t i = 0; i < count; i++) {
		const Drawn<T> body(scene, k + i);
		if (body.count == 1)
			circles.write(i, scene, shape + body.shape, rest + body.rest);
		else
			draw_polygon(scene, body.vertex, body.count, shape + body.shape, rest + body.rest, body.ink);
	}
}

template <typename T> static void convex(const Job<T> &job)
{
	const Texels<T> view = job.texels(FROM_VIEW);
	const Scene<T> scene(job, view);
	const int32_t marks = job.domain[2];
	const int32_t shape = static_cast<int32_t>(view.fact(VIEW_FIRST, FIRST_SHAPE));
	const int32_t rest = static_cast<int32_t>(view.fact(VIEW_FIRST, FIRST_EDGE));
	job.pool.run(job.domain[0], 512, [&](int32_t begin, int32_t end) {
		for (int32_t i = begin; i < std::min(end, marks); i++)
			draw_mark(scene, i, shape + i, rest + LINE_REST * i);
		for (int32_t i = std::max(begin, marks); i < end; i += Circles<T>::many)
			draw_bodies(scene, i - marks, std::min(end - i, Circles<T>::many), shape + marks, rest + LINE_REST * marks);
	});
}

extern const Stage shapes_convex;
const Stage shapes_convex{"shapes", "convex", {{STAGE_SHAPES, convex<float>, convex<double>}}, nullptr, nullptr};

}
