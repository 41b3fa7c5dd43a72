/* Shapes in pixels: CONTRACT.md, "shapes". */
#ifndef CAROM_CPU_SHAPES_HPP
#define CAROM_CPU_SHAPES_HPP

#include "cpu/stages.hpp"

namespace carom::cpu {

template <typename T> struct PixelBox {
	T x0, y0, x1, y1;

	bool empty() const { return !(x0 < x1); }
	Vec<T> first_pixel() const { return {x0 + T(0.5), y0 + T(0.5)}; }
};

template <typename T> struct Ink {
	T fill, outline, width, opacity;
};

template <typename T> T clamped(T v, T low, T high)
{
	return smaller(larger(low, v), high);
}

template <typename T> T floor_pixel(T v)
{
	const T c = clamped(v, T(-FARTHEST), T(FARTHEST)), whole = static_cast<T>(static_cast<int32_t>(c));
	return whole > c ? whole - 1 : whole;
}

template <typename T> T growth(T breadth)
{
	return clamped(T(0.5) * (1 - breadth), T(0), T(0.5));
}

/* An interval of pixels; empty where the end is not above the beginning. */
template <typename T> struct Pixels {
	T begin, end;

	/* Those that may be touched, within limits; not finite or too far out: none. (Without branches: compilers make vectors of it.) */
	[[gnu::always_inline]] Pixels(T low, T high, T margin, T least, T most)
		: begin(larger(floor_pixel(low - margin), least)), end(smaller(-floor_pixel(-(high + margin)), most))
	{
		const bool low_is_near = std::abs(low) < SEEN, high_is_near = std::abs(high) < SEEN, are_near = low_is_near & high_is_near;
		end = are_near ? end : begin;
	}

	bool any() const { return begin < end; }
};

/* The pixels that may be touched; an empty box for none. */
template <typename T> PixelBox<T> touched(const Vec<T> &low, const Vec<T> &high, T margin, const PixelBox<T> &clip)
{
	const Pixels<T> x(low.x(), high.x(), margin, clip.x0, clip.x1), y(low.y(), high.y(), margin, clip.y0, clip.y1);
	return x.any() && y.any() ? PixelBox<T>{x.begin, y.begin, x.end, y.end} : PixelBox<T>{};
}

/* Of a shape of that mean breadth and length: its fill, which is the outline's where that hides it; how broad its outline is; and how opaque it is. */
template <typename T> T fill_of(T fill, T outline, T breadth, T length)
{
	const bool is_line = (breadth < 1) & (T(LEAST_OPACITY) * length >= T(LINE_OPACITY)); /* two outlines and nothing between them */
	return is_line ? outline : fill;
}

template <typename T> T outline_of(T line, T breadth)
{
	return clamped(T(0.125) * breadth, T(0), line);
}

template <typename T> T opacity_of(T opacity, T breadth, T length)
{
	const T least = clamped(T(LEAST_OPACITY) * length, T(LEAST_OPACITY), T(LINE_OPACITY));
	return clamped(opacity, T(0), T(1)) * clamped(breadth, least, T(1));
}

template <typename T> Ink<T> seen(const Ink<T> &ink, T breadth, T length)
{
	return {fill_of(ink.fill, ink.outline, breadth, length), ink.outline, outline_of(ink.width, breadth), opacity_of(ink.opacity, breadth, length)};
}

/* Where shapes and edges go. */
template <typename T> class ShapeWriter
{
public:
	ShapeWriter(T *to_boxes, T *to_shapes, T *to_edges) : boxes(to_boxes), shapes(to_shapes), edges(to_edges) {}

	void hide(int32_t shape) const { boxes.put(shape, 0, 0, 0, 0); }

	/* False: it is not seen. `rest`: where its other edges are. */
	bool shape(int32_t shape, const PixelBox<T> &box, const Ink<T> &ink, int32_t rest, int32_t count) const
	{
		boxes.put(shape, box.x0, box.y0, box.x1, box.y1);
		if (box.empty())
			return false;
		shapes.put(SHAPES_WIDTH * shape + SHAPE_BOX, box.x0, box.y0, box.x1, box.y1);
		shapes.put(SHAPES_WIDTH * shape + SHAPE_INK, ink.fill, ink.outline, ink.width, ink.opacity);
		shapes.put(SHAPES_WIDTH * shape + SHAPE_EDGES, static_cast<T>(rest), static_cast<T>(count), 0, 0);
		return true;
	}

	/* Edge k of the shape. */
	void edge(int32_t shape, int32_t rest, int32_t k, const Vec<T> &slope, T at, T bend) const
	{
		if (k == 0)
			shapes.put(SHAPES_WIDTH * shape + SHAPE_EDGE, slope.x(), slope.y(), at, bend);
		else
			edges.put(rest + k - 1, slope.x(), slope.y(), at, bend);
	}

private:
	const Records<T> boxes, shapes, edges;
};

/* A line from a point along a unit vector. */
template <typename T> struct Line {
	Vec<T> from, along;
	T reach, breadth, color, opacity;

	void write(const ShapeWriter<T> &to, int32_t shape, int32_t rest, const PixelBox<T> &clip) const
	{
		const T half = T(0.5) * breadth;
		const Vec<T> end = from + reach * along, wide(half * std::abs(along.y()), half * std::abs(along.x()));
		const Vec<T> low(smaller(from.x(), end.x()) - wide.x(), smaller(from.y(), end.y()) - wide.y());
		const Vec<T> high(larger(from.x(), end.x()) + wide.x(), larger(from.y(), end.y()) + wide.y());
		const T size = norm(high - low), mean = (reach * breadth) / larger(size, T(1)), out = growth(mean);
		const PixelBox<T> box = reach > 0 ? touched(low, high, out, clip) : PixelBox<T>{};
		if (!to.shape(shape, box, seen<T>({color, color, 0, opacity}, mean, size), rest, LINE_EDGES))
			return;
		const Vec<T> d = box.first_pixel() - from, aside(along.y(), -along.x());
		const T far = inner(along, d), off = inner(aside, d), side = half + out;
		to.edge(shape, rest, 0, -along, -far - out, 0);
		to.edge(shape, rest, 1, along, (far - reach) - out, 0);
		to.edge(shape, rest, 2, -aside, -off - side, 0);
		to.edge(shape, rest, 3, aside, off - side, 0);
	}
};

}

#endif
