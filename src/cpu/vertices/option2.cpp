#include "cpu/vertices.hpp"

namespace carom::cpu {

/* Sent are the body's first texel in Vertices and the ordinal [3]. */
template <typename T> static void option2(const Job<T> &job)
{
	const Texels<T> stream = job.texels(PLACE_STREAM);
	const Accessed<T> vertices(job, PLACE_VERTICES);
	place_vertices(job, [&](int32_t i) {
		const int32_t first = static_cast<int32_t>(stream.of(i, STREAM_X)), ordinal = static_cast<int32_t>(stream.of(i, STREAM_Y));
		return Sent<T>{static_cast<int32_t>(stream.of(i, STREAM_BODY)), local_vertex(vertices, first, ordinal)};
	});
}

extern const Stage vertices_option2;
const Stage vertices_option2{"vertices", "option2", {{STAGE_VERTICES, option2<float>, option2<double>}}, nullptr, nullptr};

}
