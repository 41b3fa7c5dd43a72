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

/* What the host knows of a body. */
template <typename T> struct Drawn {
	int32_t vertex, count, shape, rest;
	T fill, outline;
};

/* The same of some that lie in one row. */
template <typename T> class DrawnRow
{
public:
	DrawnRow(const Texels<T> &draws, int32_t first)
	{
		for (int32_t c = 0; c < 4; c++)
			parts[c] = &draws.of(DRAWS_WIDTH * first + DRAW_PARTS, c), ink[c] = &draws.of(DRAWS_WIDTH * first + DRAW_INK, c);
	}

	Drawn<T> of(int32_t i) const
	{
		const auto part = [&](int32_t channel) { return static_cast<int32_t>(parts[channel][DRAWS_WIDTH * i]); };
		return {part(PARTS_VERTEX), part(PARTS_COUNT), part(PARTS_SHAPE), part(PARTS_EDGE), ink[INK_FILL][DRAWS_WIDTH * i],
			ink[INK_OUTLINE][DRAWS_WIDTH * i]};
	}

	/* So many are left of the row. */
	static int32_t left(int32_t first) { return (ROW_SIZE - (DRAWS_WIDTH * first & (ROW_SIZE - 1))) / DRAWS_WIDTH; }

private:
	const T *parts[4], *ink[4];
};

/* What is seen of four circles. No circle waits for another, so they are found side by side. */
template <typename T> class Circles
{
public:
	Circles(const Scene<T> &scene, const Drawn<T> (&bodies)[lane_count])
	{
		const auto placed = [&](int32_t channel) {
			const auto of = [&](int32_t i) { return scene.placed.of(bodies[i].vertex, channel); };
			return Lanes<T>{of(0), of(1), of(2), of(3)};
		};
		const Lanes<T> x = placed(PLACED_CENTER_X), y = placed(PLACED_CENTER_Y), rim_x = placed(PLACED_X), rim_y = placed(PLACED_Y);
		const Lanes<T> middle{bodies[0].fill, bodies[1].fill, bodies[2].fill, bodies[3].fill};
		const Lanes<T> outline{bodies[0].outline, bodies[1].outline, bodies[2].outline, bodies[3].outline};
		const Lanes<T> zero{}, one = zero + 1, radius = roots(rim_x * rim_x + rim_y * rim_y);
		const Lanes<T> breadth = ((DISC_AREA * radius) * radius) / larger(Lanes<T>(2 * radius), one), r = radius + growth(breadth);
		const Pixels<Lanes<T>> columns(x - r, x + r, zero, zero + scene.clip.x0, zero + scene.clip.x1);
		const Pixels<Lanes<T>> rows(y - r, y + r, zero, zero + scene.clip.y0, zero + scene.clip.y1);
		const auto any = (columns.begin < columns.end) & (rows.begin < rows.end);
		const Lanes<T> x0 = any ? columns.begin : zero, x1 = any ? columns.end : zero, y0 = any ? rows.begin : zero, y1 = any ? rows.end : zero;
		const Lanes<T> fx = x0 + T(0.5), fy = y0 + T(0.5), dx = fx - x, dy = fy - y;
		const auto is_beside = magnitude(dx) > magnitude(dy);
		const Lanes<T> center = is_beside ? x : y, first = is_beside ? fx : fy, other = is_beside ? dy : dx;
		const Lanes<T> square = ((center - r) - first) * ((center + r) - first) + other * other;
		keep(x0, y0, x1, y1, box);
		keep(fill_of<Lanes<T>>(middle, outline, breadth, 2 * radius), outline, outline_of<Lanes<T>>(zero + scene.line, breadth),
			opacity_of<Lanes<T>>(one, breadth, 2 * radius), ink);
		keep(dx / r, dy / r, square / (2 * r), 1 / (2 * r), edge);
		keep(x, y, rim_x, rim_y, place);
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
	static Lanes<T> roots(Lanes<T> squares)
	{
		for (int32_t i = 0; i < lane_count; i++)
			squares[i] = std::sqrt(squares[i]);
		return squares;
	}

	static void keep(const Lanes<T> &first, const Lanes<T> &second, const Lanes<T> &third, const Lanes<T> &fourth,
		T (&records)[lane_count][channel_count])
	{
		Lanes<T> rows[lane_count] = {first, second, third, fourth};
		transpose<T>(rows);
		std::memcpy(records, rows, sizeof rows);
	}

	T box[lane_count][channel_count], ink[lane_count][channel_count], edge[lane_count][channel_count], place[lane_count][channel_count];
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
	const DrawnRow<T> row(scene.draws, k);
	for (int32_t first = 0; first < count; first += lane_count) {
		Drawn<T> bodies[lane_count];
		for (int32_t i = 0; i < lane_count; i++)
			bodies[i] = row.of(std::min(first + i, count - 1));
		const Circles<T> circles(scene, bodies);
		for (int32_t i = 0; i < std::min(lane_count, count - first); i++) {
			const Drawn<T> &body = bodies[i];
			if (body.count == 1)
				circles.write(i, scene, shape + body.shape, rest + body.rest);
			else if (body.count < 0)
				draw_outline(scene, body.vertex, -body.count, shape + body.shape, rest + body.rest, {body.fill, body.outline, scene.line, 1});
			else
				draw_polygon(scene, body.vertex, body.count, shape + body.shape, rest + body.rest, {body.fill, body.outline, scene.line, 1});
		}
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
		for (int32_t i = std::max(begin, marks), count; i < end; i += count) {
			count = std::min(end - i, DrawnRow<T>::left(i - marks));
			draw_bodies(scene, i - marks, count, shape + marks, rest + LINE_REST * marks);
		}
	});
}

extern const Stage shapes_convex;
const Stage shapes_convex{"shapes", "convex", {{STAGE_SHAPES, convex<float>, convex<double>}}, nullptr, nullptr};

}
