/* Shapes in pixels: CONTRACT.md, "shapes". */
#ifndef CAROM_CPU_SHAPES_HPP
#define CAROM_CPU_SHAPES_HPP

#include <cstring>

#include "cpu/lanes.hpp"

namespace carom::cpu {

template <typename T> struct PixelBox {
	T x0, y0, x1, y1;

	bool empty() const { return !(x0 < x1); }
	Vec<T> first_pixel() const { return {x0 + T(0.5), y0 + T(0.5)}; }
};

template <typename T> struct Ink {
	T fill, outline, width, opacity;
};

/* What follows is of numbers, or of lanes of them: without branches. */

template <typename V> V all_of(float number)
{
	return V{} + number;
}

template <typename V> V clamped(V v, V low, V high)
{
	return smaller(larger(low, v), high);
}

template <typename T> T without_fraction(T v)
{
	return static_cast<T>(static_cast<int32_t>(v));
}

inline Lanes<float> without_fraction(Lanes<float> v)
{
	return __builtin_convertvector(__builtin_convertvector(v, decltype(v < v)), Lanes<float>);
}

inline Lanes<double> without_fraction(Lanes<double> v)
{
	return __builtin_convertvector(__builtin_convertvector(v, decltype(v < v)), Lanes<double>);
}

template <typename V> V floor_pixel(V v)
{
	const V c = clamped(v, all_of<V>(-FARTHEST), all_of<V>(FARTHEST)), whole = without_fraction(c);
	return whole > c ? whole - 1 : whole;
}

template <typename V> V growth(V breadth)
{
	return clamped(0.5f * (1 - breadth), V{}, all_of<V>(0.5f));
}

/* An interval of pixels; empty where the end is not above the beginning. */
template <typename V> struct Pixels {
	V begin, end;

	/* Those that may be touched, within limits; not finite or too far out: none. */
	Pixels(V low, V high, V margin, V least, V most)
		: begin(larger(floor_pixel(low - margin), least)), end(smaller(-floor_pixel(-(high + margin)), most))
	{
		const auto low_is_near = magnitude(low) < SEEN, high_is_near = magnitude(high) < SEEN;
		end = (low_is_near & high_is_near) ? end : begin;
	}
};

/* The pixels that may be touched; an empty box for none. */
template <typename T> PixelBox<T> touched(const Vec<T> &low, const Vec<T> &high, T margin, const PixelBox<T> &clip)
{
	const Pixels<T> x(low.x(), high.x(), margin, clip.x0, clip.x1), y(low.y(), high.y(), margin, clip.y0, clip.y1);
	return (x.begin < x.end && y.begin < y.end) ? PixelBox<T>{x.begin, y.begin, x.end, y.end} : PixelBox<T>{};
}

/* Of a shape of that mean breadth and length: its fill, which is the outline's where that hides it; how broad its outline is; and how opaque it is. */
template <typename V> V fill_of(V fill, V outline, V breadth, V length)
{
	const auto is_thin = breadth < 1, is_long = LEAST_OPACITY * length >= LINE_OPACITY;
	return (is_thin & is_long) ? outline : fill; /* a line: two outlines and nothing between them */
}

template <typename V> V outline_of(V line, V breadth)
{
	return clamped(0.125f * breadth, V{}, line);
}

template <typename V> V opacity_of(V opacity, V breadth, V length)
{
	const V least = clamped(LEAST_OPACITY * length, all_of<V>(LEAST_OPACITY), all_of<V>(LINE_OPACITY));
	return clamped(opacity, V{}, all_of<V>(1)) * clamped(breadth, least, all_of<V>(1));
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

	/* The same of records, with its first edge; there are no others. */
	bool shape(int32_t shape, const T *box, const T *ink, int32_t rest, const T *edge) const
	{
		const T parts[] = {static_cast<T>(rest), 1, 0, 0};
		copy(box, boxes, shape);
		if (!(box[BOX_X0] < box[BOX_X1]))
			return false;
		copy(box, shapes, SHAPES_WIDTH * shape + SHAPE_BOX);
		copy(ink, shapes, SHAPES_WIDTH * shape + SHAPE_INK);
		copy(parts, shapes, SHAPES_WIDTH * shape + SHAPE_EDGES);
		copy(edge, shapes, SHAPES_WIDTH * shape + SHAPE_EDGE);
		return true;
	}

	/* Side k of an outline: its line, and where it begins and ends. */
	void side(int32_t rest, int32_t k, const Vec<T> &slope, T at, const Vec<T> &from, const Vec<T> &to) const
	{
		edges.put(rest + SIDE_WIDTH * k + SIDE_LINE, slope.x(), slope.y(), at, 0);
		edges.put(rest + SIDE_WIDTH * k + SIDE_ENDS, from.x(), from.y(), to.x(), to.y());
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
	static void copy(const T *record, const Records<T> &to, int32_t index) { std::memcpy(&to.of(index, 0), record, channel_count * sizeof(T)); }

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
