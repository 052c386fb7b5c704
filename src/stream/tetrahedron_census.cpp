#include "regionmesh/census.h"
#include "stream/tetrahedron_faces.h"

namespace regionmesh {

TetrahedronCensus count_labels(TetrahedronReader& reader, const CensusOptions& options) {
    constexpr std::uint64_t kAnyMemory = std::uint64_t{1} << 62;  // no mesh is held
    TetrahedronFaces source(
        reader, {.cap = options.cap, .background = options.background, .sweep = options.sweep, .memory = kAnyMemory});
    FaceCount counted = *source.count({});
    return {.labels = source.labels(),
            .point_count = source.point_count(),
            .tetrahedron_count = source.tetrahedron_count(),
            .samples = source.samples(),
            .spacing = source.shape().scale,
            .sweep = source.shape().sweep,
            .face_count = counted.face_count,
            .oracle = std::move(counted.oracle)};
}

}  // namespace regionmesh
