#include "cpu/vertices.hpp"

namespace carom::cpu {

/* Sent are the body and the ordinal [3]. */
template <typename T> static void option1(const Job<T> &job)
{
	const Texels<T> stream = job.texels(PLACE_STREAM);
	const Accessed<T> geometry(job, PLACE_GEOMETRY), vertices(job, PLACE_VERTICES);
	place_vertices(job, [&](int32_t i) {
		const int32_t body = static_cast<int32_t>(stream.of(i, STREAM_X));
		const int32_t first = geometry.of(body).whole(GEOMETRY_FIRST);
		return Sent<T>{body, local_vertex(vertices, first, static_cast<int32_t>(stream.of(i, STREAM_Y)))};
	});
}

extern const Stage vertices_option1;
const Stage vertices_option1{"vertices", "option1", {{STAGE_VERTICES, option1<float>, option1<double>}}, nullptr, nullptr};

}
