#include "cpu/vertices.hpp"

namespace carom::cpu {

/* Sent are the local coordinates, from the host's copy of Vertices [3]. */
template <typename T> static void option3(const Job<T> &job)
{
	const Texels<T> stream = job.texels(PLACE_STREAM);
	place_vertices(job, [&](int32_t i) {
		return Sent<T>{static_cast<int32_t>(stream.of(i, STREAM_BODY)), {stream.of(i, STREAM_X), stream.of(i, STREAM_Y)}};
	});
}

extern const Stage vertices_option3;
const Stage vertices_option3{"vertices", "option3", {{STAGE_VERTICES, option3<float>, option3<double>}}, nullptr, nullptr};

}
