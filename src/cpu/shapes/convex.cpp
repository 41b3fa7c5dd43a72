#include "cpu/lanes.hpp"
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

constexpr int32_t batch = 16; /* bodies that are drawn together */

/* What the host knows of some bodies. */
template <typename T> struct Drawn {
	int32_t vertex[batch], count[batch], shape[batch], rest[batch];
	T fill[batch], outline[batch];

	/* So many, which lie in one row. */
	void take(const Texels<T> &draws, int32_t first, int32_t so_many)
	{
		const int32_t parts = DRAWS_WIDTH * first + DRAW_PARTS, ink = DRAWS_WIDTH * first + DRAW_INK;
		const T *const vertices = &draws.of(parts, PARTS_VERTEX), *const counts = &draws.of(parts, PARTS_COUNT);
		const T *const shapes = &draws.of(parts, PARTS_SHAPE), *const edges = &draws.of(parts, PARTS_EDGE);
		const T *const fills = &draws.of(ink, INK_FILL), *const outlines = &draws.of(ink, INK_OUTLINE);
#pragma omp simd
		for (int32_t i = 0; i < so_many; i++) {
			vertex[i] = static_cast<int32_t>(vertices[DRAWS_WIDTH * i]), count[i] = static_cast<int32_t>(counts[DRAWS_WIDTH * i]);
			shape[i] = static_cast<int32_t>(shapes[DRAWS_WIDTH * i]), rest[i] = static_cast<int32_t>(edges[DRAWS_WIDTH * i]);
			fill[i] = fills[DRAWS_WIDTH * i], outline[i] = outlines[DRAWS_WIDTH * i];
		}
	}

	/* So many are left of the row. */
	static int32_t left(int32_t first)
	{
		return (ROW_SIZE - (DRAWS_WIDTH * first & (ROW_SIZE - 1))) / DRAWS_WIDTH;
	}
};

/* What is seen of some circles, four side by side. What can be found of all is found of all first: no circle waits for another, and processors do much of it at once. */
template <typename T> class Circles
{
public:
	/* Before any is written. */
	void find(const Scene<T> &scene, const Drawn<T> &bodies)
	{
		const Lanes<T> zero{}, one = zero + 1;
		Lanes<T> x[fours], y[fours], radius[fours], breadth[fours], r[fours], x0[fours], y0[fours];
		for (int32_t k = 0; k < fours; k++) { /* where they are, and how large */
			const auto placed = [&](int32_t channel) {
				const auto of = [&](int32_t i) { return scene.placed.of(bodies.vertex[lane_count * k + i], channel); };
				return Lanes<T>{of(0), of(1), of(2), of(3)};
			};
			x[k] = placed(PLACED_CENTER_X), y[k] = placed(PLACED_CENTER_Y);
			const Lanes<T> rim_x = placed(PLACED_X), rim_y = placed(PLACED_Y);
			radius[k] = roots(rim_x * rim_x + rim_y * rim_y);
			keep(x[k], y[k], rim_x, rim_y, place + lane_count * k);
		}
		for (int32_t k = 0; k < fours; k++) { /* how broad they would be as lines, and how far they are seen */
			breadth[k] = ((DISC_AREA * radius[k]) * radius[k]) / larger(Lanes<T>(2 * radius[k]), one);
			r[k] = radius[k] + growth(breadth[k]);
		}
		for (int32_t k = 0; k < fours; k++) { /* the pixels that they are in */
			const Pixels<Lanes<T>> columns(x[k] - r[k], x[k] + r[k], zero, zero + scene.clip.x0, zero + scene.clip.x1);
			const Pixels<Lanes<T>> rows(y[k] - r[k], y[k] + r[k], zero, zero + scene.clip.y0, zero + scene.clip.y1);
			const auto any = (columns.begin < columns.end) & (rows.begin < rows.end);
			x0[k] = any ? columns.begin : zero, y0[k] = any ? rows.begin : zero;
			keep(x0[k], y0[k], any ? columns.end : zero, any ? rows.end : zero, box + lane_count * k);
		}
		for (int32_t k = 0; k < fours; k++) { /* how far the first of these is from their edge */
			const Lanes<T> fx = x0[k] + T(0.5), fy = y0[k] + T(0.5), dx = fx - x[k], dy = fy - y[k];
			const auto is_beside = magnitude(dx) > magnitude(dy);
			const Lanes<T> center = is_beside ? x[k] : y[k], first = is_beside ? fx : fy, other = is_beside ? dy : dx;
			const Lanes<T> square = ((center - r[k]) - first) * ((center + r[k]) - first) + other * other;
			keep(dx / r[k], dy / r[k], square / (2 * r[k]), 1 / (2 * r[k]), edge + lane_count * k);
		}
		for (int32_t k = 0; k < fours; k++) { /* their ink */
			Lanes<T> middle, outline;
			std::memcpy(&middle, bodies.fill + lane_count * k, sizeof middle);
			std::memcpy(&outline, bodies.outline + lane_count * k, sizeof outline);
			keep(fill_of<Lanes<T>>(middle, outline, breadth[k], 2 * radius[k]), outline, outline_of<Lanes<T>>(zero + scene.line, breadth[k]),
				opacity_of<Lanes<T>>(one, breadth[k], 2 * radius[k]), ink + lane_count * k);
		}
	}

	/* Circle i as that shape, and its radius line, where circles have them, as the next. */
	void write(int32_t i, const Scene<T> &scene, int32_t shape, int32_t rest) const
	{
		const bool is_seen = scene.to.shape(shape, box[i], ink[i], rest, edge[i]);
		if (!scene.has_lines)
			return;
		const Vec<T> at(place[i][0], place[i][1]), rim(place[i][2], place[i][3]);
		const T radius = norm(rim);
		if (!is_seen || !(radius >= SHOW_ANGLE)) {
			scene.to.hide(shape + 1);
			return;
		}
		const Line<T> line{at, {rim.x() / radius, rim.y() / radius}, radius - T(0.5) * scene.line, scene.line, ink[i][INK_OUTLINE],
			(radius - SHOW_ANGLE) * (1 / SHOW_ANGLE)};
		line.write(scene.to, shape + 1, rest, scene.clip);
	}

private:
	static constexpr int32_t fours = batch / lane_count;

	static Lanes<T> roots(Lanes<T> squares)
	{
		for (int32_t i = 0; i < lane_count; i++)
			squares[i] = std::sqrt(squares[i]);
		return squares;
	}

	static void keep(const Lanes<T> &first, const Lanes<T> &second, const Lanes<T> &third, const Lanes<T> &fourth, T (*records)[channel_count])
	{
		Lanes<T> rows[lane_count] = {first, second, third, fourth};
		transpose<T>(rows);
		std::memcpy(records, rows, sizeof rows);
	}

	T box[batch][channel_count], ink[batch][channel_count], edge[batch][channel_count], place[batch][channel_count];
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

/* The sides of a polygon, one after the other: calls `visit(k, from, to)` with their ends about its centre. */
template <typename T, typename Visit> static void visit_sides(const Scene<T> &scene, int32_t vertex, int32_t count, Visit visit)
{
	for (int32_t k = 0; k < count; k++)
		visit(k, scene.offset(vertex + k), scene.offset(k == count - 1 ? vertex : vertex + k + 1));
}

/* A polygon that is not convex. */
template <typename T> static void draw_outline(const Scene<T> &scene, int32_t vertex, int32_t count, int32_t shape, int32_t rest, const Ink<T> &ink)
{
	const Extent<T> all = measure(scene, vertex, count);
	const Vec<T> c = scene.center(vertex);
	T around = 0;
	visit_sides(scene, vertex, count, [&](int32_t, const Vec<T> &from, const Vec<T> &to) { around += norm(to - from); });
	const T size = norm(all.high() - all.low()), breadth = all.area / larger(T(0.5) * around, T(1)), out = growth(breadth);
	const PixelBox<T> box = touched<T>(c + all.low(), c + all.high(), out, scene.clip);
	Ink<T> its = seen(ink, breadth, size);
	its.fill = fill_of(ink.fill, ink.outline, all.area / larger(size, T(1)), size); /* a long one that is wound up is no line */
	if (!scene.to.shape(shape, box, its, rest, -count))
		return;
	const Vec<T> d = box.first_pixel() - c;
	scene.to.edge(shape, rest, 0, {0, 0}, -out, 0);
	visit_sides(scene, vertex, count, [&](int32_t k, const Vec<T> &from, const Vec<T> &to) {
		const Vec<T> way = to - from;
		const T length = norm(way);
		const Vec<T> n = length > 0 ? Vec<T>(-way.y() / length, way.x() / length) : Vec<T>(0, 1); /* lost in rounding, it goes along x */
		scene.to.side(rest, k, n, inner(n, d - from), from - d, to - d);
	});
}

/* Bodies of one row, from k on. */
template <typename T> static void draw_bodies(const Scene<T> &scene, int32_t k, int32_t count, int32_t shape, int32_t rest)
{
	Drawn<T> bodies{};
	Circles<T> circles;
	for (int32_t first = 0; first < count; first += batch) {
		const int32_t so_many = std::min(batch, count - first);
		bodies.take(scene.draws, k + first, so_many);
		if (std::find(bodies.count, bodies.count + so_many, 1) != bodies.count + so_many)
			circles.find(scene, bodies);
		for (int32_t i = 0; i < so_many; i++) {
			const int32_t vertex = bodies.vertex[i], its_shape = shape + bodies.shape[i], its_rest = rest + bodies.rest[i];
			const Ink<T> ink{bodies.fill[i], bodies.outline[i], scene.line, 1};
			if (bodies.count[i] == 1)
				circles.write(i, scene, its_shape, its_rest);
			else if (bodies.count[i] < 0)
				draw_outline(scene, vertex, -bodies.count[i], its_shape, its_rest, ink);
			else
				draw_polygon(scene, vertex, bodies.count[i], its_shape, its_rest, ink);
		}
	}
}

#if defined(__x86_64__)
/* The same with instructions of three operands, where the processor has them: a fifth fewer. */
[[gnu::target("avx2"), gnu::flatten]] static void draw_bodies_avx2(const Scene<float> &scene, int32_t k, int32_t count, int32_t shape, int32_t rest)
{
	draw_bodies(scene, k, count, shape, rest);
}

static auto best_draw_bodies(float)
{
	return __builtin_cpu_supports("avx2") ? draw_bodies_avx2 : draw_bodies<float>;
}
#endif

template <typename T> static auto best_draw_bodies(T)
{
	return draw_bodies<T>;
}

template <typename T> static void convex(const Job<T> &job)
{
	const Texels<T> view = job.texels(FROM_VIEW);
	const Scene<T> scene(job, view);
	const auto draw = best_draw_bodies(T());
	const int32_t marks = job.domain[2];
	const int32_t shape = static_cast<int32_t>(view.fact(VIEW_FIRST, FIRST_SHAPE));
	const int32_t rest = static_cast<int32_t>(view.fact(VIEW_FIRST, FIRST_EDGE));
	job.pool.run(job.domain[0], 512, [&](int32_t begin, int32_t end) {
		for (int32_t i = begin; i < std::min(end, marks); i++)
			draw_mark(scene, i, shape + i, rest + LINE_REST * i);
		for (int32_t i = std::max(begin, marks), count; i < end; i += count) {
			count = std::min(end - i, Drawn<T>::left(i - marks));
			draw(scene, i - marks, count, shape + marks, rest + LINE_REST * marks);
		}
	});
}

extern const Stage shapes_convex;
const Stage shapes_convex{"shapes", "convex", {{STAGE_SHAPES, convex<float>, convex<double>}}, nullptr, nullptr};

}
